"""A trajectory as a constraint: what a path pins of the body that is to move along it.

Letters: T frames, R rows (bones, root track), M beats.
"""

from dataclasses import dataclass
from typing import Any

import numpy as np
import torch
from torch import Tensor

from ..model.generation.constraint import Constraint
from ..motion.motion import Motion
from ..motion.root_track import LEFT_CONTACT, ROOT_ROW, headings
from ..motion.rotations import (
    matrix_to_rotation_6d,
    quaternion_to_matrix,
    rotation_6d_to_matrix,
    yaw_to_matrix,
)
from ..motion.trajectory import MotionTrajectory, to_root
from ..motion.trajectory_math import heading_of
from .footsteps import step_plan

PELVIS = 0  # its row


def pin(
    trajectory: MotionTrajectory,
    *,
    beats: np.ndarray | None = None,
    steps: np.ndarray | None = None,
    tilt: bool = False,
) -> Constraint:
    """What is known of a body that moves along a path: velocity, height and turning, T frames.

    The inverse of `integrate_root` (forward differences, ruling 6), so that a body which keeps to
    it stands on the path.

    Args:
        trajectory: of the pelvis.
        beats: seconds [M] at which the body is to have a beat; None = it keeps its own time.
        steps: beats [M] on which feet are to land while the path travels; see `step_plan`.
        tilt: also pin how the pelvis leans and rolls.
    """
    constraint = Constraint.free(trajectory.num_frames)
    values, known = constraint.values, constraint.known
    values[:, ROOT_ROW] = to_root(trajectory)
    known[:, ROOT_ROW, :LEFT_CONTACT] = True
    if steps is not None:
        contacts, planned = step_plan(trajectory, steps)
        values[:, ROOT_ROW, LEFT_CONTACT:] = torch.from_numpy(contacts).float()
        known[:, ROOT_ROW, LEFT_CONTACT:] = torch.from_numpy(planned)[:, None]
    if tilt:
        turns = quaternion_to_matrix(torch.tensor(trajectory.quaternion, dtype=torch.float64))
        level = yaw_to_matrix(-torch.from_numpy(trajectory.heading)) @ turns
        values[:, PELVIS] = matrix_to_rotation_6d(level).float()
        known[:, PELVIS] = True
    times = None if beats is None else torch.as_tensor(np.asarray(beats), dtype=torch.float32)
    return Constraint(values, known, times)


def untwisted(features: Tensor) -> Tensor:
    """Features [T,R,6] whose pelvis row has no heading left: that is the path's alone."""
    pelvis = rotation_6d_to_matrix(features[:, PELVIS])
    level = yaw_to_matrix(-headings(pelvis)) @ pelvis
    return torch.cat((matrix_to_rotation_6d(level)[:, None], features[:, 1:]), 1)


def start_of(trajectory: MotionTrajectory) -> dict[str, Any]:
    """Where a body on this path begins, as `decode_features` takes it."""
    x, _, z = trajectory.position[0].tolist()
    return {"start_position": (x, z), "start_heading": float(trajectory.heading[0])}


@dataclass(frozen=True)
class RootError:
    """How far a body's pelvis is from its path: metres and degrees of heading."""

    mean_metres: float
    max_metres: float
    mean_degrees: float
    max_degrees: float


def root_error(motion: Motion, trajectory: MotionTrajectory) -> RootError:
    """Compare a body with the path that it was to stand on, both of T frames."""
    apart = np.linalg.norm(motion.root_position - trajectory.position, axis=-1)
    pelvis = torch.tensor(motion.quaternions[:, PELVIS], dtype=torch.float64)
    turned = heading_of(pelvis).numpy() - trajectory.heading
    degrees = np.rad2deg(np.abs((turned + np.pi) % (2 * np.pi) - np.pi))
    return RootError(
        *(float(value) for value in (apart.mean(), apart.max(), degrees.mean(), degrees.max()))
    )
