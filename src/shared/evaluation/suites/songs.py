"""What the audio branch and the performer are judged on: songs and motion that no training saw.

Synthetic songs have tempi that no training song has, and exactly known beats; test phrases are
real motion paired with its song, some with bodies; tracks are sound files whose beats nobody knows.

Letters: T frames, C rows of sound.
"""

from collections.abc import Iterator
from dataclasses import dataclass, replace
from itertools import islice
from pathlib import Path
from typing import Any
from zlib import crc32

import numpy as np
from torch import Tensor

from ...audio.song import analyse, analyse_sound
from ...audio.sound import sound_from_samples
from ...audio.synthetic import HELD_OUT_TEMPI, SongSpec, render_song, sample_song_specs, song_beats
from ...data.phrases.dataset import MotionPhraseDataset, PhraseItem
from ...data.phrases.layout import PhraseRecord
from ...data.retarget.read_motion import FOLDER_ENDINGS, read_motion
from ...errors import UserError
from ...metrics.rhythm import beats_of_phase
from ...model.audio import BEAT, CONDITION_ROWS
from ...motion.features import decode_features
from ...motion.motion import Motion, resample_motion
from ...motion.trajectory import FPS, MotionTrajectory, place_window
from ...pipelines.song import SongCondition, SongGenerator, own_noise, song_condition
from ...pipelines.song_sampler import SongSampling
from ..samples import Dance

FRESH_SEED = 90210  # of songs made only to test: no training draws from the held-out tempi
MARGIN = 2.0  # seconds of beats beyond a song's end that count as neighbours
TEMPI = ", ".join(f"{low:g}-{high:g}" for low, high in HELD_OUT_TEMPI)


@dataclass(frozen=True, eq=False)
class Piece:
    """A song as the model hears it, and what is true of it."""

    name: str  # for the report
    condition: Tensor  # [C,T]
    phase: np.ndarray | None  # bars [T] of the beat tracker, unwrapped; None = no beat found
    meter: int  # beats a bar that the tracker counts
    bars: np.ndarray | None  # true bars [T], unwrapped; None = nobody knows
    true_meter: int  # beats a true bar
    beats: np.ndarray  # seconds, true ones where they are known
    about: dict[str, Any]  # tempo and the like, for the report

    @property
    def num_frames(self) -> int:
        """T."""
        return int(self.condition.shape[1])

    @property
    def seconds(self) -> float:
        return self.num_frames / FPS

    @property
    def heard(self) -> np.ndarray | None:
        """Seconds of the beats that the tracker heard; None = no beat found."""
        return None if self.phase is None else beats_of_phase(self.phase * self.meter, FPS)


def dance_of(piece: Piece, motion: MotionTrajectory) -> Dance[MotionTrajectory]:
    """A motion held against the song that it was made for."""
    return Dance(piece.name, motion, piece.beats, piece.bars, piece.true_meter, piece.meter)


def sung(
    generator: SongGenerator[Any], piece: Piece, settings: SongSampling, replication: int
) -> MotionTrajectory:
    """A motion with noise of the song's own: of one noise for all, fifty songs get one walk."""
    own = own_noise(settings, replication, crc32(piece.name.encode()))
    return generator.generate(piece.condition, phase=piece.phase, settings=own)[0]


def held_out_specs(number: int, seconds: float, seed: int) -> list[SongSpec]:
    """Songs not yet rendered, with tempi of their own."""
    return sample_song_specs(number, FRESH_SEED + seed, "held-out", seconds=seconds)


def held_out_songs(
    number: int, seconds: float, seed: int, *, tell_meter: bool = True
) -> Iterator[Piece]:
    """Freshly rendered songs with tempi of their own; `tell_meter`: the beat tracker is told the
    beats a bar, as with `--meter`; else it chooses."""
    for index, spec in enumerate(held_out_specs(number, seconds, seed)):
        made = render_song(spec)
        sound = sound_from_samples(made.samples, made.sample_rate)
        song = analyse_sound(sound, meter=spec.meter if tell_meter else None)
        tempo = 60.0 / float(np.median(np.diff(made.beat_times)))
        yield Piece(
            f"synthetic-{FRESH_SEED + seed}-{index:03d}",
            *song_condition(song, None),
            meter=song.beats.meter,
            bars=made.phase(song.num_frames),
            true_meter=spec.meter,
            beats=song_beats(replace(spec, seconds=spec.seconds + MARGIN))[0],
            about={"tempo": tempo, "meter": spec.meter, "heard": song.beats.tempo},
        )


def tracks(folder: Path, seconds: float) -> Iterator[Piece]:
    """The first `seconds` of every sound file below a folder; beats are the tracker's.
    Raises UserError: there is none."""
    from ...data.pairing.music import SOUND_FILES

    found = sorted(p for p in folder.rglob("*") if p.suffix.lower() in SOUND_FILES and p.is_file())
    if not found:
        raise UserError(f"{folder} holds no sound file ({', '.join(SOUND_FILES)}); name another")
    for path in found:
        song = analyse(path)
        heard = song.beats
        about: dict[str, Any] = {"tempo": float(heard.tempo), "meter": heard.meter}
        about |= {"confidence": float(heard.confidence), "sha256": song.sha256[:12]}
        yield Piece(
            path.stem,
            *song_condition(song, seconds),
            meter=heard.meter,
            bars=None,
            true_meter=heard.meter,
            beats=np.asarray(heard.beat_times),
            about=about,
        )


