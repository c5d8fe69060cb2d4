"""`evaluate`, `evaluate-audio`: honest figures, each beside real, chance and untrained rows."""

import sys
from collections.abc import Mapping
from dataclasses import dataclass, fields
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from ..shared.errors import UsageError
from . import options
from .console import flag_of, print_json, tell, told

if TYPE_CHECKING:
    from rich.console import Console

    from ..shared.evaluation.tables import Report
    from ..shared.model.audio.audio_motion_model import AudioMotionModel
    from ..shared.pipelines.song import SongGenerator


QUICK_REPLICATIONS, QUICK_SONGS = 3, 10
AUDIO_KIND, MODEL = "audio-motion", "starter-audio"


def given(**values: Any) -> dict[str, Any]:
    """Those that are not None, which is left to whoever is asked."""
    return {name: value for name, value in values.items() if value is not None}


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

    @classmethod
    def of(cls, arguments: Mapping[str, Any]) -> "Request":
        """From the arguments of a command, which may have others besides."""
        names = [each.name for each in fields(cls) if each.name in arguments]
        return cls(**{name: arguments[name] for name in names})

    def amount(self, *names: str) -> dict[str, Any]:
        """Settings that were asked for, by name, and how often."""
        runs = self.replications or (QUICK_REPLICATIONS if self.quick else None)
        return given(replications=runs, **{name: getattr(self, name) for name in ("seed", *names)})

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
    quick: options.Quick = False,
    model: options.Model = "starter",
    data: options.Data = None,
    evaluator: options.Judge = "evaluator",
    num_samples: options.NumSamples = None,
    replications: options.Replications = None,
    control_seeds: options.ControlSeeds = None,
    num_songs: options.NumSongs = None,
    song_seconds: options.SongSeconds = None,
    songs: options.Songs = None,
    steps: options.Steps = None,
    sampler: options.Sampler = None,
    guidance_scale: options.GuidanceScale = None,
    seed: options.Seed = 0,
    device: options.Device = "auto",
    threads: options.Threads = None,
    out: options.OutFolder = None,
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
    show_report(run(model, Request.of(locals()), out, suite), json=json)


def evaluate_audio(
    model: options.AudioModel = MODEL,
    decoder_checkpoint: options.Decoder = None,
    data: options.Pairs = None,
    songs: options.Songs = None,
    out: options.OutputDir = Path("outputs/audio"),
    quick: options.Quick = False,
    replications: options.Replications = None,
    num_songs: options.NumSongs = None,
    song_seconds: Annotated[float, typer.Option(help="Of each synthetic song.")] = 16.0,
    track_seconds: Annotated[float, typer.Option(help="Of each sound file, at most.")] = 30.0,
    tell_meter: Annotated[
        bool,
        typer.Option(
            "--tell-meter/--hear-meter", help="Tell the beat tracker each song's beats a bar."
        ),
    ] = True,
    steps: options.Steps = None,
    sampler: options.Sampler = None,
    guidance_scale: options.GuidanceScale = None,
    seed: options.Seed = 0,
    device: options.Device = "auto",
    threads: options.Threads = None,
    json: options.Json = False,
) -> None:
    """Hold motions against the music they were made for, on songs with tempi never trained on.

    Beside every figure: the beat tracker's own error, chance, another song, the same song half a
    beat later, an untrained network, and real paired motion.

    \b
    Example:
      motion-tools evaluate-audio --model starter-audio --data data/pairs --songs music
    """
    request = Request.of({**locals(), "decoder": decoder_checkpoint})
    show_report(run(model, request, out, "audio"), json=json)


# ---------------------------------------------------------------- running


def run(model: str, request: Request, out: Path | None, suite: str | None = None) -> dict[str, Any]:
    """Evaluate a model of either branch and write its report; `suite`: text, or the model's own.

    Raises:
        UserError: no such model, wrong flags, or data that cannot be used.
    """
    from ..shared.model.checkpoint import read_card, resolve_model

    folder = out or Path("outputs/evaluation") / Path(model).name
    check(request, folder)
    audio = read_card(resolve_model(model)).kind == AUDIO_KIND
    if suite is not None and suite != ("audio" if audio else "text"):
        raise UsageError(
            f"{model} makes motion from {'music' if audio else 'text'}; name one that makes it"
            f" from {'text, starter' if audio else 'music, starter-audio'} for example"
        )
    refuse(model, audio, request)

    from ..shared.device import set_threads
    from ..shared.io.files import sole_writer

    set_threads(request.threads)
    with sole_writer(folder):
        report = (run_audio if audio else run_text)(model, request, folder)

        from ..shared.evaluation.pages import save_report

        save_report(report, folder)
    tell(f"evaluate: {folder / 'report.html'}")
    return report


