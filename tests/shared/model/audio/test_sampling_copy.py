"""The fast copy of UNet1D answers as the network itself does."""

import pytest
import torch
from torch import nn

from src.shared.model.audio.unet import MatrixConv1d, sampling_copy
from tests.shared.model.audio.tiny_audio import unet


@pytest.mark.parametrize(("kernel", "stride", "padding"), [(3, 1, 1), (3, 2, 1), (1, 1, 0)])
def test_matrix_convolution_is_the_convolution(kernel: int, stride: int, padding: int) -> None:
    torch.manual_seed(0)
    conv = nn.Conv1d(5, 7, kernel, stride=stride, padding=padding)
    for frames in (8, 11):
        x = torch.randn(3, 5, frames)
        torch.testing.assert_close(MatrixConv1d(conv)(x), conv(x), rtol=1e-5, atol=1e-5)


@pytest.mark.parametrize("conditioning", ["cross-attention", "film", "both"])
@pytest.mark.parametrize("frames", [24, 37])
def test_the_copy_gives_the_same(conditioning: str, frames: int) -> None:
    model = unet(conditioning=conditioning, channel_mult=(1, 2, 2))
    x, t = torch.randn(2, 25, frames), torch.tensor([3, 700])
    condition = torch.randn(2, 167, frames)
    expected = model(x, t, condition)
    fast = sampling_copy(model)
    torch.testing.assert_close(fast(x, t, fast.prepare(condition)), expected, rtol=1e-4, atol=1e-4)
    torch.testing.assert_close(model(x, t, condition), expected)  # the original is left alone
