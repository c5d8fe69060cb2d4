"""Is it a dance and no procession? Way, stage, turning, poses, hovering and sliding of one body.

Needs no learned model. Each figure is the same computation for real and generated motion and means
little without the real row: a frozen pose has a small stage and never hovers.

Letters: T frames, K joints, A principal axes.
"""

import numpy as np

from ..motion.features import motion_heading
from ..motion.filters import smoothed
from ..motion.motion import Motion
from ..motion.postprocess.contacts import contact_runs
from ..motion.rotations import turn_about_y
from ..motion.skeleton import REST_FOOT_HEIGHT
from ..tensors import torch
from .physical import BALLS, SUPPORT_HEIGHT, ground_speed

SWAY = 0.25  # seconds, standard deviation: a sway within a step is no way
MOVING = 0.1  # m/s of that smoothed path; slower has no direction
BEHIND = 0.75 * np.pi  # radians from where it faces, beyond which it goes backward
POSE_APART = 0.12  # metres, mean over the joints, between poses that differ
POSE_STEP = 0.1  # seconds between poses that are looked at
HOVER_SECONDS = 0.45  # off the floor for longer: nobody jumps so in a dance
TORN = 250.0  # m/s² of a joint: a leg that was captured wrongly jumps for a frame
SHAKEN = 120.0  # m/s², one way and the other in two frames, likewise
SLIDING = 0.2  # m/s of the slower foot while both are near the floor


def stage(motion: Motion) -> dict[str, float]:
    """Figures of one dance of at least two frames; NaN where there is nothing to judge."""
    positions = motion.positions().astype(np.float64)
    path, heading = positions[:, 0, [0, 2]], motion_heading(motion).astype(np.float64)
    # Joints seen from below the pelvis, facing +Z.
    seen = positions - positions[:, :1] * np.array([1.0, 0.0, 1.0])
    turns = -torch.from_numpy(heading)[:, None]
    poses = np.asarray(turn_about_y(torch.from_numpy(seen), turns).numpy())
    apart = np.linalg.norm(path - path.mean(0), axis=1)
    return {
        "backward": backward_share(path, heading, motion.fps),
        "radius": float(apart.max()),  # metres from the middle of where the pelvis was
        "net_way": net_way(path, motion.fps),
        "turning": turning(heading, motion.fps),
        "poses": float(distinct_poses(poses[:: max(1, round(POSE_STEP * motion.fps))])),
        "dimensions": pose_dimensions(poses),
        "hovering": hovering(positions, motion.fps),
        "both_slide": float(sliding(positions, motion.fps).mean()),  # share of the time
    }


def backward_share(path: np.ndarray, heading: np.ndarray, fps: float) -> float:
    """Share of the way of a path [T, 2] (x, z) in metres that is gone more than 135° off the
    heading [T], radians; sways apart, and NaN where it never moves."""
    step = np.diff(smoothed(path, SWAY * fps), axis=0)  # T-1 2
    length = np.linalg.norm(step, axis=1)
    length = np.where(length * fps > MOVING, length, 0.0)
    off = (np.arctan2(step[:, 0], step[:, 1]) - heading[:-1] + np.pi) % (2 * np.pi) - np.pi
    total = float(length.sum())
    return float(length[np.abs(off) > BEHIND].sum()) / total if total else float("nan")


def net_way(path: np.ndarray, fps: float) -> float:
    """How straight a path [T, 2] leads away: 1 for a line, 0 where it ends as it began; NaN
    where it never moves."""
    smooth = smoothed(path, SWAY * fps)
    way = float(np.linalg.norm(np.diff(smooth, axis=0), axis=1).sum())
    return float(np.linalg.norm(smooth[-1] - smooth[0])) / way if way > 1e-6 else float("nan")


def turning(heading: np.ndarray, fps: float) -> float:
    """Mean degrees a second of a heading [T] in radians, unwrapped, either way; sways apart."""
    return float(np.degrees(np.abs(np.diff(smoothed(heading, SWAY * fps))).mean() * fps))


def distinct_poses(poses: np.ndarray) -> int:
    """How many of poses [T, K, 3] are all `POSE_APART` from each other, taken in their order."""
    kept: list[np.ndarray] = []
    for pose in poses:
        if not kept or np.linalg.norm(np.stack(kept) - pose, axis=-1).mean(1).min() > POSE_APART:
            kept.append(pose)
    return len(kept)


def pose_dimensions(poses: np.ndarray) -> float:
    """Participation ratio (Σλ)² / Σλ² of the covariance of poses [T, K, 3]; 0 of a frozen one."""
    flat = poses.reshape(len(poses), -1)
    spread = np.linalg.svd(flat - flat.mean(0), compute_uv=False) ** 2  # A
    total = float((spread**2).sum())
    return float(spread.sum() ** 2 / total) if total > 1e-12 else 0.0


def hovering(positions: np.ndarray, fps: float) -> float:
    """Times a minute that every joint of [T, K, 3] is over 6 cm above where the ball of a standing
    foot is, for longer than `HOVER_SECONDS`."""
    long = [stop - start > HOVER_SECONDS * fps for start, stop in aloft(positions)]
    return sum(long) * 60.0 * fps / len(positions)


def aloft(positions: np.ndarray) -> list[tuple[int, int]]:
    """First and past-the-last frame of each stretch of [T, K, 3] in which no joint is near the
    floor."""
    return contact_runs(positions[..., 1].min(1) > REST_FOOT_HEIGHT + SUPPORT_HEIGHT, 0)


def torn(change: np.ndarray) -> np.ndarray:
    """Frames [T] of accelerations [T, K, 3] in m/s² in which a joint jumps, or goes to and fro."""
    size = np.linalg.norm(change, axis=-1)
    found = (size > TORN).any(1)
    turns = (change[1:] * change[:-1]).sum(-1) < 0
    shaken = (turns & (np.minimum(size[1:], size[:-1]) > SHAKEN)).any(1)
    found[1:] |= shaken
    found[:-1] |= shaken
    return np.asarray(found)


def sliding(positions: np.ndarray, fps: float) -> np.ndarray:
    """Between which frames of [T, 22, 3] both feet slide near the floor, bool [T-1]."""
    balls = positions[:, BALLS]  # T 2 3
    near = balls[:-1, :, 1].max(1) < REST_FOOT_HEIGHT + SUPPORT_HEIGHT
    return np.asarray(near & (ground_speed(balls, fps).min(1) > SLIDING))
