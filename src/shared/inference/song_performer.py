"""SongPerformer: a song and a prompt become dances, the best first.

The audio branch makes the path, the performer puts a body on it. A prompt also sets the path's
style (ruling 11) where the text model can read one from it; without a prompt, `dance_prompt` finds
one for every few bars.

Letters: N candidates, T frames, M beats.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from torch import Tensor

from ..audio.song import Song
from ..model.generation.motion_generator import MotionGenerator
from ..motion.trajectory import MotionTrajectory
from ..motion.trajectory_postprocess import MotionPostProcessor
from .dance_prompt import DancePrompter
from .motion_stream import Passage
from .performance_judge import PerformanceJudge
from .performer import Performance, Performer, Progress
from .selection import ScoreTable
from .song_generator import SongGenerator, heard, of_song
from .song_sampler import SampleSettings


@dataclass(frozen=True, eq=False)
class HeardSong:
    """What a performer needs of a song.

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
    def of(cls, song: Song, seconds: float | None = None) -> "HeardSong":
        """The first `seconds` of a song; None = all of it."""
        condition, phase = heard(song, seconds)
        beats = np.asarray(song.beats.beat_times) if song.beats.tempo > 0 else np.zeros(0)
        return cls(condition, phase, beats, int(song.sha256, 16))


@dataclass(frozen=True, eq=False)
class Dances:
    """What was asked for, the dances by rank, and what was found of them in the order sampled."""

    prompt: str | None
    ranked: list[Performance]
    table: ScoreTable


class SongPerformer:
    """Puts bodies on the paths of a song.

    Args:
        performer: of bodies.
        prompter: finds prompts in music; None = a prompt must be given.
        judge: of the candidates; None = one without the words.
    """

    def __init__(
        self,
        performer: Performer,
        *,
        prompter: DancePrompter | None = None,
        judge: PerformanceJudge | None = None,
    ) -> None:
        self.performer, self.prompter = performer, prompter
        self.judge = judge or PerformanceJudge()

    def dance(
        self,
        raw: Sequence[MotionTrajectory],
        song: HeardSong,
        prompt: str | None = None,
        *,
        tag: str | None = None,
        seed: int = 0,
        progress: Progress | None = None,
    ) -> Dances:
        """A body for each path, ranked.

        Args:
            raw: N ≥ 1 paths of T frames as the audio branch made them.
            song: that they belong to.
            prompt: what the body does; None = what the music says.
            tag: action label beside the prompt.
            seed: candidate n depends on (seed, song, n), its path and its prompts alone.
            progress: told the frames done of N · T.

        Raises:
            UsageError: no prompt and no prompter, or as `Performer.perform`.
            UserError: as `Performer.perform`.
        """
        beats = song.beats if len(song.beats) else None
        made: list[Performance] = []
        for number, rough in enumerate(raw):
            path = finished(rough)
            own = candidate_seed(seed, song.seed, number)
            passages = self._passages(path, song, prompt, tag, own)
            before, total = number * path.num_frames, len(raw) * path.num_frames
            told = None if progress is None else _from(progress, before, total)
            made.append(
                self.performer.perform(path, passages, beats=beats, seed=own, progress=told)
            )
        prompts = [self._embedded(dance.passages) for dance in made]
        table = self.judge.judge(made, raw, prompts, beats)
        return Dances(prompt, [made[place] for place in table.order], table)

    def _passages(
        self,
        path: MotionTrajectory,
        song: HeardSong,
        prompt: str | None,
        tag: str | None,
        seed: int,
    ) -> Sequence[Passage]:
        if prompt is not None:
            return [Passage(prompt, path.num_frames, tag)]
        assert self.prompter is not None, "give a prompt, or a prompter that finds one"
        return self.prompter.passages(song.condition, song.phase, path, seed=seed)

    def _embedded(self, passages: Sequence[Passage]) -> Tensor:
        return self.performer.generator.encode_prompts([each.text for each in passages]).pooled


def finished(raw: MotionTrajectory) -> MotionTrajectory:
    """A path as it is written to files, and pinned: post-processed."""
    return MotionTrajectory(MotionPostProcessor().process(raw.data), raw.fps)


def candidate_seed(seed: int, song: int, number: int) -> int:
    """A seed of its own for each candidate of each song."""
    mixed = np.random.SeedSequence((seed, song, number)).generate_state(1, np.uint64)
    return int(mixed[0] >> np.uint64(1))


def _from(progress: Progress, before: int, total: int) -> Progress:
    return lambda done, _: progress(before + done, total)


def perform(
    audio: str | Path,
    prompt: str | None = None,
    *,
    path: SongGenerator | None = None,
    performer: Performer | None = None,
    seconds: float | None = None,
    style: np.ndarray | None = None,
    num_samples: int = 1,
    seed: int = 0,
    device: str = "auto",
) -> Dances:
    """A sound file and a sentence become dances, the best first: all of it in one call.

    Args:
        audio: wav, flac, ogg or mp3.
        prompt: what the body does; None = what the music says.
        path: the audio branch; None = `starter-audio`.
        performer: of bodies; None = with `starter`.
        seconds: only the first so many; None = all.
        style: of the path, [8] unit; None = what the prompt says of it, else the model's choice.
        num_samples: candidates N.
        seed: 0 or more.
        device: auto, cuda, mps or cpu, for what is loaded here.

    Raises:
        UserError: the file or a model cannot be used.
    """
    from ..audio.song import analyse

    path = path or SongGenerator.from_pretrained("starter-audio", device=device)
    performer = performer or Performer(MotionGenerator.from_pretrained("starter", device=device))
    song = analyse(audio)
    listened = HeardSong.of(song, seconds)
    if style is None and prompt is not None:
        style = performer.generator.style_of(prompt)
    settings = of_song(SampleSettings(num_samples=num_samples, seed=seed), song)
    raw = path.generate(listened.condition, phase=listened.phase, style=style, settings=settings)
    prompter = None if prompt else DancePrompter.beside(performer.generator)
    dancers = SongPerformer(performer, prompter=prompter)
    return dancers.dance(raw, listened, prompt, seed=seed)
