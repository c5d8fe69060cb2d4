"""AudioTower: the sound of a few seconds -> one vector in the space of texts and motions.

Letters: B batch, T frames, D embed dim, C = 163 or 167 rows of a condition (see conditioning.py),
R rows that say how fast the beat is.
"""

import math

import torch
from torch import Tensor, nn
from torch.nn.functional import normalize, pad

from ...config_audio import AudioTowerConfig
from ..layers.temporal_unet import TemporalUNet
from .conditioning import (
    BEAT,
    CONDITION_ROWS,
    FEATURE_ROWS,
    with_phase_rows,
)

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
