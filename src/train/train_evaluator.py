"""Training of the evaluator: multi-positive contrastive, on the train split only.

motion-tools train evaluator [key=value ...] [--resume]
"""

from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import torch
from pydantic import Field
from torch import Tensor, nn

from ..shared.config_schema import TrainConfig
from ..shared.data.captions.word_dropout import drop_words
from ..shared.data.prepare import open_data
from ..shared.evaluation.judge.evaluator import (
    Evaluator,
    EvaluatorConfig,
    PairBatch,
    PairSet,
    contrastive_loss,
)
from ..shared.metrics.retrieval import BATCH, TOP, guo_retrieval
from .launch import Stage
from .task import Part, Task, mix_seed
from .text_stages import can_retrieve


class TrainEvaluatorConfig(TrainConfig):
    """train_evaluator.yaml."""

    word_dropout: float = Field(0.1, ge=0, lt=1)
    noise: float = Field(0.05, ge=0)  # on training inputs, in standard deviations
    hidden_size: int = Field(128, ge=8, multiple_of=2)
    embed_dim: int = Field(32, ge=4)


class EvaluatorTask(Task):
    """What the trainer needs to know (src/train/task.py)."""

    def __init__(self, config: TrainEvaluatorConfig) -> None:
        self.config = config
        self.data = open_data(config.data, Path(config.output).parent)
        self.train = self._pairs("train", config.balance)
        # A folder of few takes keeps none for validation; training goes on without figures.
        self.held_back = self._pairs("val", 1.0) if self.data.records("val") else None
        self.retrieves = self.held_back is not None and can_retrieve(len(self.held_back.records))
        self.module = Evaluator(
            EvaluatorConfig(hidden_size=config.hidden_size, embed_dim=config.embed_dim)
        )
        assert isinstance(self.module, Evaluator)
        self.module.fit_statistics(self.train.frames())
        self.figures = {}

    def _pairs(self, split: str, balance: float) -> PairSet:
        config = self.config
        return PairSet(
            self.data,
            split,
            min_frames=config.min_frames,
            max_frames=config.max_frames,
            languages=config.languages,
            balance=balance,
        )

    def identity(self) -> dict[str, Any]:
        """A resumed run must see the same clips."""
        return {"data-hash": self.data.manifest_hash}

    def batch(self, part: Part) -> PairBatch:
        """A share of the step's batch; every part draws its own clips."""
        rng = np.random.default_rng(mix_seed("pairs", self.config.seed, part.step, part.index))
        pairs = self.train.batch(self.config.batch_size // part.count, rng)
        captions = [drop_words(text, self.config.word_dropout, rng) for text in pairs.captions]
        noise = torch.from_numpy(rng.standard_normal(pairs.joints.shape, dtype=np.float32))
        assert isinstance(self.module, Evaluator)
        scale = self.config.noise * self.module.motion.std.cpu()
        return replace(pairs, captions=captions, joints=pairs.joints + noise * scale)

    def training_step(self, module: nn.Module, batch: PairBatch) -> dict[str, Tensor]:
        """The loss and the factor on the cosines."""
        text, motion, scale = module(batch.captions, batch.joints, batch.mask)
        return {"loss": contrastive_loss(text, motion, batch.same, scale), "scale": scale}

    def validation(self, module: nn.Module) -> dict[str, float]:
        """R-precision of held-back real clips in batches of 32 (group-equal counts)."""
        if self.held_back is None:
            return {}
        module.eval()
        device = next(module.parameters()).device
        hits, losses = [], []
        for index in range(self.config.validation_batches):
            rng = np.random.default_rng(mix_seed("validation", index))
            pairs = self.held_back.batch(BATCH, rng)
            text, motion, scale = module(
                pairs.captions, pairs.joints.to(device), pairs.mask.to(device)
            )
            losses.append(contrastive_loss(text, motion, pairs.same.to(device), scale).item())
            group = [pairs.same[row].int().argmax().item() for row in range(BATCH)]
            arrays = text.cpu().float().numpy(), motion.cpu().float().numpy()
            hits.append(guo_retrieval(*arrays, [group, pairs.captions]).r_precision)
        module.train()
        if self.retrieves:
            mean = np.mean(hits, axis=0)
            self.figures = {f"r-at-{k}": float(mean[k - 1]) for k in TOP}
        return {"loss": float(np.mean(losses)), **self.figures}

    def save_pretrained(self, module: nn.Module, folder: Path) -> None:
        """Write the evaluator with what it was trained on."""
        assert isinstance(module, Evaluator)
        notes = {
            "data-hash": self.data.manifest_hash,
            "steps": self.config.steps,
            "seed": self.config.seed,
            "validation": self.figures,
            "groups": sorted({record.group for record in self.train.records}),
        }
        module.save_pretrained(folder, notes=notes)


app = Stage(
    TrainEvaluatorConfig,
    lambda config, _network: EvaluatorTask(config),  # the profile is of models it will judge
    "train_evaluator",
    "Train the evaluator: an independent text-motion model that scores generated motions.",
).app()

if __name__ == "__main__":
    app()
