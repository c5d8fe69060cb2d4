"""Moving skeletons: what readers hand over, and what BVH, GLB and USD files hold.

Rotations are given from the rest pose with the world's axes, whatever axes the joints of the file
have: a joint at rest has the identity. Files with axes of their own (GLB) keep them in `frames`.
Legend: T frames, N joints."""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Protocol, Self

import numpy as np

from ..errors import UsageError
from ..motion.motion import Motion
from ..motion.rotations import matrix_to_quaternion, quaternion_continuous, quaternion_to_matrix
from ..motion.skeleton import JOINT_INDEX, JOINT_NAMES, REST_PELVIS_HEIGHT, canonical_skeleton
from ..tensors import torch

ALL = slice(None)


class SourceClip(Protocol):
    """A recording as it stands in its file: its own joint names, axes and unit of length.

    At rest every joint's axes are parallel to the file's world axes, and `offsets` are the bones.

    Attributes:
        names: joint names, parents before children.
        parents: index of each joint's parent; -1 for a root.
        offsets: each joint's place in its parent's axes at rest [N,3].
        frame_time: seconds between two frames.
        num_frames: T.
    """

    @property
    def names(self) -> tuple[str, ...]: ...
    @property
    def parents(self) -> tuple[int, ...]: ...
    @property
    def offsets(self) -> np.ndarray: ...
    @property
    def frame_time(self) -> float: ...
    @property
    def num_frames(self) -> int: ...

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


def units(vectors: np.ndarray) -> np.ndarray:
    """Directions [...,3] of vectors, each of length one; of no vector 0."""
    return np.asarray(vectors / np.maximum(np.linalg.norm(vectors, axis=-1, keepdims=True), 1e-9))


def swing(rest: np.ndarray, seen: np.ndarray) -> np.ndarray:
    """Smallest rotations [T,3,3] that turn a direction [3] into others [T,3], all of length 1."""
    cross, cos = np.cross(rest, seen), seen @ rest
    k = np.zeros((len(seen), 3, 3))
    k[:, 0, 1], k[:, 0, 2], k[:, 1, 2] = -cross[:, 2], cross[:, 1], -cross[:, 0]
    k -= np.swapaxes(k, -1, -2)
    result = np.eye(3) + k + k @ k / np.maximum(1 + cos, 1e-9)[:, None, None]
    axis = units(np.cross(rest, np.eye(3)[np.argmin(np.abs(rest))]))
    half = 2 * np.outer(axis, axis) - np.eye(3)  # opposite: half a turn about any axis across
    return np.where((cos < -0.999999)[:, None, None], half, result)


def rest_positions(parents: Sequence[int], offsets: np.ndarray) -> np.ndarray:
    """Places of the joints at rest [N,3] float64, the root at its own offset; offsets [N,3]."""
    places = offsets.astype(np.float64)
    for joint, parent in enumerate(parents):
        if parent >= 0:
            places[joint] += places[parent]
    return places


# Trunk, then one side; {s} is the side: Left or Right (mixamo, unity), l or r (unreal).
_MIXAMO = {
    "pelvis": "Hips", "spine1": "Spine", "spine2": "Spine1", "spine3": "Spine2",
    "neck": "Neck", "head": "Head", "collar": "{s}Shoulder", "shoulder": "{s}Arm",
    "elbow": "{s}ForeArm", "wrist": "{s}Hand", "hip": "{s}UpLeg", "knee": "{s}Leg",
    "ankle": "{s}Foot", "foot": "{s}ToeBase",
}  # fmt: skip
_UNITY = {
    "pelvis": "Hips", "spine1": "Spine", "spine2": "Chest", "spine3": "UpperChest",
    "neck": "Neck", "head": "Head", "collar": "{s}Shoulder", "shoulder": "{s}UpperArm",
    "elbow": "{s}LowerArm", "wrist": "{s}Hand", "hip": "{s}UpperLeg", "knee": "{s}LowerLeg",
    "ankle": "{s}Foot", "foot": "{s}Toes",
}  # fmt: skip
_UNREAL = {
    "pelvis": "pelvis", "spine1": "spine_01", "spine2": "spine_02", "spine3": "spine_03",
    "neck": "neck_01", "head": "head", "collar": "clavicle_{s}", "shoulder": "upperarm_{s}",
    "elbow": "lowerarm_{s}", "wrist": "hand_{s}", "hip": "thigh_{s}", "knee": "calf_{s}",
    "ankle": "foot_{s}", "foot": "ball_{s}",
}  # fmt: skip


