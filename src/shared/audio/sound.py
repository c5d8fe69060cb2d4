"""Sound files of any rate and channel count become mono float32 samples at 44.1 kHz, in chunks."""

import hashlib
from array import array
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np

from ..errors import UserError
from ..io.files import sha256_file
from ..io.sound_files import MAX_SECONDS, Mender, SoundReader, too_long

SAMPLE_RATE = 44_100
FPS = 30
HOP = SAMPLE_RATE // FPS  # samples of a frame
MIN_SECONDS = 1.0
CHUNK_SECONDS = 10.0
CANCELS = 0.02  # energy of the mix, by what the loudest channel alone would have in it
CANCELLED = "{}: its channels cancel each other out when mixed; the loudest alone is heard"
SAMPLES = Path("samples")  # of a sound that came from no file


@dataclass(frozen=True)
class Sound:
    """Mono sound at 44.1 kHz.

    Attributes:
        samples: [S] float32, finite; full scale is 1.
        path: where it came from.
        sha256: of the file, or of the samples where there is no file.
        notes: one line each: what was wrong and could be mended.
    """

    samples: np.ndarray
    path: Path = SAMPLES
    sha256: str = ""
    notes: tuple[str, ...] = field(default=())
    sample_rate: int = SAMPLE_RATE

    @property
    def seconds(self) -> float:
        """Duration."""
        return len(self.samples) / self.sample_rate

    @property
    def num_frames(self) -> int:
        """T, frames of a motion or of features at 30 fps."""
        return round(self.seconds * FPS)


def load_sound(path: str | Path) -> Sound:
    """Read a whole sound file; a damaged one as far as it goes, which `notes` tells.

    Raises:
        UserError: missing, no sound file, shorter than 1 s, longer than 2 h, nothing but NaN.
    """
    path = Path(path)
    mono, notes, loudest = _read(path)
    if loudest is not None:
        del mono  # hours of sound lie in memory once
        mono, notes, _ = _read(path, loudest)
        notes = (*notes, CANCELLED.format(path))
    sound = Sound(mono, path, sha256_file(path), notes)
    _check_length(sound)
    return sound


def _read(path: Path, channel: int | None = None) -> tuple[np.ndarray, tuple[str, ...], int | None]:
    """Samples [S] of a channel, None = of all; what was mended; which one to take instead."""
    reader = SoundReader(path)
    mixer = _Mixer(reader.rate, channel)
    samples = array("f")  # grows where it is: chunks joined in the end would lie there twice
    for block in reader.blocks(max(1, round(CHUNK_SECONDS * reader.rate))):
        samples.frombytes(mixer.push(block).tobytes())
    samples.frombytes(mixer.finish().tobytes())
    return np.frombuffer(samples, np.float32), tuple(reader.notes()), mixer.instead


def check_sound(path: str | Path) -> None:
    """Refuse at once what `load_sound` would refuse after whatever else has to be done first.

    The header tells, and where it tells of next to nothing, reading all of it.

    Raises:
        UserError: missing, no sound file, shorter than 1 s, longer than 2 h.
    """
    if SoundReader(Path(path)).claimed < MIN_SECONDS:
        load_sound(path)


def sound_from_samples(samples: np.ndarray, sample_rate: int = SAMPLE_RATE) -> Sound:
    """A sound out of samples [S] or [S,channels] in memory, mended and resampled like a file.

    Raises:
        UserError: shorter than 1 s, longer than 2 h, nothing but NaN.
    """
    samples = np.atleast_2d(np.asarray(samples, dtype=np.float32).T).T  # [S,channels]
    mender, mixer = Mender(), _Mixer(sample_rate)
    samples = mender.mend(samples)
    mono, notes = np.concatenate([mixer.push(samples), mixer.finish()]), list(mender.notes(SAMPLES))
    if mixer.instead is not None:
        mixer, notes = _Mixer(sample_rate, mixer.instead), [*notes, CANCELLED.format(SAMPLES)]
        mono = np.concatenate([mixer.push(samples), mixer.finish()])
    digest = hashlib.sha256(mono.tobytes()).hexdigest()
    sound = Sound(mono, SAMPLES, digest, tuple(notes))
    _check_length(sound)
    return sound


def _check_length(sound: Sound) -> None:
    if sound.num_frames < MIN_SECONDS * FPS:
        why = f" ({sound.notes[0]})" if sound.notes else ""
        raise UserError(
            f"{sound.path} lasts {sound.seconds:.2f} s{why}; at least {MIN_SECONDS:g} s are needed"
        )
    if sound.seconds > MAX_SECONDS:
        raise too_long(sound.path, sound.seconds)


class _Mixer:
    """Mixes down all channels, or takes one, and resamples a stream of samples."""

    def __init__(self, rate: int, channel: int | None = None) -> None:
        self._resampler: Any = None
        self._channel, self._mixed = channel, 0.0
        self._apart = np.zeros(0)  # energy of each channel; the one before: of the mix
        if rate != SAMPLE_RATE:
            import soxr

            self._resampler = soxr.ResampleStream(rate, SAMPLE_RATE, 1, "float32", quality="HQ")

    def push(self, samples: np.ndarray) -> np.ndarray:
        """[s,channels] at the file's rate -> [S] at 44.1 kHz."""
        if self._channel is not None:
            samples = samples[:, self._channel, None]
        mono = samples.mean(axis=1, dtype=np.float32)
        self._mixed += float(np.vdot(mono, mono))
        energies = np.einsum("sc,sc->c", samples, samples)
        self._apart = energies + self._apart if self._apart.size else energies
        return np.asarray(mono if self._resampler is None else self._resampler.resample_chunk(mono))

    @property
    def instead(self) -> int | None:
        """The loudest channel, where the mix is next to nothing beside it: one wire is crossed."""
        loudest = int(self._apart.argmax()) if self._apart.size else 0
        alone = float(self._apart.max(initial=0.0)) / max(self._apart.size, 1) ** 2  # in the mix
        return loudest if self._mixed < CANCELS * alone else None

    def finish(self) -> np.ndarray:
        """The samples that the resampler still holds."""
        nothing = np.zeros(0, np.float32)
        if self._resampler is None:
            return nothing
        return np.asarray(self._resampler.resample_chunk(nothing, last=True))


QUIET, AROUND = 10 ** (-50 / 20), 1.0  # of the loudest tenth of a second; seconds


def loud_part(sound: np.ndarray, sample_rate: int) -> tuple[int, int]:
    """First and last-plus-one sample of what is within QUIET of the loudest, AROUND on either
    side left; where no more than twice that would go, nothing does."""
    size, around = max(sample_rate // 10, 1), round(AROUND * sample_rate)
    pieces = sound[: len(sound) // size * size].reshape(-1, size)
    level = np.sqrt(np.einsum("ps,ps->p", pieces, pieces) / size)  # no copy of hours of sound
    loud = np.flatnonzero(level > QUIET * level.max(initial=0.0))
    if not len(loud):
        return 0, len(sound)
    first, last = int(loud[0]) * size - around, (int(loud[-1]) + 1) * size + around
    return (first if first > around else 0), (last if last < len(sound) - around else len(sound))
