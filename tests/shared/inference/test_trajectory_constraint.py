"""A path as a constraint is the inverse of walking along it."""

import numpy as np
import torch
from hypothesis import given
from hypothesis import strategies as st

from src.shared.inference.trajectory_constraint import pin, root_error, start_of, untwisted
from src.shared.motion.root_track import LEFT_CONTACT, ROOT_ROW, decode_features
from src.shared.motion.rotations import (
    axis_angle_to_matrix,
    matrix_to_quaternion,
    matrix_to_rotation_6d,
)
from src.shared.motion.trajectory import MotionTrajectory
from tests.shared.evaluation.tiny_pairs import nod


def wild_path(seed: int, frames: int) -> MotionTrajectory:
    """A pelvis that wanders, turns round more than once, and leans; starts anywhere."""
    rng = np.random.default_rng(seed)
    walk = rng.normal(0, 0.02, (frames, 3)).cumsum(0) + rng.normal(0, 3, 3)
    yaw = rng.normal(0.05, 0.1, frames).cumsum() + rng.uniform(-3, 3)
    lean, roll = rng.normal(0, 0.3, (2, frames))
    turn = (
        axis_angle_to_matrix(1, torch.from_numpy(yaw))
        @ axis_angle_to_matrix(0, torch.from_numpy(lean))
        @ axis_angle_to_matrix(2, torch.from_numpy(roll))
    )
    return MotionTrajectory.from_pose(
        walk, matrix_to_quaternion(turn).numpy(), np.arange(frames) / 60.0
    )


@given(seed=st.integers(0, 10_000), frames=st.integers(2, 90))
def test_a_body_that_keeps_to_the_pins_stands_on_the_path(seed: int, frames: int) -> None:
    path = wild_path(seed, frames)
    motion = decode_features(pin(path, tilt=True).values, **start_of(path))
    error = root_error(motion, path)
    assert error.max_metres < 1e-4 and error.max_degrees < 0.02
    assert error.mean_metres <= error.max_metres and error.mean_degrees <= error.max_degrees
    same = np.abs((motion.quaternions[:, 0] * path.quaternion).sum(-1))
    assert same.min() > 1 - 1e-5  # leaning and rolling too


def test_what_is_known() -> None:
    path = wild_path(1, 40)
    whole, upright = pin(path, beats=np.array([0.5, 1.0]), tilt=True), pin(path)
    assert whole.known[:, ROOT_ROW, :LEFT_CONTACT].all() and whole.known[:, 0].all()
    assert int(whole.known.sum()) == 40 * 10  # four of the root row, six of the pelvis
    assert int(upright.known.sum()) == 40 * 4 and upright.beats is None
    assert whole.beats is not None and whole.beats.tolist() == [0.5, 1.0]
    assert whole.window(15, 30).beats.tolist() == [0.0, 0.5]  # type: ignore[union-attr]


def test_steps_are_known_where_the_path_walks() -> None:
    way = nod(np.arange(122) / 30 * 0.5)  # about a metre a second
    constraint = pin(way, steps=np.arange(1, 10) * 0.5)
    contacts = constraint.values[:, ROOT_ROW, LEFT_CONTACT:]
    assert constraint.known[:, ROOT_ROW, LEFT_CONTACT:].all() and constraint.beats is None
    assert set(contacts.unique().tolist()) == {0.0, 1.0} and contacts.any(1).all()
    assert not pin(wild_path(1, 40)).known[:, ROOT_ROW, LEFT_CONTACT:].any()


def test_ten_minutes_do_not_drift() -> None:
    path = wild_path(2, 18_000)
    error = root_error(decode_features(pin(path, tilt=True).values, **start_of(path)), path)
    assert error.max_metres < 0.005 and error.max_degrees < 0.1


def test_a_heading_in_the_pelvis_row_is_taken_out() -> None:
    path = wild_path(3, 30)
    features = pin(path, tilt=True).values.clone()
    twist = axis_angle_to_matrix(1, torch.full((30,), 0.3))
    features[:, 0] = matrix_to_rotation_6d(twist)
    features[:, 1:ROOT_ROW, 0] = features[:, 1:ROOT_ROW, 4] = 1.0
    assert root_error(decode_features(features, **start_of(path)), path).max_degrees > 10
    level = untwisted(features)
    assert root_error(decode_features(level, **start_of(path)), path).max_degrees < 0.02
    torch.testing.assert_close(level[:, 1:], features[:, 1:])


def test_errors_are_measured() -> None:
    path = wild_path(4, 30)
    motion = decode_features(pin(path, tilt=True).values, **start_of(path))
    motion.root_position[:, 0] += 0.1
    error = root_error(motion, path)
    np.testing.assert_allclose([error.mean_metres, error.max_metres], 0.1, atol=1e-4)
