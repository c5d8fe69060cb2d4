"""GLB files in: the skeleton of a character and, where there is one, its first animation.

Joints are the bones that a VRM avatar or animation names, else the nodes of the largest skin, or
all nodes of a file without skins; nodes between them count as joints too. The default pose of the
nodes is the rest pose. Legend: T frames, S keys, N joints, M nodes that matter (joints and
everything above them)."""

import json
import struct
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from ...errors import UserError, printable
from ...io.arrays import MAX_VALUES
from ...io.files import atomic_write
from ..limits import FRAME_RATES, MAX_FRAMES, MAX_JOINTS, MAX_VALUE, read_bytes
from ..rig import Rig, RigClip, matrices_to_quaternions, quaternions_to_matrices

MAX_JSON = 32 << 20
VERTEX_DATA, INDEX_DATA = 34962, 34963  # bufferView.target
_WIDTHS = {"SCALAR": 1, "VEC2": 2, "VEC3": 3, "VEC4": 4, "MAT4": 16}
_TYPES = {width: name for name, width in _WIDTHS.items()}
_COMPONENTS = {
    5120: "int8", 5121: "uint8", 5122: "int16", 5123: "uint16", 5125: "uint32", 5126: "float32",
}  # fmt: skip
_NUMBERS = {name: number for number, name in _COMPONENTS.items()}


class GlbError(Exception):
    """A fault of a GLB file; the reader names the file."""


class GlbFile:
    """The document of a GLB file and its binary chunk, which may grow.

    Args:
        document: the JSON chunk.
        data: the binary chunk.
    """

    def __init__(self, document: dict[str, Any] | None = None, data: bytes = b"") -> None:
        self.document: dict[str, Any] = {} if document is None else document
        self.data = bytearray(data)

    @classmethod
    def read(cls, path: Path) -> "GlbFile":
        """Open a file; raises UserError where it is missing, too large or no GLB file."""
        data = read_bytes(path)
        if data[:4] != b"glTF":
            raise UserError(f"{path}: is not a GLB file; export it as glTF binary (.glb)")
        try:
            version, chunks = struct.unpack_from("<I", data, 4)[0], _chunks(data)
            document = json.loads(chunks[b"JSON"])
        except (ValueError, RecursionError, KeyError, struct.error) as error:
            raise UserError(f"{path}: is not a whole GLB file ({error}); export it again") from None
        if version != 2 or not isinstance(document, dict):
            raise UserError(f"{path}: is glTF version {version}; export it as glTF 2.0")
        return cls(document, chunks.get(b"BIN\0", b""))

    def write(self, path: Path) -> Path:
        """Write the file whole or not at all; raises UserError where it cannot be written."""
        data = self.to_bytes()
        with atomic_write(path) as temporary:
            temporary.write_bytes(data)
        return path

    def to_bytes(self) -> bytes:
        """The whole file."""
        buffers = [{"byteLength": len(self.data)}, *self.document.get("buffers", [])[1:]]
        document = self.document | {"buffers": buffers}
        text = json.dumps(document, allow_nan=False, separators=(",", ":")).encode()
        chunks = _chunk(b"JSON", text, b" ") + _chunk(b"BIN\0", bytes(self.data), b"\0")
        return struct.pack("<4sII", b"glTF", 2, 12 + len(chunks)) + chunks

    def view(self, data: bytes, target: int | None = None) -> int:
        """Add bytes at the next multiple of 4; the index of their view."""
        self.data += bytes(-len(self.data) % 4)
        view = {"buffer": 0, "byteOffset": len(self.data), "byteLength": len(data)}
        views = self.document.setdefault("bufferViews", [])
        views.append(view | ({"target": target} if target else {}))
        self.data += data
        return len(views) - 1

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
            "componentType": _NUMBERS[values.dtype.name],
            "count": len(values),
            "type": _TYPES[rows.shape[1]],
        }
        if normalized:
            accessor["normalized"] = True
        if bounds:
            accessor |= {"min": rows.min(0).tolist(), "max": rows.max(0).tolist()}
        accessors = self.document.setdefault("accessors", [])
        accessors.append(accessor)
        return len(accessors) - 1

    def array(self, index: int) -> np.ndarray:
        """The values [N,width] of an accessor as float64.

        Raises:
            GlbError: sparse or compressed data, data in another file, or data that is not there.
        """
        accessor = self.document["accessors"][index]
        if "sparse" in accessor or "bufferView" not in accessor:
            raise GlbError("has sparse or compressed accessors; export without compression")
        view = self.document["bufferViews"][accessor["bufferView"]]
        if view.get("buffer", 0) != 0 or "uri" in self.document["buffers"][0]:
            raise GlbError("keeps its data in other files; export it as one .glb")
        kind = np.dtype(_COMPONENTS[accessor["componentType"]]).newbyteorder("<")
        width, count = _WIDTHS[accessor["type"]], int(accessor["count"])
        stride = int(view.get("byteStride") or width * kind.itemsize)
        start = int(view.get("byteOffset", 0)) + int(accessor.get("byteOffset", 0))
        end = start + (count - 1) * stride + width * kind.itemsize
        if count < 1 or start < 0 or stride < width * kind.itemsize or end > len(self.data):
            raise GlbError(f"accessor {index} lies outside the data; the file is cut off")
        stored = np.ndarray(
            (count, width), kind, bytes(self.data[start:end]), strides=(stride, kind.itemsize)
        )
        with np.errstate(invalid="ignore"):  # signalling NaN; refused below
            values = stored.astype(np.float64)
        if accessor.get("normalized"):  # section 3.11: integers stand for -1 … 1
            values = np.maximum(values / np.iinfo(kind).max, -1.0)
        if not np.isfinite(values).all():
            raise GlbError(f"accessor {index} holds NaN or infinite values")
        return values


