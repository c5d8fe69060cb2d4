"""What moves in a GLB file: keys of one animation, sampled at even times.

Legend: T frames, S keys.
"""

from typing import Any

import numpy as np

from .glb_file import GlbError, GlbFile
from .limits import FRAME_RATES, MAX_FRAMES, MAX_VALUES
from .rig import quaternions_to_matrices

DEFAULT_FPS = 30.0
EVEN = 1e-3  # of a frame: keys that are no further from even times are taken as frames
Track = tuple[np.ndarray, np.ndarray, str]


def read_tracks(file: GlbFile, wanted: set[int]) -> dict[tuple[int, str], Track]:
    """Key times [S], values and interpolation of each (node, path) of the first animation."""
    animations = file.document.get("animations") or [{"channels": []}]
    tracks: dict[tuple[int, str], Track] = {}
    for channel in animations[0]["channels"]:
        target = channel["target"]
        node, path = target.get("node"), target["path"]
        if node not in wanted or path not in ("translation", "rotation", "scale"):
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
    animated = [path for path in ("translation", "rotation", "scale") if (index, path) in tracks]
    if not animated:
        return rest_matrix(node)[None]
    if "matrix" in node:
        raise GlbError(f"animates node {index}, whose pose is a matrix")
    rest = {"translation": (0, 0, 0), "rotation": (0, 0, 0, 1), "scale": (1, 1, 1)}
    values = [
        _sampled(*tracks[index, path], times, turning=path == "rotation")
        if path in animated
        else np.array([node.get(path, rest[path])], dtype=np.float64)
        for path in rest
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
        matrix = _compose(
            np.array([node.get("translation", (0, 0, 0))], dtype=np.float64),
            np.array([node.get("rotation", (0, 0, 0, 1))], dtype=np.float64),
            np.array([node.get("scale", (1, 1, 1))], dtype=np.float64),
        )[0]
    if not np.isfinite(matrix).all():
        raise GlbError(f"node {node.get('name')!r} is at an impossible place")
    return matrix


def _compose(translation: np.ndarray, rotation: np.ndarray, scale: np.ndarray) -> np.ndarray:
    """Matrices [T,4,4] of translations [T,3], quaternions x y z w [T,4] and scales [T,3]."""
    matrices = np.tile(np.eye(4), (max(map(len, (translation, rotation, scale))), 1, 1))
    if np.linalg.norm(rotation, axis=-1).min() < 1e-6:
        raise GlbError("holds a quaternion of zeros, which is no rotation")
    turn = quaternions_to_matrices(rotation[:, [3, 0, 1, 2]])
    matrices[:, :3, :3] = turn * scale[:, None, :]
    matrices[:, :3, 3] = translation
    return matrices
