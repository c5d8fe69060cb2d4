#!/usr/bin/env python3
"""Make clips by rule of actions that hardly any capture here shows: nods, throws, crawls ...

    python scripts/gesture_clips.py OUT [--each 24] [--seed 0] [--actions nod,throw]

OUT gets BVH files and a captions table, `clips.tsv`, for `motion-tools prepare OUT --captions
OUT/clips.tsv`; its words are the project's own (src/configs). The clips are made by rule, as those
of `--synthetic` are, and say so (`provenance`). When things happen is the same in all clips of an
action, and how often follows from their lengths alone, so that an adapter of few clips has nothing
to average over: its motions stay as large and as fast as these (docs/experiments.md, section 68).

T frames; arms are given by where the wrist is: metres from the shoulder, outward, up and ahead of
the chest.
"""

import argparse
import csv
import sys
from collections.abc import Callable
from functools import cache
from pathlib import Path

import numpy as np
import torch
from scipy.optimize import least_squares

sys.path.insert(0, str(Path(__file__).resolve().parent.parent))
from src.shared.data.synthetic.actions import pose_arm
from src.shared.data.synthetic.clips import spec_for
from src.shared.data.synthetic.rig import (
    ABDUCT,
    BALL_LEAD,
    ELBOW,
    FLEX,
    FPS,
    LEFT,
    RIGHT,
    TWIST,
    WRIST,
    Array,
    Body,
    Scene,
    bump,
    keyframes,
    min_jerk,
    ramp,
    rotation,
    solve,
)  # fmt: skip
from src.shared.formats.registry import write_motion
from src.shared.io.files import atomic_write
from src.shared.motion.motion import Motion
from src.shared.motion.rotations import quaternion_multiply
from src.shared.motion.skeleton import (
    JOINT_INDEX,
    LEG_LENGTH,
    REST_FOOT_HEIGHT,
    canonical_skeleton,
)

UPPER, FORE = 0.26, 0.25  # metres from shoulder to elbow and on to the wrist
REST = 0.25  # seconds at rest before and after
SOON = 0.15  # seconds before what is done once
Keys = tuple[tuple[float, float], ...]


# ------------------------------------------------------------ arms by where the hand is


def _arm(angles: Array) -> tuple[Array, Array]:
    """Elbow and wrist from the shoulder, metres outward, up, ahead (the collar's share aside)."""
    flex, abduct, twist, elbow = (np.array([value]) for value in angles)
    upper = rotation(0, -flex) @ rotation(2, abduct) @ rotation(1, twist)
    upper = (upper @ rotation(2, np.array([-np.pi / 2])))[0]
    fore = upper @ rotation(1, -elbow)[0]
    at = upper @ np.array([UPPER, 0, 0])
    return at, at + fore @ np.array([FORE, 0, 0])


@cache
def reach(
    out: float, up: float, ahead: float, elbow: tuple[float, float, float]
) -> dict[str, float]:
    """Arm angles in degrees that put the wrist there, the elbow as near to `elbow` as it goes."""
    wrist, prefer = np.array([out, up, ahead]), np.array(elbow)

    def miss(angles: Array) -> Array:
        at, end = _arm(angles)
        near = at / UPPER - prefer / np.linalg.norm(prefer)
        return np.concatenate([8 * (end - wrist), 0.3 * near, 0.02 * angles])

    starts = [
        (0.3, 0.2, -0.2, 0.8),
        (1.4, 0.3, 0.0, 0.6),
        (0.5, 1.3, 1.2, 1.5),
        (-0.3, 0.5, 0, 1.2),
    ]
    bounds = ([-1.2, -0.5, -1.8, 0.02], [3.1, 2.9, 2.0, 2.65])
    found = min(
        (least_squares(miss, start, bounds=bounds) for start in starts), key=lambda f: f.cost
    )
    return dict(zip(("flex", "abduct", "twist", "elbow"), np.degrees(found.x), strict=True))


DOWN, OUT, BACK, UP = (0.25, -1.0, 0.2), (1.0, -0.35, 0.1), (0.3, -0.7, -0.8), (0.7, 0.6, 0.3)


def hand(
    body: Body, side: int, weight: Array, at: tuple[float, float, float],
    elbow: tuple[float, float, float] = DOWN, pronate: float = 20.0, wrist: float = 0.0,
) -> None:  # fmt: skip
    """Bring a hand there, by `weight` [T]."""
    pose_arm(body, side, weight, **reach(*at, elbow), pronate=pronate, wrist=wrist)


def along(
    body: Body, side: int, weight: Array, places: tuple[tuple[float, float, float], ...], way: Array
) -> None:
    """Bring a hand, by `weight`, onto a line of places; `way` [T] goes from -1 to 1 along it."""
    knots = np.linspace(-1, 1, len(places))
    poses = [reach(*at, DOWN) for at in places]
    angles = {key: np.interp(way, knots, [pose[key] for pose in poses]) for key in poses[0]}
    pose_arm(body, side, weight, **angles, pronate=10)


# ------------------------------------------------------------ time


def end_of(scene: Scene) -> float:
    """The time of the last frame in seconds."""
    return float(scene.t[-1])


def held(scene: Scene, rise: float, fall: float | None = None, at: float = REST) -> Array:
    """0, up within `rise` seconds, and down before the end."""
    fall = rise if fall is None else fall
    up: Array = ramp(scene.t, at, rise)
    up *= 1 - ramp(scene.t, end_of(scene) - REST - fall, fall)
    return up


def beats(scene: Scene, period: float, rise: float) -> tuple[Array, float]:
    """Phase [T] of whole cycles between rise and fall, 0 before and N after, and N."""
    start, room = REST + rise, end_of(scene) - 2 * (REST + rise)
    number = max(1, int(room / period + 0.25))
    return np.clip((scene.t - start) / period, 0, number), number


def strokes(
    scene: Scene, lift: float, strike: float, stay: float = 0.15
) -> tuple[Array, Array, Array]:
    """What is lifted and struck down, in seconds: how far the arms are up from rest [T], of that
    how high [T], and whether it has struck already [T]; a stroke at least, as many as fit in."""
    period = lift + strike + stay
    number = max(1, int((end_of(scene) - SOON - REST - 0.4) / period))
    phase = np.clip((scene.t - SOON) / period, 0, number)
    at = phase % 1.0 * period
    high = min_jerk(at / (0.92 * lift)) - min_jerk((at - lift) / strike)
    return held(scene, 0.8 * lift, 0.4, at=SOON), high, ramp(scene.t, SOON + lift, strike)


def moment(scene: Scene, *keys: tuple[float, float]) -> Array:
    """Keys of (seconds, value) of what is done once, soon after the start."""
    return keyframes(scene.t, [(SOON + at, value) for at, value in keys])


def sign_of(side: int) -> float:
    """1 for the left, which lies at positive x."""
    return 1.0 if side == LEFT else -1.0


def side_of(scene: Scene) -> int:
    """The side that the labels name, else the right."""
    return LEFT if scene.labels.get("side") == "left" else RIGHT


def other(side: int) -> int:
    """The other side."""
    return RIGHT if side == LEFT else LEFT


# ------------------------------------------------------------ trunk and legs


def lean(
    body: Body, ahead: Array | float = 0.0, turn: Array | float = 0.0, aside: Array | float = 0.0
) -> None:
    """Bend the trunk by degrees: ahead, to the left, left side up; half of it from the hips."""
    body.spine[:, 0] += np.radians(0.6 * np.asarray(ahead))
    body.pitch[:] += np.radians(0.4 * np.asarray(ahead))
    body.position[:, 2] -= 0.0022 * np.asarray(ahead)
    body.spine[:, 1] += np.radians(turn)
    body.spine[:, 2] += np.radians(0.7 * np.asarray(aside))
    body.roll[:] += np.radians(0.3 * np.asarray(aside))


def nod_by(
    body: Body, down: Array | float = 0.0, turn: Array | float = 0.0, aside: Array | float = 0.0
) -> None:
    """Move the head by degrees."""
    for axis, value in enumerate((down, turn, aside)):
        body.head[:, axis] += np.radians(value)


