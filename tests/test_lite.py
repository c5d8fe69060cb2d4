"""Sentences, streams, the studio and conversions need no more than requirements-lite.txt names."""

import os
import re
import subprocess
import sys
from pathlib import Path

import pytest

pytest.importorskip("onnxruntime")

ROOT = Path(__file__).parents[1]
# Everything else of pyproject.toml is hidden, as if it were not installed.
HIDDEN = {"accelerate", "einops", "filelock", "fsspec", "google", "huggingface_hub", "librosa",
          "matplotlib", "onnx", "onnxscript", "sklearn", "soundfile", "soxr",
          "tensorboard", "torch", "transformers"}  # fmt: skip
SCRIPT = f"""
import sys
from importlib.machinery import BuiltinImporter, FrozenImporter, PathFinder

class Visible(PathFinder):
    @classmethod
    def find_spec(cls, name, path=None, target=None):
        if name.partition(".")[0] not in {HIDDEN!r}:
            return PathFinder.find_spec(name, path, target)

sys.meta_path[:] = [BuiltinImporter, FrozenImporter, Visible]
from src.cli.tools import main
main()
"""


def run(*arguments: str, typed: str = "") -> subprocess.CompletedProcess[str]:
    return subprocess.run(
        [sys.executable, "-c", SCRIPT, *arguments],
        input=typed, capture_output=True, text=True, cwd=ROOT,
        env={**os.environ, "PYTHONPATH": str(ROOT), "OMP_NUM_THREADS": "1"},
    )  # fmt: skip


def test_what_is_hidden_is_what_the_list_leaves_out() -> None:
    named = set(re.findall(r"^[a-z]\w*", (ROOT / "requirements-lite.txt").read_text(), re.M))
    assert not named & HIDDEN and {"numpy", "onnxruntime"} <= named
    project = (ROOT / "pyproject.toml").read_text().partition("dependencies = [")[2]
    needed = {
        name.replace("-", "_")
        for name in re.findall(r'^    "([\w-]+)', project.partition("]\n")[0], re.M)
    }
    assert needed - named - {"protobuf"} <= HIDDEN  # whose package is google


def test_motions_are_made_and_converted_without_pytorch(tmp_path: Path) -> None:
    out = tmp_path / "out"
    made = run(
        "generate", "--prompt", "a person walks two metres, then waves", "--seconds", "1",
        "--format", "bvh,glb,npz,html,vrma", "--out", str(out),
    )  # fmt: skip
    assert made.returncode == 0, made.stderr
    assert {path.suffix for path in out.iterdir()} == {".bvh", ".glb", ".npz", ".html", ".vrma"}
    for arguments in (
        ("convert", str(next(out.glob("*.bvh"))), str(tmp_path / "a.glb")),
        ("studio", "--no-open", "--out", str(tmp_path / "studio.html")),
        ("stream", "--no-real-time", "--seconds", "1"),
        ("models",),
    ):
        found = run(*arguments)
        assert found.returncode == 0, found.stderr


@pytest.mark.parametrize(
    "arguments",
    [
        ("train", "generation", "--data", "x", "--output", "y"),
        ("generate", "--prompt", "a", "--runtime", "torch"),
    ],
)
def test_what_needs_more_names_it_in_one_line(arguments: tuple[str, ...], tmp_path: Path) -> None:
    found = run(*arguments)
    assert found.returncode == 1
    assert "torch, which is not installed" in found.stderr and "Traceback" not in found.stderr
