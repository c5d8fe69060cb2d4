"""Processes of one stage on this machine, and the signals that stop them politely.

The first Ctrl-C or SIGTERM lets a step finish and be saved. Of several processes each runs the
command line of this one; they find each other by the variables that torch.distributed calls
`env://`. The first process speaks for all; what another one wrote is shown if that one was the
first to fail.
"""

import os
import shutil
import signal
import socket
import subprocess
import sys
import tempfile
import threading
import time
from collections.abc import Callable, Iterator, Sequence
from contextlib import ExitStack, contextmanager
from types import FrameType
from typing import IO, Any

from ..shared.errors import UserError


class Interrupted(UserError):
    """Training stopped on a signal after saving; `exit_code` is 128 + the signal's number."""

    def __init__(self, message: str, signal_number: int) -> None:
        super().__init__(message)
        self.exit_code = 128 + signal_number


@contextmanager
def answering(handle: Callable[[int, FrameType | None], None]) -> Iterator[None]:
    """Inside, the signals to stop are for this function to answer."""
    before: dict[signal.Signals, Any] = {}
    for number in (signal.SIGINT, signal.SIGTERM):
        try:
            before[number] = signal.signal(number, handle)
        except ValueError:  # not the main thread: signals stay with whoever runs it
            break
    try:
        yield
    finally:
        for number, handler in before.items():
            signal.signal(number, handler)


class InterruptGuard:
    """An answer: the first signal only sets `signal_number`; a second one stops at once."""

    signal_number: int | None = None

    def __call__(self, number: int, _frame: FrameType | None) -> None:
        if self.signal_number is not None:
            raise KeyboardInterrupt
        self.signal_number = number
        if os.environ.get(PLACE, "0") == "0":  # no print: it may have interrupted one
            os.write(2, b"stopping when this is finished and saved; once more to stop at once\n")


PLACE = "RANK"  # set in every process of several, by whatever launched them
STARTED_HERE = "MOTIONGEN_STARTED_BY"  # set by `run_processes`
POLL_SECONDS = 0.1
GRACE_SECONDS = 10.0  # for the others, once one has failed: they may be saving
ALIKE = (2, 128 + signal.SIGINT, 128 + signal.SIGTERM)  # what all processes end with, if one does


def is_one_of_several() -> bool:
    """Whether a launcher, ours or another, has started this process as one of several."""
    return PLACE in os.environ


def run_processes(number: int) -> int:
    """Run this program's command line in so many processes; the exit code that tells how it ended.

    SIGINT and SIGTERM are passed on, so that training saves and stops.
    """
    threads = max(1, (os.cpu_count() or 1) // number)
    shared = {
        "WORLD_SIZE": str(number),
        "MASTER_ADDR": "127.0.0.1",
        "MASTER_PORT": str(_free_port()),
        STARTED_HERE: str(os.getpid()),
        "TORCH_CPP_LOG_LEVEL": "ERROR",  # DDP warns of what a stage without unused weights costs
        "OMP_NUM_THREADS": os.environ.get("OMP_NUM_THREADS", str(threads)),
    }
    with ExitStack() as files:
        notes = [files.enter_context(tempfile.TemporaryFile()) for _ in range(number - 1)]
        errors: list[IO[bytes] | None] = [None, *notes]  # the first process has the terminal's
        workers = [_start(rank, shared, errors[rank]) for rank in range(number)]

        def pass_on(number: int, _frame: object) -> None:
            for worker in workers:
                worker.send_signal(number)

        with answering(pass_on):
            failed = _wait(workers)
        if failed is None:
            return 0
        code = workers[failed].returncode
        if failed > 0 and not (code == workers[0].returncode and code in ALIKE):
            notes[failed - 1].seek(0)
            shutil.copyfileobj(notes[failed - 1], sys.stderr.buffer)
        return code if code > 0 else 128 - code


def end_with_parent() -> None:
    """In a process that `run_processes` started: stop, saving, as soon as the starter is gone."""
    if STARTED_HERE in os.environ:
        threading.Thread(target=_await_parent, daemon=True).start()


def _await_parent() -> None:
    os.read(0, 1)  # of stdin: returns when the other end is closed, by whatever death
    os.kill(os.getpid(), signal.SIGTERM)


def _start(
    rank: int, shared: dict[str, str], errors: IO[bytes] | None
) -> "subprocess.Popen[bytes]":
    """One process; a group of its own keeps the terminal's Ctrl-C from reaching it twice."""
    return subprocess.Popen(
        [sys.executable, *sys.orig_argv[1:]],
        env=os.environ | shared | {PLACE: str(rank), "LOCAL_RANK": str(rank)},
        stdin=subprocess.PIPE,
        stderr=errors,
        process_group=None if sys.platform == "win32" else 0,
    )


def _wait(workers: Sequence["subprocess.Popen[bytes]"]) -> int | None:
    """The rank of the first that failed, when all have ended; None if none did."""
    while True:
        codes = [worker.poll() for worker in workers]
        failed = next((rank for rank, code in enumerate(codes) if code), None)
        if failed is not None or None not in codes:
            break
        time.sleep(POLL_SECONDS)
    deadline = time.monotonic() + GRACE_SECONDS
    for worker in workers:
        try:
            worker.wait(max(0.0, deadline - time.monotonic()))
        except subprocess.TimeoutExpired:
            worker.kill()
            worker.wait()
    return failed


def _free_port() -> int:
    with socket.socket() as probe:
        probe.bind(("127.0.0.1", 0))
        return int(probe.getsockname()[1])
