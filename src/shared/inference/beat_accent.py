"""Beat accent: limbs hurry between beats and linger on them, while the pelvis keeps its path.

A dancer's beat is a moment of little movement. The limbs' poses are played at an uneven rate,

    τ(t) = t - a P / 2π · sin 2πφ(t),    dτ/dt = 1 - a cos 2πφ(t),

φ counting beats of length P: slowest on the beat, fastest halfway, never more than a few
hundredths of a second from where they were. Poses stay those that were sampled; the root row
keeps its own time, as the path is given.

Letters: T frames, R rows (bones, root track), C channels, M beats.
"""

import numpy as np
import torch
from torch import Tensor

from src.shared.data.pairing.time_warp import resample_rotations
from src.shared.motion.root_track import LEFT_CONTACT, ROOT_ROW
from src.shared.motion.rotations import (
    matrix_to_rotation_6d,
    quaternion_continuous,
    quaternion_to_matrix,
    rotation_6d_to_quaternion,
)

MAX_SHIFT = 0.08  # seconds that a pose is early or late at most; slow songs are accented less
BEYOND = 2.0  # seconds: a frame further than this from every beat has none


def accent_shift(
    beats: np.ndarray, frames: int, strength: float, *, fps: float = 30.0
) -> np.ndarray:
    """How much later than it was sampled each pose is shown, seconds [T]; 0 away from all beats.

    Args:
        beats: seconds [M], increasing; fewer than two tell no tempo.
        frames: T.
        strength: a, 0 = not at all, below 1.
        fps: frames per second.
    """
    time = np.arange(frames) / fps
    if len(beats) < 2:
        return np.zeros(frames)
    all_beats = beats_beyond(beats)
    phase = np.interp(time, all_beats, np.arange(len(all_beats)))
    middles = (all_beats[1:] + all_beats[:-1]) / 2
    period = np.interp(time, middles, np.diff(all_beats))
    size = np.minimum(strength * period / (2 * np.pi), MAX_SHIFT)
    return np.asarray(size * np.sin(2 * np.pi * phase))


def beats_beyond(beats: np.ndarray, seconds: float | None = None) -> np.ndarray:
    """Beats [M], M ≥ 2, and more of the first and the last length before and after them.

    Args:
        beats: seconds, increasing.
        seconds: from before 0 to after these there are beats all along; None = `BEYOND` more on
            both sides.
    """
    before, after = beats[1] - beats[0], beats[-1] - beats[-2]
    head = BEYOND if seconds is None else max(float(beats[0]), 0.0)
    tail = BEYOND if seconds is None else max(seconds - float(beats[-1]), 0.0)
    early = beats[0] - before * np.arange(np.ceil(head / before) + 1, 0, -1)
    late = beats[-1] + after * np.arange(1, np.ceil(tail / after) + 2)
    return np.concatenate((early, beats, late))


def accented(features: Tensor, beats: np.ndarray, strength: float, *, fps: float = 30.0) -> Tensor:
    """Features [T,R,C] with limbs, pelvis tilt and contacts in the beats' time, path unchanged."""
    time = np.arange(len(features)) / fps
    shift = accent_shift(beats, len(features), strength, fps=fps)
    at = np.clip(time - shift, 0, time[-1])
    bones = quaternion_continuous(rotation_6d_to_quaternion(features[:, :ROOT_ROW]), dim=0)
    turned = torch.from_numpy(resample_rotations(bones.numpy(), at, fps))
    result = features.clone()
    result[:, :ROOT_ROW] = matrix_to_rotation_6d(quaternion_to_matrix(turned))
    if features.shape[1] > ROOT_ROW:
        contacts = features[:, ROOT_ROW, LEFT_CONTACT:].numpy()
        moved = np.stack([np.interp(at, time, column) for column in contacts.T], 1)
        result[:, ROOT_ROW, LEFT_CONTACT:] = torch.from_numpy(moved).to(features.dtype)
    return result
