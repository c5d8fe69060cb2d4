"""Trajectories made of smooth curves, for tests."""

import numpy as np

from src.shared.motion.trajectory import MotionTrajectory


def smooth_trajectory(seed: int, num_frames: int = 120, *, fps: float = 30.0) -> MotionTrajectory:
    """A body that wanders, turns more than once, leans a little and keeps a tempo."""
    rng = np.random.default_rng(seed)
    t = np.arange(num_frames) / fps

    def wave(scale: float) -> np.ndarray:
        rate, start = rng.uniform(0.5, 4, 3), rng.uniform(0, 2 * np.pi, 3)
        return scale * np.sin(t[:, None] * rate + start).sum(1) / 3

    x, y, z = rng.uniform(-3, 3) + t + wave(1), 0.9 + wave(0.1), rng.uniform(-3, 3) + wave(1)
    yaw = rng.uniform(-3, 3) + rng.uniform(-2, 2) * t + wave(0.5)
    pitch = wave(0.2)
    zero = np.zeros_like(t)
    turn = np.stack((np.cos(yaw / 2), zero, np.sin(yaw / 2), zero), 1)
    lean = np.stack((np.cos(pitch / 2), np.sin(pitch / 2), zero, zero), 1)
    quaternion = multiply(turn, lean)
    phase = rng.uniform(0, 1) + np.cumsum(rng.uniform(0.01, 0.03, num_frames))
    angles = np.stack([0.7 + wave(0.5) for _ in range(4)], 1)
    style = np.stack((np.sin(angles), np.cos(angles)), 2).reshape(num_frames, 8) / 2
    position = np.stack((x, y, z), 1)
    return MotionTrajectory.from_pose(position, quaternion, phase, style, fps=fps)


def multiply(a: np.ndarray, b: np.ndarray) -> np.ndarray:
    """Hamilton product [T,4] of w, x, y, z, written with vectors."""
    w = a[:, :1] * b[:, :1] - (a[:, 1:] * b[:, 1:]).sum(1, keepdims=True)
    v = a[:, :1] * b[:, 1:] + b[:, :1] * a[:, 1:] + np.cross(a[:, 1:], b[:, 1:])
    return np.concatenate((w, v), 1)
