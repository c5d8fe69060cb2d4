"""Retrieval across a shared space: R@1, 5, 10 and median rank in batches of one size.

The ranks are those of the text branch; what is taken out of a list is infinitely far.

Letters: M items of a batch, Q queries, D embed dim.
"""

from collections.abc import Callable, Sequence

import numpy as np

from ..metrics.retrieval import Ranks, best_ranks
from .stats import Estimate

TOP = (1, 5, 10)
RESAMPLES = 500


def ranks(query: np.ndarray, items: np.ndarray, kin: np.ndarray) -> Ranks:
    """Rank of item i for query i, by cosine.

    Args:
        query, items: [M, D] unit-norm; row i belongs together.
        kin: [M, M] bool, items that are neither right nor wrong for a query (same song, say) and
            are taken out of its list; what it says of the diagonal does not matter.
    """
    own = np.eye(len(kin), dtype=bool)
    similarity = query.astype(np.float64) @ items.astype(np.float64).T  # M M
    return best_ranks(np.where(kin & ~own, np.inf, -similarity), own)


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
            np.concatenate([part.hits(k) for part in found]), songs, np.mean, seed=seed
        )
        for k in TOP
    }
    places = np.concatenate([part.mean() for part in found])
    return figures | {"median_rank": by_song(places, songs, np.median, seed=seed)}
