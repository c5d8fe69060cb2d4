"""Foot lock: held feet, kept knees and soles, no stretched legs, nothing else touched."""

from dataclasses import replace

import numpy as np
import pytest
import torch
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.spatial.transform import Rotation

from src.shared.metrics.physical import support_speed
from src.shared.metrics.seams import ACCELERATION, JERK, body_quantities
from src.shared.motion.motion import Motion
from src.shared.motion.postprocess.contacts import GIVE
from src.shared.motion.postprocess.footskate import (
    MAX_STRETCH,
    lock_carried_feet,
    lock_feet,
    two_bone_ik,
)
from src.shared.motion.rotations import axis_angle_to_matrix, matrix_to_quaternion
from src.shared.motion.skeleton import (
    JOINT_INDEX,
    LEG_LENGTH,
    NUM_JOINTS,
    PARENTS,
    REST_FOOT_HEIGHT,
    REST_PELVIS_HEIGHT,
    canonical_skeleton,
)

FPS = 30.0
BALLS = [JOINT_INDEX["l_foot"], JOINT_INDEX["r_foot"]]
LEGS = [JOINT_INDEX[f"{side}_{name}"] for side in "lr" for name in ("hip", "knee", "ankle")]


def about_x(angle: np.ndarray) -> np.ndarray:
    zero = np.zeros_like(angle)
    return np.stack((np.cos(angle / 2), np.sin(angle / 2), zero, zero), -1)


def sliding_walk(frames: int = 60, slide: float = 0.3) -> Motion:
    """Steps in place while the pelvis drifts forward: whichever foot is down slides with it."""
    time = np.arange(frames) / FPS
    quaternions = np.zeros((frames, NUM_JOINTS, 4), dtype=np.float32)
    quaternions[..., 0] = 1
    contacts = np.zeros((frames, 2), dtype=np.float32)
    for index, side in enumerate("lr"):
        phase = 2 * np.pi * (time + 0.5 * index)
        bend = 0.35 + 0.5 * np.clip(np.sin(phase), 0, None)
        quaternions[:, JOINT_INDEX[f"{side}_hip"]] = about_x(-bend)
        quaternions[:, JOINT_INDEX[f"{side}_knee"]] = about_x(2 * bend)
        quaternions[:, JOINT_INDEX[f"{side}_ankle"]] = about_x(-bend)
        contacts[:, index] = np.sin(phase) <= 0
    drop = LEG_LENGTH * (1 - np.cos(0.35))
    path = np.stack(
        (0 * time, np.full(frames, REST_PELVIS_HEIGHT - drop), slide * time), -1
    )  # fmt: skip
    return Motion(quaternions, path.astype(np.float32), contacts)


def contact_speed(motion: Motion) -> float:
    """Mean horizontal speed in cm/s of the balls of the feet between frames in contact."""
    balls = motion.positions()[:, BALLS][..., [0, 2]]
    speed = np.linalg.norm(np.diff(balls, axis=0), axis=-1) * motion.fps
    down = motion.contacts > 0.5
    return float(100 * speed[down[1:] & down[:-1]].mean())


def test_a_sliding_walk_stops_sliding() -> None:
    motion = sliding_walk()
    locked = lock_feet(motion)
    assert contact_speed(motion) == pytest.approx(30, rel=0.05)
    assert contact_speed(locked) == pytest.approx(100 * GIVE, rel=0.05)
    np.testing.assert_array_equal(locked.root_position, motion.root_position)
    others = [joint for joint in range(NUM_JOINTS) if joint not in LEGS]
    np.testing.assert_array_equal(locked.quaternions[:, others], motion.quaternions[:, others])
    assert np.abs(np.linalg.norm(locked.quaternions, axis=-1) - 1).max() < 1e-5


def test_feet_keep_their_world_rotation_and_height() -> None:
    motion = sliding_walk()
    locked = lock_feet(motion)
    for name in ("l_ankle", "r_ankle", "l_foot", "r_foot"):
        joint = JOINT_INDEX[name]
        np.testing.assert_allclose(
            locked.global_rotations()[:, joint], motion.global_rotations()[:, joint], atol=1e-5
        )
    before, after = motion.positions()[:, BALLS, 1], locked.positions()[:, BALLS, 1]
    np.testing.assert_allclose(after, before, atol=1e-3)


def test_the_correction_fades_in_and_out() -> None:
    motion = sliding_walk()
    shift = (lock_feet(motion).positions() - motion.positions())[:, BALLS]
    jumps = np.linalg.norm(np.diff(shift, axis=0), axis=-1)
    assert np.linalg.norm(shift, axis=-1).max() > 0.05
    assert jumps.max() < 0.04  # a hard start would jump by 0.07
    bends = np.linalg.norm(np.diff(shift, n=2, axis=0), axis=-1)
    assert bends.max() < 0.02  # m a frame²: 18 m/s², real knees and ankles reach 56


