"""What everything is held against: a pose held still, and a network that has learned nothing."""

from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np
import torch
from torch import Tensor

from ..motion.features import (
    FORWARD,
    LATERAL,
    ROOT_ROW,
    YAW_RATE,
    decode_features,
    encode_features,
)
from ..motion.motion import Motion

if TYPE_CHECKING:
    from ..model.audio.audio_motion_model import AudioMotionModel
    from ..model.audio.shared_space import AudioTower, MotionTower, SharedSpace
    from ..model.generation.motion_generator import TextToMotion


def frozen(features: Tensor) -> Tensor:
    """The first pose [T, K + 1, 6] held for the whole clip: the floor for anything that moves."""
    still = features[:1].expand_as(features).clone()
    still[:, ROOT_ROW, [FORWARD, LATERAL, YAW_RATE]] = 0
    return still


def frozen_pose(motion: Motion) -> Motion:
    """The first pose of a motion held for its whole length."""
    return decode_features(frozen(encode_features(motion)))


def held_still(motion: Motion) -> Motion:
    """The first frame for all frames."""
    frames = motion.num_frames
    return replace(
        motion,
        quaternions=np.repeat(motion.quaternions[:1], frames, axis=0),
        root_position=np.repeat(motion.root_position[:1], frames, axis=0),
        contacts=np.repeat(motion.contacts[:1], frames, axis=0),
    )


@contextmanager
def drawn_from(seed: int) -> Iterator[None]:
    """Inside, weights are drawn from this seed; outside, random numbers go on as before."""
    with torch.random.fork_rng(devices=[]):
        torch.manual_seed(seed)
        yield


def untrained(generator: "TextToMotion", seed: int) -> "TextToMotion":
    """The same denoiser with fresh weights, text tower and statistics of the trained one."""
    from ..model.generation.denoiser import MotionDenoiser

    with drawn_from(seed):
        fresh = MotionDenoiser(generator.network, generator.denoiser.num_tags)
        # As training begins the last layer is zero, and every motion the mean one.
        torch.nn.init.xavier_uniform_(fresh.output_proj.weight)
    return generator.with_denoiser(fresh, scope=None, style_map=None)


def untrained_audio_model(model: "AudioMotionModel", seed: int) -> "AudioMotionModel":
    """The same network with fresh weights but the trained one's row statistics.

    As training begins the last layer is zero, and every motion stands still: here it is random too.
    """
    with drawn_from(seed):
        fresh = type(model)(model.config)
        torch.nn.init.xavier_uniform_(fresh.unet.output_conv.get_parameter("weight"))
    fresh.set_statistics(model.mean.cpu(), model.std.cpu())
    return fresh.to(model.mean.device).eval()


def untrained_audio_tower(space: "SharedSpace", seed: int) -> "AudioTower":
    """The audio tower as its training began, but for the seed; the statistics are the same."""
    with drawn_from(seed):
        tower = type(space.audio)(space.config)
    tower.set_statistics(space.audio.mean, space.audio.std)
    return tower.eval()


def untrained_motion_tower(space: "SharedSpace", seed: int) -> "MotionTower":
    """The motion tower with random weights and the statistics of the trained one."""
    with drawn_from(seed):
        tower = type(space.motion)(space.card.network)
    tower.mean.copy_(space.motion.mean)
    tower.std.copy_(space.motion.std)
    return tower
