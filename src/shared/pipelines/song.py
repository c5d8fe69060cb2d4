"""A song in, trajectories out: what the network is told of it (TECH 12.1), and sampling (TECH 8.2).

Letters: T frames, M beats.
"""

from collections.abc import Iterator
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Self

import numpy as np
import torch
from torch import Tensor

from ..audio.song import Song, analyse
from ..data.phrases.layout import phase_rows
from ..device import choose_device
from ..model.audio.audio_motion_model import AudioMotionModel
from ..model.audio.conditioning import BEAT, CONDITION_ROWS, FEATURE_ROWS
from ..motion.trajectory import FPS, MotionTrajectory
from ..motion.trajectory_math import unwrap_phase
from .runtime import load_trained
from .song_sampler import Progress, SongSampler, SongSampling


@dataclass(frozen=True)
class SongMotions:
    """Trajectories of one song, and the song as it was heard."""

    trajectories: list[MotionTrajectory]
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
        """The first `seconds` of a song; None = all of it."""
        condition, phase = heard(song, seconds)
        beats = np.asarray(song.beats.beat_times) if song.beats.tempo > 0 else np.zeros(0)
        return cls(condition, phase, beats, int(song.sha256, 16))


class SongGenerator:
    """A trained audio branch.

    Args:
        model: trained.
        device: auto, cuda, mps or cpu.
    """

    def __init__(self, model: AudioMotionModel, *, device: str | None = None) -> None:
        self.device = torch.device(choose_device(device or "auto")[0])
        self.model = model.to(self.device).eval()

    @classmethod
    def from_pretrained(cls, name_or_folder: str | Path, *, device: str | None = None) -> Self:
        """By the name of shipped weights, or a folder that training wrote.

        Raises:
            UserError: no such model, another kind, damaged, or never trained.
        """
        return cls(load_trained(name_or_folder, device or "auto"), device=device)

    def generate(
        self,
        audio_features: np.ndarray | torch.Tensor,
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
        """Trajectories for a sound file.

        Args:
            path: wav, flac, ogg or mp3 of 1 s or more.
            meter: beats a bar; None = heard (3 or 4).
            seconds: only the first so many; None = all.
            style: [8] unit, see `src.shared.motion.style`; None = the model's choice.

        Raises:
            UserError: the file cannot be used.
        """
        song = analyse(path, meter=meter)
        condition, phase = heard(song, seconds)
        settings = of_song(settings or SongSampling(), song)
        made = self.generate(
            condition, phase=phase, style=style, settings=settings, progress=progress
        )
        return SongMotions(made, song)

    def stream(
        self,
        song: Song,
        *,
        style: np.ndarray | None = None,
        settings: SongSampling | None = None,
    ) -> Iterator[list[MotionTrajectory]]:
        """Pieces that follow each other, one a sample, as soon as they are settled."""
        condition, phase = heard(song, None)
        sampler = SongSampler(self.model, of_song(settings or SongSampling(), song))
        yield from sampler.stream(condition, phase=phase, style=style)


def of_song(settings: SongSampling, song: Song) -> SongSampling:
    """The settings with noise of the song's own, the same whenever it is played.

    The sound sets the beat and little of the path: with one seed for all, every song would walk
    the same way.
    """
    return own_noise(settings, int(song.sha256, 16))


def own_noise(settings: SongSampling, *parts: int) -> SongSampling:
    """The settings with a seed that depends on theirs and on every part, each 0 or more."""
    mixed = np.random.SeedSequence((settings.seed, *parts))
    return replace(settings, seed=int(mixed.generate_state(1)[0]))


def heard(song: Song, seconds: float | None) -> tuple[torch.Tensor, np.ndarray | None]:
    """Condition [167,T] and bars [T] of the first `seconds`; no bars where no beat was found."""
    frames = song.num_frames if seconds is None else min(song.num_frames, round(seconds * FPS))
    rows, phase = song.features.stack()[:, :frames], song.phase[:frames]
    if song.beats.tempo <= 0:
        return torch.from_numpy(np.pad(rows, ((0, 4), (0, 0)))), None
    beat = phase_rows(phase, song.beats.meter)
    return torch.from_numpy(np.concatenate([rows, beat])), phase


@dataclass(frozen=True, eq=False)
class AudioCondition:
    """Rows [163 or 167, T] at 30 fps: features, and beat and bar phase where they are known.

    Raises:
        ValueError: another shape.
    """

    rows: Tensor

    def __post_init__(self) -> None:
        if self.rows.ndim != 2 or len(self.rows) not in (FEATURE_ROWS, CONDITION_ROWS):
            raise ValueError(f"a condition is [163 or 167, T], not {list(self.rows.shape)}")

    @classmethod
    def of(cls, sound: Song | np.ndarray | Tensor) -> Self:
        """Of an analysed song; or of rows, with a batch of one in front or without."""
        if isinstance(sound, Song):
            return cls(heard(sound, None)[0])
        rows = torch.as_tensor(sound).float()
        return cls(rows[0] if rows.ndim == 3 and len(rows) == 1 else rows)

    @property
    def num_frames(self) -> int:
        """T."""
        return self.rows.shape[1]

    def first(self, num_frames: int) -> Self:
        """Its first frames."""
        return type(self)(self.rows[:, :num_frames])

    def time(self) -> tuple[np.ndarray, np.ndarray] | None:
        """Unwrapped bars [T], and times [M] of beats in seconds; None where they are unknown."""
        beat_and_bar = self.rows[BEAT].double().cpu().numpy()
        if not len(beat_and_bar) or not np.hypot(*beat_and_bar[:2]).min() > 0.5:
            return None
        beats, bars = (
            unwrap_phase(np.arctan2(sine, cosine) / (2 * np.pi) % 1.0)
            for cosine, sine in (beat_and_bar[:2], beat_and_bar[2:])
        )
        numbers = np.arange(np.ceil(beats[0]), np.floor(beats[-1]) + 1)
        return bars, np.interp(numbers, beats, np.arange(len(beats))) / FPS
