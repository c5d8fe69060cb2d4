"""Travelling and turning on the feet: walk, run, side-step, crouch-walk, turn, spin.

T frames; lengths in metres, speeds in m/s, angles of gaits in degrees, others in radians. Each foot
stands still between two swings; it is planted where the path will be in the middle of its stance,
which serves walking in any direction, arcs, starts, stops and turns. The placing of the feet under
the pelvis (`lead`) was chosen so that neither leg has to reach further than it is long.
"""

from dataclasses import dataclass, replace
from functools import partial

import numpy as np
from scipy.integrate import cumulative_trapezoid

from ...motion.skeleton import REST_FOOT_HEIGHT, REST_PELVIS_HEIGHT
from .rig import (
    ABDUCT,
    BALL_LEAD,
    ELBOW,
    FLEX,
    LEFT,
    RIGHT,
    TWIST,
    Array,
    Body,
    Scene,
    bump,
    min_jerk,
    ramp,
    smooth_noise,
    smooth_step,
)

_GRID_FPS = 120.0
_BALL_TO_HEEL = 0.17  # metres; raises the ball when the heel strikes first
_SETTLE = 0.16  # share of the stance the foot needs to come down flat
_FOREVER = 1e3


@dataclass(frozen=True)
class Gait:
    """How a travelling body moves; lengths in metres, angles in degrees.

    Attributes:
        period: seconds a stride. duty: share of it that a foot stands.
        width: between the feet. sink: below straight-legged standing.
        bob: positive where the pelvis is highest over the standing leg (walking), negative where
            it is lowest (running).
        clearance: that the ball rises. lead: of the ball in front of the pelvis.
        toe_off, strike: foot pitch when it leaves (negative) and lands.
        peak: share of the swing at which the ball is highest.
        heel_off: share of the stance after which the heel rises.
    """

    period: float
    duty: float
    width: float
    sink: float
    bob: float
    sway: float
    lean: float
    pelvis_yaw: float
    chest_yaw: float
    pelvis_roll: float
    arm_swing: float
    elbow: float
    elbow_swing: float
    clearance: float
    toe_off: float
    strike: float
    lead: float = BALL_LEAD
    arm_out: float = 0.0
    peak: float = 0.4
    heel_off: float = 0.45


def walk_gait(speed: float) -> Gait:
    """Walking forward."""
    pace = speed / 1.2
    return Gait(
        period=2 * 0.51 * speed**-0.45, duty=0.62 - 0.02 * (pace - 1), width=0.15,
        sink=0.012, bob=0.016 * pace**0.8, sway=0.026 / pace**0.5, lean=1.5 + 1.5 * pace,
        pelvis_yaw=5.0 * pace**0.6, chest_yaw=5.0 * pace**0.6, pelvis_roll=3.0,
        arm_swing=20.0 * pace**0.7, elbow=6.0 * pace, elbow_swing=8.0 * pace,
        clearance=0.035, toe_off=-42.0 * pace**0.3, heel_off=0.5, strike=19.0 * pace**0.4,
        lead=0.035,
    )  # fmt: skip


def run_gait(speed: float) -> Gait:
    """Running forward: bent arms, heels high behind."""
    pace = speed / 3.2
    return Gait(
        period=0.86 - 0.055 * speed, duty=0.335 - 0.15 * (pace - 1), width=0.11,
        sink=0.065, bob=-0.034, sway=0.012, lean=9.0 * pace**0.7,
        pelvis_yaw=8.0, chest_yaw=10.0, pelvis_roll=4.0,
        arm_swing=34.0 * pace**0.5, elbow=68.0, elbow_swing=12.0, arm_out=5.0,
        clearance=0.27 * pace**0.8, toe_off=-62.0, heel_off=0.35, strike=6.0,
        lead=0.0, peak=0.42,
    )  # fmt: skip


def backward_gait(speed: float) -> Gait:
    """Walking backward: toes first, short steps, little arm swing."""
    return replace(
        walk_gait(speed + 0.3),
        period=0.95 - 0.12 * speed, width=0.18, sink=0.03, bob=0.010, lean=3.0,
        pelvis_yaw=2.5, chest_yaw=2.0, arm_swing=8.0, elbow_swing=3.0,
        clearance=0.05, toe_off=-8.0, strike=-16.0, lead=0.09,
    )  # fmt: skip


