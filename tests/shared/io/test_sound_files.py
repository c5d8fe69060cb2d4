"""mp3 files without a length tag are read to their end."""

from pathlib import Path

import numpy as np
import pytest
import soundfile
from hypothesis import given
from hypothesis import strategies as st

from src.shared.audio.sound import load_sound
from src.shared.io.sound_files import count_frames, parse_header, with_length


def write_mp3(path: Path, rate: int, channels: int = 2, seconds: float = 5.0) -> Path:
    """Quiet, then loud: the first frame's bit rate tells nothing about the length."""
    rng = np.random.default_rng(0)
    samples = 0.2 * rng.standard_normal((round(seconds * rate), channels))
    samples[: rate // 2] *= 1e-3
    soundfile.write(path, samples, rate, bitrate_mode="VARIABLE")
    return path


def without_tag(path: Path) -> Path:
    data = path.read_bytes()
    header = parse_header(data[:4])
    assert header is not None and data[header.tag_offset :][:4] in (b"Xing", b"Info")
    bare = path.with_name("bare.mp3")
    bare.write_bytes(data[header.size :])
    return bare


@pytest.mark.parametrize("rate, samples_a_frame", [(44100, 1152), (22050, 576), (8000, 576)])
@pytest.mark.parametrize("channels", [1, 2])
def test_no_sample_is_lost(tmp_path: Path, rate: int, samples_a_frame: int, channels: int) -> None:
    tagged = write_mp3(tmp_path / "song.mp3", rate, channels)
    bare = without_tag(tagged)
    assert with_length(tagged) is None
    assert with_length(bare) is not None
    whole, found = load_sound(tagged), load_sound(bare)
    assert found.notes == ()
    assert 0 <= found.seconds - whole.seconds < 4 * samples_a_frame / rate
    # The tag also says how many samples of the encoder's delay to drop: found is shifted by them.
    spectra = [np.fft.rfft(sound.samples, 1 << 19) for sound in (found, whole)]
    shift = int(np.argmax(np.fft.irfft(spectra[0] * spectra[1].conj())))
    assert 0 <= shift < 4 * samples_a_frame * 44100 / rate
    end = min(len(whole.samples), len(found.samples) - shift)
    agreement = np.corrcoef(whole.samples[:end], found.samples[shift : shift + end])[0, 1]
    assert agreement > 0.98 and end > 0.99 * len(whole.samples)


def test_frames_are_counted_past_tags_and_damage(tmp_path: Path) -> None:
    data = write_mp3(tmp_path / "song.mp3", 44100).read_bytes()
    count = count_frames(data, 0)
    assert count * 1152 / 44100 == pytest.approx(5.0, abs=0.1)
    assert abs(count_frames(data + b"TAG" + b"a" * 125, 0) - count) <= 1
    middle = len(data) // 2
    damaged = data[:middle] + bytes(300) + data[middle + 300 :]
    assert abs(count_frames(damaged, 0) - count) <= 3


def test_a_picture_before_the_music_is_skipped(tmp_path: Path) -> None:
    bare = without_tag(write_mp3(tmp_path / "song.mp3", 44100))
    tag = b"ID3\x03\x00\x00\x00\x00\x4e\x10" + bytes(10_000)
    bare.write_bytes(tag + bare.read_bytes())
    assert load_sound(bare).seconds == pytest.approx(5.0, abs=0.1)


@given(st.binary(max_size=400))
def test_any_bytes_are_taken(data: bytes) -> None:
    header = parse_header(data[:4])
    assert header is None or header.size > 20
    assert count_frames(data, 0) <= len(data)


@pytest.mark.parametrize("data", [b"", b"ID3", b"ID3\x03\0\0\x7f\x7f\x7f\x7f", b"\xff" * 5000])
def test_no_mp3_is_left_alone(tmp_path: Path, data: bytes) -> None:
    path = tmp_path / "song.mp3"
    path.write_bytes(data)
    assert with_length(path) is None
