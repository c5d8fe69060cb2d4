"""What can be named in `--model`: `models` lists it and exchanges it with a hub, `calibrate` tries
it, `export-onnx` writes it as ONNX, `studio` as a page that makes motions in a browser; and
`shape-check`: the stages of a profile, as the architecture document tells."""

from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from ..shared import environment
from ..shared.errors import UsageError, UserError
from . import options
from .console import guarded, print_columns, print_json, tell, told, with_quiet

if TYPE_CHECKING:
    from .shape_tables import Table

COLUMNS = ("name", "kind", "trained", "licence", "size", "languages", "description")


models = typer.Typer(invoke_without_command=True, rich_markup_mode=None)


def list_all(context: typer.Context, json: options.Json = False) -> None:
    """List shipped and trained models; push one to a hub, pull one from there.

    \b
    Examples:
      motion-tools models
      motion-tools models pull user/model
    """
    if context.invoked_subcommand is not None:
        return

    from ..shared.model.checkpoint import list_models

    rows = list_models()
    if json:
        print_json(rows)
        return
    if not rows:
        print("no models: none are shipped, and runs/ holds none; train one (see README.md)")
        return
    print_columns(COLUMNS, [[str(row[column]) for column in COLUMNS] for row in rows])


def pull(
    name: Annotated[str, typer.Argument(help="user/model, or user/model@REVISION.")],
    out: Annotated[
        Path | None, typer.Option(help="Folder for a copy of one's own; else the cache alone.")
    ] = None,
    force: Annotated[bool, typer.Option("--force", help="Fetch again what is cached.")] = False,
    json: options.Json = False,
) -> None:
    """Fetch a model from a hub and check every file; its name does wherever a model is named.

    HF_ENDPOINT, HF_HUB_CACHE, HF_TOKEN and HF_HUB_OFFLINE are heard; docs/hub.md tells more.

    \b
    Examples:
      motion-tools models pull user/model
      motion-tools models pull user/model@v1 --out my-model
      motion-tools generate --model user/model@v1 --prompt "a person waves"
    """
    if out is not None:
        options.check_folder("--out", out)

    from ..shared.model.hub import copy_files, parsed
    from ..shared.model.hub import pull as fetch

    folder = fetch(name, force=force)
    if out is not None:
        copy_files(folder, out)
    if json:
        found = {"model": parsed(name)[0], "revision": folder.name, "folder": str(out or folder)}
        print_json(found)
    else:
        print(out or folder)


def push(
    model: Annotated[str, typer.Argument(help="A name that `models` lists, or a trained folder.")],
    repo: Annotated[str, typer.Argument(help="user/model, or user/model@BRANCH.")],
    licence: Annotated[
        str | None, typer.Option(help="As the hub calls it, cc-by-4.0 say; else the model's own.")
    ] = None,
    dataset: Annotated[
        list[str] | None, typer.Option(help="What it learned from; may be repeated.")
    ] = None,
    private: Annotated[
        bool, typer.Option("--private", help="If the repository is not there, make a private one.")
    ] = False,
    message: Annotated[str | None, typer.Option(help="Of the commit.")] = None,
    dry_run: Annotated[
        bool, typer.Option("--dry-run", help="Print the card and the files, push nothing.")
    ] = False,
    json: options.Json = False,
) -> None:
    """Publish a model on a hub, with a model card, in one commit.

    The card is README.md of the folder, or is made of what config.json says.

    \b
    Examples:
      motion-tools models push runs/mine user/model --licence cc-by-4.0 --dry-run
      motion-tools models push runs/mine user/model --licence cc-by-4.0 --dataset my-mocap
    """
    from ..shared.model.checkpoint import resolve_model
    from ..shared.model.hub import model_files, parsed, push_to_hub, render_card

    name, datasets = parsed(repo)[0], dataset or ()
    if dry_run:
        folder = resolve_model(model)
        card = render_card(folder, name, licence=licence, datasets=datasets)
        files = model_files(folder)
        if json:
            print_json({"card": card, "files": files})
        else:
            print(card, *files, sep="\n")
        return
    commit = push_to_hub(
        model, repo, licence=licence, datasets=datasets, private=private, message=message
    )
    if json:
        print_json({"model": name, "commit": commit})
    else:
        print(commit)


