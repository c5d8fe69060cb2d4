"""Rotations as 6D, matrices and quaternions; chains of them; derivatives and means over time.

Pure tensor functions on the last dimension(s) that broadcast over the rest, carry gradients and
keep type and device. Quaternions are Hamilton, w x y z. 6D is the first two columns of the matrix,
column by column (Zhou et al. 2019, "On the Continuity of Rotation Representations", eq. 15).

Letters: T frames, K joints, C channels.
"""

from collections.abc import Sequence
from functools import cache

from ..tensors import F, Tensor, torch

_EPSILON = 1e-6


def rotation_6d_to_matrix(d6: Tensor) -> Tensor:
    """Gram–Schmidt [...,6] → [...,3,3] (Zhou et al. 2019, eq. 15).

    Always a rotation with finite gradients: a zero first column becomes the x axis, a second
    column parallel to the first gives way to the axis least aligned with it.
    """
    a1, a2 = d6[..., :3], d6[..., 3:]
    axes = torch.eye(3, dtype=d6.dtype, device=d6.device)
    a1 = torch.where(a1.norm(dim=-1, keepdim=True) > _EPSILON, a1, axes[0])
    b1 = F.normalize(a1, dim=-1, eps=_EPSILON)
    b2 = a2 - (b1 * a2).sum(-1, keepdim=True) * b1
    degenerate = b2.norm(dim=-1, keepdim=True) <= _EPSILON * (1 + a2.norm(dim=-1, keepdim=True))
    spare = axes[b1.abs().argmin(-1)]
    spare = spare - (b1 * spare).sum(-1, keepdim=True) * b1
    b2 = F.normalize(torch.where(degenerate, spare, b2), dim=-1, eps=_EPSILON)
    b3 = torch.linalg.cross(b1, b2)
    return torch.stack((b1, b2, b3), -1)


def matrix_to_rotation_6d(matrix: Tensor) -> Tensor:
    """[...,3,3] → [...,6]: the first two columns."""
    return matrix[..., :2].swapaxes(-1, -2).flatten(-2)


def matrix_to_quaternion(matrix: Tensor) -> Tensor:
    """[...,3,3] → unit quaternions [...,4], w ≥ 0.

    Of the four ways to extract a quaternion the one with the largest divisor is taken
    (Shepperd 1978), which is exact everywhere and has finite gradients.
    """
    m00, m11, m22 = matrix[..., 0, 0], matrix[..., 1, 1], matrix[..., 2, 2]
    squares = torch.stack(
        (1 + m00 + m11 + m22, 1 + m00 - m11 - m22, 1 - m00 + m11 - m22, 1 - m00 - m11 + m22), -1
    )  # 4·(w², x², y², z²)
    turned = matrix.swapaxes(-1, -2)
    gaps, sums = matrix - turned, matrix + turned
    yz, zx, xy = gaps[..., 2, 1], gaps[..., 0, 2], gaps[..., 1, 0]  # 4·(wx, wy, wz)
    sxy, szx, syz = sums[..., 1, 0], sums[..., 0, 2], sums[..., 2, 1]  # 4·(xy, zx, yz)
    s = squares
    rows = torch.stack(
        (
            torch.stack((s[..., 0], yz, zx, xy), -1),
            torch.stack((yz, s[..., 1], sxy, szx), -1),
            torch.stack((zx, sxy, s[..., 2], syz), -1),
            torch.stack((xy, szx, syz, s[..., 3]), -1),
        ),
        -2,
    )  # row i = 4·q_i·q
    best = squares.argmax(-1)[..., None, None].expand(*squares.shape[:-1], 1, 4)
    q = F.normalize(rows.gather(-2, best).squeeze(-2), dim=-1)
    return torch.where(q[..., :1] < 0, -q, q)


def quaternion_to_matrix(q: Tensor) -> Tensor:
    """Quaternions [...,4] of any length > 0 → [...,3,3]."""
    w, x, y, z = torch.moveaxis(F.normalize(q, dim=-1), -1, 0)
    rows = (
        torch.stack((1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)), -1),
        torch.stack((2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)), -1),
        torch.stack((2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)), -1),
    )
    return torch.stack(rows, -2)


