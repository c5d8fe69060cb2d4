"""UNet1D and decoder as ONNX graphs for any batch and any length of 8 frames or more.

unet.onnx: x [B,25,T] float32 z-scores, t [B] int64, condition [B,167,T] float32 -> prediction
[B,25,T]. decoder.onnx: rows [B,T,25] in raw units, start [B] (bar phase of the first frame, NaN =
the decoder's guess) -> trajectory [B,T,25] and phase [B,T], unwrapped, in bars.

The exporter follows lengths as symbols. Where eager code asks for a number, the layer is rewritten
here with the same weights and the same result.

Letters: B batch, T frames, C channels.
"""

import copy
import logging
import warnings
from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager
from pathlib import Path

import torch
from torch import Tensor, nn
from torch.nn import functional as F

from ...io.files import atomic_write, write_json
from ...motion.trajectory import CHANNELS, PHASE
from .audio_motion_model import AudioMotionModel
from .blocks import Downsample, FrameRotary
from .conditioning import CONDITION_ROWS
from .decoder import Decoder, wrapped_phase
from .onnx_card import (
    CARD_FILE,
    GRAPHS,
    OnnxCard,
    graph_info,
    require_packages,
)
from .unet import UNet1D

OPSET = 18
EXAMPLE_FRAMES = 37  # no multiple of anything, so that no length is taken for a constant
Shapes = Mapping[int, str]  # dimension -> name of its symbol


class SymbolicUNet(UNet1D):
    """Pads without asking whether it must."""

    def _pad(self, x: Tensor) -> Tensor:
        frames, factor = x.shape[-1], self.config.factors[-1]
        padded = (frames + factor - 1) // factor * factor
        return x.index_select(-1, torch.arange(padded, device=x.device).clamp(max=frames - 1))


class SymbolicDownsample(Downsample):
    """Pads in front only: lengths are even here, and so their half is plain to see."""

    def forward(self, x: Tensor) -> Tensor:
        """[B, C, T] -> [B, C, T/2]."""
        return F.conv1d(F.pad(x, (1, 0)), self.conv.weight, self.conv.bias, stride=2)


class SymbolicRotary(FrameRotary):
    """Computes its table in the graph instead of keeping one."""

    def _tables(self, length: int, device: torch.device) -> tuple[Tensor, Tensor]:
        positions = torch.arange(length, dtype=torch.float32, device=device)
        positions = positions * self.stride + self.stride // 2
        angles = positions[:, None, None] * self.frequencies
        return angles.cos(), angles.sin()


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


def symbolic(unet: UNet1D) -> UNet1D:
    """The network again, on the CPU, in layers that the exporter can follow; without memory."""
    twins: dict[type, type] = {
        UNet1D: SymbolicUNet,
        Downsample: SymbolicDownsample,
        FrameRotary: SymbolicRotary,
    }
    twin = copy.deepcopy(unet).cpu().float().eval()
    twin.memory = None
    for module in twin.modules():
        module.__class__ = twins.get(type(module), type(module))
    return twin


def export_onnx(model: AudioMotionModel, folder: str | Path) -> OnnxCard:
    """Write both graphs and the card that vouches for them.

    Raises:
        UserError: the packages are missing, or the folder cannot be written.
    """
    require_packages("onnx", "onnxscript")
    frames, rows = EXAMPLE_FRAMES, len(model.mean)
    unet = _program(
        symbolic(model.unet),
        {
            "x": (torch.randn(2, rows, frames), {0: "batch", 2: "frames"}),
            "t": (torch.tensor([1, 2]), {0: "batch"}),
            "condition": (
                torch.randn(2, CONDITION_ROWS, frames),
                {0: "batch", 2: "frames"},
            ),
        },
        ("prediction",),
    )
    decoder = _program(
        DecoderGraph(copy.deepcopy(model.decoder).cpu().float().eval()),
        {
            "rows": (torch.randn(2, frames, CHANNELS), {0: "batch", 1: "frames"}),
            "start": (torch.rand(2), {0: "batch"}),
        },
        ("trajectory", "phase"),
    )
    # Written only now: who stops the slow part leaves no folder behind.
    files = [Path(folder) / name for name in GRAPHS]
    for program, path in zip((unet, decoder), files, strict=True):
        with atomic_write(path) as temporary:
            program.save(str(temporary))
    card = OnnxCard(
        name=model.card.name,
        description=model.card.description,
        licence=model.card.licence,
        trained=model.card.trained,
        model=model.card.weights.sha256 if model.card.weights else "",
        fps=model.card.fps,
        opset=OPSET,
        audio_network=model.config,
        mean=tuple(model.mean.tolist()),
        std=tuple(model.std.tolist()),
        null_condition=tuple(model.unet.null.tolist()),
        graphs={path.name: graph_info(path) for path in files},
    )
    write_json(Path(folder) / CARD_FILE, card.model_dump(mode="json", by_alias=True))
    return card


def _program(
    module: nn.Module,
    inputs: Mapping[str, tuple[Tensor, Shapes]],
    outputs: Sequence[str],
) -> torch.onnx.ONNXProgram:
    with torch.no_grad(), _quiet():
        program = torch.onnx.export(
            module,
            tuple(example for example, _ in inputs.values()),
            dynamo=True,
            dynamic_shapes=tuple(shapes for _, shapes in inputs.values()),
            input_names=list(inputs),
            output_names=list(outputs),
            opset_version=OPSET,
            optimize=False,  # onnxruntime does it on loading, many times faster
            verbose=False,
        )
    assert program is not None
    return program


@contextmanager
def _quiet() -> Iterator[None]:
    """The exporter tells about packages and names that are none of the user's business."""
    logger = logging.getLogger("torch.onnx")
    level = logger.level
    logger.setLevel(logging.ERROR)
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            yield
    finally:
        logger.setLevel(level)