models.callback()(with_quiet(guarded(list_all)))
for command in (pull, push):
    models.command(cls=options.Command)(with_quiet(guarded(command)))


def export_onnx(
    out: Annotated[
        Path, typer.Option(help="Folder for the model with its graphs; may be the model's own.")
    ],
    model: Annotated[str | None, typer.Option(help=options.NAMED)] = None,
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
    from ..shared.model.onnx_card import EXPORTED, ONNX_CARD, OnnxCard
    from ..shared.model.onnx_graphs import require_packages

    require_packages("onnx", "onnxscript", "onnxruntime")
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


def studio(
    out: Annotated[
        Path, typer.Option(help="The page: an .html file, or a folder for its index.html.")
    ] = Path("outputs/studio.html"),
    model: Annotated[str, typer.Option(help=options.NAMED)] = environment.TEXT_MODEL,
    steps: options.Steps = None,
    no_open: Annotated[bool, typer.Option("--no-open", help="Only write it.")] = False,
    json: options.Json = False,
) -> None:
    """Write one page with the model inside, and open it in the browser; it needs no server.

    \b
    Examples:
      motion-tools studio
      motion-tools studio --out public/ --no-open
      motion-tools studio --steps 2
    """
    from ..shared.studio.page import page_file, write_studio

    options.check_file("--out", page_file(out))
    path = write_studio(out, model, steps)
    if json:
        print_json({"file": str(path), "bytes": path.stat().st_size})
    else:
        print(path)
    if no_open:
        return
    import webbrowser

    if not webbrowser.open(path.resolve().as_uri()):
        tell(f"no browser here to open it with; open {path} in one")


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
    again where kinematics that the clips bear out do not see the action. Stopped on the way, it
    goes on where it was.

    \b
    Example:
      motion-tools calibrate --model runs/generation --data data/prepared
    """
    if not (model / "config.json").is_file():
        raise UsageError(
            f"--model {model} is no model folder of yours, and what ships is not written to; name"
            " a folder of `train generation`, or copy one"
        )
    options.check_folder("--model", model)

    from ..shared.data.prepared import PreparedData
    from ..shared.data.text_motion import arm_actions, gestures, still_actions
    from ..shared.device import set_threads
    from ..shared.evaluation.actions import action_reliability, recognizer_of
    from ..shared.evaluation.manifest import hash_names
    from ..shared.io.files import sha256_file
    from ..shared.model.checkpoint import WEIGHTS_FILE
    from ..shared.model.clip.out_of_domain import META_FILE, RELIABLE
    from ..shared.model.generation.motion_generator import TextToMotion
    from ..shared.pipelines.text import SentenceGenerator

    set_threads(threads)
    generator = TextToMotion.from_pretrained(model, device="cpu")
    if generator.scope is None:
        raise UserError(f"{model} has no scope.json to write to; train it again with this version")
    clips = PreparedData.open(data)

    judge = recognizer_of(clips, seed, told("calibrate"))
    checked = tuple(sorted(judge.necessary))
    parts = [sha256_file(model / name) for name in (WEIGHTS_FILE, "config.json", META_FILE)]
    of = hash_names([f"{tries} {seed}", clips.manifest_hash, *parts])[:12]
    kept = model / f".calibration-{of}.json"
    generator.scope = replace(
        generator.scope,
        gestures=gestures(clips),
        arms=arm_actions(clips),
        still=still_actions(clips),
        checked=checked,
    )
    found = action_reliability(
        SentenceGenerator(generator),
        clips,
        judge,
        tries=tries,
        seed=seed,
        kept=kept,
        progress=told("calibrate"),
    )
    replace(generator.scope, reliability=found).save_pretrained(model)
    for done in model.glob(".calibration-*.json"):
        done.unlink(missing_ok=True)
    if json:
        print_json({"model": str(model), "reliability": found})
    else:
        for action, share in sorted(found.items(), key=lambda each: each[1]):
            print(f"{share:.2f}  {action}{'  (warned of)' if share < RELIABLE else ''}")


# ---------------------------------------------------------------- what profiles are made of


def shape_check(
    overrides: Annotated[
        list[str] | None,
        typer.Argument(metavar="[KEY=VALUE]...", help="Settings over the profile's."),
    ] = None,
    network_profile: Annotated[
        str, typer.Option(help="Profile of the networks: default, spark or lightweight.")
    ] = "default",
    model: Annotated[str, typer.Option(help="Which branch: text or audio.")] = "text",
    full: Annotated[
        bool, typer.Option("--full", help="CLIP's two towers as well as the denoiser.")
    ] = False,
    device: options.Device = "cpu",
    root_track: Annotated[
        bool | None,
        typer.Option("--root-track/--no-root-track", help="Override the profile's root-track."),
    ] = None,
    network_file: Annotated[
        Path | None, typer.Option(help="Another network file than the one that ships.")
    ] = None,
    json: options.Json = False,
) -> None:
    """Print every stage's shape and parameters.

    Runs a profile's networks once on random input and compares each shape with the document.

    \b
    Examples:
      motion-tools shape-check --network-profile default --full --device cpu
      motion-tools shape-check --no-root-track generation.num-layers=6
      motion-tools shape-check --model audio unet.conditioning=film
    """
    settings = list(overrides or [])
    if root_track is not None:
        settings.append(f"root-track={str(root_track).lower()}")
    if model not in ("text", "audio"):
        raise UsageError(f"--model {model!r} is no branch; choose text or audio")
    for flag, given in (("--full", full), ("--root-track", root_track is not None)):
        if model == "audio" and given:
            raise UsageError(f"{flag} belongs to the text branch; leave it out with --model audio")

    import torch

    from ..shared.config_loader import load_audio_network, load_network
    from ..shared.device import choose_device
    from .shape_tables import audio_table, text_table

    if model == "audio":
        sound = load_audio_network(network_profile, network_file, settings)
        table = audio_table(sound, torch.device(choose_device(device)[0]))
        letters = table.letters
    else:
        network = load_network(network_profile, network_file, settings)
        generation = network.generation
        if full and generation.motion_channels != 6:
            raise UsageError(
                f"--full: generation.motion-channels is {generation.motion_channels}, and"
                " quaternions need 6D rotations; leave --full out, or set it to 6"
            )
        table = text_table(network, torch.device(choose_device(device)[0]), full=full)
        letters = {letter: table.letters[letter] for letter in "BTKCD"}
        letters |= {"H": generation.num_heads, "L": generation.num_layers}
        letters["S"] = generation.diffusion_steps
    if json:
        print_json(facts(network_profile, letters, table, full))
    else:
        print_table(network_profile, letters, table)
    if not all(stage.agrees for stage in table.stages):
        raise typer.Exit(1)


def show(shapes: tuple[tuple[int, ...], ...]) -> str:
    """((2, 40), (2, 128)) -> `2 x 40 -> 2 x 128`."""
    return " -> ".join(" x ".join(map(str, shape)) for shape in shapes)


def print_table(profile: str, letters: dict[str, int], table: "Table") -> None:
    """Plain aligned columns, so that nothing is cut off in a pipe."""
    print(f"profile {profile}:", " ".join(f"{key}={value}" for key, value in letters.items()))
    rows = [
        (
            stage.network,
            stage.row.name,
            f"{stage.row.before} -> {stage.row.after}",
            show(stage.shapes),
            f"{stage.parameters:,}" if stage.parameters else "-",
            stage.row.note if stage.agrees else f"MISMATCH: {show(stage.expected)}",
        )
        for stage in table.stages
    ]
    head = ("network", "stage", "in letters", "in -> out", "parameters", "notes")
    print_columns(head, rows, right="parameters", ruled=True)
    wrong, number = sum(not stage.agrees for stage in table.stages), len(rows)
    print(f"{wrong} of {number} stages differ" if wrong else f"all {number} stages agree")


def facts(profile: str, letters: dict[str, int], table: "Table", full: bool) -> dict[str, Any]:
    """The same for programs."""
    rows: list[dict[str, Any]] = [
        {
            "network": stage.network,
            "stage": stage.row.name,
            "letters": [stage.row.before, stage.row.after],
            "input": list(stage.shapes[0]),
            "output": list(stage.shapes[1]),
            "parameters": stage.parameters,
            "agrees": stage.agrees,
            "note": stage.row.note,
        }
        for stage in table.stages
    ]
    agree = all(stage.agrees for stage in table.stages)
    return {
        "profile": profile, "full": full, "letters": letters, "agree": agree, "stages": rows
    }  # fmt: skip
