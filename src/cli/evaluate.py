"""`evaluate`: honest figures of a model, each beside real, chance and untrained rows."""

from dataclasses import dataclass
from pathlib import Path
from typing import Annotated, Any

import typer

from ..shared.errors import UsageError
from . import options
from .console import tell

QUICK_REPLICATIONS, QUICK_SONGS = 3, 10
AUDIO_KIND = "audio-motion"
SONG_LIMITS = {
    "num_songs": (2, 10_000),
    "song_seconds": (4.0, 600.0),
    "track_seconds": (4.0, 7200.0),
}
OutFolder = Annotated[
    Path | None,
    typer.Option(help="Folder of the report; outputs/evaluation/MODEL. Begun ones go on."),
]
Data = Annotated[
    str | None,
    typer.Option(help="A prepared folder, or synthetic (text); pairs, for a real row (audio)."),
]
Judge = Annotated[
    str, typer.Option(help="The judge of text: a shipped name, or a folder from train_evaluator.")
]
Quick = Annotated[bool, typer.Option("--quick", help="3 replications; 10 songs.")]
NumSamples = Annotated[
    int | None, typer.Option(help="Generated motions a split; Fréchet needs 1000.")
]
Replications = Annotated[int | None, typer.Option(help="Repeats, for intervals; 20.")]
ControlSeeds = Annotated[int | None, typer.Option(help="Samples a controlled task; 10.")]
NumSongs = Annotated[int | None, typer.Option(help="Held-out synthetic songs; 50.")]
SongSeconds = Annotated[float | None, typer.Option(help="Of each synthetic song; 16.")]
Songs = Annotated[Path | None, typer.Option(help="Folder of sound files to describe as well.")]
Seed = Annotated[int, typer.Option(help="Of prompts, songs, noise, shuffles and resampling.")]


@dataclass(frozen=True)
class Request:
    """What the flags of `evaluate` and its relatives ask for; None = the default."""

    quick: bool = False
    data: str | None = None
    evaluator: str = "evaluator"
    decoder: str | None = None
    num_samples: int | None = None
    replications: int | None = None
    control_seeds: int | None = None
    songs: Path | None = None
    num_songs: int | None = None
    song_seconds: float | None = None
    track_seconds: float | None = None
    tell_meter: bool | None = None
    steps: int | None = None
    sampler: str | None = None
    guidance_scale: float | None = None
    seed: int = 0
    device: str = "auto"
    threads: int | None = None

    def amount(self, *names: str) -> dict[str, Any]:
        """Settings that were asked for, by name, and how often."""
        runs = self.replications or (QUICK_REPLICATIONS if self.quick else None)
        wanted = {name: getattr(self, name) for name in ("seed", *names)} | {"replications": runs}
        return {name: value for name, value in wanted.items() if value is not None}

    @property
    def sampling(self) -> dict[str, Any]:
        """What the model's own settings give way to."""
        names = ("steps", "sampler", "guidance_scale")
        return {name: getattr(self, name) for name in names}


def evaluate(
    suite: Annotated[
        str | None,
        typer.Option(
            help="text, audio, performer, requests, selection, memory, space or sanity, with the"
            " flags of evaluate-NAME; the model's own."
        ),
    ] = None,
    quick: Quick = False,
    model: options.Model = "starter",
    data: Data = None,
    evaluator: Judge = "evaluator",
    num_samples: NumSamples = None,
    replications: Replications = None,
    control_seeds: ControlSeeds = None,
    num_songs: NumSongs = None,
    song_seconds: SongSeconds = None,
    songs: Songs = None,
    steps: options.Steps = None,
    sampler: options.Sampler = None,
    guidance_scale: options.GuidanceScale = None,
    seed: Seed = 0,
    device: options.Device = "auto",
    threads: options.Threads = None,
    out: OutFolder = None,
    json: options.Json = False,
) -> None:
    """Score a model on motions or songs that no training saw: tables, plots, worst motions.

    Writes report.json, report.md, report.html, manifest.json and timing.json. Started again with
    the same flags it goes on where it stopped.

    \b
    Example:
      motion-tools evaluate --quick --model starter --data data/mine --out reports/mine
      motion-tools evaluate --quick --model starter-audio --data data/pairs
      motion-tools evaluate --suite requests --data data/mine
    """
    request = Request(
        quick=quick,
        data=data,
        evaluator=evaluator,
        num_samples=num_samples,
        replications=replications,
        control_seeds=control_seeds,
        songs=songs,
        num_songs=num_songs,
        song_seconds=song_seconds,
        steps=steps,
        sampler=sampler,
        guidance_scale=guidance_scale,
        seed=seed,
        device=device,
        threads=threads,
    )
    show(run(model, request, out, suite), json=json)


