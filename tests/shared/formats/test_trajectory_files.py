"""Trajectories to NPZ, NPY and CSV and back; files that are no trajectories."""

from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from src.shared.errors import UsageError, UserError
from src.shared.formats.arrays import COLUMNS, write_npz, write_trajectory_npz
from src.shared.formats.csv_files import write_trajectory_csv
from src.shared.formats.registry import read_trajectory
from src.shared.motion.trajectory import MotionTrajectory, to_motion
from tests.shared.motion.trajectories import smooth_trajectory


@settings(max_examples=15)
@given(st.integers(0, 1000), st.integers(1, 60), st.sampled_from((24.0, 29.97, 30.0, 120.0)))
def test_files_give_back_every_bit(
    tmp_path_factory: pytest.TempPathFactory, seed: int, num_frames: int, fps: float
) -> None:
    whole = smooth_trajectory(seed, num_frames, fps=fps)
    folder = tmp_path_factory.mktemp("files")
    for path in (
        write_trajectory_npz(whole, folder / "a.npz"),
        write_trajectory_csv(whole, folder / "a.csv"),
    ):
        back = read_trajectory(path)
        assert np.array_equal(back.data, whole.data)
        if num_frames > 1 or path.suffix == ".npz":
            assert back.fps == pytest.approx(fps, abs=1e-3)


def test_npz_tells_its_columns_and_unwrapped_phase(tmp_path: Path) -> None:
    whole = smooth_trajectory(3, 200)
    with np.load(write_trajectory_npz(whole, tmp_path / "a.npz")) as archive:
        assert archive["columns"].tolist() == list(COLUMNS) and len(set(COLUMNS)) == 25
        assert (np.diff(archive["phase_bars"]) > 0).all() and archive["phase_bars"][-1] > 1


def test_npy_and_the_pelvis_of_a_body(tmp_path: Path) -> None:
    whole = smooth_trajectory(3, 50)
    np.save(tmp_path / "a.npy", whole.data)
    assert np.array_equal(read_trajectory(tmp_path / "a.npy").data, whole.data)
    body = read_trajectory(write_npz(to_motion(whole), tmp_path / "body.npz"))
    assert np.abs(body.position - whole.position).max() < 1e-6


def save(path: Path, data: object) -> Path:
    np.save(path, np.asarray(data))
    return path


def replaced(data: np.ndarray, column: int, value: float) -> np.ndarray:
    copy = data.copy()
    copy[2, column : column + 4] = value
    return copy


def test_what_is_no_trajectory_is_named(tmp_path: Path) -> None:
    data = smooth_trajectory(1, 9).data
    for array, message in (
        (data.T, "time first"),
        (data[None], "time first"),
        (data[:0], "no frames"),
        (replaced(data, 0, np.nan), "NaN"),
        (replaced(data, 9, 0), "zeros"),
        (data.astype(str), "expected numbers"),
    ):
        with pytest.raises(UserError, match=message):
            read_trajectory(save(tmp_path / "a.npy", array))
    with pytest.raises(UsageError, match="known are npz, npy, csv"):
        read_trajectory(tmp_path / "a.bvh")
    for ending in ("npz", "npy", "csv"):
        with pytest.raises(UserError, match="does not exist"):
            read_trajectory(tmp_path / f"none.{ending}")
    (tmp_path / "cut.npz").write_bytes(b"PK\x03\x04 cut")
    with pytest.raises(UserError, match="not a whole NPZ"):
        read_trajectory(tmp_path / "cut.npz")
    np.savez(tmp_path / "other.npz", weights=data)
    with pytest.raises(UserError, match="no array 'trajectory'"):
        read_trajectory(tmp_path / "other.npz")
    np.savez(tmp_path / "rate.npz", trajectory=data, fps=0)
    with pytest.raises(UserError, match="frame rate"):
        read_trajectory(tmp_path / "rate.npz")


def test_damaged_tables_are_named_by_line(tmp_path: Path) -> None:
    path = write_trajectory_csv(smooth_trajectory(1, 5), tmp_path / "a.csv")
    lines = path.read_text(encoding="utf-8").splitlines()
    for spoiled, message in (
        (["x" + lines[0], *lines[1:]], "header"),
        ([], "is empty"),
        (lines[:1], "no frames"),
        ([*lines[:2], lines[2] + ",1"], "line 3: 27 cells"),
        ([*lines[:2], "hop" + lines[2]], "line 3: could not convert"),
        ([*lines[:3], lines[4]], "evenly"),
    ):
        path.write_text("\n".join(spoiled), encoding="utf-8")
        with pytest.raises(UserError, match=message):
            read_trajectory(path)
    path.write_text("\ufeff" + "\r\n".join(lines), encoding="utf-8")
    assert isinstance(read_trajectory(path), MotionTrajectory)
