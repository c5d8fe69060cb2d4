"""Limits on what is read from files: bytes, frames, joints, time; arrays without pickles.

A file is somebody else's: every reader asks here first, so that none can fill the memory, run
for minutes or run code. The figures leave room for half an hour of mocap at 120 frames a second.
"""

import io
import math
import time
import zipfile
from collections.abc import Iterable
from pathlib import Path
from typing import IO

import numpy as np

from src.shared.errors import UserError

MAX_BYTES = 256 << 20  # of one file
MAX_LINE = 1 << 20  # bytes; hundreds of joints with long numbers
MAX_JOINTS = 2000
MAX_FRAMES = 1_000_000  # more than two hours at 120 frames a second
MAX_VALUES = 16 << 20  # numbers kept of one file: 128 MB as float64
MAX_VALUE = 1e7  # no angle or position, in any unit, is larger: the file is damaged
MAX_SECONDS = 120.0  # of reading one file
FRAME_RATES = (1.0, 2000.0)  # frames a second that a recording can have
_MAX_MEMBERS = 1000  # arrays of one archive
_MAX_HEADER = 10_000  # bytes that describe one array
_END = b"PK\5\6"  # of a ZIP archive: where its directory is


class Deadline:
    """Time that reading one file may take."""

    def __init__(self, path: Path, seconds: float = MAX_SECONDS) -> None:
        self._path, self._seconds = path, seconds
        self._end = time.monotonic() + seconds

    def check(self) -> None:
        """Raises UserError when the time is over."""
        if time.monotonic() > self._end:
            raise UserError(f"{self._path}: reading takes more than {self._seconds:g} s; "
                            "split the file")  # fmt: skip


def check_size(path: Path, max_bytes: int = MAX_BYTES) -> int:
    """Bytes of a file.

    Raises:
        UserError: missing, not a plain file, unreadable, empty or too large.
    """
    try:
        size = path.stat().st_size
    except (OSError, ValueError) as error:  # ValueError: a zero byte in the name
        reason = getattr(error, "strerror", None) or error
        raise UserError(f"{path}: cannot be read: {reason}") from error
    if not path.is_file():  # a device or pipe would never end
        raise UserError(f"{path}: is not a file; name a motion file")
    if size > max_bytes:
        raise UserError(f"{path}: {size / 2**20:.0f} MB is over the limit of "
                        f"{max_bytes / 2**20:.0f} MB; split the file")  # fmt: skip
    if not size:
        raise UserError(f"{path}: is empty; export it again")
    return size


def read_bytes(path: Path, max_bytes: int = MAX_BYTES) -> bytes:
    """All bytes of a file.

    Raises:
        UserError: missing, unreadable, empty or too large.
    """
    check_size(path, max_bytes)
    try:
        with path.open("rb") as stream:
            return stream.read(max_bytes)
    except OSError as error:
        raise UserError(f"{path}: cannot be read: {error.strerror or error}") from error


def read_arrays(path: Path, wanted: Iterable[str]) -> dict[str, np.ndarray]:
    """Those of the `wanted` arrays that an NPZ file holds; no other member is touched.

    The declared size of each is held against the limit and against what the archive says before
    anything is unpacked; objects (pickles) are refused.

    Raises:
        UserError: not an NPZ file, damaged, too large, or with pickles.
    """
    check_size(path)
    try:
        with path.open("rb") as stream:
            _check_directory(path, stream)
            with zipfile.ZipFile(stream) as archive:
                infos = {info.filename.removesuffix(".npy"): info for info in archive.infolist()}
                return {name: _read_member(path, archive, infos[name], name)
                        for name in wanted if name in infos}  # fmt: skip
    except UserError:
        raise
    except OSError as error:
        raise UserError(f"{path}: cannot be read: {error.strerror or error}") from error
    except Exception as error:  # a damaged archive fails in zipfile, zlib or numpy, in any way
        raise UserError(f"{path}: is not a whole NPZ file ({error}); write it again") from error


