"""How a dancer is staged: in which manner, near the middle and to the front, at rest in the end,
with joints that turn over or snap led over.

A manner is how somebody carries what they do: bent trunk, bowed head, bent knees, small or wide
arms. What is danced stays what it is; who dances it changes.

Nothing says where a dance goes, and a body that nobody holds wanders off. Frame by frame the
heading is turned towards the front and the velocity towards the middle, by no more than feet that
step anyway can take up; a slow way backward, which nobody asked for, is mostly left out. The foot
clean-up then lets feet stand where they would have slid.

Runs on the CPU in float64.

Letters: T frames.
"""

import math
from collections.abc import Collection, Sequence
from dataclasses import dataclass, replace
from itertools import pairwise

import numpy as np

from ..tensors import Tensor, torch
from .features import (
    FORWARD,
    HEIGHT,
    LATERAL,
    LEFT_CONTACT,
    RIGHT_CONTACT,
    ROOT_ROW,
    YAW_RATE,
    heading_joints,
    integrate_root,
    to_world,
)
from .filters import smoothed
from .motion import Motion
from .rotations import (
    axis_angle_to_matrix,
    matrix_to_quaternion,
    matrix_to_rotation_6d,
    quaternion_exp,
    quaternion_log,
    quaternion_slerp,
    quaternion_to_matrix,
    rotation_6d_to_matrix,
    turn_about_y,
)
from .skeleton import JOINT_INDEX, LIMBS, NUM_JOINTS

FAR = 2.6  # radians from what an arm does on average, beyond which it is left alone
SETTLE = 0.1  # seconds, standard deviation, over which the pelvis follows bent knees
FOLDED = 100.0  # degrees of a knee that bends no more
TRUNK = [JOINT_INDEX[name] for name in ("spine1", "spine2", "spine3", "neck", "head")]
FEET = [JOINT_INDEX["l_foot"], JOINT_INDEX["r_foot"]]
ARMS = [JOINT_INDEX[name] for side in ("left-arm", "right-arm") for name in LIMBS[side]]


@dataclass(frozen=True)
class Manner:
    """What is added to every pose, degrees, and what arms and trunk keep of their movement.

    Attributes:
        stoop: that the trunk is bent forward.
        bow: that neck and head are, further.
        knees: that legs which stand straight are bent, each hip by this, each knee by twice that;
            the more one is bent already, the less.
        arms: share of their movement around what they do on average; 1 = all of it.
        trunk: share of how spine, neck and head bend and turn; 1 = all of it.
        elbows: that both are held bent; 0 = as they are.
        stops: share of each count in which the body holds still, half of it on either side; see
            `stopping`.
    """

    stoop: float = 0.0
    bow: float = 0.0
    knees: float = 0.0
    arms: float = 1.0
    trunk: float = 1.0
    elbows: float = 0.0
    stops: float = 0.0

    def __and__(self, other: "Manner") -> "Manner":
        """Both at once: who is old and tired is bent as far as one who is either."""

        def both(one: float, another: float) -> float:
            return max(one, another, key=abs) if one * another > 0 else one + another

        return Manner(
            both(self.stoop, other.stoop),
            both(self.bow, other.bow),
            both(self.knees, other.knees),
            1 + both(self.arms - 1, other.arms - 1),
            1 + both(self.trunk - 1, other.trunk - 1),
            max(self.elbows, other.elbows),
            max(self.stops, other.stops),
        )


PLAIN = Manner()


