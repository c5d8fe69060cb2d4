"""Both text-branch stages at a size for tests: a network of 32 channels, a few steps."""

from pathlib import Path
from typing import Any

from src.shared.config_loader import load_network, load_train
from src.shared.config_schema import NetworkConfig, TrainClipConfig, TrainGenerationConfig
from src.train.engine import Trainer
from src.train.train_clip import ClipTask
from src.train.train_generation import GenerationTask

NETWORK = [
    "embed-dim=32",
    "generation.num-heads=2",
    "generation.num-layers=1",
    "generation.diffusion-steps=20",
    "generation.sampling-steps=4",
    "generation.dropout=0.1",
    "clip.motion-num-heads=2",
    "clip.motion-num-layers=1",
    "clip.text-hidden-size=32",
    "clip.text-num-heads=2",
    "clip.text-num-layers=1",
    "clip.text-vocab-size=1500",
]
SETTINGS = [
    "device=cpu",
    "precision=no",
    "threads=1",
    "batch-size=8",
    "steps=6",
    "warmup-steps=2",
    "log-every=2",
    "save-every=2",
    "validate-every=100",
    "validation-batches=1",
    "max-frames=48",
    "tensorboard=false",
    "languages=[en,ja]",  # with spaces between words, and without
]


def tiny_network(*overrides: str) -> NetworkConfig:
    return load_network("lightweight", overrides=[*NETWORK, *overrides])


def _settings(data: Path, output: Path, overrides: tuple[str, ...]) -> list[str]:
    return [*SETTINGS, f"data='{data}'", f"output='{output}'", *overrides]


def clip_config(data: Path, output: Path, *overrides: str) -> TrainClipConfig:
    return load_train(None, TrainClipConfig, _settings(data, output, overrides))


def generation_config(
    data: Path, clip: Path, output: Path, *overrides: str
) -> TrainGenerationConfig:
    settings = _settings(data, output, (f"clip='{clip}'", *overrides))
    return load_train(None, TrainGenerationConfig, settings)


def train_clip(
    config: TrainClipConfig, network: NetworkConfig | None = None, *, resume: bool = False
) -> ClipTask:
    return _train(config, ClipTask, network, resume)


def train_generation(
    config: TrainGenerationConfig, network: NetworkConfig | None = None, *, resume: bool = False
) -> GenerationTask:
    return _train(config, GenerationTask, network, resume)


def _train(config: Any, task: Any, network: NetworkConfig | None, resume: bool) -> Any:
    chosen = network or tiny_network()
    trainer = Trainer(config, lambda c: task(c, chosen), command="again", resume=resume)
    trainer.train()
    return trainer.task
