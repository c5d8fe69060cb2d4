"""How somebody carries what they do: bent trunk, bowed head, bent knees, small or wide arms.

What is danced stays what it is; who dances it changes. Runs on the CPU in float64.

Letters: T frames.
"""

from dataclasses import dataclass

import numpy as np
from scipy.ndimage import gaussian_filter1d

from ..tensors import Tensor, torch
from .features import HEIGHT, ROOT_ROW, heading_joints
from .rotations import (
    axis_angle_to_matrix,
    matrix_to_quaternion,
    matrix_to_rotation_6d,
    quaternion_slerp,
    quaternion_to_matrix,
    rotation_6d_to_matrix,
)
from .skeleton import JOINT_INDEX, LIMBS, NUM_JOINTS

FAR = 2.6  # radians from what an arm does on average, beyond which it is left alone
SETTLE = 0.1  # seconds, standard deviation, over which the pelvis follows bent knees
FOLDED = 100.0  # degrees of a knee that bends no more
ARMS = [JOINT_INDEX[name] for side in ("left-arm", "right-arm") for name in LIMBS[side]]


@dataclass(frozen=True)
class Manner:
    """What is added to every pose, degrees, and what arms keep of their movement.

    Attributes:
        stoop: that the trunk is bent forward.
        bow: that neck and head are, further.
        knees: that legs which stand straight are bent, each hip by this, each knee by twice that;
            the more one is bent already, the less.
        arms: share of their movement around what they do on average; 1 = all of it.
    """

    stoop: float = 0.0
    bow: float = 0.0
    knees: float = 0.0
    arms: float = 1.0

    def __and__(self, other: "Manner") -> "Manner":
        """Both at once."""
        return Manner(
            self.stoop + other.stoop,
            self.bow + other.bow,
            self.knees + other.knees,
            self.arms * other.arms,
        )


PLAIN = Manner()


def carried(features: Tensor, manner: Manner, fps: float) -> Tensor:
    """Raw features [T,23,6] of the same movement in a manner; feet stay as high as they were.

    Args:
        features: see `encode_features`.
        manner: which.
        fps: frames a second.
    """
    if manner == PLAIN:
        return features
    result = features.clone()
    rotations = rotation_6d_to_matrix(features[:, :NUM_JOINTS].double())
    low = _lowest(rotations, features)
    if manner.arms != 1.0:
        mean = matrix_to_quaternion(rotation_6d_to_matrix(features[:, ARMS].double().mean(0)))
        own = matrix_to_quaternion(rotations[:, ARMS])
        apart = 2 * torch.acos(((mean * own).sum(-1, keepdim=True)).abs().clamp(0, 1))
        near = ((FAR - apart) / (FAR / 2)).clamp(0, 1)  # there are two ways to the far side
        share = 1 + (manner.arms - 1) * near
        rotations[:, ARMS] = quaternion_to_matrix(quaternion_slerp(mean, own, share))
    for names, degrees in (
        (("spine1", "spine2", "spine3"), manner.stoop / 3),
        (("neck", "head"), manner.bow / 2),
    ):
        for name in names:
            rotations[:, JOINT_INDEX[name]] = (
                _forward(torch.tensor(degrees)) @ rotations[:, JOINT_INDEX[name]]
            )
    for side in "lr":
        hip, knee, ankle = (JOINT_INDEX[f"{side}_{name}"] for name in ("hip", "knee", "ankle"))
        trace = rotations[:, knee, 0, 0] + rotations[:, knee, 1, 1] + rotations[:, knee, 2, 2]
        bent = torch.acos(((trace - 1) / 2).clamp(-1, 1)) * (180 / np.pi)
        more = manner.knees * (1 - bent / FOLDED).clamp(0, 1)
        rotations[:, hip] = rotations[:, hip] @ _forward(-more)
        rotations[:, knee] = rotations[:, knee] @ _forward(2 * more)
        rotations[:, ankle] = _forward(-more) @ rotations[:, ankle]
    result[:, :NUM_JOINTS] = matrix_to_rotation_6d(rotations).float()
    sinks = gaussian_filter1d(_lowest(rotations, features) - low, SETTLE * fps, mode="nearest")
    result[:, ROOT_ROW, HEIGHT] -= torch.from_numpy(sinks).float()
    return result


def _forward(degrees: Tensor) -> Tensor:
    """Turns [...,3,3] that tilt what is up forward by degrees [...]."""
    return axis_angle_to_matrix(0, degrees.double() * (np.pi / 180))


def _lowest(rotations: Tensor, features: Tensor) -> np.ndarray:
    """Height of the lowest joint [T]."""
    height = features[:, ROOT_ROW, HEIGHT].double()
    return np.asarray(heading_joints(rotations, height)[..., 1].min(1).values.numpy())
