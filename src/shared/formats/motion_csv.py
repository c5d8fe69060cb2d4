"""CSV of a motion for spreadsheets and statistics: a header, then one line a frame.

Columns: `time` in seconds; for each of the 22 joints its world position in metres (+Y up) and
world rotation as a quaternion, `pelvis_x, pelvis_y, pelvis_z, pelvis_qw, pelvis_qx, pelvis_qy,
pelvis_qz`, …; `left_contact` and `right_contact`, 0 to 1. Numbers have nine digits, so float32
values come back exactly; the frame rate is read back from the times.
"""

import csv
from pathlib import Path

import numpy as np
import torch

from src.shared.errors import UserError
from src.shared.files import atomic_write
from src.shared.formats.glb import continuous
from src.shared.formats.limits import FRAME_RATES, MAX_FRAMES, MAX_VALUE, check_size
from src.shared.formats.rig import matrices_to_quaternions
from src.shared.motion.kinematics import global_to_local
from src.shared.motion.motion import Motion
from src.shared.motion.rotations import (
    matrix_to_quaternion,
    quaternion_continuous,
    quaternion_to_matrix,
)
from src.shared.motion.skeleton import JOINT_NAMES, NUM_JOINTS, PARENTS

_PARTS = ("x", "y", "z", "qw", "qx", "qy", "qz")
HEADER = (
    "time",
    *(f"{joint}_{part}" for joint in JOINT_NAMES for part in _PARTS),
    "left_contact",
    "right_contact",
)
DEFAULT_FPS = 30.0  # of a single frame


def write_motion_csv(motion: Motion, path: str | Path) -> Path:
    """Write one motion.

    Raises:
        UserError: the file cannot be written.
    """
    times = np.arange(motion.num_frames) / motion.fps
    turns = continuous(matrices_to_quaternions(motion.global_rotations()))
    joints = np.concatenate((motion.positions(), turns), -1).reshape(motion.num_frames, -1)
    table = np.concatenate((times[:, None], joints, motion.contacts), 1)
    with atomic_write(Path(path)) as temporary, temporary.open("w", encoding="utf-8") as stream:
        np.savetxt(stream, table, fmt="%.9g", delimiter=",", header=",".join(HEADER), comments="")
    return Path(path)


def read_motion_csv(path: str | Path) -> Motion:
    """Read what `write_motion_csv` wrote; positions other than the pelvis' are left aside.

    Raises:
        UserError: missing, too large, another header, cells that are no numbers, uneven times.
    """
    path = Path(path)
    check_size(path)
    rows = []
    try:
        with path.open(encoding="utf-8-sig", newline="") as stream:  # spreadsheets add a mark
            lines = csv.reader(stream)
            if tuple(next(lines, ())) != HEADER:
                raise UserError(f"{path}: its first line is not the header of a motion, "
                                "time,pelvis_x,pelvis_y, ...; write it again by "
                                "`convert`")  # fmt: skip
            for number, line in enumerate(lines, 2):
                if line:
                    rows.append(_numbers(path, number, line))
                if len(rows) > MAX_FRAMES:
                    raise UserError(f"{path}: more than {MAX_FRAMES} frames; split the file")
    except OSError as error:
        raise UserError(
            f"{path}: cannot be read: {error.strerror or error}; name a file that may be read"
        ) from error
    except (UnicodeDecodeError, csv.Error) as error:
        raise UserError(f"{path}: is not a CSV file in UTF-8 ({error}); save it as such") from error
    if not rows:
        raise UserError(f"{path}: has no frames; write it again")
    table = np.array(rows)
    joints = table[:, 1:-2].reshape(-1, NUM_JOINTS, len(_PARTS))
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
        _frame_rate(path, table[:, 0]),
    )


def _numbers(path: Path, number: int, line: list[str]) -> np.ndarray:
    """The cells of a line."""
    try:
        values = np.array([float(cell) for cell in line])
    except ValueError as error:
        raise UserError(f"{path} line {number}: {error}") from None
    if len(values) != len(HEADER):
        raise UserError(f"{path} line {number}: {len(values)} cells, expected {len(HEADER)}")
    if not np.abs(values).max() < MAX_VALUE:
        raise UserError(
            f"{path} line {number}: holds NaN or impossibly large values; write it again"
        )
    return values


def _frame_rate(path: Path, times: np.ndarray) -> float:
    if len(times) < 2:
        return DEFAULT_FPS
    steps = np.diff(times)
    step = (times[-1] - times[0]) / len(steps)
    if not (step > 0 and np.abs(steps - step).max() < 0.01 * step):
        raise UserError(
            f"{path}: its times do not grow evenly; a motion has one frame rate; write it again"
        )
    fps = round(float(1 / step), 4)
    if not FRAME_RATES[0] <= fps <= FRAME_RATES[1]:
        raise UserError(f"{path}: {fps:g} frames a second are not possible; correct the times")
    return fps
