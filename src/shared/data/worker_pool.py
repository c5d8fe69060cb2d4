"""Jobs spread over worker processes, which end when their parent does, and what is done already.

Ctrl-C is the parent's to answer, with one line.
"""

import multiprocessing
import os
import signal
import threading
from collections.abc import Callable, Iterator, Sequence
from concurrent.futures import ProcessPoolExecutor, as_completed
from concurrent.futures.process import BrokenProcessPool
from contextlib import suppress
from multiprocessing.connection import Connection
from pathlib import Path
from typing import Any, TypeVar

import torch

from ..errors import UserError
from ..io.concurrency import answered
from ..io.files import load_json, sha256_file

Job = TypeVar("Job")
Result = TypeVar("Result")


def finished_record(path: Path, key: str) -> dict[str, Any] | None:
    """What was written of a finished job; None if nothing is there, damaged, or of another key."""
    try:
        content = load_json(path)
    except (OSError, ValueError):
        return None
    return content if isinstance(content, dict) and content.get("key") == key else None


def is_whole(path: Path, sha256: str) -> bool:
    """Whether a file is there with that content."""
    return path.exists() and sha256_file(path) == sha256


def run_jobs(
    function: Callable[[Job], Result], jobs: Sequence[Job], workers: int
) -> Iterator[tuple[Job, Result]]:
    """Yield (job, `function(job)`) as they finish; what a job raises is raised here.

    Args:
        function: of a module, so that processes can be handed it.
        jobs: each is sent to one process.
        workers: processes; one works in this process.

    Raises:
        UserError: a worker was killed.
    """
    if workers == 1 or len(jobs) <= 1:
        for job in jobs:
            yield job, function(job)
        return
    context = multiprocessing.get_context("spawn")  # forking a process with torch threads hangs
    parent, lifeline = context.Pipe(duplex=False)
    pool = ProcessPoolExecutor(min(workers, len(jobs)), context, _start_worker, (parent,))
    with parent, lifeline, pool:
        with answered(signal.SIGINT, signal.SIG_IGN):
            pending = {pool.submit(function, job): job for job in jobs}
        try:
            for future in as_completed(pending):
                yield pending[future], future.result()
        except BaseException as error:
            pool.shutdown(wait=False, cancel_futures=True)
            lifeline.close()
            if isinstance(error, BrokenProcessPool):
                raise UserError(
                    "a worker process was killed, most likely because memory ran out; give fewer"
                    " --workers and run again: what is finished is kept"
                ) from error
            raise


def _start_worker(parent: Connection) -> None:
    torch.set_num_threads(1)
    threading.Thread(target=_end_with, args=(parent,), daemon=True).start()


def _end_with(parent: Connection) -> None:
    """End this process when the other end of the pipe is closed, by the parent or its death."""
    with suppress(EOFError, OSError):
        parent.recv_bytes()
    os._exit(1)
