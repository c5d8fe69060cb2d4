"""Contacts: which feet stand, where, and how far each frame's foot is from there.

A body on a path that is not its own (a dancer pinned to a song's trajectory) slides more than a
planted foot can make up for; where a leg ends, feet take steps in turn. Between two plants the
correction follows a cubic Hermite curve (Kovar et al. 2002, "Footskate cleanup", §4).

The studio has the same in `studio/src/body/contacts.js`: change both, then `npm run build` there.

Letters: T frames, N frames of a curve.
"""

import math
from dataclasses import dataclass, replace
from itertools import pairwise

import numpy as np

from ..filters import greatest, smoothed
from ..skeleton import FOOT_JOINTS, REST_FOOT_HEIGHT

MAX_HEIGHT = 0.06  # metres of the ball of the foot above its rest height
MAX_SPEED = 0.35  # m/s of the ball of the foot
THRESHOLD = 0.5  # contact above it = on the ground
MAX_CLAIM = 0.12  # metres above the standing height; a higher foot stands on nothing
AROUND_SECONDS, FLAT = 0.4, 0.01  # in which a foot comes down; metres that are flat enough
MAX_SUPPORT = 0.08  # metres; a lower foot carries the body if none other does,
MAX_VERTICAL = 0.5  # m/s, unless it rises or falls faster than this
STEEP = 0.7  # how steep a leg is, from hip to ball, that carries: up by ahead
FALL = -3.0  # m/s² of the hips, below which the body flies
# m/s of the hips from which on no foot is planted; smoothing of them.
RUNNING, PACE_SECONDS = 2.0, 0.2
MAX_GAP_SECONDS = 2 / 30  # a contact that breaks off for no longer than this goes on
MIN_PLANT_SECONDS = 3 / 30  # a shorter contact is none
MIN_SWING_SECONDS = 8 / 30  # that a foot has to get from one plant to the next
SOONER_SECONDS = 12 / 30  # a foot lands sooner by so much at most, else there is a step between
BLEND_SECONDS = 9 / 30  # how long a correction fades in before, and out after, a contact
STEP_SECONDS = 8 / 30  # of a step that was put in
LIFT, SLOPE = 0.1, 0.1  # metres that a foot is lifted on its way, at most and for each metre
SOFT = 0.01  # metres around which that lift sets in
GIVE = 0.05  # m/s that a standing foot moves over the floor, on average, at most
ROLL = 0.005  # metres that the ball of a standing foot may be above its standing height
MAX_DRAG = 0.22  # metres that a planted foot may be from where it was; further off it steps
MAX_SLOPE = 2.5  # m/s at which a correction may start from a plant
UNDER = (0.0, 0.5, 1.0)  # shares of the way from where a foot was to below its hip
SWING = 150.0  # m/s² with which a foot gets from one plant to the next, at most
MAX_REACH = 0.94  # metres from the hip to the ball of a planted foot, leg stretched and heel up
ROUNDING = 1e-9  # of a mean in metres, however it is summed


def detect_contacts(positions: np.ndarray, fps: float) -> np.ndarray:
    """Contacts [T,2] float32 (left, right) of joint positions [T,22,3] on a floor at y = 0.

    A foot is in contact while its ball is low and slow; single frames are voted down by their
    neighbours.
    """
    balls = positions[:, [ball for _, ball in FOOT_JOINTS]]  # T 2 3
    steps = np.diff(balls, axis=0, append=balls[-1:]) * fps
    if len(steps) > 1:
        steps[-1] = steps[-2]
    low = balls[..., 1] < REST_FOOT_HEIGHT + MAX_HEIGHT
    slow = np.linalg.norm(steps, axis=-1) < MAX_SPEED
    contact = (low & slow).astype(np.float32)
    padded = np.pad(contact, ((1, 1), (0, 0)), mode="edge")
    votes = padded[:-2] + padded[1:-1] + padded[2:]
    return np.asarray(votes >= 2, dtype=np.float32)


