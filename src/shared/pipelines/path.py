"""A path as a user draws it, when a pelvis is to be where on it, and a motion along it.

In metres: x (to the left of a character that faces +Z) and z; optionally t (seconds) and heading
(degrees about +Y, 0 = +Z, 90 = +X). Between the points a path is straight; its corners are rounded
by a few centimetres, as nobody walks round a point. Without times it is gone at one speed, slower
in bends, at its beginning and at its end. Without headings the body faces the way it goes.

Letters: N points, S samples along the path, T frames.
"""

import csv
import logging
import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np

from ..config_loader import parse_yaml
from ..errors import UserError
from ..io.files import read_text
from ..model.diffusion import Sampling
from ..model.generation.constraint import Constraint
from ..model.generation.motion_generator import TextToMotion
from ..motion.features import FORWARD, HEIGHT, LATERAL, ROOT_ROW, YAW_RATE, Place
from ..motion.filters import smoothed
from ..motion.motion import Motion
from ..motion.rotations import yaw_quaternion
from ..motion.skeleton import REST_PELVIS_HEIGHT
from ..motion.trajectory import MotionTrajectory, to_root
from ..tensors import Tensor, torch
from .edit import ControlledMotion
from .stream import Passage, stream_features
from .timeline import Timeline, make_timeline

COLUMNS = ("x", "z", "t", "heading")
SHORTEST, LONGEST = 0.01, 1000.0  # metres of a path
FASTEST = 4.0  # m/s
MAX_POINTS = 100_000
TURN_SPEED, TURN_REST = 75.0, 0.5  # degrees a second; seconds before and after a turn


log = logging.getLogger(__name__)


@dataclass(frozen=True, eq=False)
class DrawnPath:
    """Points as they were given.

    Attributes:
        points: x and z [N,2] float64, metres.
        times: seconds [N], increasing, or None.
        headings: radians [N], or None.
    """

    points: np.ndarray
    times: np.ndarray | None = None
    headings: np.ndarray | None = None

    @property
    def length(self) -> float:
        """Metres along the straight lines between the points."""
        return float(np.linalg.norm(np.diff(self.points, axis=0), axis=1).sum())


Way = DrawnPath | str | Path | np.ndarray | Sequence[Any]  # what a path may be given as


def path_of(way: Way) -> DrawnPath:
    """A path that is drawn already; a file, see `read_path`; or points, as a list or an array
    [N,2 to 4], each x, z and, if you like, t and heading.

    Raises:
        UserError: as `read_path`.
    """
    if isinstance(way, DrawnPath):
        return way
    if isinstance(way, str | Path):
        return read_path(way)
    name = Path("path")
    return _path(*_listed_rows(np.array(way, dtype=object).tolist(), name), name)


def read_path(path: str | Path) -> DrawnPath:
    """A path from CSV (with or without a line of names), JSON or YAML.

    JSON and YAML hold a list of points, or a mapping with `points`: each a list in the order x, z,
    t, heading, or a mapping of these names.

    Raises:
        UserError: unreadable, not numbers, fewer than two places, times that do not increase, or
            too fast; names the point.
    """
    path = Path(path)
    text = read_text(path, "a CSV, JSON or YAML file")
    if path.suffix.lower() == ".csv":
        names, rows = _csv_rows(text, path)
    else:
        names, rows = _listed_rows(parse_yaml(text, str(path)), path)
    return _path(names, rows, path)


def _path(names: tuple[str, ...], rows: list[Any], path: Path) -> DrawnPath:
    values = _numbers(rows, names, path)
    column = {name: values[:, index] for index, name in enumerate(names)}
    headings = column.get("heading")
    drawn = DrawnPath(
        np.stack((column["x"], column["z"]), axis=1),
        column.get("t"),
        None if headings is None else np.unwrap(np.deg2rad(headings)),
    )
    _check(drawn, path)
    return drawn


def _csv_rows(text: str, path: Path) -> tuple[tuple[str, ...], list[Any]]:
    try:
        rows = [[cell.strip() for cell in row] for row in csv.reader(text.splitlines()) if any(row)]
    except csv.Error as error:
        raise UserError(f"{path}: is no table ({error}); give at least two lines x,z") from None
    if not rows:
        raise UserError(f"{path}: is empty; give at least two lines x,z")
    names = tuple(cell.lower() for cell in rows[0])
    if any(_is_number(cell) for cell in names):
        return COLUMNS[: len(rows[0])], rows
    return _checked_names(names, path), rows[1:]


