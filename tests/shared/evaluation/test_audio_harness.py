"""`evaluate-audio` end to end on a tiny network."""

import json
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from src.shared.audio.synthetic_songs import SongSpec, render_song
from src.shared.evaluation.audio_harness import (
    AudioEvaluation,
    AudioSettings,
    evaluate_audio,
)
from src.shared.evaluation.audio_plots import plot_phase
from src.shared.evaluation.audio_report import audio_tables
from src.shared.evaluation.report import as_markdown, heading
from src.shared.inference.song_generator import SongGenerator
from src.shared.model.audio.conditioning import BEAT
from src.shared.motion.trajectory import PHASE, MotionTrajectory
from tests.shared.evaluation.tiny_pairs import nod, tiny_model, write_pairs

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


# ---------------------------------------------------------------- a dancer who hears


class Nodder(SongGenerator):
    """Slows down on every beat that it hears; counts at 120 BPM where it is not told."""

    def generate(self, audio_features: Any, **options: Any) -> list[MotionTrajectory]:
        frames, bars = audio_features.shape[1], options["phase"]
        cosine, sine = audio_features[BEAT][:2].double().numpy()
        beats = np.unwrap(np.arctan2(sine, cosine)) / (2 * np.pi)  # zeros where none is heard
        made = nod(
            np.concatenate((beats, beats[-1] + (beats[-1] - beats[-2]) * np.array([1, 2]))) / 4
        )
        made.data[:, PHASE] = (np.arange(frames) / 60 if bars is None else bars) % 1.0
        return [made]


def test_who_hears_the_beat_stands_out() -> None:
    settings = AudioSettings(num_songs=6, song_seconds=9.0, own_count=2)
    report = evaluate_audio(Nodder(tiny_model(), device="cpu"), settings=settings).report
    phase = report["phase"]
    for name, cell in phase["beat tracker"].items():  # its phase is the tracker's
        assert phase["generated"][name]["value"] == pytest.approx(cell["value"], abs=1e-6)
    assert phase["own count"]["beat"]["value"] > 0.15
    assert phase["beat tracker, right tempo"]["beat"]["value"] < 0.1
    above = report["alignment"]["generated"]["above"]
    for name in ("chance", "another song", "half a beat later"):
        assert above[name]["motion_to_music"]["low"] > 0.1
    assert report["seams"]["jumps"]["none"]
