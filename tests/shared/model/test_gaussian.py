"""Noising, the three predictions, the posterior and the training loss."""

import pytest
import torch
from hypothesis import given, settings
from hypothesis import strategies as st
from torch import Tensor, nn
from torch.utils._python_dispatch import TorchDispatchMode

from src.shared.config_schema import DiffusionConfig
from src.shared.model.diffusion import GaussianDiffusion, masked_loss

SHAPES = ((3, 25, 16), (3, 8, 23, 6), (3, 5))
PREDICTIONS = ("epsilon", "sample", "v")


def make(prediction: str = "epsilon", **changes: object) -> GaussianDiffusion:
    return GaussianDiffusion(
        DiffusionConfig.model_validate({"timesteps": 100, "prediction_type": prediction} | changes)
    )


@pytest.mark.parametrize("shape", SHAPES)
def test_q_sample_has_the_printed_mean_and_variance(shape: tuple[int, ...]) -> None:
    diffusion, t = make(), torch.tensor([0, 40, 99])
    x_0, noise = torch.randn(shape), torch.randn(shape)
    x_t = diffusion.q_sample(x_0, t, noise)
    assert x_t.shape == shape
    for row, step in enumerate(t.tolist()):
        alpha_bar = diffusion.alpha_bar(step)
        expected = alpha_bar**0.5 * x_0[row] + (1 - alpha_bar) ** 0.5 * noise[row]
        torch.testing.assert_close(x_t[row], expected, rtol=1e-5, atol=1e-6)


def test_q_sample_without_noise_draws_it() -> None:
    x_t = make().q_sample(torch.zeros(2, 5000), torch.tensor([99, 99]))
    assert abs(float(x_t.std()) - 1) < 0.05


