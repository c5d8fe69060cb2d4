"""`generate --audio SONG --memory DIR`: every window asks, and what cannot answer is told."""

import json
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from typer.testing import CliRunner

from src.cli.tools import app
from src.shared.audio.synthetic import SongSpec, render_song
from src.shared.formats.arrays import read_trajectory_npz
from src.shared.memory.index import MemoryIndex
from tests.shared.evaluation.tiny_pairs import tiny_model
from tests.shared.memory.tiny_figures import tiny_figures
from tests.shared.pipelines.tiny_recall import remember, save_memory, save_space

runner = CliRunner()


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A song, a model with a memory part and one without, a space, a memory."""
    folder = tmp_path_factory.mktemp("remembering")
    tiny_model().save_pretrained(folder / "plain")
    remember(tiny_model()).save_pretrained(folder / "model")
    save_memory(folder / "memory", save_space(folder / "space"), folder / "space")
    render_song(SongSpec(seconds=4.0, seed=1)).write_wav(folder / "song.wav")
    return folder


def generate(folder: Path, *arguments: str | Path, model: str = "model") -> Any:
    command = ["generate", "--audio", folder / "song.wav", "--model", folder / model]
    command += ["--device", "cpu", "--format", "npz", "--steps", "2", "--json", *arguments]
    return runner.invoke(app, list(map(str, command)))


def made(result: Any) -> tuple[dict[str, Any], np.ndarray]:
    assert result.exit_code == 0, result.stderr
    report = json.loads(result.stdout)
    return report, read_trajectory_npz(report["motions"][0]["files"]["npz"]).data


def test_a_memory_is_asked_and_heard(folder: Path, tmp_path: Path) -> None:
    without, before = made(generate(folder, "--out", tmp_path / "without"))
    plain, first = made(generate(folder, "--out", tmp_path / "plain", model="plain"))
    assert without["memory"] is None and plain["memory"] is None
    np.testing.assert_array_equal(before, first)

    asked = generate(folder, "--out", tmp_path / "with", "--memory", folder / "memory")
    report, after = made(asked)
    told = report["memory"]
    assert told["folder"] == str(folder / "memory")
    assert told["null"] == told["timed_out"] + told["failed"]
    assert told["answered"] + told["null"] == windows(report["motions"][0]["frames"])
    assert after.shape == before.shape
    if told["answered"]:  # not on a machine that takes half a second for twelve phrases
        assert np.abs(after - before).max() > 1e-4


def test_a_memory_at_an_address_is_asked(
    folder: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path / "cache"))
    MemoryIndex.open(folder / "memory").save("memory://generate")
    report, _ = made(generate(folder, "--out", tmp_path, "--memory", "memory://generate"))
    assert report["memory"]["folder"] == "memory://generate"
    nowhere = generate(folder, "--out", tmp_path, "--memory", "memory://generate-nothing")
    assert nowhere.exit_code == 2 and "make one with `memory build`" in nowhere.stderr


def windows(frames: int) -> int:
    """Of the tiny model, for so many frames."""
    from src.shared.pipelines.song_sampler import SongSampler

    return len(SongSampler(tiny_model()).windows(frames))


@pytest.mark.parametrize(
    ("model", "arguments", "message"),
    [
        ("plain", ("--memory", "memory"), "hears no memory"),
        ("model", ("--memory", "nothing"), "is no folder"),
        ("model", ("--memory", "space"), "is no memory"),
        ("model", ("--memory", "memory", "--runtime", "onnx"), "hears no memory"),
    ],
)
def test_refusals(
    folder: Path, tmp_path: Path, model: str, arguments: tuple[str, ...], message: str
) -> None:
    flag, name, *rest = arguments
    result = generate(folder, "--out", tmp_path, flag, folder / name, *rest, model=model)
    assert result.exit_code in (1, 2) and message in result.stderr
    assert not list(tmp_path.iterdir())


def test_figures_are_for_dances_that_follow_no_path(folder: Path, tmp_path: Path) -> None:
    tiny_figures().save(tmp_path / "figures")
    out, memory = ("--out", tmp_path / "out"), ("--memory", tmp_path / "figures")
    for path in ((), ("--body", "--follow-path")):
        result = generate(folder, *out, *memory, *path)
        assert result.exit_code == 2 and "which no path hears" in result.stderr
    for name in (tmp_path / "figures", folder / "memory"):
        alone = generate(folder, *out, "--memory", name, "--body", "--no-figures")
        assert alone.exit_code == 2 and "--memory does not go with --no-figures" in alone.stderr
        led = generate(folder, *out, "--memory", name, "--prompt", "dance", "--path", "circle")
        assert led.exit_code == 2 and "--memory does not go with a drawn path" in led.stderr
    phrases = generate(folder, *out, "--memory", folder / "memory", "--body")
    assert phrases.exit_code == 2 and "holds no figures" in phrases.stderr
    assert not (tmp_path / "out").exists()


def test_a_prompt_has_no_memory() -> None:
    result = runner.invoke(app, ["generate", "--prompt", "walk", "--memory", "somewhere"])
    assert result.exit_code == 2 and "--memory" in result.stderr
