"""Gaussian diffusion: the process and its loss, guidance, and the samplers from noise to data.

One core for both branches: works on any [B, ...] tensor, [B, T, K, 6] rotations or [B, 25, T]
trajectories alike. Data is expected z-scored (SPEC ruling 13). Samplers are used in the diffusers
habit: `set_timesteps`, then one `step` per timestep; `run` is that loop. Their coefficients are
Python floats (float64) times float32 tensors: no float64 tensor exists. Noise is drawn on the CPU,
one generator a sample, alike on every device.

Letters: B batch, T frames, S training steps; t [B] in 0 ... S-1; a = sqrt(alpha_bar),
s = sqrt(1 - alpha_bar), so x_t = a * x_0 + s * noise.
"""

import math
from abc import ABC, abstractmethod
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, fields, is_dataclass, replace
from typing import Any

from ..config_schema import DiffusionConfig
from ..device import idle_threads
from ..errors import UsageError, in_range
from ..tensors import F, Tensor, nn, torch
from .noise import Generators, NoiseSchedule, sampling_timesteps, standard_normal

Model = Callable[..., Tensor]  # model(x_t, t [B], ...) -> model output, shaped like x_t
ModelFn = Callable[[Tensor, Tensor], Tensor]  # the same with its condition already inside
Callback = Callable[[int, int], None]  # callback(steps done, steps in all)


@dataclass(frozen=True, kw_only=True)
class Sampling:
    """How a motion is sampled; None = the model's own setting.

    Attributes:
        seed: from 0 to 2^64 - 1; the same seed, the same motion (on the CPU).
        steps: of denoising.
        sampler: ddim, ddpm or dpm-solver++.
        guidance_scale: how strictly the condition is followed; 1 = no guidance.
    """

    seed: int = 0
    steps: int | None = None
    sampler: str | None = None
    guidance_scale: float | None = None

    def __post_init__(self) -> None:
        for name, limits in (("seed", (0, 2**64 - 1)), ("steps", (1, 10_000))):
            value: Any = getattr(self, name)
            if value is not None or name == "seed":
                in_range(name, value, *limits, whole=True)
                object.__setattr__(self, name, int(value))  # NumPy's wrap round
        if self.guidance_scale is not None:
            in_range("guidance-scale", self.guidance_scale, 0.0, 1000.0)
            object.__setattr__(self, "guidance_scale", float(self.guidance_scale))


# ---------------------------------------------------------------- conditions, guidance


def with_condition(model: Model, condition: Any) -> ModelFn:
    """Close a model over its condition.

    A mapping becomes keyword arguments, None nothing, anything else the third argument:
    `model(x_t, t, condition)`.
    """
    if condition is None:
        return model
    if isinstance(condition, Mapping):
        keywords = dict(condition)
        return lambda x_t, t: model(x_t, t, **keywords)
    return lambda x_t, t: model(x_t, t, condition)


def join_conditions(first: Any, second: Any) -> Any:
    """Concatenate two conditions of one structure along the batch.

    Goes through tensors, None, mappings, tuples, lists and dataclasses.

    Raises:
        TypeError: the two differ in structure.
    """
    if first is None and second is None:
        return None
    if isinstance(first, Tensor) and isinstance(second, Tensor):
        return torch.cat((first, second))
    if type(first) is not type(second):
        raise TypeError(
            f"condition is a {type(first).__name__}, its null a {type(second).__name__}"
        )
    if isinstance(first, Mapping):
        if first.keys() != second.keys():
            raise TypeError(f"condition has the keys {sorted(first)}, its null {sorted(second)}")
        return {key: join_conditions(first[key], second[key]) for key in first}
    if isinstance(first, tuple | list):
        if len(first) != len(second):
            raise TypeError(f"condition has {len(first)} parts, its null {len(second)}")
        parts = [join_conditions(a, b) for a, b in zip(first, second, strict=True)]
        return type(first)(*parts) if hasattr(first, "_fields") else type(first)(parts)
    if is_dataclass(first) and not isinstance(first, type):
        changes = {
            field.name: join_conditions(getattr(first, field.name), getattr(second, field.name))
            for field in fields(first)
        }
        return replace(first, **changes)
    raise TypeError(f"cannot join conditions of type {type(first).__name__}")


def guided(model: Model, condition: Any, null_condition: Any, scale: float) -> ModelFn:
    """Classifier-free guidance: from a model's null condition towards, and past, its condition.

    Ho & Salimans 2022; SPEC ruling 14, in one doubled forward:
    null + scale * (conditional - null), eq. 6 with scale = 1 + w. For one x_t the predictions
    epsilon, sample and v are linear in each other, so the rule is the same for all three.
    Scale 1 is the plain conditional model and scale 0 the plain null model: one forward each.

    Args:
        model: called as `model(x_t, t, ...)`; rows of a batch must not see each other.
        condition: keyword arguments (a mapping), or one third argument; batch first everywhere.
        null_condition: the learned null in the same structure and shapes.
        scale: guidance scale, 0 or more.
    """
    if scale == 1:
        return with_condition(model, condition)
    if scale == 0:
        return with_condition(model, null_condition)
    both = with_condition(model, join_conditions(condition, null_condition))

    def guided_model(x_t: Tensor, t: Tensor) -> Tensor:
        output = both(torch.cat((x_t, x_t)), torch.cat((t, t)))
        conditional, null = output[: len(x_t)], output[len(x_t) :]
        return null + scale * (conditional - null)

    return guided_model


