"""`evaluate-selection`: is the best of N better to those that the judge does not listen to?"""

from typing import Annotated, Any

import typer

from ..shared.errors import UsageError
from . import options
from .console import tell
from .evaluate import print_and_keep

SYNTHETIC = "synthetic"
MODELS = {"text": "starter", "audio": "starter-audio"}
LIMITS = {"num_subjects": (2, 10_000), "num_candidates": (2, 256)}


def evaluate_selection(
    branch: Annotated[str, typer.Option(help="text, or audio.")] = "text",
    model: Annotated[
        str | None, typer.Option(help="A name that `models` lists, or a folder from training.")
    ] = None,
    judge: Annotated[
        str | None, typer.Option(help="Text: a folder of train_clip; starter has its own.")
    ] = None,
    data: Annotated[
        str, typer.Option(help="Text: a prepared folder; audio: pairs, for the real row.")
    ] = SYNTHETIC,
    evaluator: Annotated[
        str, typer.Option(help="Text: a shipped name, or a folder from train_evaluator.")
    ] = "evaluator",
    num_subjects: Annotated[int | None, typer.Option(help="Prompts (64) or songs (24).")] = None,
    num_candidates: Annotated[int, typer.Option(help="To choose from, N.")] = 8,
    replications: Annotated[
        int | None, typer.Option(help="Times N motions of each, for intervals; 4, songs 2.")
    ] = None,
    unseen: Annotated[
        bool, typer.Option("--unseen", help="Text: label combinations that no training saw.")
    ] = False,
    steps: options.Steps = None,
    sampler: options.Sampler = None,
    guidance_scale: options.GuidanceScale = None,
    seed: Annotated[int, typer.Option(help="Of prompts or songs, noise and resampling.")] = 0,
    device: options.Device = "auto",
    threads: options.Threads = None,
    out: options.ReportFile = None,
    json: options.Json = False,
) -> None:
    """Measure the best of 1, 2, 4, … N candidates by figures that choose nothing themselves.

    \b
    Examples:
      motion-tools evaluate-selection --model starter --data data/mine
      motion-tools evaluate-selection --branch audio --data data/pairs
    """
    if branch not in MODELS:
        raise UsageError(f"--branch {branch} is unknown; choose from {', '.join(MODELS)}")
    options.check_ranges(
        steps=steps,
        guidance_scale=guidance_scale,
        seed=seed,
        threads=threads,
        replications=replications,
    )
    options.check_limits({"num_subjects": num_subjects, "num_candidates": num_candidates}, LIMITS)
    if out is not None:
        options.check_folder("--out", out.parent)
    wanted: dict[str, Any] = {"steps": steps, "sampler": sampler, "guidance_scale": guidance_scale}
    wanted |= {"device": device, "progress": lambda text: tell(f"evaluate-selection: {text}")}
    model = model or MODELS[branch]

    from ..shared.device import set_threads

    set_threads(threads)
    report: dict[str, Any]
    if branch == "text":
        options.check_data(data)
        from ..shared.evaluation.suites.selection import PromptSettings, evaluate_prompts

        prompts = PromptSettings(
            num_prompts=num_subjects or PromptSettings.num_prompts,
            num_candidates=num_candidates,
            replications=replications or PromptSettings.replications,
            split="unseen" if unseen else "seen",
            seed=seed,
        )
        report = evaluate_prompts(
            model, data, judge=judge, evaluator=evaluator, settings=prompts, **wanted
        )
    else:
        if judge is not None or unseen:
            raise UsageError("--judge and --unseen go with --branch text; leave them out")
        if data != SYNTHETIC:
            options.check_pairs(data)
        from ..shared.evaluation.suites.selection import SongSettings, evaluate_songs
        from ..shared.pipelines.song import shipped_bands

        songs = SongSettings(
            num_songs=num_subjects or SongSettings.num_songs,
            num_candidates=num_candidates,
            replications=replications or SongSettings.replications,
            seed=seed,
        )
        report = evaluate_songs(
            model,
            None if data == SYNTHETIC else data,
            bands=shipped_bands(model),
            settings=songs,
            **wanted,
        )
    from ..shared.evaluation.report.tables import as_markdown, heading
    from ..shared.evaluation.suites.selection import selection_tables

    apart = ", ".join(report["outside_apart"]) or "none"
    lines = [*heading(report), f"outside figures that are better, intervals apart: {apart}"]
    text = as_markdown("Best of N", lines, selection_tables(report))
    print_and_keep(report, text, out, json=json)
