"""UNet1D and decoder as ONNX graphs for any batch and any length of 8 frames or more.

unet.onnx: x [B,25,T] float32 z-scores, t [B] int64, condition [B,167,T] float32 -> prediction
[B,25,T]. decoder.onnx: rows [B,T,25] in raw units, start [B] (bar phase of the first frame, NaN =
the decoder's guess) -> trajectory [B,T,25] and phase [B,T], unwrapped, in bars.

Letters: B batch, T frames, C channels.
"""

from pathlib import Path

import torch
from torch import Tensor, nn
from torch.nn import functional as F

from ...motion.trajectory import CHANNELS, PHASE
from ..checkpoint import CARD_FILE, WEIGHTS_FILE, resolve_model
from ..onnx_card import AudioOnnxCard
from ..onnx_export import EXAMPLE_FRAMES, process_info, symbolic, traced, write_export
from .audio_motion_model import AudioMotionModel
from .conditioning import CONDITION_ROWS
from .decoder import Decoder, wrapped_phase
from .unet import Downsample, UNet1D

UNET_GRAPH, DECODER_GRAPH = "unet.onnx", "decoder.onnx"
FILES = (CARD_FILE, WEIGHTS_FILE, "README.md", "bands.json")


class SymbolicUNet(UNet1D):
    """Pads without asking whether it must."""

    def _pad(self, x: Tensor) -> Tensor:
        frames, factor = x.shape[-1], self.factors[-1]
        padded = (frames + factor - 1) // factor * factor
        return x.index_select(-1, torch.arange(padded, device=x.device).clamp(max=frames - 1))


class SymbolicDownsample(Downsample):
    """Pads in front only: lengths are even here, and so their half is plain to see."""

    def forward(self, x: Tensor) -> Tensor:
        """[B, C, T] -> [B, C, T/2]."""
        return F.conv1d(F.pad(x, (1, 0)), self.conv.weight, self.conv.bias, stride=2)


class DecoderGraph(nn.Module):
    """A decoder whose optional `start` is a number: NaN stands for None."""

    def __init__(self, decoder: Decoder) -> None:
        super().__init__()
        self.decoder = decoder

    def forward(self, rows: Tensor, start: Tensor) -> tuple[Tensor, Tensor]:
        """Rows [B, T, 25] raw, start [B] -> trajectory [B, T, 25], phase [B, T]."""
        decoded = self.decoder.decode(rows)
        guessed = decoded.phase_unwrapped  # [B, T]
        first = guessed[:, 0]
        phase = guessed - first[:, None] + torch.where(start.isnan(), first, start)[:, None]
        trajectory = decoded.trajectory
        columns = (
            trajectory[..., :PHASE],
            wrapped_phase(phase)[..., None],
            trajectory[..., PHASE + 1 :],
        )
        return torch.cat(columns, dim=-1), phase


def symbolic_unet(unet: UNet1D) -> UNet1D:
    """The network again, on the CPU, in layers that the exporter can follow; without memory."""
    twin = symbolic(unet, {UNet1D: SymbolicUNet, Downsample: SymbolicDownsample})
    twin.memory = None
    return twin


def export_audio(model: str | Path, folder: str | Path) -> AudioOnnxCard:
    """Write a model folder with both graphs, and the card that vouches for them.

    Args:
        model: name of shipped weights, or a folder that training wrote.
        folder: made when absent; may be the model's own.

    Raises:
        UserError: no such model, or the folder cannot be written.
    """
    source, folder = resolve_model(model), Path(folder)
    loaded = AudioMotionModel.from_pretrained(source)
    frames, rows = EXAMPLE_FRAMES, len(loaded.mean)
    unet = traced(
        symbolic_unet(loaded.unet),
        {
            "x": (torch.randn(2, rows, frames), {0: "batch", 2: "frames"}),
            "t": (torch.tensor([1, 2]), {0: "batch"}),
            "condition": (torch.randn(2, CONDITION_ROWS, frames), {0: "batch", 2: "frames"}),
        },
        ("prediction",),
    )
    decoder = traced(
        DecoderGraph(symbolic(loaded.decoder)),
        {
            "rows": (torch.randn(2, frames, CHANNELS), {0: "batch", 1: "frames"}),
            "start": (torch.rand(2), {0: "batch"}),
        },
        ("trajectory", "phase"),
    )
    # Written only now: who stops the slow part leaves no folder behind.
    return write_export(
        source,
        folder,
        FILES,
        {UNET_GRAPH: unet, DECODER_GRAPH: decoder},
        AudioOnnxCard,
        loaded.card,
        process=process_info(loaded.diffusion, loaded.config.guidance_scale),
        audio_network=loaded.config,
        mean=tuple(loaded.mean.tolist()),
        std=tuple(loaded.std.tolist()),
        null_condition=tuple(loaded.unet.null.tolist()),
    )
