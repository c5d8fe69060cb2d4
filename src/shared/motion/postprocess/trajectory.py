"""Post-processing of trajectories, TECH §9: clamps, quaternions, phase, coherence, smoothing.

One computation for NumPy and Torch. Differences are forward (ruling 6), the phase is brought
into its range by wrapping and smoothed unwrapped (ruling 9), quaternion signs follow ruling 10.

Letters: B batch, T frames, 25 columns.
"""

import math

import numpy as np

from ...config_audio import PostProcessConfig
from ...tensors import F, Tensor, torch
from ..rotations import forward_difference, quaternion_continuous, smooth
from ..trajectory import (
    ACCELERATION,
    ANGULAR_VELOCITY,
    PHASE,
    POSITION,
    QUATERNION,
    STYLE,
    VELOCITY,
)


def limits(config: PostProcessConfig) -> dict[str, tuple[slice, float]]:
    """Clamped columns by name, each with its bound."""
    return {
        "position": (POSITION, config.max_position),
        "velocity": (VELOCITY, config.max_velocity),
        "acceleration": (ACCELERATION, config.max_acceleration),
        "angular_velocity": (ANGULAR_VELOCITY, config.max_angular_velocity),
    }


class _Processor:
    """What both processors share."""

    def __init__(self, config: PostProcessConfig | None = None) -> None:
        self.config = config or PostProcessConfig()


class MotionPostProcessor(_Processor):
    """TECH's post-processor for NumPy arrays [T,25] or [B,T,25], time first."""

    def process(self, motion: np.ndarray) -> np.ndarray:
        """The processed motion, same shape, float32."""
        return np.asarray(_process(_from_numpy(motion), self.config).numpy())

    def count_clamped(self, motion: np.ndarray) -> dict[str, int]:
        """Values that `process` limits, by name; see `count_clamped`."""
        return count_clamped(_from_numpy(motion), self.config)


class MotionPostProcessorTorch(_Processor):
    """TECH's post-processor for tensors [B,25,T], channels first, any device, with gradients."""

    def process(self, motion: Tensor) -> Tensor:
        """The processed motion, same shape."""
        return _process(motion.swapaxes(-1, -2), self.config).swapaxes(-1, -2)

    def count_clamped(self, motion: Tensor) -> dict[str, int]:
        """Values that `process` limits, by name; see `count_clamped`."""
        return count_clamped(motion.swapaxes(-1, -2), self.config)


def count_clamped(motion: Tensor, config: PostProcessConfig) -> dict[str, int]:
    """How many values of [...,T,25] lie outside their bounds, to be reported with the motion.

    Keys: position, velocity, acceleration, angular_velocity (components), phase (frames).
    """
    phase = motion[..., PHASE]
    outside = (phase < config.phase_min) | (phase > config.phase_max)
    counts = dict.fromkeys((*limits(config), "phase"), 0)
    if config.clamp_values:
        for name, (columns, bound) in limits(config).items():
            counts[name] = int((motion[..., columns].abs() > bound).sum())
    if config.clamp_phase:
        counts["phase"] = int(outside.sum())
    return counts


def _from_numpy(motion: np.ndarray) -> Tensor:
    return torch.from_numpy(np.array(motion, dtype=np.float32))


def _process(motion: Tensor, config: PostProcessConfig) -> Tensor:
    """[...,T,25] in TECH §9.2's order."""
    position, velocity, acceleration, turning = (
        motion[..., columns].clip(-bound, bound) if config.clamp_values else motion[..., columns]
        for columns, bound in limits(config).values()
    )
    quaternions = _quaternions(motion[..., QUATERNION], config)
    phase = _phase(motion[..., PHASE], config)[..., None]
    if config.enforce_velocity_coherence:
        derived = forward_difference(position, config.fps)
        velocity = torch.lerp(velocity, derived, config.coherence_blend)
    if config.enforce_accel_coherence:
        derived = forward_difference(velocity, config.fps)
        acceleration = torch.lerp(acceleration, derived, config.coherence_blend)
    parts = (position, velocity, acceleration, quaternions, turning, phase, motion[..., STYLE])
    result = torch.cat(parts, -1)
    return _smoothed(result, config) if config.apply_smoothing else result


def _quaternions(quaternions: Tensor, config: PostProcessConfig) -> Tensor:
    """Unit, continuous, smooth [...,T,4], as configured."""
    if config.normalize_quaternions:
        identity = torch.zeros_like(quaternions)
        identity[..., 0] = 1
        norm = quaternions.norm(dim=-1, keepdim=True)
        unit = quaternions / norm.clip(min=config.quat_eps)
        quaternions = quaternion_continuous(
            torch.where(norm < config.quat_eps, identity, unit), dim=-2
        )
    if config.smooth_quaternions:
        size = config.quat_smooth_window
        # signs must agree before quaternions can be averaged
        box = quaternions.new_full((size,), 1 / size)
        quaternions = F.normalize(smooth(quaternion_continuous(quaternions, dim=-2), box), dim=-1)
        quaternions = quaternion_continuous(quaternions, dim=-2)
    return quaternions


def _phase(phase: Tensor, config: PostProcessConfig) -> Tensor:
    """[...,T] held where it steps back, then wrapped, as configured."""
    if config.enforce_phase_monotonic:
        phase = _unwrap(phase, config).cummax(-1).values
    return _wrap(phase, config) if config.clamp_phase else phase


def _unwrap(phase: Tensor, config: PostProcessConfig) -> Tensor:
    """[...,T] without the jumps of a bar; a step is the shorter way round."""
    bar = config.phase_max - config.phase_min
    bars = torch.round((phase[..., 1:] - phase[..., :-1]) / bar).cumsum(-1)
    return torch.cat((phase[..., :1], phase[..., 1:] - bars * bar), -1)


def _wrap(phase: Tensor, config: PostProcessConfig) -> Tensor:
    """[...,T] into [phase_min, phase_max)."""
    bar = config.phase_max - config.phase_min
    wrapped = torch.remainder(phase - config.phase_min, bar)
    return config.phase_min + torch.where(wrapped >= bar, 0.0, wrapped)  # rounding may reach it


def _smoothed(motion: Tensor, config: PostProcessConfig) -> Tensor:
    """Binomial average of all columns but the quaternion; linear, so coherence survives."""
    size = config.smoothing_kernel_size
    weights = motion.new_tensor([math.comb(size - 1, k) / 2 ** (size - 1) for k in range(size)])
    phase = smooth(_unwrap(motion[..., PHASE], config)[..., None], weights)
    return torch.cat(
        (
            smooth(motion[..., : QUATERNION.start], weights),
            motion[..., QUATERNION],
            smooth(motion[..., ANGULAR_VELOCITY], weights),
            _wrap(phase, config) if config.clamp_phase else phase,
            F.normalize(smooth(motion[..., STYLE], weights), dim=-1),
        ),
        -1,
    )
