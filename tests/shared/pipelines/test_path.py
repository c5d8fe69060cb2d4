"""Paths from files: what is read, and what is refused.

Timing of paths: exact places, natural speeds, and a root row that leads there.
"""

from pathlib import Path

import numpy as np
import pytest
import torch
from hypothesis import example, given
from hypothesis import strategies as st

from src.shared.errors import UsageError, UserError
from src.shared.motion.features import FORWARD, LATERAL, ROOT_ROW, YAW_RATE, Place, decode_features
from src.shared.pipelines.path import (
    FASTEST,
    FASTEST_TURN,
    DrawnPath,
    TimedPath,
    distances_to_line,
    natural_sway,
    path_error,
    read_path,
    time_path,
)


def written(folder: Path, text: str, name: str = "path.csv") -> Path:
    file = folder / name
    file.write_text(text, encoding="utf-8")
    return file


@pytest.mark.parametrize(
    ("name", "text"),
    [
        ("a.csv", "x,z,t,heading\n0,1,0,90\n2,3,1.5,180\n"),
        ("a.csv", "heading, t ,Z,x\r\n90,0,1,0\r\n\r\n180,1.5,3,2\r\n"),
        ("a.csv", "0,1,0,90\n2,3,1.5,180"),
        ("a.json", "[[0, 1, 0, 90], [2, 3, 1.5, 180]]"),
        ("a.json", '{"points": [{"x": 0, "z": 1, "t": 0, "heading": 90},'
                   ' {"z": 3, "x": 2, "heading": 180, "t": 1.5}]}'),
        ("a.yaml", "points:\n- [0, 1, 0, 90]\n- [2, 3, 1.5, 180]\n"),
        ("a.yaml", "- {x: 0, z: 1, t: 0, heading: 90}\n- {x: 2, z: 3, t: 1.5, heading: 180}\n"),
    ],
)  # fmt: skip
def test_every_spelling_is_the_same_path(tmp_path: Path, name: str, text: str) -> None:
    path = read_path(written(tmp_path, text, name))
    np.testing.assert_allclose(path.points, [[0, 1], [2, 3]])
    assert path.times is not None and path.headings is not None
    np.testing.assert_allclose(path.times, [0, 1.5])
    np.testing.assert_allclose(path.headings, [np.pi / 2, np.pi])
    assert path.length == pytest.approx(8**0.5)


def test_two_columns_are_a_path_without_times(tmp_path: Path) -> None:
    path = read_path(written(tmp_path, "0,0\n0,2\n"))
    assert path.times is None and path.headings is None


def test_headings_turn_the_short_way(tmp_path: Path) -> None:
    path = read_path(written(tmp_path, "x,z,heading\n0,0,350\n0,1,10\n0,2,30\n"))
    assert path.headings is not None
    np.testing.assert_allclose(np.rad2deg(np.diff(path.headings)), [20, 20])


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("", "is empty"),
        ("x,z\n", "0 m long"),
        ("0,0\n", "0 m long"),
        ("1,1\n1,1\n", "0 m long"),
        ("0,0\n0,nan\n", "point 2: z is 'nan'"),
        ("0,0\ninf,1\n", "point 2: x is 'inf'"),
        ("0,0\n0,one\n", "point 2: z is 'one'"),
        ("0,0\n0\n", "point 2 is"),
        ("0\n1\n", "2 to 4 numbers"),
        ("x,y\n0,0\n0,1\n", "columns are x, y"),
        ("x,z,x\n0,0,0\n0,1,0\n", "columns are x, z, x"),
        ("0,0\n0,5000\n", "5000 m long"),
        ("x,z,t\n0,0,0\n0,1,0\n", "not after 0"),
        ("x,z,t\n0,0,1\n0,1,0\n", "not after 1"),
        ("x,z,t\n0,0,0\n0,90,1\n", "90.0 m/s"),
    ],
)
def test_nonsense_is_named(tmp_path: Path, text: str, message: str) -> None:
    with pytest.raises(UserError, match=message) as error:
        read_path(written(tmp_path, text))
    assert "path.csv" in str(error.value)


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("{}", "no list of points"),
        ("points: 3", "no list of points"),
        ("[1, 2]", "2 to 4 numbers"),
        ("[{x: 0, z: 0}, [0, 1]]", "point 2 is not like the first"),
        ("[[0, 0], [true, 1]]", "point 2: x is True"),
        ("[[0, 0], [.nan, 1]]", "point 2: x is nan"),
        ("[0, 0", "not valid YAML"),
    ],
)
def test_nonsense_in_yaml(tmp_path: Path, text: str, message: str) -> None:
    with pytest.raises(UserError, match=message):
        read_path(written(tmp_path, text, "path.yaml"))


def test_a_missing_and_a_binary_file(tmp_path: Path) -> None:
    with pytest.raises(UsageError, match="does not exist; give a"):
        read_path(tmp_path / "none.csv")
    (tmp_path / "b.csv").write_bytes(b"\xff\x00\x80")
    with pytest.raises(UserError, match="not UTF-8"):
        read_path(tmp_path / "b.csv")


@given(
    st.text(alphabet="0123456789.,-xzt \n[]{}:eE", max_size=60), st.sampled_from(["csv", "yaml"])
)
def test_any_text_is_a_path_or_an_error(tmp_path_factory, text: str, ending: str) -> None:
    file = tmp_path_factory.getbasetemp() / f"any.{ending}"
    file.write_text(text)
    try:
        path = read_path(file)
    except UserError as error:
        assert "\n" not in str(error)
    else:
        assert np.isfinite(path.points).all() and path.length > 0


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
    motion = decode_features(features, fps=path.fps, place=Place(x, z, float(path.headings[0])))
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
@example([(0.0, -0.11), (-0.1, -0.01)], 2.65)  # .05 s
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


def test_a_heading_sways_about_the_way_and_the_places_stay() -> None:
    path = time_path(LINE, fps=30.0)
    steps = 0.6 * np.sin(np.arange(len(path)) * 2 * np.pi / 30)
    swaying = path.swaying(steps)
    walked(swaying)
    apart = swaying.headings - path.headings
    assert apart[[0, -1]] == pytest.approx([0, 0], abs=1e-9) and 0.05 < apart.std() < 0.2
    still = np.linalg.norm(np.gradient(path.points, axis=0), axis=1) < 1e-3
    assert np.abs(np.diff(apart)[still[1:]]).max() < 2e-3
    features = torch.zeros(90, ROOT_ROW + 1, 6)
    features[:, ROOT_ROW, YAW_RATE] = torch.as_tensor(0.5 + steps[:90])
    sway = natural_sway(features, 30.0)
    assert sway.mean() == pytest.approx(0, abs=1e-6)
    np.testing.assert_allclose(sway[20:70], steps[20:70], atol=0.1)


def test_errors_are_distances() -> None:
    path = time_path(LINE, fps=30.0)
    beside = TimedPath(path.points + [0.03, 0.0], path.headings, 30.0)
    motion = decode_features(
        beside.constraint().values + 0.0, place=Place(*beside.points[0].tolist())
    )
    error = path_error(motion, path, LINE)
    assert error.mean == pytest.approx(0.03, abs=1e-3)
    assert error.line_mean == pytest.approx(0.03, abs=1e-3)
    np.testing.assert_allclose(
        distances_to_line(np.array([[1.0, 1.0], [3.0, 0.0]]), np.array([[0, 0], [2, 0.0]])), [1, 1]
    )
