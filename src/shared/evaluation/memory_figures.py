"""What a memory is measured by: how well real motion is denoised, what is made of held-out songs.

Letters: N phrases or songs, B of a batch, T frames.
"""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from typing import Protocol

import numpy as np
import torch
from torch import Tensor

from ..data.phrases.dataset import PhraseBatch, PhraseItem, collate
from ..memory.build import Space
from ..memory.priors import prior_curves
from ..model.audio.audio_motion_model import AudioMotionModel
from ..model.audio.conditioning import MemoryCondition
from ..model.diffusion.samplers import standard_normal
from ..motion.trajectory import MotionTrajectory
from ..motion.window import place_window
from ..pipelines.song_memory import bars_of_sound, bars_of_window
from ..pipelines.song_sampler import SPARE, Recall, SongSampler, SongSampling
from .audio_songs import Piece, open_split
from .families_audio import BeatAlignment, TrajectorySanity
from .memory_arms import Arm, Asker
from .report.tables import Column
from .samples import Dance, DanceSample

Values = dict[str, np.ndarray]  # column -> one figure for each phrase or song [N]
BATCH = 16
LEVELS = ("low", "middle", "high")  # thirds of the diffusion's steps
DENOISING = tuple(
    Column(level, f"{level} noise" if level != "all" else level, 4, better="low")
    for level in (*LEVELS, "all")
)
CURVES = tuple(
    Column(name, name, 4, better="low") for name in ("energy", "density", "tension", "stability")
)
SONG_FAMILIES = (BeatAlignment(), TrajectorySanity())
RHYTHM = ("motion_to_music", "music_to_motion", "f", "f_above_turned")
SONGS = tuple(
    column
    for family in SONG_FAMILIES
    for column in family.columns
    if column.key in RHYTHM or isinstance(family, TrajectorySanity)
)


class Figures(Protocol):
    """A way to measure an arm.

    Attributes:
        name: of its table.
        columns: of it.
        clusters: song of each of the N figures: what is drawn again together.
    """

    name: str
    columns: tuple[Column, ...]
    clusters: list[str]

    def measure(self, arm: Arm) -> Values:
        """Figures [N] of one arm."""


@dataclass(frozen=True)
class Setting:
    """The model, its memory and the space; the seed of noise."""

    model: AudioMotionModel
    space: Space
    asker: Asker
    sampled: SongSampling


# ---------------------------------------------------------------- held-back phrases


def held_back(
    data: str, splits: Sequence[str], frames: int, most: int, seed: int
) -> list[PhraseItem]:
    """Up to `most` windows without padding, a split after the other.

    Raises:
        UserError: a split is missing.
    """
    found: list[PhraseItem] = []
    for split in splits:
        dataset = open_split(data, split, frames, seed)
        items = (dataset.item(int(index), 0) for index in dataset.order(0))
        found += [item for item in items if item is not None and bool(item.mask.all())]
    return found[:most]


def batches(items: Sequence[PhraseItem]) -> Iterator[PhraseBatch]:
    """All, a few at a time."""
    for start in range(0, len(items), BATCH):
        yield collate(items[start : start + BATCH])


def songs_of(phrases: PhraseBatch) -> list[str]:
    """The song of each."""
    return [record.song or record.id for record in phrases.records]


class Denoising:
    """Mean squared error of the predicted clean window, in z-scores, at three levels of noise.

    Every arm sees the same noise. The finest of the three tables: it judges the network where it
    knows what is right, not one of the many dances that fit a song.
    """

    name = "error of denoising real motion"
    columns = DENOISING

    def __init__(self, setting: Setting, items: Sequence[PhraseItem], draws: int) -> None:
        self.setting, self.items, self.draws = setting, items, draws
        self.clusters = [item.record.song or item.record.id for item in items]

    @torch.no_grad()
    def measure(self, arm: Arm) -> Values:
        """Figures [N] of one arm."""
        found: dict[str, list[Tensor]] = {level: [] for level in LEVELS}
        for number, phrases in enumerate(batches(self.items)):
            memory = self._remembered(arm, phrases, number)
            for third, level in enumerate(LEVELS):
                errors = [
                    self._error(phrases, memory, third, (number, third, draw))
                    for draw in range(self.draws)
                ]
                found[level].append(torch.stack(errors).mean(dim=0))
        values = {level: torch.cat(each).double().numpy() for level, each in found.items()}
        return values | {"all": np.mean(list(values.values()), axis=0)}

    def _remembered(self, arm: Arm, phrases: PhraseBatch, draw: int) -> MemoryCondition | None:
        setting, frames = self.setting, phrases.audio.shape[-1]
        query, bars = setting.space.embed_audio(phrases.audio), bars_of_sound(phrases.audio)
        return setting.asker.answer(arm, query, bars, frames, songs_of(phrases), draw=draw)

    def _error(
        self,
        phrases: PhraseBatch,
        memory: MemoryCondition | None,
        third: int,
        place: tuple[int, ...],
    ) -> Tensor:
        """[B] of one draw of noise."""
        model, seed = self.setting.model, self.setting.sampled.seed
        device, steps = model.mean.device, model.diffusion.config.timesteps
        entropy = np.random.SeedSequence([seed, 7, *place]).generate_state(1)[0]
        draws = torch.Generator().manual_seed(int(entropy))
        clean = model.normalise(phrases.motion.to(device))
        low, high = third * steps // len(LEVELS), (third + 1) * steps // len(LEVELS)
        t = torch.randint(low, max(high, low + 1), (len(clean),), generator=draws).to(device)
        noise = standard_normal(clean.shape, draws, device=device)
        noisy = model.diffusion.q_sample(clean, t, noise)
        heard = None if memory is None else memory.to(device)
        output = model.denoise(noisy, t, phrases.audio.to(device), memory=heard)
        x_0 = model.diffusion.predict_x0(output, noisy, t)
        return (x_0 - clean).square().mean(dim=(1, 2)).cpu()


