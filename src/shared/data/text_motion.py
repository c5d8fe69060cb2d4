"""Captioned windows of motion, in batches that depend only on (seed, step, rank).

Batches are made on demand, so that a resumed run continues with the very batch it would have
seen, without any loader state. Gestures that come back to where they began are not cut off but
shortened. B batch, T frames; features are those of motion/features.py.
"""

from abc import ABC, abstractmethod
from collections.abc import Callable
from dataclasses import dataclass
from typing import TypedDict, Unpack

import numpy as np
import torch
from torch import Tensor

from ..config_schema import PROVENANCES
from ..metrics.measurements import arms_alone, rests_in_place, stays
from ..motion.features import FORWARD, LATERAL, ROOT_ROW, YAW_RATE, decode_features
from ..motion.motion import Motion
from .prepared import ClipRecord, PreparedData

_TURN_TRIES = 4
# Labels that speak of the whole clip: a window of it would contradict them.
_WHOLE_CLIP_LABELS = frozenset(("count", "angle"))


def _whole(record: ClipRecord) -> bool:
    return not _WHOLE_CLIP_LABELS.isdisjoint(record.labels)


@dataclass(frozen=True, eq=False)
class TextMotionBatch:
    """One padded batch.

    Attributes:
        motion: normalised features [B,T,23,6] float32, zero where padded.
        mask: True on real frames [B,T].
        captions, languages: B strings each.
        tag: index of the action label [B]; the number of tags where there is none.
        group: index of the label combination [B].
        provenance: index in PROVENANCES [B].
        records: the B records behind it.
    """

    motion: Tensor
    mask: Tensor
    captions: list[str]
    languages: list[str]
    tag: Tensor
    group: Tensor
    provenance: Tensor
    records: list[ClipRecord]

    def __len__(self) -> int:
        return len(self.captions)


class WindowOptions(TypedDict, total=False):
    """What `CaptionedWindows` takes beside its data."""

    min_frames: int
    max_frames: int
    whole: bool
    languages: tuple[str, ...]
    only: Callable[[ClipRecord], bool] | None
    seed: int


class CaptionedWindows(ABC):
    """Windows of clips with one caption each, as batches.

    Args:
        data: where the clips come from.
        whole: windows of `max_frames` always, or as long as the clip: nothing is cut off those in
            which everything has its second.
        only: clips that it says no to are left out, if given.
        seed: another one draws other windows and captions.
    """

    def __init__(
        self,
        data: PreparedData,
        *,
        min_frames: int = 32,
        max_frames: int = 128,
        whole: bool = False,
        languages: tuple[str, ...] = ("en", "es", "fr", "de", "ja", "zh"),
        only: Callable[[ClipRecord], bool] | None = None,
        seed: int = 0,
    ) -> None:
        self.data, self.seed, self._only, self.whole = data, seed, only, whole
        self.min_frames, self.max_frames, self.languages = min_frames, max_frames, languages
        self._tag_index = {name: index for index, name in enumerate(data.tags)}

    @abstractmethod
    def __len__(self) -> int:
        """Clips in all."""

    @abstractmethod
    def batch(self, step: int, size: int, *, rank: int = 0, count: int = 1) -> TextMotionBatch:
        """Part `rank` of `count` parts of `size` clips of a step: a function of these alone."""

    def _longest(self, rng: np.random.Generator) -> int:
        """Frames of the longest window of a batch."""
        shortest = self.max_frames if self.whole else self.min_frames
        return int(rng.integers(shortest, self.max_frames + 1))

    @abstractmethod
    def _features(self, record: ClipRecord) -> Tensor:
        """Raw features [T,23,6] of a clip."""

    @abstractmethod
    def _comes_back(self, record: ClipRecord) -> bool:
        """Whether a clip is a gesture, which is not cut off."""

    @abstractmethod
    def _group(self, record: ClipRecord) -> int:
        """A number that clips of one label combination share."""

    def _is_usable(self, record: ClipRecord) -> bool:
        """Whether it is wanted, long enough, can be shown whole if it must, and has a caption."""
        return (
            (self._only is None or self._only(record))
            and record.num_frames >= min(self.min_frames, self.max_frames)
            and not (_whole(record) and record.num_frames > self.max_frames)
            and any(self.data.captions(record).get(language) for language in self.languages)
        )

    def _caption(self, record: ClipRecord, rng: np.random.Generator) -> tuple[str, str]:
        captions = self.data.captions(record)
        available = [language for language in self.languages if captions.get(language)]
        language = available[rng.integers(len(available))]
        texts = captions[language]
        return texts[rng.integers(len(texts))], language

    def _fewest_frames(self, record: ClipRecord) -> int:
        """The shortest batch that a clip takes part in."""
        if _whole(record):
            return record.num_frames
        if self._comes_back(record):
            shortest = max(self.min_frames, round(record.num_frames * SHORTEST_SHARE))
            return min(record.num_frames, shortest)
        return 0

    def window(self, record: ClipRecord, frames: int, rng: np.random.Generator) -> Tensor:
        """A window [≤frames,23,6] of raw features, anywhere in the clip.

        A gesture that comes back to where it began is not cut off: where it is too long, its
        middle is left out, if two moments of it are alike enough to be joined.

        Where the labels tell of a turn, the window of several that turns most is taken: a crop
        without the turn would contradict its caption.
        """
        values = self._features(record)
        spare = len(values) - frames
        if spare <= 0:
            return values
        if self._comes_back(record) and (whole := shorten(values, frames)) is not None:
            return whole
        if "turn" not in record.labels and record.labels.get("action") != "turn":
            start = int(rng.integers(spare + 1))
            return values[start : start + frames]
        yaw = torch.nn.functional.pad(values[:, ROOT_ROW, YAW_RATE].cumsum(0), (1, 0))
        starts = rng.integers(spare + 1, size=_TURN_TRIES)
        start = int(max(starts, key=lambda s: abs(float(yaw[s + frames] - yaw[s]))))
        return values[start : start + frames]

    def collate(
        self, records: list[ClipRecord], frames: int, rng: np.random.Generator
    ) -> TextMotionBatch:
        """Windows of at most `frames` of these records as one batch."""
        windows = [self.window(record, frames, rng) for record in records]
        longest = max(len(window) for window in windows)
        motion = torch.zeros(len(records), longest, *self.data.mean.shape)
        mask = torch.zeros(len(records), longest, dtype=torch.bool)
        for row, window in enumerate(windows):
            motion[row, : len(window)] = (window - self.data.mean) / self.data.std
            mask[row, : len(window)] = True
        captions, languages = zip(*(self._caption(r, rng) for r in records), strict=True)
        none = len(self._tag_index)
        return TextMotionBatch(
            motion=motion,
            mask=mask,
            captions=list(captions),
            languages=list(languages),
            tag=torch.tensor([self._tag_index.get(r.tag, none) for r in records]),
            group=torch.tensor([self._group(r) for r in records]),
            provenance=torch.tensor([PROVENANCES.index(r.provenance) for r in records]),
            records=records,
        )


