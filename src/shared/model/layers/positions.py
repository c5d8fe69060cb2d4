"""Sinusoidal position codes for any number of positions (Vaswani et al. 2017, section 3.5).

Letters: B batch, T frames, D embed dim.
"""

import math

import torch
from torch import Tensor


def sinusoidal(positions: Tensor, dim: int, *, max_period: float = 10_000.0) -> Tensor:
    """Codes [..., dim] float32 of positions [...]: cosines in the first half, then sines.

    An odd `dim` ends with one zero.
    """
    half = dim // 2
    steps = torch.arange(half, dtype=torch.float32, device=positions.device)
    frequencies = torch.exp(steps * (-math.log(max_period) / max(half, 1)))
    angles = positions.float()[..., None] * frequencies  # [..., dim/2]
    codes = torch.cat([angles.cos(), angles.sin()], dim=-1)
    return torch.nn.functional.pad(codes, (0, dim - 2 * half))