def sink(body: Body, depth: Array, back: float = 0.3) -> None:
    """Bend the knees: the pelvis goes `depth` metres [T] down and a little back."""
    body.position[:, 1] -= depth
    body.position[:, 2] -= back * depth
    body.knee_out[:] += np.minimum(0.6 * depth, 0.3)[:, None]


def step(
    scene: Scene,
    body: Body,
    side: int,
    aside: float,
    ahead: float,
    at: float,
    seconds: float = 0.36,
) -> None:
    """Move one foot by metres, through the air, and half of that the pelvis."""
    share = (scene.t - at) / seconds
    gone, flying = min_jerk(share), (share > 0) & (share < 1)
    body.ball[:, side, 0] += aside * gone
    body.ball[:, side, 2] += ahead * gone
    body.ball[:, side, 1] += 0.07 * bump(share)
    body.foot_pitch[:, side] -= 0.25 * bump(share)
    body.contacts[flying, side] = 0.0
    body.position[:, 0] += 0.5 * aside * gone
    body.position[:, 2] += 0.5 * ahead * gone


def stance(scene: Scene, body: Body, side: int, back: float, stay: bool = False) -> None:
    """One foot goes back to stand in step, and comes again before the end."""
    step(scene, body, side, 0.04 * sign_of(side), -back, REST)
    if not stay:
        step(scene, body, side, -0.04 * sign_of(side), back, end_of(scene) - REST - 0.36)


def quiver(scene: Scene, hertz: float) -> Array:
    """A sine wave [T]."""
    return np.sin(2 * np.pi * hertz * scene.t)


# ------------------------------------------------------------ actions of head and arms


def nod(scene: Scene) -> Body:
    """Yes: the head goes down and up again, all clip long."""
    body, size = scene.standing(), scene.params["amplitude"]
    phase, _ = beats(scene, 0.62, 0.1)
    down = (1 - np.cos(2 * np.pi * phase)) / 2
    nod_by(body, 27 * size * down)
    lean(body, 3 * size * down)
    return body


def shake_head(scene: Scene) -> Body:
    """No: the head turns from side to side."""
    body, size = scene.standing(), scene.params["amplitude"]
    phase, _ = beats(scene, 0.72, 0.15)
    nod_by(body, 4 * held(scene, 0.3), 36 * size * np.sin(2 * np.pi * phase))
    lean(body, turn=3 * size * np.sin(2 * np.pi * phase))
    return body


def talk(scene: Scene) -> Body:
    """Both hands underline in turn what is said."""
    body, up = scene.standing(), held(scene, 0.6)
    phase, _ = beats(scene, 1.15, 0.5)
    size = scene.params["amplitude"]
    for side, late in ((LEFT, 0.0), (RIGHT, 0.5)):
        out = (1 - np.cos(2 * np.pi * (phase + late))) / 2
        hand(body, side, up, (0.0, -0.20, 0.30), pronate=-20)
        hand(body, side, up * out * size * 0.8, (0.22, -0.04, 0.30), pronate=-60)
    nod_by(body, 5 * np.sin(4 * np.pi * phase) * up, 9 * np.sin(2 * np.pi * phase) * up)
    lean(body, 3 * up, 4 * np.sin(2 * np.pi * phase) * up)
    return body


def shiver(scene: Scene) -> Body:
    """Huddled, arms around the body, trembling."""
    body, up = scene.standing(width=0.15), held(scene, 0.7)
    for side, height in ((LEFT, 0.0), (RIGHT, -0.06)):
        hand(body, side, up, (-0.30, -0.06 + height, 0.17), elbow=(0.1, -1, 0.5))
    cold = quiver(scene, 6) * up
    lean(body, 16 * up, 1.2 * cold)
    nod_by(body, 12 * up, 2.5 * cold)
    sink(body, 0.045 * up)
    body.add_arms(FLEX, np.radians(2.5) * cold)
    body.knee_out[:] -= (0.18 * up + 0.03 * cold)[:, None]
    return body


def laugh(scene: Scene) -> Body:
    """Hands on the belly; bent forward and back, shaking."""
    body, up = scene.standing(), held(scene, 0.6)
    phase, _ = beats(scene, 2.2, 0.4)
    for side in (LEFT, RIGHT):
        hand(body, side, up, (-0.13, -0.28, 0.17), elbow=(0.7, -1, 0.0))
    ha = quiver(scene, 4.0) * up
    bent = (1 - np.cos(2 * np.pi * phase)) / 2
    lean(body, (12 + 20 * bent) * up + 2.5 * ha)
    nod_by(body, -26 * (1 - bent) * up + 14 * bent * up + 3 * ha)
    body.arms[..., FLEX] += (np.radians(2.5) * ha)[:, None]
    sink(body, (0.02 + 0.05 * bent) * up + 0.006 * ha)
    return body


def dab(scene: Scene) -> Body:
    """Face into the bent right arm, the left one stretched out."""
    body, up = scene.standing(width=0.28), held(scene, 0.45)
    hand(body, RIGHT, up, (-0.25, 0.20, 0.20), elbow=(0.35, 0.35, 0.9), wrist=0)
    hand(body, LEFT, up, (0.42, 0.26, 0.04), elbow=UP, pronate=0)
    lean(body, 14 * up, 16 * up, 9 * up)
    nod_by(body, 34 * up, -24 * up, -14 * up)
    sink(body, 0.06 * up)
    return body


def cast_spell(scene: Scene) -> Body:
    """Both hands are gathered at the side and thrown ahead."""
    body = scene.standing()
    keys: Keys = ((0.0, 0), (0.7, 1), (1.15, 1), (1.4, 0), (9, 0))
    gather = moment(scene, *keys)
    out = moment(scene, (1.15, 0), (1.38, 1), (1.9, 1), (2.5, 0))
    for side in (LEFT, RIGHT):
        hand(body, side, gather, (-0.05, -0.22, 0.14), elbow=BACK, pronate=60)
        hand(body, side, out, (-0.06, 0.02, 0.49), elbow=DOWN, pronate=60, wrist=-65)
    lean(body, -7 * gather + 14 * out, -30 * gather)
    nod_by(body, 0, 20 * gather)
    sink(body, 0.07 * gather + 0.09 * out, back=0.0)
    body.position[:, 2] += 0.05 * out - 0.03 * gather
    return body


def press_button(scene: Scene) -> Body:
    """A finger goes ahead, presses, comes back."""
    body, side = scene.standing(), side_of(scene)
    up = moment(scene, (0, 0), (0.7, 1), (1.2, 1), (1.9, 0))
    press = moment(scene, (0.75, 0), (0.92, 1), (1.12, 0))
    hand(body, side, up, (-0.04, -0.02, 0.40), elbow=DOWN, pronate=60)
    hand(body, side, up * press, (-0.06, -0.02, 0.49), elbow=DOWN, pronate=60)
    lean(body, 3 * up + 4 * press, -sign_of(side) * 10 * up)
    nod_by(body, 8 * up)
    return body


def salute(scene: Scene) -> Body:
    """The right hand at the brow."""
    body, up = scene.standing(width=0.14), held(scene, 0.5)
    hand(body, RIGHT, up, (0.03, 0.17, 0.13), elbow=(1.0, 0.0, 0.35), pronate=50)
    lean(body, -4 * up)
    nod_by(body, -3 * up)
    return body


def shrug(scene: Scene) -> Body:
    """Shoulders and open hands go up (`make` turns the collar bones)."""
    body, up = scene.standing(), shrugged(scene)
    for side in (LEFT, RIGHT):
        hand(body, side, up, (0.22, -0.17, 0.20), elbow=(0.5, -1, -0.1), pronate=-90)
    nod_by(body, -3 * up, 0, 11 * up)
    lean(body, 3 * up)
    return body


def shrugged(scene: Scene) -> Array:
    """How far the shoulders are up [T]: twice in a long clip."""
    phase, _ = beats(scene, 1.5, 0.0)
    up: Array = bump(np.minimum(phase % 1.0 / 0.85, 1.0))
    up *= phase < phase.max()
    return up


def point(scene: Scene) -> Body:
    """The arm stretched ahead."""
    body, side = scene.standing(), side_of(scene)
    up = held(scene, 0.55)
    hand(body, side, up, (-0.03, 0.05, 0.50), elbow=(0.3, -1, 0.6), pronate=60)
    lean(body, 3 * up, -sign_of(side) * 14 * up)
    nod_by(body, 0, sign_of(side) * 10 * up)
    return body


