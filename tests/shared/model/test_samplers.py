"""Whole sampling loops against diffusers, against closed forms, and their seeds."""

from collections.abc import Callable

import numpy as np
import pytest
import torch
from diffusers import DDIMScheduler, DDPMScheduler, DPMSolverMultistepScheduler
from torch import Tensor

from src.shared.config_schema import DiffusionConfig
from src.shared.errors import UsageError
from src.shared.model.diffusion import (
    DDIMSampler,
    DDPMSampler,
    DPMSolverPP2MSampler,
    GaussianDiffusion,
    make_sampler,
)
from src.shared.model.noise import sample_generators, standard_normal

SHAPES = ((2, 25, 16), (2, 8, 23, 6))
PREDICTIONS = ("epsilon", "sample", "v")
SAMPLERS = ("ddpm", "ddim", "dpm-solver++")


def make(**settings: object) -> GaussianDiffusion:
    return GaussianDiffusion(
        DiffusionConfig.model_validate({"timesteps": 100, "clip_sigma": None} | settings)
    )


def optimal(diffusion: GaussianDiffusion, mean: float, std: float) -> Callable[..., Tensor]:
    """The analytic denoiser of data N(mean, std^2), in the prediction type of the diffusion."""

    def model(x_t: Tensor, t: Tensor) -> Tensor:
        alpha_bar = diffusion.alpha_bar(int(t[0]))
        a, s = alpha_bar**0.5, (1 - alpha_bar) ** 0.5
        x_0 = (mean * s**2 + std**2 * a * x_t) / (a**2 * std**2 + s**2)
        # The noise without dividing by a small s or a: E[noise | x_t] of the same Gaussian.
        noise = s * (x_t - a * mean) / (a**2 * std**2 + s**2)
        return diffusion.target(x_0, noise, t)

    return model


def oracle_keywords(diffusion: GaussianDiffusion) -> dict[str, object]:
    prediction = diffusion.config.prediction_type
    return {
        "num_train_timesteps": diffusion.config.timesteps,
        "trained_betas": diffusion.schedule.betas.astype(np.float32),
        "prediction_type": "v_prediction" if prediction == "v" else prediction,
        "timestep_spacing": diffusion.config.timestep_spacing,
    }


def walk(scheduler: object, model: Callable[..., Tensor], x: Tensor, **options: object) -> Tensor:
    """The loop of diffusers with a scheduler whose timesteps are set."""
    for t in scheduler.timesteps:  # type: ignore[attr-defined]
        batch = torch.full((len(x),), int(t), dtype=torch.long)
        x = scheduler.step(model(x, batch), t, x, **options).prev_sample  # type: ignore[attr-defined]
    return x


def some_network(x: Tensor, t: Tensor) -> Tensor:
    """Bounded, nonlinear, dependent on the timestep, mixing along the last dimension."""
    phase = t.float().view(-1, *(1,) * (x.ndim - 1)) / 30
    return torch.tanh(0.7 * x + 0.3 * x.roll(1, -1) + phase.sin())


# DDIM in diffusers goes to t - S // N. Its previous step is ours for `leading`, and for `trailing`
# when N divides S; else ours goes to the next timestep in the list, as its DDPM and DPM do.
DDIM_CASES = [("leading", 20), ("leading", 30), ("trailing", 20), ("trailing", 50)]


@pytest.mark.parametrize("shape", SHAPES)
@pytest.mark.parametrize("prediction", PREDICTIONS)
@pytest.mark.parametrize(("spacing", "steps"), DDIM_CASES)
def test_ddim_equals_diffusers(
    shape: tuple[int, ...], prediction: str, spacing: str, steps: int
) -> None:
    diffusion = make(prediction_type=prediction, timestep_spacing=spacing, beta_schedule="linear")
    oracle = DDIMScheduler(**oracle_keywords(diffusion), clip_sample=False, set_alpha_to_one=True)
    oracle.set_timesteps(steps)
    x_T = torch.randn(shape, generator=torch.Generator().manual_seed(0))
    ours = diffusion.ddim_sample(some_network, shape, None, steps, 0.0, x_T=x_T)
    expected = walk(oracle, some_network, x_T)
    scale = float(expected.abs().max())
    torch.testing.assert_close(ours / scale, expected / scale, rtol=0, atol=1e-5)


@pytest.mark.parametrize("prediction", PREDICTIONS)
def test_limited_ddim_equals_diffusers_on_the_cosine_schedule(prediction: str) -> None:
    """The noise is recomputed from the limited x_0: use_clipped_model_output over there."""
    diffusion = make(prediction_type=prediction, timesteps=1000, clip_sigma=2.0)
    oracle = DDIMScheduler(**oracle_keywords(diffusion), clip_sample=True, clip_sample_range=2.0)
    oracle.set_timesteps(20)
    x_T = torch.randn(2, 25, 16, generator=torch.Generator().manual_seed(0))
    ours = diffusion.ddim_sample(some_network, x_T.shape, None, 20, 0.0, x_T=x_T)
    expected = walk(oracle, some_network, x_T, use_clipped_model_output=True)
    torch.testing.assert_close(ours, expected, rtol=0, atol=1e-4)


