"""Which clips to judge on: held back from training, seen and unseen label combinations apart.

Letters: N clips, T frames, K bones.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from ..data.prepared import SYNTHETIC, ClipRecord, PreparedData
from ..errors import UserError
from ..motion.features import decode_features
from .samples import Clips

FRESH_SEED = 90210  # of synthetic clips made only to test: never one that trains
FRESH_CLIPS = 800


@dataclass(frozen=True)
class HeldOut:
    """Clips of each kind, and where they come from.

    Attributes:
        records: `seen` and `unseen` (label combinations) to their clips.
        source: one line for the report.
    """

    data: PreparedData
    records: dict[str, list[ClipRecord]]
    source: str

    @property
    def everything(self) -> list[ClipRecord]:
        """The clips of all kinds."""
        return [record for records in self.records.values() for record in records]


def open_held_out(data: str, cache: Path, trained_groups: frozenset[str]) -> HeldOut:
    """The test splits of a prepared folder, or fresh synthetic clips.

    Fresh clips are made with a seed that no training uses, so that all of them are held back;
    a label combination is unseen if it is not among `trained_groups`.

    Args:
        data: prepared folder, or "synthetic".
        cache: where synthetic clips are kept.
        trained_groups: label combinations that the models were trained on.

    Raises:
        UserError: no such folder, or it is damaged.
    """
    if data != SYNTHETIC:
        prepared = PreparedData.open(data)
        splits = {name: prepared.records(f"test_{name}") for name in ("seen", "unseen")}
        return HeldOut(prepared, splits, f"test splits of {data}")
    from ..data.prepare import prepare
    from ..data.sources.folders import SyntheticSource
    from ..io.files import sole_writer

    folder = cache / f"synthetic-test-{FRESH_CLIPS}"
    with sole_writer(folder, wait=True):
        prepare([SyntheticSource(FRESH_CLIPS, seed=FRESH_SEED)], folder)
    prepared = PreparedData.open(folder)
    splits = {"seen": [], "unseen": []}
    for record in prepared.records():
        splits["seen" if record.group in trained_groups else "unseen"].append(record)
    return HeldOut(prepared, splits, f"fresh synthetic clips, seed {FRESH_SEED}")


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
