"""The zoo: names, listing without torch."""

import subprocess
import sys

import pytest

from src.shared.errors import UserError
from src.shared.model import checkpoint
from src.shared.model.checkpoint import CARD_FILE


@pytest.fixture
def shipped(generator, tmp_path, monkeypatch):
    """A zoo with one shipped model, `tiny`, and one under runs/."""
    monkeypatch.setattr(checkpoint, "PRETRAINED", tmp_path / "pretrained")
    monkeypatch.setattr(checkpoint, "RUNS", tmp_path / "runs")
    generator.save_pretrained(tmp_path / "pretrained" / "tiny", half=True)
    generator.save_pretrained(tmp_path / "runs" / "mine" / "model")
    broken = tmp_path / "runs" / "broken"
    broken.mkdir()
    (broken / CARD_FILE).write_text("{}")
    return tmp_path


def test_listing_tells_what_a_user_needs_and_skips_damaged_cards(shipped):
    rows = checkpoint.list_models()
    assert [row["name"] for row in rows] == ["tiny", str(shipped / "runs" / "mine" / "model")]
    assert rows[0]["kind"] == "motion-generator"
    assert rows[0]["trained"] is True
    assert rows[0]["size"].endswith(" MB")
    assert {"licence", "languages", "description"} <= set(rows[0])


def test_names_and_folders_resolve(shipped):
    assert checkpoint.resolve_model("tiny") == shipped / "pretrained" / "tiny"
    folder = shipped / "runs" / "mine" / "model"
    assert checkpoint.resolve_model(folder) == checkpoint.resolve_model(str(folder)) == folder


@pytest.mark.parametrize(
    ("name", "message"),
    [
        ("tiiny", "did you mean 'tiny'"),
        ("default", "profile 'default' is untrained.*train generation.*--model tiny"),
        ("/nowhere", "no such folder"),
        ("../pretrained/tiny", "no such folder"),
    ],
)
def test_what_is_not_there_says_what_to_do(shipped, name: str, message: str):
    with pytest.raises(UserError, match=message):
        checkpoint.resolve_model(name)


def test_another_kind_is_named_with_its_article_and_what_is_shipped(shipped):
    def said(found: str, wanted: str) -> str:
        return str(checkpoint.wrong_kind(shipped, found, wanted)).removeprefix(f"{shipped} ")

    other = said("audio-motion", "motion-generator")
    assert other == (
        "holds an audio-motion, not a motion-generator;"
        " name another folder, or tiny, which is shipped"
    )
    assert said("motion-clip", "evaluator").endswith("not an evaluator; name another folder")


def test_a_folder_without_a_card(shipped, tmp_path):
    with pytest.raises(UserError, match=r"has no config.json"):
        checkpoint.resolve_model(tmp_path)


def test_listing_imports_no_torch():
    code = "import sys; from src.shared.model.checkpoint import list_models; list_models();"
    code += "sys.exit('torch' in sys.modules or 'transformers' in sys.modules)"
    assert subprocess.run([sys.executable, "-c", code], check=False).returncode == 0