@pytest.mark.parametrize("prediction", PREDICTIONS)
@pytest.mark.parametrize(
    ("spacing", "steps"), [("leading", 20), ("linspace", 33), ("trailing", 30)]
)
def test_ddpm_equals_diffusers(prediction: str, spacing: str, steps: int) -> None:
    """Same noise in the same order; diffusers keeps 1e-10 of noise on the very last step."""
    diffusion = make(prediction_type=prediction, timestep_spacing=spacing, beta_schedule="linear")
    oracle = DDPMScheduler(**oracle_keywords(diffusion), clip_sample=False)
    oracle.set_timesteps(steps)
    x_T = torch.randn(2, 25, 16, generator=torch.Generator().manual_seed(0))
    ours = DDPMSampler(diffusion, steps).sample(
        x_T.shape, model=some_network, x_T=x_T, generator=torch.Generator().manual_seed(5)
    )
    expected = walk(oracle, some_network, x_T, generator=torch.Generator().manual_seed(5))
    scale = float(expected.abs().max())
    torch.testing.assert_close(ours / scale, expected / scale, rtol=0, atol=1e-5)


@pytest.mark.parametrize("prediction", PREDICTIONS)
@pytest.mark.parametrize("spacing", ["leading", "linspace", "trailing"])
@pytest.mark.parametrize("steps", [6, 20])
def test_dpm_solver_equals_diffusers(prediction: str, spacing: str, steps: int) -> None:
    """Given our timesteps: diffusers spaces N + 1 points for this solver unless `trailing`."""
    diffusion = make(prediction_type=prediction, timestep_spacing=spacing, beta_schedule="linear")
    sampler = DPMSolverPP2MSampler(diffusion, steps)
    oracle = DPMSolverMultistepScheduler(**oracle_keywords(diffusion), final_sigmas_type="zero")
    oracle.set_timesteps(timesteps=list(sampler.timesteps))
    x_T = torch.randn(2, 25, 16, generator=torch.Generator().manual_seed(0))
    ours = sampler.sample(x_T.shape, model=some_network, x_T=x_T)
    expected = walk(oracle, some_network, x_T)
    scale = float(expected.abs().max())
    torch.testing.assert_close(ours / scale, expected / scale, rtol=0, atol=1e-5)


@pytest.mark.parametrize("prediction", PREDICTIONS)
@pytest.mark.parametrize("sampler", SAMPLERS)
@pytest.mark.parametrize("schedule", ["linear", "cosine", "sqrt"])
def test_every_sampler_reproduces_a_gaussian(prediction: str, sampler: str, schedule: str) -> None:
    diffusion = make(
        prediction_type=prediction, beta_schedule=schedule, clip_sigma=6.0, timesteps=1000
    )
    model = optimal(diffusion, mean=1.5, std=0.4)
    samples = diffusion.sample(
        model,
        (4, 25, 100),
        sampler=sampler,
        num_steps=400,
        generator=torch.Generator().manual_seed(1),
    )
    assert float(samples.mean()) == pytest.approx(1.5, abs=0.02)
    assert float(samples.std()) == pytest.approx(0.4, abs=0.02)


@pytest.mark.parametrize("eta", [0.0, 0.5, 1.0])
def test_eta_changes_the_noise_and_not_the_distribution(eta: float) -> None:
    diffusion = make(prediction_type="v", timesteps=1000)
    samples = diffusion.ddim_sample(
        optimal(diffusion, -1.0, 0.5), (2, 10000), None, 200, eta,
        generator=torch.Generator().manual_seed(2),
    )  # fmt: skip
    assert float(samples.mean()) == pytest.approx(-1.0, abs=0.02)
    assert float(samples.std()) == pytest.approx(0.5, abs=0.02)


def test_few_steps_of_epsilon_do_not_explode() -> None:
    """A network that is 1% off at the noisy end (SPEC ruling 13: std 47 instead of 1)."""
    stds = {}
    for limit in (None, 6.0):
        diffusion = make(timesteps=1000, clip_sigma=limit)
        exact = optimal(diffusion, 0.0, 1.0)
        noisy = torch.Generator().manual_seed(0)
        model = lambda x, t, m=exact, g=noisy: m(x, t) + 0.01 * torch.randn(x.shape, generator=g)  # noqa: E731
        stds[limit] = float(diffusion.sample(model, (4, 2000), num_steps=10).std())
    assert stds[None] > 4
    assert stds[6.0] < 2.5


