"""`evaluate-selection` from the command to the report."""

import json
from pathlib import Path

import pytest
from typer.testing import CliRunner

from src.cli.tools import app
from tests.shared.evaluation.tiny_pairs import tiny_model

COMMAND = ["evaluate-selection", "--branch", "audio", "--device", "cpu"]
runner = CliRunner()


def test_the_best_songs_are_reported(tmp_path: Path) -> None:
    tiny_model().save_pretrained(tmp_path / "model")
    amount = ["--num-subjects", "2", "--num-candidates", "2", "--steps", "1"]
    command = [*COMMAND, "--model", str(tmp_path / "model"), *amount]
    result = runner.invoke(app, [*command, "--json", "--out", str(tmp_path / "report.md")])
    assert result.exit_code == 0, result.output
    report = json.loads(result.stdout)
    assert list(report["rows"]) == ["chance", "best of 1", "best of 2", "worst of 2"]
    assert report["outside_apart"] == [] and report["settings"]["num_songs"] == 2
    text = (tmp_path / "report.md").read_text(encoding="utf-8")
    assert "figures akin to the judge's" in text and "| best of 2 less best of 1 |" in text


@pytest.mark.parametrize(
    ("wrong", "named"),
    [
        (["--branch", "video"], "--branch video"),
        (["--judge", "clip"], "--judge"),
        (["--num-candidates", "1"], "--num-candidates 1"),
        (["--num-subjects", "1"], "--num-subjects 1"),
        (["--data", "nowhere"], "nowhere"),
    ],
)
def test_wrong_usage_is_refused(wrong: list[str], named: str) -> None:
    result = runner.invoke(app, [*COMMAND, *wrong])
    assert result.exit_code == 2 and named in result.stderr
