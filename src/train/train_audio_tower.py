"""Audio tower: sound learns the place of the motion it was paired with, in a space that is fixed.

motion-tools train audio-tower data=PAIRS clip=runs/clip [key=value ...]

Windows of a few bars, cut at bars. A batch holds several windows of each phrase, all of them
right for one another. Phrases of the same song, or that show the same clip, are no negatives.
Each phrase is also seen a little faster and slower, so that there is a motion for every tempo.

Letters: B windows, C = 167 rows of sound, T frames, D embed dim, L clips of a phrase at most.
"""

import copy
import math
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import torch
from torch import Tensor, nn

from ..shared.config_audio import TrainAudioTowerConfig
from ..shared.config_schema import NetworkConfig
from ..shared.data.phrases.dataset import MotionPhraseDataset, sound_statistics
from ..shared.data.phrases.layout import PhraseRecord
from ..shared.evaluation.suites.space import Bench, Windows
from ..shared.metrics.retrieval import BATCH
from ..shared.model.audio.conditioning import ConditionAugmentation
from ..shared.model.audio.shared_space import AudioTower, SharedSpace
from ..shared.model.clip.core import MAX_LOGIT_SCALE, clip_loss
from ..shared.model.clip.pretrained import ClipBundle
from ..shared.motion.trajectory import FPS
from .audio_stages import open_held_back, open_phrases
from .launch import STAGES
from .run_log import announce
from .task import Part, Task, generator, numpy_generator
from .train_clip import gather


@dataclass(frozen=True)
class SpaceBatch:
    """audio [B,167,T] standardised and augmented, mask [B,T]; motion [B,D]; phrase, song [B];
    clips [B,L], -1 = none."""

    audio: Tensor
    mask: Tensor
    motion: Tensor
    phrase: Tensor
    song: Tensor
    clips: Tensor


class AudioTowerObjective(nn.Module):
    """The tower with its temperature in the output, so that one call holds every weight (DDP)."""

    def __init__(self, tower: AudioTower, temperature: float) -> None:
        super().__init__()
        self.tower = tower
        self.logit_scale = nn.Parameter(torch.tensor(-math.log(temperature)))

    def forward(self, batch: SpaceBatch) -> tuple[Tensor, Tensor]:
        """Sound [B,D], inverse temperature []."""
        return self.tower.embed(batch.audio, batch.mask), self.logit_scale.clamp(
            max=MAX_LOGIT_SCALE
        ).exp()


def kin(song: Tensor, clips: Tensor) -> Tensor:
    """Which windows [B,B] bool are of one song or share a clip: song [B], clips [B,L]."""
    shared = (clips[:, None, :, None] == clips[None, :, None, :]) & (clips >= 0)[:, None, :, None]
    return (song[:, None] == song[None]) | shared.flatten(2).any(dim=2)


