"""`generate --num-samples`: the best is written, `--return-all` writes all, the scores are told."""

import json
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import torch
from typer.testing import CliRunner

from src.cli.tools import app
from src.shared.audio.synthetic import SongSpec, render_song
from src.shared.formats.arrays import read_npz, read_trajectory_npz
from src.shared.model.checkpoint import ModelCard
from src.shared.model.clip.core import MotionClip
from src.shared.model.clip.pretrained import ClipBundle
from tests.shared.evaluation.tiny_pairs import tiny_model
from tests.shared.model.conftest import tiny_generator, tiny_network

PROMPT = ("--prompt", "a person walks forward", "--seconds", "0.5")
runner = CliRunner()


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A text model, the CLIP model of its width, an audio model, a song."""
    folder = tmp_path_factory.mktemp("models")
    generator = tiny_generator()
    generator.save_pretrained(folder / "text")
    torch.manual_seed(0)
    clip = MotionClip(tiny_network()).eval()
    clip.text.load_state_dict(generator.text.state_dict())
    card = ModelCard(kind="motion-clip", name="tiny", trained=True)
    bundle = ClipBundle(clip, generator.tokenizer, generator.mean, generator.std, card)
    bundle.save_pretrained(folder / "clip")
    tiny_model().save_pretrained(folder / "audio")
    render_song(SongSpec(seconds=4.0, seed=1)).write_wav(folder / "song.wav")
    return folder


def generate(*arguments: str | Path) -> tuple[dict[str, Any], str]:
    """The JSON of a run, and what it said beside it."""
    command = ["generate", "--device", "cpu", "--format", "npz", "--json"]
    result = runner.invoke(app, [*command, *map(str, arguments)])
    assert result.exit_code == 0, result.stderr
    return json.loads(result.stdout), result.stderr


def test_the_best_prompt_motion_is_written_and_all_are_scored(folder: Path, tmp_path: Path) -> None:
    wanted = (*PROMPT, "--model", folder / "text", "--judge", folder / "clip", "--num-samples", "3")
    best, told = generate(*wanted, "--out", tmp_path / "best")
    every, _ = generate(*wanted, "--out", tmp_path / "all", "--return-all")
    assert best["selection"] == every["selection"]
    (chosen,) = best["selection"]
    assert chosen["for"] == PROMPT[1]
    assert set(chosen["weights"]) == {"similarity", "feet", "smoothness", "distance"}
    assert [row["rank"] for row in chosen["candidates"]] == [1, 2, 3]
    order = [row["sample"] for row in chosen["candidates"]]
    assert sorted(order) == [0, 1, 2]
    assert [row["sample"] for row in every["motions"]] == order
    (written,) = best["motions"]
    assert written["sample"] == order[0] and written["rank"] == 1
    kept, first = read_npz(written["files"]["npz"]), read_npz(every["motions"][0]["files"]["npz"])
    np.testing.assert_array_equal(kept.quaternions, first.quaternions)
    assert len(list((tmp_path / "best").iterdir())) == 1
    assert len(list((tmp_path / "all").iterdir())) == 3
    assert "scores of 3 candidates" in told and "similarity" in told


def test_one_sample_needs_no_scores(folder: Path, tmp_path: Path) -> None:
    found, told = generate(*PROMPT, "--model", folder / "text", "--out", tmp_path)
    assert found["selection"] == [] and "scores" not in told


def test_the_best_of_a_song(folder: Path, tmp_path: Path) -> None:
    song = ("--audio", folder / "song.wav", "--model", folder / "audio")
    wanted = (*song, "--num-samples", "3", "--steps", "2")
    best, told = generate(*wanted, "--out", tmp_path / "best")
    every, _ = generate(*wanted, "--out", tmp_path / "all", "--return-all")
    (chosen,) = best["selection"]
    order = [row["sample"] for row in chosen["candidates"]]
    assert [row["sample"] for row in every["motions"]] == order
    assert [row["rank"] for row in every["motions"]] == [1, 2, 3]
    assert [row["sample"] for row in best["motions"]] == order[:1]
    paths = [run["motions"][0]["files"]["npz"] for run in (best, every)]
    kept, first = map(read_trajectory_npz, paths)
    np.testing.assert_array_equal(kept.data, first.data)
    assert [path.name for path in (tmp_path / "best").iterdir()] == ["song.npz"]
    assert "sanity" in told


@pytest.mark.parametrize("beside", [("--prompt", "walk"), ("--audio", "song.wav")])
def test_a_judge_without_candidates_is_refused(beside: tuple[str, str]) -> None:
    result = runner.invoke(app, ["generate", *beside, "--judge", "clip"])
    assert result.exit_code == 2 and "--num-samples 2" in result.stderr
