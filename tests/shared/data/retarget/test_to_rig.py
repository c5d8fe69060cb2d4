"""Onto a user's skeleton and back: the same motion; what the skeleton lacks keeps its rest pose."""

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.spatial.transform import Rotation

from src.shared.data.retarget.mapping import SkeletonMapping, load_mappings
from src.shared.data.retarget.read_motion import read_motion
from src.shared.data.retarget.to_canonical import retarget
from src.shared.data.retarget.to_rig import Target, read_target, rest_clip, retarget_out
from src.shared.errors import UsageError, UserError
from src.shared.formats.readers.bvh import read_bvh
from src.shared.formats.readers.glb import GlbFile, read_glb, read_glb_skeleton, rest_matrix
from src.shared.formats.registry import write_clip, write_motion
from src.shared.formats.rig import SCHEMES, Rig, RigClip, SourceClip, canonical_rig
from src.shared.formats.writers.glb import write_glb_clip
from src.shared.motion.motion import Motion
from src.shared.motion.skeleton import FOOT_JOINTS, JOINT_INDEX, JOINT_NAMES, REST_FOOT_HEIGHT
from tests.shared.data.retarget.test_round_trips import differences, random_motion

SPARSE = ("spine2", "l_collar", "r_collar")  # what many skeletons do not have


def own_rig(seed: int, *, unit: float = 0.01, a_pose: float = 0.0) -> Rig:
    """Our skeleton with other proportions, in another unit, arms lowered by `a_pose` radians."""
    rng = np.random.default_rng(seed)
    rig = canonical_rig("mixamo")
    factors = rng.uniform(0.8, 1.3, (22, 1))
    for left, name in enumerate(JOINT_NAMES):
        if name.startswith("l_"):
            factors[JOINT_INDEX[f"r_{name[2:]}"]] = factors[left]
    offsets = rig.offsets * factors
    for side, sign in (("l", -1.0), ("r", 1.0)):
        turn = Rotation.from_euler("Z", sign * a_pose).as_matrix()
        for name in ("elbow", "wrist"):
            offsets[JOINT_INDEX[f"{side}_{name}"]] @= turn.T
    offsets[0] *= 0
    return replace(rig, offsets=offsets / unit, metres=unit)


def mapping_of(rig: Rig, missing: tuple[str, ...] = ()) -> SkeletonMapping:
    pairs = zip(JOINT_NAMES, rig.names, strict=True)
    return SkeletonMapping(name="own", joints={a: b for a, b in pairs if a not in missing})


@settings(max_examples=15, deadline=None)
@given(st.integers(0, 2**32 - 1), st.floats(0.0, 0.9), st.sampled_from([1.0, 0.01, 0.0254]))
def test_there_and_back_is_the_same_motion(seed: int, a_pose: float, unit: float) -> None:
    motion = random_motion(3, seed, 30.0)
    rig = own_rig(seed, unit=unit, a_pose=a_pose)
    clip = retarget_out(motion, rig, mapping_of(rig))
    back = retarget(clip, mapping_of(rig), fps=None, ground=False)
    height = back.root_position[:1, 1] - motion.root_position[:1, 1]  # its feet are not ours
    shifted = replace(back, root_position=back.root_position - np.outer(height, [0, 1, 0]))
    angle, distance = differences(motion, shifted)
    assert angle <= 1e-4
    assert distance <= 1e-4


@pytest.mark.parametrize("up", ["Y", "Z", "-X"])
def test_any_up_axis(up: str) -> None:
    from src.shared.data.retarget.autodetection import upright

    turn = upright(up).T  # our world → the rig's
    motion, rig = random_motion(3, 3, 30.0), own_rig(3)
    rig = replace(rig, offsets=rig.offsets @ turn.T)
    clip = retarget_out(motion, rig, mapping_of(rig), up=up)
    back = retarget(clip, mapping_of(rig), fps=None, up=up, ground=False)
    assert differences(motion, back)[0] <= 1e-4
    np.testing.assert_allclose(
        np.diff(back.root_position, axis=0), np.diff(motion.root_position, axis=0), atol=1e-4
    )


