"""Training of the evaluator: multi-positive contrastive, on the train split only.

motion-tools train evaluator [key=value ...] [--resume]
"""

from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np
import torch
from torch import Tensor, nn

from ..shared.config_schema import TrainConfig, TrainEvaluatorConfig
from ..shared.data.captions.book import drop_words
from ..shared.data.prepare import open_data
from ..shared.data.prepared import PreparedData
from ..shared.errors import UserError
from ..shared.metrics.retrieval import BATCH, TOP, guo_retrieval
from ..shared.model.evaluator import Evaluator, EvaluatorConfig, joint_features, padded
from .launch import STAGES
from .task import Part, Task, mix_seed
from .text_stages import can_retrieve

CHUNK = 256  # clips whose kinematics are computed at once


@dataclass(frozen=True)
class PairBatch:
    """Captions with motions; `same` [B, B] marks the pairs that belong together."""

    captions: list[str]
    joints: Tensor  # [B, T, F]
    mask: Tensor  # [B, T] bool, true on real frames
    same: Tensor  # [B, B] bool


class PairSet:
    """Captioned clips of one split.

    Args:
        data: prepared clips.
        split: which of them.
        config: shorter clips than min-frames are left out, of longer ones than max-frames a window
            is taken; languages of the captions to draw from.
        balance: 0 draws every clip alike, 1 every label group alike.

    Raises:
        UserError: no clip of the split is long enough and has a caption in these languages.
    """

    def __init__(
        self, data: PreparedData, split: str, config: TrainConfig, balance: float = 0.5
    ) -> None:
        self.max_frames, self.languages = config.max_frames, config.languages
        self.records = [r for r in data.records(split) if r.num_frames >= config.min_frames]
        spoken = [data.captions(record) for record in self.records]
        usable = [any(texts.get(k) for k in self.languages) for texts in spoken]
        self.records = [r for r, ok in zip(self.records, usable, strict=True) if ok]
        self.captions = [texts for texts, ok in zip(spoken, usable, strict=True) if ok]
        if not self.records:
            raise UserError(
                f"split {split!r} holds no clip of {config.min_frames} frames or more"
                f" with captions in {', '.join(self.languages)}"
            )
        self.joints: list[Tensor] = []
        for start in range(0, len(self.records), CHUNK):  # kinematics need room: a part at a time
            some = [data.features(record).float() for record in self.records[start : start + CHUNK]]
            self.joints += [joints.half() for joints in joint_features(some)]
        names = sorted({record.group for record in self.records})
        lookup = {name: index for index, name in enumerate(names)}
        self.groups = np.array([lookup[record.group] for record in self.records])
        size = np.bincount(self.groups)[self.groups].astype(np.float64)
        self.weights = size**-balance / (size**-balance).sum()

    def __len__(self) -> int:
        return len(self.records)

    def frames(self, limit: int = 200_000) -> Tensor:
        """Up to about `limit` evenly spaced frames [N, F] in float32, for statistics."""
        frames = torch.cat(self.joints)
        return frames[:: max(1, len(frames) // limit)].float()

    def batch(self, size: int, rng: np.random.Generator) -> PairBatch:
        """`size` clips, each with one caption in one language, all drawn from `rng`."""
        rows = rng.choice(len(self), size=size, p=self.weights)
        captions = [self._caption(row, rng) for row in rows]
        clips = [self._window(self.joints[row], rng) for row in rows]
        joints, mask = padded(clips)
        group = torch.from_numpy(self.groups[rows])
        text = torch.from_numpy(np.unique(captions, return_inverse=True)[1])
        same = (group[:, None] == group[None]) | (text[:, None] == text[None])
        return PairBatch(captions, joints.float(), mask, same)

    def _caption(self, row: int, rng: np.random.Generator) -> str:
        captions = self.captions[row]
        spoken = [language for language in self.languages if captions.get(language)]
        choices = captions[spoken[int(rng.integers(len(spoken)))]]
        return choices[int(rng.integers(len(choices)))]

    def _window(self, joints: Tensor, rng: np.random.Generator) -> Tensor:
        """The whole clip, or a window of the longest length allowed; half begin at the start."""
        spare = len(joints) - self.max_frames
        start = int(rng.integers(spare + 1)) if spare > 0 and rng.random() < 0.5 else 0
        return joints[start : start + self.max_frames]


def contrastive_loss(text: Tensor, motion: Tensor, same: Tensor, scale: Tensor | float) -> Tensor:
    """Symmetric InfoNCE with several positives a row (SupCon, Khosla et al. 2020, eq. 2).

    Args:
        text, motion: [B, D] unit vectors.
        same: [B, B] bool, pairs that belong together; true on the diagonal.
        scale: factor on the cosines (1 / temperature).
    """
    logits = scale * text @ motion.T  # [B, B]
    target = same.to(logits.dtype)
    rows = -(logits.log_softmax(1) * target / target.sum(1, keepdim=True)).sum(1)
    columns = -(logits.log_softmax(0) * target / target.sum(0, keepdim=True)).sum(0)
    return (rows.mean() + columns.mean()) / 2


class EvaluatorTask(Task):
    """What the trainer needs to know (src/train/task.py)."""

    def __init__(self, config: TrainEvaluatorConfig) -> None:
        self.config = config
        self.data = open_data(config.data, Path(config.output).parent)
        self.train = PairSet(self.data, "train", config, config.balance)
        # A folder of few takes keeps none for validation; training goes on without figures.
        held_back = self.data.records("val")
        self.held_back = PairSet(self.data, "val", config, 1.0) if held_back else None
        self.retrieves = self.held_back is not None and can_retrieve(len(self.held_back.records))
        self.module = Evaluator(
            EvaluatorConfig(hidden_size=config.hidden_size, embed_dim=config.embed_dim)
        )
        assert isinstance(self.module, Evaluator)
        self.module.fit_statistics(self.train.frames())
        self.identity = {"data-hash": self.data.manifest_hash}

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
            hits.append(guo_retrieval(*arrays, [group, pairs.captions]).mean(1))
        module.train()
        figures = {"loss": float(np.mean(losses))}
        if self.retrieves:
            mean = np.mean(hits, axis=0)
            figures |= {f"r-at-{k}": float(mean[k - 1]) for k in TOP}
        return figures

    def save_pretrained(self, module: nn.Module, folder: Path) -> None:
        """Write the evaluator with what it was trained on."""
        assert isinstance(module, Evaluator)
        notes = {
            "data-hash": self.data.manifest_hash,
            "steps": self.config.steps,
            "seed": self.config.seed,
            "validation": {key: value for key, value in self.figures.items() if key != "loss"},
            "groups": sorted({record.group for record in self.train.records}),
        }
        module.save_pretrained(folder, notes=notes)


def task_of(config: TrainEvaluatorConfig, _network: object) -> EvaluatorTask:
    """The stage's task; the profile it is told is that of the models it will judge."""
    return EvaluatorTask(config)


if __name__ == "__main__":
    STAGES["evaluator"].app()()
