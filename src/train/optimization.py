"""What moves the weights: accelerator, optimizer, learning rate and moving average of a run."""

import copy
import math
import os
from collections.abc import Mapping

import torch
from accelerate import Accelerator, DistributedDataParallelKwargs
from accelerate.state import AcceleratorState
from torch import Tensor, nn

from ..shared.config_schema import TrainConfig
from ..shared.device import ComputeChoice
from ..shared.errors import UsageError


def learning_rate_factor(step: int, *, steps: int, warmup: int, schedule: str) -> float:
    """Factor on the base learning rate at a step that counts from 0; resuming needs no state.

    Linear warm-up from 1/warmup to 1, then cosine or linear decay that reaches 0 just after the
    last step, or a constant 1.
    """
    if step < warmup:
        return (step + 1) / warmup
    progress = min(1.0, (step - warmup) / max(1, steps - warmup))
    if schedule == "cosine":
        return 0.5 * (1 + math.cos(math.pi * progress))
    return 1.0 - progress if schedule == "linear" else 1.0


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


def make_accelerator(config: TrainConfig, compute: ComputeChoice) -> Accelerator:
    """An Accelerator on the chosen device; raises UsageError on a wrong number of processes."""
    alone = int(os.environ.get("WORLD_SIZE", "1")) == 1
    # accelerate keeps one state a process, yet a second stage may want another precision;
    # what connects several processes must stay
    AcceleratorState._reset_state(reset_partial_state=alone)
    accelerator = Accelerator(
        cpu=compute.device == "cpu",
        mixed_precision=compute.precision,
        gradient_accumulation_steps=config.gradient_accumulation,
        kwargs_handlers=[DistributedDataParallelKwargs(find_unused_parameters=True)],
    )
    expected = config.processes or int(os.environ.get("WORLD_SIZE", "1"))
    if accelerator.num_processes != expected:
        raise UsageError(
            f"{accelerator.num_processes} process(es) are running, {expected} were asked for;"
            f" let `motion-tools train STAGE --num-processes {expected}` start them, or leave"
            " `processes` out"
        )
    return accelerator


def make_optimizer(
    module: nn.Module,
    config: TrainConfig,
    device: str,
    rates: Mapping[str, float] | None = None,
) -> torch.optim.AdamW:
    """AdamW that leaves biases, norms and other vectors undecayed.

    Args:
        module: what is trained.
        config: of the stage.
        device: its type.
        rates: learning rates of parts of the module, by the beginning of their weights' names;
            the rest learns at the configuration's.
    """
    weights: dict[tuple[float, bool], list[nn.Parameter]] = {}
    for name, weight in module.named_parameters():
        if weight.requires_grad:
            matching = [rate for start, rate in (rates or {}).items() if name.startswith(start)]
            key = ([*matching, config.learning_rate][0], weight.ndim >= 2)
            weights.setdefault(key, []).append(weight)
    groups = [
        {
            "params": members,
            "lr": rate,
            "initial_lr": rate,  # before warm-up and decay
            "weight_decay": config.weight_decay if decays else 0.0,
        }
        for (rate, decays), members in sorted(weights.items(), key=lambda item: item[0])[::-1]
    ]
    return torch.optim.AdamW(
        groups,
        betas=config.adam_betas,
        fused=device != "mps",
        foreach=True if device == "mps" else None,
    )
