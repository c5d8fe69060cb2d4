"""From what the diffusion gives to a valid trajectory: two decoders, and what they are trained on.

TECH 3.3, REF; ruling 5. Both take rows in raw units, channel 16 being bars a frame, and give the 25
columns of src.shared.motion.trajectory. They begin as a correction of nothing: heads are added to
the input and start at zero, so that an untrained decoder only enforces the constraints.

Losses of decoders and of end-to-end fine-tuning (TECH 7.2, 14.1; rulings 16, 23, 24) return their
weighted terms by name; terms of weight 0 are left out. The diffusion loss itself is
`GaussianDiffusion.training_loss`.

Letters: B batch, T frames, D hidden dim; trajectories [B, T, 25] in raw units.
"""

import math
from collections.abc import Mapping
from itertools import pairwise

import torch
from torch import Tensor, nn
from torch.nn import functional as F

from ...config_audio import DecoderConfig, DecoderLossConfig, TemporalLossConfig
from ...motion.rotations import derive, forward_difference, quaternion_continuous
from ...motion.trajectory import (
    ACCELERATION,
    ANGULAR_VELOCITY,
    PHASE,
    POSITION,
    QUATERNION,
    STYLE,
    VELOCITY,
)
from . import Decoded

# About one over the spread of each column: bars a frame are near 1/60, accelerations near 10.
INPUT_SCALE = (*(1.0,) * 6, *(0.1,) * 3, *(1.0,) * 4, *(0.5,) * 3, 50.0, *(3.0,) * 8)
GAPS = 9  # further inputs of the residual decoder, see `gaps`
PHASE_SHARPNESS = 1000.0  # of the softplus, in frames a bar: the identity from 0.004 bars up


class ResidualBlock(nn.Module):
    """LayerNorm and an MLP D -> 4D -> D around a skip (TECH 3.3.2)."""

    def __init__(self, hidden_dim: int, dropout: float = 0.1) -> None:
        super().__init__()
        self.layers = nn.Sequential(
            nn.LayerNorm(hidden_dim),
            nn.Linear(hidden_dim, hidden_dim * 4),
            nn.GELU(),
            nn.Dropout(dropout),
            nn.Linear(hidden_dim * 4, hidden_dim),
            nn.Dropout(dropout),
        )

    def forward(self, x: Tensor) -> Tensor:
        """[B, T, D] -> the same."""
        result: Tensor = x + self.layers(x)
        return result


class TemporalBlock(nn.Module):
    """Conv1D over time, LayerNorm, GELU (REF)."""

    def __init__(self, dim: int, hidden_dim: int) -> None:
        super().__init__()
        self.conv = nn.Conv1d(dim, hidden_dim, 3, padding=1, padding_mode="replicate")
        self.norm = nn.LayerNorm(hidden_dim)

    def forward(self, x: Tensor) -> Tensor:
        """[B, T, C] -> [B, T, D]."""
        return F.gelu(self.norm(self.conv(x.transpose(1, 2)).transpose(1, 2)))