# ---------------------------------------------------------------- phrases


@dataclass(frozen=True, eq=False)
class RealPhrase:
    """A window of a paired phrase."""

    song: str
    audio: Tensor  # [C,T]
    motion: MotionTrajectory
    beats: np.ndarray  # seconds, those that the rows of beat phase tell; none without
    bars: np.ndarray | None  # unwrapped [T], as those rows tell; None without


def open_split(
    data: str, split: str, frames: int, seed: int, *, bodies: bool = False
) -> MotionPhraseDataset:
    """Windows of `frames` of one split of a folder or bucket of pairs.
    Raises UserError: there is none."""
    return MotionPhraseDataset(
        data, split=split, target_frames=frames, seed=seed, cache_in_memory=False, bodies=bodies
    )


def items(dataset: MotionPhraseDataset, draw: int = 0) -> Iterator[PhraseItem]:
    """Every phrase that can be read, in the order that the dataset's seed gives."""
    found = (dataset.item(int(index), draw) for index in dataset.order(0))
    return (item for item in found if item is not None)


def phrases(
    dataset: MotionPhraseDataset, number: int, *, whole: bool = False, draw: int = 0
) -> list[RealPhrase]:
    """Up to `number` windows, phrases in the order that the dataset's seed gives; `whole`: without
    shorter ones; `draw`: which window of each phrase."""
    found: list[RealPhrase] = []
    usable = (item for item in items(dataset, draw) if not whole or bool(item.mask.all()))
    for item in islice(usable, number):
        audio = item.audio[:, item.mask]
        bars, beats = clock(audio)
        window, start = item.motion[:, item.mask].numpy(), 0.0 if bars is None else float(bars[0])
        motion = MotionTrajectory(place_window(window, phase=start))
        found.append(RealPhrase(song_of(item.record), audio, motion, beats, bars))
    return found


def song_of(record: PhraseRecord) -> str:
    """The song that a phrase is of; its own where nobody knows."""
    return record.song or record.id


def clock(audio: Tensor) -> tuple[np.ndarray | None, np.ndarray]:
    """Unwrapped bars [T] and beat times that the rows of beat and bar phase of [C,T] tell."""
    if len(audio) < CONDITION_ROWS or float(audio[BEAT].abs().sum()) == 0:
        return None, np.zeros(0)
    rows = audio[BEAT].double().numpy()  # cos and sin of the beat, then of the bar
    beat, bar = (np.unwrap(np.arctan2(rows[k + 1], rows[k])) / (2 * np.pi) for k in (0, 2))
    return bar, beats_of_phase(beat, FPS)


def conditions_of_songs(number: int, frames: int, seed: int) -> list[SongCondition]:
    """Windows of held-out synthetic songs, several of each."""
    seconds, each = max(30.0, frames / FPS), max(1, int(30.0 * FPS) // frames)
    found: list[SongCondition] = []
    for piece in held_out_songs(-(-number // each), seconds, seed):
        for part in (slice(k * frames, (k + 1) * frames) for k in range(each)):
            bars = None if piece.phase is None else piece.phase[part]
            beats = np.zeros(0) if bars is None else beats_of_phase(bars * piece.meter, FPS)
            condition = piece.condition[:, part].float()
            found.append(SongCondition(condition, bars, beats, len(found)))
    return found[:number]


# ---------------------------------------------------------------- bodies

MIN_BEATS = 4  # of a real dance that is held against its music


def captured_dances(folder: Path, frames: int) -> Iterator[Dance[Motion]]:
    """The motion files of a folder in pieces of so many frames, nobody knows to which music; what
    is left at the end is a piece if it is half as long, or all there is.
    Raises UserError: there is none, or one cannot be read."""
    files = sorted(each for each in folder.iterdir() if each.suffix.lower() in FOLDER_ENDINGS)
    if not files:
        raise UserError(f"{folder} holds no motion files; name a folder of captured dances")
    for file in files:
        motion = resample_motion(read_motion(file), FPS)
        for start in range(0, motion.num_frames, frames):
            piece = motion.frames(start, start + frames)
            if start == 0 or piece.num_frames >= frames / 2:
                yield Dance(file.stem, piece, np.zeros(0))


def real_dances(data: str, frames: int, number: int, seed: int) -> list[Dance[Motion]]:
    """Bodies of up to `number` test phrases that have beats, windows of at most `frames`."""

    def dances() -> Iterator[Dance[Motion]]:
        for item in items(open_split(data, "test", frames, seed, bodies=True)):
            beats = clock(item.audio[:, item.mask])[1]
            if item.body is not None and len(beats) >= MIN_BEATS:
                yield Dance(song_of(item.record), decode_features(item.body[item.mask]), beats)

    return list(islice(dances(), number))
