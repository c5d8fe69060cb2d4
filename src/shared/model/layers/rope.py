"""Rotary positions (Su et al. 2021, RoFormer, equation 34), with cached float32 tables.

Letters: B batch, T positions, H heads, d channels of one head.
"""

import torch
from torch import Tensor, nn


class RotaryEmbedding(nn.Module):
    """Turns channel pairs (i, i + d/2) of a head by an angle that grows with the position."""

    def __init__(self, head_dim: int, *, base: float = 10_000.0) -> None:
        super().__init__()
        assert head_dim % 2 == 0, f"head dim {head_dim} must be even"
        exponents = torch.arange(0, head_dim, 2, dtype=torch.float32) / head_dim
        self.frequencies: Tensor
        self.register_buffer("frequencies", base**-exponents, persistent=False)  # [d/2]
        self._cos: Tensor | None = None
        self._sin: Tensor | None = None

    def forward(self, heads: Tensor) -> Tensor:
        """[..., T, H, d] -> the same, rotated, in its own dtype; angles are float32 always."""
        tables = self._tables(heads.shape[-3], heads.device)  # [T, 1, d/2] each
        cos, sin = (table.to(heads.dtype) for table in tables)
        first, second = heads.chunk(2, dim=-1)
        return torch.cat([first * cos - second * sin, second * cos + first * sin], dim=-1)

    def _tables(self, length: int, device: torch.device) -> tuple[Tensor, Tensor]:
        if self._cos is None or len(self._cos) < length or self._cos.device != device:
            # Made outside inference mode: training may reuse a table that sampling made first.
            with torch.inference_mode(False), torch.no_grad():
                positions = torch.arange(max(length, 256), dtype=torch.float32, device=device)
                angles = positions[:, None, None] * self.frequencies.to(device).clone()
                self._cos, self._sin = angles.cos(), angles.sin()
        assert self._cos is not None and self._sin is not None
        return self._cos[:length], self._sin[:length]