class Decoder(nn.Module):
    """What both decoders share: the heads that never are derived."""

    input_scale: Tensor

    def __init__(self, config: DecoderConfig) -> None:
        super().__init__()
        self.config = config
        self.register_buffer("input_scale", torch.tensor(INPUT_SCALE), persistent=False)
        self.position_head = self._head(3)
        self.quaternion_head = self._head(4)
        self.phase_head = self._head(1)
        self.phase_start_head = self._head(2)  # cosine and sine of the first frame's bar phase
        self.style_head = self._head(8)
        with torch.no_grad():
            self.phase_start_head.bias.copy_(torch.tensor((1.0, 0.0)))  # phase 0, not atan2(0, 0)

    def _head(self, channels: int, extra: int = 0) -> nn.Linear:
        head = nn.Linear(self.config.hidden_dim + extra, channels)
        nn.init.zeros_(head.weight)
        nn.init.zeros_(head.bias)
        return head

    def decode(self, x: Tensor, start: Tensor | None = None) -> Decoded:
        """The trajectory of a window.

        Args:
            x: [B, T, 25] raw units, channel 16 = bars a frame.
            start: bar phase of the first frame [B], as the beat tracker knows it; None = guessed
                by the phase-start head from the window's motion.
        """
        with torch.autocast(x.device.type, enabled=False):  # metres do not fit into bf16
            return self._decode(x.float(), start)

    def forward(self, x: Tensor, start: Tensor | None = None) -> Tensor:
        """As `decode`, the trajectory [B, T, 25] only."""
        return self.decode(x, start).trajectory

    def _decode(self, x: Tensor, start: Tensor | None) -> Decoded:
        h, motion = self._motion(x)
        phase = self._phase(x, h, start)
        style = F.normalize(x[..., STYLE] + self.style_head(h), dim=-1)
        columns = (*motion, wrapped_phase(phase)[..., None], style)
        return Decoded(torch.cat(columns, dim=-1), phase)

    def _motion(self, x: Tensor) -> tuple[Tensor, tuple[Tensor, ...]]:
        """Hidden states [B, T, D]; position, velocity, acceleration, quaternion and turning."""
        raise NotImplementedError

    def _position(self, x: Tensor, h: Tensor) -> Tensor:
        return bounded(x[..., POSITION] + self.position_head(h), self.config.position_scale)

    def _quaternion(self, x: Tensor, h: Tensor) -> Tensor:
        """Unit, first w >= 0, then one hemisphere (ruling 10)."""
        unit = F.normalize(x[..., QUATERNION] + self.quaternion_head(h), dim=-1)
        return quaternion_continuous(unit, dim=-2)

    def _phase(self, x: Tensor, h: Tensor, start: Tensor | None) -> Tensor:
        """Bars [B, T]: a start, then the sum of increments that softplus keeps above 0.

        Increment t leads from frame t to t + 1 (forward differences, ruling 6; ruling 9).
        """
        raw = x[..., PHASE] + self.phase_head(h)[..., 0] / PHASE_SHARPNESS  # [B, T]
        increments = F.softplus(raw * PHASE_SHARPNESS) / PHASE_SHARPNESS
        if start is None:
            cosine, sine = self.phase_start_head(h.mean(dim=1)).unbind(-1)  # [B] each
            start = torch.atan2(sine, cosine) / (2 * math.pi)
        bars = increments[:, :-1].cumsum(dim=1)  # [B, T-1]
        return start[:, None] + F.pad(bars, (1, 0))


class MotionDecoder(Decoder):
    """Residual MLP with a head for each component (TECH 3.3.2; rulings 5, 7, 9).

    As TECH draws it, it sees one frame at a time and so cannot tell whether a velocity belongs to
    the path: with `sees-gaps` each frame brings its gaps along, past the normalised blocks as
    well, for closing a gap is a sum.
    """

    def __init__(self, config: DecoderConfig | None = None) -> None:
        config = config or DecoderConfig(decoder="residual")
        super().__init__(config)
        extra = GAPS if config.sees_gaps else 0
        self.input_proj = nn.Linear(len(INPUT_SCALE) + extra, config.hidden_dim)
        self.blocks = nn.ModuleList(
            ResidualBlock(config.hidden_dim, config.dropout) for _ in range(config.num_layers)
        )
        self.velocity_head = self._head(3, extra)
        self.acceleration_head = self._head(3, extra)
        self.angular_velocity_head = self._head(3)

    def _motion(self, x: Tensor) -> tuple[Tensor, tuple[Tensor, ...]]:
        config = self.config
        missed = gaps(x, config.fps) if config.sees_gaps else x[..., :0]  # [B, T, 9 or 0]
        h = self.input_proj(torch.cat((x * self.input_scale, missed), dim=-1))  # [B, T, D]
        for block in self.blocks:
            h = block(h)  # [B, T, D]
        aware = torch.cat((h, missed), dim=-1)
        velocity = x[..., VELOCITY] + self.velocity_head(aware)
        acceleration = x[..., ACCELERATION] + self.acceleration_head(aware)
        turning = x[..., ANGULAR_VELOCITY] + self.angular_velocity_head(h)
        return h, (
            self._position(x, h),
            bounded(velocity, config.velocity_scale),
            bounded(acceleration, config.acceleration_scale),
            self._quaternion(x, h),
            bounded(turning, config.angular_velocity_scale),
        )


