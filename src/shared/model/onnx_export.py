"""From a PyTorch module to an ONNX graph that reads its weights from model.safetensors.

The exporter follows lengths as symbols. Where eager code asks for a number, a layer has a twin with
the same weights and the same result.
"""

import copy
import hashlib
import inspect
import logging
import shutil
import warnings
from collections import defaultdict
from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any, TypeVar

import numpy as np
import torch
from torch import Tensor, nn

from ..io.files import atomic_write, parse_json, sha256_file, write_json
from .checkpoint import INT8_SCALE, WEIGHTS_FILE, ModelCard, read_card, read_tensors
from .diffusion import GaussianDiffusion
from .layers import RotaryEmbedding
from .noise import sampling_timesteps
from .onnx_card import ONNX_CARD, OPSET, READY, TURNED, CardT, GraphInfo, ProcessInfo, ValueInfo

EXAMPLE_FRAMES = 37  # no multiple of anything, so that no length is taken for a constant
Shapes = Mapping[int, Any]  # dimension -> its symbol: a name, or a `torch.export.Dim`
ModuleT = TypeVar("ModuleT", bound=nn.Module)


class SymbolicRotary(RotaryEmbedding):
    """Computes its table in the graph instead of keeping one."""

    def _tables(self, length: int, device: torch.device) -> tuple[Tensor, Tensor]:
        positions = torch.arange(length, dtype=torch.float32, device=device)
        positions = positions * self.stride + self.stride // 2
        angles = positions[:, None, None] * self.frequencies
        return angles.cos(), angles.sin()

    def turned(self, heads: Tensor) -> Tensor:
        """[B, T, H, d] -> the same, rotated: `forward` in fewer nodes."""
        cos, sin = self._tables(heads.shape[1], heads.device)
        first, second = heads.chunk(2, dim=-1)
        crossed = torch.cat([second, first], -1) * torch.cat([-sin, sin], -1)
        return heads * torch.cat([cos, cos], -1) + crossed


def symbolic(module: ModuleT, twins: Mapping[type, type] | None = None) -> ModuleT:
    """The network again, on the CPU, in layers that the exporter can follow."""
    found = {RotaryEmbedding: SymbolicRotary, **(twins or {})}
    twin = copy.deepcopy(module).cpu().float().eval()
    for part in twin.modules():
        part.__class__ = found.get(type(part), type(part))
    return twin


def traced(
    module: nn.Module, inputs: Mapping[str, tuple[Tensor, Shapes]], outputs: Sequence[str]
) -> Any:
    """The graph of a module, an onnx `ModelProto` that holds its weights."""
    shapes: list[Any] = [own for _, own in inputs.values()]
    kinds = [each.kind for each in inspect.signature(module.forward).parameters.values()]
    others = shapes[len(kinds) - 1 :]
    if inspect.Parameter.VAR_POSITIONAL in kinds and others:  # these are one argument, a tuple
        shapes[-len(others) :] = [tuple(others)]
    with torch.no_grad(), _quiet():
        program = torch.onnx.export(
            module,
            tuple(example for example, _ in inputs.values()),
            dynamo=True,
            dynamic_shapes=tuple(shapes),
            input_names=list(inputs),
            output_names=list(outputs),
            opset_version=OPSET,
            optimize=True,
            verbose=False,
        )
    assert program is not None
    model = program.model_proto
    for node in model.graph.node:  # where in the source it came from: paths, and most of the bytes
        node.ClearField("metadata_props")
        node.ClearField("doc_string")
    model.graph.ClearField("value_info")
    model.graph.ClearField("metadata_props")
    model.ClearField("metadata_props")
    return model


def _write(model: Any, path: Path, weights: tuple[str, ...] = ()) -> GraphInfo:
    with atomic_write(path) as temporary:
        temporary.write_bytes(model.SerializeToString(deterministic=True))
    return GraphInfo(
        sha256=sha256_file(path),
        bytes=path.stat().st_size,
        inputs={value.name: _info(value) for value in model.graph.input},
        outputs={value.name: _info(value) for value in model.graph.output},
        weights=weights,
    )


def process_info(diffusion: GaussianDiffusion, guidance_scale: float) -> ProcessInfo:
    """A diffusion in numbers."""
    config = diffusion.config
    return ProcessInfo(
        config=config,
        alphas_cumprod=tuple(diffusion.schedule.alphas_cumprod.tolist()),
        timesteps=sampling_timesteps(
            config.timesteps, config.sampling_steps, config.timestep_spacing
        ),
        guidance_scale=guidance_scale,
    )


