"""The paired bootstrap against scipy's, and against what is known by construction."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy import stats

from src.shared.evaluation.stats import paired_bootstrap


def test_interval_agrees_with_scipy() -> None:
    rng = np.random.default_rng(0)
    a = rng.normal(size=80)
    b = a + rng.normal(0.2, 0.5, size=80)
    ours = paired_bootstrap(a, b, seed=1, num=20_000)

    def mean_difference(x: np.ndarray, y: np.ndarray, axis: int) -> np.ndarray:
        return (y - x).mean(axis=axis)

    theirs = stats.bootstrap(
        (a, b),
        mean_difference,
        paired=True,
        vectorized=True,
        method="percentile",
        n_resamples=20_000,
        rng=np.random.default_rng(2),
    ).confidence_interval
    assert ours.value == pytest.approx((b - a).mean())
    assert (ours.low, ours.high) == pytest.approx((theirs.low, theirs.high), abs=0.006)


def test_p_agrees_with_the_t_test_on_normal_differences() -> None:
    rng = np.random.default_rng(3)
    a, difference = rng.normal(size=200), rng.normal(0.15, 1.0, size=200)
    ours = paired_bootstrap(a, a + difference, num=20_000).p
    assert ours == pytest.approx(stats.ttest_1samp(difference, 0.0).pvalue, abs=0.02)


def test_pairing_removes_what_makes_prompts_hard() -> None:
    rng = np.random.default_rng(0)
    hard = rng.normal(0, 100, size=50)
    found = paired_bootstrap(hard, hard + 1 + rng.normal(0, 0.1, size=50))
    assert 0.9 < found.low < 1 < found.high < 1.1 and found.p < 1e-3


def test_no_difference_is_no_difference() -> None:
    found = paired_bootstrap([1.0, 2.0, 3.0], [1.0, 2.0, 3.0])
    assert (found.value, found.low, found.high, found.p) == (0, 0, 0, 1)


def test_false_alarms_are_about_one_in_twenty() -> None:
    rng = np.random.default_rng(5)
    alarms = 0
    for seed in range(200):
        a, b = rng.normal(size=(2, 40))
        found = paired_bootstrap(a, b, seed=seed, num=500)
        alarms += not found.low <= 0 <= found.high
    assert 2 <= alarms <= 24


@given(st.lists(st.floats(-1e3, 1e3), min_size=2, max_size=20), st.floats(-10, 10))
@settings(max_examples=30, deadline=None)
def test_swapping_sides_turns_the_sign(values: list[float], shift: float) -> None:
    a, b = np.array(values), np.array(values)[::-1] + shift
    forth, back = paired_bootstrap(a, b, num=200), paired_bootstrap(b, a, num=200)
    scale = 1e-9 * (1 + np.abs(values).max())
    assert forth.value == pytest.approx(-back.value, abs=scale)
    assert (forth.low, forth.high) == pytest.approx((-back.high, -back.low), abs=scale)


def test_pairs_with_a_gap_are_left_out_and_too_few_are_an_error() -> None:
    found = paired_bootstrap([1.0, np.nan, 2.0], [2.0, 5.0, 3.0])
    assert found.count == 2 and found.value == 1
    with pytest.raises(ValueError, match="too few"):
        paired_bootstrap([1.0, np.nan], [2.0, 5.0])
    with pytest.raises(ValueError, match="aligned"):
        paired_bootstrap([1.0], [2.0, 5.0])
