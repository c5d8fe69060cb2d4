"""GLB files out: binary glTF 2.0 with an animated, skinned body.

One scene: the joints as nodes (root first, rest pose as their default), a mesh with a skin, and
one animation with a rotation channel a joint and a translation channel for each that travels.
glTF shares our conventions (metres, +Y up, right-handed, facing +Z), so nothing is turned.
Colours come from a tiny texture, because that is what every viewer and Blender show.
Legend: T frames, V vertices, F triangles, N joints.
"""

import io
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np

from ..motion.motion import Motion
from .glb_file import INDEX_DATA, VERTEX_DATA, GlbFile
from .mannequin import Mannequin, mannequin, side_colours
from .rig import Rig, RigClip, matrices_to_quaternions, motion_clip, rescaled

PALETTE_SIZE = 32  # texels, right side to left side


def write_glb(motion: Motion, path: str | Path, *, names: str = "canonical") -> Path:
    """Write one motion as an animated GLB; its joints move as `motion.positions()` does.

    Args:
        motion: what to write.
        path: the file.
        names: what the joints are called (`joint_names.SCHEMES`).

    Raises:
        UserError: the file cannot be written.
    """
    return _write(motion_clip(motion, names), mannequin(), path)


def write_glb_clip(clip: RigClip, path: str | Path) -> Path:
    """Write a rig's motion as an animated GLB, with a simple body of its bones.

    Raises:
        UserError: the file cannot be written.
    """
    from .bone_mesh import bone_mesh

    clip = rescaled(clip, 1.0)
    return _write(clip, bone_mesh(clip.rig, clip.moving()), path)


def _write(clip: RigClip, body: Mannequin, path: str | Path) -> Path:
    file = GlbFile()
    name = clip.text or "motion"
    joints = len(clip.names)
    document = {
        "asset": {"version": "2.0", "generator": "motion-tools"},
        "scene": 0,
        "scenes": [{"name": name, "nodes": [0, joints], "extras": {"text": clip.text}}],
        "nodes": _nodes(clip.rig),
        "animations": [
            animation(clip, file, list(range(joints)), clip.rig.frames) | {"name": name}
        ],
        "meshes": [_mesh(body, file)],
        "skins": [_skin(clip.rig, file)],
        "materials": [
            {
                "name": "mannequin",
                "pbrMetallicRoughness": {
                    "baseColorTexture": {"index": 0},
                    "metallicFactor": 0.0,
                    "roughnessFactor": 0.7,
                },
            }
        ],
        "textures": [{"source": 0, "sampler": 0}],
        "samplers": [{"magFilter": 9729, "minFilter": 9729, "wrapS": 33071, "wrapT": 33071}],
        "images": [{"name": "sides", "mimeType": "image/png", "bufferView": file.view(_palette())}],
    }
    file.document |= document
    return file.write(Path(path))


def _nodes(rig: Rig) -> list[dict[str, Any]]:
    """The joints in the rest pose, then the mesh."""
    nodes: list[dict[str, Any]] = []
    above = parent_frames(rig, rig.frames)
    turns = matrices_to_quaternions(above.swapaxes(-1, -2) @ rig.frames)[:, [1, 2, 3, 0]]
    for joint, name in enumerate(rig.names):
        place = (rig.offsets[joint] @ above[joint]).astype(np.float32)
        node: dict[str, Any] = {"name": name, "translation": place.tolist()}
        if np.abs(turns[joint, :3]).max() > 1e-7:
            node["rotation"] = turns[joint].tolist()
        if children := rig.children(joint):
            node["children"] = children
        nodes.append(node)
    return [*nodes, {"name": "mannequin", "mesh": 0, "skin": 0}]


def parent_frames(rig: Rig, frames: np.ndarray, base: np.ndarray | None = None) -> np.ndarray:
    """The axes [N,3,3] in which each joint's own pose is told: its parent's, at rest."""
    top = np.eye(3) if base is None else base[:3, :3] / np.linalg.norm(base[:3, :3], axis=0)
    return np.array([frames[parent] if parent >= 0 else top for parent in rig.parents])


def _mesh(body: Mannequin, file: GlbFile) -> dict[str, Any]:
    index_type = np.uint16 if len(body.vertices) < 65535 else np.uint32
    # The middle of the outer texels, so that the ends are never blended with anything.
    u = 0.5 + 0.5 * body.side * (1 - 1 / PALETTE_SIZE)
    attributes = {
        "POSITION": file.accessor(body.vertices, VERTEX_DATA, bounds=True),
        "NORMAL": file.accessor(body.normals, VERTEX_DATA),
        "TEXCOORD_0": file.accessor(
            np.stack((u, np.full_like(u, 0.5)), -1).astype(np.float32), VERTEX_DATA
        ),
        "JOINTS_0": file.accessor(body.joints, VERTEX_DATA),
        "WEIGHTS_0": file.accessor(
            whole_shares(body.weights, 65535).astype(np.uint16), VERTEX_DATA, normalized=True
        ),
    }
    indices = file.accessor(body.triangles.reshape(-1).astype(index_type), INDEX_DATA)
    return {
        "name": "mannequin",
        "primitives": [{"attributes": attributes, "indices": indices, "material": 0}],
    }