def carried(features: Tensor, manner: Manner, fps: float) -> Tensor:
    """Raw features [T,23,6] of the same movement in a manner; feet stay as high as they were."""
    if manner == PLAIN:
        return features
    result = features.clone()
    rotations = rotation_6d_to_matrix(features[:, :NUM_JOINTS].double())
    low = _lowest(rotations, features)
    if manner.arms != 1.0:
        mean = matrix_to_quaternion(rotation_6d_to_matrix(features[:, ARMS].double().mean(0)))
        own = matrix_to_quaternion(rotations[:, ARMS])
        apart = 2 * torch.acos(((mean * own).sum(-1, keepdim=True)).abs().clamp(0, 1))
        near = ((FAR - apart) / (FAR / 2)).clamp(0, 1)  # there are two ways to the far side
        share = 1 + (manner.arms - 1) * near
        rotations[:, ARMS] = quaternion_to_matrix(quaternion_slerp(mean, own, share))
    if manner.trunk != 1.0:
        own = quaternion_log(matrix_to_quaternion(rotations[:, TRUNK]))
        rotations[:, TRUNK] = quaternion_to_matrix(quaternion_exp(manner.trunk * own))
    if manner.elbows:
        for side, sign in (("l", -1.0), ("r", 1.0)):
            bent = torch.tensor(sign * np.radians(manner.elbows)).double()
            rotations[:, JOINT_INDEX[f"{side}_elbow"]] = axis_angle_to_matrix(1, bent)
    for names, degrees in (
        (("spine1", "spine2", "spine3"), manner.stoop / 3),
        (("neck", "head"), manner.bow / 2),
    ):
        for name in names:
            rotations[:, JOINT_INDEX[name]] = (
                _forward(torch.tensor(degrees)) @ rotations[:, JOINT_INDEX[name]]
            )
    for side in "lr":
        hip, knee, ankle = (JOINT_INDEX[f"{side}_{name}"] for name in ("hip", "knee", "ankle"))
        trace = rotations[:, knee, 0, 0] + rotations[:, knee, 1, 1] + rotations[:, knee, 2, 2]
        bent = torch.acos(((trace - 1) / 2).clamp(-1, 1)) * (180 / np.pi)
        more = manner.knees * (1 - bent / FOLDED).clamp(0, 1)
        rotations[:, hip] = rotations[:, hip] @ _forward(-more)
        rotations[:, knee] = rotations[:, knee] @ _forward(2 * more)
        rotations[:, ankle] = _forward(-more) @ rotations[:, ankle]
    result[:, :NUM_JOINTS] = matrix_to_rotation_6d(rotations).float()
    sinks = smoothed(_lowest(rotations, features) - low, SETTLE * fps)
    result[:, ROOT_ROW, HEIGHT] -= torch.from_numpy(sinks).float()
    return result


def _forward(degrees: Tensor) -> Tensor:
    """Turns [...,3,3] that tilt what is up forward by degrees [...]."""
    return axis_angle_to_matrix(0, degrees.double() * (np.pi / 180))


def _lowest(rotations: Tensor, features: Tensor) -> np.ndarray:
    """Height of the lowest joint [T]."""
    height = features[:, ROOT_ROW, HEIGHT].double()
    return np.asarray(heading_joints(rotations, height)[..., 1].min(1).values.numpy())


# ---------------------------------------------------------------- on the stage

LAG = 1.0  # seconds over which place and heading are averaged: a sway and a spin are left alone
PULL, NEAR = 0.12, 0.8  # m/s at most, and metres from the middle at which 0.7 of it is reached
TURN = 0.3  # rad/s at most, for a body that has its side to the front
SWAY = 0.5  # seconds, standard deviation: quicker steps backward stay
STEADY, STROLL = 1.0, 0.12  # seconds, standard deviation, and m/s: a faster way is a walk,
ROUND = 0.55  # metres, radius of the circle that it is bent to
ROOM, PULLS = 1.1, (PULL, 0.3, 0.6, 1.2)  # metres from the middle; pulls until it stays there
FINISH = 5.0  # seconds before the end, in which a body turns to the front
ASKEW, TURNED = 0.5, 1.5  # radians: what is left then, and what is turned at most
BACKWARD = 0.8  # share of the way backward that is left out


def circling(root: Tensor, fps: float) -> Tensor:
    """Root rows [T,6] of a body that walks round where it would have walked off; see `steered`."""
    rows = root.double().clone()
    way = rows[:, [FORWARD, LATERAL]].numpy()
    slow = smoothed(way, STEADY * fps)
    speed = np.linalg.norm(slow, axis=1)
    side = 1.0 if float(rows[:, YAW_RATE].sum()) >= 0 else -1.0
    bend = side * np.maximum(speed - STROLL, 0) / ROUND
    rows[:, YAW_RATE] += torch.from_numpy(bend)
    return rows.to(root.dtype)


