"""Retrieval between texts and motions: R-precision and matching distance (Guo et al. 2022).

Letters: N pairs, D embedding channels, M pairs in one batch (32 in the protocol).
"""

from collections.abc import Sequence
from dataclasses import dataclass, field

import numpy as np
from scipy.special import gammaln

BATCH = 32
TOP = (1, 2, 3)


@dataclass(frozen=True)
class Retrieval:
    """R-precision at 1, 2, 3 (fractions) and the mean distance of matching pairs.

    Attributes:
        hits: chance of a right answer at 1, 2, 3 [3, Q], text by text in any order.
    """

    r_precision: tuple[float, float, float]
    matching_distance: float
    num_batches: int
    hits: np.ndarray = field(compare=False, repr=False)


@dataclass(frozen=True, eq=False)
class Ranks:
    """Where the best right answer of each of Q queries stands, equal distances in any order.

    Attributes:
        better: candidates nearer than it [Q].
        right: right answers at exactly its distance, itself included [Q]; 0 = there is none at all.
        wrong: wrong answers at exactly its distance [Q].
    """

    better: np.ndarray
    right: np.ndarray
    wrong: np.ndarray

    def hits(self, k: int) -> np.ndarray:
        """Chance [Q] of a right answer among the k nearest: hypergeometric over the ties."""
        places = k - self.better
        misses = np.clip(places, 0, self.wrong)  # places that wrong answers may fill
        log_miss = (
            gammaln(self.wrong + 1)
            - gammaln(self.wrong - misses + 1)
            - gammaln(self.wrong + self.right + 1)
            + gammaln(self.wrong + self.right - misses + 1)
        )
        none = (places <= 0) | (self.right == 0)
        return np.where(none, 0.0, np.where(places > self.wrong, 1.0, -np.expm1(log_miss)))

    def mean(self) -> np.ndarray:
        """Mean rank [Q] of the best right answer over all orders of the ties; 1 is the first."""
        return self.better + 1 + self.wrong / (self.right + 1)


def best_ranks(distances: np.ndarray, relevant: np.ndarray) -> Ranks:
    """Rank the best right answer of each query.

    Args:
        distances: [Q, M] of each query to each candidate; infinity takes one out of the list.
        relevant: [Q, M] bool, the candidates that count as right; a query without any never hits.
    """
    best = np.where(relevant, distances, np.inf).min(1, keepdims=True)
    tied = distances == best
    return Ranks((distances < best).sum(1), (tied & relevant).sum(1), (tied & ~relevant).sum(1))


def hit_probability(distances: np.ndarray, relevant: np.ndarray, k: int) -> float:
    """Chance that one of the relevant items [M] is among the k nearest of distances [M]."""
    return float(best_ranks(distances[None], relevant[None]).hits(k)[0])


def pair_distances(text: np.ndarray, motion: np.ndarray) -> np.ndarray:
    """Euclidean distances [M, M] of texts [M, D] (rows) to motions [M, D] (columns)."""
    difference = text[:, None].astype(np.float64) - motion[None].astype(np.float64)
    return np.sqrt((difference**2).sum(-1))


def guo_retrieval(
    text: np.ndarray,
    motion: np.ndarray,
    equal_by: Sequence[Sequence[object]],
    *,
    batch: int = BATCH,
    seed: int = 0,
) -> Retrieval:
    """R-precision in random batches of 32: each text ranks the motions of its batch.

    A motion also counts as right when it shares the text's value in one of the columns of
    `equal_by` (label group, caption), because that caption fits it just as well. Several right
    answers in a batch make guessing easier; the chance row is computed by the same rule. The last,
    incomplete batch is left out, as in the protocol.

    Args:
        text, motion: [N, D], row i belongs together.
        equal_by: columns of N values each; none: only row i is right for text i.

    Raises:
        ValueError: fewer pairs than one batch, shapes that differ, or values that are not finite.
    """
    if text.shape != motion.shape or any(len(column) != len(text) for column in equal_by):
        sizes = [len(column) for column in equal_by]
        raise ValueError(
            f"texts {text.shape}, motions {motion.shape} and labels {sizes} must be aligned"
        )
    if len(text) < batch:
        raise ValueError(f"{len(text)} pairs are fewer than one batch of {batch}: add samples")
    if not (np.isfinite(text).all() and np.isfinite(motion).all()):
        raise ValueError("embeddings hold NaN or infinity: look at the motions they came from")
    columns = [np.unique([str(v) for v in c], return_inverse=True)[1] for c in equal_by]
    columns.append(np.arange(len(text)))
    order = np.random.default_rng(seed).permutation(len(text))
    num_batches = len(text) // batch
    hits: list[list[np.ndarray]] = []
    matching = 0.0
    for rows in order[: num_batches * batch].reshape(num_batches, batch):
        distances = pair_distances(text[rows], motion[rows])
        relevant = np.any([ids[rows][:, None] == ids[rows][None] for ids in columns], axis=0)
        ranks = best_ranks(distances, relevant)
        hits.append([ranks.hits(k) for k in TOP])
        matching += float(np.diag(distances).sum())
    found = np.concatenate(hits, axis=1)
    at_1, at_2, at_3 = found.mean(1).tolist()
    return Retrieval((at_1, at_2, at_3), matching / found.shape[1], num_batches, found)


def normalised_score(generated: float, chance: float, real: float) -> float:
    """(generated - chance) / (real - chance): 0 at chance, 1 at real motion; NaN without a gap."""
    gap = real - chance
    return (generated - chance) / gap if gap > 1e-9 else float("nan")
