"""The plug-in point of the harness: a family of metrics brings columns and what they mean.

To add one: write a class with the attributes of `MetricFamily` in a file of its own and name it in
`registry.py`. Tables, intervals, comparison, the reports and their legend follow by themselves.

Letters: N motions of a sample, D embedding channels.
"""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import partial
from typing import Literal, Protocol, Self, TypeVar

import numpy as np

from ..motion.motion import Motion
from ..motion.trajectory import MotionTrajectory
from .clips import Clips

Better = Literal["high", "low", "real"]  # real: the nearer to the real row, the better
Value = float | np.ndarray
Found = TypeVar("Found")


@dataclass(frozen=True)
class Column:
    """One figure of a table.

    Attributes:
        key: in report.json; unique among the families of a branch.
        heading: above the column, with its unit.
        decimals: shown.
        better: which way is good; `worst first` goes by the columns that are not `real`.
        share: yes or no a motion (1 or 0): its interval is Wilson's, which has a width at 0 of N.
    """

    key: str
    heading: str
    decimals: int = 3
    better: Better = "real"
    share: bool = False


class Memo:
    """What is computed of a sample once: features, kinematics, fitted axes."""

    def __init__(self) -> None:
        self.known: dict[str, object] = {}

    def once(self, name: str, compute: Callable[[], Found]) -> Found:
        """The value kept under `name`, computed at the first call."""
        if name not in self.known:
            self.known[name] = compute()
        return self.known[name]  # type: ignore[return-value]


@dataclass(frozen=True, eq=False)
class MotionSample:
    """N motions of the text branch under N captions.

    Attributes:
        clips: motions, captions, label groups, tags and labels, row by row.
        text, motion: the judge's embeddings [N,D].
        source: row [N] of the reference clip whose caption was asked for, -1 = none.
        memos: one a motion; it goes with the motion wherever that goes.
        memo: `sample.memo.once("features", lambda: ...)` computes a thing once a sample.
        whole: of which this is a part; units fitted on halves would differ from row to row.
    """

    clips: Clips
    text: np.ndarray
    motion: np.ndarray
    source: np.ndarray
    memos: list[Memo]
    memo: Memo = field(default_factory=Memo, repr=False)
    whole: "MotionSample | None" = field(default=None, repr=False)

    @classmethod
    def of(
        cls, clips: Clips, text: np.ndarray, motion: np.ndarray, source: np.ndarray
    ) -> "MotionSample":
        """A sample of which nothing has been computed."""
        return cls(clips, text, motion, source, [Memo() for _ in range(len(clips))])

    def __len__(self) -> int:
        return len(self.clips)

    @property
    def asked(self) -> list[str]:
        """What each motion was asked for."""
        return self.clips.captions

    def each(self, name: str, measure: Callable[[Motion], Found]) -> list[Found]:
        """What `measure` says of each of the N motions, computed once a motion."""
        pairs = zip(self.memos, self.clips.motions, strict=True)
        return [memo.once(name, partial(measure, motion)) for memo, motion in pairs]

    def rows(self, index: Sequence[int]) -> "MotionSample":
        """The pairs at these rows, in this order."""
        at = list(index)
        memos = [self.memos[row] for row in at]
        clips = self.clips.rows(at)
        text, motion, source = self.text[at], self.motion[at], self.source[at]
        return MotionSample(clips, text, motion, source, memos, whole=self.whole or self)

    def reordered(self, order: Sequence[int]) -> "MotionSample":
        """Captions and labels stay, motions change places: what ignoring the prompt gives."""
        at = list(order)
        clips = self.clips.with_motions([self.clips.motions[row] for row in at])
        memos = [self.memos[row] for row in at]
        return MotionSample(clips, self.text, self.motion[at], self.source, memos)


@dataclass(frozen=True, eq=False)
class Dance:
    """A motion of T frames and the music that it is held against.

    Attributes:
        song: name; dances of one song are neighbours, not strangers.
        trajectory: [T,25], 30 frames a second.
        beats: of the music, seconds; some may lie beyond the end.
        bars: true bars [T] of the music, unwrapped; None = nobody knows.
        meter: beats a bar of the music.
        counted: beats a bar that the trajectory's phase counts.
        memo: of the trajectory; like `counted`, it goes where the trajectory goes.
    """

    song: str
    trajectory: MotionTrajectory
    beats: np.ndarray
    bars: np.ndarray | None = None
    meter: int = 4
    counted: int = 4
    memo: Memo = field(default_factory=Memo, repr=False)

    @property
    def seconds(self) -> float:
        return self.trajectory.seconds


@dataclass(frozen=True, eq=False)
class DanceSample:
    """N motions of the audio branch, each with its music; the rest as in `MotionSample`."""

    dances: list[Dance]
    source: np.ndarray
    memo: Memo = field(default_factory=Memo, repr=False)
    whole: "DanceSample | None" = field(default=None, repr=False)

    def __len__(self) -> int:
        return len(self.dances)

    @property
    def asked(self) -> list[str]:
        """The song of each motion."""
        return [dance.song for dance in self.dances]

    def each(self, name: str, measure: Callable[[MotionTrajectory], Found]) -> list[Found]:
        """What `measure` says of each of the N trajectories, computed once a trajectory."""
        return [dance.memo.once(name, partial(measure, dance.trajectory)) for dance in self.dances]

    def rows(self, index: Sequence[int]) -> "DanceSample":
        """The dances at these rows, in this order."""
        rows = [self.dances[i] for i in index]
        return DanceSample(rows, self.source[list(index)], whole=self.whole or self)

    def reordered(self, order: Sequence[int]) -> "DanceSample":
        """The music stays, motions change places: what not listening gives."""
        moved = []
        for dance, row in zip(self.dances, order, strict=True):
            other = self.dances[row]
            moved.append(
                replace(dance, trajectory=other.trajectory, counted=other.counted, memo=other.memo)
            )
        return DanceSample(moved, self.source)


class AnySample(Protocol):
    """What the engine asks of a set of N motions; the families of a kind know more of theirs."""

    def __len__(self) -> int: ...
    @property
    def asked(self) -> list[str]: ...
    def rows(self, index: Sequence[int]) -> Self: ...


Sample = TypeVar("Sample", bound=AnySample, contravariant=True)


class MetricFamily(Protocol[Sample]):
    """Figures that belong together and share a definition.

    Attributes:
        name: of the family's table.
        columns: what `compute` may return, in the order shown.
        definition: Markdown for the legend: what each figure is, its source, and what it cannot
            tell.
        distance: the figures are distances from the reference. The real row is then measured
            between two disjoint halves of the real motions, since a sample is at 0 from itself.
    """

    @property
    def name(self) -> str: ...
    @property
    def columns(self) -> tuple[Column, ...]: ...
    @property
    def definition(self) -> str: ...
    @property
    def distance(self) -> bool: ...

    def compute(self, sample: Sample, reference: Sample, *, seed: int) -> Mapping[str, Value]:
        """The figures of one sample in one replication.

        Args:
            sample: motions to judge: real, chance, frozen, untrained or generated ones.
            reference: the real motions. Row `sample.source[i]` is the one that motion i was asked
                to resemble. What is fitted on it belongs in `reference.memo`.
            seed: of every random choice (batches, pairs).

        Returns:
            By column key a float for the sample as a whole (its interval comes from
            replications), or an array [N], one value a motion, NaN where the column does not apply
            (mean and interval come from a bootstrap over motions; comparisons pair them by
            prompt). A column that cannot be computed is left out.
        """
        ...
