"""What UNet1D hears of a memory: ContextTransformer, MPMSConditioner, their joins (REF; ruling 26).

The blended context is added to the time embedding, the encoded priors to the audio's FiLM
condition and cross-attention context. Every join starts at zero and is multiplied by the memory's
confidence: without a memory, or with one of confidence 0, the network is what it was before.

Letters: B batch, T frames, R known frames at the start of the window, P patches of frames, W width
of the transformer, E channels of the time embedding, condition or audio context.
"""

import math
from dataclasses import dataclass, replace

import torch
from torch import Tensor, nn
from torch.nn import functional as F

from ...config_audio import MemoryConditionConfig
from ..layers.temporal_layer import TemporalLayer
from .blocks import zeroed
from .conditioning import CONDITION_ROWS, with_phase_rows

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
        return self.out(h.mean(dim=1))

    def _patches(self, rows: Tensor, *, mode: str = "replicate") -> Tensor:
        """[B, C, T] -> [B, P, C * patch]."""
        rows = F.pad(rows, (0, -rows.shape[-1] % self.patch), mode=mode)
        return rows.unflatten(-1, (-1, self.patch)).transpose(1, 2).flatten(2)


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
    """Both of them, and the zero layers through which a network hears them.

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
