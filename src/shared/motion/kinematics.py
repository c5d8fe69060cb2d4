"""Forward kinematics, from local rotations to world joints and back, and derivatives over time.

T frames, K joints, C channels; functions broadcast over every leading dimension, carry gradients
and keep type and device.
"""

from collections.abc import Sequence

import torch
from torch import Tensor

from .rotations import quaternion_conjugate, quaternion_log, quaternion_multiply


def _levels(parents: Sequence[int]) -> list[list[int]]:
    """Joints by depth, so that each level is one batched matrix product."""
    depth = [0] * len(parents)
    for joint, parent in enumerate(parents):
        depth[joint] = 0 if parent < 0 else depth[parent] + 1
    return [[j for j, d in enumerate(depth) if d == level] for level in range(max(depth) + 1)]


def local_to_global(local: Tensor, parents: Sequence[int]) -> Tensor:
    """Local rotations [...,K,3,3] → world rotations [...,K,3,3]."""
    world: list[Tensor] = [local[..., 0, :, :]] * len(parents)
    for level in _levels(parents)[1:]:
        above = torch.stack([world[parents[j]] for j in level], -3)
        product = above @ local[..., level, :, :]
        for index, joint in enumerate(level):
            world[joint] = product[..., index, :, :]
    return torch.stack(world, -3)


def global_to_local(world: Tensor, parents: Sequence[int]) -> Tensor:
    """World rotations [...,K,3,3] → local rotations [...,K,3,3]."""
    above = world[..., list(parents[1:]), :, :]
    local = above.transpose(-1, -2) @ world[..., 1:, :, :]
    return torch.cat((world[..., :1, :, :], local), -3)


def forward_kinematics(
    local: Tensor, root_position: Tensor, offsets: Tensor, parents: Sequence[int]
) -> tuple[Tensor, Tensor]:
    """World positions [...,K,3] in metres and world rotations [...,K,3,3].

    Args:
        local: local rotations [...,K,3,3]; joint 0 is the root's world orientation.
        root_position: world position of the root [...,3], metres.
        offsets: rest offsets from the parent [K,3], metres.
        parents: index of each joint's parent, -1 for the root; parents come first.
    """
    world = local_to_global(local, parents)
    above = world[..., list(parents[1:]), :, :]
    bones = (above @ offsets[1:, :, None].to(world)).squeeze(-1)  # [...,K-1,3]
    positions: list[Tensor] = [root_position] * len(parents)
    for joint in range(1, len(parents)):
        positions[joint] = positions[parents[joint]] + bones[..., joint - 1, :]
    return torch.stack(positions, -2), world


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
