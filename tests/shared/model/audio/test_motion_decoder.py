"""Both decoders keep their promises for any input, and change little before training."""

import math

import pytest
import torch
from hypothesis import given
from hypothesis import strategies as st
from torch import Tensor

from src.shared.config_audio import DecoderConfig
from src.shared.model.audio.decoder import (
    GAPS,
    Decoder,
    DerivedMotionDecoder,
    MotionDecoder,
    bounded,
    create_motion_decoder,
    gaps,
    limit_speed,
    wrapped_phase,
)
from src.shared.motion.rotations import derive
from src.shared.motion.trajectory import (
    ACCELERATION,
    ANGULAR_VELOCITY,
    PHASE,
    POSITION,
    QUATERNION,
    STYLE,
    VELOCITY,
)
from tests.shared.model.audio.tiny_audio import awake, walk

KINDS = ["residual", "derived"]


def decoder(kind: str, *, random: bool = False) -> Decoder:
    torch.manual_seed(0)
    made = create_motion_decoder(DecoderConfig.model_validate({"decoder": kind, "hidden-dim": 16}))
    if random:
        awake(made)
    return made.eval()


def wild(seed: int, frames: int = 40, scale: float = 30.0) -> Tensor:
    return scale * torch.randn(2, frames, 25, generator=torch.Generator().manual_seed(seed))


@pytest.mark.parametrize("kind", KINDS)
def test_an_untrained_decoder_leaves_a_good_trajectory_as_it_is(kind: str) -> None:
    x = walk()
    decoded = decoder(kind).decode(x, start=torch.tensor([0.1]))
    out = decoded.trajectory
    torch.testing.assert_close(out[..., POSITION], x[..., POSITION], atol=2e-3, rtol=0)
    torch.testing.assert_close(out[..., QUATERNION], x[..., QUATERNION], atol=1e-6, rtol=0)
    torch.testing.assert_close(out[..., VELOCITY], x[..., VELOCITY], atol=5e-3, rtol=0)
    torch.testing.assert_close(
        out[:, :-2, ACCELERATION], x[:, :-2, ACCELERATION], atol=2e-2, rtol=0
    )
    torch.testing.assert_close(
        out[..., ANGULAR_VELOCITY], x[..., ANGULAR_VELOCITY], atol=2e-2, rtol=0
    )
    torch.testing.assert_close(out[..., STYLE], x[..., STYLE])
    expected = 0.1 + torch.arange(60) * 0.5 / 30
    torch.testing.assert_close(decoded.phase_unwrapped[0], expected, atol=1e-4, rtol=0)


@pytest.mark.parametrize("kind", KINDS)
@given(seed=st.integers(0, 10_000))
def test_constraints_hold_for_any_input(kind: str, seed: int) -> None:
    decoded = decoder(kind, random=True).decode(wild(seed))
    out = decoded.trajectory.detach()
    assert out.shape == (2, 40, 25) and out.isfinite().all()
    quaternion = out[..., QUATERNION]
    torch.testing.assert_close(quaternion.norm(dim=-1), torch.ones(2, 40))
    assert (quaternion[:, 0, 0] >= 0).all()
    assert ((quaternion[:, 1:] * quaternion[:, :-1]).sum(dim=-1) >= 0).all()
    torch.testing.assert_close(out[..., STYLE].norm(dim=-1), torch.ones(2, 40))
    assert (out[..., PHASE] >= 0).all() and (out[..., PHASE] < 1).all()
    assert (decoded.phase_unwrapped.diff(dim=1) >= 0).all()
    assert (out[..., VELOCITY].norm(dim=-1) <= 50 * math.sqrt(3) + 1e-3).all()
    if kind == "residual":
        assert (out[..., POSITION].abs() <= 50).all()
        assert (out[..., ACCELERATION].abs() <= 100).all()
        assert (out[..., ANGULAR_VELOCITY].abs() <= 10).all()


def test_derived_quantities_agree_with_the_path() -> None:
    out = decoder("derived", random=True)(wild(1, scale=1.0))
    velocity, acceleration, turning = derive(out[..., POSITION], out[..., QUATERNION], 30.0)
    torch.testing.assert_close(out[..., VELOCITY], velocity)
    torch.testing.assert_close(out[..., ACCELERATION], acceleration)
    torch.testing.assert_close(out[..., ANGULAR_VELOCITY], turning)


@given(seed=st.integers(0, 10_000), scale=st.floats(0.001, 100))
def test_speed_is_bounded_smoothly(seed: int, scale: float) -> None:
    path = scale * torch.randn(30, 3, generator=torch.Generator().manual_seed(seed))
    limited = limit_speed(path, 50.0, 30.0)
    speed = (limited.diff(dim=0) * 30).norm(dim=-1)
    assert (speed <= 50.01 + 1e-4 * scale * 30).all()
    torch.testing.assert_close(limited[0], path[0])


