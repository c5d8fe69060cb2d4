"""`inspect`: what is told of a file, flags that state what it does not say, profiles begun."""

import json
from pathlib import Path

import numpy as np
import pytest
from typer.testing import CliRunner, Result

from src.cli.tools import app
from src.shared.formats.readers.glb import GlbFile
from src.shared.formats.writers.bvh import write_bvh
from src.shared.formats.writers.glb import write_vrm
from src.shared.motion.motion import Motion


def run(*arguments: object) -> Result:
    return CliRunner().invoke(app, ["inspect", *map(str, arguments)])


@pytest.fixture(scope="module")
def bvh(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return write_bvh(still(), tmp_path_factory.mktemp("in") / "still.bvh")


def still() -> Motion:
    """A body that stands still for a second."""
    quaternions = np.zeros((30, 22, 4), np.float32)
    quaternions[..., 0] = 1
    root = np.tile(np.float32([0, 0.95, 0]), (30, 1))
    return Motion(quaternions, root, np.ones((30, 2), np.float32))


@pytest.fixture
def odd(bvh: Path, tmp_path: Path) -> Path:
    """The same with a knee by another name, and so far down that the legs are no pair."""
    text = bvh.read_text().replace("JOINT l_knee", "JOINT hinge")
    head, tail = text.split("JOINT hinge")
    text = f"{head}JOINT hinge{tail.replace('-', '-9', 1)}"
    path = tmp_path / "odd.bvh"
    path.write_text(text)
    return path


def test_people_see_all_of_it(bvh: Path) -> None:
    result = run(bvh)
    assert result.exit_code == 0 and result.stdout.startswith(f"{bvh}\n")
    lines = result.stdout.splitlines()
    assert "  length    1.00 s: 30 frames, 30 a second" in lines
    assert "  unit      cm (guessed)" in lines and "  up axis   Y (guessed)" in lines
    assert "  mapping   motion-suite; 22 of our 22 joints" in lines
    tree = [line for line in lines if line.startswith("    ")]
    assert tree[0].split() == ["pelvis", "pelvis"] and len(tree) == 22
    assert tree[1].startswith("      l_hip") and tree[2].startswith("        l_knee")


def test_an_avatar_is_seen_at_rest(tmp_path: Path) -> None:
    """Where --skeleton of a .vrm that lacks a bone sends people."""
    file = GlbFile.read(write_vrm(still(), tmp_path / "moving.vrm"))
    moving = json.loads(run(tmp_path / "moving.vrm", "--json").stdout)
    assert (moving["frames"], moving["warnings"]) == (30, [])
    del file.document["animations"]
    path = file.write(tmp_path / "me.vrm")
    found = json.loads(run(path, "--json").stdout)
    assert (found["format"], found["unit"], found["up"]) == ("VRM", "m", "Y")
    assert len(found["matched"]) == 22 and found["frames"] == 1
    assert "holds no motion" in found["warnings"][0]


def test_programs_see_the_same(bvh: Path) -> None:
    found = json.loads(run(bvh, "--json").stdout)
    assert found["format"] == "BVH" and found["guessed"] == ["unit", "up"]
    assert found["joints"][0] == {"name": "pelvis", "parent": -1}
    assert (found["frames"], found["unit"], found["up"], found["warnings"]) == (30, "cm", "Y", [])


def test_what_is_stated_is_not_guessed_and_what_is_odd_is_said(bvh: Path) -> None:
    found = json.loads(run(bvh, "--json", "--unit", "m", "--up", "z").stdout)
    assert found["guessed"] == [] and found["unit"] == "m"
    assert any("check --unit" in warning for warning in found["warnings"])
    assert any("stands along Y, not z: check --up" in warning for warning in found["warnings"])


def test_an_unknown_joint_is_named_and_a_profile_begun(odd: Path, tmp_path: Path) -> None:
    begun = tmp_path / "mine.yaml"
    result = run(odd, "--write-mapping", begun)
    assert result.exit_code == 0 and "none fits" in result.stdout
    assert "misses l_knee (l_knee)" in result.stdout and "hinge" in result.stdout
    begun.write_text(begun.read_text().replace('"?"', "hinge"))
    found = json.loads(run(odd, "--mapping", begun, "--json").stdout)
    assert found["mapping"] == "mine" and found["matched"]["l_knee"] == "hinge"


def test_joint_names_cannot_harm_a_terminal_or_a_profile(odd: Path, tmp_path: Path) -> None:
    begun, wild = tmp_path / "mine.yaml", "hinge\x1b]0;x\x07\x7f\u009b2J"
    odd.write_text(odd.read_text().replace("hinge", wild), encoding="utf-8")
    for flags in ([], ["--json"]):
        result = run(odd, *flags)
        assert result.exit_code == 0
        assert all(line.isprintable() for line in result.stdout.splitlines())
    assert run(odd, "--write-mapping", begun).exit_code == 0
    text = begun.read_text(encoding="utf-8")
    name = next(word for word in text.replace(",", " ").split() if word.startswith("hinge"))
    begun.write_text(text.replace('?"', f'{name}"'), encoding="utf-8")
    found = json.loads(run(odd, "--mapping", begun, "--json").stdout)
    assert found["mapping"] == "mine" and found["matched"]["l_knee"] == name


@pytest.mark.parametrize(("flags", "code", "message"), [
    (["--unit", "parsec"], 2, "--unit 'parsec' is not known; choose from m, cm"),
    (["--up", "W"], 2, "--up 'W' is not an axis"),
    (["--source-fps", "0"], 2, "--source-fps 0 is out of range"),
    (["--mapping", "none.yaml"], 2, "none.yaml"),
])  # fmt: skip
def test_wrong_flags(bvh: Path, flags: list[str], code: int, message: str) -> None:
    result = run(bvh, *flags)
    assert result.exit_code == code and message in result.stderr and not result.stdout


def test_a_missing_file_is_one_line(tmp_path: Path) -> None:
    result = run(tmp_path / "none.bvh")
    assert result.exit_code == 2 and result.stderr.count("\n") == 1


def test_a_profile_is_written_over_nothing(bvh: Path, tmp_path: Path) -> None:
    clip, filled = tmp_path / "clip.bvh", tmp_path / "mine.yaml"
    clip.write_bytes(bvh.read_bytes())
    filled.write_text("profiles: []\n")
    before = clip.read_bytes()
    for taken, message in ((clip, "is no .yaml file"), (filled, "is there already")):
        result = run(clip, "--write-mapping", taken)
        assert result.exit_code == 2 and message in result.stderr
    assert clip.read_bytes() == before and filled.read_text() == "profiles: []\n"
    result = run(clip, "--skeleton", tmp_path / "no.asf")
    assert result.exit_code == 2 and "leave it out" in result.stderr