def staged(root: Tensor, fps: float, end: float, danced: Tensor | None = None) -> Tensor:
    """Root rows [T,6] that `steered` leaves within `ROOM`, by a stronger pull if it has to be, and
    that turn towards the front before the second `end`: by TURNED at most, until ASKEW is left.

    Args:
        root, fps, danced: see `steered`.
        end: when the dance is over.
    """
    rows = root
    for pull in PULLS:
        rows = _fronted(steered(root, fps, pull=pull, danced=danced), fps, end, danced)
        path = integrate_root(rows.double(), fps)[0].numpy()[:, [0, 2]]
        if np.linalg.norm(path - path.mean(0), axis=1).max() <= ROOM:
            break
    return rows


def _fronted(root: Tensor, fps: float, end: float, danced: Tensor | None = None) -> Tensor:
    """Root rows [T,6] that turn towards the front in the frames before the second `end` that are
    danced, by less where these are few."""
    last = min(round(end * fps), len(root) - 1)
    first = max(0, last - round(FINISH * fps))
    x = (torch.arange(last - first).double() + 0.5) / max(last - first, 1)
    share = 1 - torch.cos(2 * math.pi * x)
    if danced is not None:
        share = share * danced[first:last]
    whole = float(share.sum())
    if whole < 1e-6:
        return root
    rows = root.double().clone()
    off = math.remainder(float(integrate_root(rows, fps)[1][last]), 2 * math.pi)
    most = TURNED * min(whole / (FINISH * fps), 1.0)
    turn = math.copysign(min(max(abs(off) - ASKEW, 0.0), most), off)
    rows[first:last, YAW_RATE] -= turn * fps * share / whole
    return rows.to(root.dtype)


def steered(
    root: Tensor, fps: float, *, pull: float = PULL, danced: Tensor | None = None
) -> Tensor:
    """Root rows [T,6] of a body that keeps near the middle and comes back to the front.

    Args:
        root: forward and lateral velocity (m/s), height, yaw rate (rad/s) and contacts; the first
            frame is in the middle and faces the front.
        fps: frames a second.
        pull: m/s at most.
        danced: frames [T] bool; in the others the body goes nowhere. None = all.
    """
    rows = root.double().clone()
    slow = smoothed(rows[:, FORWARD].numpy(), SWAY * fps)
    rows[:, FORWARD] -= torch.from_numpy(BACKWARD * np.minimum(slow, 0.0))
    values, keep = rows.tolist(), math.exp(-1 / (LAG * fps))
    moves = [True] * len(values) if danced is None else danced.tolist()
    x = z = heading = near_x = near_z = sine = 0.0
    cosine = 1.0
    for row, moving in zip(values, moves, strict=True):
        near_x, near_z = keep * near_x + (1 - keep) * x, keep * near_z + (1 - keep) * z
        sine = keep * sine + (1 - keep) * math.sin(heading)
        cosine = keep * cosine + (1 - keep) * math.cos(heading)
        to_x, to_z = (-pull * at / math.hypot(near_x, near_z, NEAR) for at in (near_x, near_z))
        row[YAW_RATE] -= TURN * sine  # of a spin's mean little is left
        row[FORWARD] += to_x * math.sin(heading) + to_z * math.cos(heading)
        row[LATERAL] += to_x * math.cos(heading) - to_z * math.sin(heading)
        if not moving:
            row[YAW_RATE] = row[FORWARD] = row[LATERAL] = 0.0
        forward, left = row[FORWARD] / fps, row[LATERAL] / fps
        x += forward * math.sin(heading) + left * math.cos(heading)
        z += forward * math.cos(heading) - left * math.sin(heading)
        heading += row[YAW_RATE] / fps
    return torch.tensor(values, dtype=root.dtype)


LED, STEP, RAMP = 0.4, 0.33, 0.13  # seconds from a seam: the root is led, a foot steps; the edges
STOOD = 0.3  # share of a step that one foot stands at least
GIVES = 1.2  # m/s at most by which the root gives way
TAKEN = 0.05  # seconds, standard deviation, over which a foot takes a body over


