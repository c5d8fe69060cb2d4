"""What a motion does, read off its joints: travel, turning, hands, feet, crouches, flights.

T frames. Positions by forward kinematics on the canonical skeleton; nothing learned. Left comes
before right in every pair. Then kinematic definitions of actions: thresholds lie between what the
synthetic source and real mocap do for them and for others; a frozen pose and noise fail every one.
"""

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from ..motion.features import ahead_and_left, heading_frame, headings, motion_heading
from ..motion.motion import Motion
from ..motion.skeleton import JOINT_INDEX, REST_PELVIS_HEIGHT, canonical_skeleton
from ..tensors import torch

Array = np.ndarray
Pair = tuple[float, float]
Figures = dict[str, Any]  # some of the fields of `Measurements`

_OFFSETS = canonical_skeleton().offsets
ARM_LENGTH = float(
    np.abs(_OFFSETS[JOINT_INDEX["l_elbow"], 0]) + np.abs(_OFFSETS[JOINT_INDEX["l_wrist"], 0])
)
HAND_DOWN = 0.15  # metres above the pelvis, at most, of a hand at rest
HAND_UP = 0.1  # metres by which one goes up, at least, of arms that do something
AT_REST = 3  # frames at either end
_TRUNK = [JOINT_INDEX[name] for name in ("spine1", "spine2", "spine3", "neck", "head")]
STANDING = 0.92 * (REST_PELVIS_HEIGHT + float(_OFFSETS[_TRUNK, 1].sum()))  # metres, of the head
IN_PLACE = 0.6  # metres that a body may sway and still stay where it is
STEADY = 0.1, math.radians(15)  # metres and radians at the end from the beginning, at most


def at_rest(motion: Motion) -> bool:
    """Whether both hands hang at the beginning and at the end."""
    ends = np.r_[:AT_REST, -AT_REST:0]
    return bool((_hand_heights(motion)[ends] < HAND_DOWN).all())


def ends_at_rest(motion: Motion) -> bool:
    """Whether a body stands upright in its last frames, hands hanging."""
    height = motion.positions()[-AT_REST:, JOINT_INDEX["head"], 1].min()
    return bool(height > STANDING) and bool((_hand_heights(motion)[-AT_REST:] < HAND_DOWN).all())


def arms_alone(motion: Motion) -> bool:
    """Whether the hands go up and down while the feet stand and the head keeps its height."""
    joints = motion.positions().astype(np.float64)
    feet = joints[:, [JOINT_INDEX["l_ankle"], JOINT_INDEX["r_ankle"]]]
    stands = np.ptp(feet, axis=0).max() < 0.2 and np.ptp(joints[:, JOINT_INDEX["head"], 1]) < 0.15
    return bool(stands) and bool(np.ptp(_hand_heights(motion), axis=0).max() > HAND_UP)


def stays(motion: Motion) -> bool:
    """Whether a body ends where it began, facing the same way, and never left its place."""
    ground, ways = motion.root_position[:, [0, 2]].astype(np.float64), motion_heading(motion)
    apart, turned = STEADY
    back = np.linalg.norm(ground[-1] - ground[0]) < apart and abs(ways[-1] - ways[0]) < turned
    return bool(back) and bool(np.ptp(ground, axis=0).max() < IN_PLACE)


def rests_in_place(motion: Motion) -> bool:
    """Whether a body stays on its legs and in its place, from hanging arms to hanging arms."""
    x, height, z = motion.root_position.astype(np.float64).T
    stays = max(np.ptp(x), np.ptp(z)) < IN_PLACE and height.min() > 0.6 * REST_PELVIS_HEIGHT
    return bool(stays) and at_rest(motion)


def _hand_heights(motion: Motion) -> Array:
    """Of the wrists above the pelvis [T, 2]."""
    joints = motion.positions()
    wrists = joints[:, [JOINT_INDEX["l_wrist"], JOINT_INDEX["r_wrist"]], 1]
    return np.asarray(wrists - joints[:, :1, 1])


