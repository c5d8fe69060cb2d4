"""Songs in pages: playable files go in as they are, others as Ogg Vorbis, cut to the motion."""

import base64
import io
import threading
from pathlib import Path

import numpy as np
import pytest

from src.shared.errors import UserError
from src.shared.formats.preview import html as song_media
from src.shared.formats.preview.html import begin_song_uri, song_uri
from src.shared.io.sound_files import SoundReader

soundfile = pytest.importorskip("soundfile")


def song(path: Path, seconds: float = 2.0, rate: int = 8000, channels: int = 1, **how: str) -> Path:
    t = np.arange(round(seconds * rate)) / rate
    wave = 0.4 * np.sin(2 * np.pi * 220 * t)
    soundfile.write(path, np.stack([wave] * channels, 1), rate, **how)
    return path


def decoded(uri: str) -> tuple[str, bytes]:
    head, data = uri.split(";base64,")
    return head, base64.b64decode(data, validate=True)


@pytest.mark.parametrize(
    ("name", "kind"),
    [("a.ogg", "audio/ogg"), ("a.mp3", "audio/mpeg"), ("a.flac", "audio/flac"),
     ("a.wav", "audio/wav")],
)  # fmt: skip
def test_what_browsers_play_goes_in_untouched(tmp_path: Path, name: str, kind: str) -> None:
    path = song(tmp_path / name)
    assert decoded(song_uri(path, 1.9)) == (f"data:{kind}", path.read_bytes())


@pytest.mark.parametrize(
    ("name", "rate", "channels", "how"),
    [("a.wav", 8000, 1, {"subtype": "ULAW"}), ("a.aiff", 44100, 2, {}),
     ("a.w64", 96000, 2, {}), ("a.caf", 48000, 6, {})],
)  # fmt: skip
def test_the_rest_becomes_vorbis(
    tmp_path: Path, name: str, rate: int, channels: int, how: dict[str, str]
) -> None:
    head, data = decoded(song_uri(song(tmp_path / name, 2.0, rate, channels, **how), 2.0))
    assert head == "data:audio/ogg"
    wave, new_rate = soundfile.read(io.BytesIO(data), always_2d=True)
    assert new_rate <= 48000
    assert wave.shape[1] == (2 if channels == 2 else 1)
    assert len(wave) == pytest.approx(2.0 * new_rate, abs=1)
    t = np.arange(len(wave)) / new_rate
    tone = 0.4 * np.sin(2 * np.pi * 220 * t)
    assert np.corrcoef(wave[:, 0], tone)[0, 1] > 0.99  # neither late nor early


def test_a_short_motion_takes_only_its_part(tmp_path: Path) -> None:
    data = decoded(song_uri(song(tmp_path / "a.ogg", 30.0), 4.0))[1]
    assert soundfile.info(io.BytesIO(data)).duration == pytest.approx(5.0, abs=0.01)


def test_a_large_lossless_file_is_encoded(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    path = song(tmp_path / "a.wav")
    monkeypatch.setitem(song_media.KEEP, "WAV", 1000)
    head, data = decoded(song_uri(path, 2.0))
    assert head == "data:audio/ogg"
    assert len(data) < path.stat().st_size / 2


def test_no_sound_is_a_user_error(tmp_path: Path) -> None:
    (tmp_path / "a.mp3").write_text("not a song")
    for name in ("a.mp3", "missing.ogg"):
        with pytest.raises(UserError, match=name):
            song_uri(tmp_path / name, 1.0)


def heard(path: Path) -> np.ndarray:
    """Mono samples [S] of a file as the analysis reads it."""
    return np.concatenate([block.mean(1) for block in SoundReader(path).blocks(8192)])


def sweep(path: Path, seconds: float = 6.0, rate: int = 44_100) -> Path:
    """A rising tone under noise: no two places sound alike."""
    t = np.arange(round(seconds * rate)) / rate
    noise = np.random.default_rng(0).standard_normal(len(t))
    soundfile.write(path, 0.3 * np.sin(2 * np.pi * (200 + 150 * t) * t) + 0.03 * noise, rate)
    return path


@pytest.mark.parametrize("name", ["a.wav", "a.flac", "a.ogg", "a.mp3"])
@pytest.mark.parametrize("harm", ["cut off", "a hole"])
def test_of_a_damaged_file_the_page_plays_what_was_analysed(
    tmp_path: Path, name: str, harm: str, capfd: pytest.CaptureFixture[str]
) -> None:
    path = sweep(tmp_path / name)
    data = bytearray(path.read_bytes())
    middle = len(data) // 2
    if harm == "cut off":
        del data[middle:]
    else:
        data[middle : middle + 6000] = bytes(6000)
    path.write_bytes(data)
    known = heard(path)
    played = soundfile.read(io.BytesIO(decoded(song_uri(path, len(known) / 44_100))[1]))[0]
    assert capfd.readouterr().err == ""  # the decoders' own chatter
    assert len(played) == pytest.approx(len(known), abs=1200)
    end = min(len(known), len(played))
    for start in range(0, end - 44_100, 22_050):  # second by second, neither late nor early
        piece = slice(start, start + 44_100)
        assert np.corrcoef(known[piece], played[piece])[0, 1] > 0.95


def test_samples_that_are_none_do_not_reach_the_page(tmp_path: Path) -> None:
    wave = np.full(16_000, 0.1, np.float32)
    wave[5000], wave[6000] = np.nan, 1e30
    soundfile.write(tmp_path / "a.wav", wave, 8000, subtype="FLOAT")
    head, data = decoded(song_uri(tmp_path / "a.wav", 2.0))
    played = soundfile.read(io.BytesIO(data))[0]
    assert head == "data:audio/ogg"
    assert np.isfinite(played).all() and np.abs(played).max() < 0.5


def test_what_is_begun_beforehand_is_the_same(tmp_path: Path) -> None:
    path = song(tmp_path / "a.ogg", 3.0)
    at_once = song_uri(path, 2.0)
    begin_song_uri(path, 2.0)
    assert song_uri(path, 2.0) == at_once
    path.unlink()
    begin_song_uri(path, 2.0)
    with pytest.raises(UserError, match=r"a\.ogg"):
        song_uri(path, 2.0)


def test_nobody_waits_for_a_sound_at_the_end(tmp_path: Path) -> None:
    path = song(tmp_path / "a.wav", 120.0, 44_100)
    before = set(threading.enumerate())
    begin_song_uri(path, 120.0)
    begun = set(threading.enumerate()) - before
    assert begun and all(thread.daemon for thread in begun)
    assert song_uri(path, 120.0)