def _listed_rows(value: Any, path: Path) -> tuple[tuple[str, ...], list[Any]]:
    points = value.get("points") if isinstance(value, dict) else value
    if not isinstance(points, list) or not points:
        raise UserError(f"{path}: holds no list of points; write [[x, z], …] or {{points: …}}")
    if isinstance(points[0], dict):
        names = _checked_names(tuple(str(name).lower() for name in points[0]), path)
        rows = []
        for number, point in enumerate(points, start=1):
            if not isinstance(point, dict) or {str(key).lower() for key in point} != set(names):
                raise UserError(
                    f"{path}: point {number} is not like the first one ({', '.join(names)});"
                    " mend it"
                )
            rows.append([point[key] for name in names for key in point if str(key).lower() == name])
        return names, rows
    width = len(points[0]) if isinstance(points[0], list) else 0
    return COLUMNS[:width], points


def _checked_names(names: tuple[str, ...], path: Path) -> tuple[str, ...]:
    unknown = [name for name in names if name not in COLUMNS]
    if unknown or not {"x", "z"} <= set(names) or len(set(names)) < len(names):
        raise UserError(
            f"{path}: the columns are {', '.join(names)}; give x and z, and if you like t"
            " (seconds) and heading (degrees)"
        )
    return names


def _numbers(rows: Sequence[Any], names: tuple[str, ...], path: Path) -> np.ndarray:
    """Values [N, columns]."""
    if not 2 <= len(names) <= len(COLUMNS):
        raise UserError(f"{path}: a point needs 2 to 4 numbers: x, z, t, heading")
    if len(rows) > MAX_POINTS:
        raise UserError(
            f"{path}: {len(rows)} points are over the limit of {MAX_POINTS}; leave some out"
        )
    for number, row in enumerate(rows, start=1):
        if not isinstance(row, list) or len(row) != len(names):
            raise UserError(f"{path}: point {number} is {row!r}, not {len(names)} numbers; mend it")
        for name, value in zip(names, row, strict=True):
            if not _is_number(value) or not math.isfinite(float(value)):
                raise UserError(
                    f"{path}: point {number}: {name} is {value!r}, not a number; mend it"
                )
    return np.array([[float(value) for value in row] for row in rows]).reshape(-1, len(names))


def _is_number(value: Any) -> bool:
    if isinstance(value, bool):
        return False
    try:
        float(value)
    except (TypeError, ValueError, OverflowError):
        return False
    return True


def _check(drawn: DrawnPath, path: Path) -> None:
    if not SHORTEST <= drawn.length <= LONGEST:
        raise UserError(
            f"{path}: the path is {drawn.length:g} m long; give two or more different points, in"
            f" metres, of at most {LONGEST:g} m"
        )
    if drawn.times is None:
        return
    steps = np.diff(drawn.times)
    if not (steps > 0).all():
        worst = int(np.flatnonzero(steps <= 0)[0])
        raise UserError(
            f"{path}: point {worst + 2} is at t = {drawn.times[worst + 1]:g}, not after"
            f" {drawn.times[worst]:g}; times must increase"
        )
    speeds = np.linalg.norm(np.diff(drawn.points, axis=0), axis=1) / steps
    if speeds.max() > FASTEST:
        worst = int(speeds.argmax())
        raise UserError(
            f"{path}: from point {worst + 1} to {worst + 2} the speed is {speeds.max():.1f} m/s;"
            f" at most {FASTEST:g} m/s can be gone"
        )


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

    def swaying(self, sway: np.ndarray) -> "TimedPath":
        """The same, its headings swaying about the way by radians a second [T]: less where it is
        slow, not at its ends."""
        pace = np.linalg.norm(np.gradient(self.points, axis=0), axis=1)
        swayed = np.cumsum(sway * pace / max(pace.max(), 1e-9)) / self.fps
        swayed -= np.linspace(swayed[0], swayed[-1], len(self))
        return replace(self, headings=self.headings + swayed)

    def trajectory(self, phase: np.ndarray | None = None) -> MotionTrajectory:
        """The same of an upright pelvis at its height at rest; phase: unwrapped bars [T]."""
        position = np.insert(self.points, 1, REST_PELVIS_HEIGHT, axis=1)
        turns = yaw_quaternion(torch.as_tensor(self.headings)).numpy()
        bars = np.zeros(len(self)) if phase is None else phase
        return MotionTrajectory.from_pose(position, turns, bars, fps=self.fps)

    def constraint(self) -> Constraint:
        """Forward, lateral and turning velocity are known, T frames; all else is free."""
        given = Constraint.free(len(self))
        given.values[:, ROOT_ROW] = to_root(self.trajectory())
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
        count = moments[-1] * fps  # of a short way none is lost: it would be faster than asked
        count = math.ceil(count) if seconds is None and count < fps else round(count)
        frames = np.linspace(0, moments[-1], max(2, count + 1))
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
    return np.asarray(np.concatenate(([0.0], np.cumsum(steps))) / steps.sum())


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
    smooth = smoothed(longer, ROUNDING * (len(dense) - 1) / length, mode="symmetric")
    return smooth[width : width + len(dense)], at


