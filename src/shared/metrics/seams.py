"""Are the seams between windows seen? Accelerations and jerks there against everywhere else.

The ratio of each quantity's quantiles at seams and elsewhere, with a bootstrap interval over songs:
a smooth seam has 1 inside. The same and the Kolmogorov–Smirnov distance against a null: the marks
turned round to random places of each song. And the extremes of what must not jump at all.

Letters: T frames.
"""

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from ..motion.motion import Motion
from ..motion.trajectory import MotionTrajectory
from .physical import joint_rates

REACH = 3  # frames around a seam: differences look ahead, and known frames end with it
POINTS = (50, 95)  # percentiles
RESAMPLES = 500
ACCELERATION, JERK = "acceleration, m/s²", "jerk, m/s³"
ORDERS = {ACCELERATION: 2, JERK: 3}
Values = tuple[np.ndarray, np.ndarray]  # quantity [T] and True at seams [T]


@dataclass(frozen=True, eq=False)
class Seamed:
    """A trajectory of several windows, and which frames [T] are near a seam."""

    trajectory: MotionTrajectory
    seam: np.ndarray


def marked(frames: int, places: Iterable[tuple[int, int]], reach: int = REACH) -> np.ndarray:
    """True [T] in the frames of each place, from its first to before its last, and around them."""
    near = np.zeros(frames, dtype=bool)
    for start, stop in places:
        near[max(0, start - reach) : stop + reach] = True
    return near


def starts(seam: np.ndarray) -> np.ndarray:
    """The frames at which marks [T] begin."""
    return np.flatnonzero(np.diff(seam.astype(int), prepend=0) == 1)


def quantities(trajectory: MotionTrajectory) -> dict[str, np.ndarray]:
    """Sizes [T-1] of acceleration (m/s²), jerk (m/s³) and angular acceleration (rad/s²)."""
    acceleration = trajectory.acceleration.astype(np.float64)
    turning = trajectory.angular_velocity.astype(np.float64)
    return {
        "acceleration": np.linalg.norm(acceleration, axis=1)[:-1],
        "jerk": np.linalg.norm(np.diff(acceleration, axis=0), axis=1) * trajectory.fps,
        "angular_acceleration": np.linalg.norm(np.diff(turning, axis=0), axis=1) * trajectory.fps,
    }


