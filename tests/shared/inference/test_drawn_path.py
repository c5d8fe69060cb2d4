"""Paths from files: what is read, and what is refused."""

from pathlib import Path

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from src.shared.errors import UserError
from src.shared.inference.drawn_path import read_path


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
    with pytest.raises(UserError, match="cannot be read"):
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