def rotation_6d_to_quaternion(d6: Tensor) -> Tensor:
    """[...,6] → unit quaternions [...,4], w ≥ 0."""
    return matrix_to_quaternion(rotation_6d_to_matrix(d6))


def quaternion_multiply(a: Tensor, b: Tensor) -> Tensor:
    """Hamilton product [...,4] × [...,4]: first `b`, then `a`."""
    aw, ax, ay, az = torch.moveaxis(a, -1, 0)
    bw, bx, by, bz = torch.moveaxis(b, -1, 0)
    return torch.stack(
        (
            aw * bw - ax * bx - ay * by - az * bz,
            aw * bx + ax * bw + ay * bz - az * by,
            aw * by - ax * bz + ay * bw + az * bx,
            aw * bz + ax * by - ay * bx + az * bw,
        ),
        -1,
    )


def quaternion_conjugate(q: Tensor) -> Tensor:
    """The inverse of unit quaternions [...,4]."""
    return torch.cat((q[..., :1], -q[..., 1:]), -1)


def quaternion_continuous(q: Tensor, dim: int = 0) -> Tensor:
    """Signs chosen so that neighbours along `dim` lie in one hemisphere (SPEC ruling 10).

    The first element gets w ≥ 0, then continuity wins.
    """
    q = torch.moveaxis(q, dim, 0)
    turns = (q[1:] * q[:-1]).sum(-1, keepdim=True) < 0
    flips = torch.cat((q[:1, ..., :1] < 0, turns)).cumsum(0)  # ONNX has no product of this kind
    signs = (1 - 2 * (flips % 2)).to(q.dtype)
    return torch.moveaxis(q * signs, 0, dim)


def quaternion_log(q: Tensor) -> Tensor:
    """Unit quaternions [...,4] → rotation vectors [...,3] in radians, angle ≤ π."""
    q = torch.where(q[..., :1] < 0, -q, q)
    sine = q[..., 1:].norm(dim=-1, keepdim=True)
    angle = 2 * torch.atan2(sine, q[..., :1])
    return q[..., 1:] * torch.where(sine > _EPSILON, angle / sine.clip(min=_EPSILON), 2.0)


def quaternion_exp(vector: Tensor) -> Tensor:
    """Rotation vectors [...,3] in radians → unit quaternions [...,4]."""
    angle = vector.norm(dim=-1, keepdim=True)
    scale = torch.where(angle > _EPSILON, torch.sin(angle / 2) / angle.clip(min=_EPSILON), 0.5)
    return torch.cat((torch.cos(angle / 2), vector * scale), -1)


def quaternion_slerp(q0: Tensor, q1: Tensor, t: Tensor) -> Tensor:
    """Spherical interpolation on the short way; `t` [...,1] in [0, 1] (Shoemake 1985)."""
    delta = quaternion_log(quaternion_multiply(quaternion_conjugate(q0), q1))
    return quaternion_multiply(q0, quaternion_exp(t * delta))


def axis_angle_to_matrix(axis: int, angle: Tensor) -> Tensor:
    """Rotation by `angle` [...] radians about coordinate axis 0, 1 or 2 → [...,3,3]."""
    c, s = torch.cos(angle), torch.sin(angle)
    one, zero = torch.ones_like(c), torch.zeros_like(c)
    rows = (
        ((one, zero, zero), (zero, c, -s), (zero, s, c)),
        ((c, zero, s), (zero, one, zero), (-s, zero, c)),
        ((c, -s, zero), (s, c, zero), (zero, zero, one)),
    )[axis]
    return torch.stack([torch.stack(row, -1) for row in rows], -2)


def yaw_to_matrix(angle: Tensor) -> Tensor:
    """Rotation about +Y by `angle` [...] radians; positive turns left."""
    return axis_angle_to_matrix(1, angle)


def axis_turn(axis: Tensor, angle: Tensor) -> Tensor:
    """Rotation [...,3,3] about unit axes [...,3] by angles [...] radians."""
    return quaternion_to_matrix(quaternion_exp(axis * angle[..., None]))


