"""The 22-joint skeleton every motion lives on: SMPL order, T-pose, metres."""

from dataclasses import dataclass
from functools import cache

import numpy as np

JOINT_NAMES: tuple[str, ...] = (
    "pelvis", "l_hip", "r_hip", "spine1", "l_knee", "r_knee", "spine2", "l_ankle", "r_ankle",
    "spine3", "l_foot", "r_foot", "neck", "l_collar", "r_collar", "head",
    "l_shoulder", "r_shoulder", "l_elbow", "r_elbow", "l_wrist", "r_wrist",
)  # fmt: skip
PARENTS: tuple[int, ...] = (
    -1, 0, 0, 0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 9, 9, 12, 13, 14, 16, 17, 18, 19,
)  # fmt: skip
NUM_JOINTS = len(JOINT_NAMES)
JOINT_INDEX: dict[str, int] = {name: index for index, name in enumerate(JOINT_NAMES)}
# Position of the joint that a mirrored body has in each joint's place.
MIRROR: tuple[int, ...] = tuple(
    JOINT_INDEX[{"l": "r", "r": "l"}[name[0]] + name[1:]] if name[1] == "_" else index
    for index, name in enumerate(JOINT_NAMES)
)
FOOT_JOINTS: tuple[tuple[int, int], ...] = (
    (JOINT_INDEX["l_ankle"], JOINT_INDEX["l_foot"]),
    (JOINT_INDEX["r_ankle"], JOINT_INDEX["r_foot"]),
)
LIMBS: dict[str, tuple[str, ...]] = {
    "left-arm": ("l_collar", "l_shoulder", "l_elbow", "l_wrist"),
    "right-arm": ("r_collar", "r_shoulder", "r_elbow", "r_wrist"),
    "left-leg": ("l_hip", "l_knee", "l_ankle", "l_foot"),
    "right-leg": ("r_hip", "r_knee", "r_ankle", "r_foot"),
    "trunk": ("spine1", "spine2", "spine3", "neck", "head"),
}  # all joints but the pelvis

# Offsets from the parent in the T-pose, left half; the right half is its mirror image.
# Proportions of an adult of about 1.70 m; every bone lies along one axis where it can, so that
# aiming a bone is one rotation and nothing else.
_OFFSETS: dict[str, tuple[float, float, float]] = {
    "pelvis": (0.0, 0.0, 0.0),
    "l_hip": (0.09, -0.07, 0.0),
    "l_knee": (0.0, -0.40, 0.0),
    "l_ankle": (0.0, -0.40, 0.0),
    "l_foot": (0.0, -0.06, 0.13),
    "spine1": (0.0, 0.11, 0.0),
    "spine2": (0.0, 0.13, 0.0),
    "spine3": (0.0, 0.06, 0.0),
    "neck": (0.0, 0.22, 0.0),
    "head": (0.0, 0.10, 0.0),
    "l_collar": (0.08, 0.12, 0.0),
    "l_shoulder": (0.10, 0.03, 0.0),
    "l_elbow": (0.26, 0.0, 0.0),
    "l_wrist": (0.25, 0.0, 0.0),
}
REST_FOOT_HEIGHT = 0.02  # metres: ball of the foot above the floor in the rest pose
REST_PELVIS_HEIGHT = REST_FOOT_HEIGHT - sum(
    _OFFSETS[name][1] for name in ("l_hip", "l_knee", "l_ankle", "l_foot")
)
LEG_LENGTH = -_OFFSETS["l_knee"][1] - _OFFSETS["l_ankle"][1]  # metres, hip to ankle


@dataclass(frozen=True)
class Skeleton:
    """A tree of joints: `offsets` [K,3] float32 in metres from each joint's parent at rest."""

    names: tuple[str, ...]
    parents: tuple[int, ...]
    offsets: np.ndarray


@cache
def canonical_skeleton() -> Skeleton:
    """The one rest skeleton of all data (SPEC, Conventions): T-pose, facing +Z, left is +X."""
    offsets = np.zeros((NUM_JOINTS, 3), dtype=np.float32)
    for index, name in enumerate(JOINT_NAMES):
        if name in _OFFSETS:
            offsets[index] = _OFFSETS[name]
        else:
            offsets[index] = np.multiply(_OFFSETS["l" + name[1:]], (-1.0, 1.0, 1.0))
    return Skeleton(JOINT_NAMES, PARENTS, offsets)
