"""One song, analysed: features at 30 fps, beats, bar phase; remembered by content.

Analysed songs lie in $MOTIONGEN_AUDIO_CACHE, else in motionsuite/audio in the user's cache folder,
and are found again by the content of the sound file and the parameters. An entry is written whole
or not at all; one that cannot be read is made again.

Letters: T frames, N beats, M downbeats.
"""

import hashlib
import json
import logging
import os
from dataclasses import dataclass
from functools import lru_cache
from pathlib import Path
from typing import Any

import numpy as np

from ..errors import UserError
from ..io.arrays import write_arrays
from ..io.files import sha256_file
from .beats import GAP, Beats, track_beats
from .features import AudioFeatures, Chroma, extract_features, read_arrays
from .sound import FPS, Sound, load_sound

FOLDER_VARIABLE = "MOTIONGEN_AUDIO_CACHE"

log = logging.getLogger(__name__)


def cache_folder() -> Path:
    """Where entries lie unless a caller says otherwise."""
    if chosen := os.environ.get(FOLDER_VARIABLE):
        return Path(chosen).expanduser()
    base = os.environ.get("XDG_CACHE_HOME") or "~/.cache"
    return Path(base).expanduser() / "motionsuite" / "audio"


@lru_cache(maxsize=1)
def code_version() -> str:
    """Changes with any source file of this package: other code may find other beats."""
    sources = sorted(Path(__file__).parent.glob("*.py"))
    return hashlib.sha256(b"".join(source.read_bytes() for source in sources)).hexdigest()


@dataclass(frozen=True, eq=False)
class Song:
    """What the network and the previews need to know of a song.

    Attributes:
        features: 163 rows of T frames.
        beats: tempo, beat and downbeat times.
        seconds: duration of the sound.
        sha256: of the sound file.
        notes: one line each: what was wrong with the file and mended.
    """

    features: AudioFeatures
    beats: Beats
    seconds: float
    sha256: str
    notes: tuple[str, ...] = ()

    @classmethod
    def read(cls, path: str | Path, *, meter: int | None = None) -> "Song":
        """See `analyse`."""
        return analyse(path, meter=meter)

    @property
    def num_frames(self) -> int:
        """T."""
        return self.features.num_frames

    @property
    def phase(self) -> np.ndarray:
        """Unwrapped bar phase [T] float64, in bars: whole numbers at downbeats (ruling 9)."""
        return bar_phase(self.beats, self.num_frames, FPS)

    def arrays(self) -> dict[str, np.ndarray]:
        """The dictionary of TECH section 4.2, and downbeats, phase, meter and origin."""
        return {
            **self.features.arrays(),
            "tempo": np.array(self.beats.tempo, np.float64),
            "beat_times": np.asarray(self.beats.beat_times, np.float64),
            "downbeat_times": np.asarray(self.beats.downbeat_times, np.float64),
            "phase": self.phase,
            "meter": np.array(self.beats.meter, np.int32),
            "beat_confidence": np.array(self.beats.confidence, np.float64),
            "seconds": np.array(self.seconds, np.float64),
            "sha256": np.array(self.sha256),
            "notes": np.array(self.notes, dtype=np.str_),
        }

    def save(self, path: str | Path) -> Path:
        """Write `arrays` as an npz; raises UserError where it cannot be written."""
        return write_arrays(self.arrays(), Path(path))

    @classmethod
    def from_arrays(cls, arrays: dict[str, np.ndarray], path: str | Path) -> "Song":
        """The inverse of `arrays`, which came from `path`.

        Raises:
            UserError: something is missing or has another shape.
        """
        try:
            beats = Beats(
                tempo=float(arrays["tempo"]),
                beat_times=arrays["beat_times"].astype(np.float64),
                downbeat_times=arrays["downbeat_times"].astype(np.float64),
                meter=int(arrays["meter"]),
                confidence=float(arrays["beat_confidence"]),
            )
            seconds, sha256 = float(arrays["seconds"]), str(arrays["sha256"])
            notes = tuple(str(note) for note in arrays["notes"])
        except (KeyError, TypeError, ValueError) as error:
            raise UserError(f"{path} is no analysed song ({error}); make it again") from error
        return cls(AudioFeatures.from_arrays(arrays, path), beats, seconds, sha256, notes)


