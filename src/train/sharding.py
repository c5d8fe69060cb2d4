"""FSDP2: weights, gradients and the optimizer's state in as many shards as there are processes.

It is torch's own `fully_shard`, as accelerate applies it on GPUs; called here, because accelerate
1.15 leaves its FSDP plugin out without a word where several processes compute on CPUs (the list of
kinds in `AcceleratorState.__init__`), and what the tests cannot run is not known to work.
Checkpoints hold whole tensors, so that any number of processes goes on from them, sharded or not.
"""

import os
import warnings

import torch
from torch import Tensor, nn
from torch.distributed.device_mesh import init_device_mesh
from torch.distributed.fsdp import fully_shard
from torch.distributed.tensor import DTensor, distribute_tensor

from ..shared.errors import UsageError


def is_asked_for(version: int | None) -> bool:
    """Whether the settings, or the configuration of `accelerate launch`, ask for shards.

    Raises:
        UsageError: it is FSDP1 that they ask for.
    """
    launched = os.environ.pop("ACCELERATE_USE_FSDP", "false").lower() == "true"  # it is done here
    if launched and (given := os.environ.get("FSDP_VERSION", "1")) != "2":
        raise UsageError(f"accelerate's fsdp_version is {given}; give fsdp_version: 2")
    return launched or version is not None


def shard(module: nn.Module, device: torch.device) -> None:
    """Shard a module in place.

    It is one unit, whole while it computes: its blocks are asked for more than their `forward`,
    and 261M weights are 1 GB, to 4 GB of gradients, moments and average that stay in shards.
    """
    # it warns of operations in place on what a UNet returns; no loss of ours has any
    warnings.filterwarnings("ignore", message="FSDP2-wrapped module")
    for part in module.modules():
        for name, weight in part.named_parameters(recurse=False):
            if not weight.dim():  # a single number is divided as a vector of one
                one = nn.Parameter(weight.detach().reshape(1), weight.requires_grad)
                part.register_parameter(name, one)
    fully_shard(module, mesh=init_device_mesh(device.type, (torch.distributed.get_world_size(),)))


def whole(tensor: Tensor) -> Tensor:
    """All of a tensor, of which this process may hold a shard; every process must ask."""
    return tensor.full_tensor() if isinstance(tensor, DTensor) else tensor


def local(tensor: Tensor) -> Tensor:
    """The part of a tensor that this process holds."""
    return tensor.to_local() if isinstance(tensor, DTensor) else tensor


def placed_as(tensor: Tensor, other: Tensor) -> Tensor:
    """A whole tensor in shards where `other`, of its shape, is; every process must ask.

    A single number takes the shape that `shard` gave it, or gets its own back.
    """
    if tensor.numel() == other.numel() == 1 and tensor.shape != other.shape:
        tensor = tensor.reshape(other.shape)
    if not isinstance(other, DTensor) or tensor.shape != other.shape:
        return tensor
    return distribute_tensor(tensor.to(other.device), other.device_mesh, other.placements)
