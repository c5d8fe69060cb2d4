"""Beats in the pictures: those of the song, or where the phase reaches whole beats."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from src.shared.formats.trajectory_beats import SongTrack, beat_marks, phase_palette
from src.shared.motion.trajectory import MotionTrajectory


def keeping(phase: np.ndarray) -> MotionTrajectory:
    """Standing still while the bar goes on."""
    frames = len(phase)
    turn = np.tile([1.0, 0, 0, 0], (frames, 1))
    return MotionTrajectory.from_pose(np.zeros((frames, 3)), turn, phase)


@settings(max_examples=40, deadline=None)
@given(st.floats(40, 220), st.integers(2, 6), st.floats(0, 0.99))
def test_beats_of_an_even_phase(tempo: float, meter: int, start: float) -> None:
    bars = start + np.arange(301) / 30 * tempo / 60 / meter
    marks = beat_marks(keeping(bars), SongTrack(meter=meter))
    beats = np.arange(np.ceil(bars[0] * meter), np.floor(bars[-1] * meter) + 1)
    expected = (beats / meter - start) * 60 * meter / tempo
    inner = (expected > 0.01) & (expected < 9.99)  # at the very ends float32 decides
    found = np.interp(expected[inner], marks.times, marks.times)
    np.testing.assert_allclose(found, expected[inner], atol=2e-3)
    assert abs(len(marks.times) - len(beats)) <= 2
    gap = np.abs(marks.times[:, None] - expected)
    known = gap.min(1) < 2e-3
    np.testing.assert_array_equal(marks.downbeat[known], (beats[gap.argmin(1)] % meter == 0)[known])


def test_the_songs_beats_win_and_are_cut_to_the_motion() -> None:
    song = SongTrack(None, np.arange(-1, 20) * 0.5, np.array([0.0, 1.5, 3.0]), 3)
    marks = beat_marks(keeping(np.linspace(0, 7, 61)), song)  # 2 seconds
    np.testing.assert_allclose(marks.times, [0, 0.5, 1, 1.5, 2])
    assert marks.downbeat.tolist() == [True, False, False, True, False]
    none = SongTrack(None, np.array([]), np.array([]))
    assert none.beatless and not song.beatless and not SongTrack().beatless
    assert not len(beat_marks(keeping(np.linspace(0, 7, 61)), none).times)
    assert not beat_marks(keeping(np.zeros(61)), SongTrack(None, np.array([1.0]))).downbeat.any()


@pytest.mark.parametrize("frames", [1, 2, 30])
def test_no_music_has_no_beats(frames: int) -> None:
    assert not len(beat_marks(keeping(np.zeros(frames)), SongTrack()).times)


def test_a_phase_that_halts_or_slips_back_still_has_rising_beats() -> None:
    phase = np.concatenate((np.linspace(0, 1, 30), np.full(20, 1.0), np.linspace(0.98, 2, 30)))
    times = beat_marks(keeping(phase), SongTrack()).times
    assert (np.diff(times) > 0).all()
    assert len(times) in (8, 9)


def test_colours_go_round_and_are_equally_light() -> None:
    palette = phase_palette(64).astype(float)
    steps = np.abs(np.diff(np.concatenate((palette, palette[:1])), axis=0)).max(1)
    assert steps.max() < 16
    assert palette.min() > 0  # nothing is cut off
    assert palette[0].argmax() == 0  # red at the downbeat
    linear = (palette / 255) ** 2.2 @ [0.2126, 0.7152, 0.0722]
    assert linear.std() / linear.mean() < 0.1
