"""Any mapped skeleton onto ours: each joint keeps its world direction and its twist.

T frames, N source joints, K = 22. World rotations are carried over, not local ones, so source
joints in between (a second spine, a hip helper) need no counterpart.
"""

from functools import lru_cache

import numpy as np
import torch

from src.shared.data.mapping import SkeletonMapping
from src.shared.formats.bvh import BvhClip
from src.shared.motion.contacts import detect_contacts
from src.shared.motion.kinematics import forward_kinematics, global_to_local
from src.shared.motion.motion import Motion
from src.shared.motion.resample import resample_motion
from src.shared.motion.rotations import (
    matrix_to_quaternion,
    quaternion_continuous,
    quaternion_slerp,
    quaternion_to_matrix,
)
from src.shared.motion.skeleton import (
    FOOT_JOINTS,
    JOINT_INDEX,
    JOINT_NAMES,
    LEG_LENGTH,
    NUM_JOINTS,
    PARENTS,
    REST_FOOT_HEIGHT,
    canonical_skeleton,
)

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


def _align(start: np.ndarray, end: np.ndarray) -> np.ndarray:
    """Smallest rotation [3,3] that turns direction `start` into direction `end`."""
    a, b = start / np.linalg.norm(start), end / np.linalg.norm(end)
    v, c = np.cross(a, b), float(a @ b)
    if c < -0.999999:  # opposite: half a turn about any axis across
        axis = np.cross(a, np.eye(3)[np.argmin(np.abs(a))])
        axis /= np.linalg.norm(axis)
        return 2 * np.outer(axis, axis) - np.eye(3)
    k = np.array([[0, -v[2], v[1]], [v[2], 0, -v[0]], [-v[1], v[0], 0]])
    return np.eye(3) + k + k @ k / (1 + c)


def rest_corrections(clip: BvhClip, mapping: SkeletonMapping) -> dict[str, np.ndarray]:
    """Constant rotation [3,3] per mapped joint: world(ours) = world(source) · correction."""
    offsets = canonical_skeleton().offsets.astype(np.float64)
    index = {name: i for i, name in enumerate(clip.names)}
    corrections = {}
    for ours, theirs in mapping.joints.items():
        axes = mapping.axes_of(theirs)
        turn = np.eye(3)
        child = _AIM.get(ours)
        if child in mapping.joints:
            bone = axes @ _bone(clip, index[theirs], index[mapping.joints[child]])
            if np.linalg.norm(bone) > 1e-6:
                turn = _align(bone, offsets[JOINT_INDEX[child]])
        corrections[ours] = (turn @ axes).T
    return corrections


def _bone(clip: BvhClip, joint: int, descendant: int) -> np.ndarray:
    """Rest offset of a descendant in a joint's frame (rest rotations are identities in BVH)."""
    total = np.zeros(3)
    while descendant != joint and descendant >= 0:
        total += clip.offsets[descendant]
        descendant = clip.parents[descendant]
    return total if descendant == joint else np.zeros(3)


def _leg_length(clip: BvhClip, mapping: SkeletonMapping) -> float:
    index = {name: i for i, name in enumerate(clip.names)}
    j = {ours: index[theirs] for ours, theirs in mapping.joints.items()}
    return float(
        np.mean(
            [
                np.linalg.norm(_bone(clip, j[f"{s}_hip"], j[f"{s}_knee"]))
                + np.linalg.norm(_bone(clip, j[f"{s}_knee"], j[f"{s}_ankle"]))
                for s in "lr"
            ]
        )
    )


CALIBRATION_JUMP = 0.15  # radians a joint, mean, between the first two frames


@lru_cache
def _hip_centre() -> np.ndarray:
    offsets = canonical_skeleton().offsets
    return np.asarray((offsets[JOINT_INDEX["l_hip"]] + offsets[JOINT_INDEX["r_hip"]]) / 2)


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


def retarget(clip: BvhClip, mapping: SkeletonMapping, *, fps: float = 30.0) -> Motion:
    """A BVH clip as a Motion on the canonical skeleton, on the floor, at `fps`.

    Lengths are scaled so that the source's legs (hip to ankle) get ours' length, which settles
    the unit as well. The floor is put under the lower ball of the foot (2nd percentile).

    Raises:
        ValueError: the source's legs have no length.
    """
    legs = _leg_length(clip, mapping)
    if not legs > 1e-6:
        raise ValueError("the legs have no length: check the OFFSETs of hips, knees and ankles")
    index = {name: i for i, name in enumerate(clip.names)}
    positions, rotations = clip.world()
    corrections = rest_corrections(clip, mapping)
    world = np.empty((len(rotations), NUM_JOINTS, 3, 3), np.float32)
    for ours, theirs in mapping.joints.items():
        world[:, JOINT_INDEX[ours]] = rotations[:, index[theirs]] @ corrections[ours]
    world = _fill_gaps(world, set(mapping.joints))

    hips = positions[:, [index[mapping.joints[f"{side}_hip"]] for side in "lr"]].mean(1)
    root = (hips * (LEG_LENGTH / legs) - world[:, 0] @ _hip_centre()).astype(np.float32)

    local = global_to_local(torch.as_tensor(world), PARENTS)
    quaternions = quaternion_continuous(matrix_to_quaternion(local), dim=0).numpy()
    motion = Motion(
        quaternions, root, np.zeros((len(root), 2), np.float32), fps=1.0 / clip.frame_time
    )
    return _ground(resample_motion(_without_calibration(motion), fps))


def _without_calibration(motion: Motion) -> Motion:
    """Drop a first frame that jumps: many files begin with one frame of T-pose."""
    if motion.num_frames < 3:
        return motion
    q = np.abs((motion.quaternions[:2] * motion.quaternions[1:3]).sum(-1)).clip(0, 1)
    first, second = 2 * np.arccos(q).mean(-1)  # radians a joint
    if first < CALIBRATION_JUMP or first < 5 * second:
        return motion
    return Motion(motion.quaternions[1:], motion.root_position[1:], motion.contacts[1:], motion.fps)


def _ground(motion: Motion) -> Motion:
    offsets = torch.as_tensor(canonical_skeleton().offsets)
    local = quaternion_to_matrix(torch.as_tensor(motion.quaternions))
    joints = forward_kinematics(local, torch.as_tensor(motion.root_position), offsets, PARENTS)[0]
    balls = joints[:, [ball for _, ball in FOOT_JOINTS], 1].amin(1).numpy()
    lift = np.array([0, REST_FOOT_HEIGHT - np.percentile(balls, 2), 0], np.float32)
    contacts = detect_contacts(joints.numpy() + lift, motion.fps)
    return Motion(motion.quaternions, motion.root_position + lift, contacts, motion.fps)
