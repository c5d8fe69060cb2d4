"""Feet of a body that a path carries: held twice, and the legs smoothed after each time.

A dancer who is pinned to the path of a song slides as fast as the path goes. The foot lock puts
steps there, which begin and end with corners, on top of whatever the legs did. Smoothed, that is a
body that steps by itself, and the second time there is little left to correct: standing feet slide
less than after one lock, and accelerations stay as real ones (docs/experiments.md). Runs on the
CPU in float64.

Letters: T frames, J joints.
"""

from dataclasses import replace

import numpy as np
import torch
from scipy.ndimage import gaussian_filter1d

from .foot_lock import lock_feet
from .motion import Motion
from .rotations import quaternion_continuous
from .skeleton import JOINT_INDEX, LIMBS

FIRST, LAST = 1.5 / 30, 0.5 / 30  # seconds, standard deviations of the two smoothings
LEGS = [[JOINT_INDEX[joint] for joint in LIMBS[leg]] for leg in ("left-leg", "right-leg")]


def hold_carried_feet(motion: Motion, *, kept: np.ndarray | None = None) -> Motion:
    """The motion with its standing feet held; `contacts` then tells which are.

    Args:
        motion: of any length, its pelvis on a path that is not its own.
        kept: legs [T,2] bool that must stay as they are.
    """
    stepping = _smooth_legs(lock_feet(motion, kept=kept), FIRST, kept)
    return _smooth_legs(lock_feet(stepping, kept=kept), LAST, kept)


def _smooth_legs(motion: Motion, seconds: float, kept: np.ndarray | None) -> Motion:
    """Rotations of the legs averaged over time, by a Gaussian of this standard deviation."""
    smooth = motion.quaternions.copy()
    for side, joints in enumerate(LEGS):
        legs = torch.as_tensor(motion.quaternions[:, joints], dtype=torch.float64)
        rows = quaternion_continuous(legs, dim=0).numpy()  # T J 4
        mean = gaussian_filter1d(rows, seconds * motion.fps, axis=0, mode="nearest")
        mean /= np.linalg.norm(mean, axis=-1, keepdims=True)
        free = np.ones(len(rows), dtype=bool) if kept is None else ~kept[:, side]
        smooth[np.ix_(free, np.array(joints))] = mean[free]
    return replace(motion, quaternions=smooth)
