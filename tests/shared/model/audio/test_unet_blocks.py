"""The UNet's blocks compute what TECH 3.1.3 and 3.1.4 print, at equal weights."""

import pytest
import torch
from torch import Tensor
from torch.nn import functional as F

from src.shared.model.audio.unet import (
    AttentionBlock,
    Downsample,
    ResBlock,
    Upsample,
)
from src.shared.model.layers import RotaryEmbedding
from tests.shared.model.audio.tiny_audio import awake


@pytest.mark.parametrize("scale_shift", [True, False])
@pytest.mark.parametrize("out_channels", [32, 64])
def test_res_block_is_the_printed_one(scale_shift: bool, out_channels: int) -> None:
    torch.manual_seed(0)
    block = ResBlock(32, out_channels, 16, use_scale_shift_norm=scale_shift).eval()
    awake(block)
    x, time = torch.randn(2, 32, 11), torch.randn(2, 16)
    h = block.conv1(F.silu(F.group_norm(x, 32, block.norm1.weight, block.norm1.bias)))
    time_out = block.time_mlp(time)[:, :, None]
    if scale_shift:
        scale, shift = time_out.chunk(2, dim=1)
        h = block.norm2(h) * (1 + scale) + shift
    else:
        h = block.norm2(h + time_out)
    expected = block.conv2(F.silu(h)) + block.skip_conv(x)
    torch.testing.assert_close(block(x, time), expected)


def printed_attention(query: Tensor, key: Tensor, value: Tensor, heads: int) -> Tensor:
    """TECH's einsum and softmax: query [B, C, T], key and value [B, C, S] -> [B, C, T]."""
    q, k, v = (part.unflatten(1, (heads, -1)) for part in (query, key, value))  # [B, h, d, T]
    weights = torch.einsum("bhdt,bhds->bhts", q, k) * q.shape[2] ** -0.5
    return torch.einsum("bhts,bhds->bhdt", weights.softmax(dim=-1), v).flatten(1, 2)


def conv(layer: torch.nn.Module, x: Tensor) -> Tensor:
    """TECH's 1x1 convolution with the weights of our Linear."""
    return F.conv1d(x, layer.get_parameter("weight")[:, :, None], layer.get_parameter("bias"))


def test_attention_is_the_printed_one_with_a_context_of_its_own_length() -> None:
    """Ruling 3: TECH gives the context the length of the queries, which breaks at T/2."""
    torch.manual_seed(0)
    block = AttentionBlock(32, num_heads=4, context_dim=8, rotary=False)
    awake(block)
    x, context = torch.randn(2, 32, 6), torch.randn(2, 13, 8)
    query, key, value = conv(block.qkv, block.norm(x)).chunk(3, dim=1)
    expected = x + conv(block.proj, printed_attention(query, key, value, 4))
    torch.testing.assert_close(block(x), expected, rtol=1e-4, atol=1e-5)
    query = conv(block.q_cross, block.cross_norm(expected))
    key, value = conv(block.kv_cross, context.transpose(1, 2)).chunk(2, dim=1)
    expected = expected + conv(block.proj_cross, printed_attention(query, key, value, 4))
    out = block(x, block.keys_values(context))
    torch.testing.assert_close(out, expected, rtol=1e-4, atol=1e-5)


def test_rotary_positions_are_frames_on_every_level() -> None:
    """A piece of stride 4 turns as the frame in its middle does."""
    heads = torch.randn(1, 1, 2, 8)
    full, quarter = RotaryEmbedding(8), RotaryEmbedding(8, stride=4)
    everywhere = full(heads.expand(1, 32, 2, 8))
    torch.testing.assert_close(quarter(heads.expand(1, 8, 2, 8)), everywhere[:, 2::4])


def test_resampling_halves_and_doubles() -> None:
    x = torch.randn(2, 32, 16)
    assert Downsample(32)(x).shape == (2, 32, 8)
    up = Upsample(32)
    torch.testing.assert_close(up(x), up.conv(F.interpolate(x, scale_factor=2, mode="nearest")))