def stepped(features: Tensor, seams: Sequence[int], fps: float) -> Tensor:
    """Features [T,23,6] in which a foot stands through each seam, and the body goes where it leads.

    Two poses that fade into each other stand in two pairs of places, and all feet would slide from
    one pair to the other. The foot that stands longer stays and the other steps; the root gives way
    by what the standing foot would slide.

    Args:
        features: raw, of a dance.
        seams: frames in which one figure is half faded into another, ascending; 0 <= seam < T.
        fps: frames a second.
    """
    last = len(features) - 1
    if not len(seams) or last < 1:
        return features
    result, time = features.clone(), np.arange(last) / fps
    reach = round(STEP * fps)
    middles = [0, *((one + other) // 2 for one, other in pairwise(seams)), last]
    share = np.zeros(last)
    for seam, left, right in zip(seams, middles, middles[1:], strict=False):
        span = slice(max(seam - reach, left), min(seam + reach, right) + 1)
        stood = features[span, ROOT_ROW, LEFT_CONTACT:].sum(0)
        if float(stood.max()) > STOOD * (span.stop - span.start):
            longer = int(stood.argmax())
            result[span, ROOT_ROW, LEFT_CONTACT + longer] = 1.0
            result[span, ROOT_ROW, RIGHT_CONTACT - longer] = 0.0
        x = np.clip((LED - np.abs(time - seam / fps)) / RAMP, 0, 1)
        share = np.maximum(share, x * x * (3 - 2 * x))
    carries = smoothed(result[:last, ROOT_ROW, LEFT_CONTACT:].double().numpy(), TAKEN * fps)
    carries *= (share / np.maximum(carries.sum(1), 1.0))[:, None]  # T-1 2
    rows = features[:, ROOT_ROW].double()
    rotations = rotation_6d_to_matrix(features[:, :NUM_JOINTS].double())
    feet = to_world(heading_joints(rotations, rows[:, HEIGHT])[:, FEET], rows, fps)  # T 2 3
    heading = integrate_root(rows, fps)[1][:-1, None].expand(-1, 2)
    slides = turn_about_y(feet.diff(dim=0) * fps, -heading)
    led = (torch.from_numpy(carries)[..., None] * slides).sum(1)[:, [0, 2]]  # T-1 2
    led *= GIVES / led.norm(dim=1, keepdim=True).clamp_min(GIVES)
    result[:last, ROOT_ROW, FORWARD] -= led[:, 1].float()
    result[:last, ROOT_ROW, LATERAL] -= led[:, 0].float()
    return result


def resampled(features: Tensor, frame: np.ndarray, rate: np.ndarray) -> Tensor:
    """Features [t,23,6] at frames [t] of some [F,23,6], gone through at rates [t]."""
    low = np.clip(np.floor(frame).astype(int), 0, len(features) - 2)
    share = torch.from_numpy(frame - low).float()[:, None, None]
    found = torch.lerp(features[low], features[low + 1], share)
    near = features[np.rint(frame).astype(int), ROOT_ROW, LEFT_CONTACT:]
    found[:, ROOT_ROW, LEFT_CONTACT:] = near
    way = [FORWARD, LATERAL, YAW_RATE]
    found[:, ROOT_ROW, way] *= torch.from_numpy(rate).float()[:, None]
    return found


def settled(features: Tensor, end: float, seconds: float, fps: float = 30.0) -> Tensor:
    """Features [T,23,6] that come to rest at a moment, in the pose that they have there: in the
    last `seconds` before they first hasten a little (by a third at most), then slow down. Who is in
    the air then, and lands later, is left so; who does not rests where both feet last stood in
    those seconds, or one."""
    at = min(round(end * fps), len(features) - 1)
    first = max(0, at - round(seconds * fps))
    stands = features[first:, ROOT_ROW, LEFT_CONTACT:] > 0.5
    flies = not stands[at - first].any()
    if flies and (stands[at - first :].any() or not stands.any()):
        return features
    if flies:
        firm = stands.all(1) if stands.all(1).any() else stands.any(1)
        end = (first + int(torch.nonzero(firm)[-1])) / fps
    time = np.arange(len(features)) / fps
    x = np.where(time < end, (time - end) / seconds + 1, 0.0).clip(min=0)
    shown, rate = time + seconds * (x**2 - x**3), 1 + 2 * x - 3 * x**2
    if flies:
        shown, rate = np.minimum(shown, end), np.where(time < end, rate, 0.0)
    return resampled(features, np.clip(shown * fps, 0, len(features) - 1.0), rate)


def stopping(features: Tensor, counts: np.ndarray, share: float, fps: float = 30.0) -> Tensor:
    """Features [T,23,6] that hold still around every count, and get from one to the next in what is
    left of the time, by the minimum-jerk profile (Flash and Hogan 1985).

    Args:
        features: of a dance.
        counts: seconds [C], ascending, C ≥ 2; before and after them nothing changes.
        share: of a count that is held.
    """
    time = np.arange(len(features)) / fps
    index = np.clip(np.searchsorted(counts, time, side="right") - 1, 0, len(counts) - 2)
    length = np.diff(counts)[index]
    x = np.clip(((time - counts[index]) / length - share / 2) / (1 - share), 0, 1)
    shown = counts[index] + length * x**3 * (10 - 15 * x + 6 * x**2)
    rate = 30 * x**2 * (1 - x) ** 2 / (1 - share)
    inside = (time >= counts[0]) & (time < counts[-1])
    shown, rate = np.where(inside, shown, time), np.where(inside, rate, 1.0)
    return resampled(features, np.clip(shown * fps, 0, len(features) - 1.0), rate)


BENT = {  # degrees from the rest pose, at most: of joints that capture knows by a marker or two
    **dict.fromkeys(("l_wrist", "r_wrist", "l_ankle", "r_ankle", "l_foot", "r_foot"), 120.0),
    **{"neck": 75.0, "head": 90.0},
    **dict.fromkeys(("l_shoulder", "r_shoulder", "l_elbow", "r_elbow"), 180.0),  # snaps alone
}
SNAP = 40.0  # degrees in a frame


def without_flips(motion: Motion, around: int = 2, joints: Collection[str] = BENT) -> Motion:
    """A motion whose head, arms and feet neither turn over nor snap from one frame to the next.

    In some takes a head hangs upside down in its chest, or a hand turns over and back within three
    frames (CMU 60_06, 60_09). Such frames lead from the last sound one to the next; where a take
    has none, the joint is straight. A joint stays as it was where that would snap more often.

    Args:
        motion: of T frames.
        around: frames before and behind a snap that are not sound either.
        joints: of those in BENT.
    """
    turns = motion.quaternions.astype(np.float64).copy()
    for name in joints:
        own = turns[:, JOINT_INDEX[name]]
        sound = _degrees(own, np.array([1.0, 0.0, 0.0, 0.0])) <= BENT[name]
        snaps = _snaps(own)
        sound[
            np.unique(np.clip(snaps[:, None] + np.arange(1 - around, 1 + around), 0, len(own) - 1))
        ] = False
        mended = _led_over(own, sound)
        if len(_snaps(mended)) <= len(snaps):
            own[:] = mended
    return replace(motion, quaternions=turns.astype(np.float32))


def _led_over(turns: np.ndarray, sound: np.ndarray) -> np.ndarray:
    """Rotations [T, 4] of which those that are not sound lead from one that is to the next."""
    good = np.flatnonzero(sound)
    if not len(good):
        return np.tile([1.0, 0.0, 0.0, 0.0], (len(turns), 1))
    frames = np.clip(np.arange(len(turns)), good[0], good[-1])
    after = np.searchsorted(good, frames)
    last, coming = good[np.maximum(after - 1, 0)], good[after]
    way = torch.as_tensor((frames - last) / np.maximum(coming - last, 1))[:, None]
    # as rotation vectors, so that the way is nowhere bent further than its ends are
    start, end = (quaternion_log(torch.as_tensor(turns[ends])) for ends in (last, coming))
    between = quaternion_exp(torch.lerp(start, end, way)).numpy()
    return np.where(sound[:, None], turns, between)


def _snaps(turns: np.ndarray) -> np.ndarray:
    """Frames after which rotations [T, 4] turn by more than SNAP."""
    return np.flatnonzero(_degrees(turns[1:], turns[:-1]) > SNAP)


def _degrees(one: np.ndarray, other: np.ndarray) -> np.ndarray:
    """Between unit quaternions [N, 4]."""
    cosine = np.clip(np.abs((one * other).sum(-1)), 0.0, 1.0)
    return np.asarray(np.degrees(2 * np.arccos(cosine)))
