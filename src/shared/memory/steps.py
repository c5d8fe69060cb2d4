"""Steps of social dances, made by code: feet land on exact counts, and what stands is known.

A step is a cycle of counts: on each a foot lands, taking the weight or touching, or nothing does.
The pelvis goes over the foot that has the weight, bounces on the counts (or rises, in a waltz), and
hips, chest and arms answer; the arms change their manner from cycle to cycle. Cycles close: they
end where and as they begin.

Letters: T frames, C counts of a cycle.
"""

from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace

import numpy as np

from ..data.synthetic.rig import (
    ABDUCT,
    BALL_LEAD,
    DEVIATE,
    ELBOW,
    FLEX,
    FPS,
    LEFT,
    PRONATE,
    RIGHT,
    TWIST,
    WRIST,
    Array,
    Body,
    bump,
    min_jerk,
    smooth_step,
    solve,
)
from ..motion.skeleton import REST_FOOT_HEIGHT
from .figures import Take

SOURCE, LICENCE = "made by code", "Apache-2.0"
PERIODS = (0.34, 0.44, 0.56)  # seconds a count; a choreographer warps them to all of 0.28 to 0.67
COUNTS = 24  # of a take, at least
SWING = 0.6  # of a count, in which a foot is off the floor
ARRIVES = 0.85  # of a count, in which the body goes to where it is on the count
CLEARANCE = 0.07  # metres
HURRIED = 1.7  # m/s of the pelvis: who counts fast makes small steps
APART = 0.1  # metres from the middle, of a foot that goes nowhere


@dataclass(frozen=True)
class Landing:
    """A foot that arrives on a count.

    Attributes:
        foot: L or R takes the weight, l or r does not.
        left, forward: metres from the middle of the cycle.
        heading: degrees that it faces to the left.
        height: metres off the floor, of a foot that stays in the air; 0 = it lands.
    """

    foot: str
    left: float
    forward: float
    heading: float = 0.0
    height: float = 0.0


Angles = dict[str, Array | float]  # of an arm, by name, degrees
Arms = Callable[[float, Array, Array, Array], Angles]


@dataclass(frozen=True)
class Steps:
    """A cycle of counts.

    Attributes:
        kind: what it is called.
        meter: counts of a bar.
        landings: C of them, the first on the first count of a bar; None: nothing lands.
        arms: manners of the arms, one a cycle, in turn.
        bounce: metres that the pelvis sinks on each count.
        rise: metres that it rises on the counts that are no first of a bar.
        turned: degrees to the left in a cycle.
        hips: degrees that the hips tilt and twist.
        dips: metres that the pelvis is lower on each count, in turn; none = nowhere.
        leans: degrees that the trunk is bent forward on each count, likewise.
        sway: degrees that the trunk is bent to the side of the weight.
    """

    kind: str
    meter: int
    landings: tuple[Landing | None, ...]
    arms: tuple[str, ...]
    bounce: float = 0.035
    rise: float = 0.0
    turned: float = 0.0
    hips: float = 6.0
    dips: tuple[float, ...] = ()
    leans: tuple[float, ...] = ()
    sway: float = 0.0


def _round_waltz() -> tuple[Landing, ...]:
    """Six steps round the middle, once round."""
    found = []
    for count, foot in enumerate("LRLRLR"):
        side, ahead = 0.1 if foot == "L" else -0.1, 0.16 if count % 3 == 0 else 0.06
        found.append(_turned(foot, side, ahead, 60.0 * (count + 1)))
    return tuple(found)


def _turning_box() -> tuple[Landing, ...]:
    """Four half boxes, ahead and back in turn, each a quarter further to the left."""
    ahead = (("L", 0.09, 0.18), ("R", -0.22, 0.16), ("L", -0.06, 0.16))
    back = (("R", -0.09, -0.18), ("L", 0.22, -0.16), ("R", 0.06, -0.16))
    bars = enumerate((ahead, back, ahead, back))
    return tuple(
        _turned(foot, left, forward, 90.0 * bar + (30.0, 75.0, 90.0)[count])
        for bar, steps in bars for count, (foot, left, forward) in enumerate(steps)
    )  # fmt: skip


def _turned(foot: str, left: float, forward: float, degrees: float) -> Landing:
    """A landing as who has turned so far to the left sees it."""
    heading = np.radians(degrees)
    across = left * np.cos(heading) + forward * np.sin(heading)
    along = forward * np.cos(heading) - left * np.sin(heading)
    return Landing(foot, float(across), float(along), degrees)


