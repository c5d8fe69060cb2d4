"""GLB: the animation in the file moves every joint as the motion does; two libraries read it."""

import io
from pathlib import Path

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from src.shared.data.retarget.read_motion import read_motion
from src.shared.errors import UserError
from src.shared.formats.mannequin import mannequin, whole_shares
from src.shared.formats.rig import continuous
from src.shared.formats.writers.glb import write_glb, write_vrm, write_vrma
from src.shared.motion.motion import Motion
from src.shared.motion.skeleton import JOINT_NAMES
from tests.shared.formats.glb_reader import Glb


def a_motion(frames: int = 30, text: str = "歩く </script> ünï") -> Motion:
    """Smooth tumbling with sign flips in the stored quaternions."""
    rng = np.random.default_rng(4)
    speed, phase = rng.normal(size=(22, 3)), rng.normal(size=(22, 3))
    turns = [Rotation.from_rotvec(phase + 0.1 * t * speed).as_quat() for t in range(frames)]
    quaternions = np.array(turns)[..., [3, 0, 1, 2]] * rng.choice([-1, 1], (frames, 22, 1))
    root = np.cumsum(rng.normal(0, 0.02, (frames, 3)), 0).astype(np.float32)
    return Motion(quaternions.astype(np.float32), root, np.ones((frames, 2), np.float32), 30, text)


@pytest.fixture(scope="module")
def glb(tmp_path_factory: pytest.TempPathFactory) -> Glb:
    return Glb(write_glb(a_motion(), tmp_path_factory.mktemp("glb") / "a.glb"))


def test_the_animation_moves_the_joints_as_the_motion_does(glb: Glb) -> None:
    motion = a_motion()
    for frame in range(0, 30, 3):
        positions, rotations = glb.world(frame)
        np.testing.assert_allclose(positions[:22], motion.positions()[frame], atol=1e-4)
        np.testing.assert_allclose(rotations[:22], motion.global_rotations()[frame], atol=1e-4)
    assert [node["name"] for node in glb.json["nodes"][:22]] == list(JOINT_NAMES)


def test_keys_are_frames_and_quaternions_unit_and_continuous(glb: Glb) -> None:
    animation = glb.json["animations"][0]
    assert animation["name"] == a_motion().text
    times = glb.read(animation["samplers"][0]["input"])[:, 0]
    np.testing.assert_allclose(times, np.arange(30) / 30, atol=1e-6)
    rotations = [c for c in animation["channels"] if c["target"]["path"] == "rotation"]
    assert len(rotations) == 22
    for channel in rotations:
        values = glb.read(animation["samplers"][channel["sampler"]]["output"]).astype(np.float64)
        np.testing.assert_allclose(np.linalg.norm(values, axis=-1), 1, atol=1e-6)
        assert ((values[1:] * values[:-1]).sum(-1) > 0).all()


def test_a_vrm_animation_names_bones_and_moves_them_as_the_motion_does(tmp_path: Path) -> None:
    motion = a_motion()
    glb = Glb(write_vrma(motion, tmp_path / "a.vrma"))
    positions, _ = glb.world(12)
    np.testing.assert_allclose(positions, motion.positions()[12], atol=1e-4)
    assert glb.json["extensionsUsed"] == list(glb.json["extensions"]) == ["VRMC_vrm_animation"]
    bones = glb.json["extensions"]["VRMC_vrm_animation"]["humanoid"]["humanBones"]
    assert bones["hips"] == {"node": 0} and len(bones) == 22
    for side in ("left", "right"):  # those that VRM 1.0 asks for
        for bone in ("UpperArm", "LowerArm", "Hand", "UpperLeg", "LowerLeg", "Foot"):
            assert side + bone in bones
    moved = [c["target"] for c in glb.json["animations"][0]["channels"]]
    assert [t["node"] for t in moved if t["path"] != "rotation"] == [0]
    assert "meshes" not in glb.json and "rotation" not in glb.json["nodes"][0]
    assert glb.json["nodes"][0]["translation"][1] > 0.9  # by which players scale its path
    again = read_motion(tmp_path / "a.vrma")
    np.testing.assert_allclose(again.positions(), motion.positions(), atol=1e-4)


