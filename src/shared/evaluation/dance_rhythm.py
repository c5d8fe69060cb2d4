"""When a body dances: beats of all joints, beats of the limbs alone, and feet that land.

A path that slows down on every beat lends its beats to whatever it carries, a statue too. So the
limbs are also looked at from the pelvis, where a carried statue rests.

Letters: T frames, K joints, N moments.
"""

import numpy as np

from ..data.pairing.motion_beats import motion_beats
from ..motion.motion import Motion
from ..motion.skeleton import FOOT_JOINTS, REST_FOOT_HEIGHT

BALLS = [ball for _, ball in FOOT_JOINTS]
DOWN, UP = 0.02, 0.04  # metres of a ball of the foot above its standing height


def body_beats(motion: Motion) -> np.ndarray:
    """Seconds [N] of the beats of all joints' mean speed."""
    return motion_beats(motion.positions(), motion.fps).times


def limb_beats(motion: Motion) -> np.ndarray:
    """Seconds [N] of the beats of the joints as seen from the pelvis."""
    return motion_beats(seen_from_pelvis(motion), motion.fps).times


def seen_from_pelvis(motion: Motion) -> np.ndarray:
    """Joint positions [T,21,3] in metres in the frame of the pelvis, place and rotation."""
    positions = motion.positions().astype(np.float64)
    pelvis = motion.global_rotations()[:, 0].astype(np.float64)  # T 3 3
    return np.einsum("tji,tkj->tki", pelvis, positions[:, 1:] - positions[:, :1])


def landings(motion: Motion) -> np.ndarray:
    """Seconds [N] at which a foot comes down: it is within 2 cm of the floor after having been
    4 cm above it. Sliding feet never land."""
    heights = motion.positions()[:, BALLS, 1] - REST_FOOT_HEIGHT  # T 2
    found: list[float] = []
    for height in heights.T:
        away = False
        for frame, value in enumerate(height):
            if away and value < DOWN:
                found.append(frame / motion.fps)
                away = False
            away = away or value > UP
    return np.array(sorted(found))