def _chunks(data: bytes) -> dict[bytes, bytes]:
    """The first chunk of each kind."""
    found: dict[bytes, bytes] = {}
    at = 12
    while at + 8 <= len(data):
        size, kind = struct.unpack_from("<I4s", data, at)
        if at + 8 + size > len(data):
            raise ValueError(f"a chunk of {size} bytes is cut off")
        if kind == b"JSON" and size > MAX_JSON:
            raise ValueError(f"its JSON has {size >> 20} MB, over the limit of {MAX_JSON >> 20} MB")
        found.setdefault(kind, data[at + 8 : at + 8 + size])
        at += 8 + size
    return found


def _chunk(kind: bytes, data: bytes, padding: bytes) -> bytes:
    data += padding * (-len(data) % 4)
    return struct.pack("<I4s", len(data), kind) + data


DEFAULT_FPS = 30.0
EVEN = 1e-3  # of a frame: keys that are no further from even times are taken as frames
# What a channel may animate, and the value where a node says nothing.
PATHS = {"translation": (0, 0, 0), "rotation": (0, 0, 0, 1), "scale": (1, 1, 1)}
Track = tuple[np.ndarray, np.ndarray, str]


def read_tracks(file: GlbFile, wanted: set[int]) -> dict[tuple[int, str], Track]:
    """Key times [S], values and interpolation of each (node, path) of the first animation."""
    animations = file.document.get("animations") or [{"channels": []}]
    tracks: dict[tuple[int, str], Track] = {}
    for channel in animations[0]["channels"]:
        target = channel["target"]
        node, path = target.get("node"), target["path"]
        if node not in wanted or path not in PATHS:
            continue
        sampler = animations[0]["samplers"][channel["sampler"]]
        keys, values = file.array(sampler["input"])[:, 0], file.array(sampler["output"])
        kind = str(sampler.get("interpolation", "LINEAR"))
        width, each = (4 if path == "rotation" else 3), (3 if kind == "CUBICSPLINE" else 1)
        if values.shape != (each * len(keys), width) or (np.diff(keys) <= 0).any():
            raise GlbError(f"animates the {path} of node {node} with keys that do not fit")
        tracks[node, path] = (keys, values, kind)
    return tracks


