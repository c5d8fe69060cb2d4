"""The 163 features of a song at 30 frames a second (TECH section 4), all from one STFT.

Values are those of the document's librosa calls, but for chroma, which by default is a faster
transform. Frames, mel bands and decibels are librosa's without its seconds of import. Memory is
bounded: spectra live for 512 frames.

Chroma, the strength of the twelve pitch classes, is exact (`cqt`), or a fraction of the time. Both
are constant-Q transforms of 7 octaves from C1, 36 bins an octave, tuned to the song, folded to 12
classes, the strongest of each frame 1. The exact one is `librosa.feature.chroma_cqt`, block by
block. At hop 1470 = 2·735 that can halve its rate only once, so that its longest filter takes an
FFT of 65,536 samples a frame. The fast one resamples to 15,360 = 30·512 Hz, where every octave
halves both rate and hop, and each octave is one product of short frames with its 36 filters.

Letters: S samples, T frames, N samples of a frame, F = N//2 + 1 frequencies, M mel bands, K = 36
bins of an octave.
"""

from collections.abc import Callable, Iterator
from dataclasses import dataclass, fields
from functools import lru_cache
from pathlib import Path
from typing import Literal

import numpy as np

from ..errors import UsageError, UserError
from ..io.arrays import BadArray, load_arrays
from .sound import FPS, HOP, SAMPLE_RATE, Sound, load_sound

N_FFT, BLOCK = 2048, 512  # samples of a frame, frames that are transformed at a time
FLOOR_POWER = 1e-10
RANGE_DB = 80.0


def centred_frames(samples: np.ndarray, indices: range, size: int, hop: int) -> np.ndarray:
    """Frames [T,N=size] whose middles lie at sample i·hop for i in `indices`; silence outside.

    The result is a view where it can be: do not write into it.
    """
    start = indices.start * hop - size // 2
    stop = (indices.stop - 1) * hop - size // 2 + size
    piece = samples[max(0, start) : stop]
    missing = (max(0, -start), max(0, stop - max(len(samples), start)))
    if any(missing):
        piece = np.pad(piece, missing)[: stop - start]
    return np.lib.stride_tricks.sliding_window_view(piece, size)[::hop]


HANN = (0.5 - 0.5 * np.cos(2 * np.pi * np.arange(N_FFT) / N_FFT)).astype(np.float32)  # periodic


def spectra(
    samples: np.ndarray, hop: int, window: np.ndarray = HANN
) -> Iterator[tuple[range, np.ndarray, np.ndarray]]:
    """Yield (frame indices, frames [t,N], power spectra [t,F]) of the centred STFT."""
    from scipy.fft import rfft  # single precision stays single, unlike numpy's

    count = 1 + len(samples) // hop
    for first in range(0, count, BLOCK):
        indices = range(first, min(first + BLOCK, count))
        frames = centred_frames(samples, indices, len(window), hop)
        spectrum = rfft(frames * window, axis=1)
        yield indices, frames, np.square(spectrum.real) + np.square(spectrum.imag)


@lru_cache(maxsize=8)
def mel_matrix(bands: int, low: float, high: float) -> np.ndarray:
    """Triangular filters [F,M=bands] float32 between `low` and `high` Hz, of equal area.

    Slaney, Auditory Toolbox, 1998: mel linear to 1 kHz, logarithmic above.
    """
    centres = _to_hertz(np.linspace(_to_mel(low), _to_mel(high), bands + 2))
    frequencies = np.fft.rfftfreq(N_FFT, 1 / SAMPLE_RATE)[:, None]
    rising = (frequencies - centres[:-2]) / np.diff(centres)[:-1]
    falling = (centres[2:] - frequencies) / np.diff(centres)[1:]
    triangles = np.maximum(0, np.minimum(rising, falling))
    return np.asarray((triangles * 2 / (centres[2:] - centres[:-2])).astype(np.float32))


_KNEE_HERTZ, _KNEE_MEL, _HERTZ_PER_MEL, _LOG_STEP = 1000.0, 15.0, 200 / 3, np.log(6.4) / 27


def _to_mel(hertz: float) -> float:
    if hertz < _KNEE_HERTZ:
        return hertz / _HERTZ_PER_MEL
    return float(_KNEE_MEL + np.log(hertz / _KNEE_HERTZ) / _LOG_STEP)


def _to_hertz(mel: np.ndarray) -> np.ndarray:
    logarithmic = _KNEE_HERTZ * np.exp(_LOG_STEP * (mel - _KNEE_MEL))
    return np.where(mel < _KNEE_MEL, mel * _HERTZ_PER_MEL, logarithmic)


def decibels(power: np.ndarray, *, reference: float = 1.0) -> np.ndarray:
    """10 log10(power / reference), at most 80 dB below the loudest value of the whole array."""
    level = 10 * np.log10(np.maximum(power, FLOOR_POWER))
    level -= 10 * np.log10(max(reference, FLOOR_POWER))
    return np.asarray(np.maximum(level, level.max() - RANGE_DB))


# ---------------------------------------------------------------- chroma

