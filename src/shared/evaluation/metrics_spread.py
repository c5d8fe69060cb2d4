"""How different motions are from each other: diversity and multimodality (Guo et al. 2020).

Letters: N motions, P prompts, R repetitions of a prompt, D embedding channels.
"""

import numpy as np


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