def even_times(keys: list[np.ndarray], num_nodes: int) -> tuple[np.ndarray, float]:
    """Evenly spaced times [T] in seconds over all keys, and their rate."""
    densest = max(keys, key=len, default=np.zeros(1))
    if len(densest) < 2:
        return densest[:1], DEFAULT_FPS
    start, end = min(k[0] for k in keys), max(k[-1] for k in keys)
    fps = float(1.0 / np.median(np.diff(densest)))
    even = np.linspace(start, end, len(densest))
    exact = bool(np.abs(densest - even).max() < EVEN * (even[1] - even[0]))
    if exact:  # times are float32: their mean step is the better measure
        fps = (len(densest) - 1) / float(end - start)
    fps = round(fps, 2) if abs(fps - round(fps, 2)) < 1e-4 else fps
    count = round((end - start) * fps) + 1 if FRAME_RATES[0] <= fps <= FRAME_RATES[1] else 0
    if not 0 < count <= MAX_FRAMES or count * num_nodes > MAX_VALUES // 16:
        raise GlbError(f"animates {end - start:g} s at {fps:g} frames a second, which is too much")
    return densest if exact else start + np.arange(count) / fps, fps


def moved_matrices(
    node: dict[str, Any], index: int, tracks: dict[tuple[int, str], Track], times: np.ndarray
) -> np.ndarray:
    """Local matrices [T,4,4], or [1,4,4] of a node that stays."""
    animated = [path for path in PATHS if (index, path) in tracks]
    if not animated:
        return rest_matrix(node)[None]
    if "matrix" in node:
        raise GlbError(f"animates node {index}, whose pose is a matrix")
    values = [
        _sampled(*tracks[index, path], times, turning=path == "rotation")
        if path in animated
        else np.array([node.get(path, still)], dtype=np.float64)
        for path, still in PATHS.items()
    ]
    return _compose(*values)


def _sampled(
    keys: np.ndarray, values: np.ndarray, kind: str, times: np.ndarray, *, turning: bool
) -> np.ndarray:
    """Values [T,width] between keys (glTF 2.0, appendix C)."""
    after = np.clip(np.searchsorted(keys, times, "right"), 1, max(1, len(keys) - 1))
    before = after - 1
    after = np.minimum(after, len(keys) - 1)
    width = np.where(after > before, keys[after] - keys[before], 1.0)
    part = np.clip((times - keys[before]) / width, 0.0, 1.0)[:, None]
    if kind == "CUBICSPLINE":
        t, triples = part, values.reshape(len(keys), 3, -1)
        first, last = triples[before], triples[after]
        leave, arrive = first[:, 2] * width[:, None], last[:, 0] * width[:, None]
        return np.asarray(
            (2 * t**3 - 3 * t**2 + 1) * first[:, 1] + (t**3 - 2 * t**2 + t) * leave
            + (3 * t**2 - 2 * t**3) * last[:, 1] + (t**3 - t**2) * arrive
        )  # fmt: skip
    first, last = values[before], values[after]
    if kind == "STEP":
        return np.where(part >= 1.0, last, first)
    if not turning:
        return np.asarray(first + part * (last - first))
    return _slerp(first, last, part)


def _slerp(first: np.ndarray, last: np.ndarray, part: np.ndarray) -> np.ndarray:
    """Between quaternions [T,4] of any component order, on the short way (Shoemake 1985)."""
    first = first / np.maximum(np.linalg.norm(first, axis=-1, keepdims=True), 1e-12)
    last = last / np.maximum(np.linalg.norm(last, axis=-1, keepdims=True), 1e-12)
    cosine = (first * last).sum(-1, keepdims=True)
    last, cosine = np.where(cosine < 0, -last, last), np.abs(cosine).clip(0.0, 1.0)
    angle = np.arccos(cosine)
    sine = np.sin(angle)
    near = sine < 1e-6
    safe = np.where(near, 1.0, sine)
    a = np.where(near, 1 - part, np.sin((1 - part) * angle) / safe)
    b = np.where(near, part, np.sin(part * angle) / safe)
    return np.asarray(a * first + b * last)


