"""The accelerator and the optimizer that a training configuration asks for."""

import os
from collections.abc import Mapping

import torch
from accelerate import Accelerator, DistributedDataParallelKwargs
from accelerate.state import AcceleratorState
from torch import nn

from ..shared.config_schema import TrainConfig
from ..shared.device import ComputeChoice
from ..shared.errors import UsageError


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
