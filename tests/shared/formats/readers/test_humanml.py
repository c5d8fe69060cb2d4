"""HumanML3D: positions come back exactly, twists as far as bends tell; features by definition."""

from pathlib import Path

import numpy as np
import pytest

from src.shared.data.synthetic.clips import generate_clip, sample_specs
from src.shared.errors import UserError
from src.shared.formats.readers.humanml import read_humanml
from src.shared.motion.motion import Motion
from src.shared.motion.skeleton import JOINT_INDEX


@pytest.fixture(scope="module")
def walk() -> Motion:
    return generate_clip(sample_specs(40, seed=3)[17], seed=5)


def features_of(positions: np.ndarray) -> np.ndarray:
    """The vectors of HumanML3D, written from their description, complex numbers for the floor."""
    across = positions[:, JOINT_INDEX["l_hip"]] - positions[:, JOINT_INDEX["r_hip"]]
    facing = (across[:, 0] - 1j * across[:, 2]) / np.hypot(across[:, 0], across[:, 2])
    facing = facing / facing[0]  # e^(i·turn about +Y), the first frame faces as it stands
    floor = positions[..., 0] - 1j * positions[..., 2]  # turns about +Y multiply
    result = np.zeros((len(positions), 263))
    result[:-1, 0] = -np.angle(facing[1:] / facing[:-1]) / 2
    step = (floor[1:, 0] - floor[:-1, 0]) / facing[1:]
    result[:-1, 1], result[:-1, 2] = step.real, -step.imag
    result[:, 3] = positions[:, 0, 1]
    own = (floor[:, 1:] - floor[:, :1]) / facing[:, None]
    result[:, 4:67] = np.stack([own.real, positions[:, 1:, 1], -own.imag], -1).reshape(-1, 63)
    return result


def test_positions_come_back(tmp_path: Path, walk: Motion) -> None:
    positions = walk.positions()
    np.save(tmp_path / "a.npy", positions)
    clip = read_humanml(tmp_path / "a.npy")
    assert 1 / clip.frame_time == pytest.approx(20)
    np.testing.assert_allclose(clip.world()[0], positions, atol=2e-5)


def test_bent_limbs_tell_their_twist(tmp_path: Path, walk: Motion) -> None:
    np.save(tmp_path / "a.npy", walk.positions())
    world = read_humanml(tmp_path / "a.npy").world()[1]
    true = walk.global_rotations()
    traces = np.einsum("tjab,tjab->tj", world, true)
    angle = np.degrees(np.arccos(np.clip((traces - 1) / 2, -1, 1)))
    for name in ("pelvis", "spine3", "l_collar"):
        assert angle[:, JOINT_INDEX[name]].max() < 0.5, name
    for name in ("l_hip", "r_hip", "l_shoulder", "r_shoulder", "l_elbow", "r_knee"):
        assert np.median(angle[:, JOINT_INDEX[name]]) < 20, name


def test_feature_vectors_are_the_same_motion(tmp_path: Path, walk: Motion) -> None:
    positions = walk.positions().astype(np.float64)
    np.save(tmp_path / "b.npy", features_of(positions))
    found = read_humanml(tmp_path / "b.npy", fps=30).world()[0]
    positions[..., [0, 2]] -= positions[:1, :1, [0, 2]]
    np.testing.assert_allclose(found, positions, atol=2e-5)


@pytest.mark.parametrize(("array", "message"), [
    (np.zeros((5, 21, 3)), r"expected joint positions \[T,22,3\] or"),
    (np.zeros((0, 22, 3)), "expected joint positions"),
    (np.zeros((5, 22, 3), complex), "never loaded|expected joint"),
    (np.full((5, 22, 3), np.nan), "NaN"),
    (np.zeros((5, 22, 3)), "no positions in metres"),
    (np.random.default_rng(0).normal(size=(50, 263)), "times Std, plus Mean"),
    (np.array([[{}]], dtype=object), "Python objects"),
])  # fmt: skip
def test_other_arrays_are_refused(tmp_path: Path, array: np.ndarray, message: str) -> None:
    np.save(tmp_path / "c.npy", array, allow_pickle=True)
    with pytest.raises(UserError, match=message) as caught:
        read_humanml(tmp_path / "c.npy")
    assert "c.npy" in str(caught.value)
