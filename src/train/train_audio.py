"""Audio training: UNet1D learns trajectories from sound (TECH 6; rulings 8, 9, 13 to 15).

motion-tools train audio --data DIR_OR_URL [key=value ...] [--resume]

Part of each batch has known entries: the first frames of a window, as sampling a long song goes
on from the window before, or the style, as `--style` sets it. They come without noise and are not
learned.

Letters: B batch, T frames.
"""

import copy
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import torch
from torch import Tensor, nn

from ..shared.config_audio import AudioNetworkConfig, TrainAudioConfig
from ..shared.data.phrases.dataset import PhraseBatch, motion_statistics
from ..shared.device import autocast, choose_compute
from ..shared.errors import UsageError
from ..shared.model.audio import with_phase_rows
from ..shared.model.audio.audio_motion_model import AudioMotionModel
from ..shared.model.audio.conditioning import ConditionAugmentation, MemoryCondition
from ..shared.model.diffusion import GaussianDiffusion, masked_loss
from ..shared.motion.trajectory import FPS, POSITION, QUATERNION, STYLE
from .audio_stages import PhraseTask, open_held_back, open_phrases, save_noted
from .launch import STAGES
from .task import means, to_device
from .train_generation import noise_levels, spread_timesteps


@dataclass(frozen=True)
class AudioBatch:
    """Everything random is drawn already, on the CPU, so that it is the same on every device.

    Attributes:
        clean, noise: [B,25,T] z-scored.
        known: [B,25,T] bool, entries that the network is given.
        mask: [B,T] bool, real frames.
        condition: [B,167,T], augmented; drop [B] bool, windows that hear nothing.
        timesteps: [B] long.
        memory: what is remembered for the windows; None = nothing.
    """

    clean: Tensor
    noise: Tensor
    known: Tensor
    mask: Tensor
    condition: Tensor
    drop: Tensor
    timesteps: Tensor
    memory: MemoryCondition | None = None


def audio_losses(
    module: nn.Module,
    batch: AudioBatch,
    diffusion: GaussianDiffusion,
    std: Tensor,
    *,
    velocity_weight: float,
) -> dict[str, Tensor]:
    """Error of the network's prediction, of the frame differences it means, and their sum `loss`.

    Args:
        module: the UNet.
        batch: what it sees.
        diffusion: its process.
        std: [25] of the rows.
        velocity_weight: 0 = without frame differences.
    """
    noisy = diffusion.q_sample(batch.clean, batch.timesteps, batch.noise)
    noisy = torch.where(batch.known, batch.clean, noisy)
    output = module(noisy, batch.timesteps, batch.condition, batch.drop, batch.memory)
    target = diffusion.target(batch.clean, batch.noise, batch.timesteps)
    learned = torch.where(batch.known, target, output.float())
    error = diffusion.loss(learned, target, mask=batch.mask, time_dim=2)
    losses = {"loss": error, "diffusion": error}
    if velocity_weight:
        clip = diffusion.config.prediction_type != "sample"
        x_0 = diffusion.predict_x0(output.float(), noisy, batch.timesteps, clip=clip)
        losses["velocity"] = _velocity_error(x_0, batch, std)
        losses["loss"] = error + velocity_weight * losses["velocity"]
    return losses


def _velocity_error(x_0: Tensor, batch: AudioBatch, std: Tensor) -> Tensor:
    """Mean squared error of position and quaternion differences a second."""
    x_0 = torch.where(batch.known, batch.clean, x_0)
    error = (x_0 - batch.clean) * std.to(x_0.device)[:, None]  # [B,25,T] raw units
    error = torch.cat((error[:, POSITION], error[:, QUATERNION]), dim=1)  # [B,7,T]
    speed = (error[..., 1:] - error[..., :-1]) * FPS
    mask = batch.mask[:, 1:] & batch.mask[:, :-1]
    return masked_loss(speed, torch.zeros_like(speed), "mse", mask=mask, time_dim=2)


