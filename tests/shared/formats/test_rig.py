"""Any skeleton through BVH, GLB and USD and back, with independent readers as judges."""

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st
from scipy.spatial.transform import Rotation

from src.shared.errors import UsageError
from src.shared.formats.readers.bvh import read_bvh
from src.shared.formats.readers.glb import read_glb
from src.shared.formats.registry import write_clip
from src.shared.formats.rig import (
    SCHEMES,
    RigClip,
    canonical_rig,
    joint_names,
    motion_clip,
    rescaled,
    turned,
)
from src.shared.formats.writers.glb import write_glb_clip
from src.shared.motion.skeleton import JOINT_NAMES
from tests.shared.formats.glb_reader import Glb
from tests.shared.formats.rigs import differences, random_clip
from tests.shared.formats.writers.test_bvh import random_motion

ANY = settings(max_examples=20, deadline=None,
               suppress_health_check=[HealthCheck.function_scoped_fixture])  # fmt: skip
SEEDS = st.integers(0, 2**32 - 2)
TOLERANCE = 1e-4


@ANY
@given(SEEDS, st.integers(1, 20), st.integers(1, 4))
def test_any_skeleton_comes_back_from_bvh(
    tmp_path: Path, seed: int, joints: int, frames: int
) -> None:
    clip = random_clip(seed, joints=joints, frames=frames)
    back = read_bvh(write_clip(clip, tmp_path / "a.bvh"))
    assert (back.names, back.parents) == (clip.names, clip.parents)
    assert back.rotation_orders == clip.rig.orders
    assert max(differences(clip, back)) <= TOLERANCE
    np.testing.assert_allclose(back.offsets, clip.offsets, atol=1e-5)
    assert sorted(back.end_sites) == sorted(clip.rig.tips)


@ANY
@given(SEEDS, st.integers(3, 20), st.integers(1, 4))
def test_any_skeleton_comes_back_from_glb(
    tmp_path: Path, seed: int, joints: int, frames: int
) -> None:
    clip = random_clip(seed, joints=joints, frames=frames, axes=True)
    back = read_glb(write_clip(clip, tmp_path / "a.glb"))
    assert (back.names, back.parents, back.text) == (clip.names, clip.parents, "any")
    assert max(differences(clip, back)) <= TOLERANCE
    np.testing.assert_allclose(back.offsets, clip.offsets, atol=1e-5)
    np.testing.assert_allclose(back.rig.frames, clip.rig.frames, atol=1e-5)


def test_a_plain_reader_of_glb_sees_the_same_joints(tmp_path: Path) -> None:
    clip = random_clip(5, axes=True)
    glb = Glb(write_glb_clip(clip, tmp_path / "a.glb"))
    places, turns = clip.world()
    for frame in range(clip.num_frames):
        positions, rotations = glb.world(frame)
        np.testing.assert_allclose(positions[:-1], places[frame], atol=1e-4)
        np.testing.assert_allclose(rotations[:-1], turns[frame] @ clip.rig.frames, atol=1e-4)


def test_trimesh_and_pygltflib_read_a_character_of_bones(tmp_path: Path) -> None:
    trimesh, pygltflib = pytest.importorskip("trimesh"), pytest.importorskip("pygltflib")
    clip = random_clip(6, axes=True)
    path = write_glb_clip(clip, tmp_path / "a.glb")
    scene = trimesh.load(path, force="scene")
    for name, place in zip(clip.names, clip.rig.rest(), strict=True):
        np.testing.assert_allclose(scene.graph.get(name)[0][:3, 3], place, atol=1e-5)
    (mesh,) = scene.geometry.values()
    mesh.merge_vertices(merge_tex=True, merge_norm=True)
    assert mesh.is_watertight
    assert mesh.volume > 0  # faces look outwards
    document = pygltflib.GLTF2().load(str(path))
    assert len(document.skins[0].joints) == len(clip.names)


def test_usd_core_sees_the_same_joints(tmp_path: Path) -> None:
    pytest.importorskip("pxr")
    for seed in range(3):
        clip = random_clip(seed, axes=True)
        assert_usd_agrees(clip, write_clip(clip, tmp_path / f"{seed}.usda"))


def assert_usd_agrees(clip: RigClip, path: Path) -> None:
    """OpenUSD's own skinning query against our kinematics."""
    from pxr import Usd, UsdSkel

    stage = Usd.Stage.Open(str(path))
    root = UsdSkel.Root(stage.GetDefaultPrim())
    cache = UsdSkel.Cache()
    cache.Populate(root, Usd.PrimDefaultPredicate)
    query = cache.GetSkelQuery(UsdSkel.Skeleton(stage.GetPrimAtPath("/Character/Skeleton")))
    assert query.HasBindPose()
    assert query.HasRestPose()
    places, turns = clip.world()
    for frame in range(clip.num_frames):
        found = np.array(query.ComputeJointSkelTransforms(frame))
        np.testing.assert_allclose(found[:, 3, :3], places[frame], atol=1e-4)
        rotations = turns[frame] @ clip.rig.frames
        np.testing.assert_allclose(found[:, :3, :3].swapaxes(-1, -2), rotations, atol=1e-4)