def test_a_vrm_avatar_holds_what_vrm_asks_for_and_moves_as_the_motion_does(tmp_path: Path) -> None:
    motion = a_motion()
    glb = Glb(write_vrm(motion, tmp_path / "a.vrm"))
    assert glb.json["extensionsUsed"] == list(glb.json["extensions"]) == ["VRMC_vrm"]
    avatar = glb.json["extensions"]["VRMC_vrm"]
    assert avatar["specVersion"] == "1.0"
    assert avatar["meta"]["licenseUrl"] == "https://vrm.dev/licenses/1.0/"
    assert avatar["meta"]["name"] and all(avatar["meta"]["authors"])
    nodes = glb.json["nodes"]
    above = {child: n for n, node in enumerate(nodes) for child in node.get("children", [])}
    bones = {name: bone["node"] for name, bone in avatar["humanoid"]["humanBones"].items()}
    assert len(bones) == len(set(bones.values())) == 22
    limbs = {"Hand": "LowerArm", "LowerArm": "UpperArm", "UpperArm": "Shoulder",
             "Foot": "LowerLeg", "LowerLeg": "UpperLeg"}  # fmt: skip
    parents = {"spine": "hips", "chest": "spine", "upperChest": "chest", "neck": "upperChest",
               "head": "neck", "leftUpperLeg": "hips", "rightUpperLeg": "hips"}  # fmt: skip
    parents |= {side + a: side + b for side in ("left", "right") for a, b in limbs.items()}
    assert all(above[bones[bone]] == bones[parent] for bone, parent in parents.items())
    root = above[bones["hips"]]
    assert root in glb.json["scenes"][0]["nodes"] and set(nodes[root]) == {"name", "children"}
    assert not any({"rotation", "scale", "matrix"} & set(node) for node in nodes)
    np.testing.assert_allclose(glb.world(12)[0][:22], motion.positions()[12], atol=1e-4)
    same = Glb(write_glb(motion, tmp_path / "a.glb"))
    assert [glb.json[k] for k in ("meshes", "skins")] == [same.json[k] for k in ("meshes", "skins")]
    again = read_motion(tmp_path / "a.vrm")
    np.testing.assert_allclose(again.positions(), motion.positions(), atol=1e-4)
    np.testing.assert_allclose(again.global_rotations(), motion.global_rotations(), atol=1e-4)
    assert again.text == motion.text


def test_the_skin_binds_the_mesh_where_it_stands(glb: Glb) -> None:
    """Joint matrix times inverse bind matrix, at rest, is the identity."""
    skin = glb.json["skins"][0]
    assert skin["skeleton"] == 0
    inverse = glb.read(skin["inverseBindMatrices"]).reshape(-1, 4, 4).transpose(0, 2, 1)
    nodes, rest = glb.json["nodes"], np.zeros((22, 3))
    for joint in skin["joints"]:
        rest[joint] += nodes[joint]["translation"]
        for child in nodes[joint].get("children", []):
            rest[child] += rest[joint]
    for joint in skin["joints"]:
        bind = np.eye(4)
        bind[:3, 3] = rest[joint]
        np.testing.assert_allclose(bind @ inverse[joint], np.eye(4), atol=1e-6)


def test_weights_sum_to_one_and_unused_slots_name_the_first_joint(glb: Glb) -> None:
    attributes = glb.json["meshes"][0]["primitives"][0]["attributes"]
    weights, joints = glb.read(attributes["WEIGHTS_0"]), glb.read(attributes["JOINTS_0"])
    np.testing.assert_allclose(weights.sum(-1), 1, atol=1e-12)
    assert (joints[weights == 0] == 0).all()
    assert joints.max() < 22
    np.testing.assert_allclose(
        np.linalg.norm(glb.read(attributes["NORMAL"]), axis=-1), 1, atol=1e-5
    )


