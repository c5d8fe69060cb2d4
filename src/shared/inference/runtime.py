"""What SongSampler needs of a model, whoever computes it: PyTorch or onnxruntime."""

from pathlib import Path
from typing import Protocol

import torch
from torch import Tensor

from ..config_audio import AudioNetworkConfig
from ..device import choose_compute
from ..errors import UserError
from ..model.audio.audio_motion_model import AudioMotionModel
from ..model.audio.decoder import Decoded
from ..model.audio.memory_conditioning import MemoryCondition
from ..model.audio.sampling_copy import sampling_copy
from ..model.diffusion.conditions import ModelFn
from ..model.diffusion.gaussian import GaussianDiffusion
from .onnx_runtime import OnnxRuntime


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
        memory: MemoryCondition | None = None,
    ) -> ModelFn:
        """A denoiser `f(x_t, t)` for a condition [B, 163 or 167, T] and what is remembered for it.

        A scale of None is the model's own.
        """

    def decode(self, z: Tensor, start: Tensor | None = None) -> Decoded:
        """Z-scores [B, 25, T] -> trajectory and phase; `start`: phase of the first frame [B]."""


def load_runtime(name: str, model: str | Path, device: str = "auto") -> Runtime:
    """A trained model under a runtime.

    Args:
        name: torch or onnx.
        model: see `load_trained`; for onnx, a folder of `export-onnx`.
        device: auto, cuda, mps or cpu; onnx computes on the CPU.

    Raises:
        UserError: no such model, damaged, never trained, or a package is missing.
    """
    if name == "torch":
        return load_trained(model, device)
    loaded = OnnxRuntime.from_folder(model)
    _require_training(loaded.card.trained, model)
    return loaded


def load_trained(model: str | Path, device: str = "auto") -> AudioMotionModel:
    """A trained model for sampling; on a CPU its UNet is the faster copy, which learns no more.

    Args:
        model: name of shipped weights, or a folder that training wrote.
        device: auto, cuda, mps or cpu.

    Raises:
        UserError: no such model, another kind, damaged, or never trained.
    """
    compute = choose_compute(device)
    loaded = AudioMotionModel.from_pretrained(model, device=compute.device)
    _require_training(loaded.card.trained, model)
    if compute.device == "cpu":
        low = torch.bfloat16 if compute.precision == "bf16" else None
        loaded.unet = sampling_copy(loaded.unet, low)
    return loaded


def _require_training(trained: bool, model: str | Path) -> None:
    if not trained:
        raise UserError(f"{model} is untrained: train it with src.train.train_audio")
