"""Beats, tempo, downbeats and bar phase against songs whose beats are known exactly."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from src.shared.audio.beats import (
    Beats,
    _numbers,
    detect_onsets,
    mel_filters,
    track_beats,
)
from src.shared.audio.song import DEFAULT_TEMPO, bar_phase
from src.shared.audio.synthetic import (
    SAMPLE_RATE,
    SongSpec,
    SyntheticSong,
    render_song,
    sample_song_specs,
)
from tests.shared.audio.other_songs import pattern, pop


def f_measure(truth: np.ndarray, found: np.ndarray, window: float = 0.07) -> float:
    """2PR/(P+R) of the beats within `window` seconds, each matched once (in order)."""
    hits = index = 0
    for time in truth:
        while index < len(found) and found[index] < time - window:
            index += 1
        if index < len(found) and found[index] <= time + window:
            hits, index = hits + 1, index + 1
    return 2 * hits / max(len(truth) + len(found), 1)


def phase_errors(song: SyntheticSong, beats: Beats) -> tuple[float, float]:
    """Median circular error of the beat phase and of the bar phase between first and last beat."""
    frames = np.arange(round(song.spec.seconds * 30))
    within = (frames / 30 >= song.beat_times[0]) & (frames / 30 <= song.beat_times[-1])
    truth = song.phase(frames.size)[within]
    found = bar_phase(beats, frames.size)[within]
    bars = np.abs((found - truth + 0.5) % 1 - 0.5)
    turns = np.abs((found * beats.meter - truth * song.spec.meter + 0.5) % 1 - 0.5)
    return float(np.median(turns)), float(np.median(bars))


def test_f_measure_by_hand() -> None:
    truth = np.array([1.0, 2.0, 3.0, 4.0])
    assert f_measure(truth, truth) == 1.0
    assert f_measure(truth, truth + 0.069) == 1.0
    assert f_measure(truth, truth + 0.071) == 0.0
    assert f_measure(truth, np.arange(1.0, 4.1, 0.5)) == pytest.approx(2 * 4 / (4 + 7))
    assert f_measure(truth, truth[:0]) == 0.0
    mir_eval = pytest.importorskip("mir_eval")
    rng = np.random.default_rng(0)
    for _ in range(20):
        truth, found = np.cumsum(rng.uniform(0.3, 1, 40)), np.cumsum(rng.uniform(0.3, 1, 40))
        expected = mir_eval.beat.f_measure(truth, found)
        assert f_measure(truth, found) == pytest.approx(expected, abs=1e-9)


def test_a_plain_song_to_the_millisecond() -> None:
    song = render_song(SongSpec(seconds=20.0, tempo=97.3, seed=1))
    beats = track_beats(song.samples)
    assert beats.tempo == pytest.approx(97.3, abs=0.1)
    assert f_measure(song.beat_times, beats.beat_times, 0.02) > 0.98
    assert f_measure(song.downbeat_times, beats.downbeat_times, 0.02) > 0.95
    assert beats.confidence > 0.7 and beats.meter == 4
    assert max(phase_errors(song, beats)) < 0.015


def test_held_out_songs() -> None:
    """A sample of the benchmark: tempi never fitted to, several meters, changes of tempo."""
    specs = sample_song_specs(9, 21, "held-out", seconds=20.0)
    songs = [render_song(spec) for spec in specs]
    found = [track_beats(song.samples, meter=song.spec.meter) for song in songs]
    scores = [
        f_measure(song.beat_times, b.beat_times) for song, b in zip(songs, found, strict=True)
    ]
    errors = np.array([phase_errors(song, b) for song, b in zip(songs, found, strict=True)])
    assert np.median(scores) > 0.97 and np.mean(scores) > 0.9
    assert np.median(errors[:, 0]) < 0.03
    assert (errors[:, 1] < 0.1).mean() >= 0.75


def test_a_waltz_is_recognised() -> None:
    song = render_song(SongSpec(seconds=25.0, tempo=150.0, meter=3, seed=4))
    beats = track_beats(song.samples, meter=None)
    assert beats.meter == 3 and beats.tempo == pytest.approx(150, rel=0.01)
    assert f_measure(song.downbeat_times, beats.downbeat_times) > 0.9
    assert track_beats(song.samples, meter=4).meter == 4


def test_bars_that_strokes_alone_tell() -> None:
    """Without harmony the weights of before began two bars of three a beat off."""
    songs = [pattern(seed, seconds=12.0) for seed in range(1000, 1010)]
    found = [track_beats(song.samples, meter=song.meter) for song in songs]
    scores = [
        f_measure(song.downbeat_times, beats.downbeat_times)
        for song, beats in zip(songs, found, strict=True)
    ]
    assert np.mean(scores) > 0.85


def test_a_dotted_bass_is_not_the_beat() -> None:
    """One and a half times 117.5 is 176: what was heard."""
    songs = [pop(seed, seconds=12.0, tempo=117.5) for seed in range(1000, 1010)]
    tempi = np.array([track_beats(song.samples).tempo for song in songs])
    assert (np.abs(tempi / 117.5 - 1) < 0.04).mean() >= 0.8


def test_a_gap_has_no_beats_and_loses_no_bar() -> None:
    song = render_song(SongSpec(seconds=20.0, tempo=120.0, seed=6, silence=0.0))
    whole = track_beats(song.samples)
    sound = song.samples.copy()
    sound[8 * SAMPLE_RATE : 13 * SAMPLE_RATE] = 0.0
    beats = track_beats(sound)
    assert not ((beats.beat_times > 8.7) & (beats.beat_times < 12.9)).any()
    late = beats.beat_times > 13
    assert f_measure(song.beat_times[song.beat_times > 13], beats.beat_times[late]) > 0.9
    phase, expected = (bar_phase(each, 600) for each in (beats, whole))
    assert (np.diff(phase) > 0).all() and np.abs(phase - expected)[450:].max() < 0.1


def club(tempo: float, *, hats: float = 0.2, bass: float = 0.0, rate: int = 44_100) -> np.ndarray:
    """Twenty seconds of kicks on the beat, hats and a held bass between them."""
    rng, time = np.random.default_rng(1), np.arange(rate // 5) / rate
    kick = 0.9 * np.sin(2 * np.pi * (50 * time + 8 * (1 - np.exp(-30 * time)))) * np.exp(-15 * time)
    hat = hats * rng.normal(size=len(time)) * np.exp(-70 * time)
    held = np.arange(round(0.9 * 30 / tempo * rate)) / rate
    note = bass * np.tanh(4 * np.sin(2 * np.pi * 55 * held))
    sound = np.zeros(20 * rate)
    for beat in np.arange(0, 19.4, 60 / tempo):
        for stroke, when in ((kick, beat), (hat, beat + 30 / tempo), (note, beat + 30 / tempo)):
            start = round(when * rate)
            sound[start : start + len(stroke)] += stroke
    return sound


@pytest.mark.parametrize(
    ("tempo", "hats", "bass"),
    [(90, 0.2, 0), (90, 0.5, 0), (110, 0.2, 0), (110, 0.5, 0), (120, 0.2, 0), (128, 0.5, 0),
     (120, 0.2, 0.3), (140, 0.2, 0), (174, 0.2, 0)],
)  # fmt: skip
def test_the_beat_of_a_club_is_where_its_kicks_are(tempo: float, hats: float, bass: float) -> None:
    """A tenth of them was heard at two fifths of its tempo, another at the double, and more than
    half of the others on their hats."""
    found = track_beats(club(tempo, hats=hats, bass=bass))
    assert found.tempo == pytest.approx(tempo, rel=0.01)
    assert f_measure(np.arange(0, 19.4, 60 / tempo), found.beat_times) > 0.9


def test_kicks_that_are_loud_and_soft_in_turn_are_beats_all() -> None:
    rate, time = 44_100, np.arange(8820) / 44_100
    kick = np.sin(2 * np.pi * (50 * time + 8 * (1 - np.exp(-30 * time)))) * np.exp(-15 * time)
    sound, beats = np.zeros(20 * rate), np.arange(0, 19.4, 60 / 180)
    for number, beat in enumerate(beats):
        start = round(beat * rate)
        sound[start : start + len(kick)] += (0.36 if number % 2 else 0.9) * kick
    assert track_beats(sound).tempo == pytest.approx(180, rel=0.01)


def test_silence_around_a_song_is_no_reason_to_doubt_it() -> None:
    spec = SongSpec(seconds=16.0, tempo=118.0, seed=3)
    plain = track_beats(render_song(spec).samples)
    for before, behind in ((40.0, 0.0), (0.0, 40.0), (70.0, 30.0)):
        hiss = np.random.default_rng(0).normal(0, 3e-5, round((before + 16.0 + behind) * 44_100))
        start = round(before * 44_100)
        hiss[start : start + 16 * 44_100] += render_song(spec).samples[: 16 * 44_100]
        found = track_beats(hiss)
        assert found.tempo == pytest.approx(plain.tempo, rel=0.01) and found.meter == plain.meter
        own = found.beat_times - before
        assert len(own) == pytest.approx(len(plain.beat_times), abs=1)
        assert np.abs(own[:, None] - plain.beat_times).min(1).max() < 0.03
        assert np.isin(found.downbeat_times, found.beat_times).all()


def test_a_change_of_tempo_is_followed() -> None:
    spec = SongSpec(seconds=30.0, tempo=((0.0, 100.0), (15.0, 100.0), (15.0, 128.0)), seed=2)
    song = render_song(spec)
    beats = track_beats(song.samples)
    assert f_measure(song.beat_times, beats.beat_times) > 0.9
    gaps = np.diff(beats.beat_times)
    assert 60 / np.median(gaps[:15]) == pytest.approx(100, rel=0.02)
    assert 60 / np.median(gaps[-15:]) == pytest.approx(128, rel=0.02)


def test_loudness_and_sample_rate_change_little() -> None:
    song = render_song(SongSpec(seconds=12.0, tempo=110.0, seed=3))
    whole = track_beats(song.samples)
    from scipy.signal import resample_poly

    half = track_beats(resample_poly(song.samples, 1, 2).astype(np.float32), SAMPLE_RATE // 2)
    assert half.tempo == pytest.approx(whole.tempo, rel=0.005)
    louder = track_beats(song.samples * np.float32(1e-3))
    np.testing.assert_allclose(louder.beat_times, whole.beat_times, atol=1e-3)


def unrhythmic() -> dict[str, np.ndarray]:
    rng = np.random.default_rng(5)
    count = 15 * SAMPLE_RATE
    strokes = np.zeros(count, dtype=np.float32)
    for start in rng.integers(0, count - 8000, 45):
        fade = np.exp(-np.arange(8000) / 2000)
        strokes[start : start + 8000] += (rng.standard_normal(8000) * fade).astype(np.float32)
    turns = 0.03 * np.arange(count) + 40 * np.sin(np.arange(count) * 2e-5)
    return {
        "silence": np.zeros(count, np.float32),
        "constant": np.full(count, 0.5, np.float32),
        "noise": 0.1 * rng.standard_normal(count, dtype=np.float32),
        "glide": np.sin(turns).astype(np.float32),
        "strokes at random": strokes,
    }


@pytest.mark.parametrize("name", list(unrhythmic()))
def test_no_beats_where_nothing_repeats(name: str) -> None:
    beats = track_beats(unrhythmic()[name])
    assert beats.tempo == 0.0 and beats.confidence == 0.0
    assert len(beats.beat_times) == len(beats.downbeat_times) == 0
    phase = bar_phase(beats, 61)
    assert phase[-1] == pytest.approx(2 * DEFAULT_TEMPO / 60 / 4)


@pytest.mark.parametrize("samples", [0, 1, 2000, 20_000, SAMPLE_RATE, 2 * SAMPLE_RATE])
def test_short_sounds_do_not_fail(samples: int) -> None:
    song = render_song(SongSpec(seconds=3.0, silence=0.0))
    beats = track_beats(song.samples[:samples], meter=None)
    assert np.isfinite(bar_phase(beats, 30)).all()


times = st.lists(st.floats(0.2, 1.4), min_size=2, max_size=30).map(np.cumsum)


@given(times, st.integers(2, 6), st.integers(0, 5), st.sampled_from([24.0, 30.0]))
@settings(max_examples=60, deadline=None)
def test_bar_phase_rises_and_is_whole_at_downbeats(
    beat_times: np.ndarray, meter: int, first: int, fps: float
) -> None:
    downbeats = beat_times[min(first, len(beat_times) - 1) :: meter]
    beats = Beats(100.0, beat_times, downbeats, meter, 0.9)
    phase = bar_phase(beats, round(beat_times[-1] * fps) + 90, fps)
    assert phase.dtype == np.float64 and (np.diff(phase) > 0).all()
    exact = np.interp(downbeats, np.arange(phase.size) / fps, phase)
    # Between two frames the phase may bend at a beat: a frame of the fastest beat is the bound.
    assert np.abs(exact - np.arange(len(downbeats))).max() < 1 / (fps * 0.2 * meter) + 1e-9
    np.testing.assert_array_equal(phase[:20], bar_phase(beats, 20, fps))


def test_bar_phase_by_hand() -> None:
    beat_times = np.array([1.0, 1.5, 2.0, 2.5, 3.0, 3.5, 4.0])
    beats = Beats(120.0, beat_times, beat_times[1::3], 3, 1.0)
    phase = bar_phase(beats, 6, fps=1.0)
    np.testing.assert_allclose(phase, [-1.0, -1 / 3, 1 / 3, 1.0, 5 / 3, 7 / 3], atol=1e-12)
    odd_bar = Beats(120.0, beat_times, beat_times[[0, 5]], 4, 1.0)
    np.testing.assert_allclose(bar_phase(odd_bar, 5, fps=2.0)[2:], [0.0, 0.2, 0.4])


def test_downbeats_survive_a_lost_beat() -> None:
    scores = np.where(np.arange(48) % 4 == 1, 1.0, -0.33)
    assert (np.flatnonzero(_numbers(scores, 4) == 0) == np.arange(1, 48, 4)).all()
    lost = np.delete(scores, 22)
    opening = np.flatnonzero(_numbers(lost, 4) == 0)
    assert set(np.arange(24, 47, 4)) <= set(opening) and {1, 5, 9, 13} <= set(opening)


@given(st.integers(8_000, 96_000))
@settings(max_examples=30, deadline=None)
def test_no_mel_filter_is_empty(sample_rate: int) -> None:
    size = 2 ** round(np.log2(0.04 * sample_rate))
    bins = np.arange(size // 2 + 1) * sample_rate / size
    centres, filters = mel_filters(bins)
    assert np.isfinite(filters).all() and np.allclose(filters.sum(axis=1), 1, atol=1e-5)
    assert (np.diff(centres) > 0).all()


def test_onsets_lie_on_the_strokes() -> None:
    strokes = np.array([0.5, 1.237, 2.0042])
    sound = np.zeros(3 * SAMPLE_RATE, dtype=np.float32)
    rng = np.random.default_rng(0)
    for stroke in strokes:
        start = round(stroke * SAMPLE_RATE)
        sound[start : start + 4000] = rng.standard_normal(4000) * np.exp(-np.arange(4000) / 800)
    onsets = detect_onsets(sound, SAMPLE_RATE)
    assert onsets.strength.size == 301 and onsets.fps == 100.0 and not onsets.silent
    for stroke in strokes:
        near = np.arange(round(stroke * 100) - 4, round(stroke * 100) + 5)
        weight = onsets.strength[near]
        assert abs((near * weight).sum() / weight.sum() / 100 - stroke) < 0.01