OCTAVES = 7
BINS = 36  # per octave
CLASSES = 12
LOWEST = 440 * 2 ** (-45 / 12)  # C1, Hz
FAST_RATE, FAST_HOP = FPS * 512, 512
TUNING_HOP = N_FFT // 4
TUNING_HERTZ = (150.0, 4000.0)
PEAK_THRESHOLD = 0.1
FAST_BLOCK, EXACT_BLOCK = 18_000, 600  # frames: what lies in memory at a time
CONTEXT = 90  # frames: the longest filter and the resampler reach 1.6 s


class TuningEstimator:
    """How far a song is off A440: the commonest remainder of its spectral peaks.

    Quadratic interpolation of peaks: Smith and Serra, PARSHL, 1987. Frames come block by block.
    """

    def __init__(self) -> None:
        self._pitches: list[np.ndarray] = []
        self._magnitudes: list[np.ndarray] = []

    def add(self, power: np.ndarray) -> None:
        """Take in power spectra [T,F]."""
        resolution = SAMPLE_RATE / N_FFT
        low, high = (int(np.ceil(hertz / resolution)) for hertz in TUNING_HERTZ)
        loudest = np.sqrt(power.max(axis=1, keepdims=True))
        left, middle, right = (
            np.sqrt(power[:, low + shift : high + shift]) for shift in (-1, 0, 1)
        )
        strong = PEAK_THRESHOLD * loudest
        peak = (middle > strong) & (middle > left) & (middle >= right)
        frame, bin_ = np.nonzero(peak)
        before, here, after = (part[frame, bin_] for part in (left, middle, right))
        slope, bend = (after - before) / 2, before + after - 2 * here
        shift = np.where(np.abs(slope) < np.abs(bend), -slope / np.where(bend == 0, 1, bend), 0)
        # Single precision, as in librosa: near ties of the histogram come out alike.
        self._pitches.append(((low + bin_ + shift) * resolution).astype(np.float32))
        self._magnitudes.append(here + 0.5 * slope * shift)

    def tuning(self) -> float:
        """Offset in bins of 1/36 octave, -0.5 to 0.5; 0 where there is no pitch."""
        if not any(part.size for part in self._pitches):
            return 0.0
        pitches, magnitudes = np.concatenate(self._pitches), np.concatenate(self._magnitudes)
        pitches = pitches[magnitudes >= np.median(magnitudes)]
        remainder = np.mod(BINS * np.log2(pitches / np.float32(440 / 16)), 1.0)
        remainder[remainder >= 0.5] -= 1.0
        counts, edges = np.histogram(remainder, np.linspace(-0.5, 0.5, 101))
        return float(edges[np.argmax(counts)])


def estimate_tuning(samples: np.ndarray, hop: int) -> float:
    """Tuning of samples [S] in bins of 1/36 octave, from spectra `hop` samples apart."""
    estimator = TuningEstimator()
    for _, _, power in spectra(samples, hop):
        estimator.add(power)
    return estimator.tuning()


def fast_chroma(samples: np.ndarray, tuning: float) -> np.ndarray:
    """Chroma [12, 1 + S//1470] float32 of samples [S] at 44.1 kHz, tuned by `tuning` bins."""
    return _in_blocks(lambda part: _fast_chroma(part, tuning), samples, FAST_BLOCK)


def _in_blocks(
    chroma: Callable[[np.ndarray], np.ndarray], samples: np.ndarray, block: int
) -> np.ndarray:
    """`chroma` of samples [S], so many frames at a time, each block heard with what is around."""
    count = 1 + len(samples) // HOP
    pieces = []
    for first in range(0, count, block):
        last = min(first + block, count)
        start = max(0, first - CONTEXT)
        part = chroma(samples[start * HOP : (last + CONTEXT) * HOP])
        pieces.append(part[:, first - start : last - start])
    return np.concatenate(pieces, axis=1).astype(np.float32, copy=False)


def _fast_chroma(samples: np.ndarray, tuning: float) -> np.ndarray:
    """`fast_chroma` of a part."""
    import soxr

    count = 1 + len(samples) // HOP
    signal = soxr.resample(samples, SAMPLE_RATE, FAST_RATE, quality="MQ")
    rate, hop = FAST_RATE, FAST_HOP
    folded = np.zeros((count, CLASSES), np.float32)
    for octave in reversed(range(OCTAVES)):
        lowest = LOWEST * 2 ** (octave + tuning / BINS)
        kernel = _octave_kernel(lowest, rate)
        frames = centred_frames(signal, range(count), len(kernel), hop)
        response = frames @ kernel  # [T,2K]
        strength = np.hypot(response[:, :BINS], response[:, BINS:])
        # Three bins a class: the note, and a third of a semitone to either side.
        folded += np.roll(strength, 1, axis=1).reshape(count, CLASSES, -1).sum(axis=2)
        if octave:
            signal = soxr.resample(signal, 2, 1, quality="MQ")
            rate, hop = rate // 2, hop // 2
    return _scaled(folded.T)


