"""Footsteps: which foot stands when, so that feet land on the beats of a song.

While a path travels, left and right land in turn, on every beat or, in fast music, on every second
one; a foot stands until a little after the other has landed. Where the path stands still, or moves
faster than people walk, nothing is said.

Letters: T frames, M beats, S steps.
"""

import numpy as np
import torch
from scipy.ndimage import gaussian_filter1d

from ..motion.trajectory import MotionTrajectory
from ..motion.trajectory_math import turn_about_y

QUICK = 0.45  # seconds; beats closer than this are too fast for a step each
BOTH_STAND = 0.2  # of a step, both feet are on the ground
STILL, RUNNING = 0.25, 2.0  # m/s over a step; nobody walks slower, or faster
SWAY = 0.5  # seconds, standard deviation of the path that the pelvis sways about


def step_plan(trajectory: MotionTrajectory, beats: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Contacts [T,2] bool, left and right, and the frames [T] bool in which they are planned.

    The first foot is the one towards which the pelvis sways while it would stand.

    Args:
        trajectory: T frames.
        beats: seconds [M], increasing; fewer than two give no plan.
    """
    frames, fps = trajectory.num_frames, trajectory.fps
    contact, planned = np.zeros((frames, 2), dtype=bool), np.zeros(frames, dtype=bool)
    if len(beats) < 2:
        return contact, planned
    lands = landings(beats, frames / fps)
    time = np.arange(frames) / fps
    number = np.clip(np.searchsorted(lands, time, side="right") - 1, 0, len(lands) - 2)  # T
    share = (time - lands[number]) / (lands[number + 1] - lands[number])
    first = (number + _parity(trajectory, number)) % 2  # which foot landed last
    contact[np.arange(frames), first] = True
    both = share < BOTH_STAND
    contact[both] = True
    speed = np.linalg.norm(np.gradient(trajectory.position[:, [0, 2]], axis=0), axis=1) * fps
    counts = np.bincount(number, minlength=len(lands))
    mean = np.bincount(number, weights=speed, minlength=len(lands)) / np.maximum(counts, 1)
    planned = (mean[number] > STILL) & (mean[number] < RUNNING)
    return contact, planned


def landings(beats: np.ndarray, seconds: float) -> np.ndarray:
    """When feet land [S]: on every beat, or on every second one where beats are quick."""
    every = beats_beyond(beats, seconds)
    if np.median(np.diff(beats)) < QUICK:
        inside = int(np.searchsorted(every, beats[0]))
        return np.asarray(every[inside % 2 :: 2])
    return every


def beats_beyond(beats: np.ndarray, seconds: float) -> np.ndarray:
    """Beats [M], M ≥ 2, and more of the first and the last length, from before 0 to after
    `seconds`."""
    before, after = beats[1] - beats[0], beats[-1] - beats[-2]
    head, tail = max(float(beats[0]), 0.0), max(seconds - float(beats[-1]), 0.0)
    early = beats[0] - before * np.arange(np.ceil(head / before) + 1, 0, -1)
    late = beats[-1] + after * np.arange(1, np.ceil(tail / after) + 2)
    return np.concatenate((early, beats, late))


def _parity(trajectory: MotionTrajectory, number: np.ndarray) -> int:
    """0 if even steps are the left foot's, 1 if odd ones are, by how the pelvis sways."""
    path = trajectory.position.astype(np.float64)
    sway = path - gaussian_filter1d(path, SWAY * trajectory.fps, axis=0, mode="nearest")
    local = turn_about_y(torch.from_numpy(sway), -torch.from_numpy(trajectory.heading))
    to_left = local[:, 0].numpy()
    even = number % 2 == 0
    gain = to_left[even].mean() if even.any() else 0.0
    gain -= to_left[~even].mean() if (~even).any() else 0.0
    return 0 if gain >= 0 else 1
