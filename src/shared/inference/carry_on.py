"""A window goes on where its known frames end: what the network misses there is taken up smoothly.

The network is shown the first frames of a window and makes the rest, but only nearly continues
them: 1 cm of misplacement is a teleport, an acceleration of 9 m/s². So the rest of the path is
moved to where the known frames lead, its speed taken over within a third of a second, its height
and rotation within a second. At the join it accelerates and turns by the mean of both sides: a step
that merely repeated the last one would be the only frame without acceleration.

Letters: W frames of a window, K known ones.
"""

import numpy as np
import torch

from ..motion.rotations import (
    quaternion_conjugate,
    quaternion_multiply,
    quaternion_slerp,
)
from ..motion.trajectory import POSITION, QUATERNION
from ..motion.trajectory_math import continuous_sign

SPEED_FRAMES = 10  # until the path has the speed that the network made
POSE_FRAMES = 30  # until height and rotation are the network's
GROUND = [0, 2]


def carry_on(rows: np.ndarray, known: int) -> None:
    """Mend a window in place.

    Args:
        rows: [25,W], position and quaternion as made; only these two are changed.
        known: K ≥ 3 frames that are right; W ≥ K + 3, else nothing is done.
    """
    if known < 3 or rows.shape[1] < known + 3:
        return
    rest = rows.shape[1] - known
    position = rows[POSITION].astype(np.float64)  # 3 W
    made = position[:, known:].copy()
    after = np.diff(made, axis=1)  # 3 W-K-1, the first step of the rest is not among them
    before = np.diff(position[:, known - 3 : known], axis=1)  # 3 2
    steps = np.insert(after, 0, 2 * after[:, 0] - after[:, 1], axis=1)  # 3 W-K
    acceleration = (before[:, 1] - before[:, 0] + after[:, 1] - after[:, 0]) / 2
    first = before[:, 1] + acceleration
    steps += (first - steps[:, 0])[:, None] * _fade(rest, SPEED_FRAMES)
    path = position[:, known - 1 : known] + np.cumsum(steps, axis=1)
    path[1] = made[1] + (path[1] - made[1]) * _fade(rest, POSE_FRAMES)
    rows[POSITION][:, known:] = path

    rotation = torch.as_tensor(rows[QUATERNION].T, dtype=torch.float64)  # W 4
    rotation = continuous_sign(torch.nn.functional.normalize(rotation, dim=-1))
    both = quaternion_multiply(rotation[1:], quaternion_conjugate(rotation[:-1]))  # W-1 4, turns
    turn = quaternion_slerp(both[known - 2], both[known], torch.tensor([0.5]).to(both))
    due = quaternion_multiply(turn, rotation[known - 1])
    miss = quaternion_multiply(due, quaternion_conjugate(rotation[known]))
    share = torch.as_tensor(_fade(rest, POSE_FRAMES))[:, None]
    nothing = torch.tensor([1.0, 0.0, 0.0, 0.0], dtype=torch.float64).expand(rest, 4)
    turns = quaternion_slerp(nothing, miss.expand(rest, 4), share)
    rotation[known:] = quaternion_multiply(turns, rotation[known:])
    rows[QUATERNION] = continuous_sign(rotation).T.numpy()


def _fade(frames: int, length: int) -> np.ndarray:
    """Weights [frames] from nearly 1 to 0 over `length` frames, two vanishing derivatives."""
    x = np.clip((np.arange(frames) + 1) / (length + 1), 0, 1)
    return 1 - x**3 * (x * (6 * x - 15) + 10)
