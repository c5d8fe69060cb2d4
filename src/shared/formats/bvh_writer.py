"""BVH files out: the canonical skeleton in centimetres, Euler angles ZXY in degrees.

Centimetres, because Blender (scale 0.01), Maya, MotionBuilder, Unreal and Unity expect them of
a BVH file. The root has its position and rotation channels, every other joint rotations only;
`Zrotation Xrotation Yrotation` is Rz @ Rx @ Ry. The rest pose is the T-pose, +Y up, facing +Z.
Legend: T frames.
"""

from pathlib import Path

import numpy as np

from src.shared.files import write_text
from src.shared.formats.body import END_SITES
from src.shared.motion.motion import Motion
from src.shared.motion.skeleton import Skeleton, canonical_skeleton

CENTIMETRES = 100.0
ORDER = "ZXY"


def write_bvh(motion: Motion, path: str | Path) -> Path:
    """Write one motion; reading it back gives rotations and positions within 1e-4 (rad, m).

    Raises:
        UserError: the file cannot be written.
    """
    skeleton = canonical_skeleton()
    joints = _depth_first(skeleton)
    angles = np.rad2deg(quaternions_to_euler_zxy(motion.quaternions))
    root = motion.root_position.astype(np.float64)[:, None] * CENTIMETRES
    rows = np.concatenate((root, angles[:, joints]), axis=1).reshape(motion.num_frames, -1)
    lines = ["HIERARCHY", *_hierarchy(skeleton, 0, 0), "MOTION"]
    lines += [f"Frames: {motion.num_frames}", f"Frame Time: {1.0 / motion.fps:.8f}"]
    lines += [" ".join(f"{value:.5f}" for value in row) for row in rows]
    write_text(Path(path), "\n".join(lines) + "\n")
    return Path(path)


def quaternions_to_euler_zxy(quaternions: np.ndarray) -> np.ndarray:
    """Intrinsic Z, X, Y angles [T,K,3] in radians of quaternions [T,K,4] (w, x, y, z).

    With R = Rz Rx Ry: R[2,1] = sin x, R[0,1] = -sin z cos x, R[1,1] = cos z cos x. Where cos x
    vanishes z is free and taken from the frame before; y always comes from the remainder
    Rx⁻¹ Rz⁻¹ R, so the product is exact at the pole too. Of the two triples of each rotation the
    one nearer to the frame before is taken, so that tools which interpolate angles do not spin.
    """
    matrices = _to_matrices(quaternions.astype(np.float64))
    cos_x = np.hypot(matrices[..., 0, 1], matrices[..., 1, 1])
    z = np.arctan2(-matrices[..., 0, 1], matrices[..., 1, 1])
    x = np.arctan2(matrices[..., 2, 1], cos_x)
    result = np.zeros((*quaternions.shape[:2], 3))
    before = np.zeros((quaternions.shape[1], 3))
    for frame in range(len(quaternions)):
        free = cos_x[frame] < 1e-8
        z_here = np.where(free, before[:, 0], z[frame])
        first = _complete(matrices[frame], z_here, x[frame])
        second = _complete(matrices[frame], z_here + np.pi, np.pi - x[frame])
        first, second = (
            triple - 2 * np.pi * np.round((triple - before) / (2 * np.pi))
            for triple in (first, second)
        )
        nearer = np.abs(second - before).sum(-1) < np.abs(first - before).sum(-1)
        if frame == 0:  # the usual triple, |x| <= 90 degrees
            nearer[:] = False
        before = result[frame] = np.where((nearer & ~free)[:, None], second, first)
    return result


def _complete(matrices: np.ndarray, z: np.ndarray, x: np.ndarray) -> np.ndarray:
    """Add the y angle: first row of Rx⁻¹ Rz⁻¹ R is (cos y, 0, sin y)."""
    row = np.cos(z)[:, None] * matrices[:, 0] + np.sin(z)[:, None] * matrices[:, 1]
    return np.stack((z, x, np.arctan2(row[:, 2], row[:, 0])), -1)


def _to_matrices(quaternions: np.ndarray) -> np.ndarray:
    """Rotation matrices [...,3,3] of quaternions [...,4], normalised first."""
    w, x, y, z = np.moveaxis(
        quaternions / np.linalg.norm(quaternions, axis=-1, keepdims=True), -1, 0
    )
    rows = (
        (1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)),
        (2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)),
        (2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)),
    )
    return np.stack([np.stack(row, -1) for row in rows], -2)


def _children(skeleton: Skeleton, joint: int) -> list[int]:
    return [child for child, parent in enumerate(skeleton.parents) if parent == joint]


def _depth_first(skeleton: Skeleton, joint: int = 0) -> list[int]:
    """Joints in the order a BVH file lists them."""
    below = [_depth_first(skeleton, child) for child in _children(skeleton, joint)]
    return [joint, *(index for branch in below for index in branch)]


def _hierarchy(skeleton: Skeleton, joint: int, depth: int) -> list[str]:
    """Lines of one joint and everything below it."""
    pad, inner = "\t" * depth, "\t" * (depth + 1)
    rotations = " ".join(f"{axis}rotation" for axis in ORDER)
    channels = f"CHANNELS 3 {rotations}"
    if depth == 0:
        channels = f"CHANNELS 6 Xposition Yposition Zposition {rotations}"
    lines = [f"{pad}{'JOINT' if depth else 'ROOT'} {skeleton.names[joint]}", f"{pad}{{"]
    lines += [f"{inner}{_offset(skeleton.offsets[joint])}", f"{inner}{channels}"]
    for child in _children(skeleton, joint):
        lines += _hierarchy(skeleton, child, depth + 1)
    if joint in END_SITES:
        lines += [f"{inner}End Site", f"{inner}{{"]
        lines += [f"{inner}\t{_offset(np.array(END_SITES[joint]))}", f"{inner}}}"]
    return [*lines, f"{pad}}}"]


def _offset(metres: np.ndarray) -> str:
    return "OFFSET " + " ".join(f"{value:.5f}" for value in metres.astype(float) * CENTIMETRES)