def _moments(line: np.ndarray, speed: float) -> np.ndarray:
    """Seconds [S] at which each sample is passed."""
    steps = np.maximum(np.linalg.norm(np.diff(line, axis=0), axis=1), 1e-9)  # S-1
    angles = np.unwrap(np.arctan2(*np.diff(line, axis=0).T))
    bend = np.abs(np.gradient(angles)) / steps if len(steps) > 1 else np.zeros(1)
    bend = smoothed(bend, 5)
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
    return np.asarray(stretched)


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
    smooth = smoothed(headings, width)
    while np.abs(np.diff(smooth)).max() * fps > FASTEST_TURN and width < len(headings):
        width *= 1.25
        smooth = smoothed(headings, width)
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


STANDING = 0.25  # m/s; a prompt that moves less has no way of going
WALK_RATIO = 0.0062  # metres of a step by steps a minute, nearly constant (Sekiya & Nagasaki 1998)
SWAY_SMOOTHING = 0.4  # seconds, standard deviation: what is slower is the way it goes, not a step


def along_path(
    generator: TextToMotion,
    timeline: Timeline,
    drawn: DrawnPath,
    sampling: Sampling,
    *,
    seconds: float | None = None,
    foot_lock: bool | None = None,
) -> ControlledMotion:
    """A motion along a path.

    Args:
        generator: trained.
        timeline: one text, and it takes as long as the path; or several, and the path takes as
            long as they.
        drawn: the path.
        sampling: how.
        seconds: how long it takes; None = as long as the prompt's own speed says.
        foot_lock: None = the model's own.

    Raises:
        UserError: the path is too long for the seconds.

    Returns:
        errors: path_mean, path_max: metres from where the pelvis is to be in each frame; line_mean,
            line_max: from the nearest point of the line as drawn; seconds, length, speed: of the
            path.
    """
    fps = generator.card.fps
    speed, facing, *_, stands = natural_gait(generator, timeline.passages[0], sampling)
    alone = len(timeline.passages) == 1 and not timeline.parts
    if not alone:
        seconds = (timeline.num_frames - 1) / fps
    path = time_path(drawn, fps=fps, speed=speed, seconds=seconds, facing=facing)
    if not alone and len(path) != timeline.num_frames:
        raise UserError(
            f"the path takes {len(path) / fps:g} s and the texts {timeline.num_frames / fps:g} s;"
            " give both the same length"
        )
    if alone:
        timeline = Timeline((replace(timeline.passages[0], frames=len(path)),))
    if drawn.headings is None:
        free = make_timeline(generator, replace(timeline, parts=()), sampling)
        path = path.swaying(natural_sway(free, fps))
    given = path.constraint()
    features = make_timeline(
        generator,
        timeline,
        sampling,
        constraint=lambda start, stop: given.window(start, stop, fps=fps),
    )
    x, z = path.points[0].tolist()
    motion = generator.post_processor(
        features,
        given.known,
        text=timeline.text,
        place=Place(x, z, float(path.headings[0])),
        foot_lock=foot_lock,
        carried=True,
    )
    error = path_error(motion, path, drawn)
    errors = {f"path_{name}": value for name, value in vars(error).items()}
    walked = {"seconds": len(path) / fps, "length": drawn.length, "speed": speed}
    line = f"prompt {timeline.text!r} goes nowhere by itself; the path leads it all the same"
    warning = line if alone and stands and drawn.length > 1.0 else None
    if warning:
        log.warning("%s", warning)
    return ControlledMotion(motion, errors | walked, warning)


