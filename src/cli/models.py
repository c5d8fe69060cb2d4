"""`models`: what can be named in `--model`; `export-onnx`: an audio model as ONNX graphs."""

from pathlib import Path
from typing import Annotated

import typer

from ..shared import environment
from . import options
from .console import print_columns, print_json

COLUMNS = ("name", "kind", "trained", "licence", "size", "languages", "description")


def models(json: options.Json = False) -> None:
    """List shipped and trained models.

    \b
    Example:
      motion-tools models
    """
    from ..shared.model.zoo import list_models

    rows = list_models()
    if json:
        print_json(rows)
        return
    if not rows:
        print("no models: none are shipped, and runs/ holds none; train one (see README.md)")
        return
    print_columns(COLUMNS, [[str(row[column]) for column in COLUMNS] for row in rows])


def export_onnx(
    out: Annotated[Path, typer.Option(help="Folder for unet.onnx, decoder.onnx, onnx.json.")],
    model: Annotated[
        str,
        typer.Option(
            envvar=environment.DIFFUSION_CHECKPOINT,
            help="A name that `models` lists, or a folder from training.",
        ),
    ] = "starter-audio",
    json: options.Json = False,
) -> None:
    """Write UNet and decoder of an audio model for onnxruntime; any length, any batch.

    \b
    Examples:
      motion-tools export-onnx --out onnx
      motion-tools generate --audio song.mp3 --runtime onnx --model onnx
    """
    options.check_folder("--out", out)

    from ..shared.model.audio.audio_motion_model import AudioMotionModel
    from ..shared.model.audio.onnx import CARD_FILE, require_packages
    from ..shared.model.audio.onnx import export_onnx as export

    require_packages("onnx", "onnxscript")
    card = export(AudioMotionModel.from_pretrained(model), out)
    files = [out / name for name in (*card.graphs, CARD_FILE)]
    if json:
        graphs = {name: graph.model_dump() for name, graph in card.graphs.items()}
        result = {"model": model, "opset": card.opset, "graphs": graphs}
        print_json(result | {"files": [str(file) for file in files]})
    else:
        print(*files, sep="\n")
