"""Metrics against closed forms, scipy, and cases whose answer is known by construction."""

import itertools
import math

import numpy as np
import pytest
import scipy.linalg
from hypothesis import given, settings
from hypothesis import strategies as st

from src.shared.evaluation.stats import bootstrap_mean, replicated, success_rate
from src.shared.metrics.frechet import (
    JointFrechet,
    Projection,
    diversity,
    frechet_distance,
    gaussian_frechet,
    group_frechet,
)
from src.shared.metrics.retrieval import (
    best_ranks,
    guo_retrieval,
    normalised_score,
)


def random_gaussian(seed: int, size: int) -> tuple[np.ndarray, np.ndarray]:
    rng = np.random.default_rng(seed)
    factor = rng.normal(size=(size, size))
    return rng.normal(size=size), factor @ factor.T / size + 0.1 * np.eye(size)


@pytest.mark.parametrize("size", [1, 4, 32])
def test_frechet_matches_the_matrix_square_root_of_scipy(size: int) -> None:
    (mean_a, cov_a), (mean_b, cov_b) = random_gaussian(0, size), random_gaussian(1, size)
    root = scipy.linalg.sqrtm(cov_a @ cov_b).real
    expected = ((mean_a - mean_b) ** 2).sum() + np.trace(cov_a + cov_b - 2 * root)
    assert gaussian_frechet(mean_a, cov_a, mean_b, cov_b) == pytest.approx(expected, rel=1e-6)


def test_frechet_of_one_dimension_is_the_closed_form() -> None:
    a, b = np.array([[0.0], [2.0], [4.0]]), np.array([[10.0], [10.5], [11.0]])
    expected = (2.0 - 10.5) ** 2 + (a.std(ddof=1) - b.std(ddof=1)) ** 2
    assert frechet_distance(a, b) == pytest.approx(expected)


def test_frechet_is_zero_on_itself_symmetric_and_sees_a_shift() -> None:
    rng = np.random.default_rng(0)
    a, b = rng.normal(size=(300, 8)), rng.normal(size=(200, 8)) * 2
    assert frechet_distance(a, a) == pytest.approx(0, abs=1e-9)
    assert frechet_distance(a, b) == pytest.approx(frechet_distance(b, a))
    assert frechet_distance(a, a + 3) == pytest.approx(8 * 9)


def test_frechet_survives_a_singular_covariance_and_refuses_nan() -> None:
    flat = np.random.default_rng(0).normal(size=(50, 3)) @ np.ones((3, 6))
    assert frechet_distance(flat, flat + 1) == pytest.approx(6)
    with pytest.raises(ValueError, match="NaN"):
        frechet_distance(flat, np.full((5, 6), np.nan))
    with pytest.raises(ValueError, match="N >= 2"):
        frechet_distance(flat, flat[:1])
    with pytest.raises(ValueError, match=r"^samples \[50, 6\] and \[50, 4\] differ in width.*"):
        frechet_distance(flat, flat[:, :4])
    with pytest.raises(ValueError, match=r"^b is a list; give an array \[N, D\]$"):
        frechet_distance(flat, flat.tolist())


def test_projection_keeps_the_directions_of_largest_variance() -> None:
    rng = np.random.default_rng(0)
    samples = rng.normal(size=(500, 3)) * [0.1, 5.0, 1.0]
    project = Projection.fit(samples, 2)
    assert np.allclose(project.axes.T @ project.axes, np.eye(2))
    kept = project(samples).var(0, ddof=1).sum()
    assert kept == pytest.approx(np.linalg.eigvalsh(np.cov(samples.T))[1:].sum())


def test_joint_distance_sees_wrong_labels_where_the_marginal_one_cannot() -> None:
    rng = np.random.default_rng(0)
    text = rng.normal(size=(2000, 8))
    motion = text + 0.1 * rng.normal(size=text.shape)
    shuffled = motion[rng.permutation(len(motion))]
    joint = JointFrechet(text, motion, num_axes=8)
    assert joint(text, motion) == pytest.approx(0, abs=1e-9)
    assert frechet_distance(motion, shuffled) == pytest.approx(0, abs=1e-9)
    assert joint(text, shuffled) > 1


def test_group_distance_tells_matching_labels_from_shuffled_ones() -> None:
    rng = np.random.default_rng(0)
    labels = [name for name in "abc" for _ in range(40)] + ["rare"] * 3
    centre = {"a": 0.0, "b": 3.0, "c": 6.0, "rare": 9.0}
    points = np.array([centre[name] for name in labels])[:, None] + rng.normal(size=(123, 8))
    result = group_frechet(points, labels, points + 0.01, labels)
    assert result is not None and result[2] == 3
    assert result[0] < 0.05 * result[1]
    assert group_frechet(points, ["a"] * 123, points, ["a"] * 123) is None


