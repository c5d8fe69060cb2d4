"""A song in, trajectories out: what the network is told of it (TECH 12.1), and sampling (TECH 8.2);
and the phrases of a song, which are danced.

Letters: T frames, M beats, C counts of a song, n of a phrase.
"""

import logging
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from itertools import pairwise
from pathlib import Path
from typing import TYPE_CHECKING, Any, Generic, Self, TypeVar

import numpy as np

from ..audio.features import is_noise, noise_spans, silent_spans
from ..audio.song import Song, analyse
from ..config_audio import PostProcessConfig
from ..data.phrases.layout import phase_rows
from ..device import choose_device
from ..errors import UsageError, UserError
from ..metrics.sanity import Bands
from ..model.audio import BEAT, CHROMA, CONDITION_ROWS, ENERGY, FEATURE_ROWS
from ..model.checkpoint import resolve_model
from ..model.generation.motion_generator import TextToMotion
from ..motion.postprocess.trajectory import MotionPostProcessor
from ..motion.style import named_style, only_style_words
from ..motion.trajectory import FPS, NEUTRAL_STYLE, MotionTrajectory, unwrap_phase
from ..tensors import Tensor, nn, torch
from .path import DrawnPath, TimedPath, time_path
from .ranking import AudioJudge, ScoreTable, unranked
from .runtime import Runtime, load_runtime
from .song_sampler import Progress, SongSampler, SongSampling

if TYPE_CHECKING:
    from .song_memory import SongMemory

log = logging.getLogger(__name__)
BEATLESS = "no beat was found: the motion keeps its own time"
STYLE_MODEL = "starter"  # reads a style that is a sentence
ModelT = TypeVar("ModelT", bound=Runtime)


@dataclass(frozen=True, eq=False)
class SongMotions:
    """Trajectories of one song, the best first, and the song as it was heard.

    Attributes:
        trajectories: post-processed.
        raw: the same as the decoder gave them.
        table: what was found of them, in the order sampled.
        song: analysed.
    """

    trajectories: list[MotionTrajectory]
    raw: list[MotionTrajectory]
    table: ScoreTable
    song: Song


@dataclass(frozen=True, eq=False)
class SongCondition:
    """A song, or its first seconds, as the networks are told of it.

    Attributes:
        condition: what the audio branch hears, [167,T].
        phase: bars [T] of the beat tracker, unwrapped; None = no beat found.
        beats: seconds [M] of the tracker; none where it found none.
        seed: a number of the song's own, so that two songs are not danced alike.
    """

    condition: Tensor
    phase: np.ndarray | None
    beats: np.ndarray
    seed: int = 0

    @classmethod
    def of(cls, song: Song, seconds: float | None = None) -> "SongCondition":
        """The first `seconds` of a song; None = all of it. A song that is shorter is told."""
        if seconds is not None and seconds > song.seconds + 0.5:
            log.warning("the song ends after %.0f s: so does what is made for it", song.seconds)
        condition, phase = song_condition(song, seconds)
        beats = np.asarray(song.beats.beat_times) if song.beats.tempo > 0 else np.zeros(0)
        return cls(condition, phase, beats, int(song.sha256 or "0", 16))

    @property
    def waits(self) -> list[tuple[int, int]]:
        """First and past-the-last frame of each part in which nobody dances: silences, noises, and
        all of a sound that has neither beats nor pitch."""
        rows = self.condition.cpu().numpy()
        if not len(self.beats) and is_noise(rows[CHROMA]):
            return [(0, rows.shape[1])]
        loudness = rows[ENERGY.start]
        waits = np.zeros(len(loudness), dtype=int)
        for start, stop in silent_spans(loudness, FPS) + noise_spans(rows[CHROMA], loudness, FPS):
            waits[start:stop] = 1
        edges = np.flatnonzero(np.diff(waits, prepend=0, append=0)).reshape(-1, 2).tolist()
        return [(start, stop) for start, stop in edges]

    def slots(self) -> "list[Slot]":
        """Its phrases; none where no beat was found."""
        if self.phase is None or len(self.beats) < 2:
            return []
        return song_slots(self.beats, self.phase, self.condition.cpu().numpy(), self.waits)


