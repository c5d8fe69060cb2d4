"""Full-body dances of a row: each with its song, its path, and itself before the feet were held.

Letters: N dances, T frames, M beats.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field, replace
from functools import partial
from typing import TypeVar

import numpy as np

from ..motion.motion import Motion
from ..motion.trajectory import MotionTrajectory
from .samples import Memo

Found = TypeVar("Found")


@dataclass(frozen=True, eq=False)
class BodyDance:
    """A body's motion of T frames and the music that it is held against.

    Attributes:
        song: name.
        motion: as it is handed over.
        beats: of the music, seconds [M]; some may lie beyond the end.
        raw: the motion before its feet were held; None = nobody held them.
        path: that it was to stand on; None = it has its own.
        seams: True [T] near a seam of two windows; None = one piece.
        memo: of the motion; it goes with the motion wherever that goes.
    """

    song: str
    motion: Motion
    beats: np.ndarray
    raw: Motion | None = None
    path: MotionTrajectory | None = None
    seams: np.ndarray | None = None
    memo: Memo = field(default_factory=Memo, repr=False)

    @property
    def seconds(self) -> float:
        return self.motion.seconds

    @property
    def unheld(self) -> Motion:
        """The motion whose feet nobody held."""
        return self.motion if self.raw is None else self.raw


@dataclass(frozen=True, eq=False)
class BodySample:
    """N dances; `source`, `memo` as in `MotionSample`."""

    dances: list[BodyDance]
    source: np.ndarray
    memo: Memo = field(default_factory=Memo, repr=False)

    @classmethod
    def of(cls, dances: Sequence[BodyDance]) -> "BodySample":
        """Dances that answer to no real one."""
        return cls(list(dances), np.full(len(dances), -1))

    def __len__(self) -> int:
        return len(self.dances)

    @property
    def asked(self) -> list[str]:
        """The song of each dance."""
        return [dance.song for dance in self.dances]

    def each(self, name: str, measure: Callable[[BodyDance], Found]) -> list[Found]:
        """What `measure` says of each motion, its music apart, computed once a motion."""
        return [dance.memo.once(name, partial(measure, dance)) for dance in self.dances]

    def rows(self, index: Sequence[int]) -> "BodySample":
        """The dances at these rows, in this order."""
        return BodySample([self.dances[i] for i in index], self.source[list(index)])

    def reordered(self, order: Sequence[int]) -> "BodySample":
        """The music stays, motions change places: what not listening gives."""
        moved = [
            replace(self.dances[row], song=dance.song, beats=dance.beats)
            for dance, row in zip(self.dances, order, strict=True)
        ]
        return BodySample(moved, self.source)
