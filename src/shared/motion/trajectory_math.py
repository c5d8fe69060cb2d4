"""Derivatives, headings and phase of a path: the mathematics under the 25-d trajectory.

Torch functions carry gradients and keep type and device; NumPy functions serve the borders.
Letters: T frames, C channels; the rest are leading dimensions.
"""

import numpy as np
import torch
from torch import Tensor

from .rotations import (
    quaternion_conjugate,
    quaternion_continuous,
    quaternion_log,
    quaternion_multiply,
)


def forward_difference(values: Tensor, fps: float) -> Tensor:
    """Rate of change [...,T,C] → [...,T,C] a second; the last value repeats (ruling 6).

    One frame alone does not move: zeros.
    """
    steps = (values[..., 1:, :] - values[..., :-1, :]) * fps
    last = steps[..., -1:, :] if values.shape[-2] > 1 else torch.zeros_like(values)
    return torch.cat((steps, last), -2)


def angular_velocity(quaternions: Tensor, fps: float) -> Tensor:
    """World-frame angular velocity [...,T,3] in rad/s of unit quaternions [...,T,4] (ruling 5).

    The log of the turn from each frame to the next, signs of no matter; the last value repeats.
    """
    if quaternions.shape[-2] == 1:
        return torch.zeros_like(quaternions[..., 1:])
    before, after = quaternions[..., :-1, :], quaternions[..., 1:, :]
    turn = quaternion_log(quaternion_multiply(after, quaternion_conjugate(before))) * fps
    return torch.cat((turn, turn[..., -1:, :]), -2)


def derive(position: Tensor, quaternions: Tensor, fps: float) -> tuple[Tensor, Tensor, Tensor]:
    """Velocity m/s, acceleration m/s² and angular velocity rad/s, each [...,T,3].

    The last two accelerations of a sequence are zero because its last velocity repeats: derive
    with two spare frames and crop where that matters (ruling 6).

    Args:
        position: metres [...,T,3].
        quaternions: unit, w x y z [...,T,4].
        fps: frames per second.
    """
    velocity = forward_difference(position, fps)
    return velocity, forward_difference(velocity, fps), angular_velocity(quaternions, fps)


def continuous_sign(quaternions: Tensor) -> Tensor:
    """[...,T,4] with w ≥ 0 in the first frame, then neighbours in one hemisphere (ruling 10)."""
    return quaternion_continuous(quaternions, dim=-2)


def heading_of(quaternions: Tensor) -> Tensor:
    """Heading [...] in radians, in (-2π, 2π]: the twist of [...,4] about +Y (ruling 19)."""
    return 2 * torch.atan2(quaternions[..., 2], quaternions[..., 0])


def yaw_quaternion(angle: Tensor) -> Tensor:
    """Turns about +Y by [...] radians as quaternions [...,4]; positive turns left."""
    zero = torch.zeros_like(angle)
    return torch.stack((torch.cos(angle / 2), zero, torch.sin(angle / 2), zero), -1)


def turn_about_y(vectors: Tensor, angle: Tensor | float) -> Tensor:
    """Vectors [...,3] turned about +Y by `angle` radians, a number or a tensor over [...]."""
    angle = torch.as_tensor(angle, dtype=vectors.dtype, device=vectors.device)
    sine, cosine = torch.sin(angle), torch.cos(angle)
    x, y, z = vectors.unbind(-1)
    return torch.stack((cosine * x + sine * z, y, cosine * z - sine * x), -1)


def unwrap_phase(phase: np.ndarray) -> np.ndarray:
    """Phase modulo 1 [...,T] → bars that grow on without a jump, float64 [...,T] (ruling 9).

    Right as long as the phase moves by less than half a bar a frame, 900 bars a minute.
    """
    return np.unwrap(np.asarray(phase, dtype=np.float64), period=1.0, axis=-1)


def wrap_phase(unwrapped: np.ndarray) -> np.ndarray:
    """Bars [...,T] → phase in [0, 1) as float32; 0 is the downbeat."""
    wrapped = np.mod(np.asarray(unwrapped, dtype=np.float64), 1.0).astype(np.float32)
    return np.where(wrapped >= 1, np.float32(0), wrapped)  # 0.99999999 rounds up in float32


def smooth(values: Tensor, weights: Tensor) -> Tensor:
    """Weighted moving average [...,T,C] → [...,T,C]; straight lines stay straight to their ends.

    The ends are continued by point reflection.

    Args:
        values: T ≥ 1 frames.
        weights: [W], W odd, sum 1.
    """
    half, last = len(weights) // 2, values.shape[-2] - 1
    reach = torch.arange(1, half + 1, device=values.device).clamp(max=last)
    head = 2 * values[..., :1, :] - values[..., reach.flip(0), :]
    tail = 2 * values[..., -1:, :] - values[..., last - reach, :]
    padded = torch.cat((head, values, tail), -2)
    return padded.unfold(-2, len(weights), 1) @ weights
