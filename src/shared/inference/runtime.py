"""What SongSampler needs of a model, whoever computes it: PyTorch or onnxruntime."""

from pathlib import Path
from typing import Protocol

from torch import Tensor

from src.shared.config_audio import AudioNetworkConfig
from src.shared.device import choose_device
from src.shared.errors import UserError
from src.shared.inference.onnx_runtime import OnnxRuntime
from src.shared.model.audio.audio_motion_model import AudioMotionModel
from src.shared.model.audio.decoder import Decoded
from src.shared.model.diffusion.conditions import ModelFn
from src.shared.model.diffusion.gaussian import GaussianDiffusion


class Runtime(Protocol):
    """A denoiser and a decoder with their settings; AudioMotionModel is one.

    Letters: B samples, T frames. Tensors live on the device of `mean`.
    """

    config: AudioNetworkConfig
    diffusion: GaussianDiffusion
    mean: Tensor  # [25], ruling 13

    def normalise(self, raw: Tensor) -> Tensor:
        """Window rows [B, 25, T] in raw units -> z-scores."""

    def model_fn(self, condition: Tensor, guidance_scale: float | None = None) -> ModelFn:
        """A denoiser `f(x_t, t)` for a condition [B, 163 or 167, T]; None = the model's scale."""

    def decode(self, z: Tensor, start: Tensor | None = None) -> Decoded:
        """Z-scores [B, 25, T] -> trajectory and phase; `start`: phase of the first frame [B]."""


def load_runtime(name: str, model: str | Path, device: str = "auto") -> Runtime:
    """A trained model under a runtime.

    Args:
        name: torch or onnx.
        model: name of shipped weights or a folder that training wrote; for onnx, a folder of
            `export-onnx`.
        device: auto, cuda, mps or cpu; onnx computes on the CPU.

    Raises:
        UserError: no such model, damaged, never trained, or a package is missing.
    """
    loaded: AudioMotionModel | OnnxRuntime
    if name == "onnx":
        loaded = OnnxRuntime.from_folder(model)
    else:
        loaded = AudioMotionModel.from_pretrained(model, device=choose_device(device)[0])
    if not loaded.card.trained:
        raise UserError(f"{model} is untrained: train it with src.train.train_audio")
    return loaded
