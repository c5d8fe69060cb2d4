"""Time warps that bring motion beats onto music beats without changing speed by more than a share.

Two steps. `match_beats` decides which motion beat meets which music beat (dynamic programming).
`fit_warp` finds the smoothest playback rate that meets them: rates at evenly spaced knots, linear
between them, each within [1-limit, 1+limit]. The warp is their integral, so it is C1, monotone
and keeps its bound everywhere, not only on average.
"""

from dataclasses import dataclass

import numpy as np
import torch
from scipy.interpolate import CubicSpline
from scipy.optimize import lsq_linear

from ...motion.rotations import quaternion_continuous, quaternion_slerp

LIMIT = 0.15
MATCH_LIMIT = 0.13  # between two matches; the rest of the limit lets the rate change smoothly
KNOT_SECONDS = 0.2
LOOK_BACK = 6  # motion beats; so many less one may stay unmatched in a row
GRID_LOOK_BACK = 12  # music beats
SKIP_COST = 0.5  # per motion beat left unmatched
STRETCH_COST = 20.0  # per squared log rate and match
RATE_DIGITS = 5  # what the manifest stores is what was used

Pair = tuple[int, int]


def match_beats(motion: np.ndarray, grid: np.ndarray, seconds: float, lead: float) -> list[Pair]:
    """Pairs (motion beat, music beat) in order, each next one reachable at an allowed rate.

    Args:
        motion: motion beats [N] in seconds of the motion's own time.
        grid: music beats [K] in seconds of the phrase.
        seconds: length of the phrase.
        lead: seconds of motion that may be skipped before the phrase starts.

    Maximises matches minus `SKIP_COST` per motion beat between them left out minus
    `STRETCH_COST` times the squared logarithm of the rate between matches.
    """
    grid_index = np.flatnonzero((grid >= 0) & (grid < seconds))
    times = grid[grid_index]
    if not len(motion) or not len(times):
        return []
    score = np.full((len(motion), len(times)), -np.inf)
    parent = np.full((len(motion), len(times), 2), -1)
    for i, beat in enumerate(motion):
        # A chain may start here if the motion before it fills the phrase's beginning.
        earliest, latest = beat - times * (1 + MATCH_LIMIT), beat - times * (1 - MATCH_LIMIT)
        missed = i - np.searchsorted(motion[:i], beat - times)
        fits = (earliest <= lead) & (latest >= 0)
        score[i] = np.where(fits, 1 - SKIP_COST * missed, -np.inf)
        for back in range(1, min(LOOK_BACK, i) + 1):
            passed = beat - motion[i - back]
            for step in range(1, min(GRID_LOOK_BACK, len(times) - 1) + 1):
                rate = passed / (times[step:] - times[:-step])
                allowed = np.abs(rate - 1) <= MATCH_LIMIT
                gain = 1 - SKIP_COST * (back - 1) - STRETCH_COST * np.log(rate) ** 2
                value = np.where(allowed, score[i - back, :-step] + gain, -np.inf)
                better = value > score[i, step:]
                score[i, step:][better] = value[better]
                columns = np.flatnonzero(better) + step
                parent[i, columns, 0], parent[i, columns, 1] = i - back, columns - step
    i, k = (int(n) for n in np.unravel_index(int(score.argmax()), score.shape))
    pairs = []
    while i >= 0 and np.isfinite(score[i, k]):
        pairs.append((i, int(grid_index[k])))
        i, k = (int(n) for n in parent[i, k])
    return pairs[::-1]


@dataclass(frozen=True)
class Warp:
    """When of the motion is seen at which time of the phrase.

    Attributes:
        start: seconds of motion at the phrase's first frame.
        rates: playback rates at knots `KNOT_SECONDS` apart, 1 = as recorded, linear between.
    """

    start: float
    rates: tuple[float, ...]

    def times(self, at: np.ndarray) -> np.ndarray:
        """Seconds of motion [T] at phrase seconds `at` [T] ≥ 0."""
        return self.start + _integral(at, len(self.rates)) @ np.asarray(self.rates)

    def rate(self, at: np.ndarray) -> np.ndarray:
        """Playback rate [T] at phrase seconds `at` [T]."""
        knots = np.arange(len(self.rates)) * KNOT_SECONDS
        return np.asarray(np.interp(at, knots, self.rates))


