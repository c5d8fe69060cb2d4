"""CSV of a motion: a documented header, exact numbers, and faults that name the line."""

import csv
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from src.shared.errors import UserError
from src.shared.formats.csv_files import MOTION_HEADER, read_motion_csv, write_motion_csv
from tests.shared.formats.writers.test_bvh import angle_between, random_motion


def test_columns_hold_world_places_and_quaternions(tmp_path: Path) -> None:
    motion = replace(random_motion(3, 2), fps=60.0)
    with write_motion_csv(motion, tmp_path / "a.csv").open(newline="") as stream:
        rows = list(csv.DictReader(stream))
    assert tuple(rows[0]) == MOTION_HEADER
    assert len(MOTION_HEADER) == 1 + 22 * 7 + 2
    assert float(rows[2]["time"]) == pytest.approx(2 / 60)
    wrist = [float(rows[1][f"r_wrist_{axis}"]) for axis in "xyz"]
    np.testing.assert_allclose(wrist, motion.positions()[1, 21], atol=1e-6)
    turn = np.array([float(rows[1][f"head_q{part}"]) for part in "wxyz"])
    w, x, y, z = turn / np.linalg.norm(turn)
    first_column = [1 - 2 * (y * y + z * z), 2 * (x * y + w * z), 2 * (x * z - w * y)]
    np.testing.assert_allclose(first_column, motion.global_rotations()[1, 15, :, 0], atol=1e-5)


def test_it_comes_back(tmp_path: Path) -> None:
    motion = random_motion(5, 3)
    back = read_motion_csv(write_motion_csv(motion, tmp_path / "a.csv"))
    assert back.fps == motion.fps
    np.testing.assert_array_equal(back.root_position, motion.root_position)
    assert angle_between(back.global_rotations(), motion.global_rotations()).max() < 1e-4
    single = read_motion_csv(write_motion_csv(random_motion(1), tmp_path / "b.csv"))
    assert (single.num_frames, single.fps) == (1, 30.0)


@pytest.mark.parametrize(
    ("change", "says"),
    [
        (lambda text: text.replace("pelvis_x", "hips_x", 1), "not the header of a motion"),
        (lambda text: text.replace("\n0.0333", "\nx.0333", 1), "line 3"),
        (lambda text: text.rstrip() + ",1\n", "line 4: 158 cells, expected 157"),
        (lambda text: text.replace("\n0.0333333333", "\n0.5", 1), "evenly"),
        (lambda text: text.replace("\n0.0666666667,", "\n0.0666666667,nan"), "line 4"),
        (lambda text: text.splitlines()[0], "no frames"),
    ],
)
def test_faults_name_the_place(tmp_path: Path, change: object, says: str) -> None:
    path = write_motion_csv(random_motion(3), tmp_path / "a.csv")
    path.write_text(change(path.read_text()))  # type: ignore[operator]
    with pytest.raises(UserError, match=says) as caught:
        read_motion_csv(path)
    assert str(path) in str(caught.value)


@settings(max_examples=60, deadline=None,
          suppress_health_check=[HealthCheck.function_scoped_fixture])  # fmt: skip
@given(st.binary(max_size=400), st.integers(0, 1 << 16))
def test_damaged_files_are_refused_or_read(tmp_path: Path, noise: bytes, place: int) -> None:
    path = write_motion_csv(random_motion(2), tmp_path / "a.csv")
    data = path.read_bytes()
    place %= len(data)
    path.write_bytes(data[:place] + noise + data[place + len(noise) :])
    try:
        read_motion_csv(path)
    except UserError as error:
        assert str(path) in str(error)
