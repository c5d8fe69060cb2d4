"""Smoothing, the velocity clamp, and the chain from features to a motion."""

from dataclasses import replace

import numpy as np
import pytest
import torch
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.ndimage import convolve1d

from src.shared.config_schema import PostProcessingConfig
from src.shared.data.synthetic.clips import generate_clip, spec_for
from src.shared.metrics.measurements import (
    arms_alone,
    at_rest,
    ends_at_rest,
    measure,
    rests_in_place,
)
from src.shared.motion.features import decode_features, encode_features
from src.shared.motion.motion import Motion
from src.shared.motion.postprocess.whole import (
    REST_FADE,
    TOUCH,
    MotionPostProcessor,
    clamp_velocity,
    hands_meet,
    rest_to_rest,
    smooth_features,
    smoothing_weights,
    until_landed,
)
from src.shared.motion.rotations import (
    quaternion_conjugate,
    quaternion_exp,
    quaternion_log,
    quaternion_multiply,
    quaternion_slerp,
)
from src.shared.motion.skeleton import JOINT_INDEX, NUM_JOINTS, REST_PELVIS_HEIGHT


def some_motion(frames: int = 40, seed: int = 0) -> Motion:
    """Every joint swings at its own pace; the feet take turns."""
    rng = np.random.default_rng(seed)
    time = torch.arange(frames)[:, None, None] / 30
    swing = torch.as_tensor(rng.normal(0, 0.3, (1, NUM_JOINTS, 3)), dtype=torch.float32)
    quaternions = quaternion_exp(swing * torch.sin(4 * time))
    path = np.zeros((frames, 3), dtype=np.float32)
    path[:, 1], path[:, 2] = REST_PELVIS_HEIGHT, 0.02 * np.arange(frames)
    left = (np.arange(frames) % 20 < 10).astype(np.float32)
    return Motion(quaternions.numpy(), path, np.stack((left, 1 - left), -1))


def turn_rates(quaternions: torch.Tensor, fps: float) -> torch.Tensor:
    steps = quaternion_multiply(quaternion_conjugate(quaternions[:-1]), quaternions[1:])
    return quaternion_log(steps).norm(dim=-1) * fps


def weights_of(size: int, twicing: bool = False) -> list[float]:
    return smoothing_weights(PostProcessingConfig(smoothing_kernel=size, smoothing_twicing=twicing))


@pytest.mark.parametrize("size", [3, 5, 7])
@pytest.mark.parametrize("twicing", [False, True])
def test_smoothing_equals_scipy(size: int, twicing: bool) -> None:
    """Twicing: what is taken is smoothed, too, and added, on a series without ends."""
    binomial = {3: [1, 2, 1], 5: [1, 4, 6, 4, 1], 7: [1, 6, 15, 20, 15, 6, 1]}[size]
    once = np.array(binomial) / 2.0 ** (size - 1)
    features = torch.randn(2, 20, 22, 6)
    smooth = smooth_features(features, weights_of(size, twicing)).numpy()

    def average(values: np.ndarray) -> np.ndarray:
        return convolve1d(values, once, axis=1, mode="nearest")

    expected = average(features.numpy())
    if twicing:
        inner = slice(size - 1, 1 - size)
        expected = (expected + average(features.numpy() - expected))[:, inner]
        smooth = smooth[:, inner]
    np.testing.assert_allclose(smooth, expected, atol=1e-5)


def test_twicing_leaves_slow_motion_and_takes_the_fastest() -> None:
    """Shapiro's filter of order 2: 1 − sin⁴(ω/2)."""
    weights = weights_of(3, twicing=True)
    np.testing.assert_allclose(weights, np.array([-1, 4, 10, 4, -1]) / 16)
    time = torch.arange(60.0)
    for turn in (np.pi, np.pi / 2, np.pi / 3):  # 15, 7.5, 5 Hz
        wave = torch.cos(turn * time)[:, None, None].expand(60, 22, 6)
        kept = smooth_features(wave, weights)[4:-4] / wave[4:-4]
        expected = 1 - np.sin(turn / 2) ** 4
        there = wave[4:-4].abs() > 0.1
        torch.testing.assert_close(
            kept[there], torch.full_like(kept[there], expected), rtol=0, atol=1e-4
        )


@pytest.mark.parametrize("shape", [(12, 22, 6), (12, 23, 6), (3, 12, 23, 6), (2, 1, 23, 6)])
def test_smoothing_keeps_shape_constants_and_contacts(shape: tuple[int, ...]) -> None:
    features, weights = torch.randn(shape), weights_of(5, twicing=True)
    smooth, constant = smooth_features(features, weights), torch.full(shape, 0.7)
    assert smooth.shape == features.shape
    torch.testing.assert_close(smooth_features(constant, weights), constant)
    if shape[-2] == 23:
        assert torch.equal(smooth[..., 22, 4:], features[..., 22, 4:])
        if shape[-3] > 1:
            assert not torch.equal(smooth[..., 22, :4], features[..., 22, :4])


