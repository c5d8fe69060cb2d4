"""`--help` answers at once: nothing heavy is imported, and every command shows an example."""

import subprocess
import sys
from pathlib import Path

import pytest

from src.cli.tools import app

HEAVY = {
    "torch",
    "numpy",
    "transformers",
    "huggingface_hub",
    "scipy",
    "librosa",
    "yaml",
    "rich",
}  # typer itself needs pydantic
COMMANDS = [command.name or command.callback.__name__ for command in app.registered_commands]  # type: ignore[union-attr]


def run(*arguments: str) -> subprocess.CompletedProcess[str]:
    return subprocess.run([sys.executable, *arguments], capture_output=True, text=True)


@pytest.mark.parametrize(
    "arguments", [["--help"], ["generate", "--help"], ["prepare", "--help"], ["train", "--help"]]
)
def test_help_imports_nothing_heavy(arguments: list[str]) -> None:
    """The import list instead of a clock: a slow machine does not fail, a heavy import does."""
    result = run("-X", "importtime", "-m", "src.cli.tools", *arguments)
    assert result.returncode == 0
    imported = {line.rpartition("|")[2].strip() for line in result.stderr.splitlines()}
    assert "typer" in imported, "the import list was not read"
    assert not HEAVY & {name.partition(".")[0] for name in imported}


AUDIO = ("generate", "--audio", "SONG")
ASKED = ("memory", "query", "SONG", "--memory", "figures")


@pytest.mark.parametrize("arguments", [AUDIO, ASKED])
def test_an_empty_song_is_refused_before_torch_is_imported(
    arguments: tuple[str, ...], tmp_path: Path
) -> None:
    song = tmp_path / "empty.wav"
    song.touch()
    named = [str(song) if word == "SONG" else word for word in arguments]
    result = run("-X", "importtime", "-m", "src.cli.tools", *named)
    assert result.returncode == 1 and f"error: {song} is empty" in result.stderr
    imported = {line.rpartition("|")[2].strip() for line in result.stderr.splitlines()}
    assert "numpy" in imported and "torch" not in imported


@pytest.mark.parametrize("command", [name.replace("_", "-") for name in COMMANDS])
def test_every_command_shows_an_example(command: str) -> None:
    result = run("-m", "src.cli.tools", command, "--help")
    assert result.returncode == 0
    assert f"motion-tools {command}" in result.stdout
    assert "list[" not in result.stdout, "a user types values, not a Python list"


def test_completion_is_offered_only_by_the_console_script() -> None:
    """`python -m` has no name that a shell could complete."""
    assert "--install-completion" not in run("-m", "src.cli.tools", "--help").stdout
    code = (
        "import sys; sys.argv = ['bin/motion-tools', '--help']; import src.cli.tools as t; t.main()"
    )
    assert "--install-completion" in run("-c", code).stdout
