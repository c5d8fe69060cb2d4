"""The container of GLB files: a JSON chunk and one of binary data, read and written.

Binary glTF 2.0, section 4 of the Khronos specification: a header, then chunks, little-endian.
"""

import json
import struct
from pathlib import Path
from typing import Any

import numpy as np

from ..errors import UserError
from ..io.files import atomic_write
from .limits import read_bytes

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
        """Open a file.

        Raises:
            UserError: missing, too large or not a GLB file.
        """
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
        """Write the file whole or not at all.

        Raises:
            UserError: the file cannot be written.
        """
        buffers = [{"byteLength": len(self.data)}, *self.document.get("buffers", [])[1:]]
        document = self.document | {"buffers": buffers}
        text = json.dumps(document, allow_nan=False, separators=(",", ":")).encode()
        chunks = _chunk(b"JSON", text, b" ") + _chunk(b"BIN\0", bytes(self.data), b"\0")
        with atomic_write(path) as temporary:
            temporary.write_bytes(struct.pack("<4sII", b"glTF", 2, 12 + len(chunks)) + chunks)
        return path

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
