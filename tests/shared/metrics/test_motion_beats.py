"""Motion beats of made-up paths, and alignment against its definition."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from src.shared.metrics.rhythm import (
    alignment,
    beat_alignment,
    chance_alignment,
    motion_beats,
    smoothed_speed,
)


def path(period: float, seconds: float = 8.0, fps: float = 30.0, depth: float = 0.3) -> np.ndarray:
    """[T,3]: a straight walk slowest at period/2, 3/2 period, ..."""
    t = np.arange(round(seconds * fps)) / fps
    z = 1.2 * t + depth * period / (2 * np.pi) * np.sin(2 * np.pi * t / period)
    return np.stack((0 * t, 0 * t + 0.9, z), 1)


@settings(deadline=None, max_examples=30)
@given(st.floats(0.35, 1.2))
def test_beats_are_where_the_walk_is_slowest(period: float) -> None:
    found = motion_beats(path(period)).times
    wanted = np.arange(period / 2, 8.0, period)
    inside = (wanted > 0.3) & (wanted < 7.7)
    distance = np.abs(found[:, None] - wanted[inside]).min(0)
    assert distance.max() < 0.01
    assert abs(len(found) - len(wanted)) <= 2


def test_the_period_is_that_of_the_walk() -> None:
    beats = motion_beats(path(0.5))
    assert beats.period == pytest.approx(0.5, abs=0.01)
    none = motion_beats(path(0.5, depth=0.0))
    assert len(none.times) == 0 and none.period == float("inf")


def test_a_whole_body_gives_the_mean_of_its_joints() -> None:
    walk = path(0.6)
    body = np.stack((walk, walk + 1.0), 1)  # T 2 3
    assert np.allclose(smoothed_speed(body, 30.0), smoothed_speed(walk, 30.0))
    assert np.allclose(motion_beats(body).times, motion_beats(walk).times)


@pytest.mark.parametrize("frames", [0, 1, 2, 3])
def test_short_paths_have_no_beats(frames: int) -> None:
    assert len(motion_beats(np.zeros((frames, 3))).times) == 0


@settings(deadline=None, max_examples=50)
@given(
    st.lists(st.floats(0, 20), min_size=1, max_size=30, unique=True),
    st.lists(st.floats(0, 20), min_size=1, max_size=30, unique=True),
)
def test_alignment_is_its_definition(beats: list[float], others: list[float]) -> None:
    a, b = np.sort(beats), np.sort(others)
    wanted = np.exp(-(np.abs(a[:, None] - b).min(1) ** 2) / (2 * 0.05**2)).mean()
    assert beat_alignment(a, b) == pytest.approx(wanted)


def test_alignment_without_beats() -> None:
    assert np.isnan(beat_alignment(np.zeros(0), np.ones(1)))
    assert beat_alignment(np.ones(1), np.zeros(0)) == 0.0


def test_both_directions_differ_where_one_has_more_beats() -> None:
    music = np.arange(0, 10, 0.5)
    found = alignment(music[::2], music, 10.0)
    assert found.motion_to_music == pytest.approx(1.0)
    assert found.music_to_motion == pytest.approx(0.5, abs=0.01)


def test_beats_beyond_the_ends_are_neighbours_only() -> None:
    found = alignment(np.array([0.01, 5.0, 11.0]), np.array([-0.01, 5.0]), 10.0)
    assert found.motion_to_music > 0.9 and found.music_to_motion == pytest.approx(1.0)


def test_chance_is_low_for_perfect_pairs() -> None:
    """Equal beats 0.6 s apart meet within 0.05 s by chance in about a fifth of the time."""
    beats = np.arange(0, 12, 0.6)
    found = chance_alignment(beats, beats, 12.0, np.random.default_rng(0), n=400)
    wanted = 0.05 * np.sqrt(2 * np.pi) / 0.6  # mean of the Gaussian over one interval
    assert found.motion_to_music == pytest.approx(wanted, abs=0.04)
