"""The add-on in Blender itself: install, generate from a prompt, and what a user sees that errs."""

import ast
import inspect
import sys
from pathlib import Path
from typing import Any

import pytest

from src.cli.generate import generate
from src.shared.audio.synthetic import SongSpec, render_song
from src.shared.motion.skeleton import JOINT_NAMES
from tests.integrations.blender_run import blender_python, run_in_blender

ADDON = Path(__file__).parents[2] / "integrations/blender/motion_suite.py"
PROGRAM = Path(sys.executable).with_name("motion-tools")
in_blender = pytest.mark.skipif(blender_python() is None, reason="no bpy; BPY_PYTHON names one")


@pytest.fixture(scope="module")
def session(tmp_path_factory: pytest.TempPathFactory) -> dict[str, Any]:
    """What happened in one Blender: motions of prompts and of a song, then fault after fault."""
    scratch = tmp_path_factory.mktemp("addon")
    preferences = {"program": str(PROGRAM), "folder": str(scratch / "out")}
    good = {"prompt": "a person walks forward", "seconds": 1.0, "seed": 3, "format": "bvh"}
    song = scratch / "song.wav"
    render_song(SongSpec(seconds=4.0, tempo=112.0, seed=1)).write_wav(song)
    runs = [
        ({}, {}),
        ({"prompt": "- waves", "format": "glb"}, {}),
        ({"prompt": "  "}, {}),
        ({"model": "no-such-model"}, {}),
        ({"source": "SONG", "song": str(scratch / "none.wav")}, {}),
        ({}, {"program": str(scratch / "nothing-here")}),
        ({"source": "SONG", "song": str(song), "seconds": 2.0}, {}),
    ]
    fresh = {"source": "PROMPT", "model": "", "set_rate": True}
    wanted = [
        {"settings": fresh | good | settings, "preferences": preferences | where}
        for settings, where in runs
    ]
    found = run_in_blender("blender_addon.py", {"addon": str(ADDON), "runs": wanted}, scratch)
    assert isinstance(found, dict)
    return found


@in_blender
@pytest.mark.skipif(not PROGRAM.exists(), reason="motion-tools is not installed")
class TestInBlender:
    """One session, looked at from several sides."""

    @pytest.mark.parametrize(("index", "frames"), [(0, 30), (1, 30), (6, 60)])
    def test_an_armature_appears(self, session: dict[str, Any], index: int, frames: int) -> None:
        made = session["runs"][index]
        assert made["answer"] == ["FINISHED"]
        assert made["bones"] == [sorted(JOINT_NAMES)]
        first, last = made["ranges"][0]
        assert round(last - first) + 1 == frames
        assert made["fps"] == 30.0
        assert made["end"] >= last

    @pytest.mark.parametrize(
        ("index", "words"),
        [
            (2, "there is no prompt"),
            (3, "no-such-model"),
            (4, "none.wav"),
            (5, "add-on's preferences"),
        ],
    )
    def test_errors_are_shown(self, session: dict[str, Any], index: int, words: str) -> None:
        made = session["runs"][index]
        assert made["answer"] == ["CANCELLED"]
        assert words in made["error"]
        assert made["objects"] == 0
        assert "Traceback" not in made["error"]

    def test_a_run_goes_on_beside_blender_and_can_be_stopped(self, session: dict[str, Any]) -> None:
        watched = session["watched"]
        assert watched["was_running"]
        assert not watched["runs"]
        assert watched["errors"][0] == "no good"
        assert "same version" in watched["errors"][1]

    def test_switched_off_it_leaves_nothing(self, session: dict[str, Any]) -> None:
        assert not session["left"]


def test_every_flag_exists() -> None:
    text = ADDON.read_text(encoding="utf-8")
    flags = {
        part.value.split("=")[0]
        for node in ast.walk(ast.parse(text))
        for part in ast.walk(node)
        if isinstance(part, ast.Constant) and str(part.value).startswith("--")
    }
    known = {"--" + name.replace("_", "-") for name in inspect.signature(generate).parameters}
    assert {"--prompt", "--audio", "--json"} <= flags <= known


def test_one_file_with_blenders_python_alone() -> None:
    tree = ast.parse(ADDON.read_text(encoding="utf-8"))
    roots = set()
    for node in ast.walk(tree):
        if isinstance(node, ast.Import):
            roots |= {alias.name.partition(".")[0] for alias in node.names}
        elif isinstance(node, ast.ImportFrom):
            roots.add((node.module or "").partition(".")[0])
    assert roots - sys.stdlib_module_names == {"bpy"}