def _scheme(table: dict[str, str], left: str, right: str) -> tuple[str, ...]:
    """The table's names in our order of joints."""
    sides = {"l_": left, "r_": right}
    return tuple(
        table[name[2:]].format(s=sides[name[:2]]) if name[:2] in sides else table[name]
        for name in JOINT_NAMES
    )


SCHEMES: dict[str, tuple[str, ...]] = {
    "canonical": JOINT_NAMES,
    "mixamo": tuple(f"mixamorig:{name}" for name in _scheme(_MIXAMO, "Left", "Right")),
    "unity": _scheme(_UNITY, "Left", "Right"),
    "unreal": _scheme(_UNREAL, "l", "r"),
}


def joint_names(scheme: str) -> tuple[str, ...]:
    """The 22 names of a scheme, in our order of joints; raises UsageError where it is unknown."""
    try:
        return SCHEMES[scheme]
    except KeyError:
        known = ", ".join(SCHEMES)
        raise UsageError(f"{scheme!r} names no joints; choose from {known}") from None


# Tips of the chains, for formats that want an end to every bone: joint → offset in metres.
END_SITES: dict[int, tuple[float, float, float]] = {
    JOINT_INDEX["head"]: (0.0, 0.18, 0.0),
    JOINT_INDEX["l_wrist"]: (0.17, 0.0, 0.0),
    JOINT_INDEX["r_wrist"]: (-0.17, 0.0, 0.0),
    JOINT_INDEX["l_foot"]: (0.0, 0.0, 0.08),
    JOINT_INDEX["r_foot"]: (0.0, 0.0, 0.08),
}


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
        return rest_positions(self.parents, self.offsets)

    @cached_property
    def children(self) -> list[list[int]]:
        """Of each joint those whose parent it is."""
        joints = range(len(self.parents))
        return [[child for child in joints if self.parents[child] == joint] for joint in joints]

    def depth_first(self) -> list[int]:
        """Joints in the order of a hierarchy that is written out: each before what hangs on it."""
        order, stack = [], [0]
        while stack:
            order.append(stack.pop())
            stack += reversed(self.children[order[-1]])
        return order


@dataclass(frozen=True, eq=False)
class RigClip:
    """A rig in motion; what `SourceClip` promises, so any reader's user takes it.

    Attributes:
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
    """Our skeleton, its joints named as a tool likes (`rig.SCHEMES`)."""
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
    rotations, root = quaternions_to_matrices(motion.quaternions), motion.root_position
    return rooted_clip(canonical_rig(names), rotations, root, motion.fps, motion.text)


def rooted_clip(
    rig: Rig, rotations: np.ndarray, root: np.ndarray, fps: float, text: str = ""
) -> RigClip:
    """A rig whose joints turn [T,N,3,3] and of which the root alone travels [T,3]."""
    translations = np.repeat(rig.offsets[None], len(root), 0)
    translations[:, 0] = root
    return RigClip(rig, rotations, translations, fps, text)


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
    return np.asarray(quaternion_to_matrix(torch.as_tensor(quaternions.astype(np.float64))).numpy())


def matrices_to_quaternions(matrices: np.ndarray) -> np.ndarray:
    """Quaternions [...,4] float64, w >= 0, of rotation matrices [...,3,3]."""
    return np.asarray(matrix_to_quaternion(torch.as_tensor(matrices.astype(np.float64))).numpy())


def parent_frames(rig: Rig, frames: np.ndarray, base: np.ndarray | None = None) -> np.ndarray:
    """The axes [N,3,3] in which each joint's own pose is told: its parent's, at rest."""
    top = np.eye(3) if base is None else base[:3, :3] / np.linalg.norm(base[:3, :3], axis=0)
    return np.array([frames[parent] if parent >= 0 else top for parent in rig.parents])


def continuous(quaternions: np.ndarray) -> np.ndarray:
    """Unit quaternions [T,...,4] float64 with signs so that neighbouring frames are near.

    Some players mix neighbouring keys as they stand, and would turn the long way round.
    """
    unit = quaternions / np.linalg.norm(quaternions, axis=-1, keepdims=True)
    return np.asarray(quaternion_continuous(torch.as_tensor(unit)).numpy())
