"""`evaluate-sanity` and `evaluate-audio` from the command to the files."""

import json
from pathlib import Path

import pytest
from typer.testing import CliRunner

from src.cli.tools import app
from tests.shared.evaluation.tiny_pairs import tiny_model, write_pairs


@pytest.fixture(scope="module")
def model(tmp_path_factory: pytest.TempPathFactory) -> str:
    folder = tmp_path_factory.mktemp("model")
    tiny_model().save_pretrained(folder)
    return str(folder)


@pytest.fixture(scope="module")
def pairs(tmp_path_factory: pytest.TempPathFactory) -> str:
    return str(write_pairs(tmp_path_factory.mktemp("pairs")))


def test_sanity_writes_its_files(model: str, pairs: str, tmp_path: Path) -> None:
    command = ["evaluate-sanity", "--model", model, "--data", pairs, "--decoder-checkpoint", model]
    amount = ["--num-samples", "2", "--num-frames", "32", "--num-steps", "1", "--device", "cpu"]
    result = CliRunner().invoke(app, [*command, *amount, "--output-dir", str(tmp_path)])
    assert result.exit_code == 0, result.output
    assert "## verdict" in result.stdout and "| real |" in result.stdout
    names = {path.name for path in tmp_path.iterdir()}
    assert names == {"sanity.json", "sanity.md", "bands.png", "trajectory.png"}
    report = json.loads((tmp_path / "sanity.json").read_text())
    assert report["about"]["decoder"] == model and report["about"]["model_hash"]


def test_audio_writes_its_files_and_goes_on_where_it_stopped(model: str, tmp_path: Path) -> None:
    command = ["evaluate-audio", "--model", model, "--num-songs", "2", "--song-seconds", "8"]
    rest = ["--steps", "1", "--device", "cpu", "--json", "--out", str(tmp_path)]
    result = CliRunner().invoke(app, [*command, *rest, "--replications", "1"])
    assert result.exit_code == 0, result.output
    report = json.loads(result.stdout)
    assert report["settings"]["num_songs"] == 2 and report["branch"] == "audio"
    rows = [row["name"] for row in report["tables"][0]["rows"]]
    assert rows == ["chance", "frozen pose", "generated", "untrained"]
    names = {path.name for path in tmp_path.iterdir()}
    assert {"report.json", "report.md", "report.html", "manifest.json", "timing.json"} < names
    assert {"phase-01.png", "phase-02.png", "parts", "samples"} < names
    assert "# Evaluation of" in (tmp_path / "report.md").read_text()
    pages = [(tmp_path / name).read_bytes() for name in ("report.md", "report.html")]
    (tmp_path / "report.html").unlink()
    again = CliRunner().invoke(app, ["report", str(tmp_path)])
    assert again.exit_code == 0 and "| untrained |" in again.stdout
    assert pages == [(tmp_path / name).read_bytes() for name in ("report.md", "report.html")]
    other = CliRunner().invoke(app, [*command, *rest, "--seed", "1"])
    assert other.exit_code == 2 and "another settings.seed" in other.output


def test_a_report_is_compared_with_itself(model: str, tmp_path: Path) -> None:
    amount = ["--num-songs", "2", "--replications", "1", "--steps", "1", "--device", "cpu"]
    command = ["compare", model, model, *amount, "--out", str(tmp_path), "--json"]
    result = CliRunner().invoke(app, command)
    assert result.exit_code == 0, result.output
    tables = json.loads(result.stdout)["tables"]
    alignment = next(table for table in tables if table["name"] == "songs/beat alignment")
    assert all(row["cells"]["difference"]["value"] == 0 for row in alignment["rows"])
    assert (tmp_path / "report.html").is_file()
    folder = next(path for path in tmp_path.iterdir() if path.name.startswith("a-"))
    command = ["compare", str(folder), str(folder), "--other-row", "nobody", "--out", str(tmp_path)]
    result = CliRunner().invoke(app, command)
    assert result.exit_code == 1 and "no row 'nobody'" in result.output