@pytest.mark.parametrize("twicing", [False, True])
def test_a_kernel_of_one_is_off(twicing: bool) -> None:
    features = torch.randn(12, 23, 6)
    assert smooth_features(features, weights_of(1, twicing)) is features


@pytest.mark.parametrize(("twicing", "left"), [(False, 0.4), (True, 0.6)])
def test_smoothing_takes_jitter_out(twicing: bool, left: float) -> None:
    features = encode_features(some_motion())
    noisy = features + 0.05 * torch.randn(
        features.shape, generator=torch.Generator().manual_seed(0)
    )
    before = (noisy - features)[:, :22].square().mean()
    after = (smooth_features(noisy, weights_of(5, twicing)) - features)[:, :22].square().mean()
    assert after < left * before


def test_the_clamp_without_a_limit_is_off() -> None:
    quaternions = torch.as_tensor(some_motion().quaternions)
    assert clamp_velocity(quaternions, None, 30.0) is quaternions


def test_the_clamp_leaves_slow_motion_alone() -> None:
    quaternions = torch.as_tensor(some_motion().quaternions)
    fastest = float(turn_rates(quaternions, 30.0).max())
    assert torch.equal(clamp_velocity(quaternions, 1.1 * fastest, 30.0), quaternions)


@settings(deadline=None, max_examples=30)
@given(seed=st.integers(0, 1000), limit=st.floats(0.5, 20.0), fps=st.sampled_from([20.0, 30.0]))
def test_the_clamp_bounds_every_joint(seed: int, limit: float, fps: float) -> None:
    generator = torch.Generator().manual_seed(seed)
    quaternions = torch.randn(15, 4, 4, generator=generator)
    quaternions = quaternions / quaternions.norm(dim=-1, keepdim=True)
    clamped = clamp_velocity(quaternions, limit, fps)
    assert float(turn_rates(clamped, fps).max()) <= limit * 1.001 + 1e-3
    torch.testing.assert_close(clamped.norm(dim=-1), torch.ones(15, 4), rtol=0, atol=1e-5)
    assert ((clamped[1:] * clamped[:-1]).sum(-1) > -1e-6).all()
    batched = clamp_velocity(quaternions.expand(2, -1, -1, -1), limit, fps)
    torch.testing.assert_close(batched[1], clamped)


def test_a_jump_becomes_a_ramp_that_arrives() -> None:
    angle = torch.zeros(31)
    angle[10:] = 1.0
    about_y = torch.stack((torch.zeros(31), angle, torch.zeros(31)), -1)[:, None]
    clamped = clamp_velocity(quaternion_exp(about_y), 3.0, 30.0)
    expected = (0.1 * (torch.arange(31) - 9)).clamp(0, 1)
    torch.testing.assert_close(quaternion_log(clamped)[:, 0, 1], expected, rtol=0, atol=1e-5)


def test_the_chain_does_nothing_when_all_is_off() -> None:
    features = encode_features(some_motion())
    processor = MotionPostProcessor(PostProcessingConfig(smoothing_kernel=1))
    motion, plain = processor(features, text="a prompt"), decode_features(features)
    np.testing.assert_array_equal(motion.quaternions, plain.quaternions)
    np.testing.assert_array_equal(motion.root_position, plain.root_position)
    assert motion.text == "a prompt"


@pytest.mark.parametrize("rows", [22, 23])
def test_the_whole_chain_gives_a_motion(rows: int) -> None:
    config = PostProcessingConfig(smoothing_kernel=3, max_velocity=6.0, foot_lock=True)
    features = encode_features(some_motion())[:, :rows]
    noisy = features + 0.1 * torch.randn(features.shape, generator=torch.Generator().manual_seed(0))
    motion = MotionPostProcessor(config)(noisy)
    assert motion.quaternions.shape == (40, 22, 4)
    assert motion.quaternions.dtype == motion.root_position.dtype == np.float32
    assert np.isfinite(motion.positions()).all()
    arms = torch.as_tensor(motion.quaternions)[:, 12:]
    assert float(turn_rates(arms, 30.0).max()) <= 6.01


def test_the_module_holds_no_weights() -> None:
    assert not MotionPostProcessor(PostProcessingConfig()).state_dict()


