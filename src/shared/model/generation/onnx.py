"""Text tower and denoiser as ONNX graphs for any batch, any text and any length.

text.onnx: input_ids and attention_mask [B, L] int64 -> pooled [B, D]; tokens [B, L, D] for a
network that hears them, opened [B, A] for one with adapters, closeness [B] of a tower with places.
denoiser.onnx: x [B, T, K, C]
z-scores, t [B], the text, tag [B], mask [B, T] (true = a real frame), known [B, T, K, C] (true =
the entry is given) -> prediction. adapted.onnx hears the weights of each sample's adapter as well
(docs/onnx.md); denoiser.onnx is the same network where no text opens one.

Letters: B batch, L tokens, T frames, K rows, C channels, D embed dim.
"""

import math
from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path

import torch
from torch import Tensor, nn

from ...errors import UserError
from ..checkpoint import CARD_FILE, WEIGHTS_FILE, read_tensors, resolve_model
from ..clip.core import SPECIAL, TextTower, TokenPairEncoder
from ..clip.features import TextFeatures
from ..clip.out_of_domain import META_FILE as SCOPE_FILE
from ..clip.out_of_domain import TABLE_FILE
from ..clip.style_map import STYLE_FILE
from ..clip.tokenizer import META_FILE, MODEL_FILE, TOKENIZER_FOLDER
from ..layers import AdaptedLinear, MultiHeadAttention
from ..onnx_card import TextOnnxCard, TokenizerInfo
from ..onnx_export import (
    EXAMPLE_FRAMES,
    SymbolicRotary,
    process_info,
    symbolic,
    traced,
    write_export,
)
from ..onnx_graphs import ADAPTED_GRAPH, DENOISER_GRAPH, TEXT_GRAPH
from .constraint import MIN_FRAMES
from .denoiser import MotionDenoiser, vectors
from .motion_generator import PROJECTED, TextToMotion, as_captured

FILES = (
    CARD_FILE,
    WEIGHTS_FILE,
    "README.md",
    SCOPE_FILE,
    TABLE_FILE,
    STYLE_FILE,
    f"{TOKENIZER_FOLDER}/{META_FILE}",
    f"{TOKENIZER_FOLDER}/{MODEL_FILE}",
)


class SymbolicPairs(TokenPairEncoder):
    """Searches by halves: ONNX has no search in an ordered table."""

    def _places(self, keys: Tensor) -> Tensor:
        last = len(self.keys) - 1
        place = torch.zeros_like(keys, dtype=torch.long)
        for bit in reversed(range(last.bit_length())):
            further = (place + (1 << bit)).clamp(max=last)
            place = torch.where(self.keys[further] <= keys, further, place)
        return place


class SymbolicAdapted(AdaptedLinear):
    """Hears the weights of each sample's adapter [B, N]: its own are those from `start` on."""

    start = 0

    def forward(self, x: Tensor, opened: Tensor | None = None) -> Tensor:
        y = nn.functional.linear(x, self.weight, self.bias)
        if opened is None:
            return y
        middle = self.start + self.rank * self.in_features
        end = middle + self.out_features * self.rank
        down = opened[:, self.start : middle].reshape(-1, self.rank, self.in_features)
        up = opened[:, middle:end].reshape(-1, self.out_features, self.rank)
        return y + x @ down.mT @ up.mT


class SymbolicAttention(MultiHeadAttention):
    """In fewer nodes than the exporter makes of PyTorch's kernel: a sixth of a pass."""

    def forward(
        self, x: Tensor, mask: Tensor | None = None, opened: Tensor | None = None
    ) -> Tensor:
        """See MultiHeadAttention; `mask` is there and has a frame of each sample."""
        assert mask is not None and isinstance(self.rotary, SymbolicRotary)
        heads = self.qkv(x, opened).unflatten(-1, (3 * self.num_heads, -1))  # [B, T, 3H, d]
        positioned, value = heads.split([2 * self.num_heads, self.num_heads], dim=2)
        query, key = self.rotary.turned(positioned).chunk(2, dim=2)
        scores = query.transpose(1, 2) @ key.permute(0, 2, 3, 1) * value.shape[-1] ** -0.5
        scores = scores + torch.where(mask, 0.0, -1e4)[:, None, None]  # [B, H, T, T]
        mixed = scores.softmax(dim=-1) @ value.transpose(1, 2)  # [B, H, T, d]
        result: Tensor = self.out(mixed.transpose(1, 2).flatten(2), opened)
        return result


