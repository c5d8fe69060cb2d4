"""`export-onnx` and `--runtime onnx`: what onnxruntime computes is what PyTorch computes."""

import json
import re
import shutil
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import torch
from typer.testing import CliRunner

from src.cli.tools import app
from src.shared.audio.synthetic import SongSpec, render_song
from src.shared.errors import UserError
from src.shared.model import onnx_graphs
from src.shared.model.audio.audio_motion_model import AudioMotionModel
from src.shared.model.checkpoint import WEIGHTS_FILE, ModelCard
from src.shared.model.onnx_card import AUDIO_GRAPHS, AudioOnnxCard, read_onnx_card
from src.shared.model.onnx_card import ONNX_CARD as CARD_FILE
from src.shared.model.onnx_graphs import run
from src.shared.pipelines.runtime import OnnxRuntime
from src.shared.pipelines.song_sampler import SongSampler, SongSampling
from tests.shared.model.audio.tiny_audio import awake, network_config, unet_config, walk

pytest.importorskip("onnxruntime")
pytest.importorskip("onnxscript")

invoke = CliRunner().invoke
LENGTHS = (8, 30, 100, 239, 240, 600)
TOLERANCE = 1e-4
COLUMNS = (
    (slice(0, 6), TOLERANCE),
    (slice(6, 9), 100 * TOLERANCE),  # second differences: 3600 roundings of a position in metres
    (slice(9, 16), TOLERANCE),
    (slice(17, 25), TOLERANCE),
)
SMALL = dict(channel_mult=(1,), attention_resolutions=())  # the exporter is slow


def trained(decoder: str, **unet: Any) -> AudioMotionModel:
    """Random weights, none of them zero, that pass for trained ones."""
    torch.manual_seed(0)
    config = network_config(
        unet=unet_config(**unet), decoder={"decoder": decoder, "hidden-dim": 16}
    )
    model = AudioMotionModel(config, ModelCard(kind="", name="tiny", trained=True))
    awake(model)
    rows = walk(60)[0]
    model.set_statistics(rows.mean(0), 0.1 + rows.std(0))
    return model.eval()


def exported(model: AudioMotionModel, folder: Path) -> OnnxRuntime:
    model.save_pretrained(folder / "model")
    arguments = ["--model", str(folder / "model"), "--out", str(folder / "onnx")]
    result = invoke(app, ["export-onnx", *arguments])
    assert result.exit_code == 0, result.output
    assert result.stdout.split() == [
        str(folder / "onnx" / n) for n in (*AUDIO_GRAPHS, WEIGHTS_FILE, CARD_FILE)
    ]
    return OnnxRuntime.from_folder(folder / "onnx")


