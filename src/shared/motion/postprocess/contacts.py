"""Contact detection: which feet stand, from joint positions and from what a motion claims.

Letters: T frames.
"""

import numpy as np
from scipy.ndimage import gaussian_filter1d, maximum_filter1d, minimum_filter1d

from ..skeleton import FOOT_JOINTS, REST_FOOT_HEIGHT

MAX_HEIGHT = 0.06  # metres of the ball of the foot above its rest height
MAX_SPEED = 0.35  # m/s of the ball of the foot
THRESHOLD = 0.5  # contact above it = on the ground
MAX_CLAIM = 0.12  # metres above the standing height; a higher foot stands on nothing
AROUND_SECONDS, FLAT = 0.4, 0.01  # in which a foot comes down; metres that are flat enough
MAX_SUPPORT = 0.08  # metres; a lower foot carries the body if none other does,
MAX_VERTICAL = 0.5  # m/s, unless it rises or falls faster than this
FALL = -3.0  # m/s² of the hips, below which the body flies


def detect_contacts(positions: np.ndarray, fps: float) -> np.ndarray:
    """Contacts [T,2] float32 (left, right) of joint positions [T,22,3] on a floor at y = 0.

    A foot is in contact while its ball is low and slow; single frames are voted down by their
    neighbours.
    """
    balls = positions[:, [ball for _, ball in FOOT_JOINTS]]  # T 2 3
    steps = np.diff(balls, axis=0, append=balls[-1:]) * fps
    if len(steps) > 1:
        steps[-1] = steps[-2]
    low = balls[..., 1] < REST_FOOT_HEIGHT + MAX_HEIGHT
    slow = np.linalg.norm(steps, axis=-1) < MAX_SPEED
    contact = (low & slow).astype(np.float32)
    padded = np.pad(contact, ((1, 1), (0, 0)), mode="edge")
    votes = padded[:-2] + padded[1:-1] + padded[2:]
    return np.asarray(votes >= 2, dtype=np.float32)


def grounding(balls: np.ndarray, kept: np.ndarray, fps: float) -> np.ndarray:
    """What brings both feet down, or up, to the floor [T,2,3]: as much as the lower one is off it.

    A path can carry a pelvis higher or lower than the legs below it were made for. The lowest of
    half a second either way counts, so that steps and jumps stay; further off, nobody stands.
    """
    low = (balls[..., 1] - REST_FOOT_HEIGHT).min(1)
    low = minimum_filter1d(low, 2 * round(AROUND_SECONDS * fps) + 1)
    low = np.sign(low) * (np.abs(low) - FLAT).clip(min=0)
    low *= np.clip(2 - np.abs(low) / MAX_CLAIM, 0, 1)
    free = 1.0 - maximum_filter1d(kept.astype(float), 2 * round(0.2 * fps) + 1, axis=0)
    off = gaussian_filter1d(low[:, None] * free, 0.1 * fps, axis=0, mode="nearest")
    found = np.zeros_like(balls)
    found[..., 1] = np.where(kept, 0.0, -off)
    return found


def standing(balls: np.ndarray, hips: np.ndarray, contacts: np.ndarray, fps: float) -> np.ndarray:
    """Which feet [T,2] carry the body: those that claim to, else the lower one if it is low.

    Nothing carries a body whose hips fall as a thrown thing does, and a foot that moves up or down
    fast is landing or swinging.
    """
    height = balls[..., 1] - REST_FOOT_HEIGHT  # T 2
    claimed = (contacts > THRESHOLD) & (height < MAX_CLAIM)
    if len(balls) < 2:
        return np.asarray(claimed)
    vertical = np.abs(np.gradient(height, axis=0)) * fps
    waist = gaussian_filter1d(hips[..., 1].mean(1), 0.05 * fps, mode="nearest")
    flies = np.gradient(np.gradient(waist)) * fps**2 < FALL
    low = (height < MAX_SUPPORT) & (vertical < MAX_VERTICAL) & ~flies[:, None]
    lower = np.arange(2) == height.argmin(1)[:, None]
    return np.asarray(claimed | (~claimed.any(1, keepdims=True) & low & lower))


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
