"""`generate` with directions: files, errors as JSON, and what is refused before a model loads."""

import json
from pathlib import Path

import numpy as np
import pytest
from typer.testing import CliRunner

from src.cli.tools import app
from src.shared.formats.arrays import read_npz
from src.shared.formats.registry import write_motion
from tests.shared.model.conftest import tiny_generator

runner = CliRunner()
WALK = ("--prompt", "a person walks forward")


@pytest.fixture(scope="module")
def model(tmp_path_factory: pytest.TempPathFactory) -> str:
    folder = tmp_path_factory.mktemp("model")
    tiny_generator().save_pretrained(folder)
    return str(folder)


@pytest.fixture(scope="module")
def clip(tmp_path_factory: pytest.TempPathFactory) -> str:
    """Two seconds of motion in a file."""
    (motion,) = tiny_generator().generate(["somebody jumps twice"], seconds=2.0, seed=1)
    return str(write_motion(motion, tmp_path_factory.mktemp("clips") / "clip.npz"))


def generate(model: str, out: Path, *arguments: str) -> dict[str, object]:
    """The row of the one motion."""
    flags = ("--model", model, "--out", str(out), "--format", "npz", "--json", "--device", "cpu")
    result = runner.invoke(app, ["generate", *flags, *arguments])
    assert result.exit_code == 0, result.stderr
    (row,) = json.loads(result.stdout)["motions"]
    assert [str(path) for path in out.iterdir()] == list(row["files"].values())
    return row


def test_then(model: str, tmp_path: Path) -> None:
    row = generate(model, tmp_path, *WALK, "--then", "somebody jumps twice", "--seconds", "1")
    assert row["frames"] == 30 + 2 * 75 and row["directions"] == ["--then"]  # two jumps take time
    assert row["prompt"] == "a person walks forward, then somebody jumps twice"
    assert [each["text"] for each in row["clauses"]] == ["a person walks forward", "somebody jumps"]


def test_timeline_with_a_path(model: str, tmp_path: Path) -> None:
    (tmp_path / "in").mkdir()
    timeline, path = tmp_path / "in" / "t.yaml", tmp_path / "in" / "p.csv"
    timeline.write_text(
        "- {text: a person walks forward, start: 0, end: 2}\n"
        "- {text: somebody jumps twice, start: 0.5, end: 1, parts: arms}\n"
    )
    path.write_text("x,z\n1,0\n1,1.5\n")
    out = tmp_path / "out"
    row = generate(model, out, "--timeline", str(timeline), "--path", str(path))
    assert row["frames"] == 60 and row["errors"]["path_mean"] < 1e-3
    motion = read_npz(next(iter(row["files"].values())))
    np.testing.assert_allclose(motion.root_position[-1, [0, 2]], [1, 1.5], atol=1e-3)


def test_a_loop(model: str, tmp_path: Path) -> None:
    row = generate(model, tmp_path, *WALK, "--loop", "--seconds", "2")
    assert row["frames"] == 61 and row["errors"]["join_acceleration"] > 0  # with the closing key


def test_ends_and_edits(model: str, clip: str, tmp_path: Path) -> None:
    row = generate(model, tmp_path / "a", "--start", clip, "--keep", "0.5", *WALK, "--seconds", "3")
    assert row["frames"] == 90 and row["errors"]["frames_kept"] == 15
    row = generate(model, tmp_path / "b", "--start", clip, "--end", clip, "--keep", "0.5")
    kept, made = read_npz(clip), read_npz(next(iter(row["files"].values())))
    np.testing.assert_allclose(made.positions()[-15:], kept.positions()[-15:], atol=1e-3)
    arm = ("--joints", "left-arm, head", "--from", "0.5", "--to", "1.5")
    row = generate(model, tmp_path / "c", "--edit", clip, *arm)
    assert row["frames"] == 60 and row["errors"]["rotation"] < 1e-3


@pytest.mark.parametrize(
    ("arguments", "named"),
    [
        (("--then", "a person waves"), "--prompt is missing"),
        ((*WALK, *WALK, "--then", "x"), "--prompt is given 2 times"),
        ((*WALK, "--then", " "), "text 2 of 2 is empty"),
        ((*WALK, "--timeline", "t.yaml"), "--prompt does not go with --timeline"),
        (("--timeline", "t.yaml", "--then", "x"), "--timeline does not go with --then"),
        (("--timeline", "t.yaml", "--seconds", "3"), "--seconds does not go with --timeline"),
        ((*WALK, "--loop", "--path", "p.csv"), "--loop does not go with --path"),
        ((*WALK, "--keep", "1"), "--keep says how much"),
        ((*WALK, "--joints", "arms"), "--joints says what"),
        ((*WALK, "--start", "a", "--edit", "b", "--joints", "head"), "--start does not go with"),
        ((*WALK, "--start", "a", "--path", "p.csv"), "--path does not go with --start"),
        (("--edit", "a.npz"), "--edit: say what is made anew"),
        (("--edit", "a.npz", "--from", "2", "--to", "1"), "--to 1 is not after --from 2"),
        (("--edit", "a.npz", "--from", "nan"), "--from nan is out of range"),
        (("--edit", "a.npz", "--joints", "left-arn"), "did you mean 'left-arm'"),
        (("--edit", "a.npz", "--joints", ","), "--joints is empty"),
        ((*WALK, "--loop", "--num-samples", "2"), "--num-samples does not go with --loop"),
        ((*WALK, "--loop", "--style", "old"), "--style does not go with --loop"),
        (("--audio", "pyproject.toml", "--loop"), "--loop does not go with --audio"),
    ],
)
def test_wrong_usage_names_the_flag(arguments: tuple[str, ...], named: str) -> None:
    result = runner.invoke(app, ["generate", *arguments])
    assert result.exit_code == 2 and named in result.stderr, result.stderr
    assert result.stdout == "" and result.stderr.count("\n") == 1


def test_what_is_in_a_file_may_be_wrong(clip: str, tmp_path: Path) -> None:
    timeline = tmp_path / "t.yaml"
    timeline.write_text("[{text: a, start: 0, end: 2}, {text: b, start: 1, end: 3}]")
    path = tmp_path / "p.csv"
    path.write_text("x,z,t\n0,0,0\n0,nan,1\n")
    timed = tmp_path / "q.csv"
    timed.write_text("x,z,t\n0,0,0\n0,1,1\n")
    for code, named, arguments in (
        (1, "'b' starts at 1 s, before", ("--timeline", str(timeline))),
        (1, "point 2: z is 'nan'", (*WALK, "--path", str(path))),
        (2, "has times", (*WALK, "--path", str(timed), "--seconds", "3")),
        (2, "none.bvh does not exist", (*WALK, "--start", str(tmp_path / "none.bvh"))),
        (2, "none.csv does not exist", (*WALK, "--path", str(tmp_path / "none.csv"))),
        (2, "none.yaml does not exist", ("--timeline", str(tmp_path / "none.yaml"))),
        (2, "none.txt does not exist", ("--prompts", str(tmp_path / "none.txt"))),
        (1, "lasts 2.00 s, less than the 3 s", ("--start", clip, "--keep", "3")),
        (2, "leaves nothing to make", ("--start", clip, "--end", clip, "--keep", "1")),
        (1, "lasts 2.00 s; choose a span", ("--edit", clip, "--from", "1", "--to", "3")),
    ):
        result = runner.invoke(app, ["generate", *arguments])
        assert result.exit_code == code and named in result.stderr, result.stderr
