"""`evaluate`: the first honest figures of a model, each beside a real and a chance row."""

from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from src.cli import options
from src.cli.guard import complain
from src.shared.errors import UsageError

if TYPE_CHECKING:
    from src.shared.model.generation.motion_generator import MotionGenerator
    from src.shared.motion.motion import Motion


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
    sampling = {"steps": steps, "sampler": sampler, "guidance_scale": guidance_scale}
    options.check_ranges(threads=threads, steps=steps, guidance_scale=guidance_scale, **amount)
    given = {name: value for name, value in amount.items() if value is not None}
    report = judge_model(model, evaluator, data, given, sampling, device=device, threads=threads)
    if out is not None:
        write_report(report, out)
    if json:
        print_json(report)
    else:
        print_tables(report)


def judge_model(
    model: str,
    evaluator: str,
    data: str,
    amount: dict[str, Any],
    sampling: dict[str, Any],
    *,
    device: str,
    threads: int | None,
) -> dict[str, Any]:
    """Load model, judge and held-back clips, and run the harness."""
    from src.shared.device import set_threads
    from src.shared.evaluation.evaluator import Evaluator
    from src.shared.evaluation.harness import QuickSettings, evaluate_quick
    from src.shared.evaluation.held_out import open_held_out
    from src.shared.model.generation.motion_generator import MotionGenerator

    set_threads(threads)
    generator = MotionGenerator.from_pretrained(model, device=device)
    judge = Evaluator.from_pretrained(evaluator, device=generator.device)
    return evaluate_quick(
        {model: as_sampler(generator, sampling)},
        open_held_out(data, Path("runs"), judge.trained_groups),
        judge,
        settings=QuickSettings(**amount),
        about={"model": model, "model_hash": weights_hash(generator), **sampling},
        progress=lambda text: complain(f"evaluate: {text}"),
    )


def as_sampler(generator: "MotionGenerator", sampling: dict[str, Any]) -> Any:
    """The generator as the harness calls it: prompts and their frames to one motion each."""

    def sample(prompts: Sequence[str], frames: Sequence[int], seed: int) -> "list[Motion]":
        seconds = [count / generator.card.fps for count in frames]
        return generator.generate(prompts, seconds=seconds, seed=seed, **sampling)

    return sample


def weights_hash(generator: "MotionGenerator") -> str:
    """First digits of the SHA-256 that the model's card vouches for."""
    return generator.card.weights.sha256[:12] if generator.card.weights else "unsaved"


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
