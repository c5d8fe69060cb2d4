"""The 163 features of a song at 30 frames a second (TECH section 4), all from one STFT.

Values are those of the document's librosa calls, but for chroma, which by default is a faster
transform (see spectrum.py). Memory is bounded: spectra live for 512 frames.
Letters: S samples, T frames.
"""

from dataclasses import dataclass, fields
from pathlib import Path
from typing import Literal

import numpy as np

from ..errors import UserError
from ..io.arrays import BadArray, load_arrays, write_arrays
from .sound import HOP, SAMPLE_RATE, Sound, load_sound
from .spectrum import (
    N_FFT,
    TuningEstimator,
    decibels,
    exact_chroma,
    fast_chroma,
    mel_matrix,
    spectra,
)

MAX_VALUES = 1 << 25  # numbers: the 128 rows of two hours at 30 frames a second, and some


def read_arrays(path: str | Path) -> dict[str, np.ndarray]:
    """Read every array of an npz; checksums are verified.

    Raises:
        UserError: missing, no npz, or damaged.
    """
    try:
        return load_arrays(path, max_values=MAX_VALUES)
    except FileNotFoundError:
        raise UserError(f"{path} does not exist; name a features file (.npz)") from None
    except (OSError, BadArray) as error:
        raise UserError(
            f"{path} is no features file, or is damaged ({error}); make it again"
        ) from error


Chroma = Literal["fast", "cqt"]
MELS, MFCCS = 128, 20
MEL_HERTZ = (20.0, 8000.0)
FULL_HERTZ = (0.0, SAMPLE_RATE / 2)
TINY = 1e-8
DCT_BLOCK = 18_000  # frames in double precision at a time
STILL_DB = 1e-2  # an MFCC that varies less is constant; its z-score would be rounding noise


@dataclass(frozen=True)
class AudioFeatures:
    """Features of T frames at 30 fps, float32, each scaled over the whole song.

    Attributes:
        mel: [128,T] in dB, 20 to 8000 Hz, 0 to 1.
        chroma: [12,T], the strongest class of a frame is 1.
        mfcc: [20,T], zero mean and unit variance.
        rms: [T], 0 to 1.
        spectral_centroid: [T], 0 to 1.
        onset_strength: [T], 0 to 1.
    """

    mel: np.ndarray
    chroma: np.ndarray
    mfcc: np.ndarray
    rms: np.ndarray
    spectral_centroid: np.ndarray
    onset_strength: np.ndarray

    @property
    def num_frames(self) -> int:
        """T."""
        return int(self.mel.shape[1])

    def arrays(self) -> dict[str, np.ndarray]:
        """Name to array, in the order of `stack`."""
        return {f.name: getattr(self, f.name) for f in fields(self)}

    def stack(self) -> np.ndarray:
        """[163,T] float32: mel, chroma, MFCC, RMS, centroid, onset strength (TECH 4.3)."""
        return np.concatenate([np.atleast_2d(array) for array in self.arrays().values()])

    def save(self, path: str | Path) -> Path:
        """Write an npz with one array a feature.

        Raises:
            UserError: the file cannot be written.
        """
        return write_arrays(self.arrays(), path)

    @classmethod
    def load(cls, path: str | Path) -> "AudioFeatures":
        """Read what `save` wrote; arrays that are no feature are left alone.

        Raises:
            UserError: missing, broken or incomplete.
        """
        return cls.from_arrays(read_arrays(path), path)

    @classmethod
    def from_arrays(cls, arrays: dict[str, np.ndarray], path: str | Path) -> "AudioFeatures":
        """Check and take the features out of `arrays` that came from `path`.

        Raises:
            UserError: a feature is missing or has another shape.
        """
        rows = {"mel": MELS, "chroma": 12, "mfcc": MFCCS}
        frames = arrays["onset_strength"].size if "onset_strength" in arrays else 0
        for name in (f.name for f in fields(cls)):
            wanted = (rows[name], frames) if name in rows else (frames,)
            found = arrays[name].shape if name in arrays else None
            if found != wanted:
                raise UserError(f"{path}: array {name} is {found}, not {wanted}; make it again")
            if arrays[name].dtype.kind not in "fiu":
                raise UserError(f"{path}: array {name} holds no numbers; make it again")
        return cls(**{f.name: arrays[f.name].astype(np.float32) for f in fields(cls)})


def extract_features(source: str | Path | Sound, *, chroma: Chroma = "fast") -> AudioFeatures:
    """TECH section 4.2's features of a sound, cropped to T = round(30 · seconds) frames.

    Raises:
        UserError: the file cannot be used (see `load_sound`).
    """
    sound = source if isinstance(source, Sound) else load_sound(source)
    samples, count = sound.samples, 1 + len(sound.samples) // HOP
    mel, full_mel = np.empty((count, MELS), np.float32), np.empty((count, MELS), np.float32)
    rms, centroid = np.empty(count, np.float32), np.empty(count, np.float32)
    frequencies = np.fft.rfftfreq(N_FFT, 1 / SAMPLE_RATE).astype(np.float32)
    estimator = TuningEstimator()
    for block, frames, power in spectra(samples, HOP):
        part = slice(block.start, block.stop)
        mel[part] = power @ mel_matrix(MELS, *MEL_HERTZ)
        full_mel[part] = power @ mel_matrix(MELS, *FULL_HERTZ)
        rms[part] = np.sqrt(np.square(frames).mean(axis=1))
        magnitude = np.sqrt(power)
        total = magnitude.sum(axis=1)
        centroid[part] = magnitude @ frequencies / np.where(total > 0, total, 1)
        if chroma == "fast":
            estimator.add(power)
    full_db = decibels(full_mel)
    classes = (
        fast_chroma(samples, estimator.tuning()) if chroma == "fast" else exact_chroma(samples)
    )
    whole = {
        "mel": _stretched(decibels(mel, reference=mel.max())).T,
        "chroma": classes,
        "mfcc": _mfcc(full_db).T,
        "rms": _unit_peak(rms),
        "spectral_centroid": _stretched(centroid),
        "onset_strength": _unit_peak(_onset_strength(full_db)),
    }
    # librosa's centred frames are one too many for most lengths; scaled with it, cropped after.
    cropped = {name: np.ascontiguousarray(a[..., : sound.num_frames]) for name, a in whole.items()}
    return AudioFeatures(**cropped)


def _mfcc(full_db: np.ndarray) -> np.ndarray:
    """Mel spectra [T,128] in dB -> standardised cepstra [T,20]."""
    from scipy.fft import dct

    cepstra = np.concatenate(
        [
            dct(full_db[first : first + DCT_BLOCK].astype(np.float64), norm="ortho")[:, :MFCCS]
            for first in range(0, len(full_db), DCT_BLOCK)
        ]
    )
    spread = cepstra.std(axis=0)
    spread[spread < STILL_DB] = np.inf
    return np.asarray(((cepstra - cepstra.mean(axis=0)) / (spread + TINY)).astype(np.float32))


def _onset_strength(full_db: np.ndarray) -> np.ndarray:
    """Mean rise of the mel bands [T,128] since the frame before, [T]: spectral flux."""
    rise = np.maximum(0, np.diff(full_db, axis=0, prepend=full_db[:1]))
    return np.asarray(rise.mean(axis=1))


def _stretched(values: np.ndarray) -> np.ndarray:
    low, high = values.min(), values.max()
    return np.asarray((values - low) / (high - low + np.float32(TINY)))


def _unit_peak(values: np.ndarray) -> np.ndarray:
    return np.asarray(values / (values.max() + np.float32(TINY)))
