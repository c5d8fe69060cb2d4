"""`shape-check`: each stage's name, shape and parameters, as the architecture document tells."""

from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from ..shared.errors import UsageError
from . import options
from .console import print_columns, print_json

if TYPE_CHECKING:
    from .shape_tables import Table


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