@given(
    st.lists(st.tuples(st.integers(0, 3), st.booleans()), min_size=2, max_size=6),
    st.integers(1, 3),
)
@settings(max_examples=60, deadline=None)
def test_hits_average_over_every_order_of_the_ties(
    candidates: list[tuple[int, bool]], k: int
) -> None:
    distances = np.array([float(distance) for distance, _ in candidates])
    relevant = np.array([right for _, right in candidates])
    hits = []
    for order in itertools.permutations(range(len(candidates))):
        ranked = sorted(order, key=lambda i: distances[i])  # stable: ties stay in `order`
        hits.append(any(relevant[i] for i in ranked[:k]))
    found = best_ranks(distances[None], relevant[None]).hits(k)
    assert found == pytest.approx([np.mean(hits)], abs=1e-9)


def test_retrieval_of_perfect_constant_and_random_embeddings() -> None:
    rng = np.random.default_rng(0)
    text = rng.normal(size=(640, 16))
    perfect = guo_retrieval(text, text, [])
    assert (perfect == 1).all() and perfect.shape == (3, 640)
    constant = guo_retrieval(np.ones((64, 4)), np.ones((64, 4)), [])
    assert constant.mean(1) == pytest.approx((1 / 32, 2 / 32, 3 / 32))
    chance = guo_retrieval(text, rng.permutation(text), [])
    assert chance.mean(1)[2] == pytest.approx(3 / 32, abs=0.04)


def test_equal_labels_count_as_hits() -> None:
    rng = np.random.default_rng(0)
    text, motion = rng.normal(size=(64, 8)), rng.normal(size=(64, 8))
    assert (guo_retrieval(text, motion, [range(64), ["same"] * 64]) == 1).all()


def test_retrieval_matches_a_plain_loop() -> None:
    rng = np.random.default_rng(3)
    text, motion = rng.normal(size=(32, 4)), rng.normal(size=(32, 4))
    distances = np.linalg.norm(text[:, None] - motion[None], axis=-1)
    ranks = [int((row < row[i]).sum()) for i, row in enumerate(distances)]
    expected = [float(np.mean([rank < k for rank in ranks])) for k in (1, 2, 3)]
    assert guo_retrieval(text, motion, []).mean(1) == pytest.approx(expected)


def test_retrieval_says_what_is_wrong_with_its_input() -> None:
    with pytest.raises(ValueError, match="fewer than one batch"):
        guo_retrieval(np.ones((8, 2)), np.ones((8, 2)), [])
    with pytest.raises(ValueError, match="aligned"):
        guo_retrieval(np.ones((32, 2)), np.ones((33, 2)), [])
    with pytest.raises(ValueError, match="aligned"):
        guo_retrieval(np.ones((32, 2)), np.ones((32, 2)), [["a"] * 31])
    with pytest.raises(ValueError, match="NaN"):
        guo_retrieval(np.full((32, 2), np.nan), np.ones((32, 2)), [])


def test_normalised_score_has_chance_at_zero_and_real_at_one() -> None:
    assert normalised_score(0.1, 0.1, 0.9) == 0
    assert normalised_score(0.9, 0.1, 0.9) == pytest.approx(1)
    assert math.isnan(normalised_score(0.5, 0.5, 0.5))


def test_diversity_and_multimodality_by_construction() -> None:
    two_places = np.repeat([[0.0, 0.0], [3.0, 4.0]], 1, axis=0)
    assert diversity(two_places) == pytest.approx(5)
    assert diversity(np.ones((100, 3))) == 0
    rng = np.random.default_rng(0)
    spread = diversity(rng.normal(size=(5000, 32)))
    assert spread == pytest.approx(math.sqrt(2 * 32), rel=0.05)  # chi distribution, 32 d
    with pytest.raises(ValueError, match="no pair"):
        diversity(np.ones((1, 3)))


def test_intervals() -> None:
    estimate = replicated([1.0, 2.0, 3.0])
    assert estimate.value == 2 and estimate.high - 2 == pytest.approx(1.96 / math.sqrt(3), 1e-3)
    assert replicated([0.5]).low == replicated([0.5]).high == 0.5
    values = np.random.default_rng(0).normal(2, 1, 400)
    boot = bootstrap_mean([*values.tolist(), math.nan])
    assert boot.count == 400 and boot.low < 2 < boot.high
    assert boot.high - boot.low == pytest.approx(2 * 1.96 / math.sqrt(400), rel=0.15)
    assert math.isnan(bootstrap_mean([math.nan]).value)


@given(st.integers(1, 200), st.floats(0, 1))
@settings(max_examples=50, deadline=None)
def test_success_rates_agree_with_scipy(trials: int, share: float) -> None:
    from scipy.stats import binomtest

    successes = round(share * trials)
    ours = success_rate(successes, trials)
    theirs = binomtest(successes, trials).proportion_ci(method="wilson")
    assert (ours.low, ours.high) == pytest.approx((theirs.low, theirs.high), abs=1e-9)
    assert math.isnan(success_rate(0, 0).value)
