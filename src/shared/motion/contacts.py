"""Which foot stands on the ground, from joint positions."""

import numpy as np

from .skeleton import FOOT_JOINTS, REST_FOOT_HEIGHT

MAX_HEIGHT = 0.06  # metres of the ball of the foot above its rest height
MAX_SPEED = 0.35  # m/s of the ball of the foot


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
    return (votes >= 2).astype(np.float32)
