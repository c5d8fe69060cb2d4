"""A model folder: config.json (the card), model.safetensors, and what else the model needs.

Reading a card imports no torch, so that listing models is quick. Weights are only ever
safetensors; the card holds their SHA-256.
"""

from collections.abc import Mapping
from contextlib import suppress
from pathlib import Path
from typing import TYPE_CHECKING, Any, Literal

from pydantic import Field, ValidationError

from ..config_audio import AudioNetworkConfig, AudioTowerConfig
from ..config_loader import did_you_mean, profile_names
from ..config_schema import Config, NetworkConfig
from ..environment import run_folder
from ..errors import UsageError, UserError, first_fault
from ..io.files import atomic_write, load_json, sha256_file, write_json

if TYPE_CHECKING:
    from torch import Tensor, nn

CARD_FILE = "config.json"
WEIGHTS_FILE = "model.safetensors"
NO_MODEL = (
    f"is no model folder: it has no {CARD_FILE}; name a folder from training, or a name that"
    " `models` lists"
)
INT8_SCALE = ".int8_scale"
ADAPTERS = ".adapters."  # in the names of adapters' weights
SMALLEST = 1024  # numbers; smaller tensors, biases and norms among them, stay as they are


class WeightsInfo(Config):
    """What the weights file must be."""

    sha256: str
    bytes: int
    dtype: Literal["float32", "float16", "int8"] = "float32"


class ModelCard(Config):
    """What a model folder says about itself."""

    format_version: Literal[1] = 1
    kind: str  # motion-generator | motion-clip | audio-motion | shared-space
    name: str = ""
    description: str = ""
    licence: str = ""
    trained: bool = False
    network: NetworkConfig = NetworkConfig()
    audio_network: AudioNetworkConfig | None = None  # of an audio-motion model
    audio_tower: AudioTowerConfig | None = None  # of a shared-space
    text_tower: str = ""  # of a shared-space: hash of the text tower in the same space
    tags: tuple[str, ...] = ()
    languages: tuple[str, ...] = ()
    max_seconds: float | None = None  # longest clip seen in training
    fps: float = 30.0
    data: str = ""  # manifest hash of the training data
    training: dict[str, Any] = Field(default_factory=dict)  # command, steps, seconds, figures
    text_encoder: dict[str, Any] | None = None  # transformers' own config, unless "small"
    weights: WeightsInfo | None = None

    @property
    def content_hash(self) -> str:
        """SHA-256 of the weights; empty without any."""
        return self.weights.sha256 if self.weights else ""


def of_another_version(path: Path, error: ValidationError) -> UserError:
    """What to tell of a file in a model folder whose content is not what this version writes."""
    first = error.errors()[0]
    got = "" if first["type"] == "missing" else f" (got {first['input']!r:.60})"
    return UserError(
        f"{path}: {first_fault(error)}{got}; the folder is damaged, or another version of this"
        " program made it: copy it again, or train it with this one"
    )


def read_card(folder: Path) -> ModelCard:
    """The card of a model folder.

    Raises:
        UserError: no card there, or not one this version reads.
    """
    path = Path(folder) / CARD_FILE
    try:
        return ModelCard.model_validate(load_json(path))
    except FileNotFoundError as error:
        raise UserError(f"{folder} {NO_MODEL}") from error
    except ValidationError as error:
        raise of_another_version(path, error) from error
    except (OSError, ValueError) as error:
        raise UserError(f"{path} cannot be read ({error}); copy the model folder again") from error


def write_checkpoint(
    folder: Path,
    card: ModelCard,
    tensors: Mapping[str, "Tensor"],
    *,
    half: bool = False,
    int8: bool = False,
) -> ModelCard:
    """Write weights, then the card that vouches for them; returns the finished card.

    Args:
        folder: made when absent.
        card: its `weights` are filled in here.
        tensors: name -> tensor, any device.
        half: store floating-point tensors as float16.
        int8: store large ones as int8 with a scale a row, see `quantise`.

    Raises:
        UserError: the folder cannot be written.
    """
    import torch
    from safetensors.torch import save_file

    folder = Path(folder)
    tensors = quantise(tensors) if int8 else tensors
    stored = {}
    for name, tensor in tensors.items():
        half_this = half and tensor.is_floating_point()
        stored[name] = tensor.detach().to("cpu", torch.float16 if half_this else None).contiguous()
    path = folder / WEIGHTS_FILE
    with atomic_write(path) as temporary:
        # One entry only: safetensors writes several in an order of its own at each call, and the
        # same weights would hash differently. What they are is the card's to say.
        save_file(stored, temporary, metadata={"format": "pt"})
    weights = weights_info(path, "int8" if int8 else "float16" if half else "float32")
    card = card.model_copy(update={"weights": weights})
    write_json(folder / CARD_FILE, card.model_dump(mode="json", by_alias=True))
    return card