def rest_matrix(node: dict[str, Any]) -> np.ndarray:
    """The local matrix [4,4] of a node's default pose."""
    if "matrix" in node:
        matrix = np.array(node["matrix"], dtype=np.float64).reshape(4, 4).T
    else:
        values = [np.array([node.get(p, still)], dtype=np.float64) for p, still in PATHS.items()]
        matrix = _compose(*values)[0]
    if not np.isfinite(matrix).all():
        raise GlbError(f"node {node.get('name')!r} is at an impossible place")
    return matrix


def without_matrix(node: dict[str, Any]) -> dict[str, Any]:
    """The same node, its pose as translation, rotation and scale."""
    if "matrix" not in node:
        return node
    matrix = rest_matrix(node)
    (turn,), (size,) = _split(matrix[None, :3, :3])
    pose = {
        "translation": matrix[:3, 3].tolist(),
        "rotation": matrices_to_quaternions(turn)[[1, 2, 3, 0]].tolist(),
        "scale": [float(size)] * 3,
    }
    return {name: value for name, value in node.items() if name != "matrix"} | pose


def _compose(translation: np.ndarray, rotation: np.ndarray, scale: np.ndarray) -> np.ndarray:
    """Matrices [T,4,4] of translations [T,3], quaternions x y z w [T,4] and scales [T,3]."""
    matrices = np.tile(np.eye(4), (max(map(len, (translation, rotation, scale))), 1, 1))
    if np.linalg.norm(rotation, axis=-1).min() < 1e-6:
        raise GlbError("holds a quaternion of zeros, which is no rotation")
    turn = quaternions_to_matrices(rotation[:, [3, 0, 1, 2]])
    matrices[:, :3, :3] = turn * scale[:, None, :]
    matrices[:, :3, 3] = translation
    return matrices


UNEVEN = 0.02  # relative difference of a node's three scales that no skeleton needs


@dataclass(frozen=True, eq=False)
class GlbSkeleton:
    """A character's skeleton and where its joints lie in the file.

    Attributes:
        rig: the joints, in metres.
        nodes: node of each joint.
        base: matrix [4,4] of everything above the root.
        scales: size in the world of a length in each joint's parent [N].
    """

    file: GlbFile
    rig: Rig
    nodes: list[int]
    base: np.ndarray
    scales: np.ndarray

    @property
    def is_avatar(self) -> bool:
        """Whether the file is a VRM avatar, of 0.x or 1.0."""
        return not {"VRMC_vrm", "VRM"}.isdisjoint(self.file.document.get("extensions", {}))


def read_glb_skeleton(path: str | Path) -> GlbSkeleton:
    """The skeleton of a GLB file, at rest.

    Raises:
        UserError: missing, damaged, without joints, or with joints scaled unevenly.
    """
    with _opened(Path(path)) as file:
        return _skeleton(file)


def read_glb(path: str | Path) -> RigClip:
    """The first animation of a GLB file, at the rate of its densest keys; else the rest pose.
    Raises UserError as `read_glb_skeleton`, or for an animation of impossible length."""
    with _opened(Path(path)) as file:
        return _clip(_skeleton(file))


@contextmanager
def _opened(path: Path) -> Iterator[GlbFile]:
    """The file; its faults become one sentence that names it."""
    file = GlbFile.read(path)
    try:
        yield file
    except GlbError as error:
        raise UserError(f"{path}: {error}") from None
    except (LookupError, TypeError, ValueError, AttributeError, OverflowError, struct.error,
            np.linalg.LinAlgError) as error:  # fmt: skip
        # What a document with a missing, wrong or foreign entry leads to.
        raise UserError(
            f"{path}: does not hold what glTF 2.0 asks for ({error!r}); export it again"
        ) from None


