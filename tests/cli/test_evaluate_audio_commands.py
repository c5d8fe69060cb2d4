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


def test_audio_writes_its_files(model: str, tmp_path: Path) -> None:
    command = ["evaluate-audio", "--model", model, "--num-songs", "2", "--song-seconds", "8"]
    rest = ["--steps", "1", "--device", "cpu", "--json", "--out", str(tmp_path)]
    result = CliRunner().invoke(app, [*command, *rest])
    assert result.exit_code == 0, result.output
    report = json.loads(result.stdout)
    assert report["settings"]["num_songs"] == 2 and "real" not in report["alignment"]
    names = {path.name for path in tmp_path.iterdir()}
    assert names == {"audio.json", "audio.md", "phase-01.png", "phase-02.png"}
    assert "# Audio evaluation" in (tmp_path / "audio.md").read_text()
