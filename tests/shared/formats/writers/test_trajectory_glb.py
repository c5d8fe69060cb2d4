"""GLB of a trajectory: the pelvis node carries it, frame by frame."""

from pathlib import Path

import numpy as np
from scipy.spatial.transform import Rotation

from src.shared.formats.writers.glb import write_trajectory_glb
from src.shared.motion.skeleton import JOINT_INDEX
from tests.shared.formats.glb_reader import Glb
from tests.shared.motion.trajectories import smooth_trajectory


def test_the_pelvis_node_is_the_trajectory(tmp_path: Path) -> None:
    trajectory = smooth_trajectory(2, 60)
    glb = Glb(write_trajectory_glb(trajectory, tmp_path / "a.glb", "歩く </script>"))
    animation = glb.json["animations"][0]
    assert animation["name"] == "歩く </script>"
    outputs = {
        (channel["target"]["node"], channel["target"]["path"]): animation["samplers"][
            channel["sampler"]
        ]
        for channel in animation["channels"]
    }
    place, turn = outputs[0, "translation"], outputs[0, "rotation"]
    np.testing.assert_allclose(glb.read(place["input"])[:, 0], np.arange(60) / 30, atol=1e-6)
    np.testing.assert_array_equal(glb.read(place["output"]), trajectory.position)
    turns = Rotation.from_quat(glb.read(turn["output"])).as_matrix()
    expected = Rotation.from_quat(trajectory.quaternion[:, [1, 2, 3, 0]]).as_matrix()
    np.testing.assert_allclose(turns, expected, atol=1e-5)


def test_joints_that_never_turn_have_one_key(tmp_path: Path) -> None:
    glb = Glb(write_trajectory_glb(smooth_trajectory(2, 60), tmp_path / "a.glb"))
    animation = glb.json["animations"][0]
    keys = {
        channel["target"]["node"]: len(
            glb.read(animation["samplers"][channel["sampler"]]["output"])
        )
        for channel in animation["channels"]
        if channel["target"]["path"] == "rotation"
    }
    assert (keys[0], keys[JOINT_INDEX["l_knee"]], keys[JOINT_INDEX["l_elbow"]]) == (60, 60, 1)
    for sampler in animation["samplers"]:
        assert len(glb.read(sampler["input"])) == len(glb.read(sampler["output"]))


def test_ten_minutes_stay_small(tmp_path: Path) -> None:
    path = write_trajectory_glb(smooth_trajectory(2, 18_000), tmp_path / "a.glb")
    assert path.stat().st_size < 3_500_000


def test_one_frame_is_enough(tmp_path: Path) -> None:
    trajectory = smooth_trajectory(2, 1)
    positions, _ = Glb(write_trajectory_glb(trajectory, tmp_path / "a.glb")).world(0)
    np.testing.assert_allclose(positions[0], trajectory.position[0], atol=1e-6)
