"""Actions of the legs: squat, jump, kick.

T frames; key poses in degrees, lengths in metres.
"""

import numpy as np

from ...motion.skeleton import REST_FOOT_HEIGHT
from .curves import Array, bump, hermite, keyframes, min_jerk, ramp
from .gestures import pace_of, pose_arm, sides_of
from .rig import ELBOW, FLEX, LEFT, RIGHT, Body, rotation
from .scene import Scene

_GRAVITY = 9.81


def squat(scene: Scene) -> Body:
    """Squat `count` times, arms brought forward for balance."""
    body, t, pace = scene.standing(width=0.30), scene.t, pace_of(scene)
    body.foot_yaw *= 1.6
    count = int(scene.labels["count"])
    down, up, gap = 0.72 / pace**0.85, 0.68 / pace**0.85, 0.10
    start, keys = 0.25 + 0.25 * scene.params["variant"], []
    for index in range(count):
        at = start + index * (down + up + gap)
        keys += [(at, 0.0), (at + down, 1.0), (at + down + up, 0.0)]
    low = keyframes(t, keys)
    depth = (0.36 + 0.10 * scene.params["length"]) * scene.params["amplitude"] ** 0.5
    _sink(body, low, depth)
    for side in (LEFT, RIGHT):
        pose_arm(body, side, 0.9 * low, flex=78.0, abduct=6.0, twist=-12.0, elbow=22.0)
    return body


def _sink(body: Body, low: Array, depth: float) -> None:
    """Bend hips and knees: the pelvis goes down and back, the trunk forward."""
    body.position[:, 1] -= depth * low
    body.position[:, 2] -= 0.34 * depth * low
    body.pitch[:] += np.radians(60.0) * depth * low
    body.spine[:, 0] += np.radians(30.0) * depth * low
    body.knee_out[:] += (0.3 * low)[:, None]


def jump(scene: Scene) -> Body:
    """Jump `count` times, straight up or forward: crouch, push, ballistic flight, landing."""
    body, t = scene.standing(width=0.22), scene.t
    count, params = int(scene.labels["count"]), scene.params
    forward = scene.labels["direction"] == "forward"
    speed = np.sqrt(2 * _GRAVITY * (0.16 if forward else 0.2 + 0.12 * params["length"]))
    speed *= params["amplitude"] ** 0.5  # m/s at take-off
    distance = (0.45 + 0.3 * params["variant"]) * params["amplitude"] * forward
    depth, tiptoe = 0.25, 0.05
    load, settle = np.array((0.42, 0.45)) / params["tempo"] ** 0.5
    push, flight = 2 * (depth + tiptoe) / speed, 2 * speed / _GRAVITY
    land = 2 * (0.7 * depth + tiptoe) / speed
    start = 0.25 + 0.25 * params["variant"]
    rise, crouch, flex, bend, stretch, tuck = (np.zeros_like(t) for _ in range(6))
    travel, glide = np.zeros_like(t), np.zeros_like(t)  # of the feet, of the pelvis
    airborne = np.zeros(len(t), dtype=bool)
    high = 95.0 if forward else 125.0
    for index in range(count):
        at = start + index * (load + push + flight + land + settle - 0.1)
        low, off = at + load, at + load + push
        down, soft = off + flight, off + flight + land
        end = soft + settle
        air = (t > off) & (t < down)
        ground = [(at, 0, 0), (low, -depth, 0), (off, tiptoe, speed), (down, tiptoe, -speed)]
        curve = hermite(t, [*ground, (soft, -0.7 * depth, 0), (end, 0, 0)])
        since = t - off
        rise += np.where(air, tiptoe + speed * since - _GRAVITY / 2 * since**2, curve)
        crouch += keyframes(t, [(at, 0), (low, 1), (off, 0), (down, 0.1), (soft, 0.75), (end, 0)])
        flex += keyframes(
            t, [(at, 0), (at + 0.62 * load, -38), (off + 0.13, high), (soft, 30), (end, 0)]
        )
        bend += keyframes(t, [(at, 0), (low, 22), (off + 0.1, 24), (soft, 30), (end, 0)])
        stretch += keyframes(
            t, [(off - 0.14, 0), (off + 0.06, 1), (down - 0.08, 0.55), (down + 0.06, 0)]
        )
        tuck += bump((t - off) / flight)
        travel += distance * ramp(t, off, flight)
        glide += distance * ramp(t, off - 0.16, flight + 0.3)
        airborne |= air
    _sink(body, crouch, depth)
    body.position[:, 1] += depth * crouch + rise
    body.position[:, 2] += glide
    body.spine[:, 0] += np.radians(6.0) * tuck * forward
    _fly(body, np.where(airborne, rise - tiptoe, 0.0), travel, stretch, airborne)
    body.ball[..., 1] += (0.12 if forward else 0.05) * tuck[:, None]
    body.add_arms(FLEX, np.radians(flex))
    body.add_arms(ELBOW, np.radians(bend))
    return body


