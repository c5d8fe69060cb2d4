"""`evaluate`: the first honest figures of a model, each beside a real and a chance row."""

from pathlib import Path
from typing import Annotated, Any

import typer

from src.cli import options
from src.cli.guard import complain
from src.shared.errors import UsageError


def evaluate(
    quick: Annotated[
        bool, typer.Option("--quick", help="The short harness, the only one so far.")
    ] = False,
    model: options.Model = "starter",
    data: Annotated[
        str, typer.Option(help="A prepared folder, or synthetic: fresh clips.")
    ] = "synthetic",
    evaluator: Annotated[
        str, typer.Option(help="The judge: a shipped name, or a folder from train_evaluator.")
    ] = "evaluator",
    num_samples: Annotated[
        int | None, typer.Option(help="Generated motions a split; Fréchet needs 1000.")
    ] = None,
    replications: Annotated[int | None, typer.Option(help="Repeats, for intervals.")] = None,
    control_seeds: Annotated[int | None, typer.Option(help="Samples a controlled task.")] = None,
    steps: options.Steps = None,
    sampler: options.Sampler = None,
    guidance_scale: options.GuidanceScale = None,
    seed: Annotated[int, typer.Option(help="Of captions, samples and shuffles.")] = 0,
    device: options.Device = "auto",
    threads: options.Threads = None,
    out: Annotated[Path | None, typer.Option(help="Report file: .json, or .md for tables.")] = None,
    json: options.Json = False,
) -> None:
    """Score a model on held-back motions.

    The judge is a separately trained text-motion model; real motions, chance and a frozen pose
    stand beside every figure, seen and unseen label combinations apart.

    \b
    Example:
      motion-tools evaluate --quick --model starter --data data/mine --out report.json
    """
    if not quick:
        raise UsageError("give --quick: the full harness is not there yet")
    amount: dict[str, Any] = {
        "num_samples": num_samples,
        "replications": replications,
        "control_seeds": control_seeds,
        "seed": seed,
    }
    sampling: dict[str, Any] = {
        "steps": steps,
        "sampler": sampler,
        "guidance_scale": guidance_scale,
    }
    options.check_ranges(threads=threads, steps=steps, guidance_scale=guidance_scale, **amount)
    given = {name: value for name, value in amount.items() if value is not None}
    if out is not None:
        if out.is_dir():
            raise UsageError(f"--out {out} is a folder; name a .json or .md file")
        options.check_folder("--out", out.parent)
    check_data(data)

    from src.shared.device import set_threads
    from src.shared.evaluation import harness

    set_threads(threads)
    report = harness.quick(
        model,
        data,
        evaluator=evaluator,
        settings=harness.QuickSettings(**given),
        device=device,
        progress=lambda text: complain(f"evaluate: {text}"),
        **sampling,
    )
    if out is not None:
        write_report(report, out)
    if json:
        print_json(report)
    else:
        print_tables(report)


def check_data(data: str) -> None:
    """Refuse a --data that is not there, before anything slow starts.

    Raises:
        UsageError: neither `synthetic` nor a folder that `prepare` finished.
    """
    if data != "synthetic" and not (Path(data) / "manifest.json").is_file():
        raise UsageError(
            f"--data {data} is not prepared data (no manifest.json); name a folder that"
            " `prepare` wrote, or synthetic"
        )


def print_json(report: dict[str, Any]) -> None:
    """The whole report on stdout."""
    import json

    print(json.dumps(report, indent=1, ensure_ascii=False, default=str))


def write_report(report: dict[str, Any], path: Path) -> None:
    """JSON, or Markdown tables when the name ends in .md."""
    from src.shared.evaluation.report import markdown
    from src.shared.files import write_json, write_text

    if path.suffix == ".md":
        write_text(path, markdown(report))
    else:
        write_json(path, report)


def print_tables(report: dict[str, Any]) -> None:
    """Drawn tables in a terminal, Markdown in a pipe, where drawn ones would be cut off."""
    import sys

    from src.shared.evaluation.report import markdown, print_report

    if not sys.stdout.isatty():
        print(markdown(report))
        return
    from rich.console import Console

    print_report(report, Console())