class AudioTask(PhraseTask):
    """What the trainer needs to know (src/train/task.py)."""

    config: TrainAudioConfig

    def __init__(self, config: TrainAudioConfig, network: AudioNetworkConfig) -> None:
        self.config = config
        self.network = network.model_copy(update={"window": config.target_frames})
        self.train = open_phrases(config, "train", config.num_phrases)
        self.held_back = open_held_back(config)
        self.model = self._start()
        self.std = self.model.std.clone()
        # a copy: samples are made by the task's own model, with averaged weights, on the CPU
        self.module = copy.deepcopy(self.model.unet)
        self.augment = ConditionAugmentation(network.condition.augmentation)
        self.diffusion = GaussianDiffusion(network.diffusion)
        self.frozen = (self.diffusion,)
        self.compute = choose_compute(config.device, config.precision)
        self.identity = {
            "network": self.network.model_dump(mode="json", by_alias=True),
            "data-hash": self.train.fingerprint,
        }

    def _start(self) -> AudioMotionModel:
        """The model before training: nothing learned, or all of `init` with its z-scores."""
        model = AudioMotionModel(self.network)
        if self.config.init is None:
            model.set_statistics(*motion_statistics(self.train))
            return model
        trained = AudioMotionModel.from_pretrained(self.config.init)
        if _trained_shape(trained.config) != _trained_shape(self.network):
            raise UsageError(
                f"init {self.config.init} is another network than profile {self.config.profile};"
                " train with the profile and the network overrides that it was trained with"
            )
        model.load_state_dict(trained.state_dict())
        return model

    # ------------------------------------------------------------ batches

    def _drawn(self, phrases: PhraseBatch, draws: torch.Generator) -> Any:
        """Windows with noise, steps, what is known and what is dropped."""
        timesteps = spread_timesteps(len(phrases), self.diffusion.config.timesteps, draws)
        known = self._known(phrases, draws)
        drop = self.augment.draw_drop(len(phrases), draws)
        return self._noised(phrases, timesteps, known, draws, drop)

    def _known(self, phrases: PhraseBatch, draws: torch.Generator) -> Tensor:
        """Entries [B,25,T] that the network is given."""
        config, (size, _, frames) = self.config, phrases.motion.shape
        least, most = config.prefix_frames
        lengths = torch.randint(least, most + 1, (size,), generator=draws).clamp(max=frames // 2)
        lengths[torch.rand(size, generator=draws) >= config.prefix_share] = 0
        known = (torch.arange(frames) < lengths[:, None])[:, None].repeat(1, 25, 1)
        styled = torch.rand(size, generator=draws) < config.style_share
        known[:, STYLE] |= styled[:, None, None]
        return known

    def _noised(
        self,
        phrases: PhraseBatch,
        timesteps: Tensor,
        known: Tensor,
        draws: torch.Generator,
        drop: Tensor | None = None,
    ) -> AudioBatch:
        """Without `drop`, as in validation, all windows hear the sound as it is."""
        clean = self.model.normalise(phrases.motion) * phrases.mask[:, None]
        noise = torch.randn(clean.shape, generator=draws)
        if drop is None:
            condition, drop = with_phase_rows(phrases.audio), torch.zeros(len(phrases)).bool()
        else:
            condition = self.augment(phrases.audio, draws)
        return AudioBatch(clean, noise, known, phrases.mask, condition, drop, timesteps)

    # ------------------------------------------------------------ learning

    def training_step(self, module: nn.Module, batch: Any) -> dict[str, Tensor]:
        """Error of what the network predicts, and of the frame differences it means."""
        weight = self.config.velocity_weight
        return audio_losses(module, batch, self.diffusion, self.std, velocity_weight=weight)

    def validation(self, module: nn.Module) -> dict[str, float]:
        """Losses on held-back phrases at fixed steps and noise, overall and by noise level."""
        device = next(module.parameters()).device
        steps, found = self.diffusion.config.timesteps, []
        for index in range(self.config.validation_batches):
            phrases = self.held_back.batch(index + 1, self.config.batch_size)
            for level, draws, timesteps in noise_levels(index, len(phrases), steps):
                known = torch.zeros(phrases.motion.shape, dtype=torch.bool)
                batch = self._noised(phrases, timesteps, known, draws)
                batch = to_device(batch, device)
                with autocast(self.compute):
                    losses = self.training_step(module, batch)
                found.append({f"loss-{level}": losses["loss"], **losses})
        return means(found)

    # ------------------------------------------------------------ results

    def save_pretrained(self, module: nn.Module, folder: Path) -> None:
        """A folder that train_decoder, finetune_e2e and `generate --audio` read."""
        training = {"steps": self.config.steps, "validation": self.figures}
        data = self.train.fingerprint
        save_noted(self._finished(module), folder, trained=True, data=data, training=training)

    def _finished(self, module: nn.Module) -> AudioMotionModel:
        self.model.unet.load_state_dict(module.state_dict())
        return self.model.eval()


def _trained_shape(network: AudioNetworkConfig) -> dict[str, Any]:
    """What weights are bound to: the network without how it is sampled."""
    return network.model_dump(include={"unet", "condition", "decoder"})


if __name__ == "__main__":
    STAGES["audio"].app()()
