"""CLIP pretraining: a text tower and a motion tower learn one space (TEXT; ruling 20).

motion-tools train clip [key=value ...] [--resume]

The tokenizer is trained on the training captions when `clip.text-model` is "small". With `text=` a
text tower that train_text taught stays as it is, and the motion tower learns to meet it
(locked-tower tuning, Zhai et al. 2022, LiT). With several processes the contrastive loss sees the
embeddings of all of them.
"""

import math
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
import torch
import torch.distributed
from torch import Tensor, nn

from ..shared.config_schema import PAIRS, ClipConfig, NetworkConfig, TrainClipConfig
from ..shared.data.captions.book import drop_words
from ..shared.data.text_motion import TextMotionBatch
from ..shared.errors import UsageError
from ..shared.metrics.retrieval import BATCH, TOP, guo_retrieval
from ..shared.model.clip.core import MotionClip, clip_loss
from ..shared.model.clip.pretrained import KIND, ClipBundle, load_text_tower, tower_hash
from .launch import STAGES
from .task import Part, Task, numpy_generator
from .text_stages import (
    can_retrieve,
    encoder_rates,
    motion_rows,
    new_tokenizer,
    open_training_data,
    trained_card,
    training_clips,
    validation_set,
)


@dataclass(frozen=True)
class ClipBatch:
    """input_ids, attention_mask [B,L]; motion [B,T,R,6] normalised; mask [B,T]; groups [B]."""

    input_ids: Tensor
    attention_mask: Tensor
    motion: Tensor
    mask: Tensor
    groups: Tensor


class ClipObjective(nn.Module):
    """MotionClip with its temperature in the output, so that one call holds every weight (DDP)."""

    def __init__(self, clip: MotionClip) -> None:
        super().__init__()
        self.clip = clip

    def forward(self, batch: ClipBatch) -> tuple[Tensor, Tensor, Tensor]:
        """Text [B,D], motion [B,D], inverse temperature []."""
        text, motion = self.clip(batch.input_ids, batch.attention_mask, batch.motion, batch.mask)
        return text, motion, self.clip.scale()


class _Gather(torch.autograd.Function):
    """All processes' rows; a row's gradient is the sum of those every process found for it."""

    @staticmethod
    def forward(ctx: Any, values: Tensor) -> Tensor:
        parts = [torch.empty_like(values) for _ in range(torch.distributed.get_world_size())]
        torch.distributed.all_gather(parts, values)
        return torch.cat(parts)

    @staticmethod
    def backward(ctx: Any, *gradients: Tensor) -> Tensor:
        total = gradients[0].clone(memory_format=torch.contiguous_format)
        torch.distributed.all_reduce(total)
        return total.chunk(torch.distributed.get_world_size())[torch.distributed.get_rank()]


def gather(values: Tensor) -> Tensor:
    """Rows of all processes, in their order, with gradients; [B, ...] -> [W*B, ...].

    Every process then computes the same loss. The gradients that come back are summed over the
    W processes and averaged again by DDP: those of one process with the whole batch.
    """
    if not (torch.distributed.is_available() and torch.distributed.is_initialized()):
        return values
    gathered: Callable[[Tensor], Tensor] = _Gather.apply
    return gathered(values.contiguous())


