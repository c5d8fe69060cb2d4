"""Cutting at bars: every phrase starts on a downbeat, none is lost that is long enough."""

from itertools import pairwise

import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from src.shared.memory.build import cut_at_bars


def test_phrases_of_two_bars_start_on_downbeats() -> None:
    bars = np.arange(400) / 60 + 0.5  # downbeats at frames 30, 90, 150, ...
    assert cut_at_bars(bars, bars=2) == [(0, 30), (30, 150), (150, 270), (270, 390)]


def test_a_short_head_and_tail_are_left_out() -> None:
    bars = np.arange(160) / 60 + 0.75
    assert cut_at_bars(bars, bars=2, min_frames=30) == [(15, 135)]


def test_the_last_phrase_may_be_a_bar_short() -> None:
    assert cut_at_bars(np.arange(180) / 60, bars=2) == [(0, 120), (120, 180)]


def test_a_step_of_one_bar_overlaps() -> None:
    bars = np.arange(241) / 60
    cuts = cut_at_bars(bars, bars=2, step=1)
    assert cuts == [(0, 120), (60, 180), (120, 240), (180, 241)]


def test_a_piece_within_one_bar_is_whole() -> None:
    assert cut_at_bars(np.linspace(0.1, 0.9, 50)) == [(0, 50)]
    assert cut_at_bars(np.linspace(0.1, 0.9, 10)) == []
    assert cut_at_bars(np.zeros(50)) == [(0, 50)], "a song without beats"


@given(
    tempo=st.floats(0.2, 3.0),
    start=st.floats(-5, 5),
    frames=st.integers(1, 900),
    length=st.integers(1, 4),
)
def test_phrases_do_not_overlap_and_cover_all_but_short_ends(
    tempo: float, start: float, frames: int, length: int
) -> None:
    bars = start + np.arange(frames) / 30 * tempo
    cuts = cut_at_bars(bars, bars=length, min_frames=8)
    assert all(stop - first >= 8 for first, stop in cuts)
    assert all(a[1] <= b[0] for a, b in pairwise(cuts))
    covered = sum(stop - first for first, stop in cuts)
    if tempo * 8 / 30 < 1 / 2:  # bars of more than eight frames
        assert frames - covered < 16
    for first, _ in cuts[1:]:
        assert abs(bars[first] - round(bars[first])) <= tempo / 30 / 2 + 1e-9
