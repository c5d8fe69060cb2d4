"""`convert`: files and folders, every flag, faults that leave the rest whole."""

import json
import os
import shutil
from pathlib import Path

import numpy as np
import pytest
from typer.testing import CliRunner, Result

from src.cli.tools import app
from src.shared.data.retarget.read_motion import read_motion
from src.shared.formats.readers.bvh import read_bvh
from src.shared.formats.readers.glb import GlbFile, read_glb_skeleton
from src.shared.formats.registry import write_motion
from src.shared.io.storage import place
from src.shared.motion.motion import Motion
from tests.files import files_of
from tests.shared.data.retarget.test_round_trips import differences


def run(*arguments: object) -> Result:
    return CliRunner().invoke(app, ["convert", *map(str, arguments)])


def stroll(frames: int = 31) -> Motion:
    """Upright, gliding 1 m along +Z, one arm coming down."""
    quaternions = np.zeros((frames, 22, 4), np.float32)
    quaternions[..., 0] = 1
    angle = np.linspace(0, 1.2, frames)
    quaternions[:, 16, 0], quaternions[:, 16, 3] = np.cos(angle / 2), -np.sin(angle / 2)
    root = np.zeros((frames, 3), np.float32)
    root[:, 1], root[:, 2] = 0.95, np.linspace(0, 1, frames)
    return Motion(quaternions, root, np.ones((frames, 2), np.float32), 30.0, "strolls")


