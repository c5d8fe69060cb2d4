"""Whole files only: write beside the target, then rename; folders one process writes; JSON in."""

import codecs
import errno
import hashlib
import json
import os
import platform
import re
import shutil
import tempfile
import zlib
from collections.abc import Iterator
from contextlib import ExitStack, contextmanager, suppress
from pathlib import Path
from typing import Any

from ..errors import UsageError, UserError
from .storage import Address, Place, files_below

MAX_JSON = 256 << 20  # bytes
MAX_TEXT = 64 << 20
_UNFINISHED, _SAFETENSORS = re.compile(r"\..+\.\d+\.part"), re.compile(r"\.tmp[A-Za-z0-9]{6}")
_MACHINE = zlib.crc32(platform.node().encode()) % 100_000
# What systems say of a full disk. Libraries in C++ and Rust quote it in errors of their own.
_FULL = (
    *map(os.strerror, (errno.ENOSPC, errno.EDQUOT, errno.EFBIG)),
    "not enough space on the disk",
)


@contextmanager
def atomic_write(path: Place) -> Iterator[Path]:
    """Yield a temporary path in the same folder that replaces `path` when the block succeeds.

    For an address it lies on this machine, and is put there.

    Raises:
        UserError: the folder or file cannot be written (no permission, disk full, name too long).
    """
    if isinstance(path, Address):
        with tempfile.TemporaryDirectory(prefix="motionsuite-") as folder:
            local = Path(folder, path.name)
            with atomic_write(local) as temporary:
                yield temporary
            path.write_bytes(local.read_bytes())
        return
    path = Path(path)
    temporary = unfinished(path)
    try:
        path.parent.mkdir(parents=True, exist_ok=True)
        temporary.touch()  # its mode is that of any new file; some writers make theirs private
        mode = (path if path.exists() else temporary).stat().st_mode & 0o777
        temporary.unlink()
        yield temporary
        temporary.chmod(mode)
        os.replace(temporary, path)
    except Exception as error:
        if isinstance(error, UserError) or (reason := why_not_written(error)) is None:
            raise
        long = isinstance(error, OSError) and error.errno == errno.ENAMETOOLONG
        raise UserError(
            f"cannot write {path}: {reason}; "
            + ("shorten its name" if long else "free space or choose another folder")
        ) from error
    finally:
        with suppress(OSError):  # a parent that is a file, say: the error above told already
            temporary.unlink()


def unfinished(path: Path) -> Path:
    """Where a file or folder is written before it takes its name; see `is_unfinished`.

    Processes have names of their own, also those of machines that share the folder.
    """
    return path.with_name(f".{path.name}.{os.getpid()}{_MACHINE:05d}.part")


def is_unfinished(path: Path) -> bool:
    """Whether a path has a name of `unfinished`, or, as a file, one that safetensors gives."""
    return bool(_UNFINISHED.fullmatch(path.name)) or (
        bool(_SAFETENSORS.fullmatch(path.name)) and path.is_file()
    )


def why_not_written(error: Exception) -> str | None:
    """What the system said when a file could not be written; None where the fault is another."""
    if isinstance(error, OSError):
        return error.strerror or str(error)
    return next((words for words in _FULL if words in str(error)), None)


@contextmanager
def made_folder(folder: Path) -> Iterator[None]:
    """Make a folder; afterwards what of it and its parents is new and empty goes again.

    Raises:
        OSError: it cannot be made.
    """
    new = [part for part in (folder, *folder.parents) if not part.exists()]
    try:
        folder.mkdir(parents=True, exist_ok=True)
        yield
    finally:
        for part in new:
            with suppress(OSError):
                part.rmdir()


def write_text(path: Place, text: str) -> None:
    """Write UTF-8 text whole or not at all."""
    with atomic_write(path) as temporary:
        temporary.write_text(text, encoding="utf-8")


def write_json(path: Place, value: Any, *, indent: int | None = 1) -> None:
    """Write JSON with stable key order, whole or not at all; without an indent in one line."""
    apart = (",", ":") if indent is None else None
    form = json.dumps(value, indent=indent, separators=apart, ensure_ascii=False, sort_keys=True)
    write_text(path, f"{form}\n")


