"""Windows out of a trajectory and back: one by one, joined, and as they come."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from src.shared.motion.trajectory import (
    ACCELERATION,
    POSITION,
    QUATERNION,
    MotionTrajectory,
    WindowJoiner,
    encode_window,
    place_window,
    unwrap_phase,
)
from tests.shared.motion.trajectories import smooth_trajectory

seeds = st.integers(0, 10_000)


def cut(whole: MotionTrajectory, length: int, overlap: int) -> list[np.ndarray]:
    phase = whole.phase_unwrapped
    starts = range(0, whole.num_frames - overlap, length - overlap)
    return [
        encode_window(whole.data[s : s + length], phase[s : s + length])
        for s in starts
        if len(whole.data[s : s + length]) > overlap
    ]


def join_windows(windows: list[np.ndarray], overlap: int, phase: float = 0.0) -> MotionTrajectory:
    joiner = WindowJoiner(overlap, phase=phase)
    pieces = [joiner.add(window).data for window in windows]
    return MotionTrajectory(np.concatenate([*pieces, joiner.finish().data]))


def start(whole: MotionTrajectory) -> dict[str, object]:
    return {
        "position": (float(whole.position[0, 0]), float(whole.position[0, 2])),
        "heading": float(whole.heading[0]),
        "phase": float(whole.phase[0]),
    }


@settings(max_examples=25, deadline=None)
@given(seeds)
def test_a_window_is_local(seed: int) -> None:
    whole = smooth_trajectory(seed, 40)
    window = encode_window(whole.data, whole.phase_unwrapped)
    assert window.shape == (25, 40) and window.dtype == np.float32
    first = MotionTrajectory(window.T)
    assert np.abs(first.position[0, [0, 2]]).max() < 1e-6
    assert window[1] == pytest.approx(whole.data[:, 1], abs=1e-6)
    assert abs(first.heading[0]) < 1e-5 and window[9, 0] >= 0
    assert (window[16] > 0).all() and window[16, -1] == window[16, -2]


@settings(max_examples=25, deadline=None)
@given(seeds)
def test_placing_undoes_encoding(seed: int) -> None:
    whole = smooth_trajectory(seed, 40)
    back = place_window(encode_window(whole.data, whole.phase_unwrapped), **start(whole))  # type: ignore[arg-type]
    assert_close(back, whole.data)


@settings(max_examples=25, deadline=None)
@given(seeds, st.integers(20, 50), st.integers(1, 12))
def test_joining_overlapping_windows_gives_the_whole(seed: int, length: int, overlap: int) -> None:
    whole = smooth_trajectory(seed, 150)
    phase = float(whole.phase[0])
    local = place_window(encode_window(whole.data, whole.phase_unwrapped), phase=phase)
    joined = join_windows(cut(whole, length, overlap), overlap, phase)
    assert joined.num_frames == whole.num_frames
    assert np.abs(joined.data[:, POSITION] - local[:, POSITION]).max() < 1e-4
    assert np.abs(joined.data[:, QUATERNION] - local[:, QUATERNION]).max() < 1e-4
    assert_close(joined.data, local)


def test_every_window_settles_some_frames() -> None:
    windows = cut(smooth_trajectory(4, 200), 60, 10)
    joiner = WindowJoiner(10)
    assert all(joiner.add(window).num_frames for window in windows)


def test_windows_that_disagree_are_blended_without_a_jump() -> None:
    windows = [encode_window(w.data, w.phase_unwrapped)
               for w in (smooth_trajectory(seed, 90) for seed in range(6))]  # fmt: skip
    joined = join_windows(windows, 20)
    assert joined.num_frames == 6 * 90 - 5 * 20
    assert np.linalg.norm(np.diff(joined.position, axis=0), axis=1).max() < 0.5
    dots = (joined.quaternion[1:] * joined.quaternion[:-1]).sum(1)
    assert dots.min() > 0.95
    steps = np.diff(unwrap_phase(joined.phase))
    assert steps.min() > 0.009 and steps.max() < 0.031
    assert np.linalg.norm(joined.style, axis=1) == pytest.approx(1, abs=1e-5)


def assert_close(data: np.ndarray, expected: np.ndarray) -> None:
    """Within 1e-4, phase around the circle; accelerations carry 900 times float32's error."""
    error = np.abs(data - expected)
    error[:, 16] = np.minimum(error[:, 16], 1 - error[:, 16])
    assert error[:, ACCELERATION].max() < 5e-3
    error[:, ACCELERATION] = 0
    assert error.max() < 1e-4
