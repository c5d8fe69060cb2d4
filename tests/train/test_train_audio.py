"""Audio training on a little data: it learns, resumes exactly, leaves a folder that sings."""

import json
from pathlib import Path

import pytest
import torch
from safetensors.torch import load_file
from tiny_audio_stage import (
    NETWORK,
    PREFIX,
    SETTINGS,
    STEPS,
    assert_close_runs,
    assert_equal_runs,
    audio_config,
    launch_two,
    tensors,
    tiny_audio_network,
    train_audio,
)

from src.shared.config_audio import TrainAudioConfig
from src.shared.errors import UsageError, UserError
from src.shared.model.audio.audio_motion_model import AudioMotionModel
from src.shared.model.diffusion import GaussianDiffusion
from src.shared.motion.trajectory import STYLE
from src.shared.pipelines.song_sampler import SongSampler, SongSampling
from src.train.engine import learning_rate_factor
from src.train.task import Part
from src.train.train_audio import AudioBatch, AudioTask, audio_losses


def test_it_learns_and_leaves_a_folder(circles: Path, tmp_path: Path) -> None:
    task = train_audio(
        audio_config(
            circles,
            tmp_path,
            *("steps=40", "learning-rate=0.002", "ema-decay=0.9", "log-every=40"),
            "validate-first=true",
        )
    )
    lines = [json.loads(line) for line in (tmp_path / "log.jsonl").read_text().splitlines()]
    losses = [line["validation/loss"] for line in lines if "validation/loss" in line]
    assert losses[-1] < 0.85 * losses[0]
    assert {"loss-low", "loss-middle", "loss-high", "velocity"} <= task.figures.keys()
    assert (tmp_path / "samples" / "00000040" / "held-back.png").exists()

    model = AudioMotionModel.from_pretrained(tmp_path)
    assert model.card.trained and model.card.data == task.train.fingerprint
    assert torch.equal(model.mean, task.model.mean)
    settings = SongSampling(window=32, overlap=8)
    made = SongSampler(model, settings).sample(torch.rand(167, 70))[0]
    assert made.data.shape == (70, 25)


def test_it_goes_on_from_trained_weights_and_their_z_scores(circles: Path, tmp_path: Path) -> None:
    train_audio(audio_config(circles, tmp_path / "first", "steps=3"))
    first = AudioMotionModel.from_pretrained(tmp_path / "first")
    config = audio_config(circles, tmp_path / "second", "steps=3", f"init='{tmp_path / 'first'}'")
    network = tiny_audio_network()
    task = AudioTask(config, network)
    for name, value in first.state_dict().items():
        assert torch.equal(value, task.model.state_dict()[name])
    other = network.model_copy(
        update={"unet": network.unet.model_copy(update={"channel_mult": (1, 2, 3)})}
    )
    with pytest.raises(UsageError, match="is another network than profile"):
        AudioTask(config, other)


def test_resuming_is_bitwise_the_same(circles: Path, tmp_path: Path) -> None:
    def config(output: str, *more: str) -> TrainAudioConfig:
        return audio_config(circles, tmp_path / output, "lr-schedule=constant", *more)

    train_audio(config("whole", "validate-every=3"))  # to look changes nothing
    train_audio(config("halves", "steps=4"))
    train_audio(config("halves"), resume=True)
    assert_equal_runs(tmp_path / "whole", tmp_path / "halves")


def test_the_folder_holds_the_averaged_weights(circles: Path, tmp_path: Path) -> None:
    train_audio(audio_config(circles, tmp_path, "steps=2", "learning-rate=0.1"))
    saved, average = load_file(tmp_path / "model.safetensors"), tensors(tmp_path, "ema")
    assert all(torch.equal(saved[f"model.unet.{key}"], average[key]) for key in average)
    last = tensors(tmp_path, "model")
    assert not all(torch.equal(last[key], average[key]) for key in average)