def analyse_sound(sound: Sound, *, meter: int | None = None, chroma: Chroma = "fast") -> Song:
    """Features and beats of a sound in memory.

    Args:
        meter: beats a bar; None: 3 or 4, whichever fits better.
        chroma: `fast`, or `cqt` for librosa's own at many times the cost.
    """
    features = extract_features(sound, chroma=chroma)
    beats = track_beats(sound.samples, sound.sample_rate, meter=meter)
    return Song(features, beats, sound.seconds, sound.sha256, sound.notes)


def analyse(
    path: str | Path,
    *,
    meter: int | None = None,
    chroma: Chroma = "fast",
    cache: bool | Path = True,
) -> Song:
    """Features and beats of a sound file, from the cache where its content is known.

    Args:
        meter, chroma: as of `analyse_sound`.
        cache: use the user's cache folder, none, or this one.

    Raises:
        UserError: the file cannot be used (see `load_sound`).
    """
    folder = cache if isinstance(cache, Path) else cache_folder() if cache else None
    file, entry, song = Path(path), None, None
    if folder is not None and file.is_file():
        entry = _entry(folder, sha256_file(file), meter=meter, chroma=chroma)
        song = _remembered(entry)
    if song is None:
        song = analyse_sound(load_sound(file), meter=meter, chroma=chroma)
        if entry is not None:
            try:
                song.save(entry)
            except UserError as error:  # a warning, not an end
                log.warning("not cached: %s; $%s names another folder", error, FOLDER_VARIABLE)
    for note in song.notes:
        log.warning("%s: %s", path, note)
    return song


def _entry(folder: Path, sha256: str, **parameters: Any) -> Path:
    """File of an analysed song: one for each content, parameters and version of the code."""
    text = json.dumps({"version": code_version(), **parameters}, sort_keys=True)
    tail = hashlib.sha256(text.encode()).hexdigest()[:12]
    return folder / f"{sha256}-{tail}.npz"


def _remembered(entry: Path) -> Song | None:
    """The song of an entry, if it is there and whole."""
    if not entry.exists():
        return None
    try:
        return Song.from_arrays(read_arrays(entry), entry)
    except UserError as error:
        log.warning("made again: %s", error)
        return None


DEFAULT_TEMPO = 120.0  # BPM of the phase where a song has no beat


def bar_phase(beats: Beats, num_frames: int, fps: float = 30.0) -> np.ndarray:
    """Unwrapped bar phase [num_frames] (float64, bars): whole numbers at downbeats, rising.

    Linear between beats, carried on at both ends with the pace of the nearest bar. The
    first downbeat is 0. Without beats it runs at DEFAULT_TEMPO from 0 (confidence is 0 then).
    """
    frames = np.arange(num_frames) / fps
    times = beats.beat_times
    if len(times) < 2:
        return frames * DEFAULT_TEMPO / 60 / beats.meter
    bars = _bars_at_beats(times, beats.downbeat_times, beats.meter)
    near = min(beats.meter, len(times) - 1)
    head = (bars[near] - bars[0]) / (times[near] - times[0])
    tail = (bars[-1] - bars[-1 - near]) / (times[-1] - times[-1 - near])
    phase = np.interp(frames, times, bars)
    phase = np.where(frames < times[0], bars[0] + (frames - times[0]) * head, phase)
    return np.asarray(np.where(frames > times[-1], bars[-1] + (frames - times[-1]) * tail, phase))


def _bars_at_beats(times: np.ndarray, downbeats: np.ndarray, meter: int) -> np.ndarray:
    """Bars [N] at each beat: whole at downbeats, equal steps between, 1 / meter outside them; a gap
    counts as many beats as it lasts."""
    steps = np.diff(times)
    silent = np.where(steps > GAP, np.rint(steps / np.median(steps)) - 1, 0)  # beats of each gap
    numbers = np.arange(len(times)) + np.concatenate(([0.0], np.cumsum(silent)))
    if not len(downbeats):
        return numbers / meter
    opening = numbers[np.searchsorted(times, downbeats)]
    has_gap = np.diff(opening) > np.diff(np.searchsorted(times, downbeats))
    bars = np.where(has_gap, np.maximum(np.rint(np.diff(opening) / meter), 1), 1)
    bars = np.concatenate(([0.0], np.cumsum(bars)))
    found = np.interp(numbers, opening, bars)
    found = np.where(numbers < opening[0], (numbers - opening[0]) / meter, found)
    after = bars[-1] + (numbers - opening[-1]) / meter
    return np.asarray(np.where(numbers > opening[-1], after, found))
