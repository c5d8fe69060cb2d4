"""Trajectory files in, by the ending of their name."""

from pathlib import Path

from ..errors import UsageError
from ..motion.trajectory import MotionTrajectory, from_motion

ENDINGS = ("npz", "npy", "csv")


def read_trajectory(path: str | Path) -> MotionTrajectory:
    """Read a trajectory; of a body's NPZ (`formats.npz`) its pelvis.

    Raises:
        UsageError: no format has this ending.
        UserError: missing, damaged, or not a trajectory.
    """
    path = Path(path)
    ending = path.suffix.removeprefix(".").lower()
    if ending not in ENDINGS:
        raise UsageError(f"{path}: {ending!r} is not a trajectory's ending; "
                         f"known are {', '.join(ENDINGS)}")  # fmt: skip
    if ending == "csv":
        from .trajectory_csv import read_trajectory_csv

        return read_trajectory_csv(path)
    from .trajectory_npz import (
        load_arrays,
        read_trajectory_npy,
        read_trajectory_npz,
    )

    if ending == "npy":
        return read_trajectory_npy(path)
    if "root_position" in load_arrays(path):
        from .npz import read_npz

        return from_motion(read_npz(path))
    return read_trajectory_npz(path)