class SongGenerator(Generic[ModelT]):
    """A trained audio branch.

    Args:
        model: trained; a torch model is moved to the device.
        device: auto, cuda, mps or cpu.
        bands: of real motions, for the judge of candidates; None = built-in bounds.
        memory: what its windows are told of like phrases; None = nothing.

    Raises:
        UserError: a memory for a model that hears none.
    """

    def __init__(
        self,
        model: ModelT,
        *,
        device: str | None = None,
        bands: Bands | None = None,
        memory: "SongMemory | None" = None,
    ) -> None:
        if memory is not None:
            from .song_memory import require_memory

            require_memory(model.config, "this model")
        network: Any = model
        if isinstance(network, nn.Module):
            network.to(choose_device(device or "auto")[0]).eval()
        self.model, self.bands, self.memory = model, bands, memory
        self.post_processing: PostProcessConfig = model.config.post_processing
        self.device = model.mean.device

    @classmethod
    def from_pretrained(
        cls,
        name_or_folder: str | Path,
        *,
        device: str | None = None,
        runtime: str = "torch",
        memory: "SongMemory | None" = None,
    ) -> "SongGenerator[Any]":
        """By the name of shipped weights, or a folder that training or `export-onnx` wrote.

        Args:
            name_or_folder: as of `resolve_model`.
            device: auto, cuda, mps or cpu.
            runtime: see `load_runtime`; auto is torch with a memory, which no export hears.
            memory: see the class.

        Raises:
            UserError: no such model, another kind, damaged, or never trained; or it hears no
                memory and one is given.
        """
        if memory is not None:
            if runtime == "onnx":
                raise UserError(f"an export of {name_or_folder} hears no memory; use runtime torch")
            runtime = "torch"
        model: Any = load_runtime(runtime, name_or_folder, device or "auto")
        bands = shipped_bands(name_or_folder)
        return cls(model, device=device, bands=bands, memory=memory)

    @property
    def runtime(self) -> str:
        """What computes: torch or onnx."""
        return "torch" if isinstance(self.model, nn.Module) else "onnx"

    def sample(
        self,
        song: SongCondition,
        settings: SongSampling | None = None,
        *,
        style: np.ndarray | None = None,
        progress: Progress | None = None,
    ) -> list[MotionTrajectory]:
        """Candidates as the decoder gave them, with noise of the song's own."""
        sampler = SongSampler(self.model, own_noise(settings or SongSampling(), song.seed))
        recall = None
        if self.memory is not None:
            recall = self.memory.recall(sampler, song.condition, song.phase)
        return sampler.sample(
            song.condition, phase=song.phase, style=style, progress=progress, recall=recall
        )

    def trajectories(
        self,
        song: Song,
        settings: SongSampling | None = None,
        *,
        seconds: float | None = None,
        style: np.ndarray | None = None,
        progress: Progress | None = None,
    ) -> SongMotions:
        """Candidates for a song, ranked and post-processed: what `generate --audio` writes.

        Args:
            song: analysed.
            settings: how many candidates, and how they are sampled.
            seconds: only the first so many; None = all.
            style: [8] unit, see `styled`; None = the model's choice.
            progress: told the frames that are done.
        """
        condition = SongCondition.of(song, seconds)
        raw = self.sample(condition, settings, style=style, progress=progress)
        judge = AudioJudge(self.bands)
        table = judge.judge(raw, condition.beats) if len(raw) > 1 else unranked()
        ranked = [raw[place] for place in table.order]
        return SongMotions(
            [finished(path, self.post_processing) for path in ranked], ranked, table, song
        )

    def generate(
        self,
        audio_features: np.ndarray | Tensor,
        *,
        phase: np.ndarray | None = None,
        style: np.ndarray | None = None,
        settings: SongSampling | None = None,
        progress: Progress | None = None,
    ) -> list[MotionTrajectory]:
        """Trajectories from features [163 or 167, T]; see `SongSampler.stream`."""
        condition = torch.as_tensor(audio_features).float()
        sampler = SongSampler(self.model, settings)
        return sampler.sample(condition, phase=phase, style=style, progress=progress)

    def generate_from_audio(
        self,
        path: str | Path,
        *,
        meter: int | None = None,
        seconds: float | None = None,
        style: np.ndarray | None = None,
        settings: SongSampling | None = None,
        progress: Progress | None = None,
    ) -> SongMotions:
        """Trajectories for a sound file, the best first.

        Args:
            path: wav, flac, ogg or mp3 of 1 s or more.
            meter: beats a bar; None = heard (3 or 4).
            seconds: only the first so many; None = all.
            style: [8] unit, see `src.shared.motion.style`; None = the model's choice.

        Raises:
            UserError: the file cannot be used.
        """
        song = analyse(path, meter=meter)
        return self.trajectories(song, settings, seconds=seconds, style=style, progress=progress)

    def stream(
        self,
        song: Song,
        *,
        style: np.ndarray | None = None,
        settings: SongSampling | None = None,
    ) -> Iterator[list[MotionTrajectory]]:
        """Pieces that follow each other, one a sample, as soon as they are settled."""
        condition, phase = song_condition(song, None)
        sampler = SongSampler(self.model, of_song(settings or SongSampling(), song))
        yield from sampler.stream(condition, phase=phase, style=style)


