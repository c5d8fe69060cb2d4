"""Hardening a trained text tower: more wordings, the same space, so that denoisers stay valid.

motion-tools train text clip=runs/clip [generator=runs/generation] [key=value ...]

Each label combination has a place in the space: the mean of its captions under the tower that was
there before. The tower learns to send fresh captions of that combination, with words missing and
made-up words put in, to the same place. The motion tower and the denoiser are not touched.

Letters: B batch, G label combinations, D shared dimensions.
"""

import copy
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import torch
from pydantic import Field
from torch import Tensor, nn
from torch.nn.functional import cross_entropy, normalize

from src.shared.config_schema import NetworkConfig, TrainConfig
from src.shared.data.captions import packaged_book
from src.shared.data.word_dropout import drop_words, insert_babble
from src.shared.errors import UserError
from src.shared.files import sha256_file
from src.shared.model.checkpoint import WEIGHTS_FILE
from src.shared.model.clip.core import TextTower
from src.shared.model.clip.pretrained import ClipBundle, encode_captions
from src.shared.model.generation.motion_generator import MotionGenerator
from src.train.launch import stage_app
from src.train.style_fit import fit_style_map
from src.train.task import Part
from src.train.text_motion import fit_scope, numpy_generator, open_training_data

OLD_CAPTIONS = 8  # of each combination and language, whose mean is its place
HELD_BACK_SEED = 1  # of the captions that validation reads; training reads those of seed 2


class TrainTextConfig(TrainConfig):
    """train_text.yaml."""

    clip: str = "runs/clip"  # folder written by train_clip
    generator: str | None = None  # a generator that gets the hardened tower in the output
    captions_per_group: int = Field(64, ge=1)  # fresh ones, of each combination and language
    word_dropout: float = Field(0.05, ge=0, lt=1)
    babble: float = Field(0.6, ge=0, le=1)  # share of captions with made-up words in them
    scale: float = Field(15.0, gt=0)  # factor on the cosines of the classification term


@dataclass(frozen=True)
class TextBatch:
    """input_ids, attention_mask [B,L]; group [B] index of the right place."""

    input_ids: Tensor
    attention_mask: Tensor
    group: Tensor


