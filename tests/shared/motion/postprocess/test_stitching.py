"""No jump where known frames end, and nothing known moves; cuts are softened."""

import numpy as np
import pytest
import torch
from hypothesis import given
from hypothesis import strategies as st

from src.shared.motion.features import HEIGHT, LEFT_CONTACT, ROOT_ROW, decode_features
from src.shared.motion.postprocess.stitching import (
    EDGE,
    FADE,
    POSES,
    STEP,
    WAYS,
    blend_boundaries,
    blend_cuts,
    bridge,
    gone_down,
    leaps,
    posture,
)
from src.shared.motion.rotations import (
    matrix_to_quaternion,
    matrix_to_rotation_6d,
    quaternion_exp,
    quaternion_log,
    quaternion_to_matrix,
    rotation_6d_to_matrix,
)
from src.shared.motion.skeleton import JOINT_INDEX, JOINT_NAMES

SHAPE = (23, 6)

LIES = {"lying": -84.0, "prone": 76.0, "airborne": 80.0}  # degrees about the x-axis


def still(name: str, frames: int = 3) -> torch.Tensor:
    """A body in a posture [T,R,6]; who is prone kneels on all fours."""
    joints = {"pelvis": (LIES[name], 0.0, 0.0)} if name in LIES else POSES[name]
    if name == "prone":
        joints |= {"hip": (-70.0, 0, 0), "knee": (80.0, 0, 0), "shoulder": (0, -85.0, 0)}
    vectors = torch.zeros(22, 3)
    for index, joint in enumerate(JOINT_NAMES):
        x, y, z = joints.get(joint.removeprefix("l_").removeprefix("r_"), (0, 0, 0))
        sign = -1 if joint.startswith("r_") else 1
        vectors[index] = torch.tensor((x, sign * y, sign * z)) * np.pi / 180
    pose = torch.zeros(23, 6)
    pose[:22] = matrix_to_rotation_6d(quaternion_to_matrix(quaternion_exp(vectors)))
    lowest = decode_features(pose[None], fps=30.0).positions()[0, :, 1].min()
    pose[ROOT_ROW, HEIGHT] += (1.0 if name == "airborne" else 0.05) - float(lowest)
    return pose.expand(frames, -1, -1).clone()


def ramp(frames: int, jump: float = 0.0, at: int = 0) -> torch.Tensor:
    """A steady motion of 0.01 a frame that jumps once."""
    values = 0.01 * torch.arange(frames)[:, None, None].expand(-1, *SHAPE).clone()
    values[at:] += jump
    return values


def prefix(frames: int, known: int) -> torch.Tensor:
    mask = torch.zeros(frames, *SHAPE, dtype=torch.bool)
    mask[:known] = True
    return mask


@given(jump=st.floats(-0.5, 0.5), known=st.integers(2, 20), frames=st.integers(31, 60))
def test_a_jump_is_taken_up(jump: float, known: int, frames: int) -> None:
    """The step across the border is that of its neighbours; the fade is spread over `FADE`."""
    features = ramp(frames, jump, at=known)
    mask = prefix(frames, known)
    mask[:, :ROOT_ROW] = True  # no rotations
    smooth = blend_boundaries(features, mask)
    motion = torch.zeros(SHAPE, dtype=torch.bool)
    motion[ROOT_ROW, :LEFT_CONTACT] = True
    torch.testing.assert_close(smooth[:known], features[:known])
    torch.testing.assert_close(smooth[:, ~motion], features[:, ~motion])
    end = known + FADE
    torch.testing.assert_close(smooth[end:], features[end:])
    moving = smooth[:, motion]
    step = (moving[known] - moving[known - 1]).max()
    assert abs(float(step) - 0.01) < 1e-4
    assert float((moving.diff(dim=0) - 0.01).abs().max()) <= abs(jump) * 2.2 / FADE + 1e-5


def test_both_ends_of_a_gap_meet() -> None:
    features = ramp(60)
    features[20:40] += 0.3
    mask = torch.ones(60, *SHAPE, dtype=torch.bool)
    mask[20:40] = False
    mask[:, :ROOT_ROW] = True  # no rotations
    smooth = blend_boundaries(features, mask)
    steps = smooth[:, ROOT_ROW, 2].diff()
    assert float(steps[[19, 39]].sub(0.01).abs().max()) < 1e-4
    assert float((smooth - ramp(60))[:20].abs().max()) < 1e-6
    torch.testing.assert_close(smooth[29:31], features[29:31], rtol=0, atol=0.01)


@given(
    angle=st.floats(-3.0, 3.0),
    axis=st.lists(st.floats(-1, 1), min_size=3, max_size=3).filter(
        lambda v: np.hypot(*v[:2]) > 0.1
    ),
    back=st.booleans(),
)
def test_a_turned_joint_turns_back_evenly(angle: float, axis: list[float], back: bool) -> None:
    """By however much it is turned, a whole rotation goes about one axis, at the fade's pace."""
    turn = torch.tensor(axis, dtype=torch.float64)
    vectors = torch.zeros(40, 3, dtype=torch.float64)
    vectors[20:] = angle * turn / turn.norm()
    features = torch.zeros(40, *SHAPE)
    rotations = quaternion_to_matrix(quaternion_exp(vectors))
    features[:, 4] = matrix_to_rotation_6d(rotations).float()
    known = prefix(40, 20) if not back else ~prefix(40, 20)
    smooth = rotation_6d_to_matrix(blend_boundaries(features, known)[:, 4].double())
    steps = matrix_to_quaternion(smooth[:-1].swapaxes(-1, -2) @ smooth[1:])
    turned = quaternion_log(steps).norm(dim=-1)
    assert float(turned.max()) <= abs(angle) * 1.9 / FADE + 1e-3
    assert abs(float(turned.sum()) - abs(angle)) < 1e-2


