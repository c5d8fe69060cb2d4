"""The stand-in body: its pelvis is the trajectory, its feet stay on the floor."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.spatial.transform import Rotation

from src.shared.formats.trajectory_figure import stand_in
from src.shared.motion.skeleton import FOOT_JOINTS, JOINT_INDEX, REST_PELVIS_HEIGHT
from src.shared.motion.trajectory import MotionTrajectory
from tests.shared.motion.trajectories import smooth_trajectory


def leaning(lean: float, height: float, yaw: float = 1.0) -> MotionTrajectory:
    turn = Rotation.from_euler("YX", [yaw, lean]).as_quat()[[3, 0, 1, 2]]
    position = np.tile([0.5, height, -2.0], (3, 1))
    return MotionTrajectory.from_pose(position, np.tile(turn, (3, 1)), np.zeros(3))


def test_the_pelvis_is_where_the_trajectory_says() -> None:
    trajectory = smooth_trajectory(3)
    motion = stand_in(trajectory, "song")
    np.testing.assert_array_equal(motion.positions()[:, 0], trajectory.position)
    np.testing.assert_array_equal(motion.quaternions[:, 0], trajectory.quaternion)
    np.testing.assert_allclose(np.linalg.norm(motion.quaternions, axis=-1), 1, atol=1e-5)
    assert (motion.text, motion.fps, motion.num_frames) == ("song", 30.0, 120)
    assert not motion.contacts.any()


@settings(max_examples=30, deadline=None)
@given(st.floats(-0.9, 0.9), st.floats(0.6, 0.94), st.floats(-3, 3))
def test_legs_bend_until_the_feet_are_flat_on_the_floor(
    lean: float, height: float, yaw: float
) -> None:
    motion = stand_in(leaning(lean, height, yaw))
    positions = motion.positions()[0]
    for ankle, foot in FOOT_JOINTS:
        hip = positions[ankle - 6]
        if 0.35 < hip[1] - 0.08 < 0.8:  # within the leg's reach
            np.testing.assert_allclose(positions[ankle], [hip[0], 0.08, hip[2]], atol=2e-3)
            assert positions[foot][1] == pytest.approx(0.02, abs=2e-3)


def test_a_jump_leaves_the_floor_and_arms_hang() -> None:
    positions = stand_in(leaning(0.0, REST_PELVIS_HEIGHT + 0.4)).positions()[0]
    assert positions[JOINT_INDEX["l_foot"]][1] == pytest.approx(0.42, abs=2e-3)
    assert positions[JOINT_INDEX["l_wrist"]][1] < positions[JOINT_INDEX["l_shoulder"]][1] - 0.35
    assert positions[JOINT_INDEX["l_foot"]][0] != positions[JOINT_INDEX["r_foot"]][0]


@pytest.mark.parametrize("lean", [np.pi / 2, np.pi, -3.0])
def test_a_body_upside_down_is_finite(lean: float) -> None:
    positions = stand_in(leaning(lean, 0.3)).positions()
    assert np.isfinite(positions).all()


def test_knees_bend_forwards() -> None:
    """Facing +Z, the knee is before the hip and the ankle."""
    positions = stand_in(leaning(0.0, 0.75, yaw=0.0)).positions()[0]
    knee, hip = positions[JOINT_INDEX["l_knee"]], positions[JOINT_INDEX["l_hip"]]
    assert knee[2] > hip[2] + 0.1
