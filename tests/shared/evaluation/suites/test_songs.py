"""What is judged: held-out songs with true beats, windows of real phrases with their clock."""

from pathlib import Path

import numpy as np
import pytest
import soundfile

from src.shared.audio.synthetic import HELD_OUT_TEMPI, SongSpec, render_song
from src.shared.errors import UserError
from src.shared.evaluation.suites.songs import (
    conditions_of_songs,
    held_out_songs,
    open_split,
    phrases,
    tracks,
)
from src.shared.metrics.rhythm import phase_error
from src.shared.motion.trajectory import PHASE
from tests.shared.evaluation.tiny_pairs import write_pairs


def test_held_out_songs_know_their_beats() -> None:
    for piece in held_out_songs(3, 6.0, seed=0):
        assert piece.condition.shape == (167, 180) and piece.seconds == 6.0
        assert piece.bars is not None and piece.bars.shape == (180,)
        tempo = piece.about["tempo"]
        assert any(low <= tempo < high for low, high in HELD_OUT_TEMPI) or tempo > 0
        at = np.interp(piece.beats[piece.beats < 5.9], np.arange(180) / 30, piece.bars)
        beats = at * piece.true_meter
        assert beats == pytest.approx(np.round(beats), abs=1e-6)
        assert piece.beats[-1] > 6.0  # neighbours beyond the end
        assert piece.meter == piece.true_meter  # it was told
        assert piece.phase is None or len(piece.phase) == 180


def test_conditions_are_windows_of_the_length_asked_for() -> None:
    songs = conditions_of_songs(5, 120, seed=0)
    windows = [song.condition for song in songs]
    assert [tuple(window.shape) for window in windows] == [(167, 120)] * 5
    assert all(song.phase is not None and len(song.phase) == 120 for song in songs)
    assert len({song.seed for song in songs}) == 5, "each has noise of its own"
    assert not np.allclose(windows[0], windows[1])
    again = conditions_of_songs(5, 120, seed=0)
    assert all(bool((a == b.condition).all()) for a, b in zip(windows, again, strict=True))


def test_phrases_keep_motion_beats_and_song(tmp_path: Path) -> None:
    dataset = open_split(str(write_pairs(tmp_path)), "test", 120, seed=0)
    found = phrases(dataset, 3)
    assert len(found) == 3 and len({phrase.song for phrase in found}) == 3
    for phrase in found:
        assert phrase.motion.num_frames == phrase.audio.shape[1] == 120
        beats = phrase.motion.data[:, PHASE].astype(np.float64) * 4
        at = np.arange(120) / 30
        tempo = np.diff(phrase.motion.phase_unwrapped).mean() * 4 * 30
        nearest = (phrase.beats[:, None] - at).__abs__().argmin(1)
        expected = (phrase.beats - at[nearest]) * tempo + beats[nearest]
        assert phase_error(expected, np.zeros_like(expected)).absolute < 1e-3
    other = phrases(dataset, 3, draw=1)
    assert not np.allclose(found[0].audio, other[0].audio)  # another window
    assert phrases(open_split(str(tmp_path), "test", 200, seed=0), 3, whole=True) == []
    assert phrases(open_split(str(tmp_path), "test", 200, seed=0), 1)[0].motion.num_frames == 150


def test_tracks_are_cut_and_heard(tmp_path: Path) -> None:
    song = render_song(SongSpec(seconds=8.0, tempo=100.0, seed=3))
    song.write_wav(tmp_path / "a.wav")
    soundfile.write(tmp_path / "silence.wav", np.zeros(44_100 * 3), 44_100)
    first, second = tracks(tmp_path, 6.0)
    assert (first.name, second.name) == ("a", "silence")
    assert first.seconds == 6.0 and first.about["tempo"] == pytest.approx(100, rel=0.02)
    assert second.phase is None and second.beats.size == 0
    (tmp_path / "empty").mkdir()
    with pytest.raises(UserError, match="holds no sound file"):
        next(tracks(tmp_path / "empty", 6.0))
