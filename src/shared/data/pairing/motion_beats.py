"""Motion beats: where a body slows down, and how well such moments fall on the music's beats.

A motion beat is a prominent minimum of the smoothed speed, the kinematic beat of Li et al. 2021
("AI Choreographer", §5.2). Alignment uses σ in seconds and both directions, each with the level
that the same beats reach by chance.
"""

from dataclasses import dataclass

import numpy as np
from scipy.ndimage import gaussian_filter1d
from scipy.signal import find_peaks

SMOOTHING = 0.05  # seconds, standard deviation of the Gaussian
PROMINENCE = 0.15  # of the 5-95% spread of the speed around its trend
TREND = 0.5  # seconds, standard deviation; walking and running in one phrase are no beat
MIN_PROMINENCE = 0.04  # m/s; a slow drift has no beats
MIN_INTERVAL = 0.2  # seconds between two beats
SIGMA = 0.05  # seconds, of the alignment


@dataclass(frozen=True, eq=False)
class MotionBeats:
    """Beats of one motion.

    Attributes:
        times: seconds [N], increasing.
        speed: smoothed speed [T-1] in m/s they were found in; value t lies at (t + ½) / fps.
    """

    times: np.ndarray
    speed: np.ndarray

    @property
    def period(self) -> float:
        """Median interval in seconds; infinite below three beats."""
        return float(np.median(np.diff(self.times))) if len(self.times) > 2 else float("inf")

    @property
    def irregularity(self) -> float:
        """Spread of the intervals over their mean; infinite below three beats."""
        if len(self.times) < 3:
            return float("inf")
        intervals = np.diff(self.times)
        return float(intervals.std() / intervals.mean())


def smoothed_speed(points: np.ndarray, fps: float) -> np.ndarray:
    """Speed [T-1] in m/s of one point [T,3], or the mean over many [T,J,3]."""
    step = np.linalg.norm(np.diff(points.astype(np.float64), axis=0), axis=-1) * fps
    speed = step if step.ndim == 1 else step.mean(1)
    return np.asarray(gaussian_filter1d(speed, SMOOTHING * fps)) if len(speed) else speed


def motion_beats(points: np.ndarray, fps: float = 30.0) -> MotionBeats:
    """Beats of a pelvis path [T,3], or of a whole body's joints [T,J,3], in metres.

    The minimum is placed between frames by a parabola through its three samples.
    """
    speed = smoothed_speed(points, fps)
    if len(speed) < 3:
        return MotionBeats(np.zeros(0), speed)
    low, high = np.percentile(speed - gaussian_filter1d(speed, TREND * fps), (5, 95))
    found, _ = find_peaks(
        -speed,
        prominence=max(PROMINENCE * (high - low), MIN_PROMINENCE),
        distance=max(1, round(MIN_INTERVAL * fps)),
    )
    before, at, after = speed[found - 1], speed[found], speed[found + 1]
    curvature = before - 2 * at + after
    shift = np.where(curvature > 0, 0.5 * (before - after) / np.maximum(curvature, 1e-12), 0.0)
    return MotionBeats((found + 0.5 + np.clip(shift, -0.5, 0.5)) / fps, speed)


def distances(beats: np.ndarray, others: np.ndarray) -> np.ndarray:
    """Seconds [N] from each of `beats` [N] to the nearest of `others` [M], sorted, M ≥ 1."""
    right = np.clip(np.searchsorted(others, beats), 1, max(1, len(others) - 1))
    left = others[right - 1]
    return np.minimum(
        np.abs(beats - left), np.abs(others[np.minimum(right, len(others) - 1)] - beats)
    )


def beat_alignment(beats: np.ndarray, others: np.ndarray, sigma: float = SIGMA) -> float:
    """Mean over `beats` of exp(-d²/2σ²), d the distance to the nearest of `others`.

    NaN without `beats`, 0 without `others`.
    """
    if not len(beats):
        return float("nan")
    if not len(others):
        return 0.0
    return float(np.exp(-(distances(beats, others) ** 2) / (2 * sigma**2)).mean())


@dataclass(frozen=True)
class Alignment:
    """Both directions of beat alignment, in [0, 1]."""

    motion_to_music: float
    music_to_motion: float


def alignment(motion: np.ndarray, music: np.ndarray, seconds: float) -> Alignment:
    """How the motion's beats and the music's fall on each other within [0, seconds].

    Beats beyond the ends count as neighbours, never as beats of their own.
    """
    inside = motion[(motion >= 0) & (motion < seconds)]
    heard = music[(music >= 0) & (music < seconds)]
    return Alignment(beat_alignment(inside, music), beat_alignment(heard, motion))


def chance_alignment(
    motion: np.ndarray, music: np.ndarray, seconds: float, rng: np.random.Generator, *, n: int = 16
) -> Alignment:
    """What the same motion reaches when its beats are moved by a random time, mean of `n`.

    The motion is turned round within the phrase, so that number and spacing of beats stay.
    """
    draws = [
        alignment(np.sort((motion + shift) % seconds), music, seconds)
        for shift in (np.arange(n) + rng.random(n)) * (seconds / n)
    ]
    return Alignment(
        float(np.mean([draw.motion_to_music for draw in draws])),
        float(np.mean([draw.music_to_motion for draw in draws])),
    )
