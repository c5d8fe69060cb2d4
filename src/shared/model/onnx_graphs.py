"""The graphs of an export in onnxruntime: its text tower and denoiser, where PyTorch's stand.

Letters: B batch, L tokens, T frames, K rows, C channels, D embed dim.
"""

import copy
from collections.abc import Sequence
from dataclasses import replace
from functools import cache, lru_cache
from importlib.util import find_spec
from pathlib import Path
from typing import Any

import numpy as np

from ..config_schema import ClipConfig, NetworkConfig
from ..errors import UserError
from ..tensors import Tensor, nn, torch
from .checkpoint import ADAPTERS, INT8_SCALE, WEIGHTS_FILE, ModelCard, read_tensors
from .clip.features import TextFeatures, null_features
from .onnx_card import TextOnnxCard

TEXT_GRAPH, DENOISER_GRAPH = "text.onnx", "denoiser.onnx"
ADAPTED_GRAPH = "adapted.onnx"  # the denoiser with an adapter, for texts that open one
ONE_STEP = "one-step-"  # before both names: the same, learned to go from noise to motion at once


def require_packages(*names: str) -> None:
    """Raises UserError, naming the extra, when a package of it is missing."""
    missing = [name for name in names if find_spec(name) is None]
    if missing:
        raise UserError(
            f"ONNX needs the package {' and '.join(missing)}, which is not installed;"
            " install the project with its extra `onnx`, or:"
            " pip install onnx onnxscript onnxruntime"
        )


def open_graph(folder: Path, name: str, threads: int, *, spinning: bool = True) -> Any:
    """An onnxruntime session of a graph, on so many threads of the CPU.

    Args:
        spinning: whether threads that have nothing to do wait for work in a loop. Large products
            are done sooner so; between many small ones it takes the core from those that work.

    Raises:
        UserError: the package is missing, or it cannot load the graph.
    """
    require_packages("onnxruntime")
    import onnxruntime

    options = onnxruntime.SessionOptions()
    options.intra_op_num_threads = threads
    options.log_severity_level = 3  # errors
    # What runs in between, or another session's threads, wants the cores.
    options.add_session_config_entry("session.force_spinning_stop", "1")
    if not spinning:
        options.add_session_config_entry("session.intra_op.allow_spinning", "0")
    options.enable_mem_reuse = False  # what plans it is half of opening; buffers are freed anyhow
    try:
        return onnxruntime.InferenceSession(
            str(folder / name), options, providers=["CPUExecutionProvider"]
        )
    except Exception as error:  # onnxruntime's own types derive from it directly
        reason = str(error).splitlines()[0]
        raise UserError(
            f"onnxruntime cannot load {folder / name} ({reason}); update it, or export again"
        ) from error


def run(session: Any, **inputs: Tensor | np.ndarray) -> list[Tensor]:
    """All outputs of a session, by the names of its inputs."""
    arrays = {name: np.ascontiguousarray(values) for name, values in inputs.items()}
    return [torch.from_numpy(array) for array in session.run(None, arrays)]


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
        mask, pooled = attention_mask.bool(), found["pooled"]
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
        self._before, self._has_one_step = "", ONE_STEP + DENOISER_GRAPH in card.graphs
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
            self._session(
                self._before + (DENOISER_GRAPH if text.opened is None else ADAPTED_GRAPH)
            ),
            x=noisy,
            t=timesteps,
            pooled=text.pooled,
            tag=tag,
            mask=np.ones(noisy.shape[:2], dtype=bool) if mask is None else mask,
            known=np.zeros(noisy.shape, dtype=bool) if known is None else known,
            **heard,
        )
        return prediction

    def in_one_step(self) -> "OnnxDenoiser | None":
        """See `MotionDenoiser.in_one_step`."""
        if not self._has_one_step:
            return None
        changed = copy.copy(self)
        changed._before = ONE_STEP
        return changed

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
