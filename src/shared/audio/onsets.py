"""Onset strength at 100 frames a second: log-mel spectral flux in three bands, from chunks.

Memory is bounded by the mel powers (MEL_BANDS float32 a frame, 16 kB a second), not by the sound.
Letters: S samples, T frames, M mel bands.
"""

from collections.abc import Iterable, Iterator
from dataclasses import dataclass

import numpy as np

ONSET_FPS = 100  # nominal; exact only where the sample rate divides by it
MEL_BANDS = 36
WINDOW_SECONDS = 0.04
FLOOR_DB = 60.0  # below the loudest band
LOWEST, LOW, HIGH, HIGHEST = 30.0, 180.0, 2500.0, 16_000.0  # Hz: edges of the three bands
SILENCE_POWER = 1e-9  # mel power of the loudest frame; about -80 dB full scale
BLOCK_FRAMES = 1024


@dataclass(frozen=True)
class Onsets:
    """Onset strengths [T] of the whole spectrum and [3, T] of its bands (low, middle, high).

    Frame t is centred on t / fps seconds. `chroma_flux` is left to the downbeat stage: `mel` holds
    the levels [M, T] in dB above the floor. `silent` says that nothing can be heard.
    """

    strength: np.ndarray
    bands: np.ndarray
    mel: np.ndarray
    fps: float
    silent: bool


def mel_filters(count: int, sample_rate: int, n_fft: int) -> np.ndarray:
    """Triangles [M, n_fft/2+1] with equal steps on the mel scale of O'Shaughnessy, unit sum."""
    top = min(HIGHEST, sample_rate / 2)
    mels = np.linspace(1127 * np.log1p(LOWEST / 700), 1127 * np.log1p(top / 700), count + 2)
    edges = 700 * np.expm1(mels / 1127)
    # Low bands narrower than a bin would be empty: give each a bin of its own at least.
    width = sample_rate / n_fft
    bins = np.arange(n_fft // 2 + 1) * width
    below = np.minimum(edges[:-2], edges[1:-1] - width)[:, None]
    above = np.maximum(edges[2:], edges[1:-1] + width)[:, None]
    centre = edges[1:-1, None]
    rise = (bins - below) / (centre - below)
    fall = (above - bins) / (above - centre)
    filters = np.maximum(0.0, np.minimum(rise, fall))
    return (filters / filters.sum(axis=1, keepdims=True)).astype(np.float32)


def mel_centres(count: int, sample_rate: int) -> np.ndarray:
    """Centre frequencies [M] of `mel_filters` in Hz."""
    top = min(HIGHEST, sample_rate / 2)
    mels = np.linspace(1127 * np.log1p(LOWEST / 700), 1127 * np.log1p(top / 700), count + 2)
    return 700 * np.expm1(mels[1:-1] / 1127)


def _blocks(chunks: Iterable[np.ndarray], n_fft: int, hop: int) -> Iterator[np.ndarray]:
    """Frames [up to BLOCK_FRAMES, n_fft] of the joined chunks, centred, zeros beyond the ends."""
    buffer = np.zeros(n_fft // 2, dtype=np.float32)
    span = (BLOCK_FRAMES - 1) * hop + n_fft
    for chunk in chunks:
        buffer = np.concatenate([buffer, chunk.astype(np.float32, copy=False)])
        while buffer.size >= span:
            yield np.lib.stride_tricks.sliding_window_view(buffer[:span], n_fft)[::hop]
            buffer = buffer[BLOCK_FRAMES * hop :]
    buffer = np.concatenate([buffer, np.zeros(n_fft // 2, dtype=np.float32)])
    if buffer.size >= n_fft:
        yield from np.array_split(np.lib.stride_tricks.sliding_window_view(buffer, n_fft)[::hop], 2)


def mel_power(chunks: Iterable[np.ndarray], sample_rate: int) -> tuple[np.ndarray, float]:
    """Mel powers [M, T] of mono chunks and their frame rate."""
    from scipy.fft import rfft  # float32 in, complex64 out; numpy's would double

    hop = max(round(sample_rate / ONSET_FPS), 1)
    n_fft = 2 ** round(np.log2(WINDOW_SECONDS * sample_rate))
    window = np.hanning(n_fft + 1)[:-1].astype(np.float32)
    window /= window.sum() / 2
    filters = mel_filters(MEL_BANDS, sample_rate, n_fft).T
    parts = []
    for frames in _blocks(chunks, n_fft, hop):
        spectrum = rfft(frames * window, axis=1)
        parts.append((spectrum.real**2 + spectrum.imag**2) @ filters)
    power = np.concatenate(parts) if parts else np.zeros((0, MEL_BANDS), dtype=np.float32)
    return power.T, sample_rate / hop


def detect_onsets(chunks: Iterable[np.ndarray], sample_rate: int) -> Onsets:
    """Onset strengths of mono sound given in chunks of any length."""
    power, fps = mel_power(chunks, sample_rate)
    peak = float(power.max(initial=0.0))
    level = np.maximum(10 * np.log10(np.maximum(power, 1e-20) / max(peak, 1e-20)) + FLOOR_DB, 0.0)
    centres = mel_centres(MEL_BANDS, sample_rate)
    flux = _flux(level)
    edges = np.searchsorted(centres, [LOW, HIGH])
    groups = np.split(flux, edges)
    bands = np.stack([group.mean(axis=0) for group in groups])
    strength = bands.mean(axis=0)
    return Onsets(strength, bands, level, fps, peak < SILENCE_POWER)


def _flux(level: np.ndarray, lag: int = 2) -> np.ndarray:
    """Rise [M, T] in dB over `lag` frames, against the louder neighbour band (vibrato)."""
    before = level.copy()
    before[1:] = np.maximum(before[1:], level[:-1])
    before[:-1] = np.maximum(before[:-1], level[1:])
    rise = np.zeros_like(level)
    rise[:, lag:] = np.maximum(level[:, lag:] - before[:, :-lag], 0.0)
    return rise
