"""HumanML3D joints in: positions [T,22,3] as NPY, and rotations found for them.

The joints are in our order, +Y up, metres, 20 frames a second. Positions say nothing of the twist
about a bone: pelvis and chest are fitted to the three bones that leave each, every other joint
takes the smallest turn that aims its bone. Legend: T frames.
"""

from pathlib import Path

import numpy as np

from src.shared.errors import UserError
from src.shared.formats.joint_clip import JointClip
from src.shared.formats.limits import read_array
from src.shared.motion.skeleton import NUM_JOINTS, PARENTS, canonical_skeleton

FPS = 20.0
MAX_VALUE = 1e4  # metres


def read_humanml(path: str | Path, *, fps: float | None = None) -> JointClip:
    """Read joint positions [T,22,3] and fit rotations to them.

    Raises:
        UserError: missing, damaged, of another shape, or with NaN.
    """
    path = Path(path)
    array = read_array(path)
    if array.dtype.kind not in "fiu" or array.shape[1:] != (NUM_JOINTS, 3) or not len(array):
        raise UserError(f"{path}: is {array.dtype}{list(array.shape)}, expected joint positions "
                        f"[T,{NUM_JOINTS},3]")  # fmt: skip
    positions = array.astype(np.float64)
    if not np.abs(positions).max() < MAX_VALUE:
        raise UserError(f"{path}: holds NaN or impossibly large values")
    return clip_of_positions(positions, fps or FPS)


def clip_of_positions(positions: np.ndarray, fps: float) -> JointClip:
    """Rotations for joint positions [T,22,3], bones of mean length along ours."""
    rest = canonical_skeleton().offsets.astype(np.float64)
    bones = positions - positions[:, [max(parent, 0) for parent in PARENTS]]
    lengths = np.linalg.norm(bones, axis=-1).mean(0)
    unit = rest / np.maximum(np.linalg.norm(rest, axis=-1, keepdims=True), 1e-9)
    local = np.tile(np.eye(3), (len(positions), NUM_JOINTS, 1, 1))
    world = local.copy()
    for joint, parent in enumerate(PARENTS):
        children = [child for child in range(NUM_JOINTS) if PARENTS[child] == joint]
        above = world[:, parent] if parent >= 0 else np.tile(np.eye(3), (len(positions), 1, 1))
        if len(children) > 1:
            world[:, joint] = _fit(unit[children], _units(bones[:, children]))
        elif children:
            aimed = np.einsum("tji,tj->ti", above, _units(bones[:, children[0]]))
            local[:, joint] = _swing(unit[children[0]], aimed)
            world[:, joint] = above @ local[:, joint]
        else:
            world[:, joint] = above
        local[:, joint] = np.swapaxes(above, -1, -2) @ world[:, joint]
    return JointClip(local, positions[:, 0], unit * lengths[:, None], 1.0 / fps)


def _units(vectors: np.ndarray) -> np.ndarray:
    return vectors / np.maximum(np.linalg.norm(vectors, axis=-1, keepdims=True), 1e-9)


def _fit(rest: np.ndarray, seen: np.ndarray) -> np.ndarray:
    """Rotations [T,3,3] that bring directions [C,3] nearest to [T,C,3] (Kabsch 1976)."""
    u, _, v = np.linalg.svd(np.einsum("tci,cj->tij", seen, rest))
    sign = np.sign(np.linalg.det(u @ v))
    u[..., -1] *= np.where(sign == 0, 1, sign)[:, None]
    return np.asarray(u @ v)


def _swing(rest: np.ndarray, seen: np.ndarray) -> np.ndarray:
    """Smallest rotations [T,3,3] that turn direction [3] into [T,3]."""
    cross, cos = np.cross(rest, seen), seen @ rest
    k = np.zeros((len(seen), 3, 3))
    k[:, 0, 1], k[:, 0, 2], k[:, 1, 2] = -cross[:, 2], cross[:, 1], -cross[:, 0]
    k -= np.swapaxes(k, -1, -2)
    result = np.eye(3) + k + k @ k / np.maximum(1 + cos, 1e-9)[:, None, None]
    axis = np.cross(rest, np.eye(3)[np.argmin(np.abs(rest))])
    axis /= np.linalg.norm(axis)
    half = 2 * np.outer(axis, axis) - np.eye(3)  # opposite: half a turn about any axis across
    return np.where((cos < -0.999999)[:, None, None], half, result)
