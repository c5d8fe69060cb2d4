"""The text tower and the denoiser of an export, computed by onnxruntime, where PyTorch's stand.

Letters: B batch, L tokens, T frames, K rows, C channels, D embed dim.
"""

from dataclasses import replace
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np

from ...config_schema import ClipConfig, NetworkConfig
from ...tensors import Tensor, nn, torch
from ..checkpoint import ModelCard, read_tensors
from ..clip.features import TextFeatures, null_features
from ..onnx_card import TextOnnxCard, open_graph, run

TEXT_GRAPH, DENOISER_GRAPH = "text.onnx", "denoiser.onnx"
ADAPTED_GRAPH = "adapted.onnx"  # the denoiser with its adapters, for texts that open one


class OnnxTextTower(nn.Module):
    """What `TextTower` gives, from a graph on so many threads of the CPU; `card` is the model's."""

    def __init__(self, folder: Path, card: ModelCard, threads: int) -> None:
        super().__init__()
        self.config: ClipConfig = card.network.clip
        self.embed_dim = card.network.embed_dim
        self._folder, self._card = folder, card
        self._session = open_graph(folder, TEXT_GRAPH, threads)
        self._outputs = [each.name for each in self._session.get_outputs()]

    def forward(self, input_ids: Tensor, attention_mask: Tensor) -> TextFeatures:
        """Ids and mask [B, L] -> TextFeatures."""
        outputs = run(self._session, input_ids=input_ids, attention_mask=attention_mask)
        found = dict(zip(self._outputs, outputs, strict=True))
        mask = attention_mask.bool()
        pooled = found["pooled"]
        alike = pooled[:, None].expand(*mask.shape, self.embed_dim)  # which nobody will hear
        tokens, closeness = found.get("tokens", alike), found.get("closeness")
        return TextFeatures(pooled, tokens, mask, found.get("opened"), closeness)

    def state_dict(self, *_: Any, **__: Any) -> dict[str, Tensor]:  # type: ignore[override]
        """The weights, as of PyTorch's tower."""
        tensors = read_tensors(self._folder, self._card)
        return {
            name[len("text.") :]: each for name, each in tensors.items() if name.startswith("text.")
        }


class OnnxDenoiser(nn.Module):
    """What `MotionDenoiser` predicts, from a graph on so many threads of the CPU; called as it is,
    `card` the export's."""

    def __init__(
        self, folder: Path, config: NetworkConfig, card: TextOnnxCard, threads: int
    ) -> None:
        super().__init__()
        self.config, self.num_tags = config, card.no_tag
        self.shows_known, self.provenance_embed = card.shown, None
        self._pooled = torch.tensor(card.null_pooled)
        self._token = None if card.null_token is None else torch.tensor(card.null_token)
        self._session = cache(lambda graph: open_graph(folder, graph, threads))  # as they are used

    def forward(
        self,
        noisy: Tensor,
        timesteps: Tensor,
        text: TextFeatures,
        tag: Tensor,
        mask: Tensor | None = None,
        *,
        known: Tensor | None = None,
        provenance: Tensor | None = None,
        keys_values: object = None,
    ) -> Tensor:
        """As `MotionDenoiser.forward`; provenance and keys are the graph's own."""
        heard = {} if self._token is None else {"tokens": text.tokens, "token_mask": text.mask}
        if text.opened is not None:
            heard["opened"] = text.opened
        (prediction,) = run(
            self._session(DENOISER_GRAPH if text.opened is None else ADAPTED_GRAPH),
            x=noisy,
            t=timesteps,
            pooled=text.pooled,
            tag=tag,
            mask=np.ones(noisy.shape[:2], dtype=bool) if mask is None else mask,
            known=np.zeros(noisy.shape, dtype=bool) if known is None else known,
            **heard,
        )
        return prediction

    def text_keys_values(self, text: TextFeatures) -> list[Any]:
        """None: the graph makes them."""
        return []

    def with_adapters(self, text: TextFeatures) -> TextFeatures:
        """See `MotionDenoiser.with_adapters`: the text's graph has told."""
        return text if text.opened is None or text.opened.any() else replace(text, opened=None)

    def drop_text(self, text: TextFeatures, drop: Tensor) -> TextFeatures:
        """See `MotionDenoiser.drop_text`; all of them are dropped."""
        token = torch.zeros_like(self._pooled) if self._token is None else self._token
        null = null_features(self._pooled, token, len(text), text.mask.shape[1])
        return replace(null, opened=text.opened, closeness=text.closeness)
