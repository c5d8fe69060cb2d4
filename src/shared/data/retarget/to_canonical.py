"""Any mapped skeleton onto ours: each joint keeps its world direction and its twist.

T frames, N source joints, K = 22. World rotations are carried over, not local ones, so source
joints in between (a second spine, a hip helper) need no counterpart.
"""

from dataclasses import replace

import numpy as np

from ...formats.rig import SourceClip
from ...motion.motion import Motion, resample_motion
from ...motion.postprocess.contacts import detect_contacts
from ...motion.rotations import (
    global_to_local,
    matrix_to_quaternion,
    quaternion_continuous,
    quaternion_slerp,
    quaternion_to_matrix,
)
from ...motion.skeleton import (
    JOINT_INDEX,
    JOINT_NAMES,
    LEG_LENGTH,
    NUM_JOINTS,
    PARENTS,
    REST_FOOT_HEIGHT,
    canonical_skeleton,
)
from ...tensors import torch
from .autodetection import aligned, calibrated_axes, joint_indices, rest_frame, upright
from .mapping import SkeletonMapping

# The child whose bone a joint aims; the pelvis and the chest carry several bones and aim none.
_AIM: dict[str, str] = {
    "spine1": "spine2", "neck": "head",
    "l_collar": "l_shoulder", "r_collar": "r_shoulder",
    "l_shoulder": "l_elbow", "r_shoulder": "r_elbow",
    "l_elbow": "l_wrist", "r_elbow": "r_wrist",
    "l_hip": "l_knee", "r_hip": "r_knee",
    "l_knee": "l_ankle", "r_knee": "r_ankle",
    "l_ankle": "l_foot", "r_ankle": "r_foot",
}  # fmt: skip

# Joints at the end of a chain keep the angle to the bone before them that they have at rest.
_CARRIED = {"l_wrist": "l_elbow", "r_wrist": "r_elbow"}


def rest_corrections(clip: SourceClip, mapping: SkeletonMapping) -> dict[str, np.ndarray]:
    """Constant rotation [3,3] per mapped joint: world(ours) = world(source) · correction."""
    offsets = canonical_skeleton().offsets.astype(np.float64)
    index = joint_indices(clip, mapping)
    standing = rest_frame(clip, mapping)
    guessed = {} if mapping.axes or standing is not None else calibrated_axes(clip, mapping, _AIM)
    corrections = {}
    turns: dict[str, np.ndarray] = {}
    for ours in sorted(mapping.joints, key=JOINT_NAMES.index):
        axes = standing if standing is not None else mapping.axes_of(mapping.joints[ours])
        axes = guessed.get(ours, axes)
        turn = np.eye(3)
        child = _AIM.get(ours)
        if child in mapping.joints:
            bone = axes @ _bone(clip, index[ours], index[child])
            if np.linalg.norm(bone) > 1e-6:
                turn = aligned(bone, offsets[JOINT_INDEX[child]])
        elif ours in _CARRIED:
            turn = turns.get(_CARRIED[ours], turn)
        turns[ours] = turn
        corrections[ours] = (turn @ axes).T
    return corrections


def line_between(clip: SourceClip, joint: int, descendant: int) -> list[int]:
    """The joints below a joint down to a descendant, the lowest first; none if it is not below."""
    line = []
    while descendant != joint and descendant >= 0:
        line.append(descendant)
        descendant = clip.parents[descendant]
    return line if descendant == joint else []


def _bone(clip: SourceClip, joint: int, descendant: int) -> np.ndarray:
    """Rest offset of a descendant in a joint's frame (rest rotations are identities in BVH)."""
    return np.asarray(clip.offsets[line_between(clip, joint, descendant)].sum(0), np.float64)


def leg_length(clip: SourceClip, mapping: SkeletonMapping) -> float:
    """Hip to ankle, mean of both sides, in the source's unit."""
    j = joint_indices(clip, mapping)
    bones = (("hip", "knee"), ("knee", "ankle"))
    legs = [[np.linalg.norm(_bone(clip, j[f"{s}_{a}"], j[f"{s}_{b}"])) for a, b in bones]
            for s in "lr"]  # fmt: skip
    return float(np.mean(np.sum(legs, 1)))


def has_short_legs(clip: SourceClip, mapping: SkeletonMapping) -> bool:
    """Whether the body has a cartoon's proportions: hardly any legs for its trunk."""
    j = joint_indices(clip, mapping)
    trunk = clip.offsets[line_between(clip, j["pelvis"], j["head"])]
    return bool(np.linalg.norm(trunk, axis=-1).sum() > SHORT_LEGS * leg_length(clip, mapping))


SHORT_LEGS = 1.2  # trunk and neck in legs; people have 0.5 … 0.9
# How high over the floor the joints that may touch it are when they do, metres.
_TOUCH = {
    "l_foot": REST_FOOT_HEIGHT, "r_foot": REST_FOOT_HEIGHT, "l_knee": 0.04, "r_knee": 0.04,
    "pelvis": 0.08, "spine3": 0.1, "head": 0.08,
    "l_elbow": 0.03, "r_elbow": 0.03, "l_wrist": 0.02, "r_wrist": 0.02,
}  # fmt: skip
BLOCK = 200_000  # frames times joints that are worked on at once
_HIP_CENTRE = canonical_skeleton().offsets[[JOINT_INDEX["l_hip"], JOINT_INDEX["r_hip"]]].sum(0) / 2
CALIBRATION_JUMP = 0.15  # radians a joint, mean, between the first two frames


