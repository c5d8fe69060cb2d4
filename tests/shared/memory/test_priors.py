"""Prior curves: known motions have known curves, and every curve stays in [0, 1]."""

import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from src.shared.memory.priors import DENSITY, ENERGY, HALF, STABILITY, TENSION, prior_curves
from src.shared.motion.trajectory import MotionTrajectory
from tests.shared.evaluation.tiny_pairs import nod


def path(position: np.ndarray) -> np.ndarray:
    quaternion = np.tile([1.0, 0, 0, 0], (len(position), 1))
    return MotionTrajectory.from_pose(position, quaternion, np.zeros(len(position)), spare=2).data


def straight(speed: float, frames: int = 92) -> np.ndarray:
    position = np.zeros((frames, 3))
    position[:, 2] = np.arange(frames) / 30 * speed
    return path(position)


def test_standing_is_stable_and_nothing_else() -> None:
    curves = prior_curves(straight(0.0))
    assert np.allclose(curves[[ENERGY, DENSITY, TENSION]], 0)
    assert np.allclose(curves[STABILITY], 1)


def test_an_even_glide_has_energy_alone() -> None:
    curves = prior_curves(straight(HALF[ENERGY]))
    assert np.allclose(curves[ENERGY], 0.5, atol=1e-4), "x / (x + x0) at x0"
    assert np.allclose(curves[TENSION], 0, atol=1e-3)
    assert np.allclose(curves[STABILITY], 1, atol=1e-3)


def test_constant_jerk() -> None:
    time = np.arange(92) / 30
    position = np.stack([HALF[TENSION] * time**3 / 6, 0 * time, 0 * time], 1)
    assert np.allclose(prior_curves(path(position))[TENSION, 20:70], 0.5, atol=0.01)


def test_density_counts_beats_and_onsets() -> None:
    bars = np.arange(302) / 30 / 2  # two beats a second
    curves = prior_curves(nod(bars).data)
    assert np.allclose(curves[DENSITY, 60:-60], 0.5, atol=0.05)
    onsets = np.zeros(300)
    onsets[::5] = 1.0  # six a second: 6 / (6 + 2)
    both = prior_curves(nod(bars).data, onsets=onsets)
    assert np.allclose(both[DENSITY, 60:-60], (0.5 + 0.75) / 2, atol=0.05)


def test_faster_is_more_energetic_and_contacts_are_stable() -> None:
    slow, fast = (prior_curves(straight(speed))[ENERGY].mean() for speed in (0.5, 2.0))
    assert fast > slow
    contacts = np.zeros((90, 2))
    in_the_air = prior_curves(straight(1.0), contacts=contacts)[STABILITY]
    on_foot = prior_curves(straight(1.0), contacts=contacts + 1)[STABILITY]
    assert np.allclose(in_the_air, 0.5, atol=1e-3) and np.allclose(on_foot, 1, atol=1e-3)


@given(seed=st.integers(0, 99), frames=st.integers(1, 80), size=st.floats(0, 1e3))
def test_any_path_stays_in_range(seed: int, frames: int, size: float) -> None:
    rng = np.random.default_rng(seed)
    data = (rng.standard_normal((frames, 25)) * size).astype(np.float32)
    curves = prior_curves(data, onsets=rng.random(frames), contacts=rng.random((frames, 2)))
    assert curves.shape == (4, frames) and curves.dtype == np.float32
    assert np.isfinite(curves).all() and curves.min() >= 0 and curves.max() <= 1
