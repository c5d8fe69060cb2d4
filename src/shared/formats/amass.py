"""AMASS files in and out: SMPL, SMPL-H and SMPL-X parameters as NPZ, +Z up.

| array                                   | shape              | meaning                         |
|-----------------------------------------|--------------------|---------------------------------|
| poses                                   | [T,72] [T,156] [T,165] | rotation vectors, body first |
| or root_orient, pose_body               | [T,3], [T,63]      | the same, named                 |
| trans                                   | [T,3]              | metres: pelvis - `SMPL_PELVIS`  |
| mocap_framerate or mocap_frame_rate     | ()                 | frames a second                 |
| skeleton                                | ()                 | "motion-suite": the body is ours |
| written only: gender, betas, dmpls      | (), [16], [T,8]    | neutral, 0, 0: the mean shape   |

The 22 body joints are in our order already. No body model is read: the shape (`betas`), the hands,
jaw and eyes are dropped, and the rotations go onto our own bones, whose rest directions differ
from the model's by a few degrees; written, they go over as they stand, so hands and feet end up a
few centimetres elsewhere. Legend: T frames."""

from dataclasses import replace
from pathlib import Path

import numpy as np
from scipy.spatial.transform import Rotation

from ..errors import UserError
from ..io.arrays import write_arrays
from ..motion.motion import Motion
from ..motion.rotations import matrix_to_quaternion, quaternion_log
from ..motion.skeleton import NUM_JOINTS, canonical_skeleton
from ..tensors import torch
from .limits import FRAME_RATES, check_numbers, read_arrays
from .rig import RigClip, canonical_rig, quaternions_to_matrices, rooted_clip

MAX_VALUE = 1e4  # metres or radians
NAMES = ("poses", "root_orient", "pose_body", "trans", "mocap_framerate", "mocap_frame_rate",
         "skeleton")  # fmt: skip
OURS = "motion-suite"  # `skeleton` of files that `write_amass` wrote
# `trans` moves the model's origin; its pelvis lies here, whichever way the body is turned
# (metres, mean neutral shape).
SMPL_PELVIS = np.array([-0.002, -0.223, 0.028])
WIDTHS = {66: "body", 72: "SMPL", 156: "SMPL-H", 165: "SMPL-X"}


def is_amass(names: tuple[str, ...]) -> bool:
    """Whether arrays with these names are AMASS's."""
    return "trans" in names and ("poses" in names or {"root_orient", "pose_body"} <= set(names))


def read_amass(path: str | Path, *, fps: float | None = None) -> tuple[RigClip, bool]:
    """Read the 22 body joints of an AMASS file, in the file's +Z-up world; is the body our own?

    Args:
        fps: frames a second, for a file that does not say.

    Raises:
        UserError: missing, damaged, not AMASS, or with arrays of another shape or NaN.
    """
    path = Path(path)
    arrays = read_arrays(path, NAMES)
    if not is_amass(tuple(arrays)):
        raise UserError(f"{path}: needs 'trans' and 'poses', or 'root_orient' and 'pose_body'; "
                        f"it holds {', '.join(arrays) or 'none'}, export it again")  # fmt: skip
    trans = _numbers(path, arrays, "trans", 3)
    if "poses" in arrays:
        poses = _numbers(path, arrays, "poses", f"{3 * NUM_JOINTS} or more")
        if poses.shape[1] < 3 * NUM_JOINTS:
            raise UserError(f"{path}: poses has {poses.shape[1]} values a frame; "
                            f"{3 * NUM_JOINTS} or more are needed; export it again")  # fmt: skip
        poses = poses[:, : 3 * NUM_JOINTS]
    else:
        root = _numbers(path, arrays, "root_orient", 3)
        body = _numbers(path, arrays, "pose_body", 63)
        if len(root) != len(body):
            raise UserError(f"{path}: root_orient has {len(root)} frames, pose_body {len(body)}; "
                            "the file is damaged, export it again")  # fmt: skip
        poses = np.concatenate([root, body], 1)
    if len(poses) != len(trans) or not len(trans):
        raise UserError(f"{path}: {len(poses)} poses and {len(trans)} places; "
                        "the file is damaged; export it again")  # fmt: skip
    rotations = Rotation.from_rotvec(poses.reshape(-1, 3)).as_matrix()
    rig = replace(canonical_rig(), offsets=canonical_skeleton().offsets.astype(np.float64))
    clip = rooted_clip(
        rig, rotations.reshape(-1, NUM_JOINTS, 3, 3), trans + SMPL_PELVIS, _rate(path, arrays, fps)
    )
    return clip, "skeleton" in arrays and str(arrays["skeleton"]) == OURS


def _rate(path: Path, arrays: dict[str, np.ndarray], fps: float | None) -> float:
    given = [arrays[name] for name in ("mocap_framerate", "mocap_frame_rate") if name in arrays]
    if fps is not None:
        return fps
    if not given:
        raise UserError(f"{path}: has no mocap_framerate or mocap_frame_rate; "
                        "state it by --source-fps")  # fmt: skip
    if given[0].size != 1 or given[0].dtype.kind not in "fiu":
        raise UserError(f"{path}: the frame rate is {given[0].dtype}{list(given[0].shape)}, "
                        "not a number; state it by --source-fps")  # fmt: skip
    rate = float(given[0].reshape(()))
    if not FRAME_RATES[0] <= rate <= FRAME_RATES[1]:
        raise UserError(
            f"{path}: {rate:g} frames a second are not possible; state it by --source-fps"
        )
    return rate


def _numbers(path: Path, arrays: dict[str, np.ndarray], name: str, width: int | str) -> np.ndarray:
    """An array [T,width] of plausible numbers as float64."""
    where = f"{path}: {name}"
    return check_numbers(where, arrays[name], ("T", width), MAX_VALUE, "export it again")


Z_UP = np.array([[1.0, 0.0, 0.0], [0.0, 0.0, -1.0], [0.0, 1.0, 0.0]])  # of our world
BODY, ALL = 22, 52  # joints


def write_amass(motion: Motion, path: str | Path) -> Path:
    """Write one motion with the module's arrays; raises UserError where it cannot be written."""
    matrices = quaternions_to_matrices(motion.quaternions)
    matrices[:, 0] = Z_UP @ matrices[:, 0]
    poses = np.zeros((motion.num_frames, ALL * 3))
    vectors = quaternion_log(matrix_to_quaternion(torch.as_tensor(matrices)))
    poses[:, : BODY * 3] = vectors.numpy().reshape(motion.num_frames, -1)
    arrays = {
        "poses": poses,
        "trans": motion.root_position.astype(np.float64) @ Z_UP.T - SMPL_PELVIS,
        "mocap_framerate": np.float64(motion.fps),
        "gender": np.array("neutral"),
        "betas": np.zeros(16),
        "dmpls": np.zeros((motion.num_frames, 8)),
        "skeleton": np.array(OURS),
    }
    return write_arrays(arrays, Path(path), compressed=True)
