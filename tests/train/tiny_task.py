"""A task small enough for tests: a two-layer net with dropout learns a line; also a program.

Run as a program it is a training stage like any other: `python tests/train/tiny_task.py
--output DIR steps=20`. TINY_SLEEP makes each batch slow, TINY_NAN spoils the loss of one step,
TINY_DROPOUT=0 switches dropout off.
"""

import os
import time
from pathlib import Path
from typing import Any

import torch
from torch import Tensor, nn

from src.shared.config_schema import NetworkConfig, TrainConfig
from src.train.launch import Stage
from src.train.task import Part, Task, generator

WEIGHTS = torch.tensor([1.0, -2.0, 0.5])


class TinyTask(Task):
    def __init__(self, config: TrainConfig, network: NetworkConfig | None = None) -> None:
        self.config = config
        dropout = float(os.environ.get("TINY_DROPOUT", "0.5"))
        self.module = nn.Sequential(nn.Linear(3, 8), nn.Dropout(dropout), nn.Linear(8, 1))

        self.identity = {"task": "tiny"}

    def batch(self, part: Part) -> dict[str, Tensor]:
        time.sleep(float(os.environ.get("TINY_SLEEP", "0")))
        size = self.config.batch_size
        rows = range(part.index * size, (part.index + 1) * size)
        inputs = torch.stack(
            [torch.randn(3, generator=generator(self.config.seed, part.step, row)) for row in rows]
        )
        target = inputs @ WEIGHTS
        if os.environ.get("TINY_NAN") == str(part.step):
            target = target * float("nan")
        return {"inputs": inputs, "target": target}

    def training_step(self, module: nn.Module, batch: dict[str, Tensor]) -> dict[str, Tensor]:
        error = (module(batch["inputs"])[:, 0] - batch["target"]).square().mean()
        return {"loss": error, "error": error.sqrt()}

    def validation(self, module: nn.Module) -> dict[str, float]:
        inputs = torch.randn(64, 3, generator=generator("validation"))
        made = module(inputs.to(next(module.parameters()).device))[:, 0].cpu()
        return {"loss": float((made - inputs @ WEIGHTS).square().mean())}

    def export_samples(self, module: nn.Module, folder: Path) -> None:
        folder.mkdir(parents=True, exist_ok=True)
        ones = torch.ones(1, 3, device=next(module.parameters()).device)
        (folder / "sample.txt").write_text(str(module(ones)))

    def save_pretrained(self, module: nn.Module, folder: Path) -> None:
        torch.save(module.state_dict(), folder / "weights.pt")


class TinyStage(Stage):
    """A stage beside the package's own."""

    def part(self, name: str) -> Any:
        return globals()[name]


STAGE = TinyStage(TrainConfig, "tests.train.tiny_task", "TinyTask", "Train the tiny task.")

if __name__ == "__main__":
    STAGE.app()()
