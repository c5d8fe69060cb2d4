"""Memory training: a trained audio model learns to hear a memory (REF's MPMS; ruling 26).

motion-tools train memory [--audio FOLDER] --memory FOLDER_OR_URL --data DIR_OR_URL
[--space FOLDER] [key=value ...] [--resume]

Each window asks the memory with its own sound, and never finds its own song, nor another song that
was paired with one of its clips: that would tell what is to be learned. What was there before
rests, unless `base-learning-rate` is set: without a memory the model stays what it was, to the bit.

Letters: B batch, T frames.
"""

from collections import defaultdict
from dataclasses import replace
from functools import partial
from pathlib import Path
from typing import Any

import torch
from torch import Tensor, nn

from ..shared.config_audio import AudioNetworkConfig, TrainMemoryConfig
from ..shared.data.phrases.dataset import PhraseBatch, PhraseItem
from ..shared.data.phrases.layout import PhraseRecord
from ..shared.errors import UsageError
from ..shared.memory.query import retrieve
from ..shared.memory.service import MPMService
from ..shared.model.audio.audio_motion_model import AudioMotionModel
from ..shared.model.audio.conditioning import MemoryCondition, known_frames
from ..shared.motion.trajectory import MotionTrajectory
from ..shared.pipelines.song import AudioCondition
from ..shared.pipelines.song_memory import as_condition, bars_of_sound, open_memory, remembering
from ..shared.pipelines.song_sampler import SongSampler
from . import audio_stages
from .audio_stages import save_noted
from .launch import STAGES
from .train_audio import AudioBatch, AudioTask


class Forgetful(nn.Module):
    """A UNet1D that is told of no memory."""

    def __init__(self, unet: nn.Module) -> None:
        super().__init__()
        self.unet = unet

    def forward(self, x: Tensor, t: Tensor, condition: Tensor, drop: Any, memory: Any) -> Tensor:
        """As `UNet1D.forward`."""
        prediction: Tensor = self.unet(x, t, condition, drop)
        return prediction


class MemoryTask(AudioTask):
    """What the trainer needs to know (src/train/task.py); batches as in audio training."""

    config: TrainMemoryConfig

    def __init__(self, config: TrainMemoryConfig, network: AudioNetworkConfig) -> None:
        if config.target_frames != network.window:
            raise UsageError(
                f"target-frames {config.target_frames}: {config.audio} learned windows of"
                f" {network.window} frames; set it to that"
            )
        self.index, self.space = open_memory(config.memory.folder, config.space)
        self._songs_of_clip: dict[str, set[str]] = defaultdict(set)
        for number, clip in enumerate(self.index.clips):
            self._songs_of_clip[clip].add(self.index.song_of(number))
        super().__init__(config, network)
        rates = {"memory.": config.learning_rate, "": config.base_learning_rate}
        self.learning_rates = {} if config.base_learning_rate == 0 else rates
        assert self.source.weights is not None
        self.identity |= {
            "weights": self.source.weights.sha256,
            "space": self.space.fingerprint,
            "memory": self.index.about,
        }

    def _start(self) -> AudioMotionModel:
        model = AudioMotionModel.from_pretrained(self.config.audio)
        self.source = model.card
        if model.unet.memory is None:
            model.add_memory(self.config.part)
        assert model.unet.memory is not None
        if self.config.base_learning_rate == 0:
            model.unet.requires_grad_(False)
            for layer in model.unet.modules():
                if isinstance(layer, nn.Dropout):  # what does not learn needs none
                    layer.p = 0.0
        model.unet.memory.requires_grad_(True)
        self.network = model.config
        return model

    # ------------------------------------------------------------ batches

    def _drawn(self, phrases: PhraseBatch, draws: torch.Generator) -> AudioBatch:
        batch: AudioBatch = super()._drawn(phrases, draws)
        assert batch.memory is not None
        forgotten = torch.rand(len(phrases), generator=draws) < self.config.memory_dropout
        return replace(batch, memory=batch.memory.without(forgotten))

    def _noised(self, phrases: PhraseBatch, *drawn: Any) -> AudioBatch:
        batch = super()._noised(phrases, *drawn)
        recent = known_frames(batch.clean, batch.known)
        return replace(batch, memory=replace(self.recall(phrases), recent=recent))

    @torch.no_grad()
    def recall(self, phrases: PhraseBatch) -> MemoryCondition:
        """Each window's own question, what it must not find left out of the answers."""
        return as_condition(
            retrieve(
                self.index,
                self.space.embed_audio(phrases.audio, phrases.mask),
                self.config.memory,
                num_frames=phrases.audio.shape[-1],
                phase=bars_of_sound(phrases.audio),
                exclude_songs=[self.excluded(record) for record in phrases.records],
            )
        )

    def excluded(self, record: PhraseRecord) -> set[str]:
        """The phrase's song, and songs that share a clip with it."""
        sharing = (self._songs_of_clip.get(clip, set()) for clip in record.clips)
        return {record.song or record.id}.union(*sharing)

    # ------------------------------------------------------------ results

    def validation(self, module: nn.Module) -> dict[str, float]:
        """As audio training's, with memory; figures without it stand beside."""
        without = super().validation(Forgetful(module))
        found = super().validation(module)
        return found | {f"without-{key}": value for key, value in without.items()}

    def _sample(self, model: AudioMotionModel, item: PhraseItem) -> MotionTrajectory:
        """With memory."""
        bars, _ = AudioCondition(item.audio).time() or (None, None)
        sampler, service = SongSampler(model), MPMService(self.config.memory, self.index)
        recall = remembering(service, self.space, sampler, item.audio, bars, {item.record.song})
        return sampler.sample(item.audio, phase=bars, recall=recall)[0]

    def save_pretrained(self, module: nn.Module, folder: Path) -> None:
        """A folder like the one that was read, which hears a memory too."""
        trained = {"steps": self.config.steps, "validation": self.figures}
        training = {**self.source.training, "memory": trained}
        save_noted(self._finished(module), folder, training=training)


network_of = partial(audio_stages.network_of, of="--audio; see part.*")


if __name__ == "__main__":
    STAGES["memory"].app()()
