"""Reproducible noise: drawn on the CPU, one generator a sample, alike on every device."""

from collections.abc import Sequence

import numpy as np
import torch
from torch import Tensor

Generators = torch.Generator | Sequence[torch.Generator] | None


def sample_generators(seed: int, num_samples: int, start: int = 0) -> list[torch.Generator]:
    """One CPU generator for each of the samples start ... start + num_samples - 1.

    Sample i depends on (seed, i) alone: not on the batch size, its neighbours, or the device.
    """
    generators = []
    for index in range(start, start + num_samples):
        state = np.random.SeedSequence((seed, index)).generate_state(1, np.uint64)
        generators.append(torch.Generator("cpu").manual_seed(int(state[0] >> np.uint64(1))))
    return generators


def standard_normal(
    shape: Sequence[int],
    generator: Generators = None,
    *,
    device: torch.device | str = "cpu",
) -> Tensor:
    """Float32 noise of the given shape.

    Drawn on the CPU and moved, so that a seed means the same on CPU, CUDA and MPS. A sequence of
    generators gives each batch element its own stream.
    """
    shape = tuple(shape)
    if generator is None or isinstance(generator, torch.Generator):
        return torch.randn(shape, generator=generator, dtype=torch.float32).to(device)
    assert len(generator) == shape[0], f"{len(generator)} generators for a batch of {shape[0]}"
    rows = [torch.randn(shape[1:], generator=own, dtype=torch.float32) for own in generator]
    return torch.stack(rows).to(device)
