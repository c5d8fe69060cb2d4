"""TemporalUNet: motion -> one vector, the motion tower of CLIP (TEXT, TemporalUNet table).

Letters: B batch, T frames, T' = ceil(T/8) pieces, K rows (bones, root track), C channels,
D embed dim, H heads. No frame limit: positions are computed (ruling 25).
"""

import torch
from torch import Tensor, nn
from torch.nn.functional import gelu

from .transformer import TemporalLayer, masked_mean, sinusoidal, without_full_mask


class TemporalUNet(nn.Module):
    """Strided convolutions shorten time by 8, a transformer reads it, the mean sums it up.

    Padded frames are zeroed before each convolution, so a clip gets the same vector alone and
    in a padded batch.
    """

    def __init__(
        self, motion_dim: int, dim: int, *, num_heads: int, num_layers: int, dropout: float = 0.1
    ) -> None:
        super().__init__()
        self.input_proj = nn.Linear(motion_dim, dim)
        self.conv4 = nn.Conv1d(dim, dim, kernel_size=7, stride=4, padding=3)
        self.conv2 = nn.Conv1d(dim, dim, kernel_size=3, stride=2, padding=1)
        self.layers = nn.ModuleList(
            TemporalLayer(dim, num_heads, expansion=2, dropout=dropout) for _ in range(num_layers)
        )
        self.norm = nn.LayerNorm(dim)
        self.output_proj = nn.Linear(dim, dim)

    def forward(self, motion: Tensor, mask: Tensor | None = None) -> Tensor:
        """motion [B, T, K, C], mask [B, T] bool (True = real) or None -> [B, D]."""
        mask = without_full_mask(mask)
        h = self.input_proj(motion.flatten(2))  # [B, T, D]
        h, mask = self._shorten(h, mask, self.conv4)  # [B, ceil(T/4), D]
        h, mask = self._shorten(h, mask, self.conv2)  # [B, T', D]
        positions = torch.arange(h.shape[1], device=h.device)
        h = h + sinusoidal(positions, h.shape[2])  # [B, T', D]
        for layer in self.layers:
            h = layer(h, mask)  # [B, T', D]
        pooled = masked_mean(self.norm(h), mask)  # [B, D]
        result: Tensor = self.output_proj(pooled)
        return result

    @staticmethod
    def _shorten(h: Tensor, mask: Tensor | None, conv: nn.Conv1d) -> tuple[Tensor, Tensor | None]:
        stride = conv.stride[0]
        if mask is not None:
            h = h * mask[..., None].to(h.dtype)
        h = gelu(conv(h.transpose(1, 2))).transpose(1, 2)
        return h, None if mask is None else mask[:, ::stride]
