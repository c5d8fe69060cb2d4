"""Where the weights of the tempo and downbeat scores come from: fits on the training split.

`pytest -m slow tests/shared/audio/test_beat_weights.py -s` prints the fitted values.
"""

from collections.abc import Callable
from functools import lru_cache

import numpy as np
import pytest

from src.shared.audio import beats as tracking
from src.shared.audio.beats import _novelty
from src.shared.audio.onsets import Onsets, detect_onsets
from src.shared.audio.synthetic_songs import SyntheticSong, render_song, sample_song_specs

TEMPO_SONGS, DOWNBEAT_SONGS, SEED = 800, 300, 10
TEMPO_RIDGE, DOWNBEAT_RIDGE = 3e-4, 0.1
TEMPO_BLUR = 0.02  # octaves: how exact a window's tempo is

pytestmark = pytest.mark.slow


@lru_cache(maxsize=1)
def training_songs() -> list[tuple[SyntheticSong, Onsets]]:
    songs = [render_song(spec) for spec in sample_song_specs(TEMPO_SONGS, SEED, "train")]
    return [(song, detect_onsets([song.samples], song.sample_rate)) for song in songs]


def minimise(loss: Callable[[np.ndarray], tuple[float, np.ndarray]], size: int) -> np.ndarray:
    from scipy.optimize import minimize

    return minimize(loss, np.zeros(size), jac=True, method="L-BFGS-B").x


def test_tempo_weights() -> None:
    features, targets = [], []
    for song, onsets in training_songs():
        novelty = _novelty(onsets.bands, onsets.fps)
        correlations, centres = tracking.correlate_windows(novelty, onsets.fps)
        read = tracking.tempo_features(correlations, onsets.fps)
        prior = np.broadcast_to(tracking.DISTANCE**2, (len(read), 1, tracking.CANDIDATES))
        features.append(
            np.concatenate([read.reshape(len(read), -1, tracking.CANDIDATES), prior], 1)
        )
        since = np.maximum(centres - song.spec.first_downbeat, 0.0)
        beats = song.spec.tempo_map.beats(since + 0.5) - song.spec.tempo_map.beats(since - 0.5)
        away = np.log2(tracking.PERIODS * beats[:, None]) / TEMPO_BLUR
        wanted = np.exp(-(away**2) / 2)
        targets.append(wanted / wanted.sum(axis=1, keepdims=True))
    x, y = np.concatenate(features).astype(np.float32), np.concatenate(targets)

    def loss(weights: np.ndarray) -> tuple[float, np.ndarray]:
        scores = np.einsum("nfg,f->ng", x, weights.astype(np.float32)).astype(np.float64)
        scores -= scores.max(axis=1, keepdims=True)
        logs = scores - np.log(np.exp(scores).sum(axis=1, keepdims=True))
        slope = np.einsum("nfg,ng->f", x, (np.exp(logs) - y).astype(np.float32)) / len(x)
        value = -(y * logs).sum() / len(x) + TEMPO_RIDGE * (weights**2).sum()
        return value, slope.astype(np.float64) + 2 * TEMPO_RIDGE * weights

    fitted = minimise(loss, x.shape[1])
    table = fitted[:-1].reshape(tracking.MULTIPLE_WEIGHTS.shape)
    print(np.round(table, 1).tolist(), round(fitted[-1], 2))
    shipped = np.append(tracking.MULTIPLE_WEIGHTS.ravel(), tracking.PRIOR)
    assert loss(shipped)[0] < loss(fitted)[0] + 0.01
    assert np.abs(table - tracking.MULTIPLE_WEIGHTS).max() < 0.3


def test_downbeat_weights() -> None:
    sums, wanted = [], []
    for song, onsets in training_songs()[:DOWNBEAT_SONGS]:
        meter, beats = song.spec.meter, song.beat_times
        if len(beats) < 2 * meter:
            continue
        features = tracking.downbeat_features(onsets, beats).reshape(-1, len(beats))
        by_offset = [features[:, k::meter].sum(axis=1) for k in range(meter)]
        sums.append(np.stack(by_offset) / np.sqrt(len(beats) / meter))
        wanted.append(int(np.searchsorted(beats, song.downbeat_times[0])) % meter)

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
