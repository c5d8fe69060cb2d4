"""What a training stage must offer: its module, its batches, its loss, its exports."""

from dataclasses import dataclass
from pathlib import Path
from typing import Any, Protocol

import torch
from torch import Tensor, nn


@dataclass(frozen=True)
class Part:
    """Which part of which global batch: part `index` of `count` equal parts of step `step`."""

    step: int
    index: int
    count: int


class Task(Protocol):
    """What one stage learns. `module` holds everything that is trained.

    A task may also have `learning_rates`, a mapping from the beginning of weights' names to the
    rate of that part of the module, and `has_converged()`, asked on the main process after each
    validation: True ends the training early.
    """

    module: nn.Module

    def identity(self) -> dict[str, Any]:
        """Plain data that must be equal when a run is resumed (network, data hash, ...)."""
        ...

    def to(self, device: torch.device) -> None:
        """Move what belongs to the task but is not trained (frozen towers, statistics)."""
        ...

    def batch(self, part: Part) -> Any:
        """Part of a step's batch, on the CPU: a pure function of its argument and the seed."""
        ...

    def training_step(self, module: nn.Module, batch: Any) -> dict[str, Tensor]:
        """Scalars of one part, among them `loss`; call `module` itself, never an attribute."""
        ...

    def validation(self, module: nn.Module) -> dict[str, float]:
        """Figures of held-back data, with fixed noise; `module` carries the averaged weights."""
        ...

    def export_samples(self, module: nn.Module, folder: Path) -> None:
        """Write what the module makes into `folder`, for a person to look at."""
        ...

    def save_pretrained(self, module: nn.Module, folder: Path) -> None:
        """Write the finished model with its configuration."""
        ...
