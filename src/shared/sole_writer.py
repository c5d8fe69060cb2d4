"""A folder that one process at a time writes."""

import os
import shutil
from collections.abc import Iterator
from contextlib import ExitStack, contextmanager, suppress
from pathlib import Path

from .errors import UserError
from .files import is_unfinished, made_folder

LOCK = ".lock"


@contextmanager
def sole_writer(folder: str | Path, *, wait: bool = False) -> Iterator[None]:
    """Hold `folder` against other processes, and clear what a killed one left half-written.

    The lock is of the operating system: however its holder ends, the next one gets it. That one
    was killed here is told by its lock file, which stays; nothing is cleared without it.

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
            killed = (folder / LOCK).exists()
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
            if killed:
                _clear(folder)
            yield
        finally:
            with suppress(OSError):  # still held: whoever waits will make another one
                (folder / LOCK).unlink()


def _clear(folder: Path) -> None:
    """Remove what has the name of something unfinished, but where another run writes or wrote."""
    for place, folders, files in os.walk(folder):
        own = [name for name in folders if is_unfinished(Path(place, name))]
        for name in own:
            shutil.rmtree(Path(place, name), ignore_errors=True)
        folders[:] = [
            name for name in folders if name not in own and not Path(place, name, LOCK).exists()
        ]
        for name in files:
            if is_unfinished(Path(place, name)):
                Path(place, name).unlink(missing_ok=True)
