"""Actions on the spot: stand, wave, raise, clap, bow, punch; squat, jump, kick.

T frames; key poses in degrees, lengths in metres.
"""

import numpy as np

from ...motion.skeleton import REST_FOOT_HEIGHT
from .rig import (
    ABDUCT,
    DEVIATE,
    ELBOW,
    FLEX,
    LEFT,
    PRONATE,
    RIGHT,
    TWIST,
    WRIST,
    Array,
    Body,
    Scene,
    bump,
    hermite,
    keyframes,
    min_jerk,
    ramp,
    rotation,
    smooth_noise,
)

_PACE = {"slow": 0.62, "normal": 1.0, "fast": 1.6}


def pace_of(scene: Scene) -> float:
    """How many times faster than normal the labels and the tempo ask to move."""
    return _PACE[scene.labels.get("speed", "normal")] * scene.params["tempo"]


def sides_of(scene: Scene) -> tuple[int, ...]:
    """The hands or feet that the labels name."""
    return {"left": (LEFT,), "right": (RIGHT,), "both": (LEFT, RIGHT)}[scene.labels["side"]]


def shift_weight(scene: Scene, body: Body, metres: float, period: float) -> None:
    """Let the pelvis wander over the planted feet."""
    for axis, share in ((0, 1.0), (2, 0.5)):
        body.position[:, axis] += smooth_noise(scene.rng, scene.t, share * metres, period)
    body.roll[:] -= 0.6 * body.position[:, 0]
    body.spine[:, 2] += 0.6 * body.position[:, 0]
    body.yaw[:] += scene.wander(1.5, 3.0)


def pose_arm(body: Body, side: int, weight: Array, **degrees: Array | float) -> None:
    """Blend an arm towards a key pose, given by angle names in degrees, by `weight` [T]."""
    index = {
        "flex": FLEX, "abduct": ABDUCT, "twist": TWIST, "elbow": ELBOW,
        "pronate": PRONATE, "wrist": WRIST, "deviate": DEVIATE,
    }  # fmt: skip
    for name, value in degrees.items():
        joint = body.arms[:, side, index[name]]
        joint += weight * (np.radians(value) - joint)


def stand(scene: Scene) -> Body:
    """Quiet standing: weight shifts, breathing, a look around."""
    body = scene.standing()
    shift_weight(scene, body, 0.022, 2.5)
    body.head[:, 1] += scene.wander(14.0, 2.5)
    return body


def raise_hands(scene: Scene) -> Body:
    """Raise one or both hands high, hold, and mostly lower them again."""
    body, t, pace = scene.standing(), scene.t, pace_of(scene)
    shift_weight(scene, body, 0.012, 2.5)
    rise = 0.95 / pace
    start = 0.25 + 0.4 * scene.params["variant"]
    up = ramp(t, start, rise)
    if scene.params["entry"] > 0.35:
        up = up * (1 - ramp(t, t[-1] - 0.25 - 1.1 * rise, 1.1 * rise))
    high = 148.0 + 22.0 * scene.params["length"]
    out = 12.0 + 16.0 * scene.params["amplitude"] * scene.params["variant"]
    for side in sides_of(scene):
        sway = scene.wander(5.0, 2.0)
        pose_arm(body, side, up, flex=high, abduct=out, twist=8.0, elbow=14.0, pronate=20.0)
        body.arms[:, side, FLEX] += up * sway
        body.arms[:, side, ELBOW] += np.radians(35.0) * bump(up) * (up < 1)
    _answer_in_trunk(body, sides_of(scene), up)
    return body


def _answer_in_trunk(body: Body, sides: tuple[int, ...], up: Array) -> None:
    """The trunk stretches and leans a little away from a raised hand; the head looks up."""
    body.spine[:, 0] -= np.radians(4.0) * up
    body.head[:, 0] -= np.radians(7.0) * up
    if len(sides) == 1:
        toward = 1.0 if sides[0] == LEFT else -1.0
        body.spine[:, 2] += toward * np.radians(4.0) * up
        body.roll[:] -= toward * np.radians(1.0) * up
        body.position[:, 0] -= toward * 0.012 * up


def wave(scene: Scene) -> Body:
    """Wave with one or both hands beside the head."""
    body, t, pace = scene.standing(), scene.t, pace_of(scene)
    shift_weight(scene, body, 0.012, 2.5)
    rise = 0.75 / pace**0.5
    start = 0.2 + 0.3 * scene.params["variant"]
    entry = scene.params["entry"]
    up = ramp(t, -2.0 if entry < 0.35 else start, rise)
    if entry > 0.5:
        up = up * (1 - ramp(t, t[-1] - 0.2 - rise, rise))
    rate = 1.55 * pace
    size = scene.params["amplitude"] * (0.9 if pace > 1.3 else 1.05)
    for side in sides_of(scene):
        swing = np.sin(2 * np.pi * rate * (t - start - 0.4 * rise)) * min_jerk((up - 0.5) * 2)
        out = 58.0 + 36.0 * scene.params["length"]
        pose_arm(
            body, side, up, flex=28.0, abduct=out, twist=84.0, elbow=160.0 - out, pronate=0.0,
            wrist=-6.0,
        )  # fmt: skip
        body.arms[:, side, ELBOW] += np.radians(25.0 * size) * swing
        body.arms[:, side, ABDUCT] -= np.radians(5.0 * size) * swing
        lagging = np.sin(2 * np.pi * rate * (t - start - 0.4 * rise) - 0.7)
        body.arms[:, side, DEVIATE] -= np.radians(14.0 * size) * lagging * up
    _answer_in_trunk(body, sides_of(scene), 0.5 * up)
    return body


