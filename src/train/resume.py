"""When a run may be continued: the same settings, data and network as before."""

import json
from pathlib import Path
from typing import Any

from ..shared.config_loader import dump_config
from ..shared.config_schema import TrainConfig
from ..shared.errors import UsageError
from .checkpoint import Checkpoint

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
        "tensorboard",
    }
)


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


def require_same_run(checkpoint: Checkpoint, identity: dict[str, Any]) -> None:
    """Raises UsageError naming the first setting in which the checkpoint differs."""
    before = checkpoint.state["identity"]
    for key in sorted({*before, *identity}):
        if before.get(key) != identity.get(key):
            raise UsageError(
                f"cannot resume {checkpoint.folder}: {key} was {before.get(key)!r} and is now"
                f" {identity.get(key)!r}; give the old value or choose another --output"
            )