def test_joints_without_a_counterpart_keep_their_rest_pose() -> None:
    rig = own_rig(5)
    clip = retarget_out(random_motion(4, 5, 30.0), rig, mapping_of(rig, SPARSE))
    for name in SPARSE:
        joint = JOINT_INDEX[name]
        np.testing.assert_allclose(clip.rotations[:, joint], np.tile(np.eye(3), (4, 1, 1)))
    np.testing.assert_allclose(clip.translations[:, 1:], np.tile(rig.offsets[1:], (4, 1, 1)))


def standing() -> Motion:
    quaternions = np.zeros((3, 22, 4), np.float32)
    quaternions[..., 0] = 1
    root = np.tile(canonical_rig().offsets[0].astype(np.float32), (3, 1))
    return Motion(quaternions, root, np.ones((3, 2), np.float32), 30.0, "stands")


@pytest.mark.parametrize("stands", [True, False])
def test_feet_stand_on_the_floor(stands: bool) -> None:
    """As high as in a rest pose on the floor; where the rest pose is elsewhere, as ours, scaled."""
    rig = own_rig(6, unit=1.0)
    balls = [ball for _, ball in FOOT_JOINTS]
    if stands:  # in shoes
        offsets = rig.offsets.copy()
        offsets[0, 1] = 0.07 - rig.rest()[balls, 1].mean()
        rig = replace(rig, offsets=offsets)
    clip = retarget_out(standing(), rig, mapping_of(rig))
    legs = -rig.offsets[[JOINT_INDEX["l_knee"], JOINT_INDEX["l_ankle"]], 1].sum()
    expected = 0.07 if stands else REST_FOOT_HEIGHT * legs / 0.8
    np.testing.assert_allclose(clip.world()[0][:, balls, 1], expected, atol=1e-5)


def test_a_root_above_the_pelvis_stays(tmp_path: Path) -> None:
    """Unreal's skeletons have a root on the floor; the pelvis moves."""
    rig = own_rig(7)
    rooted = Rig(
        ("root", *rig.names),
        (-1, *(parent + 1 for parent in rig.parents)),
        np.concatenate((np.zeros((1, 3)), rig.offsets)),
        tuple((joint + 1, tip) for joint, tip in rig.tips),
        np.tile(np.eye(3), (23, 1, 1)),
        ("ZXY",) * 23,
    )
    motion = random_motion(3, 7, 30.0)
    clip = retarget_out(motion, rooted, mapping_of(rig))
    assert np.abs(clip.translations[:, 0]).max() == 0
    back = read_bvh(write_clip(clip, tmp_path / "a.bvh"))
    assert [len(c) for c in back.channels][:3] == [6, 6, 3]
    same_places(back, clip, 1e-2)  # centimetres


def same_places(first: SourceClip, second: SourceClip, tolerance: float) -> None:
    """The joints of the same name, for files list them in another order."""
    order = [first.names.index(name) for name in second.names]
    np.testing.assert_allclose(first.world()[0][:, order], second.world()[0], atol=tolerance)


def character(path: Path) -> Path:
    """A GLB as exporters make them: an armature scaled and turned, joints with their own axes."""
    rig = own_rig(9, unit=1.0, a_pose=0.6)
    offsets = rig.offsets.copy()
    offsets[0] = (0.0, 1.0, 0.0)
    frames = Rotation.random(22, random_state=1).as_matrix()
    rig = replace(rig, offsets=offsets, frames=frames)
    write_glb_clip(rest_clip(rig), path)
    skeleton = read_glb_skeleton(path)
    document = skeleton.file.document
    # The armature: 100 units a metre, lying on its back; its inverse goes into the pelvis' node.
    turn = Rotation.from_euler("X", 90, degrees=True)
    nodes = document["nodes"]
    nodes.append({"name": "Armature", "children": [0], "scale": [0.01] * 3,
                  "rotation": turn.as_quat().tolist()})  # fmt: skip
    pelvis = nodes[0]
    pelvis["translation"] = (turn.inv().apply(pelvis["translation"]) * 100).tolist()
    own = Rotation.from_quat(pelvis.get("rotation", [0, 0, 0, 1]))
    pelvis["rotation"] = (turn.inv() * own).as_quat().tolist()
    for node in nodes[1:22]:
        node["translation"] = (np.array(node["translation"]) * 100).tolist()
    document["scenes"][0]["nodes"] = [23, 22]
    return skeleton.file.write(path)


