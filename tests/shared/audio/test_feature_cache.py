"""Analysed songs are found again by content; broken entries are made again."""

import logging
from pathlib import Path

import numpy as np
import pytest
import soundfile

from src.shared.audio import song
from src.shared.audio.features import AudioFeatures, read_arrays
from src.shared.audio.song import (
    FOLDER_VARIABLE,
    Song,
    analyse,
    analyse_sound,
    cache_folder,
)
from src.shared.audio.sound import SAMPLE_RATE, load_sound
from src.shared.audio.synthetic import SongSpec, render_song
from src.shared.errors import UserError


@pytest.fixture(scope="module")
def tune(tmp_path_factory: pytest.TempPathFactory) -> Path:
    rendered = render_song(SongSpec(seconds=6.0, tempo=120.0, seed=3))
    path = tmp_path_factory.mktemp("songs") / "tune.wav"
    soundfile.write(path, rendered.samples, rendered.sample_rate)
    return path


@pytest.fixture
def analyses(monkeypatch: pytest.MonkeyPatch) -> list[str]:
    """Grows by one each time a song is really analysed."""
    seen: list[str] = []

    def counted(sound, **options):  # type: ignore[no-untyped-def]
        seen.append(sound.sha256)
        return analyse_sound(sound, **options)

    monkeypatch.setattr(song, "analyse_sound", counted)
    return seen


def same(a: Song, b: Song) -> None:
    for name, array in a.arrays().items():
        np.testing.assert_array_equal(array, b.arrays()[name], err_msg=name)


def test_a_song_is_analysed_once(tune: Path, tmp_path: Path, analyses: list[str]) -> None:
    first = analyse(tune, cache=tmp_path)
    copy = tmp_path / "renamed.wav"
    copy.write_bytes(tune.read_bytes())
    same(first, analyse(copy, cache=tmp_path))
    assert len(analyses) == 1
    analyse(tune, cache=tmp_path, meter=3)
    assert len(analyses) == 2, "another meter is another entry"
    analyse(tune, cache=False)
    assert len(analyses) == 3


def test_other_content_is_another_entry(tune: Path, tmp_path: Path, analyses: list[str]) -> None:
    samples, rate = soundfile.read(tune)
    other = tmp_path / "tune.wav"
    soundfile.write(other, samples * 0.5, rate)
    analyse(tune, cache=tmp_path)
    analyse(other, cache=tmp_path)
    assert len(set(analyses)) == 2


def test_newer_code_does_not_trust_older_entries(
    tune: Path, tmp_path: Path, analyses: list[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    analyse(tune, cache=tmp_path)
    monkeypatch.setattr(song, "code_version", lambda: "another")
    analyse(tune, cache=tmp_path)
    assert len(analyses) == 2


@pytest.mark.parametrize("damage", ["cut", "flip", "empty", "other arrays"])
def test_a_broken_entry_is_made_again(
    tune: Path, tmp_path: Path, analyses: list[str], damage: str, caplog: pytest.LogCaptureFixture
) -> None:
    first = analyse(tune, cache=tmp_path)
    (entry,) = tmp_path.glob("*.npz")
    data = bytearray(entry.read_bytes())
    if damage == "cut":
        entry.write_bytes(data[: len(data) // 2])
    elif damage == "flip":
        data[len(data) // 3] ^= 255
        entry.write_bytes(data)
    elif damage == "empty":
        entry.write_bytes(b"")
    else:
        np.savez(entry, mel=np.zeros((128, 3)))
    with caplog.at_level(logging.WARNING):
        same(first, analyse(tune, cache=tmp_path))
    assert len(analyses) == 2 and "made again" in caplog.text
    same(first, analyse(tune, cache=tmp_path))
    assert len(analyses) == 2


def test_a_cache_that_cannot_be_written_is_only_a_warning(
    tune: Path, tmp_path: Path, caplog: pytest.LogCaptureFixture
) -> None:
    (tmp_path / "file").write_text("in the way")
    with caplog.at_level(logging.WARNING):
        assert analyse(tune, cache=tmp_path / "file" / "folder").num_frames == 180
    assert "not cached" in caplog.text and FOLDER_VARIABLE in caplog.text


def test_the_environment_moves_the_folder(
    tune: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv(FOLDER_VARIABLE, str(tmp_path / "mine"))
    analyse(tune)
    assert len(list((tmp_path / "mine").glob("*.npz"))) == 1
    monkeypatch.delenv(FOLDER_VARIABLE)
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path))
    assert cache_folder() == tmp_path / "motionsuite" / "audio"


def test_without_a_folder_nothing_is_kept(
    tune: Path, tmp_path: Path, analyses: list[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv(FOLDER_VARIABLE, str(tmp_path))
    for _ in range(2):
        analyse(tune, cache=False)
    assert len(analyses) == 2 and not list(tmp_path.iterdir())


def test_notes_come_back_from_the_cache(
    tune: Path, tmp_path: Path, caplog: pytest.LogCaptureFixture
) -> None:
    cut = tmp_path / "cut.wav"
    cut.write_bytes(tune.read_bytes()[: tune.stat().st_size // 2])
    for _ in range(2):
        caplog.clear()
        with caplog.at_level(logging.WARNING):
            assert analyse(cut, cache=tmp_path).notes
        assert "cut off" in caplog.text and str(cut) in caplog.text


def test_arrays_are_the_documents_and_ours(tune: Path, tmp_path: Path) -> None:
    analysed = analyse(tune, cache=False, meter=4)
    assert analysed.beats.tempo == pytest.approx(120, rel=0.02)
    arrays = analysed.arrays()
    frames = analysed.num_frames
    assert frames == 180 and arrays["phase"].shape == (frames,)
    assert (np.diff(arrays["phase"]) > 0).all()
    at_downbeats = np.interp(arrays["downbeat_times"], np.arange(frames) / 30, arrays["phase"])
    np.testing.assert_allclose(at_downbeats, np.rint(at_downbeats), atol=0.02)
    path = analysed.save(tmp_path / "song.npz")
    stored_features = AudioFeatures.from_arrays(read_arrays(path), path)
    np.testing.assert_array_equal(stored_features.stack(), analysed.features.stack())
    with np.load(path) as stored:
        assert {"tempo", "beat_times", "downbeat_times", "phase", "meter"} <= set(stored.files)


@pytest.mark.parametrize("kind", ["silence", "noise", "hum"])
def test_sounds_without_a_beat_are_songs_too(kind: str, tmp_path: Path) -> None:
    rng = np.random.default_rng(0)
    time = np.arange(3 * SAMPLE_RATE) / SAMPLE_RATE
    samples = {
        "silence": np.zeros(time.size),
        "noise": 0.1 * rng.standard_normal(time.size),
        "hum": 0.1 * np.sin(2 * np.pi * 50 * time),
    }[kind]
    path = tmp_path / "sound.flac"
    soundfile.write(path, samples, SAMPLE_RATE)
    analysed = analyse_sound(load_sound(path))
    assert analysed.num_frames == 90
    assert analysed.beats.tempo >= 0 and np.isfinite(analysed.phase).all()
    if kind == "silence":
        assert analysed.beats.tempo == 0.0 and not len(analysed.beats.beat_times)


def test_a_missing_song_is_named(tmp_path: Path) -> None:
    with pytest.raises(UserError, match="does not exist"):
        analyse(tmp_path / "none.mp3", cache=tmp_path)
