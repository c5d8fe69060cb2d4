"""Rotations as 6D, matrices and quaternions; pure tensor functions.

All functions work on the last dimension(s) and broadcast over the rest. Quaternions are
Hamilton, w x y z. 6D is the first two columns of the matrix, column by column
(Zhou et al. 2019, "On the Continuity of Rotation Representations", eq. 15).
"""

import torch
from torch import Tensor
from torch.nn import functional as F

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
    return torch.stack((b1, b2, b3), dim=-1)


def matrix_to_rotation_6d(matrix: Tensor) -> Tensor:
    """[...,3,3] → [...,6]: the first two columns."""
    return matrix[..., :2].transpose(-1, -2).flatten(-2)


def matrix_to_quaternion(matrix: Tensor) -> Tensor:
    """[...,3,3] → unit quaternions [...,4], w ≥ 0.

    Of the four ways to extract a quaternion the one with the largest divisor is taken
    (Shepperd 1978), which is exact everywhere and has finite gradients.
    """
    m00, m11, m22 = matrix[..., 0, 0], matrix[..., 1, 1], matrix[..., 2, 2]
    squares = torch.stack(
        (1 + m00 + m11 + m22, 1 + m00 - m11 - m22, 1 - m00 + m11 - m22, 1 - m00 - m11 + m22), -1
    )  # 4·(w², x², y², z²)
    yz, zx, xy = (
        matrix[..., 2, 1] - matrix[..., 1, 2],
        matrix[..., 0, 2] - matrix[..., 2, 0],
        matrix[..., 1, 0] - matrix[..., 0, 1],
    )  # 4·(wx, wy, wz)
    sxy, szx, syz = (
        matrix[..., 1, 0] + matrix[..., 0, 1],
        matrix[..., 0, 2] + matrix[..., 2, 0],
        matrix[..., 2, 1] + matrix[..., 1, 2],
    )  # 4·(xy, zx, yz)
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
    w, x, y, z = F.normalize(q, dim=-1).unbind(-1)
    rows = (
        (1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)),
        (2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)),
        (2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)),
    )
    return torch.stack([torch.stack(row, -1) for row in rows], -2)


def rotation_6d_to_quaternion(d6: Tensor) -> Tensor:
    """[...,6] → unit quaternions [...,4], w ≥ 0."""
    return matrix_to_quaternion(rotation_6d_to_matrix(d6))


def quaternion_multiply(a: Tensor, b: Tensor) -> Tensor:
    """Hamilton product [...,4] × [...,4]: first `b`, then `a`."""
    aw, ax, ay, az = a.unbind(-1)
    bw, bx, by, bz = b.unbind(-1)
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
    q = q.movedim(dim, 0)
    turns = (q[1:] * q[:-1]).sum(-1, keepdim=True) < 0
    flips = torch.cat((q[:1, ..., :1] < 0, turns)).cumsum(0)  # ONNX has no product of this kind
    signs = (1 - 2 * (flips % 2)).to(q.dtype)
    return (q * signs).movedim(0, dim)


def quaternion_log(q: Tensor) -> Tensor:
    """Unit quaternions [...,4] → rotation vectors [...,3] in radians, angle ≤ π."""
    q = torch.where(q[..., :1] < 0, -q, q)
    sine = q[..., 1:].norm(dim=-1, keepdim=True)
    angle = 2 * torch.atan2(sine, q[..., :1])
    return q[..., 1:] * torch.where(sine > _EPSILON, angle / sine.clamp_min(_EPSILON), 2.0)


def quaternion_exp(vector: Tensor) -> Tensor:
    """Rotation vectors [...,3] in radians → unit quaternions [...,4]."""
    angle = vector.norm(dim=-1, keepdim=True)
    scale = torch.where(angle > _EPSILON, torch.sin(angle / 2) / angle.clamp_min(_EPSILON), 0.5)
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


def heading_angle(matrix: Tensor) -> Tensor:
    """Heading [...] in radians: the twist of [...,3,3] about +Y (SPEC ruling 19)."""
    q = matrix_to_quaternion(matrix)
    return 2 * torch.atan2(q[..., 2], q[..., 0])


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
