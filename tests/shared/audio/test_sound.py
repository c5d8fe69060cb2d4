"""Sound files in, whatever their rate, channels and state."""

import tracemalloc
from pathlib import Path

import librosa
import numpy as np
import pytest
import soundfile

from src.shared.audio.sound import (
    SAMPLE_RATE,
    check_sound,
    load_sound,
    sound_from_samples,
)
from src.shared.errors import UserError


def tone(seconds: float, rate: int, channels: int = 1) -> np.ndarray:
    time = np.arange(round(seconds * rate)) / rate
    left = 0.3 * np.sin(2 * np.pi * 440 * time) + 0.1 * np.sin(2 * np.pi * 1234 * time)
    return np.stack([left * (1 - 0.2 * c) for c in range(channels)], axis=1).astype(np.float32)


def write(path: Path, samples: np.ndarray, rate: int = SAMPLE_RATE, **kind: str) -> Path:
    soundfile.write(path, samples, rate, **kind)
    return path


@pytest.fixture
def noise() -> np.ndarray:
    return (0.1 * np.random.default_rng(0).standard_normal((SAMPLE_RATE * 6, 2))).astype("f4")


@pytest.mark.parametrize("suffix", ["wav", "flac", "ogg", "mp3"])
@pytest.mark.parametrize("rate, channels", [(44100, 2), (22050, 1), (48000, 2)])
def test_reads_what_librosa_reads(tmp_path: Path, suffix: str, rate: int, channels: int) -> None:
    path = write(tmp_path / f"song.{suffix}", tone(2.5, rate, channels), rate)
    sound = load_sound(path)
    expected, _ = librosa.load(path, sr=SAMPLE_RATE, mono=True)
    assert sound.samples.dtype == np.float32
    assert abs(len(sound.samples) - len(expected)) <= 1
    count = min(len(sound.samples), len(expected))
    np.testing.assert_allclose(sound.samples[:count], expected[:count], atol=1e-6)
    assert sound.num_frames == 75
    assert sound.notes == ()


@pytest.mark.parametrize("rate", [8000, 11025, 96000, 192000])
def test_unusual_rates(tmp_path: Path, rate: int) -> None:
    sound = load_sound(write(tmp_path / "song.wav", tone(1.0, rate), rate))
    assert sound.num_frames == 30
    middle = sound.samples[5000:-5000]
    np.testing.assert_allclose(middle, tone(1.0, SAMPLE_RATE)[5000:-5000, 0], atol=2e-3)


def test_samples_in_memory_and_from_a_file_are_one(tmp_path: Path) -> None:
    samples = tone(1.5, 48000, 2)
    path = write(tmp_path / "song.wav", samples, 48000, subtype="FLOAT")
    from_memory = sound_from_samples(samples, 48000)
    np.testing.assert_allclose(from_memory.samples, load_sound(path).samples, atol=1e-7)
    assert len(from_memory.sha256) == 64


def test_nan_and_infinite_samples_become_silence(tmp_path: Path) -> None:
    samples = tone(2.0, SAMPLE_RATE)
    samples[1000:1010] = np.nan
    samples[5000], samples[6000] = np.inf, 1e30
    sound = load_sound(write(tmp_path / "song.wav", samples, subtype="FLOAT"))
    assert np.isfinite(sound.samples).all() and np.abs(sound.samples).max() < 1
    assert sound.notes == (
        "12 samples (0.01%) are not finite or far out of range, silence instead",
    )


def test_nothing_but_nan_is_refused(tmp_path: Path) -> None:
    path = write(tmp_path / "song.wav", np.full(SAMPLE_RATE * 2, np.nan, "f4"), subtype="FLOAT")
    with pytest.raises(UserError, match="no sample that is finite"):
        load_sound(path)