def cross_arms(scene: Scene) -> Body:
    """Forearms before the chest."""
    body, up = scene.standing(), held(scene, 0.75)
    hand(body, RIGHT, up, (-0.29, -0.13, 0.23), elbow=(0.2, -1, 0.35), pronate=30)
    hand(body, LEFT, up, (-0.30, -0.18, 0.16), elbow=(0.2, -1, 0.35), pronate=30)
    lean(body, -3 * up)
    return body


def hands_on_hips(scene: Scene) -> Body:
    """Both hands at the hips, elbows out."""
    body, up = scene.standing(width=0.26), held(scene, 0.65)
    for side in (LEFT, RIGHT):
        hand(body, side, up, (-0.03, -0.35, 0.03), elbow=(1.0, -0.6, -0.35), pronate=60)
    lean(body, -4 * up)
    return body


def cover_face(scene: Scene) -> Body:
    """Both hands before the face, the head down."""
    body, up = scene.standing(), held(scene, 0.65)
    for side in (LEFT, RIGHT):
        hand(body, side, up, (-0.13, 0.14, 0.17), elbow=(0.1, -0.9, 0.6), pronate=0)
    sob = np.sin(2 * np.pi * beats(scene, 0.7, 0.6)[0]) * up
    lean(body, 14 * up + 2 * sob)
    nod_by(body, 26 * up + 3 * sob)
    sink(body, 0.02 * up)
    return body


def blow_kiss(scene: Scene) -> Body:
    """The hand from the mouth ahead."""
    body = scene.standing()
    up = moment(scene, (0, 0), (0.7, 1), (1.8, 1), (2.5, 0))
    away = moment(scene, (1.0, 0), (1.45, 1), (1.8, 1), (2.5, 1))
    hand(body, RIGHT, up * (1 - away), (-0.14, 0.13, 0.14), elbow=(0.5, -1, 0.3), pronate=30)
    hand(body, RIGHT, up * away, (0.06, 0.12, 0.46), elbow=DOWN, pronate=-80)
    nod_by(body, (8 - 12 * away) * up)
    lean(body, 7 * away * up, (6 - 4 * away) * up)
    return body


def hug(scene: Scene) -> Body:
    """Arms wide, then around somebody."""
    body, up = scene.standing(), held(scene, 0.8)
    close = held(scene, 0.75, at=REST + 0.75) * up
    for side, height in ((LEFT, 0.05), (RIGHT, -0.07)):
        pose_arm(body, side, up, flex=58, abduct=52, twist=0, elbow=26, pronate=0)
        hand(body, side, close, (-0.24, height, 0.32), elbow=(0.8, -0.3, 0.8), pronate=20)
    sway = np.sin(2 * np.pi * beats(scene, 1.8, 1.2)[0]) * close
    lean(body, 5 * up + 6 * close, 0, 3 * sway)
    nod_by(body, 0, 14 * close, 8 * close)
    return body


def stretch(scene: Scene) -> Body:
    """Both hands overhead, on the toes, and to each side."""
    body, up = scene.standing(width=0.26), held(scene, 1.0)
    phase = np.clip((scene.t - REST - 1.0) / max(end_of(scene) - 2 * REST - 2.0, 0.5), 0, 1)
    bow_aside = np.sin(2 * np.pi * phase) * up
    for side in (LEFT, RIGHT):
        hand(body, side, up, (-0.10, 0.50, 0.0), elbow=(0.7, 0.8, 0.2), pronate=0)
    lean(body, -11 * up, 0, 15 * bow_aside)
    nod_by(body, -16 * up)
    heel = 0.045 * up * (1 - np.abs(bow_aside))
    body.position[:, 1] += heel
    body.foot_pitch[:] -= (9 * heel)[:, None]
    return body


def check_watch(scene: Scene) -> Body:
    """The left wrist before the eyes."""
    body, up = scene.standing(), held(scene, 0.6)
    hand(body, LEFT, up, (-0.14, -0.07, 0.27), elbow=(1.0, -0.5, 0.3), pronate=80)
    nod_by(body, 30 * up, 4 * up)
    lean(body, 5 * up)
    return body


def pray(scene: Scene) -> Body:
    """Palms together, the head bowed."""
    body, up = scene.standing(width=0.14), held(scene, 0.75)
    for side in (LEFT, RIGHT):
        hand(body, side, up, (-0.17, 0.0, 0.21), elbow=(0.8, -0.9, 0.1), pronate=0, wrist=-35)
    lean(body, 8 * up)
    nod_by(body, 20 * up)
    return body


# ------------------------------------------------------------ with a thing in the hand


def pull_lever(scene: Scene) -> Body:
    """A hand from above the shoulder down to the hip."""
    body = scene.standing(width=0.26)
    up = moment(scene, (0, 0), (0.75, 1), (1.75, 1), (2.4, 0))
    pull = moment(scene, (0.85, 0), (1.45, 1), (1.75, 1), (2.4, 0.6))
    hand(body, RIGHT, up, (-0.04, 0.24, 0.36), elbow=DOWN, pronate=60)
    hand(body, RIGHT, up * pull, (0.02, -0.32, 0.20), elbow=BACK, pronate=60)
    lean(body, (7 + 10 * pull) * up, (14 - 22 * pull) * up)
    sink(body, 0.09 * pull * up)
    return body


def open_door(scene: Scene) -> Body:
    """A step, a handle pressed, a door pulled in a wide arc and passed through."""
    body = scene.standing()
    up = moment(scene, (0.1, 0), (0.75, 1), (2.1, 1), (2.7, 0))
    press = moment(scene, (0.75, 0), (1.0, 1), (1.8, 1), (2.1, 0))
    pull = moment(scene, (1.0, 0), (1.75, 1), (2.1, 1), (9, 1))
    hand(body, RIGHT, up, (0.02, -0.18, 0.47), elbow=(0.5, -1, 0.2), pronate=60)
    hand(body, RIGHT, up * press, (0.02, -0.28, 0.41), elbow=(0.8, -0.6, 0.2), pronate=0)
    hand(body, RIGHT, up * pull, (0.37, -0.32, 0.06), elbow=(0.6, -0.9, -0.2), pronate=20)
    lean(body, 14 * up * (1 - pull), (14 - 40 * pull) * up, 6 * press * (1 - pull))
    nod_by(body, 12 * up * (1 - pull), 10 * pull * up)
    step(scene, body, RIGHT, 0.0, 0.26, SOON + 0.2)
    step(scene, body, RIGHT, -0.06, -0.52, SOON + 1.05, 0.5)
    step(scene, body, LEFT, 0.0, 0.44, SOON + 1.9, 0.42)
    step(scene, body, RIGHT, 0.06, 0.90, SOON + 2.3, 0.5)
    step(scene, body, LEFT, 0.0, 0.20, SOON + 2.75, 0.36)
    return body


def hammer(scene: Scene) -> Body:
    """Bent over a bench, a fist from beside the ear down to a nail that the left hand holds."""
    body = scene.standing(width=0.3)
    up, high, _ = strokes(scene, 0.62, 0.4, 0.18)
    hand(body, LEFT, up, (-0.11, -0.10, 0.43), elbow=DOWN)
    hand(body, RIGHT, up, (-0.09, -0.02, 0.46), elbow=DOWN, pronate=0)
    hand(body, RIGHT, up * high, (0.06, 0.38, 0.0), elbow=(0.35, 0.6, 0.7), pronate=0)
    lean(body, (40 - 18 * high) * up, -10 * high * up)
    nod_by(body, 18 * up)
    sink(body, 0.12 * up)
    return body


def chop(scene: Scene) -> Body:
    """Both hands with an axe from behind the head down to the knees."""
    body = scene.standing(width=0.42)
    up, high, _ = strokes(scene, 0.68, 0.46)
    for side in (LEFT, RIGHT):
        hand(body, side, up, (-0.15, 0.0, 0.47), elbow=DOWN)
        hand(body, side, up * high, (-0.13, 0.40, -0.12), elbow=(0.5, 0.8, 0.5))
    lean(body, (66 - 80 * high) * up)
    nod_by(body, 10 * (1 - high) * up)
    sink(body, 0.16 * (1 - high) * up)
    return body


