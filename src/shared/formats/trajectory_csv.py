"""CSV of a trajectory for spreadsheets: a header, then one line a frame, the time first.

Columns: `time` in seconds, then the 25 of `trajectory_npz.COLUMNS`.
"""

from pathlib import Path

from ..motion.trajectory import MotionTrajectory
from .csv_table import read_table, write_table
from .trajectory_npz import COLUMNS, checked_trajectory

HEADER = ("time", *COLUMNS)


def write_trajectory_csv(trajectory: MotionTrajectory, path: str | Path) -> Path:
    """Write one trajectory.

    Raises:
        UserError: the file cannot be written.
    """
    return write_table(Path(path), HEADER, trajectory.data, trajectory.fps)


def read_trajectory_csv(path: str | Path) -> MotionTrajectory:
    """Read what `write_trajectory_csv` wrote; a single frame counts as 30 frames a second.

    Raises:
        UserError: as `read_table`.
    """
    path = Path(path)
    data, fps = read_table(path, HEADER, "trajectory")
    return checked_trajectory(path, data, fps)
