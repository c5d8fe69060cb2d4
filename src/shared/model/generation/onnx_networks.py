"""The text tower and the denoiser of an export, computed by onnxruntime, where PyTorch's stand.

Letters: B batch, L tokens, T frames, K rows, C channels, D embed dim.
"""

from collections.abc import Sequence
from dataclasses import replace
from functools import cache, lru_cache
from pathlib import Path
from typing import Any

import numpy as np

from ...config_schema import ClipConfig, NetworkConfig
from ...tensors import Tensor, nn, torch
from ..checkpoint import INT8_SCALE, WEIGHTS_FILE, ModelCard, read_tensors
from ..clip.features import TextFeatures, null_features
from ..onnx_card import TextOnnxCard, open_graph, run

TEXT_GRAPH, DENOISER_GRAPH = "text.onnx", "denoiser.onnx"
ADAPTED_GRAPH = "adapted.onnx"  # the denoiser with an adapter, for texts that open one
ADAPTERS = ".adapters."


def adapter_weights(folder: Path, opened: Sequence[float]) -> np.ndarray:
    """What adapted.onnx hears [N]: the weights of the adapter that is opened, zeros for none.

    Of each map that has adapters, by their names in model.safetensors, the first map [R, D], then
    the second [D', R], row by row, filled up with zeros to the largest rank R.

    Args:
        folder: of the export.
        opened: [A] of zeros and at most one 1.
    """
    from safetensors import safe_open

    with safe_open(folder / WEIGHTS_FILE, "np") as stored:
        names = set(stored.keys())
        first = sorted(name for name in names if name.endswith(f"{ADAPTERS}0.0.weight"))
        shapes = [stored.get_slice(name).get_shape()
                  for at in range(len(opened)) for name in [_of_adapter(first[0], at)]]  # fmt: skip
        rank, own = max(height for height, _ in shapes), [*opened].index(1) if any(opened) else None
        parts = []
        for down in first:
            up = down.replace(f"{ADAPTERS}0.0", f"{ADAPTERS}0.1")
            sizes = ((rank, stored.get_slice(down).get_shape()[1]),
                     (stored.get_slice(up).get_shape()[0], rank))  # fmt: skip
            for name, size in zip((down, up), sizes, strict=True):
                whole = np.zeros(size, np.float32)
                if own is not None:
                    name = _of_adapter(name, own)
                    part = stored.get_tensor(name).astype(np.float32)
                    if name + INT8_SCALE in names:
                        part = part * stored.get_tensor(name + INT8_SCALE)[:, None]
                    whole[: len(part), : part.shape[1]] = part
                parts.append(whole.ravel())
    return np.concatenate(parts)


def _of_adapter(name: str, at: int) -> str:
    """The tensor of adapter 0 of another one."""
    return name.replace(f"{ADAPTERS}0.", f"{ADAPTERS}{at}.")


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
        own = cache(lambda opened: adapter_weights(folder, opened))
        self._adapters = lru_cache(1)(lambda opened: np.stack([*map(own, opened)]))

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
        heard = dict[str, Tensor | np.ndarray]()
        if self._token is not None:
            heard |= {"tokens": text.tokens, "token_mask": text.mask}
        if text.opened is not None:
            heard["adapter"] = self._adapters(tuple(map(tuple, text.opened.tolist())))
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
