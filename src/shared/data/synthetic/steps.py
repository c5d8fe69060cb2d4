"""Footsteps and gaits: a path for the pelvis, feet planted beside it, and figures for each gait.

T frames; lengths in metres, angles of gaits in degrees, speeds in m/s. Each foot stands still
between two swings; it is planted where the path will be in the middle of its stance, which serves
walking in any direction, arcs, starts, stops and turns. The placing of the feet under the pelvis
(`lead`) was chosen so that neither leg has to reach further than it is long.
"""

from dataclasses import dataclass, replace

import numpy as np

from ...motion.skeleton import REST_FOOT_HEIGHT
from .rig import BALL_LEAD, LEFT, RIGHT, Array, Body, bump, min_jerk, smooth_step

_GRID_FPS = 120.0
_BALL_TO_HEEL = 0.17  # metres; raises the ball when the heel strikes first
_FOREVER = 1e3


class Path:
    """Pelvis path over the ground: x, z in metres and heading in radians, by integration."""

    def __init__(self, t: Array, forward: Array, lateral: Array, yaw_rate: Array) -> None:
        """Curves on an even grid of seconds `t`: m/s, m/s (to the left), rad/s.

        The path starts at the origin and faces +Z at time 0.
        """
        step = t[1] - t[0]

        def integrate(rate: Array) -> Array:
            return np.concatenate(([0.0], np.cumsum((rate[1:] + rate[:-1]) * 0.5 * step)))

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


@dataclass(frozen=True)
class Stepping:
    """When and how feet swing.

    Attributes:
        lifts, lands: times [N] in seconds of the swings in order, feet alternating.
        first: the foot of swing 0 (LEFT or RIGHT).
        width: metres between the feet. lead: metres of the ball in front of the pelvis.
        toe_out: radians. clearance: metres the ball rises.
        toe_off, strike: foot pitch in radians when it leaves (negative) and lands.
        stride: metres of a full-sized swing; shorter ones pitch and rise less.
    """

    lifts: Array
    lands: Array
    first: int
    width: float
    lead: float = BALL_LEAD
    toe_out: float = 0.12
    clearance: float = 0.05
    toe_off: float = -0.7
    strike: float = 0.3
    stride: float = 1.0
    heel_off: float = 0.45  # share of the stance after which the heel rises
    settle: float = 0.16  # share of the stance the foot needs to come down flat
    peak: float = 0.4  # share of the swing at which the ball is highest


def plan_feet(body: Body, t: Array, path: Path, stepping: Stepping) -> None:
    """Write the feet of `body` for frames at times `t`: ball, yaw, pitch, toes, contacts."""
    for side in (LEFT, RIGHT):
        which = slice((side - stepping.first) % 2, None, 2)
        _plan_foot(body, side, t, path, stepping, stepping.lifts[which], stepping.lands[which])


def _plan_foot(
    body: Body, side: int, t: Array, path: Path, stepping: Stepping, lifts: Array, lands: Array
) -> None:
    sign = 1.0 if side == LEFT else -1.0
    begins = np.concatenate(([-_FOREVER], lands))  # of stance n
    ends = np.concatenate((lifts, [_FOREVER]))
    x, z, heading = path.at((begins + ends) / 2)
    across = sign * stepping.width / 2
    x = x + across * np.cos(heading) + stepping.lead * np.sin(heading)
    z = z - across * np.sin(heading) + stepping.lead * np.cos(heading)
    length = np.hypot(np.diff(x), np.diff(z)) / stepping.stride  # of swing n, 1 = full-sized
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
    body.foot_yaw[:, side] = yaw + sign * stepping.toe_out

    sizes = np.concatenate(([0.2], size, [0.2]))
    last, following = sizes[stance], sizes[np.minimum(stance + 1, len(sizes) - 1)]
    swing_time = float(np.median(lands - lifts)) if len(lifts) else 0.4
    nominal = np.minimum(ends[stance] - begins[stance], 2.2 * swing_time)
    since_land = np.where(stance > 0, t - begins[stance], _FOREVER) / nominal
    until_lift = (ends[stance] - t) / nominal
    # The heel goes on rising for a moment after the toes have left the ground.
    rising = min_jerk((1.0 - until_lift / (1.0 - stepping.heel_off)) / 1.15)
    settling = 1.0 - min_jerk(since_land / stepping.settle)
    swinging = progress < 1.0
    released = min_jerk(np.array(1.0 / 1.15))
    still_rising = released + (1 - released) * min_jerk(progress / 0.2)
    recovery = smooth_step((progress - 0.05) / 0.75)
    pitch_swing = stepping.toe_off * still_rising * (1 - recovery) + stepping.strike * min_jerk(
        (progress - 0.35) / 0.65
    )
    pitch_stance = following * stepping.toe_off * rising + last * stepping.strike * settling
    pitch = np.where(swinging, last * pitch_swing, pitch_stance)
    body.foot_pitch[:, side] = pitch
    lifted = last * stepping.clearance * bump(progress, stepping.peak) * swinging
    heel_first = _BALL_TO_HEEL * np.sin(np.maximum(pitch, 0.0))
    body.ball[:, side, 1] = REST_FOOT_HEIGHT + lifted + heel_first
    body.toes_flat[:, side] = np.where(swinging, 1.0 - min_jerk(progress / 0.3), 1.0)
    body.contacts[:, side] = ~swinging


