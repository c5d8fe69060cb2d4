"""AudioCondition knows the beats that its rows hold."""

import numpy as np
import pytest
import torch
from hypothesis import given
from hypothesis import strategies as st

from src.shared.audio.beats import Beats
from src.shared.audio.features import AudioFeatures
from src.shared.audio.song import Song
from src.shared.data.phrases.layout import phase_rows
from src.shared.pipelines.song import AudioCondition, SongCondition

SHAPES = {"mel": (128,), "chroma": (12,), "mfcc": (20,), "rms": (), "spectral_centroid": (),
          "onset_strength": ()}  # fmt: skip


@given(bpm=st.floats(50, 200), meter=st.integers(2, 7), start=st.floats(0, 1, exclude_max=True))
def test_beats_are_read_from_the_rows(bpm: float, meter: int, start: float) -> None:
    bars = start + np.arange(300) / 30 * bpm / 60 / meter
    rows = np.concatenate([np.zeros((163, 300), np.float32), phase_rows(bars, meter)])
    time = AudioCondition.of(rows).time()
    assert time is not None
    shift = time[0] - bars
    np.testing.assert_allclose(shift, np.round(shift[0]), atol=1e-4)
    np.testing.assert_allclose(np.diff(time[1]), 60 / bpm, atol=1e-3)
    number = np.interp(time[1], np.arange(300) / 30, bars * meter)
    np.testing.assert_allclose(number, np.round(number), atol=1e-3)


@pytest.mark.parametrize("rows", [163, 167])
def test_no_beats_where_the_rows_hold_none(rows: int) -> None:
    assert AudioCondition(torch.zeros(rows, 30)).time() is None


def test_another_shape_is_no_condition() -> None:
    for shape in ((162, 30), (2, 163, 30), (163,)):
        with pytest.raises(ValueError, match="163 or 167"):
            AudioCondition.of(torch.zeros(shape))


def test_a_song_becomes_one(caplog: pytest.LogCaptureFixture) -> None:
    frames = 180
    silence = {name: np.zeros((*rows, frames), np.float32) for name, rows in SHAPES.items()}
    features = AudioFeatures(**silence)
    times = np.arange(0.25, 6, 0.5)
    song = Song(features, Beats(120.0, times, times[::4], 4, 1.0), 6.0, "")
    condition = AudioCondition.of(song)
    assert condition.rows.shape == (167, frames) and condition.first(50).num_frames == 50
    time = condition.time()
    assert time is not None
    np.testing.assert_allclose(time[1], times, atol=1e-3)
    np.testing.assert_allclose(np.diff(time[0]), np.diff(song.phase), atol=1e-5)
    assert SongCondition.of(song, 5.0).condition.shape[1] == 150 and not caplog.text
    assert SongCondition.of(song, 60.0).condition.shape[1] == frames
    assert "the song ends after 6 s" in caplog.text
