"""SharedSpace: sounds, motions and texts as unit vectors that can be compared (MPMS's keys).

The motion tower is that of a ClipBundle, frozen; the audio tower learned to agree with it; the
text tower is the one a text generator ships with. Motion and sound were never recorded together,
so what sound and motion share is tempo and energy.

Letters: B batch, T frames, D embed dim, K rows (22 joints, root track), C = 163 or 167 rows of a
condition (see conditioning.py), R rows that say how fast the beat is.
"""

import math
from collections.abc import Sequence
from pathlib import Path
from typing import Self

import torch
from torch import Tensor, nn
from torch.nn.functional import normalize, pad

from ...config_audio import AudioTowerConfig
from ...config_schema import NetworkConfig
from ...errors import UserError
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
from ..clip.core import TextTower
from ..clip.pretrained import ClipBundle, encode_captions, tower_hash
from ..clip.tokenizer import PromptTokenizer
from ..layers import TemporalUNet
from . import BEAT, CONDITION_ROWS, FEATURE_ROWS, with_phase_rows

HARMONICS = (1, 2)  # of the octave that a beat's rate lies in
RATE_ROWS = 1 + 2 * len(HARMONICS)
MIDDLE_RATE = 2 * math.pi * 2 / 30  # radians a frame: 120 beats a minute


def rate_rows(beat: Tensor) -> Tensor:
    """How fast the beat phase turns, so that a small tower need not find out.

    Backward differences, so that padding at the end changes nothing.

    Args:
        beat: cosine and sine [B, 2, T] of the beat phase, zeros where it is unknown.

    Returns:
        [B, R, T]: octaves above 120 beats a minute, then sine and cosine of their multiples;
        zeros where the phase is unknown.
    """
    cosine, sine = beat.float().unbind(dim=1)  # [B, T] each
    across = cosine[:, :-1] * sine[:, 1:] - sine[:, :-1] * cosine[:, 1:]
    along = cosine[:, :-1] * cosine[:, 1:] + sine[:, :-1] * sine[:, 1:]
    rate = torch.atan2(across, along)  # [B, T-1] radians a frame
    rate = torch.cat((rate[:, :1], rate), dim=1) if rate.shape[1] else torch.zeros_like(cosine)
    known = rate > 1e-3
    octave = torch.log2(torch.where(known, rate, MIDDLE_RATE) / MIDDLE_RATE)  # [B, T]
    turns = [2 * math.pi * k * octave for k in HARMONICS]
    rows = [octave, *(part for turn in turns for part in (turn.sin(), turn.cos()))]
    return torch.stack(rows, dim=1) * known[:, None]


class AudioTower(nn.Module):
    """The motion tower's own architecture over z-scored rows of sound and the rate of the beat.

    Args:
        config: of its sizes.
    """

    mean: Tensor
    std: Tensor

    def __init__(self, config: AudioTowerConfig) -> None:
        super().__init__()
        self.config = config
        self.audio = TemporalUNet(
            CONDITION_ROWS + RATE_ROWS,
            config.dim,
            num_heads=config.num_heads,
            num_layers=config.num_layers,
            dropout=config.dropout,
        )
        self.audio_proj = nn.Linear(config.dim, config.embed_dim)
        self.register_buffer("mean", torch.zeros(FEATURE_ROWS))
        self.register_buffer("std", torch.ones(FEATURE_ROWS))

    def set_statistics(self, mean: Tensor, std: Tensor) -> None:
        """Take over the training songs' row statistics, [163] each; std above 0."""
        assert bool((std > 0).all()), "a constant row needs a std of 1"
        self.mean.copy_(mean)
        self.std.copy_(std)

    def standardise(self, condition: Tensor) -> Tensor:
        """Condition [B, C, T] -> [B, 167, T]: features z-scored, phases as they are."""
        condition = with_phase_rows(condition)
        phases = CONDITION_ROWS - FEATURE_ROWS
        mean, std = pad(self.mean, (0, phases)), pad(self.std, (0, phases), value=1.0)
        return (condition - mean[:, None]) / std[:, None]

    def forward(self, condition: Tensor, mask: Tensor | None = None) -> Tensor:
        """Condition [B, C, T], mask [B, T] bool (True = real) or None -> [B, D] unit-norm.

        Raises:
            ValueError: another number of rows.
        """
        return self.embed(self.standardise(condition), mask)

    def embed(self, rows: Tensor, mask: Tensor | None = None) -> Tensor:
        """As `forward`, of rows [B, 167, T] that are standardised already."""
        rows = torch.cat((rows, rate_rows(rows[:, BEAT][:, :2])), dim=1)  # [B, 167 + R, T]
        features = self.audio_proj(self.audio(rows.transpose(1, 2), mask))  # [B, D]
        return normalize(features.float(), dim=-1)


# ---------------------------------------------------------------- the shared space

KIND = "shared-space"
PREFIX = "space"


