"""GLB files as tests read them: by the standard, without any library."""

import json
import struct
from pathlib import Path
from typing import Any

import numpy as np
from scipy.spatial.transform import Rotation

WIDTHS = {"SCALAR": 1, "VEC2": 2, "VEC3": 3, "VEC4": 4, "MAT4": 16}
TYPES = {5121: np.uint8, 5123: np.uint16, 5125: np.uint32, 5126: np.float32}


class Glb:
    """The file as the standard says it is to be read, without any library."""

    def __init__(self, path: Path) -> None:
        data = path.read_bytes()
        magic, version, length = struct.unpack_from("<4sII", data)
        assert (magic, version, length) == (b"glTF", 2, len(data))
        size, kind = struct.unpack_from("<I4s", data, 12)
        assert kind == b"JSON"
        assert size % 4 == 0
        self.json: dict[str, Any] = json.loads(data[20 : 20 + size])
        size_2, kind_2 = struct.unpack_from("<I4s", data, 20 + size)
        assert kind_2 == b"BIN\0"
        self.binary = data[28 + size :]
        assert len(self.binary) == size_2 == -(-self.json["buffers"][0]["byteLength"] // 4) * 4

    def read(self, index: int) -> np.ndarray:
        accessor = self.json["accessors"][index]
        view = self.json["bufferViews"][accessor["bufferView"]]
        assert view["byteOffset"] % 4 == 0
        shape = (accessor["count"], WIDTHS[accessor["type"]])
        values = np.frombuffer(
            self.binary, TYPES[accessor["componentType"]], shape[0] * shape[1], view["byteOffset"]
        ).reshape(shape)
        if "min" in accessor:
            assert accessor["min"] == values.min(0).tolist()
            assert accessor["max"] == values.max(0).tolist()
        if accessor.get("normalized"):
            return values.astype(np.float64) / np.iinfo(values.dtype).max
        return values

    def world(self, frame: int) -> tuple[np.ndarray, np.ndarray]:
        """Positions [N,3] and rotations [N,3,3] of all nodes at one key frame."""
        nodes = [dict(node) for node in self.json["nodes"]]
        animation = self.json["animations"][0]
        for channel in animation["channels"]:
            output = self.read(animation["samplers"][channel["sampler"]]["output"])
            target = channel["target"]
            nodes[target["node"]][target["path"]] = output[min(frame, len(output) - 1)]
        positions = np.zeros((len(nodes), 3))
        rotations = np.tile(np.eye(3), (len(nodes), 1, 1))

        def visit(index: int, origin: np.ndarray, turn: np.ndarray) -> None:
            node = nodes[index]
            positions[index] = origin + turn @ np.array(node.get("translation", [0, 0, 0]))
            own = Rotation.from_quat(node.get("rotation", [0, 0, 0, 1])).as_matrix()
            rotations[index] = turn @ own
            for child in node.get("children", []):
                visit(child, positions[index], rotations[index])

        for root in self.json["scenes"][self.json["scene"]]["nodes"]:
            visit(root, np.zeros(3), np.eye(3))
        return positions, rotations