def weights_info(
    path: Path, dtype: Literal["float32", "float16", "int8"] = "float16"
) -> WeightsInfo:
    """What a card says of a weights file that was just written."""
    return WeightsInfo(sha256=sha256_file(path), bytes=path.stat().st_size, dtype=dtype)


def check_weights(folder: Path, weights: WeightsInfo | None) -> Path:
    """The weights file of a model folder, whose card says this of it.

    Raises:
        UserError: it is missing, truncated, or not the one the card vouches for.
    """
    path = Path(folder) / WEIGHTS_FILE
    if weights is None or not path.is_file():
        raise UserError(f"{folder} holds no weights; train it, or copy {WEIGHTS_FILE} there too")
    size = path.stat().st_size
    if size != weights.bytes:
        raise UserError(
            f"{path} has {size} bytes, {CARD_FILE} says {weights.bytes}: the file is cut off"
            " or another one; copy the model folder again"
        )
    if sha256_file(path) != weights.sha256:
        raise UserError(
            f"{path} does not match the SHA-256 in {CARD_FILE}: it is damaged or another file;"
            " copy the model folder again"
        )
    return path


def read_tensors(folder: Path, card: ModelCard) -> dict[str, "Tensor"]:
    """The weights of a model folder in float32 on the CPU.

    Raises:
        UserError: the file is missing, truncated, not the one the card vouches for, or holds
            numbers that are not finite.
    """
    from safetensors import SafetensorError
    from safetensors.torch import load_file

    path = check_weights(folder, card.weights)
    try:
        tensors = load_file(path)
    except SafetensorError as error:
        raise UserError(
            f"{path} is not a safetensors file ({error!s:.300}); copy the model folder again"
        ) from error
    whole = {
        name: tensor.float() if tensor.is_floating_point() else tensor
        for name, tensor in dequantise(tensors).items()
    }
    for name, tensor in whole.items():
        if tensor.is_floating_point() and not tensor.isfinite().all():
            raise UserError(
                f"{path}: {name} holds numbers that are not finite; copy the model folder again,"
                " or take an earlier checkpoint: its training may have diverged"
            )
    return whole


def load_state(
    module: "nn.Module", tensors: Mapping[str, "Tensor"], prefix: str, folder: Path
) -> None:
    """Fill a module from the tensors whose names start with `prefix.`; every key must fit.

    Raises:
        UserError: a tensor is missing, left over, or of another shape.
    """
    start = prefix + "."
    given = {name[len(start) :]: t for name, t in tensors.items() if name.startswith(start)}
    wanted = module.state_dict()
    for name, tensor in wanted.items():
        if name not in given:
            raise UserError(f"{folder}: the weights lack {start}{name}; copy the folder again")
        if given[name].shape != tensor.shape:
            raise UserError(
                f"{folder}: {start}{name} has shape {tuple(given[name].shape)}, the configuration"
                f" asks for {tuple(tensor.shape)}; {CARD_FILE} and the weights belong together"
                "; copy the folder again"
            )
    extra = sorted(given.keys() - wanted.keys())
    if extra:
        raise UserError(
            f"{folder}: the weights have {start}{extra[0]}, which the configuration has no place"
            f" for; {CARD_FILE} and the weights belong together; copy the folder again"
        )
    module.load_state_dict(given)


def with_prefix(prefix: str, tensors: Mapping[str, "Tensor"]) -> dict[str, "Tensor"]:
    """The same tensors, named `prefix.name`."""
    return {f"{prefix}.{name}": tensor for name, tensor in tensors.items()}


def quantise(tensors: Mapping[str, "Tensor"]) -> dict[str, "Tensor"]:
    """Large floating-point tensors [R, ...] as int8, with their scales [R] beside them.

    Symmetric, one scale for each row: half the size of float16, and a rounded weight is off by at
    most 1/254 of the largest one of its row. Computed with in float32.
    """
    import torch

    stored: dict[str, Tensor] = {}
    for name, tensor in tensors.items():
        if not tensor.is_floating_point() or tensor.ndim < 2 or tensor.numel() < SMALLEST:
            stored[name] = tensor
            continue
        rows = tensor.detach().float().flatten(1)  # [R, ...]
        scale = rows.abs().amax(dim=1).clamp_min(1e-12) / 127
        stored[name] = (rows / scale[:, None]).round().to(torch.int8).view(tensor.shape)
        stored[name + INT8_SCALE] = scale
    return stored


