"""Arguments of `prepare` that do not fit together."""

from pathlib import Path

import pytest
from typer.testing import CliRunner

from src.cli.tools import app


@pytest.mark.parametrize("flag", ["--captions", "--mapping", "--labels"])
def test_a_table_without_source_is_refused(flag: str, tmp_path: Path) -> None:
    command = ["prepare", "--synthetic", "2", flag, "x.csv", "--out", str(tmp_path / "out")]
    result = CliRunner().invoke(app, command)
    assert result.exit_code == 2 and f"{flag} without SOURCE" in result.output


def test_what_is_read_is_not_written_into(tmp_path: Path) -> None:
    (tmp_path / "walk.bvh").write_text("HIERARCHY")
    result = CliRunner().invoke(app, ["prepare", str(tmp_path), "--out", f"{tmp_path}/."])
    assert result.exit_code == 2 and "is a SOURCE" in result.stderr
    assert [path.name for path in tmp_path.iterdir()] == ["walk.bvh"]