def carrying(balls: np.ndarray, hips: np.ndarray) -> np.ndarray:
    """Which legs [T,2] go down to the floor. Who lies, or sits on it, stands on no foot; and held
    in a push-up, a straight leg that is made a little shorter has its knee in the floor."""
    legs = hips - balls
    return np.asarray(legs[..., 1] > STEEP * np.hypot(legs[..., 0], legs[..., 2]))


def grounding(balls: np.ndarray, hips: np.ndarray, kept: np.ndarray, fps: float) -> np.ndarray:
    """What brings both feet down, or up, to the floor [T,2,3]: as much as the lower one is off it.

    A path can carry a pelvis higher or lower than the legs below it were made for. The lowest of
    half a second either way counts, so that steps and jumps stay; further off, nobody stands.
    """
    carries = carrying(balls, hips).any(1)
    low = (balls[..., 1] - REST_FOOT_HEIGHT).min(1)
    low = -greatest(-low, 2 * round(AROUND_SECONDS * fps) + 1)
    low = np.sign(low) * (np.abs(low) - FLAT).clip(min=0)
    low *= np.clip(2 - np.abs(low) / MAX_CLAIM, 0, 1) * carries
    free = 1.0 - greatest(kept.astype(float), 2 * round(0.2 * fps) + 1)
    off = smoothed(low[:, None] * free, 0.1 * fps)
    found = np.zeros_like(balls)
    found[..., 1] = np.where(kept, 0.0, -off)
    return found


def standing(balls: np.ndarray, hips: np.ndarray, contacts: np.ndarray, fps: float) -> np.ndarray:
    """Which feet [T,2] carry the body: those that claim to, else the lower one if it is low.

    Nothing carries a body whose hips fall as a thrown thing does, and a foot that moves up or down
    fast is landing or swinging.
    """
    height = balls[..., 1] - REST_FOOT_HEIGHT  # T 2
    carries = carrying(balls, hips)
    claimed = (contacts > THRESHOLD) & (height < MAX_CLAIM) & carries
    if len(balls) < 2:
        return np.asarray(claimed)
    vertical = np.abs(np.gradient(height, axis=0)) * fps
    waist = smoothed(hips[..., 1].mean(1), 0.05 * fps)
    flies = np.gradient(np.gradient(waist)) * fps**2 < FALL
    low = (height < MAX_SUPPORT) & (vertical < MAX_VERTICAL) & ~flies[:, None] & carries
    lower = np.arange(2) == height.argmin(1)[:, None]
    return np.asarray(claimed | (~claimed.any(1, keepdims=True) & low & lower))


def running(hips: np.ndarray, fps: float) -> np.ndarray:
    """In which frames [T] feet are left alone, as the body runs: planted, those of captured runs
    slide more and leave the floor less (docs/experiments.md, section 44)."""
    if len(hips) < 2:
        return np.zeros(len(hips), dtype=bool)
    way = np.gradient(hips[..., [0, 2]].mean(1), axis=0) * fps
    pace = smoothed(np.hypot(*way.T), PACE_SECONDS * fps)
    return np.asarray(pace >= RUNNING)


def contact_runs(contact: np.ndarray, max_gap: int) -> list[tuple[int, int]]:
    """First and past-the-last frame of each contact in bool [T]; short gaps are bridged."""
    edges = np.flatnonzero(np.diff(np.concatenate(([0], contact.astype(int), [0]))))
    runs: list[tuple[int, int]] = []
    for start, stop in zip(edges[::2].tolist(), edges[1::2].tolist(), strict=True):
        if runs and start - runs[-1][1] <= max_gap:
            runs[-1] = (runs[-1][0], stop)
        else:
            runs.append((start, stop))
    return runs


@dataclass(frozen=True, eq=False)
class Plant:
    """A foot that stands on `point` [3] in frames [start, stop): a footplant."""

    start: int
    stop: int
    point: np.ndarray


