"""MOTIONGEN_* variables mean the same to the library and to training as to the command line."""

from pathlib import Path

import pytest

from src.shared import environment
from src.shared.config_audio import (
    FinetuneE2eConfig,
    PhraseConfig,
    TrainAudioConfig,
    TrainDecoderConfig,
)
from src.shared.config_loader import load_train
from src.shared.device import choose_compute, choose_device
from src.shared.errors import UsageError
from src.shared.model import checkpoint
from src.shared.pipelines.motion_generator import MotionGenerator
from src.train.train_clip import TrainClipConfig


@pytest.fixture(autouse=True)
def variables(monkeypatch: pytest.MonkeyPatch) -> None:
    for name in ("DATA_DIR", "DIFFUSION_CHECKPOINT", "DECODER_CHECKPOINT"):
        monkeypatch.setenv(getattr(environment, name), name.lower())
    monkeypatch.setenv(environment.DEVICE, "cpu")
    monkeypatch.setenv(environment.OUTPUT_DIR, "results")


def test_a_device_that_is_open_is_the_variables(monkeypatch: pytest.MonkeyPatch) -> None:
    assert choose_device() == ("cpu", "as MOTIONGEN_DEVICE says")
    monkeypatch.setenv(environment.DEVICE, "tpu")
    assert choose_device("cpu") == ("cpu", "as requested")
    with pytest.raises(UsageError, match="'tpu' is unknown"):
        choose_compute()
    monkeypatch.setenv(environment.DEVICE, "")
    assert choose_device()[1] != "as MOTIONGEN_DEVICE says"


def test_training_reads_them_before_its_defaults() -> None:
    audio, clip = load_train(None, TrainAudioConfig), load_train(None, TrainClipConfig)
    assert (audio.data, audio.output) == ("data_dir", str(Path("results/audio")))
    assert (clip.data, clip.output) == ("synthetic", str(Path("results/clip")))
    assert load_train(None, TrainDecoderConfig).audio == "diffusion_checkpoint"
    tuned = load_train(None, FinetuneE2eConfig)
    assert tuned.checkpoint == "diffusion_checkpoint"
    assert tuned.decoder_checkpoint == "decoder_checkpoint"


def test_what_the_user_says_comes_before_them(tmp_path: Path) -> None:
    given = load_train(None, TrainAudioConfig, ["data=mine", "output=runs/there"])
    assert (given.data, given.output) == ("mine", "runs/there")
    file = tmp_path / "train.yaml"
    file.write_text("output: runs/there\n")
    config = load_train(file, PhraseConfig)
    assert (config.output, config.data) == ("runs/there", "data_dir")


def test_runs_are_found_where_training_writes_them(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv(environment.OUTPUT_DIR, str(tmp_path))
    (tmp_path / "clip").mkdir()
    (tmp_path / "clip" / checkpoint.CARD_FILE).write_text("{}")
    assert checkpoint.resolve_model("runs/clip") == tmp_path / "clip"


def test_the_library_makes_paths_with_the_model_that_is_named() -> None:
    assert environment.default_audio_model() == "diffusion_checkpoint"
    with pytest.raises(Exception, match="no model named 'diffusion_checkpoint'"):
        _ = MotionGenerator().audio
    with pytest.raises(Exception, match="no model named 'mine'"):
        _ = MotionGenerator(audio="mine").audio
