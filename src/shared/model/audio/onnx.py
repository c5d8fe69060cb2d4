"""UNet1D and decoder as ONNX graphs for any batch and any length of 8 frames or more.

condition.onnx: condition [B,167,T] float32 -> all that depends on it alone, made once a sample.
time.onnx: t [B] int64 -> all that depends on the step alone, the same for every sample.
unet.onnx: x [B,25,T'] float32 z-scores, T' the next multiple of the deepest downsampling, and what
those two gave, by its names -> prediction [B,25,T'].
decoder.onnx: rows [B,T,25] in raw units, start [B] (bar phase of the first frame, NaN = the
decoder's guess) -> trajectory [B,T,25] and phase [B,T], unwrapped, in bars.

In unet.onnx a feature map is an image of height 1, [B,C,1,T]: for the convolutions of images
onnxruntime has kernels that take two thirds of the time.

Letters: B batch, T frames, C channels, H heads, d = C/H.
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
from ..layers import KeyValue, sinusoidal
from ..onnx_card import AUDIO_GRAPHS, AudioOnnxCard
from ..onnx_export import (
    EXAMPLE_FRAMES,
    Shapes,
    SymbolicRotary,
    process_info,
    symbolic,
    traced,
    write_export,
)
from . import CONDITION_ROWS
from .audio_motion_model import AudioMotionModel
from .decoder import Decoder, wrapped_phase
from .unet import AttentionBlock, Downsample, ResBlock, StageCondition, UNet1D, Upsample, ZeroConv1d

FILES = (CARD_FILE, WEIGHTS_FILE, "README.md", "bands.json")


class SymbolicUNet(UNet1D):
    """Pads without asking whether it must."""

    def _pad(self, x: Tensor) -> Tensor:
        frames, factor = x.shape[-1], self.factors[-1]
        padded = (frames + factor - 1) // factor * factor
        return x.index_select(-1, torch.arange(padded, device=x.device).clamp(max=frames - 1))


class ImageConv1d(nn.Conv1d):
    """Of an image of height 1."""

    def forward(self, x: Tensor) -> Tensor:
        """[B, C, 1, T] -> [B, C', 1, T]."""
        padding = (0, int(self.padding[0]))
        return F.conv2d(x, self.weight[:, :, None], self.bias, padding=padding)


class ImageDownsample(Downsample):
    """Pads in front only: lengths are even here, and so their half is plain to see."""

    def forward(self, x: Tensor) -> Tensor:
        """[B, C, 1, T] -> [B, C, 1, T/2]."""
        weight = self.conv.weight[:, :, None]
        return F.conv2d(F.pad(x, (1, 0)), weight, self.conv.bias, stride=(1, 2))


class ImageUpsample(Upsample):
    """Repeats by joining: a third of the time that the exporter's node takes."""

    def forward(self, x: Tensor) -> Tensor:
        """[B, C, 1, T] -> [B, C, 1, 2T]."""
        result: Tensor = self.conv(torch.stack((x, x), dim=-1).flatten(-2))
        return result


class ImageResBlock(ResBlock):
    """Is given what it makes of step and condition, as factors and summands."""

    def of_time(self, time_emb: Tensor) -> tuple[Tensor, ...]:
        """Time [B, E] -> summand and factor [B, C', 1, 1], those of the second norm among them."""
        out = self.time_mlp(time_emb)[:, :, None, None]
        if not self.use_scale_shift_norm:
            return (out,)
        scale, shift = out.chunk(2, dim=1)
        weight, bias = (each[:, None, None] for each in (self.norm2.weight, self.norm2.bias))
        return bias * (1 + scale) + shift, weight * (1 + scale)

    def forward(self, x: Tensor, time_emb: Tensor, given: Any = None) -> Tensor:
        """x [B, C, 1, T] -> [B, C', 1, T]; of the time it hears what is `given`."""
        h, norm = self.conv1(F.silu(self.norm1(x))), self.norm2
        shift, scale, beta, gamma = given
        if scale is None:
            h = norm(h + shift)
        else:
            h = F.group_norm(h, norm.num_groups, eps=norm.eps) * scale + shift
        if gamma is not None:
            h = h * gamma[:, :, None] + beta[:, :, None]
        h = self.conv2(F.silu(h))
        result: Tensor = h + self.skip_conv(x)
        return result


class ImageAttention(AttentionBlock):
    """In fewer nodes than the exporter makes of PyTorch's kernel."""

    def forward(self, x: Tensor, keys_values: KeyValue | None = None) -> Tensor:
        """[B, C, 1, T] -> the same."""
        rows = self.norm(x)[:, :, 0].transpose(1, 2)  # [B, T, C]
        heads = self.qkv(rows).unflatten(-1, (3 * self.num_heads, -1))  # [B, T, 3H, d]
        turning, value = heads.split([2 * self.num_heads, self.num_heads], dim=2)
        query, key = self._turned(turning).chunk(2, dim=2)
        x = x + self._mixed(query, key.transpose(1, 2), value.transpose(1, 2), self.proj)
        if keys_values is None:
            return x
        rows = self.cross_norm(x)[:, :, 0].transpose(1, 2)
        query = self._turned(self.q_cross(rows).unflatten(-1, (self.num_heads, -1)))
        return x + self._mixed(query, *keys_values, self.proj_cross)

    def _turned(self, heads: Tensor) -> Tensor:
        """[B, T, H, d] -> the same."""
        return self.rotary.turned(heads) if isinstance(self.rotary, SymbolicRotary) else heads

    def _mixed(self, query: Tensor, key: Tensor, value: Tensor, out: nn.Module) -> Tensor:
        """Query [B, T, H, d], key and value [B, H, L, d] -> [B, C, 1, T]."""
        scores = query.transpose(1, 2) @ key.transpose(2, 3) * value.shape[-1] ** -0.5
        mixed = (scores.softmax(dim=-1) @ value).transpose(1, 2).flatten(2)  # [B, T, C]
        result: Tensor = out(mixed).transpose(1, 2)[:, :, None]
        return result


IMAGES = {
    nn.Conv1d: ImageConv1d,
    ZeroConv1d: ImageConv1d,
    Downsample: ImageDownsample,
    Upsample: ImageUpsample,
    ResBlock: ImageResBlock,
    AttentionBlock: ImageAttention,
}


class ConditionGraph(nn.Module):
    """What a network prepares of a condition, tensor by tensor."""

    def __init__(self, unet: UNet1D) -> None:
        super().__init__()
        self.unet = symbolic(unet, {UNet1D: SymbolicUNet})
        self.unet.memory = None

    def forward(self, condition: Tensor) -> tuple[Tensor, ...]:
        """Condition [B, 167, T] -> the values of `named`."""
        return tuple(self.named(condition).values())

    def named(self, condition: Tensor) -> dict[str, Tensor]:
        """Summand and factor [B, C, T'/2^i] of each block, keys and values [B, H, T, d]."""
        found: dict[str, Tensor] = {}
        for number, stage in enumerate(self.unet.prepare(condition).stages):
            films = enumerate(stage.film)
            for place, film in ((f"{number}.{block}", each) for block, each in films):
                if film is not None:
                    gamma, found[f"beta.{place}"] = film.chunk(2, dim=1)
                    found[f"gamma.{place}"] = 1 + gamma
            if stage.keys_values is not None:
                found[f"key.{number}"], found[f"value.{number}"] = stage.keys_values
        return found


class TimeGraph(nn.Module):
    """What the blocks of a network make of a step, tensor by tensor."""

    def __init__(self, unet: UNet1D) -> None:
        super().__init__()
        self.unet = symbolic(unet, IMAGES)

    def forward(self, t: Tensor) -> tuple[Tensor, ...]:
        """t [B] -> the values of `named`."""
        return tuple(self.named(t).values())

    def named(self, t: Tensor) -> dict[str, Tensor]:
        """See `ImageResBlock.of_time`."""
        found: dict[str, Tensor] = {}
        time_emb = self.unet.time_embed(sinusoidal(t, self.unet.config.time_embed_dim))
        for number, stage in enumerate(self.unet.stages()):
            for index, block in enumerate(stage.blocks):
                assert isinstance(block, ImageResBlock)
                for name, each in zip(("shift", "scale"), block.of_time(time_emb), strict=False):
                    found[f"{name}.{number}.{index}"] = each
        return found


class StepGraph(nn.Module):
    """A network that is given what both made, by these names."""

    def __init__(self, unet: UNet1D, names: Sequence[str]) -> None:
        super().__init__()
        self.unet, self.names = symbolic(unet, IMAGES), names

    def forward(self, x: Tensor, *tensors: Tensor) -> Tensor:
        """x [B, 25, T'] and the named tensors -> prediction [B, 25, T']."""
        named = dict(zip(self.names, tensors, strict=True))
        stages = []
        for number, stage in enumerate(self.unet.stages()):
            given: Any = tuple(
                [named.get(f"{name}.{number}.{block}") for name in PARTS]
                for block in range(len(stage.blocks))
            )
            key, value = named.get(f"key.{number}"), named.get(f"value.{number}")
            both = None if key is None or value is None else (key, value)
            stages.append(StageCondition(given, both))
        return self.unet.through(x[:, :, None], x, stages)[:, :, 0]


PARTS = ("shift", "scale", "beta", "gamma")  # what a block is given


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


def traced_unet(unet: UNet1D) -> tuple[Any, Any, Any]:
    """The graphs of a network without its memory: of a condition, of the time, of a pass."""
    batch, frames, pieces = Dim("batch"), Dim("frames"), Dim("pieces")
    deepest = unet.factors[-1]
    count = -(-EXAMPLE_FRAMES // deepest)  # frames at the deepest level
    heard, t = torch.randn(2, CONDITION_ROWS, EXAMPLE_FRAMES), torch.tensor([1, 2])
    of_condition, of_time = ConditionGraph(unet), TimeGraph(unet)
    with torch.no_grad():
        prepared, times = of_condition.named(heard), of_time.named(t)

    def many(length: int) -> Any:
        return pieces if length == count else length // count * pieces

    def shapes(name: str, tensor: Tensor) -> Shapes:
        modulates = name.startswith(("gamma", "beta"))
        return {0: batch, 2: many(tensor.shape[2]) if modulates else frames}

    condition = traced(of_condition, {"condition": (heard, {0: batch, 2: frames})}, tuple(prepared))
    time = traced(of_time, {"t": (t, {0: batch})}, tuple(times))
    x = torch.randn(2, unet.config.in_channels, deepest * count)
    step = traced(
        StepGraph(unet, (*times, *prepared)),
        {
            "x": (x, {0: batch, 2: many(x.shape[2])}),
            **{name: (tensor, {0: batch}) for name, tensor in times.items()},
            **{name: (tensor, shapes(name, tensor)) for name, tensor in prepared.items()},
        },
        ("prediction",),
    )
    return condition, time, step


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
    condition, time, unet = traced_unet(loaded.unet)
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
        dict(zip(AUDIO_GRAPHS, (condition, time, unet, decoder), strict=True)),
        AudioOnnxCard,
        loaded.card,
        process=process_info(loaded.diffusion, loaded.config.guidance_scale),
        audio_network=loaded.config,
        mean=tuple(loaded.mean.tolist()),
        std=tuple(loaded.std.tolist()),
        null_condition=tuple(loaded.unet.null.tolist()),
    )
