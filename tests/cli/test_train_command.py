"""`train STAGE`: every stage by name, its own flags and errors, nothing of a launcher's."""

import subprocess
import sys
from pathlib import Path

import pytest
from typer.main import get_command

from src.cli.tools import TRAINED
from src.train.launch import STAGES

ROOT = Path(__file__).parents[2]
COMMON = {"--config", "--data", "--output", "--num-processes", "--resume"}
NETWORK = {"--network-profile", "--network-file"}
OWN = {
    "action": {"--init"},
    "distill": {"--init"},
    "decoder": {"--audio"},
    "memory": {"--audio", "--memory", "--space"},
    "finetune-e2e": {
        "--checkpoint", "--decoder-checkpoint", "--epochs", "--num-phrases", "--batch-size",
        "--lr-diffusion", "--lr-decoder", "--diffusion-weight", "--decoder-weight",
        "--temporal-weight", "--patience",
    },
}  # fmt: skip


def test_every_stage_of_the_folder_has_a_name() -> None:
    files = {path.stem for path in (ROOT / "src" / "train").glob("*.py")}
    stages = {name for name in files if name.startswith(("train_", "finetune_"))}
    assert {stage.module for stage in STAGES.values()} == stages
    assert list(STAGES) == list(TRAINED)


@pytest.mark.parametrize("stage", STAGES)
def test_the_flags_of_a_stage_are_a_promise(stage: str) -> None:
    command = get_command(STAGES[stage].app())
    flags = {flag for parameter in command.params for flag in parameter.opts if flag[0] == "-"}
    assert flags == COMMON | OWN.get(stage, NETWORK)
    assert f"motion-tools train {stage} " in (command.help or "")


def test_a_mistake_is_one_line_and_exit_code_2() -> None:
    done = subprocess.run(
        [sys.executable, "-m", "src.cli.tools", "train", "clip", "stepz=3", "--num-processes", "2"],
        cwd=ROOT, capture_output=True, text=True,
    )  # fmt: skip
    assert done.returncode == 2
    assert done.stderr.splitlines() == [
        "error: command line: unknown key stepz (value 3); the nearest valid key is steps"
    ]
