"""What end-to-end fine-tuning minimises, and the sampler with gradients (TECH 7.1 to 7.3).

Three losses (rulings 13, 23, 24): the diffusion's own; the reconstruction of noised ground truth
by sampler and decoder; the temporal coherence of what sampler and decoder make of pure noise.

Letters: B batch, T frames.
"""

from dataclasses import dataclass

import torch
from pydantic import Field
from torch import Tensor, nn
from torch.utils.checkpoint import checkpoint

from ..shared.config_audio import DecoderLossConfig, TemporalLossConfig
from ..shared.model.audio.audio_motion_model import AudioMotionModel
from ..shared.model.audio.losses import DecoderLoss, TemporalCoherenceLoss, total
from ..shared.model.diffusion.gaussian import GaussianDiffusion
from ..shared.model.diffusion.guidance import ModelFn, with_condition
from ..shared.model.diffusion.samplers import DDIMSampler
from ..shared.motion.trajectory import FPS, POSITION, QUATERNION
from ..shared.pipelines.song_sampler import SPARE, holding
from .train_audio import AudioBatch, TrainAudioConfig, audio_losses


class DifferentiableSampler:
    """A short deterministic DDIM through which gradients flow (TECH 7.3).

    The activations of one denoiser call are in memory at a time. A predicted x_0 is limited as in
    sampling (ruling 13). A path starts from pure noise, or from noised data, which is the only
    start that can be compared with that data (ruling 24).

    Args:
        diffusion: the process.
        num_steps: of a whole path.
        data_noise: share of the diffusion's steps up to which data is noised at most.
    """

    def __init__(
        self, diffusion: GaussianDiffusion, num_steps: int = 5, data_noise: float = 0.5
    ) -> None:
        self.diffusion = diffusion
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
        noisy = self.diffusion.q_sample(x_0, step, noise)
        return self.ddim.run(recomputed(model_fn), noisy, start=start)


def recomputed(model_fn: ModelFn) -> ModelFn:
    """The same denoiser, which keeps its input only and computes anew for the backward pass."""

    def call(x_t: Tensor, t: Tensor) -> Tensor:
        if not torch.is_grad_enabled():
            return model_fn(x_t, t)
        output: Tensor = checkpoint(model_fn, x_t, t, use_reentrant=False)
        return output

    return call


CONTINUOUS = 0.95  # smallest dot of neighbouring quaternions that passes (ruling 18)


class E2eWeights(TrainAudioConfig):
    """The part of finetune_e2e.yaml that says what is minimised."""

    diffusion_weight: float = Field(0.1, ge=0)
    decoder_weight: float = Field(1.0, ge=0)
    temporal_weight: float = Field(10.0, ge=0)
    ddim_steps: int = Field(5, ge=1)  # of the sampler with gradients
    data_noise: float = Field(0.5, gt=0, le=1)  # ground truth is noised up to this share of steps
    losses: DecoderLossConfig = DecoderLossConfig()
    temporal: TemporalLossConfig = TemporalLossConfig()


@dataclass(frozen=True)
class E2eBatch:
    """Everything random is drawn already, on the CPU.

    Attributes:
        audio: what the diffusion learns from; `clean` is the ground truth, all frames real.
        target: [B,T,25], the true trajectories.
        phase: [B] bars at the first frame.
        noise: [B,25,T] where samples start.
        start: place of the sampler's path where noised ground truth enters.
    """

    audio: AudioBatch
    target: Tensor
    phase: Tensor
    noise: Tensor
    start: int


class E2eObjective(nn.Module):
    """The whole model with its losses, so that one call holds every weight (DDP).

    The model stays in evaluation mode: dropout in a sampled path would be jitter to smooth away.
    """

    def __init__(self, model: AudioMotionModel, config: E2eWeights) -> None:
        super().__init__()
        self.model = model.eval()
        self.config = config
        self.sampler = DifferentiableSampler(model.diffusion, config.ddim_steps, config.data_noise)
        self.decoder_loss = DecoderLoss(config.losses)
        self.temporal_loss = TemporalCoherenceLoss(config.temporal)

    def forward(self, batch: E2eBatch) -> dict[str, Tensor]:
        """`loss`, its three parts unweighted, their terms, and what a collapse would change."""
        config, audio, model = self.config, batch.audio, self.model
        diffusion = audio_losses(
            model.unet,
            audio,
            model.diffusion,
            model.std,
            velocity_weight=config.velocity_weight,
        )["loss"]
        heard = with_condition(model.unet, model.prepare(audio.condition))
        model_fn = holding(heard, audio.known, audio.clean)
        made = self._decode(self.sampler.from_noise(model_fn, batch.noise), batch)
        found = self.sampler.from_data(model_fn, audio.clean, audio.noise, batch.start)
        target = batch.target[:, :-SPARE]
        reconstruction = self.decoder_loss(self._decode(found, batch), target)
        temporal = self.temporal_loss(made)
        parts = {
            "diffusion": diffusion,
            "reconstruction": total(reconstruction),
            "temporal": total(temporal),
        }
        weighted = (
            config.diffusion_weight * parts["diffusion"]
            + config.decoder_weight * parts["reconstruction"]
            + config.temporal_weight * parts["temporal"]
        )
        terms = {f"decoder-{name}": value for name, value in reconstruction.items()} | temporal
        terms = {name.replace("_", "-"): value for name, value in terms.items()}
        return {"loss": weighted, **parts, **terms, **_liveliness(made, target)}

    def _decode(self, x_0: Tensor, batch: E2eBatch) -> Tensor:
        """The trajectory [B,T,25] without its spare frames (ruling 6)."""
        x_0 = torch.where(batch.audio.known, batch.audio.clean, x_0)
        return self.model.decode(x_0, batch.phase).trajectory[:, :-SPARE]


@torch.no_grad()
def _liveliness(made: Tensor, real: Tensor) -> dict[str, Tensor]:
    """Mean speed m/s of samples and of ground truth; share of samples without a quaternion leap."""
    quaternion = made[..., QUATERNION]
    dots = (quaternion[:, 1:] * quaternion[:, :-1]).sum(dim=-1)  # [B,T-1]
    passed = dots.min(dim=1).values > CONTINUOUS
    return {
        "mean-speed": mean_speed(made),
        "real-speed": mean_speed(real),
        "quaternion-pass-rate": passed.float().mean(),
    }


def mean_speed(trajectory: Tensor) -> Tensor:
    """Of the path itself [B,T,25], not of the velocity columns; a scalar, m/s."""
    steps = (trajectory[:, 1:] - trajectory[:, :-1])[..., POSITION]
    speed: Tensor = steps.norm(dim=-1).mean() * FPS
    return speed