def test_bvhio_sees_the_same_joints(tmp_path: Path) -> None:
    bvhio = pytest.importorskip("bvhio")
    clip = random_clip(8)
    clip = replace(clip, rig=replace(clip.rig, names=tuple(f"j{j}" for j in range(12))))
    root = bvhio.readAsHierarchy(str(write_clip(clip, tmp_path / "a.bvh")))
    joints = {joint.Name: joint for joint, _, _ in root.layout()}
    places = clip.world()[0]
    for frame in range(clip.num_frames):
        root.loadPose(frame, recursive=True)
        found = np.array([list(joints[name].PositionWorld) for name in clip.names])
        np.testing.assert_allclose(found, places[frame], atol=1e-4)


def test_a_chain_longer_than_pythons_stack(tmp_path: Path) -> None:
    count = 1500
    rig = canonical_rig()
    rig = replace(
        rig,
        names=tuple(f"j{j}" for j in range(count)),
        parents=tuple(range(-1, count - 1)),
        offsets=np.full((count, 3), 0.01),
        tips=(),
        frames=np.tile(np.eye(3), (count, 1, 1)),
        orders=("ZXY",) * count,
    )
    clip = RigClip(rig, rig.frames[None], rig.offsets[None], 30.0)
    back = read_bvh(write_clip(clip, tmp_path / "a.bvh"))
    assert back.parents == rig.parents


def test_another_unit_moves_nothing() -> None:
    clip = random_clip(3)
    centimetres = rescaled(clip, 0.01)
    np.testing.assert_allclose(centimetres.world()[0], clip.world()[0] * 100)
    np.testing.assert_allclose(rescaled(centimetres, 1.0).rig.tips[0][1], clip.rig.tips[0][1])


def test_a_turned_world_turns_everything() -> None:
    clip = random_clip(4, axes=True)
    turn = Rotation.random(random_state=1).as_matrix()
    (places, turns), (others, turned_too) = clip.world(), turned(clip, turn).world()
    np.testing.assert_allclose(others, places @ turn.T, atol=1e-12)
    np.testing.assert_allclose(turned_too, turn @ turns @ turn.T, atol=1e-12)


def test_thinning_keeps_every_other_frame() -> None:
    clip = random_clip(3, frames=7)
    half = clip.every(2)
    assert (half.num_frames, half.fps, half.frame_time) == (4, 15.0, 1 / 15)
    np.testing.assert_array_equal(half.world()[0], clip.world()[0][::2])
    np.testing.assert_array_equal(clip.world(slice(2, 4))[0], clip.world()[0][2:4])


@pytest.mark.parametrize("scheme", SCHEMES)
def test_names_are_22_and_plain(scheme: str, tmp_path: Path) -> None:
    names = joint_names(scheme)
    assert len(set(names)) == 22
    assert motion_clip(random_motion(1), scheme).names == names
    assert scheme == "canonical" or not set(names) & {"l_hip", "r_hip"}


def test_unity_finds_a_side_and_a_word_in_every_limb() -> None:
    """Unity's mapper looks for these in a bone's name, and for none of them in its parent's."""
    words = {"hip": ("up", "thigh"), "knee": ("lo", "calf", "knee", "shin"),
             "ankle": ("foot", "ankle"), "foot": ("toe",), "elbow": ("lo", "fore", "elbow"),
             "collar": ("shoulder", "collar", "clavicle"), "shoulder": ("up",),
             "wrist": ("hand", "wrist"), "neck": ("neck",), "head": ("head",)}  # fmt: skip
    names, parents = joint_names("unity"), canonical_rig().parents
    for joint, ours in enumerate(JOINT_NAMES):
        side = {"l_": "left", "r_": "right"}.get(ours[:2])
        wanted = words.get(ours[2:] if side else ours, ())
        name = names[joint].lower()
        assert side is None or side in name
        assert not wanted or any(word in name for word in wanted), name
        above = names[parents[joint]].lower() if joint else ""
        assert not any(word in above for word in wanted), name
        if side is None:
            assert "left" not in name
            assert "right" not in name


def test_unknown_names_are_refused() -> None:
    with pytest.raises(UsageError, match="canonical, mixamo, unity, unreal"):
        joint_names("daz")
