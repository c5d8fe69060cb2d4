"""CLIP pretraining on a little data: it learns, resumes exactly, leaves a loadable folder."""

import json
import os
import socket
from pathlib import Path

import pytest
import torch
from safetensors.torch import load_file
from tiny_stage import clip_config, tiny_network, train_clip
from torch import Tensor

from src.shared.config_schema import TrainClipConfig
from src.shared.data.prepared import PreparedData
from src.shared.data.text_motion import TextMotionDataset
from src.shared.errors import UsageError, UserError
from src.shared.model.clip.core import clip_loss
from src.shared.model.clip.pretrained import ClipBundle
from src.train import train_clip as train_clip_stage
from src.train.text_stages import split_set
from src.train.train_clip import ClipTask, gather


@pytest.mark.usefixtures("held_back")
def test_it_learns_and_leaves_a_folder(prepared: Path, tmp_path: Path) -> None:
    settings = ("steps=100", "batch-size=16", "learning-rate=0.005", "log-every=10")
    task = train_clip(clip_config(prepared, tmp_path, *settings, "cosine-weight=0"))
    lines = [json.loads(line) for line in (tmp_path / "log.jsonl").read_text().splitlines()]
    losses = [line["loss"] for line in lines if "loss" in line]
    assert losses[-1] < losses[0] - 0.1
    figures = task.figures
    assert 0 < figures["chance-at-1"] < figures["chance-at-3"] < 1
    assert figures["r-at-3"] > figures["chance-at-3"]

    bundle = ClipBundle.from_pretrained(tmp_path)
    assert bundle.card.trained and bundle.card.data == task.data.manifest_hash
    ids, mask = bundle.tokenizer(["a person walks forward", "una persona salta"])
    assert not torch.equal(ids[0], ids[1])
    assert bundle.clip.encode_text(ids, mask).shape == (2, 32)
    assert torch.equal(bundle.mean, task.data.mean)


def test_two_held_back_clips_give_no_retrieval_figure(
    prepared: Path,
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    capfd: pytest.CaptureFixture[str],
) -> None:
    """One of two is found by anyone: `r-at-1 1` would say nothing."""

    def two(config: TrainClipConfig, data: PreparedData) -> TextMotionDataset:
        found = split_set(config, data, "train")
        found.records = found.records[:2]
        return found

    monkeypatch.setattr(train_clip_stage, "validation_set", two)
    task = train_clip(clip_config(prepared, tmp_path, "steps=2"))
    assert list(task.figures) == ["loss"]
    told = capfd.readouterr().err
    assert "2 clips are held back and R@k needs 32" in told and "r-at-1" not in told


def test_resuming_is_bitwise_the_same(prepared: Path, tmp_path: Path) -> None:
    constant = "lr-schedule=constant"
    train_clip(clip_config(prepared, tmp_path / "whole", constant))
    train_clip(clip_config(prepared, tmp_path / "halves", constant, "steps=4"))
    train_clip(clip_config(prepared, tmp_path / "halves", constant), resume=True)
    for name in ("model", "ema", "optimizer"):
        file = f"checkpoints/step-00000006/{name}.safetensors"
        whole, halves = load_file(tmp_path / "whole" / file), load_file(tmp_path / "halves" / file)
        assert all(torch.equal(whole[key], halves[key]) for key in whole)


def test_without_a_root_track(prepared: Path, tmp_path: Path) -> None:
    network = tiny_network("root-track=false")
    train_clip(clip_config(prepared, tmp_path, "steps=2"), network)
    assert ClipBundle.from_pretrained(tmp_path).mean.shape == (22, 6)


def test_batches_are_a_function_of_their_part(prepared: Path, tmp_path: Path) -> None:
    from src.train.task import Part

    task = ClipTask(clip_config(prepared, tmp_path, "word-dropout=0.5"), tiny_network())
    first, again = task.batch(Part(3, 0, 2)), task.batch(Part(3, 0, 2))
    other = task.batch(Part(3, 1, 2))
    assert torch.equal(first.input_ids, again.input_ids)
    assert torch.equal(first.motion, again.motion)
    assert not torch.equal(first.groups, other.groups)


def test_wrong_number_of_bones(prepared: Path, tmp_path: Path) -> None:
    with pytest.raises(UsageError, match=r"num-bones 24 .* 22"):
        ClipTask(clip_config(prepared, tmp_path), tiny_network("generation.num-bones=24"))


def test_no_usable_clip(prepared: Path, tmp_path: Path) -> None:
    config = clip_config(prepared, tmp_path, "min-frames=5000", "max-frames=5000")
    with pytest.raises(UserError, match=r"5000 frames.*min-frames"):
        ClipTask(config, tiny_network())


def test_missing_data_folder(tmp_path: Path) -> None:
    with pytest.raises(UserError, match="manifest"):
        ClipTask(clip_config(tmp_path / "nowhere", tmp_path / "out"), tiny_network())


def _pairs() -> tuple[Tensor, Tensor, Tensor]:
    draws = torch.Generator().manual_seed(0)
    text, motion = torch.randn(2, 8, 4, generator=draws)
    return text, motion, torch.tensor([0, 1, 2, 0, 3, 4, 4, 5])


def _loss(text: Tensor, motion: Tensor, groups: Tensor) -> Tensor:
    scale = torch.tensor(5.0)
    return clip_loss(text, motion, groups, scale, cosine_weight=0.2)["loss"]


def _worker(rank: int, port: int, folder: str) -> None:
    os.environ.update(MASTER_ADDR="127.0.0.1", MASTER_PORT=str(port))
    torch.distributed.init_process_group("gloo", rank=rank, world_size=2)
    text, motion, groups = (values[4 * rank : 4 * rank + 4] for values in _pairs())
    weight = torch.nn.Parameter(torch.eye(4))  # a shared weight, averaged as DDP would
    _loss(gather(text @ weight), gather(motion), gather(groups)).backward()
    assert weight.grad is not None
    torch.distributed.all_reduce(weight.grad)
    torch.save(weight.grad / 2, f"{folder}/{rank}.pt")
    torch.distributed.destroy_process_group()


@pytest.mark.slow
def test_two_processes_have_the_gradient_of_one(tmp_path: Path) -> None:
    with socket.socket() as probe:
        probe.bind(("127.0.0.1", 0))
        port = int(probe.getsockname()[1])
    torch.multiprocessing.spawn(_worker, (port, str(tmp_path)), nprocs=2)
    text, motion, groups = _pairs()
    weight = torch.nn.Parameter(torch.eye(4))
    _loss(text @ weight, motion, groups).backward()
    for rank in range(2):
        torch.testing.assert_close(torch.load(tmp_path / f"{rank}.pt"), weight.grad)


def test_streamed_shards_train_and_go_on(prepared: Path, tmp_path: Path) -> None:
    settings = ("steps=4", "save-every=2", "stream=true", "lr-schedule=constant")
    train_clip(clip_config(prepared, tmp_path / "whole", *settings))
    train_clip(clip_config(prepared, tmp_path / "halves", *settings, "steps=2"))
    train_clip(clip_config(prepared, tmp_path / "halves", *settings), resume=True)
    whole, halves = (
        load_file(tmp_path / name / "checkpoints" / "step-00000004" / "model.safetensors")
        for name in ("whole", "halves")
    )
    assert all(torch.equal(whole[key], halves[key]) for key in whole)
