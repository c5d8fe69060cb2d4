"""TransformLayer: the feed-forward network D -> 4D -> D (TEXT, DenoiserBlock).

Letters: B batch, T frames, D embed dim.
"""

from torch import Tensor, nn

from .dropout import ChannelDropout


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