class SymbolicGelu(nn.GELU):
    """In the order in which onnxruntime knows it as one operation."""

    def forward(self, x: Tensor) -> Tensor:
        """[...] -> the same."""
        return x * (1 + torch.erf(x / math.sqrt(2))) * 0.5


TWINS = {
    AdaptedLinear: SymbolicAdapted,
    MultiHeadAttention: SymbolicAttention,
    nn.GELU: SymbolicGelu,
}


class TextGraph(nn.Module):
    """A text tower that gives what its denoiser hears."""

    def __init__(self, tower: TextTower, denoiser: MotionDenoiser) -> None:
        super().__init__()
        self.tower = symbolic(tower, {TokenPairEncoder: SymbolicPairs})
        self.denoiser = denoiser
        self.outputs = ["pooled"] + ["tokens"] * denoiser.uses_tokens
        self.outputs += ["opened"] * bool(denoiser.config.generation.adapter_ranks)
        self.outputs += ["closeness"] * bool(tower.config.text_places)

    def forward(self, input_ids: Tensor, attention_mask: Tensor) -> tuple[Tensor, ...]:
        """Ids and mask [B, L] -> pooled [B, D], tokens [B, L, D], opened [B, A], closeness [B]."""
        features = self.tower(input_ids, attention_mask)
        if "opened" in self.outputs:
            features = replace(features, opened=self.denoiser.opened(features.pooled))
        return tuple(getattr(features, name) for name in self.outputs)


class DenoiserGraph(nn.Module):
    """A denoiser whose inputs are tensors all; motion is to look captured.

    Args:
        denoiser: trained.
        more: names of its last inputs, of tokens, token_mask and adapter.
    """

    def __init__(self, denoiser: MotionDenoiser, more: Sequence[str]) -> None:
        super().__init__()
        self.denoiser, self.more = symbolic(denoiser, TWINS), more
        self.numbers = 0  # N, of the weights of an adapter
        for _, part in sorted(self.denoiser.named_modules()):
            if isinstance(part, SymbolicAdapted) and part.adapters:
                part.start = self.numbers
                self.numbers += part.rank * (part.in_features + part.out_features)

    def forward(
        self,
        x: Tensor,
        t: Tensor,
        pooled: Tensor,
        tag: Tensor,
        mask: Tensor,
        known: Tensor,
        *others: Tensor,
    ) -> Tensor:
        """See this module's head."""
        more = dict(zip(self.more, others, strict=True))
        tokens, token_mask = more.get("tokens"), more.get("token_mask")
        if tokens is None or token_mask is None:
            tokens = pooled[:, None]
            token_mask = torch.ones_like(pooled[:, :1], dtype=torch.bool)
        text = TextFeatures(pooled, tokens, token_mask, more.get("adapter"))
        told = {
            "known": known if self.denoiser.shows_known else None,
            "provenance": as_captured(self.denoiser, tag),
        }
        result: Tensor = self.denoiser(x, t, text, tag, mask, **told)
        return result


def _check_changed(denoiser: MotionDenoiser, source: Path) -> None:
    """Raises UserError where weights that change with an adapter or for one step are alike: a graph
    keeps one for all that are."""
    one_step, changed = denoiser.one_step, list[Tensor]()
    if one_step is not None:
        changed = [denoiser.get_parameter(name) for name in one_step.weights(denoiser)]
    elif denoiser.config.generation.adapter_ranks:
        changed = [m.weight for m in denoiser.modules() if isinstance(m, AdaptedLinear)]
    if alike := len(changed) - len({each.detach().numpy().tobytes() for each in changed}):
        raise UserError(
            f"{source}: {alike} of the weights that an adapter or a learned step changes are like"
            " others, so that a graph cannot tell them apart; train the model on, then export it"
        )