@pytest.fixture(scope="module")
def walk(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return write_motion(stroll(), tmp_path_factory.mktemp("in") / "walk.npz")


def test_one_file_into_another(walk: Path, tmp_path: Path) -> None:
    out = tmp_path / "new" / "walk.amass.npz"
    result = run(walk, out)
    assert result.exit_code == 0
    assert result.stdout == f"{out}\n"
    assert max(differences(stroll(), read_motion(out, fps=None))) < 1e-4
    assert [path.name for path in out.parent.iterdir()] == ["walk.amass.npz"]


def test_rate_and_root(walk: Path, tmp_path: Path) -> None:
    result = run(walk, tmp_path / "a.bvh", "--fps", 60, "--root", "in-place", "--json")
    facts = json.loads(result.stdout)
    assert facts["converted"][0]["frames"] == 61
    motion = read_motion(tmp_path / "a.bvh", fps=None)
    assert motion.fps == pytest.approx(60.0, rel=1e-4)
    assert np.abs(motion.root_position[:, [0, 2]]).max() < 1e-6
    np.testing.assert_allclose(motion.root_position[:, 1], 0.95, atol=1e-5)


@pytest.mark.parametrize(
    ("names", "hips"), [("mixamo", "mixamorig:Hips"), ("unity", "Hips"), ("unreal", "pelvis")]
)
def test_names_for_other_tools(walk: Path, tmp_path: Path, names: str, hips: str) -> None:
    assert run(walk, tmp_path, "--format", "bvh,glb,npz", "--names", names).exit_code == 0
    assert read_bvh(tmp_path / "walk.bvh").names[0] == hips
    assert read_glb_skeleton(tmp_path / "walk.glb").rig.names[0] == hips


def test_onto_a_users_skeleton(walk: Path, tmp_path: Path) -> None:
    assert run(walk, tmp_path / "own.bvh", "--names", "mixamo").exit_code == 0
    own = tmp_path / "own.bvh"
    own.write_text(own.read_text().replace("OFFSET 0.00000 -40.00000", "OFFSET 0.00000 -45.00000"))
    assert run(walk, tmp_path / "moved.bvh", "--skeleton", own).exit_code == 0
    clip = read_bvh(tmp_path / "moved.bvh")
    assert clip.names[0] == "mixamorig:Hips"
    travel = clip.world()[0][-1, 0] - clip.world()[0][0, 0]
    np.testing.assert_allclose(travel, [0, 0, 112.5], atol=1e-3)  # longer legs, longer way


def test_avatars_are_moved_and_nothing_else_becomes_one(walk: Path, tmp_path: Path) -> None:
    assert run(walk, tmp_path, "--format", "vrm,glb,bvh").exit_code == 0
    avatar, moved = tmp_path / "walk.vrm", tmp_path / "moved.vrm"
    assert max(differences(stroll(), read_motion(avatar, fps=None))) < 1e-4
    for other in ("walk.glb", "walk.bvh"):
        result = run(walk, moved, "--skeleton", tmp_path / other)
        assert result.exit_code == 2 and len(result.stderr.splitlines()) == 1
        assert f"{other} is no VRM avatar" in result.stderr
        assert not moved.exists()
    folder = tmp_path / "out"
    assert run(walk, folder, "--format", "vrm,bvh", "--skeleton", avatar).exit_code == 0
    assert run(folder / "walk.bvh", moved, "--skeleton", avatar).exit_code == 0
    extensions = GlbFile.read(avatar).document["extensions"]
    for path in (folder / "walk.vrm", moved):
        assert GlbFile.read(path).document["extensions"] == extensions
        assert differences(stroll(), read_motion(path, fps=None))[0] < 1e-4
    assert run(folder / "walk.vrm", tmp_path / "back.npz").exit_code == 0
    assert differences(stroll(), read_motion(tmp_path / "back.npz", fps=None))[0] < 1e-4
    assert run(folder, tmp_path / "back", "--format", "npz").exit_code == 0  # avatars stay out
    assert [path.name for path in (tmp_path / "back").glob("*.npz")] == ["walk.npz"]


def test_folders_keep_their_shape_and_faults_do_not_stop_the_rest(
    walk: Path, tmp_path: Path
) -> None:
    inside = tmp_path / "in"
    write_motion(stroll(5), inside / "deep" / "b.bvh")
    write_motion(stroll(5), inside / "a.npz")
    (inside / "broken.bvh").write_text("no motion")
    (inside / "notes.txt").write_text("no motion")
    result = run(inside, walk, tmp_path / "out", "--format", "csv,bvh", "--json")
    assert result.exit_code == 1
    made = sorted(
        p.relative_to(tmp_path / "out").as_posix() for p in Path(tmp_path / "out").rglob("*.*")
    )
    assert made == ["a.bvh", "a.csv", "deep/b.bvh", "deep/b.csv", "walk.bvh", "walk.csv"]
    facts = json.loads(result.stdout)
    assert len(facts["converted"]) == 3
    assert "broken.bvh" in facts["failed"][0]["error"]
    assert "1 file of 4" in result.stderr


@pytest.mark.parametrize("more", [(), ("--resume",)])
def test_links_that_lead_nowhere_do_not_stop_the_rest(
    walk: Path, tmp_path: Path, more: tuple[str, ...], monkeypatch: pytest.MonkeyPatch
) -> None:
    source = tmp_path / "in"
    source.mkdir()
    (source / "walk.npz").write_bytes(walk.read_bytes())
    (source / "bones.amc").write_text(":FULLY-SPECIFIED\n:DEGREES\n1\nroot 0 0 0 0 0 0\n")
    try:
        (source / "bones.asf").symlink_to(tmp_path / "nowhere.asf")
        (source / "loop.bvh").symlink_to(source / "loop.bvh")
        (source / "lost.bvh").symlink_to(source / "missing.bvh")
        (source / "again").symlink_to(source)
    except OSError:
        pytest.skip("no links here")
    monkeypatch.chdir(source)
    result = run(".", tmp_path / "out", "--format", "csv", *more)
    assert result.exit_code == 1 and "Traceback" not in result.output
    errors = result.stderr.splitlines()
    assert len(errors) == 4 and "3 files of 4 could not be converted" in errors[-1]
    for name, error in zip(("bones.", "loop.bvh", "lost.bvh"), errors, strict=False):
        assert name in error
    assert [path.name for path in (tmp_path / "out").iterdir()] == ["walk.csv"]


def test_a_cluster_writes_what_one_process_does(
    walk: Path, tmp_path: Path, scheduler: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    """With relative paths, which a worker would look for elsewhere."""
    source = tmp_path / "in"
    for number in range(3):
        write_motion(stroll(20 + number), source / f"{number}/walk.npz")
    (source / "broken.npz").write_bytes(b"no motion")
    monkeypatch.chdir(tmp_path)
    told = []
    for options in ([], ["--scheduler", scheduler]):
        result = run("in", "out", "--format", "bvh,csv", "--json", *options)
        assert result.exit_code == 1 and "1 file of 4 could not be converted" in result.stderr
        told.append((json.loads(result.stdout), files_of(tmp_path / "out")))
        shutil.rmtree("out")
    one, cluster = told
    assert len(one[1]) == 6 and one[1] == cluster[1]
    assert one[0]["converted"] == cluster[0]["converted"]
    assert [Path(fault["file"]).name for fault in cluster[0]["failed"]] == ["broken.npz"]


def test_addresses_are_read_and_written(walk: Path, tmp_path: Path) -> None:
    source, out = place("memory://walks"), place("memory://converted")
    (source / "deep" / "walk.npz").write_bytes(walk.read_bytes())
    assert run(source, out, "--format", "bvh,csv").exit_code == 0
    assert run(walk, tmp_path / "walk.bvh").exit_code == 0
    made = out / "deep" / "walk.bvh"
    assert made.read_bytes() == (tmp_path / "walk.bvh").read_bytes()
    result = run(source, out, "--format", "bvh,csv", "--resume")
    assert result.exit_code == 0 and "1 file skipped" in result.stderr
    assert run(made, "memory://converted/walk.glb").exit_code == 0
    assert (out / "walk.glb").is_file()


def test_resume_skips_what_is_newer(walk: Path, tmp_path: Path) -> None:
    source = write_motion(stroll(5), tmp_path / "a.npz")
    arguments = (source, walk, tmp_path / "out", "--format", "bvh", "--resume", "--json")
    assert len(json.loads(run(*arguments).stdout)["converted"]) == 2
    result = run(*arguments)
    assert json.loads(result.stdout)["skipped"] == sorted([str(source), str(walk)])
    assert "2 files skipped" in result.stderr
    later = (tmp_path / "out" / "a.bvh").stat().st_mtime + 10
    os.utime(source, (later, later))
    assert [row["source"] for row in json.loads(run(*arguments).stdout)["converted"]] == [
        str(source)
    ]


def test_wrong_usage_is_said_before_anything_is_read(walk: Path, tmp_path: Path) -> None:
    out = tmp_path / "a.glb"
    wrong = {
        "OUT is missing": (walk,),
        "'dae' is not a format": (walk, tmp_path / "a.dae"),
        "--format says what to write": (walk, walk, tmp_path / "out"),
        "'obj' is not a format": (walk, tmp_path / "out", "--format", "glb,obj"),
        "names nothing": (walk, tmp_path / "out", "--format", ","),
        "--fps 0 is out of range": (walk, out, "--fps", 0),
        "--source-fps nan is out of range": (walk, out, "--source-fps", "nan"),
        "--root 'off' is unknown": (walk, out, "--root", "off"),
        "'daz' names no joints": (walk, out, "--names", "daz"),
        "--names unity goes with bvh": (walk, tmp_path / "a.csv", "--names", "unity"),
        "--skeleton does not go with csv": (walk, tmp_path / "a.csv", "--skeleton", "x.bvh"),
        "--skeleton x.dae is no .bvh, .glb, .vrm or .fbx": (walk, out, "--skeleton", "x.dae"),
        "--names does not go with": (walk, out, "--names", "unity", "--skeleton", "x.bvh"),
        "written over itself": (walk, walk),
        "would both become": (walk, walk, tmp_path / "out", "--format", "bvh"),
        "'furlong' is not known": (walk.with_name("b.bvh"), out, "--unit", "furlong"),
    }
    write_motion(stroll(3), walk.with_name("b.bvh"))
    for says, arguments in wrong.items():
        result = run(*arguments)
        assert (result.exit_code, says in result.stderr) == (2, True), (says, result.stderr)
    assert not list(tmp_path.iterdir())


def test_missing_files_are_named(walk: Path, tmp_path: Path) -> None:
    result = run(tmp_path / "no.bvh", tmp_path / "a.glb")
    assert (result.exit_code, "no.bvh does not exist" in result.stderr) == (2, True)
    (tmp_path / "empty").mkdir()
    result = run(tmp_path / "empty", tmp_path / "out", "--format", "glb")
    assert (result.exit_code, "holds no motion file" in result.stderr) == (1, True)
    result = run(walk, tmp_path / ("a" * 248 + ".glb"))
    assert (result.exit_code, "shorten its name" in result.stderr) == (2, True)
    result = run(walk, tmp_path / "a.glb", "--skeleton", tmp_path / "hero.glb")
    assert (result.exit_code, "hero.glb" in result.stderr) == (2, True)


def test_skeletons_that_mean_nothing_or_would_be_lost_are_refused(
    walk: Path, tmp_path: Path
) -> None:
    character = write_motion(stroll(), tmp_path / "character.bvh")
    before = character.read_bytes()
    for arguments, message in (
        ((walk, tmp_path / "a.glb", "--asf", character), "leave it out"),
        ((walk, character, "--skeleton", character), "own file"),
        ((walk, tmp_path / "a"), "does not end in a format"),
    ):
        result = run(*arguments)
        assert result.exit_code == 2 and message in result.stderr
        assert len(result.stderr.splitlines()) == 1
    assert character.read_bytes() == before
