"""The phrases of an audio stage: every stage runs where too little is there to hold any back."""

from pathlib import Path

import pytest
from tiny_audio_stage import (
    SETTINGS,
    STEPS,
    audio_config,
    train_audio,
    write_circles,
)

from src.shared.config_loader import load_train
from src.shared.errors import UserError
from src.train import train_decoder
from src.train.audio_stages import network_of, open_held_back, open_phrases
from src.train.engine import Trainer
from src.train.launch import STAGES


@pytest.fixture(scope="module")
def few(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Three phrases, all of them for training."""
    return write_circles(tmp_path_factory.mktemp("few"), num=3)


def test_every_stage_runs_without_held_back_phrases(
    few: Path, tmp_path: Path, capfd: pytest.CaptureFixture[str]
) -> None:
    task = train_audio(audio_config(few, tmp_path / "audio", "steps=2"))
    assert "no phrases are held back: validation reads training phrases" in capfd.readouterr().err
    assert task.figures["loss"] > 0
    assert (tmp_path / "audio" / "samples" / "00000002" / "held-back.png").exists()

    places = [f"data='{few}'", f"audio='{tmp_path}/audio'", f"output='{tmp_path}/decoder'"]
    settings = load_train(
        None, train_decoder.TrainDecoderConfig, [*SETTINGS, *STEPS, *places, "steps=2"]
    )
    network = network_of(settings.audio)
    build = train_decoder.DecoderTask
    Trainer(settings, lambda c: build(c, network), command="again").train()

    places = [f"data='{few}'", f"checkpoint='{tmp_path}/decoder'", f"output='{tmp_path}/e2e'"]
    STAGES["finetune-e2e"].run([*SETTINGS, *places, "epochs=1"])
    assert (tmp_path / "e2e" / "finished.json").exists()


def test_what_is_held_back_is_read_where_there_is_any(
    circles: Path, few: Path, tmp_path: Path
) -> None:
    held_back = open_held_back(audio_config(circles, tmp_path))
    assert {phrase.split for phrase in held_back.phrases} == {"val"}
    config = audio_config(few, tmp_path, "num-phrases=2")
    assert open_held_back(config).phrase_ids == open_phrases(config, "train", 2).phrase_ids
    with pytest.raises(UserError, match="nowhere"):
        open_held_back(audio_config(tmp_path / "nowhere", tmp_path))
