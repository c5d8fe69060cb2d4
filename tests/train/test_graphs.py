"""What a captured step reads is found wherever it stands; that it learns the same: test_engine."""

import torch
from torch import Tensor

from src.train.graphs import tensors_in
from src.train.train_generation import NoisedBatch


def test_every_tensor_is_found_in_order() -> None:
    one, two, three = (torch.full((1,), value) for value in range(3))
    found = [*tensors_in({"a": one, "b": [two, ("text", 3)], "c": {"d": three}})]
    assert all(a is b for a, b in zip(found, (one, two, three), strict=True))


def test_those_of_a_batch() -> None:
    names = ("timesteps", "tag", "mask", "drop", "known", "provenance", "clean", "noise")
    batch = NoisedBatch(*(torch.tensor(index) for index in range(len(names))))
    assert [int(tensor) for tensor in tensors_in(batch)] == [*range(len(names))]
    assert all(isinstance(tensor, Tensor) for tensor in tensors_in(batch))