def stab(scene: Scene) -> Body:
    """The left hand holds somebody, a dagger goes from the hip into the belly, again and again."""
    body, up = scene.standing(width=0.24), held(scene, 0.6)
    phase, _ = beats(scene, 0.85, 0.65)
    thrust = bump(phase % 1.0, peak=0.4) * up
    step(scene, body, LEFT, 0.02, 0.34, REST)
    step(scene, body, LEFT, -0.02, -0.34, end_of(scene) - REST - 0.36)
    hand(body, LEFT, up, (-0.10, 0.05, 0.40), elbow=(0.6, -0.8, 0.3), pronate=40)
    hand(body, RIGHT, up, (0.02, -0.30, -0.14), elbow=BACK, pronate=-20)
    hand(body, RIGHT, thrust, (-0.16, -0.22, 0.44), elbow=DOWN, pronate=-60)
    lean(body, 8 * up + 12 * thrust, -26 * (up - thrust) + 18 * thrust)
    nod_by(body, 10 * up, 12 * (up - thrust) - 8 * thrust)
    sink(body, 0.08 * up + 0.05 * thrust, back=-0.2)
    return body


def aim_gun(scene: Scene) -> Body:
    """A pistol held at the end of both arms, knees bent, from one side slowly to the other."""
    body, up = scene.standing(width=0.3), held(scene, 0.6)
    pan = np.sin(2 * np.pi * beats(scene, 2.6, 0.7)[0]) * up
    stance(scene, body, RIGHT, 0.24)
    for side in (LEFT, RIGHT):
        hand(body, side, up, (-0.17, 0.08, 0.44), elbow=(0.3, -0.9, 0.5), pronate=0)
    lean(body, 6 * up, 14 * pan)
    nod_by(body, 6 * up, 0, 9 * up)
    sink(body, 0.06 * up)
    return body


def archery(scene: Scene) -> Body:
    """Side on, the bow at the end of the left arm; the right hand draws to the chin and lets go, as
    often as fits in."""
    body, up = scene.standing(width=0.3), held(scene, 0.6)
    phase, number = beats(scene, 2.2, 0.55)
    at = phase % 1.0 * (phase < number)
    drawn = up * min_jerk(at / 0.5) * (1 - min_jerk((at - 0.82) / 0.14))
    after = up * np.clip(1 - np.abs(at - 0.80) / 0.05, 0, 1)  # it flies back
    stance(scene, body, RIGHT, 0.22)
    lean(body, turn=-58 * up)
    hand(body, LEFT, up, (0.44, 0.08, 0.30), elbow=(0.5, -1, 0.0), pronate=0)
    hand(body, RIGHT, up, (-0.36, 0.0, 0.34), elbow=(0.6, -0.9, 0.2), pronate=0)
    hand(body, RIGHT, drawn, (-0.06, 0.08, 0.20), elbow=(1.0, 0.1, -0.3), pronate=0)
    hand(body, RIGHT, after, (0.06, 0.10, 0.12), elbow=(1.0, 0.1, -0.5), pronate=0)
    nod_by(body, turn=50 * up)
    return body


def drink(scene: Scene) -> Body:
    """A glass to the mouth, the head back, and down again; in a long clip twice."""
    body, up = scene.standing(), held(scene, 0.55)
    number = 2 if end_of(scene) > 3.7 else 1
    share = np.clip((scene.t - REST - 0.3) / (end_of(scene) - 2 * REST - 0.6), 0, 1) * number
    sip = bump(np.clip((share % 1.0 - 0.1) / 0.8, 0, 1)) * (share < number)
    sip = np.clip(1.6 * sip, 0, 1)
    hand(body, RIGHT, up, (-0.08, -0.10, 0.30), elbow=(0.35, -1, 0.1), pronate=10)
    hand(body, RIGHT, up * sip, (-0.13, 0.11, 0.19), elbow=(0.75, -0.5, 0.4), pronate=-10, wrist=15)
    nod_by(body, 4 * up - 26 * sip * up)
    lean(body, -5 * sip * up)
    return body


def push_up(scene: Scene) -> Body:
    """From straight arms down and up again, the body a board on toes and hands; before and after,
    the hips are up, so that it can be seen where in the clip a frame is."""
    body, t = scene.standing(width=0.16), scene.t
    phase, _ = beats(scene, 1.25, 0.4)
    ready = 1 - held(scene, 0.55, at=0.05)
    depth = (1 - np.cos(2 * np.pi * phase)) / 2
    heel = np.radians(72)
    body.foot_pitch[:] = -heel
    body.foot_yaw[:] = 0.0
    body.spine[:], body.head[:] = 0.3 * body.spine, 0.3 * body.head
    offsets = canonical_skeleton().offsets
    hip, chest = (sum(offsets[JOINT_INDEX[j]] for j in names) for names in (
        ("l_hip",), ("spine1", "spine2", "spine3", "l_collar", "l_shoulder")))  # fmt: skip
    lead = offsets[JOINT_INDEX["l_foot"]]  # from the ankle to the ball of the foot
    ankle_y = REST_FOOT_HEIGHT - (lead[1] * np.cos(heel) - lead[2] * np.sin(heel))
    ankle_z = BALL_LEAD - (lead[2] * np.cos(heel) + lead[1] * np.sin(heel))
    legs = 0.995 * LEG_LENGTH

    def board(low: Array) -> tuple[Array, Array, Array]:
        """Lean [T], pelvis and shoulders (height and way ahead) [T,2] for so low a chest [T]."""
        high = 0.56 - 0.29 * low
        tilt = np.arccos((high - ankle_y) / (legs - hip[1] + chest[1]))
        up = np.stack([np.cos(tilt), np.sin(tilt)], -1)
        ahead = np.stack([-np.sin(tilt), np.cos(tilt)], -1)
        pelvis = np.array([ankle_y, ankle_z]) + (legs - hip[1]) * up - hip[2] * ahead
        return tilt, pelvis, pelvis + chest[1] * up + chest[2] * ahead

    tilt, pelvis, _ = board(depth)
    body.pitch[:] = tilt + np.radians(20) * ready
    body.spine[:, 0] -= np.radians(20) * ready
    body.position[:, 1:] = pelvis
    body.position[:, 1] += 0.10 * ready
    knots = np.linspace(0, 1, 7)
    tilts, _, shoulders = board(knots)
    floor = np.array([0.05, shoulders[0, 1] + 0.04])  # where the hands are
    places = []
    for each, (high, way) in zip(tilts, shoulders, strict=True):
        y, z = floor[0] - high, floor[1] - way
        places.append(
            (0.08, y * np.cos(each) + z * np.sin(each), z * np.cos(each) - y * np.sin(each))
        )
    for side in (LEFT, RIGHT):
        along(body, side, np.ones_like(t), tuple(places), 2 * depth - 1)
        body.arms[:, side, WRIST] = np.radians(-75)
    nod_by(body, 26)
    return body


def shoot_gun(scene: Scene) -> Body:
    """Legs apart, a pistol at the end of both arms, which it kicks up at each shot."""
    body, up = scene.standing(), held(scene, 0.6)
    share = beats(scene, 0.9, 0.6)[0] % 1.0
    kick = bump(np.clip((share - 0.3) / 0.7, 0, 1), peak=0.3) * up
    step(scene, body, RIGHT, -0.26, -0.06, REST)
    step(scene, body, RIGHT, 0.26, 0.06, end_of(scene) - REST - 0.36)
    for side in (LEFT, RIGHT):
        hand(body, side, up, (-0.15, 0.20, 0.45), elbow=(0.2, -0.8, 0.8), pronate=0)
        hand(body, side, kick, (-0.15, 0.40, 0.30), elbow=(0.3, -0.4, 0.9), pronate=0)
    nod_by(body, 4 * up)
    lean(body, 8 * up - 14 * kick)
    sink(body, 0.09 * up)
    return body