@dataclass(frozen=True)
class Measurements:
    """Figures of one motion; metres, seconds, radians."""

    seconds: float  # length of the motion
    angular_speed: float  # rad/s: how fast local rotations change, mean over joints and frames
    upright: float  # share of frames with the pelvis at a bodily height and its up axis upwards
    forward: float  # distance travelled in the momentary heading frame
    lateral: float  # the same, + = left
    forward_net: float  # net displacement in the frame of the first heading
    lateral_net: float
    forward_speed: float  # the two distances over the time spent moving
    lateral_speed: float
    speed: float  # mean ground speed while moving
    cruise: float  # the speed it settles at (70th percentile)
    stride: float  # half the range of the distance between the ankles along the way of travel
    yaw: float  # heading gained, + = left
    hand_high: Pair  # seconds each wrist spends above its shoulder
    hand_peak: Pair  # how far each wrist gets above its shoulder, arm lengths (95th percentile)
    hand_travel: Pair  # metres each wrist travels relative to the chest
    hand_swings: tuple[int, int]  # times each raised wrist changes its direction of travel
    foot_peak: Pair  # greatest height of each ankle above the other one
    kicks: tuple[int, int]  # times each foot is kicked up in front
    punches: tuple[int, int]  # times each fist shoots forward to a stretched arm
    claps: int  # times the hands meet in front of the body
    slashes: int  # times both hands, held together, sweep far in a third of a second
    bows: int  # times the chest bends forward and comes up again
    calls: int  # times it does so with a hand at the face
    squats: int  # times the pelvis goes deep and comes up again with the feet on the ground
    jumps: int  # times both feet leave the ground together, the pelvis above standing height
    pelvis_low: float  # lowest pelvis height over standing height
    flight: float  # seconds with both feet clear of the ground


@dataclass(frozen=True)
class _Tracks:
    """Smoothed curves that the figures are read from."""

    fps: float
    joints: Array  # T K 3, world
    heading: Array  # T, unwrapped and smoothed
    chest: Array  # T 3 3, world rotation of the chest
    body: Array  # T K 3, joints seen from the pelvis in the heading frame

    def joint(self, name: str) -> Array:
        return np.asarray(self.joints[:, JOINT_INDEX[name]])

    def seen(self, name: str) -> Array:
        return np.asarray(self.body[:, JOINT_INDEX[name]])


