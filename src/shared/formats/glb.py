"""GLB files out: the skinned mannequin and one animation, as glTF 2.0 binary.

One file, no references: nodes 0 to 21 are the joints in SMPL order, node 22 is the mesh. Metres,
+Y up, facing +Z, as glTF wants it. Each joint has a rotation channel, the pelvis a translation
channel too; the prompt is the animation's name. Left limbs are warm, right limbs cool, through a
tiny texture, which every viewer shows.
"""

import json
import struct
import zlib
from pathlib import Path
from typing import Any

import numpy as np

from src.shared.files import atomic_write
from src.shared.formats.mannequin import Mannequin, mannequin
from src.shared.motion.motion import Motion
from src.shared.motion.skeleton import JOINT_NAMES, NUM_JOINTS, PARENTS

# sRGB of the right limbs, the trunk and the left limbs.
TINTS = ((118, 150, 196), (190, 194, 202), (214, 158, 120))
_FLOAT, _BYTE, _SHORT = 5126, 5121, 5123  # glTF component types
_VERTICES, _INDICES = 34962, 34963  # glTF buffer view targets
_TYPES = {1: "SCALAR", 2: "VEC2", 3: "VEC3", 4: "VEC4", 16: "MAT4"}


class _Buffer:
    """The binary chunk while it grows, with its views and accessors."""

    def __init__(self) -> None:
        self.data = bytearray()
        self.views: list[dict[str, Any]] = []
        self.accessors: list[dict[str, Any]] = []

    def view(self, content: bytes, target: int | None = None) -> int:
        """Append bytes at a multiple of four; returns the view's index."""
        self.data += b"\0" * (-len(self.data) % 4)
        view = {"buffer": 0, "byteOffset": len(self.data), "byteLength": len(content)}
        self.views.append(view | ({"target": target} if target else {}))
        self.data += content
        return len(self.views) - 1

    def accessor(
        self,
        array: np.ndarray,
        kind: int,
        *,
        target: int | None = None,
        bounds: bool = False,
        normalized: bool = False,
    ) -> int:
        """Append an array [N] or [N,width]; returns the accessor's index."""
        dtype = {_FLOAT: "<f4", _BYTE: "u1", _SHORT: "<u2"}[kind]
        flat = np.ascontiguousarray(array, dtype=dtype).reshape(len(array), -1)
        entry: dict[str, Any] = {
            "bufferView": self.view(flat.tobytes(), target),
            "componentType": kind,
            "count": len(flat),
            "type": _TYPES[flat.shape[1]],
        }
        if bounds:
            entry |= {"min": flat.min(0).tolist(), "max": flat.max(0).tolist()}
        if normalized:
            entry["normalized"] = True
        self.accessors.append(entry)
        return len(self.accessors) - 1


def write_glb(motion: Motion, path: str | Path) -> Path:
    """Write one motion as an animated, skinned character.

    Raises:
        UserError: the file cannot be written.
    """
    body, buffer = mannequin(), _Buffer()
    document = {
        "asset": {"version": "2.0", "generator": "motionsuite"},
        "scene": 0,
        "scenes": [{"name": "motion", "nodes": [0, NUM_JOINTS]}],
        "nodes": [*_joint_nodes(body), {"name": "mannequin", "mesh": 0, "skin": 0}],
        "meshes": [_mesh(body, buffer)],
        "skins": [_skin(body, buffer)],
        "animations": [_animation(motion, buffer)],
        **_material(buffer),
    }
    document |= {
        "accessors": buffer.accessors,
        "bufferViews": buffer.views,
        "buffers": [{"byteLength": len(buffer.data)}],
    }
    with atomic_write(Path(path)) as temporary:
        temporary.write_bytes(_pack(document, bytes(buffer.data)))
    return Path(path)


def _joint_nodes(body: Mannequin) -> list[dict[str, Any]]:
    """The skeleton in its rest pose."""
    nodes: list[dict[str, Any]] = []
    for joint, (name, parent) in enumerate(zip(JOINT_NAMES, PARENTS, strict=True)):
        offset = body.rest[joint] - (body.rest[parent] if parent >= 0 else 0.0)
        node: dict[str, Any] = {"name": name, "translation": [round(float(v), 6) for v in offset]}
        children = [child for child, above in enumerate(PARENTS) if above == joint]
        nodes.append(node | ({"children": children} if children else {}))
    return nodes


