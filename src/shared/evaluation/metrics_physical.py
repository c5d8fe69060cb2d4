"""Physical plausibility from joint positions: foot slide, floor, jerk, speed.

Each is the same computation for real and generated motion and means little without the real row.

Letters: T frames, K joints.
"""

from dataclasses import dataclass

import numpy as np

from ..motion.motion import Motion
from ..motion.skeleton import JOINT_INDEX, REST_FOOT_HEIGHT
from ..validation.body_measures import (
    BALLS,
    contact_slide,
    ground_speed,
    mean_jerk,
    penetration,
)

HANDS = [JOINT_INDEX["l_wrist"], JOINT_INDEX["r_wrist"]]
SUPPORT_HEIGHT = 0.06  # metres above the rest height: higher than this, no foot carries the body


@dataclass(frozen=True)
class Physics:
    """Physical figures of one motion; a slide is NaN when no foot touches the ground."""

    contact_slide: float  # cm/s of a ball of the foot while the contact detector sees it on ground
    support_slide: float  # cm/s of the lower ball of the foot, no condition on its speed
    penetration: float  # cm, mean depth of the lowest ball of the foot below its rest height
    jerk: float  # m/s^3, mean over all joints
    hand_jerk: float  # m/s^3, mean over both wrists
    speed: float  # m/s, pelvis over the ground


def support_slide(positions: np.ndarray, fps: float) -> float:
    """Mean horizontal speed in cm/s of the lower foot, over frames where it is near the floor.

    Some foot carries the body unless it is in the air, so this needs no guess about contacts and
    gliding cannot escape it.
    """
    balls = positions[:, BALLS]  # [T, 2, 3]
    lower = balls[:-1, :, 1].argmin(1)  # [T - 1]
    frames = np.arange(len(lower))
    grounded = balls[frames, lower, 1] < REST_FOOT_HEIGHT + SUPPORT_HEIGHT
    speed = ground_speed(balls, fps)[frames, lower]
    return float(100 * speed[grounded].mean()) if grounded.any() else float("nan")


def physics(motion: Motion) -> Physics:
    """All figures of one motion of at least two frames."""
    positions = motion.positions().astype(np.float64)
    return Physics(
        contact_slide=contact_slide(positions, motion.fps),
        support_slide=support_slide(positions, motion.fps),
        penetration=penetration(positions),
        jerk=mean_jerk(positions, motion.fps),
        hand_jerk=mean_jerk(positions[:, HANDS], motion.fps),
        speed=float(ground_speed(positions[:, 0], motion.fps).mean()),
    )
