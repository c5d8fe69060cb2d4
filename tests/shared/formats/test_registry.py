"""Exporters by ending: every format writes, unknown ones name the known, NaN is refused."""

from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from src.shared.errors import UsageError, UserError
from src.shared.formats.registry import (
    EXPORTERS,
    ending,
    export_motion,
    format_of,
    write_motion,
    write_preview,
)
from src.shared.motion.motion import Motion

STARTS = {"bvh": b"HIERARCHY", "glb": b"glTF", "npz": b"PK", "html": b"<!doctype html>",
          "vrm": b"glTF", "vrma": b"glTF", "png": b"\x89PNG", "usd": b"#usda", "usda": b"#usda",
          "usdc": b"PXR-USDC", "amass": b"PK", "csv": b"time,pelvis_x", "gif": b"GIF89a",
          "mp4": b"\0\0\0 ftyp", "fbx": b"Kaydara FBX Binary"}  # fmt: skip
PACKAGES = {"usdc": "pxr", "mp4": "av", "fbx": "bpy"}
OWN = [name for name in EXPORTERS if name != "fbx"]  # without a program beside: test_blender.py


def standing(frames: int = 3) -> Motion:
    quaternions = np.zeros((frames, 22, 4), np.float32)
    quaternions[..., 0] = 1
    root = np.tile(np.array([0, 0.93, 0], np.float32), (frames, 1))
    return Motion(quaternions, root, np.ones((frames, 2), np.float32), 30.0, "stands")


@pytest.mark.parametrize("name", EXPORTERS)
def test_every_format_writes_by_its_ending(tmp_path: Path, name: str) -> None:
    if name in PACKAGES:
        pytest.importorskip(PACKAGES[name])
    path = tmp_path / "new" / f"a.{ending(name).upper()}"
    assert write_motion(standing(), path) == path
    assert path.read_bytes().startswith(STARTS[name])
    assert [entry.name for entry in path.parent.iterdir()] == [path.name]


@pytest.mark.parametrize("name", ["a.dae", "a", "a.tar.gz"])
def test_unknown_endings_name_the_known_ones(tmp_path: Path, name: str) -> None:
    with pytest.raises(UsageError, match="bvh, glb, usd"):
        write_motion(standing(), tmp_path / name)
    assert not list(tmp_path.iterdir())


def test_amass_is_told_by_its_double_ending() -> None:
    assert format_of("a/b.AMASS.npz") == "amass"
    assert format_of("a/amass.npz") == "npz"
    assert ending("amass") == "amass.npz"


def test_several_formats_at_once(tmp_path: Path) -> None:
    paths = export_motion(standing(), tmp_path, "01-stand", ("npz", "bvh"))
    assert paths == {"npz": tmp_path / "01-stand.npz", "bvh": tmp_path / "01-stand.bvh"}
    assert all(path.exists() for path in paths.values())
    with pytest.raises(UsageError, match="'obj' is not a format"):
        export_motion(standing(), tmp_path / "other", "a", ("bvh", "obj"))
    assert not (tmp_path / "other").exists()


@pytest.mark.parametrize("name", OWN)
def test_motions_that_cannot_be_shown_are_refused(tmp_path: Path, name: str) -> None:
    broken = replace(standing(), root_position=np.full((3, 3), np.nan, np.float32))
    with pytest.raises(UserError, match="NaN"):
        write_motion(broken, tmp_path / f"a.{ending(name)}")
    with pytest.raises(UserError, match="no frames"):
        write_motion(standing(0), tmp_path / f"a.{ending(name)}")
    with pytest.raises(UserError, match="NaN"):
        write_preview([standing(), broken], tmp_path / "index.html")
    assert not list(tmp_path.iterdir())


@pytest.mark.parametrize(
    ("change", "line"),
    [
        ({"fps": 0.0}, "fps is 0.0"),
        ({"fps": float("nan")}, "fps is nan"),
        ({"text": None}, "text is None"),
        (
            {"contacts": np.ones((2, 2), np.float32)},
            r"contacts are float32 of \[2, 2\]; give numbers",
        ),
        ({"root_position": [[0.0, 0.0, 0.0]] * 3}, r"root_position are list of \[3, 3\]"),
        ({"quaternions": np.zeros((3, 22, 4), np.float32)}, "a quaternion of zeros"),
        ({"quaternions": None}, "quaternions are NoneType"),
    ],
)
def test_a_motion_of_a_users_own_is_looked_at_before_it_is_written(
    change: dict[str, Any], line: str, tmp_path: Path
) -> None:
    for name in OWN:
        with pytest.raises(UserError, match=line):
            write_motion(replace(standing(), **change), tmp_path / f"a.{ending(name)}")
    assert not list(tmp_path.iterdir())


def test_a_failed_write_keeps_the_file_that_was_there(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    path = write_motion(standing(), tmp_path / "a.glb")
    before = path.read_bytes()

    def full(self: Path, data: bytes) -> int:
        raise OSError(28, "No space left on device")

    monkeypatch.setattr(Path, "write_bytes", full)
    with pytest.raises(UserError, match="No space left"):
        write_motion(standing(9), path)
    assert path.read_bytes() == before
    assert [entry.name for entry in tmp_path.iterdir()] == ["a.glb"]
