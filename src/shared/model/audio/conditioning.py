"""What UNet1D is conditioned on: sound features, and phrases of a memory (REF, rulings 2, 26).

Of a memory the blended context is added to the time embedding, the encoded priors to the audio's
FiLM condition and cross-attention context. Every join starts at zero and is multiplied by the
memory's confidence: without a memory, or with one of confidence 0, the network is what it was.

Letters: B batch, T frames, C channels of a feature map, E channels of the time embedding,
condition or audio context, R known frames at the start of the window, P patches of frames, W width
of the transformer.
"""

import math
from dataclasses import dataclass, replace

import torch
from einops import rearrange
from torch import Tensor, nn
from torch.nn import functional as F

from ...config_audio import AudioConditionConfig, AugmentationConfig, MemoryConditionConfig
from ..layers import TemporalLayer, zeroed
from . import (
    BEAT,
    CHROMA,
    CONDITION_ROWS,
    ENERGY,
    FEATURE_ROWS,
    GROUPS,
    MEL,
    MFCC,
    width,
    with_phase_rows,
)


class AudioConditioner(nn.Module):
    """One projection for each feature group, joined by a convolution (REF).

    REF forgets rms, centroid and onset (ruling 2); the beat projection is ours.
    """

    def __init__(self, config: AudioConditionConfig) -> None:
        super().__init__()
        dim = config.dim
        self.mel_proj = nn.Conv1d(width(MEL), dim // 2, 1)
        self.mfcc_proj = nn.Conv1d(width(MFCC), dim // 4, 1)
        self.chroma_proj = nn.Conv1d(width(CHROMA), dim // 4, 1)
        self.energy_proj = nn.Conv1d(width(ENERGY), dim // 4, 1)
        self.beat_proj = nn.Conv1d(width(BEAT), dim // 4, 1)
        self.combine = nn.Conv1d(dim // 2 + 4 * (dim // 4), dim, 3, padding=1)

    def forward(self, condition: Tensor) -> Tensor:
        """Condition [B, 163 or 167, T] -> [B, E, T]."""
        condition = with_phase_rows(condition)
        parts = [
            self.mel_proj(condition[:, MEL]),  # [B, E/2, T]
            self.mfcc_proj(condition[:, MFCC]),  # [B, E/4, T], as the next three
            self.chroma_proj(condition[:, CHROMA]),
            self.energy_proj(condition[:, ENERGY]),
            self.beat_proj(condition[:, BEAT]),
        ]
        result: Tensor = self.combine(F.silu(torch.cat(parts, dim=1)))  # [B, E, T]
        return result


class ConditionAugmentation(nn.Module):
    """Noise and feature-group dropout, in training mode only (TECH's roadmap)."""

    def __init__(self, config: AugmentationConfig) -> None:
        super().__init__()
        self.config = config

    def forward(self, condition: Tensor, generator: torch.Generator | None = None) -> Tensor:
        """[B, 163 or 167, T] -> [B, 167, T]; random numbers are drawn on the CPU."""
        condition = with_phase_rows(condition)
        if not self.training:
            return condition
        config, batch = self.config, len(condition)
        if config.noise > 0:
            shape = (batch, FEATURE_ROWS, condition.shape[2])
            noise = torch.randn(shape, generator=generator).to(condition)
            noisy = condition[:, :FEATURE_ROWS] + config.noise * noise
            condition = torch.cat((noisy, condition[:, FEATURE_ROWS:]), dim=1)
        if config.group_dropout > 0:
            draws = torch.rand(batch, len(GROUPS), generator=generator)
            kept = (draws >= config.group_dropout).to(condition)
            sizes = torch.tensor([width(rows) for rows in GROUPS.values()], device=kept.device)
            condition = condition * kept.repeat_interleave(sizes, dim=1)[:, :, None]
        return condition

    def draw_drop(self, batch: int, generator: torch.Generator | None = None) -> Tensor | None:
        """Which samples lose their whole condition, [B] bool on the CPU; None: no sample."""
        if not self.training or self.config.condition_dropout == 0:
            return None
        return torch.rand(batch, generator=generator) < self.config.condition_dropout


# ---------------------------------------------------------------- memory

PRIORS = 4  # energy, density, tension, stability
MOTION_ROWS = 25


@dataclass(frozen=True, eq=False)
class MemoryCondition:
    """What a memory answered for a batch of windows.

    Attributes:
        context: [B, 256], of the retrieved motions.
        priors: [B, 4, T] in [0, 1]: energy, density, tension, stability.
        confidence: [B] in [0, 1]; 0 = nothing is remembered.
        recent: [B, 25, R] z-scores of the window's known first frames, R <= T, zeros where a
            frame is not known; None = no frame is.
    """

    context: Tensor
    priors: Tensor
    confidence: Tensor
    recent: Tensor | None = None

    def to(self, device: torch.device) -> "MemoryCondition":
        """The same on a device."""
        moved = {name: value.to(device) for name, value in vars(self).items() if value is not None}
        return replace(self, **moved)

    def after(self, recent: Tensor) -> "MemoryCondition":
        """The same for every row of known frames [B, 25, R]; its own batch is B or 1."""
        batch = len(recent)
        return replace(
            self,
            context=self.context.expand(batch, -1),
            priors=self.priors.expand(batch, -1, -1),
            confidence=self.confidence.expand(batch),
            recent=recent,
        )

    def without(self, drop: Tensor) -> "MemoryCondition":
        """Forgotten where drop [B] is True."""
        return replace(
            self, confidence=self.confidence.masked_fill(drop.to(self.confidence.device), 0)
        )


def known_frames(z: Tensor, known: Tensor) -> Tensor:
    """Z-scores [B, 25, T] where a whole frame is known, else 0; known [B, 25, T] bool."""
    return z * known.all(dim=1, keepdim=True)


@dataclass(frozen=True)
class Remembered:
    """What is added to the time embedding [B, E], to FiLM's condition [B, E, T] and to the audio
    context [B, T, E]; None = nothing is."""

    time: Tensor | None
    film: Tensor | None
    context: Tensor | None


class ContextTransformer(nn.Module):
    """A window's sound and the motion that leads into it, as one vector (REF names it only).

    Both are cut into patches of frames; those of the motion are added to those of the sound, where
    frames are known. Transformer layers with rotary positions, mean over time, a linear layer.
    """

    def __init__(self, config: MemoryConditionConfig) -> None:
        super().__init__()
        self.patch = config.patch
        self.sound = nn.Linear(CONDITION_ROWS * config.patch, config.width)
        self.motion = nn.Linear(MOTION_ROWS * config.patch, config.width, bias=False)  # zeros: none
        self.layers = nn.ModuleList(
            TemporalLayer(config.width, config.num_heads, dropout=config.dropout, rotary=True)
            for _ in range(config.num_layers)
        )
        self.out = nn.Sequential(
            nn.LayerNorm(config.width), nn.Linear(config.width, config.context_dim)
        )

    def forward(self, condition: Tensor, recent: Tensor | None = None) -> Tensor:
        """Condition [B, 163 or 167, T], known frames [B, 25, R] -> [B, 256]."""
        h = self.sound(self._patches(with_phase_rows(condition)))  # [B, P, W]
        if recent is not None:
            recent = F.pad(recent, (0, condition.shape[-1] - recent.shape[-1]))
            h = h + self.motion(self._patches(recent, mode="constant"))
        for layer in self.layers:
            h = layer(h)
        result: Tensor = self.out(h.mean(dim=1))
        return result

    def _patches(self, rows: Tensor, *, mode: str = "replicate") -> Tensor:
        """[B, C, T] -> [B, P, C * patch]."""
        rows = F.pad(rows, (0, -rows.shape[-1] % self.patch), mode=mode)
        return rearrange(rows, "b c (p n) -> b p (c n)", n=self.patch)


class MPMSConditioner(nn.Module):
    """Blends the transformer's context with the retrieved one, and encodes prior curves (REF)."""

    def __init__(self, config: MemoryConditionConfig) -> None:
        super().__init__()
        dim, priors = config.context_dim, config.prior_dim
        self.blend_gate = nn.Sequential(
            nn.Linear(2 * dim, dim), nn.SiLU(), nn.Linear(dim, dim), nn.Sigmoid()
        )
        self.prior_encoder = nn.Sequential(
            nn.Conv1d(PRIORS, priors, 5, padding=2), nn.SiLU(), nn.Conv1d(priors, priors, 1)
        )

    def forward(
        self, transformer_context: Tensor, mpms_context: Tensor, prior_curves: Tensor
    ) -> tuple[Tensor, Tensor]:
        """[B, 256], [B, 256], [B, 4, T] -> blended context [B, 256], encoded priors [B, 64, T]."""
        alpha = self.blend_gate(torch.cat((transformer_context, mpms_context), dim=-1))
        blended = alpha * transformer_context + (1 - alpha) * mpms_context
        return blended, self.prior_encoder(2 * prior_curves - 1)


class MemoryJoin(nn.Module):
    """Both of them, and the zero layers that join them to a network.

    Args:
        config: sizes.
        time_dim: E of the time embedding.
        film_dim: E of FiLM's condition; None = no FiLM.
        audio_dim: E of the audio context; None = no cross-attention.
    """

    def __init__(
        self,
        config: MemoryConditionConfig,
        time_dim: int,
        film_dim: int | None,
        audio_dim: int | None,
    ) -> None:
        super().__init__()
        self.transformer = ContextTransformer(config)
        self.conditioner = MPMSConditioner(config)
        # what is retrieved is a mean of unit vectors: entries of about 1 after this
        self.context_scale = math.sqrt(config.context_dim)
        self.to_time = zeroed(nn.Linear(config.context_dim, time_dim))
        priors = config.prior_dim
        self.to_film = None if film_dim is None else zeroed(nn.Linear(priors, film_dim))
        self.to_context = None if audio_dim is None else zeroed(nn.Linear(priors, audio_dim))

    def forward(self, condition: Tensor, memory: MemoryCondition) -> Remembered:
        """Of a condition [B, 167, T]; priors of the same T.

        Raises:
            ValueError: the memory is of another length or batch.
        """
        wanted = (len(condition), PRIORS, condition.shape[-1])
        if memory.priors.shape != wanted:
            raise ValueError(f"prior curves {list(memory.priors.shape)} are not {list(wanted)}")
        blended, priors = self.conditioner(
            self.transformer(condition, memory.recent),
            self.context_scale * memory.context,
            memory.priors,
        )
        priors, sure = priors.transpose(1, 2), memory.confidence[:, None]  # [B, T, 64], [B, 1]
        film = None if self.to_film is None else sure[..., None] * self.to_film(priors)
        return Remembered(
            time=sure * self.to_time(blended),
            film=None if film is None else film.transpose(1, 2),
            context=None if self.to_context is None else sure[..., None] * self.to_context(priors),
        )
