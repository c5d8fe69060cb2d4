"""Figures of one body's motion that need no learned model: sliding feet, the floor, jerk.

Each is the same computation for real and generated motion and means little without the real row.

Letters: T frames, K joints.
"""

import numpy as np

from ..motion.contacts import detect_contacts
from ..motion.skeleton import FOOT_JOINTS, REST_FOOT_HEIGHT

BALLS = [ball for _, ball in FOOT_JOINTS]


def ground_speed(positions: np.ndarray, fps: float) -> np.ndarray:
    """Horizontal speed [T - 1, ...] in m/s of positions [T, ..., 3]."""
    return np.linalg.norm(np.diff(positions[..., [0, 2]], axis=0), axis=-1) * fps


def contact_slide(positions: np.ndarray, fps: float) -> float:
    """Mean horizontal speed in cm/s of the balls of the feet over frames in contact.

    Contacts come from `detect_contacts`, which itself asks for a slow foot, so a foot that glides
    fast is not counted here: read it together with `support_slide` of the evaluation. NaN without
    contact.
    """
    contact = detect_contacts(positions, fps)[:-1] > 0.5  # [T - 1, 2]
    speed = ground_speed(positions[:, BALLS], fps)
    return float(100 * speed[contact].mean()) if contact.any() else float("nan")


def penetration(positions: np.ndarray) -> float:
    """Mean depth in cm of the lowest ball of a foot below its rest height."""
    lowest = positions[:, BALLS, 1].min(1)
    return float(100 * (REST_FOOT_HEIGHT - lowest).clip(min=0).mean())


def mean_jerk(positions: np.ndarray, fps: float) -> float:
    """Mean norm of the third difference in m/s^3 of positions [T, K, 3]; NaN below 4 frames."""
    if len(positions) < 4:
        return float("nan")
    return float(np.linalg.norm(np.diff(positions, n=3, axis=0), axis=-1).mean() * fps**3)
