"""Footsteps: a path for the pelvis, then feet that are planted beside it and never slide.

T frames. Each foot stands still between two swings; it is planted where the path will be in
the middle of its stance, which serves walking in any direction, arcs, starts, stops and turns.
"""

from dataclasses import dataclass

import numpy as np

from ...motion.skeleton import REST_FOOT_HEIGHT
from .curves import Array, bump, min_jerk, smooth_step
from .rig import BALL_LEAD, LEFT, RIGHT, Body

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
