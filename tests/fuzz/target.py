"""What a fuzzed reader is, and what its results must be."""

from collections.abc import Callable, Iterable
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from src.shared.errors import UserError

if TYPE_CHECKING:
    from src.shared.motion.motion import Motion

FRAMES = 24  # of the motions in whole files


@dataclass(frozen=True)
class Target:
    """One reader.

    Attributes:
        prepare: writes whole files into an empty folder.
        read: reads the damaged file, and what belongs to it.
        damaged: pattern of the files that are damaged.
        words: what the format knows, for text.
        refusals: what it may raise, and nothing else.
        mend: run after damage, half of the time: makes checksums fit, so that what lies behind
            them is reached.
    """

    prepare: Callable[[Path], None]
    read: Callable[[Path], None]
    damaged: str = "*"
    words: tuple[bytes, ...] = ()
    refusals: tuple[type[Exception], ...] = (UserError,)
    mend: Callable[[Path], None] | None = None


def check_motion(motion: "Motion") -> None:
    """A motion is whole: shapes, finite numbers, unit quaternions, a frame rate."""
    count = motion.num_frames
    assert count > 0 and motion.quaternions.shape == (count, 22, 4), motion.quaternions.shape
    assert motion.root_position.shape == (count, 3) and motion.contacts.shape == (count, 2)
    for values in (motion.quaternions, motion.root_position, motion.contacts):
        assert np.isfinite(values).all(), "values that are not finite"
    lengths = np.linalg.norm(motion.quaternions, axis=-1)
    assert np.abs(lengths - 1).max() < 1e-3, "quaternions that are no rotations"
    assert 0 < motion.fps <= 10_000, motion.fps


def check_arrays(arrays: Iterable[Any]) -> None:
    """Arrays or tensors of finite numbers."""
    for values in arrays:
        found = np.asarray(values)
        assert found.dtype.kind in "biuf", found.dtype
        assert np.isfinite(found.astype(np.float64)).all(), "values that are not finite"


def some_motion(index: int = 0) -> "Motion":
    """A short synthetic motion."""
    from src.shared.data.synthetic.clips import generate_clip, sample_specs
    from src.shared.motion.motion import Motion

    motion = generate_clip(sample_specs(8, 0)[index], seed=index)
    return Motion(
        motion.quaternions[:FRAMES],
        motion.root_position[:FRAMES],
        motion.contacts[:FRAMES],
        motion.fps,
        "a person",
    )