def _mesh(body: Mannequin, buffer: _Buffer) -> dict[str, Any]:
    """The surface with its skin weights; U runs from right (0) to left (1)."""
    shares = np.floor(body.weights * 255).astype(np.int64)
    shares[:, 0] += 255 - shares.sum(-1)  # bytes must add up to one exactly
    uv = np.stack((0.5 + 0.5 * body.side, np.full(len(body.side), 0.5)), -1)
    attributes = {
        "POSITION": buffer.accessor(body.vertices, _FLOAT, target=_VERTICES, bounds=True),
        "NORMAL": buffer.accessor(body.normals, _FLOAT, target=_VERTICES),
        "TEXCOORD_0": buffer.accessor(uv, _FLOAT, target=_VERTICES),
        "JOINTS_0": buffer.accessor(np.where(shares > 0, body.joints, 0), _BYTE, target=_VERTICES),
        "WEIGHTS_0": buffer.accessor(shares, _BYTE, target=_VERTICES, normalized=True),
    }
    indices = buffer.accessor(body.triangles.reshape(-1), _SHORT, target=_INDICES)
    primitive = {"attributes": attributes, "indices": indices, "material": 0}
    return {"name": "mannequin", "primitives": [primitive]}


def _skin(body: Mannequin, buffer: _Buffer) -> dict[str, Any]:
    inverse = np.tile(np.eye(4, dtype=np.float32), (NUM_JOINTS, 1, 1))
    inverse[:, 3, :3] = -body.rest  # column-major: the translation is the last row in memory
    matrices = buffer.accessor(inverse.reshape(NUM_JOINTS, 16), _FLOAT)
    joints = list(range(NUM_JOINTS))
    return {"joints": joints, "skeleton": 0, "inverseBindMatrices": matrices}


def _animation(motion: Motion, buffer: _Buffer) -> dict[str, Any]:
    """A rotation channel for each joint and a translation channel for the pelvis."""
    times = buffer.accessor(np.arange(motion.num_frames) / motion.fps, _FLOAT, bounds=True)
    turns = motion.quaternions.astype(np.float64)
    turns = turns / np.linalg.norm(turns, axis=-1, keepdims=True)
    flips = np.where((turns[1:] * turns[:-1]).sum(-1) < 0, -1.0, 1.0)
    turns[1:] *= np.cumprod(flips, axis=0)[..., None]  # neighbours on the same half of the sphere
    tracks = [("translation", 0, buffer.accessor(motion.root_position, _FLOAT))]
    tracks += [
        ("rotation", joint, buffer.accessor(turns[:, joint, [1, 2, 3, 0]], _FLOAT))
        for joint in range(NUM_JOINTS)
    ]
    return {
        "name": motion.text or "motion",
        "samplers": [
            {"input": times, "output": output, "interpolation": "LINEAR"} for _, _, output in tracks
        ],
        "channels": [
            {"sampler": index, "target": {"node": node, "path": path}}
            for index, (path, node, _) in enumerate(tracks)
        ],
    }


def _material(buffer: _Buffer) -> dict[str, Any]:
    """One matte material whose colour comes from a strip of three tints."""
    image = buffer.view(_png_strip())
    surface = {"baseColorTexture": {"index": 0}, "metallicFactor": 0.0, "roughnessFactor": 0.65}
    return {
        "materials": [{"name": "skin", "pbrMetallicRoughness": surface}],
        "textures": [{"source": 0, "sampler": 0}],
        "samplers": [{"magFilter": 9729, "minFilter": 9729, "wrapS": 33071, "wrapT": 33071}],
        "images": [{"name": "tints", "mimeType": "image/png", "bufferView": image}],
    }


def _png_strip(width: int = 32) -> bytes:
    """An RGB PNG [1,width] that fades between the three tints."""
    at = np.linspace(0.0, 2.0, width)
    pixels = np.stack([np.interp(at, range(3), tint) for tint in zip(*TINTS, strict=True)], -1)
    row = b"\0" + pixels.round().astype(np.uint8).tobytes()

    def chunk(kind: bytes, content: bytes) -> bytes:
        body = kind + content
        return struct.pack(">I", len(content)) + body + struct.pack(">I", zlib.crc32(body))

    header = struct.pack(">IIBBBBB", width, 1, 8, 2, 0, 0, 0)
    return (b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", header)
            + chunk(b"IDAT", zlib.compress(row)) + chunk(b"IEND", b""))  # fmt: skip


def _pack(document: dict[str, Any], binary: bytes) -> bytes:
    """The GLB container: header, JSON chunk, binary chunk, all in multiples of four bytes."""
    text = json.dumps(document, ensure_ascii=False, separators=(",", ":")).encode()
    text += b" " * (-len(text) % 4)
    binary += b"\0" * (-len(binary) % 4)
    chunks = struct.pack("<I4s", len(text), b"JSON") + text
    chunks += struct.pack("<I4s", len(binary), b"BIN\0") + binary
    return struct.pack("<4sII", b"glTF", 2, 12 + len(chunks)) + chunks
