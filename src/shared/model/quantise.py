"""Weights in 8 bits on disk: symmetric, one scale for each row, computed with in float32.

Half the size of float16. A rounded weight is off by at most 1/254 of the largest one of its row.
"""

from collections.abc import Mapping

import torch
from torch import Tensor

SUFFIX = ".int8_scale"
SMALLEST = 4096  # numbers; smaller tensors, biases and norms among them, are kept as they are


def quantise(tensors: Mapping[str, Tensor]) -> dict[str, Tensor]:
    """Large floating-point tensors [R, ...] as int8, with their scales [R] beside them."""
    stored: dict[str, Tensor] = {}
    for name, tensor in tensors.items():
        if not tensor.is_floating_point() or tensor.ndim < 2 or tensor.numel() < SMALLEST:
            stored[name] = tensor
            continue
        rows = tensor.detach().float().flatten(1)  # [R, ...]
        scale = rows.abs().amax(dim=1).clamp_min(1e-12) / 127
        stored[name] = (rows / scale[:, None]).round().to(torch.int8).view(tensor.shape)
        stored[name + SUFFIX] = scale
    return stored


def dequantise(stored: Mapping[str, Tensor]) -> dict[str, Tensor]:
    """The inverse of `quantise`, up to rounding; other tensors pass unchanged."""
    tensors: dict[str, Tensor] = {}
    for name, tensor in stored.items():
        if name.endswith(SUFFIX):
            continue
        scale = stored.get(name + SUFFIX)
        if scale is not None:
            tensor = tensor.float() * scale.view(-1, *(1,) * (tensor.ndim - 1))
        tensors[name] = tensor
    return tensors