def sideways_gait(speed: float, discrete: bool) -> Gait:
    """Moving sideways, feet closing without crossing; `discrete` steps are shorter."""
    period = (1.0 - 0.35 * speed) if discrete else (1.1 - 0.32 * speed)
    return replace(
        walk_gait(0.7),
        period=period, duty=0.62, width=0.13 + 0.5 * speed * period,
        sink=0.035, bob=0.010, sway=0.012, lean=2.0, pelvis_yaw=0.0, chest_yaw=0.0,
        pelvis_roll=2.0, arm_swing=2.0, elbow=8.0, elbow_swing=0.0, arm_out=5.0,
        clearance=0.07, toe_off=-12.0, strike=-6.0, lead=BALL_LEAD,
    )  # fmt: skip


def crouched_gait(speed: float) -> Gait:
    """Walking with bent knees and the trunk forward."""
    return replace(
        walk_gait(speed),
        period=1.12 - 0.22 * speed, width=0.2, sink=0.27, bob=0.008, lean=24.0,
        pelvis_roll=2.0, arm_swing=9.0, elbow=48.0, arm_out=8.0,
        clearance=0.06, toe_off=-30.0, strike=8.0, lead=0.10,
    )  # fmt: skip


def stepping_in_place(period: float, quick: bool) -> Gait:
    """Stepping on the spot, arms carried wider when `quick`."""
    return replace(
        walk_gait(0.7),
        period=period, duty=0.6, width=0.19, sink=0.022, bob=0.007, sway=0.02, lean=1.0,
        pelvis_yaw=0.0, chest_yaw=0.0, arm_swing=3.0, elbow=14.0 if quick else 4.0,
        elbow_swing=0.0, arm_out=14.0 if quick else 3.0,
        clearance=0.06, toe_off=-20.0, strike=0.0, lead=BALL_LEAD,
    )  # fmt: skip


class Path:
    """Pelvis path over the ground: x, z in metres and heading in radians, by integration."""

    def __init__(self, t: Array, forward: Array, lateral: Array, yaw_rate: Array) -> None:
        """Curves on an even grid of seconds `t`: m/s, m/s (to the left), rad/s.

        The path starts at the origin and faces +Z at time 0.
        """
        integrate = partial(cumulative_trapezoid, x=t, initial=0)
        heading = integrate(yaw_rate)
        heading -= np.interp(0.0, t, heading)
        sine, cosine = np.sin(heading), np.cos(heading)
        self._t, self._heading = t, heading
        self._x = integrate(forward * sine + lateral * cosine)
        self._z = integrate(forward * cosine - lateral * sine)

    def at(self, t: Array) -> tuple[Array, Array, Array]:
        """x, z, heading [T] at times [T]; the ends are held."""
        return (
            np.interp(t, self._t, self._x),
            np.interp(t, self._t, self._z),
            np.interp(t, self._t, self._heading),
        )


def time_grid(start: float, end: float) -> Array:
    """Fine even grid of seconds to integrate a path on."""
    return np.linspace(start, end, max(int((end - start) * _GRID_FPS), 2) + 1)


