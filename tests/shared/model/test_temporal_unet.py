"""TemporalUNet: lengths, padding, shapes of TEXT."""

import pytest
import torch

from src.shared.model.layers import TemporalUNet


@pytest.fixture(scope="module")
def unet() -> TemporalUNet:
    torch.manual_seed(0)
    return TemporalUNet(23 * 6, 16, num_heads=2, num_layers=2).eval()


@pytest.mark.parametrize("frames", [1, 7, 8, 9, 30, 1000])
def test_any_length_gives_one_vector(unet: TemporalUNet, frames: int):
    assert unet(torch.randn(2, frames, 23, 6)).shape == (2, 16)


@pytest.mark.parametrize("frames", [5, 8, 13, 33])
def test_padding_changes_nothing(unet: TemporalUNet, frames: int):
    motion = torch.randn(2, 40, 23, 6)
    mask = torch.arange(40) < torch.tensor([[40], [frames]])
    alone = unet(motion[1:, :frames])
    assert torch.allclose(unet(motion, mask)[1:], alone, atol=1e-5)


def test_time_is_shortened_by_eight(unet: TemporalUNet):
    lengths = []
    handle = unet.layers[0].register_forward_hook(lambda *args: lengths.append(args[2].shape[1]))
    for frames in (8, 9, 16, 17):
        unet(torch.randn(1, frames, 23, 6))
    handle.remove()
    assert lengths == [1, 2, 2, 3]


def test_layers_are_the_documents(unet: TemporalUNet):
    assert (unet.conv4.stride, unet.conv2.stride) == ((4,), (2,))
    assert unet.layers[0].feed_forward.expand.out_features == 2 * 16


def test_order_of_the_frames_matters(unet: TemporalUNet):
    motion = torch.randn(1, 64, 23, 6)
    assert not torch.allclose(unet(motion), unet(motion.flip(1)), atol=1e-4)