def _integral(at: np.ndarray, num_knots: int) -> np.ndarray:
    """Weights [T,K] of knot rates in the integral over [0, at] of their linear interpolation."""
    x = np.clip(np.asarray(at, np.float64) / KNOT_SECONDS, 0, num_knots - 1)[:, None]
    left = np.clip(x - np.arange(num_knots - 1), 0, 1)  # share of each interval passed
    weights = np.zeros((len(x), num_knots))
    weights[:, :-1] += left - left**2 / 2
    weights[:, 1:] += left**2 / 2
    return weights * KNOT_SECONDS


def knots_for(seconds: float) -> int:
    """Number of knots that cover a phrase."""
    return int(np.ceil(seconds / KNOT_SECONDS - 1e-9)) + 1


def plain_warp(seconds: float, start: float = 0.0) -> Warp:
    """As recorded."""
    return Warp(start, (1.0,) * knots_for(seconds))


def fit_warp(
    motion: np.ndarray, music: np.ndarray, seconds: float, lead: float, *, limit: float = LIMIT
) -> Warp:
    """The smoothest warp that shows motion second `motion[n]` at phrase second `music[n]`.

    Bounded linear least squares in the knots' rates: hits within 10 ms weigh as much as a
    curvature of the rate of 0.05 per knot.

    Args:
        motion, music: matched seconds [N] each; none gives the plain warp.
        seconds: length of the phrase.
        lead: largest `start`.
        limit: rates stay within [1-limit, 1+limit].
    """
    if not len(motion):
        return plain_warp(seconds, lead / 2)
    k = knots_for(seconds)
    hits = np.concatenate((np.ones((len(music), 1)), _integral(music, k)), 1) / 0.01
    bend = np.zeros((max(k - 2, 0), k + 1))
    for row in range(len(bend)):
        bend[row, row + 1 : row + 4] = (1, -2, 1)
    stay = np.zeros((k, k + 1))
    stay[:, 1:] = np.eye(k)
    matrix = np.concatenate((hits, bend / 0.05, stay / 0.5))
    target = np.concatenate((motion / 0.01, np.zeros(len(bend)), np.full(k, 1 / 0.5)))
    low = np.array([0.0] + [1 - limit] * k)
    high = np.array([max(lead, 1e-6)] + [1 + limit] * k)
    solution = lsq_linear(matrix, target, (low, high)).x
    rates = np.clip(np.round(solution[1:], RATE_DIGITS), 1 - limit, 1 + limit)
    return Warp(round(float(solution[0]), RATE_DIGITS), tuple(float(rate) for rate in rates))


def resample(
    position: np.ndarray, quaternion: np.ndarray, times: np.ndarray, fps: float = 30.0
) -> tuple[np.ndarray, np.ndarray]:
    """A pelvis path [N,3] and its rotations [N,4] at other seconds [T]: cubic and slerp."""
    last = len(position) - 1
    moved = CubicSpline(np.arange(last + 1), position.astype(np.float64))(
        np.clip(times * fps, 0, last)
    )
    return moved.astype(np.float32), resample_rotations(quaternion, times, fps)


def resample_rotations(quaternion: np.ndarray, times: np.ndarray, fps: float = 30.0) -> np.ndarray:
    """Rotations [N,...,4] at other seconds [T], by slerp, without changes of sign: [T,...,4]."""
    last = len(quaternion) - 1
    frames = np.clip(times * fps, 0, last)
    before = np.minimum(frames.astype(int), last - 1)
    q = torch.as_tensor(quaternion, dtype=torch.float32)
    part = torch.as_tensor(frames - before, dtype=torch.float32)
    part = part.view(-1, *(1,) * (q.ndim - 1))
    return quaternion_continuous(quaternion_slerp(q[before], q[before + 1], part)).numpy()
