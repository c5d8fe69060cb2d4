"""Attention against PyTorch's own, masks, rotary positions and the bf16 training path."""

import pytest
import torch

from src.shared.model.layers import (
    AdaptedLinear,
    CrossAttention,
    MultiHeadAttention,
    RotaryEmbedding,
    attend,
)

B, T, D, H = 3, 7, 16, 4


def test_self_attention_is_torchs():
    ours = MultiHeadAttention(D, H)
    theirs = torch.nn.MultiheadAttention(D, H, batch_first=True)
    theirs.in_proj_weight.data, theirs.in_proj_bias.data = ours.qkv.weight, ours.qkv.bias
    theirs.out_proj.load_state_dict(ours.out.state_dict())
    x = torch.randn(B, T, D)
    mask = torch.arange(T) < torch.tensor([[7], [3], [5]])
    expected, _ = theirs(x, x, x, key_padding_mask=~mask)
    assert torch.allclose(ours(x, mask), expected, atol=1e-5)


def test_cross_attention_is_torchs():
    ours = CrossAttention(D, H)
    theirs = torch.nn.MultiheadAttention(D, H, batch_first=True)
    theirs.in_proj_weight.data = torch.cat([ours.query.weight, ours.key_value.weight])
    theirs.in_proj_bias.data = torch.cat([ours.query.bias, ours.key_value.bias])
    theirs.out_proj.load_state_dict(ours.out.state_dict())
    x, context = torch.randn(B, T, D), torch.randn(B, 5, D)
    expected, _ = theirs(x, context, context)
    assert torch.allclose(ours(x, ours.keys_values(context)), expected, atol=1e-5)


@pytest.mark.parametrize("rotary", [False, True])
def test_padding_does_not_reach_real_frames(rotary: bool):
    layer = MultiHeadAttention(D, H, rotary=rotary)
    x = torch.randn(1, T, D)
    mask = torch.arange(T)[None] < 4
    other = torch.where(mask[..., None], x, torch.randn_like(x))
    assert torch.allclose(layer(x, mask)[:, :4], layer(other, mask)[:, :4], atol=1e-6)
    assert torch.allclose(layer(x, mask)[:, :4], layer(x[:, :4]), atol=1e-6)


def test_heads_must_divide_the_width():
    with pytest.raises(AssertionError, match="16 must be divisible by the 3 heads"):
        MultiHeadAttention(16, 3)


def test_rotary_scores_depend_on_the_distance_only():
    rope = RotaryEmbedding(8)
    query, key = torch.randn(8), torch.randn(8)
    turned_query = rope(query.expand(1, T, 1, 8))[0, :, 0]
    turned_key = rope(key.expand(1, T, 1, 8))[0, :, 0]
    scores = turned_query @ turned_key.T  # T T
    for offset in range(-T + 1, T):
        diagonal = scores.diagonal(offset)
        assert torch.allclose(diagonal, diagonal[:1].expand_as(diagonal), atol=1e-4)
    assert torch.allclose(turned_query.norm(dim=-1), query.norm().expand(T), atol=1e-5)


def test_rotary_tables_made_while_sampling_serve_training():
    layer = MultiHeadAttention(D, H, rotary=True)
    with torch.inference_mode():
        layer(torch.randn(1, 300, D))
    layer(torch.randn(1, 300, D)).sum().backward()
    gradients = [parameter.grad for parameter in layer.parameters()]
    assert all(each is not None and bool(each.isfinite().all()) for each in gradients)


def test_rotary_makes_order_matter():
    x = torch.randn(1, T, D)
    for rotary, same in ((False, True), (True, False)):
        layer = MultiHeadAttention(D, H, rotary=rotary)
        assert torch.allclose(layer(x).flip(1), layer(x.flip(1)), atol=1e-5) is same


def test_bf16_training_path_agrees_with_the_fused_kernel():
    query, key, value = (torch.randn(B, H, T, 8, dtype=torch.bfloat16) for _ in range(3))
    mask = torch.arange(T) < torch.tensor([[7], [3], [5]])
    fused = attend(query, key, value, mask)
    plain = attend(query.clone().requires_grad_(), key, value, mask)
    assert torch.allclose(plain.float(), fused.float(), atol=0.03)


def test_each_sample_has_its_own_adapter_beside_the_linear_map():
    layer = AdaptedLinear(D, 5, ranks=(2, 4))
    for parameter in layer.parameters():
        torch.nn.init.normal_(parameter)  # adapters start at zero
    x, opened = torch.randn(B, T, D), torch.tensor([[0.0, 1.0], [0.0, 0.0], [1.0, 0.0]])
    expected = layer(x).clone()
    expected[0] += layer.adapters[1](x[0])
    expected[2] += layer.adapters[0](x[2])
    assert torch.allclose(layer(x, opened), expected, atol=1e-5)


@pytest.mark.parametrize("number", [0, 1])
def test_an_adapter_that_all_samples_open_is_learned_as_each_samples_own(number: int):
    layer = AdaptedLinear(D, 5, ranks=(2, 4))
    for parameter in layer.parameters():
        torch.nn.init.normal_(parameter)
    x, opened = torch.randn(B, T, D), torch.zeros(B, 2)
    opened[:, number] = 1.0
    learned = layer(x, opened)  # one product for all
    with torch.no_grad():
        sampled = layer(x, opened)  # one a sample
    assert torch.allclose(learned, sampled, atol=1e-5)
    assert torch.equal(layer(x, torch.zeros(B, 2)), layer(x))
