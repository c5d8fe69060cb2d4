"""SIGTERM ends a program as an error would, Ctrl-C everywhere: what has to be tidied up is."""

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

INTERRUPTED = """
import os, signal, weakref
signal.signal(signal.SIGINT, signal.default_int_handler)  # ignored where `&` began the tests
def interrupted():
    os.kill(os.getpid(), NUMBER)
    for _ in range(1000):
        pass
class Finalized:
    def __del__(self):
        interrupted()
class CalledBack:
    def __init__(self):
        weakref.finalize(self, interrupted)
class HalfBuilt:
    def __init__(self):
        interrupted()
        self.file = None
    def __del__(self):
        self.file
"""


@pytest.mark.skipif(sys.platform == "win32", reason="POSIX signals")
@pytest.mark.parametrize("number", [signal.SIGTERM, signal.SIGINT])
@pytest.mark.parametrize("case", ["Finalized", "CalledBack", "HalfBuilt"])
def test_a_signal_ends_the_program_wherever_it_comes(case: str, number: signal.Signals) -> None:
    program = PROGRAM.replace('print("started", flush=True)', f"{case}()")
    classes = INTERRUPTED.replace("NUMBER", str(int(number)))
    program = program.replace("\nwith", f"{classes}\nwith", 1)
    done = subprocess.run(
        [sys.executable, "-c", program],
        cwd=Path(__file__).parents[3],
        capture_output=True,
        text=True,
        timeout=60,
    )
    assert done.stdout == "tidied\n" and "ignored" not in done.stderr
    if number == signal.SIGTERM:
        assert (done.returncode, done.stderr) == (128 + number, "")
    else:
        assert done.returncode == -number and done.stderr.endswith("\nKeyboardInterrupt\n")
        assert done.stderr.count("Error") == 0


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
