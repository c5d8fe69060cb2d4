"""Whole files only: write beside the target, then rename; hash what was written; JSON in."""

import codecs
import errno
import hashlib
import json
import os
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from pathlib import Path
from typing import Any

from src.shared.errors import UserError

MAX_JSON = 256 << 20  # bytes
MAX_TEXT = 64 << 20


@contextmanager
def atomic_write(path: Path) -> Iterator[Path]:
    """Yield a temporary path in the same folder that replaces `path` when the block succeeds.

    Raises:
        UserError: the folder or file cannot be written (no permission, disk full, name too long).
    """
    path = Path(path)
    temporary = path.with_name(f".{path.name}.{os.getpid()}.part")
    try:
        path.parent.mkdir(parents=True, exist_ok=True)
        temporary.touch()  # its mode is that of any new file; some writers make theirs private
        mode = (path if path.exists() else temporary).stat().st_mode & 0o777
        temporary.unlink()
        yield temporary
        temporary.chmod(mode)
        os.replace(temporary, path)
    except OSError as error:
        reason = error.strerror or str(error)
        long = error.errno == errno.ENAMETOOLONG
        raise UserError(
            f"cannot write {path}: {reason}; "
            + ("shorten its name" if long else "free space or choose another folder")
        ) from error
    finally:
        with suppress(OSError):  # a parent that is a file, say: the error above told already
            temporary.unlink()


def write_text(path: Path, text: str) -> None:
    """Write UTF-8 text whole or not at all."""
    with atomic_write(path) as temporary:
        temporary.write_text(text, encoding="utf-8")


def write_json(path: Path, value: Any) -> None:
    """Write JSON with stable key order, whole or not at all."""
    write_text(path, json.dumps(value, indent=1, ensure_ascii=False, sort_keys=True) + "\n")


def read_text(path: Path, wanted: str, *, max_bytes: int = MAX_TEXT) -> str:
    """The text of a file that people write: UTF-8, or UTF-16 with its mark, as Excel writes it.

    Args:
        path: the file.
        wanted: what it should be, with its article, for errors.
        max_bytes: of it.

    Raises:
        UserError: missing, unreadable, too large, or in neither of them.
    """
    try:
        with Path(path).open("rb") as stream:
            data = stream.read(max_bytes + 1)
        if len(data) <= max_bytes:
            wide = data.startswith((codecs.BOM_UTF16_LE, codecs.BOM_UTF16_BE))
            return data.decode("utf-16" if wide else "utf-8-sig")
        reason = f"larger than {max_bytes >> 20} MB"
    except OSError as error:
        reason = error.strerror or str(error)
    except UnicodeDecodeError as error:
        reason = f"not UTF-8 text: {error.reason} at byte {error.start}"
    raise UserError(f"{path}: cannot be read ({reason}); give {wanted}")


def load_json(path: str | Path, *, max_bytes: int = MAX_JSON) -> Any:
    """The value in a JSON file.

    Raises:
        OSError: missing or unreadable.
        ValueError: too large, not UTF-8, not JSON, or nested too deeply.
    """
    with Path(path).open("rb") as stream:
        data = stream.read(max_bytes + 1)
    if len(data) > max_bytes:
        raise ValueError(f"larger than {max_bytes >> 20} MB")
    return parse_json(data)


def parse_json(data: str | bytes) -> Any:
    """The value of a JSON text.

    Raises:
        ValueError: not UTF-8, not JSON, or nested too deeply.
    """
    try:
        return json.loads(data)
    except RecursionError:
        raise ValueError("nested too deeply") from None


def inside(folder: Path, name: str) -> Path:
    """The path of a file that something in `folder` names, such as its manifest.

    Raises:
        UserError: the name leads out of the folder, or is a folder's.
    """
    path = Path(folder) / name
    if not path.resolve().is_relative_to(Path(folder).resolve()):
        raise UserError(f"{name!r} leads out of {folder}, where it is named; write the folder anew")
    if path.is_dir():
        raise UserError(f"{path} is named as a file and is a folder; write {folder} anew")
    return path


def sha256_file(path: Path) -> str:
    """Hex SHA-256 of a file, read in chunks."""
    digest = hashlib.sha256()
    with Path(path).open("rb") as stream:
        while chunk := stream.read(1 << 20):
            digest.update(chunk)
    return digest.hexdigest()
