"""Axes found from the motion alone: they are those that are known, and any rest pose will do."""

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from src.shared.data.retarget.autodetection import (
    calibrated_axes,
    detect_unit,
    detect_up,
    rest_frame,
    upright,
)
from src.shared.data.retarget.mapping import SkeletonMapping, find_mapping, load_mappings
from src.shared.data.retarget.to_canonical import _AIM, leg_length, retarget
from src.shared.data.synthetic.clips import generate_clip, sample_specs
from src.shared.errors import UsageError
from src.shared.formats.readers.bvh import read_bvh
from src.shared.formats.rig import (
    RigClip,
    canonical_rig,
    compose,
    quaternions_to_matrices,
    rooted_clip,
)
from src.shared.motion.motion import Motion
from src.shared.motion.skeleton import JOINT_NAMES, PARENTS, canonical_skeleton

OURS = load_mappings()[0]


@pytest.fixture(scope="module")
def walk() -> Motion:
    return generate_clip(sample_specs(40, seed=3)[17], seed=5)


def turned(motion: Motion, turns: np.ndarray, world: np.ndarray) -> RigClip:
    """The same motion on joints whose axes are `turns` [22,3,3], in a world turned by [3,3]."""
    local = quaternions_to_matrices(motion.quaternions)
    places = np.repeat(canonical_skeleton().offsets[None].astype(float), len(local), 0)
    places[:, 0] = motion.root_position
    rotations = world @ compose(PARENTS, local, places)[1] @ turns
    above = np.stack([np.tile(np.eye(3), (len(local), 1, 1)),
                      *(rotations[:, p] for p in PARENTS[1:])], 1)  # fmt: skip
    offsets = np.einsum("jba,jb->ja", turns[list(PARENTS)], canonical_skeleton().offsets)
    rig, local = replace(canonical_rig(), offsets=offsets), np.swapaxes(above, -1, -2) @ rotations
    return rooted_clip(rig, local, motion.root_position @ world.T, motion.fps)


@pytest.mark.parametrize("up", ["Y", "Z", "-Z", "X", "-Y"])
def test_another_up_axis_is_the_same_motion(walk: Motion, up: str) -> None:
    clip = turned(walk, np.tile(np.eye(3), (22, 1, 1)), upright(up).T)
    assert detect_up(clip, OURS) == (up, True)
    found = retarget(clip, OURS, up=up, metres=1.0, ground=False)
    np.testing.assert_allclose(found.positions(), walk.positions(), atol=1e-4)


def test_a_rest_pose_that_stands_along_another_axis_needs_no_profile(walk: Motion) -> None:
    """Z up everywhere, as some exporters write it: the rest pose and the world."""
    turn = upright("Z")
    clip = turned(walk, np.tile(turn, (22, 1, 1)), turn.T)
    found = retarget(clip, OURS, up="Z", metres=1.0, ground=False)
    np.testing.assert_allclose(found.global_rotations(), walk.global_rotations(), atol=1e-4)


def test_axes_come_from_the_motion_where_the_rest_pose_is_none(walk: Motion) -> None:
    """Every bone along +x at rest, as LaFAN1 has it: left limbs, right limbs and spine alike."""
    along = np.zeros((22, 3, 3))
    offsets = canonical_skeleton().offsets
    for joint, name in enumerate(JOINT_NAMES):
        child = _AIM.get(name)
        bone = offsets[JOINT_NAMES.index(child)] if child else np.array([0, 1.0, 0])
        x = np.eye(3)[np.argmax(np.abs(bone))] * np.sign(bone[np.argmax(np.abs(bone))])
        y = np.array([0, 0, 1.0]) if abs(x[2]) < 0.5 else np.array([0, 1.0, 0])
        along[joint] = np.stack([x, y, np.cross(x, y)], -1)
    clip = turned(walk, along, np.eye(3))
    assert rest_frame(clip, OURS) is None
    found = retarget(clip, OURS, metres=1.0, ground=False)
    one, other = (Rotation.from_matrix(motion.global_rotations().reshape(-1, 3, 3))
                  for motion in (found, walk))  # fmt: skip
    turns = (one.inv() * other).magnitude()
    worst = dict(zip(JOINT_NAMES, turns.reshape(-1, 22).max(0), strict=True))
    for name in ("pelvis", "spine1", "spine3", "l_hip", "r_knee", "l_shoulder", "r_elbow", "head"):
        assert np.degrees(worst[name]) < 1, name


@pytest.mark.slow
def test_bandais_axes_are_found_without_its_profile(bandai: Path) -> None:
    """The profile's axes were derived by hand; the motion tells the same."""
    right = []
    for path in sorted(bandai.rglob("*.bvh"))[::150]:
        clip = read_bvh(path)
        mapping = find_mapping(clip.names, load_mappings())
        found = calibrated_axes(clip, mapping, _AIM)
        right += [np.allclose(found[ours], mapping.axes_of(theirs), atol=1e-6)
                  for ours, theirs in mapping.joints.items()]  # fmt: skip
    assert np.mean(right) > 0.97


def test_axes_of_a_profile_are_not_needed_by_a_body_that_stands(walk: Motion) -> None:
    clip = turned(walk, np.tile(np.eye(3), (22, 1, 1)), np.eye(3))
    odd = SkeletonMapping.model_validate(
        {"name": "x", "joints": OURS.joints, "axes": {"l_knee": ["-Y", "+X", "+Z"]}}
    )
    first, second = (retarget(clip, mapping, metres=1.0) for mapping in (OURS, odd))
    np.testing.assert_array_equal(first.quaternions, second.quaternions)


def test_units_are_guessed_by_the_legs(walk: Motion) -> None:
    clip = turned(walk, np.tile(np.eye(3), (22, 1, 1)), np.eye(3))
    legs = leg_length(clip, OURS)
    units = {
        "m": 1,
        "cm": 100,
        "mm": 1000,
        "in": 1 / 0.0254,
        "ft": 1 / 0.3048,
        "cmu": 0.45 / 0.0254,
    }
    assert {unit: detect_unit(legs * size) for unit, size in units.items()} == {u: u for u in units}


@pytest.mark.parametrize("value", ["W", "", "YY", "up", "+-Y"])
def test_an_unknown_axis_is_refused(value: str) -> None:
    with pytest.raises(UsageError, match="--up"):
        upright(value)
