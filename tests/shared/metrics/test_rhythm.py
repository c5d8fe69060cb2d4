"""Phase errors against closed forms, beat matching against mir_eval, alignment on made-up cases."""

import mir_eval
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from src.shared.metrics.rhythm import (
    COLUMNS,
    Rhythm,
    against_chance,
    beats_of_phase,
    circular_error,
    half_beat_later,
    hit_f_measure,
    mean_rhythm,
    motion_beats,
    phase_error,
    rhythm,
    turned_round,
)

RISING = np.linspace(0.0, 12.0, 4800, endpoint=False)
BEATS = np.arange(0.25, 16, 0.5)  # 120 BPM


@pytest.mark.parametrize("offset", [0.0, 0.1, -0.2, 0.49])
def test_a_constant_offset_is_the_error(offset: float) -> None:
    error = phase_error(RISING + offset, RISING)
    assert error.absolute == pytest.approx(abs(offset), abs=1e-9)
    assert error.offset == pytest.approx(offset, abs=1e-9)
    assert error.concentration == pytest.approx(1.0)


def test_a_constant_phase_scores_what_guessing_does() -> None:
    error = phase_error(np.zeros_like(RISING), RISING)
    assert error.absolute == pytest.approx(0.25, abs=1e-3)
    assert error.concentration == pytest.approx(0.0, abs=1e-9)


@given(st.floats(-50, 50), st.floats(-50, 50), st.integers(-5, 5))
def test_whole_turns_do_not_count(phase: float, truth: float, turns: int) -> None:
    error = circular_error(np.array([phase]), np.array([truth]))
    assert -0.5 <= error[0] < 0.5
    turned = circular_error(np.array([phase + turns]), np.array([truth]))
    apart = (turned - error + 0.5) % 1.0 - 0.5  # at ±0.5 rounding may choose the other end
    assert abs(float(apart[0])) < 1e-9


def test_the_error_of_beats_is_the_bar_error_times_the_meter() -> None:
    bars = RISING / 4
    assert phase_error((bars + 0.02) * 4, bars * 4).absolute == pytest.approx(0.08)
    assert phase_error(bars + 0.02, bars).absolute == pytest.approx(0.02)


def test_beats_lie_where_the_phase_passes_whole_numbers() -> None:
    at = np.arange(300) / 30.0
    times = beats_of_phase((at - 0.31) * 1.5)
    expected = 0.31 + np.arange(0, 15) / 1.5
    assert times == pytest.approx(expected[expected <= at[-1]], abs=1e-9)


# ---------------------------------------------------------------- beats on beats


def test_beats_on_beats_score_one() -> None:
    score = rhythm(BEATS, BEATS, 16.0)
    assert score == Rhythm(1.0, 1.0, 1.0, 1.0, 0.0)


def test_every_second_beat_is_half_heard() -> None:
    score = rhythm(BEATS[::2], BEATS, 16.0)
    assert score.motion_to_music == 1.0
    assert score.music_to_motion == pytest.approx(0.5, abs=1e-4)
    assert score.f == pytest.approx(2 / 3, abs=1e-4)
    assert score.hits == pytest.approx(2 / 3)


def test_one_sigma_off_is_the_gaussian() -> None:
    score = rhythm(BEATS + 0.05, BEATS, 16.0)
    assert score.motion_to_music == pytest.approx(np.exp(-0.5), abs=1e-6)
    assert score.distance == pytest.approx(0.05)
    assert score.hits == 1.0


def test_half_a_beat_later_is_as_wrong_as_it_gets() -> None:
    off = half_beat_later(BEATS)
    assert off == pytest.approx(np.arange(0.0, 16.5, 0.5))
    score = rhythm(BEATS, off, 16.0)
    assert score.motion_to_music < 1e-5
    assert score.hits == 0.0
    assert score.distance == pytest.approx(0.25)


def test_random_times_score_what_the_integral_says() -> None:
    """A uniform distance in [0, P/2]: mean of exp(-d²/2σ²) is σ √(2π) erf(P/(2√2 σ)) / P."""
    rng = np.random.default_rng(0)
    scores = [rhythm(np.sort(rng.uniform(0, 16, 40)), BEATS, 16.0) for _ in range(200)]
    expected = 0.05 * np.sqrt(2 * np.pi) / 0.5  # erf(3.5) = 1
    assert mean_rhythm(scores).motion_to_music == pytest.approx(expected, rel=0.03)
    turned = [rhythm(m, BEATS, 16.0) for m in turned_round(BEATS, 16.0, rng, 400)]
    assert mean_rhythm(turned).motion_to_music == pytest.approx(expected, rel=0.03)
    assert mean_rhythm(turned).distance == pytest.approx(0.125, rel=0.03)


def test_a_motion_without_beats_scores_nothing() -> None:
    score = rhythm(np.zeros(0), BEATS, 16.0)
    assert (score.motion_to_music, score.music_to_motion, score.f, score.hits) == (0, 0, 0, 0)
    assert np.isnan(score.distance)
    mean = mean_rhythm([score, rhythm(BEATS, BEATS, 16.0)])
    assert mean.f == 0.5
    assert mean.distance == 0.0  # over those that have one
    assert len(COLUMNS) == 5


