"""Two processes on the CPU, as DDP and as FSDP2: what one process does with the whole batch."""

import json
import os
import shutil
import subprocess
import sys
from pathlib import Path

import pytest
import torch
from safetensors.torch import load_file
from tiny_audio_stage import ROOT, assert_close_runs
from tiny_stage import clip_config, train_clip
from two_processes import KINDS, runs

from src.train.checkpoint import asks_for_shards

ONE = "gradient-accumulation=2"  # the parts of a step that two processes share
PROGRAM = """
import sys
from src.train.processes import is_one_of_several, run_processes
if not is_one_of_several():
    sys.exit(run_processes(2))
"""


def losses(output: Path) -> list[float]:
    lines = [json.loads(line) for line in (output / "log.jsonl").read_text().splitlines()]
    return [line["loss"] for line in lines if "loss" in line]


def stopped_at_4(run: Path, target: Path) -> None:
    """The run as it would be had it been stopped after its checkpoint of step 4."""
    shutil.copytree(run, target, ignore=shutil.ignore_patterns("step-00000006", "finished.json"))
    (target / "model.safetensors").unlink()
    assert [path.name for path in (target / "checkpoints").iterdir()] == ["step-00000004"]


def test_ddp_and_fsdp2_are_one_process_with_the_whole_batch(
    circles: Path, prepared: Path, tmp_path: Path
) -> None:
    """Loss curves, weights, and runs that go on in another number of processes."""
    clip = tmp_path / "clip"
    train_clip(clip_config(prepared, clip, "steps=2"))
    stages = runs(circles, prepared, clip)
    for stage, train in stages.items():
        one = tmp_path / stage / "one"
        train(one, ONE)
        for name in KINDS[stage]:
            stopped_at_4(one, tmp_path / stage / f"one-half-{name}")
    program = tmp_path / "program.py"
    program.write_text(PROGRAM + Path(__file__).with_name("two_processes.py").read_text())
    done = subprocess.run(
        [sys.executable, *map(str, (program, tmp_path, circles, prepared, clip))],
        env={
            **os.environ,
            "PYTHONPATH": os.pathsep.join((str(ROOT), str(Path(__file__).parent))),
            "ACCELERATE_USE_CPU": "true",
            "OMP_NUM_THREADS": "1",
        },
        stderr=subprocess.PIPE,
        text=True,
        timeout=600,
        check=False,
    )
    assert done.returncode == 0, done.stderr
    assert done.stderr.count("FSDP2: weights, gradients and optimizer in 2 shards") == 4
    for stage, train in stages.items():
        one = tmp_path / stage / "one"
        for name in KINDS[stage]:
            go_on = tmp_path / stage / f"{name}-half"
            stopped_at_4(tmp_path / stage / name, go_on)
            train(go_on, ONE, resume=True)
            for other in (one.with_name(name), go_on, one.with_name(f"one-half-{name}")):
                assert losses(other) == pytest.approx(losses(one), rel=1e-4)
                assert_close_runs(one, other)
                merged, whole = (load_file(o / "model.safetensors") for o in (other, one))
                assert merged.keys() == whole.keys()
                assert all(torch.allclose(merged[key], whole[key], atol=1e-5) for key in whole)


def test_accelerates_own_configuration_is_heard(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("ACCELERATE_USE_FSDP", "true")
    monkeypatch.setenv("FSDP_VERSION", "2")
    assert asks_for_shards(None) and "ACCELERATE_USE_FSDP" not in os.environ
    assert asks_for_shards(2) and not asks_for_shards(None)
