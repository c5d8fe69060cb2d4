"""Frames, mel bands and decibels, as librosa defines them, without its seconds of import.

Letters: S samples, T frames, N samples of a frame, F = N//2 + 1 frequencies, M mel bands.
"""

from collections.abc import Iterator
from functools import lru_cache

import numpy as np

from .sound import SAMPLE_RATE

N_FFT = 2048
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


def spectra(
    samples: np.ndarray, hop: int, *, block: int = 512
) -> Iterator[tuple[range, np.ndarray, np.ndarray]]:
    """Yield (frame indices, frames [t,N], power spectra [t,F]) of the centred Hann STFT."""
    from scipy.fft import rfft

    window = hann(N_FFT)
    count = 1 + len(samples) // hop
    for first in range(0, count, block):
        indices = range(first, min(first + block, count))
        frames = centred_frames(samples, indices, N_FFT, hop)
        spectrum = rfft(frames * window, axis=1)
        yield indices, frames, np.square(spectrum.real) + np.square(spectrum.imag)


def hann(size: int) -> np.ndarray:
    """Periodic Hann window [size] float32."""
    return (0.5 - 0.5 * np.cos(2 * np.pi * np.arange(size) / size)).astype(np.float32)


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
    return (triangles * 2 / (centres[2:] - centres[:-2])).astype(np.float32)


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
    return np.maximum(level, level.max() - RANGE_DB)
