"""What was measured, told again: `report` makes pages, `compare` finds the better, `plot` draws."""

from pathlib import Path
from typing import Annotated

import typer

from ..shared.errors import UsageError
from . import options
from .console import tell
from .evaluate import Request, run, show_report


def report(
    folder: Annotated[Path, typer.Argument(help="A folder that `evaluate` wrote.")],
    json: options.Json = False,
) -> None:
    """Write report.md and report.html again, and print the tables; nothing is measured.

    \b
    Example:
      motion-tools report outputs/evaluation/starter
    """
    if not (folder / "report.json").is_file():
        raise UsageError(f"{folder} holds no report.json; name a folder that `evaluate` wrote")

    from ..shared.evaluation.report.pages import render

    show_report(render(folder), json=json)
    tell(f"report: {folder / 'report.html'}")


HELP = "A folder that `evaluate` wrote, or a model."


def compare(
    a: Annotated[str, typer.Argument(help=HELP)],
    b: Annotated[str, typer.Argument(help=HELP)],
    row: Annotated[str, typer.Option(help="Row of A.")] = "generated",
    other_row: Annotated[str | None, typer.Option(help="Row of B; the same.")] = None,
    quick: options.Quick = False,
    data: options.Data = None,
    evaluator: options.Judge = "evaluator",
    num_samples: options.NumSamples = None,
    replications: options.Replications = None,
    control_seeds: options.ControlSeeds = None,
    num_songs: options.NumSongs = None,
    steps: options.Steps = None,
    seed: options.Seed = 0,
    device: options.Device = "auto",
    threads: options.Threads = None,
    out: Annotated[Path, typer.Option(help="Folder of this and of the models' reports.")] = Path(
        "outputs/comparison"
    ),
    json: options.Json = False,
) -> None:
    """Compare two reports figure by figure; models are evaluated first, with the flags given.

    A difference counts if its 95% interval excludes 0.

    \b
    Example:
      motion-tools compare outputs/evaluation/starter outputs/evaluation/mine
      motion-tools compare starter runs/mine --quick --data data/mine
    """
    request = Request.of(locals())
    options.check_folder("--out", out)
    folders = [report_of(name, side, request, out) for side, name in (("a", a), ("b", b))]

    from ..shared.evaluation.compare import Side
    from ..shared.evaluation.compare import compare as differences
    from ..shared.evaluation.report.pages import save_report

    result = differences(Side(folders[0], row), Side(folders[1], other_row or row), seed=seed)
    save_report(result, out)
    show_report(result, json=json)
    tell(f"compare: {out / 'report.html'}")


def report_of(name: str, side: str, request: Request, out: Path) -> Path:
    """The folder of a finished report; a model is evaluated into one."""
    if (Path(name) / "report.json").is_file():
        return Path(name)
    folder = out / f"{side}-{Path(name).name}"
    run(name, request, folder)
    return folder


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
    options.check_file("--out", picture)

    if file.suffix.lower() in (".json", ".jsonl"):
        from ..shared.evaluation.report.plots import plot_losses, read_losses

        plot_losses(read_losses(file), picture, title=str(file))
    else:
        from ..shared.evaluation.report.plots import plot_trajectory
        from ..shared.formats.registry import read_trajectory

        plot_trajectory(read_trajectory(file), picture, title=str(file))
    print(picture)
