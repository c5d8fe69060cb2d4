"""One function over many jobs: in this process, in several, or on the workers of a Dask cluster.

Whoever calls writes what a job made under the job's key, whole and to the same bytes wherever it
runs, so that a job which is done twice, as when a worker dies, is done once for all that is seen.
"""

import logging
import multiprocessing
import os
import re
import signal
import threading
from collections.abc import Callable, Iterator, Sequence
from concurrent import futures
from concurrent.futures import CancelledError, ProcessPoolExecutor
from concurrent.futures.process import BrokenProcessPool
from contextlib import ExitStack, suppress
from importlib.util import find_spec
from itertools import islice
from multiprocessing.connection import Connection
from typing import Any, TypeVar

from ..errors import UsageError, UserError
from .concurrency import answered
from .files import load_json
from .storage import Place

Job = TypeVar("Job")
Result = TypeVar("Result")

LOCAL = "local"  # instead of an address: a cluster on this machine
_ADDRESS = re.compile(r"(tcp|tls|ws|wss)://\S+:\d+")
AHEAD = 10_000  # jobs that a scheduler is told of before their turn
REACH = 30.0  # seconds to find a scheduler


def finished_record(path: Place, key: str) -> dict[str, Any] | None:
    """What was written of a finished job; None if nothing is there, damaged, or of another key."""
    try:
        content = load_json(path)
    except (OSError, ValueError):
        return None
    return content if isinstance(content, dict) and content.get("key") == key else None


def run_jobs(
    function: Callable[[Job], Result],
    jobs: Sequence[Job],
    workers: int | None = None,
    scheduler: str | None = None,
) -> Iterator[tuple[Job, Result]]:
    """Yield (job, `function(job)`) as they finish; what a job raises is raised here.

    Args:
        function: of a module, so that processes can be handed it; on a cluster it may run twice
            for a job, at once even, and workers have several threads.
        jobs: each is sent to one process. A cluster's workers read and write the paths in them.
        workers: processes, one works in this process; default: one a CPU core.
        scheduler: of a Dask cluster, such as tcp://host:8786, whose workers do the jobs; LOCAL
            makes one here of `workers` processes. A job whose worker died goes to another one.

    Raises:
        UserError: a worker was killed (on a cluster: several, by one job); no such scheduler, it
            went away, or Dask is not installed.
    """
    workers = workers or os.cpu_count() or 1
    if not jobs:
        return
    if scheduler is not None:
        yield from _on_cluster(function, jobs, workers, scheduler)
    elif workers == 1 or len(jobs) == 1:
        for job in jobs:
            yield job, function(job)
    else:
        yield from _in_processes(function, jobs, workers)


# ---------------------------------------------------------------- processes


def _in_processes(
    function: Callable[[Job], Result], jobs: Sequence[Job], workers: int
) -> Iterator[tuple[Job, Result]]:
    context = multiprocessing.get_context("spawn")  # forking a process with torch threads hangs
    parent, lifeline = context.Pipe(duplex=False)
    pool = ProcessPoolExecutor(min(workers, len(jobs)), context, _start_worker, (parent,))
    with parent, lifeline, pool:
        with answered(signal.SIGINT, signal.SIG_IGN):
            pending = {pool.submit(function, job): job for job in jobs}
        try:
            for future in futures.as_completed(pending):
                yield pending[future], future.result()
        except BaseException as error:
            lifeline.close()  # ends the workers, so that leaving the pool waits for none of them
            if isinstance(error, BrokenProcessPool):
                raise UserError(
                    "a worker process was killed, most likely because memory ran out; give fewer"
                    " --workers and run again: what is finished is kept"
                ) from error
            raise


def _start_worker(parent: Connection) -> None:
    _one_thread()
    threading.Thread(target=_end_with, args=(parent,), daemon=True).start()


def _one_thread() -> None:
    import torch

    torch.set_num_threads(1)


def _end_with(parent: Connection) -> None:
    """End this process when the other end of the pipe is closed, by the parent or its death."""
    with suppress(EOFError, OSError):
        parent.recv_bytes()
    os._exit(1)


# ---------------------------------------------------------------- cluster


def check_scheduler(scheduler: str | None) -> None:
    """Refuse what is no cluster, before anything is listed or started.

    Raises:
        UsageError: no address, of which Dask's client would tell after minutes.
        UserError: Dask is not installed.
    """
    if scheduler is None:
        return
    if scheduler != LOCAL and not _ADDRESS.fullmatch(scheduler):
        raise UsageError(f"--scheduler {scheduler} is no address; give tcp://HOST:8786, or {LOCAL}")
    if find_spec("distributed") is None:
        raise UserError(
            f"--scheduler {scheduler} needs Dask; install it with: pip install distributed"
        )


def _on_cluster(
    function: Callable[[Job], Result], jobs: Sequence[Job], workers: int, scheduler: str
) -> Iterator[tuple[Job, Result]]:
    check_scheduler(scheduler)
    from distributed import KilledWorker, as_completed
    from distributed.comm import CommClosedError

    with ExitStack() as held:
        client = held.enter_context(_client(held, workers, scheduler))
        todo, waiting = iter(jobs), {}

        def submit(job: Job) -> Any:
            future = client.submit(_perform, function, job, pure=False)
            waiting[future.key] = job
            return future

        first = [submit(job) for job in islice(todo, AHEAD)]
        done = as_completed(first, loop=client.loop)
        try:
            for future in done:
                result = future.result()
                yield waiting.pop(future.key), result
                for job in islice(todo, 1):
                    done.add(submit(job))
        except KilledWorker as error:
            raise UserError(
                f"a job of {scheduler} killed every worker that it was given, most likely because"
                " memory ran out; give them more and run again: what is finished is kept"
            ) from error
        except (CancelledError, CommClosedError) as error:
            raise UserError(
                f"the scheduler {scheduler} went away; start it and run again: what is finished is"
                " kept"
            ) from error


def _client(held: ExitStack, workers: int, scheduler: str) -> Any:
    """A connection to the cluster, or to one of its own that ends with `held`."""
    from distributed import Client, LocalCluster

    for name in list(logging.root.manager.loggerDict):
        if name.startswith("distributed"):  # what matters is raised here
            logging.getLogger(name).setLevel(logging.CRITICAL)
    if scheduler == LOCAL:
        with answered(signal.SIGINT, signal.SIG_IGN):
            cluster = LocalCluster(
                n_workers=workers, threads_per_worker=1, dashboard_address=None,
                silence_logs=logging.CRITICAL, scheduler_kwargs={"dashboard_address": ":0"},
            )  # fmt: skip
            held.enter_context(cluster)
            return Client(cluster, set_as_default=False)
    try:
        return Client(scheduler, set_as_default=False, timeout=REACH)
    except (OSError, TimeoutError) as error:
        raise UserError(
            f"--scheduler {scheduler}: nothing answers there; start one with: dask scheduler"
        ) from error


def _perform(function: Callable[[Job], Result], job: Job) -> Result:
    """On a worker: one thread a job, for as many jobs as the worker has threads."""
    _one_thread()
    return function(job)