class MotionTower(nn.Module):
    """The motion half of MotionClip with its statistics; same names of weights, fixed for good.

    Args:
        network: whose `clip` section shapes the tower.
    """

    mean: Tensor
    std: Tensor

    def __init__(self, network: NetworkConfig) -> None:
        super().__init__()
        rows, channels = network.motion_rows, network.generation.motion_channels
        self.motion = TemporalUNet(
            rows * channels,
            network.embed_dim,
            num_heads=network.clip.motion_num_heads,
            num_layers=network.clip.motion_num_layers,
        )
        self.motion_proj = nn.Linear(network.embed_dim, network.embed_dim)
        self.register_buffer("mean", torch.zeros(rows, channels))
        self.register_buffer("std", torch.ones(rows, channels))
        self.requires_grad_(False).eval()

    @classmethod
    def of(cls, bundle: ClipBundle) -> Self:
        """A copy of a CLIP model's motion tower."""
        tower = cls(bundle.clip.config)
        tower.motion.load_state_dict(bundle.clip.motion.state_dict())
        tower.motion_proj.load_state_dict(bundle.clip.motion_proj.state_dict())
        tower.mean.copy_(bundle.mean)
        tower.std.copy_(bundle.std)
        return tower

    def train(self, mode: bool = True) -> Self:
        """Never in training mode: it is fixed."""
        return super().train(False)

    def forward(self, features: Tensor, mask: Tensor | None = None) -> Tensor:
        """Raw features [B, T, 23, 6], mask [B, T] bool or None -> [B, D] unit-norm."""
        z = (features[:, :, : len(self.mean)] - self.mean) / self.std
        return normalize(self.motion_proj(self.motion(z, mask)).float(), dim=-1)


class SharedSpace(nn.Module):
    """Motion tower and audio tower in one module and one folder.

    Args:
        network: of the motion tower.
        config: of the audio tower.
        card: name, licence, training summary; `kind` and the two configurations are filled in.

    Raises:
        UserError: the two towers differ in their embed dim.
    """

    def __init__(
        self, network: NetworkConfig, config: AudioTowerConfig, card: ModelCard | None = None
    ) -> None:
        super().__init__()
        if network.embed_dim != config.embed_dim:
            raise UserError(
                f"embed-dim mismatch: the motion tower has {network.embed_dim}, the audio tower"
                f" {config.embed_dim}; set the audio tower's to {network.embed_dim}"
            )
        card = card or ModelCard(kind=KIND)
        update = {"kind": KIND, "network": network, "audio_tower": config}
        self.card = card.model_copy(update=update)
        self.config, self.embed_dim = config, config.embed_dim
        self.motion = MotionTower(network)
        self.audio = AudioTower(config)

    @classmethod
    def beside(cls, bundle: ClipBundle, config: AudioTowerConfig) -> Self:
        """An untrained audio tower beside a CLIP model's motion tower, of that one's width."""
        network = bundle.clip.config
        card = ModelCard(kind=KIND, text_tower=tower_hash(bundle.clip.text))
        space = cls(network, config.model_copy(update={"embed_dim": network.embed_dim}), card)
        space.motion = MotionTower.of(bundle)
        return space

    @property
    def fingerprint(self) -> str:
        """SHA-256 of the weights it was read from or saved as; "" for one that never was."""
        return self.card.content_hash

    def embed_audio(self, condition: Tensor, mask: Tensor | None = None) -> Tensor:
        """Condition [B, 163 or 167, T], mask [B, T] bool or None -> [B, D] unit-norm."""
        embedded: Tensor = self.audio(condition, mask)
        return embedded

    def embed_motion(self, features: Tensor, mask: Tensor | None = None) -> Tensor:
        """Raw features [B, T, 23, 6] (motion/features.py), mask or None -> [B, D] unit-norm."""
        embedded: Tensor = self.motion(features, mask)
        return embedded

    def embed_text(
        self, captions: Sequence[str], tower: TextTower, tokenizer: PromptTokenizer
    ) -> Tensor:
        """Captions through a generator's text tower -> [N, D] unit-norm, on the CPU.

        Raises:
            UserError: it is another text tower than the motion tower learned with.
        """
        if tower_hash(tower) != self.card.text_tower:
            raise UserError(
                f"{self.card.name or 'this shared space'} and the text tower were not trained"
                " together, so their vectors cannot be compared; use the text generator whose CLIP"
                " model the space was trained from"
            )
        return encode_captions(tower, tokenizer, list(captions))

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
        """A space by the name of a shipped one, or from a folder, in eval mode.

        Raises:
            UserError: no such model, another kind, or damaged or unfitting weights.
        """
        folder = resolve_model(name_or_folder)
        card = read_card(folder)
        if card.kind != KIND or card.audio_tower is None:
            raise wrong_kind(folder, card.kind, KIND)
        space = cls(card.network, card.audio_tower, card)
        load_state(space, read_tensors(folder, card), PREFIX, folder)
        return space.to(device).eval()
