"""Stitching: where a body stands, motions one after the other, seams without a jump, and the way
from one posture to another that lies too far away for a seam.

Runs on the CPU in float64.

Letters: T frames, R rows (bones, root track), C channels, N columns (one channel of one row).
"""

import math
from collections.abc import Sequence
from dataclasses import replace
from itertools import pairwise

import numpy as np

from ...tensors import Tensor, torch
from ..features import (
    FORWARD,
    HEIGHT,
    LATERAL,
    LEFT_CONTACT,
    ROOT_ROW,
    YAW_RATE,
    Place,
    heading_joints,
    motion_heading,
)
from ..filters import smoothed
from ..motion import Motion
from ..rotations import (
    axis_angle_to_matrix,
    matrix_to_quaternion,
    matrix_to_rotation_6d,
    quaternion_conjugate,
    quaternion_continuous,
    quaternion_exp,
    quaternion_log,
    quaternion_multiply,
    quaternion_to_matrix,
    rotation_6d_to_matrix,
    rotation_6d_to_quaternion,
    turn_about_y,
    yaw_quaternion,
)
from ..skeleton import JOINT_INDEX, JOINT_NAMES, NUM_JOINTS, REST_PELVIS_HEIGHT

FADE = 10  # frames until a correction at a border has faded out
BLUR, REACH = 1.5, 4.0  # frames, standard deviations: of the average at a cut, of where it is made


def place_of(motion: Motion, frame: int) -> Place:
    """Where a body is in a frame."""
    x, _, z = motion.root_position[frame].tolist()
    return Place(x, z, float(motion_heading(motion)[frame]))


def moved_to(motion: Motion, place: Place) -> Motion:
    """The same motion with its first frame somewhere else on the ground."""
    here = place_of(motion, 0)
    turn = place.heading - here.heading
    path = torch.as_tensor(motion.root_position, dtype=torch.float64)
    path = turn_about_y(path - torch.tensor([here.x, 0.0, here.z]), turn)
    path = path + torch.tensor([place.x, 0.0, place.z])
    quaternions = motion.quaternions.copy()
    pelvis = torch.as_tensor(quaternions[:, 0], dtype=torch.float64)
    yaw = yaw_quaternion(torch.tensor(turn, dtype=torch.float64))
    quaternions[:, 0] = quaternion_multiply(yaw.expand_as(pelvis), pelvis).numpy()
    return replace(motion, quaternions=quaternions, root_position=path.float().numpy())


def joined(first: Motion, second: Motion) -> Motion:
    """Two motions one after the other, both where they are; quaternion signs go on."""
    quaternions = np.concatenate((first.quaternions, second.quaternions))
    return replace(
        first,
        quaternions=quaternion_continuous(torch.as_tensor(quaternions), dim=0).numpy(),
        root_position=np.concatenate((first.root_position, second.root_position)),
        contacts=np.concatenate((first.contacts, second.contacts)),
    )


def blend_boundaries(features: Tensor, known: Tensor, *, fade: int = FADE) -> Tensor:
    """Features with unknown entries moved to meet the known ones; contacts stay as they are.

    Args:
        features: raw [T,R,C].
        known: bool [T,R,C]; these entries are left alone.
        fade: frames; no more than half of a gap.
    """
    smooth = features.double().flatten(1).numpy().copy()  # T N
    fixed = known.flatten(1).numpy().copy()  # T N
    contacts = ROOT_ROW * features.shape[2] + LEFT_CONTACT
    fixed[:, contacts:] = True
    _meet(smooth, fixed, fade)
    _meet(smooth[::-1], fixed[::-1], fade)
    return torch.from_numpy(smooth).to(features.dtype).view_as(features)


