"""CSV of motions and trajectories for spreadsheets: a header, then one line a frame, time first.

Of a motion, for each of the 22 joints its world position in metres (+Y up) and world rotation as a
quaternion, `pelvis_x, pelvis_y, pelvis_z, pelvis_qw, pelvis_qx, pelvis_qy, pelvis_qz`, …;
`left_contact` and `right_contact`, 0 to 1. Of a trajectory, the 25 `arrays.COLUMNS`. Numbers have
nine digits, so float32 values come back exactly; the frame rate is read back from the times.
Letters: T frames, N columns, the time included."""

import csv
from collections.abc import Sequence
from pathlib import Path

import numpy as np

from ..errors import UserError
from ..io.files import atomic_write
from ..motion.motion import Motion
from ..motion.rotations import (
    global_to_local,
    matrix_to_quaternion,
    quaternion_continuous,
    quaternion_to_matrix,
)
from ..motion.skeleton import JOINT_NAMES, NUM_JOINTS, PARENTS
from ..motion.trajectory import MotionTrajectory
from ..tensors import torch
from .arrays import COLUMNS, checked_trajectory
from .limits import FRAME_RATES, MAX_FRAMES, MAX_VALUE, check_plausible, check_size, readable
from .rig import continuous, matrices_to_quaternions

ENCODING = "utf-8-sig"  # spreadsheets add a mark
DEFAULT_FPS = 30.0  # of a single frame


def write_table(path: Path, header: Sequence[str], columns: np.ndarray, fps: float) -> Path:
    """Write columns [T,N-1] behind the time of each frame; raises UserError as `atomic_write`."""
    table = np.concatenate((np.arange(len(columns))[:, None] / fps, columns), 1)
    with atomic_write(path) as temporary, temporary.open("w", encoding="utf-8") as stream:
        np.savetxt(stream, table, fmt="%.9g", delimiter=",", header=",".join(header), comments="")
    return path


def read_table(path: Path, header: Sequence[str], what: str) -> tuple[np.ndarray, float]:
    """The columns [T,N-1] behind the time, and the frame rate.

    Args:
        header: N names that its first line must hold.
        what: of which it is a table, for errors.

    Raises:
        UserError: missing, too large, another header, cells that are no numbers, uneven times.
    """
    check_size(path)
    rows = []
    try:
        with readable(path), path.open(encoding=ENCODING, newline="") as stream:
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
    return check_plausible(f"{place}:", values, MAX_VALUE)


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


_PARTS = ("x", "y", "z", "qw", "qx", "qy", "qz")
MOTION_HEADER = (
    "time",
    *(f"{joint}_{part}" for joint in JOINT_NAMES for part in _PARTS),
    "left_contact",
    "right_contact",
)


def write_motion_csv(motion: Motion, path: str | Path) -> Path:
    """Write one motion; raises UserError where the file cannot be written."""
    positions, rotations = motion.kinematics()
    turns = continuous(matrices_to_quaternions(rotations))
    joints = np.concatenate((positions, turns), -1).reshape(motion.num_frames, -1)
    columns = np.concatenate((joints, motion.contacts), 1)
    return write_table(Path(path), MOTION_HEADER, columns, motion.fps)


def read_motion_csv(path: str | Path) -> Motion:
    """Read what `write_motion_csv` wrote; positions other than the pelvis' are left aside.

    Raises:
        UserError: as `read_table`; no frames, or a rotation that is none.
    """
    path = Path(path)
    table, fps = read_table(path, MOTION_HEADER, "motion")
    if not len(table):
        raise UserError(f"{path}: has no frames; write it again")
    joints = table[:, :-2].reshape(-1, NUM_JOINTS, len(_PARTS))
    world = torch.as_tensor(joints[..., 3:])
    if world.norm(dim=-1).min() < 1e-3:
        raise UserError(
            f"{path}: holds a quaternion of zeros, which is no rotation; write it again"
        )
    local = matrix_to_quaternion(global_to_local(quaternion_to_matrix(world), PARENTS))
    return Motion(
        quaternion_continuous(local).numpy().astype(np.float32),
        joints[:, 0, :3].astype(np.float32),
        table[:, -2:].astype(np.float32),
        fps,
    )


TRAJECTORY_HEADER = ("time", *COLUMNS)


def write_trajectory_csv(trajectory: MotionTrajectory, path: str | Path) -> Path:
    """Write one trajectory; raises UserError where the file cannot be written."""
    return write_table(Path(path), TRAJECTORY_HEADER, trajectory.data, trajectory.fps)


def read_trajectory_csv(path: str | Path) -> MotionTrajectory:
    """Read what `write_trajectory_csv` wrote; a single frame counts as 30 frames a second. Raises
    UserError as `read_table`."""
    path = Path(path)
    data, fps = read_table(path, TRAJECTORY_HEADER, "trajectory")
    return checked_trajectory(path, data, fps)
