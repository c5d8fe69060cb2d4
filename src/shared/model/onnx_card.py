"""What an ONNX export says about itself (onnx.json); no PyTorch.

An export is a model folder with graphs beside the weights. The graphs hold no weights of their own:
their initializers are external data in model.safetensors, int8 and float16 ones with the few nodes
that make float32 of them, which onnxruntime folds away on loading. docs/onnx.md is the contract.
"""

import logging
from importlib.util import find_spec
from pathlib import Path
from typing import Literal, TypeVar

from pydantic import ValidationError

from ..config_audio import AudioNetworkConfig
from ..config_schema import Config, DiffusionConfig, PostProcessingConfig
from ..device import computes_on_cpu
from ..environment import DECODER_CHECKPOINT, variable
from ..errors import UserError, first_fault
from ..io.files import load_json, sha256_file
from .checkpoint import WEIGHTS_FILE, ModelCard, read_card, resolve_model

log = logging.getLogger(__name__)
ONNX_CARD = "onnx.json"
OPSET = 18
READY, TURNED = "ready-", "/turned"  # before the name of a graph that is, behind that of a weight
AUDIO_GRAPHS = ("condition.onnx", "time.onnx", "unet.onnx", "decoder.onnx")
TEXT_KIND, AUDIO_KIND = EXPORTED = "motion-generator", "audio-motion"  # models it is made of


class ValueInfo(Config):
    """An input or output of a graph: its type, and its sizes, a name where any will do."""

    dtype: str
    shape: tuple[int | str, ...]


class GraphInfo(Config):
    """What a graph file must be; `weights`: the files of one that is ready (docs/onnx.md)."""

    sha256: str
    bytes: int
    inputs: dict[str, ValueInfo]
    outputs: dict[str, ValueInfo]
    weights: tuple[str, ...] = ()


class ProcessInfo(Config):
    """The diffusion of an export, in numbers.

    Attributes:
        config: its settings.
        alphas_cumprod: signal left after each training step [S].
        timesteps: those that sampling visits, as configured.
        guidance_scale: prediction = null + scale * (conditional - null).
        noise: the generator of standard normals, see docs/onnx.md.
    """

    config: DiffusionConfig
    alphas_cumprod: tuple[float, ...]
    timesteps: tuple[int, ...]
    guidance_scale: float
    noise: Literal["philox4x32-10/box-muller"] = "philox4x32-10/box-muller"


class TokenizerInfo(Config):
    """The tokenizer of an export, and what is done to its ids."""

    kind: str
    file: str
    bos: int = 0
    pad: int = 1
    eos: int = 2
    unk: int = 3
    max_tokens: int


class OnnxCard(Config):
    """What an export says about itself.

    Attributes:
        model: SHA-256 of the weights that the graphs read.
        weights: their file.
        graphs: file name -> what it must be.
        process: the diffusion.
    """

    kind: str
    format_version: int
    name: str = ""
    description: str = ""
    licence: str = ""
    trained: bool = False
    model: str = ""
    weights: str = WEIGHTS_FILE
    fps: float = 30.0
    opset: int = OPSET
    graphs: dict[str, GraphInfo]
    process: ProcessInfo


class TextOnnxCard(OnnxCard):
    """An export that makes bodies from sentences: text.onnx and denoiser.onnx.

    Attributes:
        mean, std: [K][C] of the features: `x = z * std + mean`.
        null_pooled: the learned "no text" [D].
        null_token: of a network that hears tokens [D]; None otherwise.
        tags: action labels; `no_tag` is the index of none.
        shown: whether known entries are shown to the network, or only held.
        shifted: the vectors, in the order of the rows of its shifts, that a model changes which
            learned to go from noise to motion at once; empty for others.
        max_seconds: of the longest clip it learned from; `min_frames` are needed.
    """

    format_version: Literal[4] = 4  # 3 had graphs of their own for one step
    kind: Literal["motion-generator"] = "motion-generator"
    mean: tuple[tuple[float, ...], ...]
    std: tuple[tuple[float, ...], ...]
    null_pooled: tuple[float, ...]
    null_token: tuple[float, ...] | None = None
    tags: tuple[str, ...] = ()
    no_tag: int
    languages: tuple[str, ...] = ()
    shown: bool
    shifted: tuple[str, ...] = ()
    max_seconds: float | None = None
    min_frames: int
    tokenizer: TokenizerInfo
    post_processing: PostProcessingConfig


