"""GLB in: characters of exporters, every interpolation, and files that are no characters."""

import struct
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st
from scipy.spatial.transform import Rotation, Slerp

from src.shared.data.retarget.read_motion import read_motion
from src.shared.data.retarget.to_rig import read_target
from src.shared.errors import UserError
from src.shared.formats.readers.glb import GlbFile, read_glb, read_glb_skeleton
from src.shared.formats.rig import SCHEMES
from src.shared.formats.writers.glb import write_glb, write_glb_clip
from tests.shared.formats.rigs import random_clip
from tests.shared.formats.writers.test_bvh import random_motion


def a_file(path: Path, joints: int = 4) -> GlbFile:
    return GlbFile.read(write_glb_clip(random_clip(1, joints=joints, frames=2), path / "a.glb"))


def animated(file: GlbFile, keys: list[float], values: np.ndarray, kind: str, path: str) -> GlbFile:
    """The file with one channel, of its second joint."""
    times, output = np.array(keys, np.float32), file.accessor(values.astype(np.float32))
    samplers = [{"input": file.accessor(times), "output": output, "interpolation": kind}]
    channels = [{"sampler": 0, "target": {"node": 1, "path": path}}]
    file.document["animations"] = [{"samplers": samplers, "channels": channels}]
    return file


def test_linear_rotations_are_slerped_as_scipy_does(tmp_path: Path) -> None:
    keys, turns = [0.0, 0.5, 0.75], Rotation.random(3, random_state=2)
    file = animated(a_file(tmp_path), keys, turns.as_quat(), "LINEAR", "rotation")
    clip = read_glb(file.write(tmp_path / "b.glb"))
    assert clip.fps == pytest.approx(1 / 0.375)  # the median step
    times = np.arange(clip.num_frames) / clip.fps
    expected = Slerp(keys, turns)(np.clip(times, 0, 0.75)).as_matrix()
    np.testing.assert_allclose(clip.rotations[:, 1], expected, atol=1e-5)


def test_steps_hold_and_splines_bend(tmp_path: Path) -> None:
    keys = [0.0, 0.5, 1.0]
    places = np.array([[0, 0, 0], [1, 2, 3], [4, 0, -1]], float)
    stepped = animated(a_file(tmp_path), keys, places, "STEP", "translation")
    clip = read_glb(stepped.write(tmp_path / "b.glb"))
    np.testing.assert_allclose(clip.translations[:, 1], places, atol=1e-6)
    zero = np.zeros((3, 1, 3))
    triples = np.concatenate((zero, places[:, None], zero), 1).reshape(-1, 3)
    spline = animated(a_file(tmp_path), keys, triples, "CUBICSPLINE", "translation")
    clip = read_glb(spline.write(tmp_path / "c.glb"))
    np.testing.assert_allclose(clip.translations[:, 1], places, atol=1e-6)


@pytest.mark.parametrize("version", ["VRM", "VRMC_vrm"])
def test_joints_of_a_vrm_avatar_are_those_it_names(version: str, tmp_path: Path) -> None:
    file = GlbFile.read(write_glb(random_motion(2), tmp_path / "a.glb"))
    nodes = file.document["nodes"]
    names = {name: index for index, name in enumerate(SCHEMES["unity"])}
    for node in nodes:
        node["name"] = "J_Bip"
    nodes[15]["children"] = [len(nodes)]  # hair, which no humanoid has
    nodes.append({"name": "hair"})
    rows = [{"bone": name[0].lower() + name[1:], "node": node} for name, node in names.items()]
    bones = rows if version == "VRM" else {row["bone"]: {"node": row["node"]} for row in rows}
    file.document["extensions"] = {version: {"humanoid": {"humanBones": bones}}}
    target = read_target(file.write(tmp_path / "a.vrm"))
    assert target.rig.names[0] == "hips" and "hair" not in target.rig.names
    walk = random_motion(5)
    moved = read_motion(target.write(walk, tmp_path / "moved.glb"))
    np.testing.assert_allclose(moved.positions(), walk.positions(), atol=1e-3)
    file.document["extensions"][version]["humanoid"] = {"humanBones": [{"bone": "hips"}]}
    with pytest.raises(UserError, match="glTF"):
        read_target(file.write(tmp_path / "b.vrm"))


def test_names_are_printable_and_tell_joints_apart(tmp_path: Path) -> None:
    file = a_file(tmp_path)
    for node, name in enumerate(("a\x1b[2J\nb", "c\x07", "c\x9b")):
        file.document["nodes"][node]["name"] = name
    names = read_glb(file.write(tmp_path / "b.glb")).rig.names
    assert names[0] == "a\ufffd[2J b" and all(name.isprintable() for name in names)
    assert names[1:3] == ("c\ufffd", "c\ufffd 2")


