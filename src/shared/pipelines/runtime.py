"""PyTorch or onnxruntime: what SongSampler needs of a model, whoever computes it.

Letters: B samples, T frames.
"""

import logging
from functools import lru_cache
from pathlib import Path
from typing import TYPE_CHECKING, Any, Protocol, Self

import numpy as np

from ..config_audio import AudioNetworkConfig
from ..device import choose_compute, sampling_threads
from ..environment import DECODER_CHECKPOINT, variable
from ..errors import UserError
from ..model.audio import Decoded, with_phase_rows
from ..model.checkpoint import resolve_model
from ..model.diffusion import GaussianDiffusion, ModelFn, guided
from ..model.onnx_card import (
    AUDIO_GRAPHS,
    AudioOnnxCard,
    chosen_for_songs,
    read_onnx_card,
)
from ..model.onnx_graphs import open_graph, run
from ..tensors import F, Tensor, torch

if TYPE_CHECKING:
    from ..model.audio.audio_motion_model import AudioMotionModel
    from ..model.audio.conditioning import MemoryCondition

log = logging.getLogger(__name__)
STEPS = 50  # of which is kept what a network makes of them; some 30 kB each


class Runtime(Protocol):
    """A denoiser and a decoder with their settings; AudioMotionModel is one.

    Letters: B samples, T frames. Tensors live on the device of `mean`.
    """

    config: AudioNetworkConfig
    diffusion: GaussianDiffusion
    mean: Tensor  # [25], ruling 13

    def normalise(self, raw: Tensor) -> Tensor:
        """Window rows [B, 25, T] in raw units -> z-scores."""

    def model_fn(
        self,
        condition: Tensor,
        guidance_scale: float | None = None,
        memory: "MemoryCondition | None" = None,
    ) -> ModelFn:
        """A denoiser `f(x_t, t)` for a condition [B, 163 or 167, T] and what is remembered for it.

        A scale of None is the model's own.
        """

    def decode(self, z: Tensor, start: Tensor | None = None) -> Decoded:
        """Z-scores [B, 25, T] -> trajectory and phase; `start`: phase of the first frame [B]."""


def load_runtime(name: str, model: str | Path, device: str = "auto") -> Runtime:
    """A trained model under a runtime.

    Args:
        name: torch, onnx, or auto: onnx where the device is a CPU, onnxruntime is installed and the
            folder holds an export that fits, unless MOTIONGEN_DECODER_CHECKPOINT names a decoder.
        model: see `load_trained`; for onnx, a folder of `export-onnx`.
        device: auto, cuda, mps or cpu; onnx computes on the CPU.

    Raises:
        UserError: no such model, damaged, never trained, or a package is missing.
    """
    if name == "auto":
        name = chosen_for_songs(model, device)
    if name == "torch":
        return load_trained(model, device)
    loaded = OnnxRuntime.from_folder(model)
    _require_training(loaded.card.trained, model)
    return loaded


def load_trained(model: str | Path, device: str = "auto") -> "AudioMotionModel":
    """A trained model for sampling; on a CPU its UNet is the faster copy, which learns no more.

    MOTIONGEN_DECODER_CHECKPOINT names a folder whose decoder takes the place of its own.

    Args:
        model: name of shipped weights, or a folder that training wrote.
        device: auto, cuda, mps or cpu.

    Raises:
        UserError: no such model, another kind, damaged, or never trained.
    """
    from ..model.audio.audio_motion_model import AudioMotionModel, load_decoder
    from ..model.audio.unet import sampling_copy

    compute = choose_compute(device)
    loaded = AudioMotionModel.from_pretrained(model, device=compute.device)
    _require_training(loaded.card.trained, model)
    if compute.device == "cpu":
        loaded.unet = sampling_copy(loaded.unet)
    if decoder := variable(DECODER_CHECKPOINT):
        loaded.decoder = load_decoder(decoder).to(compute.device).eval()
    return loaded


def _require_training(trained: bool, model: str | Path) -> None:
    if not trained:
        raise UserError(f"{model} is untrained: train it with src.train.train_audio")


class OnnxRuntime:
    """The `Runtime` of an export.

    Args:
        card: of the export.
        condition, time, unet, decoder: its sessions; anything with onnxruntime's `run` and
            `get_outputs`.
    """

    def __init__(
        self, card: AudioOnnxCard, condition: Any, time: Any, unet: Any, decoder: Any
    ) -> None:
        self.card = card
        self.config = card.audio_network
        self.diffusion = GaussianDiffusion(self.config.diffusion)
        self.mean, self.std = torch.tensor(card.mean), torch.tensor(card.std)
        self._null = torch.tensor(card.null_condition)
        self._condition, self._time, self._unet = condition, time, unet
        self._decoder = decoder
        self._prepared = [value.name for value in condition.get_outputs()]
        times = [value.name for value in time.get_outputs()]

        @lru_cache(STEPS)
        def made(*steps: int) -> dict[str, Tensor]:
            return dict(zip(times, run(time, t=np.array(steps, np.int64)), strict=True))

        self._made = made  # of the time, which is the same for each window

    @classmethod
    def from_folder(cls, folder: str | Path) -> Self:
        """An export, on as many threads as torch uses.

        Raises:
            UserError: the package is missing, or the folder holds no whole export.
        """
        folder, threads = resolve_model(folder), sampling_threads()
        card = read_onnx_card(folder, AudioOnnxCard)
        graphs = (open_graph(folder, name, threads, spinning=False) for name in AUDIO_GRAPHS)
        return cls(card, *graphs)

    def normalise(self, raw: Tensor) -> Tensor:
        """See `Runtime`."""
        return (raw - self.mean[:, None]) / self.std[:, None]

    def model_fn(
        self,
        condition: Tensor,
        guidance_scale: float | None = None,
        memory: "MemoryCondition | None" = None,
    ) -> ModelFn:
        """See `Runtime`; an export hears no memory."""
        assert memory is None, "an export hears no memory"
        scale = self.config.guidance_scale if guidance_scale is None else guidance_scale
        condition = with_phase_rows(condition)
        null = None
        if scale != 1:
            null = self._prepare(self._null[:, None].expand_as(condition))
        return guided(self._predict, self._prepare(condition), null, scale)

    def decode(self, z: Tensor, start: Tensor | None = None) -> Decoded:
        """See `Runtime`."""
        rows = (z * self.std[:, None] + self.mean[:, None]).swapaxes(1, 2)  # [B, T, 25]
        if start is None:
            start = torch.full((len(z),), torch.nan)
        trajectory, phase = run(self._decoder, rows=rows, start=start)
        return Decoded(trajectory, phase)

    def _prepare(self, condition: Tensor) -> dict[str, Tensor]:
        """What every step of a condition [B, 167, T] shares."""
        return dict(zip(self._prepared, run(self._condition, condition=condition), strict=True))

    def _predict(self, x: Tensor, t: Tensor, **prepared: Tensor) -> Tensor:
        frames = x.shape[-1]
        padded = F.pad(x, (0, -frames % self.config.unet.factors[-1]), mode="replicate")
        (prediction,) = run(self._unet, x=padded, **self._made(*t.tolist()), **prepared)
        return prediction[..., :frames]
