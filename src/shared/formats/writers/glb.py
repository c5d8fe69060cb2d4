"""GLB files out: binary glTF 2.0 with an animated, skinned body, or a user's own character moved.

One scene: the joints as nodes (root first, rest pose as their default), a mesh with a skin, and
one animation with a rotation channel a joint and a translation channel for each that travels.
glTF shares our conventions (metres, +Y up, right-handed, facing +Z), so nothing is turned.
Colours come from a tiny texture, because that is what every viewer and Blender show.
Legend: T frames, V vertices, F triangles, N joints."""

import io
import re
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np
from PIL import Image

from ...motion.motion import Motion
from ...motion.skeleton import NUM_JOINTS
from ...motion.trajectory import MotionTrajectory
from ..mannequin import Mannequin, mannequin, side_colours, whole_shares
from ..preview.trajectory import proxy_body
from ..readers.glb import INDEX_DATA, VERTEX_DATA, GlbFile, GlbSkeleton, without_matrix
from ..rig import (
    SCHEMES,
    Rig,
    RigClip,
    continuous,
    matrices_to_quaternions,
    motion_clip,
    parent_frames,
    rescaled,
)

PALETTE_SIZE = 32  # texels, right side to left side
# Of the mannequin, which is under the Apache licence.
_VRM_META = {
    "name": "motionsuite mannequin",
    "version": "1.0",
    "authors": ["motionsuite"],
    "licenseUrl": "https://vrm.dev/licenses/1.0/",
    "otherLicenseUrl": "https://www.apache.org/licenses/LICENSE-2.0",
    "avatarPermission": "everyone",
    "commercialUsage": "corporation",
    "creditNotation": "unnecessary",
    "modification": "allowModificationRedistribution",
    "allowRedistribution": True,
}


def write_glb(motion: Motion, path: str | Path, *, names: str = "canonical") -> Path:
    """Write one motion as an animated GLB; its joints move as `motion.positions()` does.

    Args:
        names: of the joints (`rig.SCHEMES`).

    Raises:
        UserError: the file cannot be written.
    """
    return _file(motion_clip(motion, names), mannequin()).write(Path(path))


def write_glb_clip(clip: RigClip, path: str | Path) -> Path:
    """Write a rig's motion as an animated GLB, with a simple body of its bones; raises UserError as
    `write_glb`."""
    clip = rescaled(clip, 1.0)
    return _file(clip, bone_mesh(clip.rig, clip.moving())).write(Path(path))


def write_vrm(motion: Motion, path: str | Path) -> Path:
    """Write our mannequin as a VRM 1.0 avatar, in the T-pose, with one motion as its glTF animation
    (most programs for avatars leave that out); raises UserError as `write_glb`."""
    file = _file(motion_clip(motion), mannequin())
    nodes, scene = file.document["nodes"], file.document["scenes"][0]
    scene["nodes"][0] = len(nodes)
    nodes.append({"name": "root", "children": [0]})  # VRM's is no bone, and at the origin
    return _vrm(file, "VRMC_vrm", meta=_VRM_META).write(Path(path))


def write_vrma(motion: Motion, path: str | Path) -> Path:
    """Write one motion as a VRM animation: the T-pose, whose bones VRM names, and no mesh; raises
    UserError as `write_glb`."""
    return _vrma(motion).write(Path(path))


def _vrma(motion: Motion) -> GlbFile:
    return _vrm(_file(motion_clip(motion)), "VRMC_vrm_animation")


def _vrm(file: GlbFile, name: str, **more: object) -> GlbFile:
    """The file with an extension of VRM 1.0, which names our joints."""
    names = (name[0].lower() + name[1:] for name in SCHEMES["unity"])
    bones = {name: {"node": joint} for joint, name in enumerate(names)}
    extension = {"specVersion": "1.0", "humanoid": {"humanBones": bones}} | more
    file.document |= {"extensionsUsed": [name], "extensions": {name: extension}}
    return file


def rest_files() -> dict[str, bytes]:
    """Files of `write_glb` and `write_vrma` with two keys a channel, to be replaced by those of a
    motion."""
    turned = np.zeros((2, NUM_JOINTS, 4), np.float32)
    turned[..., 0] = 1.0
    turned[1, :, :2] = np.sqrt(0.5)  # every joint turns, so that each has a key in every frame
    motion = Motion(turned, np.zeros((2, 3), np.float32), np.zeros((2, 2), np.float32))
    body = _file(motion_clip(motion), mannequin())
    return {"glb": body.to_bytes(), "vrma": _vrma(motion).to_bytes()}


def _file(clip: RigClip, body: Mannequin | None = None) -> GlbFile:
    file = GlbFile()
    name = clip.text or "motion"
    joints = len(clip.names)
    document: dict[str, Any] = {
        "asset": {"version": "2.0", "generator": "motion-tools"},
        "scene": 0,
        "scenes": [{"name": name, "nodes": [0], "extras": {"text": clip.text}}],
        "nodes": _nodes(clip.rig),
        "animations": [
            animation(clip, file, list(range(joints)), clip.rig.frames) | {"name": name}
        ],
    }
    if body:
        document |= _skinned(clip.rig, body, file)
        document["nodes"].append({"name": "mannequin", "mesh": 0, "skin": 0})
        document["scenes"][0]["nodes"].append(joints)
    file.document |= document
    return file


