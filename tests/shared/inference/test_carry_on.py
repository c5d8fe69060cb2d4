"""A window that nearly continues its known frames: no teleport stays, a good one hardly changes."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from src.shared.inference.carry_on import POSE_FRAMES, SPEED_FRAMES, carry_on
from src.shared.motion.trajectory import POSITION, QUATERNION, MotionTrajectory
from src.shared.motion.window import encode_window

K, W = 30, 150


def walk(turn: float = 0.3) -> np.ndarray:
    """A window [25,W] of a smooth turning walk."""
    at = np.arange(W + 2) / 30
    angle = turn * at
    speed = 1 + 0.2 * np.cos(2 * np.pi * at)
    ground = np.cumsum(np.stack([np.sin(angle), np.cos(angle)], 1) * speed[:, None], 0) / 30
    position = np.stack([ground[:, 0], 0.9 + 0.03 * np.sin(4 * at), ground[:, 1]], 1)
    zero = np.zeros_like(at)
    quaternion = np.stack([np.cos(angle / 2), zero, np.sin(angle / 2), zero], 1)
    path = MotionTrajectory.from_pose(position, quaternion, at / 2, spare=2)
    return encode_window(path.data, path.phase_unwrapped)


def missed(offset: tuple[float, float, float], turn: float) -> np.ndarray:
    """The walk whose rest lies somewhere else, turned about the vertical."""
    rows = walk()
    rows[POSITION, K:] += np.array(offset)[:, None]
    w, x, y, z = rows[QUATERNION, K:].copy()
    cos, sin = np.cos(turn / 2), np.sin(turn / 2)
    rows[QUATERNION, K:] = np.stack(
        [cos * w - sin * y, cos * x + sin * z, cos * y + sin * w, cos * z - sin * x]
    )
    return rows


def largest_acceleration(rows: np.ndarray) -> float:
    return float(np.linalg.norm(np.diff(rows[POSITION].astype(float), n=2, axis=1), axis=0).max())


meters = st.floats(-1.5, 1.5)


@given(st.tuples(meters, st.floats(-0.2, 0.2), meters), st.floats(-2.5, 2.5))
def test_no_teleport_is_left(offset: tuple[float, float, float], turn: float) -> None:
    rows, right = missed(offset, turn), walk()
    carry_on(rows, K)
    assert np.array_equal(rows[:, :K], right[:, :K])
    assert largest_acceleration(rows) * 900 < 8.0  # m/s²; an offset of 1 m is 900
    q = rows[QUATERNION]
    assert (q[:, 1:] * q[:, :-1]).sum(0).min() > 0.99
    assert np.linalg.norm(q, axis=0) == pytest.approx(1.0, abs=1e-5)


def test_later_it_is_the_networks_own_motion() -> None:
    rows, right = missed((0.5, 0.1, -0.8), 0.6), missed((0.5, 0.1, -0.8), 0.6)
    carry_on(rows, K)
    settled = K + max(SPEED_FRAMES, POSE_FRAMES)
    steps, own = (np.diff(window[POSITION][:, settled:], axis=1) for window in (rows, right))
    assert steps == pytest.approx(own, abs=1e-5)
    assert rows[1, settled:] == pytest.approx(right[1, settled:], abs=1e-6)  # height comes back
    dots = (rows[QUATERNION, settled:] * right[QUATERNION, settled:]).sum(0)
    assert np.abs(dots) == pytest.approx(1.0, abs=1e-5)


def test_the_join_accelerates_like_its_neighbours() -> None:
    rows, right = missed((0.4, 0.0, 0.3), 0.0), walk()
    carry_on(rows, K)
    found, own = (np.diff(window[POSITION], n=2, axis=1)[:, K - 2 : K] for window in (rows, right))
    assert found == pytest.approx(own, abs=4e-4)  # 0.4 m/s²


def test_what_goes_on_already_hardly_changes() -> None:
    rows, right = walk(), walk()
    carry_on(rows, K)
    assert rows[POSITION] == pytest.approx(right[POSITION], abs=0.003)
    assert rows[QUATERNION] == pytest.approx(right[QUATERNION], abs=1e-5)
    untouched = [row for row in range(25) if not (row < 3 or 9 <= row < 13)]
    assert np.array_equal(rows[untouched], right[untouched])


@pytest.mark.parametrize(("known", "frames"), [(0, W), (2, W), (W - 2, W), (W, W), (8, 10)])
def test_nothing_to_mend_is_left_alone(known: int, frames: int) -> None:
    rows = missed((1.0, 0.0, 0.0), 0.0)[:, :frames]
    before = rows.copy()
    carry_on(rows, known)
    assert np.array_equal(rows, before)
