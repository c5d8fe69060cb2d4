"""The clips that phrases are made of: their pelvis, their motion beats, and who is left out.

A clip qualifies if its pelvis moves (the threshold is read off the data: the speeds of standing
and of travelling clips form two heaps) and if it has motion beats to warp.
"""

from collections import Counter
from collections.abc import Iterable
from dataclasses import dataclass

import numpy as np
import torch
from torch import Tensor

from ...metrics.rhythm import MotionBeats, motion_beats
from ...motion.features import FORWARD, HEIGHT, LATERAL, ROOT_ROW, YAW_RATE, integrate_root
from ...motion.rotations import (
    quaternion_conjugate,
    quaternion_continuous,
    quaternion_log,
    quaternion_multiply,
    rotation_6d_to_quaternion,
    yaw_quaternion,
)
from ..prepared import SYNTHETIC, ClipRecord, PreparedData, assign_alike

FPS = 30.0
MARGIN = 6  # frames that stay free around a cut, half a seam
MIN_SPAN = 36  # frames from the cut where a clip is entered to its last
LARGEST_TURN = 0.6  # radians from frame to frame; beyond is a fault of the capture
FALLBACK_SPEED = 0.15  # m/s, where too few clips show two heaps
MIN_CLIPS_FOR_THRESHOLD = 40
SPEED_RANGE = (0.05, 0.4)  # m/s, within which the threshold is looked for

Kind = tuple[str, str]


@dataclass(frozen=True, eq=False)
class Clip:
    """One usable clip.

    Attributes:
        id, tag, source, split: as in the prepared folder; split is train, val or test.
        root: rows [T,4] float32: forward and lateral velocity, height, yaw rate.
        tilt: heading-free rotation of the pelvis [T,4] float32, w x y z.
        cuts: frames [N] at motion beats, where another clip may take over.
        period: median interval of motion beats, seconds.
        match: what the pelvis does at each cut [N,D], scaled so that 1 is a visible difference.
    """

    id: str
    tag: str
    source: str
    split: str
    root: np.ndarray
    tilt: np.ndarray
    cuts: np.ndarray
    period: float
    match: np.ndarray

    @property
    def num_frames(self) -> int:
        return len(self.root)

    @property
    def kind(self) -> Kind:
        """Source and tag."""
        return self.source, self.tag

    @property
    def entries(self) -> np.ndarray:
        """Cuts [M], by number, with enough of the clip after them to enter there."""
        return np.flatnonzero(self.cuts[-1] - self.cuts >= MIN_SPAN)


@dataclass(frozen=True, eq=False)
class ClipLibrary:
    """All usable clips, and how many were not.

    Attributes:
        clips: in the prepared folder's order.
        threshold: mean pelvis speed in m/s below which a clip hardly moves.
        left_out: number of clips by reason.
        used: number of clips by source and tag.
    """

    clips: tuple[Clip, ...]
    threshold: float
    left_out: dict[str, int]
    used: dict[str, int]

    def of_split(self, split: str) -> list[Clip]:
        """Clips of train, val or test."""
        return [clip for clip in self.clips if clip.split == split]


def open_library(data: PreparedData, *, synthetic: bool = True, seed: int = 0) -> ClipLibrary:
    """Read a prepared folder's clips and their mirror images.

    Args:
        synthetic: also take the project's own parametric motions.
        seed: of the split, where the folder has no test split of its own.
    """
    records = [r for r in data.records() if synthetic or r.source != SYNTHETIC]
    splits = _splits(records, seed)
    tracks = {r.id: _track(data, r) for r in records}
    speeds = {name: float(track[2].speed.mean()) for name, track in tracks.items()}
    threshold = speed_threshold(speeds.values())
    clips, left_out, used = [], Counter[str](), Counter[str]()
    for record in records:
        root, tilt, beats, turn = tracks[record.id]
        cuts = np.rint(beats.times * FPS).astype(int)
        cuts = cuts[(cuts >= MARGIN) & (cuts < len(root) - MARGIN)]
        if speeds[record.id] < threshold:
            left_out["the pelvis hardly moves"] += 1
        elif turn > LARGEST_TURN:
            left_out["the pelvis turns faster than a body can"] += 1
        elif len(cuts) < 2 or cuts[-1] - cuts[0] < MIN_SPAN:
            left_out["too few motion beats"] += 1
        else:
            used[f"{record.source} {record.tag or 'untagged'}"] += 1
            period = beats.period if len(beats.times) > 2 else float(np.diff(beats.times)[0])
            made = (root, tilt, cuts, period, _match(root, tilt, cuts))
            clips.append(Clip(record.id, record.tag, record.source, splits[record.take], *made))
    return ClipLibrary(tuple(clips), threshold, dict(left_out), dict(sorted(used.items())))


