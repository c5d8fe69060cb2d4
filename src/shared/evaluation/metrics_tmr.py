"""Retrieval as TMR measures it: four protocols, both directions, R@1 to 10 and the median rank.

Petrovich et al. 2023, "TMR", §4.1: (a) all pairs; (b) all pairs, where a text that says nearly the
same also counts; (c) a subset of texts far from each other; (d) batches of 32. Similarity is the
cosine. Equal similarities are averaged over all their orders, exactly: embeddings that all fall on
one point score what guessing does, not 0 and not 1.

Letters: N pairs, D embedding channels, E channels of the text similarity.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np

from .families import Column, MotionSample
from .metrics_retrieval import BATCH, best_ranks
from .text_hashing import caption_buckets

TOP = (1, 2, 3, 5, 10)
THRESHOLD = 0.95  # of (1 + cosine) / 2 of two texts, as in TMR
POOL = 256  # candidates of protocols (a) and (b) in the tables, whose rows differ in N
SUBSET = 100  # pairs of the dissimilar subset
PROTOCOLS = ("all", "threshold", "dissimilar", "batches")


@dataclass(frozen=True)
class Recall:
    """One direction: R@1, 2, 3, 5, 10 as fractions and the median of the (mean) ranks from 1."""

    recall: tuple[float, ...]
    median_rank: float


@dataclass(frozen=True)
class BothWays:
    """Text to motion and motion to text, over `num_pairs` candidates."""

    text_to_motion: Recall
    motion_to_text: Recall
    num_pairs: int


# ---------------------------------------------------------------- similarities


def cosines(text: np.ndarray, motion: np.ndarray) -> np.ndarray:
    """Cosines [N, N] of texts (rows) and motions (columns) [N, D], float64.

    Equal rows are multiplied once, so that equal embeddings are equally similar to the last bit:
    a matrix product alone may round two copies of a row differently and break their tie.

    Raises:
        ValueError: shapes that differ, NaN or infinity, or a vector of length 0.
    """
    if text.ndim != 2 or text.shape != motion.shape:
        raise ValueError(f"texts {text.shape} and motions {motion.shape} must be aligned [N, D]")
    rows, row = np.unique(_unit(text), axis=0, return_inverse=True)
    columns, column = np.unique(_unit(motion), axis=0, return_inverse=True)
    return (rows @ columns.T)[row.reshape(-1)][:, column.reshape(-1)]


def _unit(vectors: np.ndarray) -> np.ndarray:
    values = vectors.astype(np.float64)
    if not np.isfinite(values).all():
        raise ValueError("embeddings hold NaN or infinity: look at the motions they came from")
    length = np.linalg.norm(values, axis=1, keepdims=True)
    if not length.all():
        raise ValueError("an embedding of length 0 has no direction to compare")
    return values / length


def text_similarity(captions: Sequence[str], groups: Sequence[str] | None = None) -> np.ndarray:
    """(1 + cosine) / 2 [N, N] of the captions' bags of n-grams; 1 inside a label group.

    TMR takes a sentence encoder (MPNet). Ours is hashed words, word pairs and stems, which no
    judged model has a hand in: an encoder that calls all texts alike would make every answer
    right. Captions of one label group are translations of the same labels, so they are alike.
    """
    different, row = np.unique(list(captions), return_inverse=True)
    buckets = [caption_buckets(str(caption)) for caption in different]
    known = {bucket: at for at, bucket in enumerate(sorted({b for row in buckets for b in row}))}
    bags = np.zeros((len(different), len(known)))
    for bag, found in zip(bags, buckets, strict=True):
        np.add.at(bag, [known[bucket] for bucket in found], 1.0)
    similarity = ((1 + cosines(bags, bags)) / 2)[row][:, row]
    if groups is not None:
        ids = np.unique(list(groups), return_inverse=True)[1]
        similarity[ids[:, None] == ids[None]] = 1.0
    return similarity


def dissimilar_subset(
    similarity: np.ndarray, size: int = SUBSET, *, threshold: float = THRESHOLD, seed: int = 0
) -> np.ndarray:
    """Rows [at most `size`], ascending, of texts far from each other; similarity [N, N].

    No two of them are more similar than `threshold`: of such a set a random one stays, so captions
    from few templates make a smaller subset. TMR states the choice as a quadratic knapsack and
    approximates it. Here the text that is most similar to all that are left goes, one after the
    other, and then one text is exchanged for another as long as that lowers the sum of the
    similarities.
    """
    unlike: list[int] = []
    for row in np.random.default_rng(seed).permutation(len(similarity)).tolist():
        if not (similarity[row, unlike] > threshold).any():
            unlike.append(row)
    rows = np.sort(unlike)
    return rows[_farthest(similarity[np.ix_(rows, rows)], size)]


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


# ---------------------------------------------------------------- protocols


def recalls(similarity: np.ndarray, relevant: np.ndarray | None = None) -> BothWays:
    """Rank all motions for each text and all texts for each motion.

    Args:
        similarity: [N, N], texts by motions.
        relevant: symmetric bool [N, N], which answers count beside the own; None = only the own.
    """
    own = np.eye(len(similarity), dtype=bool)
    right = own if relevant is None else relevant | own
    return BothWays(_recall(-similarity, right), _recall(-similarity.T, right.T), len(similarity))


def _recall(distances: np.ndarray, relevant: np.ndarray) -> Recall:
    ranks = best_ranks(distances, relevant)
    return Recall(tuple(float(ranks.hits(k).mean()) for k in TOP), float(np.median(ranks.mean())))


def recall_of_all(text: np.ndarray, motion: np.ndarray) -> BothWays:
    """Protocol (a): only the own pair counts, though another caption may say the same."""
    return recalls(cosines(text, motion))


def recall_with_threshold(
    text: np.ndarray, motion: np.ndarray, similarity: np.ndarray, threshold: float = THRESHOLD
) -> BothWays:
    """Protocol (b): pairs whose texts are more similar than `threshold` count; similarity [N, N].

    The best placed of the right answers decides. It makes guessing easier: see the chance row.
    """
    return recalls(cosines(text, motion), similarity > threshold)


def recall_of_dissimilar(
    text: np.ndarray,
    motion: np.ndarray,
    similarity: np.ndarray,
    size: int = SUBSET,
    *,
    seed: int = 0,
) -> BothWays:
    """Protocol (c): protocol (a) among `size` texts far from each other; similarity [N, N]."""
    rows = dissimilar_subset(similarity, size, seed=seed)
    return recalls(cosines(text[rows], motion[rows]))


def recall_in_pools(
    text: np.ndarray,
    motion: np.ndarray,
    size: int = BATCH,
    similarity: np.ndarray | None = None,
    *,
    seed: int = 0,
) -> BothWays:
    """Protocol (a), or (b) if texts are given a similarity [N, N], in random pools of `size`.

    Pools of 32 are protocol (d) (Guo et al.). Recall falls as candidates are added, so samples of
    different N only compare in pools of one size. Mean over the pools; an incomplete last one is
    left out, and the median rank is the mean of the pools' medians.

    Raises:
        ValueError: fewer pairs than one pool.
    """
    if len(text) < size:
        raise ValueError(f"{len(text)} pairs are fewer than one pool of {size}: add samples")
    order = np.random.default_rng(seed).permutation(len(text))
    count = len(text) // size
    found = []
    for rows in order[: count * size].reshape(count, size):
        if similarity is None:
            found.append(recall_of_all(text[rows], motion[rows]))
        else:
            alike = similarity[np.ix_(rows, rows)]
            found.append(recall_with_threshold(text[rows], motion[rows], alike))
    return BothWays(
        _mean([one.text_to_motion for one in found]),
        _mean([one.motion_to_text for one in found]),
        size,
    )


def _mean(found: Sequence[Recall]) -> Recall:
    table = np.array([one.recall for one in found]).mean(0)
    return Recall(tuple(table.tolist()), float(np.mean([one.median_rank for one in found])))


# ---------------------------------------------------------------- in the tables

_SAYS = {
    "all": f"protocol (a): only the own pair is right. In random pools of {POOL} instead of the "
    "whole sample, because recall falls with the number of candidates and rows differ in it. "
    "Captions that repeat cap it below 1, for real motion too",
    "threshold": f"protocol (b): texts with (1 + cosine) / 2 > {THRESHOLD} of their word n-grams, "
    "or of one label group, count as right. Pools as in (a); chance is higher here",
    "dissimilar": f"protocol (c): among {SUBSET} texts far from each other, only the own pair; "
    "fewer where the captions say fewer things (*candidates*). Which of equals it takes is drawn "
    "anew in each replication",
    "batches": f"protocol (d): random batches of {BATCH}, only the own pair is right",
}


@dataclass(frozen=True)
class TmrFamily:
    """One of the four protocols as a table."""

    protocol: str
    distance: bool = False

    @property
    def name(self) -> str:
        return f"retrieval: {self.protocol}"

    @property
    def columns(self) -> tuple[Column, ...]:
        found = []
        for way, arrow in (("t2m", "text→motion"), ("m2t", "motion→text")):
            key = f"tmr_{self.protocol}_{way}"
            found += [Column(f"{key}_r{k}", f"{arrow} R@{k}", 3, "high") for k in TOP]
            found.append(Column(f"{key}_medr", f"{arrow} MedR", 1, "low"))
        found.append(Column(f"tmr_{self.protocol}_pairs", "candidates", 0))
        return tuple(found)

    @property
    def definition(self) -> str:
        return (
            f"TMR (Petrovich et al. 2023), {_SAYS[self.protocol]}. Cosine similarity; R@k is the "
            "share of queries with a right answer among the first k, MedR the median rank from 1; "
            "ties are averaged over all orders. The judge is ours, so no published figure may "
            "stand beside it. It says whether a motion fits its text better than other texts, not "
            "whether it looks right."
        )

    def compute(
        self, sample: MotionSample, reference: MotionSample, *, seed: int
    ) -> dict[str, float]:
        """R@k and MedR of the sample; nothing where it is smaller than a batch of protocol (d)."""
        if self.protocol == "batches" and len(sample) < BATCH:
            return {}

        def alike() -> np.ndarray:
            clips = sample.clips
            return sample.memo.once(
                "text similarity", lambda: text_similarity(clips.captions, clips.groups)
            )

        text, motion, pool = sample.text, sample.motion, min(POOL, len(sample))
        protocols: dict[str, Callable[[], BothWays]] = {
            "all": lambda: recall_in_pools(text, motion, pool, seed=seed),
            "threshold": lambda: recall_in_pools(text, motion, pool, alike(), seed=seed),
            "dissimilar": lambda: recall_of_dissimilar(text, motion, alike(), seed=seed),
            "batches": lambda: recall_in_pools(text, motion, seed=seed),
        }
        found = protocols[self.protocol]()
        ways = (found.text_to_motion, found.motion_to_text)
        values = [value for way in ways for value in (*way.recall, way.median_rank)]
        keys = [column.key for column in self.columns]
        return dict(zip(keys, [*values, float(found.num_pairs)], strict=True))


FAMILIES = tuple(TmrFamily(protocol) for protocol in PROTOCOLS)
