"""Run a profile's networks once on random input and compare every stage with the document.

Letters: B batch, T frames, T' pieces after the strided convolutions, K bones, C channels,
D embed dim, L text tokens, H_text width of the text encoder. "K+1" counts the root track.
"""

from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from typing import Any

import torch
from torch import Tensor, nn

from ..shared.config_schema import ClipConfig, NetworkConfig
from ..shared.model.clip.core import MotionClip, TextFeatures
from ..shared.model.generation.denoiser import MotionDenoiser
from ..shared.motion.postprocess.whole import clamp_velocity, smooth_features
from ..shared.motion.rotations import matrix_to_quaternion, rotation_6d_to_matrix

BATCH, FRAMES, TOKENS, NUM_TAGS, FPS = 2, 40, 12, 5, 30.0
QUARTER, PIECES = FRAMES // 4, FRAMES // 8  # after the stride-4 and the stride-2 convolution
# Published sizes of the two hub models, so that checking shapes downloads nothing.
XLM_R_SIZES = {
    "xlm-roberta-base": {"text_hidden_size": 768, "text_num_layers": 12, "text_num_heads": 12},
    "xlm-roberta-large": {"text_hidden_size": 1024, "text_num_layers": 24, "text_num_heads": 16},
}
XLM_R_VOCABULARY, XLM_R_POSITIONS = 250_002, 512


@dataclass(frozen=True)
class Stage:
    """One row of the table: what went in, what came out, and what TEXT says of both."""

    network: str
    name: str
    symbols: tuple[str, str]
    shapes: tuple[tuple[int, ...], tuple[int, ...]]
    expected: tuple[tuple[int, ...], tuple[int, ...]]
    parameters: int = 0
    note: str = ""

    @property
    def agrees(self) -> bool:
        """Whether both shapes are the document's."""
        return self.shapes == self.expected


@dataclass(frozen=True)
class Row:
    """What TEXT's tables say of one module: its path in the network, and its shapes in letters."""

    path: str
    name: str
    before: str
    after: str
    note: str = ""


class Letters:
    """The numbers behind the letters of one profile."""

    def __init__(self, values: dict[str, int]) -> None:
        self.values = values

    def shape(self, symbols: str) -> tuple[int, ...]:
        """`B x T x D` -> (2, 40, 128); plain numbers stand for themselves."""
        return tuple(self.values.get(part) or int(part) for part in symbols.split(" x "))

    def stage(
        self, network: str, row: Row, before: Tensor, after: Tensor, parameters: int = 0
    ) -> Stage:
        """The stage with its measured shapes beside the expected ones."""
        return Stage(
            network,
            row.name,
            (row.before, row.after),
            (tuple(before.shape), tuple(after.shape)),
            (self.shape(row.before), self.shape(row.after)),
            parameters,
            row.note,
        )


class TextLetters(Letters):
    """Those of TEXT."""

    def __init__(self, config: NetworkConfig, hidden: int) -> None:
        bones, channels = config.generation.num_bones, config.generation.motion_channels
        self.rows = "(K+1)" if config.root_track else "K"
        super().__init__(
            {
                "B": BATCH,
                "T": FRAMES,
                "T/4": QUARTER,
                "T'": PIECES,
                "L": TOKENS,
                "K": bones,
                "(K+1)": bones + 1,
                "C": channels,
                "K*C": bones * channels,
                "(K+1)*C": (bones + 1) * channels,
                "D": config.embed_dim,
                "H_text": hidden,
            }
        )


def count(module: nn.Module) -> int:
    """Parameters of a module."""
    return sum(parameter.numel() for parameter in module.parameters())


@contextmanager
def traced(module: nn.Module, paths: list[str]) -> Iterator[dict[str, tuple[Tensor, Tensor]]]:
    """Collect the first tensor in and the tensor out of each submodule during a forward pass."""
    seen: dict[str, tuple[Tensor, Tensor]] = {}

    def hook(path: str) -> Any:
        def record(_: nn.Module, args: tuple[Any, ...], kwargs: dict[str, Any], out: Any) -> None:
            before = args[0] if args else next(iter(kwargs.values()))
            seen[path] = (before, getattr(out, "last_hidden_state", out))

        return record

    handles = [
        module.get_submodule(path).register_forward_hook(hook(path), with_kwargs=True)
        for path in paths
    ]
    try:
        yield seen
    finally:
        for handle in handles:
            handle.remove()


