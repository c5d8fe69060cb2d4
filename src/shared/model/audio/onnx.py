"""UNet1D and decoder as ONNX graphs for any batch and any length of 8 frames or more.

unet.onnx: x [B,25,T] float32 z-scores, t [B] int64, condition [B,167,T] float32 -> prediction
[B,25,T]. decoder.onnx: rows [B,T,25] in raw units, start [B] (bar phase of the first frame, NaN =
the decoder's guess) -> trajectory [B,T,25] and phase [B,T], unwrapped, in bars. onnx.json beside
them holds all that a program without PyTorch needs: the statistics, the learned "no audio", the
settings of the diffusion, and the hashes of the graphs.

The exporter follows lengths as symbols. Where eager code asks for a number, the layer is rewritten
here with the same weights and the same result.

Letters: B batch, T frames, C channels.
"""

import copy
import logging
import warnings
from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager
from importlib.util import find_spec
from pathlib import Path
from typing import Literal

import torch
from pydantic import ValidationError
from torch import Tensor, nn
from torch.nn import functional as F

from ...config_audio import AudioNetworkConfig
from ...config_schema import Config
from ...errors import UserError, first_fault
from ...io.files import atomic_write, load_json, sha256_file, write_json
from ...motion.trajectory import CHANNELS, PHASE
from ..checkpoint import read_card, resolve_model
from ..layers.transformer import RotaryEmbedding
from .audio_motion_model import AudioMotionModel
from .conditioning import CONDITION_ROWS
from .decoder import Decoder, wrapped_phase
from .unet import Downsample, UNet1D

CARD_FILE = "onnx.json"
GRAPHS = ("unet.onnx", "decoder.onnx")
PACKAGES = ("onnx", "onnxscript", "onnxruntime")


class GraphInfo(Config):
    """What a graph file must be."""

    sha256: str
    bytes: int


class OnnxCard(Config):
    """What an export says about itself.

    Attributes:
        model: SHA-256 of the weights it was made from; "" when they came from no folder.
        mean, std: statistics of the 25 rows: `x = z * std + mean` (ruling 13).
        null_condition: the 167 rows of "no audio", the same in every frame (ruling 14).
        graphs: file name -> what it must be.
    """

    format_version: Literal[1] = 1
    kind: Literal["audio-motion-onnx"] = "audio-motion-onnx"
    name: str = ""
    description: str = ""
    licence: str = ""
    trained: bool = False
    model: str = ""
    fps: float = 30.0
    opset: int
    audio_network: AudioNetworkConfig
    mean: tuple[float, ...]
    std: tuple[float, ...]
    null_condition: tuple[float, ...]
    graphs: dict[str, GraphInfo]


def require_packages(*names: str) -> None:
    """Raises UserError, naming the extra, when a package of it is missing."""
    missing = [name for name in names if find_spec(name) is None]
    if missing:
        raise UserError(
            f"ONNX needs the package {' and '.join(missing)}, which is not installed;"
            " install the project with its extra `onnx`, or:"
            " pip install onnx onnxscript onnxruntime"
        )


def graph_info(path: Path) -> GraphInfo:
    """Hash and size of a file."""
    return GraphInfo(sha256=sha256_file(path), bytes=path.stat().st_size)


def read_onnx_card(folder: Path) -> OnnxCard:
    """The card of an export whose graphs are whole.

    Raises:
        UserError: no export there, one that this version cannot read, or a damaged graph.
    """
    path = Path(folder) / CARD_FILE
    if not path.is_file():
        model = f" --model {folder}" if _is_audio_model(folder) else ""
        raise UserError(
            f"{folder} holds no ONNX export ({CARD_FILE} is missing); make one with"
            f" `export-onnx{model} --out DIR` and name DIR"
        )
    try:
        card = OnnxCard.model_validate(load_json(path))
    except ValidationError as error:
        raise UserError(f"{path}: {first_fault(error)}; export the model again") from error
    except (OSError, ValueError) as error:
        raise UserError(f"{path} cannot be read ({error}); export the model again") from error
    for name in GRAPHS:
        graph = path.with_name(name)
        if not graph.is_file() or card.graphs.get(name) != graph_info(graph):
            raise UserError(
                f"{graph} is missing or not the file that {CARD_FILE} vouches for;"
                " export the model again"
            )
    return card


def _is_audio_model(name_or_folder: str | Path) -> bool:
    """Could `export-onnx` make something of it?"""
    try:
        return read_card(resolve_model(name_or_folder)).audio_network is not None
    except UserError:
        return False


# ---------------------------------------------------------------- export

OPSET = 18
EXAMPLE_FRAMES = 37  # no multiple of anything, so that no length is taken for a constant
Shapes = Mapping[int, str]  # dimension -> name of its symbol


class SymbolicUNet(UNet1D):
    """Pads without asking whether it must."""

    def _pad(self, x: Tensor) -> Tensor:
        frames, factor = x.shape[-1], self.factors[-1]
        padded = (frames + factor - 1) // factor * factor
        return x.index_select(-1, torch.arange(padded, device=x.device).clamp(max=frames - 1))


