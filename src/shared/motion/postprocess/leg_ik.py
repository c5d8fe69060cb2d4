"""Two-bone inverse kinematics of a leg, and the heel that rises where the leg is too short.

Letters: any leading dimensions `...`, mostly frames.
"""

import torch
from torch import Tensor
from torch.nn import functional as F

from ..rotations import quaternion_exp, quaternion_to_matrix
from ..skeleton import LEG_LENGTH

MAX_STRETCH = 0.995  # of the leg's length; beyond it a leg is only as long as it already was
RISE_AT = 0.97  # of the leg's length, from which on the heel rises instead
MAX_RISE = 0.8  # radians that a foot turns about its ball
STRAIGHT, BENT = 0.02, 0.1  # sine between which the knee's own plane takes over from the hinge


def longest_reach(length: Tensor) -> Tensor:
    """How far an ankle may be from its hip [...] with its heel down, `length` [...] away now."""
    return length.clamp_min(RISE_AT * LEG_LENGTH)


def heel_rise(hip: Tensor, ball: Tensor, lever: Tensor, longest: Tensor) -> Tensor:
    """The smallest rotation [...,3,3] of a foot about its ball that lets the leg reach.

    The law of cosines in the triangle of hip, ball and ankle; the identity where the leg is long
    enough, and never more than `MAX_RISE`.

    Args:
        hip: world positions [...,3], metres.
        ball: where the ball of the foot is to be [...,3].
        lever: ankle seen from the ball [...,3], world.
        longest: of hip and ankle [...].
    """
    up = hip - ball
    arm, distance = lever.norm(dim=-1), up.norm(dim=-1)
    cosine = (arm**2 + distance**2 - longest**2) / (2 * arm * distance)
    axis = torch.linalg.cross(lever, up)
    angle = torch.atan2(axis.norm(dim=-1), (lever * up).sum(-1))
    excess = (angle - torch.acos(cosine.clamp(-1, 1))).clamp(0, MAX_RISE)
    return turn(F.normalize(axis, dim=-1), excess)


def two_bone_ik(
    hip: Tensor, thigh: Tensor, shin: Tensor, upper: Tensor, lower: Tensor, target: Tensor
) -> tuple[Tensor, Tensor]:
    """World rotations [...,3,3] of thigh and shin that bring the ankle to its target.

    The knee bends or opens in its own plane, then the whole leg swings the shortest way, so the
    knee keeps its direction. A straight leg bends about its hinge, forward.

    Args:
        hip: world positions [...,3], metres.
        thigh: world rotations [...,3,3] before.
        shin: world rotations [...,3,3] before.
        upper: rest offset of the knee from the hip [3], metres.
        lower: rest offset of the ankle from the knee [3], metres.
        target: wanted world positions of the ankle [...,3]; nearer if out of reach.
    """
    length_upper, length_lower = upper.norm(), lower.norm()
    before = (thigh @ upper + shin @ lower).norm(dim=-1)
    longest = before.clamp_min(MAX_STRETCH * LEG_LENGTH)
    shortest = 1.05 * (length_upper - length_lower).abs() + 0.05
    wanted = (target - hip).norm(dim=-1)
    reach = wanted.minimum(longest).maximum(before.minimum(shortest))
    for _ in range(2):  # the hinge is not quite square to a nearly straight leg: once more
        to_knee, shank = thigh @ upper, shin @ lower
        to_ankle = to_knee + shank
        axis = _knee_axis(to_ankle, to_knee, thigh)
        length = to_ankle.norm(dim=-1)
        at_hip = _corner(length_upper, reach, length_lower) - _corner(
            length_upper, length, length_lower
        )
        at_knee = _corner(length_upper, length_lower, reach) - _corner(
            length_upper, length_lower, length
        )
        thigh, shin = turn(axis, at_hip) @ thigh, turn(axis, at_hip + at_knee) @ shin
        swing = _shortest_turn(thigh @ upper + shin @ lower, target - hip)
        thigh, shin = swing @ thigh, swing @ shin
    return thigh, shin


def turn(axis: Tensor, angle: Tensor) -> Tensor:
    """Rotation [...,3,3] about unit axes [...,3] by angles [...]."""
    return quaternion_to_matrix(quaternion_exp(axis * angle[..., None]))


def _corner(a: Tensor, b: Tensor, opposite: Tensor) -> Tensor:
    """Angle between sides a and b of a triangle, radians (law of cosines)."""
    return torch.acos(((a**2 + b**2 - opposite**2) / (2 * a * b)).clamp(-1, 1))


def _knee_axis(to_ankle: Tensor, to_knee: Tensor, thigh: Tensor) -> Tensor:
    """Unit axis [...,3] that turns the hip–ankle line towards the knee.

    The normal of the leg's plane, and for a straight leg, which has none, the thigh's hinge: the
    knee bends towards +Z, that is about -X of the thigh.
    """
    normal = torch.linalg.cross(to_ankle, to_knee)
    sine = normal.norm(dim=-1, keepdim=True) / (
        to_ankle.norm(dim=-1, keepdim=True) * to_knee.norm(dim=-1, keepdim=True)
    ).clamp_min(1e-9)
    own = ((sine - STRAIGHT) / (BENT - STRAIGHT)).clamp(0, 1)
    along = F.normalize(to_ankle, dim=-1)
    hinge = -thigh[..., :, 0]
    hinge = hinge - (hinge * along).sum(-1, keepdim=True) * along
    blend = own * F.normalize(normal, dim=-1) + (1 - own) * F.normalize(hinge, dim=-1)
    return F.normalize(blend, dim=-1)


def _shortest_turn(source: Tensor, target: Tensor) -> Tensor:
    """The smallest rotation [...,3,3] that takes one direction [...,3] to another."""
    source, target = F.normalize(source, dim=-1), F.normalize(target, dim=-1)
    axis = torch.linalg.cross(source, target)
    angle = torch.atan2(axis.norm(dim=-1), (source * target).sum(-1))
    return turn(F.normalize(axis, dim=-1), angle)