def trace(
    network: str, module: nn.Module, rows: list[Row], letters: Letters, *inputs: Any
) -> tuple[list[Stage], Any]:
    """One forward pass; returns a stage for each row and the output."""
    with torch.no_grad(), traced(module, [row.path for row in rows]) as seen:
        out = module(*inputs)
    stages = [
        letters.stage(network, row, *seen[row.path], count(module.get_submodule(row.path)))
        for row in rows
    ]
    return stages, out


# ---------------------------------------------------------------- MotionDenoiser


def block_rows(index: int, *, tokens: bool) -> list[Row]:
    """TEXT's DenoiserBlock table for one block."""
    same = "B x T x D"
    layers = [
        ("temporal", "TemporalLayer", "self-attention, FFN 4D"),
        ("film", "FiLM", "Linear 2D -> 2D"),
        ("norm", "LayerNorm", ""),
        ("attention", "MHA", "RoPE on q and k, residual"),
        *([("cross_attention", "CrossAttention", "ruling 22")] if tokens else []),
        ("adaln", "AdaLN", "Linear 2D -> 2D"),
        ("transform", "TransformLayer", "FFN D -> 4D -> D"),
    ]
    return [
        Row(f"blocks.{index}.{path}", f"block {index + 1} {name}", same, same, note)
        for path, name, note in layers
    ]


def denoiser_rows(config: NetworkConfig, rows: str) -> list[Row]:
    """TEXT's MotionDenoiser table."""
    tokens = config.generation.text_conditioning == "tokens"
    frame = f"B x T x {rows}*C"
    blocks = [block_rows(index, tokens=tokens) for index in range(config.generation.num_layers)]
    return [
        Row("motion_proj", "motionProj", frame, "B x T x D", "Linear K*C -> D"),
        Row("text_proj", "textProj", "B x D", "B x D", "expanded across T"),
        Row("timestep_embed", "timestepEmbed", "B", "B x D", "sinusoidal, MLP D -> 4D -> D"),
        Row("tag_embed", "tagEmbed", "B", "B x D", "numTags + 1, the last for none"),
        *[row for block in blocks for row in block],
        Row("output_norm", "LayerNorm", "B x T x D", "B x T x D"),
        Row("output_proj", "outputProj", "B x T x D", frame, "Linear D -> K*C"),
    ]


def random_text(config: NetworkConfig, device: torch.device) -> TextFeatures:
    """Stand-in for the text tower in the fast check."""
    pooled = nn.functional.normalize(torch.randn(BATCH, config.embed_dim, device=device), dim=-1)
    tokens = torch.randn(BATCH, TOKENS, config.embed_dim, device=device)
    return TextFeatures(pooled, tokens, torch.ones(tokens.shape[:2], dtype=torch.bool).to(device))


def denoiser_stages(
    config: NetworkConfig, device: torch.device, text: TextFeatures | None = None
) -> tuple[list[Stage], Tensor]:
    """The denoiser's stages, and a sample [B, T, K(+1), C] for the post-processing.

    `text` comes from the text tower in the full check; otherwise it is random.
    """
    letters = TextLetters(config, 0)
    with device:
        model = MotionDenoiser(config, NUM_TAGS).eval()
        generation = config.generation
        noisy = torch.randn(BATCH, FRAMES, config.motion_rows, generation.motion_channels)
        steps = torch.full((BATCH,), generation.diffusion_steps - 1)
        tag = torch.full((BATCH,), NUM_TAGS)
    text = text or random_text(config, device)
    rows = denoiser_rows(config, letters.rows)
    stages, out = trace("MotionDenoiser", model, rows, letters, noisy, steps, text, tag)
    motion = f"B x T x {letters.rows} x C"
    whole = Row("", "MotionDenoiser", motion, motion, f"predicts {generation.prediction_type}")
    return [*stages, letters.stage("MotionDenoiser", whole, noisy, out, count(model))], noisy


# ---------------------------------------------------------------- post-processing


