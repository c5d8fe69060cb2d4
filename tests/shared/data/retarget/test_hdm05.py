"""HDM05 as a body: feet on the floor, legs of human length, the action its name says."""

from pathlib import Path

import numpy as np
import pytest

from src.shared.data.retarget.mapping import find_mapping, load_mappings
from src.shared.data.retarget.read_motion import inspect_motion, read_motion
from src.shared.formats.readers.acclaim import read_amc
from src.shared.motion.skeleton import JOINT_INDEX

L_WRIST, R_WRIST, HEAD = (JOINT_INDEX[name] for name in ("l_wrist", "r_wrist", "head"))
L_FOOT, R_FOOT, PELVIS = (JOINT_INDEX[name] for name in ("l_foot", "r_foot", "pelvis"))


def one(hdm05: Path, name: str) -> Path:
    return next(path for path in sorted(hdm05.rglob("*.[aA][mM][cC]")) if name in path.name)


@pytest.mark.parametrize("name", ["grabHighR", "squat1Reps", "kickLFront", "sneak2Steps"])
def test_the_source_stands_on_its_floor(hdm05: Path, name: str) -> None:
    """In the file's own world, which the reader does not move: y = 0 is the laboratory's floor."""
    clip = read_amc(one(hdm05, name))
    index = {joint: number for number, joint in enumerate(clip.names)}
    places = clip.world()[0] * clip.metres
    toes = places[:, [index["ltoes"], index["rtoes"]], 1]
    assert -0.02 < toes.min() < 0.08  # a toe joint is inside the foot
    assert np.median(toes.min(1)) < 0.08  # one foot stands
    thigh = np.linalg.norm(places[:, index["ltibia"]] - places[:, index["lfemur"]], axis=-1)
    shin = np.linalg.norm(places[:, index["lfoot"]] - places[:, index["ltibia"]], axis=-1)
    assert np.ptp(thigh) < 1e-9 and 0.7 < thigh[0] + shin[0] < 1.0


def test_left_and_right_and_up(hdm05: Path) -> None:
    grab = read_motion(one(hdm05, "grabHighR")).positions()
    assert grab[:, R_WRIST, 1].max() > grab[:, L_WRIST, 1].max() + 0.3
    kick = read_motion(one(hdm05, "kickLFront")).positions()
    assert kick[:, L_FOOT, 1].max() > 0.4 > kick[:, R_FOOT, 1].max()
    squat = read_motion(one(hdm05, "squat1Reps")).positions()
    assert np.ptp(squat[:, PELVIS, 1]) > 0.25
    lie = read_motion(one(hdm05, "lieDown")).positions()
    assert lie[0, HEAD, 1] > 1.3 and lie[-1, HEAD, 1] < 0.5


def test_bones_point_where_the_source_has_them(hdm05: Path) -> None:
    path = one(hdm05, "rotateArms")
    clip = read_amc(path).every(4)
    mapping = find_mapping(clip.names, load_mappings())
    places = clip.world()[0]
    index = {ours: clip.names.index(theirs) for ours, theirs in mapping.joints.items()}
    ours = read_motion(path).positions()
    assert mapping.name == "acclaim" and len(ours) == len(places)
    for start, end in (("l_shoulder", "l_elbow"), ("r_elbow", "r_wrist"), ("l_hip", "l_knee"),
                       ("r_knee", "r_ankle"), ("l_ankle", "l_foot")):  # fmt: skip
        a = places[:, index[end]] - places[:, index[start]]
        b = ours[:, JOINT_INDEX[end]] - ours[:, JOINT_INDEX[start]]
        cosine = (a * b).sum(-1) / np.linalg.norm(a, axis=-1) / np.linalg.norm(b, axis=-1)
        assert cosine.min() > 1 - 1e-4, (start, end)


def test_inspection(hdm05: Path) -> None:
    found = inspect_motion(one(hdm05, "throwBasketball"))
    assert (found.format, found.mapping, found.unit, found.up) == ("ASF/AMC", "acclaim", "cmu", "Y")
    assert found.fps == pytest.approx(120) and len(found.matched) == 22
    assert any("--source-fps" in warning for warning in found.warnings)


@pytest.mark.slow
def test_the_whole_set_reads(hdm05: Path) -> None:
    files = sorted(hdm05.rglob("*.[aA][mM][cC]"))
    assert len(files) == 189
    for path in files:
        motion = read_motion(path)
        assert motion.num_frames > 8 and np.isfinite(motion.positions()).all(), path
