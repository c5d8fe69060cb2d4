"""Foot lock: feet that touch the ground stay where they are, by two-bone inverse kinematics.

While a foot stands its ball is held over one point of the floor, and not below it; the leg above
follows (`foot_holds.py`: when, where and how far; `leg_ik.py`: the leg). The foot keeps its world
rotation, and the knee its direction. Where a leg is too short for a hold the heel rises about the
ball, with the toes flat, before the foot gives way. Runs on the CPU in float64.

Letters: T frames.
"""

from dataclasses import replace

import numpy as np
import torch
from torch import Tensor

from .foot_holds import foot_shifts
from .kinematics import forward_kinematics
from .leg_ik import heel_rise, longest_reach, two_bone_ik
from .motion import Motion
from .rotations import matrix_to_quaternion, quaternion_to_matrix
from .skeleton import FOOT_JOINTS, PARENTS, canonical_skeleton

MIN_CORRECTION = 1e-4  # metres; frames that need less stay exactly as they are


def kept_legs(known: Tensor) -> np.ndarray:
    """Which leg has a known joint: entries [T,R,C] bool → [T,2] bool, left and right."""
    legs = [[PARENTS[PARENTS[ankle]], PARENTS[ankle], ankle] for ankle, _ in FOOT_JOINTS]
    return np.stack([known[:, leg].flatten(1).any(1).numpy() for leg in legs], axis=1)


def lock_feet(motion: Motion, *, kept: np.ndarray | None = None) -> Motion:
    """The motion with its standing feet held; `contacts` then tells which are.

    Args:
        motion: of any length.
        kept: legs [T,2] bool that must stay as they are.
    """
    quaternions = torch.as_tensor(motion.quaternions, dtype=torch.float64)
    offsets = torch.as_tensor(canonical_skeleton().offsets, dtype=torch.float64)
    root = torch.as_tensor(motion.root_position, dtype=torch.float64)
    positions, world = forward_kinematics(quaternion_to_matrix(quaternions), root, offsets, PARENTS)
    balls = [ball for _, ball in FOOT_JOINTS]
    hips = [PARENTS[PARENTS[ankle]] for ankle, _ in FOOT_JOINTS]
    shifts, held = foot_shifts(
        positions[:, balls].numpy(), positions[:, hips].numpy(), motion.contacts, motion.fps, kept
    )
    locked = motion.quaternions.copy()
    for side, shift in enumerate(shifts.transpose(1, 0, 2)):
        moved = np.flatnonzero(np.linalg.norm(shift, axis=-1) > MIN_CORRECTION)
        if len(moved):
            at = torch.as_tensor(moved)
            legs = _move_leg(side, positions[at], world[at], offsets, torch.as_tensor(shift[moved]))
            for joint, solved in legs.items():
                before = quaternions[at, joint]
                sign = torch.where((solved * before).sum(-1, keepdim=True) < 0, -1.0, 1.0)
                locked[moved, joint] = (solved * sign).float().numpy()
    contacts = held.astype(np.float32)
    if kept is not None:
        contacts = np.where(kept, motion.contacts, contacts)
    return replace(motion, quaternions=locked, contacts=contacts)


def _move_leg(
    side: int, positions: Tensor, world: Tensor, offsets: Tensor, shift: Tensor
) -> dict[int, Tensor]:
    """Local quaternions [T,4] of the joints of a leg whose ball moves by `shift` [T,3].

    Args:
        side: 0 left, 1 right.
        positions: world joint positions [T,22,3].
        world: world joint rotations [T,22,3,3].
        offsets: of the skeleton [22,3].
        shift: metres.
    """
    ankle, ball = FOOT_JOINTS[side]
    knee = PARENTS[ankle]
    hip = PARENTS[knee]
    target = positions[:, ball] + shift
    lever = positions[:, ankle] - positions[:, ball]
    longest = longest_reach((positions[:, ankle] - positions[:, hip]).norm(dim=-1))
    rise = heel_rise(positions[:, hip], target, lever, longest)
    thigh, shin = two_bone_ik(
        positions[:, hip],
        world[:, hip],
        world[:, knee],
        offsets[knee],
        offsets[ankle],
        target + (rise @ lever[..., None]).squeeze(-1),
    )
    foot = rise @ world[:, ankle]
    chain = (world[:, PARENTS[hip]], thigh, shin, foot, world[:, ball])
    return {
        joint: matrix_to_quaternion(parent.transpose(-1, -2) @ child)
        for joint, parent, child in zip(
            (hip, knee, ankle, ball), chain[:-1], chain[1:], strict=True
        )
    }
