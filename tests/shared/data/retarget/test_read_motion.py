"""Any motion file in: formats, guesses, exact round trips of our own files."""

from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from src.shared.data.retarget.read_motion import inspect_motion, read_motion
from src.shared.errors import UsageError, UserError
from src.shared.formats.arrays import write_npz
from src.shared.formats.writers.bvh import write_bvh
from src.shared.motion.motion import Motion
from src.shared.motion.skeleton import NUM_JOINTS


def a_motion(frames: int = 12, seed: int = 3, spread: float = 0.3) -> Motion:
    """A body that stands, floats 1.2 m up, and fidgets."""
    rng = np.random.default_rng(seed)
    quaternions = np.tile([1.0, 0, 0, 0], (frames, NUM_JOINTS, 1))
    quaternions[..., 1:] += spread * rng.normal(size=(NUM_JOINTS, 3))
    quaternions[..., 1:] += 0.02 * rng.normal(size=(frames, NUM_JOINTS, 3)).cumsum(0)
    quaternions /= np.linalg.norm(quaternions, axis=-1, keepdims=True)
    root = np.array([0, 1.2, 0]) + 0.02 * rng.normal(size=(frames, 3)).cumsum(0)
    contacts = np.zeros((frames, 2), np.float32)
    return Motion(quaternions.astype(np.float32), root.astype(np.float32), contacts)


def same(a: Motion, b: Motion, tolerance: float = 1e-4) -> None:
    assert a.fps == pytest.approx(b.fps)
    np.testing.assert_allclose(a.global_rotations(), b.global_rotations(), atol=tolerance)
    np.testing.assert_allclose(a.positions(), b.positions(), atol=tolerance)


def test_our_own_files_come_back_as_they_were(tmp_path: Path) -> None:
    motion = a_motion()
    same(read_motion(write_npz(motion, tmp_path / "a.npz")), motion)
    same(read_motion(write_bvh(motion, tmp_path / "a.bvh")), motion)


@pytest.mark.parametrize("name", ["none.bvh", "none.npz", "none.amc", "none.npy", "none.xyz"])
def test_missing_and_unknown_files(tmp_path: Path, name: str) -> None:
    with pytest.raises(UserError, match=name):
        read_motion(tmp_path / name)
    (tmp_path / name).write_bytes(b"nothing of use")
    with pytest.raises(UserError, match=name):
        read_motion(tmp_path / name)


def test_inspection_of_our_bvh(tmp_path: Path) -> None:
    found = inspect_motion(write_bvh(a_motion(), tmp_path / "a.bvh"))
    assert (found.format, found.frames, found.unit, found.up) == ("BVH", 12, "cm", "Y")
    assert found.mapping == "motion-suite" and not found.warnings
    assert found.fps == pytest.approx(30) and found.seconds == pytest.approx(0.4)


def test_a_mapping_is_a_file_of_the_folder_one_is_in(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    (tmp_path / "mine.yaml").write_text("profiles: []\n", encoding="utf-8")
    path = write_bvh(a_motion(), tmp_path / "a.bvh")
    monkeypatch.chdir(tmp_path)
    assert read_motion(path, mapping="mine.yaml").num_frames == 12
    with pytest.raises(UsageError, match=r"^none\.yaml: cannot read it"):
        read_motion(path, mapping="none.yaml")


def test_rates_and_lengths_are_held_in_bounds(tmp_path: Path) -> None:
    path = write_npz(replace(a_motion(7000), fps=1.0), tmp_path / "long.npz")
    for fps in (0, -1.0, float("nan"), "30", 1e7):
        with pytest.raises(UsageError, match=r"fps .* is out of range"):
            read_motion(path, fps=fps)  # type: ignore[arg-type]
    with pytest.raises(UserError, match="over the limit of 200000 frames"):
        read_motion(path)


def test_what_is_no_file_is_a_mistake_of_whoever_asks(tmp_path: Path) -> None:
    nothing: Any = None
    with pytest.raises(UsageError, match="path is None; give the path of a motion file"):
        read_motion(nothing)
    with pytest.raises(UsageError, match=r"no\.bvh does not exist; check the name"):
        read_motion(tmp_path / "no.bvh")
