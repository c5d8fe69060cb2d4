"""What the audio branch is measured with: settings, held-out songs, the motions made for them.

Letters: T frames, N songs.
"""

import io
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from functools import cache, cached_property
from pathlib import Path
from typing import Any
from zlib import crc32

import numpy as np

from ..audio.synthetic_songs import render_song
from ..data.phrases.dataset import MotionPhraseDataset
from ..errors import UserError
from ..io.files import atomic_write
from ..metrics.rhythm import MotionBeats, motion_beats, strangers
from ..metrics.sanity import frozen
from ..motion.trajectory import FPS, MotionTrajectory
from ..pipelines.song import SongGenerator, own_noise
from ..pipelines.song_sampler import SongSampling
from .audio_songs import (
    Piece,
    held_out_songs,
    held_out_specs,
    open_split,
    phrases,
    tracks,
)
from .samples import Dance, DanceSample
from .suites.sanity import untrained

Progress = Callable[[str], None]
Made = list[tuple[Piece, MotionTrajectory]]


@dataclass(frozen=True)
class AudioSettings:
    """How much is measured; the report repeats it."""

    num_songs: int = 50
    song_seconds: float = 16.0
    replications: int = 20
    untrained: int = 3  # replications of the untrained row, at most; 0 = no row
    own_count: int = 10  # songs made once more, the phase not held to the beat tracker
    tell_meter: bool = True
    max_real: int = 200  # test phrases
    track_seconds: float = 30.0  # of each sound file
    pictures: int = 4
    worst: int = 4  # motions to be looked at, each with its song
    seed: int = 0


@dataclass(frozen=True, eq=False)
class Picture:
    """What a plot of one song needs: bars [T] by name, beats, and where the motion slows down."""

    name: str
    bars: dict[str, np.ndarray]
    beats: np.ndarray
    motion: MotionBeats

    @classmethod
    def of(cls, piece: Piece, trajectory: MotionTrajectory) -> "Picture":
        """Of a motion on its song."""
        bars = {} if piece.bars is None else {"truth": piece.bars}
        bars |= {} if piece.phase is None else {"beat tracker": piece.phase}
        bars["generated"] = trajectory.phase_unwrapped
        motion = motion_beats(trajectory.position, trajectory.fps)
        return cls(piece.name, bars, piece.beats[piece.beats < piece.seconds], motion)