def whole_shares(weights: np.ndarray, total: int) -> np.ndarray:
    """Weights [V,4] (heaviest first, summing to 1) as integers that sum to `total` exactly."""
    shares = np.floor(weights.astype(np.float64) * total).astype(np.int64)
    shares[:, 0] += total - shares.sum(-1)
    return shares


def _skin(rig: Rig, file: GlbFile) -> dict[str, Any]:
    """The inverse of each joint's place and axes at rest."""
    inverse = np.tile(np.eye(4), (len(rig.names), 1, 1))
    inverse[:, :3, :3] = rig.frames.swapaxes(-1, -2)
    inverse[:, :3, 3] = -(inverse[:, :3, :3] @ rig.rest()[..., None])[..., 0]
    columns = inverse.transpose(0, 2, 1).reshape(-1, 16)  # glTF stores column by column
    return {
        "name": "mannequin",
        "skeleton": 0,
        "joints": list(range(len(rig.names))),
        "inverseBindMatrices": file.accessor(columns.astype(np.float32)),
    }


def animation(
    clip: RigClip,
    file: GlbFile,
    nodes: Sequence[int],
    frames: np.ndarray,
    *,
    base: np.ndarray | None = None,
    scales: np.ndarray | None = None,
) -> dict[str, Any]:
    """Rotations of all joints and the paths of those that travel, keyed at every frame.

    A joint that never turns has one key.

    Args:
        clip: what moves, in metres.
        file: takes the keys.
        nodes: node of each joint.
        frames: the joints' own axes in the world at rest [N,3,3].
        base: matrix [4,4] of the nodes above the root.
        scales: size of a length under each joint's parent in the world [N].
    """
    above = parent_frames(clip.rig, frames, base)
    times = (np.arange(clip.num_frames) / clip.fps).astype(np.float32)
    local = above.swapaxes(-1, -2) @ clip.rotations @ frames
    rotations = continuous(matrices_to_quaternions(local))[..., [1, 2, 3, 0]].astype(np.float32)
    still = (rotations == rotations[:1]).all((0, 2)) & (clip.num_frames > 1)
    keys = file.accessor(times, bounds=True)
    single = file.accessor(times[:1], bounds=True) if still.any() else keys
    samplers: list[dict[str, Any]] = []
    channels: list[dict[str, Any]] = []

    def add(joint: int, path: str, values: np.ndarray, *, once: bool = False) -> None:
        output = file.accessor(values[:1] if once else values)
        channels.append({"sampler": len(samplers), "target": {"node": nodes[joint], "path": path}})
        samplers.append({"input": single if once else keys, "output": output})

    for joint in clip.moving():
        place = clip.translations[:, joint]
        if joint == 0 and base is not None:
            inverse = np.linalg.inv(base)
            place = place @ inverse[:3, :3].T + inverse[:3, 3]
        else:
            place = place @ above[joint] / (1.0 if scales is None else scales[joint])
        add(joint, "translation", place.astype(np.float32))
    for joint in range(len(clip.names)):
        add(joint, "rotation", rotations[:, joint], once=bool(still[joint]))
    return {
        "samplers": [sampler | {"interpolation": "LINEAR"} for sampler in samplers],
        "channels": channels,
    }


def continuous(quaternions: np.ndarray) -> np.ndarray:
    """Unit quaternions [T,...,4] with signs chosen so that neighbouring frames are near.

    Some players mix neighbouring keys as they stand, and would turn the long way round.
    """
    unit = quaternions.astype(np.float64)
    unit = unit / np.linalg.norm(unit, axis=-1, keepdims=True)
    flips = np.where((unit[1:] * unit[:-1]).sum(-1) < 0, -1.0, 1.0)
    signs = np.concatenate((np.ones_like(unit[:1, ..., 0]), np.cumprod(flips, axis=0)))
    return np.asarray(unit * signs[..., None])


def _palette() -> bytes:
    """A PNG strip from the colour of the right side over the trunk's to the left side's."""
    from PIL import Image

    row = side_colours(np.linspace(-1.0, 1.0, PALETTE_SIZE))
    pixels = np.repeat((row * 255).round().astype(np.uint8)[None], 4, axis=0)
    stream = io.BytesIO()
    Image.fromarray(pixels).save(stream, format="PNG")
    return stream.getvalue()
