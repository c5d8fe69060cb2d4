"""GLB: the container, the accessors, and the animated skin against our own kinematics."""

import json
import struct
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from src.shared.formats.glb import write_glb
from src.shared.formats.mannequin import mannequin
from src.shared.motion.motion import Motion

DTYPES = {5126: "<f4", 5121: "u1", 5123: "<u2"}
WIDTHS = {"SCALAR": 1, "VEC2": 2, "VEC3": 3, "VEC4": 4, "MAT4": 16}


def a_motion(frames: int = 7) -> Motion:
    rng = np.random.default_rng(5)
    quaternions = rng.normal(size=(frames, 22, 4))
    quaternions /= np.linalg.norm(quaternions, axis=-1, keepdims=True)
    root = rng.normal(size=(frames, 3)).astype(np.float32)
    return Motion(quaternions.astype(np.float32), root, np.zeros((frames, 2), np.float32), 30.0,
                  'say "hi" </script> 歩く')  # fmt: skip


def load(path: Path) -> tuple[dict[str, Any], bytes]:
    data = path.read_bytes()
    magic, version, length = struct.unpack_from("<4sII", data)
    assert (magic, version, length) == (b"glTF", 2, len(data))
    size, kind = struct.unpack_from("<I4s", data, 12)
    assert kind == b"JSON" and size % 4 == 0
    document = json.loads(data[20 : 20 + size])
    rest, kind = struct.unpack_from("<I4s", data, 20 + size)
    assert kind == b"BIN\0" and rest % 4 == 0 and 28 + size + rest == len(data)
    assert document["buffers"] == [{"byteLength": pytest.approx(rest, abs=3)}]
    return document, data[28 + size :]


def array(document: dict[str, Any], binary: bytes, index: int) -> np.ndarray:
    accessor = document["accessors"][index]
    view = document["bufferViews"][accessor["bufferView"]]
    dtype = np.dtype(DTYPES[accessor["componentType"]])
    count = accessor["count"] * WIDTHS[accessor["type"]]
    assert view["byteOffset"] % 4 == 0 and count * dtype.itemsize == view["byteLength"]
    return np.frombuffer(binary, dtype, count, view["byteOffset"]).reshape(accessor["count"], -1)


def node_worlds(document: dict[str, Any], binary: bytes, frame: int) -> np.ndarray:
    """World matrix of every joint node at a key frame [22,4,4], straight from the file."""
    nodes = [dict(node) for node in document["nodes"]]
    animation = document["animations"][0]
    for channel in animation["channels"]:
        sampler = animation["samplers"][channel["sampler"]]
        value = array(document, binary, sampler["output"])[frame]
        nodes[channel["target"]["node"]][channel["target"]["path"]] = value
    worlds = np.zeros((22, 4, 4))

    def visit(index: int, above: np.ndarray) -> None:
        local = np.eye(4)
        local[:3, :3] = Rotation.from_quat(nodes[index].get("rotation", (0, 0, 0, 1))).as_matrix()
        local[:3, 3] = nodes[index].get("translation", (0, 0, 0))
        worlds[index] = above @ local
        for child in nodes[index].get("children", ()):
            visit(child, worlds[index])

    visit(0, np.eye(4))
    return worlds


def test_skinned_vertices_follow_our_kinematics(tmp_path: Path) -> None:
    motion, body = a_motion(), mannequin()
    document, binary = load(write_glb(motion, tmp_path / "a.glb"))
    primitive = document["meshes"][0]["primitives"][0]
    read = {k: array(document, binary, i) for k, i in primitive["attributes"].items()}
    inverse = array(document, binary, document["skins"][0]["inverseBindMatrices"])
    inverse = inverse.reshape(22, 4, 4).transpose(0, 2, 1)
    for frame in (0, 3, 6):
        worlds = node_worlds(document, binary, frame)
        np.testing.assert_allclose(worlds[:, :3, 3], motion.positions()[frame], atol=1e-5)
        skin = (worlds @ inverse)[read["JOINTS_0"]]  # [V,4,4,4]
        blended = np.einsum("vk,vkij->vij", read["WEIGHTS_0"] / 65535.0, skin)
        points = np.concatenate((read["POSITION"], np.ones((len(read["POSITION"]), 1))), -1)
        moved = np.einsum("vij,vj->vi", blended, points)[:, :3]
        expected = body.pose(motion.positions()[frame], motion.global_rotations()[frame])[0]
        assert np.abs(moved - expected).max() < 1e-3  # weights are integers


def test_accessors_and_animation(tmp_path: Path) -> None:
    motion = a_motion()
    document, binary = load(write_glb(motion, tmp_path / "a.glb"))
    for index, accessor in enumerate(document["accessors"]):
        values = array(document, binary, index)
        assert np.isfinite(values.astype(float)).all()
        if "min" in accessor:
            assert accessor["min"] == values.min(0).tolist()
            assert accessor["max"] == values.max(0).tolist()
    primitive = document["meshes"][0]["primitives"][0]
    weights = array(document, binary, primitive["attributes"]["WEIGHTS_0"])
    assert (weights.astype(int).sum(-1) == 65535).all()
    joints = array(document, binary, primitive["attributes"]["JOINTS_0"])
    assert (joints[weights == 0] == 0).all()
    indices = array(document, binary, primitive["indices"])
    assert indices.max() == document["accessors"][primitive["attributes"]["POSITION"]]["count"] - 1
    animation = document["animations"][0]
    assert animation["name"] == motion.text
    assert len(animation["channels"]) == 23
    times = array(document, binary, animation["samplers"][0]["input"])[:, 0]
    np.testing.assert_allclose(times, np.arange(7) / 30)
    for sampler in animation["samplers"][1:]:
        turns = array(document, binary, sampler["output"])
        np.testing.assert_allclose(np.linalg.norm(turns, axis=-1), 1, atol=1e-6)
        assert ((turns[1:] * turns[:-1]).sum(-1) >= 0).all()  # the short way round


def test_one_frame_and_no_text(tmp_path: Path) -> None:
    motion = a_motion(1)
    document, _ = load(write_glb(Motion(motion.quaternions, motion.root_position, motion.contacts),
                                 tmp_path / "a.glb"))  # fmt: skip
    assert document["animations"][0]["name"] == "motion"


def test_other_readers_accept_it(tmp_path: Path) -> None:
    pygltflib = pytest.importorskip("pygltflib")
    path = write_glb(a_motion(), tmp_path / "a.glb")
    document = pygltflib.GLTF2().load(str(path))
    assert len(document.skins[0].joints) == 22
    assert document.images[0].mimeType == "image/png"
    trimesh = pytest.importorskip("trimesh")
    scene = trimesh.load(path)
    assert sum(len(mesh.faces) for mesh in scene.geometry.values()) == len(mannequin().triangles)
