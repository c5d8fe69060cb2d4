"""Footskate clean-up: feet that touch the ground stay where they are, by inverse kinematics.

While a foot stands its ball is planted over one point of the floor, and not below it; the leg above
follows (`contacts.py` says when, where and how far). The foot keeps its world rotation, and the
knee its direction. Where a leg is too short for its plant the heel rises about the ball, with the
toes flat, before the foot gives way. Runs on the CPU in float64.

Letters: T frames, J joints, `...` any leading dimensions, mostly frames.
"""

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from ...tensors import F, Tensor, torch
from ..filters import frames_away, smoothed
from ..motion import Motion
from ..rotations import (
    axis_turn,
    forward_kinematics,
    matrix_to_quaternion,
    quaternion_continuous,
    quaternion_slerp,
    quaternion_to_matrix,
    shortest_turn,
)
from ..skeleton import JOINT_INDEX, LEG_LENGTH, LIMBS, PARENTS, canonical_skeleton
from .contacts import foot_shifts

MIN_CORRECTION = 1e-4  # metres; frames that need less stay exactly as they are
FIRST, LAST = 1.5 / 30, 0.5 / 30  # seconds, standard deviations of the two smoothings of legs
LEGS = [[JOINT_INDEX[joint] for joint in LIMBS[leg]] for leg in ("left-leg", "right-leg")]
EASE = 10  # frames until a leg is held as if nothing of it had been kept
MAX_STRETCH = 0.995  # of the leg's length; beyond it a leg is only as long as it already was
RISE_AT = 0.97  # of the leg's length, from which on the heel rises instead
MAX_RISE = 0.8  # radians that a foot turns about its ball
RISE_SECONDS = 1 / 30  # standard deviation of its smoothing: it came and went within a frame
KNEE = (-1.0, 0.0, 0.0)  # its hinge: it bends towards +Z
STRAIGHT, BENT = 0.02, 0.1  # sine between which the knee's own plane takes over from the hinge


def kept_legs(known: Tensor) -> np.ndarray:
    """Which leg has a known joint: entries [T,R,C] bool → [T,2] bool, left and right."""
    return np.stack([known[:, leg[:-1]].flatten(1).any(1).numpy() for leg in LEGS], axis=1)


def lock_feet(motion: Motion, *, kept: np.ndarray | None = None) -> Motion:
    """The motion with its standing feet planted, which `contacts` then tells; legs that are `kept`
    [T,2] bool stay as they are."""
    quaternions = torch.as_tensor(motion.quaternions, dtype=torch.float64)
    offsets = torch.as_tensor(canonical_skeleton().offsets, dtype=torch.float64)
    root = torch.as_tensor(motion.root_position, dtype=torch.float64)
    positions, world = forward_kinematics(quaternion_to_matrix(quaternions), root, offsets, PARENTS)
    hips, balls = [leg[0] for leg in LEGS], [leg[-1] for leg in LEGS]
    shifts, planted = foot_shifts(
        positions[:, balls].numpy(), positions[:, hips].numpy(), motion.contacts, motion.fps, kept
    )
    locked = motion.quaternions.copy()
    at, side = np.nonzero(np.linalg.norm(shifts, axis=-1) > MIN_CORRECTION)  # of N legs to move
    if len(at):
        joints, shift = np.array(LEGS)[side], torch.as_tensor(shifts[at, side])  # N 4, N 3
        hip, _, ankle, ball = _of_legs(positions[at], joints)
        longest = (ankle - hip).norm(dim=-1).clip(min=RISE_AT * LEG_LENGTH)  # with its heel down
        axis, angle = heel_rise(hip, ball + shift, ankle - ball, longest)
        angles = np.zeros(shifts.shape[:2])
        angles[at, side] = angle.numpy()
        smooth = smoothed(angles, RISE_SECONDS * motion.fps)[at, side]
        rise = axis_turn(axis, torch.as_tensor(smooth))
        solved = move_legs(joints, positions[at], world[at], offsets, shift, rise)
        before = quaternions[at[:, None], joints]
        sign = torch.where((solved * before).sum(-1, keepdim=True) < 0, -1.0, 1.0)
        locked[at[:, None], joints] = (solved * sign).float().numpy()
    contacts = planted.astype(np.float32)
    if kept is not None:
        contacts = np.where(kept, motion.contacts, contacts)
    return replace(motion, quaternions=locked, contacts=contacts)


