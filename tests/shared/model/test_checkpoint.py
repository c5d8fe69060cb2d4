"""The folder of a model: what is in its files depends on the weights alone."""

from pathlib import Path

import torch

from src.shared.model.checkpoint import ModelCard, write_checkpoint


def test_the_same_weights_are_the_same_bytes(tmp_path: Path) -> None:
    tensors = {"a": torch.arange(3.0), "b": torch.zeros(2)}
    written = {
        write_checkpoint(tmp_path, ModelCard(kind="test"), tensors).weights for _ in range(20)
    }
    assert len(written) == 1
