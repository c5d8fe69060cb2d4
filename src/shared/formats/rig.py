"""A moving skeleton with its own names, lengths and axes: what BVH, GLB and USD files hold.

Rotations are told from the rest pose with the world's axes, whatever axes the joints of the file
have: a joint at rest has the identity. Files with axes of their own (GLB) keep them in `frames`.
Legend: T frames, N joints.
"""

from dataclasses import dataclass, replace

import numpy as np

from ..motion.motion import Motion
from ..motion.skeleton import JOINT_INDEX, REST_PELVIS_HEIGHT, canonical_skeleton
from .body import END_SITES
from .joint_names import joint_names
from .source_clip import ALL, compose


@dataclass(frozen=True, eq=False)
class Rig:
    """A skeleton at rest.

    Attributes:
        names: joint names, parents before children; joint 0 is the only root.
        parents: index of each joint's parent, -1 for the root.
        offsets: [N,3] from the parent (of the root: from the origin) at rest, along the world's
            axes, in the unit of the file.
        tips: (joint, offset [3] of the end of its bone) of chains that end.
        frames: [N,3,3] the joints' own axes in the world at rest.
        orders: Euler order of each joint where the file names one; "ZXY" otherwise.
        metres: length of the file's unit.
    """

    names: tuple[str, ...]
    parents: tuple[int, ...]
    offsets: np.ndarray
    tips: tuple[tuple[int, tuple[float, float, float]], ...]
    frames: np.ndarray
    orders: tuple[str, ...]
    metres: float = 1.0

    def rest(self) -> np.ndarray:
        """Position of each joint at rest [N,3]."""
        positions = self.offsets.astype(np.float64).copy()
        for joint, parent in enumerate(self.parents):
            if parent >= 0:
                positions[joint] += positions[parent]
        return positions

    def children(self, joint: int) -> list[int]:
        """Joints whose parent this one is."""
        return [child for child, parent in enumerate(self.parents) if parent == joint]


@dataclass(frozen=True, eq=False)
class RigClip:
    """A rig in motion; what `source_clip.SourceClip` promises, so any reader's user takes it.

    Attributes:
        rig: the skeleton.
        rotations: [T,N,3,3] turn of each joint from rest against its parent.
        translations: [T,N,3] position of each joint against its parent, along the world's axes
            at rest, in the rig's unit; most equal `rig.offsets`.
        fps: frames a second.
        text: caption, may be empty.
    """

    rig: Rig
    rotations: np.ndarray
    translations: np.ndarray
    fps: float
    text: str = ""

    @property
    def names(self) -> tuple[str, ...]:
        return self.rig.names

    @property
    def parents(self) -> tuple[int, ...]:
        return self.rig.parents

    @property
    def offsets(self) -> np.ndarray:
        return self.rig.offsets

    @property
    def frame_time(self) -> float:
        return 1.0 / self.fps

    @property
    def num_frames(self) -> int:
        return len(self.rotations)

    def every(self, stride: int) -> "RigClip":
        """Only every `stride`-th frame."""
        rotations, translations = self.rotations[::stride], self.translations[::stride]
        return replace(self, rotations=rotations, translations=translations, fps=self.fps / stride)

    def world(self, frames: slice = ALL) -> tuple[np.ndarray, np.ndarray]:
        """World positions [T,N,3] and turns from rest [T,N,3,3], both float64."""
        return compose(
            self.parents,
            np.array(self.rotations[frames], dtype=np.float64),
            np.array(self.translations[frames], dtype=np.float64),
        )

    def moving(self) -> list[int]:
        """The root, and joints that move against their parents."""
        strays = np.abs(self.translations - self.rig.offsets).max((0, 2))
        reach = max(1e-9, float(np.abs(self.rig.offsets).max()))
        return [j for j, stray in enumerate(strays) if j == 0 or stray > 1e-6 * reach]


def canonical_rig(names: str = "canonical") -> Rig:
    """Our skeleton, its joints named as a tool likes (`joint_names.SCHEMES`)."""
    skeleton = canonical_skeleton()
    offsets = skeleton.offsets.astype(np.float64)
    offsets[0] = (0.0, REST_PELVIS_HEIGHT, 0.0)
    count = len(skeleton.names)
    return Rig(
        joint_names(names),
        skeleton.parents,
        offsets,
        tuple(END_SITES.items()),
        np.tile(np.eye(3), (count, 1, 1)),
        ("ZXY",) * count,
    )


def motion_clip(motion: Motion, names: str = "canonical") -> RigClip:
    """A motion on our own skeleton, nothing changed."""
    rig = canonical_rig(names)
    translations = np.repeat(rig.offsets[None], motion.num_frames, 0)
    translations[:, JOINT_INDEX["pelvis"]] = motion.root_position
    rotations = quaternions_to_matrices(motion.quaternions)
    return RigClip(rig, rotations, translations, motion.fps, motion.text)


def rescaled(clip: RigClip, metres: float) -> RigClip:
    """The same clip with another unit of length."""
    rig = clip.rig
    factor = rig.metres / metres
    tips = tuple((j, (x * factor, y * factor, z * factor)) for j, (x, y, z) in rig.tips)
    rig = replace(rig, offsets=rig.offsets * factor, tips=tips, metres=metres)
    return replace(clip, rig=rig, translations=clip.translations * factor)


def turned(clip: RigClip, turn: np.ndarray) -> RigClip:
    """The same clip in a world that is turned by a rotation [3,3]."""
    rig = clip.rig
    tips = tuple((j, tuple((turn @ np.array(tip)).tolist())) for j, tip in rig.tips)
    rig = replace(rig, offsets=rig.offsets @ turn.T, tips=tips, frames=turn @ rig.frames)
    rotations = turn @ clip.rotations @ turn.T
    return replace(clip, rig=rig, rotations=rotations, translations=clip.translations @ turn.T)


def quaternions_to_matrices(quaternions: np.ndarray) -> np.ndarray:
    """Rotation matrices [...,3,3] float64 of quaternions [...,4], normalised first."""
    quaternions = quaternions.astype(np.float64)
    w, x, y, z = np.moveaxis(
        quaternions / np.linalg.norm(quaternions, axis=-1, keepdims=True), -1, 0
    )
    rows = (
        (1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)),
        (2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)),
        (2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)),
    )
    return np.stack([np.stack(row, -1) for row in rows], -2)


def matrices_to_quaternions(matrices: np.ndarray) -> np.ndarray:
    """Quaternions [...,4] float64, w >= 0, of rotation matrices [...,3,3]."""
    import torch

    from ..motion.rotations import matrix_to_quaternion

    return np.asarray(matrix_to_quaternion(torch.as_tensor(matrices.astype(np.float64))).numpy())
