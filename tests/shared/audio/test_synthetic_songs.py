"""Synthetic songs: exact beats and phases, split tempi, the same sound for the same seed."""

from dataclasses import replace
from itertools import pairwise
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from src.shared.audio.synthetic import (
    HELD_OUT_TEMPI,
    SAMPLE_RATE,
    TIMBRES,
    TRAIN_TEMPI,
    SongSpec,
    TempoMap,
    render_song,
    sample_song_specs,
    song_beats,
    song_phase,
    tone,
)

RAMP = ((0.0, 80.0), (10.0, 120.0), (15.0, 120.0), (15.0, 90.0))


def as_knots(steps: list[tuple[float, float]]) -> tuple[tuple[float, float], ...]:
    times = np.cumsum([0.0] + [gap for gap, _ in steps[1:]])
    return tuple((float(t), tempo) for t, (_, tempo) in zip(times, steps, strict=True))


gaps = st.floats(0.1, 20.0)
knots = st.lists(st.tuples(gaps, st.floats(40.0, 200.0)), min_size=1, max_size=4).map(as_knots)


@given(knots)
@settings(max_examples=50, deadline=None)
def test_seconds_inverts_beats(points: tuple[tuple[float, float], ...]) -> None:
    tempo_map = TempoMap(points)
    beats = np.arange(-8, 120)
    np.testing.assert_allclose(tempo_map.beats(tempo_map.seconds(beats)), beats, atol=1e-9)


def test_tempo_map_integrates_the_tempo() -> None:
    tempo_map = TempoMap(RAMP)
    times = np.linspace(0, 25, 250_001)
    tempo = np.interp(times, [0, 10, 15, 15 + 1e-9], [80, 120, 120, 90])
    steps = (tempo[1:] + tempo[:-1]) / 120 * np.diff(times)
    by_sum = np.concatenate([[0.0], np.cumsum(steps)])
    np.testing.assert_allclose(tempo_map.beats(times), by_sum, atol=1e-4)


def test_beats_of_a_constant_tempo() -> None:
    song = render_song(SongSpec(seconds=8.0, tempo=90.0, meter=3, silence=0.25, pickup=2))
    step = 60 / 90
    np.testing.assert_allclose(song.beat_times, 0.25 + step * np.arange(12))
    np.testing.assert_allclose(song.downbeat_times, song.beat_times[2::3])
    assert song.samples.shape == (8 * SAMPLE_RATE,) and song.samples.dtype == np.float32
    assert not song.samples[: round(0.25 * SAMPLE_RATE)].any() and song.samples[-SAMPLE_RATE:].any()


@pytest.mark.parametrize("tempo", [97.3, RAMP])
def test_phase_is_whole_at_downbeats_and_monotone(tempo: float) -> None:
    spec = SongSpec(seconds=20.0, tempo=tempo, meter=4, pickup=1)
    song = render_song(spec)
    at_downbeats = song_phase(spec, song.downbeat_times)
    np.testing.assert_allclose(at_downbeats, np.arange(len(at_downbeats)), atol=1e-9)
    phase = song.phase(600)
    assert phase.dtype == np.float64 and phase.shape == (600,)
    assert phase[0] < 0 and (np.diff(phase) > 0).all()


def test_sounds_start_on_the_beat() -> None:
    spec = SongSpec(seconds=6.0, tempo=120.0, voices=("drums",), density=0.0, dynamics=0.0, seed=3)
    song = render_song(spec)
    loud = np.abs(song.samples) > 0.02
    for beat in song.beat_times:  # silence or a tail before, a stroke within 3 ms after
        at = round(beat * SAMPLE_RATE)
        window = np.abs(song.samples[at : at + 130])
        before = np.abs(song.samples[max(at - 130, 0) : at]).max(initial=0.0)
        assert window.max() > max(0.02, 1.5 * before)
    assert loud.any()


def test_a_seed_is_a_song() -> None:
    spec = SongSpec(seconds=4.0, noise=0.1, jitter=0.01, syncopation=0.7, density=0.9, seed=5)
    first, again = render_song(spec), render_song(spec)
    np.testing.assert_array_equal(first.samples, again.samples)
    other = render_song(replace(spec, seed=6))
    assert np.abs(first.samples - other.samples).max() > 0.05
    np.testing.assert_array_equal(first.beat_times, other.beat_times)


@pytest.mark.parametrize("meter", [2, 3, 4, 6])
def test_every_meter_and_voice_sounds(meter: int) -> None:
    for voice in ("drums", "bass", "chords", "melody"):
        spec = SongSpec(seconds=5.0, meter=meter, voices=(voice,), seed=meter)
        assert render_song(spec).samples.std() > 0.01


def test_splits_share_no_tempo() -> None:
    bands = sorted([*TRAIN_TEMPI, *HELD_OUT_TEMPI])
    assert all(low[1] <= high[0] for low, high in pairwise(bands))
    for split, allowed in (("train", TRAIN_TEMPI), ("held-out", HELD_OUT_TEMPI)):
        for spec in sample_song_specs(60, 1, split, seconds=40.0):
            length = spec.seconds - spec.first_downbeat
            times = np.linspace(-2.0, length, 400)
            tempi = 60 * np.diff(spec.tempo_map.beats(times)) / np.diff(times)
            inside = [any(low - 1e-6 <= t < high + 1e-6 for low, high in allowed) for t in tempi]
            assert sum(inside) >= len(tempi) - 1  # the step of a sudden change is a mean


def test_specs_do_not_depend_on_their_number() -> None:
    assert sample_song_specs(3, 7) == sample_song_specs(9, 7)[:3]
    assert sample_song_specs(3, 7) != sample_song_specs(3, 8)


def test_beats_without_rendering() -> None:
    spec = sample_song_specs(1, 2, "held-out")[0]
    song = render_song(spec)
    np.testing.assert_array_equal(song_beats(spec)[0], song.beat_times)


def test_wav_round_trip(tmp_path: Path) -> None:
    import soundfile

    song = render_song(SongSpec(seconds=2.0))
    song.write_wav(tmp_path / "song.wav")
    samples, rate = soundfile.read(tmp_path / "song.wav", dtype="float32")
    assert rate == SAMPLE_RATE
    np.testing.assert_allclose(samples, song.samples, atol=1e-4)


def test_tones_have_their_pitch() -> None:
    for timbre in TIMBRES:
        note = tone(69, timbre, 1.0)
        spectrum = np.abs(np.fft.rfft(note * np.hanning(note.size)))
        assert abs(int(spectrum.argmax()) * SAMPLE_RATE / note.size - 440) < 2


def test_wrong_specs_are_named() -> None:
    with pytest.raises(ValueError, match="meter is 5"):
        SongSpec(meter=5)
    with pytest.raises(ValueError, match="voices"):
        SongSpec(voices=("harp",))
