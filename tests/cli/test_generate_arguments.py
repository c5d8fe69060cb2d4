"""`generate` refuses wrong usage with exit code 2, before any model is loaded."""

import string
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st
from typer.testing import CliRunner

from src.cli import generate as command
from src.cli import generate_files
from src.cli.generate_request import read_prompts
from src.cli.tools import app
from src.shared.errors import UsageError
from src.shared.formats.registry import EXPORTERS

runner = CliRunner()
WAVE = ["generate", "--prompt", "a person waves"]


@pytest.mark.parametrize(
    ("arguments", "named"),
    [
        (["generate"], "--prompt"),
        (["generate", "--prompt", "  "], "--prompt"),
        ([*WAVE, "--format", "bvh,dae"], "'dae'"),
        ([*WAVE, "--format", ","], "--format"),
        ([*WAVE, "--prompts", "prompts.csv"], "--prompt does not go with --prompts"),
        (["generate", "--prompts", "a.txt", "--loop"], "--prompts does not go with --loop"),
        ([*WAVE, "--seconds", "0"], "--seconds 0"),
        ([*WAVE, "--seconds", "nan"], "--seconds nan"),
        ([*WAVE, "--num-samples", "0"], "--num-samples 0"),
        ([*WAVE, "--steps", "0"], "--steps 0"),
        ([*WAVE, "--guidance-scale", "-1"], "--guidance-scale -1"),
        ([*WAVE, "--tag", "walk", "--tag", "run"], "--tag"),
        ([*WAVE, "--out", "pyproject.toml/x"], "is a file"),
        ([*WAVE, "--colour", "red"], "--colour"),
        (["prepare", "--out", "somewhere"], "SOURCE"),
        (["prepare", "x", "--out", "y", "--workers", "0"], "--workers"),
        (["shape-check", "--network-profile", "defualt"], "'default'"),
        (["shape-check", "generation.num-head=2"], "generation.num-heads"),
        (["shape-check", "embed-dim=130"], "embed-dim 130"),
        (["shape-check", "--full", "generation.motion-channels=5"], "motion-channels is 5"),
        (["shape-check", "--device", "tpu"], "'tpu'"),
    ],
)
def test_wrong_usage_is_one_line_and_exit_code_2(arguments: list[str], named: str) -> None:
    result = runner.invoke(app, arguments)
    assert result.exit_code == 2
    assert named in result.stderr
    assert result.stdout == ""
    assert "Traceback" not in result.stderr
    if result.stderr.startswith("error:"):
        assert len(result.stderr.splitlines()) == 1


@pytest.mark.parametrize(
    ("name", "text", "named"),
    [
        ("p.txt", "\n  \n", "holds no prompt"),
        ("p.csv", "prompt,second\na,1\n", "columns are prompt, second"),
        ("p.csv", "prompt,seconds\na,1\nb,long\n", "line 3: 'long' is no number"),
        ("p.csv", "prompt,seconds\na,1000\n", "line 2: '1000' is no number"),
        ("p.csv", "prompt,seconds\n,2\n", "line 2: has no prompt"),
        ("p.csv", "prompt,seconds\na,2,walk\n", "line 2: has too many cells"),
        ("p.csv", "prompt,prompt\na,b\n", "columns are prompt, prompt"),
        ("p.csv", 'prompt,seconds\n"x,3\ny,4\n', "unexpected end of data"),
        ("p.csv", f"prompt\n{'a' * 140_000}\n", "field larger than field limit"),
    ],
)
def test_a_faulty_file_of_prompts_names_its_line(
    tmp_path: Path, name: str, text: str, named: str
) -> None:
    (tmp_path / name).write_text(text, encoding="utf-8")
    result = runner.invoke(app, ["generate", "--prompts", str(tmp_path / name)])
    assert result.exit_code == 1 and named in result.stderr
    assert len(result.stderr.splitlines()) == 1


def test_prompts_of_a_file(tmp_path: Path) -> None:
    (tmp_path / "a.txt").write_text("a person  waves\n\nsaluda\n", encoding="utf-8")
    assert read_prompts(tmp_path / "a.txt") == (
        ["a person waves", "saluda"],
        [None] * 2,
        [None] * 2,
    )
    rows = 'tag,prompt,seconds\nwave,"waves, then bows",2.5\n,jumps,\n'
    (tmp_path / "b.csv").write_text(rows, encoding="utf-8")
    texts = ["waves, then bows", "jumps"]
    assert read_prompts(tmp_path / "b.csv") == (texts, [2.5, None], ["wave", None])
    rows = "tag;prompt;seconds\nwave;waves, then bows;2.5\n;jumps;\n"
    (tmp_path / "c.csv").write_text(rows, encoding="utf-8")
    assert read_prompts(tmp_path / "c.csv") == (texts, [2.5, None], ["wave", None])


def test_unknown_format_is_told_before_the_model_loads() -> None:
    assert runner.invoke(app, [*WAVE, "--format", "dae", "--model", "none"]).exit_code == 2


def test_formats_are_taken_once_each_in_the_order_given() -> None:
    assert generate_files.checked_formats(" GLB,bvh,glb ", EXPORTERS) == ["glb", "bvh"]


def test_one_tag_serves_all_prompts() -> None:
    assert command.checked_tags(["walk"], 3) == ["walk"] * 3
    assert command.checked_tags(None, 3) is None
    with pytest.raises(UsageError, match="3 prompts"):
        command.checked_tags(["walk", "run"], 3)


@given(st.text())
def test_slug_is_a_safe_file_name(text: str) -> None:
    name = generate_files.slug(text)
    assert 0 < len(name) <= 40 and len(name.encode()) <= 80
    assert not set(name) & set(string.punctuation.replace("-", "") + string.whitespace)
    assert not name.startswith("-") and not name.endswith("-")


def test_letters_that_file_systems_take_apart_stay_whole() -> None:
    assert generate_files.slug("Café Müller") == generate_files.slug("Cafe\u0301 Mu\u0308ller")


def test_file_names_tell_prompts_and_samples_apart() -> None:
    prompts = ["A person waves!"] * 2 + ["人が手を振る"] * 2
    assert generate_files.stems(prompts, 2) == [
        "01-a-person-waves",
        "01-a-person-waves-2",
        "02-人が手を振る",
        "02-人が手を振る-2",
    ]


def test_interrupt_ends_with_130_and_one_line(monkeypatch: pytest.MonkeyPatch) -> None:
    def interrupted(_: object) -> None:
        raise KeyboardInterrupt

    monkeypatch.setattr(command, "prompted", interrupted)
    result = runner.invoke(app, WAVE)
    assert result.exit_code == 130
    assert result.stderr.startswith("interrupted") and len(result.stderr.splitlines()) == 1
