"""A recording given as local rotations of our own 22 joints: AMASS, HumanML3D.

Legend: T frames, N = 22 joints.
"""

from dataclasses import dataclass, replace

import numpy as np

from ..motion.skeleton import JOINT_NAMES, PARENTS
from .source_clip import ALL, compose


@dataclass(frozen=True, eq=False)
class JointClip:
    """Rotations on our joints, with the file's own bone lengths.

    Attributes:
        rotations: of each joint against its parent [T,22,3,3].
        root: world position of the pelvis [T,3], metres.
        offsets: bones at rest [22,3], metres.
        ours: the body is our own, so places are taken as they are.
    """

    rotations: np.ndarray
    root: np.ndarray
    offsets: np.ndarray
    frame_time: float
    names: tuple[str, ...] = JOINT_NAMES
    parents: tuple[int, ...] = PARENTS
    metres: float = 1.0
    ours: bool = False

    @property
    def num_frames(self) -> int:
        return len(self.root)

    def every(self, stride: int) -> "JointClip":
        return replace(self, rotations=self.rotations[::stride], root=self.root[::stride],
                       frame_time=self.frame_time * stride)  # fmt: skip

    def world(self, frames: slice = ALL) -> tuple[np.ndarray, np.ndarray]:
        """World positions [T,22,3] and world rotations [T,22,3,3]."""
        root = self.root[frames]
        translations = np.repeat(self.offsets[None].astype(np.float64), len(root), axis=0)
        translations[:, 0] = root
        return compose(self.parents, self.rotations[frames].astype(np.float64), translations)
