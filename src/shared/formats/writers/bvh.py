"""BVH files out: any rig; our own skeleton in centimetres, Euler angles ZXY in degrees.

Centimetres, because Blender (scale 0.01), Maya, MotionBuilder, Unreal and Unity expect them of
a BVH file. The root has its position and rotation channels, every other joint rotations only
(and positions where it moves against its parent); `Zrotation Xrotation Yrotation` is
Rz @ Rx @ Ry. Our rest pose is the T-pose, +Y up, facing +Z. Legend: T frames, K joints.
"""

from dataclasses import replace
from pathlib import Path

import numpy as np

from ...io.files import write_text
from ...motion.motion import Motion
from ..rig import Rig, RigClip, motion_clip, rescaled

CENTIMETRE = 0.01


def write_bvh(motion: Motion, path: str | Path, *, names: str = "canonical") -> Path:
    """Write one motion; reading it back gives rotations and positions within 1e-4 (rad, m).

    Args:
        names: of the joints (`rig.SCHEMES`).

    Raises:
        UserError: the file cannot be written.
    """
    clip = rescaled(motion_clip(motion, names), CENTIMETRE)
    # The pelvis path says where the root is, so its own offset would only be in the way.
    offsets = clip.rig.offsets.copy()
    offsets[0] = 0.0
    return write_bvh_clip(replace(clip, rig=replace(clip.rig, offsets=offsets)), path)


def write_bvh_clip(clip: RigClip, path: str | Path) -> Path:
    """Write a rig's motion in its own unit and Euler orders; raises UserError if it cannot."""
    rig, moving, frames = clip.rig, clip.moving(), clip.num_frames
    order = rig.depth_first()
    columns = []
    angles = np.empty((frames, len(rig.names), 3))
    for axes in set(rig.orders):
        joints = [joint for joint, other in enumerate(rig.orders) if other == axes]
        angles[:, joints] = np.rad2deg(matrices_to_euler(clip.rotations[:, joints], axes))
    for joint in order:
        columns += [clip.translations[:, joint]] if joint in moving else []
        columns.append(angles[:, joint])
    lines = ["HIERARCHY", *_hierarchy(rig, order, moving), "MOTION"]
    lines += [f"Frames: {frames}", f"Frame Time: {1.0 / clip.fps:.8f}"]
    lines += [" ".join(f"{v:.5f}" for v in row) for row in np.concatenate(columns, 1).tolist()]
    write_text(Path(path), "\n".join(lines) + "\n")
    return Path(path)


def matrices_to_euler(matrices: np.ndarray, order: str = "ZXY") -> np.ndarray:
    """Intrinsic Euler angles [T,K,3] in radians of rotations [T,K,3,3], three different axes.

    Worked out for ZXY; for any other order the axes are renamed, which for an odd permutation
    is a reflection and turns the signs of the angles.
    """
    axes = ["XYZ".index(axis) for axis in order]
    rename = np.zeros((3, 3))
    rename[[2, 0, 1], axes] = 1.0  # first axis → Z, second → X, third → Y
    angles = _euler_zxy(rename @ matrices.astype(np.float64) @ rename.T)
    return np.asarray(angles * np.linalg.det(rename))


def _euler_zxy(matrices: np.ndarray) -> np.ndarray:
    """Intrinsic Z, X, Y angles [T,K,3] in radians.

    With R = Rz Rx Ry: R[2,1] = sin x, R[0,1] = -sin z cos x, R[1,1] = cos z cos x. Where cos x
    vanishes z is free and taken from the frame before; y always comes from the remainder
    Rx⁻¹ Rz⁻¹ R, so the product is exact at the pole too. Of the two triples of each rotation the
    one nearer to the frame before is taken, so that tools which interpolate angles do not spin.
    """
    cos_x = np.hypot(matrices[..., 0, 1], matrices[..., 1, 1])
    z = np.arctan2(-matrices[..., 0, 1], matrices[..., 1, 1])
    x = np.arctan2(matrices[..., 2, 1], cos_x)
    result = np.zeros((*matrices.shape[:2], 3))
    before = np.zeros((matrices.shape[1], 3))
    for frame in range(len(matrices)):
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


def _hierarchy(rig: Rig, order: list[int], moving: list[int]) -> list[str]:
    """Lines of all joints, without recursion: a chain may be longer than Python's stack."""
    lines: list[str] = []
    depths: dict[int, int] = {-1: -1}
    level = -1
    for joint in order:
        depth = depths[joint] = depths[rig.parents[joint]] + 1
        lines += [_pad(closed) + "}" for closed in range(level, depth - 1, -1)]
        level = depth
        lines += _joint(rig, joint, _pad(depth), joint in moving)
    return lines + [_pad(closed) + "}" for closed in range(level, -1, -1)]


def _pad(depth: int) -> str:
    """Indentation; that of long chains would outgrow their content."""
    return "\t" * min(depth, 40)


def _joint(rig: Rig, joint: int, pad: str, moves: bool) -> list[str]:
    """Lines of one joint and the ends of its bones, still open for its children."""
    channels = " ".join(f"{axis}rotation" for axis in rig.orders[joint])
    lead = "6 Xposition Yposition Zposition" if moves else "3"
    title = "ROOT" if rig.parents[joint] < 0 else "JOINT"
    lines = [
        f"{pad}{title} {rig.names[joint]}",
        f"{pad}{{",
        f"{pad}\t{_offset(rig.offsets[joint])}",
    ]
    lines.append(f"{pad}\tCHANNELS {lead} {channels}")
    for end in (tip for owner, tip in rig.tips if owner == joint):
        lines += [f"{pad}\tEnd Site", f"{pad}\t{{", f"{pad}\t\t{_offset(np.array(end))}"]
        lines.append(f"{pad}\t}}")
    return lines


def _offset(offset: np.ndarray) -> str:
    # Rounded first, so that no "-0.00000" is left.
    return "OFFSET " + " ".join(f"{round(value, 5) + 0.0:.5f}" for value in offset.tolist())