def _of_legs(values: Tensor, joints: np.ndarray) -> tuple[Tensor, ...]:
    """Of values [N,22,...] those of hip, knee, ankle and ball of each leg, joints [N,4]."""
    return values[torch.as_tensor(np.arange(len(joints)))[:, None], torch.as_tensor(joints)].unbind(
        1
    )


def move_legs(
    joints: np.ndarray,
    positions: Tensor,
    world: Tensor,
    offsets: Tensor,
    shift: Tensor,
    rise: Tensor,
) -> Tensor:
    """Local quaternions [N,4,4] of the joints of legs whose balls move by `shift` [N,3].

    Args:
        joints: hip, knee, ankle and ball of each leg [N,4].
        positions: world joint positions [N,22,3].
        world: world joint rotations [N,22,3,3].
        offsets: of the skeleton [22,3]; its legs are alike.
        shift: metres.
        rise: rotations [N,3,3] of their feet about the balls.
    """
    hip, _, ankle, ball = _of_legs(positions, joints)
    turned_hip, turned_knee, turned_ankle, turned_ball = _of_legs(world, joints)
    _, knee, foot, _ = LEGS[0]
    thigh, shin = two_bone_ik(
        hip,
        turned_hip,
        turned_knee,
        offsets[knee],
        offsets[foot],
        ball + shift + (rise @ (ankle - ball)[..., None]).squeeze(-1),
    )
    pelvis = world[:, PARENTS[LEGS[0][0]]]
    above = torch.stack((pelvis, thigh, shin, rise @ turned_ankle), 1)
    below = torch.stack((thigh, shin, rise @ turned_ankle, turned_ball), 1)
    return matrix_to_quaternion(above.swapaxes(-1, -2) @ below)


def lock_carried_feet(motion: Motion, *, kept: np.ndarray | None = None) -> Motion:
    """`lock_feet` for a body that a path carries: locked twice, the legs smoothed after each time.

    A dancer who is pinned to the path of a song slides as fast as the path goes. The foot lock puts
    steps there, which begin and end with corners, on top of whatever the legs did. Smoothed, that
    is a body that steps by itself, and the second time there is little left to correct: standing
    feet slide less than after one lock, and accelerations stay as real ones (docs/experiments.md).
    """
    stepping = _smooth_legs(lock_feet(motion, kept=kept), FIRST, kept)
    return _smooth_legs(lock_feet(stepping, kept=kept), LAST, kept)


def _smooth_legs(motion: Motion, seconds: float, kept: np.ndarray | None) -> Motion:
    """Rotations of the legs averaged over time, by a Gaussian of this standard deviation."""
    smooth = motion.quaternions.copy()
    for side, joints in enumerate(LEGS):
        legs = torch.as_tensor(motion.quaternions[:, joints], dtype=torch.float64)
        rows = quaternion_continuous(legs, dim=0).numpy()  # T J 4
        mean = smoothed(rows, seconds * motion.fps)
        mean /= np.linalg.norm(mean, axis=-1, keepdims=True)
        free = np.ones(len(rows), dtype=bool) if kept is None else ~kept[:, side]
        smooth[np.ix_(free, np.array(joints))] = mean[free]
    return replace(motion, quaternions=smooth)


def ease_from_kept(loose: Motion, locked: Motion, kept: np.ndarray) -> Motion:
    """Legs planted little by little from where they are kept [T,2] bool: no foot jumps there."""
    quaternions = torch.as_tensor(locked.quaternions).clone()
    before = torch.as_tensor(loose.quaternions)
    for side, joints in enumerate(LEGS):
        away = frames_away(kept[:, side]) if kept[:, side].any() else np.inf
        x = torch.as_tensor(np.minimum(away / EASE, 1.0), dtype=torch.float32)
        share = (x**2 * (3 - 2 * x)).expand(len(before))[:, None, None]
        quaternions[:, joints] = quaternion_slerp(before[:, joints], quaternions[:, joints], share)
    return replace(locked, quaternions=quaternion_continuous(quaternions, dim=0).numpy())