def drive(scene: Scene) -> Body:
    """Seated, the hands on a wheel, which they turn far to and fro."""
    body, wheel = scene.standing(width=0.26), beats(scene, 1.55, 0.05)[0]
    turn = np.sin(2 * np.pi * wheel) * held(scene, 0.5)
    body.position[:, 1] = 0.50
    body.ball[..., 2] += 0.46
    body.knee_out[:] += 0.15
    one, angle = np.ones_like(scene.t), np.radians(np.linspace(-75, 75, 9))
    rim = tuple((0.21 * np.cos(a) - 0.17, 0.21 * np.sin(a) - 0.10, 0.37) for a in angle)
    for side in (LEFT, RIGHT):
        along(body, side, one, rim, sign_of(side) * turn)
    lean(body, -6, 5 * turn, 5 * turn)
    nod_by(body, 2, 12 * turn)
    return body


# ------------------------------------------------------------ with the whole body


def pick_up(scene: Scene) -> Body:
    """Down on bent knees, something in the hand, up again."""
    body = scene.standing(width=0.26)
    low = moment(scene, (0, 0), (0.95, 1), (1.25, 1), (2.2, 0))
    got = moment(scene, (1.2, 0), (1.9, 1), (2.25, 1), (2.7, 0))
    sink(body, 0.50 * low, back=0.30)
    lean(body, 92 * low)
    nod_by(body, 12 * low)
    hand(body, RIGHT, low, (-0.04, -0.24, 0.43), elbow=DOWN)
    hand(body, RIGHT, got * (1 - low), (-0.06, -0.22, 0.28), elbow=DOWN, pronate=-40)
    pose_arm(body, LEFT, low, flex=42, abduct=14, elbow=44)
    return body


def throw(scene: Scene) -> Body:
    """Wind up, step, release, follow through."""
    body, side = scene.standing(width=0.24), side_of(scene)
    sign = sign_of(side)
    wind = moment(scene, (0, 0), (0.85, 1), (1.0, 1), (1.2, 0))
    out = moment(scene, (1.0, 0), (1.2, 1), (1.32, 1), (2.4, 0))
    through = moment(scene, (1.24, 0), (1.5, 1), (1.75, 1), (2.4, 0))
    hand(body, side, wind, (0.26, 0.20, -0.20), elbow=(1, 0.15, -0.3), wrist=-25)
    hand(body, side, out, (-0.02, 0.26, 0.40), elbow=(0.6, 0.5, 0.8), pronate=40)
    hand(body, side, through, (-0.26, -0.24, 0.28), elbow=(0.3, -0.4, 0.9), pronate=40)
    pose_arm(body, other(side), wind, flex=72, abduct=22, elbow=24)
    pose_arm(body, other(side), out, flex=5, abduct=22, elbow=70)
    lean(body, -9 * wind + 15 * out + 8 * through, sign * (38 * wind - 30 * out))
    nod_by(body, 0, -sign * (30 * wind - 22 * out))
    step(scene, body, other(side), 0.0, 0.42, SOON + 0.68, 0.36)
    step(scene, body, other(side), 0.0, -0.42, SOON + 2.0, 0.42)
    sink(body, 0.07 * out, back=0.0)
    body.position[:, 2] += 0.10 * out - 0.06 * wind
    return body


def push(scene: Scene) -> Body:
    """One foot back, both palms ahead again and again."""
    body, up = scene.standing(), held(scene, 0.6)
    phase, _ = beats(scene, 1.7, 0.6)
    out = (1 - np.cos(2 * np.pi * phase)) / 2
    stance(scene, body, RIGHT, 0.40)
    for side in (LEFT, RIGHT):
        hand(body, side, up, (-0.02, -0.06, 0.28), elbow=OUT, pronate=40, wrist=-60)
        hand(body, side, up * out, (-0.04, 0.02, 0.48), elbow=DOWN, pronate=40, wrist=-60)
    lean(body, (12 + 16 * out) * up)
    nod_by(body, 10 * up)
    sink(body, (0.08 + 0.05 * out) * up, back=0.0)
    body.position[:, 2] += (0.05 + 0.12 * out) * up
    return body


def stomp(scene: Scene) -> Body:
    """Each foot in turn high, and down at once."""
    body, up = scene.standing(), held(scene, 0.4)
    phase, number = beats(scene, 0.95, 0.35)
    for index in range(int(number)):
        side = RIGHT if index % 2 == 0 else LEFT
        share = np.clip(phase - index, 0, 1)
        high = np.where(share < 0.6, min_jerk(share / 0.6), 1 - min_jerk((share - 0.62) / 0.15))
        high = high * ((share > 0) & (share < 1))
        body.ball[:, side, 1] += 0.27 * high
        body.ball[:, side, 2] += 0.07 * high
        body.contacts[(high > 0.01), side] = 0.0
        body.position[:, 0] -= sign_of(side) * 0.055 * bump(share)
        hit = bump(np.clip((share - 0.72) / 0.28, 0, 1), peak=0.25)
        lean(body, 9 * hit)
        nod_by(body, 10 * hit)
        sink(body, 0.035 * hit)
    for side in (LEFT, RIGHT):
        pose_arm(body, side, up, flex=8, abduct=17, elbow=52, pronate=50)
    lean(body, 6 * up)
    return body


def jumping_jacks(scene: Scene) -> Body:
    """Feet and arms apart and together, in small jumps."""
    body = scene.standing(width=0.15)
    phase, _ = beats(scene, 1.05, 0.25)
    apart = (1 - np.cos(2 * np.pi * phase)) / 2
    share = (2 * phase) % 1.0  # two small jumps a cycle
    during = (phase > 0) & (phase < phase.max())
    air = np.where(during, np.clip(1 - ((share - 0.5) / 0.32) ** 2, 0, 1), 0)
    body.ball[..., 1] += (0.07 * air)[:, None]
    body.position[:, 1] += 0.10 * air - 0.05 * (1 - air) * during
    body.contacts[air > 0.05] = 0.0
    body.foot_pitch[:] -= (0.5 * air)[:, None]
    for side in (LEFT, RIGHT):
        body.ball[:, side, 0] += sign_of(side) * 0.26 * apart
        pose_arm(body, side, apart, flex=8, abduct=158, twist=30, elbow=22, pronate=0)
    return body


def dodge(scene: Scene) -> Body:
    """The trunk away, with a step, to a side or back."""
    body = scene.standing(width=0.26)
    away = moment(scene, (0.2, 0), (0.5, 1), (0.85, 1), (1.6, 0))
    direction = scene.labels.get("direction")
    if direction is None:  # backward
        lean(body, -26 * away)
        nod_by(body, 6 * away)
        step(scene, body, RIGHT, 0.03, -0.34, SOON + 0.18, 0.26)
        step(scene, body, RIGHT, -0.03, 0.34, SOON + 1.2, 0.4)
    else:
        side = LEFT if direction == "left" else RIGHT
        lean(body, 16 * away, 0, -sign_of(side) * 34 * away)
        step(scene, body, side, sign_of(side) * 0.26, 0, SOON + 0.18, 0.26)
        step(scene, body, side, -sign_of(side) * 0.26, 0, SOON + 1.2, 0.4)
        body.position[:, 0] += sign_of(side) * 0.08 * away
    sink(body, 0.17 * away)
    for side in (LEFT, RIGHT):
        hand(body, side, away, (0.0, 0.02, 0.24), elbow=(0.6, -1, 0.3))
    return body


# ------------------------------------------------------------ on the floor


def down(body: Body, sit: Array, flat: Array) -> None:
    """Sit down behind the feet, knees up, by `sit` [T], and by `flat` [T] lie back, legs out."""
    mid = 4 * sit * (1 - sit)
    body.position[:, 1] += sit * (0.13 - body.position[:, 1])
    body.position[:, 2] -= 0.46 * sit
    body.pitch[:] += np.radians(32 * mid - 12 * sit * (1 - flat) - 84 * flat)
    body.spine[:, 0] += np.radians(14 * mid + 22 * sit * (1 - flat) + 26 * 4 * flat * (1 - flat))
    body.ball[..., 2] += (0.43 * flat)[:, None]
    body.ball[..., 1] += (0.17 * flat)[:, None]
    body.foot_pitch[:] += np.radians(66 * flat)[:, None]
    body.foot_yaw[:] *= 1 + 2 * flat[:, None]
    body.contacts[flat > 0.05] = 0.0
    for side in (LEFT, RIGHT):
        pose_arm(body, side, mid, flex=48, abduct=14, elbow=20)
        pose_arm(body, side, sit * (1 - flat), flex=-42, abduct=22, elbow=12, twist=-10, wrist=-60)
        pose_arm(body, side, flat, flex=2, abduct=17, elbow=12)
    nod_by(body, -58 * flat)  # the rig's head looks ahead; here it lies


