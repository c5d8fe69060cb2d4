"""GLB files out: binary glTF 2.0 with an animated, skinned mannequin.

One scene: the 22 joints as nodes (pelvis first, rest pose as their default), a mesh with a skin,
and one animation with a rotation channel a joint and a translation channel for the pelvis.
glTF shares our conventions (metres, +Y up, right-handed, facing +Z), so nothing is turned.
Colours come from a tiny texture, because that is what every viewer and Blender show.
Legend: T frames, V vertices, F triangles.
"""

import io
import json
import struct
from pathlib import Path
from typing import Any

import numpy as np

from src.shared.files import atomic_write
from src.shared.formats.mannequin import Mannequin, mannequin, side_colours
from src.shared.motion.motion import Motion
from src.shared.motion.skeleton import NUM_JOINTS, canonical_skeleton

VERTEX_DATA, INDEX_DATA = 34962, 34963  # bufferView.target
_TYPES = {1: "SCALAR", 2: "VEC2", 3: "VEC3", 4: "VEC4", 16: "MAT4"}
_COMPONENTS = {"float32": 5126, "uint8": 5121, "uint16": 5123, "uint32": 5125}
PALETTE_SIZE = 32  # texels, right side to left side
MESH_NODE = NUM_JOINTS


def write_glb(motion: Motion, path: str | Path) -> Path:
    """Write one motion as an animated GLB; its joints move as `motion.positions()` does.

    Raises:
        UserError: the file cannot be written.
    """
    buffer = _Buffer()
    document = _document(motion, mannequin(), buffer)
    text = json.dumps(document, allow_nan=False, separators=(",", ":")).encode()
    chunks = _chunk(b"JSON", text, b" ") + _chunk(b"BIN\0", bytes(buffer.data), b"\0")
    with atomic_write(Path(path)) as temporary:
        temporary.write_bytes(struct.pack("<4sII", b"glTF", 2, 12 + len(chunks)) + chunks)
    return Path(path)


class _Buffer:
    """The binary chunk while it grows, with its views and accessors."""

    def __init__(self) -> None:
        self.data = bytearray()
        self.views: list[dict[str, Any]] = []
        self.accessors: list[dict[str, Any]] = []

    def view(self, data: bytes, target: int | None = None) -> int:
        """Add bytes at the next multiple of 4; the index of their view."""
        self.data += bytes(-len(self.data) % 4)
        view = {"buffer": 0, "byteOffset": len(self.data), "byteLength": len(data)}
        self.views.append(view | ({"target": target} if target else {}))
        self.data += data
        return len(self.views) - 1

    def accessor(
        self,
        values: np.ndarray,
        target: int | None = None,
        *,
        bounds: bool = False,
        normalized: bool = False,
    ) -> int:
        """Add an array [N] or [N,width]; the index of its accessor."""
        values = np.ascontiguousarray(values)
        rows = values.reshape(len(values), -1)
        little_endian = values.astype(values.dtype.newbyteorder("<"))
        accessor: dict[str, Any] = {
            "bufferView": self.view(little_endian.tobytes(), target),
            "componentType": _COMPONENTS[values.dtype.name],
            "count": len(values),
            "type": _TYPES[rows.shape[1]],
        }
        if normalized:
            accessor["normalized"] = True
        if bounds:
            accessor |= {"min": rows.min(0).tolist(), "max": rows.max(0).tolist()}
        self.accessors.append(accessor)
        return len(self.accessors) - 1


def _document(motion: Motion, body: Mannequin, buffer: _Buffer) -> dict[str, Any]:
    """The JSON chunk; fills `buffer` on the way."""
    name = motion.text or "motion"
    animation = _animation(motion, buffer) | {"name": name}
    document = {
        "asset": {"version": "2.0", "generator": "motion-tools"},
        "scene": 0,
        "scenes": [{"name": name, "nodes": [0, MESH_NODE], "extras": {"text": motion.text}}],
        "nodes": _nodes(body),
        "meshes": [_mesh(body, buffer)],
        "skins": [_skin(body, buffer)],
        "animations": [animation],
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
        "images": [
            {"name": "sides", "mimeType": "image/png", "bufferView": buffer.view(_palette())}
        ],
    }
    return document | {
        "accessors": buffer.accessors,
        "bufferViews": buffer.views,
        "buffers": [{"byteLength": len(buffer.data)}],
    }