def test_turning_keeps_number_and_order() -> None:
    for moved in turned_round(BEATS, 16.0, np.random.default_rng(1), 5):
        assert len(moved) == len(BEATS)
        assert (np.diff(moved) >= 0).all() and moved[0] >= 0 and moved[-1] < 16


times = st.lists(st.integers(0, 400), max_size=25, unique=True).map(
    lambda values: np.sort(np.array(values, dtype=np.float64)) * 0.0437
)


@given(times, times)
def test_hits_are_mir_evals(reference: np.ndarray, estimate: np.ndarray) -> None:
    if not len(reference) or not len(estimate):
        assert hit_f_measure(reference, estimate) == 0.0
        return
    assert hit_f_measure(reference, estimate) == pytest.approx(
        mir_eval.beat.f_measure(reference, estimate)
    )


@given(times, times)
def test_both_directions_are_mir_evals_cemgil(reference: np.ndarray, estimate: np.ndarray) -> None:
    """Cemgil's accuracy is the sum of music→motion over the mean number of beats."""
    score = rhythm(estimate, reference, 20.0)
    if not len(reference) or not len(estimate):
        assert score.music_to_motion == 0.0
        return
    both = len(reference) + len(estimate)
    there, _ = mir_eval.beat.cemgil(reference, estimate, cemgil_sigma=0.05)
    back, _ = mir_eval.beat.cemgil(estimate, reference, cemgil_sigma=0.05)
    assert score.music_to_motion * len(reference) * 2 / both == pytest.approx(there)
    assert score.motion_to_music * len(estimate) * 2 / both == pytest.approx(back)


@given(times, times, st.floats(0, 30))
def test_the_scores_know_no_origin_of_time(
    motion: np.ndarray, music: np.ndarray, later: float
) -> None:
    plain, moved = rhythm(motion, music, 40.0), rhythm(motion + later, music + later, 80.0)
    back = rhythm(40.0 - motion[::-1], 40.0 - music[::-1], 80.0)
    for other in (moved, back):
        assert other.f == pytest.approx(plain.f, abs=1e-6)
        assert other.motion_to_music == pytest.approx(plain.motion_to_music, abs=1e-6)
    swapped = rhythm(music, motion, 40.0)
    assert swapped.f == pytest.approx(plain.f) and swapped.hits == pytest.approx(plain.hits)


# ---------------------------------------------------------------- from a path to a score


def stepping(offset: float, fps: float = 30.0, *, beats: np.ndarray = BEATS) -> np.ndarray:
    """A pelvis path [T,3] that stops `offset` seconds after every beat, and nowhere else."""
    at = (np.arange(round(16 * fps)) + 0.5) / fps  # speeds lie between frames
    pulse = 1 - np.exp(-(((at[:, None] - beats - offset) / 0.08) ** 2)).sum(1)
    path = np.zeros((len(at) + 1, 3))
    path[1:, 2] = np.cumsum(0.8 * pulse) / fps
    path[:, 1] = 0.9
    return path


@pytest.mark.parametrize("fps", [30.0, 60.0])
@pytest.mark.parametrize("offset", [0.0, 0.05, 0.1, 0.25])
def test_a_path_that_stops_late_scores_its_lateness(offset: float, fps: float) -> None:
    """On the beat: 1. 50 ms late: exp(-1/2). Half a beat late: 0. Seconds, whatever the frames."""
    heard = motion_beats(stepping(offset, fps), fps).times
    score = rhythm(heard, BEATS, 16.0)
    expected = np.exp(-(offset**2) / (2 * 0.05**2))
    assert score.motion_to_music == pytest.approx(expected, abs=0.06)
    assert score.music_to_motion == pytest.approx(expected, abs=0.1)
    assert score.distance == pytest.approx(offset, abs=0.01)
    assert score.hits > 0.95 if offset <= 0.06 else score.hits < 0.1


def test_a_frozen_pose_and_a_glide_score_nothing() -> None:
    still = np.tile([[0.0, 0.9, 0.0]], (480, 1))
    glide = still + np.arange(480)[:, None] / 30 * [0, 0, 1.0]
    for path in (still, glide):
        assert rhythm(motion_beats(path).times, BEATS, 16.0).f == 0.0


def test_nan_is_named_and_one_beat_has_no_off_beat() -> None:
    with pytest.raises(ValueError, match="NaN"):
        rhythm(np.array([1.0, np.nan]), BEATS, 16.0)
    with pytest.raises(ValueError, match="NaN"):
        rhythm(BEATS, np.array([np.inf]), 16.0)
    assert len(half_beat_later(BEATS[:1])) == len(half_beat_later(np.zeros(0))) == 0


def test_against_chance_a_dance_on_the_beat_beats_the_off_beat() -> None:
    own, chance, off = against_chance(BEATS, BEATS, 16.0, np.random.default_rng(0))
    assert own.f == pytest.approx(1) and off.f < 0.01
    assert off.f < chance.f < 0.5
