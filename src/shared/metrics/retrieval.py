"""Retrieval between texts and motions: R-precision as Guo measures it, recall as TMR does.

Guo et al. 2022: R-precision and matching distance in batches of 32, by Euclidean distance.
Petrovich et al. 2023, "TMR", §4.1, both directions, by cosine: (a) all pairs; (b) all pairs, where
a text that says nearly the same also counts; (c) a subset of texts far from each other; (d) batches
of 32. Equal distances are averaged over all their orders, exactly: embeddings that all fall on one
point score what guessing does, not 0 and not 1.

Letters: N pairs, D embedding channels, M pairs in one batch, Q queries.
"""

import re
import unicodedata
import zlib
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from itertools import pairwise

import numpy as np
from scipy.spatial.distance import cdist
from scipy.special import gammaln
from scipy.stats import rankdata

from .frechet import finite

BATCH = 32
TOP = (1, 2, 3)
Seed = int | Sequence[int] | np.random.Generator


@dataclass(frozen=True, eq=False)
class Ranks:
    """Where the best right answer of each of Q queries stands, equal distances in any order."""

    better: np.ndarray  # candidates nearer than it [Q]
    # right answers at exactly its distance, itself included [Q]; 0 = there is none at all
    right: np.ndarray
    wrong: np.ndarray  # wrong answers at exactly its distance [Q]

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
        return np.asarray(self.better + 1 + self.wrong / (self.right + 1))


def best_ranks(distances: np.ndarray, relevant: np.ndarray) -> Ranks:
    """Rank the best right answer of each query by its distances [Q, M] to all candidates; infinity
    takes one out of the list. `relevant` [Q, M] bool are right; without any, a query never hits."""
    best = np.where(relevant, distances, np.inf).min(1, keepdims=True)
    tied = distances == best
    return Ranks((distances < best).sum(1), (tied & relevant).sum(1), (tied & ~relevant).sum(1))


def rank_of(distances: np.ndarray, column: int) -> np.ndarray:
    """How many columns [N] of distances [N,P] are nearer than this one; ties count half."""
    return np.asarray(rankdata(distances, axis=1)[:, column] - 1)


def guo_retrieval(
    text: np.ndarray, motion: np.ndarray, equal_by: Sequence[Sequence[object]], *, seed: int = 0
) -> np.ndarray:
    """R-precision in random batches of 32, without an incomplete last one: each text ranks the
    motions of its batch.

    Args:
        text, motion: [N, D], row i belongs together.
        equal_by: columns of N values (label group, caption); a motion that shares one of them with
            the text is right, too, since that caption fits it as well. The chance row has the same
            rule, as several right answers make guessing easier.

    Returns:
        Chance of a right answer at 1, 2, 3 [3, Q], text by text in any order; their mean is the
        R-precision.

    Raises ValueError: fewer pairs than one batch, shapes that differ, or values not finite.
    """
    if text.shape != motion.shape or any(len(column) != len(text) for column in equal_by):
        sizes = [len(column) for column in equal_by]
        raise ValueError(
            f"texts {text.shape}, motions {motion.shape} and labels {sizes} must be aligned"
        )
    if len(text) < BATCH:
        raise ValueError(f"{len(text)} pairs are fewer than one batch of {BATCH}: add samples")
    found = in_batches(finite(text), finite(motion), equal_by, seed)
    return np.concatenate([hits for _, hits in found], axis=1)


def in_batches(
    text: np.ndarray, motion: np.ndarray, equal_by: Sequence[Sequence[object]], seed: Seed
) -> Iterator[tuple[np.ndarray, np.ndarray]]:
    """Rows [32] of each random batch, and what `guo_retrieval` says of them [3, 32]."""
    columns = [np.unique([str(v) for v in c], return_inverse=True)[1] for c in equal_by]
    columns.append(np.arange(len(text)))
    for rows in batches(len(text), BATCH, seed):
        relevant = np.any([ids[rows][:, None] == ids[rows][None] for ids in columns], axis=0)
        ranks = best_ranks(cdist(text[rows], motion[rows]), relevant)
        yield rows, np.stack([ranks.hits(k) for k in TOP])