def test_a_character_keeps_its_mesh_and_gets_the_motion(tmp_path: Path) -> None:
    path = character(tmp_path / "hero.glb")
    target = read_target(path)
    assert target.mapping.name
    before = read_glb_skeleton(path)
    motion = random_motion(5, 11, 30.0)
    out = target.write(motion, tmp_path / "moved.glb")
    after = read_glb_skeleton(out)
    assert after.file.document["meshes"] == before.file.document["meshes"]
    assert after.file.document["nodes"] == before.file.document["nodes"]
    clip = read_glb(out)
    same_places(clip, target.clip(motion), 1e-4)
    back = read_motion(out, fps=None)
    assert differences(motion, back)[0] <= 1e-4
    with pytest.raises(UserError, match="own file"):
        target.write(motion, path)
    bvh = read_bvh(target.write(motion, tmp_path / "moved.bvh"))  # in centimetres, as all of ours
    np.testing.assert_allclose(bvh.offsets[1:], 100 * target.rig.offsets[1:], atol=1e-3)


@pytest.mark.parametrize("version", ["VRM", "VRMC_vrm"])
def test_an_avatar_keeps_all_that_its_file_holds(version: str, tmp_path: Path) -> None:
    file = GlbFile.read(character(tmp_path / "hero.glb"))
    nodes = {name[0].lower() + name[1:]: node for node, name in enumerate(SCHEMES["unity"])}
    if version == "VRM":  # of 0.x, which faces -Z
        bones: object = [{"bone": name, "node": node} for name, node in nodes.items()]
        turn = {"name": "back", "children": [23], "rotation": [0.0, 1.0, 0.0, 0.0]}
        file.document["nodes"].append(turn)
        file.document["scenes"][0]["nodes"][0] = 24
    else:
        bones = {name: {"node": node} for name, node in nodes.items()}
    extension = {"meta": {"name": "Hero", "authors": ["me"]}, "humanoid": {"humanBones": bones}}
    file.document |= {"extensionsUsed": [version], "extensions": {version: extension}}
    path = file.write(tmp_path / "hero.vrm")
    motion = random_motion(5, 11, 30.0)
    out = read_target(path).write(motion, tmp_path / "moved.VRM")
    after = GlbFile.read(out)
    for name in ("extensions", "extensionsUsed", "meshes", "skins", "materials", "nodes", "scenes"):
        assert after.document[name] == file.document[name]
    for name in ("accessors", "bufferViews"):
        kept = file.document[name]
        assert after.document[name][: len(kept)] == kept
    assert after.data.startswith(bytes(file.data))
    assert len(after.document["animations"]) == 1
    assert differences(motion, read_motion(out, fps=None))[0] <= 1e-4
    again = read_target(out).write(motion, tmp_path / "again.vrm")
    assert GlbFile.read(again).document["extensions"] == file.document["extensions"]


def test_what_is_no_avatar_is_not_written_as_one(tmp_path: Path) -> None:
    for source in (character(tmp_path / "hero.glb"), write_motion(standing(), tmp_path / "a.bvh")):
        with pytest.raises(UsageError, match=rf"{source.name} is no VRM avatar.*write a \.glb"):
            read_target(source).write(standing(), tmp_path / "moved.vrm")
    assert not (tmp_path / "moved.vrm").exists()


def as_matrices(path: Path) -> Path:
    """The same file, each node's pose as a matrix."""
    file = GlbFile.read(path)
    for node in file.document["nodes"]:
        matrix = rest_matrix(node)
        for name in ("translation", "rotation", "scale"):
            node.pop(name, None)
        node["matrix"] = matrix.T.ravel().tolist()
    return file.write(path)


def test_joints_whose_pose_is_a_matrix_move_as_well(tmp_path: Path) -> None:
    """glTF animates no node with a matrix."""
    path, motion = character(tmp_path / "hero.glb"), random_motion(5, 11, 30.0)
    plain = read_glb(read_target(path).write(motion, tmp_path / "plain.glb"))
    moved = read_glb(read_target(as_matrices(path)).write(motion, tmp_path / "moved.glb"))
    same_places(moved, plain, 1e-4)


