"""How different motions are from each other: diversity and multimodality (Guo et al. 2020).

Letters: N motions, P prompts, R repetitions of a prompt, D embedding channels.
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from scipy.spatial.distance import pdist

from .families import Column, MotionSample


def diversity(embeddings: np.ndarray, *, num_pairs: int = 300, seed: int = 0) -> float:
    """Mean distance of `num_pairs` random pairs of different rows of embeddings [N, D].

    With fewer than 2 x `num_pairs` rows as many disjoint pairs as there are. Close to real is best.

    Raises:
        ValueError: fewer than two rows.
    """
    pairs = min(num_pairs, len(embeddings) // 2)
    if pairs < 1:
        raise ValueError(f"{len(embeddings)} embeddings make no pair: at least 2 are needed")
    rows = np.random.default_rng(seed).permutation(len(embeddings))[: 2 * pairs]
    difference = embeddings[rows[:pairs]] - embeddings[rows[pairs:]]
    return float(np.linalg.norm(difference.astype(np.float64), axis=-1).mean())


def multimodality(embeddings: np.ndarray, *, num_pairs: int = 10, seed: int = 0) -> float:
    """Mean distance of random pairs made for one prompt, over prompts; embeddings [P, R, D].

    0 means the model answers a prompt with one motion only.

    Raises:
        ValueError: fewer than two repetitions.
    """
    num_prompts, repetitions, _ = embeddings.shape
    if repetitions < 2:
        raise ValueError(f"multimodality needs 2 or more samples a prompt, got {repetitions}")
    pairs = min(num_pairs, repetitions // 2)
    rng = np.random.default_rng(seed)
    total = 0.0
    for prompt in range(num_prompts):
        rows = rng.permutation(repetitions)[: 2 * pairs]
        difference = embeddings[prompt, rows[:pairs]] - embeddings[prompt, rows[pairs:]]
        total += float(np.linalg.norm(difference.astype(np.float64), axis=-1).mean())
    return total / num_prompts


@dataclass(frozen=True)
class WithinPrompts:
    """Mean distance of motions of one prompt, over the `num_prompts` that have two or more."""

    distance: float
    num_prompts: int


def within_prompts(embeddings: np.ndarray, prompts: Sequence[str]) -> WithinPrompts:
    """Multimodality of a sample in which some of the prompts [N] come again; embeddings [N, D].

    All pairs of a prompt instead of ten random ones: the value that Guo's draw estimates, without
    the draw. NaN where no prompt comes twice.

    Raises:
        ValueError: lengths that differ, NaN or infinity.
    """
    if len(embeddings) != len(prompts):
        raise ValueError(f"{len(embeddings)} embeddings and {len(prompts)} prompts are not aligned")
    values = embeddings.astype(np.float64)
    if not np.isfinite(values).all():
        raise ValueError("embeddings hold NaN or infinity: look at the motions they came from")
    ids = np.unique(list(prompts), return_inverse=True)[1]
    again = np.flatnonzero(np.bincount(ids) > 1)
    means = [pdist(values[ids == prompt]).mean() for prompt in again]
    return WithinPrompts(float(np.mean(means)) if means else float("nan"), len(means))


# ---------------------------------------------------------------- in the tables


@dataclass(frozen=True)
class Multimodality:
    """Different answers to one prompt, as a table."""

    name: str = "multimodality"
    distance: bool = False
    columns: tuple[Column, ...] = (
        Column("multimodality", "MultiModality"),
        Column("multimodality_share", "of all pairs"),
        Column("multimodality_prompts", "prompts", 0),
    )
    definition: str = (
        "Guo et al. 2020: mean distance of the judge's embeddings of motions that have one "
        "caption, over the captions that come twice or more (all their pairs, not ten random "
        "ones). *of all pairs*: over the mean distance of any two motions; 1 says that the caption "
        "decides nothing, which is what the chance row has, and 0 that each caption has one "
        "answer. Best near the real row, where one caption has several clips. Nonsense is varied "
        "too, and so are frozen poses of different clips: read it beside R@k. Where captions "
        "seldom repeat it rests on the few *prompts* counted. The judge is ours: no published "
        "figure stands beside it."
    )

    def compute(
        self, sample: MotionSample, reference: MotionSample, *, seed: int
    ) -> dict[str, float]:
        """Nothing where no caption comes twice; no random choice."""
        found = within_prompts(sample.motion, sample.clips.captions)
        if not found.num_prompts:
            return {}
        every = float(pdist(sample.motion.astype(np.float64)).mean())
        return {
            "multimodality": found.distance,
            "multimodality_share": found.distance / every if every else float("nan"),
            "multimodality_prompts": float(found.num_prompts),
        }