@pytest.fixture(scope="module")
def home(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return tmp_path_factory.mktemp("onnx")


@pytest.fixture(scope="module")
def model() -> AudioMotionModel:
    return trained("derived", **SMALL)


@pytest.fixture(scope="module")
def runtime(home: Path, model: AudioMotionModel) -> OnnxRuntime:
    return exported(model, home)


@torch.no_grad()
def check_graphs(model: AudioMotionModel, runtime: OnnxRuntime) -> None:
    for batch, frames in ((1 + index % 3, frames) for index, frames in enumerate(LENGTHS)):
        x, condition = torch.randn(batch, 25, frames), torch.randn(batch, 167, frames)
        t = torch.randint(0, 1000, (batch,))
        for scale in (1.0, 2.5):
            wanted = model.model_fn(condition, scale)(x, t)
            found = runtime.model_fn(condition, scale)(x, t)
            assert wanted.abs().max() > 0.5
            torch.testing.assert_close(found, wanted, atol=TOLERANCE, rtol=0)
        rows = walk(frames).repeat(batch, 1, 1) + 1e-3 * torch.randn(batch, frames, 25)
        rows[..., :3] *= 0.1  # float32 knows 20 m to 2e-6 only, and velocities have 30 times that
        z = model.normalise(rows.transpose(1, 2))
        for start in (None, torch.rand(batch)):
            wanted, found = model.decode(z, start), runtime.decode(z, start)
            torch.testing.assert_close(
                found.phase_unwrapped, wanted.phase_unwrapped, atol=TOLERANCE, rtol=0
            )
            for columns, tolerance in COLUMNS:
                torch.testing.assert_close(
                    found.trajectory[..., columns],
                    wanted.trajectory[..., columns],
                    atol=tolerance,
                    rtol=0,
                )
            turn = 2 * torch.pi * (found.trajectory - wanted.trajectory)[..., 16]
            assert (1 - turn.cos()).max() < TOLERANCE  # 0.9999 and 0.0001 are neighbours


def test_any_length_and_batch(model: AudioMotionModel, runtime: OnnxRuntime) -> None:
    check_graphs(model, runtime)


@pytest.mark.slow
@pytest.mark.parametrize("conditioning", ["both", "cross-attention", "film"])
def test_three_levels_and_the_residual_decoder(tmp_path: Path, conditioning: str) -> None:
    """64 channels, for 8 frames are one at the lowest level.

    With 32 a group of the GroupNorm would be two numbers there. Where these are nearly equal, the
    division by their deviation multiplies roundings by 300: at 8 frames float32 PyTorch was 3e-4
    from float64 itself, onnxruntime 4e-4 (1e-5 at 30 frames). No profile has such groups.
    """
    levels = dict(model_channels=64, channel_mult=(1, 2, 2), attention_resolutions=(2, 4, 8))
    model = trained("residual", conditioning=conditioning, **levels)
    check_graphs(model, exported(model, tmp_path))


def test_same_seed_same_motion(model: AudioMotionModel, runtime: OnnxRuntime) -> None:
    settings = SongSampling(
        num_samples=2, steps=3, guidance_scale=1.5, seed=4, window=60, overlap=15
    )
    condition = torch.rand(167, 110, generator=torch.Generator().manual_seed(0))
    phase = np.arange(110) / 55.0
    wanted = SongSampler(model, settings).sample(condition, phase=phase)
    found = SongSampler(runtime, settings).sample(condition, phase=phase)
    for ours, theirs in zip(found, wanted, strict=True):
        np.testing.assert_allclose(ours.position, theirs.position, atol=1e-3)
        np.testing.assert_allclose(ours.quaternion, theirs.quaternion, atol=1e-3)


def test_graphs_name_their_dimensions(home: Path, runtime: OnnxRuntime) -> None:
    shapes = {value.name: value.shape for value in runtime._unet.get_inputs()}
    assert shapes["x"] == ["batch", 25, "2*pieces"]
    assert [value.shape for value in runtime._time.get_inputs()] == [["batch"]]
    card = read_onnx_card(home / "onnx", AudioOnnxCard)
    assert card.trained and card.name == "tiny" and len(card.model) == 64
    assert len(card.mean) == 25 and len(card.null_condition) == 167


def test_run_returns_every_output() -> None:
    class Echo:
        def run(self, outputs: None, inputs: dict[str, np.ndarray]) -> list[np.ndarray]:
            return [inputs["a"], inputs["a"] + 1]

    first, second = run(Echo(), a=torch.zeros(2, 3).T)
    assert first.shape == (3, 2) and bool((second == 1).all())


def test_generate_writes_the_same_files(home: Path, runtime: OnnxRuntime, tmp_path: Path) -> None:
    song = tmp_path / "song.wav"
    render_song(SongSpec(seconds=2.0, tempo=120.0, seed=1)).write_wav(song)
    arrays = {}
    for name, folder in (("torch", "model"), ("onnx", "onnx")):
        arguments = ["generate", "--audio", str(song), "--runtime", name, "--format", "npz"]
        arguments += ["--model", str(home / folder), "--out", str(tmp_path / name)]
        result = invoke(app, [*arguments, "--steps", "2", "--device", "cpu", "--json"])
        assert result.exit_code == 0, result.output
        assert json.loads(result.stdout)["runtime"] == name
        with np.load(tmp_path / name / "song.npz") as found:
            arrays[name] = {key: found[key] for key in found.files}
    assert arrays["onnx"].keys() == arrays["torch"].keys()
    numbers = [key for key, value in arrays["torch"].items() if value.dtype.kind == "f"]
    assert numbers
    for key in numbers:
        np.testing.assert_allclose(
            arrays["onnx"][key], arrays["torch"][key], atol=2e-2, err_msg=key
        )


@pytest.mark.parametrize("damage", ["graph", "card", "version", "missing"])
def test_damage_is_one_line(home: Path, runtime: OnnxRuntime, tmp_path: Path, damage: str) -> None:
    folder = tmp_path / "copy"
    shutil.copytree(home / "onnx", folder)
    card = folder / CARD_FILE
    if damage == "graph":
        (folder / AUDIO_GRAPHS[1]).write_bytes(b"cut")
    elif damage == "card":
        card.write_text("{")
    elif damage == "version":
        card.write_text(card.read_text().replace('"format-version": 4', '"format-version": 3'))
    else:
        card.unlink()
    with pytest.raises(UserError, match="export") as caught:
        OnnxRuntime.from_folder(folder)
    assert "\n" not in str(caught.value) and str(folder) in str(caught.value)


def test_no_export_yet_says_how_to_make_one(home: Path, tmp_path: Path) -> None:
    trained("derived", **SMALL).save_pretrained(home / "model")
    audio = (home / "model", Path("starter-audio"))
    others = (tmp_path, tmp_path / "none", Path("evaluator"))
    wanted = [(folder, f" --model {folder}") for folder in (*audio, Path("starter"))]
    for folder, model in [*wanted, *((folder, "") for folder in others)]:
        with pytest.raises(UserError, match=re.escape(f"`export-onnx{model} --out DIR`")):
            read_onnx_card(folder, AudioOnnxCard)


def test_an_export_that_is_stopped_leaves_nothing(
    home: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    trained("derived", **SMALL).save_pretrained(home / "model")

    def stopped(*_: object, **__: object) -> None:
        raise KeyboardInterrupt

    monkeypatch.setattr(torch.onnx, "export", stopped)
    out = tmp_path / "onnx"
    result = invoke(app, ["export-onnx", "--model", str(home / "model"), "--out", str(out)])
    assert result.exit_code == 130 and not out.exists()


def test_missing_package_names_the_extra(
    home: Path, runtime: OnnxRuntime, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(onnx_graphs, "find_spec", lambda name: None)
    with pytest.raises(UserError, match=r"onnxruntime.*pip install onnx"):
        OnnxRuntime.from_folder(home / "onnx")


@pytest.mark.parametrize(
    "arguments, words",
    [
        (["--audio", "SONG", "--runtime", "tensorrt"], "--runtime tensorrt"),
        (["--audio", "SONG", "--runtime", "onnx", "--device", "cuda"], "--device cuda"),
        (["--prompt", "a person waves", "--runtime", "onnx", "--device", "cuda"], "--device cuda"),
    ],
)
def test_wrong_usage(tmp_path: Path, arguments: list[str], words: str) -> None:
    song = tmp_path / "song.wav"
    song.touch()
    filled = [str(song) if argument == "SONG" else argument for argument in arguments]
    result = invoke(app, ["generate", *filled])
    assert result.exit_code == 2 and words in result.stderr
