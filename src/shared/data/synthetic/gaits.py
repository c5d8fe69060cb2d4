"""How bodies travel: stride timing, pelvis, trunk and arm figures as functions of speed.

Lengths in metres, angles in degrees, speeds in m/s. The placing of the feet under the pelvis
(`lead`) was chosen so that neither leg has to reach further than it is long.
"""

from dataclasses import dataclass, replace

from .steps import BALL_LEAD


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
