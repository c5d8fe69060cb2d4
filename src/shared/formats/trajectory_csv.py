"""CSV of a trajectory for spreadsheets: a header, then one line a frame, the time first.

Columns: `time` in seconds, then the 25 of `trajectory_npz.COLUMNS`. The frame rate is read back
from the times. Numbers have nine digits, so float32 values come back exactly.
"""

import csv
from pathlib import Path

import numpy as np

from src.shared.errors import UserError
from src.shared.files import atomic_write
from src.shared.formats.trajectory_npz import COLUMNS, checked_trajectory
from src.shared.motion.trajectory import FPS, MotionTrajectory

HEADER = ("time", *COLUMNS)


def write_trajectory_csv(trajectory: MotionTrajectory, path: str | Path) -> Path:
    """Write one trajectory.

    Raises:
        UserError: the file cannot be written.
    """
    times = np.arange(trajectory.num_frames) / trajectory.fps
    table = np.concatenate((times[:, None], trajectory.data), 1)
    with atomic_write(Path(path)) as temporary, temporary.open("w", encoding="utf-8") as stream:
        np.savetxt(stream, table, fmt="%.9g", delimiter=",", header=",".join(HEADER), comments="")
    return Path(path)


def read_trajectory_csv(path: str | Path) -> MotionTrajectory:
    """Read what `write_trajectory_csv` wrote; a single frame counts as 30 frames a second.

    Raises:
        UserError: missing, another header, cells that are no numbers, or uneven times.
    """
    path = Path(path)
    try:
        with path.open(encoding="utf-8-sig", newline="") as stream:  # spreadsheets add a mark
            lines = [line for line in csv.reader(stream) if line]
    except OSError as error:
        raise UserError(
            f"{path}: cannot be read: {error.strerror or error}; name a file that may be read"
        ) from error
    except (UnicodeDecodeError, csv.Error) as error:
        raise UserError(f"{path}: is not a CSV file in UTF-8 ({error}); save it as such") from error
    if not lines or tuple(lines[0]) != HEADER:
        raise UserError(f"{path}: its first line is not the header of a trajectory, "
                        "time,position_x,position_y, ...; write it again")  # fmt: skip
    table = np.array([_numbers(path, number, line) for number, line in enumerate(lines[1:], 2)])
    table = table.reshape(-1, len(HEADER))
    return checked_trajectory(path, table[:, 1:], _frame_rate(path, table[:, 0]))


def _numbers(path: Path, number: int, line: list[str]) -> list[float]:
    try:
        values = [float(cell) for cell in line]
    except ValueError as error:
        raise UserError(f"{path} line {number}: {error}") from None
    if len(values) != len(HEADER):
        raise UserError(f"{path} line {number}: {len(values)} cells, expected {len(HEADER)}")
    return values


def _frame_rate(path: Path, times: np.ndarray) -> float:
    if len(times) < 2:
        return FPS
    steps = np.diff(times)
    step = (times[-1] - times[0]) / len(steps)
    if not (step > 0 and np.abs(steps - step).max() < 0.01 * step):
        raise UserError(
            f"{path}: its times do not grow evenly; a trajectory has one frame rate; write it again"
        )
    return round(float(1 / step), 4)
