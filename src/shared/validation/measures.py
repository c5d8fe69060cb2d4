"""Figures of one trajectory that tell motion from noise and from standing still.

All come from the path itself, position and orientation, never from the columns that claim to be
its derivatives. Letters: T frames.
"""

from collections.abc import Callable

import numpy as np

from ..motion.trajectory import MotionTrajectory


def mean_speed(trajectory: MotionTrajectory) -> float:
    """Mean speed of the pelvis, m/s."""
    return _mean_rate(trajectory, 1)


def path_rate(trajectory: MotionTrajectory) -> float:
    """Metres of path over the ground per second."""
    ground = trajectory.position[:, [0, 2]].astype(np.float64)
    return _mean(np.linalg.norm(np.diff(ground, axis=0), axis=1)) * trajectory.fps


def turning(trajectory: MotionTrajectory) -> float:
    """Radians of heading turned per second, left and right alike."""
    return _mean(np.abs(np.diff(trajectory.heading))) * trajectory.fps


def mean_acceleration(trajectory: MotionTrajectory) -> float:
    """Mean size of the acceleration, m/s²."""
    return _mean_rate(trajectory, 2)


def path_jerk(trajectory: MotionTrajectory) -> float:
    """Mean size of the jerk, m/s³."""
    return _mean_rate(trajectory, 3)


def roughness(trajectory: MotionTrajectory) -> float:
    """Mean acceleration by mean speed, 1/s: how fast velocities change.

    Does not depend on the size of the motion. At 30 fps white noise has √3·30 = 52, a random walk
    √2·30 = 42, a person at most 20. 0 where nothing moves.
    """
    speed = mean_speed(trajectory)
    return mean_acceleration(trajectory) / speed if speed else 0.0


MEASURES: dict[str, Callable[[MotionTrajectory], float]] = {
    "mean_speed": mean_speed,
    "path_rate": path_rate,
    "turning": turning,
    "mean_acceleration": mean_acceleration,
    "path_jerk": path_jerk,
    "roughness": roughness,
}
UNITS = {
    "mean_speed": "m/s",
    "path_rate": "m/s",
    "turning": "rad/s",
    "mean_acceleration": "m/s²",
    "path_jerk": "m/s³",
    "roughness": "1/s",
}


def _mean(values: np.ndarray) -> float:
    return float(values.mean()) if values.size else 0.0


def _mean_rate(trajectory: MotionTrajectory, order: int) -> float:
    """Mean norm of the position's `order`-th derivative."""
    steps = np.diff(trajectory.position.astype(np.float64), n=order, axis=0)
    return _mean(np.linalg.norm(steps, axis=1)) * trajectory.fps**order
