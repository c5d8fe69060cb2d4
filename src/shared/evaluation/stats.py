"""Confidence intervals: over replications, by bootstrap, for success rates, and of differences.

Letters: N observations (prompts, motions or replications), B resamples.
"""

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np

Z95 = 1.959963984540054  # 97.5% quantile of the standard normal
FEW = 8  # observations below which a percentile bootstrap is too sure of itself
MIN_PAIRS = 2
RESAMPLES = 1000  # of a mean
CHUNK = 1000  # resamples at once


@dataclass(frozen=True)
class Estimate:
    """A value with its 95% interval and how many observations stand behind it."""

    value: float
    low: float
    high: float
    count: int


@dataclass(frozen=True)
class Difference(Estimate):
    """b minus a over `count` pairs."""

    p: float  # two-sided: how often resamples disagree with the sign, twice; at least 2 / (B + 1)


NOTHING = Estimate(math.nan, math.nan, math.nan, 0)


def replicated(values: Sequence[float]) -> Estimate:
    """Mean of replications with 1.96 sigma / sqrt(n) (Guo et al. 2022); one value has no width."""
    data = np.asarray(values, dtype=np.float64)
    mean = float(data.mean())
    half = Z95 * float(data.std(ddof=1)) / math.sqrt(len(data)) if len(data) > 1 else 0.0
    return Estimate(mean, mean - half, mean + half, len(data))


def bootstrap_mean(values: Sequence[float] | np.ndarray) -> Estimate:
    """Mean with its percentile bootstrap interval (Efron 1979); NaN entries are left out."""
    data = _known(values)
    if not len(data):
        return NOTHING
    low, high = np.percentile(_resampled_means(data, 0, RESAMPLES), [2.5, 97.5]).tolist()
    return Estimate(float(data.mean()), low, high, len(data))


def bootstrap_columns(rows: Sequence[Mapping[str, float]]) -> dict[str, Estimate]:
    """`bootstrap_mean` of each column of N rows that all have the same ones."""
    return {key: bootstrap_mean([row[key] for row in rows]) for key in (rows[0] if rows else ())}


def success_rate(successes: int, trials: int) -> Estimate:
    """A proportion with its Wilson (1927) interval, which stays in 0..1 at 0 of n and n of n."""
    if trials == 0:
        return NOTHING
    rate = successes / trials
    scale = 1 + Z95**2 / trials
    centre = (rate + Z95**2 / (2 * trials)) / scale
    half = Z95 / scale * math.sqrt(rate * (1 - rate) / trials + Z95**2 / (4 * trials**2))
    return Estimate(rate, max(centre - half, 0.0), min(centre + half, 1.0), trials)


def share_of(answers: Sequence[bool] | Sequence[float] | np.ndarray) -> Estimate:
    """`success_rate` of yes or no (1 or 0) each; NaN entries are left out."""
    known = _known(answers)
    return success_rate(int(known.sum()), len(known))


def paired_bootstrap(
    a: Sequence[float] | np.ndarray,
    b: Sequence[float] | np.ndarray,
    *,
    seed: int = 0,
    num: int = 10_000,
) -> Difference:
    """Mean of b - a over pairs with its percentile interval (Efron & Tibshirani 1993, §13.3, §16).

    Of pairs a[i], b[i] without a NaN, drawn with replacement `num` times (B), so that what makes a
    prompt hard for both counts for neither.
    Raises ValueError: different lengths, or fewer than two pairs."""
    left, right = np.asarray(a, dtype=np.float64), np.asarray(b, dtype=np.float64)
    if left.shape != right.shape or left.ndim != 1:
        raise ValueError(f"pairs must be aligned, got {left.shape} and {right.shape}")
    difference = _known(right - left)
    if len(difference) < MIN_PAIRS:
        raise ValueError(f"{len(difference)} pairs are too few for an interval")
    means = _resampled_means(difference, seed, num)
    low, high = np.percentile(means, [2.5, 97.5]).tolist()
    beyond = min((means <= 0).sum(), (means >= 0).sum())
    p = min(1.0, 2 * (1 + int(beyond)) / (1 + num))
    return Difference(float(difference.mean()), low, high, len(difference), p)


def _known(values: Sequence[float] | np.ndarray) -> np.ndarray:
    """Those [N] that are not NaN."""
    data = np.asarray(values, dtype=np.float64)
    return np.asarray(data[~np.isnan(data)])


def _resampled_means(values: np.ndarray, seed: int, num: int) -> np.ndarray:
    """Means [B] of resamples of values [N]."""
    rng = np.random.default_rng(seed)
    sizes = [min(CHUNK, num - start) for start in range(0, num, CHUNK)]
    return np.concatenate(
        [values[rng.integers(0, len(values), (size, len(values)))].mean(1) for size in sizes]
    )
