"""`plot`: a picture of a trajectory, or of a training run's losses."""

from pathlib import Path
from typing import Annotated

import typer

from ..shared.errors import UsageError
from . import options

PICTURES = (".png", ".pdf", ".svg")


def plot(
    file: Annotated[
        Path,
        typer.Argument(help="A trajectory (.npz, .npy, .csv) or a log (log.jsonl, .json)."),
    ],
    out: Annotated[
        Path | None, typer.Option(help="Picture: .png, .pdf or .svg; beside FILE by default.")
    ] = None,
) -> None:
    """Draw a trajectory's position, velocity, quaternion, phase, norm and jerk, or a run's losses.

    \b
    Example:
      motion-tools plot out/song.npz --out song.png
      motion-tools plot runs/audio/log.jsonl
    """
    if file.is_dir():
        raise UsageError(f"{file} is a folder; name a trajectory or a log.jsonl in it")
    picture = out or file.with_suffix(".png")
    if picture.suffix.lower() not in PICTURES:
        raise UsageError(f"--out {picture}: choose from {', '.join(PICTURES)}")
    if picture.is_dir():
        raise UsageError(f"--out {picture} is a folder; name a picture")
    options.check_folder("--out", picture.parent)

    if file.suffix.lower() in (".json", ".jsonl"):
        from ..shared.evaluation.report.plots import plot_losses, read_losses

        plot_losses(read_losses(file), picture, title=str(file))
    else:
        from ..shared.evaluation.report.plots import plot_trajectory
        from ..shared.formats.registry import read_trajectory

        plot_trajectory(read_trajectory(file), picture, title=str(file))
    print(picture)