def _fill_gaps(world: np.ndarray, mapped: set[str]) -> np.ndarray:
    """Unmapped joints: halfway between the mapped neighbours of a chain, or like the parent."""
    for joint, name in enumerate(JOINT_NAMES):
        if name in mapped:
            continue
        parent = PARENTS[joint]
        children = [c for c in range(NUM_JOINTS) if PARENTS[c] == joint]
        mapped_child = [c for c in children if JOINT_NAMES[c] in mapped]
        if len(children) == 1 and mapped_child:
            ends = matrix_to_quaternion(torch.as_tensor(world[:, [parent, mapped_child[0]]]))
            half = torch.full((len(world), 1), 0.5)
            world[:, joint] = quaternion_to_matrix(
                quaternion_slerp(ends[:, 0], ends[:, 1], half)
            ).numpy()
        else:
            world[:, joint] = world[:, parent]
    return world


def retarget(
    clip: SourceClip,
    mapping: SkeletonMapping,
    *,
    fps: float | None = 30.0,
    up: str = "Y",
    metres: float | None = None,
    ground: bool = True,
) -> Motion:
    """A clip as a Motion on the canonical skeleton, on the floor, at `fps`.

    Lengths are scaled so that the source's legs (hip to ankle) get ours' length, which settles
    the unit as well. The floor is put under what is lowest of the body (2nd percentile): the ball
    of a foot, mostly. Of a cartoon with short legs the rotations alone are taken: our body is put
    on the floor anew in each frame, so its jumps are lost.

    Args:
        fps: None keeps the source's own rate.
        up: the source's up axis: "Y", "Z", "-X", …
        metres: length of the source's unit; given, distances stay true instead of being scaled.
        ground: False leaves heights and the first frame as they are.

    Raises:
        ValueError: the source's legs have no length.
    """
    legs = leg_length(clip, mapping)
    if not legs > 1e-6:
        raise ValueError("the legs have no length; check the bones of hips, knees and ankles")
    scale = LEG_LENGTH / legs if metres is None else metres
    quaternions, root = _carry_over(clip, mapping, upright(up), scale)
    contacts = np.zeros((len(root), 2), np.float32)
    motion = Motion(quaternions, root, contacts, fps=1.0 / clip.frame_time)
    if ground:
        if has_short_legs(clip, mapping):
            root[:, 1] -= _lowest(_positions(motion))
        motion = _without_calibration(motion)
    motion = motion if fps is None else resample_motion(motion, fps)
    return on_floor(motion, lift=ground)


def _carry_over(
    clip: SourceClip, mapping: SkeletonMapping, turn: np.ndarray, scale: float
) -> tuple[np.ndarray, np.ndarray]:
    """Local quaternions [T,22,4] and pelvis path [T,3] on our skeleton, +Y up, float32.

    Frames are worked through in blocks: there may be hundreds of joints, or an hour.
    """
    index = joint_indices(clip, mapping)
    corrections = rest_corrections(clip, mapping)
    mapped = sorted(mapping.joints, key=JOINT_NAMES.index)
    ours, theirs = [JOINT_INDEX[name] for name in mapped], [index[name] for name in mapped]
    turned = np.stack([corrections[name] for name in mapped])
    quaternions = np.empty((clip.num_frames, NUM_JOINTS, 4), np.float32)
    root = np.empty((clip.num_frames, 3), np.float32)
    block = max(1, BLOCK // max(NUM_JOINTS, len(clip.names)))
    for start in range(0, clip.num_frames, block):
        frames = slice(start, start + block)
        positions, rotations = clip.world(frames)
        world = np.empty((len(positions), NUM_JOINTS, 3, 3), np.float32)
        world[:, ours] = turn @ rotations[:, theirs] @ turned
        world = _fill_gaps(world, set(mapping.joints))
        hips = positions[:, [index["l_hip"], index["r_hip"]]].mean(1) @ turn.T
        root[frames] = hips * scale - world[:, 0] @ _HIP_CENTRE
        local = global_to_local(torch.as_tensor(world), PARENTS)
        quaternions[frames] = matrix_to_quaternion(local).numpy()
    return quaternion_continuous(torch.as_tensor(quaternions), dim=0).numpy(), root


def _without_calibration(motion: Motion) -> Motion:
    """Drop a first frame that jumps: many files begin with one frame of T-pose."""
    if motion.num_frames < 3:
        return motion
    q = np.abs((motion.quaternions[:2] * motion.quaternions[1:3]).sum(-1)).clip(0, 1)
    first, second = 2 * np.arccos(q).mean(-1)  # radians a joint
    if first < CALIBRATION_JUMP or first < 5 * second:
        return motion
    return Motion(motion.quaternions[1:], motion.root_position[1:], motion.contacts[1:], motion.fps)


def on_floor(motion: Motion, *, lift: bool = True) -> Motion:
    """Put the floor under the body, if asked to, and find the contacts."""
    joints = _positions(motion)
    height = -np.percentile(_lowest(joints), 2) if lift else 0.0
    shift = np.array([0, height, 0], np.float32)
    contacts = detect_contacts(joints + shift, motion.fps)
    return Motion(motion.quaternions, motion.root_position + shift, contacts, motion.fps)


def _positions(motion: Motion) -> np.ndarray:
    """Joints [T,22,3], worked out in blocks."""
    block = BLOCK // NUM_JOINTS
    return np.concatenate([
        replace(motion, quaternions=motion.quaternions[start : start + block],
                root_position=motion.root_position[start : start + block]).positions()
        for start in range(0, motion.num_frames, block)
    ])  # fmt: skip


def _lowest(joints: np.ndarray) -> np.ndarray:
    """Height of the lowest part of the body [T] over a floor at 0; joints [T,22,3]."""
    heights = joints[:, [JOINT_INDEX[name] for name in _TOUCH], 1] - list(_TOUCH.values())
    return np.asarray(heights.min(1))
