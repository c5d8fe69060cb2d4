"""What UNet1D is built of: ResBlock, AttentionBlock, Downsample, Upsample, Stage (TECH 3.1).

Letters: B batch, C channels, T frames at the block's resolution, L frames of the audio context,
E channels of the time embedding or of a condition, H heads, d = C/H.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise

import torch
from torch import Tensor, nn
from torch.nn import functional as F

from ...config_audio import NORM_GROUPS, UNetConfig
from ..layers.attention import KeyValue, RotaryEmbedding, attend
from .conditioning import FiLMLayer, zeroed


class ResBlock(nn.Module):
    """Two convolutions around the time embedding and the per-frame FiLM.

    Args:
        channels: of the input.
        out_channels: of the output.
        time_embed_dim: E of the time embedding.
        condition_dim: E of the FiLM condition; None = no FiLM.
        use_scale_shift_norm: TECH's way to use the time; otherwise it is added (REF).
    """

    def __init__(
        self,
        channels: int,
        out_channels: int,
        time_embed_dim: int,
        *,
        condition_dim: int | None = None,
        dropout: float = 0.1,
        use_scale_shift_norm: bool = True,
    ) -> None:
        super().__init__()
        self.use_scale_shift_norm = use_scale_shift_norm
        self.norm1 = nn.GroupNorm(NORM_GROUPS, channels)
        self.conv1 = nn.Conv1d(channels, out_channels, 3, padding=1)
        time_dim = out_channels * (2 if use_scale_shift_norm else 1)
        self.time_mlp = nn.Sequential(nn.SiLU(), nn.Linear(time_embed_dim, time_dim))
        self.norm2 = nn.GroupNorm(NORM_GROUPS, out_channels)
        self.film = None if condition_dim is None else FiLMLayer(out_channels, condition_dim)
        self.dropout = nn.Dropout(dropout)
        self.conv2 = zeroed(nn.Conv1d(out_channels, out_channels, 3, padding=1))
        same = channels == out_channels
        self.skip_conv = nn.Identity() if same else nn.Conv1d(channels, out_channels, 1)

    def forward(self, x: Tensor, time_emb: Tensor, gamma_beta: Tensor | None = None) -> Tensor:
        """x [B, C, T], time [B, E], modulations of `film` [B, 2C', T] -> [B, C', T]."""
        h = self.conv1(F.silu(self.norm1(x)))  # [B, C', T]
        time_out = self.time_mlp(time_emb)[:, :, None]  # [B, 2C' or C', 1]
        if self.use_scale_shift_norm:
            scale, shift = time_out.chunk(2, dim=1)
            h = self.norm2(h) * (1 + scale) + shift
        else:
            h = self.norm2(h + time_out)
        if gamma_beta is not None:
            h = FiLMLayer.modulate(h, gamma_beta)
        h = self.conv2(self.dropout(F.silu(h)))  # [B, C', T]
        return h + self.skip_conv(x)


class FrameRotary(RotaryEmbedding):
    """Rotary positions counted in frames of the full rate: piece i lies in the middle of its own.

    So a query of any level and a key of the audio context turn by their distance in time.
    """

    def __init__(self, head_dim: int, stride: int = 1) -> None:
        super().__init__(head_dim)
        self.stride = stride

    def _tables(self, length: int, device: torch.device) -> tuple[Tensor, Tensor]:
        cos, sin = super()._tables(length * self.stride, device)
        middle = self.stride // 2
        return cos[middle :: self.stride], sin[middle :: self.stride]


class AttentionBlock(nn.Module):
    """Self-attention, then cross-attention to the audio context, which keeps its own length.

    Args:
        channels: of the feature map.
        num_heads: must divide them.
        context_dim: channels of the context; None = no cross-attention.
        rotary: turn queries and keys by their frame (ours); TECH has no positions.
        stride: frames of the full rate behind one piece here.
    """

    def __init__(
        self,
        channels: int,
        num_heads: int = 8,
        context_dim: int | None = None,
        *,
        rotary: bool = True,
        stride: int = 1,
    ) -> None:
        super().__init__()
        self.num_heads = num_heads
        head_dim = channels // num_heads
        self.rotary = FrameRotary(head_dim, stride) if rotary else None
        self.norm = nn.GroupNorm(NORM_GROUPS, channels)
        self.qkv = nn.Linear(channels, 3 * channels)
        self.proj = zeroed(nn.Linear(channels, channels))
        self.has_context = context_dim is not None
        if context_dim is not None:
            self.context_rotary = FrameRotary(head_dim) if rotary else None
            self.cross_norm = nn.GroupNorm(NORM_GROUPS, channels)
            self.q_cross = nn.Linear(channels, channels)
            self.kv_cross = nn.Linear(context_dim, 2 * channels)
            self.proj_cross = zeroed(nn.Linear(channels, channels))

    def keys_values(self, context: Tensor) -> KeyValue:
        """Context [B, L, E] -> keys and values [B, H, L, d], computed once a sample (ruling 3)."""
        key, value = self._heads(self.kv_cross(context)).chunk(2, dim=2)  # [B, L, H, d]
        if self.context_rotary is not None:
            key = self.context_rotary(key)
        return key.transpose(1, 2), value.transpose(1, 2)

    def forward(self, x: Tensor, keys_values: KeyValue | None = None) -> Tensor:
        """x [B, C, T] -> [B, C, T]."""
        query, key, value = self._heads(self.qkv(_rows(self.norm(x)))).chunk(3, dim=2)
        if self.rotary is not None:
            query, key = self.rotary(query), self.rotary(key)
        out = attend(query.transpose(1, 2), key.transpose(1, 2), value.transpose(1, 2), None)
        x = x + self.proj(_join(out)).transpose(1, 2)  # [B, C, T]
        if keys_values is None:
            return x
        query = self._heads(self.q_cross(_rows(self.cross_norm(x))))  # [B, T, H, d]
        if self.rotary is not None:
            query = self.rotary(query)
        out = attend(query.transpose(1, 2), *keys_values, None)  # [B, H, T, d]
        return x + self.proj_cross(_join(out)).transpose(1, 2)

    def _heads(self, rows: Tensor) -> Tensor:
        """[B, T, n*C] -> [B, T, n*H, d]."""
        head_dim = self.qkv.in_features // self.num_heads
        return rows.unflatten(-1, (-1, head_dim))


def _rows(x: Tensor) -> Tensor:
    """[B, C, T] -> [B, T, C], laid out anew: a transposed view takes a slow matrix product."""
    return x.transpose(1, 2).contiguous()


def _join(heads: Tensor) -> Tensor:
    """[B, H, T, d] -> [B, T, C]."""
    return heads.transpose(1, 2).flatten(2)


class Downsample(nn.Module):
    """Half as many frames, by a convolution of stride 2."""

    def __init__(self, channels: int) -> None:
        super().__init__()
        self.conv = nn.Conv1d(channels, channels, 3, stride=2, padding=1)

    def forward(self, x: Tensor) -> Tensor:
        """[B, C, T] -> [B, C, T/2]."""
        return self.conv(x)


class Upsample(nn.Module):
    """Twice as many frames: each one repeated, then a convolution."""

    def __init__(self, channels: int) -> None:
        super().__init__()
        self.conv = nn.Conv1d(channels, channels, 3, padding=1)

    def forward(self, x: Tensor) -> Tensor:
        """[B, C, T] -> [B, C, 2T]."""
        return self.conv(x.repeat_interleave(2, dim=-1))


# ---------------------------------------------------------------- stages


@dataclass(frozen=True)
class StageCondition:
    """The audio condition of one stage; None where it has no such layers."""

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
