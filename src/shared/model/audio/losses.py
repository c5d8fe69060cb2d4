"""What decoders and end-to-end fine-tuning are trained on (TECH 7.2, 14.1; rulings 16, 23, 24).

Every loss returns its weighted terms by name; terms of weight 0 are left out. The diffusion loss
itself is `GaussianDiffusion.training_loss`.

Letters: B batch, T frames; trajectories [B, T, 25] in raw units.
"""

import math
from collections.abc import Mapping

import torch
from torch import Tensor, nn
from torch.nn import functional as F

from ...config_audio import DecoderLossConfig, TemporalLossConfig
from ...motion.trajectory import (
    ACCELERATION,
    ANGULAR_VELOCITY,
    PHASE,
    POSITION,
    QUATERNION,
    STYLE,
    VELOCITY,
)


def total(terms: Mapping[str, Tensor]) -> Tensor:
    """The sum of weighted terms, a scalar."""
    return torch.stack(list(terms.values())).sum()


def wrapped_difference(difference: Tensor) -> Tensor:
    """Differences of phases [...] in bars, brought into [-1/2, 1/2); gradient 1."""
    return difference - (difference.detach() + 0.5).floor()


class DecoderLoss(nn.Module):
    """Mean squared error of each component, in the geometry it lives in."""

    def __init__(self, config: DecoderLossConfig | None = None) -> None:
        super().__init__()
        self.config = config or DecoderLossConfig()

    def forward(self, decoded: Tensor, target: Tensor) -> dict[str, Tensor]:
        """Decoded and true trajectory [B, T, 25] -> weighted scalar terms."""
        with torch.autocast(decoded.device.type, enabled=False):
            decoded, target = decoded.float(), target.float()
            errors = {
                "position": _mse(decoded, target, POSITION),
                "velocity": _mse(decoded, target, VELOCITY),
                "acceleration": _mse(decoded, target, ACCELERATION),
                "quaternion": quaternion_error(decoded, target),
                "angular_velocity": _mse(decoded, target, ANGULAR_VELOCITY),
                "phase": phase_error(decoded, target),
                "style": _mse(decoded, target, STYLE),
            }
            weights = {name: getattr(self.config, f"{name}_weight") for name in errors}
            return _weighted({name: (weights[name], errors[name]) for name in errors})


class TemporalCoherenceLoss(nn.Module):
    """Do the components of a trajectory agree from frame to frame (TECH 7.2)?

    As printed, except that TECH's phase term charges exactly the legal wraps, and its quaternion
    term lets a flip of sign pass (ruling 23). The root in its jerk is gone, value unchanged: it
    has no gradient at zero.
    """

    def __init__(self, config: TemporalLossConfig | None = None) -> None:
        super().__init__()
        self.config = config or TemporalLossConfig()

    def forward(self, decoded: Tensor) -> dict[str, Tensor]:
        """A trajectory [B, T, 25] -> weighted scalar terms."""
        with torch.autocast(decoded.device.type, enabled=False):
            decoded = decoded.float()
            config = self.config
            return _weighted(
                {
                    "jerk": (config.jerk_weight, self.jerk(decoded)),
                    "velocity_coherence": (
                        config.velocity_weight,
                        self._coherence(decoded, POSITION, VELOCITY, config.target_vel_coherence),
                    ),
                    "accel_coherence": (
                        config.acceleration_weight,
                        self._coherence(
                            decoded, VELOCITY, ACCELERATION, config.target_accel_coherence
                        ),
                    ),
                    "quat_delta": (config.quat_delta_weight, self.quat_delta(decoded)),
                    "phase_monotonic": (config.phase_monotonic_weight, phase_backward(decoded)),
                    "position_smoothness": (config.smoothness_weight, self.smoothness(decoded)),
                }
            )

    def jerk(self, decoded: Tensor) -> Tensor:
        """Mean over frames of (|jerk| / target)^2, from the explicit acceleration."""
        acceleration = decoded[..., ACCELERATION]
        jerk = (acceleration[:, 1:] - acceleration[:, :-1]) * self.config.fps  # [B, T-1, 3]
        return (jerk / self.config.target_jerk).square().sum(dim=-1).mean()

    def quat_delta(self, decoded: Tensor) -> Tensor:
        """Mean shortfall of the signed dot of neighbours below the target."""
        quaternion = decoded[..., QUATERNION]
        dot = (quaternion[:, 1:] * quaternion[:, :-1]).sum(dim=-1)  # [B, T-1]
        return F.relu(self.config.target_quat_delta - dot).mean()

    def smoothness(self, decoded: Tensor) -> Tensor:
        """Mean metres that a step exceeds max-step on an axis (TECH 14.1)."""
        position = decoded[..., POSITION]
        return F.relu((position[:, 1:] - position[:, :-1]).abs() - self.config.max_step).mean()

    def _coherence(self, decoded: Tensor, below: slice, above: slice, target: float) -> Tensor:
        """Mean squared gap between `above` and the forward difference of `below`, over target^2."""
        values, explicit = decoded[..., below], decoded[..., above]
        derived = (values[:, 1:] - values[:, :-1]) * self.config.fps  # [B, T-1, 3]
        return ((explicit[:, :-1] - derived) / target).square().mean()


def quaternion_error(decoded: Tensor, target: Tensor) -> Tensor:
    """MSE of unit quaternions, q and -q being one: (1 - |dot|) / 2, a scalar."""
    dot = (decoded[..., QUATERNION] * target[..., QUATERNION]).sum(dim=-1)
    return (1 - dot.abs()).mean() / 2


def phase_error(decoded: Tensor, target: Tensor) -> Tensor:
    """Squared error of the phase in bars for small errors, smooth around the circle; a scalar."""
    difference = decoded[..., PHASE] - target[..., PHASE]
    return (1 - torch.cos(2 * math.pi * difference)).mean() / (2 * math.pi**2)


def phase_backward(decoded: Tensor) -> Tensor:
    """Bars that the phase runs backwards in a window, mean over the batch (ruling 23)."""
    phase = decoded[..., PHASE]
    steps = wrapped_difference(phase[:, 1:] - phase[:, :-1])  # [B, T-1]
    return F.relu(-steps).sum(dim=-1).mean()


def _mse(decoded: Tensor, target: Tensor, columns: slice) -> Tensor:
    return F.mse_loss(decoded[..., columns], target[..., columns])


def _weighted(terms: Mapping[str, tuple[float, Tensor]]) -> dict[str, Tensor]:
    return {name: weight * value for name, (weight, value) in terms.items() if weight > 0}
