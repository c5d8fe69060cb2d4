"""`evaluate-performer`: dances of whole bodies, and editing, each beside what must score less."""

from pathlib import Path
from typing import Annotated, Any

import typer

from . import options
from .console import tell
from .evaluate import SONG_LIMITS, show_report

QUICK = {"num_songs": 4, "replications": 1, "style_songs": 2, "edits": 6}
LIMITS = {**SONG_LIMITS, "style_songs": (0, 10_000), "edits": (0, 10_000)}


def evaluate_performer(
    model: options.Model = "starter",
    audio_model: Annotated[
        str, typer.Option(help="What makes the paths: a name, or a folder from training.")
    ] = "starter-audio",
    other: Annotated[
        str | None, typer.Option(help="Another text model, for a row of its own.")
    ] = None,
    data: options.Pairs = None,
    clips: Annotated[
        str, typer.Option(help="What editing is measured on: a prepared folder, or synthetic.")
    ] = "synthetic",
    songs: options.Songs = None,
    evaluator: options.Judge = "evaluator",
    out: Annotated[Path, typer.Option(help="Folder of the report. Begun ones go on.")] = Path(
        "outputs/performer"
    ),
    quick: options.Quick = False,
    replications: options.Replications = None,
    num_songs: Annotated[int | None, typer.Option(help="Held-out synthetic songs; 20.")] = None,
    song_seconds: Annotated[float, typer.Option(help="Of each synthetic song.")] = 16.0,
    track_seconds: Annotated[float, typer.Option(help="Of each sound file, at most.")] = 16.0,
    style_songs: Annotated[
        int | None, typer.Option(help="Songs danced to different prompts; 8.")
    ] = None,
    edits: Annotated[
        int | None, typer.Option(help="Clips that are edited; 24. 0 = no editing.")
    ] = None,
    steps: options.Steps = None,
    sampler: options.Sampler = None,
    guidance_scale: options.GuidanceScale = None,
    seed: options.Seed = 0,
    device: options.Device = "auto",
    threads: options.Threads = None,
    json: options.Json = False,
) -> None:
    """Measure whole-body dances and edited motions: beats, prompts, paths, feet, seams.

    Beside every figure: real dances, another song, a frozen pose, the path alone, an untrained
    network. With --quick: 4 songs, one replication.

    \b
    Example:
      motion-tools evaluate-performer --data data/pairs --clips data/mine --songs music
    """
    amount: dict[str, Any] = {
        "num_songs": num_songs,
        "replications": replications,
        "style_songs": style_songs,
        "edits": edits,
    }
    amount = {name: value for name, value in amount.items() if value is not None}
    amount = (QUICK if quick else {}) | amount
    options.check_ranges(
        steps=steps, guidance_scale=guidance_scale, seed=seed, threads=threads,
        replications=replications,
    )  # fmt: skip
    amount |= {"song_seconds": song_seconds, "track_seconds": track_seconds}
    options.check_limits({k: v for k, v in amount.items() if k in LIMITS}, LIMITS)
    options.check_pairs(data)
    options.check_songs(songs)
    if amount.get("edits") != 0:
        options.check_data(clips)
    options.check_folder("--out", out)
    sampling = {"steps": steps, "sampler": sampler, "guidance_scale": guidance_scale}
    models = {"model": model, "audio_model": audio_model, "other": other, "evaluator": evaluator}
    from ..shared.io.files import sole_writer

    with sole_writer(out):
        report = run(
            models, amount | {"seed": seed}, sampling, data, clips, songs, out, device, threads
        )
    show_report(report, json=json)


def run(
    models: dict[str, str | None],
    amount: dict[str, Any],
    sampling: dict[str, Any],
    data: str | None,
    clips: str,
    songs: Path | None,
    out: Path,
    device: str,
    threads: int | None,
) -> dict[str, Any]:
    """Load, measure, and write the report.

    Raises:
        UserError: no such model, or data that cannot be used.
    """
    from ..shared.device import set_threads

    set_threads(threads)
    from ..shared.evaluation.held_out import open_held_out
    from ..shared.evaluation.judge.evaluator import Evaluator
    from ..shared.evaluation.report.pages import save_report
    from ..shared.evaluation.suites.dance import DanceContext, DanceSettings
    from ..shared.evaluation.suites.dance import evaluate_performer as evaluate
    from ..shared.evaluation.suites.editing import EditContext, EditSettings
    from ..shared.model.generation.motion_generator import TextToMotion
    from ..shared.pipelines.body import PerformerSettings
    from ..shared.pipelines.song import SongGenerator

    judge = Evaluator.from_pretrained(str(models["evaluator"]))
    generator = TextToMotion.from_pretrained(str(models["model"]), device=device)
    other = models["other"]
    settings = DanceSettings(**amount)
    context = DanceContext(
        generator,
        SongGenerator.from_pretrained(str(models["audio_model"]), device=device),
        judge,
        settings,
        data=data,
        songs=songs,
        other=None if not other else TextToMotion.from_pretrained(other, device=device),
        sampling=PerformerSettings(**sampling),
        progress=told,
    )
    editing = None
    if settings.edits:
        editing = EditContext(
            generator,
            open_held_out(clips, Path("runs"), judge.trained_groups),
            EditSettings(settings.edits, untrained=settings.untrained, seed=settings.seed),
            progress=told,
        )
    report = evaluate(context, editing, about=models, folder=out)
    save_report(report, out)
    tell(str(out / "report.html"))
    return report


def told(text: str) -> None:
    """Progress, on stderr."""
    tell(f"evaluate-performer: {text}")
