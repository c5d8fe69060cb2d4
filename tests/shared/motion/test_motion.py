"""Skeleton, kinematics, root track, contacts, resampling and mirroring."""

import math

import numpy as np
import pytest
import torch
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.spatial.transform import Rotation, Slerp

from src.shared.motion.features import (
    FORWARD,
    LATERAL,
    ROOT_ROW,
    YAW_RATE,
    Place,
    decode_features,
    encode_features,
    hastened,
    headings,
    mirror_features,
    without_drift,
)
from src.shared.motion.motion import Motion, in_place, resample_motion
from src.shared.motion.postprocess.contacts import detect_contacts
from src.shared.motion.rotations import (
    axis_angle_to_matrix,
    global_to_local,
    heading_angle,
    local_to_global,
    yaw_to_matrix,
)
from src.shared.motion.skeleton import (
    JOINT_INDEX,
    JOINT_NAMES,
    MIRROR,
    NUM_JOINTS,
    PARENTS,
    REST_PELVIS_HEIGHT,
    canonical_skeleton,
)
from tests.shared.motion.mirrored import mirror_motion


def random_motion(seed: int = 0, frames: int = 40, fps: float = 30.0) -> Motion:
    """A smooth random motion that turns and travels."""
    rng = np.random.default_rng(seed)
    knots = Rotation.random(5 * NUM_JOINTS, rng=rng).as_rotvec().reshape(5, NUM_JOINTS, 3) * 0.3
    knots[:, 0] *= 0.3
    knots[:, 0, 1] = np.cumsum(rng.normal(0, 1.0, 5))
    grid, times = np.linspace(0, 1, 5), np.linspace(0, 1, frames)
    vectors = np.stack(
        [np.interp(times, grid, column) for column in knots.reshape(5, -1).T], -1
    ).reshape(-1, 3)
    q = Rotation.from_rotvec(vectors).as_quat()[:, [3, 0, 1, 2]].reshape(frames, NUM_JOINTS, 4)
    path = np.cumsum(rng.normal(0, 0.02, (frames, 3)), 0) + [0, 0.9, 0]
    contacts = (rng.random((frames, 2)) < 0.5).astype(np.float32)
    return Motion(q.astype(np.float32), path.astype(np.float32), contacts, fps)


def rest_motion(frames: int = 10) -> Motion:
    q = np.zeros((frames, NUM_JOINTS, 4), np.float32)
    q[..., 0] = 1
    path = np.tile(np.float32([0, REST_PELVIS_HEIGHT, 0]), (frames, 1))
    return Motion(q, path, np.ones((frames, 2), np.float32))


def test_rest_pose_stands_on_the_floor_facing_z() -> None:
    positions = rest_motion().positions()[0]
    at = {name: positions[index] for name, index in JOINT_INDEX.items()}
    assert at["l_foot"][1] == pytest.approx(0.02, abs=1e-5)
    assert at["l_foot"][2] > at["l_ankle"][2] + 0.1
    assert at["l_wrist"][0] > 0.6 > -0.6 > at["r_wrist"][0]
    assert 1.4 < at["head"][1] < 1.7
    np.testing.assert_allclose(
        canonical_skeleton().offsets[list(MIRROR)] * [-1, 1, 1], canonical_skeleton().offsets
    )
    assert len(JOINT_NAMES) == NUM_JOINTS == 22
    assert all(parent < joint for joint, parent in enumerate(PARENTS))


@given(st.integers(0, 10_000))
@settings(max_examples=15, deadline=None)
def test_kinematics_agree_with_a_plain_loop(seed: int) -> None:
    motion = random_motion(seed, frames=3)
    offsets = canonical_skeleton().offsets
    for frame, positions in enumerate(motion.positions()):
        world: list[Rotation] = []
        for joint, parent in enumerate(PARENTS):
            local = Rotation.from_quat(motion.quaternions[frame, joint][[1, 2, 3, 0]])
            if parent < 0:
                world.append(local)
                expected = motion.root_position[frame]
            else:
                world.append(world[parent] * local)
                expected = positions[parent] + world[parent].apply(offsets[joint])
            np.testing.assert_allclose(positions[joint], expected, atol=1e-5)


def test_local_and_global_are_inverse() -> None:
    world = torch.tensor(random_motion(1).global_rotations())
    local = global_to_local(world, PARENTS)
    torch.testing.assert_close(local_to_global(local, PARENTS), world, atol=1e-5, rtol=0)