def _cycle(
    *landings: tuple[str, float, float] | tuple[str, float, float, float] | None,
) -> tuple[Landing | None, ...]:
    """Feet, left, forward and, of a foot in the air, its height; toes turned a little outward."""
    found: list[Landing | None] = []
    for each in landings:
        if each is None:
            found.append(None)
            continue
        foot, left, forward, *height = each
        out = 4.0 if foot in "Ll" else -4.0
        found.append(Landing(foot, left, forward, out, *height))
    return tuple(found)


STEPS = (
    Steps(
        "step touch", 4,
        _cycle(("L", 0.25, 0), ("r", 0.07, 0.02), ("R", -0.25, 0), ("l", -0.07, 0.02)),
        ("swing", "swing", "open", "open", "reach", "reach"),
    ),
    Steps(
        "step touch", 4,
        _cycle(("L", 0.3, 0.06), ("r", 0.2, -0.2), ("R", -0.3, 0.06), ("l", -0.2, -0.2)),
        ("circle", "circle", "high", "high", "push", "push"), bounce=0.05, hips=10.0,
        dips=(0.02, 0.08, 0.02, 0.08),
    ),
    Steps(
        "two-step", 4,
        _cycle(("L", 0.2, 0), ("R", 0.02, 0), ("L", 0.5, 0), ("r", 0.32, 0.02),
               ("R", 0.02, 0), ("L", 0.2, 0), ("R", -0.28, 0), ("l", -0.1, 0.02)),
        ("swing", "open", "push"), hips=8.0,
    ),
    Steps(
        "grapevine", 4,
        _cycle(("L", 0.15, 0), ("R", 0.27, -0.16), ("L", 0.55, 0), ("r", 0.42, 0.3, 0.22),
               ("R", 0.1, 0), ("L", -0.02, -0.16), ("R", -0.34, 0), ("l", -0.2, 0.3, 0.22)),
        ("open", "circle", "high"), bounce=0.025,
    ),
    Steps(
        "box step", 4,
        _cycle(("R", 0.1, 0.22), ("L", 0.14, -0.16), ("R", -0.2, -0.1), ("L", 0.08, 0.14)),
        ("swing", "push", "push", "circle", "high", "high"), bounce=0.04, hips=10.0,
    ),
    Steps(
        "bounce", 4,
        _cycle(("L", 0.2, 0), ("R", -0.2, 0), ("L", 0.2, 0.02), ("R", -0.2, 0.02)),
        ("push", "high", "high", "swing", "reach", "circle"), bounce=0.09, hips=12.0,
        dips=(0.06, 0.02, 0.1, 0.02),
    ),
    Steps(
        "kick step", 4,
        _cycle(("L", 0.1, 0), ("r", -0.05, 0.5, 0.35), ("R", -0.1, 0), ("l", 0.05, 0.5, 0.35)),
        ("swing", "open", "high", "push"), bounce=0.04, hips=6.0,
    ),
    Steps(
        "knee lift", 4,
        _cycle(("L", 0.16, 0), ("r", 0.0, 0.22, 0.42), ("R", -0.16, 0), ("l", 0.0, 0.22, 0.42)),
        ("reach", "push", "high", "circle"), bounce=0.05, hips=8.0,
    ),
    Steps(
        "lunge step", 4,
        _cycle(("L", 0.42, 0.05), None, ("L", 0.1, 0), ("R", -0.1, 0.0),
               ("R", -0.42, 0.05), None, ("R", -0.1, 0), ("L", 0.1, 0.0)),
        ("reach", "open", "sweep"), bounce=0.02, dips=(0.16, 0.18, 0.0, 0.0),
    ),
    Steps(
        "waltz", 3,
        _cycle(("L", 0.09, 0.32), ("R", -0.24, 0.32), ("L", -0.07, 0.32),
               ("R", -0.24, 0), ("L", 0.09, 0), ("R", -0.09, 0)),
        ("hold", "bloom", "hold", "flow"), bounce=0.03, rise=0.05, hips=3.0, sway=8.0,
    ),
    Steps(
        "balance step", 3,
        _cycle(("L", 0.32, 0), ("r", 0.14, -0.26), None,
               ("R", -0.32, 0), ("l", -0.14, -0.26), None),
        ("sweep", "fan", "gather", "bloom"), bounce=0.02, rise=0.0, hips=4.0,
        dips=(0.02, 0.22, 0.14), leans=(0, 22, 10), sway=10.0,
    ),
    Steps(
        "waltz", 3, _round_waltz(), ("hold", "hold", "bloom"),
        bounce=0.025, rise=0.045, turned=360.0, hips=3.0, sway=4.0,
    ),
    Steps(
        "waltz", 3, _turning_box(), ("hold", "flow", "hold", "bloom"),
        bounce=0.03, rise=0.05, turned=360.0, hips=3.0, sway=6.0,
    ),
    Steps(
        "waltz", 3,
        _cycle(("L", 0.12, 0.26), ("r", -0.06, 0.24), None,
               ("R", -0.12, -0.2), ("l", 0.06, -0.18), None),
        ("flow", "hold", "gather"), bounce=0.02, rise=0.04, hips=3.0, sway=6.0,
        leans=(4, 0, 0, -4, 0, 0),
    ),
    Steps(
        "balance step", 3,
        _cycle(("L", 0.08, 0.3), ("r", -0.08, 0.75, 0.36), None,
               ("R", -0.08, -0.05), ("l", 0.1, -0.55, 0.42), None),
        ("bloom", "sweep", "fan", "flow"), bounce=0.015, rise=0.02, hips=4.0,
        leans=(0, -14, -8, 0, 34, 24),
    ),
    Steps(
        "balance step", 3,
        _cycle(("L", 0.46, 0.02), None, ("R", 0.3, 0.0), ("R", -0.46, 0.02), None, ("L", -0.3, 0)),
        ("sweep", "gather", "fan"), bounce=0.01, rise=0.0, hips=3.0, dips=(0.16, 0.22, 0.0),
        leans=(4, 10, 0), sway=16.0,
    ),
    Steps(
        "waltz", 3,
        _cycle(("L", -0.16, 0.2), ("R", -0.3, 0.04), ("L", -0.12, 0.0),
               ("R", 0.16, 0.2), ("L", 0.3, 0.04), ("R", 0.12, 0.0)),
        ("hold", "sweep", "flow"), bounce=0.03, rise=0.045, hips=4.0, sway=10.0,
    ),
    Steps(
        "balance step", 3,
        _cycle(("L", 0.1, 0), ("r", -0.5, 0.1, 0.34), None,
               ("R", -0.1, 0), ("l", 0.5, 0.1, 0.34), None),
        ("gather", "sweep", "bloom"), bounce=0.02, rise=0.02, hips=8.0, dips=(0.08, 0.0, 0.0),
        sway=-14.0,
    ),
    Steps(
        "balance step", 3,
        _cycle(("L", 0.1, -0.2), ("r", -0.08, 0.2), None, ("R", -0.1, 0.1), ("L", 0.1, 0.12), None),
        ("flow", "gather", "bloom"), bounce=0.01, rise=0.0, hips=3.0,
        dips=(0.04, 0.18, 0.2, 0.02, 0.0, 0.0), leans=(6, 44, 50, 10, -8, -10),
    ),
)  # fmt: skip


