"""`evaluate-space` from the command line: files, JSON, and what it refuses."""

import json
from pathlib import Path

import pytest
from typer.testing import CliRunner

from src.cli.tools import app
from tests.shared.evaluation.space_samples import tiny_space, write_space_phrases

QUICK = ["--bars", "1", "--batch", "8", "--replications", "2", "--text", "none"]


@pytest.fixture(scope="module")
def made(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("space")
    write_space_phrases(folder / "pairs", songs=16)
    tiny_space().save_pretrained(folder / "model")
    return folder


def run(made: Path, *more: str) -> tuple[int, str, str]:
    arguments = ["evaluate-space", "--data", str(made / "pairs"), "--model", str(made / "model")]
    result = CliRunner().invoke(app, [*arguments, "--out", str(made / "out"), *more])
    return result.exit_code, result.stdout, result.stderr


def test_tables_and_json_say_the_same(made: Path) -> None:
    code, text, _ = run(made, *QUICK)
    assert code == 0
    assert "## sound → motion" in text and "| chance |" in text
    assert (made / "out" / "space.md").read_text(encoding="utf-8").strip() == text.strip()
    code, text, _ = run(made, *QUICK, "--json")
    assert code == 0
    assert json.loads(text) == json.loads((made / "out" / "space.json").read_text("utf-8"))


@pytest.mark.parametrize(
    ("more", "word"),
    [
        (["--split", "train"], "choose from test, val"),
        (["--batch", "1"], "choose from 2"),
        (["--data", "nowhere"], "no folder"),
        (["--text", "starter"], "were not trained together"),
    ],
)
def test_mistakes_are_one_line(made: Path, more: list[str], word: str) -> None:
    code, _, complaint = run(made, *QUICK, *more)
    assert code in (1, 2) and word in complaint and "Traceback" not in complaint
