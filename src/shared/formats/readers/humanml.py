"""HumanML3D in: joint positions [T,22,3] or feature vectors [T,263] as NPY.

The joints are in our order, +Y up, metres, 20 frames a second. Of the feature vectors (Guo et al.
2022, "Generating Diverse and Natural 3D Human Motions from Text", section 5.1) the parts that give
positions are read. Rotations: every bone is aimed exactly; positions say nothing of the twist about
it, but pelvis and chest carry several bones, a bent knee or elbow bends about one axis, and every
other joint takes the smallest turn that aims its bone. Legend: T frames, N = 22 joints.

| channels of 263 | meaning                                                             |
|-----------------|---------------------------------------------------------------------|
| 0               | half the turn of the root about +Y to the next frame, radians       |
| 1:3             | step of the root to the next frame along its own x and z, metres    |
| 3               | height of the root, metres                                          |
| 4:67            | the other 21 joints: x and z from the root in its own axes, y as is |
| 67:263          | rotations, velocities, contacts: not read                           |
"""

from dataclasses import replace
from pathlib import Path

import numpy as np
from scipy.spatial.transform import Rotation

from ...errors import UserError
from ...motion.skeleton import JOINT_INDEX, NUM_JOINTS, PARENTS, canonical_skeleton
from ..limits import check_plausible, read_array
from ..rig import RigClip, canonical_rig, rooted_clip, swing, units

FPS = 20.0
FEATURES = 263
MAX_VALUE = 1e4  # metres
SPREAD = 0.25  # of a bone's length over time, relative: more, and they are no positions


def read_humanml(path: str | Path, *, fps: float | None = None) -> RigClip:
    """Read joint positions or feature vectors and fit rotations to them.

    Raises:
        UserError: missing, damaged, of another shape, with NaN, or normalised vectors.
    """
    path = Path(path)
    array = read_array(path)
    shapes = ((NUM_JOINTS, 3), (FEATURES,))
    if array.dtype.kind not in "fiu" or array.shape[1:] not in shapes or not len(array):
        raise UserError(f"{path}: is {array.dtype}{list(array.shape)}, expected joint positions "
                        f"[T,{NUM_JOINTS},3] or HumanML3D vectors [T,{FEATURES}]; "
                        "save one of the two")  # fmt: skip
    array = check_plausible(f"{path}:", array, MAX_VALUE)
    positions = array if array.ndim == 3 else positions_of_features(array)
    bones = np.linalg.norm(positions[:, 1:] - positions[:, list(PARENTS[1:])], axis=-1)
    if (bones.std(0) > SPREAD * bones.mean(0).max()).any() or not bones.mean(0).max() > 0.01:
        raise UserError(f"{path}: the bones change their length, so these are no positions in "
                        "metres; undo a normalisation (times Std, plus Mean) first")  # fmt: skip
    return clip_of_positions(positions, fps or FPS)


def positions_of_features(features: np.ndarray) -> np.ndarray:
    """World positions [T,22,3] of feature vectors [T,263], from the origin, facing +Z."""
    turn = np.zeros(len(features))
    turn[1:] = -2.0 * np.cumsum(features[:-1, 0])
    cos, sin = np.cos(turn), np.sin(turn)
    step = np.zeros((len(features), 2))
    step[1:] = features[:-1, 1:3]
    root = np.stack([cos * step[:, 0] + sin * step[:, 1], -sin * step[:, 0] + cos * step[:, 1]], -1)
    root = np.cumsum(root, 0)
    others = features[:, 4:67].reshape(-1, NUM_JOINTS - 1, 3)
    x, y, z = others[..., 0], others[..., 1], others[..., 2]
    cos, sin = cos[:, None], sin[:, None]
    others = np.stack([cos * x + sin * z + root[:, :1], y, -sin * x + cos * z + root[:, 1:]], -1)
    first = np.stack([root[:, 0], features[:, 3], root[:, 1]], -1)
    return np.concatenate([first[:, None], others], 1)


LEFT, UP = np.array([1.0, 0.0, 0.0]), np.array([0.0, 1.0, 0.0])
# Upper joint of a limb: its middle and end joints, and the axis about which the middle one bends.
BENDS = {"l_hip": ("l_knee", "l_ankle", LEFT), "r_hip": ("r_knee", "r_ankle", LEFT),
         "l_shoulder": ("l_elbow", "l_wrist", -UP),
         "r_shoulder": ("r_elbow", "r_wrist", UP)}  # fmt: skip
BENT = (0.1, 0.4)  # sine of a bend that tells nothing, and of one that tells all


def clip_of_positions(positions: np.ndarray, fps: float) -> RigClip:
    """Rotations for joint positions [T,22,3] in metres, +Y up; bones of mean length along ours."""
    rest = canonical_skeleton().offsets.astype(np.float64)
    bones = positions - positions[:, [max(parent, 0) for parent in PARENTS]]
    lengths = np.linalg.norm(bones, axis=-1).mean(0)
    rest, bones = units(rest), units(bones)
    limbs = {JOINT_INDEX[upper]: (JOINT_INDEX[middle], JOINT_INDEX[end], axis)
             for upper, (middle, end, axis) in BENDS.items()}  # fmt: skip
    identity = np.tile(np.eye(3), (len(positions), 1, 1))
    world = np.empty((len(positions), NUM_JOINTS, 3, 3))
    local = np.empty_like(world)
    for joint, parent in enumerate(PARENTS):
        children = [child for child in range(NUM_JOINTS) if PARENTS[child] == joint]
        above = world[:, parent] if parent >= 0 else identity
        if len(children) > 1:
            world[:, joint] = _fit(rest[children], bones[:, children])
        elif children:
            aimed = np.einsum("tji,tj->ti", above, bones[:, children[0]])
            world[:, joint] = above @ swing(rest[children[0]], aimed)
        else:
            world[:, joint] = above
        if joint in limbs:
            middle, end, axis = limbs[joint]
            normal = np.cross(bones[:, middle], bones[:, end])
            seen = np.einsum("tji,tj->ti", world[:, joint], normal)
            world[:, joint] = world[:, joint] @ _twist(rest[middle], axis, seen)
        local[:, joint] = np.swapaxes(above, -1, -2) @ world[:, joint]
    rig = replace(canonical_rig(), offsets=rest * lengths[:, None])
    return rooted_clip(rig, local, positions[:, 0], fps)


def _fit(rest: np.ndarray, seen: np.ndarray) -> np.ndarray:
    """Rotations [T,3,3] that bring directions [C,3] nearest to [T,C,3] (Kabsch 1976)."""
    u, _, v = np.linalg.svd(np.einsum("tci,cj->tij", seen, rest))
    sign = np.sign(np.linalg.det(u @ v))
    u[..., -1] *= np.where(sign == 0, 1, sign)[:, None]
    return np.asarray(u @ v)


def _twist(bone: np.ndarray, hinge: np.ndarray, seen: np.ndarray) -> np.ndarray:
    """Rotations [T,3,3] about a bone [3] that turn its hinge [3] to the bend's normals [T,3].

    A nearly straight limb (a short normal) is left alone.
    """
    angle = np.arctan2(seen @ np.cross(bone, hinge), seen @ hinge)
    part = np.clip((np.linalg.norm(seen, axis=-1) - BENT[0]) / (BENT[1] - BENT[0]), 0.0, 1.0)
    angle = angle * part * part * (3 - 2 * part)
    return np.asarray(Rotation.from_rotvec(angle[:, None] * bone).as_matrix())