def finished(raw: MotionTrajectory, config: PostProcessConfig | None = None) -> MotionTrajectory:
    """A path as it is written to files, and pinned: post-processed."""
    return MotionTrajectory(MotionPostProcessor(config).process(raw.data), raw.fps)


def shipped_bands(name_or_folder: str | Path) -> Bands | None:
    """Bands of the training motions beside the weights, where the folder has them."""
    path = resolve_model(name_or_folder) / "bands.json"
    return Bands.load(path) if path.is_file() else None


def analysed(audio: Song | str | Path, meter: int | None = None) -> Song:
    """A song, or that of a sound file.

    Raises:
        UsageError: neither, or a meter for what has its own.
        UserError: the file cannot be used.
    """
    if not isinstance(audio, Song | str | Path):
        raise UsageError(
            f"audio is a {type(audio).__name__}; give a sound file, or a Song (of samples in"
            " memory: write them as WAV first)"
        )
    if not isinstance(audio, Song):
        return analyse(audio, meter=meter)
    if meter is not None:
        raise UsageError(
            f"meter {meter}: this Song has {audio.beats.meter} beats a bar; leave it out"
        )
    return audio


def in_time_of(song: SongCondition, path: DrawnPath) -> MotionTrajectory:
    """A drawn path in the time of a song, at most as long as it."""
    frames = song.condition.shape[1]
    seconds = None if path.times is not None else (frames - 1) / FPS
    timed = time_path(path, fps=FPS, seconds=seconds)
    length = min(len(timed), frames)
    phase = None if song.phase is None else song.phase[:length]
    return TimedPath(timed.points[:length], timed.headings[:length], FPS).trajectory(phase)


def styled(text: str | np.ndarray | None) -> np.ndarray | None:
    """The style [8] that a text names; None without one, and a vector as it is.

    A list of style words is looked up; any other text is read as a prompt, through the map of
    styles that the text model has learned (ruling 11).

    Raises:
        UsageError: a vector that is none.
    """
    if text is None:
        return None
    if not isinstance(text, str):
        vector = np.asarray(text)
        numbers = vector.shape == NEUTRAL_STYLE.shape and vector.dtype.kind in "fiu"
        if not (numbers and np.isfinite(vector).all() and vector.any()):
            raise UsageError(f"style {text!r} is no unit vector of 8 numbers; give one, or words")
        return vector
    if only_style_words(text):
        return named_style(text)
    found = TextToMotion.from_pretrained(STYLE_MODEL).style_of(text)
    return named_style(text) if found is None else found  # the former says what is known


def of_song(settings: SongSampling, song: Song) -> SongSampling:
    """The settings with noise of the song's own, the same whenever it is played.

    The sound sets the beat and little of the path: with one seed for all, every song would walk
    the same way.
    """
    return own_noise(settings, int(song.sha256 or "0", 16))


def own_noise(settings: SongSampling, *parts: int) -> SongSampling:
    """The settings with a seed that depends on theirs and on every part, each 0 or more."""
    mixed = np.random.SeedSequence((settings.seed, *parts))
    return replace(settings, seed=int(mixed.generate_state(1)[0]))


def frames_of(song: Song, seconds: float | None) -> int:
    """Frames of a path for its first `seconds`; None = all of it."""
    return song.num_frames if seconds is None else min(song.num_frames, round(seconds * FPS))


def song_condition(song: Song, seconds: float | None) -> tuple[Tensor, np.ndarray | None]:
    """Condition [167,T] and bars [T] of the first `seconds`; no bars where no beat was found."""
    frames = frames_of(song, seconds)
    rows, phase = song.features.stack()[:, :frames], song.phase[:frames]
    if song.beats.tempo <= 0:
        return torch.from_numpy(np.pad(rows, ((0, 4), (0, 0)))), None
    beat = phase_rows(phase, song.beats.meter)
    return torch.from_numpy(np.concatenate([rows, beat])), phase


