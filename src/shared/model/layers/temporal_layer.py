"""TemporalLayer: one pre-norm transformer encoder layer over time (TEXT, DenoiserBlock).

Letters: B batch, T frames, D embed dim, H heads.
"""

from torch import Tensor, nn

from .attention import MultiHeadAttention
from .dropout import ChannelDropout
from .transform_layer import TransformLayer


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
