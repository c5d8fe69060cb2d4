"""Timing of paths: exact places, natural speeds, and a root row that leads there."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from src.shared.errors import UserError
from src.shared.inference.drawn_path import FASTEST, DrawnPath
from src.shared.inference.path_following import (
    FASTEST_TURN,
    TimedPath,
    distances_to_line,
    path_error,
    time_path,
)
from src.shared.motion.root_track import FORWARD, LATERAL, ROOT_ROW, YAW_RATE, decode_features

AROUND = np.linspace(0, 2 * np.pi, 80)
EIGHT = DrawnPath(np.stack([np.sin(2 * AROUND), 2 * np.sin(AROUND)], axis=1))
SQUARE = DrawnPath(np.array([[0, 0], [0, 2], [2, 2], [2, 0.0]]))
LINE = DrawnPath(np.array([[1, 1], [1, 5.0]]))
BACK = DrawnPath(np.array([[0, 0], [0, 2], [0, 0.0]]))


def walked(path: TimedPath) -> np.ndarray:
    """Where the root row of the constraint leads."""
    x, z = path.points[0]
    features = path.constraint().values
    features[:, :ROOT_ROW, 0] = 1.0
    features[:, :ROOT_ROW, 4] = 1.0
    motion = decode_features(
        features, fps=path.fps, start_position=(x, z), start_heading=float(path.headings[0])
    )
    error = path_error(motion, path)
    assert error.max < 1e-4 and error.line_max < 1e-4
    return motion.root_position[:, [0, 2]]


@pytest.mark.parametrize(
    "drawn", [EIGHT, SQUARE, LINE, BACK], ids=["eight", "square", "line", "back"]
)
def test_a_path_is_followed_at_a_natural_speed(drawn: DrawnPath) -> None:
    path = time_path(drawn, fps=30.0, speed=1.2)
    made = walked(path)
    np.testing.assert_allclose(made[[0, -1]], drawn.points[[0, -1]], atol=1e-3)
    assert distances_to_line(made, drawn.points).mean() < 0.02
    speeds = np.linalg.norm(np.diff(made, axis=0), axis=1) * 30
    assert speeds.max() < 1.25 and speeds[0] < 0.5 and speeds[-1] < 0.5
    assert np.abs(np.diff(speeds)).max() * 30 < 6
    assert np.abs(np.diff(path.headings)).max() * 30 <= FASTEST_TURN + 1e-6
    known = path.constraint().known
    assert known[:, ROOT_ROW, [FORWARD, LATERAL, YAW_RATE]].all()
    assert int(known.sum()) == 3 * len(path)


@given(
    st.lists(st.tuples(st.floats(-5, 5), st.floats(-5, 5)), min_size=2, max_size=8),
    st.floats(0.3, 3.5),
)
def test_any_path_is_gone_smoothly(points: list[tuple[float, float]], speed: float) -> None:
    drawn = DrawnPath(np.array(points))
    if drawn.length < 0.05:
        return
    path = time_path(drawn, fps=30.0, speed=speed)
    assert np.isfinite(path.points).all() and np.isfinite(path.headings).all()
    steps = np.linalg.norm(np.diff(path.points, axis=0), axis=1) * 30
    assert steps.max() <= speed * 1.02 + 1e-6
    assert distances_to_line(path.points, drawn.points).max() < 0.12


def test_seconds_and_facing() -> None:
    path = time_path(LINE, fps=30.0, seconds=6.0)
    assert len(path) == 181
    backward = time_path(LINE, fps=30.0, facing=np.pi)
    np.testing.assert_allclose(backward.headings, np.pi, atol=1e-6)
    values = backward.constraint().values[:, ROOT_ROW]
    assert values[60, FORWARD] < -0.5 and abs(values[60, LATERAL]) < 1e-5
    with pytest.raises(UserError, match="too long for its time"):
        time_path(LINE, fps=30.0, seconds=0.5)


@given(st.integers(75, 400), st.floats(0.5, 3.0))
def test_as_many_frames_as_asked_for(frames: int, speed: float) -> None:
    assert len(time_path(LINE, fps=30.0, seconds=(frames - 1) / 30, speed=speed)) == frames


def test_who_runs_neither_starts_nor_stops() -> None:
    speeds = {
        speed: np.linalg.norm(
            np.diff(time_path(LINE, fps=30.0, speed=speed).points, axis=0), axis=1
        )
        for speed in (1.0, 3.0)
    }
    assert speeds[3.0].min() * 30 > 2.9
    assert (speeds[1.0][[*range(12), *range(-12, 0)]] == 0).all()


def test_times_and_headings_of_the_file_count() -> None:
    drawn = DrawnPath(
        np.array([[0, 0], [0, 1], [0, 1.5], [0, 4.0]]),
        times=np.array([1.0, 2.0, 4.0, 5.0]),
        headings=np.array([0.0, 0.0, 1.5, 1.5]),
    )
    path = time_path(drawn, fps=30.0)
    assert len(path) == 121
    np.testing.assert_allclose(path.points[[0, 30, 90, 120], 1], [0, 1, 1.5, 4], atol=1e-9)
    assert path.headings[0] == pytest.approx(0, abs=0.02)
    assert path.headings[-1] == pytest.approx(1.5, abs=0.02)
    walked(path)
    assert FASTEST > 1


def test_errors_are_distances() -> None:
    path = time_path(LINE, fps=30.0)
    beside = TimedPath(path.points + [0.03, 0.0], path.headings, 30.0)
    motion = decode_features(
        beside.constraint().values + 0.0, start_position=tuple(beside.points[0])
    )
    error = path_error(motion, path, LINE)
    assert error.mean == pytest.approx(0.03, abs=1e-3)
    assert error.line_mean == pytest.approx(0.03, abs=1e-3)
    np.testing.assert_allclose(
        distances_to_line(np.array([[1.0, 1.0], [3.0, 0.0]]), np.array([[0, 0], [2, 0.0]])), [1, 1]
    )
