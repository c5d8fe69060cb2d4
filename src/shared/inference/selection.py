"""Selection: from the scores of N candidates to a ranking, best first, then the best of the rest.

Each candidate has terms in [0, 1], higher is better, made by a judge (`text_judge`,
`audio_judge`). Its score is their mean with the weights of `SelectionConfig`; each failed check
costs 2, more than everything else can earn. The first choice is the highest score. Each later
one is the highest score plus `distance` times how far the candidate is from the nearest of those
already chosen, so that the second best is not the best once more (greedy maximal marginal
relevance, Carbonell and Goldstein 1998).

Letters: N candidates, T frames, J points.
"""

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np
from pydantic import Field

from ..config_schema import Config

FAILURE = 2.0  # what each failed check costs
MAX_FRAMES = 256  # of a candidate that its distance to others looks at, evenly spread


class SelectionConfig(Config):
    """Weight of each term; a term that the judge cannot make (no beat, no tower) is left out."""

    similarity: float = Field(1.0, ge=0)  # text: cosine of prompt and motion in the shared space
    feet: float = Field(0.5, ge=0)  # text: feet that neither slide nor sink
    smoothness: float = Field(0.5, ge=0)  # text: no more jerk than real motion has
    sanity: float = Field(1.0, ge=0)  # audio: margins of the sanity suite
    beats: float = Field(1.0, ge=0)  # audio: slow moments on the beats, both ways
    distance: float = Field(0.25, ge=0)  # from those already chosen; never decides the first


@dataclass(frozen=True, eq=False)
class ScoreTable:
    """What was found of N candidates, in the order they were sampled.

    Attributes:
        terms: name to values [N] in [0, 1].
        failed: checks that each candidate fails, [N].
        score: weighted mean of the terms less 2 for each failed check, [N].
        order: candidates by rank, the best first, [N].
        distance: of each candidate from the nearest of those ranked before it, in [0, 1]; NaN for
            the best, [N].
        weights: of the terms that there are, and of the distance.
    """

    terms: dict[str, np.ndarray]
    failed: np.ndarray
    score: np.ndarray
    order: np.ndarray
    distance: np.ndarray
    weights: dict[str, float]

    @property
    def best(self) -> int:
        """The first choice."""
        return int(self.order[0])

    def rows(self) -> list[dict[str, Any]]:
        """Plain values for JSON, best first: rank, sample, score, failed, each term, distance."""
        return [
            {
                "rank": rank,
                "sample": int(index),
                "score": round(float(self.score[index]), 6),
                "failed": int(self.failed[index]),
                **{name: round(float(values[index]), 6) for name, values in self.terms.items()},
                "distance": None if rank == 1 else round(float(self.distance[index]), 6),
            }
            for rank, index in enumerate(self.order, start=1)
        ]


def rank(
    terms: Mapping[str, np.ndarray],
    failed: np.ndarray,
    distance_from: Callable[[int], np.ndarray],
    config: SelectionConfig | None = None,
) -> ScoreTable:
    """Rank N ≥ 1 candidates.

    Args:
        terms: values [N] in [0, 1] by the names of `SelectionConfig`; what is not finite is 0.
        failed: checks that each fails, [N].
        distance_from: distances [N] in [0, 1] of all candidates from one.
        config: weights.

    Equal candidates keep the order they were sampled in.
    """
    config = config or SelectionConfig()
    clean = {name: np.nan_to_num(np.asarray(values), nan=0.0) for name, values in terms.items()}
    weights = {name: float(getattr(config, name)) for name in clean}
    total = sum(weights.values()) or 1.0
    number = len(failed)
    mean = sum((weights[name] / total * values for name, values in clean.items()), np.zeros(number))
    score = mean - FAILURE * np.asarray(failed)
    order, distance = _greedy(score, distance_from, config.distance)
    weights["distance"] = config.distance
    return ScoreTable(clean, np.asarray(failed), score, order, distance, weights)


def _greedy(
    score: np.ndarray, distance_from: Callable[[int], np.ndarray], weight: float
) -> tuple[np.ndarray, np.ndarray]:
    """Order [N], and the distance [N] at which each was chosen."""
    number = len(score)
    left = np.ones(number, dtype=bool)
    nearest, at = np.full(number, np.inf), np.full(number, np.nan)
    order = [int(score.argmax())]
    while len(order) < number:
        left[order[-1]] = False
        nearest = np.minimum(nearest, distance_from(order[-1]))
        gain = np.where(left, score + weight * nearest, -np.inf)
        order.append(int(gain.argmax()))
        at[order[-1]] = nearest[order[-1]]
    return np.array(order), at


def distances(points: np.ndarray, scale: float) -> Callable[[int], np.ndarray]:
    """How far candidates are from each other, for `rank`.

    1 - exp(-d / scale), d the mean distance of the same point at the same frame: 0 for the same
    motion, 0.63 for points `scale` apart, never more than 1.

    Args:
        points: [N,T,J,3], metres.
        scale: metres.
    """
    every = -(-points.shape[1] // MAX_FRAMES)
    kept = points[:, ::every]

    def distance_from(chosen: int) -> np.ndarray:
        apart = np.linalg.norm(kept - kept[chosen], axis=-1).mean((1, 2))
        return np.asarray(-np.expm1(-np.nan_to_num(apart) / scale))

    return distance_from