def smooth(values: Array, frames: int) -> Array:
    """Centred moving average over the first axis, `frames` long; the ends are repeated."""
    frames = max(min(frames, len(values)) // 2 * 2 + 1, 1)
    half = frames // 2
    padding = [(half + 1, half)] + [(0, 0)] * (values.ndim - 1)
    total = np.cumsum(np.pad(values, padding, mode="edge"), axis=0)
    return np.asarray((total[frames:] - total[:-frames]) / frames)


def count_peaks(values: Array, high: float, low: float) -> int:
    """Times a curve [T] rises above `high`; it must have been below `low` before each time."""
    count, armed = 0, not len(values) or bool(values[0] <= high)
    for value in values:
        if armed and value > high:
            count, armed = count + 1, False
        elif value < low:
            armed = True
    return count


def _tracks(motion: Motion) -> _Tracks:
    positions, rotations = motion.kinematics()
    heading = headings(torch.as_tensor(rotations[:, 0])).numpy().astype(np.float64)
    heading = smooth(heading, round(0.5 * motion.fps))
    joints = smooth(positions.astype(np.float64), round(0.1 * motion.fps))
    chest = rotations[:, JOINT_INDEX["spine3"]].astype(np.float64)
    return _Tracks(motion.fps, joints, heading, chest, heading_frame(joints, heading))


def measure(motion: Motion) -> Measurements:
    """All figures of a motion of at least two frames."""
    tracks = _tracks(motion)
    return Measurements(
        seconds=motion.seconds,
        **_credibility(motion),
        **_travel(tracks),
        **_hands(tracks),
        **_arms_at_work(tracks),
        **_feet(tracks),
        **_heights(tracks),
    )


def hand_swings(motion: Motion) -> tuple[int, int]:
    """Times each raised wrist changes its direction of travel: left, right."""
    left, right = _hands(_tracks(motion))["hand_swings"]
    return left, right


def _credibility(motion: Motion) -> Figures:
    q = motion.quaternions.astype(np.float64)
    cosine = np.clip(np.abs((q[1:] * q[:-1]).sum(-1)), 0.0, 1.0)
    angular_speed = 2 * np.arccos(cosine).mean() * motion.fps
    w, x, y, z = q[:, 0].T
    up = (1 - 2 * (x * x + z * z)) / np.maximum(w * w + x * x + y * y + z * z, 1e-9)
    height = motion.root_position[:, 1]
    bodily = (up > 0.3) & (height > 0.2) & (height < 2.0)
    return {"angular_speed": float(angular_speed), "upright": float(bodily.mean())}


def _travel(tracks: _Tracks) -> Figures:
    path = smooth(tracks.joints[:, 0], round(0.3 * tracks.fps))
    step = np.diff(path, axis=0)
    heading = tracks.heading
    forward, lateral = ahead_and_left(step, heading[:-1])
    ground = np.hypot(step[:, 0], step[:, 2])
    moving = ground * tracks.fps > 0.12
    seconds = max(moving.sum() / tracks.fps, 0.5)
    forward_net, lateral_net = ahead_and_left(path[-1] - path[0], heading[0])
    total = np.array([lateral.sum(), forward.sum()])
    along = total / max(float(np.hypot(*total)), 1e-6)
    apart = tracks.seen("l_ankle") - tracks.seen("r_ankle")
    apart_along = apart[:, 0] * along[0] + apart[:, 2] * along[1]
    low, high = np.percentile(apart_along, (3, 97))
    return {
        "forward": float(forward.sum()),
        "lateral": float(lateral.sum()),
        "forward_net": float(forward_net),
        "lateral_net": float(lateral_net),
        "forward_speed": float(forward[moving].sum() / seconds),
        "lateral_speed": float(lateral[moving].sum() / seconds),
        "speed": float(ground[moving].sum() / seconds),
        "cruise": float(np.percentile(ground[moving], 70) * tracks.fps) if moving.any() else 0.0,
        "stride": float(high - low) / 2,
        "yaw": float(heading[-1] - heading[0]),
    }


def _hands(tracks: _Tracks) -> Figures:
    sides = []
    for letter in "lr":
        wrist, shoulder = tracks.joint(f"{letter}_wrist"), tracks.joint(f"{letter}_shoulder")
        above = (wrist - shoulder)[:, 1] / ARM_LENGTH
        seen = tracks.seen(f"{letter}_wrist") - tracks.seen("spine3")
        figures = {
            "hand_high": float((above > 0.0).sum() / tracks.fps),
            "hand_peak": float(np.percentile(above, 95)),
            "hand_travel": float(np.linalg.norm(np.diff(seen, axis=0), axis=-1).sum()),
            "hand_swings": _swings(seen[above > -0.1]),
        }
        sides.append(figures)
    return {key: tuple(side[key] for side in sides) for key in sides[0]}


def _swings(points: Array) -> int:
    """Times `points` [N,3] change direction along one of their main axes, 6 cm or more apart."""
    if len(points) < 4:
        return 0
    centred = points - smooth(points, 31)
    _, _, axes = np.linalg.svd(centred - centred.mean(0), full_matrices=False)
    curves = (centred @ axes[:2].T).T
    return max(count_peaks(c, 0.03, -0.03) + count_peaks(-c, 0.03, -0.03) for c in curves)


def _arms_at_work(tracks: _Tracks) -> Figures:
    punches = []
    up = tracks.chest[:, :, 1]
    for letter in "lr":
        arm = tracks.joint(f"{letter}_wrist") - tracks.joint(f"{letter}_shoulder")
        reach = np.linalg.norm(arm, axis=-1) / ARM_LENGTH
        level = np.abs((arm * up).sum(-1)) < 0.6 * np.linalg.norm(arm, axis=-1)
        ahead = tracks.seen(f"{letter}_wrist") - tracks.seen(f"{letter}_shoulder")
        speed = np.gradient(reach, 1 / tracks.fps)
        fast = smooth((speed > 1.5).astype(float), round(0.4 * tracks.fps)) > 0.05
        extended = np.where(level & (ahead[:, 2] > 0.25) & fast, reach, np.minimum(reach, 0.7))
        punches.append(count_peaks(extended, 0.85, 0.72))
    left, right = tracks.joint("l_wrist"), tracks.joint("r_wrist")
    gap = np.linalg.norm(left - right, axis=-1)
    middle = (tracks.seen("l_wrist") + tracks.seen("r_wrist")) / 2
    in_front = (middle[:, 2] > 0.12) & (middle[:, 1] > 0.05)
    claps = count_peaks(np.where(in_front, -gap, -1.0), -0.17, -0.24)
    third = max(round(tracks.fps / 3), 1)
    held = smooth((gap < 0.3).astype(float), third)[third // 2 :] > 0.99  # about the sweep's middle
    swept = np.linalg.norm(middle[third:] - middle[:-third], axis=-1)
    swept = np.where(held[: len(swept)], swept, 0.0)
    faced = np.stack((np.sin(tracks.heading), np.cos(tracks.heading)), -1)
    tilt = np.degrees(np.arcsin(np.clip((up[:, [0, 2]] * faced).sum(-1), -1, 1)))
    tall = tracks.joints[:, 0, 1] > 0.83 * REST_PELVIS_HEIGHT  # else it is a squat or a jump
    tilt = np.where(tall & (_ground_speed(tracks) < 0.5), tilt, np.minimum(tilt, 25.0))
    at_face = np.zeros(len(tilt), bool)
    for wrist in (left, right):
        raised = ((wrist - tracks.joint("spine3")) * up).sum(-1) > 0
        at_face |= raised & (np.linalg.norm(wrist - tracks.joint("head"), axis=-1) < 0.45)
    return {
        "punches": tuple(punches),
        "claps": claps,
        "slashes": count_peaks(swept, 0.4, 0.2),
        "bows": count_peaks(smooth(tilt, 5), 35.0, 18.0),
        "calls": count_peaks(np.where(at_face, smooth(tilt, 5), 0.0), 40.0, 18.0),
    }


def _ground_speed(tracks: _Tracks) -> Array:
    path = smooth(tracks.joints[:, 0], round(0.3 * tracks.fps))
    return np.asarray(np.linalg.norm(np.gradient(path[:, [0, 2]], axis=0), axis=-1) * tracks.fps)


def _feet(tracks: _Tracks) -> Figures:
    left, right = tracks.joint("l_ankle"), tracks.joint("r_ankle")
    lead = (left - right)[:, 1]
    kicks = []
    for letter, height in (("l", lead), ("r", -lead)):
        ahead = tracks.seen(f"{letter}_ankle")[:, 2]
        kicked = np.where(ahead > 0.3, height, np.minimum(height, 0.2))
        kicks.append(count_peaks(kicked, 0.33, 0.25))
    return {"foot_peak": (float(lead.max()), float((-lead).max())), "kicks": tuple(kicks)}


def _heights(tracks: _Tracks) -> Figures:
    pelvis = tracks.joints[:, 0, 1]
    balls = np.stack((tracks.joint("l_foot")[:, 1], tracks.joint("r_foot")[:, 1]), -1)
    floor = np.percentile(balls.min(1), 10)
    clear = (balls - floor).min(1)
    ankles = tracks.seen("l_ankle") - tracks.seen("r_ankle")
    together = np.linalg.norm(ankles[:, 1:], axis=-1) < 0.3  # a runner's feet are further apart
    leaps = (pelvis > REST_PELVIS_HEIGHT + 0.03) & together & (_ground_speed(tracks) < 2.6)
    flying = np.where(leaps, clear, 0.0)
    standing = REST_PELVIS_HEIGHT
    grounded = np.where(clear < 0.06, standing - pelvis, 0.0)
    return {
        "squats": count_peaks(grounded, 0.27, 0.12),
        "jumps": count_peaks(flying, 0.05, 0.02),
        "pelvis_low": float(pelvis.min() / standing),
        "flight": float((clear > 0.03).sum() / tracks.fps),
    }


# ---------------------------------------------------------------- which action it is

Check = Callable[[Measurements], bool]

_MAX_ANGULAR_SPEED = 6.0  # rad/s, mean over joints; sprinting mocap has 4, white noise over 30
_MIN_ANGULAR_SPEED = 0.02
_MIN_TURN = 0.7  # radians; straight walking mocap gains at most 0.5
_MIN_STRIDE = 0.06  # metres; a gliding body does not step


def credible(m: Measurements) -> bool:
    """A body that lives: upright, neither frozen nor trembling."""
    return m.upright > 0.9 and _MIN_ANGULAR_SPEED < m.angular_speed < _MAX_ANGULAR_SPEED


def _steps(m: Measurements, distance: float, speed: float) -> bool:
    return distance > 0.3 and speed > 0.17 and m.stride > _MIN_STRIDE


def _straight(m: Measurements, sign: int) -> bool:
    way = sign * m.forward
    return _steps(m, way, sign * m.forward_speed) and abs(m.lateral) < 0.6 * way


def _sideways(m: Measurements, sign: int) -> bool:
    # Mocap called "walk left" goes diagonally, 20° and more from straight ahead.
    return _steps(m, sign * m.lateral, sign * m.lateral_speed / 0.7) and (
        sign * m.lateral > 0.25 * abs(m.forward)
    )


def _hand_up(m: Measurements, side: int) -> bool:
    return m.hand_peak[side] > -0.2 and m.hand_travel[side] > 0.15


def _one_hand(m: Measurements, side: int) -> bool:
    return _hand_up(m, side) and m.hand_peak[side] - m.hand_peak[1 - side] > 0.35


def _waves(m: Measurements) -> bool:
    highest = max((0, 1), key=lambda side: m.hand_peak[side])
    return _hand_up(m, highest) and m.hand_swings[highest] >= 4


def _runs(m: Measurements) -> bool:
    flies = m.flight > 0.05 * m.seconds
    return _straight(m, 1) and (m.cruise > 2.0 or (flies and m.cruise > 1.3))


def _stays(m: Measurements) -> bool:
    return abs(m.forward) < 0.4 and abs(m.lateral) < 0.4


def _stands(m: Measurements) -> bool:
    quiet = max(m.hand_peak) < -0.3 and abs(m.yaw) < 0.5 and m.angular_speed < 1.0
    return _stays(m) and quiet and m.pelvis_low > 0.9 and m.stride < 0.1 and m.bows == 0


_RAW: dict[str, Check] = {
    "forward": lambda m: _straight(m, 1),
    "backward": lambda m: _straight(m, -1),
    "left": lambda m: _sideways(m, 1),
    "right": lambda m: _sideways(m, -1),
    "turn-left": lambda m: m.yaw > _MIN_TURN,
    "turn-right": lambda m: -m.yaw > _MIN_TURN,
    "left-hand": lambda m: _one_hand(m, 0),
    "right-hand": lambda m: _one_hand(m, 1),
    "left-hand-too": lambda m: _hand_up(m, 0),
    "right-hand-too": lambda m: _hand_up(m, 1),
    "both-hands": lambda m: all(_hand_up(m, side) and m.hand_peak[side] > -0.15 for side in (0, 1)),
    "wave": _waves,
    "run": _runs,
    "squat": lambda m: m.squats >= 1,
    "jump": lambda m: m.jumps >= 1,
    "kick-left": lambda m: m.kicks[0] > m.kicks[1],
    "kick-right": lambda m: m.kicks[1] > m.kicks[0],
    "punch-left": lambda m: m.punches[0] > m.punches[1],
    "punch-right": lambda m: m.punches[1] > m.punches[0],
    "clap": lambda m: m.claps >= 1,
    "bow": lambda m: m.bows >= 1,
    "forward-jump": lambda m: m.forward > 0.25,
    "crouched": lambda m: m.pelvis_low < 0.82,
    "in-place": _stays,
    "stand": _stands,
}


def _of_a_body(check: Check) -> Check:
    return lambda m: credible(m) and check(m)


CHECKS: dict[str, Check] = {name: _of_a_body(check) for name, check in _RAW.items()}
"""Named yes-or-no questions to a measured motion; each also demands a credible body."""


def _travels(m: Measurements, speed: float) -> bool:
    return math.hypot(m.forward_net, m.lateral_net) > speed * m.seconds


def _within(m: Measurements, metres: float) -> bool:
    return abs(m.forward_net) < metres and abs(m.lateral_net) < metres


def _walks(m: Measurements) -> bool:
    slow = m.cruise < 2.0 and m.flight < 0.05 * m.seconds
    goes = _travels(m, 0.25) or (abs(m.yaw) > _MIN_TURN and m.cruise > 0.5)  # in a circle, too
    return slow and goes and m.stride > _MIN_STRIDE and m.pelvis_low > 0.82


def _side_steps(m: Measurements) -> bool:
    return any(_sideways(m, sign) for sign in (1, -1)) and abs(m.lateral_net) > abs(m.forward_net)


_ACTIONS: dict[str, Check] = {
    "walk": _walks,
    "run": _runs,
    "wave": _waves,
    "crouch-walk": lambda m: m.pelvis_low < 0.85 and _travels(m, 0.2),
    "side-step": _side_steps,
    "turn": lambda m: abs(m.yaw) > _MIN_TURN and _within(m, 0.6) and max(m.hand_peak) < -0.3,
    "spin": lambda m: abs(m.yaw) > 4.7 and _within(m, 0.8),
    "kick": lambda m: max(m.kicks) >= 1,
    "punch": lambda m: max(m.punches) >= 1 and not _travels(m, 0.25),
    "slash": lambda m: m.slashes >= 1,
    "call": lambda m: m.calls >= 1,
    **dict.fromkeys(("raise", "bye"), lambda m: _hand_up(m, 0) or _hand_up(m, 1)),
    **{name: _RAW[name] for name in ("squat", "jump", "clap", "bow", "stand")},
}

ACTIONS: dict[str, Check] = {name: _of_a_body(check) for name, check in _ACTIONS.items()}
"""Actions that kinematics define, or ask something of, whoever performs them in whatever style."""


def side_check(action: str, side: str, *, by_hand: bool) -> Check | None:
    """Whether an action is done with the left or right limb, or to that side; None where nobody can
    say. `by_hand`: it is done with the arms alone."""
    name = f"turn-{side}" if action == "spin" else f"{action}-{side}"
    return CHECKS.get(name) or (CHECKS.get(f"{side}-hand") if by_hand else None)


def _of_limbs(counts: Sequence[int], side: str | None) -> int:
    """Of the (left, right) limb that is named, or of both."""
    return sum({"left": counts[:1], "right": counts[1:]}.get(side or "", counts))


REPETITIONS: dict[str, Callable[[Measurements, str | None], int]] = {
    "bow": lambda m, _: m.bows,
    "clap": lambda m, _: m.claps,
    "jump": lambda m, _: m.jumps,
    "kick": lambda m, side: _of_limbs(m.kicks, side),
    "punch": lambda m, side: _of_limbs(m.punches, side),
    "squat": lambda m, _: m.squats,
}  # of the actions whose repetitions are seen


def repetitions(action: str, m: Measurements, side: str | None = None) -> int | None:
    """How often an action is seen, with either limb or the named one; None where nobody counts."""
    return REPETITIONS[action](m, side) if action in REPETITIONS else None