def blend_cuts(features: Tensor, cuts: Sequence[int]) -> Tensor:
    """Features averaged over time near the first frames of new pieces; contacts stay.

    Args:
        features: raw [T,R,C].
        cuts: frames at which a piece begins.
    """
    if not cuts:
        return features
    away = np.abs(np.arange(len(features))[:, None] + 0.5 - np.asarray(cuts)).min(1)
    share = np.where(away < 4 * REACH, np.exp(-0.5 * (away / REACH) ** 2), 0.0)
    rows = features.double().numpy()
    mean = smoothed(rows, BLUR)
    soft = torch.from_numpy(rows + share[:, None, None] * (mean - rows)).to(features.dtype)
    soft[:, ROOT_ROW:, LEFT_CONTACT:] = features[:, ROOT_ROW:, LEFT_CONTACT:]
    return soft


def _meet(values: np.ndarray, fixed: np.ndarray, fade: int) -> None:
    """Blend the boundaries behind fixed entries [T,N] in place: whole rotations by turning them,
    single channels by adding to them."""
    starts = fixed[:-1] & ~fixed[1:]  # T-1 N, the next frame is the first free one
    for last in np.flatnonzero(starts.any(1)):
        columns = np.flatnonzero(starts[last])
        later = fixed[last + 1 :, columns]
        lengths = np.where(later.any(0), later.argmax(0), len(later))  # until it is fixed again
        for length in np.unique(lengths):
            same = columns[lengths == length]
            part = values[last + 1 : last + 1 + length, same]
            goal = _expected(values[: last + 1, same], fixed[: last + 1, same], part)
            open_ended = last + 1 + length == len(values)
            reach = fade if open_ended else min(fade, max(1, length // 2))
            weights = _weights(length, reach)
            made = part + weights[:, None] * (goal - part[0])
            whole = np.isin(np.arange(ROOT_ROW * 6), same).reshape(-1, 6).all(1)
            if whole.any():
                at = np.searchsorted(same, np.arange(ROOT_ROW * 6).reshape(-1, 6)[whole])  # rows 6
                made[:reach, at] = _turned(part[:reach, at], goal[at], weights[:reach])
            values[last + 1 : last + 1 + length, same] = made


def _turned(rows: np.ndarray, goal: np.ndarray, weights: np.ndarray) -> np.ndarray:
    """Rotations [T,R,6] turned by what the first ones lack to their goals [R,6], weighted [T].

    On the way between rotations that lie far apart columns of 6D nearly vanish, and what is made of
    them jumps.
    """
    rotations = rotation_6d_to_matrix(torch.from_numpy(rows))
    lack = rotation_6d_to_matrix(torch.from_numpy(goal)) @ rotations[0].swapaxes(-1, -2)
    share = torch.from_numpy(weights)[:, None, None] * quaternion_log(matrix_to_quaternion(lack))
    return matrix_to_rotation_6d(quaternion_to_matrix(quaternion_exp(share)) @ rotations).numpy()


def _expected(before: np.ndarray, fixed: np.ndarray, after: np.ndarray) -> np.ndarray:
    """The first free values [N]: the last fixed ones, and the mean step of both sides on."""
    steps = [after[1] - after[0]] if len(after) > 1 else []
    if len(before) > 1:
        own = before[-1] - before[-2]
        steps.append(np.where(fixed[-2], own, steps[0] if steps else 0.0))
    return np.asarray(before[-1] + np.mean(steps, axis=0) if steps else before[-1])


def _weights(frames: int, reach: int) -> np.ndarray:
    """[frames] from 1 to 0 over `reach` frames; first and second derivative vanish at both ends."""
    return np.asarray(1 - _eased(torch.arange(frames, dtype=torch.float64) / reach).numpy())


# ---------------------------------------------------------------- from posture to posture

LEAP_SECONDS = 0.5  # in which who leaps
LEAP_HEIGHT, LEAP_TILT = 0.3, 0.64  # goes up or down by metres, or tilts, a cosine
UPRIGHT = 0.5  # cosine: a pelvis that is tilted by more lies
LOW, SEAT = 0.75, 0.35  # of a standing pelvis' height: who is lower crouches, or sits on the floor
IN_THE_AIR = 0.3  # metres above the floor of the lowest joint
EDGE, STEP = 1.0, 0.6  # seconds from one pose to the next, and until the one after that begins
FLAT = 0.02  # metres by which an ankle is higher that carries 1 / e as much
STAYS = 0.2  # m/s of a foot, at most, that carries
STOPPING = 0.1  # seconds in which what moved comes to rest
SHARP = 60.0  # 1/m, of the soft minimum of how far joints are above the floor
FLOORED = 0.2, 0.4  # metres: a pelvis that is lower rests on the floor, on the feet if it is higher
CLEAR = {"ankle": 0.08, "foot": 0.02, "wrist": 0.03, "elbow": 0.04, "knee": 0.05, "pelvis": 0.09}

Pose = dict[str, tuple[float, float, float]]  # rotation vectors in degrees; the right side mirrors
POSES: dict[str, Pose] = {
    "standing": {
        "hip": (-6, 4, 0), "knee": (19, 0, 0), "ankle": (-13, 2, 0), "shoulder": (7, -10, -72),
        "elbow": (6, -28, 1),
    },
    "crouched": {
        "pelvis": (25, 0, 0), "hip": (-118, 17, 10), "knee": (138, 0, 0), "ankle": (-16, -4, 5),
        "foot": (-29, 0, 0), "spine1": (11, 0, 0), "spine2": (13, 0, 0), "spine3": (13, 0, 0),
        "neck": (-20, 0, 0), "head": (-20, 0, 0), "shoulder": (0, -40, -62), "elbow": (6, -20, 3),
    },
    "propped": {  # on the feet and the hands, which were on the floor or soon will be
        "pelvis": (45, 0, 0), "hip": (-149, 3, 5), "knee": (125, 0, 0), "ankle": (14, 5, -5),
        "foot": (-34, 0, 0), "spine1": (20, 0, 0), "spine2": (24, 0, 0), "spine3": (24, 0, 0),
        "neck": (-38, 0, 0), "head": (-45, 0, 0), "collar": (-1, -7, 9),
        "shoulder": (-38, -65, -35), "elbow": (10, -25, 2), "wrist": (9, -4, 50),
    },
    "seated": {
        "pelvis": (-12, 0, 0), "hip": (-140, 1, 1), "spine1": (7, 0, 0), "knee": (120, 0, 0),
        "spine2": (8, 0, 0), "ankle": (33, 5, 2), "spine3": (8, 0, 0), "neck": (-3, 0, 0),
        "head": (-4, 0, 0), "shoulder": (46, 19, -69), "elbow": (6, -12, 1), "wrist": (5, -3, 60),
    },
}  # fmt: skip
WAYS: dict[str, tuple[str, ...]] = {
    "crouched": (),
    "standing": ("crouched",),
    "seated": ("crouched",),
    "prone": ("propped", "crouched"),
    "lying": ("seated", "crouched"),
    "airborne": ("standing", "crouched"),
}  # from each posture to where all ways meet
HIGH = ("standing", "airborne")


def leaps(pose: Tensor, piece: Tensor, fps: float) -> bool:
    """Whether a piece [T,R,6] that begins after a pose [R,6] is soon far higher or lower, or tilted
    otherwise, than a body gets in that time."""
    soon = torch.cat((pose[None], piece[: round(LEAP_SECONDS * fps)]))
    up = rotation_6d_to_matrix(soon[:, 0].double())[:, :, 1]
    far = (soon[:, ROOT_ROW, HEIGHT] - soon[0, ROOT_ROW, HEIGHT]).abs().max()
    return float(far) > LEAP_HEIGHT or float((up @ up[0]).min()) < LEAP_TILT


def posture(pose: Tensor) -> str:
    """One of `WAYS` for a pose [R,6]."""
    return _posture(rotation_6d_to_quaternion(pose[:NUM_JOINTS].double()), _height(pose))


def gone_down(pose: Tensor, piece: Tensor) -> int:
    """From which frame on a piece [T,R,6] is for who is low already in a pose [R,6]: where posture
    and height are nearest to that, of what follows when it has gone down. 0 where it does not."""
    start, postures = posture(pose), [posture(each) for each in piece]
    high = [at for at, name in enumerate(postures) if name in HIGH]
    if start in HIGH or not postures or postures[0] not in HIGH or high[-1] + 1 == len(postures):
        return 0
    far = (piece[:, ROOT_ROW, HEIGHT] - pose[ROOT_ROW, HEIGHT]).abs().tolist()
    low = range(high[-1] + 1, len(postures))
    return min(low, key=lambda at: (_apart(start, postures[at]), far[at]))


def bridge(before: Tensor, after: Tensor, fps: float, longest: int | None = None) -> Tensor:
    """Frames [t,R,6] from how a body was to how it begins: by way of the postures between (who lies
    sits up, crouches, stands), the lowest joint on the floor, the feet where they are.

    Each pose is reached by its own share of a sum of rotations (Kim, Kim and Shin, A general
    construction scheme for unit quaternion curves, SIGGRAPH 1995), so that none is stopped at.

    Args:
        before, after: raw features [T,R,6], with a root track.
        longest: frames at most.
    """
    ends = [pose.double() for pose in (before[-1], after[0])]
    first, last = (rotation_6d_to_quaternion(pose[:NUM_JOINTS]) for pose in ends)
    start, stop = map(posture, ends)
    names = [start, *_between(start, stop), stop]
    keys = [first, *map(_pose, names[1:-1]), last]
    total = STEP * (len(keys) - 2) + EDGE
    frames = round(total * fps)
    frames = frames if longest is None else min(frames, longest)
    time = torch.arange(frames + 2, dtype=torch.float64) * total / (frames + 1)  # both ends, too
    # It goes on as it moved at last, comes to rest, and then where it is to be.
    on = STOPPING * fps * (1 - torch.exp(-time / STOPPING)) * (1 - _eased(time / EDGE))
    was = rotation_6d_to_quaternion(before[-2:][0, :NUM_JOINTS].double())
    moving = quaternion_log(quaternion_multiply(quaternion_conjugate(was), first))
    turned = quaternion_multiply(first, quaternion_exp(on[:, None, None] * moving))
    shares = list[Tensor]()
    for number, (one, other) in enumerate(pairwise(keys)):
        shares.append(_eased((time - number * STEP) / EDGE))
        step = quaternion_log(quaternion_multiply(quaternion_conjugate(one), other))
        turned = quaternion_multiply(turned, quaternion_exp(shares[-1][:, None, None] * step))
    local = quaternion_to_matrix(turned)
    joints = heading_joints(local, torch.zeros_like(time))
    if "propped" in names:  # tilted such that hands and feet are on the floor, both
        near = 1 - shares[1] if start == "prone" else shares[-2]
        up, _, ahead = (_middle(joints, "wrist") - _middle(joints, "foot")).T[[1, 0, 2]]
        tilt = torch.atan2(up - CLEAR["wrist"] + CLEAR["foot"], ahead)
        tilt = near**4 * (tilt - tilt[0 if start == "prone" else -1]).clip(-0.6, 0.6)
        local = torch.cat((axis_angle_to_matrix(0, tilt)[:, None] @ local[:, :1], local[:, 1:]), 1)
        joints = heading_joints(local, torch.zeros_like(time))
    floor = torch.log((SHARP * (_CLEAR - joints[..., 1])).exp().sum(1)) / SHARP  # pelvis' height
    above = torch.stack([_height(pose) for pose in ends]) - floor[[0, -1]]
    share = _eased(time / total)
    above = above[0] + share * (above[1] - above[0])
    height = floor + above
    low, high = FLOORED
    carried = ((height - low) / (high - low)).clip(0, 1) * (1 - above / IN_THE_AIR).clip(0, 1)
    balls = joints[:, [JOINT_INDEX["l_foot"], JOINT_INDEX["r_foot"]]].diff(dim=0) * fps  # T 2 3
    ankles = joints[:, [JOINT_INDEX["l_ankle"], JOINT_INDEX["r_ankle"]]]  # T 2 3
    flat = (-ankles[1:, :, 1] / FLAT).exp()  # the lower ankle, of the foot that is flat
    flat = (flat / flat.sum(1, keepdim=True))[..., None]
    moved = -carried[1:, None] * (flat * ankles.diff(dim=0)).sum(1) * fps
    made = torch.zeros(frames, before.shape[1], 6, dtype=torch.float64)
    made[:, :NUM_JOINTS] = matrix_to_rotation_6d(local[1:-1])
    root, fading = made[:, ROOT_ROW], torch.exp(-time[1:-1] / STOPPING)
    loose = (1 - carried[1:-1]) * fading
    root[:, FORWARD] = moved[1:, 2] + loose * ends[0][ROOT_ROW, FORWARD]
    root[:, LATERAL] = moved[1:, 0] + loose * ends[0][ROOT_ROW, LATERAL]
    root[:, YAW_RATE] = fading * ends[0][ROOT_ROW, YAW_RATE]
    root[:, HEIGHT] = height[1:-1]
    stays = (balls + moved[:, None])[1:, :, [0, 2]].norm(dim=-1) < STAYS  # T 2
    root[:, LEFT_CONTACT:] = (stays & (carried[1:-1, None] > 0)).double()
    return made.to(before.dtype)


def _posture(quaternions: Tensor, height: Tensor) -> str:
    local = quaternion_to_matrix(quaternions)
    up = local[0, :, 1]
    if float(up[1]) < UPRIGHT:
        if float(up[2]) < 0:
            return "lying"
        lowest = (heading_joints(local[None], height[None])[0, :, 1] - _CLEAR).min()
        return "airborne" if float(lowest) > IN_THE_AIR else "prone"
    share = float(height) / REST_PELVIS_HEIGHT
    return "seated" if share < SEAT else "crouched" if share < LOW else "standing"


def _between(start: str, stop: str) -> list[str]:
    """The postures on the way from one to another."""
    there, back = [start, *WAYS[start]], [stop, *WAYS[stop]]
    met = next(name for name in there if name in back)
    way = there[: there.index(met) + 1] + back[: back.index(met)][::-1]
    return way[1:-1]


def _apart(start: str, stop: str) -> int:
    return 0 if start == stop else 1 + len(_between(start, stop))


def _middle(joints: Tensor, name: str) -> Tensor:
    """Between a left and a right joint [T,3] of [T,K,3]."""
    return joints[:, [JOINT_INDEX[f"l_{name}"], JOINT_INDEX[f"r_{name}"]]].mean(1)


def _height(pose: Tensor) -> Tensor:
    return pose[ROOT_ROW, HEIGHT : HEIGHT + 1].double()[0]


def _pose(name: str) -> Tensor:
    """Quaternions [K,4] of one of `POSES`."""
    vectors = torch.zeros(NUM_JOINTS, 3, dtype=torch.float64)
    for joint, index in JOINT_INDEX.items():
        x, y, z = POSES[name].get(joint.removeprefix("l_").removeprefix("r_"), (0.0, 0.0, 0.0))
        sign = -1 if joint.startswith("r_") else 1
        vectors[index] = torch.tensor((x, sign * y, sign * z), dtype=torch.float64)
    return quaternion_exp(vectors * (math.pi / 180))


def _eased(share: Tensor) -> Tensor:
    """From 0 to 1 with minimum jerk (Flash and Hogan 1985)."""
    x = share.clip(0, 1)
    return x**3 * (10 + x * (6 * x - 15))


_CLEAR = torch.tensor([CLEAR.get(name.rpartition("_")[2], 0.08) for name in JOINT_NAMES]).double()
