"""Real clips to measure against, and motions made for their captions, at the same lengths.

Letters: N clips, T frames, K bones.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace

import numpy as np
from torch import Tensor

from ..data.prepared import ClipRecord, PreparedData
from ..errors import UserError
from ..motion.features import FORWARD, LATERAL, ROOT_ROW, YAW_RATE, decode_features
from ..motion.motion import Motion

# Prompts and their numbers of frames, with a seed, to one motion each, in the same order.
Sampler = Callable[[Sequence[str], Sequence[int], int], list[Motion]]


@dataclass(frozen=True)
class Clips:
    """N motions with what they are about; row i of each field belongs together."""

    motions: list[Motion]
    captions: list[str]
    groups: list[str]
    tags: list[str]
    labels: list[dict[str, str]]

    def __len__(self) -> int:
        return len(self.motions)

    @property
    def num_frames(self) -> list[int]:
        """Length of each motion in frames."""
        return [motion.num_frames for motion in self.motions]

    def rows(self, index: Sequence[int]) -> "Clips":
        """The clips at these rows, in this order."""
        return Clips(
            motions=[self.motions[i] for i in index],
            captions=[self.captions[i] for i in index],
            groups=[self.groups[i] for i in index],
            tags=[self.tags[i] for i in index],
            labels=[self.labels[i] for i in index],
        )

    def with_motions(self, motions: list[Motion]) -> "Clips":
        """The same captions and labels over other motions."""
        return replace(self, motions=motions)


def choose_caption(captions: Sequence[str], key: str, seed: int) -> str:
    """One of a clip's captions, the same for the same key (the clip's id) and seed."""
    rng = np.random.default_rng([seed, *key.encode()])
    return captions[int(rng.integers(len(captions)))]


def spread_over_groups(records: Sequence[ClipRecord], num: int, seed: int) -> list[ClipRecord]:
    """At most `num` different records, one of each label group in turn, in a random order.

    A source with many clips of one action (Bandai: two in three raise or wave an arm) would
    otherwise decide every figure.
    """
    rng = np.random.default_rng(seed)
    queues: dict[str, list[ClipRecord]] = {}
    for row in rng.permutation(len(records)):
        queues.setdefault(records[row].group, []).append(records[row])
    chosen: list[ClipRecord] = []
    while queues and len(chosen) < num:
        for group in rng.permutation(sorted(queues)):
            chosen.append(queues[group].pop())
            if not queues[group]:
                del queues[group]
    return chosen[:num]


def real_clips(
    data: PreparedData,
    records: Sequence[ClipRecord],
    *,
    num: int,
    max_frames: int,
    language: str = "en",
    min_frames: int = 16,
    seed: int = 0,
) -> Clips:
    """At most `num` of these clips that have a caption in the language, spread over groups.

    Of longer clips the first `max_frames` count.

    Raises:
        UserError: there is no such clip.
    """
    usable = [
        record
        for record in records
        if record.num_frames >= min_frames and data.captions(record).get(language)
    ]
    if not usable:
        raise UserError(
            f"no clip of {min_frames} frames with a {language!r} caption to evaluate"
            "; prepare longer or captioned clips"
        )
    chosen = spread_over_groups(usable, num, seed)
    return Clips(
        motions=[decode_features(data.features(record)[:max_frames]) for record in chosen],
        captions=[
            choose_caption(data.captions(record)[language], record.id, seed) for record in chosen
        ],
        groups=[record.group for record in chosen],
        tags=[record.tag for record in chosen],
        labels=[record.labels for record in chosen],
    )


def frozen(features: Tensor) -> Tensor:
    """The first pose [T, K + 1, 6] held for the whole clip: the floor for anything that moves."""
    still = features[:1].expand_as(features).clone()
    still[:, ROOT_ROW, [FORWARD, LATERAL, YAW_RATE]] = 0
    return still
