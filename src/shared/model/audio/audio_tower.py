"""AudioTower: the sound of a few seconds -> one vector in the space of texts and motions.

Letters: B batch, T frames, D embed dim, C = 163 or 167 rows of a condition (see conditioning.py).
"""

import torch
from torch import Tensor, nn
from torch.nn.functional import normalize, pad

from src.shared.config_space import AudioTowerConfig
from src.shared.model.audio.conditioning import CONDITION_ROWS, FEATURE_ROWS, with_phase_rows
from src.shared.model.layers.temporal_unet import TemporalUNet


class AudioTower(nn.Module):
    """The motion tower's own architecture over z-scored rows of sound.

    Args:
        config: of its sizes.
    """

    mean: Tensor
    std: Tensor

    def __init__(self, config: AudioTowerConfig) -> None:
        super().__init__()
        self.config = config
        self.audio = TemporalUNet(
            CONDITION_ROWS,
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
        features = self.audio_proj(self.audio(rows.transpose(1, 2), mask))  # [B, D]
        return normalize(features.float(), dim=-1)
