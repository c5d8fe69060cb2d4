"""CSV of a motion for spreadsheets and statistics: a header, then one line a frame.

Columns: `time` in seconds; for each of the 22 joints its world position in metres (+Y up) and
world rotation as a quaternion, `pelvis_x, pelvis_y, pelvis_z, pelvis_qw, pelvis_qx, pelvis_qy,
pelvis_qz`, …; `left_contact` and `right_contact`, 0 to 1.
"""

from pathlib import Path

import numpy as np
import torch

from ..errors import UserError
from ..motion.kinematics import global_to_local
from ..motion.motion import Motion
from ..motion.rotations import (
    matrix_to_quaternion,
    quaternion_continuous,
    quaternion_to_matrix,
)
from ..motion.skeleton import JOINT_NAMES, NUM_JOINTS, PARENTS
from .csv_table import read_table, write_table
from .glb import continuous
from .rig import matrices_to_quaternions

_PARTS = ("x", "y", "z", "qw", "qx", "qy", "qz")
HEADER = (
    "time",
    *(f"{joint}_{part}" for joint in JOINT_NAMES for part in _PARTS),
    "left_contact",
    "right_contact",
)


def write_motion_csv(motion: Motion, path: str | Path) -> Path:
    """Write one motion.

    Raises:
        UserError: the file cannot be written.
    """
    turns = continuous(matrices_to_quaternions(motion.global_rotations()))
    joints = np.concatenate((motion.positions(), turns), -1).reshape(motion.num_frames, -1)
    columns = np.concatenate((joints, motion.contacts), 1)
    return write_table(Path(path), HEADER, columns, motion.fps)


def read_motion_csv(path: str | Path) -> Motion:
    """Read what `write_motion_csv` wrote; positions other than the pelvis' are left aside.

    Raises:
        UserError: as `read_table`; no frames, or a rotation that is none.
    """
    path = Path(path)
    table, fps = read_table(path, HEADER, "motion")
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
