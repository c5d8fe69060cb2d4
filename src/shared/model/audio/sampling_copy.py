"""A copy of UNet1D that samples faster on the CPU: deep levels as low-precision matrix products.

Deep levels hold most weights and few frames, which PyTorch's Conv1d on a CPU serves badly: the
default profile's step takes 41 ms instead of 100 on one core. Rounding errors of deep levels come
out interpolated. Levels at and near the full rate stay as they are: there rounding would jitter,
and accelerations multiply a frame's jitter by 900.

Letters: B batch, C channels, T frames, k kernel size.
"""

import copy

import torch
from torch import Tensor, nn
from torch.nn import functional as F

from .stage import Stage
from .unet import UNet1D

DEEP = 4  # downsampling factor from which a level counts as deep


class MatrixConv1d(nn.Module):
    """Conv1d as one matrix product over frames; weights [C', k*C] instead of [C', C, k]."""

    def __init__(self, conv: nn.Conv1d) -> None:
        super().__init__()
        assert conv.groups == 1 and conv.padding_mode == "zeros" and conv.dilation == (1,)
        (self.kernel,), (self.stride,) = conv.kernel_size, conv.stride
        padding = conv.padding[0]
        assert isinstance(padding, int)
        self.padding = padding
        weight = conv.weight.detach().permute(0, 2, 1).flatten(1).contiguous()
        self.weight = nn.Parameter(weight, requires_grad=False)
        self.bias = conv.bias

    def forward(self, x: Tensor) -> Tensor:
        """[B, C, T] -> [B, C', T'] in the type of the weights."""
        rows = x.to(self.weight.dtype).transpose(1, 2)  # [B, T, C]
        if self.kernel > 1:
            batch, _, channels = rows.shape
            rows = F.pad(rows, (0, 0, self.padding, self.padding)).contiguous()
            length = rows.shape[1]
            frames = (length - self.kernel) // self.stride + 1
            # neighbours lie behind each other: k frames are one run of k*C numbers
            rows = rows.as_strided(
                (batch, frames, self.kernel * channels),
                (length * channels, self.stride * channels, 1),
            )
        return F.linear(rows.contiguous(), self.weight, self.bias).transpose(1, 2)


def sampling_copy(unet: UNet1D, low: torch.dtype | None = None) -> UNet1D:
    """The network again, for sampling on the CPU only: it neither trains nor is saved.

    Args:
        unet: on the CPU; left as it is.
        low: type of the levels from T/4 down, torch.bfloat16 where the processor multiplies it;
            None = float32.
    """
    fast = copy.deepcopy(unet).eval().requires_grad_(False)
    resamplers = zip(fast.config.factors[:-1], fast.downsample, fast.upsample, strict=True)
    parts: list[tuple[int, nn.Module]] = [(stage.factor, stage) for stage in fast.stages()]
    parts += [(factor, layer) for factor, *layers in resamplers for layer in layers]
    for factor, part in parts:
        if factor >= DEEP:
            _replace_convolutions(part)
            part.to(low or torch.float32)
            if isinstance(part, Stage):
                part.low = low
    return fast


def _replace_convolutions(module: nn.Module) -> None:
    for name, child in module.named_children():
        if isinstance(child, nn.Conv1d):
            setattr(module, name, MatrixConv1d(child))
        else:
            _replace_convolutions(child)
