"""The body that stands in for a trajectory: a mannequin whose pelvis follows it exactly.

A trajectory tells of the pelvis alone. So that its height and turning can be seen, the rest is
posed by one rule: arms hang, trunk and head go with the pelvis, the legs stay upright and bend
until the feet reach the floor. Legend: T frames.
"""

from dataclasses import replace

import numpy as np
from scipy.spatial.transform import Rotation

from ..motion.motion import Motion
from ..motion.skeleton import JOINT_INDEX, LEG_LENGTH, canonical_skeleton
from ..motion.trajectory import MotionTrajectory, to_motion

ANKLE_HEIGHT = 0.08  # metres, in the rest pose
MIN_REACH = 0.3  # share of the leg's length that a folded leg keeps
MAX_LEAN = np.deg2rad(60.0)  # legs are kept upright against so much leaning, no more
ARMS = {  # degrees about the axis from the T-pose, left side; the right one is mirrored
    "shoulder": ("z", -72.0),
    "elbow": ("y", -22.0),
}


def stand_in(trajectory: MotionTrajectory, title: str = "") -> Motion:
    """The mannequin's motion: joint 0 is the trajectory's position and quaternion.

    Contacts are zero: a trajectory has no feet.
    """
    motion = to_motion(trajectory, text=title)
    quaternions = motion.quaternions.copy()
    for name, (axis, angle) in ARMS.items():
        for side, sign in (("l", 1.0), ("r", -1.0)):
            turn = Rotation.from_euler(axis, sign * angle, degrees=True)
            quaternions[:, JOINT_INDEX[f"{side}_{name}"]] = _wxyz(turn)
    pelvis = Rotation.from_quat(quaternions[:, 0][:, [1, 2, 3, 0]])
    upright = _upright(pelvis)
    for side in ("l", "r"):
        hip, knee, ankle = (JOINT_INDEX[f"{side}_{part}"] for part in ("hip", "knee", "ankle"))
        height = trajectory.position[:, 1] + pelvis.apply(canonical_skeleton().offsets[hip])[:, 1]
        bend = np.arccos(np.clip((height - ANKLE_HEIGHT) / LEG_LENGTH, MIN_REACH, 1.0))
        quaternions[:, hip] = _wxyz(upright * _pitch(-bend))
        quaternions[:, knee] = _wxyz(_pitch(2 * bend))
        quaternions[:, ankle] = _wxyz(_pitch(-bend))
    return replace(motion, quaternions=quaternions)


def _upright(pelvis: Rotation) -> Rotation:
    """Rotations [T] in the pelvis' frame that take its lean back, up to `MAX_LEAN`."""
    up = pelvis.inv().apply(np.array([0.0, 1.0, 0.0]))  # world's up, in the pelvis' frame
    axis = np.stack((up[:, 2], np.zeros(len(up)), -up[:, 0]), -1)  # +Y × up
    sine = np.linalg.norm(axis, axis=-1, keepdims=True)
    angle = np.arctan2(sine, up[:, 1:2])
    return Rotation.from_rotvec(axis / np.maximum(sine, 1e-9) * np.minimum(angle, MAX_LEAN))


def _pitch(angle: np.ndarray) -> Rotation:
    """Turns [T] about +X."""
    return Rotation.from_rotvec(angle[:, None] * np.array([1.0, 0.0, 0.0]))


def _wxyz(rotation: Rotation) -> np.ndarray:
    return np.asarray(rotation.as_quat()[..., [3, 0, 1, 2]], dtype=np.float32)
