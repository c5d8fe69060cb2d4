"""Features against librosa's own calls, as TECH section 4.2 prints them."""

from pathlib import Path

import librosa
import numpy as np
import pytest
import soundfile

from src.shared.audio.features import (
    AudioFeatures,
    centred_frames,
    decibels,
    extract_features,
    is_noise,
    mel_matrix,
    noise_spans,
    read_arrays,
    silent_spans,
)
from src.shared.audio.sound import HOP, SAMPLE_RATE, load_sound, sound_from_samples
from src.shared.errors import UserError
from src.shared.io.arrays import write_arrays

MUSIC = Path(__file__).parents[4] / "shared" / "data" / "music"


def literal(y: np.ndarray) -> dict[str, np.ndarray]:
    """The document's calls, but for chroma and beats."""
    sr, hop = SAMPLE_RATE, HOP
    mel = librosa.feature.melspectrogram(
        y=y, sr=sr, n_mels=128, hop_length=hop, fmin=20.0, fmax=8000.0
    )
    mel = librosa.power_to_db(mel, ref=np.max)
    mfcc = librosa.feature.mfcc(y=y, sr=sr, n_mfcc=20, hop_length=hop)
    rms = librosa.feature.rms(y=y, hop_length=hop)[0]
    centroid = librosa.feature.spectral_centroid(y=y, sr=sr, hop_length=hop)[0]
    onset = librosa.onset.onset_strength(y=y, sr=sr, hop_length=hop)
    return {
        "mel": (mel - mel.min()) / (mel.max() - mel.min() + 1e-8),
        "mfcc": (mfcc - mfcc.mean(axis=1, keepdims=True))
        / (mfcc.std(axis=1, keepdims=True) + 1e-8),
        "rms": rms / (rms.max() + 1e-8),
        "spectral_centroid": (centroid - centroid.min()) / (centroid.max() - centroid.min() + 1e-8),
        "onset_strength": onset / (onset.max() + 1e-8),
    }


def notes(seconds: float, seed: int = 0) -> np.ndarray:
    """Plucked chords over a little noise, with a loud and a silent part."""
    rng = np.random.default_rng(seed)
    time = np.arange(round(seconds * SAMPLE_RATE)) / SAMPLE_RATE
    sound = 0.003 * rng.standard_normal(time.size)
    for start in np.arange(0, seconds, 0.4):
        after = np.maximum(time - start, 0)
        for pitch in rng.choice([48, 52, 55, 60, 64, 67, 72], 3, replace=False):
            hertz = 440 * 2 ** ((pitch - 69) / 12)
            sound += 0.1 * np.sin(2 * np.pi * hertz * after) * np.exp(-6 * after) * (after > 0)
    sound[time > seconds - 0.5] = 0
    return sound.astype(np.float32)


def tracks() -> list[Path]:
    return sorted(MUSIC.glob("*.ogg"))


def signals() -> dict[str, np.ndarray]:
    rng = np.random.default_rng(1)
    return {
        "notes": notes(6.0),
        "one second": notes(1.0),
        "odd length": notes(3.0)[: 2 * SAMPLE_RATE + 1234],
        "noise": (0.2 * rng.standard_normal(3 * SAMPLE_RATE)).astype(np.float32),
        "clipped": np.clip(30 * notes(3.0), -1, 1),
        "faint": 1e-4 * notes(3.0),
    }


@pytest.mark.parametrize("name", signals())
def test_agrees_with_librosa(name: str) -> None:
    samples = signals()[name]
    features = extract_features(sound_from_samples(samples))
    for key, expected in literal(samples).items():
        found = getattr(features, key)
        np.testing.assert_allclose(found, expected[..., : found.shape[-1]], atol=1e-4, err_msg=key)


@pytest.mark.skipif(not tracks(), reason="no music at hand")
@pytest.mark.parametrize("index", range(5))
def test_agrees_with_librosa_on_real_music(index: int) -> None:
    samples = load_sound(tracks()[index]).samples[: 20 * SAMPLE_RATE]
    features = extract_features(sound_from_samples(samples))
    for key, expected in literal(samples).items():
        found = getattr(features, key)
        np.testing.assert_allclose(found, expected[..., : found.shape[-1]], atol=1e-4, err_msg=key)


@pytest.mark.parametrize("seconds", [1.0, 1.51, 2.99, 3.017])
def test_thirty_frames_a_second(seconds: float) -> None:
    features = extract_features(sound_from_samples(notes(seconds)))
    stacked = features.stack()
    assert stacked.shape == (163, round(seconds * 30)) and stacked.dtype == np.float32
    assert features.num_frames == stacked.shape[1]
    np.testing.assert_array_equal(stacked[:128], features.mel)
    np.testing.assert_array_equal(stacked[128:140], features.chroma)
    np.testing.assert_array_equal(stacked[140:160], features.mfcc)
    np.testing.assert_array_equal(stacked[162], features.onset_strength)


