"""AudioMotionModel: UNet1D, decoder, diffusion and statistics in one module and one folder.

Letters: B batch, T frames. Trajectories are [B, 25, T] rows for the diffusion, z-scored, and
[B, T, 25] columns for the decoder, raw.
"""

from pathlib import Path
from typing import Self

import torch
from torch import Tensor, nn

from ...config_audio import AudioNetworkConfig, MemoryConditionConfig
from ...config_schema import Config
from ..checkpoint import (
    ModelCard,
    load_state,
    read_card,
    read_tensors,
    resolve_model,
    with_prefix,
    write_checkpoint,
    wrong_kind,
)
from ..diffusion import GaussianDiffusion, ModelFn, guided
from . import Decoded
from .conditioning import ConditionAugmentation, MemoryCondition
from .decoder import Decoder, create_motion_decoder
from .unet import Prepared, UNet1D

KIND = "audio-motion"
PREFIX = "model"


class AudioMotionModel(nn.Module):
    """All that a trained audio branch needs.

    Args:
        config: of its parts.
        card: name, licence, training summary; `kind` and `audio_network` are filled in.
    """

    mean: Tensor
    std: Tensor

    def __init__(self, config: AudioNetworkConfig, card: ModelCard | None = None) -> None:
        super().__init__()
        card = card or ModelCard(kind=KIND)
        self.config = config
        self.card = card.model_copy(update={"kind": KIND, "audio_network": config})
        self.unet = UNet1D(config.unet, config.condition)
        self.decoder: Decoder = create_motion_decoder(config.decoder)
        self.augmentation = ConditionAugmentation(config.condition.augmentation)
        self.diffusion = GaussianDiffusion(config.diffusion)
        rows = config.unet.in_channels
        self.register_buffer("mean", torch.zeros(rows))
        self.register_buffer("std", torch.ones(rows))

    def replace_decoder(self, decoder: Decoder) -> None:
        """Take over another decoder, of either kind."""
        self.decoder = decoder
        self._reconfigure(decoder=decoder.config)

    def add_memory(self, memory: MemoryConditionConfig) -> None:
        """Let the UNet take a memory too, untrained and without effect yet."""
        self.unet.add_memory(memory)
        self._reconfigure(unet=self.unet.config)

    def _reconfigure(self, **parts: Config) -> None:
        self.config = self.config.model_copy(update=parts)
        self.card = self.card.model_copy(update={"audio_network": self.config})

    # Statistics (ruling 13)

    def set_statistics(self, mean: Tensor, std: Tensor) -> None:
        """Take over the training data's row statistics, [25] each; std above 0."""
        assert bool((std > 0).all()), "a constant row needs a std of 1"
        self.mean.copy_(mean)
        self.std.copy_(std)

    def normalise(self, raw: Tensor) -> Tensor:
        """Window rows [B, 25, T] in raw units -> z-scores."""
        return (raw - self.mean[:, None]) / self.std[:, None]

    def denormalise(self, z: Tensor) -> Tensor:
        """Z-scores [B, 25, T] -> window rows in raw units."""
        return z * self.std[:, None] + self.mean[:, None]

    # Conditions

    def prepare(self, condition: Tensor, memory: MemoryCondition | None = None) -> Prepared:
        """Condition [B, 163 or 167, T], and what is remembered -> what every step shares."""
        return self.unet.prepare(condition, memory=memory)

    def prepare_null(self, batch: int, frames: int) -> Prepared:
        """The learned "no audio", prepared (ruling 14)."""
        return self.unet.prepare(self.unet.null_condition(batch, frames))

    # Denoising and decoding

    def model_fn(
        self,
        condition: Tensor,
        guidance_scale: float | None = None,
        memory: MemoryCondition | None = None,
    ) -> ModelFn:
        """A denoiser `f(x_t, t)` for a sampler, its condition prepared once.

        Args:
            condition: [B, 163 or 167, T].
            guidance_scale: 1 = one forward a step (ruling 14); None = the configuration's.
            memory: what is remembered for it; guidance leads away from "no audio, no memory".
        """
        scale = self.config.guidance_scale if guidance_scale is None else guidance_scale
        null = None if scale == 1 else self.prepare_null(len(condition), condition.shape[-1])
        return guided(self.unet, self.prepare(condition, memory), null, scale)

    def decode(self, z: Tensor, start: Tensor | None = None) -> Decoded:
        """Z-scored rows [B, 25, T] -> trajectory and unwrapped phase; `start`: first phase [B]."""
        return self.decoder.decode(self.denormalise(z).transpose(1, 2), start)

    def forward(
        self,
        x_t: Tensor,
        t: Tensor,
        condition: Prepared | Tensor,
        drop: Tensor | None = None,
        memory: MemoryCondition | None = None,
    ) -> Tensor:
        """One prediction [B, 25, T] of the UNet; see `UNet1D.forward`."""
        result: Tensor = self.unet(x_t, t, condition, drop, memory)
        return result

    # Folders

    def save_pretrained(
        self, folder: str | Path, *, half: bool = False, int8: bool = False
    ) -> None:
        """Write card and weights, as float16 or int8 if asked; raises UserError when that fails."""
        tensors = with_prefix(PREFIX, self.state_dict())
        self.card = write_checkpoint(Path(folder), self.card, tensors, half=half, int8=int8)

    @classmethod
    def from_pretrained(
        cls, name_or_folder: str | Path, *, device: torch.device | str = "cpu"
    ) -> Self:
        """A model by the name of a shipped one, or from a folder, in eval mode.

        Raises:
            UserError: no such model, another kind, or damaged or unfitting weights.
        """
        folder = resolve_model(name_or_folder)
        card = read_card(folder)
        if card.kind != KIND or card.audio_network is None:
            raise wrong_kind(folder, card.kind, KIND)
        model = cls(card.audio_network, card)
        load_state(model, read_tensors(folder, card), PREFIX, folder)
        return model.to(device).eval()


def load_diffusion(name_or_folder: str | Path) -> GaussianDiffusion:
    """The diffusion of a trained model with its UNet inside (REF's `from_pretrained`).

    It lives in z-scores: `AudioMotionModel.denormalise` leads back to metres.
    """
    model = AudioMotionModel.from_pretrained(name_or_folder)
    return GaussianDiffusion(model.config.diffusion, model=model.unet).eval()


def load_decoder(name_or_folder: str | Path) -> Decoder:
    """The decoder of a trained model (TECH 12.2), for raw rows [B, T, 25]."""
    return AudioMotionModel.from_pretrained(name_or_folder).decoder
