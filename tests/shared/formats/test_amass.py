"""AMASS files, in and out."""

from pathlib import Path

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from src.shared.data.retarget.read_motion import inspect_motion, read_motion
from src.shared.errors import UserError
from src.shared.formats.amass import SMPL_PELVIS, read_amass, write_amass
from src.shared.motion.motion import Motion
from src.shared.motion.skeleton import JOINT_INDEX

RNG = np.random.default_rng(4)
POSES = RNG.normal(size=(9, 156)) * 0.4
POSES[:, :3] = Rotation.from_euler("x", 90, degrees=True).as_rotvec()  # AMASS: +Z up, facing -Y
TRANS = np.column_stack([np.linspace(0, 1, 9), np.linspace(0, -2, 9), np.full(9, 0.9)])
GOOD = {"poses": POSES, "trans": TRANS, "mocap_framerate": np.float64(60), "betas": np.zeros(16)}


def save(folder: Path, **changes: object) -> Path:
    arrays = {name: value for name, value in (GOOD | changes).items() if value is not None}
    np.savez(folder / "a.npz", **arrays)  # type: ignore[arg-type]
    return folder / "a.npz"


@pytest.mark.parametrize("changes", [
    {},
    {"poses": POSES[:, :66]},
    {"poses": np.pad(POSES, ((0, 0), (0, 9)))},
    {"mocap_framerate": None, "mocap_frame_rate": np.float32(60)},
    {"poses": None, "root_orient": POSES[:, :3], "pose_body": POSES[:, 3:66]},
])  # fmt: skip
def test_every_spelling_is_the_same_body(tmp_path: Path, changes: dict) -> None:
    clip, ours = read_amass(save(tmp_path, **changes))
    expected = Rotation.from_rotvec(POSES[:, :66].reshape(-1, 3)).as_matrix()
    np.testing.assert_allclose(clip.rotations.reshape(-1, 3, 3), expected, atol=1e-12)
    assert not ours
    np.testing.assert_allclose(clip.translations[:, 0], TRANS + SMPL_PELVIS)
    assert 1 / clip.frame_time == pytest.approx(60)


def test_z_up_becomes_y_up(tmp_path: Path) -> None:
    """Derived by hand: +Z is up, and who faced -Y walks along +Z."""
    poses = np.zeros((9, 156))
    poses[:, :3] = POSES[:, :3]
    motion = read_motion(save(tmp_path, poses=poses), fps=None)
    at = motion.positions()
    assert motion.fps == pytest.approx(60)
    assert at[0, JOINT_INDEX["head"], 1] > 1.4 and at[0, JOINT_INDEX["l_foot"], 1] < 0.1
    assert at[0, JOINT_INDEX["l_wrist"], 0] > at[0, JOINT_INDEX["r_wrist"], 0] + 1
    np.testing.assert_allclose(at[-1, 0] - at[0, 0], [1, 0, 2], atol=1e-5)
    found = inspect_motion(save(tmp_path))
    assert (found.format, found.up, found.unit, found.guessed) == ("AMASS", "Z", "m", ())
    assert any("hands" in warning for warning in found.warnings)


@pytest.mark.parametrize(("changes", "message"), [
    ({"trans": None}, "neither a motion of this project nor AMASS"),
    ({"poses": POSES[:, :60]}, "poses has 60 values"),
    ({"poses": POSES[:5]}, "5 poses and 9 places"),
    ({"poses": POSES.ravel()}, r"expected numbers of shape \[T, 66 or more\]"),
    ({"trans": TRANS * np.nan}, "trans holds NaN"),
    ({"trans": TRANS.astype("U4")}, "trans is"),
    ({"mocap_framerate": None}, "--source-fps"),
    ({"mocap_framerate": np.float64(0)}, "0 frames a second"),
    ({"mocap_framerate": np.zeros(2)}, "the frame rate is"),
    ({"poses": np.array([{}])}, "Python objects"),
])  # fmt: skip
def test_faults_are_named(tmp_path: Path, changes: dict, message: str) -> None:
    with pytest.raises(UserError, match=message) as caught:
        read_motion(save(tmp_path, **changes))
    assert "a.npz" in str(caught.value) and "\n" not in str(caught.value)


def test_a_rate_can_be_stated(tmp_path: Path) -> None:
    path = save(tmp_path, mocap_framerate=None)
    assert read_motion(path, source_fps=120, fps=None).fps == pytest.approx(120)


def test_an_unread_array_with_objects_does_no_harm(tmp_path: Path) -> None:
    """Real AMASS files carry some; only what is needed is opened."""
    assert read_motion(save(tmp_path, labels_obs=np.array([{"a": 1}]))).num_frames > 0


def test_other_bodies_are_put_on_the_floor_and_ours_are_left(tmp_path: Path) -> None:
    """A foreign file's body is not ours in size, so its heights say little of our feet."""
    floating = {"trans": TRANS + [0, 0, 5], "poses": np.pad(POSES[:, :3], ((0, 0), (0, 153)))}
    lowest = {skeleton: read_motion(save(tmp_path, skeleton=skeleton, **floating)).positions()
              [:, [JOINT_INDEX["l_foot"], JOINT_INDEX["r_foot"]], 1].min()
              for skeleton in (None, "motion-suite")}  # fmt: skip
    assert lowest[None] < 0.05 and lowest["motion-suite"] > 4.5


def facing_left() -> Motion:
    """One frame: upright, turned to face +X, 2 m along +Z, one knee bent."""
    quaternions = np.zeros((1, 22, 4), np.float32)
    quaternions[..., 0] = 1
    turn = Rotation.from_euler("Y", 90, degrees=True).as_quat()
    quaternions[0, 0] = turn[[3, 0, 1, 2]]
    bend = Rotation.from_euler("X", 30, degrees=True).as_quat()
    quaternions[0, 4] = bend[[3, 0, 1, 2]]
    return Motion(quaternions, np.array([[0.0, 0.9, 2.0]], np.float32), np.ones((1, 2)), 60.0, "")


def test_arrays_are_those_of_smpl_h(tmp_path: Path) -> None:
    arrays = np.load(write_amass(facing_left(), tmp_path / "a.npz"), allow_pickle=False)
    shapes = {name: arrays[name].shape for name in arrays.files}
    assert shapes == {"poses": (1, 156), "trans": (1, 3), "mocap_framerate": (), "gender": (),
                      "betas": (16,), "dmpls": (1, 8), "skeleton": ()}  # fmt: skip
    assert str(arrays["gender"]) == "neutral"
    assert float(arrays["mocap_framerate"]) == 60.0
    assert not arrays["betas"].any()
    assert not arrays["poses"][:, 66:].any()


def test_the_world_is_z_up(tmp_path: Path) -> None:
    arrays = np.load(write_amass(facing_left(), tmp_path / "a.npz"))
    # Our +Z, towards the viewer, is AMASS's -Y; up is +Z. The pelvis is where ours is.
    np.testing.assert_allclose(arrays["trans"][0] + SMPL_PELVIS, [0.0, -2.0, 0.9], atol=1e-6)
    pelvis = Rotation.from_rotvec(arrays["poses"][0, :3])
    np.testing.assert_allclose(pelvis.apply([0, 1, 0]), [0, 0, 1], atol=1e-6)  # upright
    np.testing.assert_allclose(pelvis.apply([0, 0, 1]), [1, 0, 0], atol=1e-6)  # faces +X
    knee = arrays["poses"][0, 12:15]
    np.testing.assert_allclose(knee, [np.deg2rad(30), 0, 0], atol=1e-6)
