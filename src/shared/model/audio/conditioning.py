"""From sound features to conditions: AudioConditioner, FiLMLayer, augmentation (REF, ruling 2).

Letters: B batch, T frames, C channels of a feature map, E channels of the condition.

Rows of a condition [B, 163, T]: mel 0:128, chroma 128:140, mfcc 140:160, rms, spectral centroid,
onset strength. Four more make [B, 167, T]: cosine and sine of the beat phase, then of the bar
phase, zero where no beat is known.
"""

import torch
from torch import Tensor, nn
from torch.nn import functional as F

from ...config_audio import AudioConditionConfig, AugmentationConfig

MEL, CHROMA, MFCC = slice(0, 128), slice(128, 140), slice(140, 160)
ENERGY, BEAT = slice(160, 163), slice(163, 167)
GROUPS = {"mel": MEL, "chroma": CHROMA, "mfcc": MFCC, "energy": ENERGY, "beat": BEAT}
FEATURE_ROWS, CONDITION_ROWS = 163, 167


def width(rows: slice) -> int:
    """Number of rows of a feature group."""
    return int(rows.stop - rows.start)


def with_phase_rows(condition: Tensor) -> Tensor:
    """[B, 163 or 167, T] -> [B, 167, T]; phases left out are unknown, which is zero.

    Raises:
        ValueError: another number of rows.
    """
    rows = condition.shape[1]
    if rows not in (FEATURE_ROWS, CONDITION_ROWS):
        raise ValueError(
            f"an audio condition has {FEATURE_ROWS} or {CONDITION_ROWS} rows, not {rows}"
        )
    return F.pad(condition, (0, 0, 0, CONDITION_ROWS - rows))


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
        return self.combine(F.silu(torch.cat(parts, dim=1)))  # [B, E, T]


class FiLMLayer(nn.Module):
    """Per-frame feature-wise modulation (Perez et al. 2018, eq. 1); starts as the identity.

    gamma and beta depend on the condition alone: `gamma_beta` may run once a sample and
    `modulate` once a step.
    """

    def __init__(self, channels: int, condition_dim: int) -> None:
        super().__init__()
        self.mlp = nn.Sequential(nn.SiLU(), nn.Conv1d(condition_dim, 2 * channels, 1))
        final = self.mlp[1]
        assert isinstance(final, nn.Conv1d) and final.bias is not None
        nn.init.zeros_(final.weight)
        nn.init.zeros_(final.bias)

    def gamma_beta(self, condition: Tensor) -> Tensor:
        """Condition [B, E, T] -> both modulations [B, 2C, T]."""
        return self.mlp(condition)

    @staticmethod
    def modulate(h: Tensor, gamma_beta: Tensor) -> Tensor:
        """h [B, C, T], modulations [B, 2C, T] -> [B, C, T]; gamma counts from 1."""
        gamma, beta = gamma_beta.chunk(2, dim=1)
        return torch.addcmul(h + beta, h, gamma)

    def forward(self, h: Tensor, condition: Tensor) -> Tensor:
        """h [B, C, T], condition [B, E, T] -> [B, C, T] (REF's signature)."""
        return self.modulate(h, self.gamma_beta(condition))


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
