"""`evaluate-audio` end to end on a tiny network."""

import json
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from src.shared.audio.synthetic import SongSpec, render_song
from src.shared.evaluation.pages import save_report
from src.shared.evaluation.suites.audio import AudioContext, AudioSettings, evaluate_audio
from src.shared.evaluation.tables import Grid, grids, markdown, tables
from src.shared.model.audio import BEAT
from src.shared.motion.trajectory import PHASE, MotionTrajectory
from src.shared.pipelines.song import SongGenerator
from tests.shared.evaluation.tiny_pairs import nod, tiny_model, write_pairs

SETTINGS = AudioSettings(
    num_songs=2, song_seconds=9.0, own_count=1, pictures=1, replications=2, untrained=1, worst=2
)


@pytest.fixture(scope="module")
def sources(tmp_path_factory: pytest.TempPathFactory) -> dict[str, Any]:
    root = tmp_path_factory.mktemp("evaluation")
    (root / "songs").mkdir()
    render_song(SongSpec(seconds=5.0, seed=1)).write_wav(root / "songs" / "song.wav")
    return {"data": str(write_pairs(root / "pairs")), "songs": root / "songs"}


def run(sources: dict[str, Any], folder: Path) -> dict[str, Any]:
    generator = SongGenerator(tiny_model(), device="cpu")
    context = AudioContext(generator, SETTINGS, sampling={"steps": 2}, **sources)
    report = evaluate_audio(context, folder=folder)
    save_report(report, folder)
    return report


@pytest.fixture(scope="module")
def folder(sources: dict[str, Any], tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("report")
    run(sources, folder)
    return folder


@pytest.fixture(scope="module")
def report(folder: Path) -> dict[str, Any]:
    return dict(json.loads((folder / "report.json").read_text()))


def named(report: dict[str, Any]) -> dict[str, Grid]:
    return {grid.name: grid for grid in grids(report)}


def cell(grid: Grid, row: str, column: str) -> dict[str, Any]:
    found = grid.rows[row].cells[column]
    assert isinstance(found, dict)
    return found


def test_the_report_says_what_was_measured(report: dict[str, Any]) -> None:
    assert report["about"]["steps"] == 2 and report["about"]["data_hash"]
    assert report["about"]["test_phrases"] == 4
    found = named(report)
    beats = found["songs/beat alignment"]
    assert list(beats.rows) == ["real", "chance", "frozen pose", "generated", "untrained"]
    runs = {name: (row.num, row.replications) for name, row in beats.rows.items()}
    assert runs["real"] == (4, 2) and runs["generated"] == (2, 2)
    assert runs["untrained"] == runs["frozen pose"] == (2, 1)
    assert found["phase"].rows["own count"].num == 1
    assert found["phase"].rows["untrained, own count"].num == 1
    assert {f"alignment/{row}/rows" for row in ("generated", "untrained", "real")} <= set(found)
    assert {"seams", "seams/untrained", "jumps", "jumps/untrained"} <= set(found)
    assert found["seams"].title.startswith("seams (2 seams of 2 songs")
    assert list(found["tracks"].rows) == ["song"]


def test_real_motion_keeps_the_beat_and_the_tracker_beats_chance(report: dict[str, Any]) -> None:
    found = named(report)
    assert found["alignment/real/rows"].value("own song", "motion_to_music") > 0.9
    assert found["songs/beat alignment"].value("real", "f") > 0.9
    above = cell(found["alignment/real/above"], "half a beat later", "f")
    assert above["low"] > 0 and not above["apart"], "two songs prove nothing"
    phase = found["phase"]
    assert phase.value("beat tracker", "beat") < phase.value("chance", "beat")
    assert "*" in markdown(report)


def test_a_second_run_gives_the_same_bytes(
    folder: Path, sources: dict[str, Any], tmp_path: Path
) -> None:
    run(sources, tmp_path)
    files = {path.relative_to(folder) for path in folder.rglob("*") if path.is_file()}
    assert files == {path.relative_to(tmp_path) for path in tmp_path.rglob("*") if path.is_file()}
    for name in files - {Path("timing.json")}:
        assert (folder / name).read_bytes() == (tmp_path / name).read_bytes(), name


def test_tables_and_pictures(report: dict[str, Any], folder: Path) -> None:
    assert all(len(row) == len(table.header) for table in tables(report) for row in table.rows)
    text = (folder / "report.md").read_text()
    assert "| beat tracker |" in text and "seed: 0" in text and "## worst first" in text
    assert [picture["title"].split()[-1] for picture in report["pictures"]][1:] == ["song"]
    for picture in report["pictures"]:
        assert (folder / picture["file"]).stat().st_size > 5000
    page = (folder / "report.html").read_text()
    assert page.count("<iframe") == 2 and page.count("data:image/png") == 2
    assert page.count("data:audio") == 2


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
    settings = AudioSettings(
        num_songs=6, song_seconds=9.0, own_count=2, replications=1, untrained=0
    )
    context = AudioContext(Nodder(tiny_model(), device="cpu"), settings)
    found = named(evaluate_audio(context))
    phase = found["phase"]
    for column in phase.columns:  # its phase is the tracker's
        own, heard = (phase.value(row, column.key) for row in ("generated", "beat tracker"))
        assert own == pytest.approx(heard, abs=1e-6)
    assert phase.value("own count", "beat") > 0.15
    assert phase.value("beat tracker, right tempo", "beat") < 0.1
    above = found["alignment/generated/above"]
    for row in ("chance", "another song", "half a beat later"):
        assert cell(above, row, "motion_to_music")["low"] > 0.1
    beats = found["songs/beat alignment"]
    assert beats.value("generated", "f") > beats.value("chance", "f") + 0.1
    assert beats.value("frozen pose", "f") == 0
    assert found["jumps"].title.endswith("none")
