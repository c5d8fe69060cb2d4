"""`generate` with a tiny real model: files, JSON on stdout, warnings on stderr, refusals."""

import json
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from typer.testing import CliRunner

from src.cli.generate import GROUP, in_groups
from src.cli.tools import app
from src.shared.formats.arrays import read_npz
from src.shared.io.files import write_json
from src.shared.metrics.measurements import ACTIONS
from src.shared.pipelines.motion_generator import MotionGenerator
from tests.shared.model.conftest import tiny_generator

PROMPTS = ("--prompt", "a person walks forward", "--prompt", "人が前に歩く")
runner = CliRunner()


@pytest.fixture(scope="module")
def model(tmp_path_factory: pytest.TempPathFactory) -> str:
    """A model folder."""
    folder = tmp_path_factory.mktemp("model")
    tiny_generator().save_pretrained(folder)
    return str(folder)


def generate(*arguments: str, code: int = 0) -> tuple[str, str]:
    """stdout and stderr of a run that must end with `code`."""
    result = runner.invoke(app, ["generate", "--seconds", "0.5", "--device", "cpu", *arguments])
    assert result.exit_code == code, result.stderr
    return result.stdout, result.stderr


def test_json_names_whole_files_seeds_and_times(model: str, tmp_path: Path) -> None:
    out, _ = generate(*PROMPTS, "--model", model, "--out", str(tmp_path), "--num-samples", "2",
                      "--return-all", "--seed", "5", "--format", "bvh,npz", "--json")  # fmt: skip
    result = json.loads(out)  # nothing else is on stdout
    rows = result["motions"]
    assert [row["prompt"] for row in rows] == [PROMPTS[1]] * 2 + [PROMPTS[3]] * 2
    assert [row["rank"] for row in rows] == [1, 2, 1, 2]
    assert [sorted(row["sample"] for row in rows[i : i + 2]) for i in (0, 2)] == [[0, 1]] * 2
    assert {row["seed"] for row in rows} == {5} and result["device"] == "cpu"
    files = [Path(path) for row in rows for path in row["files"].values()]
    assert sorted(files) == sorted(tmp_path.iterdir()), "no other file, no half-written one"
    assert {path.suffix for path in files} == {".bvh", ".npz"}
    assert set(result["timings"]) == {"import", "load", "sample", "write", "total"}
    parts = [seconds for name, seconds in result["timings"].items() if name != "total"]
    assert sum(parts) == pytest.approx(result["timings"]["total"], abs=0.01)


def test_a_seed_means_the_same_motion(model: str, tmp_path: Path) -> None:
    def motion(folder: str, seed: str) -> np.ndarray:
        out, _ = generate("--prompt", "a person walks forward", "--model", model, "--seed", seed,
                          "--out", str(tmp_path / folder), "--format", "npz")  # fmt: skip
        return read_npz(out.strip()).quaternions

    first = motion("first", "1")
    assert np.array_equal(first, motion("again", "1"))
    assert not np.allclose(first, motion("other", "2"))


def test_replaced_files_are_told(model: str, tmp_path: Path) -> None:
    arguments = (*PROMPTS, "--model", model, "--out", str(tmp_path), "--format", "npz")
    assert "replaced" not in generate(*arguments)[1]
    assert "2 files in" in generate(*arguments)[1]


def test_far_prompts_are_warned_of_by_name(model: str, tmp_path: Path) -> None:
    arguments = ("--model", model, "--out", str(tmp_path), "--format", "npz", "--json")
    out, err = generate(
        "--prompt", "quantum chromodynamics", "--prompt", "somebody jumps twice", *arguments
    )
    far, near = json.loads(out)["motions"]
    assert "walk" in far["warning"] and near["warning"] is None
    assert err.count("warning:") == 1 and far["warning"] in err


