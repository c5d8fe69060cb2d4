"""NPZ: a bit-exact round trip, and a clear error for everything else."""

from pathlib import Path

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from src.shared.errors import UserError
from src.shared.formats.arrays import read_npz, write_npz
from src.shared.motion.motion import Motion


def a_motion(frames: int = 6, text: str = "歩く </script> ünï") -> Motion:
    rng = np.random.default_rng(3)
    quaternions = rng.normal(size=(frames, 22, 4))
    quaternions /= np.linalg.norm(quaternions, axis=-1, keepdims=True)
    root = rng.normal(size=(frames, 3)).astype(np.float32)
    contacts = rng.integers(0, 2, (frames, 2)).astype(np.float32)
    return Motion(quaternions.astype(np.float32), root, contacts, 30.0, text)


def test_round_trip(tmp_path: Path) -> None:
    motion = a_motion()
    back = read_npz(write_npz(motion, tmp_path / "a.npz"))
    np.testing.assert_allclose(back.quaternions, motion.quaternions, atol=1e-7)
    np.testing.assert_array_equal(back.root_position, motion.root_position)
    np.testing.assert_array_equal(back.contacts, motion.contacts)
    assert (back.fps, back.text) == (30.0, motion.text)


def test_every_documented_array_is_there_without_pickles(tmp_path: Path) -> None:
    from src.shared.formats import arrays as npz

    with np.load(write_npz(a_motion(), tmp_path / "a.npz"), allow_pickle=False) as archive:
        names = set(archive.files)
        np.testing.assert_allclose(archive["positions"], a_motion().positions())
        assert archive["parents"][0] == -1
    documented = {line.split("|")[1].strip() for line in (npz.__doc__ or "").splitlines()
                  if line.startswith("| ")} - {"name"}  # fmt: skip
    assert names == documented


def test_the_same_motion_gives_the_same_bytes(tmp_path: Path) -> None:
    first = write_npz(a_motion(), tmp_path / "a.npz").read_bytes()
    assert write_npz(a_motion(), tmp_path / "b.npz").read_bytes() == first


def changed(folder: Path, **changes: object) -> Path:
    with np.load(write_npz(a_motion(), folder / "a.npz")) as archive:
        arrays = {name: archive[name] for name in archive.files} | changes
    path = folder / "changed.npz"
    np.savez(path, **{name: value for name, value in arrays.items() if value is not None})  # type: ignore[arg-type]
    return path


@pytest.mark.parametrize(("changes", "message"), [
    ({"quaternions": None}, "no array 'quaternions'"),
    ({"quaternions": np.zeros((6, 21, 4))}, r"expected numbers of shape \[6, 22, 4\]"),
    ({"quaternions": np.zeros((6, 22, 4))}, "no rotations"),
    ({"root_position": np.full((6, 3), np.nan)}, "NaN"),
    ({"root_position": np.zeros((5, 3))}, "root_position is"),
    ({"root_position": np.full((6, 3), "x")}, "root_position is"),
    ({"fps": np.float32(0)}, "0 frames a second"),
    ({"fps": np.zeros(3)}, "fps is"),
    ({"joint_names": np.array(["a"] * 22)}, "joint_names"),
    ({"text": np.array([{}], dtype=object)}, "Python objects"),
])  # fmt: skip
def test_foreign_arrays_are_refused(tmp_path: Path, changes: dict, message: str) -> None:
    with pytest.raises(UserError, match=message):
        read_npz(changed(tmp_path, **changes))


def test_missing_file(tmp_path: Path) -> None:
    with pytest.raises(UserError, match="does not exist"):
        read_npz(tmp_path / "none.npz")


@settings(max_examples=80, deadline=None,
          suppress_health_check=[HealthCheck.function_scoped_fixture])  # fmt: skip
@given(st.integers(0, 10_000), st.binary(min_size=0, max_size=9), st.booleans())
def test_damaged_files_raise_user_errors_only(
    tmp_path: Path, at: int, piece: bytes, cut: bool
) -> None:
    data = write_npz(a_motion(2), tmp_path / "a.npz").read_bytes()
    at %= len(data)
    broken = tmp_path / "broken.npz"
    broken.write_bytes(data[:at] + piece + (b"" if cut else data[at + len(piece) :]))
    try:
        read_npz(broken)
    except UserError as error:
        assert "broken.npz" in str(error)
