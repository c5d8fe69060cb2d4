"""The table of candidates on stderr."""

import pytest

from src.cli.generate_files import show_scores


def test_a_prompt_is_no_markup(capsys: pytest.CaptureFixture[str]) -> None:
    candidates = [{"place": 1, "score": 0.5}, {"place": 2, "score": None}]
    show_scores([{"for": "[bold]walk[/x]", "candidates": candidates}])
    told = capsys.readouterr().err
    assert "scores of 2 candidates: [bold]walk[/x]" in " ".join(told.split()) and "0.500" in told
