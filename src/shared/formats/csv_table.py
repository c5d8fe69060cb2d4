"""CSV tables with a header and the time first: what motions and trajectories have in common.

Numbers have nine digits, so float32 values come back exactly; the frame rate is read back from the
times.

Letters: T frames, N columns, the time included.
"""

import csv
from collections.abc import Sequence
from pathlib import Path

import numpy as np

from ..errors import UserError
from ..files import atomic_write
from .limits import FRAME_RATES, MAX_FRAMES, MAX_VALUE, check_size

DEFAULT_FPS = 30.0  # of a single frame


def write_table(path: Path, header: Sequence[str], columns: np.ndarray, fps: float) -> Path:
    """Write columns [T,N-1] behind the time of each frame.

    Raises:
        UserError: the file cannot be written.
    """
    table = np.concatenate((np.arange(len(columns))[:, None] / fps, columns), 1)
    with atomic_write(path) as temporary, temporary.open("w", encoding="utf-8") as stream:
        np.savetxt(stream, table, fmt="%.9g", delimiter=",", header=",".join(header), comments="")
    return path


def read_table(path: Path, header: Sequence[str], what: str) -> tuple[np.ndarray, float]:
    """The columns [T,N-1] behind the time, and the frame rate.

    Args:
        path: the file.
        header: N names that its first line must hold.
        what: of which it is a table, for errors.

    Raises:
        UserError: missing, too large, another header, cells that are no numbers, uneven times.
    """
    check_size(path)
    rows = []
    try:
        with path.open(encoding="utf-8-sig", newline="") as stream:  # spreadsheets add a mark
            lines = csv.reader(stream)
            if tuple(next(lines, ())) != tuple(header):
                raise UserError(
                    f"{path}: its first line is not the header of a {what},"
                    f" {','.join(header[:3])}, ...; write it again"
                )
            for number, line in enumerate(lines, 2):
                if line:
                    rows.append(_numbers(f"{path} line {number}", line, len(header)))
                if len(rows) > MAX_FRAMES:
                    raise UserError(f"{path}: more than {MAX_FRAMES} frames; split the file")
    except OSError as error:
        raise UserError(
            f"{path}: cannot be read: {error.strerror or error}; name a file that may be read"
        ) from error
    except (UnicodeDecodeError, csv.Error) as error:
        raise UserError(f"{path}: is not a CSV file in UTF-8 ({error}); save it as such") from error
    table = np.array(rows).reshape(-1, len(header))
    return table[:, 1:], _frame_rate(path, table[:, 0], what)


def _numbers(place: str, line: list[str], wanted: int) -> np.ndarray:
    """The cells of a line."""
    try:
        values = np.array([float(cell) for cell in line])
    except ValueError as error:
        raise UserError(f"{place}: {error}; write a number") from None
    if len(values) != wanted:
        raise UserError(f"{place}: {len(values)} cells, expected {wanted}; write it again")
    if not np.abs(values).max() < MAX_VALUE:
        raise UserError(f"{place}: holds NaN or impossibly large values; write it again")
    return values


def _frame_rate(path: Path, times: np.ndarray, what: str) -> float:
    if len(times) < 2:
        return DEFAULT_FPS
    steps = np.diff(times)
    step = (times[-1] - times[0]) / len(steps)
    if not (step > 0 and np.abs(steps - step).max() < 0.01 * step):
        raise UserError(
            f"{path}: its times do not grow evenly; a {what} has one frame rate; write it again"
        )
    fps = round(float(1 / step), 4)
    if not FRAME_RATES[0] <= fps <= FRAME_RATES[1]:
        raise UserError(f"{path}: {fps:g} frames a second are not possible; correct the times")
    return fps