class Curves:
    """How far the made motion's prior curves are from those of the motion that was danced.

    Mean absolute difference over time, each curve in [0, 1]; one sample a phrase.
    """

    name = "distance of prior curves from real motion"
    columns = CURVES

    def __init__(self, setting: Setting, items: Sequence[PhraseItem]) -> None:
        self.setting, self.items = setting, items
        self.frames = setting.model.config.window - SPARE  # as many as one window makes
        self.clusters = [item.record.song or item.record.id for item in items]
        self.real = [_curves_of(item, self.frames) for item in items]

    def measure(self, arm: Arm) -> Values:
        """Figures [N] of one arm."""
        made = []
        for number, item in enumerate(self.items):
            audio, song = item.audio[:, : self.frames], self.clusters[number]
            bars = bars_of_sound(audio[None])[0].numpy()
            made.append(prior_curves(dance(self.setting, arm, audio, bars, song, number).data))
        return self._distances(made)

    def chance(self) -> Values:
        """Real motion of another song instead: what not listening scores."""
        order = np.roll(np.arange(len(self.items)), len(self.items) // 2)
        return self._distances([self.real[number] for number in order])

    def _distances(self, made: Sequence[np.ndarray]) -> Values:
        pairs = zip(made, self.real, strict=True)
        rows = np.array([np.abs(a - b).mean(axis=1) for a, b in pairs])  # [N,4]
        return {column.key: rows[:, place] for place, column in enumerate(self.columns)}


def _curves_of(item: PhraseItem, frames: int) -> np.ndarray:
    bars = bars_of_sound(item.audio[None])[0]
    return prior_curves(place_window(item.motion.numpy(), phase=float(bars[0]))[:frames])


# ---------------------------------------------------------------- songs


class Songs:
    """Beat alignment and sanity of motions for held-out synthetic songs, one sample a song."""

    name = "motions for held-out songs"
    columns = SONGS

    def __init__(self, setting: Setting, pieces: Sequence[Piece]) -> None:
        self.setting, self.pieces = setting, pieces
        self.clusters = [piece.name for piece in pieces]

    def measure(self, arm: Arm) -> Values:
        """Figures [N] of one arm."""
        dances = []
        for number, piece in enumerate(self.pieces):
            made = dance(self.setting, arm, piece.condition, piece.phase, piece.name, number)
            beats, bars = piece.beats, piece.bars
            dances.append(Dance(piece.name, made, beats, bars, piece.true_meter, piece.meter))
        sample = DanceSample(dances, np.full(len(dances), -1))
        found: Values = {}
        for family in SONG_FAMILIES:
            computed = family.compute(sample, sample, seed=self.setting.sampled.seed)
            found |= {key: np.asarray(value) for key, value in computed.items()}
        return {column.key: found[column.key] for column in self.columns}


@torch.no_grad()
def dance(
    setting: Setting, arm: Arm, condition: Tensor, bars: np.ndarray | None, song: str, number: int
) -> MotionTrajectory:
    """One motion for a condition [C,T]; noise depends on (seed, number), not on the arm."""
    sampled = replace(setting.sampled, seed=setting.sampled.seed + 1000 * number)
    sampler = SongSampler(setting.model, sampled)
    recall = recalled(setting, arm, condition, bars, song, number) if arm.asks else None
    return sampler.sample(condition, phase=bars, recall=recall)[0]


def recalled(
    setting: Setting, arm: Arm, condition: Tensor, bars: np.ndarray | None, song: str, number: int
) -> Recall:
    """Each window's answer."""

    def recall(start: int, length: int) -> MemoryCondition:
        query = setting.space.embed_audio(condition[None, :, start : start + length])
        phase = None if bars is None else bars_of_window(bars, start, length)[None]
        draw = 1000 * number + start
        answer = setting.asker.answer(arm, query, phase, length, [song], draw=draw)
        assert answer is not None
        return answer

    return recall