def foot_shifts(
    balls: np.ndarray,
    hips: np.ndarray,
    contacts: np.ndarray,
    fps: float,
    kept: np.ndarray | None = None,
) -> tuple[np.ndarray, np.ndarray]:
    """How far the ball of each foot has to move [T,2,3] in metres, and whether it stands [T,2].

    Args:
        balls: world positions of the balls of both feet [T,2,3], metres.
        hips: of the hips above them [T,2,3].
        contacts: [T,2] in [0, 1], as the motion claims.
        fps: frames per second.
        kept: legs [T,2] bool that must stay as they are; a foot that stands on goes on standing
            where it was kept.
    """
    kept = np.zeros((len(balls), 2), dtype=bool) if kept is None else kept
    shifts = grounding(balls, hips, kept, fps)
    balls = balls + shifts
    stands, runs = standing(balls, hips, contacts, fps), running(hips, fps)[:, None]
    planted = stands & runs
    for side, plants in enumerate(plant_spans(balls, hips, stands & ~runs, fps, kept)):
        treads = planted[:, side]  # running
        shifts[:, side] += corrections(balls[:, side], plants, kept[:, side], treads, fps)
        for plant in plants:
            planted[plant.start : plant.stop, side] = True
    return shifts, planted


# ---------------------------------------------------------------- where


def plant_spans(
    balls: np.ndarray, hips: np.ndarray, stands: np.ndarray, fps: float, kept: np.ndarray
) -> tuple[list[Plant], list[Plant]]:
    """The plants of the left and of the right foot, in order; where one foot must leave before the
    other was to land, the other one lands sooner, or steps are put between.

    Who wants other times changes those found here: within `_Planner` each moves the next one, too.

    Args:
        balls: [T,2,3].
        hips: [T,2,3].
        stands: [T,2] bool.
        fps: frames per second.
        kept: [T,2] bool, legs that stay as they are.
    """
    free = np.asarray(stands.any(1) & ~kept.any(1))
    planner = _Planner(balls, hips, free, fps, kept)
    for start, stop, side in _standing_spans(balls, stands, fps, kept):
        planner.stand(start, stop, side)
    planner.step_on(len(balls))
    return planner.found


class _Planner:
    """Takes the times that feet stand, in order, and finds where and how long they can."""

    def __init__(
        self, balls: np.ndarray, hips: np.ndarray, free: np.ndarray, fps: float, kept: np.ndarray
    ) -> None:
        self.balls, self.hips, self.free, self.fps, self.kept = balls, hips, free, fps, kept
        self.shortest = min(round(MIN_PLANT_SECONDS * fps), len(balls))
        self.swing, self.sooner = round(MIN_SWING_SECONDS * fps), round(SOONER_SECONDS * fps)
        self.found: tuple[list[Plant], list[Plant]] = ([], [])
        self.until, self.last = 0, 0  # some foot stands up to here; the foot that stood last

    def stand(self, start: int, stop: int, side: int) -> None:
        """A foot is to stand in frames [start, stop)."""
        self.step_on(start, side)
        if self._gap(start) and start - self.until <= self.sooner:
            start = max(self._ready(side), min(start, self.until))
        self._plant(start, stop, side)

    def step_on(self, start: int, side: int | None = None) -> None:
        """Steps until `start`, when `side` is to land (None = nobody is), where nobody stands."""
        while self._gap(start) and (start - self.until > self.sooner or side in (None, self.last)):
            before, between = self.until, 1 - self.last
            end = start - self.swing if between == side else start
            self._plant(self._ready(between), end, between)
            if self.until == before:
                break

    def _gap(self, start: int) -> bool:
        """Whether the body is carried, by nobody so far, until `start`."""
        return self.until < start and bool(self.free[self.until : start].all())

    def _ready(self, side: int) -> int:
        """When a foot may land that has to get here from where it stood."""
        before = self.found[side][-1].stop + self.swing if self.found[side] else 0
        return max(self.until, before)

    def _plant(self, start: int, stop: int, side: int) -> None:
        """Plant a foot as long as its leg reaches."""
        ball, hip = self.balls[:, side], self.hips[:, side]
        fixed = np.flatnonzero(self.kept[start:stop, side])
        if len(fixed):
            point = _on_floor(ball[start + _border(fixed)])
            first, last = _reached(point, hip, start, stop)
        elif stop - start < self.shortest:
            return
        else:
            point, first, last = _in_reach(ball, hip, start, stop, self.shortest)
        if not len(fixed):
            first = self._landing(point, first, side)
        if last - first >= self.shortest:
            self.found[side].append(Plant(first, last, point))
            if last > self.until:
                self.until, self.last = last, side

    def _landing(self, point: np.ndarray, first: int, side: int) -> int:
        """When a foot that is to land in frame `first` does: it has to get there from its last
        plant, and leaves that sooner if it can, else it lands later."""
        if not self.found[side]:
            return first
        before = self.found[side][-1]
        away = float(np.linalg.norm(point - before.point))
        swing = math.ceil(math.sqrt(6 * away / SWING) * self.fps)
        leaves = min(first - swing, before.stop)
        if leaves == before.stop:
            return first
        kept = self.kept[max(leaves, 0) : before.stop, side].any()
        if kept or leaves - before.start < self.shortest:
            return before.stop + swing
        self.found[side][-1] = replace(before, stop=leaves)
        return first