def _plan_foot(
    body: Body,
    side: int,
    t: Array,
    path: Path,
    gait: Gait,
    lifts: Array,
    lands: Array,
    *,
    toe_out: float,
    stride: float,
) -> None:
    """Write one foot for frames at times `t`: ball, yaw, pitch, toes, contacts.

    Args:
        lifts, lands: times [N] in seconds of its swings in order.
        toe_out: radians.
        stride: metres of a full-sized swing; shorter ones pitch and rise less.
    """
    sign = 1.0 if side == LEFT else -1.0
    toe_off, strike = np.radians(gait.toe_off), np.radians(gait.strike)
    begins = np.concatenate(([-_FOREVER], lands))  # of stance n
    ends = np.concatenate((lifts, [_FOREVER]))
    x, z, heading = path.at((begins + ends) / 2)
    across = sign * gait.width / 2
    x = x + across * np.cos(heading) + gait.lead * np.sin(heading)
    z = z - across * np.sin(heading) + gait.lead * np.cos(heading)
    length = np.hypot(np.diff(x), np.diff(z)) / stride  # of swing n, 1 = full-sized
    turned = np.abs(np.diff(heading)) / 1.5
    size = np.clip(np.maximum(length, turned), 0.2, 1.1)

    stance = np.searchsorted(lifts, t, side="right")  # the stance that is, or is about to begin
    before = np.maximum(stance - 1, 0)
    lift, land = np.append(lifts, _FOREVER)[before], np.append(lands, _FOREVER)[before]
    progress = np.where(stance > 0, np.clip((t - lift) / (land - lift), 0.0, 1.0), 1.0)
    moved = smooth_step(progress)
    body.ball[:, side, 0] = x[before] + (x[stance] - x[before]) * moved
    body.ball[:, side, 2] = z[before] + (z[stance] - z[before]) * moved
    yaw = heading[before] + (heading[stance] - heading[before]) * moved
    body.foot_yaw[:, side] = yaw + sign * toe_out

    sizes = np.concatenate(([0.2], size, [0.2]))
    last, following = sizes[stance], sizes[np.minimum(stance + 1, len(sizes) - 1)]
    swing_time = float(np.median(lands - lifts)) if len(lifts) else 0.4
    nominal = np.minimum(ends[stance] - begins[stance], 2.2 * swing_time)
    since_land = np.where(stance > 0, t - begins[stance], _FOREVER) / nominal
    until_lift = (ends[stance] - t) / nominal
    # The heel goes on rising for a moment after the toes have left the ground.
    rising = min_jerk((1.0 - until_lift / (1.0 - gait.heel_off)) / 1.15)
    settling = 1.0 - min_jerk(since_land / _SETTLE)
    swinging = progress < 1.0
    released = min_jerk(np.array(1.0 / 1.15))
    still_rising = released + (1 - released) * min_jerk(progress / 0.2)
    recovery = smooth_step((progress - 0.05) / 0.75)
    landing = min_jerk((progress - 0.35) / 0.65)
    pitch_swing = toe_off * still_rising * (1 - recovery) + strike * landing
    pitch_stance = following * toe_off * rising + last * strike * settling
    pitch = np.where(swinging, last * pitch_swing, pitch_stance)
    body.foot_pitch[:, side] = pitch
    lifted = last * gait.clearance * bump(progress, gait.peak) * swinging
    heel_first = _BALL_TO_HEEL * np.sin(np.maximum(pitch, 0.0))
    body.ball[:, side, 1] = REST_FOOT_HEIGHT + lifted + heel_first
    body.toes_flat[:, side] = np.where(swinging, 1.0 - min_jerk(progress / 0.3), 1.0)
    body.contacts[:, side] = ~swinging


def travel(scene: Scene) -> Body:
    """walk, run, side-step, crouch-walk: constant speed between an optional start and stop."""
    action, direction = scene.labels["action"], scene.labels["direction"]
    speed = scene.params["speed"]
    if action == "run":
        gait = run_gait(speed)
    elif action == "crouch-walk":
        gait = crouched_gait(speed)
    elif direction == "backward":
        gait = backward_gait(speed)
    elif direction in ("left", "right"):
        gait = sideways_gait(speed, discrete=action == "side-step")
    else:
        gait = walk_gait(speed)
    half = 0.5 * gait.period / scene.params["tempo"] ** 0.5
    gait = replace(gait, period=2 * half)
    start, stop = _start_and_stop(scene, half, action)
    swing = 2 * half * (1 - gait.duty)
    stop = start + swing + half * max(np.floor((stop - start - swing) / half), 1.0)
    grid = time_grid(scene.t[0] - 4.0, scene.t[-1] + 4.0)
    envelope = ramp(grid, start, (2.0 if action == "run" else 1.4) * half)
    envelope = envelope * (1 - ramp(grid, stop - 1.8 * half, 2.0 * half))
    pace = speed * envelope
    sign = {"forward": 1.0, "backward": -1.0, "left": 1.0, "right": -1.0}[direction]
    zero = np.zeros_like(grid)
    along, across = (zero, sign * pace) if direction in ("left", "right") else (sign * pace, zero)
    path = Path(grid, along, across, _arc(scene, grid, start, envelope))
    first = LEFT if scene.params["variant"] < 0.5 else RIGHT
    if direction in ("left", "right"):
        first = LEFT if direction == "left" else RIGHT
    return _stride(scene, gait, path, first, start, stop, sign, np.interp(scene.t, grid, envelope))


