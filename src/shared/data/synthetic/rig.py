"""From control curves to joint rotations: the body that the synthetic actions move.

T frames. Curves take times or progress [T] and return [T]. `Body` holds angles in radians and
positions in metres; `solve` turns it into a `Motion`: legs by two-bone inverse kinematics to the
planned feet, arms by shoulder angles, the pelvis lowered where a leg would not reach.
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import torch
from scipy.interpolate import CubicHermiteSpline

from ...formats.rig import units
from ...motion.motion import Motion
from ...motion.rotations import matrix_to_quaternion, quaternion_continuous
from ...motion.skeleton import (
    JOINT_INDEX,
    LEG_LENGTH,
    NUM_JOINTS,
    REST_FOOT_HEIGHT,
    REST_PELVIS_HEIGHT,
    canonical_skeleton,
)

Array = np.ndarray


def min_jerk(progress: Array) -> Array:
    """0 → 1 with zero speed and acceleration at both ends (Flash & Hogan 1985)."""
    x = np.clip(progress, 0.0, 1.0)
    return np.asarray(x**3 * (10.0 + x * (6.0 * x - 15.0)))


def smooth_step(progress: Array) -> Array:
    """0 → 1 with zero speed at both ends; brisker than `min_jerk`."""
    x = np.clip(progress, 0.0, 1.0)
    return np.asarray(x * x * (3.0 - 2.0 * x))


def ramp(t: Array, start: float, duration: float) -> Array:
    """0 before `start` seconds, 1 after `start + duration`, minimum jerk between."""
    return min_jerk((t - start) / max(duration, 1e-6))


def bump(progress: Array, peak: float = 0.5) -> Array:
    """0 → 1 → 0 over progress 0 … 1 with the maximum at `peak`, smooth everywhere."""
    x = np.clip(progress, 0.0, 1.0)
    return np.where(x < peak, min_jerk(x / peak), min_jerk((1.0 - x) / (1.0 - peak)))


def keyframes(t: Array, keys: Sequence[tuple[float, float]]) -> Array:
    """Minimum-jerk interpolation of (time, value) keys; constant outside them."""
    times, values = np.array(keys, dtype=float).T
    if len(keys) == 1:
        return np.full_like(t, values[0])
    index = np.clip(np.searchsorted(times, t, side="right") - 1, 0, len(keys) - 2)
    span = np.maximum(times[index + 1] - times[index], 1e-6)
    blend = min_jerk((t - times[index]) / span)
    return np.asarray(values[index] + (values[index + 1] - values[index]) * blend)


def hermite(t: Array, keys: Sequence[tuple[float, float, float]]) -> Array:
    """Cubic interpolation of (time, value, speed) keys; constant outside them."""
    times, values, speeds = np.array(keys, dtype=float).T
    return np.asarray(CubicHermiteSpline(times, values, speeds)(np.clip(t, times[0], times[-1])))


def smooth_noise(rng: np.random.Generator, t: Array, amplitude: float, period: float) -> Array:
    """Slow wandering: three sines near `period` seconds with random phases, |value| ≤ amplitude."""
    rates = 2 * np.pi / (period * rng.uniform((0.7, 1.2, 2.0), (1.0, 1.7, 2.8)))
    phases = rng.uniform(0, 2 * np.pi, 3)
    weights = np.array([0.5, 0.3, 0.2])
    return np.asarray(amplitude * (weights * np.sin(t[:, None] * rates + phases)).sum(1))


def upper_envelope(values: Array, radius: int) -> Array:
    """A smooth curve that stays above `values`: running maximum, then a narrower smoothing, which
    is Gaussian; ends are repeated."""
    padded = np.pad(values, radius, mode="edge")
    highest = np.lib.stride_tricks.sliding_window_view(padded, 2 * radius + 1).max(1)
    kernel = np.exp(-0.5 * (np.arange(-radius, radius + 1) / (radius / 3)) ** 2)
    return np.convolve(np.pad(highest, radius, mode="edge"), kernel / kernel.sum(), mode="valid")


FPS = 30.0
FLEX, ABDUCT, TWIST, ELBOW, PRONATE, WRIST, DEVIATE = range(7)
"""Arm angles: raise forward, raise sideways, outward turn about the upper arm (from hanging
with the palm inward), elbow bend, forearm turn (thumb inward), palm towards forearm, hand
towards the thumb."""
LEFT, RIGHT = 0, 1

_OFFSETS = canonical_skeleton().offsets.astype(np.float64)
_HIP = np.stack([_OFFSETS[JOINT_INDEX["l_hip"]], _OFFSETS[JOINT_INDEX["r_hip"]]])
_ANKLE_TO_BALL = _OFFSETS[JOINT_INDEX["l_foot"]]
_THIGH = -float(_OFFSETS[JOINT_INDEX["l_knee"]][1])
_SHIN = -float(_OFFSETS[JOINT_INDEX["l_ankle"]][1])
_LONGEST_REACH = 0.995 * LEG_LENGTH
_SHORTEST_REACH = 0.36 * LEG_LENGTH
_MIRROR = np.diag([-1.0, 1.0, 1.0])
_SPINE_SHARE = (0.3, 0.35, 0.35)  # of spine1, spine2, spine3
_GAZE_HOLD = 0.75  # share of the trunk's lean and turn that neck and head take back


def rotation(axis: int, angle: Array) -> Array:
    """Rotation matrices [T,3,3] about x (0), y (1) or z (2)."""
    matrix = np.zeros((*np.shape(angle), 3, 3))
    i, j = (axis + 1) % 3, (axis + 2) % 3
    matrix[..., axis, axis] = 1.0
    matrix[..., i, i] = matrix[..., j, j] = np.cos(angle)
    matrix[..., j, i] = np.sin(angle)
    matrix[..., i, j] = -matrix[..., j, i]
    return matrix


@dataclass
class Body:
    """Control curves of one clip; `standing` gives neutral ones to add to.

    Attributes:
        position: pelvis [T,3]; its height is what is wished for, the legs may lower it.
        yaw, pitch, roll: pelvis [T]; pitch leans forward, roll lifts the left side.
        spine: pitch, yaw, roll [T,3] of the chest against the pelvis, same signs.
        head: pitch (down), yaw (left), roll [T,3] added to the stabilised gaze.
        arms: [T,2,7] left and right, indices FLEX … DEVIATE.
        ball: ball of the foot [T,2,3]; foot_yaw, foot_pitch (toes up), knee_out [T,2].
        toes_flat: [T,2] in [0,1], how far the toes stay level while the heel is up.
        contacts: [T,2] 1 while the foot is planted.
    """

    position: Array
    yaw: Array
    pitch: Array
    roll: Array
    spine: Array
    head: Array
    arms: Array
    ball: Array
    foot_yaw: Array
    foot_pitch: Array
    knee_out: Array
    toes_flat: Array
    contacts: Array

    @classmethod
    def standing(cls, num_frames: int, width: float = 0.2, toe_out: float = 0.12) -> "Body":
        """Standing at the origin, facing +Z, arms hanging, feet `width` metres apart."""
        arms = np.zeros((num_frames, 2, 7))
        arms[..., :5] = np.radians((4.0, 9.0, -12.0, 16.0, 12.0))
        arms[..., WRIST] = np.radians(6.0)
        ball = np.zeros((num_frames, 2, 3))
        ball[:, LEFT, 0], ball[:, RIGHT, 0] = width / 2, -width / 2
        ball[..., 1] = REST_FOOT_HEIGHT
        ball[..., 2] = BALL_LEAD
        position, spine, head = (np.zeros((num_frames, 3)) for _ in range(3))
        position[:, 1] = REST_PELVIS_HEIGHT - 0.012
        yaw, pitch, roll = (np.zeros(num_frames) for _ in range(3))
        foot_yaw = np.tile((toe_out, -toe_out), (num_frames, 1))
        foot_pitch, knee_out = (np.zeros((num_frames, 2)) for _ in range(2))
        toes_flat, contacts = (np.ones((num_frames, 2)) for _ in range(2))
        return cls(
            position, yaw, pitch, roll, spine, head, arms, ball, foot_yaw, foot_pitch, knee_out,
            toes_flat, contacts,
        )  # fmt: skip

    def add_arms(self, joint: int, value: Array | float) -> None:
        """Add the same curve [T] to both arms."""
        self.arms[..., joint] += np.asarray(value)[..., None]


BALL_LEAD = 0.085  # metres of the ball of the foot in front of the pelvis in quiet standing


def solve(body: Body) -> Motion:
    """The motion of a body, moved so that its pelvis starts above the origin."""
    local = np.broadcast_to(np.eye(3), (len(body.yaw), NUM_JOINTS, 3, 3)).copy()
    pelvis = rotation(1, body.yaw) @ rotation(0, body.pitch) @ rotation(2, body.roll)
    local[:, 0] = pelvis
    _pose_trunk(body, local)
    for side in (LEFT, RIGHT):
        _pose_arm(body.arms[:, side], side, local)
    feet = rotation(1, body.foot_yaw) @ rotation(0, -body.foot_pitch)
    ankles = body.ball - feet @ _ANKLE_TO_BALL
    hips = (pelvis[:, None] @ _HIP[..., None]).squeeze(-1)
    position = _lower_pelvis(body.position, hips, ankles)
    for side in (LEFT, RIGHT):
        reach = ankles[:, side] - position - hips[:, side]
        _pose_leg(body, side, pelvis, reach, feet[:, side], local)
    quaternions = quaternion_continuous(matrix_to_quaternion(torch.from_numpy(local)), dim=0)
    position = position - position[0] * np.array([1.0, 0.0, 1.0])
    return Motion(
        quaternions=quaternions.numpy().astype(np.float32),
        root_position=position.astype(np.float32),
        contacts=body.contacts.astype(np.float32),
        fps=FPS,
    )


def _pose_trunk(body: Body, local: Array) -> None:
    pitch, yaw, roll = body.spine.T
    for name, share in zip(("spine1", "spine2", "spine3"), _SPINE_SHARE, strict=True):
        turn = rotation(1, share * yaw) @ rotation(0, share * pitch) @ rotation(2, share * roll)
        local[:, JOINT_INDEX[name]] = turn
    head_pitch = body.head[:, 0] - _GAZE_HOLD * (pitch + body.pitch)
    head_yaw = body.head[:, 1] - _GAZE_HOLD * yaw
    head_roll = body.head[:, 2] - _GAZE_HOLD * (roll + body.roll)
    for name, share in (("neck", 0.4), ("head", 0.6)):
        local[:, JOINT_INDEX[name]] = (
            rotation(1, share * head_yaw)
            @ rotation(0, share * head_pitch)
            @ rotation(2, share * head_roll)
        )


def _pose_arm(angles: Array, side: int, local: Array) -> None:
    flex, abduct, twist, elbow, pronate, wrist, deviate = angles.T
    # The collar bone follows the upper arm upwards beyond about 40° (scapulohumeral rhythm).
    lift = np.maximum(np.hypot(flex, abduct) - 0.7, 0.0)
    forward = np.clip(flex - 0.5, 0.0, 1.0) * 0.12
    collar = rotation(1, -forward) @ rotation(2, 0.2 * lift)
    hang = rotation(2, np.full_like(flex, -np.pi / 2))
    chest = rotation(0, -flex) @ rotation(2, abduct) @ rotation(1, twist) @ hang
    rotations = {
        "collar": collar,
        "shoulder": collar.swapaxes(-1, -2) @ chest,
        "elbow": rotation(1, -elbow) @ rotation(0, 0.5 * pronate),
        "wrist": rotation(0, 0.5 * pronate) @ rotation(2, -wrist) @ rotation(1, -deviate),
    }
    for name, matrix in rotations.items():
        if side == RIGHT:
            matrix = _MIRROR @ matrix @ _MIRROR
        local[:, JOINT_INDEX["lr"[side] + "_" + name]] = matrix


def _lower_pelvis(wish: Array, hips: Array, ankles: Array) -> Array:
    """The wished pelvis path [T,3], lowered smoothly where a leg would be too short."""
    gap = ankles - hips - wish[:, None]
    sideways = np.minimum(gap[..., 0] ** 2 + gap[..., 2] ** 2, (0.9 * _LONGEST_REACH) ** 2)
    highest = (ankles - hips)[..., 1] + np.sqrt(_LONGEST_REACH**2 - sideways)
    deficit = np.maximum(wish[:, 1] - highest.min(1), 0.0)
    position = wish.copy()
    position[:, 1] -= upper_envelope(deficit, 3)
    return position


def _frame(hinge: Array, bone: Array) -> Array:
    """Rotation [T,3,3] that takes a bone lying along -Y with hinge +X to the given directions."""
    return np.stack((hinge, -bone, np.cross(hinge, -bone)), -1)


def _pose_leg(
    body: Body, side: int, pelvis: Array, reach: Array, foot: Array, local: Array
) -> None:
    """Two-bone inverse kinematics; the knee bends about a hinge that follows hip and foot."""
    distance = np.linalg.norm(reach, axis=-1)
    clipped = np.clip(distance, _SHORTEST_REACH, 0.9995 * LEG_LENGTH)
    toward = reach / np.maximum(distance, 1e-9)[:, None]
    outward = body.knee_out[:, side] * (1 if side == LEFT else -1)
    foot_turn = np.angle(np.exp(1j * (body.foot_yaw[:, side] - body.yaw)))
    hinge = pelvis @ rotation(1, 0.6 * foot_turn + outward)[..., 0][..., None]
    hinge = hinge.squeeze(-1)
    hinge = units(hinge - (hinge * toward).sum(-1, keepdims=True) * toward)
    bend = np.cross(toward, hinge)
    along = (clipped**2 + _THIGH**2 - _SHIN**2) / (2 * clipped)
    across = np.sqrt(np.maximum(_THIGH**2 - along**2, 0.0))
    knee = along[:, None] * toward + across[:, None] * bend
    thigh = _frame(hinge, units(knee))
    shin = _frame(hinge, units(clipped[:, None] * toward - knee))
    letter = "lr"[side]
    local[:, JOINT_INDEX[letter + "_hip"]] = pelvis.swapaxes(-1, -2) @ thigh
    local[:, JOINT_INDEX[letter + "_knee"]] = thigh.swapaxes(-1, -2) @ shin
    local[:, JOINT_INDEX[letter + "_ankle"]] = shin.swapaxes(-1, -2) @ foot
    level = np.minimum(body.foot_pitch[:, side], 0.0) * body.toes_flat[:, side]
    local[:, JOINT_INDEX[letter + "_foot"]] = rotation(0, level)


@dataclass(frozen=True)
class Scene:
    """One clip being made: frame times [T] in seconds, labels, parameters, noise source."""

    t: Array
    labels: dict[str, str]
    params: dict[str, float]
    rng: np.random.Generator

    def standing(self, width: float = 0.19) -> Body:
        """A body at ease with this clip's posture, breathing and slowly wandering joints."""
        params, t = self.params, self.t
        body = Body.standing(len(t), width * params["width"], np.radians(params["toe_out"]))
        hunch = np.radians(params["hunch"])
        breath = np.radians(0.8) * np.sin(2 * np.pi * t / 3.6 + 6 * params["variant"])
        body.spine[:, 0] += hunch + breath
        body.head[:, 0] += np.radians(params["gaze"]) - 0.5 * hunch
        body.add_arms(ABDUCT, np.radians(params["arm_carry"]) - 0.3 * breath)
        body.add_arms(ELBOW, np.radians(params["elbow_carry"]))
        for index, degrees in enumerate((0.8, 1.2, 0.8)):
            body.spine[:, index] += self.wander(degrees, 2.5)
            body.head[:, index] += self.wander(2.0 * degrees, 2.2)
        for side in (LEFT, RIGHT):
            for joint, degrees in ((FLEX, 2.0), (ABDUCT, 1.5), (TWIST, 3.0), (ELBOW, 3.0)):
                body.arms[:, side, joint] += self.wander(degrees, 2.2)
        return body

    def wander(self, degrees: float, period: float) -> Array:
        """Slow noise [T] in radians."""
        return smooth_noise(self.rng, self.t, float(np.radians(degrees)), period)
