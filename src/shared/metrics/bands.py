"""Figures of one trajectory, and the bands that real motions keep to.

The checks look at the columns as a model gave them, before any clamping: TECH §10.1 and ruling 18.
The measures look at the path itself, position and orientation, never at the columns that claim to
be its derivatives: they tell motion from noise and from standing still. A band is the 5th to 95th
percentile of a figure over real motions, stored as JSON.

Letters: T frames.
"""

import math
from collections.abc import Callable, Iterable
from dataclasses import asdict, dataclass
from pathlib import Path

import numpy as np

from ..errors import UserError
from ..io.files import load_json, write_json
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


# ---------------------------------------------------------------- figures of the path


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


def _mean_rate(trajectory: MotionTrajectory, order: int) -> float:
    """Mean norm of the position's `order`-th derivative."""
    steps = np.diff(trajectory.position.astype(np.float64), n=order, axis=0)
    return _mean(np.linalg.norm(steps, axis=1)) * trajectory.fps**order


# ---------------------------------------------------------------- what real motions measure


FORMAT_VERSION = 1
SLACK = 3.0  # a factor beyond the band at both ends that still passes


@dataclass(frozen=True)
class Band:
    """One figure over a set of real motions.

    Attributes:
        low: 5th percentile.
        median: 50th.
        high: 95th.
    """

    low: float
    median: float
    high: float

    def holds(self, value: float) -> bool:
        """Whether a value lies between the 5th and the 95th percentile."""
        return self.low <= value <= self.high

    @property
    def limits(self) -> tuple[float, float]:
        """The band with `SLACK` at both ends, which nearly all real motion keeps to.

        One real motion in ten lies outside each band itself, so a verdict on one motion cannot
        ask for that.
        """
        return self.low / SLACK, self.high * SLACK

    def tolerates(self, value: float) -> bool:
        """Whether a value lies within `limits`."""
        return self.limits[0] <= value <= self.limits[1]


@dataclass(frozen=True)
class Bands:
    """Bands of the seven checks and of `MEASURES`, by name, and how many motions they stem from."""

    bands: dict[str, Band]
    motions: int

    @classmethod
    def of(cls, trajectories: Iterable[MotionTrajectory]) -> "Bands":
        """Measure real motions.

        Raises:
            UserError: there are none.
        """
        figures = CHECKS | MEASURES
        rows = [[figure(motion) for figure in figures.values()] for motion in trajectories]
        if not rows:
            raise UserError("no real motions to measure; give at least one trajectory")
        limits = np.percentile(rows, (5, 50, 95), axis=0).T.tolist()
        return cls(
            {name: Band(*each) for name, each in zip(figures, limits, strict=True)}, len(rows)
        )

    def save(self, path: str | Path) -> Path:
        """Write JSON.

        Raises:
            UserError: the file cannot be written.
        """
        content = {
            "format_version": FORMAT_VERSION,
            "motions": self.motions,
            "bands": {name: asdict(band) for name, band in self.bands.items()},
        }
        write_json(Path(path), content)
        return Path(path)

    @classmethod
    def load(cls, path: str | Path) -> "Bands":
        """Read what `save` wrote.

        Raises:
            UserError: the file is missing, damaged or not ours.
        """
        try:
            content = load_json(path)
            bands = {name: _band(cells) for name, cells in content["bands"].items()}
            return cls(bands, int(content["motions"]))
        except OSError as error:
            raise UserError(
                f"{path}: cannot be read: {error.strerror or error}; name a file that may be read"
            ) from error
        except (ValueError, OverflowError, KeyError, TypeError, AttributeError) as error:
            raise UserError(
                f"{path}: is not a file of bands ({type(error).__name__}: {error}); "
                "prepare the data again"
            ) from error

    def inside(self, trajectory: MotionTrajectory) -> dict[str, bool]:
        """For each of `MEASURES`: does this motion lie between the 5th and 95th percentile?"""
        return {
            name: self.bands[name].holds(measure(trajectory))
            for name, measure in MEASURES.items()
            if name in self.bands
        }


def _band(cells: dict[str, float]) -> Band:
    band = Band(float(cells["low"]), float(cells["median"]), float(cells["high"]))
    if not all(math.isfinite(value) for value in (band.low, band.median, band.high)):
        raise ValueError("a band is not finite")
    return band
