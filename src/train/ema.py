"""Exponential moving average of a module's weights."""

import copy

import torch
from torch import Tensor, nn


class ExponentialMovingAverage:
    """A frozen copy of a module that trails it: e ← d·e + (1 − d)·w.

    The decay d warms up as min(decay, (1 + n) / (10 + n)) over the number n of updates, so that
    a short training is not averaged with its random start. Buffers are copied.
    """

    def __init__(self, module: nn.Module, decay: float) -> None:
        self.decay = decay
        self.module = copy.deepcopy(module).eval().requires_grad_(False)
        trained = [name for name, weight in module.named_parameters() if weight.requires_grad]
        self._average: list[Tensor] = [self.module.get_parameter(name) for name in trained]
        self._current: list[Tensor] = [module.get_parameter(name) for name in trained]
        self._buffers = list(zip(self.module.buffers(), module.buffers(), strict=True))

    @torch.no_grad()
    def update(self, updates: int) -> None:
        """Move towards the module's present weights; `updates` counts the calls before this."""
        decay = min(self.decay, (1 + updates) / (10 + updates))
        torch._foreach_lerp_(self._average, self._current, 1 - decay)
        for average, current in self._buffers:
            average.copy_(current)