@dataclass(frozen=True, eq=False)
class AudioCondition:
    """Rows [163 or 167, T] at 30 fps: features, and beat and bar phase where they are known.

    Attributes:
        rows: what the network hears.
        song: the same with what the beat tracker found, if the rows are an analysed song's.

    Raises:
        ValueError: another shape.
    """

    rows: Tensor
    song: SongCondition | None = None

    def __post_init__(self) -> None:
        if self.rows.ndim != 2 or len(self.rows) not in (FEATURE_ROWS, CONDITION_ROWS):
            raise ValueError(f"a condition is [163 or 167, T], not {list(self.rows.shape)}")

    @classmethod
    def of(cls, sound: Song | np.ndarray | Tensor) -> Self:
        """Of an analysed song; or of rows, with a batch of one in front or without."""
        if isinstance(sound, Song):
            song = SongCondition.of(sound)
            return cls(song.condition, song)
        rows = torch.as_tensor(sound).float()
        return cls(rows[0] if rows.ndim == 3 and len(rows) == 1 else rows)

    @property
    def num_frames(self) -> int:
        """T."""
        return self.rows.shape[1]

    def first(self, num_frames: int) -> Self:
        """Its first frames."""
        song = self.song
        if song is not None:
            phase = None if song.phase is None else song.phase[:num_frames]
            song = replace(song, condition=song.condition[:, :num_frames], phase=phase)
        return type(self)(self.rows[:, :num_frames], song)

    def time(self) -> tuple[np.ndarray, np.ndarray] | None:
        """Unwrapped bars [T], and times [M] of beats in seconds; None where they are unknown."""
        if self.song is not None:
            return None if self.song.phase is None else (self.song.phase, self.song.beats)
        beat_and_bar = self.rows[BEAT].double().cpu().numpy()
        if not len(beat_and_bar) or not np.hypot(*beat_and_bar[:2]).min() > 0.5:
            return None
        beats, bars = (
            unwrap_phase(np.arctan2(sine, cosine) / (2 * np.pi) % 1.0)
            for cosine, sine in (beat_and_bar[:2], beat_and_bar[2:])
        )
        numbers = np.arange(np.ceil(beats[0]), np.floor(beats[-1]) + 1)
        return bars, np.interp(numbers, beats, np.arange(len(beats))) / FPS


# ---------------------------------------------------------------- phrases that are danced

PACE = 0.5  # seconds of a count, about; a beat counts half, one or two of them
ALIKE = 0.9  # cosine of what two phrases of a song sound like, from which one is the other again


@dataclass(frozen=True, eq=False)
class Slot:
    """A phrase of a song.

    Attributes:
        counts: seconds of n counts and of the end [n+1].
        loudness: rank among the phrases, 0 to 1.
        same: the earlier phrase that it is to repeat; None = none.
        part: letter of the form.
        meter: counts of a bar, where the phrase opens one; 0 = it does not.
        halved: two counts are a beat.
    """

    counts: np.ndarray
    loudness: float = 0.5
    same: int | None = None
    part: str = "a"
    meter: int = 0
    halved: bool = False


def song_slots(
    beats: np.ndarray,
    phase: np.ndarray,
    condition: np.ndarray,
    waits: Sequence[tuple[int, int]] = (),
) -> list[Slot]:
    """The phrases of a song of T frames, in order; none where less than a bar sounds.

    Args:
        beats: seconds [M], ascending.
        phase: unwrapped bars [T].
        condition: what is heard, rows [R,T]; the 160th is the loudness.
        waits: frames [start, stop) in which nobody dances.
    """
    seconds = len(phase) / FPS
    counts, bars, halved = _counts(beats, phase, seconds)
    silent = np.zeros(len(phase) + 1, dtype=bool)
    for start, stop in waits:
        silent[start:stop] = True
    frame = np.clip(np.rint(counts * FPS).astype(int), 0, len(phase))
    alive = (counts >= 0) & (counts <= seconds + 1e-6) & ~silent[frame]
    edges = np.flatnonzero(np.diff(alive.astype(int), prepend=0, append=0)).reshape(-1, 2)
    gap = [False, *(2 * silent[a:b].sum() > b - a for a, b in pairwise(frame.tolist()))]
    runs = [run for start, end in edges.tolist()
            for run in pairwise([start, *(i for i in range(start + 1, end) if gap[i]), end])
            ]  # fmt: skip
    per_phrase, bars_of_phrase = _phrase(bars)
    opening = counts[np.isclose(bars % 1, 0)]
    found: list[np.ndarray] = []
    for first, stop in runs:
        opens = first + np.flatnonzero(np.isclose(bars[first:stop] % bars_of_phrase, 0))
        cuts = sorted({first, stop - 1, *opens.tolist()})
        found += _merged([counts[start : end + 1] for start, end in pairwise(cuts)], per_phrase)
    meter = _danced_meter(bars)
    return [
        replace(
            slot, meter=meter if np.isclose(opening, slot.counts[0]).any() else 0, halved=halved
        )
        for slot in (_formed(found, condition) if found else ())
    ]


