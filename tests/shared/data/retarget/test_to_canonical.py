"""Retargeting: world directions and twists survive, whatever the source's axes and names."""

from pathlib import Path

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from src.shared.data.retarget.mapping import SkeletonMapping, find_mapping, load_mappings
from src.shared.data.retarget.to_canonical import rest_corrections, retarget
from src.shared.data.synthetic.clips import generate_clip, sample_specs
from src.shared.errors import UsageError, UserError
from src.shared.formats.readers.bvh import BvhClip, read_bvh
from src.shared.formats.writers.bvh import write_bvh
from src.shared.motion.skeleton import JOINT_INDEX, canonical_skeleton

OURS = load_mappings()[0]


@pytest.fixture(scope="module")
def clip(tmp_path_factory: pytest.TempPathFactory) -> BvhClip:
    """A synthetic walk, written and read back."""
    path = tmp_path_factory.mktemp("bvh") / "walk.bvh"
    write_bvh(generate_clip(sample_specs(40, seed=3)[17], seed=5), path)
    return read_bvh(path)


def rebased(clip: BvhClip, seed: int, scale: float) -> tuple[BvhClip, SkeletonMapping]:
    """The same motion with other joint names, another unit, and other local axes per joint."""
    rng = np.random.default_rng(seed)
    signs = [m for m in Rotation.create_group("O").as_matrix()]
    turns = {name: signs[rng.integers(len(signs))] for name in clip.names}
    positions, world = clip.world()
    new_world = np.stack([world[:, j] @ turns[n] for j, n in enumerate(clip.names)], 1)
    parts = []
    offsets = clip.offsets.copy()
    for joint, parent in enumerate(clip.parents):
        above = np.eye(3)[None] if parent < 0 else new_world[:, parent]
        local = np.swapaxes(above, -1, -2) @ new_world[:, joint]
        angles = Rotation.from_matrix(local).as_euler("XZY", degrees=True)
        if parent < 0:
            parts.append(positions[:, joint] * scale)
        else:
            offsets[joint] = turns[clip.names[parent]].T @ clip.offsets[joint]
        parts.append(angles)
    names = tuple(f"J_{name}" for name in clip.names)
    channels = ("Xrotation", "Zrotation", "Yrotation")
    first = ("Xposition", "Yposition", "Zposition", *channels)
    moved = BvhClip(
        names=names,
        parents=clip.parents,
        offsets=offsets * scale,
        end_sites=(),
        channels=(first, *([channels] * (len(names) - 1))),
        rotation_orders=("XZY",) * len(names),
        frame_time=clip.frame_time,
        values=np.concatenate(parts, 1),
    )

    def axis(column: np.ndarray) -> str:
        index = int(np.argmax(np.abs(column)))
        return ("+" if column[index] > 0 else "-") + "XYZ"[index]

    mapping = SkeletonMapping.model_validate(
        {
            "name": "rebased",
            "joints": {ours: f"J_{theirs}" for ours, theirs in OURS.joints.items()},
            "axes": {f"J_{n}": [axis(column) for column in turn.T] for n, turn in turns.items()},
        }
    )
    return moved, mapping


@pytest.mark.parametrize("seed", range(4))
def test_other_axes_names_and_units_give_the_same_motion(clip: BvhClip, seed: int) -> None:
    moved, mapping = rebased(clip, seed, scale=0.0254 / 2.3)
    ours, theirs = retarget(clip, OURS), retarget(moved, mapping)
    np.testing.assert_allclose(theirs.positions(), ours.positions(), atol=2e-4)
    np.testing.assert_allclose(theirs.global_rotations(), ours.global_rotations(), atol=2e-3)


def check_directions_and_twists(clip: BvhClip, mapping: SkeletonMapping) -> None:
    motion = retarget(clip, mapping, fps=1 / clip.frame_time)
    positions, world = clip.world()
    positions, world = positions[-motion.num_frames :], world[-motion.num_frames :]
    index = {name: i for i, name in enumerate(clip.names)}
    offsets = canonical_skeleton().offsets
    rotations = motion.global_rotations()
    corrections = rest_corrections(clip, mapping)
    for ours, theirs in mapping.joints.items():
        twist = np.swapaxes(world[:, index[theirs]], -1, -2) @ rotations[:, JOINT_INDEX[ours]]
        expected = np.broadcast_to(corrections[ours], twist.shape)
        np.testing.assert_allclose(twist, expected, atol=1e-4)
    bones = (
        ("l_hip", "l_knee"),
        ("r_knee", "r_ankle"),
        ("l_elbow", "l_wrist"),
        ("r_shoulder", "r_elbow"),
        ("neck", "head"),
        ("l_ankle", "l_foot"),
    )
    for joint, child in bones:
        a, b = (index[mapping.joints[name]] for name in (joint, child))
        theirs_bone = positions[:, b] - positions[:, a]
        ours_bone = rotations[:, JOINT_INDEX[joint]] @ offsets[JOINT_INDEX[child]]
        cosine = (theirs_bone * ours_bone).sum(-1) / (
            np.linalg.norm(theirs_bone, axis=-1) * np.linalg.norm(ours_bone, axis=-1)
        )
        assert cosine.min() > 1 - 1e-4, (joint, child)


