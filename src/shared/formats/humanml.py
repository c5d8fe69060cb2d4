"""HumanML3D in: joint positions [T,22,3] or feature vectors [T,263] as NPY.

The joints are in our order, +Y up, metres, 20 frames a second. Of the feature vectors (Guo et al.
2022, "Generating Diverse and Natural 3D Human Motions from Text", section 5.1) the parts that give
positions are read; rotations are found for them by `positions_ik`. Legend: T frames.

| channels of 263 | meaning                                                             |
|-----------------|---------------------------------------------------------------------|
| 0               | half the turn of the root about +Y to the next frame, radians       |
| 1:3             | step of the root to the next frame along its own x and z, metres    |
| 3               | height of the root, metres                                          |
| 4:67            | the other 21 joints: x and z from the root in its own axes, y as is |
| 67:263          | rotations, velocities, contacts: not read                           |
"""

from pathlib import Path

import numpy as np

from ..errors import UserError
from ..motion.skeleton import NUM_JOINTS, PARENTS
from .joint_clip import JointClip
from .limits import read_array
from .positions_ik import clip_of_positions

FPS = 20.0
FEATURES = 263
MAX_VALUE = 1e4  # metres
SPREAD = 0.25  # of a bone's length over time, relative: more, and they are no positions


def read_humanml(path: str | Path, *, fps: float | None = None) -> JointClip:
    """Read joint positions or feature vectors and fit rotations to them.

    Raises:
        UserError: missing, damaged, of another shape, with NaN, or normalised vectors.
    """
    path = Path(path)
    array = read_array(path)
    shapes = ((NUM_JOINTS, 3), (FEATURES,))
    if array.dtype.kind not in "fiu" or array.shape[1:] not in shapes or not len(array):
        raise UserError(f"{path}: is {array.dtype}{list(array.shape)}, expected joint positions "
                        f"[T,{NUM_JOINTS},3] or HumanML3D vectors [T,{FEATURES}]; "
                        "save one of the two")  # fmt: skip
    array = array.astype(np.float64)
    if not np.abs(array).max() < MAX_VALUE:
        raise UserError(f"{path}: holds NaN or impossibly large values; write it again")
    positions = array if array.ndim == 3 else positions_of_features(array)
    bones = np.linalg.norm(positions[:, 1:] - positions[:, list(PARENTS[1:])], axis=-1)
    if (bones.std(0) > SPREAD * bones.mean(0).max()).any() or not bones.mean(0).max() > 0.01:
        raise UserError(f"{path}: the bones change their length, so these are no positions in "
                        "metres; undo a normalisation (times Std, plus Mean) first")  # fmt: skip
    return clip_of_positions(positions, fps or FPS)


def positions_of_features(features: np.ndarray) -> np.ndarray:
    """World positions [T,22,3] of feature vectors [T,263], from the origin, facing +Z."""
    turn = np.zeros(len(features))
    turn[1:] = -2.0 * np.cumsum(features[:-1, 0])
    cos, sin = np.cos(turn), np.sin(turn)
    step = np.zeros((len(features), 2))
    step[1:] = features[:-1, 1:3]
    root = np.stack([cos * step[:, 0] + sin * step[:, 1], -sin * step[:, 0] + cos * step[:, 1]], -1)
    root = np.cumsum(root, 0)
    others = features[:, 4:67].reshape(-1, NUM_JOINTS - 1, 3)
    x, y, z = others[..., 0], others[..., 1], others[..., 2]
    cos, sin = cos[:, None], sin[:, None]
    others = np.stack([cos * x + sin * z + root[:, :1], y, -sin * x + cos * z + root[:, 1:]], -1)
    first = np.stack([root[:, 0], features[:, 3], root[:, 1]], -1)
    return np.concatenate([first[:, None], others], 1)
