"""A soft pull to the middle of the stage and to the front, on the root track of a body.

Nothing says where a dance goes, and a body that nobody holds wanders off. Frame by frame the
heading is turned towards the front and the velocity towards the middle, by no more than feet that
step anyway can take up; a slow way backward, which nobody asked for, is mostly left out. The foot
clean-up then lets feet stand where they would have slid.

Runs on the CPU in float64.

Letters: T frames.
"""

import math

import numpy as np
from scipy.ndimage import gaussian_filter1d

from ..tensors import Tensor, torch
from .features import FORWARD, LATERAL, YAW_RATE, integrate_root

LAG = 1.0  # seconds over which place and heading are averaged: a sway and a spin are left alone
PULL, NEAR = 0.12, 0.8  # m/s at most, and metres from the middle at which 0.7 of it is reached
TURN = 0.3  # rad/s at most, for a body that has its side to the front
SWAY = 0.5  # seconds, standard deviation: quicker steps backward stay
STEADY, STROLL = 1.0, 0.12  # seconds, standard deviation, and m/s: a faster way is a walk,
ROUND = 0.55  # metres, radius of the circle that it is bent to
ROOM, PULLS = (
    1.1,
    (PULL, 0.3, 0.6, 1.2),
)  # metres from the middle; pulls that are tried until it stays
BACKWARD = 0.8  # share of the way backward that is left out


def circling(root: Tensor, fps: float) -> Tensor:
    """Root rows [T,6] of a body that walks round where it would have walked off.

    Args:
        root: see `steered`.
        fps: frames a second.
    """
    rows = root.double().clone()
    way = rows[:, [FORWARD, LATERAL]].numpy()
    slow = gaussian_filter1d(way, STEADY * fps, axis=0, mode="nearest")
    speed = np.linalg.norm(slow, axis=1)
    side = 1.0 if float(rows[:, YAW_RATE].sum()) >= 0 else -1.0
    bend = side * np.maximum(speed - STROLL, 0) / ROUND
    rows[:, YAW_RATE] += torch.from_numpy(bend)
    return rows.to(root.dtype)


def staged(root: Tensor, fps: float) -> Tensor:
    """Root rows [T,6] that `steered` leaves within `ROOM`, by a stronger pull if it has to be."""
    rows = root
    for pull in PULLS:
        rows = steered(root, fps, pull=pull)
        path = integrate_root(rows.double(), fps)[0].numpy()[:, [0, 2]]
        if np.linalg.norm(path - path.mean(0), axis=1).max() <= ROOM:
            break
    return rows


def steered(root: Tensor, fps: float, *, pull: float = PULL, turn: float = TURN) -> Tensor:
    """Root rows [T,6] of a body that keeps near the middle and comes back to the front.

    Args:
        root: forward and lateral velocity (m/s), height, yaw rate (rad/s) and contacts; the first
            frame is in the middle and faces the front.
        fps: frames a second.
        pull, turn: see the module.
    """
    rows = root.double().clone()
    slow = gaussian_filter1d(rows[:, FORWARD].numpy(), SWAY * fps, mode="nearest")
    rows[:, FORWARD] -= torch.from_numpy(BACKWARD * np.minimum(slow, 0.0))
    values, keep = rows.tolist(), math.exp(-1 / (LAG * fps))
    x = z = heading = near_x = near_z = sine = 0.0
    cosine = 1.0
    for row in values:
        near_x, near_z = keep * near_x + (1 - keep) * x, keep * near_z + (1 - keep) * z
        sine = keep * sine + (1 - keep) * math.sin(heading)
        cosine = keep * cosine + (1 - keep) * math.cos(heading)
        to_x, to_z = (-pull * at / math.hypot(near_x, near_z, NEAR) for at in (near_x, near_z))
        row[YAW_RATE] -= turn * sine  # of a spin's mean little is left
        row[FORWARD] += to_x * math.sin(heading) + to_z * math.cos(heading)
        row[LATERAL] += to_x * math.cos(heading) - to_z * math.sin(heading)
        forward, left = row[FORWARD] / fps, row[LATERAL] / fps
        x += forward * math.sin(heading) + left * math.cos(heading)
        z += forward * math.cos(heading) - left * math.sin(heading)
        heading += row[YAW_RATE] / fps
    return torch.tensor(values, dtype=root.dtype)