def lie_down(scene: Scene) -> Body:
    """Sit down on the floor and lie back."""
    body = scene.standing(width=0.22)
    down(body, moment(scene, (0, 0), (1.3, 1)), moment(scene, (1.2, 0), (2.5, 1)))
    return body


def get_up(scene: Scene) -> Body:
    """From lying on the back over sitting to standing."""
    body = scene.standing(width=0.22)
    down(body, 1 - moment(scene, (1.2, 0), (2.6, 1)), 1 - moment(scene, (0, 0), (1.25, 1)))
    return body


def sleep(scene: Scene) -> Body:
    """On the back, hands on the belly, breathing slowly."""
    body, one = scene.standing(width=0.22), np.ones_like(scene.t)
    down(body, one, one)
    breath = np.sin(2 * np.pi * scene.t / 3.4)
    for side, height in ((LEFT, -0.25), (RIGHT, -0.30)):
        hand(body, side, one, (-0.14, height, 0.19), elbow=(0.9, -0.6, -0.1))
    body.spine[:, 0] -= np.radians(1.6) * breath
    nod_by(body, 4, 22)
    return body


def sit_floor(scene: Scene) -> Body:
    """Down onto the floor, knees up, arms around them."""
    body = scene.standing(width=0.22)
    sit = moment(scene, (0, 0), (1.4, 1))
    down(body, sit, 0 * sit)
    around = moment(scene, (1.3, 0), (2.0, 1))
    for side in (LEFT, RIGHT):
        hand(body, side, around, (-0.06, -0.22, 0.44), elbow=(0.5, -0.9, 0.2))
    body.spine[:, 0] += np.radians(8) * around
    return body


def die(scene: Scene) -> Body:
    """Hit in the chest, a hand to it, down onto the knees, ahead onto the floor, and still."""
    body = scene.standing(width=0.22)
    hit, held = moment(scene, (0, 0), (0.22, 1), (0.7, 0)), moment(scene, (0.05, 0), (0.35, 1))
    knees, fall = moment(scene, (0.3, 0), (0.95, 1)), moment(scene, (1.05, 0), (1.75, 1))
    slides = moment(scene, (0.95, 0), (1.65, 1))  # the shins give way first
    lean(body, -14 * hit + 16 * knees * (1 - fall), aside=5 * knees)
    body.position[:, 1] += knees * (0.50 - body.position[:, 1])
    body.position[:, 1] += fall * (0.13 - body.position[:, 1])
    body.position[:, 2] += 0.36 * knees + 0.66 * slides
    body.pitch[:] += np.radians(85) * fall
    body.spine[:] *= 1 - 0.8 * fall[:, None]
    body.foot_pitch[:] -= 1.1 * knees[:, None] + 0.8 * fall[:, None]
    body.foot_yaw[:] *= 1 - fall[:, None]
    body.ball[:, RIGHT, 2] -= 0.10 * knees
    body.ball[..., 1] += 0.02 * fall[:, None]
    body.contacts[fall > 0.05] = 0.0
    chest = held * (1 - fall)
    hand(body, RIGHT, chest, (-0.12, -0.18, 0.20), elbow=(0.7, -0.8, 0.1))
    pose_arm(body, LEFT, knees * (1 - fall), flex=10, abduct=24, elbow=25)
    pose_arm(body, LEFT, fall, flex=128, abduct=42, elbow=38, twist=0)
    pose_arm(body, RIGHT, fall, flex=4, abduct=40, elbow=22)
    nod_by(body, -10 * hit + 18 * knees * (1 - fall) - 8 * fall, 55 * fall)
    return body


def crouch(scene: Scene) -> Body:
    """Down low over bent knees, one foot behind on its ball, a hand to the floor, and there it
    stays."""
    body = scene.standing(width=0.24)
    low = moment(scene, (0, 0), (1.0, 1))
    step(scene, body, RIGHT, -0.02, -0.42, SOON + 0.05, 0.45)
    body.foot_pitch[:, RIGHT] -= 0.7 * low
    sink(body, 0.52 * low, back=0.0)
    body.position[:, 2] += 0.11 * low
    lean(body, 58 * low)
    nod_by(body, -22 * low)
    hand(body, RIGHT, low, (0.0, -0.46, 0.20), elbow=(0.5, -1, 0.1))
    hand(body, LEFT, low, (-0.02, -0.20, 0.36), elbow=(0.6, -1, 0.1))
    return body


def kneel(scene: Scene) -> Body:
    """On the right knee, the trunk upright, the left hand on the raised knee."""
    body, one = scene.standing(width=0.20), np.ones_like(scene.t)
    body.position[:, 1] = 0.51
    body.ball[:, LEFT, 2] += 0.44
    body.ball[:, RIGHT, 2] -= 0.42
    body.foot_pitch[:, RIGHT] -= 1.1
    breath = np.sin(2 * np.pi * scene.t / 3.2)
    lean(body, 8 + 1.6 * breath)
    nod_by(body, 4)
    hand(body, LEFT, one, (-0.02, -0.38, 0.36), elbow=(0.7, -0.7, 0.2))
    hand(body, RIGHT, one, (0.02, -0.50, 0.10), elbow=(0.6, -0.6, -0.4))
    return body


def face_down(body: Body, height: Array | float, tilt: float) -> None:
    """The trunk level, face down, the gaze a little ahead."""
    body.position[:, 1] = height
    body.pitch[:] = np.radians(tilt)
    body.spine[:] *= 0.3
    body.foot_yaw[:] = 0.0
    nod_by(body, 30)


def crawl(scene: Scene) -> Body:
    """On hands and knees ahead: a hand and the other side's knee at a time."""
    body, t = scene.standing(width=0.2), scene.t
    pace, period = 0.42, 1.1
    face_down(body, 0.44, 76)
    go = ramp(t, 0.15, 0.5)  # first it sits back: so it can be seen where in the clip a frame is
    gone = np.cumsum(go) / FPS
    body.position[:, 2] += pace * gone - 0.10 * (1 - go)
    body.position[:, 1] -= 0.06 * (1 - go)
    body.head[:, 0] += np.radians(25) * (1 - go)
    body.foot_pitch[:] = np.radians(-84)
    for side, late in ((LEFT, 0.0), (RIGHT, 0.5)):
        phase = (gone / period + late) % 1.0
        swing = np.clip((phase - 0.55) / 0.45, 0, 1)
        way = np.where(phase < 0.55, 1 - phase / 0.55, 0.0) + min_jerk(swing)  # 1 far ahead
        lift = bump(swing)
        knee = pace * gone - 0.56 + pace * period * 0.55 * (way - 0.5)
        body.ball[:, side, 2] = knee
        body.ball[:, side, 1] = 0.055 + 0.02 * lift
        body.contacts[:, side] = 0.0
        arm = other(side)
        line = tuple((0.02, 0.06 + ahead, 0.47) for ahead in (-0.13, -0.06, 0.0, 0.06, 0.13))
        along(body, arm, np.ones_like(t), line, 2 * way - 1)
        hand(body, arm, 0.8 * lift, (0.03, 0.12, 0.36), elbow=(0.5, -0.9, 0.1))
        body.arms[:, arm, WRIST] = np.radians(-70)
    sway = np.sin(2 * np.pi * gone / period) * go
    body.roll[:] += np.radians(3) * sway
    body.spine[:, 1] += np.radians(5) * sway
    return body