def test_knees_stay_in_front() -> None:
    motion = sliding_walk()
    locked = lock_feet(motion)
    for side in "lr":
        hip, knee, ankle = (JOINT_INDEX[f"{side}_{name}"] for name in ("hip", "knee", "ankle"))
        for positions in (motion.positions(), locked.positions()):
            middle = (positions[:, hip] + positions[:, ankle]) / 2
            assert (positions[:, knee, 2] - middle[:, 2] > 0.1).all()
            assert np.abs(positions[:, knee, 0] - positions[:, hip, 0]).max() < 1e-3


def test_in_the_air_nothing_changes() -> None:
    motion = sliding_walk()
    up = motion.root_position + np.float32([0, 0.4, 0])
    airborne = replace(motion, contacts=np.zeros_like(motion.contacts), root_position=up)
    np.testing.assert_array_equal(lock_feet(airborne).quaternions, motion.quaternions)
    claimed = replace(motion, root_position=up)  # nobody stands on air
    np.testing.assert_array_equal(lock_feet(claimed).quaternions, motion.quaternions)
    assert not lock_feet(claimed).contacts.any()


def test_who_claims_no_contact_is_held_all_the_same() -> None:
    motion = sliding_walk()
    silent = lock_feet(replace(motion, contacts=np.zeros_like(motion.contacts)))
    assert silent.contacts.any(1).mean() > 0.95
    assert contact_speed(silent) == pytest.approx(100 * GIVE, rel=0.05)


def test_a_foot_that_stands_is_left_alone() -> None:
    motion = sliding_walk(slide=0.0)
    np.testing.assert_array_equal(lock_feet(motion).quaternions, motion.quaternions)


def test_a_foot_in_contact_is_lifted_out_of_the_floor() -> None:
    motion = sliding_walk(slide=0.0)
    sunk = replace(motion, root_position=motion.root_position - np.float32([0, 0.03, 0]))
    heights = lock_feet(sunk).positions()[:, BALLS, 1]
    assert sunk.positions()[:, BALLS, 1][motion.contacts > 0.5].max() < REST_FOOT_HEIGHT - 0.02
    np.testing.assert_allclose(heights[motion.contacts > 0.5], REST_FOOT_HEIGHT, atol=1e-4)


def test_legs_never_stretch() -> None:
    """Feet claimed to be in contact all along while the pelvis runs away from them."""
    motion = sliding_walk(slide=2.0)
    glued = replace(motion, contacts=np.ones_like(motion.contacts))
    positions = lock_feet(glued).positions()
    assert np.isfinite(positions).all()
    original = motion.positions()
    for side in "lr":
        hip, ankle = JOINT_INDEX[f"{side}_hip"], JOINT_INDEX[f"{side}_ankle"]
        reach = np.linalg.norm(positions[:, ankle] - positions[:, hip], axis=-1)
        before = np.linalg.norm(original[:, ankle] - original[:, hip], axis=-1)
        assert (reach <= np.maximum(before, MAX_STRETCH * LEG_LENGTH) + 1e-5).all()


@pytest.mark.parametrize("frames", [1, 2, 5])
def test_short_motions_work(frames: int) -> None:
    motion = sliding_walk(frames)
    assert lock_feet(motion).quaternions.shape == (frames, NUM_JOINTS, 4)


@settings(deadline=None, max_examples=40)
@given(
    angles=st.lists(st.floats(-0.8, 0.8), min_size=3, max_size=3),
    knee=st.floats(0.0, 2.0),
    goal=st.tuples(st.floats(-0.3, 0.3), st.floats(-0.75, -0.3), st.floats(-0.3, 0.3)),
)
def test_ik_reaches_what_it_can(
    angles: list[float], knee: float, goal: tuple[float, float, float]
) -> None:
    offsets = torch.as_tensor(canonical_skeleton().offsets, dtype=torch.float64)
    upper, lower = offsets[JOINT_INDEX["l_knee"]], offsets[JOINT_INDEX["l_ankle"]]
    thigh = torch.from_numpy(Rotation.from_euler("YXZ", angles).as_matrix())[None]
    shin = thigh @ axis_angle_to_matrix(0, torch.tensor(knee, dtype=torch.float64))
    hip = torch.tensor([[0.1, 0.9, 0.0]], dtype=torch.float64)
    target = hip + torch.tensor([goal], dtype=torch.float64)
    new_thigh, new_shin = two_bone_ik(hip, thigh, shin, upper, lower, target)
    ankle = hip + new_thigh @ upper + new_shin @ lower
    straight = MAX_STRETCH * LEG_LENGTH
    if 0.1 < float((target - hip).norm()) < straight:
        assert float((ankle - target).norm()) < 2e-3
    for matrix in (new_thigh, new_shin):
        torch.testing.assert_close(
            matrix @ matrix.transpose(-1, -2), torch.eye(3, dtype=torch.float64)[None]
        )
    again_thigh, again_shin = two_bone_ik(hip, new_thigh, new_shin, upper, lower, ankle)
    torch.testing.assert_close(
        matrix_to_quaternion(again_thigh).abs(),
        matrix_to_quaternion(new_thigh).abs(),
        rtol=0,
        atol=1e-3,
    )
    torch.testing.assert_close(again_shin, new_shin, rtol=0, atol=2e-3)