def _start_and_stop(scene: Scene, half: float, action: str) -> tuple[float, float]:
    """When stepping starts and stops; far outside the clip where it should not be seen."""
    entry, seconds = scene.params["entry"], scene.t[-1]
    offset = scene.params["variant"] * 2 * half
    start, stop = -3.0 - offset, seconds + 3.0
    if 0.45 < entry <= 0.75 or entry > 0.9:
        start = 0.15 + 0.5 * scene.params["length"]
    if entry > 0.75 and action != "run":
        stop = seconds - 0.45
    return start, stop


def _arc(scene: Scene, grid: Array, start: float, envelope: Array) -> Array:
    """Yaw rate along the path: a steady arc, or a nearly straight line."""
    if "turn" not in scene.labels:
        return np.asarray(0.02 * np.sin(grid * 1.3 + 6 * scene.params["variant"]) * envelope)
    sign = 1.0 if scene.labels["turn"] == "left" else -1.0
    seconds = scene.t[-1] - max(start, 0.0)
    total = np.radians(75.0 + 60.0 * scene.params["length"])  # seen within the clip
    if scene.params["variant"] < 0.5:  # all the way round an arc
        return np.asarray(sign * total / seconds * envelope)
    # straight, a bend, straight again
    begin, duration = max(start, 0.0) + 0.2 * seconds, 0.6 * seconds
    progress = (grid - begin) / duration
    step = grid[1] - grid[0]
    return np.asarray(sign * total * np.gradient(min_jerk(progress), step))


def _stride(
    scene: Scene,
    gait: Gait,
    path: Path,
    first: int,
    start: float,
    stop: float,
    sign: float,
    envelope: Array,
) -> Body:
    """A body that walks along `path` with the given gait; steps from `start` to `stop`.

    `first` is the foot (LEFT or RIGHT) of the first swing; feet alternate.
    """
    t, params, half = scene.t, scene.params, gait.period / 2
    swing = (1 - gait.duty) * gait.period
    lifts = start + half * np.arange(round((stop - start - swing) / half) + 1)
    width, clearance = gait.width * params["width"], gait.clearance * params["amplitude"]
    gait = replace(gait, width=width, clearance=clearance)
    body = scene.standing()
    for side in (LEFT, RIGHT):
        which = slice((side - first) % 2, None, 2)
        _plan_foot(
            body, side, t, path, gait, lifts[which], (lifts + swing)[which],
            toe_out=np.radians(params["toe_out"]),
            stride=max(params.get("speed", 0.3) * gait.period, 0.3),
        )  # fmt: skip
    phase = np.pi * (t - start - swing / 2) / half  # 0 in the middle of a left swing
    if first == RIGHT:
        phase = phase + np.pi
    _carry(scene, body, gait, path, phase, envelope, sign)
    return body