@given(st.integers(0, 10_000))
@settings(max_examples=15, deadline=None)
def test_features_give_the_motion_back(seed: int) -> None:
    motion = random_motion(seed)
    features = encode_features(motion)
    assert features.shape == (40, NUM_JOINTS + 1, 6) and features.dtype == torch.float32
    first = torch.tensor(motion.global_rotations()[0, 0])
    from src.shared.motion.rotations import heading_angle

    again = decode_features(
        features,
        place=Place(*motion.root_position[0, [0, 2]].tolist(), float(heading_angle(first))),
    )
    np.testing.assert_allclose(again.root_position, motion.root_position, atol=1e-4)
    np.testing.assert_allclose(again.positions(), motion.positions(), atol=2e-4)
    np.testing.assert_array_equal(again.contacts, motion.contacts)


def test_features_forget_where_the_motion_starts_and_faces() -> None:
    motion = random_motion(4)
    turned = decode_features(encode_features(motion), place=Place(3, -2, 2.0))
    torch.testing.assert_close(encode_features(turned), encode_features(motion), atol=2e-4, rtol=0)


def test_root_row_signs() -> None:
    """Walking towards +Z is forward, towards +X is left; growing yaw turns left."""
    motion = rest_motion(31)
    time = np.arange(31) / 30
    path = motion.root_position.copy()
    path[:, 2] += time
    path[:, 0] += 0.5 * time
    q = motion.quaternions.copy()
    features = encode_features(Motion(q, path, motion.contacts))
    assert features[0, ROOT_ROW, :4].tolist() == pytest.approx([1, 0.5, REST_PELVIS_HEIGHT, 0])
    q[:, 0, 0], q[:, 0, 2] = np.cos(time / 2), np.sin(time / 2)
    features = encode_features(Motion(q, path, motion.contacts))
    assert features[5, ROOT_ROW, 3].item() == pytest.approx(1.0, abs=1e-3)


@given(st.integers(0, 10_000))
@settings(max_examples=15, deadline=None)
def test_mirroring(seed: int) -> None:
    motion = random_motion(seed)
    mirrored = mirror_motion(motion)
    expected = motion.positions()[:, list(MIRROR)] * np.float32([-1, 1, 1])
    np.testing.assert_allclose(mirrored.positions(), expected, atol=1e-5)
    np.testing.assert_allclose(mirror_motion(mirrored).quaternions, motion.quaternions)
    torch.testing.assert_close(
        mirror_features(encode_features(motion)), encode_features(mirrored), atol=1e-4, rtol=0
    )


def test_resampling_agrees_with_scipy_slerp() -> None:
    motion = random_motion(7, frames=61, fps=120.0)
    slow = resample_motion(motion, 30.0)
    assert slow.num_frames == 16 and slow.fps == 30.0
    np.testing.assert_allclose(slow.root_position, motion.root_position[::4], atol=1e-6)
    odd = resample_motion(motion, 25.0)
    joint = 5
    oracle = Slerp(
        np.arange(61) / 120, Rotation.from_quat(motion.quaternions[:, joint][:, [1, 2, 3, 0]])
    )(np.arange(odd.num_frames) / 25)
    dots = np.abs((oracle.as_quat()[:, [3, 0, 1, 2]] * odd.quaternions[:, joint]).sum(-1))
    assert dots.min() > 1 - 1e-5
    with pytest.raises(ValueError, match="fps"):
        resample_motion(motion, 0)


@pytest.mark.parametrize("frame_time", ["0.03333333", "0.033333"])
def test_a_rounded_frame_time_costs_no_frame(frame_time: str) -> None:
    for frames in (2, 120, 9000):
        motion = random_motion(7, frames=frames, fps=1 / float(frame_time))
        twice = resample_motion(motion, 60.0)
        assert twice.num_frames == 2 * frames - 1
        np.testing.assert_allclose(twice.root_position[-1], motion.root_position[-1], atol=1e-3)