def _danced_meter(bars: np.ndarray) -> int:
    """Three or four counts, as steps are counted; 0 of bars that are neither."""
    per_bar = round(1 / float(np.median(np.diff(bars))))
    return 3 if per_bar % 3 == 0 else 4 if per_bar in (2, 4, 8) else 0


def _counts(
    beats: np.ndarray, phase: np.ndarray, seconds: float
) -> tuple[np.ndarray, np.ndarray, bool]:
    """Counts and the bar [C] that each falls in, from before 0 to the end, and whether two of them
    are a beat."""
    from .body import beats_beyond

    beats = beats_beyond(beats, seconds)
    period = float(np.median(np.diff(beats)))
    times = np.arange(len(phase)) / FPS
    slope = (phase[-1] - phase[0]) / max(times[-1], 1e-6)
    in_threes = round(1 / max(slope * period, 1e-6)) % 3 == 0
    shares = (0.5, 1.0) if in_threes else (0.5, 1.0, 2.0)
    share = min(shares, key=lambda s: abs(np.log(period * s / PACE)))
    if share == 0.5:
        beats = np.sort(np.concatenate((beats, (beats[1:] + beats[:-1]) / 2)))
    bars = np.interp(beats, times, phase)
    bars += slope * (np.minimum(beats, 0) + np.maximum(beats - times[-1], 0))
    per_bar = max(1, round(1 / float(np.median(np.diff(bars)))))
    bars = np.rint(bars * per_bar) / per_bar
    if share == 2.0:  # every second beat, the downbeats among them
        first = int(np.flatnonzero(np.isclose(bars % 1, 0))[:1].sum()) % 2
        beats, bars = beats[first::2], bars[first::2]
    return beats, bars, share == 0.5


def _phrase(bars: np.ndarray) -> tuple[int, int]:
    """Counts and bars of a phrase: so many bars (1, 2 or 4) as are nearest to eight counts."""
    per_bar = 1 / float(np.median(np.diff(bars)))
    number = min((1, 2, 4), key=lambda bars: abs(np.log(per_bar * bars / 8)))
    return round(per_bar * number), number


def _merged(phrases: list[np.ndarray], per_phrase: int) -> list[np.ndarray]:
    """Phrases of two counts and more, one after the other; those below three join a neighbour, and
    so does half a phrase at the end."""
    found: list[np.ndarray] = []
    for phrase in phrases:
        both = len(found[-1]) + len(phrase) - 2 if found else 0
        short = bool(found) and min(len(found[-1]), len(phrase)) < 4
        if short and both <= per_phrase + 2:
            found[-1] = np.concatenate((found[-1], phrase[1:]))
        else:
            found.append(phrase)
    if len(found) > 1 and len(found[-1]) - 1 <= per_phrase // 2:  # no stub before the end
        last = found.pop()
        found[-1] = np.concatenate((found[-1], last[1:]))
    return [phrase for phrase in found if len(phrase) > 2]


def _formed(phrases: list[np.ndarray], condition: np.ndarray) -> list[Slot]:
    """Phrases with their loudness, and which earlier one each repeats: a a' b a', and what the
    song plays again."""
    heard, loudness = [], []
    for phrase in phrases:
        start, stop = int(phrase[0] * FPS), max(int(phrase[-1] * FPS), int(phrase[0] * FPS) + 1)
        part = condition[:, start:stop]
        heard.append(part[128:160].mean(1) if part.size else np.zeros(32))
        loudness.append(float(part[160].mean()) if part.size else 0.0)
    sound = np.array(heard).reshape(len(phrases), 32)
    sound = sound - sound.mean(0)
    sound /= np.linalg.norm(sound, axis=1, keepdims=True).clip(min=1e-9)
    ranks = np.argsort(np.argsort(loudness)) / max(len(phrases) - 1, 1)
    slots: list[Slot] = []
    for index, phrase in enumerate(phrases):
        place = index % 4
        same = {1: index - 1, 3: index - 2}.get(place)
        if place in (0, 2) and index >= 4:
            earlier = [other for other in range(place, index - 3, 4) if len(phrases[other]) > 3]
            near = max(earlier, key=lambda other: sound[index] @ sound[other], default=None)
            if near is not None and sound[index] @ sound[near] > ALIKE:
                same = near
        if same is not None and len(phrases[same]) != len(phrase):
            same = None
        slots.append(
            Slot(
                phrase,
                float(ranks[index]),
                same,
                ("a", "a'", "b", "a'")[place] + (f"{index // 4 + 1}" if index >= 4 else ""),
            )
        )
    return slots
