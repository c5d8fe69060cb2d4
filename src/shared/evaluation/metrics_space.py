"""Retrieval across a shared space: R@1, 5, 10 and median rank in batches of one size.

Letters: M items of a batch, Q queries, D embed dim.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np

from src.shared.evaluation.intervals import Estimate

BATCH = 32
TOP = (1, 5, 10)
RESAMPLES = 500


@dataclass(frozen=True)
class Ranks:
    """Where each query found its own: `better` [Q] items above it, `tied` [Q] others level."""

    better: np.ndarray
    tied: np.ndarray

    def recall(self, k: int) -> np.ndarray:
        """Chance [Q] to be among the first k, equal similarities in any order."""
        return np.clip((k - self.better) / (self.tied + 1), 0.0, 1.0)

    @property
    def rank(self) -> np.ndarray:
        """Mean place [Q] over all orders of the ties, counted from 1."""
        return self.better + 1 + self.tied / 2


def ranks(query: np.ndarray, items: np.ndarray, kin: np.ndarray) -> Ranks:
    """Rank of item i for query i.

    Args:
        query, items: [M, D] unit-norm; row i belongs together.
        kin: [M, M] bool, items that are neither right nor wrong for a query (same song, say) and
            are taken out of its list; what it says of the diagonal does not matter.
    """
    similarity = query.astype(np.float64) @ items.astype(np.float64).T  # M M
    own = np.diag(similarity)[:, None]
    wrong = ~(kin | np.eye(len(kin), dtype=bool))
    better = ((similarity > own) & wrong).sum(1)
    return Ranks(better, ((similarity == own) & wrong).sum(1))


def by_song(
    values: np.ndarray,
    songs: Sequence[str],
    statistic: Callable[[np.ndarray], float],
    *,
    seed: int = 0,
) -> Estimate:
    """A figure of queries with a bootstrap interval over songs.

    Queries of one song are not independent, so whole songs are drawn again (Field and Welsh 2007,
    cluster bootstrap). `count` is the number of songs.

    Args:
        values: [Q].
        songs: of each query.
        statistic: mean, or median.
        seed: of the resampling.
    """
    names, owner = np.unique(np.asarray(songs), return_inverse=True)
    groups = [values[owner == number] for number in range(len(names))]
    rng = np.random.default_rng(seed)
    drawn = rng.integers(0, len(groups), (RESAMPLES, len(groups)))
    found = [statistic(np.concatenate([groups[g] for g in row])) for row in drawn]
    low, high = np.percentile(found, [2.5, 97.5])
    return Estimate(float(statistic(values)), float(low), float(high), len(groups))


def retrieval_figures(
    found: Sequence[Ranks], songs: Sequence[str], *, seed: int = 0
) -> dict[str, Estimate]:
    """`r_at_1`, `r_at_5`, `r_at_10` (fractions) and `median_rank` over all batches.

    Args:
        found: of each batch.
        songs: of each query, batch after batch.
        seed: of the resampling.
    """
    figures = {
        f"r_at_{k}": by_song(
            np.concatenate([part.recall(k) for part in found]), songs, np.mean, seed=seed
        )
        for k in TOP
    }
    places = np.concatenate([part.rank for part in found])
    return figures | {"median_rank": by_song(places, songs, np.median, seed=seed)}
