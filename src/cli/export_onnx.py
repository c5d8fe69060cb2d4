"""`export-onnx`: a trained audio model as ONNX graphs."""

from pathlib import Path
from typing import Annotated

import typer

from . import options
from .generate_request import AUDIO_MODEL


def export_onnx(
    out: Annotated[Path, typer.Option(help="Folder for unet.onnx, decoder.onnx, onnx.json.")],
    model: options.Model = AUDIO_MODEL,
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
    from ..shared.model.audio.onnx_card import CARD_FILE, require_packages
    from ..shared.model.audio.onnx_export import export_onnx as export

    require_packages("onnx", "onnxscript")
    card = export(AudioMotionModel.from_pretrained(model), out)
    files = [out / name for name in (*card.graphs, CARD_FILE)]
    if json:
        import json as json_format

        graphs = {name: graph.model_dump() for name, graph in card.graphs.items()}
        result = {"model": model, "opset": card.opset, "graphs": graphs}
        print(json_format.dumps(result | {"files": [str(file) for file in files]}, indent=1))
    else:
        print(*files, sep="\n")
