"""Feature-wise affine modulation (Perez et al. 2018, FiLM, equation 1).

Letters: B batch, T frames, D embed dim, E condition channels.
"""

from torch import Tensor, nn


class FiLM(nn.Module):
    """x * (1 + scale) + shift, both read off the condition; starts as the identity."""

    def __init__(self, dim: int, condition_dim: int) -> None:
        super().__init__()
        self.modulation = nn.Linear(condition_dim, 2 * dim)
        nn.init.zeros_(self.modulation.weight)
        nn.init.zeros_(self.modulation.bias)

    def forward(self, x: Tensor, condition: Tensor) -> Tensor:
        """x [B, T, D], condition [B, E] -> [B, T, D]."""
        scale, shift = self.modulation(condition)[:, None].chunk(2, dim=-1)  # [B, 1, D] each
        return x * (1 + scale) + shift