def _carry(
    scene: Scene, body: Body, gait: Gait, path: Path, phase: Array, envelope: Array, sign: float
) -> None:
    """Pelvis, trunk and arms of a striding body; `phase` is 0 in the middle of a left swing."""
    t, params = scene.t, scene.params
    x, z, heading = path.at(t)
    sway = -gait.sway * envelope * np.cos(phase)
    # A walker is slowest over the standing leg.
    surge = -0.4 * max(gait.bob, 0.0) * sign * envelope * np.sin(2 * phase)
    body.position[:, 0] = x + sway * np.cos(heading) + surge * np.sin(heading)
    body.position[:, 2] = z - sway * np.sin(heading) + surge * np.cos(heading)
    bob = gait.bob * params["bounce"] * np.cos(2 * phase)
    body.position[:, 1] = REST_PELVIS_HEIGHT - 0.012 + (bob - gait.sink) * envelope
    swing = np.sin(phase - 0.15) * envelope * (sign if gait.arm_swing > 5 else 1.0)
    vary = params["amplitude"]
    body.yaw[:] = heading - np.radians(gait.pelvis_yaw) * vary * swing
    twist = np.radians(gait.pelvis_yaw + gait.chest_yaw) * vary * swing
    body.spine[:, 1] += twist
    # The pelvis drops on the side of the swinging leg, the chest stays level.
    drop = np.radians(gait.pelvis_roll) * np.cos(phase) * envelope
    body.roll[:] += -drop
    body.spine[:, 2] += drop
    body.pitch[:] += 0.45 * np.radians(gait.lean) * envelope
    body.spine[:, 0] += 0.55 * np.radians(gait.lean) * envelope
    _lean_into_turn(body, t, heading, x, z)
    reach = np.radians(gait.arm_swing) * params["swing"]
    for side, direction in ((LEFT, -1.0), (RIGHT, 1.0)):
        arm = body.arms[:, side]
        ahead = direction * swing
        arm[:, FLEX] += reach * (ahead + 0.1 * envelope)
        arm[:, ELBOW] += np.radians(gait.elbow) * envelope
        arm[:, ELBOW] += np.radians(gait.elbow_swing) * (ahead + 0.4 * envelope)
        arm[:, ABDUCT] += np.radians(gait.arm_out) * envelope
        if gait.elbow > 40:  # bent arms swing towards the middle of the body
            arm[:, TWIST] -= np.radians(8.0) * (1 + ahead) * envelope
            arm[:, FLEX] -= np.radians(8.0) * envelope
    body.head[:, 1] += smooth_noise(scene.rng, t, 0.06, 3.0)


def _lean_into_turn(body: Body, t: Array, heading: Array, x: Array, z: Array) -> None:
    """Roll towards the inside of an arc by the centripetal acceleration; look ahead into it."""
    rate = np.gradient(heading, t)
    speed = np.hypot(np.gradient(x, t), np.gradient(z, t))
    lean = np.clip(np.arctan(speed * rate / 9.81), -0.3, 0.3)
    body.roll[:] -= 0.6 * lean
    body.spine[:, 2] -= 0.3 * lean
    body.head[:, 1] += np.clip(0.25 * rate, -0.5, 0.5)
    body.spine[:, 1] += np.clip(0.06 * rate, -0.15, 0.15)


def turn_in_place(scene: Scene) -> Body:
    """turn (90° or 180°) and spin (one full turn) by small steps on the spot."""
    spin = scene.labels["action"] == "spin"
    sign = 1.0 if scene.labels["direction"] == "left" else -1.0
    degrees = 360.0 if spin else float(scene.labels["angle"])
    half = (0.30 if spin else 0.44) / scene.params["tempo"]
    steps = {90.0: 4, 180.0: 6, 360.0: 7}[degrees]
    start = 0.35 + 0.5 * scene.params["length"]
    swing = 0.8 * half
    duration = (steps - 1) * half + swing
    total = sign * np.radians(degrees * (1 + 0.04 * np.cos(40 * scene.params["variant"])))
    grid = time_grid(-4.0, scene.t[-1] + 4.0)
    rate = total * np.gradient(min_jerk((grid - start) / duration), grid[1] - grid[0])
    path = Path(grid, np.zeros_like(grid), np.zeros_like(grid), rate)
    gait = stepping_in_place(2 * half, spin)
    envelope = ramp(scene.t, start - 0.1, 0.4) * (1 - ramp(scene.t, start + duration - 0.3, 0.5))
    first = LEFT if sign > 0 else RIGHT
    body = _stride(scene, gait, path, first, start, start + duration, 1.0, envelope)
    # Head and chest lead the turn, the pelvis follows.
    lead = ramp(scene.t, start - 0.2, 0.4) * (1 - ramp(scene.t, start + 0.55 * duration, 0.5))
    body.head[:, 1] += sign * 0.35 * lead
    body.spine[:, 1] += sign * (0.3 if spin else 0.16) * lead
    return body
