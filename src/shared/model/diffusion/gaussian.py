"""Gaussian diffusion: noising, what the network predicts, the training loss, sampling.

One core for both branches: works on any [B, ...] tensor, [B, T, K, 6] rotations or [B, 25, T]
trajectories alike. Data is expected z-scored (SPEC ruling 13).

Letters: B batch, T frames, S training steps; t [B] in 0 ... S-1.
"""

import math
from collections.abc import Callable, Sequence
from typing import Any

import torch
from torch import Tensor, nn
from torch.nn import functional as F

from ...config_schema import DiffusionConfig
from .guidance import Model, with_condition
from .samplers import Callback, Generators, make_sampler, standard_normal
from .schedule import NoiseSchedule

ERRORS: dict[str, Callable[..., Tensor]] = {
    "mse": F.mse_loss,
    "l1": F.l1_loss,
    "huber": F.huber_loss,
}


class GaussianDiffusion(nn.Module):
    """The process between data and noise, and its reversal by a denoiser.

    Args:
        config: schedule, prediction type, loss and sampler.
        model: the denoiser, for callers who keep both together; every method that needs one
            also takes it as an argument.
    """

    betas: Tensor
    alphas_cumprod: Tensor
    sqrt_alphas_cumprod: Tensor
    sqrt_one_minus_alphas_cumprod: Tensor
    posterior_mean_coef1: Tensor
    posterior_mean_coef2: Tensor
    posterior_variance: Tensor

    def __init__(self, config: DiffusionConfig, model: nn.Module | None = None) -> None:
        super().__init__()
        self.config = config
        self.model = model
        self.schedule = NoiseSchedule.from_config(config)
        betas, alpha_bar = self.schedule.betas, self.schedule.alphas_cumprod
        before = alpha_bar / (1 - betas)  # alpha_bar one step earlier
        before[0] = 1.0
        buffers = {
            "betas": betas,
            "alphas_cumprod": alpha_bar,
            "sqrt_alphas_cumprod": alpha_bar**0.5,
            "sqrt_one_minus_alphas_cumprod": (1 - alpha_bar) ** 0.5,
            "posterior_mean_coef1": before**0.5 * betas / (1 - alpha_bar),
            "posterior_mean_coef2": (1 - betas) ** 0.5 * (1 - before) / (1 - alpha_bar),
            "posterior_variance": betas * (1 - before) / (1 - alpha_bar),
        }
        for name, values in buffers.items():  # float32: MPS has no float64
            self.register_buffer(name, torch.from_numpy(values.astype("float32")), persistent=False)

    def denoiser(self, model: Model | None = None) -> Model:
        """The model given, else the one this process was built with."""
        chosen = model if model is not None else self.model
        assert chosen is not None, "give a model to this call or to GaussianDiffusion"
        return chosen

    # Forward process and the three parametrisations

    def q_sample(self, x_0: Tensor, t: Tensor, noise: Tensor | None = None) -> Tensor:
        """Noise x_0 [B, ...] to step t [B]: a * x_0 + s * noise (Ho et al. 2020, eq. 4)."""
        if noise is None:
            noise = torch.randn_like(x_0)
        signal_scale, noise_scale = self._scales(t, x_0)
        return signal_scale * x_0 + noise_scale * noise

    def target(self, x_0: Tensor, noise: Tensor, t: Tensor) -> Tensor:
        """What the network should output: noise, x_0, or v = a * noise - s * x_0.

        v is Salimans & Ho 2022, eq. D.
        """
        if self.config.prediction_type == "epsilon":
            return noise
        if self.config.prediction_type == "sample":
            return x_0
        signal_scale, noise_scale = self._scales(t, x_0)
        return signal_scale * noise - noise_scale * x_0

    def predict_x0(
        self, model_output: Tensor, x_t: Tensor, t: Tensor | int, *, clip: bool = True
    ) -> Tensor:
        """The clean data that a model output stands for, within ±clip-sigma (SPEC ruling 13).

        Without the limit the last cosine step multiplies the error of a predicted epsilon by
        64,000. `clip=False` gives the exact inverse of `target`.
        """
        signal_scale, noise_scale = self._scales(t, x_t)
        if self.config.prediction_type == "epsilon":
            x_0 = (x_t - noise_scale * model_output) / signal_scale
        elif self.config.prediction_type == "sample":
            x_0 = model_output
        else:
            x_0 = signal_scale * x_t - noise_scale * model_output
        limit = self.config.clip_sigma
        return x_0.clamp(-limit, limit) if clip and limit is not None else x_0

    def output_for(self, x_0: Tensor, x_t: Tensor, t: Tensor) -> Tensor:
        """The model output at x_t [B, ...] that stands for this x_0: the inverse of predict_x0."""
        signal_scale, noise_scale = self._scales(t, x_t)
        return self.target(x_0, (x_t - signal_scale * x_0) / noise_scale, t)

    def q_posterior(self, x_0: Tensor, x_t: Tensor, t: Tensor) -> tuple[Tensor, Tensor]:
        """Mean [B, ...] and variance [B, 1, ...] of q(x_{t-1} | x_t, x_0) (Ho et al., eq. 7)."""
        mean = (
            _per_sample(self.posterior_mean_coef1, t, x_t) * x_0
            + _per_sample(self.posterior_mean_coef2, t, x_t) * x_t
        )
        return mean, _per_sample(self.posterior_variance, t, x_t)

    def _scales(self, t: Tensor | int, like: Tensor) -> tuple[Tensor | float, Tensor | float]:
        """The a and s of step t: floats for one int, [B, 1, ...] tensors for t [B]."""
        if isinstance(t, int):
            alpha_bar = self.schedule.alpha_bar(t)
            return math.sqrt(alpha_bar), math.sqrt(1 - alpha_bar)
        return (
            _per_sample(self.sqrt_alphas_cumprod, t, like),
            _per_sample(self.sqrt_one_minus_alphas_cumprod, t, like),
        )

    # Training

    def draw_timesteps(self, num: int, generator: torch.Generator | None = None) -> Tensor:
        """Uniform steps [num], drawn on the CPU, on the device of the process."""
        steps = torch.randint(self.config.timesteps, (num,), generator=generator)
        return steps.to(self.betas.device)

    def training_loss(
        self,
        model: Model,
        x_0: Tensor,
        condition: Any = None,
        *,
        t: Tensor | None = None,
        noise: Tensor | None = None,
        mask: Tensor | None = None,
        time_dim: int = 1,
        generator: torch.Generator | None = None,
    ) -> Tensor:
        """Mean loss of a denoiser on noised data, a scalar (Ho et al. 2020, eq. 14).

        Args:
            model: called as `model(x_t, t, condition)`, see `with_condition`.
            x_0: clean data [B, ...].
            condition: of the model.
            t: steps [B]; uniform when absent.
            noise: as x_0; standard normal when absent.
            mask: frames that count, see `masked_loss`.
            time_dim: the dimension of x_0 that holds frames.
            generator: source of t and noise when they are absent, on the CPU.
        """
        if t is None:
            t = self.draw_timesteps(len(x_0), generator)
        if noise is None:
            noise = (
                torch.randn_like(x_0)
                if generator is None
                else standard_normal(x_0.shape, generator, device=x_0.device)
            )
        output = with_condition(model, condition)(self.q_sample(x_0, t, noise), t)
        return self.loss(output, self.target(x_0, noise, t), mask=mask, time_dim=time_dim)

    def loss(
        self, output: Tensor, target: Tensor, *, mask: Tensor | None = None, time_dim: int = 1
    ) -> Tensor:
        """The configured loss between two tensors, over real frames only, a scalar."""
        return masked_loss(output, target, self.config.loss_type, mask=mask, time_dim=time_dim)

    # Sampling

    @torch.no_grad()
    def p_sample(
        self,
        x_t: Tensor,
        t: Tensor,
        condition: Any = None,
        *,
        model: Model | None = None,
        clip_denoised: bool = True,
        generator: Generators = None,
    ) -> Tensor:
        """One DDPM step from x_t [B, ...] to x_{t-1}; t [B] may differ from row to row."""
        output = with_condition(self.denoiser(model), condition)(x_t, t)
        mean, variance = self.q_posterior(
            self.predict_x0(output, x_t, t, clip=clip_denoised), x_t, t
        )  # the variance is 0 at t = 0
        return mean + variance.sqrt() * standard_normal(x_t.shape, generator, device=x_t.device)

    def ddim_sample(
        self,
        model: Model,
        shape: Sequence[int],
        condition: Any = None,
        num_steps: int = 50,
        eta: float = 0.0,
        **options: Any,
    ) -> Tensor:
        """`sample` by DDIM (REF's signature)."""
        return self.sample(
            model, shape, condition, sampler="ddim", num_steps=num_steps, eta=eta, **options
        )

    def sample(
        self,
        model: Model,
        shape: Sequence[int],
        condition: Any = None,
        *,
        sampler: str | None = None,
        num_steps: int | None = None,
        eta: float | None = None,
        generator: Generators = None,
        x_T: Tensor | None = None,
        callback: Callback | None = None,
    ) -> Tensor:
        """Draw samples [B, ...]; see `Sampler.sample`. Settings left out come from the config.

        Raises:
            UsageError: the sampler is unknown or the number of steps is out of range.
        """
        return make_sampler(self, sampler, num_steps, eta).sample(
            shape, condition, model=model, generator=generator, x_T=x_T, callback=callback
        )


def _per_sample(values: Tensor, t: Tensor, like: Tensor) -> Tensor:
    """Entries of values [S] at t [B], shaped [B, 1, ...] to multiply `like` [B, ...]."""
    return values[t].view(-1, *(1,) * (like.ndim - 1))


def masked_loss(
    output: Tensor,
    target: Tensor,
    loss_type: str = "mse",
    *,
    mask: Tensor | None = None,
    time_dim: int = 1,
) -> Tensor:
    """Mean error over real frames, a float32 scalar.

    Args:
        output: [B, ...] of any dtype.
        target: like output.
        loss_type: mse, l1 or huber (delta 1).
        mask: bool [B, T], True = real frame; None = all are real.
        time_dim: the dimension of output that holds the T frames.
    """
    error = ERRORS[loss_type](output.float(), target.float(), reduction="none")
    if mask is None:
        return error.mean()
    shape = [1] * error.ndim
    shape[0], shape[time_dim] = mask.shape
    mask = mask.bool().view(shape)
    per_frame = error.numel() // mask.numel()
    return error.masked_fill(~mask, 0).sum() / (mask.sum() * per_frame).clamp(min=1)
