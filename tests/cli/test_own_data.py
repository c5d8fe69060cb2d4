"""Someone's own mocap, from BVH files to generated motions, by the command line alone."""

import json
import os
import subprocess
import sys
from pathlib import Path

import pytest

from src.shared.data.captions.book import CaptionBook
from src.shared.data.synthetic.clips import generate_clip, spec_for
from src.shared.evaluation.actions import check
from src.shared.formats.arrays import read_npz
from src.shared.formats.writers.bvh import write_bvh

ROOT = Path(__file__).parents[2]
ACTIONS = (
    {"action": "walk", "direction": "forward", "speed": "normal"},
    {"action": "walk", "direction": "backward", "speed": "normal"},
    {"action": "wave", "side": "right", "speed": "normal"},
    {"action": "squat", "count": "2", "speed": "normal"},
)
CLIPS_EACH, SAMPLES_EACH = 5, 8


def run(folder: Path, *arguments: str) -> str:
    """A command of the project in a folder of the user's; returns its stdout."""
    environment = {**os.environ, "PYTHONPATH": str(ROOT)}
    result = subprocess.run(
        [sys.executable, *arguments], cwd=folder, env=environment, capture_output=True, text=True
    )
    assert result.returncode == 0, result.stderr[-3000:]
    return result.stdout


def write_mocap(folder: Path) -> list[str]:
    """Twenty BVH clips and a table of captions, as a stranger would bring them.

    Returns one of the captions of each action, to ask for later.
    """
    book, rows = CaptionBook.load(None), ["clip,caption,language"]
    prompts = []
    for kind, labels in enumerate(ACTIONS):
        captions = book.captions(labels, num=CLIPS_EACH, seed=3)["en"]
        for take in range(CLIPS_EACH):
            name = f"take_{kind}{take}"
            write_bvh(generate_clip(spec_for(labels, seed=take), seed=take), folder / f"{name}.bvh")
            rows.append(f'{name},"{captions[take % len(captions)]}",en')
        prompts.append(captions[0])
    (folder / "captions.csv").write_text("\n".join(rows), encoding="utf-8")
    return prompts


def success(labels: dict[str, str], folder: Path) -> float:
    """Share of the motions in a folder that do what the labels say, by forward kinematics."""
    answers = [check(labels, read_npz(path)) for path in sorted(folder.glob("*.npz"))]
    assert len(answers) == SAMPLES_EACH
    return sum(all(answer.values()) for answer in answers) / len(answers)


@pytest.mark.slow
def test_twenty_clips_become_a_model_that_beats_chance(tmp_path: Path) -> None:
    (tmp_path / "mocap").mkdir()
    prompts = write_mocap(tmp_path / "mocap")
    tools, train = ("-m", "src.cli.tools"), ("-m", "accelerate.commands.launch")
    launch = (*train, "--num_processes", "1", "-m")
    report = json.loads(
        run(tmp_path, *tools, "prepare", "mocap", "--captions", "mocap/captions.csv",
            "--out", "data", "--workers", "1", "--json")
    )  # fmt: skip
    assert report["clips"] == CLIPS_EACH * len(ACTIONS) and report["skipped"] == []

    common = ("--data", "data", "batch-size=16", "warmup-steps=20", "max-frames=96")
    run(tmp_path, *launch, "src.train.train_clip", *common, "--output", "clip", "steps=150")
    run(tmp_path, *launch, "src.train.train_generation", *common,
        "--output", "model", "clip=clip", "steps=2000")  # fmt: skip

    for kind, prompt in enumerate(prompts):
        run(tmp_path, *tools, "generate", "--prompt", prompt,
            "--num-samples", str(SAMPLES_EACH), "--return-all", "--seconds", "3",
            "--format", "npz", "--model", "model", "--out", f"out/{kind}")  # fmt: skip
    rates = [
        [success(labels, tmp_path / "out" / str(asked)) for asked in range(len(ACTIONS))]
        for labels in ACTIONS
    ]
    right = sum(rates[kind][kind] for kind in range(len(ACTIONS))) / len(ACTIONS)
    others = [rates[a][b] for a in range(len(ACTIONS)) for b in range(len(ACTIONS)) if a != b]
    chance = sum(others) / len(others)
    print(f"right action {right:.0%}, the same check on other prompts {chance:.0%}: {rates}")
    assert right >= chance + 0.25
