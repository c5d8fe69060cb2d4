"""The card of an ONNX export: onnx.json beside unet.onnx and decoder.onnx.

All that a program without PyTorch needs: the statistics, the learned "no audio", the settings of
the diffusion, and the hashes of the graphs. Imports no torch.
"""

from importlib.util import find_spec
from pathlib import Path
from typing import Literal

from pydantic import ValidationError

from ...config_audio import AudioNetworkConfig
from ...config_schema import Config
from ...errors import UserError, first_fault
from ...io.files import load_json, sha256_file
from ..checkpoint import read_card
from ..zoo import resolve_model

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
