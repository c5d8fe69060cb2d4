"""Run a profile's networks once on random input, and compare every stage with the documents.

Letters of the text branch: B batch, T frames, T' pieces after the strided convolutions, K bones,
C channels, D embed dim, L text tokens, H_text width of the text encoder; "K+1" counts the root
track. Of the audio branch: C channels of the finest level, E channels of the audio condition,
X channels of the cross-attention context, M channels of the time embedding, D hidden dim of the
decoders. Level i has T/2^i frames; both documents draw it (TECH 3.1.2, REF).
"""

from dataclasses import dataclass, field
from typing import Any, NamedTuple

import torch
from torch import Tensor, nn

from ..shared.config_audio import AudioNetworkConfig
from ..shared.config_schema import ClipConfig, NetworkConfig
from ..shared.model.audio import CONDITION_ROWS
from ..shared.model.audio.decoder import create_motion_decoder
from ..shared.model.audio.unet import UNet1D
from ..shared.model.clip.core import MotionClip
from ..shared.model.clip.features import TextFeatures
from ..shared.model.generation.denoiser import MotionDenoiser
from ..shared.motion.postprocess.whole import clamp_velocity, smooth_features, smoothing_weights
from ..shared.motion.rotations import matrix_to_quaternion, rotation_6d_to_matrix

BATCH, FRAMES, TOKENS, NUM_TAGS, FPS = 2, 40, 12, 5, 30.0
PIECES = 6  # at the deepest level of the UNet, so that nothing needs padding
# Published sizes of the two hub models, so that checking shapes downloads nothing.
XLM_R_SIZES = {
    "xlm-roberta-base": {"text_hidden_size": 768, "text_num_layers": 12, "text_num_heads": 12},
    "xlm-roberta-large": {"text_hidden_size": 1024, "text_num_layers": 24, "text_num_heads": 16},
}
XLM_R_VOCABULARY, XLM_R_POSITIONS = 250_002, 512


class Row(NamedTuple):
    """What a document says of one module: its path in the network, and its shapes in letters."""

    path: str  # empty for the network itself
    name: str
    before: str
    after: str
    note: str = ""


@dataclass(frozen=True)
class Stage:
    """One printed row: what went in and came out, and what the document says of both."""

    network: str
    row: Row
    shapes: tuple[tuple[int, ...], tuple[int, ...]]
    expected: tuple[tuple[int, ...], tuple[int, ...]]
    parameters: int = 0

    @property
    def agrees(self) -> bool:
        """Whether both shapes are the document's."""
        return self.shapes == self.expected


def count(module: nn.Module) -> int:
    """Parameters of a module."""
    return sum(parameter.numel() for parameter in module.parameters())


@dataclass
class Table:
    """The stages of a check, in the order of the data; letters stand for a profile's numbers."""

    letters: dict[str, int]
    stages: list[Stage] = field(default_factory=list)

    def add(
        self, network: str, row: Row, before: Tensor, after: Tensor, parameters: int = 0
    ) -> None:
        """A stage with its measured shapes; in letters, `B x 25 x T` holds a plain number."""
        expected = [
            tuple(self.letters.get(part) or int(part) for part in symbols.split(" x "))
            for symbols in (row.before, row.after)
        ]
        shapes = tuple(before.shape), tuple(after.shape)
        self.stages.append(Stage(network, row, shapes, (expected[0], expected[1]), parameters))

    def run(self, network: str, module: nn.Module, rows: list[Row], *inputs: Any) -> Any:
        """One forward pass, a stage for each row: the first tensor in and the tensor out."""
        seen: dict[str, tuple[Tensor, Tensor]] = {}

        def hook(path: str) -> Any:
            def record(_: Any, args: tuple[Any, ...], kwargs: dict[str, Any], out: Any) -> None:
                found = getattr(out, "pooled", getattr(out, "last_hidden_state", out))
                seen[path] = args[0] if args else next(iter(kwargs.values())), found

            return record

        modules = {row.path: module.get_submodule(row.path) for row in rows}
        handles = [
            each.register_forward_hook(hook(path), with_kwargs=True)
            for path, each in modules.items()
        ]
        with torch.no_grad():
            out = module(*inputs)
        for handle in handles:
            handle.remove()
        for row in rows:
            self.add(network, row, *seen[row.path], count(modules[row.path]))
        return out


# ---------------------------------------------------------------- text