@pytest.mark.parametrize("schedule", ["cosine", "linear", "constant"])
def test_learning_rate_schedules(circles: Path, tmp_path: Path, schedule: str) -> None:
    settings = ("steps=5", "log-every=1", "save-every=100", "batch-size=1")
    train_audio(audio_config(circles, tmp_path, f"lr-schedule={schedule}", *settings))
    lines = [json.loads(line) for line in (tmp_path / "log.jsonl").read_text().splitlines()]
    rates = [line["learning-rate"] for line in lines if "learning-rate" in line]
    factors = [learning_rate_factor(s, steps=5, warmup=2, schedule=schedule) for s in range(5)]
    assert rates == pytest.approx([5e-4 * factor for factor in factors], rel=1e-4)


@pytest.mark.slow
def test_two_processes_equal_one(circles: Path, tmp_path: Path) -> None:
    settings = [*NETWORK, *SETTINGS, *STEPS, *PREFIX, "network.unet.dropout=0", "steps=3"]
    places = ["--data", circles, "--output", tmp_path / "two"]
    launch_two("src.train.train_audio", *settings, *places)
    # the same parts of each batch, one after the other
    config = audio_config(circles, tmp_path / "one", "gradient-accumulation=2", "steps=3")
    from src.train.engine import Trainer

    network = tiny_audio_network("network.unet.dropout=0")
    Trainer(config, lambda c: AudioTask(c, network), command="again").train()
    assert_close_runs(tmp_path / "two", tmp_path / "one")


def test_batches_are_a_function_of_their_part(circles: Path, tmp_path: Path) -> None:
    task = AudioTask(audio_config(circles, tmp_path), tiny_audio_network())
    first, again, other = (task.batch(Part(3, index, 2)) for index in (0, 0, 1))
    for name, value in vars(first).items():
        same = value is None or torch.equal(value, getattr(again, name))
        assert same, name
    assert not torch.equal(first.clean, other.clean)
    assert not torch.equal(first.noise, other.noise)


def test_what_is_known(circles: Path, tmp_path: Path) -> None:
    both = ("prefix-share=1", "style-share=1", "batch-size=8")
    task = AudioTask(audio_config(circles, tmp_path, *both), tiny_audio_network())
    known = task.batch(Part(1, 0, 1)).known
    assert known[:, STYLE].all()
    lengths = known[:, 0].sum(dim=1)
    assert lengths.min() >= 8 and lengths.max() <= 12
    assert all(row[:length].all() for row, length in zip(known[:, 0], lengths, strict=True))

    nothing = ("prefix-share=0", "style-share=0")
    task = AudioTask(audio_config(circles, tmp_path, *nothing), tiny_audio_network())
    assert not task.batch(Part(1, 0, 1)).known.any()


class Constant(torch.nn.Module):
    """Says the same whatever it hears, and keeps what it was shown."""

    def __init__(self, output: torch.Tensor) -> None:
        super().__init__()
        self.output = torch.nn.Parameter(output)

    def forward(self, noisy: torch.Tensor, *_: torch.Tensor) -> torch.Tensor:
        self.seen = noisy
        return self.output


def test_known_entries_are_shown_clean_and_get_no_loss() -> None:
    draws = torch.Generator().manual_seed(0)
    clean, noise, output = torch.randn(3, 2, 25, 16, generator=draws)
    known = torch.rand(clean.shape, generator=draws) < 0.5
    mask = torch.ones(2, 16, dtype=torch.bool)
    mask[1, 12:] = False
    diffusion = GaussianDiffusion(tiny_audio_network().diffusion)
    batch = AudioBatch(
        clean,
        noise,
        known,
        mask,
        torch.zeros(2, 167, 16),
        torch.zeros(2, dtype=torch.bool),
        torch.tensor([3, 40]),
    )
    module = Constant(output)
    losses = audio_losses(module, batch, diffusion, torch.ones(25), velocity_weight=0.5)
    losses["loss"].backward()
    assert torch.equal(module.seen[known], clean[known])
    gradient = module.output.grad
    assert gradient is not None
    assert not gradient[known].any() and not gradient[1, :, 12:].any()
    assert gradient[~known & mask[:, None]].abs().min() > 0
    expected = losses["diffusion"] + 0.5 * losses["velocity"]
    torch.testing.assert_close(losses["loss"], expected)


def test_missing_data(tmp_path: Path) -> None:
    with pytest.raises(UserError, match="nowhere"):
        AudioTask(audio_config(tmp_path / "nowhere", tmp_path), tiny_audio_network())