def test_ddpm_is_ddim_with_eta_one() -> None:
    diffusion = make(prediction_type="v", timestep_spacing="linspace")
    x_T = torch.randn(2, 25, 16)
    ddpm, ddim = (
        sampler.sample(
            x_T.shape, model=some_network, x_T=x_T, generator=torch.Generator().manual_seed(3)
        )
        for sampler in (DDPMSampler(diffusion, 17), DDIMSampler(diffusion, 17, eta=1.0))
    )
    torch.testing.assert_close(ddpm, ddim, rtol=1e-4, atol=1e-4)


def test_the_second_order_solver_needs_fewer_steps() -> None:
    """Error against the exact flow of a Gaussian: x_0 = mean + std * x_T."""
    diffusion = make(prediction_type="sample", timesteps=1000)
    x_T = torch.randn(2, 500, generator=torch.Generator().manual_seed(0))
    exact = 1.0 + 0.3 * x_T

    def error(sampler: str, steps: int) -> float:
        model = optimal(diffusion, 1.0, 0.3)
        sample = diffusion.sample(model, x_T.shape, sampler=sampler, num_steps=steps, x_T=x_T)
        return float((sample - exact).abs().mean())

    assert error("dpm-solver++", 20) < 0.5 * error("ddim", 20)
    assert error("ddim", 40) < 0.6 * error("ddim", 20)
    assert error("dpm-solver++", 40) < 0.35 * error("dpm-solver++", 20)


def test_step_in_the_diffusers_habit_is_the_run() -> None:
    for name in SAMPLERS:
        diffusion = make(prediction_type="v")
        sampler = make_sampler(diffusion, name, eta=0.7)
        sampler.set_timesteps(9)
        generator = torch.Generator().manual_seed(4)
        x_T = torch.randn(2, 25, 16)
        x = x_T
        for t in sampler.timesteps:
            x = sampler.step(some_network(x, torch.full((2,), t)), t, x, generator=generator)
        again = sampler.sample(
            x_T.shape, model=some_network, x_T=x_T, generator=torch.Generator().manual_seed(4)
        )
        torch.testing.assert_close(x, again, rtol=0, atol=0)


@pytest.mark.parametrize("sampler", SAMPLERS)
def test_a_sample_depends_on_its_seed_alone(sampler: str) -> None:
    diffusion = make(prediction_type="v", eta=0.5)
    run = lambda generators, num: diffusion.sample(  # noqa: E731
        some_network, (num, 25, 16), sampler=sampler, num_steps=5, generator=generators
    )
    batch = run(sample_generators(11, 4), 4)
    alone = run(sample_generators(11, 1, start=2), 1)
    other = run(sample_generators(12, 4), 4)
    torch.testing.assert_close(batch[2:3], alone, rtol=0, atol=1e-6)
    assert not torch.allclose(batch, other)
    assert not torch.allclose(batch[0], batch[1])
    torch.testing.assert_close(batch, run(sample_generators(11, 4), 4), rtol=0, atol=0)


def test_noise_is_float32_on_the_cpu_by_default() -> None:
    noise = standard_normal((3, 4), sample_generators(0, 3))
    assert noise.dtype == torch.float32
    assert noise.device.type == "cpu"


@pytest.mark.gpu
@pytest.mark.skipif(not torch.cuda.is_available(), reason="no CUDA device")
def test_samples_agree_across_devices() -> None:
    samples = []
    for device in ("cpu", "cuda"):
        diffusion = make(prediction_type="v", eta=0.5).to(device)
        samples.append(
            diffusion.sample(
                some_network, (2, 25, 16), num_steps=10, generator=sample_generators(0, 2)
            ).cpu()
        )
    torch.testing.assert_close(*samples, rtol=0, atol=1e-4)


def test_progress_is_told() -> None:
    told: list[tuple[int, int]] = []
    make().sample(some_network, (1, 4), num_steps=3, callback=lambda *at: told.append(at))
    assert told == [(1, 3), (2, 3), (3, 3)]


def test_run_records_gradients_and_sample_does_not() -> None:
    for name in SAMPLERS:
        diffusion = make(prediction_type="sample")
        weight = torch.tensor(0.5, requires_grad=True)
        model = lambda x, t, w=weight: w * x  # noqa: E731
        sampler = make_sampler(diffusion, name, 3)
        assert not sampler.sample((2, 5), model=model).requires_grad
        sampler.run(model, torch.randn(2, 5)).sum().backward()
        assert weight.grad is not None and torch.isfinite(weight.grad)


def test_the_configuration_chooses_the_sampler() -> None:
    diffusion = make(sampler="ddim", sampling_steps=7, eta=0.25)
    sampler = make_sampler(diffusion)
    assert isinstance(sampler, DDIMSampler)
    assert sampler.eta == 0.25
    assert len(sampler.timesteps) == 7
    assert len(make_sampler(diffusion, "ddpm", 3).timesteps) == 3
    with pytest.raises(UsageError, match=r"'euler'.*ddpm"):
        make_sampler(diffusion, "euler")
    with pytest.raises(UsageError, match="steps 101"):
        make_sampler(diffusion, "ddim", 101)
