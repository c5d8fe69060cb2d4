"""Jobs in processes and on a cluster: workers end with their parent, a killed one is survived."""

import os
import signal
import subprocess
import sys
import threading
import time
from contextlib import suppress
from pathlib import Path

import pytest

from src.shared.errors import UsageError, UserError
from src.shared.io.jobs import LOCAL, run_jobs
from tests.shared.io.jobs_program import die, die_once, fail

pytestmark = pytest.mark.skipif(sys.platform == "win32", reason="POSIX signals")
ROOT = Path(__file__).parents[3]


def start(folder: Path, *what: str) -> "subprocess.Popen[str]":
    return subprocess.Popen(
        [sys.executable, "-m", "tests.shared.io.jobs_program", str(folder), *what],
        cwd=ROOT,
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
    )


@pytest.mark.parametrize("where", [(), (LOCAL,)], ids=["processes", "cluster"])
@pytest.mark.parametrize(
    ("number", "code"), [(signal.SIGKILL, -9), (signal.SIGTERM, 143), (signal.SIGINT, 130)]
)
def test_workers_end_with_their_parent(
    tmp_path: Path, number: signal.Signals, code: int, where: tuple[str, ...]
) -> None:
    if where:
        pytest.importorskip("distributed")
    process = start(tmp_path, "linger", *where)
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


def test_a_pool_that_broke_leaves_no_thread_behind(tmp_path: Path) -> None:
    before = {*threading.enumerate()}
    with pytest.raises(UserError, match="a worker process was killed"):
        list(run_jobs(die, [tmp_path] * 4, 2))
    left = {*threading.enumerate()} - before
    assert not [thread.name for thread in left if "Executor" in type(thread).__name__]


def test_a_job_whose_worker_died_is_done_by_another(tmp_path: Path, scheduler: str) -> None:
    jobs = [tmp_path / name for name in ("a", "b", "deadly", "c", "d")]
    done = dict(run_jobs(die_once, jobs, scheduler=scheduler))
    assert done.keys() == set(jobs) and done[tmp_path / "deadly"] == 2


def test_a_job_that_kills_every_worker_is_one_line(tmp_path: Path, scheduler: str) -> None:
    with pytest.raises(UserError, match="killed every worker that it was given"):
        list(run_jobs(die, [tmp_path], scheduler=scheduler))


def test_what_a_job_raises_on_a_cluster_is_raised_here(scheduler: str) -> None:
    with pytest.raises(UserError, match=r"job \d found its disk full"):
        list(run_jobs(fail, range(3), scheduler=scheduler))


@pytest.mark.parametrize("address", ["nonsense", "foo://bar:1", "tcp://host"])
def test_what_is_no_address_is_refused(address: str) -> None:
    with pytest.raises(UsageError, match="is no address; give tcp"):
        list(run_jobs(fail, [1], scheduler=address))


def test_without_dask_the_package_is_named(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "distributed", None)
    with pytest.raises(UserError, match="needs Dask; install it with: pip install distributed"):
        list(run_jobs(fail, [1], scheduler=LOCAL))