def run_text(model: str, request: Request, folder: Path) -> dict[str, Any]:
    """The text branch's report."""
    options.check_data(request.data or "synthetic")

    from ..shared.evaluation.suites import text as harness
    from ..shared.evaluation.suites.text import TextSettings

    return harness.evaluate_text(
        model,
        request.data or "synthetic",
        evaluator=request.evaluator,
        settings=TextSettings(**request.amount("num_samples", "control_seeds")),
        device=request.device,
        folder=folder,
        progress=told("evaluate"),
        **request.sampling,
    )


def run_audio(model: str, request: Request, folder: Path) -> dict[str, Any]:
    """The audio branch's report."""
    options.check_pairs(request.data)

    from ..shared.evaluation.suites.audio import AudioContext, AudioSettings, evaluate_audio

    amount = request.amount("num_songs", "song_seconds", "track_seconds", "tell_meter")
    if request.quick:
        amount = {"num_songs": QUICK_SONGS, **amount}
    context = AudioContext(
        load_generator(model, request.decoder, request.device),
        AudioSettings(**amount),
        request.data,
        request.songs,
        request.sampling,
        told("evaluate"),
    )
    about = {"model": model, "decoder": request.decoder or model}
    return evaluate_audio(context, about=about, folder=folder)


# ---------------------------------------------------------------- arguments


def check(request: Request, folder: Path) -> None:
    """Refuse folders that cannot be used, before anything slow starts.

    Raises:
        UsageError: naming the flag.
    """
    options.check_songs(request.songs)
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
            kind = "music" if audio else "text"
            raise UsageError(
                f"{flag_of(name)} is not for {model}, which makes motion from {kind}; leave it out"
            )


def load_generator(
    name: str, decoder: str | None, device: str
) -> "SongGenerator[AudioMotionModel]":
    """A trained audio branch on a device, with another folder's decoder if one is named."""
    from ..shared.pipelines.song import SongGenerator

    generator = SongGenerator.from_pretrained(name, device=device)
    if decoder is not None:
        from ..shared.model.audio.audio_motion_model import load_decoder

        generator.model.decoder = load_decoder(decoder).to(generator.device).eval()
    return generator


def show_report(report: "Report", *, json: bool) -> None:
    """On stdout: JSON, or tables: drawn in a terminal, Markdown in a pipe, where they would be cut.

    Whatever suite it is of.
    """
    from ..shared.evaluation.tables import markdown

    if json:
        print_json(report)
    elif sys.stdout.isatty():
        from rich.console import Console

        draw(report, Console(markup=False))
    else:
        print(markdown(report))


def draw(report: "Report", console: "Console") -> None:
    """Any report on a terminal: facts line by line, tables."""
    from rich.table import Table

    from ..shared.evaluation.tables import heading, intervals_note, tables

    for line in filter(None, [*heading(report), intervals_note(report)]):
        console.print(line, highlight=False)
    for table in tables(report):
        drawn = Table(title=table.title, caption=table.note, title_justify="left")
        for index, name in enumerate(table.header):
            drawn.add_column(name, justify="right" if index else "left")
        for row in table.rows:
            drawn.add_row(*row)
        console.print(drawn)


def keep_and_show(report: "Report", *files: Path, json: bool) -> None:
    """The report in these files, Markdown where one ends so, and on stdout."""
    from ..shared.evaluation.tables import markdown
    from ..shared.io.files import write_json, write_text

    for file in files:
        if file.suffix == ".md":
            write_text(file, markdown(report))
        else:
            write_json(file, report)
    show_report(report, json=json)


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

    from ..shared.evaluation.pages import render

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

    from ..shared.evaluation.pages import Side, save_report
    from ..shared.evaluation.pages import compare as differences

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
    if not file.exists():
        raise UsageError(f"{file} does not exist; name a trajectory or a log")
    picture = out or file.with_suffix(".png")
    if picture.suffix.lower() not in PICTURES:
        raise UsageError(f"--out {picture}: choose from {', '.join(PICTURES)}")
    if picture.is_dir():
        raise UsageError(f"--out {picture} is a folder; name a picture")
    options.check_file("--out", picture)

    if file.suffix.lower() in (".json", ".jsonl"):
        from ..train.run_log import plot_losses, read_losses

        plot_losses(read_losses(file), picture, title=str(file))
    else:
        from ..shared.formats.preview.charts import plot_trajectory
        from ..shared.formats.registry import read_trajectory
        from ..shared.metrics.sanity import SanityThresholds

        bound = SanityThresholds().max_jerk
        plot_trajectory(read_trajectory(file), picture, max_jerk=bound, title=str(file))
    print(picture)
