"""Run an audio profile's networks once on random input and compare each block's shape.

Letters: B batch, T frames, C channels of the finest level, E channels of the audio condition,
X channels of the cross-attention context, M channels of the time embedding, D hidden dim of the
decoders. Level i has T/2^i frames; both documents draw it (TECH 3.1.2, REF).
"""

import torch
from torch import Tensor, nn

from ..shared.config_audio import AudioNetworkConfig, UNetConfig
from ..shared.model.audio.conditioning import CONDITION_ROWS, AudioConditioner
from ..shared.model.audio.decoder import create_motion_decoder
from ..shared.model.audio.unet import UNet1D
from .shape_stages import Letters, Row, Stage, count, trace

BATCH, PIECES = 2, 6  # pieces at the deepest level, so that nothing needs padding


class AudioLetters(Letters):
    """The numbers behind the letters of one profile."""

    def __init__(self, config: AudioNetworkConfig) -> None:
        deepest = config.unet.factors[-1]
        frames = {"T": PIECES * deepest}
        frames |= {f"T/{factor}": frames["T"] // factor for factor in config.unet.factors[1:]}
        channels = {
            f"{factor}C" if factor > 1 else "C": width
            for factor, width in zip(config.unet.channel_mult, config.unet.channels, strict=True)
        }
        others = {
            "E": config.condition.dim,
            "E/2": config.condition.dim // 2,
            "E/4": config.condition.dim // 4,
            "3E/2": config.condition.dim // 2 * 3,
            "X": config.unet.context_dim,
            "M": config.unet.time_embed_dim,
            "D": config.decoder.hidden_dim,
        }
        super().__init__({"B": BATCH, **frames, **channels, **others})


def audio_stages(config: AudioNetworkConfig, device: torch.device) -> list[Stage]:
    """AudioConditioner, UNet1D and both decoders, in the order of the data."""
    letters = AudioLetters(config)
    frames = letters.values["T"]
    with device:
        unet = UNet1D(config.unet, config.condition).eval()
        noisy = torch.randn(BATCH, config.unet.in_channels, frames)
        steps = torch.full((BATCH,), config.diffusion.timesteps - 1)
        condition = torch.randn(BATCH, CONDITION_ROWS, frames)
    stages = conditioner_stages(unet.conditioner, condition, letters)
    rows = unet_rows(config, unet)
    blocks, out = trace("UNet1D", unet, rows, letters, noisy, steps, condition)
    predicts = f"predicts {config.diffusion.prediction_type}"
    if unet.conditioner is not None:
        predicts += ", AudioConditioner included"
    whole = Row("", "UNet1D", "B x 25 x T", "B x 25 x T", predicts)
    stages += [*blocks, letters.stage("UNet1D", whole, noisy, out, count(unet))]
    for kind in ("residual", "derived"):
        stages += decoder_stages(config, kind, letters, device)
    return stages


def conditioner_stages(
    conditioner: AudioConditioner | None, condition: Tensor, letters: Letters
) -> list[Stage]:
    """A projection for each feature group and the convolution that joins them (ruling 2)."""
    if conditioner is None:
        return []
    projections = (
        ("mel", 128, ""),
        ("mfcc", 20, ""),
        ("chroma", 12, ""),
        ("energy", 3, "rms, centroid, onset"),
        ("beat", 4, "beat and bar phase, cosine and sine"),
    )
    rows = []
    for name, width, note in projections:
        part = "E/2" if name == "mel" else "E/4"
        shapes = f"B x {width} x T", f"B x {part} x T"
        rows.append(Row(f"{name}_proj", f"{name} proj", *shapes, note))
    rows.append(Row("combine", "combine", "B x 3E/2 x T", "B x E x T", "Conv1d 3"))
    name = "AudioConditioner"
    stages, out = trace(name, conditioner, rows, letters, condition)
    whole = Row("", name, "B x 167 x T", "B x E x T", "for FiLM, once a sample")
    return [*stages, letters.stage(name, whole, condition, out, count(conditioner))]


# ---------------------------------------------------------------- UNet1D


def unet_rows(config: AudioNetworkConfig, unet: UNet1D) -> list[Row]:
    """Every block, from the context through the levels and back."""
    rows = []
    if unet.context_proj is not None:
        rows.append(Row("context_proj", "audio context", "B x T x 167", "B x T x X", "Linear"))
    rows.append(Row("time_embed", "time embedding", "B x M", "B x M", "sinusoidal, Linear x 2"))
    rows.append(Row("input_conv", "input conv", "B x 25 x T", "B x C x T"))
    levels = range(len(config.unet.channels))
    for level in levels:
        rows += down_rows(config.unet, unet, level)
    rows += middle_rows(config.unet)
    for level in reversed(levels):
        rows += up_rows(config.unet, unet, level)
    return [*rows, Row("output_conv", "output conv", "B x C x T", "B x 25 x T", "starts at zero")]


def width_of(config: UNetConfig, level: int) -> str:
    """The letters of a level's channels."""
    factor = config.channel_mult[level]
    return f"{factor}C" if factor > 1 else "C"


def map_of(channels: str, factor: int) -> str:
    """The letters of a feature map."""
    return f"B x {channels} x T" if factor == 1 else f"B x {channels} x T/{factor}"


def listening(config: UNetConfig) -> tuple[str, str]:
    """Notes on how ResBlocks and attentions hear the audio."""
    film = "time" if config.conditioning == "cross-attention" else "time, FiLM"
    attention = "self" if config.conditioning == "film" else "self, cross"
    return film, attention


def block_rows(
    config: UNetConfig, path: str, name: str, before: str, after: str, factor: int
) -> list[Row]:
    """The ResBlocks of one level."""
    film, _ = listening(config)
    out = map_of(after, factor)
    return [
        Row(
            f"{path}.blocks.{index}",
            f"{name} ResBlock {index + 1}",
            map_of(before, factor) if index == 0 else out,
            out,
            film,
        )
        for index in range(config.num_res_blocks)
    ]


def attention_row(config: UNetConfig, path: str, name: str, channels: str, factor: int) -> Row:
    """One attention block."""
    shape, (_, note) = map_of(channels, factor), listening(config)
    return Row(f"{path}.attention", f"{name} Attention", shape, shape, note)


def down_rows(config: UNetConfig, unet: UNet1D, level: int) -> list[Row]:
    """One level on the way down."""
    name, path, factor = f"down {level}", f"down.{level}", config.factors[level]
    before, width = width_of(config, max(level - 1, 0)), width_of(config, level)
    rows = block_rows(config, path, name, before, width, factor)
    if getattr(unet.down[level], "attention", None) is not None:
        rows.append(attention_row(config, path, name, width, factor))
    if not isinstance(unet.downsample[level], nn.Identity):
        shapes = map_of(width, factor), map_of(width, 2 * factor)
        rows.append(Row(f"downsample.{level}", f"{name} Downsample", *shapes, "Conv1d, stride 2"))
    return rows


def middle_rows(config: UNetConfig) -> list[Row]:
    """ResBlock, attention, ResBlock."""
    width, factor = width_of(config, len(config.channels) - 1), config.factors[-1]
    shape, (film, _) = map_of(width, factor), listening(config)
    return [
        Row("middle.blocks.0", "middle ResBlock 1", shape, shape, film),
        attention_row(config, "middle", "middle", width, factor),
        Row("middle.blocks.1", "middle ResBlock 2", shape, shape, film),
    ]


def up_rows(config: UNetConfig, unet: UNet1D, level: int) -> list[Row]:
    """One level on the way up; its first block takes the skip beside what comes from below."""
    name, path, factor = f"up {level}", f"up.{level}", config.factors[level]
    width, after = width_of(config, level), width_of(config, max(level - 1, 0))
    rows = []
    if not isinstance(unet.upsample[level], nn.Identity):
        shapes = map_of(width, 2 * factor), map_of(width, factor)
        rows.append(Row(f"upsample.{level}", f"{name} Upsample", *shapes, "nearest, Conv1d"))
    joined = str(2 * config.channels[level])
    rows += block_rows(config, path, name, joined, after, factor)
    if getattr(unet.up[level], "attention", None) is not None:
        rows.append(attention_row(config, path, name, after, factor))
    return rows


# ---------------------------------------------------------------- decoders


def decoder_stages(
    config: AudioNetworkConfig, kind: str, letters: Letters, device: torch.device
) -> list[Stage]:
    """One of the two decoders, whichever the profile uses."""
    chosen = config.decoder.model_copy(update={"decoder": kind})
    with device:
        decoder = create_motion_decoder(chosen).eval()
        rows_in = torch.randn(BATCH, letters.values["T"], 25)
    name = type(decoder).__name__
    hidden, layers = "B x T x D", range(config.decoder.num_layers)
    if kind == "residual":
        rows = [Row("input_proj", "input proj", "B x T x 25", hidden)]
        rows += [
            Row(f"blocks.{index}", f"ResidualBlock {index + 1}", hidden, hidden, "MLP D -> 4D -> D")
            for index in layers
        ]
    else:
        rows = [
            Row(
                f"encoder.{index}",
                f"encoder {index + 1}",
                hidden if index else "B x T x 25",
                hidden,
                "Conv1D, LayerNorm, GELU",
            )
            for index in layers
        ]
    rows += head_rows(decoder)
    stages, out = trace(name, decoder, rows, letters, rows_in)
    used = "the profile's" if config.decoder.decoder == kind else ""
    whole = Row("", name, "B x T x 25", "B x T x 25", used)
    return [*stages, letters.stage(name, whole, rows_in, out, count(decoder))]


def head_rows(decoder: nn.Module) -> list[Row]:
    """Every head; the phase start is one pair of numbers a window."""
    rows = []
    for name, head in decoder.named_children():
        if isinstance(head, nn.Linear) and name.endswith("_head"):
            place = "B" if "start" in name else "B x T"
            shapes = f"{place} x D", f"{place} x {head.out_features}"
            rows.append(Row(name, name.replace("_", " "), *shapes))
    return rows
