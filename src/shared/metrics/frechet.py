"""Samples of embeddings: Fréchet distances, also with text and per label, and their variety.

Letters: N samples, D channels. All in float64. Keep D at 32 or less and N at 1000 or more: at N =
270 two samples of one distribution are already 18 apart in 128 dimensions, so each figure stands
beside a real-against-real one.
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from scipy.spatial.distance import pdist


def finite(embeddings: np.ndarray) -> np.ndarray:
    """Embeddings [N, D] in float64. Raises ValueError: NaN or infinity."""
    if not np.isfinite(embeddings).all():
        raise ValueError("embeddings hold NaN or infinity: look at the motions they came from")
    return embeddings.astype(np.float64)


def _moments(samples: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    if samples.ndim != 2 or len(samples) < 2:
        raise ValueError(f"a sample of shape {samples.shape} needs [N >= 2, D]")
    values = finite(samples)
    return values.mean(0), np.atleast_2d(np.cov(values, rowvar=False))


def gaussian_frechet(
    mean_a: np.ndarray, cov_a: np.ndarray, mean_b: np.ndarray, cov_b: np.ndarray
) -> float:
    """|m_a - m_b|^2 + Tr(S_a + S_b - 2 (S_a S_b)^1/2) (Dowson and Landau 1982; Heusel et al. 2017).

    Tr (S_a S_b)^1/2 equals Tr (S_a^1/2 S_b S_a^1/2)^1/2, whose argument is symmetric, so two
    eigen-decompositions give it without the complex square root of a singular matrix.
    """
    values, vectors = np.linalg.eigh(cov_a)
    root = (vectors * np.sqrt(values.clip(min=0))) @ vectors.T
    cross = np.linalg.eigvalsh(root @ cov_b @ root).clip(min=0)
    distance = ((mean_a - mean_b) ** 2).sum() + np.trace(cov_a) + np.trace(cov_b)
    return float(max(distance - 2 * np.sqrt(cross).sum(), 0.0))


def frechet_distance(a: np.ndarray, b: np.ndarray) -> float:
    """Fréchet distance of two samples [N, D] and [M, D].
    Raises ValueError: no arrays of two axes and one width, NaN, or N < 2."""
    for name, sample in (("a", a), ("b", b)):
        if not isinstance(sample, np.ndarray):
            raise ValueError(f"{name} is a {type(sample).__name__}; give an array [N, D]")
    if a.ndim == b.ndim == 2 and a.shape[1] != b.shape[1]:
        raise ValueError(
            f"samples {list(a.shape)} and {list(b.shape)} differ in width; give [N, D] and [M, D]"
        )
    return gaussian_frechet(*_moments(a), *_moments(b))


@dataclass(frozen=True)
class Projection:
    """Principal axes fitted on real samples: `mean` [D], `axes` [D, C] orthonormal."""

    mean: np.ndarray
    axes: np.ndarray

    @classmethod
    def fit(cls, samples: np.ndarray, num_axes: int) -> "Projection":
        """Keep the `num_axes` directions of largest variance of samples [N, D]."""
        mean, covariance = _moments(samples)
        _, vectors = np.linalg.eigh(covariance)
        return cls(mean, vectors[:, ::-1][:, :num_axes])

    def __call__(self, samples: np.ndarray) -> np.ndarray:
        """[N, D] to [N, C]."""
        return np.asarray((samples.astype(np.float64) - self.mean) @ self.axes)


class JointFrechet:
    """Fréchet distance of (text, motion) pairs, which sees whether the labels fit.

    The distance of motions alone cannot: shuffling the labels leaves it unchanged. Text and motion
    embeddings are each reduced to `num_axes` principal axes of the real sample and put side by
    side, so a wrong pairing shows in the cross-covariance (joint form of Soloveitchik et al. 2021).
    """

    def __init__(self, text: np.ndarray, motion: np.ndarray, *, num_axes: int = 16) -> None:
        self.text_axes = Projection.fit(text, num_axes)
        self.motion_axes = Projection.fit(motion, num_axes)
        self.reference = self.moments(text, motion)

    def moments(self, text: np.ndarray, motion: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Mean and covariance of pairs [N, D] in the reduced joint space."""
        return _moments(np.concatenate([self.text_axes(text), self.motion_axes(motion)], axis=1))

    def __call__(self, text: np.ndarray, motion: np.ndarray) -> float:
        """Distance of pairs (text [N, D], motion [N, D]) to the real pairs given at the start."""
        return gaussian_frechet(*self.moments(text, motion), *self.reference)


GROUP_AXES, GROUP_SIZE = 8, 24  # principal axes, and least samples of a label


def group_frechet(
    generated: np.ndarray,
    generated_labels: Sequence[str],
    real: np.ndarray,
    real_labels: Sequence[str],
) -> tuple[float, float, int] | None:
    """Fréchet distance label by label, beside the same with the labels shuffled.

    Of labels with `GROUP_SIZE` samples on both sides, in `GROUP_AXES` principal axes of the real
    sample: a small group in many dimensions measures its own size.

    Returns:
        Mean distance to the same label and to a wrong one (the next of a random cycle), and the
        number of labels; None when fewer than two labels are large enough.
    """
    project = Projection.fit(real, min(GROUP_AXES, real.shape[1]))
    made, true = np.asarray(generated_labels), np.asarray(real_labels)
    shared = sorted(set(generated_labels) & set(real_labels))
    names = [n for n in shared if min((made == n).sum(), (true == n).sum()) >= GROUP_SIZE]
    if len(names) < 2:
        return None
    a = {name: _moments(project(generated[made == name])) for name in names}
    b = {name: _moments(project(real[true == name])) for name in names}
    cycle = np.random.default_rng(0).permutation(len(names))
    wrong = {names[i]: names[j] for i, j in zip(cycle, np.roll(cycle, 1), strict=True)}
    matched = np.mean([gaussian_frechet(*a[n], *b[n]) for n in names])
    mismatched = np.mean([gaussian_frechet(*a[n], *b[wrong[n]]) for n in names])
    return float(matched), float(mismatched), len(names)


# ---------------------------------------------------------------- variety (Guo et al. 2020)


def diversity(embeddings: np.ndarray, *, seed: int = 0) -> float:
    """Mean distance of 300 random disjoint pairs of rows of embeddings [N, D], of as many as there
    are below 600 rows. Close to real is best.
    Raises ValueError: fewer than two rows."""
    pairs = min(300, len(embeddings) // 2)
    if pairs < 1:
        raise ValueError(f"{len(embeddings)} embeddings make no pair: at least 2 are needed")
    rows = np.random.default_rng(seed).permutation(len(embeddings))[: 2 * pairs]
    difference = embeddings[rows[:pairs]] - embeddings[rows[pairs:]]
    return float(np.linalg.norm(difference.astype(np.float64), axis=-1).mean())


def within_prompts(embeddings: np.ndarray, prompts: Sequence[str]) -> tuple[float, int]:
    """Multimodality of embeddings [N, D]: the mean distance of motions of one of the prompts [N],
    NaN where none comes twice, and how many do. All pairs of a prompt: what ten random ones (Guo)
    estimate.
    Raises ValueError: lengths that differ, NaN or infinity."""
    if len(embeddings) != len(prompts):
        raise ValueError(f"{len(embeddings)} embeddings and {len(prompts)} prompts are not aligned")
    values = finite(embeddings)
    ids = np.unique(list(prompts), return_inverse=True)[1]
    again = np.flatnonzero(np.bincount(ids) > 1)
    means = [pdist(values[ids == prompt]).mean() for prompt in again]
    return float(np.mean(means)) if means else float("nan"), len(means)