def test_contacts_need_a_low_and_slow_foot() -> None:
    motion = rest_motion(30)
    assert detect_contacts(motion.positions(), 30).min() == 1
    path = motion.root_position.copy()
    path[:, 2] += np.arange(30) * (1.0 / 30)
    moved = Motion(motion.quaternions, path, motion.contacts)
    assert detect_contacts(moved.positions(), 30).max() == 0
    path = motion.root_position + np.float32([0, 0.3, 0])
    moved = Motion(motion.quaternions, path, motion.contacts)
    assert detect_contacts(moved.positions(), 30).max() == 0


def test_in_place_takes_the_travel_only() -> None:
    rng = np.random.default_rng(0)
    quaternions = rng.normal(size=(7, 22, 4)).astype(np.float32)
    contacts = rng.uniform(0, 1, (7, 2)).astype(np.float32)
    motion = Motion(quaternions, rng.normal(size=(7, 3)).astype(np.float32), contacts, 24.0, "a")
    still = in_place(motion)
    assert not still.root_position[:, [0, 2]].any()
    np.testing.assert_array_equal(still.root_position[:, 1], motion.root_position[:, 1])
    assert still.quaternions is motion.quaternions
    assert still.contacts is motion.contacts
    assert (still.fps, still.text) == (24.0, "a")
    assert still.root_position.dtype == np.float32


def test_who_stands_faces_at_the_end_as_at_first() -> None:
    features = torch.zeros(60, ROOT_ROW + 1, 6)
    features[:, ROOT_ROW, YAW_RATE] = torch.linspace(-1, 2, 60)
    kept = without_drift(features, [YAW_RATE])
    assert features[:, ROOT_ROW, YAW_RATE].mean() == pytest.approx(0.5)
    assert kept[:, ROOT_ROW, YAW_RATE].mean() == pytest.approx(0, abs=1e-6)
    assert torch.equal(kept[:, :ROOT_ROW], features[:, :ROOT_ROW])


def test_who_does_not_leave_his_place_ends_where_he_began() -> None:
    features = torch.zeros(60, ROOT_ROW + 1, 6)
    features[:, :ROOT_ROW, [0, 4]] = 1.0
    features[:, ROOT_ROW, FORWARD] = torch.linspace(0, 0.4, 60)
    features[:, ROOT_ROW, LATERAL] = 0.1
    ground = decode_features(without_drift(features, [FORWARD, LATERAL])).root_position[:, [0, 2]]
    assert np.allclose(ground[-1], ground[0], atol=0.01)
    assert np.ptp(ground, axis=0).max() > 0.05


@given(st.integers(2, 60), st.floats(0.3, 3.0), st.integers(0, 100))
def test_what_is_hastened_goes_as_far_in_its_time(frames: int, times: float, seed: int) -> None:
    features = torch.randn(frames, 23, 6, generator=torch.Generator().manual_seed(seed))
    fast = hastened(features, times)
    assert len(fast) == max(1, round(frames / times)) and hastened(features, 1.0) is features
    columns = [FORWARD, LATERAL, YAW_RATE]
    gone = [each[:, ROOT_ROW, columns].double().sum(0) for each in (features, fast)]
    torch.testing.assert_close(gone[1], gone[0], atol=1e-4, rtol=1e-4)
    torch.testing.assert_close(fast[0, :22], features[0, :22])
    assert len(hastened(features, times, 17)) == 17
    if len(fast) > 1:
        torch.testing.assert_close(fast[-1, :22], features[-1, :22])  # no step to what follows


@pytest.mark.parametrize("axis", [0, 2])  # over the head, and over a side
def test_who_turns_over_turns_evenly_about_the_vertical(axis: int) -> None:
    """The twist about +Y goes half round in a frame or two where a pelvis is upside down."""
    frames = 40
    angle = torch.linspace(0, 2 * math.pi, frames)
    wobble = axis_angle_to_matrix(2 - axis, 0.3 * torch.sin(angle / 2))
    over = yaw_to_matrix(torch.full((frames,), 0.7)) @ axis_angle_to_matrix(axis, angle) @ wobble
    told = headings(over)
    assert (told - 0.7).abs().max() < 0.5
    assert told.diff().abs().max() < 0.15
    twists = np.unwrap(heading_angle(over).numpy())
    assert np.abs(np.diff(twists)).max() > 0.5
    assert torch.equal(headings(over[:0]), torch.zeros(0))
    upside = over[18:22]  # nobody can say: as they are
    np.testing.assert_allclose(headings(upside), np.unwrap(heading_angle(upside).numpy()))
