"""Text tower and denoiser as ONNX graphs for any batch, any text and any length.

text.onnx: input_ids and attention_mask [B, L] int64 -> pooled [B, D], and tokens [B, L, D] for a
network that hears them. denoiser.onnx: x [B, T, K, C] z-scores, t [B], the text, tag [B], mask
[B, T] (true = a real frame), known [B, T, K, C] (true = the entry is given) -> prediction.

Letters: B batch, L tokens, T frames, K rows, C channels, D embed dim.
"""

from pathlib import Path

import torch
from torch import Tensor, nn

from ...config_schema import PROVENANCES
from ..checkpoint import CARD_FILE, WEIGHTS_FILE, resolve_model
from ..clip.core import SPECIAL, TextFeatures, TextTower, TokenPairEncoder
from ..clip.out_of_domain import META_FILE as SCOPE_FILE
from ..clip.out_of_domain import TABLE_FILE
from ..clip.pretrained import STYLE_FILE, TOKENIZER_FOLDER
from ..clip.tokenizer import META_FILE, MODEL_FILE
from ..onnx_card import ONNX_CARD, TextOnnxCard, TokenizerInfo
from ..onnx_export import (
    EXAMPLE_FRAMES,
    copy_model,
    process_info,
    symbolic,
    traced,
    write_card,
    write_graph,
)
from .denoiser import MotionDenoiser
from .motion_generator import MIN_FRAMES, TextToMotion

TEXT_GRAPH, DENOISER_GRAPH = "text.onnx", "denoiser.onnx"
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


class TextGraph(nn.Module):
    """A text tower that gives what its denoiser hears."""

    def __init__(self, tower: TextTower, *, tokens: bool) -> None:
        super().__init__()
        self.tower = symbolic(tower, {TokenPairEncoder: SymbolicPairs})
        self.tokens = tokens

    def forward(self, input_ids: Tensor, attention_mask: Tensor) -> tuple[Tensor, ...]:
        """Ids and mask [B, L] -> pooled [B, D], and tokens [B, L, D]."""
        features = self.tower(input_ids, attention_mask)
        return (features.pooled, features.tokens) if self.tokens else (features.pooled,)


class DenoiserGraph(nn.Module):
    """A denoiser whose inputs are tensors all; motion is to look captured."""

    def __init__(self, denoiser: MotionDenoiser) -> None:
        super().__init__()
        self.denoiser = symbolic(denoiser)

    def forward(
        self,
        x: Tensor,
        t: Tensor,
        pooled: Tensor,
        tag: Tensor,
        mask: Tensor,
        known: Tensor,
        tokens: Tensor | None = None,
        token_mask: Tensor | None = None,
    ) -> Tensor:
        """See this module's head."""
        if tokens is None or token_mask is None:
            tokens = pooled[:, None]
            token_mask = torch.ones_like(pooled[:, :1], dtype=torch.bool)
        provenance = None
        if self.denoiser.provenance_embed is not None:
            provenance = torch.full_like(tag, PROVENANCES.index("captured"))
        result: Tensor = self.denoiser(
            x,
            t,
            TextFeatures(pooled, tokens, token_mask),
            tag,
            mask,
            known=known if self.denoiser.known_proj is not None else None,
            provenance=provenance,
        )
        return result


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
    rows, channels = generator.mean.shape
    frames, dim, tokens = EXAMPLE_FRAMES, config.embed_dim, denoiser.uses_tokens
    batch, whole = {0: "batch"}, {0: "batch", 1: "frames"}
    ids = torch.randint(SPECIAL, 64, (2, 7))
    words = {0: "batch", 1: "tokens"}
    text = traced(
        TextGraph(generator.text, tokens=tokens),
        {"input_ids": (ids, words), "attention_mask": (torch.ones_like(ids), words)},
        ("pooled", "tokens") if tokens else ("pooled",),
    )
    shape = (2, frames, rows, channels)
    heard = {
        "tokens": (torch.randn(2, 7, dim), words),
        "token_mask": (torch.ones(2, 7, dtype=torch.bool), words),
    }
    network = traced(
        DenoiserGraph(denoiser),
        {
            "x": (torch.randn(shape), whole),
            "t": (torch.tensor([1, 2]), batch),
            "pooled": (torch.randn(2, dim), batch),
            "tag": (torch.tensor([0, 0]), batch),
            "mask": (torch.ones(shape[:2], dtype=torch.bool), whole),
            "known": (torch.zeros(shape, dtype=torch.bool), whole),
            **(heard if tokens else {}),
        },
        ("prediction",),
    )
    # Written only now: who stops the slow part leaves no folder behind.
    copy_model(source, folder, FILES)
    graphs = {
        TEXT_GRAPH: write_graph(text, folder / TEXT_GRAPH),
        DENOISER_GRAPH: write_graph(network, folder / DENOISER_GRAPH),
    }
    card, tokenizer = generator.card, generator.tokenizer
    result = TextOnnxCard(
        name=card.name,
        description=card.description,
        licence=card.licence,
        trained=card.trained,
        model=card.content_hash,
        fps=card.fps,
        graphs=graphs,
        process=process_info(generator.diffusion, config.generation.guidance_scale),
        mean=tuple(map(tuple, generator.mean.tolist())),
        std=tuple(map(tuple, generator.std.tolist())),
        null_pooled=tuple(denoiser.null_pooled.tolist()),
        null_token=tuple(denoiser.null_token.tolist()) if tokens else None,
        tags=card.tags,
        no_tag=denoiser.num_tags,
        languages=card.languages,
        shown=denoiser.known_proj is not None,
        max_seconds=card.max_seconds,
        min_frames=MIN_FRAMES,
        tokenizer=TokenizerInfo(
            kind=tokenizer.kind,
            file=f"{TOKENIZER_FOLDER}/{MODEL_FILE}",
            max_tokens=tokenizer.max_tokens,
        ),
        post_processing=config.generation.post_processing,
    )
    write_card(folder / ONNX_CARD, result)
    return result
