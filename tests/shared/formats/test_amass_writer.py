"""AMASS-compatible NPZ: the arrays that tools of that data set expect, in its own world."""

from pathlib import Path

import numpy as np
from scipy.spatial.transform import Rotation

from src.shared.formats.amass import SMPL_PELVIS
from src.shared.formats.amass_writer import write_amass
from src.shared.motion.motion import Motion


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