class AudioOnnxCard(OnnxCard):
    """An export that makes paths from songs, with the graphs AUDIO_GRAPHS.

    Attributes:
        mean, std: statistics of the 25 rows: `x = z * std + mean` (ruling 13).
        null_condition: the 167 rows of "no audio", the same in every frame (ruling 14).
    """

    format_version: Literal[4] = 4  # 3 asked for the time in every window
    kind: Literal["audio-motion"] = "audio-motion"
    audio_network: AudioNetworkConfig
    mean: tuple[float, ...]
    std: tuple[float, ...]
    null_condition: tuple[float, ...]


CardT = TypeVar("CardT", bound=OnnxCard)


def read_onnx_card(folder: str | Path, kind: type[CardT], model: ModelCard | None = None) -> CardT:
    """The card of an export whose graphs are whole; `model` is the model's, where it was read.

    Raises:
        UserError: no export there, one that this version cannot read, or a damaged graph.
    """
    path = Path(folder) / ONNX_CARD
    if not path.is_file():
        named = f" --model {folder}" if _could_be_exported(folder) else ""
        raise UserError(
            f"{folder} holds no ONNX export ({ONNX_CARD} is missing); make one with"
            f" `export-onnx{named} --out DIR` and name DIR"
        )
    try:
        card = kind.model_validate(load_json(path))
    except ValidationError as error:
        raise UserError(f"{path}: {first_fault(error)}; export the model again") from error
    except (OSError, ValueError) as error:
        raise UserError(f"{path} cannot be read ({error}); export the model again") from error
    if card.model != (model or read_card(Path(folder))).content_hash:
        raise UserError(f"{path} was made from other weights than these; export the model again")
    for name, graph in card.graphs.items():
        file = path.with_name(name)
        if not file.is_file() or sha256_file(file) != graph.sha256:
            raise UserError(
                f"{file} is missing or not the file that {ONNX_CARD} vouches for;"
                " export the model again"
            )
    return card


def _could_be_exported(name_or_folder: str | Path) -> bool:
    try:
        return read_card(resolve_model(name_or_folder)).kind in EXPORTED
    except UserError:
        return False


RUNTIMES = ("auto", "torch", "onnx")


def chosen_runtime(runtime: str, model: str | Path, device: str = "auto") -> str:
    """Torch or onnx; auto, of RUNTIMES, is onnx where the device is a CPU, onnxruntime is installed
    and the model exported."""
    if runtime != "auto":
        return runtime
    if find_spec("onnxruntime") is None or not computes_on_cpu(device):
        return "torch"
    try:
        return "onnx" if (resolve_model(model) / ONNX_CARD).is_file() else "torch"
    except UserError:
        return "torch"  # which says what is wrong with the name


def chosen_for_songs(model: str | Path, device: str = "auto", *, quiet: bool = False) -> str:
    """What makes the paths of songs where nobody says: onnx needs an export that fits, of this
    kind; one that does not fit is told of."""
    if variable(DECODER_CHECKPOINT) or chosen_runtime("auto", model, device) == "torch":
        return "torch"
    folder = resolve_model(model)
    if read_card(folder).kind != AUDIO_KIND:
        return "torch"  # which says so
    try:
        read_onnx_card(folder, AudioOnnxCard)
    except UserError as error:
        if not quiet:
            log.warning("%s; PyTorch samples until then", error)
        return "torch"
    return "onnx"
