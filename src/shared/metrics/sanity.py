"""The sanity suite: does a trajectory hold together, and does it move as people do? (ruling 18)

TECH §10.1's five checks, quaternion continuity and phase monotonicity (REF) look at the columns as
a model gave them, before any clamping. TECH's thresholds alone pass an untrained decoder and a
frozen pose, so three things are added: a jerk bound that noise misses, a floor and a ceiling on the
path itself (`liveliness`, `roughness`), and, where the bands of real motions are given, each
measure of the path against them: of position and orientation, never of the columns that claim to
be their derivatives.

Measured on 2,667 clips of Bandai-Namco and CMU mocap (walking, running, dancing, waving; 30 fps):
mean jerk 5 to 217 m/s³ (5th to 95th percentile), at most 455; mean speed from 0.0055 m/s (standing,
one arm raised); roughness 2.2 to 19.5 1/s. White noise of 1 cm has a jerk of 2,100 m/s³ and a
roughness of 52 1/s. Two of the clips fail: a marker glitch turns the pelvis 67° in one frame.

Letters: T frames.
"""

import math
from collections.abc import Callable, Iterable, Iterator
from dataclasses import asdict, astuple, dataclass
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np

from ..errors import UserError
from ..io.files import load_json, write_json
from ..io.storage import Place, place
from ..motion.trajectory import (
    ACCELERATION,
    PHASE,
    POSITION,
    QUATERNION,
    VELOCITY,
    MotionTrajectory,
)


def _columns(trajectory: MotionTrajectory, columns: slice) -> np.ndarray:
    return trajectory.data[:, columns].astype(np.float64)


def _mean(values: np.ndarray) -> float:
    return float(values.mean()) if values.size else 0.0


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


def incoherence(trajectory: MotionTrajectory, of: slice, claimed: slice) -> float:
    """Mean absolute difference of one column and the forward difference of another."""
    derived = np.diff(_columns(trajectory, of), axis=0) * trajectory.fps
    return _mean(np.abs(_columns(trajectory, claimed)[:-1] - derived))


def quaternion_continuity(trajectory: MotionTrajectory) -> float:
    """The smallest signed dot product of neighbouring orientations (rulings 18, 23): 0.95 of a turn
    of 36° from one frame to the next, -1 of a sign that was not carried on."""
    q = _columns(trajectory, QUATERNION)
    q = q / np.maximum(np.linalg.norm(q, axis=1, keepdims=True), 1e-12)
    dots = (q[1:] * q[:-1]).sum(1)
    return float(dots.min()) if dots.size else 1.0


def phase_step(trajectory: MotionTrajectory) -> float:
    """The smallest step of the phase, bars a frame, the shorter way round the bar line; below 0 it
    runs backwards (ruling 23)."""
    steps = np.diff(trajectory.data[:, PHASE].astype(np.float64))
    steps -= np.round(steps)
    return float(steps.min()) if steps.size else 0.0


CHECKS: dict[str, Callable[[MotionTrajectory], float]] = {
    "quaternion": lambda t: float(np.linalg.norm(_columns(t, QUATERNION), axis=1).mean()),
    "phase": phase_excess,
    "jerk": jerk,
    "velocity_coherence": partial(incoherence, of=POSITION, claimed=VELOCITY),  # m/s
    "accel_coherence": partial(incoherence, of=VELOCITY, claimed=ACCELERATION),  # m/s²
    "quaternion_continuity": quaternion_continuity,
    "phase_monotonic": phase_step,
}


# ---------------------------------------------------------------- figures of the path


def mean_rate(trajectory: MotionTrajectory, order: int) -> float:
    """Mean norm of the position's `order`-th derivative, m/s, m/s² or m/s³."""
    steps = np.diff(trajectory.position.astype(np.float64), n=order, axis=0)
    return _mean(np.linalg.norm(steps, axis=1)) * trajectory.fps**order


def path_rate(trajectory: MotionTrajectory) -> float:
    """Metres of path over the ground per second."""
    ground = trajectory.position[:, [0, 2]].astype(np.float64)
    return _mean(np.linalg.norm(np.diff(ground, axis=0), axis=1)) * trajectory.fps


def turning(trajectory: MotionTrajectory) -> float:
    """Radians of heading turned per second, left and right alike."""
    return _mean(np.abs(np.diff(trajectory.heading))) * trajectory.fps


def roughness(trajectory: MotionTrajectory) -> float:
    """Mean acceleration by mean speed, 1/s, whatever the size of the motion; 0 where nothing moves.
    At 30 fps white noise has √3·30 = 52, a random walk √2·30 = 42, a person at most 20."""
    speed = mean_rate(trajectory, 1)
    return mean_rate(trajectory, 2) / speed if speed else 0.0


MEASURES: dict[str, Callable[[MotionTrajectory], float]] = {
    "mean_speed": partial(mean_rate, order=1),
    "path_rate": path_rate,
    "turning": turning,
    "mean_acceleration": partial(mean_rate, order=2),
    "path_jerk": partial(mean_rate, order=3),
    "roughness": roughness,
}
UNITS = dict(zip(MEASURES, ("m/s", "m/s", "rad/s", "m/s²", "m/s³", "1/s"), strict=True))


