"""The figures behind the seven sanity checks, one function each, TECH §10.1 and ruling 18.

They look at the columns as the model gave them, before any clamping. Letters: T frames.
"""

from collections.abc import Callable

import numpy as np

from ..motion.trajectory import (
    ACCELERATION,
    PHASE,
    POSITION,
    QUATERNION,
    VELOCITY,
    MotionTrajectory,
)


def quaternion_norm(trajectory: MotionTrajectory) -> float:
    """The mean norm of the quaternions."""
    return float(np.linalg.norm(_columns(trajectory, QUATERNION), axis=1).mean())


def phase_range(trajectory: MotionTrajectory) -> tuple[float, float]:
    """The smallest and the largest phase, bars."""
    phase = trajectory.data[:, PHASE]
    return float(phase.min()), float(phase.max())


def phase_excess(trajectory: MotionTrajectory) -> float:
    """How far the phase leaves 0 to 1, bars; 0 = never."""
    low, high = phase_range(trajectory)
    return float(np.maximum(0.0, np.maximum(-low, high - 1))) + 0.0  # no minus zero


def jerk(trajectory: MotionTrajectory) -> float:
    """Mean size of the forward difference of the acceleration column, m/s³."""
    steps = np.diff(_columns(trajectory, ACCELERATION), axis=0) * trajectory.fps
    return _mean(np.linalg.norm(steps, axis=1))


def velocity_error(trajectory: MotionTrajectory) -> float:
    """Mean absolute difference of velocity column and forward difference of position, m/s."""
    return _incoherence(trajectory, POSITION, VELOCITY)


def acceleration_error(trajectory: MotionTrajectory) -> float:
    """Mean absolute difference of acceleration column and difference of velocity, m/s²."""
    return _incoherence(trajectory, VELOCITY, ACCELERATION)


def quaternion_continuity(trajectory: MotionTrajectory) -> float:
    """The smallest signed dot product of neighbouring orientations (rulings 18, 23).

    0.95 is a turn of 36° from one frame to the next, or a sign that was not carried on is -1.
    """
    q = _columns(trajectory, QUATERNION)
    q = q / np.maximum(np.linalg.norm(q, axis=1, keepdims=True), 1e-12)
    dots = (q[1:] * q[:-1]).sum(1)
    return float(dots.min()) if dots.size else 1.0


def phase_step(trajectory: MotionTrajectory) -> float:
    """The smallest step of the phase, bars a frame; below 0 it runs backwards (ruling 23).

    Steps are taken the shorter way round the bar line, so that legal wraps are steps forward.
    """
    steps = np.diff(trajectory.data[:, PHASE].astype(np.float64))
    steps -= np.round(steps)
    return float(steps.min()) if steps.size else 0.0


CHECKS: dict[str, Callable[[MotionTrajectory], float]] = {
    "quaternion": quaternion_norm,
    "phase": phase_excess,
    "jerk": jerk,
    "velocity_coherence": velocity_error,
    "accel_coherence": acceleration_error,
    "quaternion_continuity": quaternion_continuity,
    "phase_monotonic": phase_step,
}


def _columns(trajectory: MotionTrajectory, columns: slice) -> np.ndarray:
    return trajectory.data[:, columns].astype(np.float64)


def _mean(values: np.ndarray) -> float:
    return float(values.mean()) if values.size else 0.0


def _incoherence(trajectory: MotionTrajectory, of: slice, claimed: slice) -> float:
    derived = np.diff(_columns(trajectory, of), axis=0) * trajectory.fps
    return _mean(np.abs(_columns(trajectory, claimed)[:-1] - derived))