class ClipTask(Task):
    """What the trainer needs to know (src/train/task.py)."""

    def __init__(self, config: TrainClipConfig, network: NetworkConfig) -> None:
        self.config, self.network = config, network
        self.data = open_training_data(config, network, stream=config.stream)
        self.train = training_clips(config, self.data)
        self.held_back = validation_set(config, self.data)
        self.retrieves = self.held_back is not None and can_retrieve(len(self.held_back))
        if config.text is None and network.clip.text_model == PAIRS:
            raise UsageError(
                f"clip.text-model {PAIRS} is made by `train text clip=null`;"
                " give that run's folder as text=FOLDER"
            )
        if config.text is None:
            self.tokenizer = new_tokenizer(network.clip, self._captions)
            clip = MotionClip(network)
        else:
            tower, self.tokenizer = load_text_tower(config.text, network.embed_dim)
            self.network = with_text_sizes(network, tower.config)
            clip = MotionClip(self.network, encoder_config=tower.encoder_config())
            clip.text = tower
        nn.init.constant_(clip.logit_scale, -math.log(config.temperature))
        self.learning_rates = encoder_rates(clip.text, "clip.text.", config.encoder_learning_rate)
        self.module = ClipObjective(clip)
        self.identity = {
            "network": self.network.model_dump(mode="json", by_alias=True),
            "data-hash": self.data.manifest_hash,
        }
        if config.text is not None:
            self.identity["tower-hash"] = tower_hash(clip.text)

    def _captions(self) -> list[str]:
        captions = self.data.all_captions("train")
        return [text for language in self.config.languages for text in captions.get(language, [])]

    def batch(self, part: Part) -> ClipBatch:
        """Clips with shortened captions."""
        clips = self.train.batch(
            part.step, self.config.batch_size, rank=part.index, count=part.count
        )
        rng = numpy_generator("words", self.config.seed, part.step, part.index)
        share = self.config.word_dropout
        return self._tokenized(clips, [drop_words(text, share, rng) for text in clips.captions])

    def _tokenized(self, clips: TextMotionBatch, captions: list[str]) -> ClipBatch:
        motion = motion_rows(clips.motion, self.network)
        return ClipBatch(*self.tokenizer(captions), motion, clips.mask, clips.group)

    def training_step(self, module: nn.Module, batch: ClipBatch) -> dict[str, Tensor]:
        """Contrastive and cosine loss over the batch of all processes."""
        text, motion, scale = module(batch)
        text, motion, groups = gather(text), gather(motion), gather(batch.groups)
        weight = self.config.cosine_weight
        losses = clip_loss(text, motion, groups, scale, cosine_weight=weight)
        return {**losses, "scale": scale}

    def validation(self, module: nn.Module) -> dict[str, float]:
        """Loss of held-back clips; R@k in batches of 32, beside what guessing gives."""
        if self.held_back is None:
            return {}
        device = next(module.parameters()).device
        texts, motions, captions, groups, losses = [], [], [], [], []
        size = max(BATCH, self.config.batch_size)
        for clips in self.held_back.fixed_batches(size, self.config.validation_batches):
            batch = self._tokenized(clips, clips.captions)
            batch = ClipBatch(*(value.to(device) for value in vars(batch).values()))
            text, motion, scale = module(batch)
            weight = self.config.cosine_weight
            loss = clip_loss(text, motion, batch.groups, scale, cosine_weight=weight)["loss"]
            losses.append(loss.item())
            texts.append(text.cpu().float())
            motions.append(motion.cpu().float())
            captions += clips.captions
            groups += clips.group.tolist()
        figures = {"loss": sum(losses) / len(losses)}
        if self.retrieves:
            columns, blind = [groups, captions], np.zeros((len(groups), 1))  # every distance a tie
            text, motion = torch.cat(texts).numpy(), torch.cat(motions).numpy()
            found = guo_retrieval(text, motion, columns).mean(1).tolist()
            guessed = guo_retrieval(blind, blind, columns).mean(1).tolist()
            for k, value, chance in zip(TOP, found, guessed, strict=True):
                figures |= {f"r-at-{k}": value, f"chance-at-{k}": chance}
        return figures

    def save_pretrained(self, module: nn.Module, folder: Path) -> None:
        """Both towers, tokenizer and statistics: the folder that train_generation reads."""
        assert isinstance(module, ClipObjective)
        card = trained_card(
            KIND,
            self.config,
            self.network,
            self.data,
            max_seconds=self.config.max_frames / 30.0,
            training={"steps": self.config.steps, "validation": self.figures},
        )
        mean, std = (motion_rows(v, self.network) for v in (self.data.mean, self.data.std))
        ClipBundle(module.clip, self.tokenizer, mean, std, card).save_pretrained(folder)


def with_text_sizes(network: NetworkConfig, tower: ClipConfig) -> NetworkConfig:
    """The network with another text tower's sizes, which only its training knows."""
    text = {name for name in ClipConfig.model_fields if not name.startswith("motion_")}
    sizes = tower.model_dump(include=text)
    return network.model_copy(update={"clip": network.clip.model_copy(update=sizes)})


if __name__ == "__main__":
    STAGES["clip"].app()()