@dataclass(frozen=True)
class Gait:
    """How a travelling body moves; lengths in metres, angles in degrees.

    `bob` is positive where the pelvis is highest over the standing leg (walking) and negative
    where it is lowest (running).
    """

    period: float  # seconds a stride
    duty: float  # share of the stride that a foot stands
    width: float
    sink: float  # below straight-legged standing
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
        period=2 * 0.51 * speed**-0.45,
        duty=0.62 - 0.02 * (pace - 1),
        width=0.15,
        sink=0.012,
        bob=0.016 * pace**0.8,
        sway=0.026 / pace**0.5,
        lean=1.5 + 1.5 * pace,
        pelvis_yaw=5.0 * pace**0.6,
        chest_yaw=5.0 * pace**0.6,
        pelvis_roll=3.0,
        arm_swing=20.0 * pace**0.7,
        elbow=6.0 * pace,
        elbow_swing=8.0 * pace,
        clearance=0.035,
        toe_off=-42.0 * pace**0.3,
        heel_off=0.5,
        strike=19.0 * pace**0.4,
        lead=0.035,
    )


def run_gait(speed: float) -> Gait:
    """Running forward: bent arms, heels high behind."""
    pace = speed / 3.2
    return Gait(
        period=0.86 - 0.055 * speed,
        duty=0.335 - 0.15 * (pace - 1),
        width=0.11,
        sink=0.065,
        bob=-0.034,
        sway=0.012,
        lean=9.0 * pace**0.7,
        pelvis_yaw=8.0,
        chest_yaw=10.0,
        pelvis_roll=4.0,
        arm_swing=34.0 * pace**0.5,
        elbow=68.0,
        elbow_swing=12.0,
        clearance=0.27 * pace**0.8,
        toe_off=-62.0,
        strike=6.0,
        lead=0.0,
        arm_out=5.0,
        peak=0.42,
        heel_off=0.35,
    )


def backward_gait(speed: float) -> Gait:
    """Walking backward: toes first, short steps, little arm swing."""
    return replace(
        walk_gait(speed + 0.3),
        period=0.95 - 0.12 * speed,
        sink=0.03,
        bob=0.010,
        lean=3.0,
        pelvis_yaw=2.5,
        chest_yaw=2.0,
        arm_swing=8.0,
        elbow_swing=3.0,
        clearance=0.05,
        toe_off=-8.0,
        strike=-16.0,
        lead=0.09,
        width=0.18,
    )


def sideways_gait(speed: float, discrete: bool) -> Gait:
    """Moving sideways, feet closing without crossing; `discrete` steps are shorter."""
    period = (1.0 - 0.35 * speed) if discrete else (1.1 - 0.32 * speed)
    return replace(
        walk_gait(0.7),
        period=period,
        duty=0.62,
        width=0.13 + 0.5 * speed * period,
        sink=0.035,
        bob=0.010,
        sway=0.012,
        lean=2.0,
        pelvis_yaw=0.0,
        chest_yaw=0.0,
        pelvis_roll=2.0,
        arm_swing=2.0,
        elbow=8.0,
        elbow_swing=0.0,
        clearance=0.07,
        toe_off=-12.0,
        strike=-6.0,
        lead=BALL_LEAD,
        arm_out=5.0,
    )


def crouched_gait(speed: float) -> Gait:
    """Walking with bent knees and the trunk forward."""
    return replace(
        walk_gait(speed),
        period=1.12 - 0.22 * speed,
        width=0.2,
        sink=0.27,
        bob=0.008,
        lean=24.0,
        pelvis_roll=2.0,
        arm_swing=9.0,
        elbow=48.0,
        clearance=0.06,
        toe_off=-30.0,
        strike=8.0,
        lead=0.10,
        arm_out=8.0,
    )


def stepping_in_place(period: float, quick: bool) -> Gait:
    """Stepping on the spot, arms carried wider when `quick`."""
    return replace(
        walk_gait(0.7),
        period=period,
        duty=0.6,
        width=0.19,
        sink=0.022,
        bob=0.007,
        sway=0.02,
        lean=1.0,
        pelvis_yaw=0.0,
        chest_yaw=0.0,
        arm_swing=3.0,
        elbow=14.0 if quick else 4.0,
        elbow_swing=0.0,
        clearance=0.06,
        toe_off=-20.0,
        strike=0.0,
        lead=BALL_LEAD,
        arm_out=14.0 if quick else 3.0,
    )