# ---------------------------------------------------------------- one leg


def heel_rise(hip: Tensor, ball: Tensor, lever: Tensor, longest: Tensor) -> tuple[Tensor, Tensor]:
    """Axis [...,3] and angle [...] in radians of the smallest rotation of a foot about its ball
    that lets the leg reach.

    The law of cosines in the triangle of hip, ball and ankle; 0 where the leg is long enough, and
    never more than `MAX_RISE`.

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
    excess = (angle - torch.acos(cosine.clip(-1, 1))).clip(0, MAX_RISE)
    return F.normalize(axis, dim=-1), excess


def two_bone_ik(
    hip: Tensor,
    thigh: Tensor,
    shin: Tensor,
    upper: Tensor,
    lower: Tensor,
    target: Tensor,
    hinge: Sequence[float] = KNEE,
) -> tuple[Tensor, Tensor]:
    """World rotations [...,3,3] of thigh and shin that bring the ankle to its target.

    The knee bends or opens in its own plane, then the whole leg swings the shortest way, so the
    knee keeps its direction. A straight leg bends about its hinge, forward. An arm is one, too.

    Args:
        hip: world positions [...,3], metres.
        thigh: world rotations [...,3,3] before.
        shin: world rotations [...,3,3] before.
        upper: rest offset of the knee from the hip [3], metres.
        lower: rest offset of the ankle from the knee [3], metres.
        target: wanted world positions of the ankle [...,3]; nearer if out of reach.
        hinge: axis in the thigh's frame that turns the hip–ankle line towards the knee [3].
    """
    length_upper, length_lower = upper.norm(), lower.norm()
    before = (thigh @ upper + shin @ lower).norm(dim=-1)
    longest = before.clip(min=MAX_STRETCH * float(length_upper + length_lower))
    shortest = 1.05 * (length_upper - length_lower).abs() + 0.05
    wanted = (target - hip).norm(dim=-1)
    reach = wanted.minimum(longest).maximum(before.minimum(shortest))
    for _ in range(2):  # the hinge is not quite square to a nearly straight leg: once more
        to_knee, shank = thigh @ upper, shin @ lower
        to_ankle = to_knee + shank
        axis = _knee_axis(to_ankle, to_knee, thigh @ thigh.new_tensor(hinge))
        length = to_ankle.norm(dim=-1)
        at_hip = _corner(length_upper, reach, length_lower) - _corner(
            length_upper, length, length_lower
        )
        at_knee = _corner(length_upper, length_lower, reach) - _corner(
            length_upper, length_lower, length
        )
        turns = axis_turn(axis, torch.stack((at_hip, at_hip + at_knee)))
        thigh, shin = turns[0] @ thigh, turns[1] @ shin
        swing = shortest_turn(thigh @ upper + shin @ lower, target - hip)
        thigh, shin = swing @ thigh, swing @ shin
    return thigh, shin


def _corner(a: Tensor, b: Tensor, opposite: Tensor) -> Tensor:
    """Angle between sides a and b of a triangle, radians (law of cosines)."""
    return torch.acos(((a**2 + b**2 - opposite**2) / (2 * a * b)).clip(-1, 1))


def _knee_axis(to_ankle: Tensor, to_knee: Tensor, hinge: Tensor) -> Tensor:
    """Unit axis [...,3] that turns the hip–ankle line towards the knee.

    The normal of the leg's plane, and for a straight leg, which has none, its hinge.
    """
    normal = torch.linalg.cross(to_ankle, to_knee)
    sine = normal.norm(dim=-1, keepdim=True) / (
        to_ankle.norm(dim=-1, keepdim=True) * to_knee.norm(dim=-1, keepdim=True)
    ).clip(min=1e-9)
    own = ((sine - STRAIGHT) / (BENT - STRAIGHT)).clip(0, 1)
    along = F.normalize(to_ankle, dim=-1)
    hinge = hinge - (hinge * along).sum(-1, keepdim=True) * along
    blend = own * F.normalize(normal, dim=-1) + (1 - own) * F.normalize(hinge, dim=-1)
    return F.normalize(blend, dim=-1)
