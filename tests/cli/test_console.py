"""What the operating system refuses, and text that is none: one line each, whatever the command."""

import os
import subprocess
import sys
from pathlib import Path

import pytest
from typer.testing import CliRunner

from src.cli.console import complain
from src.cli.tools import app, main
from src.shared.formats.writers.bvh import write_bvh
from tests.shared.formats.writers.test_bvh import random_motion

TOOLS = [sys.executable, "-m", "src.cli.tools"]
FULL = Path("/dev/full")  # takes nothing, as a full disk does
LONG = "a" * 300


@pytest.mark.parametrize(
    "command",
    [
        ["generate", "--prompt", "un caf\udce9"],
        ["generate", "--prompt", "a person walks", "--then", "un caf\udce9"],
        ["generate", "--audio", "song.wav", "--style", "un caf\udce9"],
        ["memory", "query", "un caf\udce9", "--memory", "none"],
    ],
)
def test_text_that_is_not_utf_8_is_refused(command: list[str]) -> None:
    result = CliRunner().invoke(app, command)
    assert result.exit_code == 2
    assert result.stderr == (
        "error: 'un caf\\udce9' is not UTF-8 text; set the terminal to UTF-8\n"
    )


@pytest.mark.parametrize(
    "command",
    [
        ["generate", "--prompt", "walk", "--out", LONG],
        ["generate", "--prompt", "walk", "--model", LONG],
        ["generate", "--audio", LONG],
        ["convert", LONG, "out.bvh"],
        ["evaluate", "--model", LONG, "--data", "data", "--out", "report"],
        ["prepare", LONG, "--out", "data"],
        ["plot", LONG],
        ["compare", LONG, "report"],
    ],
)
def test_a_name_that_no_file_can_have(command: list[str]) -> None:
    result = CliRunner().invoke(app, command)
    assert result.exit_code == 2
    assert result.stderr.startswith("error: ") and result.stderr.count("\n") == 1
    assert result.stderr.endswith("its name is too long; shorten it\n")


def test_what_is_told_cannot_harm_a_terminal(capsys: pytest.CaptureFixture[str]) -> None:
    complain("walk\x1b]0;title\x07.bvh is left out\n")
    assert capsys.readouterr().err == "walk\ufffd]0;title\ufffd.bvh is left out\n"


@pytest.mark.skipif(os.name == "nt", reason="names are text there")
def test_a_file_of_any_name_is_read_and_its_path_printed(tmp_path: Path) -> None:
    name = os.fsdecode(b"caf\xe9.bvh")
    write_bvh(random_motion(2), tmp_path / name)
    command = [*TOOLS, "convert", str(tmp_path / name), str(tmp_path), "--format", "npz"]
    strict = os.environ | {"PYTHONIOENCODING": "utf-8:strict"}  # as in most locales
    done = subprocess.run(command, capture_output=True, env=strict)
    assert (done.returncode, done.stderr) == (0, b"")
    assert done.stdout == os.fsencode(tmp_path) + b"/caf\xe9.npz\n"


@pytest.mark.skipif(not FULL.exists(), reason="there is no such device")
@pytest.mark.parametrize("arguments", [["models"], ["models", "--json"], ["convert", "--help"]])
def test_a_full_disk_behind_stdout_is_one_line(arguments: list[str]) -> None:
    with FULL.open("w") as full:
        done = subprocess.run([*TOOLS, *arguments], stdout=full, stderr=subprocess.PIPE, text=True)
    assert done.returncode == 1
    assert done.stderr == ("error: stdout cannot be written: no space left; send it elsewhere\n")


@pytest.mark.skipif(os.name == "nt", reason="pipes end otherwise there")
def test_a_reader_who_has_gone_hears_nothing() -> None:
    reading, writing = os.pipe()
    os.close(reading)
    done = subprocess.run([*TOOLS, "models"], stdout=writing, stderr=subprocess.PIPE, text=True)
    os.close(writing)
    assert (done.returncode, done.stderr) == (1, "")


def test_ctrl_c_before_a_command_is_there_shows_no_traceback(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    def interrupted() -> None:
        raise KeyboardInterrupt

    monkeypatch.setattr("src.cli.tools.app", interrupted)
    with pytest.raises(SystemExit) as ended:
        main()
    assert ended.value.code == 130
