"""The pre-norm transformer layer over time, its feed-forward part and its dropout (TEXT).

Letters: B batch, T frames, D embed dim, H heads.
"""

import torch
from torch import Tensor, nn

from .attention import MultiHeadAttention


class ChannelDropout(nn.Module):
    """Drops the same channels in all frames of a sample: one random number a channel.

    Gal and Ghahramani 2016, variational dropout. Drawing one for every value costs a tenth of a
    training step on the CPU.
    """

    def __init__(self, p: float) -> None:
        super().__init__()
        self.p = p

    def forward(self, x: Tensor) -> Tensor:
        """x [B, T, D] -> the same shape; the identity in eval mode and for p = 0."""
        if not self.training or self.p == 0:
            return x
        keep = torch.rand(x.shape[0], 1, x.shape[2], device=x.device) >= self.p  # [B, 1, D]
        return x * (keep / (1 - self.p)).to(x.dtype)


class TransformLayer(nn.Module):
    """Two linear maps around a GELU; adds its input when the two widths match."""

    def __init__(
        self, dim: int, out_dim: int | None = None, *, expansion: int = 4, dropout: float = 0.0
    ) -> None:
        super().__init__()
        out_dim = dim if out_dim is None else out_dim
        self.residual = out_dim == dim
        self.expand = nn.Linear(dim, expansion * dim)
        self.activation = nn.GELU()
        self.contract = nn.Linear(expansion * dim, out_dim)
        self.dropout = ChannelDropout(dropout)

    def forward(self, x: Tensor) -> Tensor:
        """x [B, T, D] -> [B, T, out_dim]."""
        hidden = self.activation(self.expand(x))  # [B, T, 4D]
        y: Tensor = self.dropout(self.contract(hidden))  # [B, T, out_dim]
        return x + y if self.residual else y


class TemporalLayer(nn.Module):
    """Self-attention and a feed-forward network, each behind a layer norm with a residual."""

    def __init__(
        self,
        dim: int,
        num_heads: int,
        *,
        expansion: int = 4,
        dropout: float = 0.0,
        rotary: bool = False,
    ) -> None:
        super().__init__()
        self.attention_norm = nn.LayerNorm(dim)
        self.attention = MultiHeadAttention(dim, num_heads, rotary=rotary)
        self.dropout = ChannelDropout(dropout)
        self.feed_forward_norm = nn.LayerNorm(dim)
        self.feed_forward = TransformLayer(dim, expansion=expansion, dropout=dropout)
        self.feed_forward.residual = False  # the residual goes around the norm

    def forward(self, x: Tensor, mask: Tensor | None = None) -> Tensor:
        """x [B, T, D], mask [B, T] bool (True = real) or None -> [B, T, D]."""
        x = x + self.dropout(self.attention(self.attention_norm(x), mask))  # [B, T, D]
        return x + self.feed_forward(self.feed_forward_norm(x))
