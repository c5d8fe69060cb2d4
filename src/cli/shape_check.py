"""`shape-check`: each stage's name, shape and parameters, as the architecture document tells."""

from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from . import options

if TYPE_CHECKING:
    from ..shared.config_schema import NetworkConfig
    from .shape_stages import Stage


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
    from ..shared.config_loader import load_network

    check_branch(model, full=full, root_track=root_track)
    settings = list(overrides or [])
    if model == "audio":
        symbols, stages = collect_audio(network_profile, network_file, settings, device)
    else:
        if root_track is not None:
            settings.append(f"root-track={str(root_track).lower()}")
        network = load_network(network_profile, network_file, settings)
        stages, symbols = collect(network, device, full=full), letters_of(network)
    if json:
        print_json(network_profile, symbols, stages, full=full)
    else:
        print_table(network_profile, symbols, stages)
    if not all(stage.agrees for stage in stages):
        raise typer.Exit(1)


def check_branch(model: str, *, full: bool, root_track: bool | None) -> None:
    """Refuse another branch than text or audio, and flags that the audio branch has no use for.

    Raises:
        UsageError: naming the flag.
    """
    from ..shared.errors import UsageError

    if model not in ("text", "audio"):
        raise UsageError(f"--model {model!r} is no branch; choose text or audio")
    for flag, given in (("--full", full), ("--root-track", root_track is not None)):
        if model == "audio" and given:
            raise UsageError(f"{flag} belongs to the text branch; leave it out with --model audio")


def collect_audio(
    profile: str, path: Path | None, overrides: list[str], device: str
) -> "tuple[dict[str, int], list[Stage]]":
    """The letters of the audio branch, and all its stages in the order of the data.

    Raises:
        UsageError: an unknown profile or key, or no such device.
    """
    import torch

    from ..shared.config_loader import load_audio_network
    from ..shared.device import choose_device
    from .shape_stages_audio import AudioLetters, audio_stages

    network = load_audio_network(profile, path, overrides)
    stages = audio_stages(network, torch.device(choose_device(device)[0]))
    return AudioLetters(network).values, stages


def collect(network: "NetworkConfig", device: str, *, full: bool) -> "list[Stage]":
    """All stages of one check, in the order of the data.

    Raises:
        UsageError: `--full` with other than 6 channels a bone, or no such device.
    """
    import torch

    from ..shared.device import choose_device
    from ..shared.errors import UsageError
    from .shape_stages import clip_stages, denoiser_stages, post_processing_stages

    channels = network.generation.motion_channels
    if full and channels != 6:
        raise UsageError(
            f"--full: generation.motion-channels is {channels}, and quaternions need 6D"
            " rotations; leave --full out, or set it to 6"
        )
    place = torch.device(choose_device(device)[0])
    stages, text = clip_stages(network, place) if full else ([], None)
    denoiser, sample = denoiser_stages(network, place, text)
    return [*stages, *denoiser, *post_processing_stages(network, sample)]


def letters_of(network: "NetworkConfig") -> dict[str, int]:
    """The document's letters with this profile's values."""
    from .shape_stages import BATCH, FRAMES

    generation = network.generation
    return {
        "B": BATCH,
        "T": FRAMES,
        "K": generation.num_bones,
        "C": generation.motion_channels,
        "D": network.embed_dim,
        "H": generation.num_heads,
        "L": generation.num_layers,
        "S": generation.diffusion_steps,
    }


def show(shape: tuple[int, ...]) -> str:
    """(2, 40, 128) -> `2 x 40 x 128`."""
    return " x ".join(map(str, shape))


def print_table(profile: str, symbols: dict[str, int], stages: "list[Stage]") -> None:
    """Plain aligned columns, so that nothing is cut off in a pipe."""
    print(f"profile {profile}:", " ".join(f"{key}={value}" for key, value in symbols.items()))
    rows = [
        (
            stage.network,
            stage.name,
            " -> ".join(stage.symbols),
            " -> ".join(map(show, stage.shapes)),
            f"{stage.parameters:,}" if stage.parameters else "-",
            stage.note if stage.agrees else f"MISMATCH: {' -> '.join(map(show, stage.expected))}",
        )
        for stage in stages
    ]
    head = ("network", "stage", "in letters", "in -> out", "parameters", "notes")
    widths = [max(len(row[column]) for row in [head, *rows]) for column in range(len(head))]
    for row in [head, tuple("-" * width for width in widths), *rows]:
        cells = [cell.ljust(width) for cell, width in zip(row, widths, strict=True)]
        cells[4] = row[4].rjust(widths[4])
        print("  ".join(cells).rstrip())
    wrong = sum(not stage.agrees for stage in stages)
    print(f"{wrong} of {len(stages)} stages differ" if wrong else f"all {len(stages)} stages agree")


def print_json(profile: str, symbols: dict[str, int], stages: "list[Stage]", *, full: bool) -> None:
    """The same as one JSON object on stdout."""
    import json

    rows: list[dict[str, Any]] = [
        {
            "network": stage.network,
            "stage": stage.name,
            "letters": list(stage.symbols),
            "input": list(stage.shapes[0]),
            "output": list(stage.shapes[1]),
            "parameters": stage.parameters,
            "agrees": stage.agrees,
            "note": stage.note,
        }
        for stage in stages
    ]
    agree = all(stage.agrees for stage in stages)
    result = {"profile": profile, "full": full, "letters": symbols, "agree": agree, "stages": rows}
    print(json.dumps(result, indent=1, ensure_ascii=False))
