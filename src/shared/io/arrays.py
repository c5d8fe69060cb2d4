"""Arrays from NPY and NPZ files that somebody else made: bounded, and never with pickles.

The declared size of an array is held against the limit and against the bytes that are there
before anything is allocated or unpacked; members that nobody asked for are not touched.
"""

import io
import math
import zipfile
from collections.abc import Iterable, Iterator, Mapping
from contextlib import contextmanager
from functools import lru_cache
from typing import IO, TypeVar

import numpy as np

from .files import atomic_write
from .storage import Place, place

PlaceT = TypeVar("PlaceT", bound=Place)

MAX_VALUES = 16 << 20  # numbers kept of one array: 128 MB as float64
_MAX_MEMBERS = 1000  # arrays of one archive
_MAX_HEADER = 10_000  # bytes that describe one array
_END = b"PK\5\6"  # of a ZIP archive: where its directory is


class BadArray(ValueError):
    """No array file, a damaged or too large one, or one with pickles; the message says which."""


def load_arrays(
    source: str | Place | bytes,
    wanted: Iterable[str] | None = None,
    *,
    max_values: int = MAX_VALUES,
) -> dict[str, np.ndarray]:
    """The arrays of an NPZ, those of `wanted` that it holds, or all.

    Args:
        source: path or content.
        wanted: names; None = every one.
        max_values: numbers in one array at most.

    Raises:
        OSError: the file is missing or cannot be read.
        BadArray: see there.
    """
    with _archive(source) as archive:
        infos = {info.filename.removesuffix(".npy"): info for info in archive.infolist()}
        names = [name for name in (infos if wanted is None else wanted) if name in infos]
        return {name: _member(archive, infos[name], name, max_values) for name in names}


def write_arrays(arrays: Mapping[str, object], path: PlaceT, *, compressed: bool = False) -> PlaceT:
    """Write an NPZ whole or not at all; returns its path; raises UserError as `atomic_write`."""
    save = np.savez_compressed if compressed else np.savez
    with atomic_write(path) as temporary, temporary.open("wb") as stream:
        save(stream, **arrays)  # type: ignore[arg-type]
    return path


def array_names(source: str | Place | bytes) -> tuple[str, ...]:
    """Names of the arrays in an NPZ; raises as `load_arrays`."""
    with _archive(source) as archive:
        return tuple(name.removesuffix(".npy") for name in archive.namelist())


def load_array(source: str | Place | bytes) -> np.ndarray:
    """The array of an NPY; raises as `load_arrays`."""
    with _opened(source, "NPY") as stream:
        size = stream.seek(0, io.SEEK_END)
        stream.seek(0)
        return _array(stream, size, "the array", MAX_VALUES)


@contextmanager
def _opened(source: str | Place | bytes, kind: str) -> Iterator[IO[bytes]]:
    """The bytes of a file; what fails on them but the reading itself is a `BadArray`."""
    with io.BytesIO(source) if isinstance(source, bytes) else place(source).open("rb") as stream:
        try:
            yield stream
        except (BadArray, OSError):
            raise
        except Exception as error:  # a damaged file fails in zipfile, zlib or numpy, in any way
            raise BadArray(f"is not a whole {kind} file ({error})") from error


@contextmanager
def _archive(source: str | Place | bytes) -> Iterator[zipfile.ZipFile]:
    with _opened(source, "NPZ") as stream:
        _check_directory(stream)
        with zipfile.ZipFile(stream) as archive:
            yield archive


def _check_directory(stream: IO[bytes]) -> None:
    """Refuse an archive whose directory alone would fill the memory."""
    size = stream.seek(0, io.SEEK_END)
    stream.seek(max(0, size - (1 << 16) - 22))
    tail = stream.read()
    at = tail.rfind(_END)
    if at < 0 or len(tail) < at + 22:
        raise BadArray("is not a whole NPZ file")
    members = int.from_bytes(tail[at + 10 : at + 12], "little")
    directory = int.from_bytes(tail[at + 12 : at + 16], "little")
    if members > _MAX_MEMBERS or directory > _MAX_MEMBERS * 512 or b"PK\6\7" in tail[:at][-20:]:
        raise BadArray(f"holds {members} arrays; a few are expected")
    stream.seek(0)


def _member(
    archive: zipfile.ZipFile, info: zipfile.ZipInfo, name: str, max_values: int
) -> np.ndarray:
    """One array of an archive."""
    if info.flag_bits & 1:
        raise BadArray(f"array {name!r} is encrypted; save it without a password")
    with archive.open(info) as stream:
        return _array(stream, info.file_size, f"array {name!r}", max_values)


_READERS = {
    (1, 0): np.lib.format.read_array_header_1_0,
    (2, 0): np.lib.format.read_array_header_2_0,
}


@lru_cache(256)  # arrays of one kind are described alike; reading it takes a third of the time
def _described(version: tuple[int, int], header: bytes) -> tuple[tuple[int, ...], bool, np.dtype]:
    """Shape, order and type of the numbers of an array."""
    return _READERS[version](io.BytesIO(header), max_header_size=_MAX_HEADER)


def _array(stream: IO[bytes], size: int, what: str, max_values: int) -> np.ndarray:
    """An array in NPY form of `size` bytes, header included."""
    version = np.lib.format.read_magic(stream)
    if version not in _READERS:
        raise BadArray(f"{what} has version {version} of the NPY form")
    length = stream.read(2 * version[0])
    header = stream.read(min(int.from_bytes(length, "little"), _MAX_HEADER + 1))
    shape, fortran, dtype = _described(version, length + header)
    if dtype.hasobject or dtype.kind not in "biufUS":
        raise BadArray(
            f"{what} holds Python objects ({dtype}), which are never loaded: they can run code;"
            " save plain numbers"
        )
    count = math.prod(shape)
    if count > max_values or count * dtype.itemsize > 8 * max_values:
        raise BadArray(f"{what} has shape {list(shape)}, more than {max_values} numbers; split it")
    wanted = count * dtype.itemsize
    if wanted > size or min(shape, default=0) < 0:
        raise BadArray(f"{what} says shape {list(shape)}, but only {size} bytes follow; cut off")
    data = stream.read(wanted)
    if len(data) != wanted:
        raise BadArray(f"{what} is cut off")
    if not wanted:
        return np.zeros(shape, dtype)
    stream.read(1)  # lets the archive compare its checksum
    # A bytearray, so that the array may be written to, as torch wants of what it shares.
    return np.frombuffer(bytearray(data), dtype).reshape(shape, order="F" if fortran else "C")
