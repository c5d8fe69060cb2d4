"""When a pelvis is to be where on a drawn path, and how far it is from there.

Between the points a path is straight; its corners are rounded by a few centimetres, as nobody walks
round a point. Without times it is gone at one speed, slower in bends, at its beginning and at its
end. Without headings the body faces the way it goes.

Letters: N points, S samples along the path, T frames.
"""

import math
from dataclasses import dataclass

import numpy as np
import torch
from scipy.ndimage import gaussian_filter1d

from ..errors import UserError
from ..model.generation.constraint import Constraint
from ..motion.motion import Motion
from ..motion.root_track import FORWARD, LATERAL, ROOT_ROW, YAW_RATE
from ..motion.skeleton import REST_PELVIS_HEIGHT
from ..motion.trajectory import MotionTrajectory, to_root
from ..motion.trajectory_math import yaw_quaternion
from .drawn_path import FASTEST, DrawnPath

SPACING = 0.01  # metres between samples
ROUNDING = 0.12  # metres, standard deviation of what rounds corners
NATURAL, SLOWEST = 1.2, 0.25  # m/s
MAX_SIDEWAYS = 2.0  # m/s², acceleration in bends
MAX_ALONG = 1.5  # m/s², acceleration when starting and stopping
MAX_TURN, FASTEST_TURN = 2.5, 4.0  # rad/s, in bends and where the path turns back
START_SPEED = 0.1  # m/s, of the first and the last step
REST = 0.4  # seconds of standing at either end; without them the feet end apart
RUNNING = 2.0  # m/s; who is faster neither starts nor stops: a runner at rest stands on one leg
TURN_SMOOTHING = 0.12  # seconds, standard deviation, of the heading


@dataclass(frozen=True, eq=False)
class TimedPath:
    """Where the pelvis is to be in each frame.

    Attributes:
        points: x and z [T,2] float64, metres.
        headings: radians about +Y [T], unwrapped.
        fps: frames a second.
    """

    points: np.ndarray
    headings: np.ndarray
    fps: float

    def __len__(self) -> int:
        return len(self.points)

    def constraint(self) -> Constraint:
        """Forward, lateral and turning velocity are known, T frames; all else is free."""
        position = np.insert(self.points, 1, REST_PELVIS_HEIGHT, axis=1)
        turns = yaw_quaternion(torch.as_tensor(self.headings)).numpy()
        path = MotionTrajectory.from_pose(position, turns, np.zeros(len(self)), fps=self.fps)
        given = Constraint.free(len(self))
        given.values[:, ROOT_ROW] = to_root(path)
        given.known[:, ROOT_ROW, [FORWARD, LATERAL, YAW_RATE]] = True
        return given


# ---------------------------------------------------------------- timing


def time_path(
    drawn: DrawnPath,
    *,
    fps: float,
    speed: float = NATURAL,
    seconds: float | None = None,
    facing: float = 0.0,
) -> TimedPath:
    """When to be where.

    Args:
        drawn: the path.
        fps: frames a second.
        speed: m/s on straight ground, for a path without times.
        seconds: how long it is to take instead.
        facing: radians from the way it goes to the way the body faces; pi = backward.

    Raises:
        UserError: the seconds are too few for the length.
    """
    if drawn.times is not None:
        points = _smooth_in_time(drawn, fps)
        along = np.linspace(0, 1, len(points))
        given_at = (drawn.times - drawn.times[0]) / (drawn.times[-1] - drawn.times[0])
    else:
        line, share = _rounded(drawn.points)
        moments = _moments(line, min(max(speed, SLOWEST), FASTEST))
        rest = 0.0 if speed > RUNNING else REST if seconds is None else min(REST, seconds / 8)
        still = int(rest * fps)  # frames
        if seconds is not None:
            moments = _in_seconds(line, moments, seconds - 2 * still / fps)
        frames = np.linspace(0, moments[-1], max(2, round(moments[-1] * fps) + 1))
        frames = np.pad(frames, still, mode="edge")
        points = np.stack([np.interp(frames, moments, line[:, axis]) for axis in (0, 1)], axis=1)
        along = np.interp(frames, moments, share)
        given_at = _shares(drawn.points)
    if drawn.headings is None:
        headings = _tangents(points, fps) + facing
    else:
        headings = np.interp(along, given_at, drawn.headings)
    return TimedPath(points, _slow_turns(headings, fps), fps)


def _shares(points: np.ndarray) -> np.ndarray:
    """Of the length [N], from 0 to 1."""
    steps = np.linalg.norm(np.diff(points, axis=0), axis=1)
    return np.concatenate(([0.0], np.cumsum(steps))) / steps.sum()


