"""Decoder training: noise of the right size, better than no decoder, a folder that loads."""

import json
import math
from pathlib import Path

import numpy as np
import pytest
import torch
from hypothesis import given, settings
from hypothesis import strategies as st
from tiny_audio_stage import (
    SETTINGS,
    STEPS,
    assert_close_runs,
    assert_equal_runs,
    audio_config,
    launch_two,
    train_audio,
)
from typer.testing import CliRunner

from src.shared.config_audio import TrainDecoderConfig
from src.shared.config_loader import load_train
from src.shared.data.phrases.dataset import MotionPhraseDataset
from src.shared.errors import UsageError, UserError
from src.shared.model.audio.audio_motion_model import AudioMotionModel
from src.shared.model.audio.decoder import DerivedMotionDecoder, MotionDecoder
from src.shared.motion.trajectory import PHASE
from src.train.audio_stages import bar_phase_at_start, network_of, true_trajectory, whole_windows
from src.train.engine import Trainer
from src.train.launch import STAGES
from src.train.task import Part, generator
from src.train.train_decoder import DecoderTask, denoiser_error, log_uniform, time_noise

RESIDUAL = "network.decoder.decoder=residual"


@pytest.fixture(scope="module")
def audio(circles: Path, tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A short train_audio run."""
    folder = tmp_path_factory.mktemp("audio") / "run"
    train_audio(audio_config(circles, folder, "steps=10", "learning-rate=0.002"))
    return folder


def decoder_config(data: Path, audio: Path, output: Path, *overrides: str) -> TrainDecoderConfig:
    places = [f"data='{data}'", f"audio='{audio}'", f"output='{output}'"]
    return load_train(None, TrainDecoderConfig, [*SETTINGS, *STEPS, *places, *overrides])


def train_decoder(config: TrainDecoderConfig, *network: str, resume: bool = False) -> DecoderTask:
    found = network_of(config.audio, network)
    trainer = Trainer(config, lambda c: DecoderTask(c, found), command="again", resume=resume)
    trainer.train()
    assert isinstance(trainer.task, DecoderTask)
    return trainer.task


@pytest.mark.parametrize("kind", ["residual", "derived"])
def test_it_is_better_than_no_decoder(
    circles: Path, audio: Path, tmp_path: Path, kind: str
) -> None:
    learning = ("steps=60", "learning-rate=0.002", "ema-decay=0.9", "noise=[0.5,1.0]")
    config = decoder_config(circles, audio, tmp_path, *learning, "validate-first=true")
    task = train_decoder(config, f"network.decoder.decoder={kind}")
    lines = [json.loads(line) for line in (tmp_path / "log.jsonl").read_text().splitlines()]
    first, last = (line for line in lines if "validation/loss" in line)
    assert first["validation/loss"] == first["validation/untrained-loss"]
    assert last["validation/loss"] < 0.9 * last["validation/untrained-loss"]
    assert last["validation/untrained-loss"] == first["validation/untrained-loss"]

    before, after = (
        AudioMotionModel.from_pretrained(audio),
        AudioMotionModel.from_pretrained(tmp_path),
    )
    assert isinstance(after.decoder, MotionDecoder if kind == "residual" else DerivedMotionDecoder)
    weights = after.unet.state_dict()
    assert all(torch.equal(weights[key], value) for key, value in before.unet.state_dict().items())
    assert torch.equal(before.std, after.std)
    assert after.decoder.position_head.weight.any()
    assert after.card.training["decoder"]["validation"] == task.figures
    assert after.card.training["steps"] == 10  # of the audio run


def test_a_decoder_that_does_harm_is_not_kept(
    circles: Path, audio: Path, tmp_path: Path, capfd: pytest.CaptureFixture[str]
) -> None:
    harmful = decoder_config(circles, audio, tmp_path, "learning-rate=1", "gradient-clip=1000")
    task = train_decoder(harmful, RESIDUAL)
    assert task.figures["loss"] > task.figures["untrained-loss"]
    assert "untrained" in capfd.readouterr().err
    decoder = AudioMotionModel.from_pretrained(tmp_path).decoder
    assert isinstance(decoder, MotionDecoder) and not decoder.velocity_head.weight.any()


def test_resuming_is_bitwise_the_same(circles: Path, audio: Path, tmp_path: Path) -> None:
    def config(name: str, *more: str) -> TrainDecoderConfig:
        constant = "lr-schedule=constant"
        return decoder_config(circles, audio, tmp_path / name, constant, *more)

    train_decoder(config("whole"), RESIDUAL)
    train_decoder(config("halves", "steps=4"), RESIDUAL)
    train_decoder(config("halves"), RESIDUAL, resume=True)
    assert_equal_runs(tmp_path / "whole", tmp_path / "halves")


@pytest.mark.slow
def test_two_processes_equal_one(circles: Path, audio: Path, tmp_path: Path) -> None:
    places = ["--data", circles, "--audio", audio, "--output", tmp_path / "two"]
    launch_two("src.train.train_decoder", *SETTINGS, *STEPS, *places)
    train_decoder(decoder_config(circles, audio, tmp_path / "one", "gradient-accumulation=2"))
    assert_close_runs(tmp_path / "two", tmp_path / "one")


# ------------------------------------------------------------ noise


@settings(max_examples=15)
@given(width=st.floats(1, 20), share=st.floats(0, 1), frames=st.sampled_from([63, 64, 120]))
def test_noise_has_unit_variance(width: float, share: float, frames: int) -> None:
    size, num = (4, 400, frames), 4
    widths, shares = torch.full((num,), width), torch.full((num,), share)
    noise = time_noise(size, widths, shares, torch.Generator().manual_seed(0))
    assert noise.shape == size
    assert noise.square().mean().item() == pytest.approx(1, abs=0.1)


def test_correlated_noise_follows_its_kernel() -> None:
    """A Gaussian kernel of deviation w gives the autocorrelation exp(-d²/4w²)."""
    draws = torch.Generator().manual_seed(0)
    noise = time_noise((1, 4000, 128), torch.tensor([3.0]), torch.ones(1), draws)
    for lag in (1, 3, 6):
        found = (noise[..., lag:] * noise[..., :-lag]).mean().item()
        assert found == pytest.approx(math.exp(-(lag**2) / 36), abs=0.02)
    white = time_noise((1, 4000, 128), torch.tensor([3.0]), torch.zeros(1), draws)
    assert abs((white[..., 1:] * white[..., :-1]).mean().item()) < 0.01


def test_log_uniform_numbers() -> None:
    found = log_uniform((0.01, 1.0), 4000, torch.Generator().manual_seed(0)).log10()
    assert found.min() >= -2 and found.max() <= 0
    assert np.allclose(np.quantile(found, [0.25, 0.5, 0.75]), [-1.5, -1, -0.5], atol=0.06)


def test_the_noise_is_that_of_the_denoiser(circles: Path, audio: Path, tmp_path: Path) -> None:
    """A UNet that outputs nothing errs by the data's own spread, one sigma a row."""
    model = AudioMotionModel.from_pretrained(audio)
    torch.nn.init.zeros_(model.unet.output_conv.weight)
    torch.nn.init.zeros_(model.unet.output_conv.bias)
    phrases = MotionPhraseDataset(circles, target_frames=32, split="train").batch(1, 9)
    error = denoiser_error(model, [phrases])
    expected = model.normalise(phrases.motion).square().mean(dim=(0, 2)).sqrt()
    torch.testing.assert_close(error, expected)

    task = DecoderTask(decoder_config(circles, audio, tmp_path), network_of(audio))
    noisy = task._drawn(phrases, generator(0))
    offset = (noisy.rows.transpose(1, 2) - phrases.motion) / task.model.std[:, None]
    largest = offset.square().mean(dim=2).sqrt() / task.error
    assert 0.01 < largest.nanmedian() < 1  # rows that are constant have no error
    clean = task._drawn(phrases, generator(0), clean=True)
    assert torch.equal(clean.rows.transpose(1, 2), phrases.motion)


# ------------------------------------------------------------ windows


def test_true_trajectories_are_those_of_the_phrases(circles: Path) -> None:
    dataset = MotionPhraseDataset(circles, target_frames=60, split="train")
    phrases = dataset.batch(1, 4)
    start, known = bar_phase_at_start(phrases.audio)
    assert known.all()
    found = true_trajectory(phrases.motion, start)
    for row, record in zip(found, phrases.records, strict=True):
        real = np.load(circles / record.motion.path)
        gap = (row[:, PHASE].numpy() - real[:, PHASE] + 0.5) % 1 - 0.5
        assert np.abs(gap).max() < 1e-4
        assert np.allclose(row[:, 1], real[:, 1], atol=1e-5)  # heights are not local
    start, known = bar_phase_at_start(phrases.audio[:, :163])
    assert not known.any() and not start.any()


def test_short_phrases_cut_the_batch(circles: Path) -> None:
    phrases = MotionPhraseDataset(circles, target_frames=90, split="train").batch(1, 4)
    assert phrases.motion.shape[2] == 90
    whole = whole_windows(phrases)
    assert whole.motion.shape[2] == whole.audio.shape[2] == 60 and whole.mask.all()


# ------------------------------------------------------------ mistakes


def test_only_the_decoder_can_change(audio: Path, tmp_path: Path) -> None:
    with pytest.raises(UsageError, match=r"network\.unet\.dropout=0.*only network\.decoder"):
        network_of(audio, ["network.unet.dropout=0"])
    with pytest.raises(UsageError, match="hidden-dim"):
        network_of(audio, ["network.decoder.hiden-dim=4"])
    with pytest.raises(UserError, match="nowhere"):
        network_of(tmp_path / "nowhere")


def test_limits_are_two_numbers_in_order(circles: Path, audio: Path, tmp_path: Path) -> None:
    for wrong in ("noise=[0,1]", "correlation=[3,2]"):
        with pytest.raises(UsageError, match=wrong.split("=")[0]):
            decoder_config(circles, audio, tmp_path, wrong)


def test_a_run_from_the_command_line(circles: Path, audio: Path, tmp_path: Path) -> None:
    places = ["--data", str(circles), "--audio", str(audio), "--output", str(tmp_path)]
    done = CliRunner().invoke(STAGES["decoder"].app(), [*SETTINGS, *STEPS, *places, "steps=1"])
    assert done.exit_code == 0, done.output
    assert (tmp_path / "model.safetensors").exists()
    again = CliRunner().invoke(STAGES["decoder"].app(), [*SETTINGS, *STEPS, *places, "steps=1"])
    assert again.exit_code == 2 and "--resume" in again.output


def test_batches_are_a_function_of_their_part(circles: Path, audio: Path, tmp_path: Path) -> None:
    task = DecoderTask(decoder_config(circles, audio, tmp_path), network_of(audio))
    first, again, other = (task.batch(Part(3, index, 2)) for index in (0, 0, 1))
    for name, value in vars(first).items():
        assert torch.equal(value, getattr(again, name)), name
    assert not torch.equal(first.rows, other.rows)
