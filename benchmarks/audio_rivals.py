"""Samplers of rivals' sizes with random weights, timed beside ours by audio_unet.

`edge_sized`: the decoder of EDGE (Tseng et al. 2023): 8 layers, 512 wide, FFN 1024, 8 heads, each
with self-attention, cross-attention to the music and FiLM by the step; 50 guided steps.
`unet1d_model`: diffusers' UNet1DModel at 100M, 50 plain steps.

Letters: B batch, T frames, D width.
"""

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import torch
from torch import Tensor, nn

from src.shared.model.layers import sinusoidal

FEATURES = 25
MUSIC = 4800  # Jukebox features
EDGE_FEATURES = 151


@dataclass(frozen=True)
class Rival:
    """A sampler that makes 4 s of motion, and its size."""

    sample: Callable[[], Any]
    parameters: int
    frames: int
    steps: int
    forwards: int  # network passes of one sample, guidance counted twice


class FiLMDecoderLayer(nn.Module):
    """Self-attention, cross-attention and FFN, each behind a norm and before a FiLM."""

    def __init__(self, width: int, heads: int, hidden: int) -> None:
        super().__init__()
        self.norms = nn.ModuleList(nn.LayerNorm(width) for _ in range(3))
        self.self_attention = nn.MultiheadAttention(width, heads, batch_first=True)
        self.cross_attention = nn.MultiheadAttention(width, heads, batch_first=True)
        self.ffn = nn.Sequential(nn.Linear(width, hidden), nn.GELU(), nn.Linear(hidden, width))
        self.films = nn.ModuleList(
            nn.Sequential(nn.Mish(), nn.Linear(width, 2 * width)) for _ in range(3)
        )

    def forward(self, x: Tensor, memory: Tensor, step: Tensor) -> Tensor:
        """x [B, T, D], memory [B, S, D], step [B, D] -> [B, T, D]."""
        h = self.norms[0](x)
        x = x + self._film(0, self.self_attention(h, h, h, need_weights=False)[0], step)
        h = self.norms[1](x)
        x = x + self._film(1, self.cross_attention(h, memory, memory, need_weights=False)[0], step)
        return x + self._film(2, self.ffn(self.norms[2](x)), step)

    def _film(self, index: int, h: Tensor, step: Tensor) -> Tensor:
        scale, shift = self.films[index](step)[:, None].chunk(2, dim=-1)
        return (1 + scale) * h + shift


class EdgeSized(nn.Module):
    """The decoder with its music encoder: 2 transformer layers."""

    def __init__(self, width: int = 512, heads: int = 8, hidden: int = 1024) -> None:
        super().__init__()
        self.width = width
        self.into, self.out = nn.Linear(EDGE_FEATURES, width), nn.Linear(width, EDGE_FEATURES)
        self.music = nn.Linear(MUSIC, width)
        encoder = nn.TransformerEncoderLayer(width, heads, hidden, batch_first=True)
        self.music_encoder = nn.TransformerEncoder(encoder, 2, enable_nested_tensor=False)
        self.step = nn.Sequential(
            nn.Linear(width, 4 * width), nn.Mish(), nn.Linear(4 * width, 3 * width)
        )
        self.layers = nn.ModuleList(FiLMDecoderLayer(width, heads, hidden) for _ in range(8))

    def hear(self, music: Tensor) -> Tensor:
        """[B, S, 4800] -> [B, S, D]."""
        return self.music_encoder(self.music(music))

    def forward(self, x: Tensor, t: Tensor, heard: Tensor) -> Tensor:
        """x [B, T, 151], t [B], heard [B, S, D] -> [B, T, 151]."""
        step, *tokens = self.step(sinusoidal(t, self.width)).chunk(3, dim=-1)
        memory = torch.cat((heard, torch.stack(tokens, dim=1)), dim=1)  # two step tokens
        h = self.into(x)
        for layer in self.layers:
            h = layer(h, memory, step)
        return self.out(h)


def edge_sized(frames: int, steps: int = 50) -> Rival:
    """50 guided steps, as one doubled batch each; the music is encoded once."""
    model = EdgeSized().eval()
    music = torch.randn(2, frames, MUSIC)

    @torch.inference_mode()
    def sample() -> Tensor:
        heard, x = model.hear(music), torch.randn(1, frames, EDGE_FEATURES)
        for step in range(steps, 0, -1):
            t = torch.full((2,), step * (1000 // steps) - 1)
            told, untold = model(x.expand(2, -1, -1), t, heard)
            x = _cheap_update(x, untold + 2 * (told - untold), step)
        return x

    return Rival(sample, _count(model), frames, steps, 2 * steps)


def unet1d_model(frames: int, steps: int = 50) -> Rival:
    """Residual convolutions on four levels, attention on the two deepest.

    Its lengths must divide by 16: `frames` is rounded up.
    """
    from diffusers import UNet1DModel

    frames += -frames % 16
    model = UNet1DModel(
        sample_size=frames,
        in_channels=FEATURES,
        out_channels=FEATURES,
        extra_in_channels=2 * UNET1D_CHANNELS[0],  # its Fourier code of the step
        block_out_channels=UNET1D_CHANNELS,
        down_block_types=("DownBlock1DNoSkip", "DownBlock1D", "AttnDownBlock1D", "AttnDownBlock1D"),
        up_block_types=("AttnUpBlock1D", "AttnUpBlock1D", "UpBlock1D", "UpBlock1DNoSkip"),
    ).eval()

    @torch.inference_mode()
    def sample() -> Tensor:
        x = torch.randn(1, FEATURES, frames)
        for step in range(steps, 0, -1):
            x = _cheap_update(x, model(x, step * (1000 // steps) - 1).sample, step)
        return x

    return Rival(sample, _count(model), frames, steps, steps)


UNET1D_CHANNELS = (160, 320, 512, 704)


def _cheap_update(x: Tensor, clean: Tensor, step: int) -> Tensor:
    """Towards the prediction; any update: its cost does not show."""
    return (x * (step - 1) + clean) / step


def _count(model: nn.Module) -> int:
    return sum(parameter.numel() for parameter in model.parameters())
