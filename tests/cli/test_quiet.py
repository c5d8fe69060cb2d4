"""Options of the whole program: --quiet, --version and -h."""

from importlib.metadata import version
from pathlib import Path

import pytest
from typer.testing import CliRunner

from src.cli import console
from src.cli.console import is_quiet, tell
from src.cli.tools import app
from tests.shared.model.conftest import tiny_generator

runner = CliRunner()


def test_quiet_leaves_results_and_warnings(tmp_path: Path) -> None:
    tiny_generator().save_pretrained(tmp_path / "model")
    arguments = ["generate", "--prompt", "quantum chromodynamics", "--seconds", "0.5",
                 "--model", str(tmp_path / "model"), "--out", str(tmp_path / "out"),
                 "--format", "npz", "--num-samples", "2"]  # fmt: skip
    loud, quiet = runner.invoke(app, arguments), runner.invoke(app, [*arguments, "--quiet"])
    assert loud.exit_code == quiet.exit_code == 0
    assert quiet.stdout == loud.stdout
    assert "scores of 2" in loud.stderr and "1 motion in" in loud.stderr
    assert len(quiet.stderr.splitlines()) == 1 and quiet.stderr.startswith("warning: ")


def test_quiet_lasts_one_command() -> None:
    runner.invoke(app, ["models", "-q"])
    assert is_quiet()
    runner.invoke(app, ["models"])
    assert not is_quiet()


def test_the_version_is_the_package_s() -> None:
    assert runner.invoke(app, ["--version"]).stdout == f"motion-tools {version('motionsuite')}\n"


def test_h_is_help_everywhere() -> None:
    for command in ([], ["generate"], ["memory", "build"], ["train"], ["train", "clip"]):
        told = runner.invoke(app, [*command, "-h"])
        assert told.exit_code == 0 and told.stdout.startswith("Usage: "), command


def test_without_a_screen_progress_is_a_line_now_and_then(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setattr(console, "_quiet", False)
    monkeypatch.setattr(console, "LINE_SECONDS", 0.0)
    with console.progress_bar("motions") as done:
        done(64, 300)
        done(128, 300)
        done(300, 300)
    told = capsys.readouterr().err.splitlines()
    assert len(told) == 2, "nothing is left to wait for after the last one"
    assert told[0] == "64 of 300 motions", "models were loaded until then"
    assert told[1].startswith("128 of 300 motions, about ") and told[1].endswith(" s left")
    monkeypatch.setattr(console, "_quiet", True)
    with console.progress_bar("motions") as done:
        done(64, 300)
    tell("finished")
    assert capsys.readouterr().err == ""
