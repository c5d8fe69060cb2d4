"""Is one model better than another? A paired bootstrap over what both were asked.

Letters: N prompts (or replications) that both were measured on, B resamples.
"""

from collections.abc import Sequence
from dataclasses import asdict, dataclass

import numpy as np

MIN_PAIRS = 2
CHUNK = 1000  # resamples at once


@dataclass(frozen=True)
class Difference:
    """b minus a with its 95% interval.

    Attributes:
        p: two-sided: how often resamples disagree with the sign, twice; at least 2 / (B + 1).
        count: pairs.
    """

    value: float
    low: float
    high: float
    p: float
    count: int

    def as_dict(self) -> dict[str, float | int]:
        """Plain numbers for a JSON report."""
        return asdict(self)


def paired_bootstrap(
    a: Sequence[float] | np.ndarray,
    b: Sequence[float] | np.ndarray,
    *,
    seed: int = 0,
    num: int = 10_000,
) -> Difference:
    """Mean of b - a over pairs with its percentile interval (Efron & Tibshirani 1993, §13.3, §16).

    Pairs are drawn with replacement, so that what makes a prompt hard for both counts for neither.
    A pair with a NaN is left out.

    Args:
        a, b: [N], entry i of each belongs together.
        num: resamples B.

    Raises:
        ValueError: different lengths, or fewer than two pairs.
    """
    left, right = np.asarray(a, dtype=np.float64), np.asarray(b, dtype=np.float64)
    if left.shape != right.shape or left.ndim != 1:
        raise ValueError(f"pairs must be aligned, got {left.shape} and {right.shape}")
    difference = right - left
    difference = difference[~np.isnan(difference)]
    if len(difference) < MIN_PAIRS:
        raise ValueError(f"{len(difference)} pairs are too few for an interval")
    means = _resampled_means(difference, np.random.default_rng(seed), num)
    low, high = np.percentile(means, [2.5, 97.5])
    beyond = min((means <= 0).sum(), (means >= 0).sum())
    p = min(1.0, 2 * (1 + int(beyond)) / (1 + num))
    return Difference(float(difference.mean()), float(low), float(high), p, len(difference))


def _resampled_means(values: np.ndarray, rng: np.random.Generator, num: int) -> np.ndarray:
    """Means [B] of resamples of values [N]."""
    means = np.empty(num)
    for start in range(0, num, CHUNK):
        size = min(CHUNK, num - start)
        rows = rng.integers(0, len(values), (size, len(values)))
        means[start : start + size] = values[rows].mean(1)
    return means
