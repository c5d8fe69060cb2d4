"""What every reader hands over: a tree of joints and where they are in each frame.

Legend: T frames, N joints of the file.
"""

from typing import Protocol, Self

import numpy as np

ALL = slice(None)


class SourceClip(Protocol):
    """A recording as it stands in its file: its own joint names, axes and unit of length.

    At rest every joint's axes are parallel to the file's world axes, and `offsets` are the bones.
    """

    @property
    def names(self) -> tuple[str, ...]:
        """Joint names, parents before children."""
        ...

    @property
    def parents(self) -> tuple[int, ...]:
        """Index of each joint's parent; -1 for a root."""
        ...

    @property
    def offsets(self) -> np.ndarray:
        """Each joint's place in its parent's axes at rest [N,3]."""
        ...

    @property
    def frame_time(self) -> float:
        """Seconds between two frames."""
        ...

    @property
    def num_frames(self) -> int:
        """T."""
        ...

    def every(self, stride: int) -> Self:
        """Only every `stride`-th frame, `frame_time` lengthened accordingly."""
        ...

    def world(self, frames: slice = ALL) -> tuple[np.ndarray, np.ndarray]:
        """World positions [T,N,3], in the file's unit, and world rotations [T,N,3,3]."""
        ...


def compose(
    parents: tuple[int, ...], rotations: np.ndarray, translations: np.ndarray
) -> tuple[np.ndarray, np.ndarray]:
    """Local to world, in place: positions [T,N,3] and rotations [T,N,3,3].

    Args:
        rotations: of each joint against its parent [T,N,3,3].
        translations: of each joint in its parent's axes [T,N,3].
    """
    for joint, parent in enumerate(parents):
        if parent >= 0:
            above = rotations[:, parent]
            rotations[:, joint] = above @ rotations[:, joint]
            moved = above @ translations[:, joint, :, None]
            translations[:, joint] = moved[..., 0] + translations[:, parent]
    return translations, rotations