@settings(deadline=None, max_examples=12)
@given(slide=st.floats(-0.4, 0.4), sink=st.floats(-0.03, 0.02), seed=st.integers(0, 99))
def test_held_feet_rest_and_bones_keep_their_length(slide: float, sink: float, seed: int) -> None:
    motion = sliding_walk(slide=slide)
    noise = np.random.default_rng(seed).normal(0, 0.02, 3).astype(np.float32)
    root = motion.root_position + noise * [1, 0, 1] + np.float32([0, sink, 0])
    moved = replace(motion, root_position=root.astype(np.float32))
    locked = lock_feet(moved)
    positions = locked.positions().astype(np.float64)
    for side, ball in enumerate(BALLS):
        down = locked.contacts[:, side] > 0.5
        steps = np.linalg.norm(np.diff(positions[:, ball][:, [0, 2]], axis=0), axis=-1)
        standing = steps[down[1:] & down[:-1]]
        assert standing.sum() <= 1.1 * len(standing) * GIVE / motion.fps
        assert positions[:, ball, 1].min() > REST_FOOT_HEIGHT - 1e-3
    bones = positions[:, 1:] - positions[:, list(PARENTS[1:])]
    lengths = np.linalg.norm(canonical_skeleton().offsets[1:], axis=-1)
    np.testing.assert_allclose(
        np.linalg.norm(bones, axis=-1), np.broadcast_to(lengths, bones.shape[:2]), atol=1e-5
    )


def test_kept_legs_stay() -> None:
    motion = sliding_walk()
    kept = np.zeros((60, 2), dtype=bool)
    kept[:20], kept[:, 0] = True, True
    locked = lock_feet(motion, kept=kept)
    np.testing.assert_array_equal(locked.quaternions[:20], motion.quaternions[:20])
    left = [JOINT_INDEX[f"l_{name}"] for name in ("hip", "knee", "ankle", "foot")]
    np.testing.assert_array_equal(locked.quaternions[:, left], motion.quaternions[:, left])
    assert (locked.quaternions[20:] != motion.quaternions[20:]).any()


# ---------------------------------------------------------------- carried bodies

WHOLE_LEGS = [
    JOINT_INDEX[f"{side}_{name}"] for side in "lr" for name in ("hip", "knee", "ankle", "foot")
]
OTHERS = [joint for joint in JOINT_INDEX.values() if joint not in WHOLE_LEGS]


def slide(motion: Motion) -> float:
    """Mean speed of the lower foot, m/s."""
    return float(support_speed(motion.positions().astype(np.float64), motion.fps).mean())


def test_feet_slide_as_little_and_legs_move_more_smoothly_than_after_one_lock() -> None:
    motion = sliding_walk(150, slide=0.9)
    once, carried = lock_feet(motion), lock_carried_feet(motion)
    assert slide(motion) > 0.5
    assert slide(carried) < 0.25 * slide(motion) and slide(carried) < 1.2 * slide(once)
    for quantity in (ACCELERATION, JERK):
        rough, smooth = (np.percentile(body_quantities(m)[quantity], 99) for m in (once, carried))
        assert smooth < 0.9 * rough


def test_nothing_but_the_legs_is_touched() -> None:
    motion = sliding_walk(90, slide=0.9)
    carried = lock_carried_feet(motion)
    np.testing.assert_array_equal(carried.root_position, motion.root_position)
    np.testing.assert_array_equal(carried.quaternions[:, OTHERS], motion.quaternions[:, OTHERS])
    norms = np.linalg.norm(carried.quaternions, axis=-1)
    np.testing.assert_allclose(norms, 1, atol=1e-5)
    assert ((carried.quaternions[1:] * carried.quaternions[:-1]).sum(-1) > 0).all()


def test_kept_legs_of_carried_bodies_stay() -> None:
    motion = sliding_walk(90, slide=0.9)
    kept = np.zeros((90, 2), dtype=bool)
    kept[:40, 0] = True
    carried = lock_carried_feet(motion, kept=kept)
    np.testing.assert_array_equal(
        carried.quaternions[:40, WHOLE_LEGS[:4]], motion.quaternions[:40, WHOLE_LEGS[:4]]
    )
    np.testing.assert_array_equal(carried.contacts[:40, 0], motion.contacts[:40, 0])
    assert not np.array_equal(carried.quaternions[40:], motion.quaternions[40:])
