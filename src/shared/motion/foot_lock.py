"""Foot lock: feet that touch the ground stay where they are, by two-bone inverse kinematics.

While a foot is in contact its ball is held over one point of the floor, and not below it; the leg
above follows. Before and after, the correction fades in and out (Kovar et al. 2002). The foot keeps
its height and world rotation, so heels still rise over a held ball (and legs that are almost
straight need not bend 20 degrees for one centimetre); the knee keeps its direction. Runs on the
CPU in float64.

Letters: T frames.
"""

from dataclasses import replace

import numpy as np
import torch
from torch import Tensor
from torch.nn import functional as F

from src.shared.motion.kinematics import forward_kinematics
from src.shared.motion.motion import Motion
from src.shared.motion.rotations import matrix_to_quaternion, quaternion_exp, quaternion_to_matrix
from src.shared.motion.skeleton import FOOT_JOINTS, PARENTS, REST_FOOT_HEIGHT, canonical_skeleton

THRESHOLD = 0.5  # contact above it = on the ground
BLEND_SECONDS = 4 / 30  # how long a correction fades in before, and out after, a contact
MAX_GAP_SECONDS = 2 / 30  # a contact that breaks off for no longer than this goes on
MAX_CORRECTION = 0.2  # metres; a foot further from its hold is no slide but a wrong contact
MIN_CORRECTION = 1e-4  # metres; frames that need less stay exactly as they are
MAX_STRETCH = 0.995  # of the leg's length; beyond it a leg is only as long as it already was
STRAIGHT, BENT = 0.02, 0.1  # sine between which the knee's own plane takes over from the hinge


def lock_feet(motion: Motion) -> Motion:
    """The motion with its feet held while `motion.contacts` says so; the same without contacts.

    Where a leg would have to stretch, the foot stays behind its hold instead.
    """
    quaternions = torch.as_tensor(motion.quaternions, dtype=torch.float64)
    offsets = torch.as_tensor(canonical_skeleton().offsets, dtype=torch.float64)
    root = torch.as_tensor(motion.root_position, dtype=torch.float64)
    local = quaternion_to_matrix(quaternions)
    positions, world = forward_kinematics(local, root, offsets, PARENTS)
    locked = motion.quaternions.copy()
    for side, (ankle, ball) in enumerate(FOOT_JOINTS):
        knee = PARENTS[ankle]
        hip = PARENTS[knee]
        contact = motion.contacts[:, side] > THRESHOLD
        shift = ball_corrections(positions[:, ball].numpy(), contact, motion.fps)
        moved = np.flatnonzero(np.linalg.norm(shift, axis=-1) > MIN_CORRECTION)
        if not len(moved):
            continue
        at = torch.as_tensor(moved)
        thigh, shin = two_bone_ik(
            positions[at, hip],
            world[at, hip],
            world[at, knee],
            offsets[knee],
            offsets[ankle],
            positions[at, ankle] + torch.as_tensor(shift[moved]),
        )
        above = world[at, PARENTS[hip]]
        chain = (above, thigh, shin, world[at, ankle])
        for joint, parent, child in zip((hip, knee, ankle), chain[:-1], chain[1:], strict=True):
            solved = matrix_to_quaternion(parent.transpose(-1, -2) @ child)
            before = quaternions[at, joint]
            sign = torch.where((solved * before).sum(-1, keepdim=True) < 0, -1.0, 1.0)
            locked[moved, joint] = (solved * sign).float().numpy()
    return replace(motion, quaternions=locked)


def contact_runs(contact: np.ndarray, max_gap: int) -> list[tuple[int, int]]:
    """First and past-the-last frame of each contact in bool [T]; short gaps are bridged."""
    edges = np.flatnonzero(np.diff(np.concatenate(([0], contact.astype(int), [0]))))
    runs: list[tuple[int, int]] = []
    for start, stop in zip(edges[::2].tolist(), edges[1::2].tolist(), strict=True):
        if runs and start - runs[-1][1] <= max_gap:
            runs[-1] = (runs[-1][0], stop)
        else:
            runs.append((start, stop))
    return runs


def ball_corrections(ball: np.ndarray, contact: np.ndarray, fps: float) -> np.ndarray:
    """Where the ball of a foot has to move, [T,3] in metres; zero = nothing to do.

    Args:
        ball: world positions [T,3], metres.
        contact: bool [T].
        fps: frames per second.
    """
    frames = np.arange(len(ball))
    blend = round(BLEND_SECONDS * fps)
    shift, weight = np.zeros_like(ball), np.zeros((len(ball), 1))
    runs = contact_runs(contact, round(MAX_GAP_SECONDS * fps))
    held = []
    for start, stop in runs:
        path = ball[start:stop]
        own = path.mean(0) - path
        own[:, 1] = np.maximum(REST_FOOT_HEIGHT - path[:, 1], 0)
        length = np.linalg.norm(own, axis=-1, keepdims=True)
        own *= np.minimum(1, MAX_CORRECTION / np.maximum(length, 1e-9))
        held.append(own)
        distance = np.maximum(np.maximum(start - frames, frames - stop + 1), 0)
        near = np.clip(1 - distance / (blend + 1), 0, 1)
        ramp = (near**2 * (3 - 2 * near))[:, None]
        shift += ramp * own[np.clip(frames - start, 0, stop - start - 1)]
        weight += ramp
    shift /= np.maximum(weight, 1)
    for (start, stop), own in zip(runs, held, strict=True):
        shift[start:stop] = own  # no neighbour's ramp moves a held foot
    return shift


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
    longest = before.clamp_min(MAX_STRETCH * float(length_upper + length_lower))
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
        thigh, shin = _turn(axis, at_hip) @ thigh, _turn(axis, at_hip + at_knee) @ shin
        swing = _shortest_turn(thigh @ upper + shin @ lower, target - hip)
        thigh, shin = swing @ thigh, swing @ shin
    return thigh, shin


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


def _turn(axis: Tensor, angle: Tensor) -> Tensor:
    """Rotation [...,3,3] about unit axes [...,3] by angles [...]."""
    return quaternion_to_matrix(quaternion_exp(axis * angle[..., None]))


def _shortest_turn(source: Tensor, target: Tensor) -> Tensor:
    """The smallest rotation [...,3,3] that takes one direction [...,3] to another."""
    source, target = F.normalize(source, dim=-1), F.normalize(target, dim=-1)
    axis = torch.linalg.cross(source, target)
    angle = torch.atan2(axis.norm(dim=-1), (source * target).sum(-1))
    return _turn(F.normalize(axis, dim=-1), angle)