@settings(deadline=None, max_examples=60)
@given(
    prediction=st.sampled_from(PREDICTIONS),
    schedule=st.sampled_from(("linear", "cosine", "sqrt")),
    shape=st.sampled_from(SHAPES),
    step=st.integers(0, 98),  # at 99 cosine leaves 64,000 times less signal than noise
    seed=st.integers(0, 2**31),
)
def test_predictions_invert_the_target(
    prediction: str, schedule: str, shape: tuple[int, ...], step: int, seed: int
) -> None:
    diffusion = make(prediction, beta_schedule=schedule)
    generator = torch.Generator().manual_seed(seed)
    x_0 = torch.randn(shape, generator=generator).clamp(-5, 5)
    noise = torch.randn(shape, generator=generator)
    t = torch.tensor([step, step // 2, 0])
    x_t = diffusion.q_sample(x_0, t, noise)
    output = diffusion.target(x_0, noise, t)
    torch.testing.assert_close(diffusion.predict_x0(output, x_t, t), x_0, rtol=1e-4, atol=1e-3)


def test_the_last_cosine_step_is_limited_for_epsilon() -> None:
    diffusion = make("epsilon", timesteps=1000)
    x_t, wrong, t = torch.randn(2, 8), torch.zeros(2, 8), torch.tensor([999, 999])
    assert diffusion.predict_x0(wrong, x_t, t).abs().max() <= 6
    assert diffusion.predict_x0(wrong, x_t, t, clip=False).abs().max() > 1000
    assert (
        make("epsilon", timesteps=1000, clip_sigma=None).predict_x0(wrong, x_t, t).abs().max()
        > 1000
    )


def test_alpha_bar_before_the_first_step_is_one() -> None:
    diffusion = make()
    assert diffusion.alpha_bar(-1) == 1.0
    assert diffusion.alpha_bar(0) < 1.0


def test_the_posterior_is_bayes_rule() -> None:
    """Precision-weighted product of q(x_{t-1} | x_0) and q(x_t | x_{t-1})."""
    diffusion, step = make(), 57
    x_0, x_t, t = torch.randn(1, 6), torch.randn(1, 6), torch.tensor([step])
    mean, variance = diffusion.q_posterior(x_0, x_t, t)
    beta = float(diffusion.schedule.betas[step])
    before = diffusion.alpha_bar(step - 1)
    precision = 1 / (1 - before) + (1 - beta) / beta
    expected = (before**0.5 * x_0 / (1 - before) + (1 - beta) ** 0.5 * x_t / beta) / precision
    torch.testing.assert_close(mean, expected, rtol=1e-4, atol=1e-5)
    assert float(variance) == pytest.approx(1 / precision, rel=1e-4)


def test_the_posterior_at_step_zero_is_x0() -> None:
    x_0 = torch.randn(2, 4)
    mean, variance = make().q_posterior(x_0, torch.randn(2, 4), torch.zeros(2, dtype=torch.long))
    torch.testing.assert_close(mean, x_0)
    assert not variance.any()


def test_p_sample_is_noiseless_only_where_t_is_zero() -> None:
    diffusion = make("sample")
    model = lambda x, t: torch.full_like(x, 0.5)  # noqa: E731
    x_t, t = torch.randn(2, 2000), torch.tensor([0, 50])
    first = diffusion.p_sample(x_t, t, model=model)
    second = diffusion.p_sample(x_t, t, model=model)
    torch.testing.assert_close(first[0], torch.full((2000,), 0.5))
    difference = (first[1] - second[1]).std() / 2**0.5
    assert float(difference) == pytest.approx(
        float(diffusion.posterior_variance[50]) ** 0.5, rel=0.1
    )


def test_the_documents_signatures_work_with_a_model_inside() -> None:
    class Denoiser(nn.Module):
        def __init__(self) -> None:
            super().__init__()
            self.mix = nn.Conv1d(25 + 7, 25, 1)

        def forward(self, x_t: Tensor, t: Tensor, condition: Tensor) -> Tensor:
            return self.mix(torch.cat((x_t, condition), dim=1))

    model, condition, x_0 = Denoiser(), torch.randn(2, 7, 16), torch.randn(2, 25, 16)
    diffusion = GaussianDiffusion(DiffusionConfig(timesteps=20), model)
    loss = diffusion.training_loss(model, x_0, condition)
    loss.backward()
    assert model.mix.weight.grad is not None and torch.isfinite(model.mix.weight.grad).all()
    t = torch.tensor([3, 9])
    assert diffusion.p_sample(x_0, t, condition).shape == x_0.shape
    assert diffusion.ddim_sample(model, x_0.shape, condition, 5, 0.0).shape == x_0.shape


@pytest.mark.parametrize("loss_type", ["mse", "l1", "huber"])
@pytest.mark.parametrize(("shape", "time_dim"), [((2, 10, 23, 6), 1), ((2, 25, 10), -1)])
def test_padding_never_reaches_the_loss(
    loss_type: str, shape: tuple[int, ...], time_dim: int
) -> None:
    output, target = torch.randn(shape, requires_grad=True), torch.randn(shape)
    mask = torch.arange(10) < torch.tensor([[10], [4]])
    loss = masked_loss(output, target, loss_type, mask=mask, time_dim=time_dim)

    padding = ~mask.view(2, 10, 1, 1) if time_dim == 1 else ~mask.view(2, 1, 10)
    for garbage in (1e30, float("nan"), float("inf")):
        spoiled = target.masked_fill(padding, garbage)
        again = masked_loss(output, spoiled, loss_type, mask=mask, time_dim=time_dim)
        assert again.item() == loss.item()

    kept = [(output[0], target[0]), (output[1:], target[1:])]
    kept[1] = tuple(x.narrow(time_dim, 0, 4) for x in kept[1])  # type: ignore[assignment]
    a = torch.cat([x.flatten() for x, _ in kept])
    b = torch.cat([x.flatten() for _, x in kept])
    assert loss.item() == pytest.approx(masked_loss(a, b, loss_type).item(), rel=1e-5)

    loss.backward()
    assert output.grad is not None
    assert not output.grad.masked_select(padding).any()


def test_masked_training_loss_ignores_padded_frames() -> None:
    diffusion = make("sample")
    x_0, noise, t = torch.randn(2, 10, 3, 6), torch.randn(2, 10, 3, 6), torch.tensor([5, 60])
    mask = torch.arange(10) < torch.tensor([[7], [4]])
    model = lambda x, _: 0.3 * x  # noqa: E731
    losses = []
    for fill in (0.0, 100.0):
        padded = x_0.masked_fill(~mask[..., None, None], fill)
        losses.append(float(diffusion.training_loss(model, padded, t=t, noise=noise, mask=mask)))
    assert losses[0] == losses[1]
    assert losses[0] != float(diffusion.training_loss(model, x_0, t=t, noise=noise))


def test_an_empty_mask_costs_nothing() -> None:
    mask = torch.zeros(2, 4, dtype=torch.bool)
    assert float(masked_loss(torch.randn(2, 4, 3), torch.randn(2, 4, 3), mask=mask)) == 0


def test_the_training_loss_of_a_perfect_model_is_zero() -> None:
    for prediction in PREDICTIONS:
        diffusion = make(prediction)
        x_0, noise, t = torch.randn(2, 25, 8), torch.randn(2, 25, 8), torch.tensor([3, 77])
        perfect = lambda x, s, d=diffusion, a=x_0, n=noise: d.target(a, n, s)  # noqa: E731
        assert float(diffusion.training_loss(perfect, x_0, t=t, noise=noise)) == 0


def test_training_draws_are_reproducible() -> None:
    diffusion, x_0 = make(), torch.randn(4, 25, 8)
    model = lambda x, t: x * t.view(-1, 1, 1) / 100  # noqa: E731
    a, b = (
        diffusion.training_loss(model, x_0, generator=torch.Generator().manual_seed(7))
        for _ in range(2)
    )
    assert float(a) == float(b)


def test_half_precision_outputs_give_a_float32_loss() -> None:
    model = lambda x, t: x.bfloat16()  # noqa: E731
    assert make().training_loss(model, torch.randn(2, 25, 8)).dtype == torch.float32
    sample = make("sample").sample(model, (2, 25, 8), num_steps=3, sampler="dpm-solver++")
    assert sample.dtype == torch.float32


class NoFloat64(TorchDispatchMode):
    """Fail on any operation that returns a float64 tensor: MPS has none."""

    def __torch_dispatch__(self, func, types, args=(), kwargs=None):  # type: ignore[no-untyped-def]
        result = func(*args, **(kwargs or {}))
        for part in result if isinstance(result, tuple | list) else (result,):
            assert not (isinstance(part, Tensor) and part.dtype == torch.float64), str(func)
        return result


@pytest.mark.parametrize("prediction", PREDICTIONS)
def test_no_float64_on_the_model_path(prediction: str) -> None:
    model = lambda x, t: 0.9 * x  # noqa: E731
    with NoFloat64():
        diffusion = make(prediction)
        diffusion.training_loss(model, torch.randn(2, 8, 23, 6), mask=torch.ones(2, 8).bool())
        diffusion.p_sample(torch.randn(2, 25, 8), torch.tensor([0, 5]), model=model)
        for sampler in ("ddpm", "ddim", "dpm-solver++"):
            sample = diffusion.sample(model, (2, 8, 23, 6), sampler=sampler, num_steps=4, eta=0.5)
            assert sample.dtype == torch.float32