class AudioContext:
    """Everything a table of the audio branch may draw on; songs and motions are made once.

    Args:
        generator: a trained audio branch.
        settings: how much.
        data: folder or bucket of pairs, whose test split is the real row; None = no such row.
        songs: folder of sound files; None = none.
        sampling: steps, sampler, guidance_scale; None = the model's own.
        progress: told what begins.
    """

    def __init__(
        self,
        generator: SongGenerator,
        settings: AudioSettings,
        *,
        data: str | None = None,
        songs: Path | None = None,
        sampling: dict[str, Any] | None = None,
        progress: Progress = lambda text: None,
    ) -> None:
        self.generator, self.settings, self.progress = generator, settings, progress
        self.data, self.songs = data, songs
        given = SongSampling(**(sampling or {}))
        self.sampled = given.resolved(generator.model.config)
        self.made = cache(self._made)
        self.made_untrained = cache(self._made_untrained)

    @cached_property
    def pieces(self) -> list[Piece]:
        """Held-out synthetic songs."""
        settings = self.settings
        self.progress(f"{settings.num_songs} songs of {settings.song_seconds:g} s")
        return list(
            held_out_songs(
                settings.num_songs,
                settings.song_seconds,
                settings.seed,
                tell_meter=settings.tell_meter,
            )
        )

    def write_song(self, index: int, path: Path) -> None:
        """A held-out song as a FLAC file, for the report."""
        import soundfile

        settings = self.settings
        specs = held_out_specs(settings.num_songs, settings.song_seconds, settings.seed)
        song = render_song(specs[index])
        sound = io.BytesIO()  # libsndfile does not say what the disk said
        soundfile.write(sound, song.samples, song.sample_rate, subtype="PCM_16", format="FLAC")
        with atomic_write(path) as temporary:
            temporary.write_bytes(sound.getvalue())

    def dance(
        self,
        piece: Piece,
        *,
        replication: int = 0,
        held: bool = True,
        generator: SongGenerator | None = None,
    ) -> MotionTrajectory:
        """A motion for a song, with noise of its own; not `held`, it counts the phase for itself.

        With one noise for all, fifty songs would hold fifty times one walk.
        """
        settings = replace(self.sampled, seed=self.settings.seed)
        settings = own_noise(settings, replication, crc32(piece.name.encode()))
        return (generator or self.generator).generate(
            piece.condition,
            phase=piece.phase if held else None,
            settings=settings,
        )[0]

    def _made(self, replication: int) -> Made:
        """A motion for each held-out song."""
        return [(piece, self.dance(piece, replication=replication)) for piece in self.pieces]

    def _made_untrained(self, replication: int) -> Made:
        """The same by the same network with fresh weights."""
        return [
            (piece, self.dance(piece, replication=replication, generator=self.fresh))
            for piece in self.pieces
        ]

    @cached_property
    def played(self) -> Made:
        """A motion for each sound file."""
        if self.songs is None:
            return []
        made = []
        for piece in tracks(self.songs, self.settings.track_seconds):
            self.progress(piece.name)
            made.append((piece, self.dance(piece)))
        return made

    # ---------------------------------------------------------------- samples

    @cached_property
    def split(self) -> MotionPhraseDataset | None:
        """The test split, in windows as long as the songs; None without data.

        Raises:
            UserError: there is none.
        """
        if self.data is None:
            return None
        frames = round(self.settings.song_seconds * FPS)
        return open_split(self.data, "test", frames, self.settings.seed)

    @property
    def fingerprint(self) -> str:
        """Hash of the data; empty without."""
        return "" if self.split is None else self.split.fingerprint

    @cached_property
    def reference(self) -> DanceSample:
        """Real motion of the test split with its music; empty without data.

        Raises:
            UserError: no phrase of the split has a beat.
        """
        if self.data is None:
            return DanceSample([], np.zeros(0, dtype=int))
        self.progress(f"the test split of {self.data}")
        assert self.split is not None
        known = [p for p in phrases(self.split, self.settings.max_real) if len(p.beats) > 1]
        if not known:
            raise UserError(
                f"{self.data}: no test phrase has a beat; make the pairs with prepare-audio"
            )
        dances = [Dance(phrase.song, phrase.motion, phrase.beats) for phrase in known]
        return DanceSample(dances, np.arange(len(dances)))

    def real(self, replication: int) -> DanceSample:
        """The same phrases each time."""
        return self.reference

    def generated(self, replication: int) -> DanceSample:
        """The model's motions on their own songs."""
        return sample_of(self.made(replication))

    def chance(self, replication: int) -> DanceSample:
        """The same motions, each on another song: what not listening scores."""
        sample = self.generated(replication)
        rng = np.random.default_rng([self.settings.seed, 4, replication])
        return sample.reordered(strangers(len(sample), rng))

    def frozen_pose(self, replication: int) -> DanceSample:
        """The first pose of each motion held while the music goes on."""
        return sample_of([(piece, frozen(motion)) for piece, motion in self.made(0)])

    def untrained(self, replication: int) -> DanceSample:
        """Motions of the same network with fresh weights."""
        return sample_of(self.made_untrained(replication))

    @cached_property
    def fresh(self) -> SongGenerator:
        """The same network with fresh weights, the last layer included."""
        fresh = untrained(self.generator.model, self.settings.seed)
        return SongGenerator(fresh, device=str(self.generator.device))


def sample_of(made: Sequence[tuple[Piece, MotionTrajectory]]) -> DanceSample:
    """Motions on songs as a sample; no real motion belongs to a song that was made up."""
    dances = [
        Dance(piece.name, motion, piece.beats, piece.bars, piece.true_meter, piece.meter)
        for piece, motion in made
    ]
    return DanceSample(dances, np.full(len(dances), -1))
