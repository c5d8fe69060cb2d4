"""UNet1D and decoder as ONNX graphs for any batch and any length of 8 frames or more.

condition.onnx: condition [B,167,T] float32 -> all that depends on it alone, made once a sample.
unet.onnx: x [B,25,T'] float32 z-scores, T' the next multiple of the deepest downsampling, t [B]
int64, and what condition.onnx gave, by its names -> prediction [B,25,T'].
decoder.onnx: rows [B,T,25] in raw units, start [B] (bar phase of the first frame, NaN = the
decoder's guess) -> trajectory [B,T,25] and phase [B,T], unwrapped, in bars.

Letters: B batch, T frames, C channels.
"""

from collections.abc import Sequence
from pathlib import Path
from typing import Any

import torch
from torch import Tensor, nn
from torch.export import Dim
from torch.nn import functional as F

from ...motion.trajectory import CHANNELS, PHASE
from ..checkpoint import CARD_FILE, WEIGHTS_FILE, resolve_model
from ..onnx_card import AUDIO_GRAPHS, AudioOnnxCard
from ..onnx_export import EXAMPLE_FRAMES, Shapes, process_info, symbolic, traced, write_export
from .audio_motion_model import AudioMotionModel
from .conditioning import CONDITION_ROWS
from .decoder import Decoder, wrapped_phase
from .unet import Downsample, Prepared, StageCondition, UNet1D

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


class ConditionGraph(nn.Module):
    """What a network prepares of a condition, tensor by tensor."""

    def __init__(self, unet: UNet1D) -> None:
        super().__init__()
        self.unet = unet

    def forward(self, condition: Tensor) -> tuple[Tensor, ...]:
        """Condition [B, 167, T] -> the values of `named_tensors`."""
        return tuple(named_tensors(self.unet.prepare(condition)).values())


def named_tensors(prepared: Prepared) -> dict[str, Tensor]:
    """Modulations [B, 2C, T'/2^i] of each block, keys and values [B, H, T, d] of each attention."""
    found: dict[str, Tensor] = {}
    for number, stage in enumerate(prepared.stages):
        films = enumerate(stage.film)
        found |= {f"film.{number}.{block}": film for block, film in films if film is not None}
        if stage.keys_values is not None:
            found[f"key.{number}"], found[f"value.{number}"] = stage.keys_values
    return found


class StepGraph(nn.Module):
    """A network that is given what ConditionGraph made, by these names."""

    def __init__(self, unet: UNet1D, names: Sequence[str]) -> None:
        super().__init__()
        self.unet, self.names = unet, names

    def forward(self, x: Tensor, t: Tensor, *tensors: Tensor) -> Tensor:
        """x [B, 25, T'], t [B] and the named tensors -> prediction [B, 25, T']."""
        named = dict(zip(self.names, tensors, strict=True))
        stages = []
        for number, stage in enumerate(self.unet.stages()):
            films = [named.get(f"film.{number}.{block}") for block in range(len(stage.blocks))]
            key, value = named.get(f"key.{number}"), named.get(f"value.{number}")
            both = None if key is None or value is None else (key, value)
            stages.append(StageCondition(tuple(films), both))
        result: Tensor = self.unet(x, t, Prepared(tuple(stages)))
        return result


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


def traced_unet(unet: UNet1D) -> tuple[Any, Any]:
    """Both graphs of a network of `symbolic_unet`: of its condition, and of a step."""
    batch, frames, pieces = Dim("batch"), Dim("frames"), Dim("pieces")
    deepest = unet.factors[-1]
    count = -(-EXAMPLE_FRAMES // deepest)  # frames at the deepest level
    heard = torch.randn(2, CONDITION_ROWS, EXAMPLE_FRAMES)
    with torch.no_grad():
        tensors = named_tensors(unet.prepare(heard))

    def many(length: int) -> Any:
        return pieces if length == count else length // count * pieces

    def shapes(name: str, tensor: Tensor) -> Shapes:
        return {0: batch, 2: many(tensor.shape[2]) if name.startswith("film") else frames}

    condition = traced(
        ConditionGraph(unet), {"condition": (heard, {0: batch, 2: frames})}, tuple(tensors)
    )
    x = torch.randn(2, unet.config.in_channels, deepest * count)
    step = traced(
        StepGraph(unet, tuple(tensors)),
        {
            "x": (x, {0: batch, 2: many(x.shape[2])}),
            "t": (torch.tensor([1, 2]), {0: batch}),
            **{name: (tensor, shapes(name, tensor)) for name, tensor in tensors.items()},
        },
        ("prediction",),
    )
    return condition, step


def export_audio(model: str | Path, folder: str | Path) -> AudioOnnxCard:
    """Write a model folder with its graphs, and the card that vouches for them.

    Args:
        model: name of shipped weights, or a folder that training wrote.
        folder: made when absent; may be the model's own.

    Raises:
        UserError: no such model, or the folder cannot be written.
    """
    source, folder = resolve_model(model), Path(folder)
    loaded = AudioMotionModel.from_pretrained(source)
    condition, unet = traced_unet(symbolic_unet(loaded.unet))
    decoder = traced(
        DecoderGraph(symbolic(loaded.decoder)),
        {
            "rows": (torch.randn(2, EXAMPLE_FRAMES, CHANNELS), {0: "batch", 1: "frames"}),
            "start": (torch.rand(2), {0: "batch"}),
        },
        ("trajectory", "phase"),
    )
    # Written only now: who stops the slow part leaves no folder behind.
    return write_export(
        source,
        folder,
        FILES,
        dict(zip(AUDIO_GRAPHS, (condition, unet, decoder), strict=True)),
        AudioOnnxCard,
        loaded.card,
        process=process_info(loaded.diffusion, loaded.config.guidance_scale),
        audio_network=loaded.config,
        mean=tuple(loaded.mean.tolist()),
        std=tuple(loaded.std.tolist()),
        null_condition=tuple(loaded.unet.null.tolist()),
    )