class SymbolicDownsample(Downsample):
    """Pads in front only: lengths are even here, and so their half is plain to see."""

    def forward(self, x: Tensor) -> Tensor:
        """[B, C, T] -> [B, C, T/2]."""
        return F.conv1d(F.pad(x, (1, 0)), self.conv.weight, self.conv.bias, stride=2)


class SymbolicRotary(RotaryEmbedding):
    """Computes its table in the graph instead of keeping one."""

    def _tables(self, length: int, device: torch.device) -> tuple[Tensor, Tensor]:
        positions = torch.arange(length, dtype=torch.float32, device=device)
        positions = positions * self.stride + self.stride // 2
        angles = positions[:, None, None] * self.frequencies
        return angles.cos(), angles.sin()


class DecoderGraph(nn.Module):
    """A decoder whose optional `start` is a number: NaN stands for None."""

    def __init__(self, decoder: Decoder) -> None:
        super().__init__()
        self.decoder = decoder

    def forward(self, rows: Tensor, start: Tensor) -> tuple[Tensor, Tensor]:
        """Rows [B, T, 25] raw, start [B] -> trajectory [B, T, 25], phase [B, T]."""
        decoded = self.decoder.decode(rows)
        guessed = decoded.phase_unwrapped  # [B, T]
        first = guessed[:, 0]
        phase = guessed - first[:, None] + torch.where(start.isnan(), first, start)[:, None]
        trajectory = decoded.trajectory
        columns = (
            trajectory[..., :PHASE],
            wrapped_phase(phase)[..., None],
            trajectory[..., PHASE + 1 :],
        )
        return torch.cat(columns, dim=-1), phase


def symbolic(unet: UNet1D) -> UNet1D:
    """The network again, on the CPU, in layers that the exporter can follow; without memory."""
    twins: dict[type, type] = {
        UNet1D: SymbolicUNet,
        Downsample: SymbolicDownsample,
        RotaryEmbedding: SymbolicRotary,
    }
    twin = copy.deepcopy(unet).cpu().float().eval()
    twin.memory = None
    for module in twin.modules():
        module.__class__ = twins.get(type(module), type(module))
    return twin


def export_onnx(model: AudioMotionModel, folder: str | Path) -> OnnxCard:
    """Write both graphs and the card that vouches for them.

    Raises:
        UserError: the packages are missing, or the folder cannot be written.
    """
    require_packages("onnx", "onnxscript")
    frames, rows = EXAMPLE_FRAMES, len(model.mean)
    unet = _program(
        symbolic(model.unet),
        {
            "x": (torch.randn(2, rows, frames), {0: "batch", 2: "frames"}),
            "t": (torch.tensor([1, 2]), {0: "batch"}),
            "condition": (
                torch.randn(2, CONDITION_ROWS, frames),
                {0: "batch", 2: "frames"},
            ),
        },
        ("prediction",),
    )
    decoder = _program(
        DecoderGraph(copy.deepcopy(model.decoder).cpu().float().eval()),
        {
            "rows": (torch.randn(2, frames, CHANNELS), {0: "batch", 1: "frames"}),
            "start": (torch.rand(2), {0: "batch"}),
        },
        ("trajectory", "phase"),
    )
    # Written only now: who stops the slow part leaves no folder behind.
    files = [Path(folder) / name for name in GRAPHS]
    for program, path in zip((unet, decoder), files, strict=True):
        with atomic_write(path) as temporary:
            program.save(str(temporary))
    card = OnnxCard(
        name=model.card.name,
        description=model.card.description,
        licence=model.card.licence,
        trained=model.card.trained,
        model=model.card.content_hash,
        fps=model.card.fps,
        opset=OPSET,
        audio_network=model.config,
        mean=tuple(model.mean.tolist()),
        std=tuple(model.std.tolist()),
        null_condition=tuple(model.unet.null.tolist()),
        graphs={path.name: graph_info(path) for path in files},
    )
    write_json(Path(folder) / CARD_FILE, card.model_dump(mode="json", by_alias=True))
    return card


def _program(
    module: nn.Module,
    inputs: Mapping[str, tuple[Tensor, Shapes]],
    outputs: Sequence[str],
) -> torch.onnx.ONNXProgram:
    with torch.no_grad(), _quiet():
        program = torch.onnx.export(
            module,
            tuple(example for example, _ in inputs.values()),
            dynamo=True,
            dynamic_shapes=tuple(shapes for _, shapes in inputs.values()),
            input_names=list(inputs),
            output_names=list(outputs),
            opset_version=OPSET,
            optimize=False,  # onnxruntime does it on loading, many times faster
            verbose=False,
        )
    assert program is not None
    return program


@contextmanager
def _quiet() -> Iterator[None]:
    """The exporter tells about packages and names that are none of the user's business."""
    logger = logging.getLogger("torch.onnx")
    level = logger.level
    logger.setLevel(logging.ERROR)
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            yield
    finally:
        logger.setLevel(level)
