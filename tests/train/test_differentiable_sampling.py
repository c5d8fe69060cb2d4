"""DDIM with gradients: those of the plain loop, in little memory, limited, from noised data."""

import pytest
import torch
from tiny_audio_stage import tiny_audio_network
from torch import Tensor, nn

from src.shared.config_schema import DiffusionConfig
from src.shared.model.diffusion import DDIMSampler, GaussianDiffusion, ModelFn
from src.train.finetune_e2e import DifferentiableSampler, recomputed


class Net(nn.Module):
    """A denoiser with more activations than weights."""

    def __init__(self) -> None:
        super().__init__()
        torch.manual_seed(0)
        self.layers = nn.Sequential(
            nn.Conv1d(25, 64, 3, padding=1), nn.GELU(), nn.Conv1d(64, 25, 3, padding=1)
        )
        self.calls = 0

    def forward(self, x: Tensor, t: Tensor) -> Tensor:
        self.calls += 1
        output: Tensor = self.layers(x) + 0.001 * t[:, None, None]
        return output


def diffusion(**changes: object) -> GaussianDiffusion:
    return GaussianDiffusion(tiny_audio_network().diffusion.model_copy(update=changes))


def start(seed: int = 0) -> Tensor:
    return torch.randn(2, 25, 40, generator=torch.Generator().manual_seed(seed))


def gradients(net: Net, x_0: Tensor) -> list[Tensor]:
    net.zero_grad()
    (x_0[:, :3].square().mean() + x_0[..., 5:].mean()).backward()
    return [weight.grad.clone() for weight in net.parameters() if weight.grad is not None]


def test_gradients_are_those_of_the_plain_loop() -> None:
    net, process = Net(), diffusion()
    plain = DDIMSampler(process, 5, eta=0.0).run(net, start())
    ours = DifferentiableSampler(process, 5).from_noise(net, start())
    torch.testing.assert_close(ours, plain)
    expected, found = gradients(net, plain), gradients(net, ours)
    assert len(found) == 4
    for one, other in zip(found, expected, strict=True):
        torch.testing.assert_close(one, other)


def saved_bytes(model_fn: ModelFn, num_steps: int) -> int:
    """What autograd keeps for the backward pass, each storage counted once."""
    kept: dict[int, Tensor] = {}

    def keep(tensor: Tensor) -> Tensor:
        kept[tensor.untyped_storage().data_ptr()] = tensor
        return tensor

    with torch.autograd.graph.saved_tensors_hooks(keep, lambda tensor: tensor):
        DDIMSampler(diffusion(), num_steps, eta=0.0).run(model_fn, start())
    return sum(tensor.untyped_storage().nbytes() for tensor in kept.values())


def test_memory_hardly_grows_with_the_steps() -> None:
    """Plain: the activations of every call. Ours: one [B,25,T] a step."""
    net = Net()
    plain = saved_bytes(net, 10) - saved_bytes(net, 5)
    ours = saved_bytes(recomputed(net), 10) - saved_bytes(recomputed(net), 5)
    assert ours < 0.5 * plain
    state = start().nbytes
    assert ours < 5 * 2.1 * state  # x_t, and the mask of the limit on x_0


def test_every_call_is_computed_once_more_for_the_backward_pass() -> None:
    net = Net()
    made = DifferentiableSampler(diffusion(), 5).from_noise(net, start())
    assert net.calls == 5
    gradients(net, made)
    assert net.calls == 10
    with torch.no_grad():
        DifferentiableSampler(diffusion(), 5).from_noise(net, start())
    assert net.calls == 15


def test_predicted_data_is_limited_as_in_sampling() -> None:
    """At the last cosine step epsilon prediction multiplies an error by thousands (ruling 13)."""
    process = diffusion(prediction_type="epsilon")
    made = DifferentiableSampler(process, 3).from_noise(lambda x, t: 0.5 * x, start())
    assert made.abs().max() <= 6
    without = diffusion(prediction_type="epsilon", clip_sigma=None)
    made = DifferentiableSampler(without, 3).from_noise(lambda x, t: 0.5 * x, start())
    assert made.abs().max() > 6


@pytest.mark.parametrize("steps", [1, 5])
def test_noised_data_enters_late_and_comes_back(steps: int) -> None:
    process = GaussianDiffusion(DiffusionConfig(timesteps=50, prediction_type="sample"))
    sampler, data, noise = DifferentiableSampler(process, steps), start(1), start(2)
    levels = [sampler.ddim.timesteps[place] for place in sampler.data_starts]
    assert levels and (steps == 1 or max(levels) <= 25)
    seen: list[Tensor] = []

    def oracle(x_t: Tensor, t: Tensor) -> Tensor:
        seen.append(x_t)
        return data + 0 * x_t

    for place in sampler.data_starts:
        found = sampler.from_data(oracle, data, noise, place)
        torch.testing.assert_close(found, data)
        level = torch.full((2,), sampler.ddim.timesteps[place])
        torch.testing.assert_close(seen[0], process.q_sample(data, level, noise))
        assert len(seen) == steps - place
        seen.clear()