def _skinned(rig: Rig, body: Mannequin, file: GlbFile) -> dict[str, Any]:
    """What draws a body: mesh, skin, material."""
    return {
        "meshes": [_mesh(body, file)],
        "skins": [_skin(rig, file)],
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


def _nodes(rig: Rig) -> list[dict[str, Any]]:
    """The joints in the rest pose."""
    nodes: list[dict[str, Any]] = []
    above = parent_frames(rig, rig.frames)
    turns = matrices_to_quaternions(above.swapaxes(-1, -2) @ rig.frames)[:, [1, 2, 3, 0]]
    for joint, name in enumerate(rig.names):
        place = (rig.offsets[joint] @ above[joint]).astype(np.float32)
        node: dict[str, Any] = {"name": name, "translation": place.tolist()}
        if np.abs(turns[joint, :3]).max() > 1e-7:
            node["rotation"] = turns[joint].tolist()
        if children := rig.children[joint]:
            node["children"] = children
        nodes.append(node)
    return nodes


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


def _palette() -> bytes:
    """A PNG strip from the colour of the right side over the trunk's to the left side's."""
    row = side_colours(np.linspace(-1.0, 1.0, PALETTE_SIZE))
    pixels = np.repeat((row * 255).round().astype(np.uint8)[None], 4, axis=0)
    stream = io.BytesIO()
    Image.fromarray(pixels).save(stream, format="PNG")
    return stream.getvalue()


WAIST = 0.15  # of the bone's length from its start, where it is widest
WIDTH = 0.09  # half of that width, of the bone's length
_LEFT, _RIGHT = (
    re.compile(rf"{word}|(^|[_. :-]){word[0]}($|[_. -])", re.I) for word in ("left", "right")
)
_FACES = np.array([(0, 2, 1), (0, 3, 2), (0, 4, 3), (0, 1, 4),
                   (5, 1, 2), (5, 2, 3), (5, 3, 4), (5, 4, 1)])  # fmt: skip


def bone_mesh(rig: Rig, loose: Sequence[int] = ()) -> Mannequin:
    """The bones of a rig as a skinned mesh, each vertex moved by one joint.

    Args:
        loose: joints that move against their parents, to which no bone leads.
    """
    rest = rig.rest()
    bones = [
        (parent, rest[parent], rest[joint])
        for joint, parent in enumerate(rig.parents)
        if parent >= 0 and joint not in loose
    ]
    bones += [(joint, rest[joint], rest[joint] + tip) for joint, tip in rig.tips]
    bones = [bone for bone in bones if np.linalg.norm(bone[2] - bone[1]) > 1e-6]
    if not bones:  # a lone joint
        bones = [(0, rest[0], rest[0] + np.array([0.0, 0.1, 0.0]))]
    corners = np.concatenate([_octahedron(start, end)[_FACES] for _, start, end in bones])
    normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    normals /= np.linalg.norm(normals, axis=-1, keepdims=True)
    owners = np.repeat([owner for owner, _, _ in bones], 3 * len(_FACES))
    count = len(owners)
    sides = np.array([float(bool(_LEFT.search(n))) - bool(_RIGHT.search(n)) for n in rig.names])
    joints = np.zeros((count, 4), np.uint8 if len(rig.names) <= 256 else np.uint16)
    joints[:, 0] = owners
    return Mannequin(
        corners.reshape(-1, 3).astype(np.float32),
        np.repeat(normals, 3, 0).astype(np.float32),
        np.arange(count, dtype=np.int32).reshape(-1, 3),
        joints,
        np.tile(np.array([1, 0, 0, 0], np.float32), (count, 1)),
        sides[owners].astype(np.float32),
        rest.astype(np.float32),
    )


def _octahedron(start: np.ndarray, end: np.ndarray) -> np.ndarray:
    """Its six corners [6,3]: the start, four around the waist, the end."""
    along = end - start
    length = np.linalg.norm(along)
    across = np.cross(along, np.eye(3)[np.abs(along).argmin()])
    across *= WIDTH * length / np.linalg.norm(across)
    other = np.cross(along / length, across)
    waist = start + WAIST * along
    ring = [waist + across, waist + other, waist - across, waist - other]
    return np.array([start, *ring, end])


def write_glb_character(skeleton: GlbSkeleton, clip: RigClip, path: str | Path) -> Path:
    """Write the character's file again, mesh and all, with the clip as its only animation.

    Args:
        skeleton: of `readers.glb.read_glb_skeleton`.
        clip: a motion of `skeleton.rig`.
        path: the file; may not be the character's own.

    Raises:
        UserError: the file cannot be written.
    """
    document = dict(skeleton.file.document)
    for name in ("accessors", "bufferViews", "nodes"):
        document[name] = list(document.get(name, []))
    for node in skeleton.nodes:  # an animated one may have no matrix
        document["nodes"][node] = without_matrix(document["nodes"][node])
    file = GlbFile(document, bytes(skeleton.file.data))
    keys = animation(
        rescaled(clip, 1.0),
        file,
        skeleton.nodes,
        skeleton.rig.frames,
        base=skeleton.base,
        scales=skeleton.scales,
    )
    document["animations"] = [keys | {"name": clip.text or "motion"}]
    return file.write(Path(path))


def write_trajectory_glb(trajectory: MotionTrajectory, path: str | Path, title: str = "") -> Path:
    """Write one trajectory as an animated GLB; raises UserError where it cannot be written."""
    return write_glb(proxy_body(trajectory, title), path)