@pytest.mark.parametrize("suffix", ["wav", "flac", "ogg", "mp3"])
def test_truncated_files_say_so(tmp_path: Path, noise: np.ndarray, suffix: str, capfd) -> None:  # type: ignore[no-untyped-def]
    path = write(tmp_path / f"song.{suffix}", noise)
    assert load_sound(path).notes == ()
    path.write_bytes(path.read_bytes()[: path.stat().st_size // 2])
    sound = load_sound(path)
    assert 2.0 < sound.seconds < 3.3
    assert len(sound.notes) == 1 and sound.notes[0].startswith("cut off or damaged: ")
    assert capfd.readouterr().err == ""  # the decoders' own chatter


@pytest.mark.parametrize("suffix", ["wav", "flac", "ogg", "mp3"])
def test_hardly_anything_left_is_an_error(tmp_path: Path, noise: np.ndarray, suffix: str) -> None:
    path = write(tmp_path / f"song.{suffix}", noise)
    path.write_bytes(path.read_bytes()[: path.stat().st_size // 20])
    with pytest.raises(UserError, match=r"cut off or damaged|is no sound file") as caught:
        load_sound(path)
    assert "\n" not in str(caught.value)


def test_a_stream_without_a_length_is_no_damage(tmp_path: Path, noise: np.ndarray) -> None:
    path = write(tmp_path / "song.flac", noise)
    data = bytearray(path.read_bytes())
    data[21] &= 0xF0  # the 36 bits of STREAMINFO that count samples
    data[22:26] = bytes(4)
    path.write_bytes(data)
    assert load_sound(path).num_frames == 180 and load_sound(path).notes == ()
    path = write(tmp_path / "song.wav", noise)
    data = bytearray(path.read_bytes())
    data[4:8] = data[40:44] = b"\xff" * 4  # as written into a pipe
    path.write_bytes(data)
    assert load_sound(path).num_frames == 180 and load_sound(path).notes == ()


def test_damage_in_the_middle_keeps_what_comes_before(tmp_path: Path, noise: np.ndarray) -> None:
    path = write(tmp_path / "song.flac", noise)
    data = bytearray(path.read_bytes())
    middle = len(data) // 2
    data[middle : middle + 2000] = bytes(2000)
    path.write_bytes(data)
    sound = load_sound(path)
    assert sound.seconds > 2.5
    assert "of 6.0 s could be read" in sound.notes[0]


@pytest.mark.parametrize(
    "content, words",
    [
        (b"", "is empty"),
        (b"hello, world\n" * 500, "is no sound file"),
        (bytes(100_000), "is no sound file"),
        (b"RIFF\xff", "is no sound file"),
        (b"OggS", "is no sound file"),
    ],
)
@pytest.mark.parametrize("suffix", ["wav", "mp3", "raw", "m4a"])
def test_not_audio(tmp_path: Path, content: bytes, words: str, suffix: str, capfd) -> None:  # type: ignore[no-untyped-def]
    path = tmp_path / f"song.{suffix}"
    path.write_bytes(content)
    with pytest.raises(UserError, match=words):
        load_sound(path)
    assert capfd.readouterr().err == ""


def test_missing_and_folder(tmp_path: Path) -> None:
    with pytest.raises(UserError, match="does not exist"):
        load_sound(tmp_path / "none.wav")
    with pytest.raises(UserError, match="cannot read"):
        load_sound(tmp_path)


def test_length_limits(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    with pytest.raises(UserError, match=r"lasts 0\.50 s; at least 1 s"):
        load_sound(write(tmp_path / "short.wav", tone(0.5, SAMPLE_RATE)))
    with pytest.raises(UserError, match=r"lasts 0\.00 s"):
        load_sound(write(tmp_path / "none.wav", np.zeros(0, np.float32)))
    monkeypatch.setattr("src.shared.io.sound_files.MAX_SECONDS", 2.0)
    with pytest.raises(UserError, match="at most"):
        load_sound(write(tmp_path / "long.wav", tone(3.0, SAMPLE_RATE)))


def test_a_sound_that_is_too_long_is_refused_from_its_header(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    path = write(tmp_path / "day.flac", tone(1.0, SAMPLE_RATE))
    data = bytearray(path.read_bytes())
    samples = 24 * 3600 * SAMPLE_RATE
    data[21:26] = [data[21] & 0xF0 | samples >> 32, *(samples & 2**32 - 1).to_bytes(4)]
    path.write_bytes(data)

    def decoded(*_: object, **__: object) -> None:
        raise AssertionError("nothing is decoded")

    monkeypatch.setattr(soundfile.SoundFile, "read", decoded)
    for refuse in (load_sound, check_sound):
        with pytest.raises(UserError, match="lasts 1440 minutes; at most 120 can be read: cut it"):
            refuse(path)


def test_a_song_is_checked_without_being_decoded(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    good, short = tmp_path / "good.wav", write(tmp_path / "short.wav", tone(0.5, SAMPLE_RATE))
    write(good, tone(1.5, SAMPLE_RATE))
    with pytest.raises(UserError, match=r"lasts 0\.50 s; at least 1 s"):
        check_sound(short)
    monkeypatch.setattr(soundfile.SoundFile, "read", None)
    check_sound(good)


def test_a_sound_lies_in_memory_once(tmp_path: Path) -> None:
    path = write(tmp_path / "long.wav", np.zeros(SAMPLE_RATE * 60, np.int16))
    tracemalloc.start()
    sound = load_sound(path)
    _, peak = tracemalloc.get_traced_memory()
    tracemalloc.stop()
    assert peak < 1.6 * sound.samples.nbytes  # it grows by an eighth; a copy would make it 2


def test_silence_and_clipping_are_fine(tmp_path: Path) -> None:
    silent = load_sound(write(tmp_path / "silent.wav", np.zeros(SAMPLE_RATE * 2, np.float32)))
    assert not silent.samples.any()
    clipped = np.clip(20 * tone(2.0, SAMPLE_RATE), -1, 1)
    assert load_sound(write(tmp_path / "clipped.wav", clipped)).notes == ()


def test_channels_that_cancel_each_other_out_are_not_silence(tmp_path: Path) -> None:
    """A crossed wire: what is mixed to mono would be silence, and nobody would dance."""
    left = tone(2.0, 48000, 1)
    crossed = np.concatenate([left, -left], axis=1)
    path = write(tmp_path / "song.wav", crossed, 48000, subtype="FLOAT")
    alone = load_sound(write(tmp_path / "left.wav", left, 48000, subtype="FLOAT"))
    for sound in (load_sound(path), sound_from_samples(crossed, 48000)):
        np.testing.assert_allclose(sound.samples, alone.samples, atol=1e-6)
        assert "cancel" in sound.notes[-1]
    assert load_sound(write(tmp_path / "still.wav", 0 * crossed, 48000)).notes == ()
    hiss, silent = 1e-4 * left[::-1], np.zeros((len(left), 31), np.float32)
    for channels, heard in (([hiss, left, -0.95 * left], True), ([left, silent], False)):
        notes = sound_from_samples(np.concatenate(channels, axis=1), 48000).notes
        assert any("cancel" in note for note in notes) is heard