def body_quantities(motion: Motion) -> dict[str, np.ndarray]:
    """Of each frame [T] the largest acceleration and jerk of a joint; 0 at the ends."""
    positions = motion.positions().astype(np.float64)
    found = {}
    for name, order in ORDERS.items():
        sizes = joint_rates(positions, motion.fps, order).max(1)
        missing = motion.num_frames - len(sizes)
        found[name] = np.pad(sizes, (order // 2, missing - order // 2))
    return found


def seam_report(songs: Sequence[Seamed], seed: int = 0, n: int = RESAMPLES) -> dict[str, Any]:
    """Everything about the seams of at least one song, as plain data.

    Returns:
        songs, seams (their number), frames; quantities: see `compare`; jumps: see `jumps`.
        Only the first two where no song has a seam.
    """
    seamed = [song for song in songs if song.seam.any()]
    number = sum(len(starts(song.seam)) for song in seamed)
    report: dict[str, Any] = {"songs": len(seamed), "seams": number}
    if not seamed:
        return report
    sizes = [quantities(song.trajectory) for song in seamed]
    report["frames"] = sum(int(song.seam.sum()) for song in seamed)
    marks = [song.seam[:-1] for song in seamed]
    report["quantities"] = {
        name: compare(list(zip([each[name] for each in sizes], marks, strict=True)), seed, n)
        for name in sizes[0]
    }
    report["jumps"] = jumps(seamed)
    return report


def compare(songs: Sequence[Values], seed: int = 0, n: int = RESAMPLES) -> dict[str, Any]:
    """One quantity at seams and elsewhere.

    Returns:
        seam_pQ, elsewhere_pQ; ratio_pQ with value, low, high (bootstrap over songs), null_low,
        null_high (marks turned round); ks likewise with its null and p, the share of turned marks
        whose distance is as large.
    """
    rng = np.random.default_rng(seed)
    seam, other = split(songs)
    draws = rng.integers(0, len(songs), (n, len(songs)))
    drawn = np.array([_ratios(*split([songs[i] for i in draw])) for draw in draws])
    turned = ([(v, np.roll(m, int(rng.integers(len(m))))) for v, m in songs] for _ in range(n))
    null = np.array([measure(each) for each in turned])  # marks at random places of each song
    observed = measure(songs)
    nulls = np.percentile(null, (2.5, 97.5), axis=0).T.tolist()
    found = [
        {"value": value, "null_low": low, "null_high": high}
        for value, (low, high) in zip(observed.tolist(), nulls, strict=True)
    ]
    report: dict[str, Any] = {}
    for index, point in enumerate(POINTS):
        report[f"seam_p{point}"] = float(np.percentile(seam, point))
        report[f"elsewhere_p{point}"] = float(np.percentile(other, point))
        low, high = np.percentile(drawn[:, index], (2.5, 97.5)).tolist()
        report[f"ratio_p{point}"] = found[index] | {"low": low, "high": high}
    as_far = int((null[:, -1] >= observed[-1]).sum())
    return report | {"ks": found[-1] | {"p": (1 + as_far) / (1 + n)}}


def measure(songs: Sequence[Values]) -> np.ndarray:
    """Ratios of the quantiles at `POINTS`, then the Kolmogorov–Smirnov distance, in one."""
    seam, other = split(songs)
    return np.append(_ratios(seam, other), distance(seam, other))


def distance(first: np.ndarray, second: np.ndarray) -> float:
    """Kolmogorov–Smirnov: the largest difference of the shares of two samples up to a value; NaN
    where a sample holds one."""
    first, second = np.sort(first), np.sort(second)
    both = np.concatenate((first, second))
    if np.isnan(both).any():
        return float("nan")
    one, other = (
        np.searchsorted(values, both, side="right") / len(values) for values in (first, second)
    )
    return float(np.abs(one - other).max())


def jumps(songs: Sequence[Seamed]) -> dict[str, Any]:
    """Extremes at seams and elsewhere, in the order (seam, elsewhere).

    Returns:
        phase_step_min, phase_step_max: bars a frame, relative to the song's median step;
        quaternion_dot_min: signed, of neighbours; position_step_max: metres a frame, relative to
        the song's 95th percentile; none: at seams no phase step runs backwards, none is twice the
        largest elsewhere, nor is a step of the position, and no sign flips.
    """
    rows = [_steps(song) for song in songs]
    found: dict[str, Any] = {}
    for name in ("phase_step_min", "phase_step_max", "quaternion_dot_min", "position_step_max"):
        step, _, end = name.rpartition("_")
        parts = split([(row[step], row["seam"]) for row in rows])
        found[name] = [float(part.min() if end == "min" else part.max()) for part in parts]
    largest = (found["phase_step_max"], found["position_step_max"])
    found["none"] = (
        found["phase_step_min"][0] >= -1e-4
        and all(at <= 2 * elsewhere for at, elsewhere in largest)
        and found["quaternion_dot_min"][0] > 0
    )
    return found


def _steps(song: Seamed) -> dict[str, np.ndarray]:
    """Steps [T-1] from each frame to the next, and whether they lie at a seam."""
    trajectory = song.trajectory
    phase = np.diff(trajectory.phase.astype(np.float64))
    phase -= np.round(phase)
    q = trajectory.quaternion.astype(np.float64)
    moved = np.linalg.norm(np.diff(trajectory.position.astype(np.float64), axis=0), axis=1)
    return {
        "phase_step": phase / max(float(np.median(phase)), 1e-9),
        "quaternion_dot": (q[1:] * q[:-1]).sum(1),
        "position_step": moved / max(float(np.percentile(moved, 95)), 1e-9),
        "seam": song.seam[:-1],
    }


def split(songs: Sequence[Values]) -> tuple[np.ndarray, np.ndarray]:
    """All values at seams, and all others."""
    return (
        np.concatenate([values[mask] for values, mask in songs]),
        np.concatenate([values[~mask] for values, mask in songs]),
    )


def _ratios(seam: np.ndarray, other: np.ndarray) -> np.ndarray:
    return np.asarray(np.percentile(seam, POINTS) / np.maximum(np.percentile(other, POINTS), 1e-12))