# ---------------------------------------------------------------- what real motions measure

FORMAT_VERSION = 1
SLACK = 3.0  # a factor beyond the band at both ends that still passes


@dataclass(frozen=True)
class Band:
    """One figure over a set of real motions."""

    low: float  # 5th percentile
    median: float
    high: float  # 95th percentile

    def holds(self, value: float) -> bool:
        """Whether a value lies between the 5th and the 95th percentile."""
        return self.low <= value <= self.high

    @property
    def limits(self) -> tuple[float, float]:
        """The band with `SLACK` at both ends, which nearly all real motion keeps to; of the band
        itself one real motion in ten is outside."""
        return self.low / SLACK, self.high * SLACK


@dataclass(frozen=True)
class Bands:
    """Bands of the seven checks and of `MEASURES`, by name, and how many motions they stem from."""

    bands: dict[str, Band]
    motions: int

    @classmethod
    def of(cls, trajectories: Iterable[MotionTrajectory]) -> "Bands":
        """Measure real motions. Raises UserError: there are none."""
        figures = CHECKS | MEASURES
        rows = [[figure(motion) for figure in figures.values()] for motion in trajectories]
        if not rows:
            raise UserError("no real motions to measure; give at least one trajectory")
        limits = np.percentile(rows, (5, 50, 95), axis=0).T.tolist()
        bands = {name: Band(*each) for name, each in zip(figures, limits, strict=True)}
        return cls(bands, len(rows))

    def save(self, path: str | Place) -> Place:
        """Write JSON. Raises UserError: the file cannot be written."""
        bands = {name: asdict(band) for name, band in self.bands.items()}
        content = {"format_version": FORMAT_VERSION, "motions": self.motions, "bands": bands}
        write_json(place(path), content)
        return place(path)

    @classmethod
    def load(cls, path: str | Path) -> "Bands":
        """Read what `save` wrote. Raises UserError: the file is missing, damaged or not ours."""
        try:
            content = load_json(place(path))
            bands = {
                name: Band(*(float(cells[key]) for key in ("low", "median", "high")))
                for name, cells in content["bands"].items()
            }
            if not all(math.isfinite(x) for band in bands.values() for x in astuple(band)):
                raise ValueError("a band is not finite")
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
        known = {name: self.bands[name] for name in MEASURES if name in self.bands}
        return {name: band.holds(MEASURES[name](trajectory)) for name, band in known.items()}


# ---------------------------------------------------------------- the suite

SEVEN = tuple(CHECKS)  # names of the documents' checks; the others have names of their own
Figure = float | tuple[float, float]
WHAT = {
    "quaternion": "mean norm",
    "phase": "phase range",
    "jerk": "mean jerk, m/s³",
    "velocity_coherence": "velocity against position, m/s",
    "accel_coherence": "acceleration against velocity, m/s²",
    "quaternion_continuity": "smallest dot product of neighbours",
    "phase_monotonic": "smallest phase step, bars",
    "liveliness": "mean speed, m/s",
    "roughness": "acceleration by speed, 1/s",
}


@dataclass(frozen=True)
class SanityThresholds:
    """Bounds of the checks; TECH's names, its values but for jerk and acceleration. Its jerk of
    50,000 passes anything (ruling 18); real motion has at most a fourth of this."""

    quaternion_norm_min: float = 0.95  # of the mean norm
    quaternion_norm_max: float = 1.05
    phase_min: float = 0.0  # bars
    phase_max: float = 1.0
    max_jerk: float = 2000.0  # m/s³, mean
    max_velocity_error: float = 5.0  # m/s, mean
    max_acceleration_error: float = 50.0  # m/s², mean (ruling 16)
    min_quaternion_continuity: float = 0.95  # smallest signed dot product (ruling 18)
    max_phase_backstep: float = 1e-4  # bars a frame that rounding may cost a monotone phase
    min_mean_speed: float = 0.003  # m/s; below, nothing moves
    max_roughness: float = 25.0  # 1/s; above, the path is noise


@dataclass(frozen=True)
class CheckResult:
    """Result of one check."""

    name: str  # key in `check_all`'s dictionary
    passed: bool
    value: Figure  # the phase check gives smallest and largest
    threshold: Figure  # the bound or bounds it was held against
    message: str  # one line for people
    band: tuple[float, float] | None = None  # 5th and 95th percentile of real motions, where known


