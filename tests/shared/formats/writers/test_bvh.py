"""BVH writer: what is written reads back as the same motion, at the poles of Euler angles too."""

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st
from scipy.spatial.transform import Rotation

from src.shared.formats.readers.bvh import read_bvh
from src.shared.formats.writers.bvh import matrices_to_euler, write_bvh
from src.shared.motion.motion import Motion
from src.shared.motion.skeleton import JOINT_NAMES


def random_motion(frames: int = 20, seed: int = 0) -> Motion:
    rng = np.random.default_rng(seed)
    quaternions = rng.normal(size=(frames, 22, 4)).astype(np.float32)
    quaternions /= np.linalg.norm(quaternions, axis=-1, keepdims=True)
    root = rng.uniform(-30, 30, (frames, 3)).astype(np.float32)
    return Motion(quaternions, root, np.zeros((frames, 2), np.float32), 30.0, "random")


def angle_between(first: np.ndarray, second: np.ndarray) -> np.ndarray:
    """Angles in radians between rotation matrices [...,3,3], exact for small ones."""
    return 2 * np.arcsin(np.clip(np.linalg.norm(first - second, axis=(-2, -1)) / np.sqrt(8), 0, 1))


def test_round_trip(tmp_path: Path) -> None:
    motion = random_motion()
    clip = read_bvh(write_bvh(motion, tmp_path / "out.bvh"))
    order = [clip.names.index(name) for name in JOINT_NAMES]
    positions, rotations = clip.world()
    assert 1 / clip.frame_time == pytest.approx(30.0, abs=1e-4)
    assert len(clip.end_sites) == 5
    assert np.abs(positions[:, order] / 100 - motion.positions()).max() < 1e-4
    assert angle_between(rotations[:, order], motion.global_rotations()).max() < 1e-4
    parents = [clip.names[clip.parents[index]] for index in order[1:]]
    assert parents[:3] == ["pelvis"] * 3


@settings(max_examples=25, deadline=None,
          suppress_health_check=[HealthCheck.function_scoped_fixture])  # fmt: skip
@given(st.integers(0, 2**32 - 1), st.integers(1, 4), st.sampled_from([24.0, 30.0, 60.0, 120.0]))
def test_random_motions_come_back(tmp_path: Path, seed: int, frames: int, fps: float) -> None:
    motion = replace(random_motion(frames, seed), fps=fps)
    clip = read_bvh(write_bvh(motion, tmp_path / "out.bvh"))
    order = [clip.names.index(name) for name in JOINT_NAMES]
    positions, rotations = clip.world()
    assert 1 / clip.frame_time == pytest.approx(fps, rel=1e-5)
    assert np.abs(positions[:, order] / 100 - motion.positions()).max() < 1e-4
    assert angle_between(rotations[:, order], motion.global_rotations()).max() < 1e-4


def test_bvhio_reads_the_same_positions(tmp_path: Path) -> None:
    bvhio = pytest.importorskip("bvhio")
    motion = random_motion(3, 7)
    root = bvhio.readAsHierarchy(str(write_bvh(motion, tmp_path / "out.bvh")))
    joints = {joint.Name: joint for joint, _, _ in root.layout()}
    for frame in range(3):
        root.loadPose(frame, recursive=True)
        found = [list(joints[name].PositionWorld) for name in JOINT_NAMES]
        assert np.abs(np.array(found) / 100 - motion.positions()[frame]).max() < 1e-3


def test_all_joints_have_rotations_and_only_the_root_moves(tmp_path: Path) -> None:
    clip = read_bvh(write_bvh(random_motion(1), tmp_path / "out.bvh"))
    assert set(clip.rotation_orders) == {"ZXY"}
    assert [len(channels) for channels in clip.channels] == [6] + [3] * 21


@settings(max_examples=60, deadline=None)
@given(st.floats(-np.pi, np.pi), st.floats(-np.pi, np.pi), st.sampled_from([-1.0, 1.0]),
       st.floats(0, 1e-3) | st.sampled_from([0.0, 1e-9, 1e-7, 1e-6, 1e-5]))  # fmt: skip
def test_euler_angles_are_exact_at_the_poles(z: float, y: float, sign: float, gap: float) -> None:
    exact = Rotation.from_euler("ZXY", [z, sign * (np.pi / 2 - gap), y])
    angles = matrices_to_euler(exact.as_matrix()[None, None])[0, 0]
    back = Rotation.from_euler("ZXY", angles)
    assert (back * exact.inv()).magnitude() < 1e-6


@pytest.mark.parametrize("order", ["XYZ", "XZY", "YXZ", "YZX", "ZXY", "ZYX"])
def test_every_order_agrees_with_scipy(order: str) -> None:
    exact = Rotation.random(50, random_state=3)
    angles = matrices_to_euler(exact.as_matrix()[:, None], order)[:, 0]
    assert (Rotation.from_euler(order, angles) * exact.inv()).magnitude().max() < 1e-9
    np.testing.assert_allclose(angles[0], exact[0].as_euler(order), atol=1e-9)


def test_angles_do_not_jump_between_frames() -> None:
    turn = np.linspace(0, 6 * np.pi, 200)  # three somersaults: x runs through both poles
    angles = matrices_to_euler(Rotation.from_euler("X", turn[:, None]).as_matrix()[:, None])
    np.testing.assert_allclose(angles[:, 0, 1], turn, atol=1e-6)
    assert np.abs(np.diff(angles, axis=0)).max() < 0.1
