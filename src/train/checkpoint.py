"""Checkpoints: one folder a step, safetensors and JSON only (no pickle), whole or absent.

`checkpoints/step-00000500/` holds model, ema and optimizer tensors and `state.json`: step,
configuration, hash of the data, and the SHA-256 of each file. A folder is written beside and
renamed, so `kill -9` leaves either the old state or the new one. A run goes on from one only with
the settings, data and network that it had before.

They hold whole tensors, so that any number of processes goes on from them, sharded or not. Shards
of weights, gradients and the optimizer's state, as many as there are processes, are FSDP2: torch's
own `fully_shard`, as accelerate applies it on GPUs; called here, because accelerate 1.15 leaves its
FSDP plugin out without a word where several processes compute on CPUs (the list of kinds in
`AcceleratorState.__init__`), and what the tests cannot run is not known to work.
"""

import json
import math
import os
import shutil
import sys
import warnings
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import torch
from safetensors import SafetensorError
from safetensors.torch import load_file, save_file
from torch import Tensor, nn
from torch.distributed.device_mesh import init_device_mesh
from torch.distributed.fsdp import fully_shard
from torch.distributed.tensor import DTensor, distribute_tensor

from ..shared.config_loader import dump_config
from ..shared.config_schema import TrainConfig
from ..shared.errors import UsageError, UserError
from ..shared.io.files import sha256_file, unfinished, why_not_written, write_json


@dataclass(frozen=True)
class Checkpoint:
    """A complete checkpoint on disk and the plain data of its state.json."""

    folder: Path
    state: dict[str, Any]

    @property
    def step(self) -> int:
        """Optimizer steps done."""
        return int(self.state["step"])

    def tensors(self, name: str) -> dict[str, Tensor]:
        """The tensors of one file: model, ema or optimizer."""
        return load_file(self.folder / f"{name}.safetensors")


def optimizer_tensors(optimizer: torch.optim.Optimizer) -> dict[str, Tensor]:
    """The optimizer's state as a flat mapping `parameter number.name`, shards put together."""
    state = optimizer.state_dict()["state"]
    return {
        f"{index}.{name}": whole(value)
        for index, values in state.items()
        for name, value in values.items()
        if isinstance(value, Tensor)
    }


def load_optimizer(optimizer: torch.optim.Optimizer, tensors: dict[str, Tensor]) -> None:
    """Inverse of `optimizer_tensors`; hyper-parameters stay those of the configuration."""
    state: dict[int, dict[str, Tensor]] = {}
    weights = [weight for group in optimizer.param_groups for weight in group["params"]]
    for key, value in tensors.items():
        index, name = key.split(".", 1)
        if name != "step":  # a count; the others are of the weight's shape
            value = placed_as(value, weights[int(index)])
        state.setdefault(int(index), {})[name] = value
    groups = optimizer.state_dict()["param_groups"]
    optimizer.load_state_dict({"state": state, "param_groups": groups})


def save_checkpoint(
    root: Path, tensors: Mapping[str, dict[str, Tensor]], *, state: dict[str, Any], keep: int
) -> Path:
    """Write `root/step-N` for `state["step"]` and remove all but the newest `keep`.

    Args:
        root: folder of the checkpoints.
        tensors: those of each file: model, ema, optimizer.
        state: the plain data of state.json.
        keep: number of checkpoints.

    Raises:
        UserError: the folder cannot be written.
    """
    target = root / f"step-{state['step']:08d}"
    partial = unfinished(target)
    files = {f"{name}.safetensors": own for name, own in tensors.items()}
    try:
        partial.mkdir(parents=True)
        for name, own in files.items():
            alone = {key: each.detach().cpu().contiguous().clone() for key, each in own.items()}
            save_file(alone, partial / name)  # which refuses tensors that share memory
        hashes = {name: sha256_file(partial / name) for name in files}
        write_json(partial / "state.json", {**state, "sha256": hashes})
        shutil.rmtree(target, ignore_errors=True)
        os.replace(partial, target)
    except (OSError, SafetensorError) as error:
        reason = why_not_written(error) or str(error)
        raise UserError(
            f"cannot write checkpoint {target}: {reason}; free space and run again with --resume"
        ) from error
    finally:
        shutil.rmtree(partial, ignore_errors=True)  # gone already, if all went well
    for old in _folders(root)[keep:]:
        shutil.rmtree(old, ignore_errors=True)
    return target


