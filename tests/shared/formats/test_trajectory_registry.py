"""Trajectory writers by ending: every format writes, unknown ones name the known."""

from pathlib import Path

import numpy as np
import pytest

from src.shared.errors import UsageError, UserError
from src.shared.formats.preview.trajectory import SongTrack
from src.shared.formats.registry import (
    TRAJECTORY_EXPORTERS,
    export_trajectory,
    write_motion,
    write_trajectory,
    write_trajectory_preview,
)
from src.shared.motion.trajectory import MotionTrajectory
from tests.shared.formats.pages import Page
from tests.shared.motion.trajectories import smooth_trajectory

STARTS = {"npz": b"PK", "csv": b"time", "glb": b"glTF", "html": b"<!doctype html>",
          "png": b"\x89PNG"}  # fmt: skip


def broken(value: float, column: slice | int) -> MotionTrajectory:
    data = smooth_trajectory(1, 5).data.copy()
    data[2, column] = value
    return MotionTrajectory(data)


@pytest.mark.parametrize("name", TRAJECTORY_EXPORTERS)
def test_every_format_writes_by_its_ending(tmp_path: Path, name: str) -> None:
    path = tmp_path / "new" / f"a.{name.upper()}"
    assert write_trajectory(smooth_trajectory(1, 5), path, title="a song") == path
    assert path.read_bytes().startswith(STARTS[name])
    assert [entry.name for entry in path.parent.iterdir()] == [path.name]
    written = path.read_bytes()
    assert write_motion(smooth_trajectory(1, 5), path) == path  # by the public name, too
    assert name not in ("npz", "csv") or path.read_bytes() == written


@pytest.mark.parametrize("name", TRAJECTORY_EXPORTERS)
def test_trajectories_that_cannot_be_shown_are_refused(tmp_path: Path, name: str) -> None:
    path = tmp_path / f"a.{name}"
    for trajectory, reason in (
        (broken(np.nan, 0), "NaN"),
        (broken(np.inf, 20), "NaN or infinite"),
        (broken(0.0, slice(9, 13)), "quaternion of zeros"),
        (MotionTrajectory(np.zeros((0, 25), np.float32)), "no frames"),
    ):
        with pytest.raises(UserError, match=reason):
            write_trajectory(trajectory, path)
        with pytest.raises(UserError, match=reason):
            write_trajectory_preview([smooth_trajectory(1, 5), trajectory], path)
    assert not list(tmp_path.iterdir())


def test_several_formats_at_once_and_unknown_ones(tmp_path: Path) -> None:
    paths = export_trajectory(smooth_trajectory(1, 5), tmp_path, "song", ("npz", "glb"))
    assert paths == {"npz": tmp_path / "song.npz", "glb": tmp_path / "song.glb"}
    with pytest.raises(UsageError, match="'bvh' is not a format; choose from npz, csv, glb"):
        export_trajectory(smooth_trajectory(1, 5), tmp_path / "b", "a", ("npz", "bvh"))
    with pytest.raises(UsageError, match="choose from"):
        write_trajectory(smooth_trajectory(1, 5), tmp_path / "b" / "a")
    assert not (tmp_path / "b").exists()


def test_a_preview_has_a_card_for_each(tmp_path: Path) -> None:
    shown = [smooth_trajectory(seed, 5) for seed in range(3)]
    path = write_trajectory_preview(shown, tmp_path / "i.html", SongTrack(meter=3), ["a", "b"])
    motions = Page(path).data["motions"]
    assert [motion["text"] for motion in motions] == ["a", "b", ""]
    assert {motion["meter"] for motion in motions} == {3}
    with pytest.raises(UserError, match="no trajectory"):
        write_trajectory_preview([], tmp_path / "j.html")


def test_a_song_may_be_just_a_path(tmp_path: Path) -> None:
    soundfile = pytest.importorskip("soundfile")
    soundfile.write(tmp_path / "a.wav", np.zeros(800), 8000)
    path = write_trajectory(smooth_trajectory(1, 5), tmp_path / "a.html", tmp_path / "a.wav")
    assert 'src="data:audio/wav;base64,' in path.read_text("utf-8")
