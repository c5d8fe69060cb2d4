"""Limits on what is read from files: bytes, frames, joints, time; arrays without pickles.

A file is somebody else's: every reader asks here first, so that none can fill the memory, run
for minutes or run code. The figures leave room for half an hour of mocap at 120 frames a second.
"""

import time
from collections.abc import Iterable, Iterator
from contextlib import contextmanager
from pathlib import Path

import numpy as np

from ..errors import MissingFile, UserError
from ..io.arrays import BadArray, load_array, load_arrays
from ..io.arrays import array_names as names_of

MAX_BYTES = 256 << 20  # of one file
MAX_LINE = 1 << 20  # bytes; hundreds of joints with long numbers
MAX_JOINTS = 2000
MAX_FRAMES = 1_000_000  # more than two hours at 120 frames a second
MAX_VALUE = 1e7  # no angle or position, in any unit, is larger: the file is damaged
MAX_SECONDS = 120.0  # of reading one file
FRAME_RATES = (1.0, 2000.0)  # frames a second that a recording can have


def remedied(message: str) -> str:
    """The message, with what to do about it where it does not say so itself."""
    return message if ";" in message else f"{message}; correct it or export the file again"


class Deadline:
    """Time that reading one file may take."""

    def __init__(self, path: Path) -> None:
        self._path, self._end = path, time.monotonic() + MAX_SECONDS

    def check(self) -> None:
        """Raises UserError when the time is over."""
        if time.monotonic() > self._end:
            raise UserError(f"{self._path}: reading takes more than {MAX_SECONDS:g} s; "
                            "split the file")  # fmt: skip


def check_size(path: Path, max_bytes: int = MAX_BYTES) -> int:
    """Bytes of a file.

    Raises:
        MissingFile: it does not exist.
        UserError: not a plain file, unreadable, empty or too large.
    """
    try:
        size = path.stat().st_size
    except FileNotFoundError:
        raise MissingFile(f"{path} does not exist; check the name") from None
    except (OSError, ValueError) as error:  # ValueError: a zero byte in the name
        reason = getattr(error, "strerror", None) or error
        raise UserError(
            f"{path}: cannot be read: {reason}; name a file that may be read"
        ) from error
    if not path.is_file():  # a device or pipe would never end
        raise UserError(f"{path}: is not a file; name a motion file")
    if size > max_bytes:
        raise UserError(f"{path}: {size / 2**20:.0f} MB is over the limit of "
                        f"{max_bytes / 2**20:.0f} MB; split the file")  # fmt: skip
    if not size:
        raise UserError(f"{path}: is empty; export it again")
    return size


def read_bytes(path: Path, max_bytes: int = MAX_BYTES) -> bytes:
    """All bytes of a file; raises UserError as `check_size`."""
    check_size(path, max_bytes)
    with readable(path), path.open("rb") as stream:
        return stream.read(max_bytes)


@contextmanager
def readable(path: Path, what: str = "file") -> Iterator[None]:
    """Inside, the system's refusal to read a file is a UserError that names it."""
    try:
        yield
    except FileNotFoundError:
        raise MissingFile(f"{path} does not exist; check the name") from None
    except OSError as error:
        raise UserError(
            f"{path}: cannot be read: {error.strerror or error}; name a {what} that may be read"
        ) from error


def check_plausible(
    where: str, values: np.ndarray, most: float, remedy: str = "write it again"
) -> np.ndarray:
    """The values as float64; raises UserError, beginning with `where`, if one is NaN or beyond."""
    values = values.astype(np.float64)
    if values.size and not np.abs(values).max() < most:
        raise UserError(f"{where} holds NaN or impossibly large values; correct them, or {remedy}")
    return values


def check_numbers(
    where: str,
    values: np.ndarray,
    shape: tuple[int | str, ...],
    most: float,
    remedy: str = "write it again",
) -> np.ndarray:
    """`check_plausible` of an array of this shape, in which a word, such as "T", is any length.

    Raises:
        UserError: another shape, no numbers, NaN or impossibly large ones.
    """
    sizes = zip(values.shape, shape, strict=False)
    fits = values.ndim == len(shape) and all(w in (n, str(w)) for n, w in sizes)
    if not fits or values.dtype.kind not in "fiu":
        wanted = f"[{', '.join(map(str, shape))}]"
        raise UserError(f"{where} is {values.dtype}{list(values.shape)}, expected numbers of shape"
                        f" {wanted}; {remedy}")  # fmt: skip
    return check_plausible(where, values, most, remedy)


def read_arrays(path: Path, wanted: Iterable[str] | None = None) -> dict[str, np.ndarray]:
    """Those of the `wanted` arrays that an NPZ file holds, or all; no other member is touched.

    Raises:
        UserError: not an NPZ file, damaged, too large, or with pickles.
    """
    with _told(path):
        return load_arrays(path, wanted)


def array_names(path: Path) -> tuple[str, ...]:
    """Names of the arrays in an NPZ file; raises UserError where it is none."""
    with _told(path):
        return names_of(path)


def read_array(path: Path) -> np.ndarray:
    """The array of an NPY file; raises UserError as `read_arrays`."""
    with _told(path):
        return load_array(path)


@contextmanager
def _told(path: Path) -> Iterator[None]:
    """Refuse what is too large; name the file in what goes wrong with its arrays."""
    check_size(path)
    with readable(path):
        try:
            yield
        except BadArray as error:
            raise UserError(f"{path}: {error}; write it again") from error
