"""What a training stage must offer, and what every stage draws from: seeds that need no state.

Randomness is a pure function of (seed, step, part): resuming needs no generator states.
"""

import hashlib
from abc import ABC, abstractmethod
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, fields, is_dataclass, replace
from pathlib import Path
from types import MappingProxyType
from typing import Any

import numpy as np
import torch
from torch import Tensor, nn


def mix_seed(*parts: int | str) -> int:
    """A 63-bit seed that depends on every part; neighbouring steps give unrelated seeds."""
    text = "/".join(map(str, parts)).encode()
    return int.from_bytes(hashlib.blake2b(text, digest_size=8).digest(), "big") >> 1


def generator(*parts: int | str) -> torch.Generator:
    """A CPU generator of its own, seeded by `mix_seed`: equal numbers on every device."""
    return torch.Generator().manual_seed(mix_seed(*parts))


def numpy_generator(*parts: int | str) -> np.random.Generator:
    """A NumPy generator that depends on every part."""
    return np.random.default_rng(mix_seed(*parts))


@dataclass(frozen=True)
class Part:
    """Which part of which global batch: part `index` of `count` equal parts of step `step`."""

    step: int
    index: int
    count: int


def means(rows: Sequence[Mapping[str, float | Tensor]]) -> dict[str, float]:
    """Of each figure its mean over the rows that have it."""
    columns: dict[str, list[float]] = {}
    for row in rows:
        for key, value in row.items():
            columns.setdefault(key, []).append(float(value))
    return {key: sum(values) / len(values) for key, values in columns.items()}


class Task(ABC):
    """What one stage learns.

    Attributes:
        module: everything that is trained.
        identity: plain data that must be equal when a run is resumed (network, data hash, …).
        frozen: what belongs to the task but is not trained (towers, losses); it follows the module.
        learning_rates: from the beginning of weights' names to the rate of that part.
        figures: of the last validation; the trainer keeps them here.
        can_be_captured: whether `training_step` reads nothing back from the device (graphs.py);
            each shape is captured once, so batches give themselves in one of few, as `padded()`.
    """

    module: nn.Module
    identity: dict[str, Any]
    frozen: Sequence[nn.Module] = ()
    learning_rates: Mapping[str, float] = MappingProxyType({})
    figures: dict[str, float]
    can_be_captured: bool = False

    def to(self, device: torch.device) -> None:
        """Move what belongs to the task but is not trained."""
        for part in self.frozen:
            part.to(device)

    @abstractmethod
    def batch(self, part: Part) -> Any:
        """Part of a step's batch, on the CPU: a pure function of its argument and the seed."""

    def training_step(self, module: nn.Module, batch: Any) -> dict[str, Tensor]:
        """Scalars of one part, among them `loss`; call `module` itself, never an attribute."""
        losses: dict[str, Tensor] = module(batch)
        return losses

    @abstractmethod
    def validation(self, module: nn.Module) -> dict[str, float]:
        """Figures of held-back data, with fixed noise; `module` carries the averaged weights."""

    def has_converged(self) -> bool:
        """Whether training may end early; asked on the main process after each validation."""
        return False

    def export_samples(self, module: nn.Module, folder: Path) -> None:
        """Write what the module makes into `folder`, for a person to look at, if it makes any."""
        return

    @abstractmethod
    def save_pretrained(self, module: nn.Module, folder: Path) -> None:
        """Write the finished model with its configuration."""


def to_device(value: Any, device: torch.device) -> Any:
    """Move every tensor inside dicts, lists, tuples and dataclasses; leave the rest."""
    if isinstance(value, Tensor):
        return value.to(device, non_blocking=True)
    if isinstance(value, dict):
        return {key: to_device(item, device) for key, item in value.items()}
    if isinstance(value, list | tuple) and any(isinstance(v, Tensor | dict) for v in value):
        return type(value)(to_device(item, device) for item in value)
    if is_dataclass(value) and not isinstance(value, type):
        moved = {f.name: to_device(getattr(value, f.name), device) for f in fields(value) if f.init}
        return replace(value, **moved)
    return value
