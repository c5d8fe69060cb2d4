"""Every lossless pair of formats: what goes out through one and in again is the same motion."""

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st
from scipy.spatial.transform import Rotation

from src.shared.data.retarget.read_motion import read_motion
from src.shared.formats.registry import ending, write_motion
from src.shared.motion.motion import Motion

LOSSLESS = ("npz", "bvh", "glb", "amass", "csv")
TOLERANCE = 1e-4  # radians, metres


def random_motion(frames: int, seed: int, fps: float) -> Motion:
    """Any rotation in any frame, a path within 20 m."""
    rng = np.random.default_rng(seed)
    quaternions = rng.normal(size=(frames, 22, 4)).astype(np.float32)
    quaternions /= np.linalg.norm(quaternions, axis=-1, keepdims=True)
    root = rng.uniform(-20, 20, (frames, 3)).astype(np.float32)
    return Motion(quaternions, root, np.zeros((frames, 2), np.float32), fps, "a")


def differences(first: Motion, second: Motion) -> tuple[float, float]:
    """The largest angle of a joint in the world (rad) and distance of a joint (m)."""
    turns = [Rotation.from_matrix(m.global_rotations().reshape(-1, 3, 3)) for m in (first, second)]
    angle = (turns[0].inv() * turns[1]).magnitude().max()
    return float(angle), float(np.abs(first.positions() - second.positions()).max())


@pytest.mark.parametrize("first", LOSSLESS)
@settings(max_examples=6, deadline=None,
          suppress_health_check=[HealthCheck.function_scoped_fixture])  # fmt: skip
@given(second=st.sampled_from(LOSSLESS), seed=st.integers(0, 2**32 - 1), frames=st.integers(1, 5),
       fps=st.sampled_from([24.0, 29.97, 30.0, 60.0, 120.0]))  # fmt: skip
def test_pairs_are_lossless(
    tmp_path: Path, first: str, second: str, seed: int, frames: int, fps: float
) -> None:
    motion = random_motion(frames, seed, fps)
    there = read_motion(write_motion(motion, tmp_path / f"a.{ending(first)}"), fps=None)
    back = read_motion(write_motion(there, tmp_path / f"b.{ending(second)}"), fps=None)
    angle, distance = differences(motion, back)
    assert angle <= TOLERANCE
    assert distance <= TOLERANCE
    if frames > 1:
        assert back.fps == pytest.approx(fps, rel=1e-4)


@pytest.mark.parametrize("name", LOSSLESS)
def test_a_single_frame_and_many_frames(tmp_path: Path, name: str) -> None:
    for frames in (1, 300):
        motion = random_motion(frames, frames, 30.0)
        back = read_motion(write_motion(motion, tmp_path / f"a.{ending(name)}"), fps=None)
        assert back.num_frames == frames
        assert max(differences(motion, back)) <= TOLERANCE


@pytest.mark.parametrize("name", ["npz", "csv"])
def test_contacts_come_back(tmp_path: Path, name: str) -> None:
    motion = random_motion(9, 1, 30.0)
    contacts = np.random.default_rng(2).uniform(0, 1, (9, 2)).astype(np.float32)
    path = write_motion(replace(motion, contacts=contacts), tmp_path / f"a.{name}")
    np.testing.assert_array_equal(read_motion(path, fps=None).contacts, contacts)


@pytest.mark.parametrize("name", ["npz", "glb"])
def test_captions_come_back(tmp_path: Path, name: str) -> None:
    motion = replace(random_motion(3, 1, 30.0), text='says "hi", 歩く')
    path = write_motion(motion, tmp_path / f"a.{name}")
    assert read_motion(path, fps=None).text == motion.text
