"""AMASS-compatible NPZ out: SMPL-H rotation vectors, +Z up, for tools that read AMASS.

| array           | shape   | type    | meaning                                                  |
|-----------------|---------|---------|----------------------------------------------------------|
| poses           | [T,156] | float64 | rotation vectors: 22 body joints, then 30 of the hands, 0 |
| trans           | [T,3]   | float64 | metres, +Z up: pelvis - `amass.SMPL_PELVIS`               |
| mocap_framerate | ()      | float64 | frames a second                                          |
| gender          | ()      | str     | neutral                                                  |
| betas           | [16]    | float64 | 0: the mean shape                                        |
| dmpls           | [T,8]   | float64 | 0: no soft tissue                                        |
| skeleton        | ()      | str     | motion-suite: reading it again needs no fitting          |

Rotations go over as they stand, for our joints are SMPL's and its rest pose is a T-pose too; its
bones lie a few degrees off ours, so hands and feet end up a few centimetres elsewhere.
Legend: T frames.
"""

from pathlib import Path

import numpy as np

from ..files import atomic_write
from ..motion.motion import Motion
from .amass import OURS, SMPL_PELVIS
from .rig import quaternions_to_matrices

Z_UP = np.array([[1.0, 0.0, 0.0], [0.0, 0.0, -1.0], [0.0, 1.0, 0.0]])  # of our world
BODY, ALL = 22, 52  # joints


def write_amass(motion: Motion, path: str | Path) -> Path:
    """Write one motion with the arrays of the module's table.

    Raises:
        UserError: the file cannot be written.
    """
    matrices = quaternions_to_matrices(motion.quaternions)
    matrices[:, 0] = Z_UP @ matrices[:, 0]
    poses = np.zeros((motion.num_frames, ALL * 3))
    poses[:, : BODY * 3] = _vectors(matrices).reshape(motion.num_frames, -1)
    with atomic_write(Path(path)) as temporary, temporary.open("wb") as stream:
        np.savez_compressed(
            stream,
            poses=poses,
            trans=motion.root_position.astype(np.float64) @ Z_UP.T - SMPL_PELVIS,
            mocap_framerate=np.float64(motion.fps),
            gender=np.array("neutral"),
            betas=np.zeros(16),
            dmpls=np.zeros((motion.num_frames, 8)),
            skeleton=np.array(OURS),
        )
    return Path(path)


def _vectors(matrices: np.ndarray) -> np.ndarray:
    """Rotation vectors [...,3] in radians of matrices [...,3,3]."""
    import torch

    from ..motion.rotations import matrix_to_quaternion, quaternion_log

    return np.asarray(quaternion_log(matrix_to_quaternion(torch.as_tensor(matrices))).numpy())