class Gait(NamedTuple):
    """How a body goes that nobody directs.

    Attributes:
        speed: m/s.
        facing: radians from its way to its heading, a multiple of a quarter turn: a prompt may say
            backward or sideways.
        turning: radians a second, positive to the left.
        height: metres of the pelvis when it has begun.
        stands: whether it goes nowhere; its speed is then that of a walk.
    """

    speed: float
    facing: float
    turning: float
    height: float
    stands: bool = False


def natural_gait(generator: TextToMotion, passage: Passage, sampling: Sampling) -> Gait:
    """That of a passage's text."""
    (features,) = stream_features(generator, [replace(passage, frames=90)], sampling)
    root = features[:, ROOT_ROW].numpy()  # 90 C
    ground = root[:, [FORWARD, LATERAL]]
    speed = float(np.percentile(np.hypot(*ground.T), 75))  # it may have to start first
    forward, lateral = ground.mean(0)
    turning, height = float(root[:, YAW_RATE].mean()), float(np.median(root[30:, HEIGHT]))
    if np.hypot(forward, lateral) < STANDING:
        return Gait(NATURAL, 0.0, turning, height, stands=True)
    way = float(np.round(np.arctan2(lateral, forward) / (np.pi / 2)) * (np.pi / 2))
    return Gait(speed, -way, turning, height)


def time_of_steps(steps: float, speed: float) -> float:
    """Seconds of so many steps at a natural speed, m/s."""
    return steps * math.sqrt(60 * WALK_RATIO / speed)


def natural_sway(features: Tensor, fps: float) -> np.ndarray:
    """Radians a second [T], 0 in the mean, by which the heading of a body that nobody directs
    sways about its way with each step. Without it a led pelvis does not turn with its legs."""
    rate = features[:, ROOT_ROW, YAW_RATE].numpy()
    sway = rate - smoothed(rate, SWAY_SMOOTHING * fps)
    return np.asarray(sway - sway.mean())


# ---------------------------------------------------------------- a heading alone


def turned(
    degrees: float, fps: float, seconds: float | None = None, rest: float = TURN_REST
) -> Constraint:
    """A heading that turns by so many degrees, positive to the left, in so many seconds or at
    TURN_SPEED, of which `rest` seconds before and after do not turn, or half of all."""
    if seconds is None:
        seconds = max(abs(degrees) / TURN_SPEED, 1.0) + 2 * rest
    rest = round(min(rest, seconds / 4) * fps)
    moving = max(round(seconds * fps) - 2 * rest, 1)
    way = np.linspace(0, 1, moving + 1)
    heading = np.radians(degrees) * (3 * way**2 - 2 * way**3)  # [moving + 1]
    given = Constraint.free(moving + 2 * rest)
    rate = torch.zeros(len(given))
    rate[rest : rest + moving] = torch.as_tensor(np.diff(heading) * fps, dtype=torch.float32)
    given.values[:, ROOT_ROW, YAW_RATE] = rate
    given.known[:, ROOT_ROW, YAW_RATE] = True
    return given


def on_the_spot(given: Constraint) -> Constraint:
    """A motion whose place is known, a led turn's from where it begins: who walked has come to a
    stop."""
    turning = torch.nonzero(given.values[:, ROOT_ROW, YAW_RATE])
    first = int(turning[0, 0]) if len(turning) else 0
    given.values[first:, ROOT_ROW, [FORWARD, LATERAL]] = 0.0
    given.known[first:, ROOT_ROW, [FORWARD, LATERAL]] = True
    return given


def circled(degrees: Sequence[float], fps: float, seconds: float) -> Constraint:
    """A heading that turns by so many degrees, one after the other, as fast at any moment: once
    round, a way that closes."""
    given, angles = Constraint.free(round(seconds * fps)), np.radians(degrees)
    ends = np.abs(angles).cumsum() / np.abs(angles).sum() * len(given)
    signs = np.sign(angles)[np.searchsorted(ends[:-1], np.arange(len(given)), "right")]
    rate = torch.as_tensor(signs * np.abs(angles).sum() / seconds, dtype=torch.float32)
    given.values[:, ROOT_ROW, YAW_RATE] = rate
    given.known[:, ROOT_ROW, YAW_RATE] = True
    return given
