"""Options that several commands share, checks of their values, and the help page of a command."""

import errno
import re
import tempfile
from pathlib import Path
from typing import Annotated, Any

import typer
from typer.core import TyperCommand

from ..shared import environment
from ..shared.errors import UsageError
from ..shared.io.files import made_folder, unfinished
from ..shared.io.storage import Address, Place, place
from .console import complain

NAMED = "A name that `models` lists, a folder from training, or user/model[@revision] on a hub."
Model = Annotated[str, typer.Option(help=NAMED)]
Device = Annotated[str, typer.Option(envvar=environment.DEVICE, help="auto, cpu, cuda or mps.")]
Mapping = Annotated[Path | None, typer.Option(help="YAML that names your skeleton's joints.")]
Unit = Annotated[
    str | None, typer.Option(help="Unit of length read: m, cm, mm, in, ft, cmu; else guessed.")
]
Up = Annotated[str | None, typer.Option(help="Up axis of what is read: Y, Z, -X, …; else guessed.")]
SourceFps = Annotated[
    float | None, typer.Option(help="Frames a second of what is read, where it does not say.")
]
Skeleton = Annotated[
    Path | None, typer.Option(help="ASF skeleton of AMC files; the one beside each.")
]
Root = Annotated[str, typer.Option(help="on; or in-place: no travel.")]
Threads = Annotated[int | None, typer.Option(help="CPU threads to use.")]
Workers = Annotated[int | None, typer.Option(help="Processes; one a core.")]
Scheduler = Annotated[
    str | None,
    typer.Option(help="Of a Dask cluster that does the work, tcp://HOST:8786; local: one here."),
]
Json = Annotated[bool, typer.Option("--json", help="The result as JSON on stdout.")]
Steps = Annotated[
    int | None,
    typer.Option(help="Sampling steps; the model's own. 1 and 2 begin with a learned one, if any."),
]
Sampler = Annotated[str | None, typer.Option(help="ddim, ddpm or dpm-solver++; the model's own.")]
GuidanceScale = Annotated[
    float | None, typer.Option(help="How strictly to follow the prompt; the model's own.")
]

# of evaluations
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
AudioModel = Annotated[
    str,
    typer.Option(
        "--model",
        "--diffusion-checkpoint",
        envvar=environment.DIFFUSION_CHECKPOINT,
        help=NAMED,
    ),
]
OutputDir = Annotated[
    Path,
    typer.Option(envvar=environment.OUTPUT_DIR, help="Folder for report, table and plots."),
]
Pairs = Annotated[
    str | None,
    typer.Option(
        envvar=environment.DATA_DIR,
        help="Pairs from `prepare-audio`, a folder or bucket: its test split is used.",
    ),
]
Decoder = Annotated[
    str | None,
    typer.Option(
        envvar=environment.DECODER_CHECKPOINT,
        help="Another model folder, to take the decoder from.",
    ),
]
ReportFile = Annotated[Path | None, typer.Option(help="Report file: .json, or .md for tables.")]


def parts(text: str) -> list[str]:
    """What is named with commas between."""
    return [part.strip() for part in text.split(",") if part.strip()]


def check_root(root: str) -> None:
    """Raises UsageError: not one of the choices of `Root`."""
    if root not in ("on", "in-place"):
        raise UsageError(f"--root {root!r} is unknown; choose from on, in-place")


def check_scheduler(scheduler: str | None) -> None:
    """As `jobs.check_scheduler`, which is imported only where there is one to check."""
    if scheduler is not None:
        from ..shared.io import jobs

        jobs.check_scheduler(scheduler)


