"""Forward kinematics: local rotations and a root position to world joints, and back.

B batch, T frames, K joints; functions broadcast over every leading dimension.
"""

from collections.abc import Sequence

import torch
from torch import Tensor


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