@pytest.mark.parametrize(
    "samples",
    [
        np.zeros(SAMPLE_RATE * 2, np.float32),
        np.full(SAMPLE_RATE * 2, 0.5, np.float32),
        np.sign(np.sin(np.arange(SAMPLE_RATE * 2) * 0.05)).astype(np.float32),
        np.full(SAMPLE_RATE * 2, 1e-30, np.float32),
        1e5 * notes(2.0),
    ],
    ids=["silence", "constant", "square", "denormal", "huge"],
)
def test_odd_sounds_stay_finite_and_bounded(samples: np.ndarray) -> None:
    stacked = extract_features(sound_from_samples(samples)).stack()
    assert np.isfinite(stacked).all()
    assert np.abs(stacked).max() < 20


def test_silence_is_zero() -> None:
    assert not extract_features(sound_from_samples(np.zeros(SAMPLE_RATE, np.float32))).stack().any()


def loaded(path: Path) -> AudioFeatures:
    return AudioFeatures.from_arrays(read_arrays(path), path)


def test_save_and_load(tmp_path: Path) -> None:
    features = extract_features(sound_from_samples(notes(1.2)))
    path = write_arrays(features.arrays(), tmp_path / "deep" / "features.npz")
    np.testing.assert_array_equal(loaded(path).stack(), features.stack())


def test_load_refuses_what_it_cannot_use(tmp_path: Path) -> None:
    with pytest.raises(UserError, match="does not exist"):
        loaded(tmp_path / "none.npz")
    features = extract_features(sound_from_samples(notes(1.2)))
    path = write_arrays(features.arrays(), tmp_path / "features.npz")
    data = path.read_bytes()
    path.write_bytes(data[: len(data) // 2])
    with pytest.raises(UserError, match="damaged"):
        loaded(path)
    arrays = features.arrays()
    np.savez(path, **{**arrays, "rms": arrays["rms"][:-1]})
    with pytest.raises(UserError, match="array rms is"):
        loaded(path)
    np.savez(path, mel=arrays["mel"])
    with pytest.raises(UserError, match="make it again"):
        loaded(path)


@pytest.mark.parametrize("low, high", [(20.0, 8000.0), (0.0, 22050.0)])
def test_mel_filters_are_librosas(low: float, high: float) -> None:
    expected = librosa.filters.mel(sr=SAMPLE_RATE, n_fft=2048, n_mels=128, fmin=low, fmax=high)
    np.testing.assert_allclose(mel_matrix(128, low, high).T, expected, atol=1e-8)


def test_decibels_are_librosas() -> None:
    power = np.random.default_rng(0).random((5, 7)).astype(np.float32) ** 20
    np.testing.assert_allclose(decibels(power), librosa.power_to_db(power), atol=1e-5)
    expected = librosa.power_to_db(power, ref=np.max)
    np.testing.assert_allclose(decibels(power, reference=power.max()), expected, atol=1e-5)


@pytest.mark.parametrize("length, size, hop", [(100, 16, 5), (7, 16, 3), (3, 4, 10), (50, 6, 1)])
def test_frames_are_centred_and_padded(length: int, size: int, hop: int) -> None:
    samples = np.arange(1, length + 1, dtype=np.float32)
    count = 1 + length // hop
    padded = np.pad(samples, (size, size + hop))
    expected = [padded[size + i * hop - size // 2 :][:size] for i in range(count)]
    np.testing.assert_array_equal(centred_frames(samples, range(count), size, hop), expected)
    if count > 2:
        part = centred_frames(samples, range(1, count), size, hop)
        np.testing.assert_array_equal(part, expected[1:])


def test_file_and_sound_give_the_same(tmp_path: Path) -> None:
    path = tmp_path / "song.wav"
    soundfile.write(path, notes(1.3), SAMPLE_RATE, subtype="FLOAT")
    from_file = extract_features(path).stack()
    np.testing.assert_array_equal(from_file, extract_features(load_sound(path)).stack())


def test_gaps_of_a_second_and_more() -> None:
    loud = np.ones(300)
    loud[60:120] = loud[200:220] = 0.01
    assert silent_spans(loud) == [(60, 120)]
    assert silent_spans(np.zeros(90)) == [(0, 90)] and silent_spans(np.ones(90)) == []


def test_a_noise_within_a_song_is_found() -> None:
    rng = np.random.default_rng(0)
    chroma = 0.2 + 0.1 * rng.random((12, 400))
    chroma[3] = 1.0
    chroma[3, 100:220] = chroma[3, 300:330] = 0.25  # four seconds, and one
    loudness = 0.3 + 0.2 * (np.arange(400) % 15 == 0)
    loudness[100:220] = 0.1 * (1 + 0.05 * rng.random(120))
    ((start, stop),) = noise_spans(chroma, loudness)
    assert abs(start - 100) < 25 and abs(stop - 220) < 25
    drums = np.where(np.arange(400) % 15 < 5, 0.5, 0.01)
    assert noise_spans(np.full((12, 400), 0.3), drums) == []
    assert noise_spans(np.full((12, 9), 0.3), np.ones(9)) == []


def test_noise_has_no_pitch() -> None:
    rng = np.random.default_rng(0)
    noise = 1 - 0.3 * rng.random((12, 200))
    tune = 0.1 * noise
    tune[rng.integers(12, size=200), np.arange(200)] = 1
    assert is_noise(noise) and is_noise(np.zeros((12, 50))) and not is_noise(tune)