def _octave_kernel(lowest: float, rate: int) -> np.ndarray:
    """Windowed cosines and sines [N,2K] float32 of one octave from `lowest` Hz.

    Brown, Calculation of a constant Q spectral transform, 1991; scaled by the square root of the
    length, as librosa does.
    """
    frequencies = lowest * 2 ** (np.arange(BINS) / BINS)
    ratio = 2 ** (2 / BINS)
    quality = (ratio + 1) / (ratio - 1)
    lengths = quality * rate / frequencies
    size = 2 * int(np.ceil(lengths.max() / 2))
    time = (np.arange(size) - size // 2)[:, None]
    window = np.where(np.abs(time) < lengths / 2, 0.5 + 0.5 * np.cos(2 * np.pi * time / lengths), 0)
    window *= np.sqrt(quality / frequencies) / window.sum(axis=0)
    angle = 2 * np.pi * frequencies * time / rate
    return np.concatenate([window * np.cos(angle), window * np.sin(angle)], 1).astype(np.float32)


def _scaled(chroma: np.ndarray) -> np.ndarray:
    """The largest value of each column becomes 1; silent columns stay 0."""
    largest = chroma.max(axis=0, keepdims=True)
    return chroma / np.where(largest < np.finfo(np.float32).tiny, 1, largest)


def exact_chroma(samples: np.ndarray) -> np.ndarray:
    """`librosa.feature.chroma_cqt` [12, 1 + S//1470] of samples [S] at 44.1 kHz, in blocks."""
    import librosa

    tuning = estimate_tuning(samples, TUNING_HOP)

    def exact(part: np.ndarray) -> np.ndarray:
        return np.asarray(
            librosa.feature.chroma_cqt(
                y=part, sr=SAMPLE_RATE, hop_length=HOP, n_chroma=CLASSES, tuning=tuning
            )
        )

    return _in_blocks(exact, samples, EXACT_BLOCK)


# ---------------------------------------------------------------- features


MAX_VALUES = 1 << 25  # numbers: the 128 rows of two hours at 30 frames a second, and some


def read_arrays(path: str | Path) -> dict[str, np.ndarray]:
    """Every array of an npz, checksums verified; raises UserError where it cannot be read."""
    try:
        return load_arrays(path, max_values=MAX_VALUES)
    except FileNotFoundError:
        raise UsageError(f"{path} does not exist; name a features file (.npz)") from None
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


@dataclass(frozen=True, eq=False)
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


# ---------------------------------------------------------------- where a dancer waits

QUIET = 0.03  # of the loudness that 5% of the frames exceed
WAIT = 1.2  # seconds; a shorter silence is a rest of the music
# Of a noise within a song: seconds over which it is looked at and that it lasts at least, its
# strongest pitch class by the mean one, and its 90th by its 10th percentile of loudness, at most.
STEADY, LONG_NOISE, FLAT, EVEN = 1.5, 2.0, 1.5, 1.35
NOISE = 1.8  # a music's strongest pitch class is so many times the mean one, and a noise's is not


def silent_spans(loudness: np.ndarray, fps: float = 30.0) -> list[tuple[int, int]]:
    """First and past-the-last frame of each silence of 1.2 s or more.

    Args:
        loudness: RMS [T], 0 to 1; all of it silent where nothing sounds.
        fps: frames a second.
    """
    return _spans(loudness <= QUIET * float(np.percentile(loudness, 95)), WAIT * fps)


def noise_spans(
    chroma: np.ndarray, loudness: np.ndarray, fps: float = 30.0
) -> list[tuple[int, int]]:
    """First and past-the-last frame of each part of 2 s or more without pitch or stroke: a noise
    before, within or behind the music, in which a tracker hears beats that nobody played.

    Args:
        chroma: [12,T].
        loudness: RMS [T].
        fps: frames a second.
    """
    from scipy.ndimage import median_filter, percentile_filter

    near = 2 * round(STEADY * fps / 2) + 1
    if len(loudness) < near:
        return []
    mean = chroma.mean(0)
    pitch = np.where(mean > 0, chroma.max(0) / mean.clip(min=1e-9), np.inf)
    low, high = (percentile_filter(loudness, share, near, mode="nearest") for share in (10, 90))
    flat = (median_filter(pitch, near, mode="nearest") < FLAT) & (high < EVEN * low)
    return _spans(flat, LONG_NOISE * fps)


def _spans(marked: np.ndarray, least: float) -> list[tuple[int, int]]:
    """First and past-the-last frame of each run of so many frames or more in bool [T]."""
    edges = np.flatnonzero(np.diff(marked.astype(int), prepend=0, append=0)).reshape(-1, 2)
    return [(start, stop) for start, stop in edges.tolist() if stop - start >= least]


def is_noise(chroma: np.ndarray) -> bool:
    """Whether no pitch stands out of a sound's chroma [12,T]; silence is no music either."""
    mean = chroma.mean(0)
    sounding = mean > 0
    if not sounding.any():
        return True
    return bool(np.median(chroma[:, sounding].max(0) / mean[sounding]) < NOISE)
