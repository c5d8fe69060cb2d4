"""Travelling and turning on the feet: walk, run, side-step, crouch-walk, turn, spin.

T frames; angles in degrees where a name or table says so, radians elsewhere.
"""

from dataclasses import replace

import numpy as np

from ...motion.skeleton import REST_PELVIS_HEIGHT
from .rig import (
    ABDUCT,
    ELBOW,
    FLEX,
    LEFT,
    RIGHT,
    TWIST,
    Array,
    Body,
    Scene,
    min_jerk,
    ramp,
    smooth_noise,
)
from .steps import (
    Gait,
    Path,
    Stepping,
    backward_gait,
    crouched_gait,
    plan_feet,
    run_gait,
    sideways_gait,
    stepping_in_place,
    time_grid,
    walk_gait,
)


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
    """A body that walks along `path` with the given gait; steps from `start` to `stop`."""
    t, half = scene.t, gait.period / 2
    swing = (1 - gait.duty) * gait.period
    count = round((stop - start - swing) / half) + 1
    lifts = start + half * np.arange(count)
    stepping = Stepping(
        lifts=lifts,
        lands=lifts + swing,
        first=first,
        width=gait.width * scene.params["width"],
        lead=gait.lead,
        toe_out=np.radians(scene.params["toe_out"]),
        clearance=gait.clearance * scene.params["amplitude"],
        toe_off=np.radians(gait.toe_off),
        strike=np.radians(gait.strike),
        stride=max(scene.params.get("speed", 0.3) * gait.period, 0.3),
        heel_off=gait.heel_off,
        peak=gait.peak,
    )
    body = scene.standing()
    plan_feet(body, t, path, stepping)
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