def holding(model_fn: ModelFn, known: Tensor, values: Tensor) -> ModelFn:
    """The model, always shown `values` where they are `known`."""
    return lambda x_t, t: model_fn(torch.where(known, values, x_t), t)


# ---------------------------------------------------------------- the process


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
        signal_scale, noise_scale = self._scales(t, x_0)
        noise = torch.randn_like(x_0) if noise is None else noise
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
        return x_0.clip(-limit, limit) if clip and limit is not None else x_0

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

    def alpha_bar(self, t: int) -> float:
        """Share of signal variance left at step t; exactly 1 before step 0 (SPEC ruling 12)."""
        return 1.0 if t < 0 else float(self.schedule.alphas_cumprod[t])

    def _scales(self, t: Tensor | int, like: Tensor) -> tuple[Tensor | float, Tensor | float]:
        """The a and s of step t: floats for one int, [B, 1, ...] tensors for t [B]."""
        if isinstance(t, int):
            alpha_bar = self.alpha_bar(t)
            return math.sqrt(alpha_bar), math.sqrt(1 - alpha_bar)
        return (
            _per_sample(self.sqrt_alphas_cumprod, t, like),
            _per_sample(self.sqrt_one_minus_alphas_cumprod, t, like),
        )

    def held(
        self,
        model_fn: ModelFn,
        known: Tensor,
        values: Tensor,
        noise: Tensor,
        *,
        shown: Tensor,
        guide: Callable[..., Tensor] | None = None,
    ) -> ModelFn:
        """The model with the known entries put in before, and put right after, each call.

        Args:
            model_fn: with its condition inside.
            known: [B, ...] bool, which entries are.
            values: [B, ...], used where known.
            noise: [B, ...] that sampling starts from; the known entries are noised with it.
            shown: [B, ...] bool, the known entries that are handed over clean, without noise.
            guide: moves each predicted x_0 [B, ...] where `free` [B, ...] bool.
        """

        def held(x_t: Tensor, t: Tensor) -> Tensor:
            mixed = torch.where(known & ~shown, self.q_sample(values, t, noise), x_t)
            output = model_fn(torch.where(shown, values, mixed), t).to(x_t.dtype)
            if guide is not None:
                x_0 = torch.where(known, values, self.predict_x0(output, x_t, t))
                output = self.output_for(guide(x_0, free=~known), x_t, t)
            return torch.where(known, self.output_for(values, x_t, t), output)

        return held

    # Training

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
            steps = torch.randint(self.config.timesteps, (len(x_0),), generator=generator)
            t = steps.to(self.betas.device)
        if noise is None and generator is None:
            noise = torch.randn_like(x_0)
        elif noise is None:
            noise = standard_normal(x_0.shape, generator, device=x_0.device)
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
        x_0 = self.predict_x0(output, x_t, t, clip=clip_denoised)
        mean, variance = self.q_posterior(x_0, x_t, t)  # the variance is 0 at t = 0
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
    error: Tensor = getattr(F, f"{loss_type}_loss")(
        output.float(), target.float(), reduction="none"
    )
    if mask is None:
        return error.mean()
    shape = [1] * error.ndim
    shape[0], shape[time_dim] = mask.shape
    mask = mask.bool().view(shape)
    per_frame = error.numel() // mask.numel()
    return error.masked_fill(~mask, 0).sum() / (mask.sum() * per_frame).clamp(min=1)


# ---------------------------------------------------------------- samplers


class Sampler(ABC):
    """A way through the timesteps of one diffusion process.

    Args:
        diffusion: the process.
        num_steps: of the way; None = as configured.
        eta: of DDIM, the others have none; None = as configured.
    """

    def __init__(
        self, diffusion: GaussianDiffusion, num_steps: int | None = None, eta: float | None = None
    ) -> None:
        self.diffusion = diffusion
        self.eta = diffusion.config.eta if eta is None else eta
        self.timesteps: tuple[int, ...] = ()
        self.set_timesteps(num_steps or diffusion.config.sampling_steps)

    def set_timesteps(self, num_steps: int) -> None:
        """Choose the timesteps and forget any earlier run. Raises UsageError when out of range."""
        config = self.diffusion.config
        self.timesteps = sampling_timesteps(config.timesteps, num_steps, config.timestep_spacing)
        self._earlier: tuple[Tensor, float] | None = None  # x_0 and lambda one step ago

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
        self._earlier = None
        x_t = x_T
        batches = torch.tensor(self.timesteps, device=x_T.device)[:, None].expand(-1, len(x_T))
        for at in range(start, len(self.timesteps)):
            model_output = model_fn(x_t, batches[at]).to(x_t.dtype)  # the path stays float32
            x_t = self.step(model_output, self.timesteps[at], x_t, generator=generator)
            if callback is not None:
                callback(at + 1, len(self.timesteps))
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
        return self.diffusion.alpha_bar(t), self.diffusion.alpha_bar(following)


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


SAMPLERS: dict[str, type[Sampler]] = {
    "ddpm": DDPMSampler,
    "ddim": DDIMSampler,
    "dpm-solver++": DPMSolverPP2MSampler,
}


def make_sampler(
    diffusion: GaussianDiffusion,
    name: str | None = None,
    num_steps: int | None = None,
    eta: float | None = None,
) -> Sampler:
    """The sampler of that name; what is left out comes from the diffusion's configuration.

    Raises:
        UsageError: the name is unknown or the number of steps is out of range.
    """
    name = name or diffusion.config.sampler
    if name not in SAMPLERS:
        raise UsageError(f"sampler {name!r} is unknown; choose one of {', '.join(SAMPLERS)}")
    return SAMPLERS[name](diffusion, num_steps, eta)