def test_a_bvh_skeleton_keeps_names_offsets_orders_and_unit(tmp_path: Path) -> None:
    rig = own_rig(13)
    orders = tuple(["XYZ", "ZYX", "YXZ"][joint % 3] for joint in range(22))
    source = write_clip(rest_clip(replace(rig, orders=orders)), tmp_path / "own.bvh")
    target = read_target(source)
    assert isinstance(target, Target)
    out = target.write(random_motion(5, 13, 60.0), tmp_path / "moved.bvh")
    before, after = read_bvh(source), read_bvh(out)
    assert (after.names, after.parents) == (before.names, before.parents)
    assert after.rotation_orders == before.rotation_orders
    np.testing.assert_array_equal(after.offsets, before.offsets)
    assert after.end_sites == before.end_sites
    assert 1 / after.frame_time == pytest.approx(60.0, rel=1e-5)
    angle, _ = differences(random_motion(5, 13, 60.0), read_motion(out, fps=None))
    assert angle <= 1e-4
    # GLB counts in metres: the centimetres of the skeleton are guessed from its legs.
    glb = read_glb(target.write(random_motion(5, 13, 60.0), tmp_path / "moved.glb"))
    np.testing.assert_allclose(glb.offsets * 100, before.offsets, atol=1e-3)


def test_a_skeleton_that_stands_along_z_stands_up_in_glb(tmp_path: Path) -> None:
    from src.shared.formats.rig import turned

    turn = Rotation.from_euler("X", 90, degrees=True).as_matrix()
    source = write_clip(turned(rest_clip(own_rig(17)), turn), tmp_path / "own.bvh")
    target = read_target(source)
    assert target.up == "Z"
    upright = read_glb(target.write(standing(), tmp_path / "moved.glb"))
    places = upright.world()[0][0]
    head, ankle = (places[upright.names.index(f"mixamorig:{n}")] for n in ("Head", "LeftFoot"))
    assert head[1] - ankle[1] > 1.2
    lying = read_bvh(target.write(standing(), tmp_path / "moved.bvh")).world()[0][0]
    assert np.ptp(lying[:, 2]) > 120


def test_a_rest_pose_that_tells_nothing_is_read_off_the_motion(tmp_path: Path) -> None:
    """All bones along X, as in LaFAN1's files: the recording in the file tells the axes."""
    rig = own_rig(19)
    offsets = rig.offsets.copy()
    for joint, name in enumerate(JOINT_NAMES):
        if not name.endswith(("pelvis", "hip", "collar")):
            offsets[joint] = (np.linalg.norm(offsets[joint]), 0.0, 0.0)
    stick = replace(rig, offsets=offsets)
    moving = random_motion(60, 19, 30.0)
    corrections = {name: Rotation.random(random_state=1).as_matrix() for name in JOINT_NAMES}
    own = retarget_out(moving, stick, mapping_of(stick), corrections=corrections)
    path = write_clip(own, tmp_path / "own.bvh")
    target, recorded = read_target(path), read_bvh(path)
    ours = retarget(recorded, target.mapping, fps=None, up=target.up, ground=False)
    np.testing.assert_allclose(target.clip(ours).world()[1], recorded.world()[1], atol=1e-3)


def test_faults_name_the_file(tmp_path: Path) -> None:
    two = tmp_path / "two.bvh"
    one = "{\nOFFSET 0 0 0\nCHANNELS 3 Zrotation Xrotation Yrotation\n}\n"
    two.write_text(f"HIERARCHY\nROOT a\n{one}ROOT b\n{one}MOTION\nFrames: 1\nFrame Time: 0.03\n"
                   "0 0 0 0 0 0\n")  # fmt: skip
    with pytest.raises(UserError, match=r"two\.bvh"):
        read_target(two)
    path = write_motion(standing(), tmp_path / "a.bvh")
    with pytest.raises(UserError, match="own file"):
        read_target(path).write(standing(), path)
    rig = canonical_rig()
    flat = replace(rig, offsets=rig.offsets * 0)
    mapping = next(m for m in load_mappings() if m.name == "motion-suite")
    with pytest.raises(UserError, match="legs have no length"):
        retarget_out(standing(), flat, mapping)


def test_rest_is_one_frame_without_turns() -> None:
    clip = rest_clip(canonical_rig())
    assert isinstance(clip, RigClip)
    np.testing.assert_allclose(clip.world()[0][0], canonical_rig().rest())