def _skeleton(file: GlbFile) -> GlbSkeleton:
    nodes: list[dict[str, Any]] = file.document.get("nodes", [])
    parents, bones = _parents(nodes), _bones(file.document)
    joints = _joints(file.document, nodes, parents, list(bones))
    index = {node: joint for joint, node in enumerate(joints)}
    poses = {node: rest_matrix(nodes[node]) for node in _with_ancestors(joints, parents)}
    world: dict[int, np.ndarray] = {}
    for node in _with_ancestors(joints, parents):  # parents first
        world[node] = (world[parents[node]] if parents[node] >= 0 else np.eye(4)) @ poses[node]
    places = np.array([world[node] for node in joints])
    frames, sizes = _split(places[:, :3, :3])
    above = [index.get(parents[node], -1) for node in joints]
    offsets = np.array([
        places[j, :3, 3] - (places[p, :3, 3] if p >= 0 else 0.0) for j, p in enumerate(above)
    ])  # fmt: skip
    if not np.abs(offsets).max() < MAX_VALUE:
        raise GlbError("has joints at impossible places")
    root = parents[joints[0]]
    base = world[root] if root >= 0 else np.eye(4)
    base_size = _split(base[None, :3, :3])[1]
    names = _names(nodes, joints, bones)
    leaves = sorted(set(range(len(joints))) - set(above))
    tips = tuple((j, tuple((0.5 * offsets[j]).tolist())) for j in leaves if above[j] >= 0)
    rig = Rig(names, tuple(above), offsets, tips, frames, ("ZXY",) * len(joints))
    scales = np.array([sizes[p] if p >= 0 else base_size[0] for p in above])
    return GlbSkeleton(file, rig, joints, base, scales)


def _parents(nodes: list[dict[str, Any]]) -> list[int]:
    """Parent of each node, -1 for none."""
    if len(nodes) > 100 * MAX_JOINTS:
        raise GlbError(f"has {len(nodes)} nodes; a character has far fewer")
    parents = [-1] * len(nodes)
    for node, entry in enumerate(nodes):
        for child in entry.get("children", []):
            if not 0 <= child < len(nodes) or parents[child] >= 0:
                raise GlbError(f"node {child} is missing or has two parents")
            parents[child] = node
    return parents


def _bones(document: dict[str, Any]) -> dict[int, str]:
    """What VRM calls nodes (avatars of 0.x and 1.0, animations); of other files nothing."""
    extensions = document.get("extensions", {})
    for name in ("VRMC_vrm", "VRMC_vrm_animation", "VRM"):
        if name in extensions:
            bones = extensions[name]["humanoid"]["humanBones"]
            rows = bones if name == "VRM" else [{"bone": key} | bones[key] for key in bones]
            return {row["node"]: row["bone"] for row in rows}
    return {}


def _joints(
    document: dict[str, Any], nodes: list[dict[str, Any]], parents: list[int], bones: list[int]
) -> list[int]:
    """Nodes of the skeleton, parents first, of which the first is the only root."""
    skins = document.get("skins", [])
    chosen = bones or max((skin["joints"] for skin in skins), key=len, default=[])
    if not chosen:
        chosen = [n for n, entry in enumerate(nodes) if not {"mesh", "camera"} & set(entry)]
    if not chosen:
        raise GlbError("holds no skeleton; export the armature as well")
    if len(chosen) > MAX_JOINTS or any(not 0 <= n < len(nodes) for n in chosen):
        raise GlbError(f"names {len(chosen)} joints, too many or not its own nodes")
    lines = {node: _line(node, parents) for node in chosen}
    tops: dict[int, list[int]] = {}
    for node in chosen:
        tops.setdefault(lines[node][0], []).append(node)
    tree = max(tops.values(), key=len)
    root = next(  # the lowest node above all
        node for node in reversed(lines[tree[0]]) if all(node in lines[other] for other in tree)
    )
    wanted = {node for joint in tree for node in lines[joint][lines[joint].index(root) :]}
    if len(wanted) > MAX_JOINTS:
        raise GlbError(f"has more than {MAX_JOINTS} joints")
    order, stack = [], [root]
    while stack:
        order.append(stack.pop())
        children = nodes[order[-1]].get("children", [])
        stack += [child for child in reversed(children) if child in wanted]
    return order