def write_export(
    source: Path,
    folder: Path,
    files: Sequence[str],
    graphs: Mapping[str, Any],
    kind: type[CardT],
    card: ModelCard,
    also_ready: Sequence[str] = (),
    **own: Any,
) -> CardT:
    """Write a model folder with graphs of `traced` and the card that vouches for them.

    Args:
        source: the model's folder.
        folder: made when absent; may be the same.
        files: of the model, copied where they are there.
        graphs: by the names of their files.
        kind: of the card.
        card: of the model.
        also_ready: those of the graphs that are written as `ready` makes them, too.
        own: what the card of this kind says besides.

    Raises:
        UserError: the folder cannot be written.
    """
    for name in files:
        given, target = source / name, folder / name
        if given.is_file() and not (target.exists() and target.samefile(given)):
            with atomic_write(target) as temporary:
                shutil.copyfile(given, temporary)
    written = {
        READY + name: _write(path=folder / (READY + name), **ready(graphs[name], folder))
        for name in also_ready
    }
    for name, graph in graphs.items():
        link_weights(graph, folder)
        written[name] = _write(graph, folder / name)
    result = kind(
        name=card.name,
        description=card.description,
        licence=card.licence,
        trained=card.trained,
        model=card.content_hash,
        fps=card.fps,
        graphs=written,
        **own,
    )
    write_json(folder / ONNX_CARD, result.model_dump(mode="json", by_alias=True))
    return result


# ---------------------------------------------------------------- weights outside the graph


def link_weights(model: Any, folder: Path) -> None:
    """Let the initializers of a graph be what lies in a folder's model.safetensors, where it does.

    They are recognised by their content, as it is or transposed. What is stored as int8 or float16
    becomes float32 in the graph: onnxruntime folds those nodes away on loading. Of a table of which
    rows are looked up, only those rows do.
    """
    from onnx import helper, numpy_helper

    header, known = _header(folder / WEIGHTS_FILE), _known(folder)
    graph, outside, nodes = model.graph, dict[str, Any](), list[Any]()
    rest, inside = list(graph.node), list[Any]()
    for each in graph.initializer:
        value = numpy_helper.to_array(each)
        lookups = [node for node in rest if each.name in node.input]
        looked_up = all(_looks_up(node, each.name) for node in lookups)
        alike = known.get(_digest(value), [])
        if not alike:
            inside.append(each)
            continue
        name = max(reversed(alike), key=lambda name: not name.endswith(TURNED))
        turned = name.endswith(TURNED)
        if looked_up and not turned:
            for node in lookups:
                at, found = rest.index(node), (node.output[0], header, outside, node.input[1])
                rest[at : at + 1] = _stored(name, *found)
            continue
        plain = f"{each.name}/turned" if turned else each.name
        nodes += _stored(name.removesuffix(TURNED), plain, header, outside)
        if turned:
            nodes.append(helper.make_node("Transpose", [plain], [each.name]))
    graph.ClearField("initializer")
    graph.ClearField("node")
    graph.initializer.extend([*inside, *outside.values()])
    graph.node.extend([*nodes, *rest])


def ready(model: Any, folder: Path) -> dict[str, Any]:
    """The `model` of `traced` as onnxruntime optimises it, to open without doing so again, and the
    files that its `weights` are in.

    Each holds a tensor of the folder's model.safetensors as float32 and has its name, with TURNED
    behind it where it is transposed. Who opens the graph hands them over: from int8 and scales ONNX
    makes floats by nodes alone, and to fold these away is most of opening.
    """
    import onnx
    import onnxruntime

    options = onnxruntime.SessionOptions()
    options.graph_optimization_level = onnxruntime.GraphOptimizationLevel.ORT_ENABLE_EXTENDED
    options.log_severity_level = 3  # errors
    with TemporaryDirectory() as scratch:
        options.optimized_model_filepath = str(Path(scratch) / "ready.onnx")
        onnxruntime.InferenceSession(
            model.SerializeToString(), options, providers=["CPUExecutionProvider"]
        )
        found = onnx.load(options.optimized_model_filepath)
    used = {node.domain for node in found.graph.node}
    versions = [each for each in found.opset_import if each.domain in used]
    found.ClearField("opset_import")
    found.opset_import.extend(versions)
    known, names = _known(folder), dict[str, str]()  # what they are called: their names
    for each in found.graph.initializer:
        alike = known.get(_digest(onnx.numpy_helper.to_array(each)), [])
        if alike and each.data_type == onnx.TensorProto.FLOAT:
            name = each.name if each.name in alike else alike[0]
            alike.remove(name)
            names[each.name] = name
            each.ClearField("raw_data")
            each.data_location = onnx.TensorProto.EXTERNAL
            each.external_data.add(key="location", value=name)
            each.name = name
    for node in found.graph.node:
        node.input[:] = [names.get(each, each) for each in node.input]
    return {"model": found, "weights": tuple(names.values())}


