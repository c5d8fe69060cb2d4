"""DDIM with gradients, the activations of one denoiser call in memory at a time (TECH 7.3).

A predicted x_0 is limited as in sampling (ruling 13). A path starts from pure noise, or from
noised data, which is the only start that can be compared with that data (ruling 24).

Letters: B batch, T frames.
"""

import torch
from torch import Tensor
from torch.utils.checkpoint import checkpoint

from ..shared.model.diffusion.conditions import ModelFn
from ..shared.model.diffusion.gaussian import GaussianDiffusion
from ..shared.model.diffusion.samplers import DDIMSampler


class DifferentiableSampler:
    """A short deterministic DDIM through which gradients flow.

    Args:
        diffusion: the process.
        num_steps: of a whole path.
        data_noise: share of the diffusion's steps up to which data is noised at most.
    """

    def __init__(
        self, diffusion: GaussianDiffusion, num_steps: int = 5, data_noise: float = 0.5
    ) -> None:
        self.ddim = DDIMSampler(diffusion, num_steps, eta=0.0)
        most, last = data_noise * diffusion.config.timesteps, num_steps - 1
        places = [place for place, t in enumerate(self.ddim.timesteps) if t <= most]
        self.data_starts: list[int] = places or [last]  # places of a path where data may enter

    def from_noise(self, model_fn: ModelFn, noise: Tensor) -> Tensor:
        """The whole path from noise [B,25,T] to x_0."""
        return self.ddim.run(recomputed(model_fn), noise)

    def from_data(self, model_fn: ModelFn, x_0: Tensor, noise: Tensor, start: int) -> Tensor:
        """Data [B,25,T], noised to place `start` of the path and denoised along the rest."""
        step = torch.full((len(x_0),), self.ddim.timesteps[start], device=x_0.device)
        noisy = self.ddim.diffusion.q_sample(x_0, step, noise)
        return self.ddim.run(recomputed(model_fn), noisy, start=start)


def recomputed(model_fn: ModelFn) -> ModelFn:
    """The same denoiser, which keeps its input only and computes anew for the backward pass."""

    def call(x_t: Tensor, t: Tensor) -> Tensor:
        if not torch.is_grad_enabled():
            return model_fn(x_t, t)
        output: Tensor = checkpoint(model_fn, x_t, t, use_reentrant=False)
        return output

    return call