def test_human_speeds_pass_unchanged() -> None:
    path = walk()[0, :, POSITION]
    torch.testing.assert_close(limit_speed(path, 50.0, 30.0), path, atol=1e-5, rtol=0)


@pytest.mark.parametrize("kind", KINDS)
def test_phase_starts_where_it_is_told_or_guesses_within_a_bar(kind: str) -> None:
    model, x = decoder(kind, random=True), walk()
    told = model.decode(x, start=torch.tensor([0.37])).phase_unwrapped
    assert float(told.detach()[0, 0]) == pytest.approx(0.37)
    guessed = model.decode(x).phase_unwrapped
    assert abs(float(guessed.detach()[0, 0])) <= 0.5
    torch.testing.assert_close(guessed - guessed[:, :1], told - told[:, :1])


@pytest.mark.parametrize("kind", KINDS)
def test_backward_increments_become_a_pause(kind: str) -> None:
    x = walk()
    x[..., PHASE] = -1.0
    bars = decoder(kind).decode(x, start=torch.zeros(1)).phase_unwrapped
    assert (bars >= 0).all() and bars.max() < 0.01


def test_wrapped_phase_stays_below_one_and_keeps_its_gradient() -> None:
    bars = torch.tensor([-1e-9, 0.0, 0.25, 1.0, 3.75, -0.25], requires_grad=True)
    phase = wrapped_phase(bars)
    torch.testing.assert_close(phase, torch.tensor([0, 0, 0.25, 0, 0.75, 0.75]))
    phase.sum().backward()
    assert bars.grad is not None and (bars.grad == 1).all()


def test_bounded_is_the_identity_near_zero() -> None:
    x = torch.tensor([-500.0, 0.0, 0.1, 500.0])
    torch.testing.assert_close(bounded(x, 50.0), torch.tensor([-50, 0, 0.1, 50]))


@pytest.mark.parametrize("kind", KINDS)
def test_every_parameter_gets_a_gradient(kind: str) -> None:
    model = decoder(kind, random=True).train()
    weights = torch.randn(25, generator=torch.Generator().manual_seed(0))
    (model(walk()) * weights).sum().backward()
    silent = [name for name, p in model.named_parameters() if p.grad is None or not p.grad.any()]
    assert not silent


@pytest.mark.parametrize("kind", KINDS)
def test_degenerate_input_has_finite_gradients(kind: str) -> None:
    """A still body: no speed, no turn, no phase."""
    x = torch.zeros(1, 12, 25)
    x[..., 9] = 1
    x[..., 17] = 1
    x.requires_grad_()
    decoder(kind)(x).square().sum().backward()
    assert x.grad is not None and x.grad.isfinite().all()


def test_layers_and_sizes_are_the_documents() -> None:
    """TECH: 1.6M with seven heads; REF: 0.4M with four (ruling 1); the phase start is ours."""
    residual, derived = MotionDecoder(), DerivedMotionDecoder()
    heads = {name for name, _ in residual.named_children() if name.endswith("_head")}
    names = ("position", "velocity", "acceleration", "quaternion", "angular_velocity")
    assert heads == {f"{name}_head" for name in (*names, "phase", "style", "phase_start")}
    heads = {name for name, _ in derived.named_children() if name.endswith("_head")}
    assert heads == {
        f"{name}_head" for name in ("position", "quaternion", "phase", "style", "phase_start")
    }
    for model, millions in ((residual, 1.6), (derived, 0.4)):
        count = sum(parameter.numel() for parameter in model.parameters())
        assert count / 1e6 == pytest.approx(millions, abs=0.05)


def test_gaps_are_what_a_derivative_lacks() -> None:
    x = walk()
    assert gaps(x, 30.0).shape == (1, 60, GAPS)
    assert gaps(x, 30.0)[:, :-2].abs().max() < 1e-2  # a walk's columns agree
    x[..., VELOCITY] += 0.1
    found = gaps(x, 30.0)[:, :-2]
    torch.testing.assert_close(found[..., :3], torch.full((1, 58, 3), -0.5), atol=1e-3, rtol=0)
    assert found[..., 3:].abs().max() < 1e-2


def test_with_gaps_a_frame_can_follow_its_neighbours() -> None:
    """A linear reading of the gaps makes velocities those of the path; without, nothing could."""
    made = MotionDecoder(DecoderConfig(decoder="residual", hidden_dim=16, sees_gaps=True)).eval()
    x = walk()
    x[..., VELOCITY] = 0
    with torch.no_grad():
        for axis in range(3):
            made.velocity_head.weight[axis, 16 + axis] = 1 / 5
    velocity = made(x)[0, :-1, VELOCITY]
    torch.testing.assert_close(velocity, 30 * x[0, :, POSITION].diff(dim=0), atol=0.02, rtol=0)