def read_text(path: Path, wanted: str) -> str:
    """The text of a file that people write: UTF-8, or UTF-16 with its mark, as Excel writes it.

    Args:
        wanted: what the file should be, with its article, for errors.

    Raises:
        UsageError: it does not exist.
        UserError: unreadable, too large, or in neither of them.
    """
    try:
        with Path(path).open("rb") as stream:
            data = stream.read(MAX_TEXT + 1)
        if len(data) <= MAX_TEXT:
            wide = data.startswith((codecs.BOM_UTF16_LE, codecs.BOM_UTF16_BE))
            return data.decode("utf-16" if wide else "utf-8-sig")
        reason = f"larger than {MAX_TEXT >> 20} MB"
    except FileNotFoundError:
        raise UsageError(f"{path} does not exist; give {wanted}") from None
    except OSError as error:
        reason = error.strerror or str(error)
    except UnicodeDecodeError as error:
        reason = f"not UTF-8 text: {error.reason} at byte {error.start}"
    raise UserError(f"{path}: cannot be read ({reason}); give {wanted}")


def load_json(path: Place, *, max_bytes: int = MAX_JSON) -> Any:
    """The value in a JSON file.

    Raises:
        OSError: missing or unreadable.
        ValueError: too large, not UTF-8, not JSON, or nested too deeply.
    """
    with path.open("rb") as stream:
        data = stream.read(max_bytes + 1)
    if len(data) > max_bytes:
        raise ValueError(f"larger than {max_bytes >> 20} MB")
    return parse_json(data)


def parse_json(data: str | bytes) -> Any:
    """The value of a JSON text; raises ValueError: not UTF-8, not JSON, or nested too deeply."""
    try:
        return json.loads(data)
    except RecursionError:
        raise ValueError("nested too deeply") from None


def same_place(one: Place, other: Place) -> bool:
    """Whether two paths lead to one place, through links; a loop of links is its own place."""
    if isinstance(one, Address) or isinstance(other, Address):
        return one == other
    return os.path.realpath(one) == os.path.realpath(other)  # `Path.resolve` may raise at a loop


def inside(folder: Path, name: str) -> Path:
    """The path of a file that something in `folder` names, such as its manifest.

    Raises:
        UserError: the name leads out of the folder, or is a folder's.
    """
    path = Path(folder) / name
    if not Path(os.path.realpath(path)).is_relative_to(os.path.realpath(folder)):
        raise UserError(f"{name!r} leads out of {folder}, where it is named; write the folder anew")
    if path.is_dir():
        raise UserError(f"{path} is named as a file and is a folder; write {folder} anew")
    return path


def sha256_file(path: Place) -> str:
    """Hex SHA-256 of a file, read in chunks."""
    digest = hashlib.sha256()
    with path.open("rb") as stream:
        while chunk := stream.read(1 << 20):
            digest.update(chunk)
    return digest.hexdigest()


def is_whole(path: Place, sha256: str) -> bool:
    """Whether a file is there with that content."""
    try:
        return sha256_file(path) == sha256
    except (FileNotFoundError, NotADirectoryError):
        return False


LOCK = ".lock"


@contextmanager
def sole_writer(folder: str | Place, *, wait: bool = False) -> Iterator[None]:
    """Hold `folder` against other processes, and clear what a killed one left half-written.

    The lock is of the operating system: however its holder ends, the next one gets it. That one
    was killed here is told by its lock file, which stays; nothing is cleared without it. An address
    knows no locks, and there is nothing half-written: it is not held.

    Args:
        wait: for the other process to finish, rather than refuse.

    Raises:
        UserError: another process writes there, or the folder cannot be written.
    """
    if isinstance(folder, Address):
        yield
        return
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
                clear_unfinished(folder)
            yield
        finally:
            with suppress(OSError):  # still held: whoever waits will make another one
                (folder / LOCK).unlink()


def remove_folder(folder: Place) -> None:
    """Remove a folder and what is in it, if it is there."""
    if isinstance(folder, Address):
        for file in files_below(folder):
            file.unlink(missing_ok=True)
    else:
        shutil.rmtree(folder, ignore_errors=True)


def clear_unfinished(folder: Place) -> None:
    """Remove what has the name of something unfinished, but where another run writes or wrote."""
    if isinstance(folder, Address):
        return
    for where, folders, files in os.walk(folder):
        own = [name for name in folders if is_unfinished(Path(where, name))]
        for name in own:
            shutil.rmtree(Path(where, name), ignore_errors=True)
        folders[:] = [
            name for name in folders if name not in own and not Path(where, name, LOCK).exists()
        ]
        for name in files:
            if is_unfinished(Path(where, name)):
                Path(where, name).unlink(missing_ok=True)
