"""End-to-end fine-tuning: UNet, sampler and decoder learn to move coherently (TECH 7).

motion-tools train finetune-e2e --checkpoint runs/decoder --data DIR_OR_URL
[--epochs 50] [--lr-diffusion 1e-6] [--lr-decoder 5e-5] [key=value ...] [--resume]

The UNet learns slowly, the decoder faster. After each epoch the averaged weights are judged on
held-back phrases; the best are kept, and `patience` epochs without a better total end the run.

Three losses (rulings 13, 23, 24): the diffusion's own; the reconstruction of noised ground truth
by sampler and decoder; the temporal coherence of what sampler and decoder make of pure noise.

Letters: B batch, T frames.
"""

import copy
import math
import os
from dataclasses import asdict, dataclass
from functools import partial
from pathlib import Path
from typing import Any

import torch
from torch import Tensor, nn
from torch.utils.checkpoint import checkpoint

from ..shared.config_audio import FROM_EPOCHS, AudioNetworkConfig, FinetuneE2eConfig
from ..shared.data.phrases.dataset import PhraseBatch
from ..shared.device import autocast
from ..shared.io.files import write_json, write_text
from ..shared.model.audio.audio_motion_model import AudioMotionModel
from ..shared.model.audio.decoder import DecoderLoss, TemporalCoherenceLoss, total
from ..shared.model.diffusion import (
    DDIMSampler,
    GaussianDiffusion,
    ModelFn,
    holding,
    with_condition,
)
from ..shared.motion.trajectory import FPS, POSITION, QUATERNION
from ..shared.pipelines.song_sampler import SPARE
from . import audio_stages
from .audio_stages import (
    PhraseTask,
    bar_phase_at_start,
    open_phrases,
    save_noted,
    true_trajectory,
    whole_windows,
)
from .launch import STAGES
from .run_log import Epoch, as_logged, best_epoch, console, read_epochs, results_table
from .task import generator, means, to_device
from .train_audio import AudioBatch, AudioTask, audio_losses
from .train_generation import spread_timesteps

CONTINUOUS = 0.95  # smallest dot of neighbouring quaternions that passes (ruling 18)
BEST = "best"  # folder in the output, of the best weights so far


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

    def __init__(self, model: AudioMotionModel, config: FinetuneE2eConfig) -> None:
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


class FinetuneE2eTask(AudioTask):
    """What the trainer needs to know (src/train/task.py); batches as in audio training."""

    config: FinetuneE2eConfig

    def __init__(self, config: FinetuneE2eConfig, network: AudioNetworkConfig) -> None:
        super().__init__(config, network)
        # a copy: batches are made by the task's own model, which stays on the CPU
        self.module = E2eObjective(copy.deepcopy(self.model), config)
        self.learning_rates = {
            "model.unet.": config.lr_diffusion,
            "model.decoder.": config.lr_decoder,
        }
        self.identity["weights"] = [card.weights.sha256 for card in self.sources if card.weights]

    def _start(self) -> AudioMotionModel:
        model = AudioMotionModel.from_pretrained(self.config.checkpoint)
        self.sources = [model.card]
        if self.config.decoder_checkpoint is not None:
            other = AudioMotionModel.from_pretrained(self.config.decoder_checkpoint)
            model.replace_decoder(other.decoder)
            self.sources.append(other.card)
        self.network = model.config
        return model

    # ------------------------------------------------------------ batches

    def _drawn(self, phrases: PhraseBatch, draws: torch.Generator) -> E2eBatch:
        phrases = whole_windows(phrases)
        return self._completed(phrases, super()._drawn(phrases, draws), draws)

    def _completed(
        self, phrases: PhraseBatch, audio: Any, draws: torch.Generator, start: int | None = None
    ) -> E2eBatch:
        assert isinstance(self.module, E2eObjective)
        phase, _ = bar_phase_at_start(phrases.audio)
        noise = torch.randn(phrases.motion.shape, generator=draws)
        starts = self.module.sampler.data_starts
        if start is None:
            start = int(torch.randint(len(starts), (1,), generator=draws))
        target = true_trajectory(phrases.motion, phase)
        return E2eBatch(audio, target, phase, noise, starts[start % len(starts)])

    # ------------------------------------------------------------ learning

    training_step = PhraseTask.training_step  # the module gives its losses itself

    def validation(self, module: nn.Module) -> dict[str, float]:
        """All losses on held-back phrases with fixed noise; keeps the weights if best so far."""
        device, steps = next(module.parameters()).device, self.diffusion.config.timesteps
        found = []
        for index in range(self.config.validation_batches):
            phrases = whole_windows(self.held_back.batch(index + 1, self.config.batch_size))
            draws = generator("validation", index)
            timesteps = spread_timesteps(len(phrases), steps, draws)
            known = torch.zeros(phrases.motion.shape, dtype=torch.bool)
            audio = self._noised(phrases, timesteps, known, draws)
            batch = to_device(self._completed(phrases, audio, draws, index), device)
            with autocast(self.compute):
                found.append(module(batch))
        figures = means(found)
        before = [epoch.loss for epoch in self.epochs()]
        if not before or as_logged(figures["loss"]) < min(before):
            self._finished(module).save_pretrained(Path(self.config.output) / BEST)
        return figures

    def epochs(self) -> list[Epoch]:
        """Those validated and logged so far."""
        return read_epochs(Path(self.config.output) / "log.jsonl", self.config.validate_every)

    def has_converged(self) -> bool:
        """Whether the last `patience` epochs brought no better total."""
        epochs = self.epochs()
        return epochs[-1].epoch - best_epoch(epochs).epoch >= self.config.patience

    # ------------------------------------------------------------ results

    def save_pretrained(self, module: nn.Module, folder: Path) -> None:
        """The best weights as a folder like the one that was read; training_log.json; a table."""
        epochs = self.epochs()
        best = best_epoch(epochs)
        table = results_table(epochs, best)
        write_json(folder / "training_log.json", [asdict(epoch) for epoch in epochs])
        write_text(folder / "results.md", table)
        console.print(f"\n{table}", markup=False)
        model = AudioMotionModel.from_pretrained(folder / BEST)
        tuned = {"epochs": epochs[-1].epoch, "kept": best.epoch, "validation": best.validation}
        training = {**self.sources[0].training, "e2e": tuned}
        save_noted(model, folder, trained=True, training=training)

    def _finished(self, module: nn.Module) -> AudioMotionModel:
        assert isinstance(module, E2eObjective)
        self.model.load_state_dict(module.model.state_dict())
        return self.model


def in_steps(config: FinetuneE2eConfig) -> FinetuneE2eConfig:
    """The same with what follows from the number of phrases of an epoch."""
    num_phrases = len(open_phrases(config, "train", config.num_phrases))
    parts = config.gradient_accumulation * int(os.environ.get("WORLD_SIZE", "1"))
    steps = math.ceil(num_phrases / (config.batch_size * parts))
    update = {name: steps for name in FROM_EPOCHS[1:4]}
    rate = {"learning_rate": config.lr_decoder}
    return config.model_copy(update={**update, **rate, "steps": config.epochs * steps})


network_of = partial(audio_stages.network_of, of="--checkpoint and --decoder-checkpoint")


if __name__ == "__main__":
    STAGES["finetune-e2e"].app()()
