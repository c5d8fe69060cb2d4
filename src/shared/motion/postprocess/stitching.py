"""Stitching: where a body stands, motions one after the other, seams without a jump.

Runs on the CPU in float64.

Letters: T frames, R rows (bones, root track), C channels, N columns (one channel of one row).
"""

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from ...tensors import Tensor, torch
from ..features import LEFT_CONTACT, ROOT_ROW, Place, headings
from ..filters import smoothed
from ..motion import Motion
from ..rotations import (
    matrix_to_quaternion,
    matrix_to_rotation_6d,
    quaternion_continuous,
    quaternion_exp,
    quaternion_log,
    quaternion_multiply,
    quaternion_to_matrix,
    rotation_6d_to_matrix,
    turn_about_y,
    yaw_quaternion,
)

FADE = 10  # frames until a correction at a border has faded out
BLUR, REACH = 1.5, 4.0  # frames, standard deviations: of the average at a cut, of where it is made


def place_of(motion: Motion, frame: int) -> Place:
    """Where a body is in a frame."""
    pelvis = quaternion_to_matrix(torch.as_tensor(motion.quaternions[:, 0]))
    x, _, z = motion.root_position[frame].tolist()
    return Place(x, z, float(headings(pelvis)[frame]))


def moved_to(motion: Motion, place: Place) -> Motion:
    """The same motion with its first frame somewhere else on the ground."""
    here = place_of(motion, 0)
    turn = place.heading - here.heading
    path = torch.as_tensor(motion.root_position, dtype=torch.float64)
    path = turn_about_y(path - torch.tensor([here.x, 0.0, here.z]), turn)
    path = path + torch.tensor([place.x, 0.0, place.z])
    quaternions = motion.quaternions.copy()
    pelvis = torch.as_tensor(quaternions[:, 0], dtype=torch.float64)
    yaw = yaw_quaternion(torch.tensor(turn, dtype=torch.float64))
    quaternions[:, 0] = quaternion_multiply(yaw.expand_as(pelvis), pelvis).numpy()
    return replace(motion, quaternions=quaternions, root_position=path.float().numpy())


def joined(first: Motion, second: Motion) -> Motion:
    """Two motions one after the other, both where they are; quaternion signs go on."""
    quaternions = np.concatenate((first.quaternions, second.quaternions))
    return replace(
        first,
        quaternions=quaternion_continuous(torch.as_tensor(quaternions), dim=0).numpy(),
        root_position=np.concatenate((first.root_position, second.root_position)),
        contacts=np.concatenate((first.contacts, second.contacts)),
    )


def blend_boundaries(features: Tensor, known: Tensor, *, fade: int = FADE) -> Tensor:
    """Features with unknown entries moved to meet the known ones; contacts stay as they are.

    Args:
        features: raw [T,R,C].
        known: bool [T,R,C]; these entries are left alone.
        fade: frames; no more than half of a gap.
    """
    smooth = features.double().flatten(1).numpy().copy()  # T N
    fixed = known.flatten(1).numpy().copy()  # T N
    contacts = ROOT_ROW * features.shape[2] + LEFT_CONTACT
    fixed[:, contacts:] = True
    _meet(smooth, fixed, fade)
    _meet(smooth[::-1], fixed[::-1], fade)
    return torch.from_numpy(smooth).to(features.dtype).view_as(features)


def blend_cuts(features: Tensor, cuts: Sequence[int]) -> Tensor:
    """Features averaged over time near the first frames of new pieces; contacts stay.

    Args:
        features: raw [T,R,C].
        cuts: frames at which a piece begins.
    """
    if not cuts:
        return features
    away = np.abs(np.arange(len(features))[:, None] + 0.5 - np.asarray(cuts)).min(1)
    share = np.where(away < 4 * REACH, np.exp(-0.5 * (away / REACH) ** 2), 0.0)
    rows = features.double().numpy()
    mean = smoothed(rows, BLUR)
    soft = torch.from_numpy(rows + share[:, None, None] * (mean - rows)).to(features.dtype)
    soft[:, ROOT_ROW:, LEFT_CONTACT:] = features[:, ROOT_ROW:, LEFT_CONTACT:]
    return soft


def _meet(values: np.ndarray, fixed: np.ndarray, fade: int) -> None:
    """Blend the boundaries behind fixed entries [T,N] in place: whole rotations by turning them,
    single channels by adding to them."""
    starts = fixed[:-1] & ~fixed[1:]  # T-1 N, the next frame is the first free one
    for last in np.flatnonzero(starts.any(1)):
        columns = np.flatnonzero(starts[last])
        later = fixed[last + 1 :, columns]
        lengths = np.where(later.any(0), later.argmax(0), len(later))  # until it is fixed again
        for length in np.unique(lengths):
            same = columns[lengths == length]
            part = values[last + 1 : last + 1 + length, same]
            goal = _expected(values[: last + 1, same], fixed[: last + 1, same], part)
            open_ended = last + 1 + length == len(values)
            reach = fade if open_ended else min(fade, max(1, length // 2))
            weights = _weights(length, reach)
            made = part + weights[:, None] * (goal - part[0])
            whole = np.isin(np.arange(ROOT_ROW * 6), same).reshape(-1, 6).all(1)
            if whole.any():
                at = np.searchsorted(same, np.arange(ROOT_ROW * 6).reshape(-1, 6)[whole])  # rows 6
                made[:reach, at] = _turned(part[:reach, at], goal[at], weights[:reach])
            values[last + 1 : last + 1 + length, same] = made


def _turned(rows: np.ndarray, goal: np.ndarray, weights: np.ndarray) -> np.ndarray:
    """Rotations [T,R,6] turned by what the first ones lack to their goals [R,6], weighted [T].

    On the way between rotations that lie far apart columns of 6D nearly vanish, and what is made of
    them jumps.
    """
    rotations = rotation_6d_to_matrix(torch.from_numpy(rows))
    lack = rotation_6d_to_matrix(torch.from_numpy(goal)) @ rotations[0].swapaxes(-1, -2)
    share = torch.from_numpy(weights)[:, None, None] * quaternion_log(matrix_to_quaternion(lack))
    return matrix_to_rotation_6d(quaternion_to_matrix(quaternion_exp(share)) @ rotations).numpy()


def _expected(before: np.ndarray, fixed: np.ndarray, after: np.ndarray) -> np.ndarray:
    """The first free values [N]: the last fixed ones, and the mean step of both sides on."""
    steps = [after[1] - after[0]] if len(after) > 1 else []
    if len(before) > 1:
        own = before[-1] - before[-2]
        steps.append(np.where(fixed[-2], own, steps[0] if steps else 0.0))
    return np.asarray(before[-1] + np.mean(steps, axis=0) if steps else before[-1])


def _weights(frames: int, reach: int) -> np.ndarray:
    """[frames] from 1 to 0 over `reach` frames; first and second derivative vanish at both ends."""
    x = np.clip(np.arange(frames) / reach, 0, 1)
    return np.asarray(1 - x**3 * (x * (6 * x - 15) + 10))