def test_skinned_vertices_follow_our_kinematics(glb: Glb) -> None:
    motion, body = a_motion(), mannequin()
    attributes = glb.json["meshes"][0]["primitives"][0]["attributes"]
    points = glb.read(attributes["POSITION"])
    weights, joints = glb.read(attributes["WEIGHTS_0"]), glb.read(attributes["JOINTS_0"])
    columns = glb.read(glb.json["skins"][0]["inverseBindMatrices"]).reshape(-1, 4, 4)
    inverse = columns.transpose(0, 2, 1)
    for frame in (0, 17, 29):
        positions, rotations = glb.world(frame)
        moved = np.zeros_like(points, dtype=float)
        for slot in range(4):
            bone = joints[:, slot]
            local = points + inverse[bone, :3, 3]
            moved += weights[:, slot, None] * (
                np.einsum("vij,vj->vi", rotations[bone], local) + positions[bone]
            )
        expected = body.pose(motion.positions()[frame], motion.global_rotations()[frame])[0]
        assert np.abs(moved - expected).max() < 1e-3  # weights are integers


def test_trimesh_sees_an_upright_closed_body(tmp_path: Path) -> None:
    trimesh = pytest.importorskip("trimesh")
    scene = trimesh.load(write_glb(a_motion(), tmp_path / "a.glb"), force="scene")
    (mesh,) = scene.geometry.values()
    mesh.merge_vertices(merge_tex=True, merge_norm=True)
    assert mesh.is_watertight
    assert mesh.is_winding_consistent
    assert 0.05 < mesh.volume < 0.09  # cubic metres; a person of 70 kg has 0.07
    low, high = mesh.bounds
    assert abs(low[1]) < 0.02
    assert 1.6 < high[1] < 1.85
    assert np.ptp(mesh.bounds[:, 0]) > 1.5  # arms out
    assert mesh.visual.material.baseColorTexture.size == (32, 4)


def test_pygltflib_reads_it_and_the_picture_inside(tmp_path: Path) -> None:
    pygltflib = pytest.importorskip("pygltflib")
    from PIL import Image

    document = pygltflib.GLTF2().load(str(write_glb(a_motion(), tmp_path / "a.glb")))
    assert len(document.skins[0].joints) == 22
    assert len(document.animations[0].channels) == 23
    view = document.bufferViews[document.images[0].bufferView]
    png = document.binary_blob()[view.byteOffset : view.byteOffset + view.byteLength]
    pixels = np.asarray(Image.open(io.BytesIO(png)).convert("RGB")).astype(int)
    assert pixels[0, 0, 2] > pixels[0, 0, 0]  # the right side is blue
    assert pixels[0, -1, 0] > pixels[0, -1, 2]  # the left side is orange


def test_one_frame_is_enough(tmp_path: Path) -> None:
    glb = Glb(write_glb(a_motion(1, ""), tmp_path / "a.glb"))
    np.testing.assert_allclose(glb.world(0)[0][:22], a_motion(1).positions()[0], atol=1e-4)
    assert glb.json["animations"][0]["name"] == "motion"


def test_the_same_motion_gives_the_same_bytes(tmp_path: Path) -> None:
    first = write_glb(a_motion(), tmp_path / "a.glb").read_bytes()
    assert write_glb(a_motion(), tmp_path / "b.glb").read_bytes() == first


def test_a_folder_in_the_way_is_a_user_error(tmp_path: Path) -> None:
    (tmp_path / "a.glb").mkdir()
    with pytest.raises(UserError, match=r"a\.glb"):
        write_glb(a_motion(), tmp_path / "a.glb")


def test_shares_are_whole_and_complete() -> None:
    shares = whole_shares(np.array([[0.5, 0.3, 0.2, 0.0], [1 / 3, 1 / 3, 1 / 3, 0.0]]), 255)
    assert (shares.sum(-1) == 255).all()
    assert (shares >= 0).all()


def test_continuous_turns_the_short_way() -> None:
    quaternions = np.array([[1, 0, 0, 0], [-1, 0, 0, 0], [2, 0, 0, 0]], dtype=float)
    np.testing.assert_array_equal(continuous(quaternions)[:, 0], [1, 1, 1])