def _fly(body: Body, height: Array, travel: Array, stretch: Array, airborne: Array) -> None:
    """Lift the feet with the pelvis along the flight; they step forward only in the air."""
    body.ball[..., 1] += np.maximum(height, 0.0)[:, None]
    body.ball[..., 2] += travel[:, None]
    body.foot_pitch[:] -= (np.radians(42.0) * stretch)[:, None]
    body.toes_flat[airborne] = 0.0
    body.contacts[airborne] = 0.0


def kick(scene: Scene) -> Body:
    """Kick `count` times to the front: chamber the knee, snap, pull back, set down."""
    body, t = scene.standing(width=0.18), scene.t
    count, tempo = int(scene.labels["count"]), scene.params["tempo"]
    (side,) = sides_of(scene)
    sign = 1.0 if side == LEFT else -1.0
    chamber, snap, pull, lower, gap = np.array((0.34, 0.17, 0.22, 0.36, 0.22)) / tempo
    start = 0.55 + 0.25 * scene.params["variant"]
    up, out, away = np.zeros_like(t), np.zeros_like(t), np.zeros(len(t), dtype=bool)
    for index in range(count):
        at = start + index * (chamber + snap + pull + lower + gap)
        end = at + chamber + snap + pull + lower
        up += keyframes(t, [(at, 0), (at + chamber, 1), (end - lower, 1), (end, 0)])
        peak = at + chamber + snap
        out += keyframes(t, [(peak - 1.3 * snap, 0), (peak, 1), (peak + 0.04, 1),
                             (peak + pull, 0)])  # fmt: skip
        away |= (t > at) & (t < end)
    last = start + count * (chamber + snap + pull + lower + gap)
    weight = ramp(t, start - 0.45, 0.5) * (1 - ramp(t, last - gap - 0.1, 0.6))
    _stand_on_one_leg(body, weight, sign)
    _kick_foot(scene, body, side, up, out, away)
    body.pitch[:] -= np.radians(7.0) * up + np.radians(9.0) * out
    body.spine[:, 0] += np.radians(9.0) * up
    body.spine[:, 1] += sign * np.radians(10.0) * out
    other = RIGHT if side == LEFT else LEFT
    pose_arm(body, other, 0.8 * up, flex=45.0, abduct=18.0, twist=-15.0, elbow=75.0)
    pose_arm(body, side, 0.8 * up, flex=8.0, abduct=28.0, twist=-10.0, elbow=55.0)
    body.arms[:, side, FLEX] -= np.radians(22.0) * out
    return body


def _stand_on_one_leg(body: Body, weight: Array, sign: float) -> None:
    """Shift the pelvis over the foot opposite to `sign` and keep the trunk upright."""
    body.position[:, 0] -= sign * 0.062 * weight
    body.position[:, 1] -= 0.022 * weight
    body.roll[:] += sign * np.radians(1.5) * weight
    body.spine[:, 2] += sign * np.radians(1.0) * weight


def _kick_foot(scene: Scene, body: Body, side: int, up: Array, out: Array, away: Array) -> None:
    """Place the kicking foot by the angles its thigh and shin should have."""
    height = 58.0 + 20.0 * scene.params["length"] * scene.params["amplitude"]  # of the thigh
    thigh = np.radians(height) * up + np.radians(6.0) * out
    knee = np.radians(95.0) * up * (1 - out) + np.radians(9.0) * out
    shin = thigh - knee
    hip = np.array((0.09 if side == LEFT else -0.09, -0.07, 0.0))
    hips = body.position + (
        rotation(1, body.yaw) @ rotation(0, body.pitch) @ rotation(2, body.roll) @ hip
    )
    ankle = hips.copy()
    ankle[:, 1] -= 0.40 * np.cos(thigh) + 0.40 * np.cos(shin)
    ankle[:, 2] += 0.40 * np.sin(thigh) + 0.40 * np.sin(shin)
    pitch = np.radians(-25.0) * up * (1 - out) + (shin - np.radians(35.0)) * out
    foot = rotation(0, -pitch) @ np.array((0.0, -0.06, 0.13))
    blend = min_jerk(up / 0.55)[:, None]
    body.ball[:, side] += blend * (ankle + foot - body.ball[:, side])
    body.ball[:, side, 1] = np.maximum(body.ball[:, side, 1], REST_FOOT_HEIGHT)
    body.foot_pitch[:, side] += min_jerk(up / 0.3) * pitch
    body.toes_flat[:, side] = 1 - min_jerk(up / 0.3)
    body.contacts[away, side] = 0.0
