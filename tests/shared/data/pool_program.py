"""A program whose two workers are busy for ten minutes, or die: FOLDER linger|die."""

import os
import signal
import sys
import time
from pathlib import Path

from src.shared.data.prepare import run_jobs
from src.shared.errors import UserError
from src.shared.io.concurrency import orderly_termination


def linger(folder: Path) -> None:
    (folder / str(os.getpid())).touch()
    time.sleep(600)


def die(_folder: Path) -> None:
    os.kill(os.getpid(), signal.SIGKILL)


if __name__ == "__main__":
    job = {"linger": linger, "die": die}[sys.argv[2]]
    signal.signal(signal.SIGINT, signal.default_int_handler)  # ignored where a shell's `&` began it
    try:
        with orderly_termination():
            list(run_jobs(job, [Path(sys.argv[1])] * 4, 2))
    except UserError as error:
        sys.exit(f"error: {error}")
    except KeyboardInterrupt:
        sys.exit(130)
