"""A folder that one process at a time writes."""

import shutil
from collections.abc import Iterator
from contextlib import ExitStack, contextmanager, suppress
from pathlib import Path

from src.shared.errors import UserError
from src.shared.files import LEFTOVERS, made_folder

LOCK = ".lock"


@contextmanager
def sole_writer(folder: str | Path, *, wait: bool = False) -> Iterator[None]:
    """Hold `folder` against other processes, and clear what a killed one left half-written.

    The lock is of the operating system: however its holder ends, the next one gets it.

    Args:
        wait: for the other process to finish, rather than refuse.

    Raises:
        UserError: another process writes there, or the folder cannot be written.
    """
    from filelock import FileLock, Timeout

    folder = Path(folder)
    with ExitStack() as held:
        try:
            held.enter_context(made_folder(folder))
            held.enter_context(FileLock(folder / LOCK, blocking=wait))
        except Timeout:
            raise UserError(
                f"another process is writing {folder}; wait until it has finished, or name another"
                " folder"
            ) from None
        except OSError as error:
            reason = error.strerror or str(error)
            raise UserError(f"cannot write {folder}: {reason}; name another folder") from error
        try:
            _clear(folder)
            yield
        finally:
            with suppress(OSError):  # still held: whoever waits will make another one
                (folder / LOCK).unlink()


def _clear(folder: Path) -> None:
    """Remove the unfinished files and folders of a process that was killed."""
    for path in [path for pattern in LEFTOVERS for path in folder.rglob(pattern)]:
        if path.is_dir():
            shutil.rmtree(path, ignore_errors=True)
        else:
            path.unlink(missing_ok=True)