class AudioTowerTask(Task):
    """What the trainer needs to know (src/train/task.py)."""

    def __init__(self, config: TrainAudioTowerConfig, network: NetworkConfig) -> None:
        self.config = config
        bundle = ClipBundle.from_pretrained(config.clip)
        self.space = SharedSpace.beside(bundle, config.tower)
        dataset = open_phrases(config, "train", config.num_phrases, bodies=True)
        self.space.audio.set_statistics(*sound_statistics(dataset))
        self.train = _windows(config, dataset, step=1, copies=config.copies)
        self.motion = self.train.embed_bodies(self.space.embed_motion)  # N D
        self.song, self.clips = _numbered(self.train.records)
        self.held_back = _windows(config, open_held_back(config, bodies=True))
        self.held_back_motion = self.held_back.embed_bodies(self.space.embed_motion)
        if (number := len(self.held_back.records)) < BATCH:
            announce(
                f"only {number} phrases to validate with: R@k and ranks among so few mean little,"
                " whatever they are"
            )
        self.bench = Bench.draw(self.held_back, replications=config.validation_batches)
        self.augment = ConditionAugmentation(config.tower.augmentation)
        # a copy: the space of the task gets the averaged weights
        tower = copy.deepcopy(self.space.audio)
        self.module = AudioTowerObjective(tower, config.temperature)
        self.identity = {
            "tower": self.space.config.model_dump(mode="json", by_alias=True),
            "text-tower": self.space.card.text_tower,
            "data-hash": dataset.fingerprint,
        }

    def batch(self, part: Part) -> SpaceBatch:
        """Windows of phrases drawn at random, `windows` of each."""
        rng = numpy_generator("windows", self.config.seed, part.step, part.index)
        number = min(max(self.config.batch_size // self.config.windows, 2), len(self.train.records))
        phrases = rng.choice(len(self.train.records), number, replace=False)
        index = [
            int(window)
            for phrase in phrases
            for window in rng.choice(self.train.of_phrase[phrase], self.config.windows)
        ]
        condition, mask = self.train.sounds(index)
        draws = generator("noise", self.config.seed, part.step, part.index)
        rows = self.augment(self.space.audio.standardise(condition), draws)
        owner = torch.tensor([self.train.items[i].phrase for i in index])
        return SpaceBatch(
            rows * mask[:, None],
            mask,
            self.motion[index],
            owner,
            self.song[owner],
            self.clips[owner],
        )

    def training_step(self, module: nn.Module, batch: SpaceBatch) -> dict[str, Tensor]:
        """Contrastive loss over the windows of all processes."""
        audio, scale = module(batch)
        audio, motion = gather(audio), gather(batch.motion)
        phrase, song, clips = (gather(v) for v in (batch.phrase, batch.song, batch.clips))
        losses = clip_loss(
            audio,
            motion,
            phrase,
            scale,
            cosine_weight=self.config.cosine_weight,
            left_out=kin(song, clips),
        )
        return {**losses, "scale": scale}

    def validation(self, module: nn.Module) -> dict[str, float]:
        """Sound finds its motion among held-back phrases; beside it what guessing gives."""
        assert isinstance(module, AudioTowerObjective)
        device = next(module.parameters()).device
        audio = self.held_back.embed_sounds(module.tower, device)
        found = self.bench.measure(audio, self.held_back_motion)
        chance = self.bench.measure(audio, self.held_back_motion, shuffled=True)
        return {
            prefix + name.replace("_", "-"): figure.value
            for prefix, figures in (("", found), ("chance-", chance))
            for name, figure in figures.items()
        }

    def save_pretrained(self, module: nn.Module, folder: Path) -> None:
        """Both towers: the folder that `memory build` reads."""
        assert isinstance(module, AudioTowerObjective)
        self.space.audio.load_state_dict(module.tower.state_dict())
        self.space.card = self.space.card.model_copy(
            update={
                "name": folder.name,
                "trained": True,
                "max_seconds": self.config.max_frames / FPS,
                "data": self.identity["data-hash"],
                "training": {"steps": self.config.steps, "validation": self.figures},
            }
        )
        self.space.save_pretrained(folder)


def _windows(
    config: TrainAudioTowerConfig,
    dataset: MotionPhraseDataset,
    *,
    step: int | None = None,
    copies: int = 0,
) -> Windows:
    def rates(number: int) -> list[float]:
        drawn = numpy_generator("rates", config.seed, number).uniform(-1, 1, copies)
        return [1.0, *((1 + config.stretch) ** drawn).tolist()]

    return Windows.cut(
        dataset,
        bars=config.bars,
        step=step,
        min_frames=config.min_frames,
        max_frames=config.max_frames,
        rates=rates,
    )


def _numbered(records: Sequence[PhraseRecord]) -> tuple[Tensor, Tensor]:
    """Song [P] and clips [P,L] of phrases as numbers; -1 fills up."""
    songs = {name: n for n, name in enumerate(sorted({r.song or r.id for r in records}))}
    clips = {name: n for n, name in enumerate(sorted({c for r in records for c in r.clips}))}
    most = max(1, *(len(record.clips) for record in records))
    table = torch.full((len(records), most), -1)
    for row, record in zip(table, records, strict=True):
        row[: len(record.clips)] = torch.tensor([clips[name] for name in record.clips])
    return torch.tensor([songs[record.song or record.id] for record in records]), table


if __name__ == "__main__":
    STAGES["audio-tower"].app()()
