"""Styles are unit, slow, and say what they are named for."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from src.shared.errors import UsageError
from src.shared.motion.style import (
    PAIRS,
    WORDS,
    measure_style,
    named_style,
    only_style_words,
    style_values,
    style_vector,
)
from src.shared.motion.trajectory import NEUTRAL_STYLE, MotionTrajectory
from tests.shared.motion.trajectories import smooth_trajectory

values = st.lists(st.floats(0, 1), min_size=4, max_size=4)


def path(speed: float, *, radius: float = 1.0, pulse: float = 0.0, shake: float = 0.0,
         seconds: float = 8.0) -> MotionTrajectory:  # fmt: skip
    """Round a circle, with a speed that may pulse twice a second, and a shake at 6 Hz."""
    t = np.arange(int(seconds * 30)) / 30
    rate = speed / radius
    angle = rate * t - rate * pulse / (4 * np.pi) * np.cos(4 * np.pi * t)
    position = np.stack((radius * np.cos(angle), 0.9 + 0 * t, radius * np.sin(angle)), 1)
    position[:, 1] += shake * np.sin(2 * np.pi * 6 * t)
    return MotionTrajectory.from_pose(position, np.tile((1.0, 0, 0, 0), (len(t), 1)), 0 * t)


def middle(trajectory: MotionTrajectory) -> dict[str, float]:
    style = measure_style(trajectory)
    return dict(zip(PAIRS, style_values(style[len(style) // 2]).tolist(), strict=True))


@settings(max_examples=50)
@given(values)
def test_vectors_are_unit_and_give_their_values_back(given: list[float]) -> None:
    style = style_vector(np.array(given))
    assert np.linalg.norm(style) == pytest.approx(1, abs=1e-6)
    assert style_values(style) == pytest.approx(np.array(given), abs=1e-5)


def test_each_pair_follows_what_it_is_named_for() -> None:
    base = middle(path(1.0))
    assert middle(path(3.0))["intensity"] > base["intensity"] + 0.2
    assert middle(path(1.0, radius=0.1))["extent"] < base["extent"] - 0.2
    assert middle(path(1.0, pulse=0.8))["rhythm"] > base["rhythm"] + 0.2
    assert middle(path(1.0, shake=0.02))["attitude"] > base["attitude"] + 0.2


@settings(max_examples=20)
@given(st.integers(0, 1000), st.integers(1, 200))
def test_measured_styles_are_unit_and_slow(seed: int, num_frames: int) -> None:
    whole = smooth_trajectory(seed, num_frames)
    style = measure_style(whole)
    assert style.shape == (num_frames, 8) and style.dtype == np.float32
    assert np.linalg.norm(style, axis=1) == pytest.approx(1, abs=1e-5)
    if num_frames > 1:
        assert np.linalg.norm(np.diff(style, axis=0), axis=1).max() < 0.1


def test_a_still_body_is_calm_and_finite() -> None:
    still = MotionTrajectory.from_pose(np.zeros((60, 3)), np.tile((1.0, 0, 0, 0), (60, 1)),
                                       np.zeros(60))  # fmt: skip
    assert np.isfinite(measure_style(still)).all()
    assert middle(still)["intensity"] < 0.01


def test_words_become_styles() -> None:
    tired = style_values(named_style("tired, elderly"))
    assert tired[PAIRS.index("intensity")] == pytest.approx(0.15)
    assert tired[PAIRS.index("extent")] == pytest.approx(0.2)
    assert style_values(named_style("Energetic"))[0] > 0.8
    assert named_style("neutral") == pytest.approx(NEUTRAL_STYLE)
    assert style_values(named_style("slow and fast"))[0] == pytest.approx(0.5)
    for word in WORDS:
        assert np.linalg.norm(named_style(word)) == pytest.approx(1)


@pytest.mark.parametrize(("words", "message"), [
    ("", "names no style"), (" , ", "names no style"),
    ("energetik", "did you mean 'energetic'"), ("tired, purple", "'purple' is not a known style"),
])  # fmt: skip
def test_unknown_words_are_answered_with_the_known(words: str, message: str) -> None:
    with pytest.raises(UsageError, match=message) as caught:
        named_style(words)
    assert "elderly" in str(caught.value)


def test_sentences_are_told_from_lists_of_styles() -> None:
    assert only_style_words("tired, Elderly and slow")
    assert not only_style_words("a tired man walks") and not only_style_words("tird")
