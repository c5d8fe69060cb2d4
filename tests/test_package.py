"""What holds of the package as a whole: threads that wait asleep, and what the licence covers."""

import os
import re
import subprocess
import sys
import tomllib
from pathlib import Path

import pytest

from src.shared.model.checkpoint import PRETRAINED

ROOT = Path(__file__).parents[1]


@pytest.mark.parametrize(
    ("given", "found"), [({}, "PASSIVE"), ({"OMP_WAIT_POLICY": "active"}, "ACTIVE")]
)
def test_threads_of_training_sleep_while_they_wait_unless_told_otherwise(
    given: dict[str, str], found: str
) -> None:
    """As the OpenMP library itself reports when torch loads it."""
    own = {name: value for name, value in os.environ.items() if name != "OMP_WAIT_POLICY"}
    done = subprocess.run(
        [sys.executable, "-c", "import src.train.launch, torch"],
        cwd=ROOT, env=own | given | {"OMP_DISPLAY_ENV": "true"}, capture_output=True, text=True,
    )  # fmt: skip
    assert done.returncode == 0, done.stderr
    assert re.findall(r"OMP_WAIT_POLICY ?= ?'(\w+)'", done.stderr)[0] == found


@pytest.mark.parametrize(("given", "found"), [({}, "None"), ({"WORLD_SIZE": "2"}, "ERROR")])
def test_several_processes_do_not_each_warn_of_unused_weights(
    given: dict[str, str], found: str
) -> None:
    told = "import os, src.train; print(os.environ.get('TORCH_CPP_LOG_LEVEL'))"
    left_out = ("WORLD_SIZE", "TORCH_CPP_LOG_LEVEL")
    own = {name: value for name, value in os.environ.items() if name not in left_out}
    done = subprocess.run(
        [sys.executable, "-c", told], cwd=ROOT, env=own | given, capture_output=True, text=True
    )
    assert done.stdout.strip() == found


def test_the_licence_names_every_shipped_model() -> None:
    """Each as its own card says, and the wheel's metadata as all of them together."""
    cards = {
        card.parent.name: card.read_text(encoding="utf-8")
        for card in PRETRAINED.glob("*/README.md")
    }
    licence = (ROOT / "LICENSE").read_text(encoding="utf-8")
    line = r"^ +(starter\S*|evaluator) +(CC-BY-NC-4.0, non-commercial|Apache-2.0)$"
    named = dict(re.findall(line, licence, re.MULTILINE))
    assert set(named) == set(cards)
    for name, card in cards.items():
        row = next(line for line in card.splitlines() if line.startswith("| licence"))
        assert named[name].startswith("CC-BY-NC") == ("CC BY-NC" in row)
    project = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["project"]
    assert project["license"] == "Apache-2.0 AND CC-BY-NC-4.0"
    assert all(any(file.match(glob) for glob in project["license-files"])
               for file in PRETRAINED.glob("*/README.md"))  # fmt: skip