def _folders(root: Path) -> list[Path]:
    """Complete checkpoint folders, newest first."""
    return sorted((p for p in root.glob("step-*") if p.is_dir()), reverse=True)


def _damage(folder: Path) -> str | None:
    """What is wrong with a checkpoint folder, or None."""
    try:
        state = json.loads((folder / "state.json").read_text(encoding="utf-8"))
        for name, expected in state["sha256"].items():
            if sha256_file(folder / name) != expected:
                return f"{name} does not match its SHA-256"
    except (OSError, ValueError, KeyError) as error:
        return f"state.json or a file it names is unreadable ({error})"
    return None


def latest_checkpoint(root: Path) -> Checkpoint | None:
    """The newest undamaged checkpoint; names each damaged one on stderr, None if there is none.

    Raises:
        UserError: there are checkpoints, and all are damaged.
    """
    folders = _folders(root)
    for folder in folders:
        if (damage := _damage(folder)) is None:
            state = json.loads((folder / "state.json").read_text(encoding="utf-8"))
            return Checkpoint(folder, state)
        print(f"warning: skipping checkpoint {folder}: {damage}", file=sys.stderr)
    if folders:
        raise UserError(f"every checkpoint in {root} is damaged; delete the folder and start again")
    return None


# Settings a resumed run may change: they say where, how fast and how often, not what is learned.
# `steps` may grow (the decay of the learning rate then runs to the new end).
MAY_CHANGE = frozenset(
    {
        "output",
        "steps",
        "epochs",
        "patience",
        "log-every",
        "validate-every",
        "validate-first",
        "validation-batches",
        "validation-prompts",
        "save-every",
        "keep-checkpoints",
        "device",
        "threads",
        "num-workers",
        "fsdp-version",
        "tensorboard",
        "cuda-graphs",
    }
)
# Their product may not change, each of them may: the same clips make a step.
BATCH = ("batch-size", "gradient-accumulation", "processes")


def run_identity(config: TrainConfig, task: dict[str, Any], processes: int) -> dict[str, Any]:
    """What a resumed run must have in common with the run it continues, as plain JSON data."""
    own = {key: value for key, value in dump_config(config).items() if key not in MAY_CHANGE}
    return dict(json.loads(json.dumps({**own, **task, "processes": processes})))


def refuse_to_overwrite(output: Path, *, resume: bool) -> None:
    """Raises UsageError when a folder holds checkpoints that nobody asked to continue."""
    if not resume and any((output / "checkpoints").glob("step-*")):
        raise UsageError(
            f"{output} holds a run already; add --resume to continue it, or choose another --output"
        )


def require_same_run(
    checkpoint: Checkpoint, identity: dict[str, Any], before: dict[str, Any] | None = None
) -> None:
    """Raises UsageError naming the first setting in which the checkpoint differs; `before`: what it
    is held against, its identity by default."""
    before = checkpoint.state["identity"] if before is None else before
    before, identity = _with_global_batch(before), _with_global_batch(identity)
    for key in sorted({*before, *identity}):
        if before.get(key) != identity.get(key):
            if not {key} <= before.keys() & identity.keys():
                raise UsageError(
                    f"cannot resume {checkpoint.folder}: it is a run of another stage, or of"
                    f" another version ({key}); choose another --output"
                )
            raise UsageError(
                f"cannot resume {checkpoint.folder}: {key} was {before.get(key)!r} and is now"
                f" {identity.get(key)!r}; give the old value or choose another --output"
            )


def _with_global_batch(identity: dict[str, Any]) -> dict[str, Any]:
    """The clips of a step as one number, for those of a part, parts and processes."""
    rest = {key: value for key, value in identity.items() if key not in BATCH}
    product = math.prod(identity[key] for key in BATCH)
    return rest | {f"global batch ({' x '.join(BATCH)})": product}


# ---------------------------------------------------------------- shards


def asks_for_shards(version: int | None) -> bool:
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
