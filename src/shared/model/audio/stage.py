"""A stage of UNet1D: ResBlocks of one resolution and perhaps an attention (TECH 3.1).

Letters: B batch, T frames at the stage's resolution, C channels, E channels of the time embedding
or of a condition, L frames of the audio context, H heads, d = C/H.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise

import torch
from torch import Tensor, nn

from ...config_audio import UNetConfig
from ..layers.attention import KeyValue
from .blocks import AttentionBlock, ResBlock
from .conditioning import FiLMLayer


@dataclass(frozen=True)
class StageCondition:
    """What one stage hears of the audio; None where it does not listen that way."""

    film: tuple[Tensor | None, ...]  # for each ResBlock [B, 2C, T]
    keys_values: KeyValue | None  # of the cross-attention, [B, H, L, d] each


class Stage(nn.Module):
    """ResBlocks of one resolution, and one attention after the block `attention_after`.

    Args:
        config: of the whole network.
        widths: channels in, then out of each block.
        factor: downsampling factor here.
        condition_dim: E of the FiLM condition; None = no FiLM.
        attention_after: index of a block; None = no attention.
    """

    def __init__(
        self,
        config: UNetConfig,
        widths: Sequence[int],
        factor: int,
        condition_dim: int | None,
        attention_after: int | None,
    ) -> None:
        super().__init__()
        self.factor = factor
        self.attention_after = attention_after
        self.low: torch.dtype | None = None  # of a sampling copy whose weights are cast here
        self.blocks = nn.ModuleList(
            ResBlock(
                before,
                after,
                config.time_embed_dim,
                condition_dim=condition_dim,
                dropout=config.dropout,
                use_scale_shift_norm=config.use_scale_shift_norm,
            )
            for before, after in pairwise(widths)
        )
        self.attention: AttentionBlock | None = None
        if attention_after is not None:
            channels = widths[attention_after + 1]
            self.attention = AttentionBlock(
                channels,
                config.heads(channels),
                None if config.conditioning == "film" else config.context_dim,
                rotary=config.rotary,
                stride=factor,
            )

    def prepare(self, audio: Tensor | None, context: Tensor | None) -> StageCondition:
        """Audio for FiLM [B, E, T] at this rate, context [B, L, E]; None = not in use."""
        if context is not None and self.low is not None:
            context = context.to(self.low)
        film: list[Tensor | None] = [None] * len(self.blocks)
        if audio is not None:
            layers = [block.film for block in self.blocks]
            film = [layer.gamma_beta(audio) for layer in layers if isinstance(layer, FiLMLayer)]
        keys_values = None
        if context is not None and self.attention is not None:
            keys_values = self.attention.keys_values(context)
        return StageCondition(tuple(film), keys_values)

    def forward(self, h: Tensor, time_emb: Tensor, condition: StageCondition) -> Tensor:
        """h [B, C, T], time [B, E] -> [B, C', T]."""
        if self.low is not None:
            h, time_emb = h.to(self.low), time_emb.to(self.low)
        for index, block in enumerate(self.blocks):
            h = block(h, time_emb, condition.film[index])
            if index == self.attention_after and self.attention is not None:
                h = self.attention(h, condition.keys_values)
        return h if self.low is None else h.float()