# ---------------------------------------------------------------- running


def run(model: str, request: Request, out: Path | None, suite: str | None = None) -> dict[str, Any]:
    """Evaluate a model of either branch and write its report; `suite`: text, or the model's own.

    Raises:
        UserError: no such model, wrong flags, or data that cannot be used.
    """
    from ..shared.model.checkpoint import read_card
    from ..shared.model.zoo import resolve_model

    folder = out or Path("outputs/evaluation") / Path(model).name
    check(request, folder)
    audio = read_card(resolve_model(model)).kind == AUDIO_KIND
    if audio and suite is not None:
        raise UsageError(
            f"--suite {suite} is not for {model}, which makes motion from music; leave --suite out"
        )
    refuse(model, audio, request)

    from ..shared.device import set_threads
    from ..shared.io.files import sole_writer

    set_threads(request.threads)
    with sole_writer(folder):
        report = (run_audio if audio else run_text)(model, request, folder)

        from ..shared.evaluation.report.pages import save_report

        save_report(report, folder)
    tell(f"evaluate: {folder / 'report.html'}")
    return report


def run_text(model: str, request: Request, folder: Path) -> dict[str, Any]:
    """The text branch's report."""
    check_data(request.data or "synthetic")

    from ..shared.evaluation.suites import text as harness
    from ..shared.evaluation.suites.text import TextSettings

    return harness.evaluate_text(
        model,
        request.data or "synthetic",
        evaluator=request.evaluator,
        settings=TextSettings(**request.amount("num_samples", "control_seeds")),
        device=request.device,
        folder=folder,
        progress=told,
        **request.sampling,
    )


def run_audio(model: str, request: Request, folder: Path) -> dict[str, Any]:
    """The audio branch's report."""
    from .evaluate_sanity import check_pairs, load_generator

    check_pairs(request.data)

    from ..shared.evaluation.suites.audio import AudioSettings, evaluate_audio

    amount = request.amount("num_songs", "song_seconds", "track_seconds", "tell_meter")
    if request.quick:
        amount = {"num_songs": QUICK_SONGS, **amount}
    return evaluate_audio(
        load_generator(model, request.decoder, request.device),
        data=request.data,
        songs=request.songs,
        settings=AudioSettings(**amount),
        sampling=request.sampling,
        about={"model": model, "decoder": request.decoder or model},
        folder=folder,
        progress=told,
    )


def told(text: str) -> None:
    """Progress, on stderr."""
    tell(f"evaluate: {text}")


# ---------------------------------------------------------------- arguments


def check(request: Request, folder: Path) -> None:
    """Refuse values out of range and folders that cannot be used, before anything slow starts.

    Raises:
        UsageError: naming the flag.
    """
    from .evaluate_sanity import check_limits

    options.check_ranges(
        **{
            name: getattr(request, name)
            for name in (
                "num_samples", "replications", "control_seeds", "steps", "guidance_scale", "seed",
                "threads",
            )
        }
    )  # fmt: skip
    given = {name: getattr(request, name) for name in SONG_LIMITS}
    check_limits({k: v for k, v in given.items() if v is not None}, SONG_LIMITS)
    if request.songs is not None and not request.songs.is_dir():
        raise UsageError(f"--songs {request.songs} is no folder; name one with sound files")
    if folder.suffix in (".json", ".md", ".html"):
        raise UsageError(
            f"--out {folder}: name a folder; report.json, report.md and report.html go into it"
        )
    options.check_folder("--out", folder)


def refuse(model: str, audio: bool, request: Request) -> None:
    """Refuse flags of the other branch.

    Raises:
        UsageError: naming the flag.
    """
    foreign = ("num_samples", "control_seeds") if audio else ("num_songs", "song_seconds", "songs")
    for name in foreign:
        if getattr(request, name) is not None:
            flag, kind = "--" + name.replace("_", "-"), "music" if audio else "text"
            raise UsageError(
                f"{flag} is not for {model}, which makes motion from {kind}; leave it out"
            )


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


# ---------------------------------------------------------------- results


def print_json(report: dict[str, Any]) -> None:
    """The whole report on stdout."""
    import json

    print(json.dumps(report, indent=1, ensure_ascii=False, default=str))


def show(report: dict[str, Any], *, json: bool) -> None:
    """JSON, or tables: drawn in a terminal, Markdown in a pipe, where drawn ones would be cut."""
    import sys

    from ..shared.evaluation.report.tables import markdown, print_report

    if json:
        print_json(report)
    elif sys.stdout.isatty():
        from rich.console import Console

        print_report(report, Console(markup=False))
    else:
        print(markdown(report))
