"""A program whose two workers are busy for ten minutes, or die: FOLDER linger|die [SCHEDULER]."""

import os
import signal
import sys
import time
from pathlib import Path

from src.shared.errors import UserError
from src.shared.io.concurrency import orderly_termination
from src.shared.io.jobs import run_jobs


def linger(folder: Path) -> None:
    (folder / str(os.getpid())).touch()
    time.sleep(600)


def die(_folder: Path) -> None:
    os.kill(os.getpid(), signal.SIGKILL)


def die_once(path: Path) -> int:
    """Count the doings in the file; of the one called "deadly" the first ends the process."""
    with path.open("a") as stream:
        stream.write(".")
    if path.name == "deadly" and path.stat().st_size == 1:
        die(path)
    return path.stat().st_size


def fail(number: int) -> None:
    raise UserError(f"job {number} found its disk full")


if __name__ == "__main__":
    job = {"linger": linger, "die": die}[sys.argv[2]]
    signal.signal(signal.SIGINT, signal.default_int_handler)  # ignored where a shell's `&` began it
    try:
        with orderly_termination():
            list(run_jobs(job, [Path(sys.argv[1])] * 4, 2, *sys.argv[3:]))
    except UserError as error:
        sys.exit(f"error: {error}")
    except KeyboardInterrupt:
        sys.exit(130)