def _standing_spans(
    balls: np.ndarray, stands: np.ndarray, fps: float, kept: np.ndarray
) -> list[tuple[int, int, int]]:
    """First and past-the-last frame and side of each time that a foot stands, by their start."""
    runs = []
    for side in (0, 1):
        for start, stop in _bridged_runs(stands[:, side], balls[:, side], fps):
            path = balls[start:stop, side]
            whole = bool(kept[start:stop, side].any())
            pieces = [(start, stop)] if whole else _steps(path, start, fps, 0.5 * side)
            runs += [(first, last, side) for first, last in pieces]
    return sorted(runs)


def _bridged_runs(stands: np.ndarray, ball: np.ndarray, fps: float) -> list[tuple[int, int]]:
    """Runs of bool [T]; a short gap is bridged, but where the ball [T,3] got far in it."""
    runs: list[tuple[int, int]] = []
    for start, stop in contact_runs(stands, 0):
        last = runs[-1][1] if runs else -1
        near = last > 0 and np.linalg.norm((ball[start] - ball[last - 1])[[0, 2]]) <= MAX_DRAG
        if near and start - last <= round(MAX_GAP_SECONDS * fps):
            runs[-1] = (runs[-1][0], stop)
        else:
            runs.append((start, stop))
    return runs


def _border(fixed: np.ndarray) -> int:
    """The kept frame of a run that the others follow: the last of a beginning, else the first."""
    return int(fixed[-1]) if fixed[0] == 0 else int(fixed[0])


