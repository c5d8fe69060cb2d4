"""SIGTERM ends a program as an error would: what has to be tidied up is."""

import signal
import subprocess
import sys
from pathlib import Path

import pytest

PROGRAM = """
import time
from src.shared.io.concurrency import orderly_termination
with orderly_termination():
    try:
        print("started", flush=True)
        time.sleep(600)
    finally:
        print("tidied")
"""


@pytest.mark.skipif(sys.platform == "win32", reason="POSIX signals")
def test_sigterm_leaves_in_order() -> None:
    process = subprocess.Popen(
        [sys.executable, "-c", PROGRAM],
        cwd=Path(__file__).parents[3],
        stdout=subprocess.PIPE,
        text=True,
    )
    assert process.stdout is not None and process.stdout.readline() == "started\n"
    process.send_signal(signal.SIGTERM)
    out, _ = process.communicate(timeout=60)
    assert (process.returncode, out) == (128 + signal.SIGTERM, "tidied\n")
