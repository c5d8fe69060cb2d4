"""Memory training: what was there rests, the memory part learns, the own song is never found."""

import json
from pathlib import Path

import pytest
import torch
from safetensors.torch import load_file
from tiny_audio_stage import PREFIX, SETTINGS, STEPS, assert_equal_runs, audio_config, train_audio

from src.shared.config_audio import TrainMemoryConfig
from src.shared.config_loader import load_train
from src.shared.data.phrases.dataset import MotionPhraseDataset
from src.shared.errors import UsageError, UserError
from src.shared.memory.index import MemoryIndex
from src.shared.memory.query import retrieve
from src.shared.model.audio.audio_motion_model import AudioMotionModel
from src.shared.motion.trajectory import PHASE
from src.shared.pipelines.song_memory import bars_of_sound
from src.train.audio_stages import network_of
from src.train.engine import Trainer
from src.train.task import Part
from src.train.train_memory import MemoryTask
from tests.shared.memory.tiny_memory import make_phrase
from tests.shared.pipelines.tiny_recall import save_space

SMALL = ["part.width=16", "part.num-heads=2", "part.num-layers=1", "memory.top-k=2"]


@pytest.fixture(scope="module")
def audio(circles: Path, tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A short train_audio run."""
    folder = tmp_path_factory.mktemp("audio") / "run"
    train_audio(audio_config(circles, folder, "steps=10", "learning-rate=0.002"))
    return folder


@pytest.fixture(scope="module")
def memory(circles: Path, tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Random phrases of the songs of the data; a phrase's song is its own name here."""
    folder = tmp_path_factory.mktemp("memory")
    space = save_space(folder / "space")
    names = MotionPhraseDataset(circles).phrase_ids
    phrases = [make_phrase(number, space.embed_dim, song=name) for number, name in enumerate(names)]
    about = {"space": space.fingerprint, "space_name": str(folder / "space"), "bars": 2}
    MemoryIndex.from_phrases(phrases, **about).save(folder / "index")
    return folder / "index"


def memory_config(
    data: Path, audio: Path, memory: Path, output: Path, *overrides: str
) -> TrainMemoryConfig:
    places = [f"data='{data}'", f"audio='{audio}'", f"output='{output}'"]
    places.append(f"memory.folder='{memory}'")
    given = [*SETTINGS, *STEPS, *PREFIX, *SMALL, *places, *overrides]
    return load_train(None, TrainMemoryConfig, given)


def train_memory(config: TrainMemoryConfig, *, resume: bool = False) -> MemoryTask:
    network = network_of(config.audio)
    trainer = Trainer(config, lambda c: MemoryTask(c, network), command="again", resume=resume)
    trainer.train()
    assert isinstance(trainer.task, MemoryTask)
    return trainer.task


def weights(folder: Path) -> dict[str, torch.Tensor]:
    return load_file(folder / "model.safetensors")


def test_the_memory_part_learns_and_the_rest_rests(
    circles: Path, audio: Path, memory: Path, tmp_path: Path
) -> None:
    learning = ("steps=12", "learning-rate=0.01", "ema-decay=0.5", "validate-first=true")
    task = train_memory(memory_config(circles, audio, memory, tmp_path, *learning))
    before, after = weights(audio), weights(tmp_path)
    assert all(torch.equal(after[name], tensor) for name, tensor in before.items())
    assert all(name.startswith("model.unet.memory.") for name in after.keys() - before.keys())
    assert after["model.unet.memory.to_time.weight"].any()

    lines = [json.loads(line) for line in (tmp_path / "log.jsonl").read_text().splitlines()]
    first, last = (line for line in lines if "validation/loss" in line)
    assert first["validation/loss"] == first["validation/without-loss"], "silent at the start"
    assert last["validation/without-loss"] == first["validation/without-loss"]
    assert last["validation/loss"] != last["validation/without-loss"]
    assert (tmp_path / "samples" / "00000012" / "held-back.png").exists()

    model = AudioMotionModel.from_pretrained(tmp_path)
    assert model.config.unet.memory == task.config.part
    assert model.card.trained and model.card.training["memory"]["steps"] == 12


def test_what_was_there_may_learn_too(
    circles: Path, audio: Path, memory: Path, tmp_path: Path
) -> None:
    slow = ("steps=2", "base-learning-rate=0.001", "learning-rate=0.01")
    task = train_memory(memory_config(circles, audio, memory, tmp_path, *slow))
    before, after = weights(audio), weights(tmp_path)
    assert not torch.equal(before["model.unet.input_conv.weight"],
                           after["model.unet.input_conv.weight"])  # fmt: skip
    assert task.learning_rates == {"memory.": 0.01, "": 0.001}


def test_resuming_is_bitwise_the_same(
    circles: Path, audio: Path, memory: Path, tmp_path: Path
) -> None:
    def config(output: str, *more: str) -> TrainMemoryConfig:
        constant = "lr-schedule=constant"
        return memory_config(circles, audio, memory, tmp_path / output, constant, *more)

    train_memory(config("whole"))
    train_memory(config("halves", "steps=4"))
    train_memory(config("halves"), resume=True)
    assert_equal_runs(tmp_path / "whole", tmp_path / "halves")


@pytest.fixture(scope="module")
def task(circles: Path, audio: Path, memory: Path) -> MemoryTask:
    config = memory_config(circles, audio, memory, Path("unused"), "memory-dropout=0.5")
    return MemoryTask(config, network_of(audio))


def test_a_phrase_never_finds_its_own_song(task: MemoryTask) -> None:
    phrases = task.train.batch(1, 6)
    found = task.recall(phrases)
    query = task.space.embed_audio(phrases.audio, phrases.mask).detach()
    options = {"num_frames": 32, "phase": bars_of_sound(phrases.audio)}
    own = [{record.id} for record in phrases.records]
    apart = retrieve(task.index, query, task.config.memory, exclude_songs=own, **options)
    torch.testing.assert_close(found.context, apart.context)
    assert apart.hits is not None
    for songs, hits in zip(own, apart.hits.index.tolist(), strict=True):
        assert songs.isdisjoint(task.index.song_of(n) for n in hits)
    assert found.priors.shape == (6, 4, 32)


def test_nor_a_song_that_shares_a_clip(task: MemoryTask) -> None:
    record = task.train.phrases[0].model_copy(update={"clips": ("clip-3", "clip-5", "elsewhere")})
    third, fifth = (task.index.song_of(number) for number in (3, 5))
    assert task.excluded(record) == {record.id, third, fifth}


def test_batches_drop_memories_and_know_what_leads_in(task: MemoryTask) -> None:
    batches = [task.batch(Part(step, 0, 1)) for step in range(1, 9)]
    memories = [batch.memory for batch in batches]
    forgotten = torch.cat([memory.confidence == 0 for memory in memories])
    assert 0.2 < forgotten.float().mean() < 0.8
    for batch in batches:
        whole = batch.known.all(dim=1)  # [B,T]
        recent = batch.memory.recent
        torch.testing.assert_close(recent, batch.clean * whole[:, None])
    again = task.batch(Part(3, 0, 1))
    assert torch.equal(again.memory.confidence, memories[2].confidence)


def test_bars_come_from_the_rows_of_sound(task: MemoryTask) -> None:
    phrases = task.train.batch(1, 3)
    bars = bars_of_sound(phrases.audio)
    increments = phrases.motion[:, PHASE, :-1].double()
    torch.testing.assert_close(bars.diff(dim=1), increments, atol=1e-4, rtol=0)
    assert not bars_of_sound(phrases.audio[:, :163]).any()


def test_what_does_not_fit_is_refused(
    circles: Path, audio: Path, memory: Path, tmp_path: Path
) -> None:
    def build(*overrides: str) -> None:
        MemoryTask(memory_config(circles, audio, memory, tmp_path, *overrides), network_of(audio))

    with pytest.raises(UsageError, match="target-frames 40"):
        build("target-frames=40")
    save_space(tmp_path / "other", seed=1)
    with pytest.raises(UserError, match="another shared space"):
        build(f"space='{tmp_path / 'other'}'")