@pytest.mark.filterwarnings("error")
def test_a_signalling_nan_is_refused_without_a_warning(tmp_path: Path) -> None:
    file = animated(a_file(tmp_path), [0.0, 1.0], np.zeros((2, 3)), "LINEAR", "translation")
    last = file.document["bufferViews"][file.document["accessors"][-2]["bufferView"]]
    start = last["byteOffset"]
    file.data[start : start + 4] = struct.pack("<I", 0x7FA00000)
    with pytest.raises(UserError, match="NaN"):
        read_glb(file.write(tmp_path / "b.glb"))


def test_scale_above_the_skeleton_counts(tmp_path: Path) -> None:
    file = a_file(tmp_path)
    before = read_glb(file.write(tmp_path / "b.glb")).world()[0]
    nodes = file.document["nodes"]
    nodes.append({"name": "top", "children": [0], "scale": [2, 2, 2]})
    after = read_glb(file.write(tmp_path / "c.glb")).world()[0]
    np.testing.assert_allclose(after, before * 2, atol=1e-5)


def test_a_file_without_animation_is_its_rest_pose(tmp_path: Path) -> None:
    file = a_file(tmp_path)
    del file.document["animations"]
    clip = read_glb(file.write(tmp_path / "b.glb"))
    assert (clip.num_frames, clip.fps) == (1, 30.0)
    np.testing.assert_allclose(clip.world()[0][0], clip.rig.rest(), atol=1e-6)


def test_without_a_skin_the_nodes_are_the_joints(tmp_path: Path) -> None:
    file = a_file(tmp_path)
    names = read_glb_skeleton(file.write(tmp_path / "b.glb")).rig.names
    file.document.pop("skins")
    assert read_glb_skeleton(file.write(tmp_path / "c.glb")).rig.names == names


def set_uneven(document: dict[str, Any]) -> None:
    document["nodes"][1]["scale"] = [1, 2, 1]


def set_circle(document: dict[str, Any]) -> None:
    document["nodes"][1]["children"] = [0]


def set_sparse(document: dict[str, Any]) -> None:
    for accessor in document["accessors"]:
        accessor["sparse"] = {}


def set_huge(document: dict[str, Any]) -> None:
    document["nodes"][0]["translation"] = [1e30, 0, 0]


def set_mirrored(document: dict[str, Any]) -> None:
    document["nodes"][0]["scale"] = [-1, 1, 1]


def set_wrong(document: dict[str, Any]) -> None:
    document["skins"] = [{"joints": ["a"]}]


@pytest.mark.parametrize(
    ("change", "says"),
    [
        (set_uneven, "unevenly"),
        (set_circle, "two parents|own ancestors"),
        (set_sparse, "compress"),
        (set_huge, "impossible places"),
        (set_mirrored, "mirrored"),
        (set_wrong, "glTF 2.0"),
    ],
)
def test_what_is_wrong_is_said(
    tmp_path: Path, change: Callable[[dict[str, Any]], None], says: str
) -> None:
    file = a_file(tmp_path)
    change(file.document)
    with pytest.raises(UserError, match=says) as caught:
        read_glb(file.write(tmp_path / "b.glb"))
    assert str(tmp_path / "b.glb") in str(caught.value)


@pytest.mark.parametrize(
    ("data", "says"),
    [
        (b"", "empty"),
        (b"{}", "not a GLB"),
        (b"glTF", "not a whole GLB"),
        (struct.pack("<4sII", b"glTF", 1, 12), "not a whole GLB"),
        (struct.pack("<4sIII4s", b"glTF", 2, 22, 2, b"JSON") + b"[]", "version 2"),
        (struct.pack("<4sIII4s", b"glTF", 2, 22, 2, b"JSON") + b"{}", "no skeleton"),
        (struct.pack("<4sIII4s", b"glTF", 2, 90, 99, b"JSON") + b"{}", "cut off"),
    ],
)
def test_files_that_are_no_characters(tmp_path: Path, data: bytes, says: str) -> None:
    path = tmp_path / "a.glb"
    path.write_bytes(data)
    with pytest.raises(UserError, match=says) as caught:
        read_glb_skeleton(path)
    assert str(path) in str(caught.value)


@settings(max_examples=150, deadline=None,
          suppress_health_check=[HealthCheck.function_scoped_fixture])  # fmt: skip
@given(st.binary(min_size=1, max_size=30), st.floats(0, 1), st.booleans())
def test_damaged_files_are_refused_or_read(
    tmp_path: Path, noise: bytes, place: float, cut: bool
) -> None:
    path = tmp_path / "a.glb"
    if not path.exists():
        write_glb_clip(random_clip(1, joints=4), path)
    data = path.read_bytes()
    at = int(place * (len(data) - 1))
    other = tmp_path / "b.glb"
    other.write_bytes(data[:at] + noise + (b"" if cut else data[at + len(noise) :]))
    try:
        read_glb(other)
    except UserError as error:
        assert str(other) in str(error)


def test_our_own_characters_are_read(tmp_path: Path) -> None:
    skeleton = read_glb_skeleton(write_glb(random_motion(2), tmp_path / "a.glb"))
    assert len(skeleton.rig.names) == 22
    assert skeleton.rig.metres == 1.0
    np.testing.assert_array_equal(skeleton.base, np.eye(4))
