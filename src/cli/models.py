"""What can be named in `--model`: `models` lists, `calibrate` tries, `export-onnx` writes ONNX."""

from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import Annotated

import typer

from ..shared import environment
from ..shared.errors import UsageError, UserError
from . import options
from .console import print_columns, print_json, tell

COLUMNS = ("name", "kind", "trained", "licence", "size", "languages", "description")


def models(json: options.Json = False) -> None:
    """List shipped and trained models.

    \b
    Example:
      motion-tools models
    """
    from ..shared.model.checkpoint import list_models

    rows = list_models()
    if json:
        print_json(rows)
        return
    if not rows:
        print("no models: none are shipped, and runs/ holds none; train one (see README.md)")
        return
    print_columns(COLUMNS, [[str(row[column]) for column in COLUMNS] for row in rows])


def export_onnx(
    out: Annotated[
        Path, typer.Option(help="Folder for the model with its graphs; may be the model's own.")
    ],
    model: Annotated[
        str | None, typer.Option(help="A name that `models` lists, or a folder from training.")
    ] = None,
    json: options.Json = False,
) -> None:
    """Write a model for onnxruntime, in Python or a browser: any text, any length, any batch.

    The folder holds the weights, tokenizer and graphs; docs/onnx.md says what goes in and out.

    \b
    Examples:
      motion-tools export-onnx --out onnx
      motion-tools export-onnx --model starter-audio --out onnx-audio
      motion-tools generate --prompt "a person waves" --runtime onnx --model onnx
    """
    options.check_folder("--out", out)

    from ..shared.model.checkpoint import read_card, resolve_model, wrong_kind
    from ..shared.model.onnx_card import EXPORTED, ONNX_CARD, OnnxCard, require_packages

    require_packages("onnx", "onnxscript")
    name = environment.TEXT_MODEL if model is None else model
    folder = resolve_model(name)
    kind = read_card(folder).kind
    export: Callable[[str, Path], OnnxCard]
    if kind == EXPORTED[0]:
        from ..shared.model.generation.onnx import export_text as export
    elif kind == EXPORTED[1]:
        from ..shared.model.audio.onnx import export_audio as export
    else:
        raise wrong_kind(folder, kind, EXPORTED[0])
    card = export(name, out)
    files = [out / name for name in (*card.graphs, card.weights, ONNX_CARD)]
    if json:
        graphs = {name: graph.model_dump() for name, graph in card.graphs.items()}
        result = {"model": name, "opset": card.opset, "graphs": graphs}
        print_json(result | {"files": [str(file) for file in files]})
    else:
        print(*files, sep="\n")


def calibrate(
    model: Annotated[Path, typer.Option(help="Folder of `train generation`; its scope is kept.")],
    data: Annotated[Path, typer.Option(help="Folder written by `prepare`, as it was trained on.")],
    tries: Annotated[int, typer.Option(help="Sentences of each action.")] = 12,
    seed: Annotated[int, typer.Option(help="Of sampling, and of the sentences drawn.")] = 0,
    threads: options.Threads = None,
    json: options.Json = False,
) -> None:
    """Ask a model for each of its actions and let it warn of those that seldom come out.

    A judge fitted on the clips of DATA says what came out. `generate` and `evaluate-requests` warn
    from then on of prompts that ask for an action shown in less than half of the tries, and sample
    again where kinematics that the clips bear out do not see the action.

    \b
    Example:
      motion-tools calibrate --model runs/generation --data data/prepared
    """
    options.check_ranges(seed=seed, threads=threads, tries=tries)
    if not (model / "config.json").is_file():
        raise UsageError(
            f"--model {model} is no model folder of yours, and what ships is not written to; name"
            " a folder of `train generation`, or copy one"
        )

    from ..shared.data.prepared import PreparedData
    from ..shared.data.text_motion import arm_actions, gestures
    from ..shared.device import set_threads
    from ..shared.evaluation.judge.actions import action_reliability, recognizer_of
    from ..shared.model.clip.out_of_domain import RELIABLE
    from ..shared.model.generation.motion_generator import TextToMotion
    from ..shared.pipelines.text import SentenceGenerator

    set_threads(threads)
    generator = TextToMotion.from_pretrained(model, device="cpu")
    if generator.scope is None:
        raise UserError(f"{model} has no scope.json to write to; train it again with this version")
    clips = PreparedData.open(data)

    def progress(what: str) -> None:
        tell(f"calibrate: {what}")

    judge = recognizer_of(clips, seed, progress)
    checked = tuple(sorted(judge.necessary))
    generator.scope = replace(
        generator.scope, gestures=gestures(clips), arms=arm_actions(clips), checked=checked
    )
    found = action_reliability(
        SentenceGenerator(generator), clips, judge, tries=tries, seed=seed, progress=progress
    )
    replace(generator.scope, reliability=found).save_pretrained(model)
    if json:
        print_json({"model": str(model), "reliability": found})
    else:
        for action, share in sorted(found.items(), key=lambda each: each[1]):
            print(f"{share:.2f}  {action}{'  (warned of)' if share < RELIABLE else ''}")