def _known(folder: Path) -> dict[str, list[str]]:
    """Digests of a folder's tensors, as they are and transposed, and the names of those that are
    alike, TURNED behind those that are transposed."""
    known = defaultdict[str, list[str]](list)
    for name, tensor in read_tensors(folder, read_card(folder)).items():
        value = tensor.numpy()
        known[_digest(value)].append(name)
        if value.ndim == 2:
            known[_digest(value.T)].append(name + TURNED)
    return known


def _looks_up(node: Any, table: str) -> bool:
    """Whether a node does nothing with a table but to take rows of it."""
    axis = next((each.i for each in node.attribute if each.name == "axis"), 0)
    return bool(node.op_type == "Gather" and node.input[0] == table and axis == 0)


def _stored(
    name: str,
    value: str,
    header: Mapping[str, Any],
    outside: dict[str, Any],
    rows: str | None = None,
) -> list[Any]:
    """The nodes that make a value of a stored tensor, or of those rows of it that are looked up.

    Args:
        name: of the tensor in its file.
        value: what it is called in the graph.
        header: of the file.
        outside: initializers by name, to which those that it needs are added.
        rows: the value that says which rows; None = all.
    """
    from onnx import TensorProto, helper

    nodes = []

    def made(stored: str, called: str, more: int = 0) -> None:
        entry = header[stored]
        plain = rows is None and entry["dtype"] not in ("F16", "I8")
        source = called if plain else f"stored/{stored}"
        _read(stored, source, [*entry["shape"], *[1] * more], header, outside)
        if plain:
            return
        if rows is not None:
            nodes.append(helper.make_node("Gather", [source, rows], [f"{called}/rows"], axis=0))
            source = f"{called}/rows"
        if entry["dtype"] in ("F16", "I8"):
            nodes.append(helper.make_node("Cast", [source], [called], to=TensorProto.FLOAT))
        else:
            nodes.append(helper.make_node("Identity", [source], [called]))

    if (scale := name + INT8_SCALE) not in header:
        made(name, value)
    else:
        made(name, f"{value}/rounded")
        made(scale, f"{value}/scale", len(header[name]["shape"]) - 1)  # [R, 1, ...]
        nodes.append(helper.make_node("Mul", [f"{value}/rounded", f"{value}/scale"], [value]))
    return nodes


def _read(
    stored: str,
    called: str,
    shape: Sequence[int],
    header: Mapping[str, Any],
    outside: dict[str, Any],
) -> None:
    """Add an initializer that is read from the file of the weights."""
    from onnx import TensorProto

    types = {"F32": TensorProto.FLOAT, "F16": TensorProto.FLOAT16, "I8": TensorProto.INT8,
             "I32": TensorProto.INT32, "I64": TensorProto.INT64}  # fmt: skip
    entry = header[stored]
    tensor = TensorProto(name=called, data_type=types[entry["dtype"]])
    tensor.dims.extend(shape)
    tensor.data_location = TensorProto.EXTERNAL
    start, stop = entry["data_offsets"]
    where = {"location": WEIGHTS_FILE, "offset": start + header[_START], "length": stop - start}
    for key, each in where.items():
        tensor.external_data.add(key=key, value=str(each))
    outside[called] = tensor


_START = ""  # in a header, where the data begins; no tensor has such a name


def _header(path: Path) -> dict[str, Any]:
    """What a safetensors file says of its tensors, and the byte at which they begin."""
    with path.open("rb") as stream:
        length = int.from_bytes(stream.read(8), "little")
        found: dict[str, Any] = parse_json(stream.read(length))
    return found | {_START: 8 + length}


def _digest(value: np.ndarray) -> str:
    kind = f"{value.dtype.str}{value.shape}".encode()
    return hashlib.sha256(kind + value.tobytes()).hexdigest()


def _info(value: Any) -> ValueInfo:
    from onnx import TensorProto

    kind = value.type.tensor_type
    shape = [dim.dim_param or dim.dim_value for dim in kind.shape.dim]
    return ValueInfo(dtype=TensorProto.DataType.Name(kind.elem_type).lower(), shape=tuple(shape))


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
