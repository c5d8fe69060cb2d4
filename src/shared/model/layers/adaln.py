"""Adaptive layer norm (Peebles and Xie 2023, DiT, section 3.2).

Letters: B batch, T frames, D embed dim, E condition channels.
"""

from torch import Tensor, nn

from .film import FiLM


class AdaLN(nn.Module):
    """Layer norm whose scale and shift come from the condition; starts as a plain layer norm."""

    def __init__(self, dim: int, condition_dim: int) -> None:
        super().__init__()
        self.norm = nn.LayerNorm(dim, elementwise_affine=False)
        self.film = FiLM(dim, condition_dim)

    def forward(self, x: Tensor, condition: Tensor) -> Tensor:
        """x [B, T, D], condition [B, E] -> [B, T, D]."""
        return self.film(self.norm(x), condition)
