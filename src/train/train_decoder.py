"""Decoder training: from windows as the denoiser gives them to the true trajectories (ruling 5).

motion-tools train decoder --audio runs/audio --data DIR_OR_URL
[network.decoder.decoder=residual] [key=value ...] [--resume]

The UNet rests. The decoder sees clean windows with Gaussian noise: row by row of the size of the
UNet's own error, times a factor drawn log-uniformly, partly alike from frame to frame. It starts
as a correction of nothing; validation shows both that start and what became of it.

Letters: B batch, T frames.
"""

import math
from dataclasses import dataclass
from pathlib import Path

import torch
from torch import Tensor, nn

from ..shared.config_audio import AudioNetworkConfig, TrainDecoderConfig
from ..shared.data.phrases.dataset import PhraseBatch
from ..shared.model.audio.audio_motion_model import AudioMotionModel
from ..shared.model.audio.decoder import (
    Decoder,
    DecoderLoss,
    create_motion_decoder,
    total,
    wrapped_phase,
)
from ..shared.motion.trajectory import PHASE
from ..shared.pipelines.song_sampler import SPARE
from . import audio_stages
from .audio_stages import (
    PhraseTask,
    bar_phase_at_start,
    open_held_back,
    open_phrases,
    save_noted,
    true_trajectory,
    whole_windows,
)
from .launch import STAGES
from .run_log import console
from .task import generator, means, to_device

ERROR_BATCHES = 4  # on which the UNet's error is measured
ERROR_LEVEL = 0.25  # up to this share of the diffusion steps: what sampling ends with


@dataclass(frozen=True)
class DecoderBatch:
    """What a decoder sees and should give.

    Attributes:
        rows: [B,T,25] raw, noisy.
        target: [B,T,25] trajectories.
        start: [B] first bar phase.
        start_known: [B] bool.
    """

    rows: Tensor
    target: Tensor
    start: Tensor
    start_known: Tensor


class DecoderObjective(nn.Module):
    """A decoder with its loss, so that one call holds every weight (DDP)."""

    def __init__(self, decoder: Decoder, config: TrainDecoderConfig) -> None:
        super().__init__()
        self.decoder = decoder
        self.loss = DecoderLoss(config.losses)
        self.start_weight = config.start_weight

    def forward(self, batch: DecoderBatch) -> dict[str, Tensor]:
        """Weighted terms and their sum `loss`.

        The phase is judged as if the start were known; the guess of the start by itself.
        """
        decoded = self.decoder.decode(batch.rows)
        guess = decoded.phase_unwrapped[:, :1]
        bars = decoded.phase_unwrapped - guess + batch.start[:, None]
        columns = decoded.trajectory[..., :PHASE], decoded.trajectory[..., PHASE + 1 :]
        trajectory = torch.cat((columns[0], wrapped_phase(bars)[..., None], columns[1]), dim=-1)
        terms = self.loss(trajectory[:, :-SPARE], batch.target[:, :-SPARE])
        if self.start_weight:
            turn = 2 * math.pi * (guess[:, 0] - batch.start)
            error = (1 - turn.cos()) * batch.start_known / (2 * math.pi**2)
            terms["start"] = self.start_weight * error.mean()
        return {"loss": total(terms), **terms}


def time_noise(
    size: tuple[int, int, int], widths: Tensor, share: Tensor, draws: torch.Generator
) -> Tensor:
    """Unit Gaussian noise [B,C,T], a share of whose variance is alike from frame to frame.

    Args:
        size: B, C, T.
        widths: [B] frames, standard deviation of the kernel that makes noise alike.
        share: [B] in [0, 1].
        draws: source of the noise.
    """
    white, smooth = torch.randn(size, generator=draws), torch.randn(size, generator=draws)
    frequencies = torch.fft.rfftfreq(size[2])  # turns a frame
    gain = torch.exp(-2 * (math.pi * widths[:, None] * frequencies) ** 2)  # [B,F]
    smooth = torch.fft.irfft(torch.fft.rfft(smooth) * gain[:, None], n=size[2])
    twice = torch.full_like(frequencies, 2.0)  # each frequency but the ends stands for two
    twice[0] = 1.0
    if size[2] % 2 == 0:
        twice[-1] = 1.0
    power = (gain.square() * twice).sum(dim=1) / size[2]
    smooth = smooth / power.sqrt()[:, None, None]
    part = share[:, None, None]
    noise: Tensor = (1 - part).sqrt() * white + part.sqrt() * smooth
    return noise


def log_uniform(limits: tuple[float, float], num: int, draws: torch.Generator) -> Tensor:
    """[num] numbers between two limits, uniform in their logarithm."""
    low, high = (math.log(limit) for limit in limits)
    return torch.exp(low + (high - low) * torch.rand(num, generator=draws))


