"""Arguments of `evaluate`: wrong ones are found before anything loads, right ones reach `quick`."""

from pathlib import Path
from typing import Any

import pytest
from typer.testing import CliRunner

from src.cli.tools import app
from src.shared.errors import UserError
from src.shared.evaluation import harness
from src.shared.evaluation.evaluator import Evaluator
from src.shared.model.clip.tokenizer import PromptTokenizer


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (["--data", "nowhere"], "--data nowhere is not prepared data"),
        (["--out", "/proc/none/r.json"], "--out /proc/none: cannot write there"),
        (["--out", "."], "is a folder"),
    ],
)
def test_wrong_ones_are_usage_errors(
    arguments: list[str], message: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(harness, "quick", lambda *a, **k: pytest.fail("it began"))
    result = CliRunner().invoke(app, ["evaluate", "--quick", *arguments])
    assert result.exit_code == 2 and message in result.output


def test_right_ones_reach_the_harness(monkeypatch: pytest.MonkeyPatch) -> None:
    calls: list[Any] = []

    def quick(*names: str, **options: Any) -> dict[str, Any]:
        calls.append((names, options))
        return {"about": {"held_out": "yes"}}

    monkeypatch.setattr(harness, "quick", quick)
    command = ["evaluate", "--quick", "--steps", "3", "--num-samples", "5", "--json"]
    result = CliRunner().invoke(app, command)
    assert result.exit_code == 0 and '"held_out": "yes"' in result.output
    ((names, options),) = calls
    assert names == ("starter", "synthetic") and options["steps"] == 3
    assert options["settings"].num_samples == 5 and options["evaluator"] == "evaluator"


def test_a_missing_evaluator_or_tokenizer_is_named(tmp_path: Path) -> None:
    with pytest.raises(UserError, match=r"no evaluator 'nope'; there are: evaluator.*train"):
        Evaluator.from_pretrained("nope")
    (tmp_path / "config.json").write_text("{}")
    with pytest.raises(UserError, match=r"tokenizer is missing; copy the model folder again"):
        PromptTokenizer.from_pretrained(tmp_path / "tokenizer")
