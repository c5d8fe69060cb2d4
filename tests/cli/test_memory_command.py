"""`memory build` and `memory query` with a tiny real space, a tiny text model and a real song."""

import json
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import soundfile
import torch
from typer.testing import CliRunner

from src.cli.tools import app
from src.shared.audio.synthetic import SongSpec, render_song
from src.shared.config_audio import AudioTowerConfig
from src.shared.formats.arrays import write_npz
from src.shared.io.storage import place
from src.shared.memory.index import MemoryIndex
from src.shared.model.audio.shared_space import SharedSpace
from src.shared.model.checkpoint import ModelCard
from src.shared.model.clip.core import MotionClip
from src.shared.model.clip.pretrained import ClipBundle
from tests.shared.memory.tiny_figures import stepping, tiny_figures
from tests.shared.memory.tiny_memory import write_dancers
from tests.shared.model.conftest import tiny_generator

runner = CliRunner()


def invoke(*arguments: str, code: int = 0) -> tuple[str, str]:
    """stdout and stderr of a run that must end with `code`."""
    result = runner.invoke(app, ["memory", *arguments])
    assert result.exit_code == code, result.output
    return result.stdout, result.stderr


@pytest.fixture(autouse=True)
def private_cache(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("MOTIONGEN_AUDIO_CACHE", str(tmp_path / "cache"))


def test_figures_are_built_and_asked(tmp_path: Path) -> None:
    tiny_figures().save(tmp_path / "own")
    song = tmp_path / "song.wav"
    render_song(SongSpec(seconds=9.0, tempo=120.0, seed=5)).write_wav(song)
    (tmp_path / "dances").mkdir()
    write_npz(stepping(0.5), tmp_path / "dances" / "step.npz")
    out = str(tmp_path / "built")
    told, _ = invoke("build", str(tmp_path / "dances"), "--figures", "--out", out, "--json")
    assert json.loads(told)["takes"] == 1 and json.loads(told)["figures"] > 10
    told, _ = invoke("query", str(song), "--memory", out, "--json")
    assert all(row["name"].startswith("step@") for row in json.loads(told)["figures"])
    told, _ = invoke("query", "polka", "--memory", str(tmp_path / "own"), "--top-k", "2", "--json")
    assert [row["kind"] for row in json.loads(told)["figures"]] == ["polka"] * 2
    _, said = invoke("query", "a tango", "--memory", "figures")
    assert "salsa" in said
    for wrong in (("--space", "x"), ("--split", "val"), ("--bars", "2")):
        invoke("build", "x", "--figures", "--out", out, *wrong, code=2)
    invoke("build", "nowhere", "--figures", "--out", out, code=2)
    invoke("build", "x", "--takes", "t.csv", "--out", out, code=2)


@pytest.fixture(scope="module")
def world(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """pairs, a text model and a space of the same text tower, the memory of them, a song."""
    root = tmp_path_factory.mktemp("world")
    write_dancers(root / "pairs", 4)
    generator = tiny_generator()
    generator.save_pretrained(root / "text")
    torch.manual_seed(0)
    clip = MotionClip(generator.network)
    clip.text = generator.text
    bundle = ClipBundle(
        clip.eval(),
        generator.tokenizer,
        generator.mean,
        generator.std,
        ModelCard(kind="motion-clip"),
    )
    for seed in (0, 1):
        torch.manual_seed(seed)
        config = AudioTowerConfig(embed_dim=32, dim=16, num_heads=2, num_layers=1)
        SharedSpace.beside(bundle, config).save_pretrained(root / f"space{seed}")
    rendered = render_song(SongSpec(seconds=9.0, tempo=120.0, seed=5))
    soundfile.write(root / "tune.ogg", rendered.samples, rendered.sample_rate)
    invoke("build", str(root / "pairs"), "--space", str(root / "space0"), "--out",
           str(root / "memory"))  # fmt: skip
    return root


def test_build_reports_and_leaves_what_is_up_to_date(world: Path) -> None:
    before = (world / "memory" / "keys.safetensors").stat().st_mtime_ns
    out, _ = invoke("build", str(world / "pairs"), "--space", str(world / "space0"),
                    "--out", str(world / "memory"), "--json")  # fmt: skip
    report = json.loads(out)
    assert report["songs"] == 3 and report["dim"] == 32 and report["left_out"] == {}
    index = MemoryIndex.open(world / "memory")
    assert report["phrases"] == len(index) > 6
    assert (world / "memory" / "keys.safetensors").stat().st_mtime_ns == before
    text, _ = invoke("build", str(world / "pairs"), "--space", str(world / "space0"),
                     "--out", str(world / "memory"))  # fmt: skip
    assert f"{len(index)} phrases of 3 songs" in text and "memory query" in text


def test_an_address_is_built_and_asked(
    world: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path))
    arguments = ("build", str(world / "pairs"), "--space", str(world / "space0"), "--out")
    out, _ = invoke(*arguments, "memory://remembered/")
    assert "memory query SONG --memory memory://remembered\n" in out
    here, there = (
        json.loads(invoke("query", str(world / "tune.ogg"), "--memory", memory, "--json")[0])
        for memory in (str(world / "memory"), "memory://remembered")
    )
    assert there["memory"] == "memory://remembered" and there["answers"] == here["answers"]
    write_npz(stepping(0.5), tmp_path / "step.npz")
    place("memory://dances/step.npz").write_bytes((tmp_path / "step.npz").read_bytes())
    invoke("build", "memory://dances", "--figures", "--out", "memory://danced")
    told, _ = invoke("query", "dance", "--memory", "memory://danced", "--json")
    assert json.loads(told)["figures"]


def test_a_song_is_answered_bar_by_bar(world: Path) -> None:
    arguments = ("query", str(world / "tune.ogg"), "--memory", str(world / "memory"))
    told: dict[str, Any] = json.loads(invoke(*arguments, "--top-k", "3", "--json")[0])
    answers = told["answers"]
    assert told["kind"] == "song" and len(answers) >= 4
    assert [len(answer["hits"]) for answer in answers] == [3] * len(answers)
    starts = [answer["start"] for answer in answers]
    assert np.allclose(np.diff(starts[1:]), 2.0, atol=0.1), "a bar of 120 BPM in 4/4"
    assert all(0 <= answer["confidence"] <= 1 for answer in answers)
    first = answers[1]["hits"][0]
    assert first["rank"] == 1 and first["tempo"] == 120.0 and first["caption"]
    scores = [[hit["score"] for hit in answer["hits"]] for answer in answers]
    assert all(row == sorted(row, reverse=True) for row in scores)
    lines = invoke(*arguments)[0].splitlines()
    assert len(lines) == len(answers) + 1 and "conf" in lines[0]


def test_words_are_answered_by_motions(world: Path) -> None:
    arguments = ("query", "a person walks forward", "--memory", str(world / "memory"),
                 "--model", str(world / "text"))  # fmt: skip
    told = json.loads(invoke(*arguments, "--top-k", "4", "--json")[0])
    (answer,) = told["answers"]
    assert told["kind"] == "text" and "bar" not in answer
    assert [hit["rank"] for hit in answer["hits"]] == [1, 2, 3, 4]
    lines = invoke(*arguments)[0].splitlines()
    assert lines[0].startswith("confidence") and "stability" in lines[1] and len(lines) == 2 + 8
    invoke("query", "a person walks and " * 30, *arguments[2:])  # longer than a file's name


def test_silence_is_asked_every_two_seconds(world: Path, tmp_path: Path) -> None:
    soundfile.write(tmp_path / "still.wav", np.zeros(44100 * 6), 44100)
    out, err = invoke("query", str(tmp_path / "still.wav"), "--memory", str(world / "memory"))
    assert "no beat was heard" in err and len(out.splitlines()) > 2


@pytest.mark.parametrize(
    ("arguments", "code", "says"),
    [
        (["query", "no-such.mp3", "--memory", "MEMORY"], 2, "no such file"),
        (["query", " ", "--memory", "MEMORY"], 2, "empty"),
        (["query", "walk", "--memory", "MEMORY", "--top-k", "0"], 2, "top-k"),
        (["query", "walk", "--memory", "PAIRS"], 1, "describes no memory"),
        (["query", "walk", "--memory", "nowhere"], 1, "is no memory"),
        (["query", "walk", "--memory", "memory://nowhere"], 1, "is no memory"),
        (["query", "walk", "--memory", "webhdfs://x/y"], 1, "webhdfs"),
        (["query", "walk", "--memory", "mars://x"], 2, "mars"),
        (["query", "walk", "--memory", "MEMORY", "--space", "SPACE1"], 1, "another shared space"),
        (["query", "walk", "--memory", "MEMORY", "--model", "starter"], 1, "not trained"),
        (["build", "PAIRS", "--space", "TEXT", "--out", "OUT"], 1, "not a shared-space"),
        (
            ["build", "PAIRS", "--space", "SPACE0", "--split", "val", "--out", "OUT"],
            1,
            "no phrases",
        ),
        (["build", "nowhere", "--space", "SPACE0", "--out", "OUT"], 2, "no phrases"),
        (["build", "PAIRS", "--space", "SPACE0", "--bars", "0", "--out", "OUT"], 2, "bars"),
    ],
)
def test_refusals_are_one_line(
    world: Path, tmp_path: Path, arguments: list[str], code: int, says: str
) -> None:
    places = {name.upper(): str(world / name) for name in ("memory", "pairs", "text")}
    places |= {"SPACE0": str(world / "space0"), "SPACE1": str(world / "space1")}
    places["OUT"] = str(tmp_path / "out")
    _, err = invoke(*(places.get(argument, argument) for argument in arguments), code=code)
    errors = [line for line in err.splitlines() if line.startswith("error:")]
    assert len(errors) == 1 and says in errors[0]
    assert not (tmp_path / "out").exists()


@pytest.mark.parametrize("command", ["build", "query"])
def test_help_shows_an_example(command: str) -> None:
    assert f"motion-tools memory {command}" in invoke(command, "--help")[0]
