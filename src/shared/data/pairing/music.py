"""Where the music of pairs comes from: a folder of sound files, or synthetic songs.

A synthetic song's beats, bars and phase are known exactly and are taken from its score; of a
recording they are estimated.
"""

import re
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from ...audio.features import AudioFeatures, extract_features
from ...audio.song import analyse
from ...audio.sound import sound_from_samples
from ...audio.synthetic import SongSpec, render_song, sample_song_specs
from ...errors import UsageError, UserError
from ...io.files import sha256_file
from ...io.storage import Place, fetched, files_below, place, relative_name
from ..prepared import assign_alike
from .pair import MusicBeats, strong_beats

FPS = 30.0
SYNTHETIC_SECONDS = 60.0
TEST_SHARE, VAL_SHARE = 0.1, 0.08  # of synthetic songs; the test songs have tempi of their own
SOUND_FILES = (".wav", ".flac", ".ogg", ".mp3", ".aiff", ".aif", ".opus")


@dataclass(frozen=True)
class SongEntry:
    """A song before it is read.

    Attributes:
        id: names its phrases.
        split: train, val or test.
        fingerprint: changes when the sound does.
        path: of the sound file, relative to its folder.
    """

    id: str
    split: str
    fingerprint: str
    path: str = ""


@dataclass(frozen=True, eq=False)
class Music:
    """A song at 30 fps.

    Attributes:
        features: arrays [C,T] and [T] of features.npz by name.
        phase: unwrapped bars [T] float64.
        beat_times, downbeat_times: seconds.
        tempo: beats a minute, 0 = none.
        meter: beats a bar.
    """

    features: dict[str, np.ndarray]
    phase: np.ndarray
    beat_times: np.ndarray
    downbeat_times: np.ndarray
    tempo: float
    meter: int

    @property
    def num_frames(self) -> int:
        return len(self.phase)

    def beats_around(self, begin: float, end: float) -> MusicBeats:
        """Beats from 2 s before `begin` to 2 s after `end`, in seconds after `begin`."""
        kept = (self.beat_times > begin - 2) & (self.beat_times < end + 2)
        times = self.beat_times[kept]
        bars = np.interp(times, np.arange(self.num_frames) / FPS, self.phase)
        numbers = np.rint(bars * self.meter).astype(int)
        return MusicBeats(times - begin, strong_beats(numbers, self.meter))


@dataclass(frozen=True)
class SyntheticMusic:
    """Rendered songs; the test songs' tempi occur in no other."""

    number: int
    seed: int = 0
    seconds: float = SYNTHETIC_SECONDS

    def entries(self) -> list[SongEntry]:
        """All songs, in a stable order."""
        return [
            SongEntry(f"synthetic-{self.seed}-{index:05d}", split, repr(spec))
            for index, (split, spec) in enumerate(self.specs())
        ]

    def specs(self) -> list[tuple[str, SongSpec]]:
        """(split, song) of each."""
        test = max(round(TEST_SHARE * self.number), self.number >= 3)
        val = max(round(VAL_SHARE * self.number), self.number >= 3)
        seen = sample_song_specs(self.number - test, self.seed, "train", seconds=self.seconds)
        unseen = sample_song_specs(test, self.seed, "held-out", seconds=self.seconds)
        splits = ["val"] * val + ["train"] * (len(seen) - val)
        return [*zip(splits, seen, strict=True), *(("test", spec) for spec in unseen)]

    def read(self, entry: SongEntry) -> Music:
        """One song."""
        _, spec = self.specs()[int(entry.id.rpartition("-")[2])]
        song = render_song(spec)
        features = extract_features(sound_from_samples(song.samples, song.sample_rate))
        beats, phase = song.beat_times, song.phase(features.num_frames)
        tempo = 60.0 / float(np.median(np.diff(beats)))
        arrays = feature_arrays(features)
        return Music(arrays, phase, beats, song.downbeat_times, tempo, spec.meter)


@dataclass(frozen=True)
class FolderMusic:
    """Every sound file below a folder; beats are tracked."""

    root: Place
    meter: int | None = None  # 3 or 4, as each song sounds
    seed: int = 0

    def entries(self) -> list[SongEntry]:
        """All songs, in a stable order; raises UserError where there is none."""
        found = [p for p in files_below(self.root) if p.suffix.lower() in SOUND_FILES]
        if not found:
            raise UserError(
                f"--music {self.root} holds no sound file ({', '.join(SOUND_FILES)});"
                " name a folder that does, or synthetic:N"
            )
        by_hash: dict[str, Place] = {}
        for path in found:
            by_hash.setdefault(sha256_file(path), path)
        splits = assign_alike(list(by_hash), self.seed)
        entries = []
        for digest, path in by_hash.items():
            slug = re.sub(r"[^a-z0-9]+", "-", path.stem.lower()).strip("-")[:40] or "song"
            name, fingerprint = f"{slug}-{digest[:8]}", f"{digest}:{self.meter}"
            file = relative_name(path, self.root)
            entries.append(SongEntry(name, splits[digest], fingerprint, file))
        return entries

    def read(self, entry: SongEntry) -> Music:
        """One song; raises UserError where it cannot be used."""
        with fetched(self.root / entry.path) as file:
            song = analyse(file, meter=self.meter)
        beats, arrays = song.beats, feature_arrays(song.features)
        times = (beats.beat_times, beats.downbeat_times)
        return Music(arrays, song.phase, *times, beats.tempo, beats.meter)


MusicSource = SyntheticMusic | FolderMusic


def feature_arrays(features: AudioFeatures) -> dict[str, np.ndarray]:
    """Arrays of features.npz as float16: they are normalised, three digits are enough."""
    return {name: values.astype(np.float16) for name, values in features.arrays().items()}


def open_music(
    names: Sequence[str], *, seed: int = 0, meter: int | None = None
) -> list[MusicSource]:
    """Sources named on the command line: folders and `synthetic:N`.

    Raises:
        UsageError: no such folder, or N is not a number above 0.
    """
    sources: list[MusicSource] = []
    for name in names:
        kind, _, number = name.partition(":")
        if kind == "synthetic":
            if not number.isdecimal() or not int(number):
                raise UsageError(f"--music {name}: say how many songs, e.g. synthetic:100")
            sources.append(SyntheticMusic(int(number), seed))
        elif not (folder := place(name)).is_dir():
            raise UsageError(f"--music {name} is no folder; name one, or synthetic:N")
        else:
            sources.append(FolderMusic(folder.absolute(), meter, seed))
    return sources