def _nodes(body: Mannequin) -> list[dict[str, Any]]:
    """The joints in the rest pose, then the mesh."""
    skeleton = canonical_skeleton()
    nodes: list[dict[str, Any]] = []
    for joint, name in enumerate(skeleton.names):
        children = [child for child, above in enumerate(skeleton.parents) if above == joint]
        node = {"name": name, "translation": skeleton.offsets[joint].tolist()}
        nodes.append(node | ({"children": children} if children else {}))
    nodes[0]["translation"] = body.rest[0].tolist()
    return [*nodes, {"name": "mannequin", "mesh": 0, "skin": 0}]


def _mesh(body: Mannequin, buffer: _Buffer) -> dict[str, Any]:
    index_type = np.uint16 if len(body.vertices) < 65535 else np.uint32
    # The middle of the outer texels, so that the ends are never blended with anything.
    u = 0.5 + 0.5 * body.side * (1 - 1 / PALETTE_SIZE)
    attributes = {
        "POSITION": buffer.accessor(body.vertices, VERTEX_DATA, bounds=True),
        "NORMAL": buffer.accessor(body.normals, VERTEX_DATA),
        "TEXCOORD_0": buffer.accessor(
            np.stack((u, np.full_like(u, 0.5)), -1).astype(np.float32), VERTEX_DATA
        ),
        "JOINTS_0": buffer.accessor(body.joints, VERTEX_DATA),
        "WEIGHTS_0": buffer.accessor(
            whole_shares(body.weights, 65535).astype(np.uint16), VERTEX_DATA, normalized=True
        ),
    }
    indices = buffer.accessor(body.triangles.reshape(-1).astype(index_type), INDEX_DATA)
    return {
        "name": "mannequin",
        "primitives": [{"attributes": attributes, "indices": indices, "material": 0}],
    }


def whole_shares(weights: np.ndarray, total: int) -> np.ndarray:
    """Weights [V,4] (heaviest first, summing to 1) as integers that sum to `total` exactly."""
    shares = np.floor(weights.astype(np.float64) * total).astype(np.int64)
    shares[:, 0] += total - shares.sum(-1)
    return shares


def _skin(body: Mannequin, buffer: _Buffer) -> dict[str, Any]:
    """The rest pose has no rotations, so each inverse bind matrix is one translation."""
    inverse = np.tile(np.eye(4, dtype=np.float32), (NUM_JOINTS, 1, 1))
    inverse[:, :3, 3] = -body.rest
    columns = inverse.transpose(0, 2, 1).reshape(NUM_JOINTS, 16)  # glTF stores column by column
    return {
        "name": "mannequin",
        "skeleton": 0,
        "joints": list(range(NUM_JOINTS)),
        "inverseBindMatrices": buffer.accessor(columns),
    }


def _animation(motion: Motion, buffer: _Buffer) -> dict[str, Any]:
    """Rotations of all joints and the pelvis path, keyed at every frame.

    A joint that never turns has one key.
    """
    times = (np.arange(motion.num_frames) / motion.fps).astype(np.float32)
    quaternions = continuous(motion.quaternions)[..., [1, 2, 3, 0]].astype(np.float32)
    still = (quaternions == quaternions[:1]).all((0, 2)) & (motion.num_frames > 1)
    keys = buffer.accessor(times, bounds=True)
    single = buffer.accessor(times[:1], bounds=True) if still.any() else keys
    samplers = [{"input": keys, "output": buffer.accessor(motion.root_position.astype(np.float32))}]
    for joint in range(NUM_JOINTS):
        count = 1 if still[joint] else motion.num_frames
        output = buffer.accessor(quaternions[:count, joint])
        samplers.append({"input": single if still[joint] else keys, "output": output})
    targets = [{"node": 0, "path": "translation"}]
    targets += [{"node": joint, "path": "rotation"} for joint in range(NUM_JOINTS)]
    return {
        "samplers": [sampler | {"interpolation": "LINEAR"} for sampler in samplers],
        "channels": [{"sampler": i, "target": target} for i, target in enumerate(targets)],
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


def _chunk(kind: bytes, data: bytes, padding: bytes) -> bytes:
    data += padding * (-len(data) % 4)
    return struct.pack("<I4s", len(data), kind) + data
