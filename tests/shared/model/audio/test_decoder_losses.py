"""Decoder and temporal losses against closed forms, and the faults of TECH 7.2 that they avoid."""

import math

import pytest
import torch
from torch import Tensor

from src.shared.config_audio import DecoderLossConfig, TemporalLossConfig
from src.shared.model.audio.decoder import (
    DecoderLoss,
    TemporalCoherenceLoss,
    phase_backward,
    phase_error,
    quaternion_error,
    total,
    wrapped_difference,
)
from src.shared.motion.trajectory import PHASE, POSITION, QUATERNION
from tests.shared.model.audio.tiny_audio import walk

PLAIN = TemporalLossConfig(
    velocity_weight=1,
    acceleration_weight=1,
    jerk_weight=1,
    quat_delta_weight=1,
    phase_monotonic_weight=1,
)


def still(frames: int = 10) -> Tensor:
    x = torch.zeros(2, frames, 25)
    x[..., 9] = 1
    return x


def temporal(x: Tensor) -> dict[str, float]:
    return {name: float(value) for name, value in TemporalCoherenceLoss(PLAIN)(x).items()}


def test_a_coherent_walk_costs_next_to_nothing() -> None:
    x = walk()
    x[..., PHASE] = (torch.arange(60) * 0.5 / 30) % 1  # crosses a bar line
    terms = temporal(x)
    assert terms.pop("jerk") < 1e-4
    assert max(terms.values()) < 1e-9


def test_velocity_term() -> None:
    """Velocity 2 m/s on a still path: mean of (2/5)^2, 0, 0."""
    x = still()
    x[..., 3] = 2.0
    assert temporal(x)["velocity_coherence"] == pytest.approx((2 / 5) ** 2 / 3)


def test_acceleration_term() -> None:
    x = still()
    x[..., 7] = 25.0
    assert temporal(x)["accel_coherence"] == pytest.approx((25 / 50) ** 2 / 3)


def test_jerk_term() -> None:
    """Acceleration growing by 10 a frame: jerk 300 on two axes, 2 * (300 / 50000)^2."""
    x = still()
    x[..., 6] = x[..., 8] = 10.0 * torch.arange(10)
    assert temporal(x)["jerk"] == pytest.approx(2 * (300 / 50_000) ** 2)


def test_quaternion_term_is_signed() -> None:
    """A flip of sign costs 1.95 in its frame; TECH's absolute dot lets it pass (ruling 23)."""
    x = still()
    x[:, 4:, 9] = -1
    assert temporal(x)["quat_delta"] == pytest.approx(1.95 / 9)


def test_phase_term_charges_backward_steps_and_no_wraps() -> None:
    x = still(5)
    x[..., PHASE] = torch.tensor([0.7, 0.9, 0.1, 0.3, 0.5])  # a legal wrap
    assert float(phase_backward(x)) == pytest.approx(0.0, abs=1e-6)
    x[0, :, PHASE] = torch.tensor([0.7, 0.6, 0.65, 0.65, 0.45])  # back by 0.1 and 0.2
    assert float(phase_backward(x)) == pytest.approx(0.3 / 2, abs=1e-6)


def test_smoothness_term() -> None:
    """Steps of 0.8 m on one axis of three exceed 0.5 by 0.3."""
    x = still()
    x[..., 0] = 0.8 * torch.arange(10)
    assert temporal(x)["position_smoothness"] == pytest.approx(0.1, rel=1e-4)


def test_weights_multiply_and_zero_switches_off() -> None:
    x = still()
    x[..., 3] = 2.0
    config = PLAIN.model_copy(update={"velocity_weight": 10.0, "jerk_weight": 0.0})
    terms = TemporalCoherenceLoss(config)(x)
    assert "jerk" not in terms
    assert float(terms["velocity_coherence"]) == pytest.approx(
        10 * temporal(x)["velocity_coherence"]
    )
    assert float(total(terms)) == pytest.approx(sum(map(float, terms.values())))


def test_a_still_body_has_finite_gradients() -> None:
    """TECH's root of a square has none at zero."""
    x = still().requires_grad_()
    total(TemporalCoherenceLoss()(x)).backward()
    assert x.grad is not None and x.grad.isfinite().all()


def test_decoder_terms() -> None:
    target, decoded = still(), still()
    decoded[..., POSITION] += 2.0
    half = math.radians(30) / 2
    decoded[..., QUATERNION] = torch.tensor([math.cos(half), math.sin(half), 0, 0])
    decoded[..., PHASE] = 0.98
    target[..., PHASE] = 0.01
    config = DecoderLossConfig(position_weight=3.0, style_weight=0.0)
    terms = {name: float(value) for name, value in DecoderLoss(config)(decoded, target).items()}
    assert terms["position"] == pytest.approx(3 * 4)
    assert terms["quaternion"] == pytest.approx((1 - math.cos(half)) / 2, rel=1e-3)
    assert terms["phase"] == pytest.approx(0.03**2, rel=0.01)
    assert terms["velocity"] == terms["acceleration"] == terms["angular_velocity"] == 0
    assert "style" not in terms


def test_quaternion_error_is_the_mean_squared_error_and_blind_to_sign() -> None:
    torch.manual_seed(0)
    target, decoded = still(), still()
    target[..., QUATERNION] = torch.nn.functional.normalize(torch.randn(2, 10, 4), dim=-1)
    turned = target[..., QUATERNION] + 0.1 * torch.randn(2, 10, 4)
    decoded[..., QUATERNION] = torch.nn.functional.normalize(turned, dim=-1)
    mse = (decoded[..., QUATERNION] - target[..., QUATERNION]).square().mean()
    torch.testing.assert_close(quaternion_error(decoded, target), mse, rtol=1e-4, atol=1e-6)
    decoded[..., QUATERNION] *= -1
    torch.testing.assert_close(quaternion_error(decoded, target), mse, rtol=1e-4, atol=1e-6)


def test_phase_error_is_largest_half_a_bar_away() -> None:
    target, decoded = still(), still()
    decoded[..., PHASE] = 0.5
    assert float(phase_error(decoded, target)) == pytest.approx(1 / math.pi**2)


def test_wrapped_difference() -> None:
    values = torch.tensor([0.9, -0.9, 0.2, -0.2, 0.5, -0.5])
    expected = torch.tensor([-0.1, 0.1, 0.2, -0.2, -0.5, -0.5])
    torch.testing.assert_close(wrapped_difference(values), expected)