@torch.no_grad()
def denoiser_error(model: AudioMotionModel, batches: list[PhraseBatch], *seed: int) -> Tensor:
    """Root mean square error [25] of the UNet's x_0 in z-scores, at low noise."""
    squares, most = (
        torch.zeros(len(model.mean)),
        int(model.diffusion.config.timesteps * ERROR_LEVEL),
    )
    for index, phrases in enumerate(batches):
        draws = generator("denoiser-error", *seed, index)
        clean = model.normalise(phrases.motion)
        timesteps = torch.randint(max(most, 1), (len(clean),), generator=draws)
        noisy = model.diffusion.q_sample(
            clean, timesteps, torch.randn(clean.shape, generator=draws)
        )
        output = model.unet(noisy, timesteps, phrases.audio)
        error = model.diffusion.predict_x0(output, noisy, timesteps) - clean
        squares += error.square().mean(dim=(0, 2)) / len(batches)
    return squares.sqrt()


class DecoderTask(PhraseTask):
    """What the trainer needs to know (src/train/task.py)."""

    config: TrainDecoderConfig

    def __init__(self, config: TrainDecoderConfig, network: AudioNetworkConfig) -> None:
        self.config = config
        self.model = AudioMotionModel.from_pretrained(config.audio)
        self.source = self.model.card
        self.train = open_phrases(config, "train", config.num_phrases)
        self.held_back = open_held_back(config)
        self.model.replace_decoder(create_motion_decoder(network.decoder))
        self.module = DecoderObjective(self.model.decoder.train(), config)
        self.untrained = DecoderObjective(create_motion_decoder(network.decoder), config).eval()
        batches = [
            whole_windows(self.train.batch(index + 1, min(config.batch_size, 16)))
            for index in range(ERROR_BATCHES)
        ]
        self.error = denoiser_error(self.model, batches, config.seed)
        self.frozen = (self.untrained,)
        assert self.source.weights is not None
        self.identity = {
            "network": self.model.config.model_dump(mode="json", by_alias=True),
            "audio-weights": self.source.weights.sha256,
            "data-hash": self.train.fingerprint,
        }

    # ------------------------------------------------------------ batches

    def _drawn(
        self, phrases: PhraseBatch, draws: torch.Generator, *, clean: bool = False
    ) -> DecoderBatch:
        """Windows with noise, or `clean` without."""
        phrases, config, num = whole_windows(phrases), self.config, len(phrases)
        scale = log_uniform(config.noise, num, draws)[:, None, None] * self.error[:, None]
        widths, share = (
            log_uniform(config.correlation, num, draws),
            torch.rand(num, generator=draws),
        )
        size, std = phrases.motion.shape, self.model.std[:, None]
        noise = time_noise((size[0], size[1], size[2]), widths, share, draws)
        rows = phrases.motion if clean else phrases.motion + noise * scale * std
        start, known = bar_phase_at_start(phrases.audio)
        target = true_trajectory(phrases.motion, start)
        return DecoderBatch(rows.transpose(1, 2), target, start, known)

    # ------------------------------------------------------------ learning

    def validation(self, module: nn.Module) -> dict[str, float]:
        """Losses on held-back phrases with fixed noise and with none, beside the untrained's."""
        device = self.untrained.decoder.input_scale.device
        found = []
        for index in range(self.config.validation_batches):
            phrases = self.held_back.batch(index + 1, self.config.batch_size)
            for clean, prefix in ((False, ""), (True, "clean-")):
                batch = self._drawn(phrases, generator("validation", index), clean=clean)
                batch = to_device(batch, device)
                losses = module(batch)
                figures = {"clean-loss": losses["loss"]} if clean else losses
                untrained = self.untrained(batch)["loss"]
                found.append({**figures, f"untrained-{prefix}loss": untrained})
        return means(found)

    # ------------------------------------------------------------ results

    def save_pretrained(self, module: nn.Module, folder: Path) -> None:
        """The audio model with the trained decoder: a folder like the one that was read.

        A decoder that does harm on held-back phrases is left out.
        """
        model = self._finished(module)
        if self.figures["loss"] > self.figures["untrained-loss"]:
            console.print("no better than the untrained decoder, which is kept: train longer")
            model.replace_decoder(self.untrained.decoder)
        trained = {"steps": self.config.steps, "validation": self.figures}
        save_noted(model, folder, training={**self.source.training, "decoder": trained})

    def _finished(self, module: nn.Module) -> AudioMotionModel:
        assert isinstance(module, DecoderObjective)
        decoder = create_motion_decoder(module.decoder.config)
        decoder.load_state_dict(module.decoder.state_dict())
        self.model.replace_decoder(decoder)
        return self.model.eval()


network_of = audio_stages.network_of


if __name__ == "__main__":
    STAGES["decoder"].app()()