class TextTask:
    """What the trainer needs to know (src/train/task.py)."""

    def __init__(self, config: TrainTextConfig, network: NetworkConfig) -> None:
        self.config = config
        self.bundle = ClipBundle.from_pretrained(config.clip)
        self.tokenizer = self.bundle.tokenizer
        self.data = open_training_data(config, self.bundle.clip.config)
        records = self.data.records("train")
        self.labels = {record.group: record.labels for record in records if record.labels}
        if not self.labels:
            raise UserError(
                f"{config.data} has no labels to write fresh captions from; this stage needs them"
            )
        self.groups = sorted(self.labels)
        self.fresh = self._captions(HELD_BACK_SEED + 1, config.captions_per_group)
        self.held_back = self._captions(HELD_BACK_SEED, 2)
        self.places = self._places()
        tower = copy.deepcopy(self.bundle.clip.text)
        self.module: nn.Module = tower.train().requires_grad_(True)
        self.figures: dict[str, float] = {}

    def _captions(self, seed: int, num: int) -> list[dict[str, list[str]]]:
        book = packaged_book()
        kept = self.config.languages
        return [
            {
                k: v
                for k, v in book.captions(self.labels[g], num=num, seed=seed).items()
                if k in kept
            }
            for g in self.groups
        ]

    def _places(self) -> Tensor:
        """Unit mean [G,D] of each combination's old captions under the old tower."""
        captions = self._captions(0, OLD_CAPTIONS)
        texts = [text for group in captions for texts in group.values() for text in texts]
        owner = [i for i, group in enumerate(captions) for texts in group.values() for _ in texts]
        embeddings = encode_captions(self.bundle.clip.text.eval(), self.tokenizer, texts)
        places = torch.zeros(len(self.groups), embeddings.shape[1])
        return normalize(places.index_add_(0, torch.tensor(owner), embeddings), dim=-1)

    def identity(self) -> dict[str, Any]:
        """A resumed run must start from the same tower and see the same labels."""
        return {
            "data-hash": self.data.manifest_hash,
            "clip-hash": sha256_file(Path(self.config.clip) / WEIGHTS_FILE),
        }

    def to(self, device: torch.device) -> None:
        """The places follow the module."""
        self.places = self.places.to(device)

    def batch(self, part: Part) -> TextBatch:
        """Fresh captions, half of them damaged in some way; combinations and languages alike."""
        config = self.config
        rng = numpy_generator("text", config.seed, part.step, part.index)
        chosen = rng.integers(len(self.groups), size=config.batch_size)
        captions = []
        for group in chosen:
            by_language = self.fresh[group]
            language = config.languages[rng.integers(len(config.languages))]
            texts = by_language.get(language) or next(iter(by_language.values()))
            text = texts[rng.integers(len(texts))]
            if rng.random() < 0.5:
                text = drop_words(text, config.word_dropout, rng)
            if rng.random() < config.babble:
                other = self.fresh[rng.integers(len(self.fresh))].get(language, [text])
                text = insert_babble(text, other[rng.integers(len(other))], rng)
            captions.append(text)
        return TextBatch(*self.tokenizer(captions), torch.from_numpy(chosen))

    def training_step(self, module: nn.Module, batch: TextBatch) -> dict[str, Tensor]:
        """Distance to the right place, and its probability among all places."""
        pooled = module(batch.input_ids, batch.attention_mask).pooled  # [B, D]
        cosine = 1 - (pooled * self.places[batch.group]).sum(-1).mean()
        choice = cross_entropy(self.config.scale * pooled @ self.places.T, batch.group)
        return {"loss": cosine + 0.1 * choice, "cosine": cosine, "choice": choice}

    def validation(self, module: nn.Module) -> dict[str, float]:
        """Of captions that training did not read: how many land nearest to the right place."""
        assert isinstance(module, TextTower)
        module.eval()
        self.figures = {}
        for language in self.config.languages:
            pairs = [
                (t, i) for i, group in enumerate(self.held_back) for t in group.get(language, [])
            ]
            if not pairs:
                continue
            embeddings = encode_captions(module, self.tokenizer, [text for text, _ in pairs])
            nearest = (embeddings @ self.places.cpu().T).argmax(-1)
            right = nearest == torch.tensor([index for _, index in pairs])
            self.figures[f"right-{language}"] = right.float().mean().item()
        self.figures["right"] = sum(self.figures.values()) / max(len(self.figures), 1)
        module.train()
        return self.figures

    def export_samples(self, module: nn.Module, folder: Path) -> None:
        """A text tower makes nothing to look at."""

    def save_pretrained(self, module: nn.Module, folder: Path) -> None:
        """The CLIP folder with the new tower; or the generator with it and a new scope."""
        assert isinstance(module, TextTower)
        tower = module.cpu().freeze()
        hardened = {"steps": self.config.steps, "validation": self.figures}
        if self.config.generator is None:
            self.bundle.clip.text = tower
            self.bundle.card = _noted(self.bundle.card, hardened)
            self.bundle.save_pretrained(folder)
            return
        generator = MotionGenerator.from_pretrained(self.config.generator)
        generator.text = tower
        generator.scope = fit_scope(self.data, self.config.languages, tower, self.tokenizer)
        generator.style_map = fit_style_map(self.data, self.config.languages, tower, self.tokenizer)
        generator.card = _noted(generator.card, hardened)
        generator.save_pretrained(folder)


def _noted(card: Any, hardened: dict[str, Any]) -> Any:
    return card.model_copy(update={"training": {**card.training, "text-hardening": hardened}})


app = stage_app(
    TrainTextConfig,
    TextTask,
    "src.train.train_text",
    "Harden a trained text tower against wordings it never saw; its space stays as it is.",
)

if __name__ == "__main__":
    app()