def test_directions_and_twists_of_our_own_file(clip: BvhClip) -> None:
    check_directions_and_twists(clip, OURS)


@pytest.mark.slow
@pytest.mark.parametrize("pattern", ["*walk-turn-left_normal_00[1-3].bvh", "*kick*.bvh"])
def test_directions_and_twists_of_bandai(bandai: Path, pattern: str) -> None:
    for path in sorted(bandai.rglob(pattern)):
        clip = read_bvh(path)
        check_directions_and_twists(clip, find_mapping(clip.names, load_mappings()))


def test_directions_and_twists_of_cmu(cmu: Path) -> None:
    for name in ("02/02_01.bvh", "05/05_02.bvh"):
        clip = read_bvh(cmu / name).every(4)
        check_directions_and_twists(clip, find_mapping(clip.names, load_mappings()))


def test_a_source_at_rest_stands_in_our_rest_pose(cmu: Path) -> None:
    """Derived by hand: CMU's rest is a T-pose in world axes, legs 20° apart, feet level."""
    clip = read_bvh(cmu / "02/02_01.bvh").every(4)
    values = clip.values.copy()
    values[:, 3:] = 0.0
    rest = BvhClip(**{**vars(clip), "values": values})
    motion = retarget(rest, find_mapping(rest.names, load_mappings()))
    world = motion.global_rotations()[0]
    angle = {
        name: np.degrees(np.arccos(np.clip((np.trace(world[index]) - 1) / 2, -1, 1)))
        for name, index in JOINT_INDEX.items()
    }
    assert all(angle[name] < 1 for name in ("pelvis", "spine3", "head", "l_wrist", "r_wrist"))
    assert all(angle[name] < 6 for name in ("spine1", "neck", "l_elbow", "r_elbow", "l_shoulder"))
    assert 15 < angle["l_hip"] < 25 and 15 < angle["r_hip"] < 25
    at = motion.positions()[0] - motion.root_position[0]
    assert at[JOINT_INDEX["l_wrist"]][0] > 0.6 and at[JOINT_INDEX["r_wrist"]][0] < -0.6
    assert at[JOINT_INDEX["l_foot"]][2] > at[JOINT_INDEX["l_ankle"]][2] + 0.1


def test_the_floor_is_under_the_feet(clip: BvhClip) -> None:
    balls = retarget(clip, OURS).positions()[:, [10, 11], 1]
    assert balls.min() > -0.02 and balls.min() < 0.05


def test_an_unknown_skeleton_names_what_is_missing() -> None:
    names = tuple(name for name in OURS.joints.values() if name != "l_knee")
    with pytest.raises(UserError, match=r"misses l_knee \(l_knee\).*--mapping"):
        find_mapping(names, (OURS,))


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("profiles: [{name: x, joints: {pelvis: Hips}}]", "'l_hip' is not mapped"),
        ("profiles: [{name: x, joints: {pelviss: Hips}}]", "unknown joint 'pelviss'"),
        ("profiles: [{nam: x, joints: {}}]", "nam"),
        ("profiles: 3", "profiles"),
    ],
)
def test_a_faulty_mapping_file_is_named(tmp_path: Path, text: str, message: str) -> None:
    path = tmp_path / "mapping.yaml"
    path.write_text(text)
    with pytest.raises(UsageError, match=message) as error:
        load_mappings(path)
    assert str(path) in str(error.value) and "\n" not in str(error.value)


def test_left_handed_axes_are_refused(tmp_path: Path) -> None:
    joints = dict(OURS.joints)
    path = tmp_path / "mapping.yaml"
    path.write_text(f"profiles: [{{name: x, joints: {joints}, axes: {{pelvis: [+X, +Y, -Z]}}}}]")
    with pytest.raises(UsageError, match="not right-handed"):
        load_mappings(path)


def test_a_calibration_frame_is_dropped(clip: BvhClip) -> None:
    values = clip.values.copy()
    values[0, 3:] += 40.0  # degrees: another pose, then the motion begins
    jumping = BvhClip(**{**vars(clip), "values": values})
    assert retarget(jumping, OURS).num_frames == clip.num_frames - 1
    assert retarget(clip, OURS).num_frames == clip.num_frames
