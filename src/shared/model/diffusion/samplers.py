"""From noise to data: DDPM, DDIM and DPM-Solver++(2M) behind one loop, and reproducible noise.

Used in the diffusers habit: `set_timesteps`, then one `step` per timestep; `run` is that loop.
Coefficients are Python floats (float64) times float32 tensors: no float64 tensor exists. Noise is
drawn on the CPU, one generator a sample, alike on every device.

Letters: a = sqrt(alpha_bar), s = sqrt(1 - alpha_bar), so x_t = a * x_0 + s * noise.
"""

import math
from abc import ABC, abstractmethod
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any, Protocol

import numpy as np
import torch
from torch import Tensor

from ...config_schema import DiffusionConfig
from ...device import idle_threads
from ...errors import UsageError
from .guidance import Model, ModelFn, with_condition
from .schedule import NoiseSchedule, sampling_timesteps

Generators = torch.Generator | Sequence[torch.Generator] | None


def sample_generators(seed: int, num_samples: int, start: int = 0) -> list[torch.Generator]:
    """One CPU generator for each of the samples start ... start + num_samples - 1.

    Sample i depends on (seed, i) alone: not on the batch size, its neighbours, or the device.
    """
    generators = []
    for index in range(start, start + num_samples):
        state = np.random.SeedSequence((seed, index)).generate_state(1, np.uint64)
        generators.append(torch.Generator("cpu").manual_seed(int(state[0] >> np.uint64(1))))
    return generators


def standard_normal(
    shape: Sequence[int],
    generator: Generators = None,
    *,
    device: torch.device | str = "cpu",
) -> Tensor:
    """Float32 noise of the given shape.

    Drawn on the CPU and moved, so that a seed means the same on CPU, CUDA and MPS. A sequence of
    generators gives each batch element its own stream.
    """
    shape = tuple(shape)
    if generator is None or isinstance(generator, torch.Generator):
        return torch.randn(shape, generator=generator, dtype=torch.float32).to(device)
    assert len(generator) == shape[0], f"{len(generator)} generators for a batch of {shape[0]}"
    rows = [torch.randn(shape[1:], generator=own, dtype=torch.float32) for own in generator]
    return torch.stack(rows).to(device)


Callback = Callable[[int, int], None]  # callback(steps done, steps in all)


@dataclass(frozen=True, kw_only=True)
class Sampling:
    """How a motion is sampled; None = the model's own setting.

    Attributes:
        seed: 0 or more; the same seed, the same motion (on the CPU).
        steps: of denoising.
        sampler: ddim, ddpm or dpm-solver++.
        guidance_scale: how strictly the condition is followed; 1 = no guidance.
    """

    seed: int = 0
    steps: int | None = None
    sampler: str | None = None
    guidance_scale: float | None = None


class Process(Protocol):
    """What a sampler needs of a diffusion process; `GaussianDiffusion` is one."""

    config: DiffusionConfig
    schedule: NoiseSchedule
    betas: Tensor

    def denoiser(self, model: Model | None = None) -> Model:
        """The model given, else the one this process was built with."""

    def predict_x0(
        self, model_output: Tensor, x_t: Tensor, t: Tensor | int, *, clip: bool = True
    ) -> Tensor:
        """The clean data that a model output stands for."""


class Sampler(ABC):
    """A way through the timesteps of one diffusion process."""

    def __init__(self, diffusion: Process, num_steps: int | None = None) -> None:
        self.diffusion = diffusion
        self.timesteps: tuple[int, ...] = ()
        self.set_timesteps(num_steps or diffusion.config.sampling_steps)

    def set_timesteps(self, num_steps: int) -> None:
        """Choose the timesteps and forget any earlier run. Raises UsageError when out of range."""
        config = self.diffusion.config
        self.timesteps = sampling_timesteps(config.timesteps, num_steps, config.timestep_spacing)

    @abstractmethod
    def step(
        self, model_output: Tensor, t: int, x_t: Tensor, *, generator: Generators = None
    ) -> Tensor:
        """One step from x_t to the next, less noisy timestep; after the last one, to x_0."""

    @idle_threads()
    def run(
        self,
        model_fn: ModelFn,
        x_T: Tensor,
        *,
        start: int = 0,
        generator: Generators = None,
        callback: Callback | None = None,
    ) -> Tensor:
        """Walk the timesteps from x_T to x_0. Differentiable when the caller records gradients.

        `start` skips that many of them: x_T is then data noised to `timesteps[start]`.
        """
        self.set_timesteps(len(self.timesteps))
        x_t = x_T
        for done, t in enumerate(self.timesteps[start:], start=start + 1):
            t_batch = torch.full((len(x_t),), t, dtype=torch.long, device=x_t.device)
            model_output = model_fn(x_t, t_batch).to(x_t.dtype)  # the path stays float32
            x_t = self.step(model_output, t, x_t, generator=generator)
            if callback is not None:
                callback(done, len(self.timesteps))
        return x_t

    @torch.no_grad()
    def sample(
        self,
        shape: Sequence[int],
        condition: Any = None,
        *,
        model: Model | None = None,
        generator: Generators = None,
        x_T: Tensor | None = None,
        callback: Callback | None = None,
    ) -> Tensor:
        """Draw samples of the given shape (TECH 8.1), float32 on the device of the diffusion.

        Args:
            shape: (B, ...), any further dimensions.
            condition: see `with_condition`.
            model: the denoiser; by default the one inside the diffusion.
            generator: one generator, or one for each batch element.
            x_T: starting noise; drawn when absent.
            callback: called with (steps done, steps in all) after each step.
        """
        model_fn = with_condition(self.diffusion.denoiser(model), condition)
        if x_T is None:
            x_T = standard_normal(shape, generator, device=self.diffusion.betas.device)
        return self.run(model_fn, x_T, generator=generator, callback=callback)

    def _alpha_bars(self, t: int) -> tuple[float, float]:
        """Alpha_bar at t and at the timestep after it, which is 1 at the end (SPEC ruling 12)."""
        place = self.timesteps.index(t) + 1
        following = self.timesteps[place] if place < len(self.timesteps) else -1
        schedule = self.diffusion.schedule
        return schedule.alpha_bar(t), schedule.alpha_bar(following)


