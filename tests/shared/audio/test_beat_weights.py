"""Where the weights of the tempo and downbeat scores come from: fits on the training split, and on
music of another make.

`pytest -m slow tests/shared/audio/test_beat_weights.py -s` prints the fitted values.
"""

from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import lru_cache

import numpy as np
import pytest

from src.shared.audio import beats as tracking
from src.shared.audio.beats import Onsets, _novelty, detect_onsets
from src.shared.audio.synthetic import (
    SAMPLE_RATE,
    SyntheticSong,
    render_song,
    sample_song_specs,
)
from tests.shared.audio.other_songs import OtherSong, pattern, pop

TEMPO_SONGS, SHORT_SONGS, DOWNBEAT_SONGS, OTHERS, SEED = 800, 400, 300, 200, 10
FIRST = 5.0  # seconds of a song's beginning, which is fitted on its own
TEMPO_RIDGE, DOWNBEAT_RIDGE = 1e-4, 0.1
TEMPO_BLUR = 0.02  # octaves: how exact a window's tempo is

pytestmark = pytest.mark.slow


@dataclass(frozen=True)
class Heard:
    """Onsets of a song, its beats and downbeats in seconds, beats a bar."""

    onsets: Onsets
    beats: np.ndarray
    downbeats: np.ndarray
    meter: int

    def beginning(self) -> "Heard":
        """The first seconds from its first beat on."""
        end = FIRST + self.beats[0]
        own = self.onsets
        frames, pitches = int(end * own.fps), int(end * own.pitch_fps)
        cut = replace(
            own,
            bands=own.bands[:, :frames],
            loudness=own.loudness[:frames],
            pitch=own.pitch[:, :pitches],
        )
        return replace(self, onsets=cut, beats=self.beats[self.beats < end])

    def windows(self) -> tuple[np.ndarray, np.ndarray]:
        """Features and wanted shares of each candidate tempo, for every window."""
        correlations, centres = tracking.correlate_windows(
            _novelty(self.onsets.bands, self.onsets.fps), self.onsets.fps
        )
        read = tracking.tempo_features(correlations, self.onsets.fps)
        prior = np.broadcast_to(tracking.DISTANCE**2, (len(read), 1, tracking.CANDIDATES))
        x = np.concatenate([read.reshape(len(read), -1, tracking.CANDIDATES), prior], 1)
        period = np.interp(centres, self.beats[:-1], np.diff(self.beats))
        away = np.log2(tracking.PERIODS / period[:, None]) / TEMPO_BLUR
        wanted = np.exp(-(away**2) / 2)
        known = (period > 60 / 215) & (period < 60 / 50)
        shares = wanted / (wanted.sum(axis=1, keepdims=True) + 1e-12)
        return x[known].astype(np.float32), shares[known].astype(np.float32)


@lru_cache(maxsize=1)
def training_songs() -> list[Heard]:
    songs = [render_song(spec) for spec in sample_song_specs(TEMPO_SONGS, SEED, "train")]
    meters = [song.spec.meter for song in songs]
    return [heard(song, meter) for song, meter in zip(songs, meters, strict=True)]


@lru_cache(maxsize=2)
def other_songs(make: Callable[[int], OtherSong]) -> list[Heard]:
    return [heard(song, song.meter) for song in (make(seed) for seed in range(OTHERS))]


def heard(song: SyntheticSong | OtherSong, meter: int) -> Heard:
    onsets = detect_onsets(song.samples, SAMPLE_RATE)
    return Heard(onsets, song.beat_times, song.downbeat_times, meter)


def minimise(loss: Callable[[np.ndarray], tuple[float, np.ndarray]], size: int) -> np.ndarray:
    from scipy.optimize import minimize

    return minimize(loss, np.zeros(size), jac=True, method="L-BFGS-B").x


def test_tempo_weights() -> None:
    parts, shares = [], []
    for songs, every, share in (
        (training_songs(), 3, 4.0),
        ([song.beginning() for song in training_songs()[:SHORT_SONGS]], 1, 1.0),
        (other_songs(pop), 2, 0.5),
        ([song.beginning() for song in other_songs(pop)], 1, 0.3),
        (other_songs(pattern), 2, 0.3),
    ):
        own = [song.windows() for song in songs if len(song.beats) >= 4]
        parts += [(x[::every], y[::every]) for x, y in own]
        count = sum(len(x[::every]) for x, _ in own)
        shares.append(np.full(count, share / count, np.float32))
    x, y = (np.concatenate(each) for each in zip(*parts, strict=True))
    weight = np.concatenate(shares)
    weight /= weight.sum()

    def loss(weights: np.ndarray) -> tuple[float, np.ndarray]:
        scores = np.einsum("nfg,f->ng", x, weights.astype(np.float32)).astype(np.float64)
        scores -= scores.max(axis=1, keepdims=True)
        logs = scores - np.log(np.exp(scores).sum(axis=1, keepdims=True))
        off = (np.exp(logs) - y) * weight[:, None]
        slope = np.einsum("nfg,ng->f", x, off.astype(np.float32))
        value = -(weight[:, None] * y * logs).sum() + TEMPO_RIDGE * (weights**2).sum()
        return value, slope.astype(np.float64) + 2 * TEMPO_RIDGE * weights

    fitted = minimise(loss, x.shape[1])
    table = fitted[:-1].reshape(tracking.MULTIPLE_WEIGHTS.shape)
    print(np.round(table, 1).tolist(), round(fitted[-1], 2))
    shipped = np.append(tracking.MULTIPLE_WEIGHTS.ravel(), tracking.PRIOR)
    assert loss(shipped)[0] < loss(fitted)[0] + 0.01
    assert np.abs(table - tracking.MULTIPLE_WEIGHTS).max() < 0.3


def test_downbeat_weights() -> None:
    sums, wanted = [], []
    for song in training_songs()[:DOWNBEAT_SONGS] + other_songs(pattern):
        meter, beats = song.meter, song.beats
        if len(beats) < 2 * meter:
            continue
        features = tracking.downbeat_features(song.onsets, beats).reshape(-1, len(beats))
        by_offset = [features[:, k::meter].sum(axis=1) for k in range(meter)]
        sums.append(np.stack(by_offset) / np.sqrt(len(beats) / meter))
        wanted.append(int(np.searchsorted(beats, song.downbeats[0])) % meter)

    def loss(weights: np.ndarray) -> tuple[float, np.ndarray]:
        value, slope = DOWNBEAT_RIDGE * (weights**2).sum(), 2 * DOWNBEAT_RIDGE * weights
        for x, offset in zip(sums, wanted, strict=True):
            scores = x @ weights
            share = np.exp(scores - scores.max())
            share /= share.sum()
            value -= np.log(share[offset]) / len(sums)
            slope = slope + (share @ x - x[offset]) / len(sums)
        return value, slope

    fitted = minimise(loss, sums[0].shape[1]).reshape(tracking.WEIGHTS.shape)
    print(np.round(fitted, 2).tolist())
    assert loss(tracking.WEIGHTS.ravel())[0] < loss(fitted.ravel())[0] + 0.01
    assert np.abs(fitted - tracking.WEIGHTS).max() < 0.05
