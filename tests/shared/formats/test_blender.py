"""FBX through Blender: what is said where there is none; where there is one, that it comes back."""

import io
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from PIL import Image

from src.shared.data.retarget.read_motion import open_recording, read_motion
from src.shared.data.retarget.to_rig import read_target
from src.shared.data.synthetic.clips import generate_clip, sample_specs
from src.shared.environment import BLENDER
from src.shared.errors import UserError
from src.shared.formats import blender
from src.shared.formats.readers.glb import GlbFile
from src.shared.formats.registry import export_motion, write_motion
from src.shared.motion.motion import Motion, resample_motion
from tests.integrations.blender_run import blender_python

needs_blender = pytest.mark.skipif(blender_python() is None, reason="no bpy; BPY_PYTHON names one")


@pytest.fixture(autouse=True)
def named(monkeypatch: pytest.MonkeyPatch) -> None:
    if (python := blender_python()) is not None:
        monkeypatch.setenv(BLENDER, python)


@pytest.fixture(scope="module")
def walk() -> Motion:
    return generate_clip(sample_specs(1, 3)[0], seed=3)


def without(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.delenv(BLENDER, raising=False)
    monkeypatch.setattr(blender, "which", lambda _name: None)
    monkeypatch.setattr(blender, "find_spec", lambda _name: None)


def test_without_blender_nothing_is_written(
    walk: Motion, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    without(monkeypatch)
    with pytest.raises(UserError, match=r"FBX needs Blender.*take .glb"):
        export_motion(walk, tmp_path, "a", ("bvh", "fbx"))
    assert not list(tmp_path.iterdir())


def test_without_blender_nothing_is_read(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    without(monkeypatch)
    (tmp_path / "a.fbx").write_bytes(b"Kaydara")
    with pytest.raises(UserError, match="FBX needs Blender"):
        read_motion(tmp_path / "a.fbx")


def test_a_program_that_is_none_is_named(
    walk: Motion, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv(BLENDER, str(tmp_path / "nothing"))
    with pytest.raises(UserError, match=r"MOTIONGEN_BLENDER=.*nothing is no program"):
        write_motion(walk, tmp_path / "a.fbx")


def test_what_the_program_says_is_told(
    walk: Motion, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    program = tmp_path / "broken"
    program.write_text("#!/bin/sh\necho this is no Blender >&2\nexit 3\n")
    program.chmod(0o755)
    monkeypatch.setenv(BLENDER, str(program))
    with pytest.raises(UserError, match="could not convert it: this is no Blender"):
        write_motion(walk, tmp_path / "a.fbx")
    assert not (tmp_path / "a.fbx").exists()


@needs_blender
@pytest.mark.parametrize("fps", [30.0, 120.0])
def test_a_motion_comes_back(walk: Motion, tmp_path: Path, fps: float) -> None:
    motion = resample_motion(walk, fps)
    path = write_motion(motion, tmp_path / "a.fbx")
    assert path.read_bytes().startswith(b"Kaydara FBX Binary")
    back = read_motion(path, fps=None)
    assert (back.num_frames, back.fps) == (motion.num_frames, fps)
    assert np.abs(back.positions() - motion.positions()).max() < 1e-4
    assert open_recording(path).format == "FBX, by Blender"


@needs_blender
def test_a_broken_rate_is_sampled_at_the_nearest_whole_one(walk: Motion, tmp_path: Path) -> None:
    back = read_motion(write_motion(resample_motion(walk, 29.97), tmp_path / "a.fbx"), fps=None)
    frames = min(back.num_frames, walk.num_frames)
    assert back.fps == 30.0
    assert back.num_frames >= walk.num_frames - 1
    assert np.abs(back.positions()[:frames] - walk.positions()[:frames]).max() < 0.02


@needs_blender
@pytest.mark.parametrize(("fps", "base"), [(25, 2.0), (30, 1.001), (24, 1.001)])
def test_a_file_of_a_broken_rate_is_read_as_long_and_as_fast_as_it_is(
    walk: Motion, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, fps: int, base: float
) -> None:
    broken = f"scene.render.fps, scene.render.fps_base = {fps}, {base}\nrigs = ["
    assert blender.SCRIPT.count("rigs = [") == 1
    with monkeypatch.context() as other:  # somebody else's file, of a broken rate
        other.setattr(blender, "SCRIPT", blender.SCRIPT.replace("rigs = [", broken))
        path = write_motion(resample_motion(walk, float(fps)), tmp_path / "a.fbx")
    back = read_motion(path, fps=None)
    assert back.fps == round(fps / base)
    wanted = resample_motion(replace(resample_motion(walk, float(fps)), fps=fps / base), back.fps)
    frames = min(back.num_frames, wanted.num_frames)
    assert frames >= wanted.num_frames - 2
    apart = np.linalg.norm(back.positions()[:frames] - wanted.positions()[:frames], axis=-1)
    assert apart.max() < 0.03


@needs_blender
def test_the_texture_of_a_character_stays(walk: Motion, tmp_path: Path) -> None:
    hero = GlbFile.read(write_motion(walk, tmp_path / "hero.glb"))
    picture = io.BytesIO()
    Image.new("RGB", (8, 8), "red").save(picture, "PNG")
    start = len(hero.data)
    hero.data += picture.getvalue() + bytes(-len(picture.getvalue()) % 4)
    document = hero.document
    size = len(picture.getvalue())
    document["bufferViews"].append({"buffer": 0, "byteOffset": start, "byteLength": size})
    view = len(document["bufferViews"]) - 1
    document["images"] = [{"bufferView": view, "mimeType": "image/png", "name": "skin"}]
    document["textures"] = [{"source": 0}]
    document["materials"][0].setdefault("pbrMetallicRoughness", {})["baseColorTexture"] = {
        "index": 0
    }
    hero.write(tmp_path / "hero.glb")
    path = read_target(tmp_path / "hero.glb").write(walk, tmp_path / "moved.fbx")
    assert picture.getvalue() in path.read_bytes()


@needs_blender
def test_a_character_of_fbx_moves_with_its_mesh(walk: Motion, tmp_path: Path) -> None:
    hero = write_motion(walk, tmp_path / "hero.fbx", names="mixamo")
    target = read_target(hero)
    assert target.character is not None
    path = target.write(walk, tmp_path / "moved.fbx")
    assert np.abs(read_motion(path).positions() - walk.positions()).max() < 1e-4
    assert path.stat().st_size > 400_000  # the mesh


def test_a_name_is_no_argument(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Whatever a file is called, Blender is told its whole path, after the script and `--`."""
    program, heard = tmp_path / "listens", tmp_path / "heard"
    program.write_text(f'#!/bin/sh\nprintf "%s\\n" "$@" > "{heard}"\nexit 1\n')
    program.chmod(0o755)
    monkeypatch.setenv(BLENDER, str(program))
    name = '--python-expr "import os; $(touch done) `touch done`.fbx'
    (tmp_path / name).write_bytes(b"Kaydara")
    monkeypatch.chdir(tmp_path)
    with pytest.raises(UserError, match="could not convert it"):
        read_motion(Path(name))
    arguments = heard.read_text(encoding="utf-8").splitlines()
    assert arguments.index("--") == len(arguments) - 4  # and source, target, rate
    assert arguments[-3] == str(tmp_path / name)
    assert "--disable-autoexec" in arguments and not (tmp_path / "done").exists()


def test_a_program_that_cannot_be_run_is_told(
    walk: Motion, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    (program := tmp_path / "nonsense").write_bytes(b"\0\1nothing to run")
    program.chmod(0o755)
    monkeypatch.setenv(BLENDER, str(program))
    with pytest.raises(UserError, match="nonsense cannot be run: "):
        write_motion(walk, tmp_path / "a.fbx")


@needs_blender
def test_a_broken_file_is_told(tmp_path: Path) -> None:
    (tmp_path / "a.fbx").write_bytes(b"Kaydara FBX Binary  \0\x1a\0" + bytes(100))
    with pytest.raises(UserError, match=r"a.fbx: Blender .* could not convert it"):
        read_motion(tmp_path / "a.fbx")
