"""Audio tower training on a little data: it learns, resumes exactly, leaves a space."""

import json
from pathlib import Path

import pytest
import torch
from tiny_audio_stage import SETTINGS, STEPS, assert_equal_runs

from src.shared.config_audio import TrainAudioTowerConfig
from src.shared.config_loader import load_network, load_train
from src.shared.errors import UserError
from src.shared.model.audio.shared_space import SharedSpace
from src.train.engine import Trainer
from src.train.task import Part
from src.train.train_audio_tower import AudioTowerTask, kin
from tests.shared.evaluation.space_samples import TOWER, tiny_bundle, write_space_phrases

SIZES = [f"tower.{key}={getattr(TOWER, key.replace('-', '_'))}" for key in
         ("dim", "num-heads", "num-layers", "dropout")]  # fmt: skip
WINDOWS = ["bars=1", "min-frames=30", "max-frames=60", "target-frames=32", "batch-size=12"]


@pytest.fixture(scope="module")
def phrases(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return write_space_phrases(tmp_path_factory.mktemp("phrases"), songs=16)


@pytest.fixture(scope="module")
def clip(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("clip")
    tiny_bundle().save_pretrained(folder)
    return folder


def config(data: Path, clip: Path, output: Path, *more: str) -> TrainAudioTowerConfig:
    places = [f"data='{data}'", f"clip='{clip}'", f"output='{output}'"]
    settings = [*SETTINGS, *STEPS, *SIZES, *WINDOWS, *places, *more]
    return load_train(None, TrainAudioTowerConfig, settings)


def train(settings: TrainAudioTowerConfig, *, resume: bool = False) -> AudioTowerTask:
    network = load_network("lightweight")
    trainer = Trainer(
        settings, lambda c: AudioTowerTask(c, network), command="again", resume=resume
    )
    trainer.train()
    assert isinstance(trainer.task, AudioTowerTask)
    return trainer.task


def test_it_learns_and_leaves_a_space(phrases: Path, clip: Path, tmp_path: Path) -> None:
    more = ("steps=60", "copies=0", "learning-rate=0.003", "ema-decay=0.9", "log-every=10")
    task = train(config(phrases, clip, tmp_path, *more, "validate-first=true"))
    lines = [json.loads(line) for line in (tmp_path / "log.jsonl").read_text().splitlines()]
    losses = [line["contrastive"] for line in lines if "contrastive" in line]
    assert losses[-1] < 0.92 * losses[0]
    assert task.figures["r-at-1"] >= 2 * task.figures["chance-r-at-1"]
    assert task.figures["median-rank"] < task.figures["chance-median-rank"]

    space = SharedSpace.from_pretrained(tmp_path)
    assert space.card.trained and space.card.data == task.identity["data-hash"]
    assert space.card.max_seconds == 2.0
    motion = task.train.embed_bodies(space.embed_motion)
    assert torch.allclose(motion, task.motion, atol=1e-5), "the motion tower is as it was"
    sound = task.train.embed_sounds(space.embed_audio)
    assert (sound * motion).sum(1).mean() > (sound @ motion.T).mean()


def test_resuming_is_bitwise_the_same(phrases: Path, clip: Path, tmp_path: Path) -> None:
    def settings(output: str, *more: str) -> TrainAudioTowerConfig:
        return config(phrases, clip, tmp_path / output, "lr-schedule=constant", *more)

    train(settings("whole", "validate-every=3"))  # to look changes nothing
    train(settings("halves", "steps=4"))
    train(settings("halves"), resume=True)
    assert_equal_runs(tmp_path / "whole", tmp_path / "halves")


def test_batches_are_windows_of_phrases_with_their_motion(
    phrases: Path, clip: Path, tmp_path: Path
) -> None:
    task = AudioTowerTask(config(phrases, clip, tmp_path, "windows=3"), load_network("lightweight"))
    batch = task.batch(Part(step=5, index=0, count=1))
    again = task.batch(Part(step=5, index=0, count=1))
    other = task.batch(Part(step=6, index=0, count=1))
    assert torch.equal(batch.audio, again.audio) and not torch.equal(batch.motion, other.motion)
    assert batch.audio.shape[:2] == (12, 167) and batch.motion.shape == (12, 32)
    assert batch.phrase.view(4, 3).unique(dim=1).shape == (4, 1), "three windows of each"
    assert torch.equal(batch.audio * batch.mask[:, None], batch.audio)
    records = task.train.records
    songs = [records[phrase].song for phrase in batch.phrase.tolist()]
    expected = torch.tensor([[a == b for b in songs] for a in songs])
    assert torch.equal(kin(batch.song, batch.clips), expected)


def test_kin_share_a_song_or_a_clip() -> None:
    clips = torch.tensor([[0, 1], [1, 2], [3, -1], [4, -1]])
    found = kin(torch.tensor([0, 1, 2, 2]), clips)
    assert found.int().tolist() == [[1, 1, 0, 0], [1, 1, 0, 0], [0, 0, 1, 1], [0, 0, 1, 1]]


def test_folders_without_bodies_are_refused(circles: Path, clip: Path, tmp_path: Path) -> None:
    with pytest.raises(UserError, match="trajectories without bodies"):
        train(config(circles, clip, tmp_path))