def swim(scene: Scene) -> Body:
    """Face down as on water: after a glide, both arms ahead, one after the other goes through and
    over the head, and the legs beat."""
    body, t = scene.standing(width=0.16), scene.t
    face_down(body, 0.55, 84)
    go = ramp(t, 0.3, 0.5)
    gone = np.cumsum(go) / FPS
    body.position[:, 2] += 0.5 * gone
    for side, late in ((LEFT, 0.0), (RIGHT, 0.5)):
        apart = late * ramp(t, 0.3, 1.4)  # no faster than the strokes
        turn = 2 * np.pi * (gone / 1.4 + apart)
        body.arms[:, side, FLEX] = np.radians(88) + np.radians(84) * np.cos(turn)
        body.arms[:, side, ABDUCT] = np.radians(14) + np.radians(34) * np.clip(-np.sin(turn), 0, 1)
        body.arms[:, side, TWIST] = 0.0
        body.arms[:, side, ELBOW] = np.radians(16) + np.radians(40) * np.clip(-np.sin(turn), 0, 1)
        beat = np.sin(2 * np.pi * (gone / 0.47 + apart)) * go
        body.ball[:, side, 2] = body.position[:, 2] - 0.93
        body.ball[:, side, 1] = 0.52 + 0.13 * beat
        body.foot_pitch[:, side] = np.radians(-110)
        body.contacts[:, side] = 0.0
    body.roll[:] += np.radians(16) * np.cos(2 * np.pi * gone / 1.4) * go
    return body


def fly(scene: Scene) -> Body:
    """Ahead through the air, face down, both arms stretched out, banking a little."""
    body, t = scene.standing(width=0.12), scene.t
    face_down(body, 1.05, 80)
    body.position[:, 2] += 1.5 * t
    bank = np.sin(2 * np.pi * t / 2.6)
    body.position[:, 1] += 0.04 * np.sin(2 * np.pi * t / 1.9)
    body.roll[:] += np.radians(12) * bank
    for side in (LEFT, RIGHT):
        pose_arm(body, side, np.ones_like(t), flex=165, abduct=8, elbow=8, twist=0)
        body.ball[:, side, 2] = body.position[:, 2] - 0.93
        body.ball[:, side, 1] = body.position[:, 1] - 0.06 + 0.03 * sign_of(side) * bank
        body.foot_pitch[:, side] = np.radians(-120)
        body.contacts[:, side] = 0.0
    return body


# ------------------------------------------------------------ more of the whole body


def cheer(scene: Scene) -> Body:
    """Both arms up, fists shaken, in small jumps."""
    body, up = scene.standing(width=0.24), held(scene, 0.4)
    phase, _ = beats(scene, 0.62, 0.3)
    share = phase % 1.0
    air = np.where(
        (phase > 0) & (phase < phase.max()), np.clip(1 - ((share - 0.5) / 0.3) ** 2, 0, 1), 0
    )
    body.ball[..., 1] += (0.09 * air)[:, None]
    body.position[:, 1] += 0.12 * air - 0.06 * (1 - air) * up
    body.contacts[air > 0.05] = 0.0
    body.foot_pitch[:] -= (0.5 * air)[:, None]
    for side in (LEFT, RIGHT):
        pose_arm(body, side, up, flex=30, abduct=140, twist=20, elbow=35)
        body.arms[:, side, ELBOW] += np.radians(26) * (1 - air) * up
    nod_by(body, -14 * up)
    return body


def block(scene: Scene) -> Body:
    """Both forearms go up before the face, the body back and low."""
    body, up = scene.standing(width=0.26), held(scene, 0.3)
    stance(scene, body, RIGHT, 0.28)
    for side in (LEFT, RIGHT):
        hand(body, side, up, (-0.16, 0.20, 0.22), elbow=(0.35, -0.9, 0.8), pronate=0)
    lean(body, -9 * up, -10 * up)
    nod_by(body, 20 * up)
    sink(body, 0.13 * up)
    return body


def hop(scene: Scene) -> Body:
    """On the right foot, the left held up behind, on the spot."""
    body = scene.standing(width=0.12)
    up = held(scene, 0.35)
    phase, _ = beats(scene, 0.62, 0.4)
    share = phase % 1.0
    air = np.where(
        (phase > 0) & (phase < phase.max()), np.clip(1 - ((share - 0.5) / 0.32) ** 2, 0, 1), 0
    )
    body.ball[:, LEFT, 1] += 0.34 * up
    body.ball[:, LEFT, 2] -= 0.26 * up
    body.foot_pitch[:, LEFT] -= 0.9 * up
    body.ball[..., 1] += (0.13 * air)[:, None]
    body.position[:, 1] += 0.15 * air - 0.09 * (1 - air) * up
    body.position[:, 0] -= 0.05 * up
    body.contacts[air > 0.05] = 0.0
    body.contacts[up > 0.05, LEFT] = 0.0
    body.foot_pitch[:, RIGHT] -= 0.5 * air
    for side in (LEFT, RIGHT):
        pose_arm(body, side, up, flex=24, abduct=30, elbow=62)
        body.arms[:, side, ABDUCT] += np.radians(14) * air
    lean(body, 8 * up)
    return body


def get_hit(scene: Scene) -> Body:
    """A blow into the face: head and trunk are thrown back and turned, a step back to stay up."""
    body = scene.standing(width=0.22)
    hit = moment(scene, (0.15, 0), (0.36, 1), (0.6, 0.85), (1.5, 0))
    nod_by(body, -30 * hit, 38 * hit)
    lean(body, -22 * hit, 26 * hit)
    step(scene, body, RIGHT, -0.06, -0.36, SOON + 0.3, 0.3)
    step(scene, body, RIGHT, 0.06, 0.36, SOON + 1.4, 0.42)
    sink(body, 0.12 * hit)
    pose_arm(body, LEFT, hit, flex=52, abduct=40, elbow=46)
    pose_arm(body, RIGHT, hit, flex=26, abduct=48, elbow=30)
    rub = moment(scene, (0.95, 0), (1.3, 1), (1.75, 1), (2.2, 0))
    hand(body, RIGHT, rub, (-0.08, 0.14, 0.15), elbow=(0.5, -0.9, 0.3))
    return body


def fist_pump(scene: Scene) -> Body:
    """A fist pulled down to the hip, the knee up: yes!"""
    body, up = scene.standing(width=0.24), held(scene, 0.35)
    phase, _ = beats(scene, 0.9, 0.35)
    pull = bump(np.clip(phase % 1.0 / 0.9, 0, 1), peak=0.35) * (phase < phase.max())
    hand(body, RIGHT, up, (0.06, 0.34, 0.16), elbow=(0.7, 0.1, 0.7), pronate=-40)
    hand(body, RIGHT, up * pull, (0.05, -0.10, 0.16), elbow=(0.5, -0.9, -0.5), pronate=-60)
    pose_arm(body, LEFT, up, flex=14, abduct=20, elbow=70)
    lean(body, 16 * pull * up, -10 * up + 14 * pull * up)
    nod_by(body, 10 * pull * up)
    sink(body, 0.10 * pull * up)
    return body


def confused(scene: Scene) -> Body:
    """A hand scratches the head, which tilts from one side to the other."""
    body, up = scene.standing(), held(scene, 0.6)
    scratch = quiver(scene, 2.6) * up
    hand(body, RIGHT, up, (-0.07, 0.27, 0.04), elbow=(1.0, 0.1, 0.4), pronate=20)
    body.arms[:, RIGHT, ELBOW] += np.radians(5) * scratch
    hand(body, LEFT, up, (-0.03, -0.35, 0.03), elbow=(1.0, -0.6, -0.35), pronate=60)
    phase, _ = beats(scene, 2.4, 0.5)
    side = np.sin(2 * np.pi * phase) * up
    nod_by(body, 5 * up, 12 * side, 15 * side)
    lean(body, 0, 5 * side, -3 * up)
    return body


def dizzy(scene: Scene) -> Body:
    """A hand at the brow, the body goes round over its feet, the knees soft."""
    body, up = scene.standing(width=0.26), held(scene, 0.6)
    phase, _ = beats(scene, 1.4, 0.3)
    round_, over = np.sin(2 * np.pi * phase) * up, np.cos(2 * np.pi * phase) * up
    hand(body, RIGHT, up, (-0.12, 0.22, 0.16), elbow=(0.7, -0.6, 0.5))
    pose_arm(body, LEFT, up, flex=20, abduct=38, elbow=26)
    lean(body, 10 * up + 12 * over, 0, 20 * round_)
    nod_by(body, 12 * up + 10 * over, 0, 16 * round_)
    body.position[:, 0] += 0.10 * round_
    body.position[:, 2] += 0.04 * over
    sink(body, 0.06 * up)
    return body


