"""From sampled features to a motion: smoothing, Gram–Schmidt, quaternions, clamp, foot lock; arms
that hang at both ends, hands that meet.

TEXT, inference only. Order: depthwise smoothing → Gram–Schmidt → quaternion → optional velocity
clamp → optional footskate clean-up. `streaming.py` does the same piece by piece.

Letters: B batch, T frames, R = K bones and, with a root track, one row more; C channels.
"""

import math
from collections.abc import Sequence
from dataclasses import replace
from itertools import pairwise

import numpy as np

from ...config_schema import PostProcessingConfig
from ...tensors import F, Tensor, nn, torch
from ..features import LEFT_CONTACT, ORIGIN, ROOT_ROW, Place, decode_features, headings
from ..filters import greatest, smoothed
from ..motion import Motion
from ..rotations import (
    forward_kinematics,
    matrix_to_quaternion,
    matrix_to_rotation_6d,
    quaternion_conjugate,
    quaternion_continuous,
    quaternion_exp,
    quaternion_log,
    quaternion_multiply,
    quaternion_slerp,
    quaternion_to_matrix,
    rotation_6d_to_matrix,
    yaw_to_matrix,
)
from ..skeleton import JOINT_INDEX, LIMBS, PARENTS, canonical_skeleton
from .footskate import ease_from_kept, kept_legs, lock_carried_feet, lock_feet, two_bone_ik


