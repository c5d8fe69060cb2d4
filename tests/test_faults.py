"""Faults at random moments; `python -m tests.faults` has as many of them as one likes."""

import subprocess
import sys
from pathlib import Path

import pytest


@pytest.mark.slow
@pytest.mark.skipif(sys.platform == "win32", reason="POSIX signals")
def test_what_met_a_fault_goes_on_to_the_same_bytes() -> None:
    done = subprocess.run(
        [sys.executable, "-m", "tests.faults", "--times", "2"],
        cwd=Path(__file__).parents[1],
        stdout=subprocess.PIPE,
        text=True,
        check=True,
    )
    faults = 3 if "left out" in done.stdout else 5
    assert done.stdout.count("the same bytes") == 6 * faults
