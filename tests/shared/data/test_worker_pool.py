"""Workers end with their parent, however that ends; a killed worker is one line."""

import os
import signal
import subprocess
import sys
import time
from contextlib import suppress
from pathlib import Path

import pytest

pytestmark = pytest.mark.skipif(sys.platform == "win32", reason="POSIX signals")
ROOT = Path(__file__).parents[3]


def start(folder: Path, what: str) -> "subprocess.Popen[str]":
    return subprocess.Popen(
        [sys.executable, "-m", "tests.shared.data.pool_program", str(folder), what],
        cwd=ROOT,
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
    )


@pytest.mark.parametrize(
    ("number", "code"), [(signal.SIGKILL, -9), (signal.SIGTERM, 143), (signal.SIGINT, 130)]
)
def test_workers_end_with_their_parent(tmp_path: Path, number: signal.Signals, code: int) -> None:
    process = start(tmp_path, "linger")
    while len(workers := list(tmp_path.iterdir())) < 2:
        assert process.poll() is None
        time.sleep(0.05)
    process.send_signal(number)
    try:  # the pipes end when the last process that holds them does
        out, errors = process.communicate(timeout=60)
    finally:
        for worker in workers:
            with suppress(ProcessLookupError):
                os.kill(int(worker.name), signal.SIGKILL)
    assert (process.returncode, out) == (code, "")
    if number != signal.SIGKILL:
        assert errors == ""


def test_a_killed_worker_is_one_line(tmp_path: Path) -> None:
    _, errors = start(tmp_path, "die").communicate(timeout=300)
    assert errors.startswith("error: a worker process was killed")
    assert len(errors.splitlines()) == 1