def _splits(records: list[ClipRecord], seed: int) -> dict[str, str]:
    """Split of each take: the folder's own, or another where it holds too little back."""
    own = {r.take: r.split.partition("_")[0] for r in records}
    if {"train", "val", "test"} <= set(own.values()):
        return own
    return assign_alike(list(own), seed)


def _track(
    data: PreparedData, record: ClipRecord
) -> tuple[np.ndarray, np.ndarray, MotionBeats, float]:
    """Rows, tilt, beats and the largest turn from frame to frame of a clip's pelvis."""
    features = data.features(record)
    rows, tilt = track_of(features)
    position, heading = integrate_root(features[:, ROOT_ROW], FPS)
    world = quaternion_multiply(yaw_quaternion(heading), torch.as_tensor(tilt))
    steps = quaternion_log(quaternion_multiply(world[1:], quaternion_conjugate(world[:-1])))
    return rows, tilt, motion_beats(position.numpy(), FPS), float(steps.norm(dim=1).max())


def track_of(features: Tensor) -> tuple[np.ndarray, np.ndarray]:
    """Rows [T,4] and tilt [T,4] of a clip's pelvis, as `Clip` holds them, of features [T,23,6]."""
    rows = features[:, ROOT_ROW][:, [FORWARD, LATERAL, HEIGHT, YAW_RATE]]
    tilt = quaternion_continuous(rotation_6d_to_quaternion(features[:, 0]))
    return rows.numpy().copy(), tilt.numpy()


def speed_threshold(speeds: Iterable[float]) -> float:
    """Mean speed in m/s that parts standing clips from moving ones.

    Otsu's threshold (1979) on the logarithm, looked for within `SPEED_RANGE`; a fixed value
    below `MIN_CLIPS_FOR_THRESHOLD` clips.
    """
    logs = np.sort(np.log(np.maximum(list(speeds), 1e-4)))
    if len(logs) < MIN_CLIPS_FOR_THRESHOLD:
        return FALLBACK_SPEED
    grid = np.linspace(np.log(SPEED_RANGE[0]), np.log(SPEED_RANGE[1]), 200)
    below = np.searchsorted(logs, grid)
    sums = np.concatenate(([0.0], np.cumsum(logs)))
    lower = sums[below] / np.maximum(below, 1)
    upper = (sums[-1] - sums[below]) / np.maximum(len(logs) - below, 1)
    between = below * (len(logs) - below) * (upper - lower) ** 2
    best = np.flatnonzero(between >= between.max() * (1 - 1e-9))  # the gap's middle
    return float(np.exp(grid[best].mean()))


def _match(root: np.ndarray, tilt: np.ndarray, cuts: np.ndarray) -> np.ndarray:
    """Velocity, yaw rate, height and tilt a seam's half before, at and after each cut [N,21]."""
    scale = np.array((0.3, 0.3, 0.06, 1.0))
    rows = np.concatenate((root / scale, tilt[:, 1:] * np.sign(tilt[:, :1]) / 0.1), 1)
    around = [rows[np.clip(cuts + shift, 0, len(rows) - 1)] for shift in (-MARGIN, 0, MARGIN - 1)]
    return np.concatenate(around, 1).astype(np.float32)