def shortest_turn(source: Tensor, target: Tensor) -> Tensor:
    """The smallest rotation [...,3,3] that takes one direction [...,3] to another."""
    source, target = F.normalize(source, dim=-1), F.normalize(target, dim=-1)
    axis = torch.linalg.cross(source, target)
    angle = torch.atan2(axis.norm(dim=-1), (source * target).sum(-1))
    return axis_turn(F.normalize(axis, dim=-1), angle)


def heading_angle(matrix: Tensor) -> Tensor:
    """Heading [...] in radians: the twist of [...,3,3] about +Y (SPEC ruling 19)."""
    return heading_of(matrix_to_quaternion(matrix))


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
    x, y, z = torch.moveaxis(vectors, -1, 0)
    return torch.stack((cosine * x + sine * z, y, cosine * z - sine * x), -1)


# ---------------------------------------------------------------- chains


@cache
def _levels(parents: tuple[int, ...]) -> list[list[int]]:
    """Joints by depth, so that each level is one batched matrix product."""
    depth = [0] * len(parents)
    for joint, parent in enumerate(parents):
        depth[joint] = 0 if parent < 0 else depth[parent] + 1
    return [[j for j, d in enumerate(depth) if d == level] for level in range(max(depth) + 1)]


def local_to_global(local: Tensor, parents: Sequence[int]) -> Tensor:
    """Local rotations [...,K,3,3] → world rotations [...,K,3,3]."""
    own = local.unbind(-3)  # its gradient is one tensor, that of each index would be as large
    world: list[Tensor] = [own[0]] * len(parents)
    for level in _levels(tuple(parents))[1:]:
        above = torch.stack([world[parents[j]] for j in level], -3)
        product = above @ torch.stack([own[j] for j in level], -3)
        for joint, turned in zip(level, product.unbind(-3), strict=True):
            world[joint] = turned
    return torch.stack(world, -3)


def _parents_of(world: Tensor, parents: Sequence[int]) -> Tensor:
    """Of every joint but the root what stands at its parent: [...,K,3,3] → [...,K-1,3,3].

    Here as above joints are stacked: an index would have to be sent to a GPU, which waits for it.
    """
    joints = world.unbind(-3)
    return torch.stack([joints[parent] for parent in parents[1:]], -3)


def global_to_local(world: Tensor, parents: Sequence[int]) -> Tensor:
    """World rotations [...,K,3,3] → local rotations [...,K,3,3]."""
    above = _parents_of(world, parents)
    local = above.swapaxes(-1, -2) @ world[..., 1:, :, :]
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
    above = _parents_of(world, parents)
    bones = (above @ offsets[1:, :, None].to(world)).squeeze(-1).unbind(-2)  # K-1 of [...,3]
    positions: list[Tensor] = [root_position] * len(parents)
    for joint in range(1, len(parents)):
        positions[joint] = positions[parents[joint]] + bones[joint - 1]
    return torch.stack(positions, -2), world


# ---------------------------------------------------------------- over time


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
    """Velocity m/s, acceleration m/s² and angular velocity rad/s, each [...,T,3], of positions
    [...,T,3] in metres and unit quaternions [...,T,4].

    The last two accelerations of a sequence are zero because its last velocity repeats: derive
    with two spare frames and crop where that matters (ruling 6).
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
    reach = torch.arange(1, half + 1, device=values.device).clip(max=last)
    head = 2 * values[..., :1, :] - values[..., reach.flip(0), :]
    tail = 2 * values[..., -1:, :] - values[..., last - reach, :]
    padded = torch.cat((head, values, tail), -2)
    return padded.unfold(-2, len(weights), 1) @ weights


def gaussian_smooth(series: Tensor, deviation: float) -> Tensor:
    """[B, T, K, C] convolved over time with a Gaussian of that many frames; the ends repeat."""
    reach = round(3 * deviation)
    kernel = torch.exp(
        -0.5 * (torch.arange(-reach, reach + 1, device=series.device) / deviation) ** 2
    )
    rows = series.flatten(2).swapaxes(1, 2)  # B K*C T
    padded = F.pad(rows, (reach, reach), mode="replicate")
    smooth = F.conv1d(padded.flatten(0, 1)[:, None], (kernel / kernel.sum())[None, None])
    return smooth.view(rows.shape).swapaxes(1, 2).view_as(series)
