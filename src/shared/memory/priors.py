"""Prior curves: energy, density, tension and stability of a motion, frame by frame (REF).

Each is a measure x of the pelvis, averaged over time, on the fixed scale x / (x + x₀): 0 where
nothing happens, 0.5 at x₀, which is near the median of real walking, running and dancing. The
scale does not depend on the clip, so that clips compare.

| row | name      | measure x                                                     | x₀        |
|-----|-----------|---------------------------------------------------------------|-----------|
| 0   | energy    | speed                                                         | 0.8 m/s   |
| 1   | density   | motion beats a second; with a song, the mean with its onsets  | 2 1/s     |
| 2   | tension   | size of the jerk                                              | 60 m/s³   |
| 3   | stability | 1 - that of sway, the speed around its own average; with      | 0.3 m/s   |
|     |           | contacts, the mean with the share of time on a foot           |           |

T frames at 30 fps.
"""

import numpy as np
from scipy.signal import find_peaks

from ..metrics.rhythm import motion_beats
from ..motion.filters import smoothed
from ..motion.trajectory import ACCELERATION, FPS, POSITION, VELOCITY

NUM_PRIORS = 4
ENERGY, DENSITY, TENSION, STABILITY = range(NUM_PRIORS)
HALF = (0.8, 2.0, 60.0, 0.3)  # x₀ of each row

FAST, SLOW = 0.15, 0.5  # seconds, standard deviation of the averages
MIN_ONSET = 0.1  # of the loudest onset's strength


def prior_curves(
    trajectory: np.ndarray, *, onsets: np.ndarray | None = None, contacts: np.ndarray | None = None
) -> np.ndarray:
    """Rows ENERGY, DENSITY, TENSION, STABILITY [4,T] float32 in [0,1].

    Args:
        trajectory: [T,25].
        onsets: onset strength [T] of the song, 0 to 1.
        contacts: left and right foot on the ground [T,2], 0 to 1.
    """
    data = np.asarray(trajectory, np.float64)
    velocity, acceleration = data[:, VELOCITY], data[:, ACCELERATION]
    speed = np.linalg.norm(velocity, axis=1)
    jerk = np.linalg.norm(np.diff(acceleration, axis=0, append=acceleration[-1:]), axis=1) * FPS
    sway = np.square(velocity - _average(velocity, SLOW)).sum(axis=1)

    energy = _level(_average(speed, FAST), HALF[ENERGY])
    beats = motion_beats(data[:, POSITION], FPS).times * FPS
    density = _level(_rate(beats, len(data)), HALF[DENSITY])
    if onsets is not None:
        peaks, _ = find_peaks(np.asarray(onsets, np.float64), prominence=MIN_ONSET)
        density = (density + _level(_rate(peaks, len(data)), HALF[DENSITY])) / 2
    tension = _level(_average(jerk, FAST), HALF[TENSION])
    stability = 1 - _level(np.sqrt(_average(sway, SLOW)), HALF[STABILITY])
    if contacts is not None:
        on_foot = np.clip(np.asarray(contacts, np.float64).max(axis=1), 0, 1)
        stability = (stability + _average(on_foot, FAST)) / 2
    return np.asarray(
        np.clip(np.stack([energy, density, tension, stability]), 0, 1).astype(np.float32)
    )


def _level(measure: np.ndarray, half: float) -> np.ndarray:
    return measure / (measure + half)


def _average(values: np.ndarray, seconds: float) -> np.ndarray:
    """Gaussian average over time of [T] or [T,C]; the ends are held."""
    return smoothed(values, seconds * FPS)


def _rate(frames: np.ndarray, num_frames: int) -> np.ndarray:
    """Events a second [T] around each frame, given at (fractional) frames."""
    counts = np.bincount(np.rint(frames).astype(int), minlength=num_frames)[:num_frames]
    return _average(counts.astype(np.float64) * FPS, SLOW)