def text_table(config: NetworkConfig, device: torch.device, *, full: bool) -> Table:
    """CLIP with `full`, the denoiser, the post-processing."""
    generation = config.generation
    bones, channels = generation.num_bones, generation.motion_channels
    letters = {"B": BATCH, "T": FRAMES, "T/4": FRAMES // 4, "T'": FRAMES // 8, "L": TOKENS}
    letters |= {"K": bones, "(K+1)": bones + 1, "C": channels, "K*C": bones * channels}
    table = Table(letters | {"(K+1)*C": (bones + 1) * channels, "D": config.embed_dim})
    rows = "(K+1)" if config.root_track else "K"
    text = clip_stages(table, config, device, rows) if full else random_text(config, device)
    with device:
        model = MotionDenoiser(config, NUM_TAGS).eval()
        noisy = torch.randn(BATCH, FRAMES, config.motion_rows, channels)
        steps = torch.full((BATCH,), generation.diffusion_steps - 1)
        tag = torch.full((BATCH,), NUM_TAGS)
    table.run("MotionDenoiser", model, denoiser_rows(config, rows), noisy, steps, text, tag)
    post_processing_stages(table, config, noisy, rows)
    return table


def random_text(config: NetworkConfig, device: torch.device) -> TextFeatures:
    """Stand-in for the text tower in the fast check."""
    pooled = nn.functional.normalize(torch.randn(BATCH, config.embed_dim, device=device), dim=-1)
    tokens = torch.randn(BATCH, TOKENS, config.embed_dim, device=device)
    return TextFeatures(pooled, tokens, torch.ones(tokens.shape[:2], dtype=torch.bool).to(device))


def denoiser_rows(config: NetworkConfig, rows: str) -> list[Row]:
    """TEXT's tables of MotionDenoiser and DenoiserBlock."""
    generation, same = config.generation, "B x T x D"
    frame, motion = f"B x T x {rows}*C", f"B x T x {rows} x C"
    layers = [
        ("temporal", "TemporalLayer", "self-attention, FFN 4D"),
        ("film", "FiLM", "Linear 2D -> 2D"),
        ("norm", "LayerNorm", ""),
        ("attention", "MHA", "RoPE on q and k, residual"),
        ("cross_attention", "CrossAttention", "ruling 22"),
        ("adaln", "AdaLN", "Linear 2D -> 2D"),
        ("transform", "TransformLayer", "FFN D -> 4D -> D"),
    ]
    if generation.text_conditioning != "tokens":
        del layers[4]
    return [
        Row("motion_proj", "motionProj", frame, same, "Linear K*C -> D"),
        Row("text_proj", "textProj", "B x D", "B x D", "expanded across T"),
        Row("timestep_embed", "timestepEmbed", "B", "B x D", "sinusoidal, MLP D -> 4D -> D"),
        Row("tag_embed", "tagEmbed", "B", "B x D", "numTags + 1, the last for none"),
        *[
            Row(f"blocks.{index}.{path}", f"block {index + 1} {name}", same, same, note)
            for index in range(generation.num_layers)
            for path, name, note in layers
        ],
        Row("output_norm", "LayerNorm", same, same),
        Row("output_proj", "outputProj", same, frame, "Linear D -> K*C"),
        Row("", "MotionDenoiser", motion, motion, f"predicts {generation.prediction_type}"),
    ]


def post_processing_stages(table: Table, config: NetworkConfig, sample: Tensor, rows: str) -> None:
    """Smoothing, 6D -> matrix -> quaternion, velocity clamp; only smoothing unless C = 6."""
    settings = config.generation.post_processing
    weights, most = smoothing_weights(settings), settings.max_velocity
    smooth = smooth_features(sample, weights)
    frame, turn, four = f"B x T x {rows} x C", "B x T x K x 3 x 3", "B x T x K x 4"
    note = f"depthwise Conv1D, kernel {len(weights)}"
    stages = [(Row("", "smoothing", frame, frame, note), sample, smooth)]
    if config.generation.motion_channels == 6:
        rotations = smooth[:, :, : config.generation.num_bones]
        matrix = rotation_6d_to_matrix(rotations)
        quaternion = matrix_to_quaternion(matrix)
        clamped = clamp_velocity(quaternion, most, FPS)
        note = "off" if most is None else f"{most:g} rad/s"
        stages += [
            (Row("", "renormalization", "B x T x K x C", turn, "Gram-Schmidt"), rotations, matrix),
            (Row("", "quaternion", turn, four, "w x y z"), matrix, quaternion),
            (Row("", "velocity clamp", four, four, note), quaternion, clamped),
        ]
    for stage in stages:
        table.add("post-processing", *stage)


def without_download(clip: ClipConfig) -> ClipConfig:
    """The same tower with the published sizes spelled out, for the two hub models we name."""
    sizes = XLM_R_SIZES.get(clip.text_model)
    if sizes is None:
        return clip
    extra = {"text_vocab_size": XLM_R_VOCABULARY, "max_tokens": XLM_R_POSITIONS}
    return clip.model_copy(update={"text_model": "small", **sizes, **extra})


def clip_stages(
    table: Table, config: NetworkConfig, device: torch.device, rows: str
) -> TextFeatures:
    """TEXT's tables of both towers, and the texts' features; XLM-R has its published size."""
    clip = without_download(config.clip)
    note = "random weights, nothing downloaded" if clip.text_model == "small" else ""
    config = config.model_copy(update={"clip": clip})
    with device:
        model = MotionClip(config).eval()
        ids = torch.randint(3, clip.text_vocab_size, (BATCH, TOKENS))
        mask = torch.ones(BATCH, TOKENS, dtype=torch.long)
        motion = torch.randn(BATCH, FRAMES, config.motion_rows, config.generation.motion_channels)
    table.letters["H_text"] = model.text.encoder.config.hidden_size
    text = [
        Row("encoder", "XLM-Roberta", "B x L", "B x L x H_text", note),
        Row("text_proj", "textProj", "B x H_text", "B x D", "Linear H_text -> D"),
        Row("", "TextTower", "B x L", "B x D", "masked mean, textProj, unit norm"),
    ]
    features: TextFeatures = table.run("CLIP text", model.text, text, ids, mask)
    same = "B x T' x D"
    tower = [
        Row("input_proj", "input projection", f"B x T x {rows}*C", "B x T x D"),
        Row("conv4", "temporal conv", "B x D x T", "B x D x T/4", "stride 4"),
        Row("conv2", "temporal conv", "B x D x T/4", "B x D x T'", "stride 2"),
        *[
            Row(f"layers.{index}", f"transformer {index + 1}", same, same, "FFN 2D")
            for index in range(clip.motion_num_layers)
        ],
        Row("norm", "LayerNorm", same, same, "then the mean over T'"),
        Row("output_proj", "output proj", "B x D", "B x D"),
        Row("", "TemporalUNet", f"B x T x {rows} x C", "B x D"),
    ]
    pooled = table.run("CLIP motion", model.motion, tower, motion)
    with torch.no_grad():
        embedding = model.encode_motion(motion)
    projection = Row("", "motionProj", "B x D", "B x D")
    table.add("CLIP motion", projection, pooled, embedding, count(model.motion_proj))
    logits = features.pooled @ embedding.T * model.scale()
    loss = Row("", "similarity", "B x D", "B x B", "contrastive + cosine loss")
    table.add("CLIP", loss, features.pooled, logits, 1)
    return features


# ---------------------------------------------------------------- audio


def audio_table(config: AudioNetworkConfig, device: torch.device) -> Table:
    """AudioConditioner, UNet1D and both decoders."""
    unet_config, dim = config.unet, config.condition.dim
    frames = PIECES * unet_config.factors[-1]
    letters = {"B": BATCH, "T": frames}
    letters |= {f"T/{factor}": frames // factor for factor in unet_config.factors[1:]}
    letters |= dict(zip(widths_of(config), unet_config.channels, strict=True))
    letters |= {"E": dim, "E/2": dim // 2, "E/4": dim // 4, "3E/2": dim // 2 * 3}
    letters |= {"X": unet_config.context_dim, "M": unet_config.time_embed_dim}
    table = Table(letters | {"D": config.decoder.hidden_dim})
    with device:
        unet = UNet1D(unet_config, config.condition).eval()
        noisy = torch.randn(BATCH, unet_config.in_channels, frames)
        steps = torch.full((BATCH,), config.diffusion.timesteps - 1)
        condition = torch.randn(BATCH, CONDITION_ROWS, frames)
    if unet.conditioner is not None:
        table.run("AudioConditioner", unet.conditioner, conditioner_rows(), condition)
    table.run("UNet1D", unet, unet_rows(config, unet), noisy, steps, condition)
    for kind in ("residual", "derived"):
        chosen = config.decoder.model_copy(update={"decoder": kind})
        with device:
            decoder = create_motion_decoder(chosen).eval()
            windows = torch.randn(BATCH, frames, 25)
        note = "the profile's" if config.decoder.decoder == kind else ""
        rows = decoder_rows(decoder, kind, config.decoder.num_layers, note)
        table.run(type(decoder).__name__, decoder, rows, windows)
    return table


def conditioner_rows() -> list[Row]:
    """A projection for each feature group and the convolution that joins them (ruling 2)."""
    projections = [
        ("mel", 128, "E/2", ""),
        ("mfcc", 20, "E/4", ""),
        ("chroma", 12, "E/4", ""),
        ("energy", 3, "E/4", "rms, centroid, onset"),
        ("beat", 4, "E/4", "beat and bar phase, cosine and sine"),
    ]
    return [
        *[
            Row(f"{name}_proj", f"{name} proj", f"B x {width} x T", f"B x {part} x T", note)
            for name, width, part, note in projections
        ],
        Row("combine", "combine", "B x 3E/2 x T", "B x E x T", "Conv1d 3"),
        Row("", "AudioConditioner", "B x 167 x T", "B x E x T", "for FiLM, once a sample"),
    ]


def widths_of(config: AudioNetworkConfig) -> list[str]:
    """The letters of each level's channels."""
    return [f"{factor}C" if factor > 1 else "C" for factor in config.unet.channel_mult]


def unet_rows(config: AudioNetworkConfig, unet: UNet1D) -> list[Row]:
    """Every block, from the context through the levels and back.

    On the way up a level's first block takes the skip beside what comes from below.
    """
    widths, factors, channels = widths_of(config), config.unet.factors, config.unet.channels
    heard = config.unet.conditioning
    film = "time" if heard == "cross-attention" else "time, FiLM"
    attends = "self" if heard == "film" else "self, cross"

    def shape(width: str, factor: int) -> str:
        return f"B x {width} x T" if factor == 1 else f"B x {width} x T/{factor}"

    def level_rows(way: str, level: int, before: str, after: str) -> list[Row]:
        name, path = f"{way} {level}", f"{way}.{level}"
        same, first = shape(after, factors[level]), shape(before, factors[level])
        rows = [
            Row(f"{path}.blocks.{i}", f"{name} ResBlock {i + 1}", same if i else first, same, film)
            for i in range(config.unet.num_res_blocks)
        ]
        if getattr(unet.get_submodule(path), "attention", None) is not None:
            rows.append(Row(f"{path}.attention", f"{name} Attention", same, same, attends))
        return rows

    def resampled(way: str, level: int, note: str) -> list[Row]:
        path, factor = f"{way}sample.{level}", factors[level]
        if isinstance(unet.get_submodule(path), nn.Identity):
            return []
        fine, coarse = shape(widths[level], factor), shape(widths[level], 2 * factor)
        shapes = (fine, coarse) if way == "down" else (coarse, fine)
        return [Row(path, f"{way} {level} {way.title()}sample", *shapes, note)]

    rows = [
        Row("time_embed", "time embedding", "B x M", "B x M", "sinusoidal, Linear x 2"),
        Row("input_conv", "input conv", "B x 25 x T", "B x C x T"),
    ]
    if unet.context_proj is not None:
        rows.insert(0, Row("context_proj", "audio context", "B x T x 167", "B x T x X", "Linear"))
    for level, width in enumerate(widths):
        rows += level_rows("down", level, widths[max(level - 1, 0)], width)
        rows += resampled("down", level, "Conv1d, stride 2")
    same = shape(widths[-1], factors[-1])
    rows += [
        Row("middle.blocks.0", "middle ResBlock 1", same, same, film),
        Row("middle.attention", "middle Attention", same, same, attends),
        Row("middle.blocks.1", "middle ResBlock 2", same, same, film),
    ]
    for level in reversed(range(len(widths))):
        rows += resampled("up", level, "nearest, Conv1d")
        rows += level_rows("up", level, str(2 * channels[level]), widths[max(level - 1, 0)])
    predicts = f"predicts {config.diffusion.prediction_type}"
    predicts += "" if unet.conditioner is None else ", AudioConditioner included"
    return [
        *rows,
        Row("output_conv", "output conv", "B x C x T", "B x 25 x T", "starts at zero"),
        Row("", "UNet1D", "B x 25 x T", "B x 25 x T", predicts),
    ]


def decoder_rows(decoder: nn.Module, kind: str, num_layers: int, note: str) -> list[Row]:
    """One of the two decoders; the head of the phase start gives one pair of numbers a window."""
    window, hidden = "B x T x 25", "B x T x D"
    if kind == "residual":
        rows = [Row("input_proj", "input proj", window, hidden)]
        path, name, first, about = "blocks", "ResidualBlock", hidden, "MLP D -> 4D -> D"
    else:
        rows = []
        path, name, first, about = "encoder", "encoder", window, "Conv1D, LayerNorm, GELU"
    rows += [
        Row(f"{path}.{index}", f"{name} {index + 1}", hidden if index else first, hidden, about)
        for index in range(num_layers)
    ]
    for name, head in decoder.named_children():
        if isinstance(head, nn.Linear) and name.endswith("_head"):
            place = "B" if "start" in name else "B x T"
            shapes = f"{place} x D", f"{place} x {head.out_features}"
            rows.append(Row(name, name.replace("_", " "), *shapes))
    return [*rows, Row("", type(decoder).__name__, window, window, note)]
