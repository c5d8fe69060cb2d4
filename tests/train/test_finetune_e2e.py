"""End-to-end fine-tuning: what each loss sees, two learning rates, patience, the results."""

import json
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

import pytest
import torch
from safetensors.torch import load_file
from tiny_audio_stage import (
    NETWORK,
    PREFIX,
    SETTINGS,
    assert_close_runs,
    assert_equal_runs,
    audio_config,
    launch_two,
    tiny_audio_network,
    train_audio,
)
from typer.testing import CliRunner

from src.shared.config_audio import FinetuneE2eConfig
from src.shared.config_loader import load_train
from src.shared.errors import UsageError
from src.shared.model.audio.audio_motion_model import AudioMotionModel
from src.shared.model.audio.decoder import (
    DerivedMotionDecoder,
    MotionDecoder,
    create_motion_decoder,
)
from src.train.audio_stages import network_of
from src.train.engine import Trainer
from src.train.finetune_e2e import E2eObjective, FinetuneE2eTask, in_steps, mean_speed
from src.train.launch import STAGES
from src.train.run_log import Epoch, best_epoch, read_epochs, results_table
from src.train.task import Part

QUIET = [*SETTINGS, *PREFIX, "ddim-steps=2", "warmup-steps=1"]


@pytest.fixture(scope="module")
def checkpoint(circles: Path, tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A model that walks in circles, and a residual decoder that spoils its velocities."""
    folder = tmp_path_factory.mktemp("e2e")
    learning = ("steps=80", "learning-rate=0.005", "ema-decay=0.9", "batch-size=8")
    train_audio(audio_config(circles, folder / "audio", *learning))
    model = AudioMotionModel.from_pretrained(folder / "audio")
    torch.manual_seed(0)
    residual = network_of(folder / "audio", ["network.decoder.decoder=residual"]).decoder
    model.replace_decoder(create_motion_decoder(residual))
    assert isinstance(model.decoder, MotionDecoder)
    torch.nn.init.normal_(model.decoder.velocity_head.weight, std=0.1)
    torch.nn.init.normal_(model.decoder.acceleration_head.weight, std=1.0)
    model.save_pretrained(folder / "checkpoint")
    return folder / "checkpoint"


Settings = Callable[..., FinetuneE2eConfig]


@pytest.fixture
def settings(circles: Path, checkpoint: Path, tmp_path: Path) -> Settings:
    """Makes a configuration; 9 phrases in batches of 4 are 3 steps an epoch."""

    def make(*overrides: str, output: str = "run") -> FinetuneE2eConfig:
        places = [f"data='{circles}'", f"checkpoint='{checkpoint}'"]
        places += [f"output='{tmp_path / output}'"]
        config = load_train(None, FinetuneE2eConfig, [*QUIET, *places, *overrides])
        return in_steps(config)

    return make


def trainer(config: FinetuneE2eConfig, *, resume: bool = False) -> Trainer[FinetuneE2eConfig]:
    network = network_of(config.checkpoint)
    return Trainer(config, lambda c: FinetuneE2eTask(c, network), command="again", resume=resume)


# ------------------------------------------------------------ runs


def test_it_becomes_coherent_and_keeps_moving(settings: Settings) -> None:
    config = settings("epochs=12", "lr-decoder=0.01", "lr-diffusion=0.0001", "ema-decay=0.5")
    trainer(config).train()
    output = Path(config.output)
    epochs = json.loads((output / "training_log.json").read_text())
    assert [epoch["epoch"] for epoch in epochs] == list(range(13))
    assert [epoch["step"] for epoch in epochs] == list(range(0, 37, 3))
    before, after = epochs[0]["validation"], epochs[-1]["validation"]
    assert after["velocity-coherence"] < before["velocity-coherence"] / 10
    assert after["mean-speed"] == pytest.approx(before["mean-speed"], rel=0.2)
    assert after["reconstruction"] <= before["reconstruction"]
    assert "loss" in epochs[1]["train"] and not epochs[0]["train"]
    table = (output / "results.md").read_text()
    for row in ("Total loss", "Accel coherence", "Decoder quaternion", "Mean speed, m/s"):
        assert f"| {row} |" in table

    model = AudioMotionModel.from_pretrained(output)
    best = load_file(output / "best" / "model.safetensors")
    saved = load_file(output / "model.safetensors")
    assert all(torch.equal(saved[key], best[key]) for key in best)
    assert model.card.trained and model.card.training["e2e"]["kept"] > 0


def test_resuming_is_bitwise_the_same(settings: Settings) -> None:
    constant = "lr-schedule=constant"
    whole = settings("epochs=2", constant, output="whole")
    trainer(whole).train()
    trainer(settings("epochs=1", constant, output="halves")).train()
    halves = settings("epochs=2", constant, output="halves")
    trainer(halves, resume=True).train()
    assert_equal_runs(Path(whole.output), Path(halves.output))
    for name in ("model.safetensors", "results.md"):
        one, other = Path(whole.output) / name, Path(halves.output) / name
        assert one.read_bytes() == other.read_bytes()


def test_patience_ends_a_run_and_keeps_the_best(
    settings: Settings, capfd: pytest.CaptureFixture[str]
) -> None:
    config = settings("epochs=9", "patience=2", "lr-decoder=10", "gradient-clip=1e9")
    trainer(config).train()
    output = Path(config.output)
    done = json.loads((output / "finished.json").read_text())
    assert done == {"steps": 6, "planned": 27}  # epochs 1 and 2 are worse than none
    before = load_file(Path(config.checkpoint) / "model.safetensors")
    after = load_file(output / "model.safetensors")
    assert all(torch.equal(after[key], before[key]) for key in before)
    assert "| kept: epoch 0 |" in (output / "results.md").read_text()
    capfd.readouterr()
    trainer(config, resume=True).train()
    assert "nothing to do" in capfd.readouterr().err


def test_the_command_takes_the_flags_of_the_document(
    circles: Path, checkpoint: Path, tmp_path: Path
) -> None:
    flags = {
        "epochs": 1,
        "num-phrases": 4,
        "batch-size": 2,
        "lr-diffusion": "1e-6",
        "lr-decoder": "5e-5",
        "diffusion-weight": 0.1,
        "decoder-weight": 1.0,
        "temporal-weight": 10.0,
        "patience": 10,
        "checkpoint": checkpoint,
        "decoder-checkpoint": checkpoint,
        "data": circles,
        "output": tmp_path,
    }
    arguments = [part for key, value in flags.items() for part in (f"--{key}", str(value))]
    done = CliRunner().invoke(STAGES["finetune-e2e"].app(), [*QUIET, *arguments])
    assert done.exit_code == 0, done.output
    identity = json.loads((tmp_path / "run.json").read_text())
    assert identity["lr-diffusion"] == 1e-6 and identity["temporal-weight"] == 10
    log = (tmp_path / "log.jsonl").read_text().splitlines()
    assert [json.loads(line)["step"] for line in log] == [0, 2, 2]


@pytest.mark.slow
def test_two_processes_equal_one(circles: Path, checkpoint: Path, tmp_path: Path) -> None:
    places = ["--data", circles, "--checkpoint", checkpoint, "--num-phrases", 8]
    arguments = [*QUIET, "batch-size=2", "epochs=1", *map(str, places)]
    launch_two("src.train.finetune_e2e", *arguments, "--output", tmp_path / "two")
    one = [*arguments, "gradient-accumulation=2", "--output", str(tmp_path / "one")]
    done = CliRunner().invoke(STAGES["finetune-e2e"].app(), one)
    assert done.exit_code == 0, done.output
    assert_close_runs(tmp_path / "two", tmp_path / "one")


# ------------------------------------------------------------ the parts


def test_two_learning_rates(settings: Settings) -> None:
    made = trainer(settings("epochs=1"))
    rates = {
        id(weight): group["initial_lr"]
        for group in made.optimizer.param_groups
        for weight in group["params"]
    }
    assert isinstance(made.module, E2eObjective)
    for name, weight in made.module.named_parameters():
        expected = 1e-6 if name.startswith("model.unet.") else 5e-5
        assert rates[id(weight)] == expected, name
    assert len(rates) == len(list(made.module.parameters()))


def test_what_each_loss_depends_on(settings: Settings) -> None:
    """Pure noise feeds the temporal terms only; reconstruction starts from ground truth."""
    task = FinetuneE2eTask(settings(), tiny_audio_network())
    batch, objective = task.batch(Part(1, 0, 1)), task.module
    first = objective(batch)
    other = objective(replace(batch, noise=batch.noise.flip(0)))
    assert torch.equal(first["reconstruction"], other["reconstruction"])
    assert torch.equal(first["diffusion"], other["diffusion"])
    assert not torch.equal(first["temporal"], other["temporal"])
    other = objective(replace(batch, target=batch.target + 1))
    assert torch.equal(first["temporal"], other["temporal"])
    assert not torch.equal(first["reconstruction"], other["reconstruction"])
    weighted = 0.1 * first["diffusion"] + first["reconstruction"] + 10 * first["temporal"]
    torch.testing.assert_close(first["loss"], weighted)
    for name in ("velocity", "accel"):
        assert f"{name}-coherence" in first
    assert {"jerk", "quat-delta", "phase-monotonic", "position-smoothness"} <= first.keys()


@pytest.mark.parametrize("part", ["diffusion", "reconstruction", "temporal"])
def test_gradients_reach_what_they_should(settings: Settings, part: str) -> None:
    task = FinetuneE2eTask(settings(), tiny_audio_network())
    task.module(task.batch(Part(1, 0, 1)))[part].backward()
    assert isinstance(task.module, E2eObjective)
    model = task.module.model
    unet = [weight.grad for weight in model.unet.parameters() if weight.grad is not None]
    assert sum(float(gradient.abs().sum()) for gradient in unet) > 0
    decoder = model.decoder.position_head.weight.grad
    assert (decoder is None) == (part == "diffusion")


def test_known_frames_are_those_of_the_ground_truth(settings: Settings) -> None:
    """As in sampling a long song: there the reconstruction has no error."""
    task = FinetuneE2eTask(settings("prefix-share=1"), tiny_audio_network())
    batch = task.batch(Part(1, 0, 1))
    everything = replace(batch.audio, known=torch.ones_like(batch.audio.known))
    assert isinstance(task.module, E2eObjective)
    decoder = task.module.model.decoder
    assert isinstance(decoder, MotionDecoder)
    torch.nn.init.zeros_(decoder.velocity_head.weight)
    torch.nn.init.zeros_(decoder.acceleration_head.weight)
    losses = task.module(replace(batch, audio=everything))
    assert losses["reconstruction"] < 1e-4
    torch.testing.assert_close(losses["mean-speed"], losses["real-speed"], rtol=1e-3, atol=0)


def test_the_decoder_of_another_folder(settings: Settings, tmp_path: Path) -> None:
    torch.manual_seed(1)
    AudioMotionModel(tiny_audio_network()).save_pretrained(tmp_path / "derived")
    config = settings(f"decoder-checkpoint='{tmp_path / 'derived'}'")
    task = FinetuneE2eTask(config, network_of(config.checkpoint))
    assert isinstance(task.model.decoder, DerivedMotionDecoder)
    assert task.identity["network"]["decoder"]["decoder"] == "derived"
    assert len(task.identity["weights"]) == 2
    losses = task.module(task.batch(Part(1, 0, 1)))
    assert losses["velocity-coherence"] < 1e-9  # derived velocities always agree


@pytest.mark.parametrize("key", ["steps=3", "learning-rate=0.1", "validate-every=2"])
def test_what_follows_from_the_epochs_cannot_be_set(settings: Settings, key: str) -> None:
    with pytest.raises(UsageError, match=f"{key.split('=')[0]} has no place here"):
        settings(key)


def test_the_network_is_that_of_the_checkpoint(checkpoint: Path, circles: Path) -> None:
    with pytest.raises(UsageError, match=r"network\.unet.* is that of --checkpoint"):
        STAGES["finetune-e2e"].run([NETWORK[0], f"checkpoint='{checkpoint}'", f"data='{circles}'"])


# ------------------------------------------------------------ epochs


def test_epochs_are_read_from_the_log(tmp_path: Path) -> None:
    lines = [
        {"step": 0, "validation/loss": 3.0, "validation/jerk": 1.0},
        {"step": 4, "loss": 2.5},
        {"step": 4, "validation/loss": 1.0, "validation/jerk": 0.25},
        {"step": 8, "loss": 2.0},
        {"step": 8, "validation/loss": None, "validation/jerk": 0.5},
    ]
    log = tmp_path / "log.jsonl"
    log.write_text("".join(json.dumps(line) + "\n" for line in lines))
    epochs = read_epochs(log, 4)
    assert [epoch.epoch for epoch in epochs] == [0, 1, 2]
    assert epochs[1].train == {"loss": 2.5}
    assert best_epoch(epochs) is epochs[1]  # not a number is never the best
    table = results_table(epochs, epochs[1])
    assert "| Total loss | 3 | 1 | - | 1 | 3 |" in table
    assert "| Jerk | 1 | 0.25 | 0.5 | 0.25 | 4 |" in table
    assert read_epochs(tmp_path / "none.jsonl", 4) == []


def test_the_first_of_equal_epochs_is_the_best() -> None:
    epochs = [Epoch(number, number, {}, {"loss": 1.0}) for number in range(3)]
    assert best_epoch(epochs).epoch == 0


def test_mean_speed_is_that_of_the_path() -> None:
    trajectory = torch.zeros(2, 31, 25)
    trajectory[..., 2] = torch.arange(31) / 30 * 1.5
    assert mean_speed(trajectory).item() == pytest.approx(1.5)
