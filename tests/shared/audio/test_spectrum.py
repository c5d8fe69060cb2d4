"""Chroma: the exact transform is librosa's, the fast one close to it."""

from pathlib import Path

import librosa
import numpy as np
import pytest

from src.shared.audio.features import (
    TUNING_HOP,
    TuningEstimator,
    estimate_tuning,
    exact_chroma,
    fast_chroma,
)
from src.shared.audio.sound import HOP, SAMPLE_RATE, load_sound

MUSIC = Path(__file__).parents[4] / "shared" / "data" / "music"
SHORT_TRACKS = sorted(MUSIC.glob("sorohanro*.ogg")) + sorted(MUSIC.glob("admiralbob77*.ogg"))


def melody(seconds: float, *, cents: float = 0.0, seed: int = 0) -> np.ndarray:
    rng = np.random.default_rng(seed)
    time = np.arange(round(seconds * SAMPLE_RATE)) / SAMPLE_RATE
    sound = 1e-4 * rng.standard_normal(time.size)
    for start in np.arange(0, seconds, 0.35):
        after = np.maximum(time - start, 0)
        pitch = rng.integers(30, 90)
        hertz = 440 * 2 ** ((pitch - 69 + cents / 100) / 12)
        for harmonic in (1, 2, 3):
            tone = np.sin(2 * np.pi * hertz * harmonic * after) / harmonic
            sound += 0.2 * tone * np.exp(-4 * after) * (after > 0)
    return sound.astype(np.float32)


def librosa_chroma(samples: np.ndarray) -> np.ndarray:
    return librosa.feature.chroma_cqt(y=samples, sr=SAMPLE_RATE, hop_length=HOP, n_chroma=12)


def cosines(a: np.ndarray, b: np.ndarray) -> np.ndarray:
    lengths = np.linalg.norm(a, axis=0) * np.linalg.norm(b, axis=0)
    return (a * b).sum(axis=0)[lengths > 0] / lengths[lengths > 0]


@pytest.mark.parametrize("cents", [0.0, 12.0, -25.0])
def test_fast_is_close_to_exact(cents: float) -> None:
    samples = melody(4.0, cents=cents)
    fast = fast_chroma(samples, estimate_tuning(samples, HOP))
    expected = librosa_chroma(samples)
    assert fast.shape == expected.shape and fast.dtype == np.float32
    found = cosines(fast, expected)
    assert np.median(found) > 0.998 and np.quantile(found, 0.05) > 0.99


def test_fast_is_the_same_in_blocks(monkeypatch: pytest.MonkeyPatch) -> None:
    samples = melody(12.0, cents=7.0)
    whole = fast_chroma(samples, 0.1)
    monkeypatch.setattr("src.shared.audio.features.FAST_BLOCK", 70)
    np.testing.assert_allclose(fast_chroma(samples, 0.1), whole, atol=1e-5)


@pytest.mark.skipif(not SHORT_TRACKS, reason="no music at hand")
def test_fast_is_close_to_exact_on_real_music() -> None:
    for path in SHORT_TRACKS:
        samples = load_sound(path).samples
        fast = fast_chroma(samples, estimate_tuning(samples, HOP))
        assert np.median(cosines(fast, librosa_chroma(samples))) > 0.998, path.name


def test_exact_is_librosa_in_blocks(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("src.shared.audio.features.EXACT_BLOCK", 70)
    samples = melody(5.0, cents=7.0)
    np.testing.assert_allclose(exact_chroma(samples), librosa_chroma(samples), atol=1e-4)


@pytest.mark.parametrize("cents", [0.0, 10.0, -14.0])
def test_tuning_is_librosas(cents: float) -> None:
    samples = melody(3.0, cents=cents, seed=3)
    expected = librosa.estimate_tuning(y=samples, sr=SAMPLE_RATE, bins_per_octave=36)
    assert estimate_tuning(samples, TUNING_HOP) == pytest.approx(expected, abs=1e-9)


def test_silence_has_no_tuning_and_no_chroma() -> None:
    silence = np.zeros(SAMPLE_RATE, np.float32)
    assert estimate_tuning(silence, HOP) == 0.0
    assert not fast_chroma(silence, 0.0).any()
    assert not exact_chroma(silence).any()
    assert TuningEstimator().tuning() == 0.0


def test_a_note_lights_its_class() -> None:
    time = np.arange(SAMPLE_RATE * 2) / SAMPLE_RATE
    for midi in (36, 57, 61, 95):
        tone = np.sin(2 * np.pi * 440 * 2 ** ((midi - 69) / 12) * time).astype(np.float32)
        chroma = fast_chroma(tone, 0.0)[:, 20:40]
        assert (chroma.argmax(axis=0) == midi % 12).all()
        assert np.delete(chroma, [midi % 12, (midi - 1) % 12, (midi + 1) % 12], axis=0).max() < 0.1
