"""`compare`: is B better than A? A paired bootstrap over the same prompts, songs and seeds."""

from pathlib import Path
from typing import Annotated

import typer

from . import options
from .console import tell
from .evaluate import Request, run, show_report

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