def listen(scene: Scene) -> Body:
    """A hand behind the ear, the head turned and leaned that way."""
    body, up = scene.standing(), held(scene, 0.6)
    hand(body, RIGHT, up, (0.0, 0.24, 0.08), elbow=(1.0, -0.1, 0.4), pronate=-40)
    near = np.sin(2 * np.pi * beats(scene, 2.4, 0.6)[0]) * up
    nod_by(body, 4 * up, 24 * up + 4 * near, -14 * up)
    lean(body, 14 * up + 4 * near, 12 * up, -8 * up)
    return body


def fight_stance(scene: Scene) -> Body:
    """Fists before the chin, one foot back, swaying on soft knees."""
    body, up = scene.standing(width=0.26), held(scene, 0.45)
    stance(scene, body, RIGHT, 0.32)
    sway = np.sin(2 * np.pi * beats(scene, 0.72, 0.45)[0]) * up
    for side, ahead in ((LEFT, 0.34), (RIGHT, 0.22)):
        hand(body, side, up, (-0.10, 0.06, ahead), elbow=(0.4, -1, 0.2), pronate=30)
    lean(body, 10 * up + 2 * sway, -20 * up)
    nod_by(body, 8 * up, 16 * up)
    body.position[:, 2] += 0.025 * sway
    sink(body, 0.09 * up + 0.025 * sway)
    return body


Maker = Callable[[Scene], Body]
Labels = dict[str, str]
SIDED: tuple[Labels, ...] = ({}, {"side": "left"}, {"side": "right"})
DODGES: tuple[Labels, ...] = ({}, {"direction": "left"}, {"direction": "right"})
ACTIONS: dict[str, tuple[Maker, float, float, tuple[Labels, ...]]] = {
    # maker, shortest and longest in seconds, labels beside the action
    "aim-gun": (aim_gun, 2.8, 5.0, ({},)),
    "archery": (archery, 3.4, 5.0, ({},)),
    "block": (block, 2.2, 4.5, ({},)),
    "blow-kiss": (blow_kiss, 2.9, 4.5, ({},)),
    "cast-spell": (cast_spell, 2.9, 4.5, ({},)),
    "check-watch": (check_watch, 2.2, 4.5, ({},)),
    "cheer": (cheer, 2.2, 5.0, ({},)),
    "chop": (chop, 3.45, 5.0, ({},)),
    "confused": (confused, 2.8, 5.0, ({},)),
    "cover-face": (cover_face, 2.6, 5.0, ({},)),
    "crawl": (crawl, 2.4, 5.0, ({},)),
    "cross-arms": (cross_arms, 2.6, 5.0, ({},)),
    "crouch": (crouch, 2.2, 4.5, ({},)),
    "dab": (dab, 2.0, 4.5, ({},)),
    "die": (die, 2.4, 4.5, ({},)),
    "dizzy": (dizzy, 2.8, 5.0, ({},)),
    "dodge": (dodge, 2.2, 4.5, DODGES),
    "drink": (drink, 2.6, 5.0, ({},)),
    "drive": (drive, 2.5, 5.0, ({},)),
    "fight-stance": (fight_stance, 2.4, 5.0, ({},)),
    "fist-pump": (fist_pump, 2.2, 4.5, ({},)),
    "fly": (fly, 2.2, 5.0, ({},)),
    "get-hit": (get_hit, 2.6, 4.5, ({},)),
    "get-up": (get_up, 3.1, 4.7, ({},)),
    "hammer": (hammer, 3.25, 5.0, ({},)),
    "hands-on-hips": (hands_on_hips, 2.4, 5.0, ({},)),
    "hop": (hop, 2.2, 5.0, ({},)),
    "hug": (hug, 3.2, 5.0, ({},)),
    "jumping-jacks": (jumping_jacks, 2.6, 5.0, ({},)),
    "laugh": (laugh, 2.8, 5.0, ({},)),
    "lie-down": (lie_down, 3.1, 5.0, ({},)),
    "kneel": (kneel, 2.4, 5.0, ({},)),
    "listen": (listen, 2.4, 5.0, ({},)),
    "nod": (nod, 2.0, 4.5, ({},)),
    "open-door": (open_door, 3.5, 5.0, ({},)),
    "pick-up": (pick_up, 3.1, 4.7, ({},)),
    "point": (point, 2.2, 4.5, SIDED),
    "pray": (pray, 2.6, 5.0, ({},)),
    "press-button": (press_button, 2.3, 4.5, SIDED),
    "pull-lever": (pull_lever, 2.8, 4.7, ({},)),
    "push": (push, 2.8, 5.0, ({},)),
    "push-up": (push_up, 2.6, 5.0, ({},)),
    "salute": (salute, 2.2, 4.5, ({},)),
    "shake-head": (shake_head, 2.0, 4.5, ({},)),
    "shiver": (shiver, 2.8, 5.0, ({},)),
    "shoot-gun": (shoot_gun, 2.8, 5.0, ({},)),
    "shrug": (shrug, 2.0, 4.5, ({},)),
    "sit-floor": (sit_floor, 2.6, 5.0, ({},)),
    "sleep": (sleep, 2.4, 5.0, ({},)),
    "stab": (stab, 2.8, 5.0, ({},)),
    "stomp": (stomp, 2.6, 5.0, ({},)),
    "stretch": (stretch, 3.2, 5.0, ({},)),
    "swim": (swim, 2.4, 5.0, ({},)),
    "talk": (talk, 2.8, 5.0, ({},)),
    "throw": (throw, 2.9, 4.7, SIDED),
}  # fmt: skip


def make(action: str, labels: Labels, number: int, each: int, seed: int) -> Motion:
    """One clip; its length is one of `each` between the shortest and the longest."""
    maker, short, long, _ = ACTIONS[action]
    params = spec_for({"action": action}, 1000 * seed + number).params
    seconds = short + (long - short) * number / max(each - 1, 1)
    t = np.arange(round(seconds * FPS)) / FPS
    scene = Scene(t, labels, params, np.random.default_rng((seed, number)))
    motion = solve(maker(scene))
    if action == "shrug":  # the rig's collar bones follow the arms alone
        for joint, sign in (("l_collar", 1), ("r_collar", -1)):
            half = 0.5 * sign * np.radians(24) * shrugged(scene)
            turn = np.stack([np.cos(half), *np.zeros((2, len(t))), np.sin(half)], -1)
            bone = torch.from_numpy(motion.quaternions[:, JOINT_INDEX[joint]]).double()
            turned = quaternion_multiply(torch.from_numpy(turn), bone)
            motion.quaternions[:, JOINT_INDEX[joint]] = turned.numpy()
    return motion


def main() -> None:
    """Write the clips and their table."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").partition("\n")[0])
    parser.add_argument("out", type=Path)
    parser.add_argument("--each", type=int, default=24, help="clips of each action and its labels")
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument("--actions", default=",".join(ACTIONS))
    options = parser.parse_args()
    actions = options.actions.split(",")
    if unknown := sorted({*actions} - {*ACTIONS}):
        parser.error(f"no such action: {', '.join(unknown)}; there are {', '.join(ACTIONS)}")
    if (options.out / "clips.tsv").exists():  # written last
        return
    options.out.mkdir(parents=True, exist_ok=True)
    rows = []
    for action in actions:
        for labels in ACTIONS[action][3]:
            name = "_".join((action, *labels.values()))
            for number in range(options.each):
                motion = make(action, labels, number, options.each, options.seed)
                file = f"{name}_{number:03d}"
                write_motion(motion, options.out / f"{file}.bvh")
                rows.append({"file": file, "action": action, **labels, "provenance": "procedural"})
    keys = ("file", "action", "side", "direction", "provenance")
    with (
        atomic_write(options.out / "clips.tsv") as path,
        path.open("w", encoding="utf-8", newline="") as stream,
    ):
        table = csv.DictWriter(stream, keys, delimiter="\t", restval="")
        table.writeheader()
        table.writerows(rows)


if __name__ == "__main__":
    main()
