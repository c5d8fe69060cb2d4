"""Time warps keep their bound, meet the beats, and leave a motion's path alone."""

from itertools import pairwise

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from src.shared.data.pairing.phrase_motion import (
    KNOT_SECONDS,
    LIMIT,
    Warp,
    fit_warp,
    match_beats,
    plain_warp,
    resample,
)


@settings(deadline=None, max_examples=25)
@given(
    st.integers(0, 10_000),
    st.floats(0.92, 1.08),
    st.floats(0.35, 0.9),
)
def test_a_warp_meets_beats_within_its_bound(seed: int, ratio: float, interval: float) -> None:
    rng = np.random.default_rng(seed)
    music = np.arange(rng.uniform(0, interval), 12.0, interval)
    motion = 0.4 + np.arange(0, 14.0, interval * ratio)
    motion = motion + rng.normal(0, 0.01, len(motion))
    pairs = match_beats(motion, music, 12.0, 1.2)
    assert len(pairs) >= 0.6 * len(music)
    assert all(a < c and b < d for (a, b), (c, d) in pairwise(pairs))
    hit = np.array([music[k] for _, k in pairs])
    seen = np.array([motion[i] for i, _ in pairs])
    warp = fit_warp(seen, hit, 12.0, 1.2)
    assert 0 <= warp.start <= 1.2
    at = np.linspace(0, 12, 2000)
    rate = np.diff(warp.times(at)) / np.diff(at)
    assert rate.min() >= 1 - LIMIT - 1e-6 and rate.max() <= 1 + LIMIT + 1e-6
    assert np.abs(warp.times(hit) - seen).mean() < 0.025


def test_rates_are_the_derivative_of_times() -> None:
    rng = np.random.default_rng(0)
    warp = Warp(0.3, tuple(rng.uniform(0.85, 1.15, 20)))
    at = np.linspace(0.01, 3.79, 500)
    slope = (warp.times(at + 1e-5) - warp.times(at - 1e-5)) / 2e-5
    assert np.allclose(slope, np.interp(at, np.arange(20) * KNOT_SECONDS, warp.rates), atol=1e-4)
    assert warp.times(np.zeros(1))[0] == pytest.approx(0.3)


def test_the_plain_warp_changes_nothing() -> None:
    at = np.linspace(0, 7.77, 100)
    assert np.allclose(plain_warp(7.77, 0.5).times(at), at + 0.5)
    assert len(plain_warp(7.77).rates) == int(np.ceil(7.77 / KNOT_SECONDS)) + 1


def test_nothing_to_match() -> None:
    assert match_beats(np.zeros(0), np.ones(3), 5.0, 1.0) == []
    assert match_beats(np.ones(3), np.zeros(0), 5.0, 1.0) == []
    warp = fit_warp(np.zeros(0), np.zeros(0), 5.0, 1.0)
    assert set(warp.rates) == {1.0}


def test_beats_out_of_reach_stay_unmatched() -> None:
    """Motion 1.5 times too slow for every beat cannot be bent onto every beat."""
    music = np.arange(0, 10, 0.5)
    motion = np.arange(0.2, 12, 0.75)
    pairs = match_beats(motion, music, 10.0, 1.0)
    rates = [(motion[c] - motion[a]) / (music[d] - music[b]) for (a, b), (c, d) in pairwise(pairs)]
    assert all(abs(rate - 1) <= LIMIT for rate in rates)


def test_resampling_at_the_frames_returns_the_motion() -> None:
    rng = np.random.default_rng(1)
    position = np.cumsum(rng.normal(0, 0.02, (50, 3)), 0).astype(np.float32)
    angle = np.cumsum(rng.normal(0, 0.05, 50))
    quaternion = np.stack((np.cos(angle / 2), 0 * angle, np.sin(angle / 2), 0 * angle), 1)
    p, q = resample(position, quaternion, np.arange(50) / 30)
    assert np.allclose(p, position, atol=1e-5) and np.allclose(q, quaternion, atol=1e-3)
    halfway = resample(position, quaternion, (np.arange(49) + 0.5) / 30)[1]
    assert np.allclose(np.linalg.norm(halfway, axis=1), 1, atol=1e-5)