class DDPMSampler(Sampler):
    """Ancestral sampling with the small posterior variance (Ho et al. 2020, eqs. 6 and 7)."""

    def step(
        self, model_output: Tensor, t: int, x_t: Tensor, *, generator: Generators = None
    ) -> Tensor:
        """Draw from q(x_next | x_t, predicted x_0)."""
        alpha_bar, next_alpha_bar = self._alpha_bars(t)
        x_0 = self.diffusion.predict_x0(model_output, x_t, t)
        alpha = alpha_bar / next_alpha_bar  # of the whole jump, when timesteps are skipped
        mean = (
            math.sqrt(next_alpha_bar) * (1 - alpha) / (1 - alpha_bar) * x_0
            + math.sqrt(alpha) * (1 - next_alpha_bar) / (1 - alpha_bar) * x_t
        )
        deviation = math.sqrt((1 - next_alpha_bar) / (1 - alpha_bar) * (1 - alpha))
        return _add_noise(mean, deviation, generator)


class DDIMSampler(Sampler):
    """Implicit sampling: eta 0 is deterministic, 1 is DDPM (Song et al. 2021, eqs. 12 and 16).

    The noise in eq. 12 is recomputed from the limited x_0, so that the two always add up to x_t.
    """

    def __init__(
        self,
        diffusion: Process,
        num_steps: int | None = None,
        eta: float | None = None,
    ) -> None:
        super().__init__(diffusion, num_steps)
        self.eta = diffusion.config.eta if eta is None else eta

    def step(
        self, model_output: Tensor, t: int, x_t: Tensor, *, generator: Generators = None
    ) -> Tensor:
        """Move along the line through x_t and the predicted x_0, and renew eta of the noise."""
        alpha_bar, next_alpha_bar = self._alpha_bars(t)
        x_0 = self.diffusion.predict_x0(model_output, x_t, t)
        eps = (x_t - math.sqrt(alpha_bar) * x_0) / math.sqrt(1 - alpha_bar)
        sigma = self.eta * math.sqrt(
            (1 - next_alpha_bar) / (1 - alpha_bar) * (1 - alpha_bar / next_alpha_bar)
        )
        direction = math.sqrt(max(1 - next_alpha_bar - sigma**2, 0.0))
        return _add_noise(math.sqrt(next_alpha_bar) * x_0 + direction * eps, sigma, generator)


class DPMSolverPP2MSampler(Sampler):
    """DPM-Solver++(2M), midpoint form, deterministic (Lu et al. 2022b, algorithm 2).

    First order on the first step, and on the last one, whose end has no noise (lambda infinite).
    """

    def set_timesteps(self, num_steps: int) -> None:
        """Choose the timesteps and forget any earlier run. Raises UsageError when out of range."""
        super().set_timesteps(num_steps)
        self._earlier: tuple[Tensor, float] | None = None  # x_0 and lambda one step ago

    def step(
        self, model_output: Tensor, t: int, x_t: Tensor, *, generator: Generators = None
    ) -> Tensor:
        """Extrapolate x_0 from this step and the one before, then follow the exact ODE part."""
        alpha_bar, next_alpha_bar = self._alpha_bars(t)
        x_0 = self.diffusion.predict_x0(model_output, x_t, t)
        lambda_t = _half_log_snr(alpha_bar)
        earlier, self._earlier = self._earlier, (x_0, lambda_t)
        if next_alpha_bar == 1:
            return x_0
        h = _half_log_snr(next_alpha_bar) - lambda_t
        if earlier is not None:
            x_0_before, lambda_before = earlier
            x_0 = x_0 + 0.5 * h / (lambda_t - lambda_before) * (x_0 - x_0_before)
        shrink = math.sqrt((1 - next_alpha_bar) / (1 - alpha_bar))
        return shrink * x_t - math.sqrt(next_alpha_bar) * math.expm1(-h) * x_0


def _half_log_snr(alpha_bar: float) -> float:
    """Lambda: log(a / s)."""
    return 0.5 * (math.log(alpha_bar) - math.log1p(-alpha_bar))


def _add_noise(mean: Tensor, deviation: float, generator: Generators) -> Tensor:
    if deviation == 0:
        return mean
    return mean + deviation * standard_normal(mean.shape, generator, device=mean.device)


def make_sampler(
    diffusion: Process,
    name: str | None = None,
    num_steps: int | None = None,
    eta: float | None = None,
) -> Sampler:
    """The sampler of that name; what is left out comes from the diffusion's configuration.

    Raises:
        UsageError: the name is unknown or the number of steps is out of range.
    """
    name = name or diffusion.config.sampler
    if name == "ddpm":
        return DDPMSampler(diffusion, num_steps)
    if name == "ddim":
        return DDIMSampler(diffusion, num_steps, eta)
    if name == "dpm-solver++":
        return DPMSolverPP2MSampler(diffusion, num_steps)
    raise UsageError(f"sampler {name!r} is unknown; choose one of ddpm, ddim, dpm-solver++")
