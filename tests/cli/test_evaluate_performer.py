"""Arguments of `evaluate-performer`: wrong ones are found early, right ones reach the harness."""

from pathlib import Path
from typing import Any

import pytest
from typer.testing import CliRunner

from src.cli.tools import app
from src.shared.evaluation.suites import dance
from src.shared.evaluation.tables import report_data


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
    monkeypatch.setattr(dance, "evaluate_performer", lambda *a, **k: pytest.fail("it began"))
    result = CliRunner().invoke(app, ["evaluate-performer", *arguments])
    assert result.exit_code == 2 and message in result.output


def test_right_ones_reach_the_harness(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    asked: list[Any] = []

    def run(*arguments: Any, about: dict[str, Any], folder: Path) -> dict[str, Any]:
        asked.extend((*arguments, about))
        return report_data("performer", {"model": about["model"]}, {}, [], [])

    monkeypatch.setattr(dance, "evaluate_performer", run)
    flags = ["--quick", "--edits", "0", "--steps", "5", "--seed", "3", "--out", str(tmp_path)]
    result = CliRunner().invoke(app, ["evaluate-performer", *flags])
    assert result.exit_code == 0 and "Evaluation of starter" in result.output
    context, editing, models = asked
    assert models["model"] == "starter" and models["other"] is None and context.other is None
    settings = context.settings
    assert (settings.num_songs, settings.replications, settings.seed) == (4, 1, 3)
    assert settings.edits == 0 and editing is None and context.sampling.steps == 5