def _rounded(points: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """The path with rounded corners [S,2] and the share of its length [S] at each sample.

    The ends stay where they are: beyond them the path is turned about them.
    """
    share = _shares(points)
    length = float(np.linalg.norm(np.diff(points, axis=0), axis=1).sum())
    at = np.linspace(0, 1, max(3, math.ceil(length / SPACING) + 1))
    keep = np.concatenate(([True], np.diff(share) > 0))
    dense = np.stack([np.interp(at, share[keep], points[keep, axis]) for axis in (0, 1)], axis=1)
    width = min(math.ceil(4 * ROUNDING / SPACING), len(dense) - 1)
    before = 2 * dense[0] - dense[width:0:-1]
    after = 2 * dense[-1] - dense[-2 : -width - 2 : -1]
    longer = np.concatenate((before, dense, after))
    smooth = gaussian_filter1d(longer, ROUNDING * (len(dense) - 1) / length, axis=0)
    return smooth[width : width + len(dense)], at


def _moments(line: np.ndarray, speed: float) -> np.ndarray:
    """Seconds [S] at which each sample is passed."""
    steps = np.maximum(np.linalg.norm(np.diff(line, axis=0), axis=1), 1e-9)  # S-1
    angles = np.unwrap(np.arctan2(*np.diff(line, axis=0).T))
    bend = np.abs(np.gradient(angles)) / steps if len(steps) > 1 else np.zeros(1)
    bend = gaussian_filter1d(bend, 5, mode="nearest")
    limits = np.minimum(
        np.sqrt(MAX_SIDEWAYS / np.maximum(bend, 1e-6)), MAX_TURN / np.maximum(bend, 1e-6)
    )
    limits = np.clip(limits, min(SLOWEST, speed), speed)
    if speed <= RUNNING:
        limits[[0, -1]] = np.minimum(limits[[0, -1]], START_SPEED)
    for order in (range(1, len(limits)), range(len(limits) - 2, -1, -1)):
        for at in order:
            near = at - order.step
            reachable = math.sqrt(limits[near] ** 2 + 2 * MAX_ALONG * steps[at])
            limits[at] = min(limits[at], reachable)
    return np.concatenate(([0.0], np.cumsum(steps / limits)))


def _in_seconds(line: np.ndarray, moments: np.ndarray, seconds: float) -> np.ndarray:
    """The same timing, stretched or shortened."""
    stretched = moments * (seconds / moments[-1])
    fastest = float((np.linalg.norm(np.diff(line, axis=0), axis=1) / np.diff(stretched)).max())
    if fastest > FASTEST:
        shortest = seconds * fastest / FASTEST
        raise UserError(
            f"the path is too long for its time: it takes {shortest:.1f} s at {FASTEST:g} m/s, the"
            " fastest there is; give it more seconds"
        )
    return stretched


def _smooth_in_time(drawn: DrawnPath, fps: float) -> np.ndarray:
    """Places [T,2] at given times, between them by monotone cubics."""
    from scipy.interpolate import PchipInterpolator

    assert drawn.times is not None, "only a path with times"
    frames = round((drawn.times[-1] - drawn.times[0]) * fps) + 1
    at = np.linspace(drawn.times[0], drawn.times[-1], max(frames, 2))
    return np.asarray(PchipInterpolator(drawn.times, drawn.points)(at))


def _tangents(points: np.ndarray, fps: float) -> np.ndarray:
    """The way it goes [T], radians about +Y; where it rests, the way that it went last."""
    steps = np.diff(points, axis=0)
    moving = np.linalg.norm(steps, axis=1) * fps > 0.05
    if not moving.any():
        moving[:] = True
    last = np.maximum.accumulate(np.where(moving, np.arange(len(steps)), int(moving.argmax())))
    angles = np.unwrap(np.arctan2(*steps[last].T))
    return np.append(angles, angles[-1])


def _slow_turns(headings: np.ndarray, fps: float) -> np.ndarray:
    """Headings [T] that turn smoothly, and no faster than a body can."""
    width = TURN_SMOOTHING * fps
    smooth = gaussian_filter1d(headings, width, mode="nearest")
    while np.abs(np.diff(smooth)).max() * fps > FASTEST_TURN and width < len(headings):
        width *= 1.25
        smooth = gaussian_filter1d(headings, width, mode="nearest")
    return np.asarray(smooth)


# ---------------------------------------------------------------- error


@dataclass(frozen=True)
class PathError:
    """How far a pelvis is from its path, metres; `wanted` in the same frame, `line` anywhere."""

    mean: float
    max: float
    line_mean: float
    line_max: float


def path_error(motion: Motion, path: TimedPath, drawn: DrawnPath | None = None) -> PathError:
    """Compare the ground path of a body with what was wanted, and with the line as drawn."""
    made = motion.root_position[:, [0, 2]].astype(np.float64)
    apart = np.linalg.norm(made - path.points, axis=1)
    line = distances_to_line(made, path.points if drawn is None else drawn.points)
    return PathError(
        *(float(value) for value in (apart.mean(), apart.max(), line.mean(), line.max()))
    )


def distances_to_line(places: np.ndarray, points: np.ndarray) -> np.ndarray:
    """Metres [T] from places [T,2] to the nearest point of straight lines between points [N,2]."""
    start, along = points[:-1], np.diff(points, axis=0)  # N-1 2
    square = np.maximum((along**2).sum(1), 1e-18)
    found = np.empty(len(places))
    for index, place in enumerate(places):
        share = np.clip(((place - start) * along).sum(1) / square, 0, 1)
        found[index] = np.linalg.norm(start + share[:, None] * along - place, axis=1).min()
    return found
