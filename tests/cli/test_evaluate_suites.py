"""`evaluate --suite NAME` is the suite's own command under one name."""

import pytest
from typer.main import get_command
from typer.testing import CliRunner

from src.cli.tools import app

SUITES = ("audio", "memory", "performer", "requests", "sanity", "selection", "space")
runner = CliRunner()


def test_every_suite_is_reached_by_name() -> None:
    commands = get_command(app).commands  # type: ignore[attr-defined]
    assert {name for name in commands if name.startswith("evaluate-")} == {
        f"evaluate-{suite}" for suite in SUITES
    }


@pytest.mark.parametrize("suite", SUITES)
def test_a_suite_has_the_flags_of_its_command(suite: str) -> None:
    own = runner.invoke(app, [f"evaluate-{suite}", "--help"])
    named = runner.invoke(app, ["evaluate", f"--suite={suite}", "--help"])
    assert named.exit_code == own.exit_code == 0
    assert named.output.splitlines()[2:] == own.output.splitlines()[2:]


def test_a_suite_refuses_what_its_command_refuses() -> None:
    wrong = ["--num-candidates", "1"]
    own = runner.invoke(app, ["evaluate-selection", *wrong])
    named = runner.invoke(app, ["evaluate", *wrong, "--suite", "selection"])
    assert named.exit_code == own.exit_code == 2 and named.stderr == own.stderr


def test_a_suite_that_is_not_there_is_named() -> None:
    result = runner.invoke(app, ["evaluate", "--suite", "video"])
    assert result.exit_code == 2
    assert "--suite video is unknown" in result.stderr and "requests" in result.stderr


@pytest.mark.parametrize(
    ("arguments", "line"),
    [
        (["evaluate", "--suite", "text", "--model", "starter-audio"], "from text, starter for"),
        (["evaluate-audio", "--model", "starter"], "from music, starter-audio for"),
    ],
)
def test_a_suite_of_the_other_kind_names_a_model_of_its_own(
    arguments: list[str], line: str
) -> None:
    result = runner.invoke(app, arguments)
    assert result.exit_code == 2 and line in result.stderr