def clap(scene: Scene) -> Body:
    """Clap `count` times in front of the chest."""
    body, t = scene.standing(), scene.t
    shift_weight(scene, body, 0.010, 2.5)
    count, tempo = int(scene.labels["count"]), scene.params["tempo"]
    rise, beat = 0.7 / tempo, 0.52 / tempo
    start = 0.3 + 0.3 * scene.params["variant"]
    strikes = start + rise + 0.45 * beat + beat * np.arange(count)
    end = strikes[-1] + 0.4 * beat
    up = ramp(t, start, rise) * (1 - ramp(t, end, 1.1 * rise))
    near = np.zeros_like(t)
    for strike in strikes:
        near = np.maximum(near, bump((t - strike + 0.5 * beat) / beat))
    apart = 1 - near
    lift = 8.0 * scene.params["length"]
    for side in (LEFT, RIGHT):
        twist = -55.0 + (28.0 + 10.0 * scene.params["amplitude"]) * apart
        pose_arm(
            body, side, up, flex=40.0 + lift, abduct=14.0, twist=twist, elbow=86.0 + lift,
            pronate=-30.0, wrist=-34.0 + 20.0 * apart, deviate=2.0,
        )  # fmt: skip
    body.head[:, 0] += np.radians(6.0) * up
    body.spine[:, 0] += np.radians(1.5) * up * near
    return body


def bow(scene: Scene) -> Body:
    """Bow `count` times from the hips with a flat back; the hips move back for balance."""
    body, t = scene.standing(width=0.15), scene.t
    count, tempo = int(scene.labels["count"]), scene.params["tempo"]
    down = (0.72 if count == 1 else 0.58) / tempo
    hold = (0.45 if count == 1 else 0.15) / tempo
    start, keys = 0.3 + 0.3 * scene.params["variant"], []
    for index in range(count):
        at = start + index * (2.1 * down + hold + 0.12)
        keys += [(at, 0.0), (at + down, 1.0), (at + down + hold, 1.0)]
        keys += [(at + 2.1 * down + hold, 0.0)]
    bent = keyframes(t, keys)
    degrees = (46.0 + 16.0 * scene.params["length"]) * scene.params["amplitude"] ** 0.5
    body.pitch[:] += np.radians(0.68 * degrees) * bent
    body.spine[:, 0] += np.radians(0.42 * degrees) * bent
    body.head[:, 0] += np.radians(0.55 * degrees) * bent
    body.position[:, 2] -= 0.11 * degrees / 50 * bent
    body.position[:, 1] -= 0.012 * bent
    for side in (LEFT, RIGHT):
        # Half way between hanging down and staying along the body.
        body.arms[:, side, FLEX] += np.radians(0.5 * degrees) * bent
        body.arms[:, side, ABDUCT] -= np.radians(2.0) * bent
    return body


def punch(scene: Scene) -> Body:
    """Punch `count` times straight ahead out of a boxer's guard."""
    body, t = scene.standing(width=0.24), scene.t
    count, tempo = int(scene.labels["count"]), scene.params["tempo"]
    (side,) = sides_of(scene)
    sign = 1.0 if side == LEFT else -1.0
    guard_time, out, back = 0.5 / tempo, 0.20 / tempo, 0.34 / tempo
    start = 0.25 + 0.25 * scene.params["variant"]
    first = start + guard_time + 0.12
    keys, wind = [(first, 0.0)], [(first - 0.2, 0.0)]
    for index in range(count):
        at = first + index * (out + back + 0.22)
        wind += [(at, 1.0), (at + out, 0.0)]
        keys += [(at, 0.0), (at + out, 1.0), (at + out + 0.05, 1.0), (at + out + 0.05 + back, 0.0)]
        wind += [(at + out + back, 0.0)]
    thrust, windup = keyframes(t, keys), keyframes(t, wind)
    end = keys[-1][0] + 0.1
    guard = ramp(t, start, guard_time) * (1 - ramp(t, end, 0.65))
    for arm in (LEFT, RIGHT):
        pose_arm(
            body, arm, guard, flex=38.0, abduct=16.0, twist=-22.0, elbow=122.0, pronate=25.0,
            wrist=4.0,
        )  # fmt: skip
    height = 91.0 + 9.0 * scene.params["length"]
    pose_arm(body, side, thrust, flex=height, abduct=4.0, twist=-10.0, elbow=9.0, pronate=75.0)
    body.arms[:, side, FLEX] -= np.radians(12.0) * windup
    drive = scene.params["amplitude"] * (thrust - 0.45 * windup)
    body.spine[:, 1] -= sign * np.radians(24.0) * drive
    body.yaw[:] -= sign * np.radians(9.0) * drive
    body.spine[:, 0] += np.radians(5.0) * guard + np.radians(4.0) * drive
    body.position[:, 2] += 0.045 * drive
    body.position[:, 1] -= 0.035 * guard
    body.head[:, 1] += sign * np.radians(4.0) * drive
    return body


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
