"""kill -9 at random moments; `python -m tests.kills` has as many of them as one likes."""

import subprocess
import sys
from pathlib import Path

import pytest


@pytest.mark.slow
@pytest.mark.skipif(sys.platform == "win32", reason="POSIX signals")
def test_what_was_killed_goes_on_to_the_same_bytes() -> None:
    done = subprocess.run(
        [sys.executable, "-m", "tests.kills", "--kills", "2"],
        cwd=Path(__file__).parents[1],
        stdout=subprocess.PIPE,
        text=True,
        check=True,
    )
    assert done.stdout.count("the same bytes") == 6
