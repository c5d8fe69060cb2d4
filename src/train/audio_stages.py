"""What audio stages share: phrases in whole windows, what decoders find, the network gone on from.

Letters: B batch, T frames, C rows of sound.
"""

import math
from abc import abstractmethod
from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path
from typing import Any

import torch
from torch import Tensor, nn
from torch.nn import functional as F

from ..shared.config_audio import AudioNetworkConfig, PhraseConfig
from ..shared.config_loader import NETWORK_PREFIX, dump_config, load_config
from ..shared.data.pairing.music import open_music
from ..shared.data.pairing.prepare_audio import PairOptions, prepare_audio
from ..shared.data.phrases.dataset import EmptySplit, MotionPhraseDataset, PhraseBatch, PhraseItem
from ..shared.data.prepare import open_data
from ..shared.data.prepared import SYNTHETIC
from ..shared.errors import UsageError
from ..shared.formats.registry import write_trajectory
from ..shared.io.files import sole_writer
from ..shared.model.audio import BEAT, CONDITION_ROWS, MIN_FRAMES
from ..shared.model.audio.audio_motion_model import KIND, AudioMotionModel
from ..shared.model.audio.decoder import wrapped_phase
from ..shared.model.checkpoint import read_card, resolve_model, wrong_kind
from ..shared.motion.trajectory import PHASE, MotionTrajectory
from ..shared.pipelines.song_sampler import SongSampler
from .run_log import announce, console
from .task import Part, Task, generator

SYNTHETIC_SONGS = 40


def open_phrases(
    config: PhraseConfig, split: str, num_phrases: int | None, *, bodies: bool = False
) -> MotionPhraseDataset:
    """One split of the folder or bucket that `data` names; `synthetic` is made on the spot, once.

    Raises:
        UserError: it cannot be read, has no phrase of this split, or no `bodies`.
    """
    root = config.data
    if root == SYNTHETIC:
        root = str(synthetic_pairs(Path(config.output).parent / f"synthetic-{SYNTHETIC_SONGS}"))
    return MotionPhraseDataset(
        root,
        num_phrases=num_phrases,
        target_frames=config.target_frames,
        split=split,
        bodies=bodies,
        seed=config.seed,
    )


def open_held_back(config: PhraseConfig, *, bodies: bool = False) -> MotionPhraseDataset:
    """The split `val`; where nothing is held back the training phrases, with a word on stderr.

    Raises:
        UserError: as `open_phrases`.
    """
    try:
        return open_phrases(config, "val", None, bodies=bodies)
    except EmptySplit:
        announce(
            "no phrases are held back: validation reads training phrases, so that its figures say"
            " nothing of other songs"
        )
        return open_phrases(config, "train", config.num_phrases, bodies=bodies)


def synthetic_pairs(folder: Path) -> Path:
    """Parametric motions paired with rendered songs, all the project's own."""
    console.print(f"pairing synthetic motions with synthetic songs in {folder}", markup=False)
    with sole_writer(folder, wait=True):
        prepare_audio(
            open_data(SYNTHETIC, folder / ".motion"),
            open_music([f"{SYNTHETIC}:{SYNTHETIC_SONGS}"], seed=0),
            folder,
            options=PairOptions(synthetic_clips=True),
        )
    return folder


def whole_windows(phrases: PhraseBatch) -> PhraseBatch:
    """The batch cut to the length of its shortest phrase: every frame is real."""
    frames = max(int(phrases.mask.sum(dim=1).min()), MIN_FRAMES)
    return replace(
        phrases,
        motion=phrases.motion[..., :frames],
        audio=phrases.audio[..., :frames],
        mask=phrases.mask[:, :frames],
    )


def bar_phase_at_start(audio: Tensor) -> tuple[Tensor, Tensor]:
    """Sound [B,C,T] -> bar phase of the first frame [B], 0 where unknown; which are known [B]."""
    if audio.shape[1] < CONDITION_ROWS:
        return torch.zeros(len(audio)), torch.zeros(len(audio), dtype=torch.bool)
    cosine, sine = audio[:, BEAT][:, 2:, 0].unbind(dim=1)  # [B] each
    return torch.atan2(sine, cosine) / (2 * math.pi), torch.hypot(cosine, sine) > 0.5


def true_trajectory(motion: Tensor, start: Tensor) -> Tensor:
    """Windows [B,25,T] as the dataset has them, first bar phase [B] -> trajectories [B,T,25]."""
    trajectory = motion.transpose(1, 2).clone()
    bars = F.pad(trajectory[:, :-1, PHASE].cumsum(dim=1), (1, 0))  # increment t leads to t + 1
    trajectory[..., PHASE] = wrapped_phase(start[:, None] + bars)
    return trajectory


def save_noted(model: AudioMotionModel, folder: Path, **noted: Any) -> None:
    """Write a model with these entries of its card, named after its folder."""
    model.card = model.card.model_copy(update={"name": folder.name, **noted})
    model.save_pretrained(folder)


class PhraseTask(Task):
    """A task that learns trajectories from sound, in windows of phrases.

    Attributes:
        train, held_back: the phrases.
        model: on the CPU; the module holds what is trained of it.
    """

    config: PhraseConfig
    train: MotionPhraseDataset
    held_back: MotionPhraseDataset
    model: AudioMotionModel

    def batch(self, part: Part) -> Any:
        """Windows with what is drawn for them."""
        size, draws = self.config.batch_size, ("noise", self.config.seed, part.step, part.index)
        phrases = self.train.batch(part.step, size, index=part.index, count=part.count)
        return self._drawn(phrases, generator(*draws))

    @abstractmethod
    def _drawn(self, phrases: PhraseBatch, draws: torch.Generator) -> Any:
        """A training batch of these phrases."""

    @abstractmethod
    def _finished(self, module: nn.Module) -> AudioMotionModel:
        """The model with the weights of a module."""

    def export_samples(self, module: nn.Module, folder: Path) -> None:
        """A held-back phrase's sound, made into a trajectory: a picture of it."""
        item, model = self.held_back.item(0, 0), self._finished(module)
        if item is not None:
            folder.mkdir(parents=True, exist_ok=True)
            write_trajectory(self._sample(model, item), folder / "held-back.png")

    def _sample(self, model: AudioMotionModel, item: PhraseItem) -> MotionTrajectory:
        """A trajectory for the sound of a phrase."""
        return SongSampler(model).sample(item.audio)[0]


DECODER_PREFIX = NETWORK_PREFIX + "decoder."


def network_of(
    name_or_folder: str | Path, overrides: Sequence[str] = (), *, of: str | None = None
) -> AudioNetworkConfig:
    """The network of a trained model.

    Args:
        name_or_folder: as `AudioMotionModel.from_pretrained` takes it.
        overrides: `network.decoder.…=…`; what is trained already cannot change.
        of: the flags that name it, where its decoder is trained, too.

    Raises:
        UserError: no audio model there.
        UsageError: an override of a trained part, an unknown key or a wrong value.
    """
    folder = resolve_model(name_or_folder)
    card = read_card(folder)
    if card.kind != KIND or card.audio_network is None:
        raise wrong_kind(folder, card.kind, KIND)
    for override in overrides:
        if of is not None:
            raise UsageError(f"{override}: the network is that of {of}; leave it out")
        if not override.startswith(DECODER_PREFIX):
            raise UsageError(
                f"{override}: the network is that of {folder}; only {DECODER_PREFIX}* can change"
                "; leave the rest out"
            )
    values = dump_config(card.audio_network)
    return load_config(AudioNetworkConfig, values, str(folder), overrides, prefix=NETWORK_PREFIX)
