"""Small audio networks, and a walk, for tests."""

from typing import Any

import torch
from torch import Tensor

from src.shared.config_audio import AudioConditionConfig, AudioNetworkConfig, UNetConfig
from src.shared.model.audio.unet import UNet1D
from src.shared.motion.rotations import derive

CONDITION = AudioConditionConfig(dim=32)


def unet_config(**changes: Any) -> UNetConfig:
    values: dict[str, Any] = dict(
        model_channels=32,
        channel_mult=(1, 2),
        num_res_blocks=1,
        attention_resolutions=(2,),
        num_head_channels=16,
        time_embed_dim=32,
        context_dim=16,
        downsample_last=True,
        dropout=0.0,
    )
    return UNetConfig(**values | changes)


def network_config(**changes: Any) -> AudioNetworkConfig:
    values = dict(unet=unet_config(), condition=CONDITION, decoder={"hidden-dim": 16})
    return AudioNetworkConfig.model_validate(values | changes)


def awake(module: torch.nn.Module, seed: int = 0) -> torch.nn.Module:
    """Random weights where training would start from zeros, so that every path matters."""
    generator = torch.Generator().manual_seed(seed)
    with torch.no_grad():
        for parameter in module.parameters():
            if not parameter.any():
                parameter.copy_(0.1 * torch.randn(parameter.shape, generator=generator))
    return module


def unet(**changes: Any) -> UNet1D:
    torch.manual_seed(0)
    model = UNet1D(unet_config(**changes), CONDITION)
    awake(model)
    return model.eval()


def walk(frames: int = 60) -> Tensor:
    """A smooth turning walk at 120 BPM in 4/4, [1, T, 25] with increments in column 16."""
    time = torch.arange(frames) / 30.0
    position = torch.stack((time.sin(), 0.9 + 0.05 * (6 * time).sin(), time), dim=-1)
    half, zero = 0.4 * time, torch.zeros_like(time)
    quaternion = torch.stack((half.cos(), zero, half.sin(), zero), dim=-1)
    velocity, acceleration, turning = derive(position, quaternion, 30.0)
    steps = torch.full((frames, 1), 0.5 / 30)
    style = torch.full((frames, 8), 8**-0.5)
    columns = (position, velocity, acceleration, quaternion, turning, steps, style)
    return torch.cat(columns, dim=-1)[None]
