"""The input of the beat tracker: onset strength at 100 frames a second and pitch levels at 20.

One pass over mono chunks, two short-time spectra: 46 ms windows for the moment of an onset, 186 ms
windows for pitch. Memory is bounded by the levels that are kept (20 kB a second), not the sound.
Letters: S samples, T onset frames, P pitch frames, M mel bands, N semitones.
"""

from collections.abc import Iterable, Iterator
from dataclasses import dataclass

import numpy as np

ONSET_FPS, PITCH_FPS = 100, 20  # nominal; exact only where the sample rate divides by them
ONSET_WINDOW, PITCH_WINDOW = 0.04, 0.18  # seconds, to the nearest power of two in samples
MEL_BANDS = 36
LOWEST, LOW, HIGH, HIGHEST = 30.0, 180.0, 2500.0, 16_000.0  # Hz: edges of the three bands
LOWEST_PITCH, SEMITONES = 33, 60  # MIDI numbers from 55 Hz on
FLOOR_DB = 60.0  # below the loudest band
SILENCE_POWER = 1e-9  # power of the loudest frame; about -80 dB full scale
BLOCK_FRAMES = 512
LAG = 2  # frames over which a rise is measured


@dataclass(frozen=True)
class Onsets:
    """Onset strengths, levels and pitches; frame t of T is centred on t / fps seconds.

    Attributes:
        bands: [3, T] mean rise of the low, middle and high bands, dB in 20 ms.
        loudness: [T] level of the loudest band in dB above the floor.
        pitch: [N, P] levels of the semitones, compressed, at `pitch_fps`.
        silent: nothing can be heard.
    """

    bands: np.ndarray
    loudness: np.ndarray
    pitch: np.ndarray
    fps: float
    pitch_fps: float
    silent: bool

    @property
    def strength(self) -> np.ndarray:
        """Rise of all bands [T]."""
        return np.asarray(self.bands.mean(axis=0))


class _Spectra:
    """Short-time power spectra, filtered: frames are cut from chunks as they come."""

    def __init__(self, sample_rate: int, fps: float, seconds: float) -> None:
        self.hop = max(round(sample_rate / fps), 1)
        self.size = int(2 ** round(np.log2(seconds * sample_rate)))
        window = np.hanning(self.size + 1)[:-1].astype(np.float32)
        self.window = window * np.float32(2 / window.sum())
        self.bins = np.arange(self.size // 2 + 1) * sample_rate / self.size  # Hz
        self.fps = sample_rate / self.hop
        self.filters = np.zeros((0, 0), dtype=np.float32)
        self._buffer = np.zeros(self.size // 2, dtype=np.float32)
        self._parts: list[np.ndarray] = []

    def push(self, samples: np.ndarray) -> None:
        """Take mono samples [S]."""
        self._buffer = np.concatenate([self._buffer, samples.astype(np.float32, copy=False)])
        while self._buffer.size >= (BLOCK_FRAMES - 1) * self.hop + self.size:
            self._filter(self._buffer[: (BLOCK_FRAMES - 1) * self.hop + self.size])
            self._buffer = self._buffer[BLOCK_FRAMES * self.hop :]

    def finish(self) -> np.ndarray:
        """Filtered powers [bands, T] of everything that came, T = 1 + S // hop."""
        self.push(np.zeros(self.size // 2, dtype=np.float32))
        if self._buffer.size >= self.size:
            self._filter(self._buffer)
        return np.concatenate([np.zeros((0, len(self.filters)), np.float32), *self._parts]).T

    def _filter(self, samples: np.ndarray) -> None:
        from scipy.fft import rfft  # single precision stays single, unlike numpy's

        frames = np.lib.stride_tricks.sliding_window_view(samples, self.size)[:: self.hop]
        spectrum = rfft(frames * self.window, axis=1)
        self._parts.append((spectrum.real**2 + spectrum.imag**2) @ self.filters.T)


def detect_onsets(chunks: Iterable[np.ndarray], sample_rate: int) -> Onsets:
    """Onset strengths and pitch levels of mono sound given in chunks of any length."""
    rises = _Spectra(sample_rate, ONSET_FPS, ONSET_WINDOW)
    centres, rises.filters = mel_filters(rises.bins)
    pitches = _Spectra(sample_rate, PITCH_FPS, PITCH_WINDOW)
    pitches.filters = pitch_filters(pitches.bins)
    for chunk in chunks:
        for piece in _pieces(chunk):
            rises.push(piece)
            pitches.push(piece)
    power = rises.finish()
    peak = float(power.max(initial=0.0))
    level = np.maximum(10 * np.log10(np.maximum(power, 1e-20) / max(peak, 1e-20)) + FLOOR_DB, 0.0)
    groups = np.split(_rise(level), np.searchsorted(centres, [LOW, HIGH]))
    pitch = np.sqrt(pitches.finish())  # amplitudes
    return Onsets(
        bands=np.stack([group.mean(axis=0) for group in groups]),
        loudness=level.max(axis=0),
        pitch=np.log1p(100 * pitch / max(float(pitch.max(initial=0.0)), 1e-10)),
        fps=rises.fps,
        pitch_fps=pitches.fps,
        silent=peak < SILENCE_POWER,
    )


def _pieces(chunk: np.ndarray, size: int = 1 << 18) -> Iterator[np.ndarray]:
    """Parts of a chunk, so that a whole song in one chunk is not copied at each step."""
    yield from (chunk[start : start + size] for start in range(0, len(chunk), size))


def mel_filters(bins: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Centres [M] in Hz and triangles [M, bins] of unit sum, at equal steps on the mel scale.

    Triangles narrower than a bin are widened to one, so that none is empty.
    """
    first, last = 1127 * np.log1p(np.array([LOWEST, min(HIGHEST, bins[-1])]) / 700)
    edges = 700 * np.expm1(np.linspace(first, last, MEL_BANDS + 2) / 1127)
    centres = edges[1:-1]
    below = np.minimum(edges[:-2], centres - bins[1])[:, None]
    above = np.maximum(edges[2:], centres + bins[1])[:, None]
    rise = (bins - below) / (centres[:, None] - below)
    fall = (above - bins) / (above - centres[:, None])
    filters = np.maximum(0.0, np.minimum(rise, fall))
    return centres, (filters / filters.sum(axis=1, keepdims=True)).astype(np.float32)


def pitch_filters(bins: np.ndarray) -> np.ndarray:
    """Triangles [N, bins], a semitone or at least a bin to each side."""
    centres = 440.0 * 2 ** ((LOWEST_PITCH + np.arange(SEMITONES) - 69) / 12)
    width = np.maximum(centres * (2 ** (1 / 12) - 1), bins[1])[:, None]
    return np.asarray(
        np.maximum(0.0, 1 - np.abs(bins - centres[:, None]) / width).astype(np.float32)
    )


def _rise(level: np.ndarray) -> np.ndarray:
    """Rise [M, T] in dB over LAG frames, above the loudest neighbour band before (vibrato)."""
    before = np.pad(level, ((1, 1), (LAG, 0)))[:, : level.shape[1]]
    before = np.maximum(np.maximum(before[:-2], before[1:-1]), before[2:])
    return np.asarray(np.maximum(level - before, 0.0))
