"""Phase rows against closed forms, and whether the tempo was heard."""

from dataclasses import replace

import numpy as np
import pytest
import torch

from src.shared.evaluation.suites.audio import phase_row, right_tempo
from src.shared.evaluation.suites.songs import Piece


def piece(meter: int = 4) -> Piece:
    bars = np.arange(300) / 30 * 0.5 - 0.3  # 120 BPM in 4/4
    beats = np.arange(0.1, 12, 0.5)
    return Piece("song", torch.zeros(167, 300), bars, meter, bars, 4, beats, {})


@pytest.mark.parametrize("ahead", [0.0, 0.05, -0.1])
def test_a_constant_lead_is_the_error(ahead: float) -> None:
    song = piece()
    assert song.bars is not None
    row = phase_row([(song, song.bars + ahead / 4)] * 3)
    assert row["beat"].value == pytest.approx(abs(ahead), abs=1e-9)
    assert row["bar"].value == pytest.approx(abs(ahead) / 4, abs=1e-9)
    assert row["beat_offset"].value == pytest.approx(ahead, abs=1e-9)
    assert row["beat_seconds"].value == pytest.approx(abs(ahead) * 0.5, abs=1e-9)
    assert row["steady"].value == pytest.approx(1.0)


def test_a_wrong_downbeat_costs_the_bar_alone() -> None:
    song = piece()
    assert song.bars is not None
    row = phase_row([(song, song.bars + 0.5)])
    assert row["beat"].value == pytest.approx(0.0, abs=1e-9)
    assert row["bar"].value == pytest.approx(0.5, abs=1e-9)


def test_a_meter_heard_wrong_still_finds_its_beats() -> None:
    song = piece(meter=3)
    assert song.bars is not None
    row = phase_row([(replace(song, phase=song.bars * 4 / 3), song.bars * 4 / 3)])
    assert row["beat"].value == pytest.approx(0.0, abs=1e-9)
    assert row["bar"].value > 0.1


def test_the_tempo_is_right_within_four_percent() -> None:
    song = piece()
    assert song.bars is not None
    for faster, right in ((1.0, True), (1.03, True), (1.05, False), (2.0, False), (0.5, False)):
        assert right_tempo(replace(song, phase=song.bars * faster)) is right
    assert right_tempo(replace(song, phase=song.bars * 4 / 3, meter=3))  # beats count
    assert not right_tempo(replace(song, phase=None))
