"""Weights in 8 bits: small error, a quarter of the bytes, nothing else touched."""

from pathlib import Path

import torch
from hypothesis import given
from hypothesis import strategies as st

from src.shared.model.checkpoint import (
    INT8_SCALE,
    ModelCard,
    dequantise,
    quantise,
    read_tensors,
    write_checkpoint,
)


@given(seed=st.integers(0, 1000), size=st.floats(1e-6, 1e4))
def test_no_weight_is_off_by_more_than_half_a_step_of_its_row(seed: int, size: float) -> None:
    generator = torch.Generator().manual_seed(seed)
    rows = torch.logspace(-3, 0, 64)[:, None, None]  # rows of very different size
    weight = size * rows * torch.randn(64, 32, 3, generator=generator)
    again = dequantise(quantise({"w": weight}))["w"]
    step = weight.abs().amax(dim=(1, 2), keepdim=True) / 127
    assert ((again - weight).abs() <= 0.5001 * step).all()


def test_small_and_whole_number_tensors_pass_unchanged() -> None:
    tensors = {"bias": torch.randn(5000), "tiny": torch.randn(3, 3), "n": torch.ones(9000).long()}
    assert quantise(tensors).keys() == tensors.keys() == dequantise(quantise(tensors)).keys()
    for name, tensor in dequantise(quantise(tensors)).items():
        torch.testing.assert_close(tensor, tensors[name])


def test_a_row_of_zeros_stays_one() -> None:
    assert not dequantise(quantise({"w": torch.zeros(64, 64)}))["w"].any()


def test_a_folder_holds_a_quarter_of_the_bytes(tmp_path: Path) -> None:
    weight = torch.randn(256, 256)
    card = write_checkpoint(tmp_path, ModelCard(kind="test"), {"w": weight}, int8=True)
    assert card.weights is not None and card.weights.dtype == "int8"
    assert card.weights.bytes < 256 * 256 * 1.1
    tensors = read_tensors(tmp_path, card)
    assert tensors.keys() == {"w"} and not any(INT8_SCALE in name for name in tensors)
    torch.testing.assert_close(tensors["w"], weight, rtol=0, atol=0.02)