class TextMotionDataset(CaptionedWindows):
    """Windows of one split with one caption each."""

    def __init__(
        self,
        data: PreparedData,
        split: str,
        *,
        balance: float = 0.5,
        captured_share: float = 0.0,
        **windows: Unpack[WindowOptions],
    ) -> None:
        """Select the records of a split.

        Args:
            balance: 0 draws clips alike, 1 draws actions alike and the label combinations of an
                action alike; between: a mixture of exponents (a combination of n clips has
                weight n^(1-balance), an action of combinations of weight w in all
                w^(1-balance)).
            captured_share: of the draws of an action, at least so many go to its captured clips,
                where there are any: ten thousand procedural ones would drown six.

        Raises:
            ValueError: no clip of the split is long enough or has a caption in `languages`.
        """
        super().__init__(data, **windows)
        self.records = [record for record in data.records(split) if self._is_usable(record)]
        if not self.records:
            raise ValueError(
                f"split {split!r} of {data.folder} has no clip of at least {self.min_frames}"
                f" frames with a caption in {', '.join(self.languages)}"
            )
        groups = sorted({record.group for record in self.records})
        self._group_index = {name: index for index, name in enumerate(groups)}
        counts = np.bincount([self._group_index[r.group] for r in self.records])
        weights = np.array(
            [counts[self._group_index[r.group]] ** -balance for r in self.records], np.float64
        )
        recorded = np.array([record.provenance == "captured" for record in self.records])
        for action in {record.tag for record in self.records}:
            of_action = np.array([record.tag == action for record in self.records])
            weights[of_action] *= weights[of_action].sum() ** -balance
            captured = of_action & recorded
            theirs, all_of_it = weights[captured].sum(), weights[of_action].sum()
            if 0 < theirs < captured_share * all_of_it:
                weights[captured] *= captured_share * all_of_it / theirs
                weights[of_action & ~recorded] *= (1 - captured_share) / (1 - theirs / all_of_it)
        self._weights = weights
        self._gestures = {record.id for record in self.records if comes_back(data.features(record))}
        self._least = np.array([self._fewest_frames(record) for record in self.records])

    def __len__(self) -> int:
        return len(self.records)

    def _features(self, record: ClipRecord) -> Tensor:
        return self.data.features(record)

    def _comes_back(self, record: ClipRecord) -> bool:
        return record.id in self._gestures

    def _group(self, record: ClipRecord) -> int:
        return self._group_index[record.group]

    def batch(self, step: int, size: int, *, rank: int = 0, count: int = 1) -> TextMotionBatch:
        """Clips drawn for a part of one step; all windows of a step share one target length.

        One length a batch keeps padding small; lengths are spread evenly over the steps. Clips
        that are not to be cut (a counted action) take part in the batches that hold them whole.
        """
        shared = np.random.default_rng((self.seed, step))
        longest = self._longest(shared)
        rng = np.random.default_rng((self.seed, step, rank, 1))
        weights = np.where(self._least <= longest, self._weights, 0.0)
        if not weights.any():  # nothing but long, whole clips
            weights, longest = self._weights, self.max_frames
        chosen = rng.choice(len(self.records), size=size, p=weights / weights.sum())
        return self.collate([self.records[i] for i in chosen], longest, rng)

    def fixed_batches(self, size: int, num: int) -> list[TextMotionBatch]:
        """The same batches every time, each record at most once while they last."""
        rng = np.random.default_rng((self.seed, 2))
        order = rng.permutation(len(self.records))
        batches = []
        for number in range(num):
            chosen = order[number * size : (number + 1) * size]
            if len(chosen) == 0 or (number and len(chosen) < 2):
                break
            batches.append(self.collate([self.records[i] for i in chosen], self.max_frames, rng))
        return batches