def array_names(path: Path) -> tuple[str, ...]:
    """Names of the arrays in an NPZ file.

    Raises:
        UserError: not an NPZ file.
    """
    check_size(path)
    try:
        with path.open("rb") as stream:
            _check_directory(path, stream)
            with zipfile.ZipFile(stream) as archive:
                return tuple(name.removesuffix(".npy") for name in archive.namelist())
    except UserError:
        raise
    except Exception as error:
        raise UserError(f"{path}: is not a whole NPZ file ({error}); write it again") from error


def read_array(path: Path) -> np.ndarray:
    """The array of an NPY file, under the same limits.

    Raises:
        UserError: not an NPY file, damaged, too large, or with pickles.
    """
    size = check_size(path)
    try:
        with path.open("rb") as stream:
            return _read_array(path, stream, size, "the array")
    except UserError:
        raise
    except OSError as error:
        raise UserError(f"{path}: cannot be read: {error.strerror or error}") from error
    except Exception as error:
        raise UserError(f"{path}: is not a whole NPY file ({error}); write it again") from error


def _check_directory(path: Path, stream: IO[bytes]) -> None:
    """Refuse an archive whose directory alone would fill the memory."""
    size = stream.seek(0, io.SEEK_END)
    stream.seek(max(0, size - (1 << 16) - 22))
    tail = stream.read()
    at = tail.rfind(_END)
    if at < 0 or len(tail) < at + 22:
        raise UserError(f"{path}: is not a whole NPZ file; write it again")
    members = int.from_bytes(tail[at + 10 : at + 12], "little")
    directory = int.from_bytes(tail[at + 12 : at + 16], "little")
    if members > _MAX_MEMBERS or directory > _MAX_MEMBERS * 512 or b"PK\6\7" in tail[:at][-20:]:
        raise UserError(f"{path}: holds {members} arrays; a motion has a few")
    stream.seek(0)


def _read_member(
    path: Path, archive: zipfile.ZipFile, info: zipfile.ZipInfo, name: str
) -> np.ndarray:
    """One array of an archive."""
    if info.flag_bits & 1:
        raise UserError(f"{path}: array {name!r} is encrypted; save it without a password")
    with archive.open(info) as stream:
        return _read_array(path, stream, info.file_size, f"array {name!r}")


def _read_array(path: Path, stream: IO[bytes], size: int, what: str) -> np.ndarray:
    """An array in NPY form of `size` bytes, header included."""
    version = np.lib.format.read_magic(stream)
    reader = {(1, 0): np.lib.format.read_array_header_1_0,
              (2, 0): np.lib.format.read_array_header_2_0}.get(version)  # fmt: skip
    if reader is None:
        raise UserError(f"{path}: {what} has version {version} of the NPY form; save it again")
    shape, fortran, dtype = reader(stream, max_header_size=_MAX_HEADER)
    if dtype.hasobject or dtype.kind not in "biufUS":
        raise UserError(f"{path}: {what} holds Python objects ({dtype}), which are never loaded: "
                        "they can run code; save plain numbers")  # fmt: skip
    count = math.prod(shape)
    if count > MAX_VALUES or count * dtype.itemsize > 8 * MAX_VALUES:
        raise UserError(f"{path}: {what} has shape {list(shape)}, more than "
                        f"{MAX_VALUES} numbers; split the file")  # fmt: skip
    wanted = count * dtype.itemsize
    if wanted > size:
        raise UserError(f"{path}: {what} says shape {list(shape)}, but only {size} bytes follow; "
                        "the file is damaged or cut off")  # fmt: skip
    data = stream.read(wanted)
    if len(data) != wanted:
        raise UserError(f"{path}: {what} is cut off; write it again")
    if not wanted:
        return np.zeros(shape, dtype)
    stream.read(1)  # lets the archive compare its checksum
    return np.frombuffer(data, dtype).reshape(shape, order="F" if fortran else "C")
