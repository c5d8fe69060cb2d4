"""`studio` writes one page and opens it."""

import json
import webbrowser
from pathlib import Path

import pytest
from typer.testing import CliRunner

from src.cli.tools import app


def test_the_page_is_written_and_opened(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    opened: list[str] = []

    def browse(address: str) -> bool:
        opened.append(address)
        return True

    monkeypatch.setattr(webbrowser, "open", browse)
    page = tmp_path / "a page.html"
    result = CliRunner().invoke(app, ["studio", "--out", str(page)])
    assert result.exit_code == 0 and result.stdout.strip() == str(page)
    assert opened == [page.as_uri()]
    result = CliRunner().invoke(
        app, ["studio", "--out", str(tmp_path / "site"), "--no-open", "--json"]
    )
    told = json.loads(result.stdout)
    assert Path(told["file"]) == tmp_path / "site" / "index.html"
    assert told["bytes"] == page.stat().st_size and len(opened) == 1


def test_other_models_are_refused_with_a_way_on(tmp_path: Path) -> None:
    for model, code in (("starter-audio", 1), ("nothing", 2)):
        result = CliRunner().invoke(
            app, ["studio", "--model", model, "--out", str(tmp_path / "a.html")]
        )
        assert result.exit_code == code and result.stderr.startswith("error: ")
    assert not list(tmp_path.iterdir())
