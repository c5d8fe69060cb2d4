"""The graphs of an export in onnxruntime: its text tower and denoiser, where PyTorch's stand.

Letters: B batch, L tokens, T frames, K rows, C channels, D embed dim.
"""

import copy
from collections.abc import Mapping
from dataclasses import replace
from functools import lru_cache
from importlib.util import find_spec
from pathlib import Path
from typing import Any

import numpy as np

from ..config_schema import ClipConfig, NetworkConfig
from ..errors import UserError
from ..tensors import Tensor, nn, torch
from .checkpoint import ADAPTERS, INT8_SCALE, WEIGHTS_FILE, ModelCard, read_tensors
from .clip.features import TextFeatures, null_features
from .onnx_card import READY, TURNED, TextOnnxCard

TEXT_GRAPH, DENOISER_GRAPH = "text.onnx", "denoiser.onnx"
ADAPTED_GRAPH = "adapted.onnx"  # the denoiser with an adapter, for texts that open one
STEP = "denoiser.one_step."  # before the names of what changes it for a single step
SESSIONS = 14  # at most that are open: adapters, with one step and without; some 30 MB each


def require_packages(*names: str) -> None:
    """Raises UserError, naming the extra, when a package of it is missing."""
    missing = [name for name in names if find_spec(name) is None]
    if missing:
        raise UserError(
            f"ONNX needs the package {' and '.join(missing)}, which is not installed;"
            " install the project with its extra `onnx`, or:"
            " pip install onnx onnxscript onnxruntime"
        )


def open_graph(
    folder: Path,
    name: str,
    threads: int,
    *,
    spinning: bool = True,
    weights: Mapping[str, np.ndarray] | None = None,
) -> Any:
    """An onnxruntime session of a graph, on so many threads of the CPU.

    Args:
        weights: of a graph that is ready, by their names.
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
    if weights is not None:
        level = onnxruntime.GraphOptimizationLevel
        options.graph_optimization_level = level.ORT_DISABLE_ALL  # the graph is optimised
        values = [onnxruntime.OrtValue.ortvalue_from_numpy(each) for each in weights.values()]
        options.add_external_initializers(list(weights), values)
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


def denoiser_weights(
    folder: Path, card: TextOnnxCard, adapter: int, one_step: bool
) -> dict[str, np.ndarray]:
    """What a ready graph of a denoiser reads, by name: as one of its adapters changes it (Hu et al.
    2022, LoRA, equation 3), and as it goes from noise to motion at once (`OneStep`).

    Args:
        folder: of the export.
        adapter: which is open; -1: none.
    """
    from safetensors import safe_open

    with safe_open(folder / WEIGHTS_FILE, "np") as stored:
        names = set(stored.keys())

        def floats(name: str) -> np.ndarray:
            value = stored.get_tensor(name).astype(np.float32)
            if name + INT8_SCALE in names:
                scale = stored.get_tensor(name + INT8_SCALE)
                value *= scale.reshape(-1, *[1] * (value.ndim - 1))
            return np.asarray(value)

        shifts = dict[str, np.ndarray]()
        if one_step:
            rows, at = floats(f"{STEP}shifts"), 0
            for name in card.shifted:
                size = stored.get_slice(name).get_shape()[0]
                shifts[name] = rows[at:].ravel()[:size]
                at += -(-size // rows.shape[1])
        found = dict[str, np.ndarray]()
        for path in card.graphs[READY + DENOISER_GRAPH].weights:
            name = path.removesuffix(TURNED)
            value, key = floats(name), name.removeprefix("denoiser.").replace(".", "_")
            down = f"{name.removesuffix('weight')}{ADAPTERS[1:]}{adapter}.0.weight"
            if one_step and f"{STEP}down.{key}" in names:
                value += floats(f"{STEP}up.{key}") @ floats(f"{STEP}down.{key}")
            elif name in shifts:
                value += shifts[name]
            if down in names:
                value += floats(down.replace(".0.weight", ".1.weight")) @ floats(down)
            turned = value.T if path != name else value
            found[path] = turned.copy(order="C")
        return found


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

    one_adapter = True  # samples of a batch should open the same one: each has a session

    def __init__(
        self, folder: Path, config: NetworkConfig, card: TextOnnxCard, threads: int
    ) -> None:
        super().__init__()
        self.config, self.num_tags = config, card.no_tag
        self._one_step, self._has_one_step = False, bool(card.shifted)
        self.shows_known, self.provenance_embed = card.shown, None
        self._pooled = torch.tensor(card.null_pooled)
        self._token = None if card.null_token is None else torch.tensor(card.null_token)

        @lru_cache(SESSIONS)
        def session(adapter: int, one_step: bool) -> Any:
            weights = denoiser_weights(folder, card, adapter, one_step)
            return open_graph(folder, READY + DENOISER_GRAPH, threads, weights=weights)

        self._session = session  # as they are used

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
        heard |= {
            "x": noisy,
            "t": timesteps,
            "pooled": text.pooled,
            "tag": tag,
            "mask": np.ones(noisy.shape[:2], dtype=bool) if mask is None else mask,
            "known": np.zeros(noisy.shape, dtype=bool) if known is None else known,
        }
        adapters = np.full(len(noisy), -1)
        if text.opened is not None:
            opened = np.asarray(text.opened)
            adapters = np.where(opened.any(1), opened.argmax(1), -1)
        prediction = np.empty(noisy.shape, np.float32)
        for adapter in np.unique(adapters).tolist():
            rows = adapters == adapter
            own = {name: np.asarray(values)[rows] for name, values in heard.items()}
            prediction[rows] = run(self._session(adapter, self._one_step), **own)[0]
        return torch.from_numpy(prediction)

    def in_one_step(self) -> "OnnxDenoiser | None":
        """See `MotionDenoiser.in_one_step`."""
        if not self._has_one_step:
            return None
        changed = copy.copy(self)
        changed._one_step = True
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
