"""Derivatives against closed forms, signs, phase, and the way from and to a body."""

import numpy as np
import pytest
import torch
from hypothesis import given, settings
from hypothesis import strategies as st

from src.shared.motion.features import LEFT_CONTACT, Place, decode_features, encode_features
from src.shared.motion.rotations import angular_velocity, derive, forward_difference, yaw_quaternion
from src.shared.motion.trajectory import (
    CHANNELS,
    MotionTrajectory,
    from_motion,
    to_motion,
    to_root,
    unwrap_phase,
    wrap_phase,
)
from tests.shared.motion.trajectories import smooth_trajectory

seeds = st.integers(0, 10_000)


def test_a_circle_has_the_closed_form_derivatives() -> None:
    radius, rate, fps = 2.0, 1.5, 30.0
    angle = torch.arange(90, dtype=torch.float64) * rate / fps
    position = torch.stack(
        (radius * torch.sin(angle), torch.full_like(angle, 0.9), radius * torch.cos(angle)), -1
    )
    velocity, acceleration, turning = derive(position, yaw_quaternion(angle), fps)
    chord = 2 * radius * np.sin(rate / fps / 2) * fps  # forward difference of a circle, exactly
    assert torch.allclose(velocity.norm(dim=-1), torch.tensor(chord, dtype=torch.float64))
    expected = chord * 2 * np.sin(rate / fps / 2) * fps
    assert acceleration[:-2].norm(dim=-1).numpy() == pytest.approx(expected)
    assert torch.equal(acceleration[-2:], torch.zeros(2, 3, dtype=torch.float64))
    assert turning[:, 1].numpy() == pytest.approx(rate)
    assert turning[:, (0, 2)].abs().max() < 1e-9


def test_differences_of_a_ramp_and_of_one_frame() -> None:
    ramp = torch.arange(5.0)[:, None]
    assert torch.equal(forward_difference(ramp, 30.0), torch.full((5, 1), 30.0))
    assert torch.equal(forward_difference(ramp[:1], 30.0), torch.zeros(1, 1))
    assert torch.equal(angular_velocity(torch.ones(1, 4) / 2, 30.0), torch.zeros(1, 3))


def test_angular_velocity_is_in_the_world_frame() -> None:
    """A body that lies on its side and rolls about the world's +Y."""
    angle = torch.arange(10.0) * 0.1
    lying = torch.tensor((0.5**0.5, 0.0, 0.0, 0.5**0.5)).expand(10, 4)
    turn = yaw_quaternion(angle)
    from src.shared.motion.rotations import quaternion_multiply

    rate = angular_velocity(quaternion_multiply(turn, lying), 30.0)
    assert torch.allclose(rate, torch.tensor((0.0, 3.0, 0.0)).expand(10, 3), atol=1e-4)


def test_gradients_are_finite_on_a_frozen_path() -> None:
    position = torch.zeros(1, 6, 3, requires_grad=True)
    quaternion = torch.tensor((1.0, 0, 0, 0)).repeat(1, 6, 1).requires_grad_()
    sum(part.square().sum() + part.sum() for part in derive(position, quaternion, 30.0)).backward()
    assert position.grad is not None and position.grad.isfinite().all()
    assert quaternion.grad is not None and quaternion.grad.isfinite().all()


@settings(max_examples=20, deadline=None)
@given(seeds, seeds)
def test_quaternion_signs_follow_ruling_10(seed: int, flips: int) -> None:
    whole = smooth_trajectory(seed)
    signs = np.random.default_rng(flips).choice((-1.0, 1.0), (whole.num_frames, 1))
    again = MotionTrajectory.from_pose(
        whole.position, whole.quaternion * signs, whole.phase_unwrapped, whole.style
    )
    assert again.quaternion[0, 0] >= 0
    assert ((again.quaternion[1:] * again.quaternion[:-1]).sum(1) > 0.9).all()
    assert np.abs(again.quaternion - whole.quaternion).max() < 1e-6


@settings(max_examples=20, deadline=None)
@given(seeds)
def test_phase_unwraps_to_what_it_was(seed: int) -> None:
    phase = np.cumsum(np.random.default_rng(seed).uniform(0, 0.1, 200))
    wrapped = wrap_phase(phase)
    assert wrapped.dtype == np.float32 and (wrapped >= 0).all() and (wrapped < 1).all()
    back = unwrap_phase(wrapped)
    assert np.abs((back - back[0]) - (phase - phase[0])).max() < 1e-6
    assert wrap_phase(np.array([1 - 1e-12]))[0] == 0


def test_spare_frames_keep_the_end_whole() -> None:
    whole = smooth_trajectory(3, 60)
    pose = (whole.position, whole.quaternion, whole.phase_unwrapped, whole.style)
    cropped = MotionTrajectory.from_pose(*pose, spare=2)
    assert cropped.num_frames == 58
    assert np.abs(cropped.acceleration[-1]).max() > 0.1
    assert not whole.acceleration[-1].any()


def test_the_pelvis_of_a_body_and_back_to_its_root_rows() -> None:
    whole = smooth_trajectory(5, 90)
    body = to_motion(whole, text="a path")
    again = from_motion(body, whole.phase_unwrapped, whole.style)
    assert np.abs(again.data - whole.data).max() < 2e-3  # accelerations of float32 positions
    expected = encode_features(body)[:, -1]
    root = to_root(whole)
    assert torch.allclose(root[:, :LEFT_CONTACT], expected[:, :LEFT_CONTACT], atol=2e-4)
    features = encode_features(body)
    features[:, -1] = root
    x, _, z = whole.position[0]
    path = decode_features(features, place=Place(float(x), float(z), float(whole.heading[0])))
    assert np.abs(path.root_position - whole.position).max() < 1e-3


def test_neutral_style_and_wrong_shapes() -> None:
    body = to_motion(smooth_trajectory(1, 12))
    trajectory = from_motion(body)
    assert np.linalg.norm(trajectory.style, axis=1) == pytest.approx(1)
    assert not trajectory.phase.any()
    assert trajectory.seconds == pytest.approx(0.4)
    with pytest.raises(ValueError, match=r"\[T,25\]"):
        MotionTrajectory(np.zeros((CHANNELS, 4), dtype=np.float32))