def export_text(model: str | Path, folder: str | Path) -> TextOnnxCard:
    """Write a model folder with both graphs, and the card that vouches for them.

    Args:
        model: name of shipped weights, or a folder that training wrote.
        folder: made when absent; may be the model's own.

    Raises:
        UserError: no such model, or the folder cannot be written.
    """
    source, folder = resolve_model(model), Path(folder)
    generator = TextToMotion.from_pretrained(source, device="cpu")
    denoiser, config = generator.denoiser, generator.network
    _check_changed(denoiser, source)
    if generator.card.network.generation.adapter_ranks and not any(
        PROJECTED in name for name in read_tensors(source, generator.card)
    ):
        raise UserError(
            f"{source} is from before adapters had a share of the output projection; write it anew"
            " (TextToMotion.from_pretrained(old).save_pretrained(new)) and export that"
        )
    rows, channels = generator.mean.shape
    frames, dim, tokens = EXAMPLE_FRAMES, config.embed_dim, denoiser.uses_tokens
    batch, whole = {0: "batch"}, {0: "batch", 1: "frames"}
    ids = torch.randint(SPECIAL, 64, (2, 7))
    words = {0: "batch", 1: "tokens"}
    tower = TextGraph(generator.text, denoiser)
    text = traced(
        tower,
        {"input_ids": (ids, words), "attention_mask": (torch.ones_like(ids), words)},
        tower.outputs,
    )
    shape = (2, frames, rows, channels)
    more: dict[str, tuple[Tensor, dict[int, str]]] = {}
    if tokens:
        more["tokens"] = (torch.randn(2, 7, dim), words)
        more["token_mask"] = (torch.ones(2, 7, dtype=torch.bool), words)
    variants = {DENOISER_GRAPH: more}
    if config.generation.adapter_ranks:
        numbers = DenoiserGraph(denoiser, ()).numbers
        variants[ADAPTED_GRAPH] = more | {"adapter": (torch.zeros(2, numbers), batch)}
    networks = {
        graph: traced(
            DenoiserGraph(denoiser, list(heard)),
            {
                "x": (torch.randn(shape), whole),
                "t": (torch.tensor([1, 2]), batch),
                "pooled": (torch.randn(2, dim), batch),
                "tag": (torch.tensor([0, 0]), batch),
                "mask": (torch.ones(shape[:2], dtype=torch.bool), whole),
                "known": (torch.zeros(shape, dtype=torch.bool), whole),
                **heard,
            },
            ("prediction",),
        )
        for graph, heard in variants.items()
    }
    card, tokenizer = generator.card, generator.tokenizer
    shifted = tuple(f"denoiser.{name}" for name in vectors(denoiser)) if denoiser.one_step else ()
    # Written only now: who stops the slow part leaves no folder behind.
    return write_export(
        source,
        folder,
        FILES,
        {TEXT_GRAPH: text, **networks},
        TextOnnxCard,
        card,
        also_ready=tuple(variants),
        process=process_info(generator.diffusion, config.generation.guidance_scale),
        mean=tuple(map(tuple, generator.mean.tolist())),
        std=tuple(map(tuple, generator.std.tolist())),
        null_pooled=tuple(denoiser.null_pooled.tolist()),
        null_token=tuple(denoiser.null_token.tolist()) if tokens else None,
        tags=card.tags,
        no_tag=denoiser.num_tags,
        languages=card.languages,
        shown=denoiser.shows_known,
        shifted=shifted,
        max_seconds=card.max_seconds,
        min_frames=MIN_FRAMES,
        tokenizer=TokenizerInfo(
            kind=tokenizer.kind,
            file=f"{TOKENIZER_FOLDER}/{MODEL_FILE}",
            max_tokens=tokenizer.max_tokens,
        ),
        post_processing=config.generation.post_processing,
    )
