"""Arguments of `evaluate`: wrong ones are found early, right ones reach the harness."""

from pathlib import Path
from typing import Any

import pytest
from typer.testing import CliRunner

from src.cli.evaluate import Request
from src.cli.tools import app
from src.shared.errors import UserError
from src.shared.evaluation.suites import text as harness
from src.shared.evaluation.suites.text import TextSettings
from src.shared.evaluation.tables import report_data
from src.shared.model.clip.tokenizer import PromptTokenizer
from src.shared.model.evaluator import Evaluator


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (["--data", "nowhere"], "--data nowhere is not prepared data"),
        (["--out", "/proc/none/r"], "--out /proc/none/r: cannot write there"),
        (["--out", "report.md"], "name a folder"),
        (["--replications", "0"], "--replications 0 is out of range"),
        (["--num-songs", "5"], "--num-songs is not for starter, which makes motion from text"),
        (["--model", "starter-audio", "--num-samples", "5"], "which makes motion from music"),
    ],
)
def test_wrong_ones_are_usage_errors(
    arguments: list[str], message: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(harness, "evaluate_text", lambda *a, **k: pytest.fail("it began"))
    result = CliRunner().invoke(app, ["evaluate", "--quick", *arguments])
    assert result.exit_code == 2 and message in result.output


def test_right_ones_reach_the_harness(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    calls: list[Any] = []

    def evaluate_text(*names: str, **given: Any) -> dict[str, Any]:
        calls.append((names, given))
        return report_data("text", {"held_out": "yes"}, {}, [], [])

    monkeypatch.setattr(harness, "evaluate_text", evaluate_text)
    command = ["evaluate", "--quick", "--steps", "3", "--num-samples", "5", "--json"]
    result = CliRunner().invoke(app, [*command, "--out", str(tmp_path / "report")])
    assert result.exit_code == 0 and '"held_out": "yes"' in result.stdout
    ((names, given),) = calls
    assert names == ("starter", "synthetic") and given["steps"] == 3
    assert given["settings"] == TextSettings(num_samples=5, replications=3)
    assert given["evaluator"] == "evaluator" and given["folder"] == tmp_path / "report"
    names_of_files = {path.name for path in given["folder"].iterdir()}
    assert names_of_files == {"report.json", "report.md", "report.html"}


def test_without_quick_there_are_twenty_replications() -> None:
    assert TextSettings(**Request().amount("num_samples")).replications == 20
    assert Request(quick=True, replications=7).amount()["replications"] == 7


def test_a_missing_evaluator_or_tokenizer_is_named(tmp_path: Path) -> None:
    with pytest.raises(UserError, match=r"no evaluator 'nope'; there are: evaluator.*train"):
        Evaluator.from_pretrained("nope")
    (tmp_path / "config.json").write_text("{}")
    with pytest.raises(UserError, match=r"tokenizer is missing; copy the model folder again"):
        PromptTokenizer.from_pretrained(tmp_path / "tokenizer")
