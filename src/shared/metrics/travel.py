"""Where a motion goes: speed, direction and turning, compared with a real clip of the same caption.

Needs no learned model. Letters: T frames, N motions.
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import torch

from ..motion.features import headings
from ..motion.motion import Motion
from ..motion.rotations import quaternion_to_matrix

MIN_TRAVEL = 0.5  # metres: below this a direction is noise


@dataclass(frozen=True)
class Travel:
    """Net travel of one motion, seen from its first frame."""

    speed: float  # m/s, path length of the pelvis over the ground
    direction: float  # radians from where it faces at first, + = to its left; NaN below 0.5 m
    turn: float  # radians of heading gained, + = to the left


def travel(motion: Motion) -> Travel:
    """Speed, direction and turning of one motion of at least two frames."""
    heading = headings(quaternion_to_matrix(torch.as_tensor(motion.quaternions[:, 0]))).numpy()
    path = motion.root_position[:, [0, 2]].astype(np.float64)  # x, z
    seconds = (motion.num_frames - 1) / motion.fps
    across, along = path[-1] - path[0]
    direction = float("nan")
    if np.hypot(across, along) >= MIN_TRAVEL:
        direction = _wrap(float(np.arctan2(across, along)) - float(heading[0]))
    return Travel(
        speed=float(np.linalg.norm(np.diff(path, axis=0), axis=-1).sum() / seconds),
        direction=direction,
        turn=float(heading[-1] - heading[0]),
    )


def _wrap(angle: float) -> float:
    """Radians into -pi..pi."""
    return (angle + np.pi) % (2 * np.pi) - np.pi


@dataclass(frozen=True)
class TravelError:
    """Absolute differences to a real motion of the same caption; one entry a motion, NaN = none."""

    speed: list[float]  # m/s
    direction: list[float]  # degrees, where both travel
    turn: list[float]  # degrees


def travel_error(motions: Sequence[Travel], references: Sequence[Travel]) -> TravelError:
    """Row by row; a motion that stands where its reference travels has a direction error of 90°."""
    speed, direction, turn = [], [], []
    for ours, real in zip(motions, references, strict=True):
        speed.append(abs(ours.speed - real.speed))
        turn.append(abs(float(np.degrees(ours.turn - real.turn))))
        if np.isnan(real.direction):
            direction.append(float("nan"))
        elif np.isnan(ours.direction):
            direction.append(90.0)
        else:
            direction.append(abs(float(np.degrees(_wrap(ours.direction - real.direction)))))
    return TravelError(speed, direction, turn)