SHORTEST_SHARE = 0.4  # of its frames a gesture keeps at least
_GESTURE_CLIPS = 40  # of an action are looked at
_IN_PLACE = 0.3  # m/s over the ground, on average
_SAME_POSE = 1.0  # between [22,6] rotations: hands that hang, twice; half a step is 1.2
_JOIN = 10  # frames over which the two moments are blended
_ENDS = 8  # frames at both ends that are never left out
_PACE = 6.0  # frames of motion that weigh as much as the pose, when moments are compared


def gestures(data: PreparedData) -> tuple[str, ...]:
    """Actions of which a quarter of the training clips or more begin and end at rest, in place.

    A quarter, because clips are cut out of takes in which a gesture goes on and on.
    """
    return _actions_that(rests_in_place, data, 0.25)


def arm_actions(data: PreparedData) -> tuple[str, ...]:
    """Actions that half of the training clips or more do with the arms alone."""
    return _actions_that(arms_alone, data, 0.5)


def still_actions(data: PreparedData) -> tuple[str, ...]:
    """Actions that end where they began in half of the training clips or more."""
    return _actions_that(stays, data, 0.5)


def _actions_that(
    does: Callable[[Motion], bool], data: PreparedData, share: float
) -> tuple[str, ...]:
    """Actions that do it in this share of their training clips or more."""
    clips: dict[str, list[ClipRecord]] = {}
    for record in data.records("train"):
        if record.tag and not record.mirrored and record.num_frames > 2 * _ENDS:
            clips.setdefault(record.tag, []).append(record)
    found = []
    for action, records in sorted(clips.items()):
        some = records[:: -(-len(records) // _GESTURE_CLIPS)]
        answers = [does(decode_features(data.features(record))) for record in some]
        found += [action] if sum(answers) >= share * len(answers) else []
    return tuple(found)


def comes_back(values: Tensor) -> bool:
    """Whether a clip [T,23,6] stays in place and ends in the pose that it began with."""
    travel = values[:, ROOT_ROW, [FORWARD, LATERAL]].norm(dim=-1).mean()
    gap = (values[0, :ROOT_ROW] - values[-1, :ROOT_ROW]).norm()
    return bool(travel < _IN_PLACE) and bool(gap < _SAME_POSE)


def shorten(values: Tensor, frames: int) -> Tensor | None:
    """The clip [T,23,6] without a part of its middle: [≤frames,23,6], or None.

    The two moments nearest in pose and motion are joined (a transition of a motion graph, Kovar
    et al. 2002, section 3.1), as far apart as is needed and up to a fifth more. None where too
    much would go, or no two moments are alike.
    """
    num = len(values)
    excess = num - frames
    if frames < num * SHORTEST_SHARE or num - excess < 2 * _ENDS:
        return None
    pose = values[:, :ROOT_ROW].flatten(1)  # [T,132]
    pace = torch.nn.functional.pad(pose[1:] - pose[:-1], (0, 0, 0, 1)) * _PACE
    moments = torch.cat((pose, pace), dim=1)
    far = torch.cdist(moments, moments)  # [T,T]
    first, second = torch.meshgrid(torch.arange(num), torch.arange(num), indexing="ij")
    apart = second - first
    allowed = (apart >= excess) & (apart <= excess + frames // 5)
    allowed &= (first >= _ENDS) & (second < num - _ENDS - _JOIN)
    far = far.masked_fill(~allowed, torch.inf)
    best = int(far.argmin())
    start, end = best // num, best % num
    if far[start, end] > _SAME_POSE:
        return None
    share = torch.linspace(0, 1, _JOIN + 2)[1:-1, None, None]
    joined = torch.lerp(values[start : start + _JOIN], values[end : end + _JOIN], share)
    return torch.cat((values[:start], joined, values[end + _JOIN :]))