class DerivedMotionDecoder(Decoder):
    """Conv1D encoder and four heads; velocity, acceleration and turning are derived (REF).

    Speed is bounded before anything is derived, so that the three always agree (ruling 6).
    The last two accelerations are not those of a longer window: give spare frames and crop.
    """

    def __init__(self, config: DecoderConfig | None = None) -> None:
        config = config or DecoderConfig(decoder="derived")
        super().__init__(config)
        widths = [len(INPUT_SCALE)] + [config.hidden_dim] * config.num_layers
        self.encoder = nn.ModuleList(
            TemporalBlock(before, after) for before, after in pairwise(widths)
        )

    def _motion(self, x: Tensor) -> tuple[Tensor, tuple[Tensor, ...]]:
        config = self.config
        h = x * self.input_scale
        for block in self.encoder:
            h = block(h)  # [B, T, D]
        position = limit_speed(self._position(x, h), config.velocity_scale, config.fps)
        quaternion = self._quaternion(x, h)
        velocity, acceleration, turning = derive(position, quaternion, config.fps)
        return h, (position, velocity, acceleration, quaternion, turning)


def create_motion_decoder(config: DecoderConfig) -> Decoder:
    """The decoder that the configuration names (REF)."""
    return MotionDecoder(config) if config.decoder == "residual" else DerivedMotionDecoder(config)


def gaps(x: Tensor, fps: float) -> Tensor:
    """What velocity and acceleration lack to follow from the rows below them, [B, T, 9], scaled.

    From position to velocity, from velocity to acceleration, from position to acceleration, by
    forward differences (ruling 6).
    """
    acceleration = x[..., ACCELERATION]
    steps = forward_difference(x[..., POSITION], fps)  # [B, T, 3], m/s
    of_velocity = steps - x[..., VELOCITY]
    of_acceleration = torch.cat(
        (
            forward_difference(x[..., VELOCITY], fps) - acceleration,
            forward_difference(steps, fps) - acceleration,
        ),
        dim=-1,
    )
    return torch.cat((bounded(5 * of_velocity, 25), bounded(0.5 * of_acceleration, 25)), dim=-1)


def bounded(x: Tensor, scale: float) -> Tensor:
    """tanh(x / scale) * scale: the identity for small x (REF)."""
    return torch.tanh(x / scale) * scale


def limit_speed(position: Tensor, limit: float, fps: float) -> Tensor:
    """Paths [..., T, 3] whose speed stays below `limit` m/s: steps are shortened and summed anew.

    A step of speed s keeps the share (1 + (s/limit)^4)^(-1/4): 1 - 4e-8 at 1 m/s under 50.
    """
    steps = position[..., 1:, :] - position[..., :-1, :]  # [..., T-1, 3]
    excess = steps.square().sum(dim=-1, keepdim=True) * (fps / limit) ** 2  # (s / limit)^2
    steps = steps * (1 + excess.square()) ** -0.25
    return torch.cat((position[..., :1, :], position[..., :1, :] + steps.cumsum(dim=-2)), dim=-2)


def wrapped_phase(bars: Tensor) -> Tensor:
    """Bars [...] -> phase in [0, 1); the gradient passes unchanged."""
    phase = bars - bars.detach().floor()
    return torch.where(phase < 1, phase, phase - phase.detach())  # -1e-9 rounds up to 1


# ---------------------------------------------------------------- losses


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