def _steps(path: np.ndarray, start: int, fps: float, phase: float) -> list[tuple[int, int]]:
    """A run [N,3] as it is, or cut into equally long drags with a step's time between them."""
    ground = path[:, [0, 2]]
    if np.linalg.norm(ground - ground.mean(0), axis=1).max() <= MAX_DRAG:
        return [(start, start + len(path))]
    smooth = smoothed(ground, 0.1 * fps)
    way = np.concatenate(([0.0], np.cumsum(np.linalg.norm(np.diff(smooth, axis=0), axis=1))))
    step = round(STEP_SECONDS * fps)
    number = min(int(np.ceil(way[-1] / (2 * MAX_DRAG))), len(path) // (2 * step))
    if number < 2:
        return [(start, start + len(path))]
    marks = (np.arange(1, number + 1) - phase) / number
    cuts = np.searchsorted(way, marks[marks < 1 - 1e-9] * way[-1])
    half = step // 2
    edges = [-half, *cuts.tolist(), len(path) + half]
    pairs = [(a + half, b - half) for a, b in pairwise(edges)]
    return [(start + max(a, 0), start + min(b, len(path))) for a, b in pairs if b > a]


def _on_floor(point: np.ndarray) -> np.ndarray:
    return np.array([point[0], REST_FOOT_HEIGHT, point[2]])


def _in_reach(
    ball: np.ndarray, hip: np.ndarray, start: int, stop: int, shortest: int
) -> tuple[np.ndarray, int, int]:
    """Where a foot stands, and the first frame and the one past the last in which its leg reaches.

    The middle of its way, or nearer to below the hip; of a way that is too long, the longest
    beginning: a foot lands when it is to land, and leaves sooner. No frames where no leg reaches.
    """
    sums = [np.concatenate(([0.0], np.cumsum(way[start:stop, axis]))).tolist()
            for axis in (0, 2) for way in (ball, hip)]  # fmt: skip
    hips, far = hip[start:stop].tolist(), 0  # in frame `far` no leg reached the last time

    def fails_there(first: int, last: int, share: float) -> bool:
        """Whether the leg is too short in that frame again: far sooner known than of all frames."""
        if not first <= far < last:
            return False
        own = 1 - share
        x, z = (
            (own * (foot[last] - foot[first]) + share * (under[last] - under[first]))
            / (last - first)
            for foot, under in (sums[:2], sums[2:])
        )
        away = (hips[far][0] - x, hips[far][1] - REST_FOOT_HEIGHT, hips[far][2] - z)
        return math.hypot(*away) > MAX_REACH + ROUNDING

    for first in range(start, stop - shortest + 1):
        for last in range(stop, first + shortest - 1, -1):
            for share in UNDER:
                if fails_there(first - start, last - start, share):
                    continue
                foot, under = ball[first:last].mean(0), hip[first:last].mean(0)
                point = _on_floor((1 - share) * foot + share * under)
                away = np.linalg.norm(hip[first:last] - point, axis=1)
                if away.max() <= MAX_REACH:
                    return point, first, last
                far = first - start + int(away.argmax())
    return _on_floor(ball[start]), start, start


def _reached(point: np.ndarray, hip: np.ndarray, start: int, stop: int) -> tuple[int, int]:
    """The frames around the nearest one in which a leg gets to the point."""
    away = np.linalg.norm(hip[start:stop] - point, axis=1)
    nearest = int(away.argmin())
    far = np.flatnonzero(away > MAX_REACH)
    before, after = far[far < nearest], far[far > nearest]
    if away[nearest] > MAX_REACH:
        return start, start
    first = start + (int(before[-1]) + 1 if len(before) else 0)
    return first, start + (int(after[0]) if len(after) else stop - start)


# ---------------------------------------------------------------- how far


def corrections(
    ball: np.ndarray, plants: list[Plant], kept: np.ndarray, treads: np.ndarray, fps: float
) -> np.ndarray:
    """Where the ball of a foot [T,3] has to move, [T,3] in metres; zero = nothing to do. Between
    plants it is lifted, unless it `treads` [T] bool on the floor there, running."""
    shift, known = np.zeros_like(ball), kept.copy()
    lift = np.zeros(len(ball))
    for plant in plants:
        own = plant.point - ball[plant.start : plant.stop]
        if not kept[plant.start : plant.stop].any():  # there the foot stands where it was kept
            own += _give(ball[plant.start : plant.stop], fps)
        path = ball[plant.start : plant.stop, 1]
        own[:, 1] = path.clip(REST_FOOT_HEIGHT, REST_FOOT_HEIGHT + ROLL) - path
        shift[plant.start : plant.stop] = own
        known[plant.start : plant.stop] = True
    shift[kept] = 0
    for before, after in pairwise(plants):
        if treads[before.stop : after.start].any():
            continue
        rise = np.linspace(0, np.pi, after.start - before.stop + 2)[1:-1]
        way = np.linalg.norm(after.point - before.point)
        lift[before.stop : after.start] = min(LIFT, SLOPE * way) * np.sin(rise) ** 2
    shift = _bridged(shift, known, round(BLEND_SECONDS * fps), fps)
    missing = lift - (ball[:, 1] + shift[:, 1] - REST_FOOT_HEIGHT)
    soft = np.clip((missing + SOFT) / (2 * SOFT), 0, 1) ** 2 * SOFT  # sets in without a corner
    raised = np.where(missing < SOFT, soft, missing)
    shift[:, 1] += np.where(known | (lift == 0), 0.0, raised * np.minimum(lift / SOFT, 1))
    shift[:, 1] += _above_floor(ball[:, 1] + shift[:, 1], known, fps)
    return shift


def _give(path: np.ndarray, fps: float) -> np.ndarray:
    """What a planted ball keeps of its own way over the floor [N,3], no faster than GIVE on the
    average.

    A foot that rolls from heel to toe, or turns, moves a little; captured ones do (FIELD, foot
    slide), and a foot that does not looks nailed down.
    """
    own = path - path.mean(0)
    own[:, 1] = 0.0
    speed = np.linalg.norm(np.diff(own, axis=0), axis=1).sum() * fps / max(len(path) - 1, 1)
    return np.asarray(own * min(1.0, GIVE / max(speed, 1e-9)))


def _bridged(shift: np.ndarray, known: np.ndarray, blend: int, fps: float) -> np.ndarray:
    """Corrections [T,3] with the frames that are not known filled in, smoothly."""
    shift = shift.copy()
    limit = MAX_SLOPE / fps
    edges = np.flatnonzero(np.diff(np.concatenate(([1], known.astype(int), [1]))))
    for start, stop in zip(edges[::2].tolist(), edges[1::2].tolist(), strict=True):
        ends = []
        for at, inner in ((start - 1, start - 2), (stop, stop + 1)):
            here = shift[at] if 0 <= at < len(shift) else np.zeros(3)
            slope = np.zeros(3)
            if min(at, inner) >= 0 and max(at, inner) < len(shift) and known[inner]:
                slope = (shift[at] - shift[inner]) * (at - inner)
            ends.append((here, slope.clip(-limit, limit)))
        (left, left_slope), (right, right_slope) = ends
        frames = stop - start + 1
        along = np.arange(1, frames)
        inside = start > 0 and stop < len(shift)
        if inside and frames <= 2 * blend:
            shift[start:stop] = hermite(left, right, left_slope, right_slope, frames)[1:-1]
            continue
        zero = np.zeros(3)
        if start > 0:
            out = hermite(left, zero, left_slope, zero, blend)
            shift[start:stop] += out[np.minimum(along, blend)]
        if stop < len(shift):
            into = hermite(zero, right, zero, right_slope, blend)
            shift[start:stop] += into[np.maximum(along - frames + blend, 0)]
    return shift


def hermite(
    left: np.ndarray, right: np.ndarray, left_slope: np.ndarray, right_slope: np.ndarray, num: int
) -> np.ndarray:
    """The cubic [num+1,3] between two values with given slopes a frame."""
    u = (np.arange(num + 1) / num)[:, None]
    return np.asarray(
        (2 * u**3 - 3 * u**2 + 1) * left
        + (u**3 - 2 * u**2 + u) * num * left_slope
        + (3 * u**2 - 2 * u**3) * right
        + (u**3 - u**2) * num * right_slope
    )


def _above_floor(height: np.ndarray, known: np.ndarray, fps: float) -> np.ndarray:
    """What lifts a foot [T] that moves to its standing height, faded in and out."""
    depth = np.where(known, 0.0, (REST_FOOT_HEIGHT - height).clip(min=0))
    if not depth.any():
        return np.zeros_like(height)
    width = 2 * round(0.1 * fps) + 1
    smooth = smoothed(greatest(depth, width), width / 6)
    return np.where(known, 0.0, smooth)