def test_what_no_sample_shows_is_told(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    for shows in (True, False):
        monkeypatch.setitem(ACTIONS, "jump", lambda measured, shows=shows: shows)
        out, _ = generate("--prompt", "a person jumps", "--model", "starter", "--runtime", "torch",
                          "--seconds", "1", "--out", str(tmp_path), "--format", "npz",
                          "--json")  # fmt: skip
        (row,) = json.loads(out)["motions"]
        assert ("none of 8 samples shows" in (row["warning"] or "")) is not shows


def test_prompts_come_from_a_file_and_say_what_was_read(model: str, tmp_path: Path) -> None:
    file = tmp_path / "npc.csv"
    file.write_text("prompt,seconds\na person walks,1\nwalks twice,\n", encoding="utf-8")
    arguments = ("--model", model, "--out", str(tmp_path / "out"), "--format", "npz", "--json")
    rows = json.loads(generate("--prompts", str(file), "--seconds", "2", *arguments)[0])["motions"]
    assert rows[0]["frames"] == 30 and rows[0]["clauses"] == [{"text": "a person walks"}]
    assert rows[1]["clauses"] == [{"text": "walks", "count": 2}]


def test_any_length_needs_no_warning(model: str, tmp_path: Path) -> None:
    arguments = ("--model", model, "--out", str(tmp_path), "--format", "npz", "--json")
    out, err = generate(*PROMPTS, "--seconds", "3", *arguments)
    assert all(row["frames"] == 90 for row in json.loads(out)["motions"])
    assert "longer" not in err


def test_tags_reach_the_model(model: str, tmp_path: Path) -> None:
    arguments = (*PROMPTS, "--model", model, "--out", str(tmp_path), "--format", "npz")
    generate(*arguments, "--tag", "walk", "--tag", "jump")
    assert "did you mean 'walk'" in generate(*arguments, "--tag", "wlak", code=2)[1]


def test_an_untrained_model_refuses(model: str, tmp_path: Path) -> None:
    tiny_generator().save_pretrained(tmp_path / "untrained")
    card = json.loads((tmp_path / "untrained" / "config.json").read_text(encoding="utf-8"))
    write_json(tmp_path / "untrained" / "config.json", card | {"trained": False})
    _, err = generate(*PROMPTS, "--model", str(tmp_path / "untrained"), "--out", str(tmp_path),
                      code=1)  # fmt: skip
    assert "untrained" in err and len(err.splitlines()) == 1
    _, err = generate(*PROMPTS, "--model", "default", "--out", str(tmp_path), code=1)
    assert "profile 'default' is untrained" in err


def test_a_damaged_model_is_named(model: str, tmp_path: Path) -> None:
    tiny_generator().save_pretrained(tmp_path / "cut")
    weights = tmp_path / "cut" / "model.safetensors"
    weights.write_bytes(weights.read_bytes()[:-10])
    _, err = generate(*PROMPTS, "--model", str(tmp_path / "cut"), "--out", str(tmp_path), code=1)
    assert "model.safetensors" in err and "Traceback" not in err


def test_a_stop_keeps_what_was_written_and_the_rest_can_follow(
    model: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    listed, many = tmp_path / "many.txt", GROUP + 3
    listed.write_text("\n".join(f"a person walks {number}" for number in range(many)))
    asked = ["generate", "--prompts", str(listed), "--seconds", "0.5", "--model", model]
    asked += ["--device", "cpu", "--format", "bvh", "--json", "--out"]
    whole, parts = tmp_path / "whole", tmp_path / "parts"
    assert runner.invoke(app, [*asked, str(whole)]).exit_code == 0

    sampled, counts = MotionGenerator.candidates, list[int]()

    def stopped(self: MotionGenerator, prompts: list[str], *rest: Any, **options: Any) -> Any:
        if counts:
            raise KeyboardInterrupt
        counts.append(len(prompts))
        return sampled(self, prompts, *rest, **options)

    with monkeypatch.context() as patch:
        patch.setattr(MotionGenerator, "candidates", stopped)
        assert runner.invoke(app, [*asked, str(parts)]).exit_code == 130
    assert counts == [GROUP] and len([*parts.iterdir()]) == GROUP
    before = {path: path.stat().st_mtime_ns for path in parts.iterdir()}
    result = runner.invoke(app, [*asked, str(parts), "--resume"])
    rows = json.loads(result.stdout)["motions"]
    assert [row.get("resumed", False) for row in rows] == [True] * GROUP + [False] * 3
    assert all(path.stat().st_mtime_ns == time for path, time in before.items())
    for path in whole.iterdir():
        assert (parts / path.name).read_bytes() == path.read_bytes()
    paged = [*asked[:-3], "npz,html", "--json", "--out", str(parts)]
    assert json.loads(runner.invoke(app, paged).stdout)["index"]
    (parts / "index.html").unlink()
    next(parts.glob("01-*.npz")).unlink()
    again = json.loads(runner.invoke(app, [*paged, "--resume"]).stdout)
    assert [row.get("resumed", False) for row in again["motions"]] == [False] + [True] * (many - 1)
    page = (parts / "index.html").read_text(encoding="utf-8")
    assert all(f"a person walks {number}" in page for number in range(many))
    refused = runner.invoke(app, ["generate", "--resume", "--prompt", "a", "--then", "b"])
    assert refused.exit_code == 2 and "--resume" in refused.stderr


def test_equal_prompts_are_sampled_together() -> None:
    assert in_groups(["a", "b"], [True, False]) == [[1]]
    assert in_groups(["a", "b", "a"], [True, False, False]) == [[0, 1, 2]]
    assert in_groups(["a", "a"], [True, True]) == []
