"""The audio stages at a size for tests: people who walk in circles, a UNet of 32 channels."""

import os
import socket
import subprocess
import sys
from pathlib import Path
from typing import Any

import numpy as np
import torch
from safetensors.torch import load_file

from src.shared.config_audio import AudioNetworkConfig, TrainAudioConfig
from src.shared.config_loader import load_audio_network, load_train
from src.shared.data.phrases.layout import write_manifest, write_phrase
from src.shared.motion.trajectory import MotionTrajectory
from src.train.engine import Trainer
from src.train.train_audio import AudioTask

ROOT = Path(__file__).parents[2]
NETWORK = [
    "network.unet.model-channels=32",
    "network.unet.channel-mult=[1,2]",
    "network.unet.num-res-blocks=1",
    "network.unet.attention-resolutions=[2]",
    "network.unet.num-heads=2",
    "network.unet.time-embed-dim=32",
    "network.unet.context-dim=16",
    "network.condition.dim=16",
    "network.decoder.hidden-dim=32",
    "network.diffusion.timesteps=50",
    "network.diffusion.sampling-steps=4",
]
SETTINGS = [
    "device=cpu",
    "precision=no",
    "threads=1",
    "batch-size=4",
    "warmup-steps=2",
    "target-frames=32",
    "validation-batches=1",
    "tensorboard=false",
]
STEPS = ["steps=6", "log-every=2", "save-every=2", "validate-every=100"]
PREFIX = ["prefix-frames=[8,12]"]
GROUPS = {"mel": 128, "chroma": 12, "mfcc": 20, "rms": 0, "spectral_centroid": 0}


def write_circles(root: Path, num: int = 12, frames: int = 60) -> Path:
    """Phrases with a bounce on each beat; every fourth is held back. Returns the folder."""
    rng, records = np.random.default_rng(0), []
    time = np.arange(frames) / 30
    for index in range(num):
        tempo, turn = rng.uniform(80, 140), rng.uniform(-0.5, 0.5)
        bars, angle = time * tempo / 240 + rng.uniform(), time * turn
        bounce = np.cos(8 * np.pi * bars)
        speed = 1 + 0.3 * bounce
        position = np.stack(
            [
                np.cumsum(np.sin(angle) * speed) / 30,
                1 + 0.03 * bounce,
                np.cumsum(np.cos(angle) * speed) / 30,
            ],
            axis=1,
        )
        zero = np.zeros(frames)
        quaternion = np.stack([np.cos(angle / 2), zero, np.sin(angle / 2), zero], axis=1)
        trajectory = MotionTrajectory.from_pose(position, quaternion, bars).data
        sound = {k: rng.random((n, frames) if n else frames) for k, n in GROUPS.items()}
        sound["onset_strength"] = np.maximum(bounce, 0)
        features = {name: values.astype(np.float32) for name, values in sound.items()}
        features |= {"phase": bars, "meter": np.array(4), "tempo": np.array(tempo)}
        split = "val" if index % 4 == 3 else "train"
        name = f"circle-{index:02d}"
        records.append(write_phrase(root, name, trajectory, features, split=split))
    write_manifest(root, records)
    return root


def tiny_audio_network(*overrides: str) -> AudioNetworkConfig:
    return load_audio_network("lightweight", overrides=[*NETWORK, *overrides])


def audio_config(data: Path, output: Path, *overrides: str) -> TrainAudioConfig:
    places = [f"data='{data}'", f"output='{output}'"]
    return load_train(None, TrainAudioConfig, [*SETTINGS, *STEPS, *PREFIX, *places, *overrides])


def train_audio(config: TrainAudioConfig, *, resume: bool = False) -> AudioTask:
    network = tiny_audio_network()
    trainer = Trainer(config, lambda c: AudioTask(c, network), command="again", resume=resume)
    trainer.train()
    assert isinstance(trainer.task, AudioTask)
    return trainer.task


def tensors(output: Path, name: str) -> dict[str, torch.Tensor]:
    """Those of the newest checkpoint: model, ema or optimizer."""
    newest = sorted((output / "checkpoints").iterdir())[-1]
    return load_file(newest / f"{name}.safetensors")


def assert_equal_runs(first: Path, second: Path) -> None:
    for name in ("model", "ema", "optimizer"):
        one, other = tensors(first, name), tensors(second, name)
        assert one.keys() == other.keys()
        assert all(torch.equal(one[key], other[key]) for key in one), name


def launch_two(module: str, *arguments: Any) -> None:
    """Run a stage as two processes on the CPU."""
    with socket.socket() as probe:
        probe.bind(("127.0.0.1", 0))
        port = str(probe.getsockname()[1])
    launcher = [sys.executable, "-m", "accelerate.commands.launch", "--multi_gpu"]
    done = subprocess.run(
        [
            *launcher,
            *("--num_processes", "2", "--main_process_port", port, "-m", module),
            *map(str, arguments),
            "processes=2",
        ],
        env={**os.environ, "OMP_NUM_THREADS": "1", "ACCELERATE_USE_CPU": "true"},
        cwd=ROOT,
        stderr=subprocess.PIPE,
        text=True,
        timeout=300,
        check=False,
    )
    assert done.returncode == 0, done.stderr
    assert "2 process(es)" in done.stderr


def assert_close_runs(first: Path, second: Path) -> None:
    for name in ("model", "ema"):
        one, other = tensors(first, name), tensors(second, name)
        assert all(torch.allclose(one[key], other[key], atol=1e-5) for key in one), name
