"""What both text-branch stages need: the data, its rows, and figures shared by their tasks."""

from pathlib import Path

import numpy as np
import torch

from ..shared.config_schema import NetworkConfig, TrainConfig
from ..shared.data.prepare import open_data
from ..shared.data.prepared import PreparedData
from ..shared.data.text_motion import TextMotionDataset
from ..shared.errors import UsageError, UserError
from ..shared.metrics.retrieval import BATCH
from ..shared.motion.skeleton import NUM_JOINTS
from .run_log import announce
from .task import mix_seed


def open_training_data(config: TrainConfig, network: NetworkConfig) -> PreparedData:
    """The data of a stage; synthetic data is made once beside the run's folder.

    Raises:
        UsageError: the network has another number of bones than the data.
        UserError: no prepared data there.
    """
    if network.generation.num_bones != NUM_JOINTS:
        raise UsageError(
            f"generation.num-bones {network.generation.num_bones} does not fit the data, which"
            f" has {NUM_JOINTS}; set it to {NUM_JOINTS}"
        )
    return open_data(config.data, Path(config.output).parent)


def training_set(config: TrainConfig, data: PreparedData) -> TextMotionDataset:
    """The train split; raises UserError when no clip of it can be used."""
    try:
        return split_set(config, data, "train")
    except ValueError as error:
        raise UserError(f"{error}; lower min-frames or prepare more data") from error


def validation_set(config: TrainConfig, data: PreparedData) -> TextMotionDataset | None:
    """The val split; None, with a word on stderr, where little data left nothing in it."""
    try:
        return split_set(config, data, "val")
    except ValueError:
        announce("no validation: the data is too little to hold clips back")
        return None


def can_retrieve(number: int) -> bool:
    """Whether R@k, which goes by batches of 32, can be told of so many held-back clips.

    Of two clips anyone finds the right one; where there are too few a word on stderr says so.
    """
    if number < BATCH:
        announce(
            f"{number} clips are held back and R@k needs {BATCH}: validation is the loss alone"
        )
    return number >= BATCH


def split_set(config: TrainConfig, data: PreparedData, split: str) -> TextMotionDataset:
    """One split as the configuration wants it; raises ValueError when nothing in it fits."""
    return TextMotionDataset(
        data,
        split,
        min_frames=config.min_frames,
        max_frames=config.max_frames,
        languages=config.languages,
        balance=config.balance,
        captured_share=config.captured_share,
        seed=mix_seed("data", config.seed),
    )


def numpy_generator(*parts: int | str) -> np.random.Generator:
    """A NumPy generator that depends on every part."""
    return np.random.default_rng(mix_seed(*parts))


def motion_rows(motion: torch.Tensor, network: NetworkConfig) -> torch.Tensor:
    """Features [..., 23, 6] without the root track where the profile has none."""
    return motion[..., : network.motion_rows, :]
