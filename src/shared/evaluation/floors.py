"""What everything is held against: a pose held still, and a network that has learned nothing."""

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


def untrained(generator: "TextToMotion", seed: int) -> "TextToMotion":
    """The same denoiser with fresh weights, text tower and statistics of the trained one."""
    from ..model.generation.denoiser import MotionDenoiser
    from ..model.generation.motion_generator import TextToMotion

    with torch.random.fork_rng(devices=[]):
        torch.manual_seed(seed)
        fresh = MotionDenoiser(generator.network, generator.denoiser.num_tags)
        # As training begins the last layer is zero, and every motion the mean one.
        torch.nn.init.xavier_uniform_(fresh.output_proj.weight)
    return TextToMotion(
        fresh,
        generator.text,
        generator.tokenizer,
        mean=generator.mean,
        std=generator.std,
        card=generator.card,
        device=str(generator.device),
    )
