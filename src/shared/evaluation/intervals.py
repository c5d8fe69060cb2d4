"""Confidence intervals: over replications, by bootstrap, and for success rates."""

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

Z95 = 1.959963984540054  # 97.5% quantile of the standard normal
FEW = 8  # observations below which a percentile bootstrap is too sure of itself


@dataclass(frozen=True)
class Estimate:
    """A value with its 95% interval and how many observations stand behind it."""

    value: float
    low: float
    high: float
    count: int

    def as_dict(self) -> dict[str, float | int]:
        """Plain numbers for a JSON report."""
        return {"value": self.value, "low": self.low, "high": self.high, "count": self.count}


def replicated(values: Sequence[float]) -> Estimate:
    """Mean of replications with 1.96 sigma / sqrt(n) (Guo et al. 2022); one value has no width."""
    data = np.asarray(values, dtype=np.float64)
    mean = float(data.mean())
    half = Z95 * float(data.std(ddof=1)) / math.sqrt(len(data)) if len(data) > 1 else 0.0
    return Estimate(mean, mean - half, mean + half, len(data))


def bootstrap_mean(
    values: Sequence[float], *, num_resamples: int = 1000, seed: int = 0
) -> Estimate:
    """Mean with its percentile bootstrap interval (Efron 1979); NaN entries are left out."""
    data = np.asarray(values, dtype=np.float64)
    data = data[~np.isnan(data)]
    if not len(data):
        return Estimate(math.nan, math.nan, math.nan, 0)
    rows = np.random.default_rng(seed).integers(0, len(data), (num_resamples, len(data)))
    low, high = np.percentile(data[rows].mean(1), [2.5, 97.5])
    return Estimate(float(data.mean()), float(low), float(high), len(data))


def success_rate(successes: int, trials: int) -> Estimate:
    """A proportion with its Wilson (1927) interval, which stays in 0..1 at 0 of n and n of n."""
    if trials == 0:
        return Estimate(math.nan, math.nan, math.nan, 0)
    rate = successes / trials
    scale = 1 + Z95**2 / trials
    centre = (rate + Z95**2 / (2 * trials)) / scale
    half = Z95 / scale * math.sqrt(rate * (1 - rate) / trials + Z95**2 / (4 * trials**2))
    return Estimate(rate, max(centre - half, 0.0), min(centre + half, 1.0), trials)