def made_takes() -> Iterator[Take]:
    """Every step at every tempo."""
    for number, steps in enumerate(STEPS):
        for period in PERIODS:
            yield made_take(steps, period, number)


def made_take(steps: Steps, period: float, number: int = 0) -> Take:
    """A step at `period` seconds a count, danced on and on; its name tells the number."""
    length = len(steps.landings)
    counts = np.arange(-(-COUNTS // length) * length + 1)
    time = np.arange(round((len(counts) + 1) * period * FPS)) / FPS / period - 1  # counts
    body = _body(steps, time, period)
    pelvis = np.diff(body.position[:, [0, 2]], axis=0)
    quickest = float(np.linalg.norm(pelvis, axis=1).max()) * FPS
    if quickest > HURRIED:
        body = _body(_narrowed(steps, HURRIED / quickest), time, period)
    name = f"{steps.kind.replace(' ', '-')}-{number}-{60 / period:.0f}bpm"
    return Take(
        name, steps.kind, SOURCE, LICENCE, solve(body), (counts + 1) * period, meter=steps.meter
    )


def _narrowed(steps: Steps, share: float) -> Steps:
    """With so much of the way that each foot goes from where it would stand in the middle."""
    landings = []
    for each in steps.landings:
        if each is not None:
            base = APART if each.foot in "Ll" else -APART
            left = base + share * (each.left - base)
            each = replace(each, left=left, forward=share * each.forward)
        landings.append(each)
    return replace(steps, landings=tuple(landings))


# ---------------------------------------------------------------- the body


def _body(steps: Steps, time: Array, period: float) -> Body:
    """Control curves at times [T] in counts from the first landing."""
    body, length = Body.standing(len(time)), len(steps.landings)
    stop = int(np.ceil(time[-1])) + length
    weight, heading, over = _feet(steps, body, time, range(-2 * length, stop))
    body.yaw[:] = heading
    side = 2 * weight - 1  # 1 on the left foot, -1 on the right one
    sine, cosine = np.sin(heading), np.cos(heading)
    body.position[:, 0] = over[:, 0] - BALL_LEAD * sine
    body.position[:, 2] = over[:, 1] - BALL_LEAD * cosine
    down = 0.5 + 0.5 * np.cos(2 * np.pi * time)
    bar = time % steps.meter
    up = bump(np.clip((bar - 0.35) / (steps.meter - 0.35), 0, 1), 0.6)
    body.position[:, 1] += -0.025 - steps.bounce * down + steps.rise * up
    dip = _by_count(steps.dips, time)
    body.position[:, 1] -= dip
    body.spine[:, 0] += 1.2 * dip + np.radians(_by_count(steps.leans, time))
    body.spine[:, 2] -= np.radians(steps.sway) * side
    tilt = np.radians(steps.hips) * side
    body.roll[:] += 0.6 * tilt
    body.yaw[:] += 0.5 * tilt
    body.spine[:, 2] -= 0.9 * tilt
    body.spine[:, 1] -= 1.2 * tilt
    body.spine[:, 0] += np.radians(2.0) + np.radians(60.0) * steps.bounce * down
    body.head[:, 0] += np.radians(40.0) * steps.bounce * down
    body.head[:, 1] += 0.6 * tilt
    cycles = [ARMS[steps.arms[n % len(steps.arms)]] for n in range(stop // length + 2)]
    which = np.floor(time / length).astype(int) + 1
    fade = min_jerk((time % length) / 0.8)  # from the manner of the cycle before
    made = {manner: _arms(manner, time, side, up) for manner in set(cycles)}
    now = np.stack([made[cycles[n]][frame] for frame, n in enumerate(which)])
    past = np.stack([made[cycles[max(n - 1, 0)]][frame] for frame, n in enumerate(which)])
    body.arms[:] = past + (now - past) * fade[:, None, None]
    return body


def _by_count(values: tuple[float, ...], time: Array) -> Array:
    """What holds on each count, in turn, and smoothly between them [T]; none = 0."""
    if not values:
        return np.zeros(len(time))
    known, count = np.array(values), np.floor(time).astype(int)
    now, then = known[count % len(known)], known[(count + 1) % len(known)]
    return np.asarray(now + (then - now) * smooth_step(time - count))


def _feet(steps: Steps, body: Body, time: Array, span: range) -> tuple[Array, Array, Array]:
    """Write both feet; the share of weight on the left one [T], heading [T] in radians, and the
    point over which the pelvis is [T,2] (left, forward)."""
    length = len(steps.landings)
    weight = np.full(len(time), 0.5)
    heading = np.zeros(len(time))
    places: list[tuple[int, int, Array, bool]] = []
    for count in span:
        landing = steps.landings[count % length]
        if landing is None:
            continue
        turns = np.radians(landing.heading + steps.turned * (count // length))
        place = np.array([landing.left, landing.forward, turns, landing.height])
        side = LEFT if landing.foot in "Ll" else RIGHT
        places.append((count, side, place, landing.foot.isupper()))
    for side in (LEFT, RIGHT):
        own = [(count, place, whole) for count, which, place, whole in places if which == side]
        _plan(body, side, time, own)
    for count, side, place, whole in places:
        goes = min_jerk((time - count + ARRIVES) / ARRIVES)
        if whole:
            weight = weight + (float(side == LEFT) - weight) * goes
        if steps.turned:
            heading = heading + (place[2] - heading) * goes
    share = 0.5 + 0.38 * (2 * weight - 1)
    stands = _standing_points(time, places)
    over = stands[:, LEFT] * share[:, None] + stands[:, RIGHT] * (1 - share[:, None])
    return weight, heading, over


def _standing_points(time: Array, places: list[tuple[int, int, Array, bool]]) -> Array:
    """Where each foot stands [T,2,2], going from one place to the next while it swings."""
    found = np.zeros((len(time), 2, 2))
    for count, side, place, _ in places:
        if place[3]:
            continue  # a foot in the air carries nothing
        goes = min_jerk((time - count + ARRIVES) / ARRIVES)[:, None]
        found[:, side] += (place[:2] - found[:, side]) * goes
    return found


def _plan(body: Body, side: int, time: Array, own: list[tuple[int, Array, bool]]) -> None:
    """One foot: still where it landed, off the floor for a part of a count before the next one."""
    sign = 1.0 if side == LEFT else -1.0
    ball, pitch = body.ball[:, side], body.foot_pitch[:, side]
    body.contacts[:, side] = 1.0
    turn = np.zeros(len(time))
    for index, (count, place, whole) in enumerate(own):
        progress = np.clip((time - count + SWING) / SWING, 0, 1)
        goes = smooth_step(progress)
        ball[:, 0] += (place[0] - ball[:, 0]) * goes
        ball[:, 2] += (place[1] - ball[:, 2]) * goes
        turn += (place[2] - turn) * goes
        until = own[index + 1][0] - SWING if index + 1 < len(own) else count + 1
        swings = (progress > 0) & (progress < 1)
        arc = CLEARANCE * bump(progress) * swings
        ball[:, 1] += (REST_FOOT_HEIGHT + place[3] - ball[:, 1]) * goes
        ball[:, 1] += arc
        free = (progress > 0) & (time < until) if place[3] else swings
        body.contacts[free, side] = 0.0
        heel = np.radians(-28.0)  # up before it leaves, and while it touches only
        leaves = min_jerk((time - count + SWING + 0.3) / 0.3) * (1 - min_jerk(progress / 0.6))
        pitch += heel * leaves
        if not whole:
            rests = min_jerk((time - count + 0.3) / 0.3)
            rests *= 1 - min_jerk((time - until + 0.3) / 0.3)
            pitch += heel * rests
    body.foot_yaw[:, side] = turn + sign * 0.12


# ---------------------------------------------------------------- arms, in degrees

_INDEX = {"flex": FLEX, "abduct": ABDUCT, "twist": TWIST, "elbow": ELBOW, "pronate": PRONATE,
          "wrist": WRIST, "deviate": DEVIATE}  # fmt: skip


def _arms(manner: Arms, time: Array, side: Array, up: Array) -> Array:
    """Radians [T,2,7] of both arms; what a manner does not name hangs.

    Args:
        manner: of one arm.
        time: in counts [T].
        side: where the weight is [T], from 1 on the left foot to -1 on the right one.
        up: 0 to 1 [T], high on the counts that are no first of a bar.
    """
    found = np.zeros((len(time), 2, 7))
    found[..., :5] = (4.0, 12.0, -12.0, 20.0, 12.0)
    found[..., WRIST] = 6.0
    for arm, sign in ((LEFT, 1.0), (RIGHT, -1.0)):
        for name, value in manner(sign, time, sign * side, up).items():
            found[:, arm, _INDEX[name]] = value
    return np.radians(found)


def _wave(time: Array, counts: float, lag: float = 0.0) -> Array:
    """-1 to 1, once in so many counts; 1 at the first one."""
    return np.asarray(np.cos(2 * np.pi * (time - lag) / counts))


# Manners: `sign` is 1 for the left arm and -1 for the right one, `own` 1 where the weight is on the
# arm's own side and -1 where it is on the other; the rest is as of `_arms`.


def _swing(sign: float, time: Array, own: Array, up: Array) -> Angles:
    """Bent arms that swing against the hips."""
    bent = 78 + 14 * _wave(time, 1)
    return {"flex": 18 - 34 * own, "abduct": 20.0, "elbow": bent, "twist": -20.0}


def _open(sign: float, time: Array, own: Array, up: Array) -> Angles:
    """Out to the sides on one count, before the chest on the next."""
    out = 0.5 + 0.5 * _wave(time, 2)
    return {
        "flex": 48 - 30 * out, "abduct": 18 + 62 * out + 8 * own,
        "elbow": 112 - 88 * out, "twist": -20 + 30 * out, "wrist": 20 - 30 * out,
    }  # fmt: skip


def _reach(sign: float, time: Array, own: Array, up: Array) -> Angles:
    """The arm over the standing leg reaches up and out, the other hand rests near the hip."""
    high = min_jerk(0.5 + 0.5 * own)
    return {
        "flex": 8 + 42 * high, "abduct": 38 + 88 * high, "elbow": 82 - 66 * high,
        "twist": -35 + 60 * high, "wrist": 10 - 20 * high,
    }  # fmt: skip


def _circle(sign: float, time: Array, own: Array, up: Array) -> Angles:
    """Hands go round each other before the body, up on one side and down on the other."""
    lag = 1 - sign  # half a turn behind
    rises, out = _wave(time, 4, lag), np.sin(2 * np.pi * (time - lag) / 4)
    return {
        "flex": 55 + 42 * rises, "abduct": 25 + 22 * sign * out, "elbow": 78 - 26 * rises,
        "twist": 15.0 + 15 * rises,
    }  # fmt: skip


def _high(sign: float, time: Array, own: Array, up: Array) -> Angles:
    """Both arms overhead, swaying with the weight and pumping on the counts."""
    pump = 10 * _wave(time, 1)
    return {
        "flex": 128.0 + pump, "abduct": 30 + 22 * own, "elbow": 42 - 14 * own,
        "twist": 20.0, "wrist": 12 * _wave(time, 1, 0.2),
    }  # fmt: skip


def _push(sign: float, time: Array, own: Array, up: Array) -> Angles:
    """One arm pushes forward and up while the other elbow draws back."""
    out = min_jerk(0.5 - 0.5 * own)
    return {
        "flex": -22 + 100 * out, "abduct": 26.0 - 10 * out, "elbow": 112 - 92 * out,
        "twist": -25 + 25 * out, "wrist": -30 * out,
    }  # fmt: skip


def _flow(sign: float, time: Array, own: Array, up: Array) -> Angles:
    """Long arms that float out and sway across with the weight."""
    return {
        "flex": 26 - 26 * own, "abduct": 34 + 20 * up + 18 * own,
        "elbow": 58 - 12 * up - 14 * own, "twist": 15.0, "wrist": -14 * up,
    }  # fmt: skip


def _hold(sign: float, time: Array, own: Array, up: Array) -> Angles:
    """As if round a partner: elbows out at the height of the shoulders, forearms ahead."""
    return {
        "flex": 38.0, "abduct": 62 + 6 * up, "elbow": 86.0 - 6 * up, "twist": -25.0, "wrist": 8.0,
    }  # fmt: skip


def _gather(sign: float, time: Array, own: Array, up: Array) -> Angles:
    """Crossed low before the body, then wide open and high, once in two bars of three."""
    wide = min_jerk(0.5 - 0.5 * _wave(time, 6))
    return {
        "flex": 62 - 40 * wide, "abduct": -8 + 108 * wide, "elbow": 84 - 44 * wide,
        "twist": -30 + 70 * wide, "wrist": 20 - 30 * wide,
    }  # fmt: skip


def _fan(sign: float, time: Array, own: Array, up: Array) -> Angles:
    """Arms go round in great arcs, one half a turn behind the other."""
    lag = 1.5 * (1 - sign)
    rises = 0.5 - 0.5 * _wave(time, 6, lag)
    ahead = 0.5 + 0.5 * np.sin(2 * np.pi * (time - lag) / 6)
    return {
        "flex": 10 + 135 * rises * ahead, "abduct": 15 + 96 * rises * (1 - ahead),
        "elbow": 66 - 30 * rises, "twist": 40 * rises,
    }  # fmt: skip


def _bloom(sign: float, time: Array, own: Array, up: Array) -> Angles:
    """From low before the body to overhead and out to the sides, once in two bars."""
    rises = 0.5 - 0.5 * _wave(time, 6)
    out = bump(rises, 0.6)
    return {
        "flex": 22 + 118 * rises, "abduct": 14 + 34 * out + 10 * own,
        "elbow": 76 - 22 * rises, "twist": 5 + 25 * rises, "wrist": 10 - 24 * out,
    }  # fmt: skip


def _sweep(sign: float, time: Array, own: Array, up: Array) -> Angles:
    """One arm sweeps up to the side of the weight, the other rests low behind it."""
    high = min_jerk(0.5 + 0.5 * own)
    return {
        "flex": -12 + 50 * high, "abduct": 30 + 84 * high, "elbow": 70 - 38 * high,
        "twist": 40 * high, "wrist": -12 + 20 * high,
    }  # fmt: skip


ARMS: dict[str, Arms] = {
    "swing": _swing, "open": _open, "reach": _reach, "circle": _circle, "high": _high,
    "push": _push, "flow": _flow, "bloom": _bloom, "sweep": _sweep, "gather": _gather,
    "fan": _fan, "hold": _hold,
}  # fmt: skip