class SanityChecker:
    """All checks on one trajectory, or on many."""

    def __init__(
        self, thresholds: SanityThresholds | None = None, bands: Bands | None = None
    ) -> None:
        """Without bands the path is only held against the built-in floor and ceiling."""
        self.thresholds = thresholds or SanityThresholds()
        self.bands = bands

    def check_all(self, trajectory: MotionTrajectory) -> tuple[bool, dict[str, CheckResult]]:
        """Whether a trajectory of at least one frame, as the model gave it, not clamped, passes
        everything, and the results by name: the seven checks, `liveliness`, `roughness` and, with
        bands, `band_<measure>`. A value that is not finite fails."""
        if not trajectory.num_frames:
            raise ValueError("a trajectory without frames cannot be checked")
        with np.errstate(invalid="ignore", over="ignore"):  # NaN and infinity fail below
            results = [*self._checks(trajectory), *self._against_bands(trajectory)]
        return all(result.passed for result in results), {r.name: r for r in results}

    def _checks(self, trajectory: MotionTrajectory) -> Iterator[CheckResult]:
        t, value = self.thresholds, {name: check(trajectory) for name, check in CHECKS.items()}
        value |= {"liveliness": mean_rate(trajectory, 1), "roughness": roughness(trajectory)}
        norms, phases = (t.quaternion_norm_min, t.quaternion_norm_max), (t.phase_min, t.phase_max)
        low, high = phase_range(trajectory)
        found: dict[str, tuple[bool, Figure]] = {
            "quaternion": (norms[0] <= value["quaternion"] <= norms[1], norms),
            "phase": (phases[0] <= low and high <= phases[1], phases),
        }
        most = {"jerk": t.max_jerk, "velocity_coherence": t.max_velocity_error}
        most["accel_coherence"] = t.max_acceleration_error
        found |= {name: (value[name] < bound, bound) for name, bound in most.items()}
        least, backstep = t.min_quaternion_continuity, -t.max_phase_backstep
        found["quaternion_continuity"] = value["quaternion_continuity"] > least, least
        found["phase_monotonic"] = value["phase_monotonic"] >= backstep, backstep
        found["liveliness"] = value["liveliness"] >= t.min_mean_speed, t.min_mean_speed
        found["roughness"] = value["roughness"] < t.max_roughness, t.max_roughness
        for name, (passed, threshold) in found.items():
            figure: Figure = (low, high) if name == "phase" else value[name]
            band = self.bands.bands.get(name) if self.bands else None
            message = f"{WHAT[name]}: {_text(figure)} (threshold {_text(threshold)})"
            limits = (band.low, band.high) if band else None
            yield CheckResult(name, bool(passed), figure, threshold, message, limits)

    def _against_bands(self, trajectory: MotionTrajectory) -> Iterator[CheckResult]:
        known = {} if self.bands is None else self.bands.bands
        for name in (name for name in MEASURES if name in known):
            band, value, what = known[name], MEASURES[name](trajectory), name.replace("_", " ")
            real = f"(real {band.low:.4g} to {band.high:.4g})"
            message = f"{what}: {value:.4g} {UNITS[name]} {real}"
            low, high = band.limits
            passed, edges = low <= value <= high, (band.low, band.high)
            yield CheckResult(f"band_{name}", passed, value, (low, high), message, edges)


def _text(value: Figure) -> str:
    if isinstance(value, tuple):
        return f"{value[0]:.4g} to {value[1]:.4g}"
    return f"{value:.4g}"


# ---------------------------------------------------------------- many motions


def frozen(trajectory: MotionTrajectory) -> MotionTrajectory:
    """The first pose held while the music goes on: a row that must fail."""
    first = MotionTrajectory(trajectory.data[:1], trajectory.fps)
    length, phase = (trajectory.num_frames, 1), trajectory.phase_unwrapped
    position, quaternion = np.tile(first.position, length), np.tile(first.quaternion, length)
    style, fps = trajectory.style, trajectory.fps
    return MotionTrajectory.from_pose(position, quaternion, phase, style, fps=fps)


def sanity_row(
    name: str, trajectories: Iterable[MotionTrajectory], checker: SanityChecker
) -> dict[str, Any]:
    """One group of motions through the suite, as plain values for JSON.

    Returns:
        name, motions, passed (whole suite), passed_seven, rate; checks: for each check its number
        passed and the mean of its value, None where that is not finite; inside: for each of
        `MEASURES` the share of motions between the 5th and 95th percentile of real ones, with
        bands only; failures: for each failed motion its index and the names of what failed.
    """
    motions, bands = list(trajectories), checker.bands
    outcomes = [checker.check_all(motion) for motion in motions]
    checks: dict[str, dict[str, float | None]] = {}
    for key in outcomes[0][1] if outcomes else ():
        mean = float(np.mean([results[key].value for _, results in outcomes]))
        count = sum(results[key].passed for _, results in outcomes)
        checks[key] = {"passed": count, "mean": mean if np.isfinite(mean) else None}
    known = [] if bands is None else [bands.inside(motion) for motion in motions]
    failed = [[r.name for r in results.values() if not r.passed] for _, results in outcomes]
    seven = sum(all(results[key].passed for key in SEVEN) for _, results in outcomes)
    passed = sum(good for good, _ in outcomes)
    return {
        "name": name,
        "motions": len(motions),
        "passed": passed,
        "passed_seven": seven,
        "rate": passed / len(motions) if motions else None,
        "checks": checks,
        "inside": {k: float(np.mean([r[k] for r in known])) for k in (known[0] if known else ())},
        "failures": [{"index": i, "failed": names} for i, names in enumerate(failed) if names],
    }