def check_folder(flag: str, folder: Place) -> None:
    """Refuse a path that cannot become a folder, before anything slow starts.

    Raises:
        UsageError: a file stands in the way, or it cannot be made or written to.
        UserError: an address of a store that nothing can be written to.
    """
    if isinstance(folder, Address):
        trial = folder / ".trial"
        trial.write_bytes(b"")
        trial.unlink()
        return
    for part in (folder, *folder.parents):
        if part.exists():
            if not part.is_dir():
                raise UsageError(f"{flag} {folder}: {part} is a file; name a folder")
            break
    for chance in (1, 2):  # a trial: whoever writes makes the folder
        try:
            with made_folder(folder), tempfile.TemporaryFile(dir=folder):
                return
        except OSError as error:
            if chance == 1 and isinstance(error, FileNotFoundError):
                continue  # another process's trial took it away meanwhile
            reason = error.strerror or error
            raise UsageError(
                f"{flag} {folder}: cannot write there ({reason}); name another folder"
            ) from None


def check_file(flag: str, path: Path) -> None:
    """Refuse a file that cannot be written, before anything slow starts.

    Raises:
        UsageError: as `check_folder` of its folder, or its name is too long for the system.
    """
    check_folder(flag, path.parent)
    trial = unfinished(path)
    try:
        with made_folder(path.parent):
            trial.touch()
            trial.unlink()
    except OSError as error:
        if error.errno == errno.ENAMETOOLONG:  # of anything else writing tells
            raise UsageError(f"{flag} {path}: {error.strerror}; shorten its name") from None


def check_pairs(data: str | None) -> None:
    """Refuse a local folder that is not there; a bucket is asked when it is opened."""
    if data is not None and "://" not in data and not Path(data).is_dir():
        raise UsageError(f"--data {data} is no folder; name one that `prepare-audio` wrote")


def check_data(data: str) -> None:
    """Refuse a --data that is not there, before anything slow starts.

    Raises:
        UsageError: neither `synthetic` nor a folder that `prepare` finished.
    """
    if data != "synthetic" and not (place(data) / "manifest.json").is_file():
        raise UsageError(
            f"--data {data} is not prepared data (no manifest.json); name a folder that"
            " `prepare` wrote, or synthetic"
        )


def check_songs(folder: Path | None) -> None:
    """Refuse a --songs that is no folder."""
    if folder is not None and not folder.is_dir():
        raise UsageError(f"--songs {folder} is no folder; name one with sound files")


OWN_SUITE = "text"  # of `evaluate` itself
LIST = re.compile(r"<list\[(\w+)\]>")  # as typer tells of what may be repeated


class Command(TyperCommand):
    """A command whose help says what each value is, where typer tells of a Python list."""

    def format_options(self, ctx: Any, formatter: Any) -> None:
        """Write arguments and options."""
        write = formatter.write_dl
        formatter.write_dl = lambda rows: write(
            [(LIST.sub(lambda found: f"<{found[1].lower()}>", name), text) for name, text in rows]
        )
        super().format_options(ctx, formatter)


class SuiteCommand(Command):
    """`evaluate`, whose `--suite NAME` has the options of the command `evaluate-NAME`."""

    def make_context(
        self, info_name: str | None, args: list[str], parent: Any = None, **extra: Any
    ) -> Any:
        """Parse as the suite's own command does, where another suite than that of text is named.

        Raises:
            typer.Exit: there is none of that name.
        """
        name, rest = _suite(args)
        if parent is None or name in (None, OWN_SUITE):
            return super().make_context(info_name, args, parent, **extra)
        command = parent.command.get_command(parent, f"evaluate-{name}")
        if command is None:
            known = [each.removeprefix("evaluate-") for each in parent.command.list_commands(parent)
                     if each.startswith("evaluate-")]  # fmt: skip
            names = ", ".join([OWN_SUITE, *known])
            complain(f"error: --suite {name} is unknown; choose from {names}")
            raise typer.Exit(UsageError.exit_code)
        return command.make_context(f"{info_name} --suite {name}", rest, parent, **extra)


def _suite(args: list[str]) -> tuple[str | None, list[str]]:
    """The suite that is named, the last if several are, and the other arguments."""
    name, rest = None, []
    words = iter(args)
    for word in words:
        if word == "--suite":
            name = next(words, None)
        elif word.startswith("--suite="):
            name = word.removeprefix("--suite=")
        else:
            rest.append(word)
    return name, rest