def smoothing_weights(config: PostProcessingConfig) -> list[float]:
    """The filter over time that a configuration asks for, an odd number of frames, [1] = none.

    A binomial average B of `smoothing_kernel` frames. It takes a quarter of what happens at 5 Hz,
    the steps of a run among it; with `smoothing_twicing` that is smoothed as well and put back,
    2B − B² (Tukey, Exploratory Data Analysis, 1977: twicing). Of three frames these are
    (−1, 4, 10, 4, −1)/16: nothing of the highest frequency is left, 94% of 5 Hz (Shapiro, Reviews
    of Geophysics 8, 1970, order 2).
    """
    size = config.smoothing_kernel
    once = np.array([math.comb(size - 1, k) for k in range(size)]) / 2 ** (size - 1)
    if not config.smoothing_twicing:
        return list(once.tolist())
    twice = np.pad(2 * once, size // 2) - np.convolve(once, once)
    return list(twice.tolist())


def smooth_features(features: Tensor, weights: Sequence[float]) -> Tensor:
    """Average over time, [...,T,R,C] → the same; the ends repeat their last frame.

    6D rows leave the sphere a little, which Gram–Schmidt mends. Contacts are left as they are:
    a foot is on the ground or not.

    Args:
        features: any number of leading dimensions; crop padding first.
        weights: of an odd number of frames, `smoothing_weights`.
    """
    size = len(weights)
    if size == 1:
        return features
    frames, rows, channels = features.shape[-3:]
    series = features.reshape(-1, frames, rows * channels).swapaxes(1, 2)  # B R*C T
    padded = F.pad(series, (size // 2, size // 2), mode="replicate")
    depthwise = features.new_tensor(weights).expand(rows * channels, 1, size)
    smooth = F.conv1d(padded, depthwise, groups=rows * channels)
    smooth = smooth.swapaxes(1, 2).reshape(features.shape)
    if rows > ROOT_ROW:
        smooth[..., ROOT_ROW, LEFT_CONTACT:] = features[..., ROOT_ROW, LEFT_CONTACT:]
    return smooth


def clamp_velocity(quaternions: Tensor, max_velocity: float | None, fps: float) -> Tensor:
    """Rotations that no joint turns faster than allowed, [...,T,K,4] → the same.

    Each frame follows the wanted rotation along the geodesic, as far as one frame allows, so a
    jump becomes a ramp that arrives late. Frames within the limit are returned untouched, as are
    all where `max_velocity`, rad/s, is None.
    """
    if max_velocity is None:
        return quaternions
    limit = max_velocity / fps  # radians a frame
    wanted = quaternions.unbind(-3)
    path = [wanted[0]]
    for target in wanted[1:]:
        step = quaternion_log(quaternion_multiply(quaternion_conjugate(path[-1]), target))
        angle = step.norm(dim=-1, keepdim=True)
        reachable = step * (limit / angle.clip(min=limit))
        limited = quaternion_multiply(path[-1], quaternion_exp(reachable))
        path.append(torch.where(angle > limit, limited, target))
    return quaternion_continuous(torch.stack(path, -3), dim=-3)


class MotionPostProcessor(nn.Module):
    """All of it, as configured, for features of a whole motion.

    Args:
        config: what is done.
        fps: frames a second.
    """

    def __init__(self, config: PostProcessingConfig, fps: float = 30.0) -> None:
        super().__init__()
        self.config, self.fps = config, fps
        self.weights = smoothing_weights(config)

    def forward(
        self,
        features: Tensor,
        known: Tensor | None = None,
        *,
        text: str = "",
        place: Place = ORIGIN,
        foot_lock: bool | None = None,
        carried: bool = False,
    ) -> Motion:
        """One sample's features [T,K+1,6] or [T,K,6], not z-scored → Motion.

        Args:
            features: as sampled.
            known: bool, at least as many rows as `features`: entries to be left as they are. A
                leg of which a joint is known is not moved by the foot lock.
            text: the caption.
            place: of the first frame.
            foot_lock: hold standing feet; None = as configured.
            carried: a path that is not the body's own is known.
        """
        smooth = smooth_features(features, self.weights)
        if known is not None:
            known = known[:, : features.shape[1]]
            # Neither what was made of the pelvis nor an average has a heading of its own to add.
            smooth = without_heading(torch.where(known, features, smooth))
            smooth = torch.where(known, features, smooth)
        motion = decode_features(smooth, fps=self.fps, place=place, text=text)
        if self.config.max_velocity is not None:
            quaternions = torch.as_tensor(motion.quaternions)
            clamped = clamp_velocity(quaternions, self.config.max_velocity, self.fps)
            motion = replace(motion, quaternions=clamped.numpy())
        if not (self.config.foot_lock if foot_lock is None else foot_lock):
            return motion
        lock = lock_carried_feet if carried else lock_feet
        kept = None if known is None else kept_legs(known)
        if kept is None or not kept.any():
            return lock(motion)
        return ease_from_kept(motion, lock(motion, kept=kept), kept)


PELVIS = 0  # its row


def without_heading(features: Tensor) -> Tensor:
    """Features [T,R,6] whose pelvis row has no heading left: that is the path's alone."""
    pelvis = rotation_6d_to_matrix(features[:, PELVIS])
    level = yaw_to_matrix(-headings(pelvis)) @ pelvis
    return torch.cat((matrix_to_rotation_6d(level)[:, None], features[:, 1:]), 1)


# ---------------------------------------------------------------- arms at rest

ARMS = [[JOINT_INDEX[joint] for joint in LIMBS[arm]] for arm in ("left-arm", "right-arm")]
REST_FADE = 0.5  # seconds in which an arm comes down
HURRY = 5.5  # m/s of a wrist about the pelvis, beyond which no arm comes up or down for a gesture
NEAR_END, WIDER = 0.7, 0.2  # seconds: of an end; around frames that are so fast
SLOWED = 0.09  # seconds, standard deviation of the average over time
# Rotation vectors of a left arm that hangs beside the body, out of the T-pose; mirrored in y and z.
_HANGING = {"collar": (0.0, 0.0, 0.0), "shoulder": (0.0, 0.0, -1.37), "elbow": (0.0, -0.38, 0.0),
            "wrist": (0.0, 0.0, 0.0)}  # fmt: skip


def _hanging(letter: str) -> dict[int, np.ndarray]:
    """Joints of the left or right arm, l or r, and the rotation vectors [3] with which it hangs."""
    mirror = (1.0, 1.0, 1.0) if letter == "l" else (1.0, -1.0, -1.0)
    return {JOINT_INDEX[f"{letter}_{joint}"]: np.multiply(turn, mirror)
            for joint, turn in _HANGING.items()}  # fmt: skip


def hanging_arms() -> dict[int, Tensor]:
    """Joints of both arms that hang, and their 6D rows [6]."""
    turns = {
        joint: torch.as_tensor(turn) for side in "lr" for joint, turn in _hanging(side).items()
    }
    return {
        joint: matrix_to_rotation_6d(quaternion_to_matrix(quaternion_exp(turn))).float()
        for joint, turn in turns.items()
    }


def rest_to_rest(
    motion: Motion, cuts: Sequence[int] | None = None, *, held: bool = False
) -> Motion:
    """The same motion with arms that hang in its first and last frame, where they did not.

    Within REST_FADE seconds of an end each joint of a raised arm turns towards how it hangs, with
    no speed at either side of the fade. The rest of the body is not touched, nor is a motion that
    is shorter than four fades.

    Args:
        motion: T frames.
        cuts: instead of at the ends arms hang here: between frames c - 1 and c, at least four fades
            from each other and from the ends.
        held: the end is left as it is.
    """
    frames, last = round(REST_FADE * motion.fps), motion.num_frames - 1
    if motion.num_frames < 4 * frames:
        return motion
    whole = [[(0, 1)], [(last, -1)]][: 1 if held else 2]
    ends = whole if cuts is None else [[(c - 1, -1), (c, 1)] for c in cuts]
    positions = motion.positions()
    heights = positions[:, :, 1]
    quaternions = motion.quaternions.copy()
    left = np.linspace(1.0, 0.0, frames + 1)[:-1]  # from an end inwards
    weights = left**3 * (10 - 15 * left + 6 * left**2)  # [frames], the minimum-jerk profile
    raised = [
        (row + way * np.arange(frames), joint, turn)
        for end in ends
        for letter in "lr"
        if any(heights[row, JOINT_INDEX[f"{letter}_wrist"]] >= heights[row, 0] for row, _ in end)
        for row, way in end
        for joint, turn in _hanging(letter).items()
    ]
    if raised:
        at, joints, turns = map(np.stack, zip(*raised, strict=True))
        now = torch.as_tensor(quaternions[at, joints[:, None]]).float()  # joints, frames, 4
        hung = quaternion_exp(torch.as_tensor(turns, dtype=torch.float32))[:, None].expand_as(now)
        moved = quaternion_slerp(now, hung, torch.as_tensor(weights).float()[:, None])
        quaternions[at, joints[:, None]] = moved.numpy()
    signed = quaternion_continuous(torch.as_tensor(quaternions), dim=0).numpy()
    rested = replace(motion, quaternions=signed)
    return rested if cuts is not None else _unhurried(rested, positions, held=held)


def _unhurried(motion: Motion, positions: np.ndarray, *, held: bool) -> Motion:
    """The motion with arms that come up at its begin and down at its end no faster than arms do: a
    wrist that is faster than HURRY there, by positions [T,22,3], has its arm's rotations averaged
    over time."""
    quaternions, frames = motion.quaternions.copy(), len(positions)
    near = min(round(NEAR_END * motion.fps), frames // 6)
    ends = np.zeros(frames, dtype=bool)
    ends[:near], ends[frames - near :] = True, not held
    for arm in ARMS:
        wrist = positions[:, arm[-1]] - positions[:, 0]
        speed = np.linalg.norm(np.gradient(wrist, axis=0), axis=1) * motion.fps
        hurries = (speed > HURRY) & ends
        if not hurries.any():
            continue
        wide = greatest(hurries.astype(float), 2 * round(WIDER * motion.fps) + 1)
        share = torch.as_tensor(smoothed(wide, SLOWED * motion.fps))[:, None, None]
        rows = torch.as_tensor(quaternions[:, arm], dtype=torch.float64)
        mean = F.normalize(torch.as_tensor(smoothed(rows.numpy(), SLOWED * motion.fps)), dim=-1)
        quaternions[:, arm] = quaternion_slerp(rows, mean, share).float().numpy()
    return replace(motion, quaternions=quaternions)


# ---------------------------------------------------------------- hands that meet

TOUCH, NEAR, SWING = 0.09, 0.35, 0.15  # metres of wrists: hands touch, nearly do; swing


def hands_meet(motion: Motion, start: int, stop: int) -> Motion:
    """The motion with hands that touch where they clap in frames [start, stop) and do not quite.

    A clap is where the gap of the wrists has fallen by SWING or more to less than NEAR, and rises
    by as much again. Between the widest gaps before and after it is stretched in proportion, so
    that its least is TOUCH: both hands move by half of what is lacking, along the line between
    them. Hands keep their world rotation; claps that are nearer stay as they are. Runs on the
    CPU in float64.
    """
    if stop <= start:
        return motion
    quaternions = torch.as_tensor(motion.quaternions[start:stop], dtype=torch.float64)
    root = torch.as_tensor(motion.root_position[start:stop], dtype=torch.float64)
    offsets = torch.as_tensor(canonical_skeleton().offsets, dtype=torch.float64)
    positions, world = forward_kinematics(quaternion_to_matrix(quaternions), root, offsets, PARENTS)
    between = positions[:, ARMS[1][-1]] - positions[:, ARMS[0][-1]]  # T 3
    lacking = torch.as_tensor(_lacking(between.norm(dim=-1).numpy()))
    at = torch.nonzero(lacking)[:, 0]
    if not len(at):
        return motion
    step = (lacking[:, None] * F.normalize(between, dim=-1))[at] / 2
    for (collar, shoulder, elbow, wrist), way in zip(ARMS, (1.0, -1.0), strict=True):
        upper, lower = two_bone_ik(
            positions[at, shoulder],
            world[at, shoulder],
            world[at, elbow],
            offsets[elbow],
            offsets[wrist],
            positions[at, wrist] + way * step,
            (0.0, way, 0.0),  # elbows bend forward, out of the T-pose
        )
        above = torch.stack((world[at, collar], upper, lower), 1)
        below = torch.stack((upper, lower, world[at, wrist]), 1)
        solved = matrix_to_quaternion(above.swapaxes(-1, -2) @ below)
        quaternions[at[:, None], torch.tensor([shoulder, elbow, wrist])] = solved
    moved = motion.quaternions.copy()
    moved[start + at] = quaternions[at].float().numpy()
    return replace(motion, quaternions=quaternion_continuous(torch.as_tensor(moved), dim=0).numpy())


def _lacking(gap: np.ndarray) -> np.ndarray:
    """Metres [T] by which the gap of the wrists [T] is to be less, that each clap is one."""
    claps, low, high, falls = list[int](), 0, 0, False
    for t, value in enumerate(gap):
        low, high = (t if value < gap[low] else low), (t if value > gap[high] else high)
        if falls and value - gap[low] >= SWING:
            claps += [low] if gap[low] < NEAR else []
            falls, high = False, t
        elif not falls and gap[high] - value >= SWING:
            falls, low = True, t
    ends = [0, *claps, len(gap) - 1]
    widest = [a + int(np.argmax(gap[a : b + 1])) for a, b in pairwise(ends)]
    lacking = np.zeros(len(gap))
    for least, around in zip(claps, pairwise(widest), strict=True):
        for wide in around:
            span = slice(min(least, wide), max(least, wide) + 1)
            share = (gap[wide] - gap[span]) / (gap[wide] - gap[least])
            lacking[span] = share.clip(0, 1) * max(gap[least] - TOUCH, 0)
    return lacking


BOWED = math.radians(45.0)  # of the neck and of the head on it, half each
BOW_FADE = 0.5  # seconds until it is so, and is no more, beside what else is done


def head_bowed(motion: Motion, start: int, stop: int) -> Motion:
    """The motion with a head that is lower by BOWED in frames [start, stop), and goes there and
    back where others come before and after."""
    frames, fade = np.arange(start, stop), round(BOW_FADE * motion.fps)
    down = (frames - start + 1) / fade if start > 0 else np.ones(len(frames))
    up = (stop - frames) / fade if stop < motion.num_frames else np.ones(len(frames))
    share = np.minimum(down, up).clip(0.0, 1.0)
    half = torch.as_tensor(share * share * (3.0 - 2.0 * share) * BOWED / 4, dtype=torch.float32)
    still = torch.zeros_like(half)
    turn = torch.stack((torch.cos(half), torch.sin(half), still, still), -1)  # about their own x
    quaternions = motion.quaternions.copy()
    for joint in (JOINT_INDEX["neck"], JOINT_INDEX["head"]):
        own = torch.as_tensor(quaternions[start:stop, joint])
        quaternions[start:stop, joint] = quaternion_multiply(own, turn).numpy()
    return replace(motion, quaternions=quaternions)


SETTLED = 0.1  # seconds of a foot that has landed


def until_landed(motion: Motion, steps: int, last: int, otherwise: int) -> Motion:
    """The motion as far as the frame in which a foot has landed so many times; 0 = all of it.

    Args:
        steps: landings of either foot; none before half a step's time, which had begun before.
        last: frames at the end, in which they are counted.
        otherwise: how many of these so many steps take, by their pace; what is left where there
            are fewer landings.
    """
    if not steps:
        return motion
    start = motion.num_frames - last
    stands = motion.contacts[start:] > 0.5  # T 2
    lands = np.flatnonzero((stands[1:] & ~stands[:-1]).any(1)) + 1
    lands = lands[lands >= 0.5 * otherwise / steps]
    if len(lands) >= steps:
        otherwise = min(int(lands[steps - 1]) + round(SETTLED * motion.fps), last)
    return motion.frames(0, start + otherwise)