@given(
    st.lists(st.booleans(), min_size=1, max_size=30),
    st.integers(0, 2**32),
)
def test_known_entries_stay_and_all_is_finite(mask: list[bool], seed: int) -> None:
    """Any pattern, single frames and single free frames among them."""
    features = torch.randn(len(mask), *SHAPE, generator=torch.Generator().manual_seed(seed))
    known = torch.tensor(mask)[:, None, None].expand(-1, *SHAPE).clone()
    known[:, 5, 2] = False
    smooth = blend_boundaries(features, known)
    assert torch.isfinite(smooth).all()
    torch.testing.assert_close(smooth[known], features[known])
    torch.testing.assert_close(smooth[:, 5, 2], features[:, 5, 2])


def test_nothing_known_changes_nothing() -> None:
    features = torch.randn(20, *SHAPE)
    torch.testing.assert_close(blend_boundaries(features, prefix(20, 0)), features)
    torch.testing.assert_close(blend_boundaries(features, prefix(20, 20)), features)


def test_cuts_are_softened_and_the_rest_is_left_alone() -> None:
    """A corner at frame 40 becomes a curve; contacts and far frames stay to the bit."""
    line = torch.arange(80.0)
    corner = torch.where(line < 40, line, 80 - line) / 30
    features = corner[:, None, None].repeat(1, ROOT_ROW + 1, 6)
    soft = blend_cuts(features, [40])
    change = (soft[2:] - 2 * soft[1:-1] + soft[:-2]).abs()
    before = (features[2:] - 2 * features[1:-1] + features[:-2]).abs()
    assert change[:, :ROOT_ROW].max() < 0.4 * before.max()
    assert torch.equal(soft[:, ROOT_ROW, LEFT_CONTACT:], features[:, ROOT_ROW, LEFT_CONTACT:])
    assert torch.equal(soft[:24], features[:24]) and torch.equal(soft[56:], features[56:])
    assert blend_cuts(features, []) is features


@pytest.mark.parametrize("stop", WAYS)
@pytest.mark.parametrize("start", WAYS)
def test_there_is_a_way_from_any_posture_to_any_other(start: str, stop: str) -> None:
    before, after = still(start), still(stop)
    assert posture(before[-1]) == start and posture(after[0]) == stop
    way = bridge(before, after, 30.0)
    assert torch.isfinite(way).all() and len(way) >= EDGE * 30
    whole = torch.cat((before, way, after))
    joints = decode_features(whole, fps=30.0).positions().astype(float)
    speed = np.linalg.norm(np.diff(joints, axis=0), axis=-1) * 30
    assert speed.max() < 3.0 and speed[[2, -4]].max() < 0.2  # begins and ends as slowly
    assert joints[..., 1].min() > -0.06  # an elbow of who lies down, at most
    if "airborne" not in (start, stop):
        assert joints[..., 1].min(1).max() < 0.1  # something is on the floor all the time
    shorter = bridge(before, after, 30.0, 10)
    assert len(shorter) == 10


def test_who_lies_sits_up_before_he_stands() -> None:
    way = bridge(still("lying"), still("standing"), 30.0)
    assert len(way) == round((2 * STEP + EDGE) * 30)
    seen = [posture(pose) for pose in way]
    order = [name for number, name in enumerate(seen) if not number or name != seen[number - 1]]
    assert order == ["lying", "seated", "crouched", "standing"]
    feet = [JOINT_INDEX["l_ankle"], JOINT_INDEX["r_ankle"]]
    joints = decode_features(way, fps=30.0).positions().astype(float)
    up = joints[len(way) // 2 :]  # from a crouch on the feet stay where they are
    assert np.ptp(up[:, feet].mean(1)[:, [0, 2]], axis=0).max() < 0.08


def test_a_leap_is_farther_than_a_body_gets() -> None:
    lying, standing = still("lying", 30), still("standing", 30)
    assert leaps(lying[0], standing, 30.0) and leaps(standing[0], lying, 30.0)
    assert not leaps(standing[0], standing, 30.0)
    late = torch.cat((standing[:20], lying))
    assert not leaps(standing[0], late, 30.0)


def test_who_is_low_does_not_stand_up_to_lie_down() -> None:
    """He goes on where what begins standing is nearest to him when it has gone down."""
    down = [still(name) for name in ("standing", "crouched", "seated", "lying")]
    frames = len(down[0])
    piece = torch.cat(down)
    assert gone_down(still("seated")[-1], piece) == 2 * frames
    assert gone_down(still("prone")[-1], piece) == frames  # by hands and feet to a crouch
    assert gone_down(still("standing")[-1], piece) == 0
    assert gone_down(still("seated")[-1], piece[frames:]) == 0  # begins low
    assert gone_down(still("seated")[-1], torch.cat((piece, down[0]))) == 0  # stands at the end
    assert gone_down(still("seated")[-1], piece[:0]) == 0
