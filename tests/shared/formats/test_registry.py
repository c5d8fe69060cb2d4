"""The table of exporters: every format, by name or by ending, and clear refusals."""

from pathlib import Path

import numpy as np
import pytest

from src.shared.errors import UsageError, UserError
from src.shared.formats.registry import EXPORTERS, export_motion, write_motion, write_preview
from src.shared.motion.motion import Motion


def a_motion(frames: int = 5) -> Motion:
    quaternions = np.zeros((frames, 22, 4), np.float32)
    quaternions[..., 0] = 1.0
    root = np.tile(np.array([0.0, 0.95, 0.0], np.float32), (frames, 1))
    return Motion(quaternions, root, np.ones((frames, 2), np.float32), 30.0, "a person stands")


STARTS = {
    "bvh": b"HIERARCHY",
    "glb": b"glTF",
    "npz": b"PK",
    "html": b"<!doctype",
    "png": b"\x89PNG",
}


def test_every_format_is_written(tmp_path: Path) -> None:
    paths = export_motion(a_motion(), tmp_path / "deep" / "folder", "stand", tuple(EXPORTERS))
    assert list(paths) == list(STARTS)
    for name, path in paths.items():
        assert path.name == f"stand.{name}"
        assert path.read_bytes().startswith(STARTS[name])
    assert len(list((tmp_path / "deep" / "folder").iterdir())) == len(STARTS)  # no leftovers


def test_the_ending_names_the_format(tmp_path: Path) -> None:
    assert write_motion(a_motion(), tmp_path / "A.BVH").read_bytes().startswith(b"HIERARCHY")


def test_unknown_formats_are_refused_before_anything_is_written(tmp_path: Path) -> None:
    with pytest.raises(UsageError, match=r"'fbx' is not a format; choose from bvh, glb, npz, html"):
        export_motion(a_motion(), tmp_path, "x", ["bvh", "fbx"])
    with pytest.raises(UsageError, match="'fbx'"):
        write_motion(a_motion(), tmp_path / "x.fbx")
    assert not list(tmp_path.iterdir())


def test_motions_that_cannot_be_shown_are_refused(tmp_path: Path) -> None:
    bad = a_motion()
    bad.quaternions[2, 3] = np.nan
    for motion in (bad, a_motion(0)):
        with pytest.raises(UserError, match="cannot write"):
            write_motion(motion, tmp_path / "x.bvh")
        with pytest.raises(UserError, match="cannot write"):
            write_preview([a_motion(), motion], tmp_path / "x.html")
    assert not list(tmp_path.iterdir())


def test_a_target_that_cannot_be_written(tmp_path: Path) -> None:
    (tmp_path / "x.npz").mkdir()
    with pytest.raises(UserError, match="cannot write"):
        write_motion(a_motion(), tmp_path / "x.npz")
    assert [path.name for path in tmp_path.iterdir()] == ["x.npz"]