def dequantise(stored: Mapping[str, "Tensor"]) -> dict[str, "Tensor"]:
    """The inverse of `quantise`, up to rounding; other tensors pass unchanged."""
    tensors: dict[str, Tensor] = {}
    for name, tensor in stored.items():
        if name.endswith(INT8_SCALE):
            continue
        scale = stored.get(name + INT8_SCALE)
        if scale is not None:
            tensor = tensor.float() * scale.view(-1, *(1,) * (tensor.ndim - 1))
        tensors[name] = tensor
    return tensors


# ---------------------------------------------------------------- zoo


PRETRAINED = Path(__file__).resolve().parents[1] / "pretrained"
RUNS = Path("runs")


def list_models(*, runs: bool = True) -> list[dict[str, Any]]:
    """The shipped models by name, then those under `runs` by folder, if asked for; no damaged ones.

    Keys: name, kind, trained, licence, size (MB), languages, description.
    """
    shipped = [
        (path.parent.name, path.parent) for path in sorted(PRETRAINED.glob(f"*/{CARD_FILE}"))
    ]
    place = run_folder(RUNS)
    found = [*place.glob(f"*/{CARD_FILE}"), *place.glob(f"*/*/{CARD_FILE}")] if runs else []
    own = [(str(path.parent), path.parent) for path in sorted(found)]
    rows = []
    for name, folder in [*shipped, *own]:
        with suppress(UserError):
            card = read_card(folder)
            size = card.weights.bytes / 1e6 if card.weights else 0.0
            rows.append(
                {
                    "name": name,
                    "kind": card.kind,
                    "trained": card.trained,
                    "licence": card.licence,
                    "size": f"{size:.1f} MB",
                    "languages": ", ".join(card.languages),
                    "description": card.description,
                }
            )
    return rows


def wrong_kind(
    folder: Path, found: str, wanted: str, hint: str = "name another folder"
) -> UserError:
    """What to say of a model of another kind; names what is shipped of the kind that was wanted."""
    shipped = [row["name"] for row in list_models(runs=False) if row["kind"] == wanted]
    of_it = f", or {' or '.join(shipped)}, which is shipped" if shipped else ""
    held, asked = (f"{'an' if kind[:1] in 'aeiou' else 'a'} {kind}" for kind in (found, wanted))
    return UserError(f"{folder} holds {held}, not {asked}; {hint}{of_it}")


def resolve_model(name_or_folder: str | Path) -> Path:
    """The folder of a model: one that holds it, a shipped name, or `user/model` on a hub.

    Raises:
        UserError: none of them; an untrained profile says how to train it.
    """
    folder = Path(name_or_folder)
    for place in (folder, run_folder(folder)):
        if (place / CARD_FILE).is_file():
            return place
    name = str(name_or_folder)
    if folder.name == name and (PRETRAINED / name / CARD_FILE).is_file():
        return PRETRAINED / name
    if (fetched := from_hub(name_or_folder)) is not None:
        return fetched
    shipped = sorted(path.parent.name for path in PRETRAINED.glob(f"*/{CARD_FILE}"))
    if name in profile_names():
        use = f", or use --model {shipped[0]}" if shipped else ""
        raise UserError(
            f"profile {name!r} is untrained: no weights of it are shipped; train it with"
            f" `motion-tools train generation --network-profile {name}`"
            f" and name the run's folder{use}"
        )
    if (folder / "checkpoints").is_dir():
        raise UserError(f"{folder} is a training that has not ended; finish it by --resume")
    if folder.is_dir():
        raise UserError(f"{folder} {NO_MODEL}")
    hint = did_you_mean(name, shipped)
    raise UsageError(f"no model named {name!r}, and no such folder; {hint}`models` lists all")


def from_hub(name: str | Path) -> Path | None:
    """The folder of a model on a hub; None where the name is not `user/model[@revision]`.

    Raises:
        UserError: as of `hub.pull`.
    """
    if not isinstance(name, str) or "/" not in name:
        return None
    from .hub import hub_name, pull

    return pull(name) if hub_name(name) else None
