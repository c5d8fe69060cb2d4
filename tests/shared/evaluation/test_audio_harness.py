"""`evaluate-audio` end to end on a tiny network; phase rows against closed forms."""

import json
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import torch

from src.shared.audio.synthetic_songs import SongSpec, render_song
from src.shared.evaluation.audio_harness import (
    AudioEvaluation,
    AudioSettings,
    evaluate_audio,
    phase_row,
)
from src.shared.evaluation.audio_plots import plot_phase
from src.shared.evaluation.audio_report import audio_tables
from src.shared.evaluation.audio_songs import Piece
from src.shared.evaluation.report import as_markdown, heading
from src.shared.inference.song_generator import SongGenerator
from tests.shared.evaluation.tiny_pairs import tiny_model, write_pairs

SETTINGS = AudioSettings(num_songs=2, song_seconds=9.0, own_count=1, pictures=1)


@pytest.fixture(scope="module")
def folders(tmp_path_factory: pytest.TempPathFactory) -> dict[str, Any]:
    root = tmp_path_factory.mktemp("evaluation")
    (root / "songs").mkdir()
    render_song(SongSpec(seconds=5.0, seed=1)).write_wav(root / "songs" / "song.wav")
    return {"data": str(write_pairs(root / "pairs")), "songs": root / "songs"}


def run(folders: dict[str, Any]) -> AudioEvaluation:
    generator = SongGenerator(tiny_model(), device="cpu")
    return evaluate_audio(generator, settings=SETTINGS, sampling={"steps": 2}, **folders)


@pytest.fixture(scope="module")
def result(folders: dict[str, Any]) -> AudioEvaluation:
    return run(folders)


def test_the_report_says_what_was_measured(result: AudioEvaluation) -> None:
    report = json.loads(json.dumps(result.report))
    assert report["about"]["steps"] == 2 and report["about"]["data_hash"]
    assert report["about"]["test_phrases"] == 4 and len(report["tempi"]) == 2
    assert set(report["alignment"]) == {"generated", "real"}
    assert report["phase"]["generated"]["beat"]["count"] == 2
    assert report["phase"]["own count"]["beat"]["count"] == 1
    assert report["seams"]["seams"] == 2
    assert report["tracks"][0]["name"] == "song"


def test_real_motion_keeps_the_beat_and_the_tracker_beats_chance(result: AudioEvaluation) -> None:
    real = result.report["alignment"]["real"]
    assert real["rows"]["own song"]["motion_to_music"]["value"] > 0.9
    assert real["above"]["half a beat later"]["f"]["apart"]
    phase = result.report["phase"]
    assert phase["beat tracker"]["beat"]["value"] < phase["chance"]["beat"]["value"]


def test_it_is_deterministic(result: AudioEvaluation, folders: dict[str, Any]) -> None:
    again = run(folders).report
    assert {**again, "seconds": 0} == {**result.report, "seconds": 0}


def test_tables_and_pictures(result: AudioEvaluation, tmp_path: Path) -> None:
    tables = list(audio_tables(result.report))
    assert len(tables) == 8
    assert all(len(row) == len(table.header) for table in tables for row in table.rows)
    text = as_markdown("Audio evaluation", heading(result.report), tables)
    assert "| beat tracker |" in text and "seed: 0" in text
    names = [picture.name for picture in result.pictures]
    assert names[1:] == ["song"]
    for number, picture in enumerate(result.pictures):
        assert plot_phase(picture, tmp_path / f"{number}.png").stat().st_size > 5000


# ---------------------------------------------------------------- phase rows


def piece(meter: int = 4) -> Piece:
    bars = np.arange(300) / 30 * 0.5 - 0.3  # 120 BPM in 4/4
    beats = np.arange(0.1, 12, 0.5)
    return Piece("song", torch.zeros(167, 300), bars, meter, bars, 4, beats, {})


@pytest.mark.parametrize("ahead", [0.0, 0.05, -0.1])
def test_a_constant_lead_is_the_error(ahead: float) -> None:
    song = piece()
    assert song.bars is not None
    row = phase_row([(song, song.bars + ahead / 4)] * 3)
    assert row["beat"]["value"] == pytest.approx(abs(ahead), abs=1e-9)
    assert row["bar"]["value"] == pytest.approx(abs(ahead) / 4, abs=1e-9)
    assert row["beat_offset"]["value"] == pytest.approx(ahead, abs=1e-9)
    assert row["beat_seconds"]["value"] == pytest.approx(abs(ahead) * 0.5, abs=1e-9)
    assert row["steady"]["value"] == pytest.approx(1.0)


def test_a_wrong_downbeat_costs_the_bar_alone() -> None:
    song = piece()
    assert song.bars is not None
    row = phase_row([(song, song.bars + 0.5)])
    assert row["beat"]["value"] == pytest.approx(0.0, abs=1e-9)
    assert row["bar"]["value"] == pytest.approx(0.5, abs=1e-9)


def test_a_meter_heard_wrong_still_finds_its_beats() -> None:
    song = piece(meter=3)
    assert song.bars is not None
    row = phase_row([(replace(song, phase=song.bars * 4 / 3), song.bars * 4 / 3)])
    assert row["beat"]["value"] == pytest.approx(0.0, abs=1e-9)
    assert row["bar"]["value"] > 0.1
