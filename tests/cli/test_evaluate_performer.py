"""Arguments of `evaluate-performer`: wrong ones are found early, right ones reach the harness."""

from pathlib import Path
from typing import Any

import pytest
from typer.testing import CliRunner

from src.cli import evaluate_suites
from src.cli.tools import app
from src.shared.evaluation.report.tables import report_data
from src.shared.evaluation.suites.dance import DanceSettings


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (["--clips", "nowhere"], "nowhere is not prepared data"),
        (["--data", "nowhere"], "--data nowhere"),
        (["--songs", "nowhere"], "--songs nowhere is no folder"),
        (["--num-songs", "1"], "--num-songs 1"),
        (["--edits", "-1"], "--edits -1"),
        (["--replications", "0"], "--replications 0 is out of range"),
        (["--out", "/proc/none/r"], "--out /proc/none/r: cannot write there"),
    ],
)
def test_wrong_ones_are_usage_errors(
    arguments: list[str], message: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(evaluate_suites, "run_performer", lambda *a, **k: pytest.fail("it began"))
    result = CliRunner().invoke(app, ["evaluate-performer", *arguments])
    assert result.exit_code == 2 and message in result.output


def test_right_ones_reach_the_harness(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    asked: list[Any] = []

    def run(*arguments: Any) -> dict[str, Any]:
        asked.extend(arguments)
        return report_data("performer", {"model": "starter"}, {}, [], [])

    monkeypatch.setattr(evaluate_suites, "run_performer", run)
    flags = ["--quick", "--edits", "0", "--steps", "5", "--seed", "3", "--out", str(tmp_path)]
    result = CliRunner().invoke(app, ["evaluate-performer", *flags])
    assert result.exit_code == 0 and "Evaluation of starter" in result.output
    models, amount, sampling = asked[:3]
    assert models["model"] == "starter" and models["other"] is None
    settings = DanceSettings(**amount)
    assert (settings.num_songs, settings.replications, settings.seed) == (4, 1, 3)
    assert settings.edits == 0 and sampling["steps"] == 5
