"""Two starts into one folder: the second is refused, in one line, before it writes."""

from pathlib import Path

from typer.testing import CliRunner

from src.cli.tools import app
from tests.shared.holder import held

COMMANDS = (
    "prepare --synthetic 1",
    "prepare-audio --motion synthetic --music synthetic:1",
    "memory build no-such-data",
    "evaluate --quick",
    "evaluate-performer --quick",
)


def test_the_second_start_is_refused(tmp_path: Path) -> None:
    with held(tmp_path):
        for command in COMMANDS:
            result = CliRunner().invoke(app, [*command.split(), "--out", str(tmp_path)])
            assert result.exit_code == 1, command
            assert result.stderr.splitlines()[-1] == (
                f"error: another process is writing {tmp_path}; wait until it has finished, or"
                " name another folder"
            )
            assert [path.name for path in tmp_path.iterdir()] == [".lock"], command