def post_processing_stages(config: NetworkConfig, sample: Tensor) -> list[Stage]:
    """Smoothing, 6D -> matrix -> quaternion, velocity clamp; only smoothing unless C = 6."""
    letters, settings = TextLetters(config, 0), config.generation.post_processing
    name = "post-processing"
    smooth = smooth_features(sample, settings.smoothing_kernel)
    motion, kernel = f"B x T x {letters.rows} x C", f"kernel {settings.smoothing_kernel}"
    smoothing = Row("", "smoothing", motion, motion, f"depthwise Conv1D, {kernel}")
    stages = [letters.stage(name, smoothing, sample, smooth)]
    if config.generation.motion_channels != 6:
        return stages
    rotations = smooth[:, :, : config.generation.num_bones]
    matrix = rotation_6d_to_matrix(rotations)
    quaternion = matrix_to_quaternion(matrix)
    clamped = clamp_velocity(quaternion, settings.max_velocity, FPS)
    limit = "off" if settings.max_velocity is None else f"{settings.max_velocity:g} rad/s"
    turn, four = "B x T x K x 3 x 3", "B x T x K x 4"
    rows = [
        (Row("", "renormalization", "B x T x K x C", turn, "Gram-Schmidt"), rotations, matrix),
        (Row("", "quaternion", turn, four, "w x y z"), matrix, quaternion),
        (Row("", "velocity clamp", four, four, limit), quaternion, clamped),
    ]
    return [*stages, *(letters.stage(name, *row) for row in rows)]


# ---------------------------------------------------------------- CLIP


def without_download(clip: ClipConfig) -> ClipConfig:
    """The same tower with the published sizes spelled out, for the two hub models we name."""
    sizes = XLM_R_SIZES.get(clip.text_model)
    if sizes is None:
        return clip
    extra = {"text_vocab_size": XLM_R_VOCABULARY, "max_tokens": XLM_R_POSITIONS}
    return clip.model_copy(update={"text_model": "small", **sizes, **extra})


def clip_stages(config: NetworkConfig, device: torch.device) -> tuple[list[Stage], TextFeatures]:
    """Both towers of CLIP, and the texts' features; XLM-R has its published size."""
    clip = without_download(config.clip)
    note = "random weights, nothing downloaded" if clip.text_model == "small" else ""
    config = config.model_copy(update={"clip": clip})
    with device:
        model = MotionClip(config).eval()
        ids = torch.randint(3, clip.text_vocab_size, (BATCH, TOKENS))
        mask = torch.ones(BATCH, TOKENS, dtype=torch.long)
        motion = torch.randn(BATCH, FRAMES, config.motion_rows, config.generation.motion_channels)
    letters = TextLetters(config, model.text.encoder.config.hidden_size)
    text, features = trace("CLIP text", model.text, text_rows(note), letters, ids, mask)
    unit = Row("", "TextTower", "B x L", "B x D", "masked mean, textProj, unit norm")
    text.append(letters.stage("CLIP text", unit, ids, features.pooled, count(model.text)))
    rows = motion_rows(config, letters.rows)
    tower, pooled = trace("CLIP motion", model.motion, rows, letters, motion)
    with torch.no_grad():
        embedding = model.encode_motion(motion)
    motion_frame = f"B x T x {letters.rows} x C"
    ends = [
        (Row("", "TemporalUNet", motion_frame, "B x D"), motion, pooled, count(model.motion)),
        (Row("", "motionProj", "B x D", "B x D"), pooled, embedding, count(model.motion_proj)),
    ]
    tower += [letters.stage("CLIP motion", *end) for end in ends]
    logits = features.pooled @ embedding.T * model.scale()
    loss = Row("", "similarity", "B x D", "B x B", "contrastive + cosine loss")
    return [*text, *tower, letters.stage("CLIP", loss, features.pooled, logits, 1)], features


def text_rows(note: str) -> list[Row]:
    """TEXT's CLIP text encoder table."""
    return [
        Row("encoder", "XLM-Roberta", "B x L", "B x L x H_text", note),
        Row("text_proj", "textProj", "B x H_text", "B x D", "Linear H_text -> D"),
    ]


def motion_rows(config: NetworkConfig, rows: str) -> list[Row]:
    """TEXT's TemporalUNet table."""
    same = "B x T' x D"
    layers = [
        Row(f"layers.{index}", f"transformer {index + 1}", same, same, "FFN 2D")
        for index in range(config.clip.motion_num_layers)
    ]
    return [
        Row("input_proj", "input projection", f"B x T x {rows}*C", "B x T x D"),
        Row("conv4", "temporal conv", "B x D x T", "B x D x T/4", "stride 4"),
        Row("conv2", "temporal conv", "B x D x T/4", "B x D x T'", "stride 2"),
        *layers,
        Row("norm", "LayerNorm", same, same, "then the mean over T'"),
        Row("output_proj", "output proj", "B x D", "B x D"),
    ]
