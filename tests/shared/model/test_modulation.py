"""FiLM, AdaLN, embeddings, dropout and feed-forward layers."""

import math

import torch
from hypothesis import given
from hypothesis import strategies as st

from src.shared.model.layers import (
    AdaLN,
    ChannelDropout,
    FiLM,
    TagEmbedding,
    TemporalLayer,
    TimestepEmbedding,
    TransformLayer,
    masked_mean,
    sinusoidal,
    without_full_mask,
)

B, T, D = 2, 5, 8


def test_film_starts_as_the_identity_and_then_modulates():
    film = FiLM(D, 4)
    x, condition = torch.randn(B, T, D), torch.randn(B, 4)
    assert torch.equal(film(x, condition), x)
    torch.nn.init.normal_(film.modulation.weight)
    scale, shift = film.modulation(condition).chunk(2, dim=-1)
    assert torch.allclose(film(x, condition)[1, 3], x[1, 3] * (1 + scale[1]) + shift[1])


def test_adaln_starts_as_a_layer_norm():
    x, condition = torch.randn(B, T, D) * 5 + 3, torch.randn(B, 4)
    expected = torch.nn.functional.layer_norm(x, (D,))
    assert torch.allclose(AdaLN(D, 4)(x, condition), expected)


@given(position=st.integers(0, 5000), half=st.integers(1, 16))
def test_sinusoidal_codes(position: int, half: int):
    code = sinusoidal(torch.tensor([position]), 2 * half)[0]
    for index in range(half):
        angle = position * math.exp(-math.log(10_000) * index / half)
        assert abs(code[index] - math.cos(angle)) < 2e-3
        assert abs(code[half + index] - math.sin(angle)) < 2e-3


def test_sinusoidal_of_odd_width_ends_with_zero():
    assert sinusoidal(torch.arange(3), 5).shape == (3, 5)
    assert torch.equal(sinusoidal(torch.arange(3), 5)[:, 4], torch.zeros(3))


def test_timestep_embedding_tells_steps_apart():
    embedding = TimestepEmbedding(D)
    assert [layer.out_features for layer in embedding.mlp if hasattr(layer, "out_features")] == [
        4 * D,
        D,
    ]
    out = embedding(torch.arange(100))
    assert out.shape == (100, D)
    assert torch.cdist(out, out).fill_diagonal_(1).min() > 1e-4


def test_tag_embedding_has_one_entry_more():
    assert TagEmbedding(3, D)(torch.tensor([0, 3])).shape == (2, D)
    assert TagEmbedding(0, D).embedding.num_embeddings == 1


def test_transform_layer_has_a_residual_only_where_widths_match():
    same, other = TransformLayer(D), TransformLayer(D, 6)
    for layer in (same, other):
        torch.nn.init.zeros_(layer.contract.weight)
        torch.nn.init.zeros_(layer.contract.bias)
    x = torch.randn(B, T, D)
    assert torch.equal(same(x), x)
    assert torch.equal(other(x), torch.zeros(B, T, 6))
    assert same.expand.out_features == 4 * D


def test_temporal_layer_ignores_padding():
    layer = TemporalLayer(D, 2).eval()
    x = torch.randn(1, T, D)
    mask = torch.arange(T)[None] < 3
    assert torch.allclose(layer(x, mask)[:, :3], layer(x[:, :3]), atol=1e-6)


def test_channel_dropout_keeps_the_mean_and_drops_over_time():
    torch.manual_seed(0)
    dropout = ChannelDropout(0.3)
    out = dropout(torch.ones(200, 4, 50))
    assert torch.equal(out, out[:, :1].expand_as(out))
    assert abs(out.mean() - 1) < 0.02
    assert abs((out == 0).float().mean() - 0.3) < 0.02
    assert torch.equal(dropout.eval()(out), out)


def test_masked_mean_counts_real_rows_only():
    values = torch.tensor([[[1.0], [3.0], [100.0]]])
    assert masked_mean(values, torch.tensor([[True, True, False]])).item() == 2
    assert masked_mean(values, torch.zeros(1, 3, dtype=torch.bool)).item() == 0


def test_a_full_mask_is_dropped():
    assert without_full_mask(torch.ones(2, 3, dtype=torch.bool)) is None
    mask = torch.tensor([[True, False]])
    assert without_full_mask(mask) is mask
