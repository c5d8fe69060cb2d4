"""Models are loaded for sampling: trained ones only, and on a CPU in their faster form."""

from pathlib import Path
from typing import Any

import numpy as np
import pytest
import torch

from src.shared.errors import UserError
from src.shared.model.audio.audio_motion_model import AudioMotionModel
from src.shared.model.audio.unet import MatrixConv1d
from src.shared.model.checkpoint import ModelCard
from src.shared.pipelines import runtime
from src.shared.pipelines.motion_generator import load
from src.shared.pipelines.runtime import load_runtime, load_trained
from src.shared.pipelines.song import SongGenerator
from src.shared.pipelines.song_sampler import SongSampler, SongSampling
from tests.shared.model.audio.tiny_audio import awake, network_config, unet_config

SETTINGS = SongSampling(steps=2, window=60, overlap=15, seed=2)


def saved(folder: Path, *, trained: bool) -> AudioMotionModel:
    torch.manual_seed(0)
    config = network_config(unet=unet_config(channel_mult=(1, 1, 1), attention_resolutions=(4,)))
    model = AudioMotionModel(config, ModelCard(kind="", trained=trained))
    awake(model)
    model.save_pretrained(folder)
    return model.eval()


def is_fast(model: AudioMotionModel) -> bool:
    return any(isinstance(module, MatrixConv1d) for module in model.unet.modules())


def test_the_faster_copy_makes_the_same_motion_where_bf16_is_native_too(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("src.shared.device._native_bf16", lambda device: (True, "said so"))
    model = saved(tmp_path, trained=True)
    loaded = load_trained(tmp_path, "cpu")
    assert is_fast(loaded) and not is_fast(model)
    condition = torch.rand(167, 50)  # one window: a seam of a random network magnifies rounding
    wanted = SongSampler(model, SETTINGS).sample(condition)[0]
    found = SongSampler(loaded, SETTINGS).sample(condition)[0]
    assert np.abs(wanted.position).max() > 5.0
    np.testing.assert_allclose(found.position, wanted.position, atol=1e-4)


def test_generator_and_runtime_load_alike(tmp_path: Path) -> None:
    saved(tmp_path, trained=True)
    generator = SongGenerator.from_pretrained(tmp_path, device="cpu")
    assert is_fast(generator.model) and generator.device.type == "cpu"
    loaded = load_runtime("torch", tmp_path, "cpu")
    assert isinstance(loaded, AudioMotionModel) and is_fast(loaded)


def test_what_ships_is_sampled_by_onnxruntime_unless_another_decoder_is_named(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    pytest.importorskip("onnxruntime")
    assert SongGenerator.from_pretrained("starter-audio", runtime="auto").runtime == "onnx"
    for name in ("onnx", "torch"):
        assert load("starter", device="cpu", runtime=name).text.runtime == name
    saved(tmp_path, trained=True)  # has no export
    assert SongGenerator.from_pretrained(tmp_path, device="cpu", runtime="auto").runtime == "torch"
    monkeypatch.setenv("MOTIONGEN_DECODER_CHECKPOINT", "starter-audio")
    assert SongGenerator.from_pretrained("starter-audio", runtime="auto").runtime == "torch"


def test_an_export_that_does_not_fit_is_told_and_torch_samples(
    tmp_path: Path, caplog: pytest.LogCaptureFixture
) -> None:
    pytest.importorskip("onnxruntime")
    saved(tmp_path, trained=True)
    (tmp_path / "onnx.json").write_text('{"kind": "audio-motion", "format-version": 2}')
    assert isinstance(load_runtime("auto", tmp_path, "cpu"), AudioMotionModel)
    assert "export the model again; PyTorch samples until then" in caplog.text
    with pytest.raises(UserError, match="export the model again"):
        load_runtime("onnx", tmp_path, "cpu")
    with pytest.raises(UserError, match="holds a motion-generator, not an audio-motion"):
        load_runtime("auto", "starter", "cpu")


def test_an_export_hears_no_memory(tmp_path: Path) -> None:
    memory: Any = object()
    with pytest.raises(UserError, match="hears no memory"):
        SongGenerator.from_pretrained("starter-audio", runtime="onnx", memory=memory)


def test_untrained_models_are_refused(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    model = saved(tmp_path, trained=False)
    with pytest.raises(UserError, match="untrained"):
        load_runtime("torch", tmp_path, "cpu")
    monkeypatch.setattr(runtime.OnnxRuntime, "from_folder", lambda folder: model)
    with pytest.raises(UserError, match="untrained"):
        load_runtime("onnx", tmp_path)