def batches(number: int, size: int, seed: Seed) -> np.ndarray:
    """Rows [B, size] in a random order; an incomplete last batch is left out."""
    order = np.random.default_rng(seed).permutation(number)
    return order[: number // size * size].reshape(-1, size)


def normalised_score(generated: float, chance: float, real: float) -> float:
    """(generated - chance) / (real - chance): 0 at chance, 1 at real motion; NaN without a gap."""
    gap = real - chance
    return (generated - chance) / gap if gap > 1e-9 else float("nan")


# ---------------------------------------------------------------- texts as bags of n-grams

NUM_BUCKETS = 8192
STEM = 4  # characters of a word beginning
_WORD = re.compile(r"[^\W_]+")
_CJK = re.compile(r"[\u3040-\u30ff\u3400-\u9fff\uf900-\ufaff]+")


def _n_grams(text: str) -> Iterator[str]:
    plain = unicodedata.normalize("NFKC", text).lower()
    for run in _CJK.findall(plain):
        for size in (1, 2, 3):
            yield from (f"c{run[i : i + size]}" for i in range(len(run) - size + 1))
    words = _WORD.findall(_CJK.sub(" ", plain))
    yield from (f"w{word}" for word in words)
    yield from (f"s{word[:STEM]}" for word in words if len(word) > STEM)
    yield from (f"p{a} {b}" for a, b in pairwise(words))


def caption_buckets(text: str, num_buckets: int = NUM_BUCKETS) -> list[int]:
    """Buckets of a caption's n-grams, the same on every machine; bucket 0 when it has none.

    Words and word pairs for languages with spaces, runs of one to three characters for Japanese and
    Chinese, and word beginnings, which join the inflected forms of one stem.
    """
    return [zlib.crc32(piece.encode()) % num_buckets for piece in _n_grams(text)] or [0]


# ---------------------------------------------------------------- TMR's protocols

RECALL_AT = (1, 2, 3, 5, 10)
THRESHOLD = 0.95  # of (1 + cosine) / 2 of two texts, as in TMR
POOL = 256  # candidates of protocols (a) and (b) in the tables, whose rows differ in N
SUBSET = 100  # pairs of the dissimilar subset
PROTOCOLS = ("all", "threshold", "dissimilar", "batches")


def cosines(text: np.ndarray, motion: np.ndarray) -> np.ndarray:
    """Cosines [N, N] of texts (rows) and motions (columns) [N, D], float64.

    Equal rows are multiplied once: a matrix product may round two copies differently, and break
    their tie.
    Raises ValueError: shapes that differ, NaN or infinity, or a vector of length 0."""
    if text.ndim != 2 or text.shape != motion.shape:
        raise ValueError(f"texts {text.shape} and motions {motion.shape} must be aligned [N, D]")
    rows, row = np.unique(_unit(text), axis=0, return_inverse=True)
    columns, column = np.unique(_unit(motion), axis=0, return_inverse=True)
    return np.asarray((rows @ columns.T)[row.reshape(-1)][:, column.reshape(-1)])


def _unit(vectors: np.ndarray) -> np.ndarray:
    values = finite(vectors)
    length = np.linalg.norm(values, axis=1, keepdims=True)
    if not length.all():
        raise ValueError("an embedding of length 0 has no direction to compare")
    return np.asarray(values / length)


def text_similarity(captions: Sequence[str], groups: Sequence[str] | None = None) -> np.ndarray:
    """(1 + cosine) / 2 [N, N] of the captions' bags of n-grams; 1 inside a label group, whose
    captions are translations of the same labels.

    Hashed words, word pairs and stems in place of TMR's sentence encoder (MPNet): no judged model
    has a hand in them, and one that calls all texts alike would make every answer right.
    """
    different, row = np.unique(list(captions), return_inverse=True)
    buckets = [caption_buckets(str(caption)) for caption in different]
    known = np.unique(np.concatenate(buckets))
    bags = np.zeros((len(different), len(known)))
    for bag, found in zip(bags, buckets, strict=True):
        np.add.at(bag, np.searchsorted(known, found), 1.0)
    similarity = ((1 + cosines(bags, bags)) / 2)[row][:, row]
    if groups is not None:
        ids = np.unique(list(groups), return_inverse=True)[1]
        similarity[ids[:, None] == ids[None]] = 1.0
    return similarity


def dissimilar_subset(similarity: np.ndarray, size: int = SUBSET, *, seed: int = 0) -> np.ndarray:
    """Rows [at most `size`], ascending, of texts far from each other; similarity [N, N].

    Of texts that are more similar than `THRESHOLD` a random one stays, so captions from few
    templates make a smaller subset. TMR approximates a quadratic knapsack; here the text most
    similar to all that are left goes, one after the other, and then texts are exchanged as long as
    that lowers the sum of the similarities.
    """
    unlike: list[int] = []
    for row in np.random.default_rng(seed).permutation(len(similarity)).tolist():
        if not (similarity[row, unlike] > THRESHOLD).any():
            unlike.append(row)
    rows = np.sort(unlike)
    return np.asarray(rows[_farthest(similarity[np.ix_(rows, rows)], size)])


def _farthest(similarity: np.ndarray, size: int) -> np.ndarray:
    """Rows [min(size, N)], ascending, with a small sum of similarities [N, N]."""
    kept = np.ones(len(similarity), dtype=bool)
    others = similarity - np.diag(np.diag(similarity))
    total = others.sum(1)  # similarity to all that are kept
    for _ in range(len(similarity) - size):
        worst = int(np.where(kept, total, -np.inf).argmax())
        kept[worst] = False
        total -= others[worst]
    while 0 < kept.sum() < len(kept):
        inside, outside = np.flatnonzero(kept), np.flatnonzero(~kept)
        gain = total[inside, None] - (total[outside] - others[np.ix_(inside, outside)])
        leaves, comes = np.unravel_index(gain.argmax(), gain.shape)
        if gain[leaves, comes] < 1e-9:
            break
        kept[[inside[leaves], outside[comes]]] = False, True
        total += others[outside[comes]] - others[inside[leaves]]
    return np.flatnonzero(kept)


def recalls(
    text: np.ndarray, motion: np.ndarray, similarity: np.ndarray | None = None
) -> np.ndarray:
    """Rank all motions for each text and all texts for each motion: protocol (a), or (b).

    Args:
        text, motion: [N, D], row i belongs together.
        similarity: of the texts [N, N]: pairs above `THRESHOLD` count beside the own, the best
            placed decides. None = the own pair alone counts, whatever other captions say.

    Returns:
        [2, 6]: text to motion, motion to text; R@1, 2, 3, 5, 10 as fractions and the median of the
        (mean) ranks from 1.
    """
    found = cosines(text, motion)
    right = np.eye(len(text), dtype=bool)
    if similarity is not None:
        right |= similarity > THRESHOLD
    ways = best_ranks(-found, right), best_ranks(-found.T, right.T)
    return np.array([[*(r.hits(k).mean() for k in RECALL_AT), np.median(r.mean())] for r in ways])


def recall_in_pools(
    text: np.ndarray,
    motion: np.ndarray,
    size: int = BATCH,
    similarity: np.ndarray | None = None,
    *,
    seed: int = 0,
) -> np.ndarray:
    """`recalls` in random pools of `size`, their mean (of medians, too) without an incomplete last.

    Pools of 32 are protocol (d) (Guo et al.). Recall falls as candidates are added, so samples of
    different N only compare in pools of one size.
    Raises ValueError: fewer pairs than one pool."""
    if len(text) < size:
        raise ValueError(f"{len(text)} pairs are fewer than one pool of {size}: add samples")
    found = []
    for rows in batches(len(text), size, seed):
        alike = None if similarity is None else similarity[np.ix_(rows, rows)]
        found.append(recalls(text[rows], motion[rows], alike))
    return np.asarray(np.mean(found, axis=0))