def _line(node: int, parents: list[int]) -> list[int]:
    """From the top of the tree down to a node."""
    line = [node]
    while parents[line[-1]] >= 0:
        line.append(parents[line[-1]])
        if len(line) > MAX_JOINTS:
            raise GlbError("has nodes that are their own ancestors or far too many levels")
    return line[::-1]


def _with_ancestors(joints: list[int], parents: list[int]) -> list[int]:
    """The nodes above the root, then the joints: parents first."""
    return [*_line(joints[0], parents)[:-1], *joints]


def _names(
    nodes: list[dict[str, Any]], joints: list[int], bones: dict[int, str]
) -> tuple[str, ...]:
    """Names on one line, printable; numbered where two joints share one."""
    names: list[str] = []
    for node in joints:
        given = str(bones.get(node, nodes[node].get("name", "")))
        name = printable(" ".join(given.split())) or f"node {node}"
        names.append(name if name not in names else f"{name} {node}")
    return tuple(names)


def _split(matrices: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Rotations [...,3,3] and even scales [...] of matrices [...,3,3]."""
    sizes = np.linalg.norm(matrices, axis=-2)
    size = sizes.mean(-1)
    if size.min() < 1e-9 or np.abs(sizes / size[..., None] - 1).max() > UNEVEN:
        raise GlbError("has joints that are scaled unevenly; apply all scales and export it again")
    rotations = matrices / sizes[..., None, :]
    product = rotations @ rotations.swapaxes(-1, -2)
    if np.abs(product - np.eye(3)).max() > UNEVEN or np.linalg.det(rotations).min() < 0:
        raise GlbError("has joints that are sheared or mirrored; apply all transforms first")
    return rotations, size


# ---------------------------------------------------------------- animation


def _clip(skeleton: GlbSkeleton) -> RigClip:
    """The first animation, sampled evenly."""
    document = skeleton.file.document
    nodes = document["nodes"]
    above = _parents(nodes)
    line = _with_ancestors(skeleton.nodes, above)
    tracks = read_tracks(skeleton.file, set(line))
    times, fps = even_times([keys for keys, _, _ in tracks.values()], len(line))
    world: dict[int, np.ndarray] = {}
    for node in line:
        local = moved_matrices(nodes[node], node, tracks, times)
        world[node] = world[above[node]] @ local if above[node] >= 0 else local
    places = np.stack([np.broadcast_to(world[n], (len(times), 4, 4)) for n in skeleton.nodes], 1)
    turns = _split(places[..., :3, :3])[0] @ skeleton.rig.frames.swapaxes(-1, -2)
    positions = places[..., :3, 3]
    rotations, translations = turns.copy(), positions.copy()
    for joint, parent in enumerate(skeleton.rig.parents):
        if parent >= 0:
            back = turns[:, parent].swapaxes(-1, -2)
            rotations[:, joint] = back @ turns[:, joint]
            step = positions[:, joint] - positions[:, parent]
            translations[:, joint] = (back @ step[..., None])[..., 0]
    if not np.abs(translations).max() < MAX_VALUE:
        raise GlbError("moves its joints to impossible places")
    scene = (document.get("scenes") or [{}])[document.get("scene", 0)]
    text = str((scene.get("extras") or {}).get("text", ""))
    return RigClip(skeleton.rig, rotations, translations, fps, text)