def waving(frames: int) -> Motion:
    """The middle of a wave: the hand is up at both ends."""
    clip = generate_clip(spec_for({"action": "wave", "side": "right", "speed": "slow"}, 0), seed=0)
    up = np.flatnonzero(clip.positions()[:, JOINT_INDEX["r_wrist"], 1] > 1.2)
    middle = int(up[len(up) // 2])
    return clip.frames(middle - frames // 2, middle + frames // 2)


def test_raised_hands_come_down_at_both_ends_without_a_jerk() -> None:
    motion = waving(90)
    assert not at_rest(motion)
    whole = rest_to_rest(motion)
    assert ends_at_rest(whole) and not ends_at_rest(motion)
    assert arms_alone(whole) and rests_in_place(whole) and not rests_in_place(motion)
    fade = round(REST_FADE * motion.fps)
    assert np.array_equal(whole.quaternions[fade:-fade], motion.quaternions[fade:-fade])
    speed = np.linalg.norm(np.diff(whole.positions(), axis=0), axis=-1) * motion.fps
    assert speed.max() < 4.0
    assert np.allclose(np.linalg.norm(whole.quaternions, axis=-1), 1.0, atol=1e-5)


def test_raised_hands_come_down_in_between() -> None:
    motion = waving(90)
    held = rest_to_rest(motion, held=True)
    assert np.array_equal(held.quaternions[-15:], motion.quaternions[-15:])
    cut = rest_to_rest(motion, [45])
    height = cut.positions()[:, JOINT_INDEX["r_wrist"], 1]
    assert height[44:46].max() < 1.0 < min(height[0], height[-1])
    assert np.array_equal(cut.quaternions[0], motion.quaternions[0])
    speed = np.linalg.norm(np.diff(cut.positions(), axis=0), axis=-1) * motion.fps
    assert speed.max() < 4.0


def test_arms_that_hang_are_left_alone() -> None:
    stand = generate_clip(spec_for({"action": "stand"}, 0), seed=0)
    assert np.array_equal(rest_to_rest(stand).quaternions, stand.quaternions)
    assert ends_at_rest(stand) and rests_in_place(stand) and not arms_alone(stand)


def test_what_is_too_short_for_both_fades_is_left_alone() -> None:
    short = waving(40)
    assert np.array_equal(rest_to_rest(short).quaternions, short.quaternions)


def walking(*landings: int, frames: int = 60) -> Motion:
    """Feet that land in turn in these frames, each lifted ten frames before."""
    motion = some_motion(frames)
    contacts = np.ones((frames, 2), np.float32)
    for number, frame in enumerate(landings):
        contacts[max(frame - 10, 0) : frame, number % 2] = 0
    return replace(motion, contacts=contacts)


def test_so_many_steps_end_where_the_last_foot_has_landed() -> None:
    motion = walking(3, 15, 30, 45)  # the first one had begun before
    assert until_landed(motion, 2, 60, 20).num_frames == 33
    assert until_landed(motion, 3, 60, 20).num_frames == 48
    assert until_landed(motion, 2, 40, 25).num_frames == 48  # of the last 40 frames
    assert until_landed(motion, 5, 60, 20).num_frames == 20
    assert until_landed(motion, 0, 60, 20) is motion


def clapping(swing: float) -> Motion:
    """Three claps whose arms go from how they are widest apart by a share of their way."""
    motion = generate_clip(spec_for({"action": "clap", "count": "3"}, 0), seed=0)
    gap = wrist_gap(motion)
    arms = [JOINT_INDEX[f"{side}_{joint}"] for side in "lr" for joint in ("shoulder", "elbow")]
    first, last = np.flatnonzero(gap < 0.2)[[0, -1]]
    wide = first + int(np.argmax(gap[first:last]))
    quaternions = torch.as_tensor(motion.quaternions)
    apart = quaternions[wide : wide + 1, arms].expand(len(quaternions), -1, -1)
    quaternions[:, arms] = quaternion_slerp(apart, quaternions[:, arms], torch.tensor(swing))
    return replace(motion, quaternions=quaternions.numpy())


def wrist_gap(motion: Motion) -> np.ndarray:
    positions = motion.positions()
    left, right = (positions[:, JOINT_INDEX[f"{side}_wrist"]] for side in "lr")
    return np.asarray(np.linalg.norm(left - right, axis=-1))


def test_hands_that_nearly_clap_meet() -> None:
    loose = clapping(0.6)
    assert measure(loose).claps == 0 and wrist_gap(loose).min() > 0.17
    met = hands_meet(loose, 0, loose.num_frames)
    gap, before = wrist_gap(met), wrist_gap(loose)
    assert measure(met).claps == 3 and gap.min() == pytest.approx(TOUCH, abs=2e-3)
    assert (gap <= before + 1e-5).all() and np.abs(np.diff(gap, 2)).max() < 0.1
    moved = [JOINT_INDEX[f"{s}_{name}"] for s in "lr" for name in ("shoulder", "elbow", "wrist")]
    others = [joint for joint in range(NUM_JOINTS) if joint not in moved]
    assert np.array_equal(met.quaternions[:, others], loose.quaternions[:, others])
    for wrist in (JOINT_INDEX["l_wrist"], JOINT_INDEX["r_wrist"]):  # hands turn as they did
        turned = [motion.kinematics()[1][:, wrist] for motion in (loose, met)]
        assert np.allclose(*turned, atol=1e-4)


def test_hands_are_left_alone_outside_the_claps_and_where_they_touch() -> None:
    loose, close = clapping(0.6), clapping(1.0)
    part = hands_meet(loose, 0, 20)
    assert np.array_equal(part.quaternions, loose.quaternions)
    assert np.abs(wrist_gap(hands_meet(close, 0, close.num_frames)) - wrist_gap(close)).max() < 0.03
    stand = some_motion()
    assert hands_meet(stand, 0, stand.num_frames) is stand
