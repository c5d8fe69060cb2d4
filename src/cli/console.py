"""What every command says and how it ends: lines on stderr, progress, --quiet, exit codes.

0 is done, 1 failed, 2 wrong usage, 130 Ctrl-C, 143 ended.
"""

import errno
import functools
import inspect
import logging
import os
import sys
import time
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from io import TextIOWrapper
from typing import Annotated, Any, ParamSpec, TypeVar

import typer

from ..shared.errors import UsageError, UserError, in_range, printable
from ..shared.io.concurrency import orderly_termination
from ..shared.io.storage import Place

Parameters = ParamSpec("Parameters")
OptionsT = TypeVar("OptionsT")  # a dataclass
INTERRUPTED = 130
QUIET = inspect.Parameter(
    "quiet",
    inspect.Parameter.KEYWORD_ONLY,
    default=False,
    annotation=Annotated[
        bool, typer.Option("--quiet", "-q", help="Only errors and warnings on stderr.")
    ],
)

_quiet = False  # as the command that runs was told


def is_quiet() -> bool:
    """Whether this command was given --quiet."""
    return _quiet


def complain(text: str) -> None:
    """One line on stderr, an error or a warning; stdout belongs to results."""
    print(printable(" ".join(str(text).split())), file=sys.stderr, flush=True)


def tell(text: str) -> None:
    """One line on stderr of what is being done or was done; none with --quiet."""
    if not _quiet:
        complain(text)


def told(command: str) -> Callable[[str], None]:
    """Tells a command's progress, on stderr."""
    return lambda text: tell(f"{command}: {text}")


def guarded(command: Callable[Parameters, None]) -> Callable[Parameters, None]:
    """Let a command end with one line and an exit code wherever the user can mend it.

    A fault of ours keeps its traceback: it is what a report needs.
    """

    @functools.wraps(command)
    def run(*args: Parameters.args, **kwargs: Parameters.kwargs) -> None:
        logging.basicConfig(format="warning: %(message)s")  # from warnings upwards, on stderr
        try:
            check_texts(kwargs)
            check_ranges(kwargs)
            with orderly_termination(), short_names():
                command(*args, **kwargs)
        except UserError as error:
            complain(f"error: {error}")
            raise typer.Exit(error.exit_code) from None
        except ModuleNotFoundError as error:
            package = (error.name or "").partition(".")[0]
            if package in ("", "src", "motionsuite"):
                raise
            complain(
                f"error: this needs the package {package}, which is not installed"
                "; `pip install motionsuite` brings all of them"
            )
            raise typer.Exit(1) from None
        except KeyboardInterrupt:
            complain("interrupted: files that are written are whole")
            raise typer.Exit(INTERRUPTED) from None

    return run


def with_quiet(command: Callable[..., None]) -> Callable[..., None]:
    """The command with one more option, --quiet."""

    @functools.wraps(command)
    def run(*args: Any, quiet: bool = False, **kwargs: Any) -> None:
        global _quiet
        _quiet = quiet
        command(*args, **kwargs)

    signature = inspect.signature(command)
    parameters = [*signature.parameters.values(), QUIET]
    run.__signature__ = signature.replace(parameters=parameters)  # type: ignore[attr-defined]
    return run


def of_fields(
    options: type[OptionsT],
) -> Callable[[Callable[[OptionsT], None]], Callable[..., None]]:
    """Makes a command of a function of one dataclass, whose fields are the options."""

    def command(function: Callable[[OptionsT], None]) -> Callable[..., None]:
        @functools.wraps(function)
        def run(**given: Any) -> None:
            function(options(**given))

        run.__signature__ = inspect.signature(options)  # type: ignore[attr-defined]
        return run

    return command


def check_texts(arguments: Mapping[str, Any]) -> None:
    """Refuse text whose bytes are not UTF-8, which Python hands over as half characters.

    Paths are left as they are, and text that names what is there (where it may be an address, too):
    a file may be called by any bytes.

    Raises:
        UsageError: quoting the text.
    """
    for value in arguments.values():
        for text in value if isinstance(value, list) else [value]:
            half = isinstance(text, str) and any("\ud800" <= char <= "\udfff" for char in text)
            if half and not os.path.lexists(text):
                raise UsageError(f"{text!r} is not UTF-8 text; set the terminal to UTF-8")


RANGES = {  # of numbers, whatever command has them
    "window": (0.1, 4.0),
    "song_seconds": (4.0, 600.0),
    "track_seconds": (4.0, 7200.0),
    "keep": (0.1, 60.0),
    "begin": (0.0, 7200.0),
    "until": (0.0, 7200.0),
    "source_fps": (1.0, 2000.0),
    "fps": (1.0, 1000.0),
    "passes": (1, 100),
    "meter": (2, 12),
    "num_samples": (1, 100_000),
    "num_frames": (8, 3000),
    "num_steps": (1, 10_000),
    "num_songs": (2, 10_000),
    "num_phrases": (2, 10_000),
    "num_subjects": (2, 10_000),
    "num_candidates": (2, 256),
    "style_songs": (0, 10_000),
    "edits": (0, 10_000),
    "wordings": (1, 100),
    "seed": (0, 2**63 - 1),
    "steps": (1, 10_000),
    "guidance_scale": (0.0, 30.0),
    "threads": (1, 1024),
    "workers": (1, 1024),
    "synthetic": (0, 1_000_000),
    "replications": (1, 1000),
    "control_seeds": (0, 10_000),
    "tries": (1, 1000),
}
FLAGS = {"begin": "--from", "until": "--to"}  # the others are called as their parameters


def flag_of(name: str) -> str:
    """An option as it is typed, of the parameter's name."""
    return FLAGS.get(name, "--" + name.replace("_", "-"))


def check_ranges(arguments: Mapping[str, Any]) -> None:
    """Refuse numbers out of range; None is left to the model.

    Raises:
        UsageError: naming the flag and its range.
    """
    given = [(flag_of(n), arguments[n], *RANGES[n]) for n in RANGES if arguments.get(n) is not None]
    for each in given:
        in_range(*each)


def check_range(name: str, value: float | None, least: float, most: float) -> None:
    """Refuse a number that is out of range, NaN among them.

    Raises:
        UsageError: naming the flag and its range.
    """
    if value is not None:
        in_range(flag_of(name), value, least, most)


@contextmanager
def short_names() -> Iterator[None]:
    """Tell of a name that no file can have.

    Raises:
        UsageError: the system found a name too long.
    """
    try:
        yield
    except OSError as error:
        if error.errno != errno.ENAMETOOLONG:
            raise
        raise UsageError(f"{error.filename}: its name is too long; shorten it") from None


@contextmanager
def results_on_stdout() -> Iterator[None]:
    """Print paths byte for byte, and tell in one line that stdout takes no more."""
    if isinstance(sys.stdout, TextIOWrapper):
        sys.stdout.reconfigure(errors="surrogateescape")  # file names that are not UTF-8
    try:
        try:
            yield
        finally:
            print(end="", flush=True)
    except OSError as error:
        if error.errno not in (errno.ENOSPC, errno.EPIPE):
            raise
        if error.errno == errno.ENOSPC:  # a reader who has gone, as `head` does, is no error
            complain("error: stdout cannot be written: no space left; send it elsewhere")
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())  # what is left in the buffer
        sys.exit(1)


LINE_SECONDS = 10.0  # between lines where there is no screen


@contextmanager
def progress_bar(what: str) -> Iterator[Callable[[int, int], None]]:
    """Its value is told (done, in all): a bar on a screen, else a line now and then.

    Args:
        what: is counted, in the plural.
    """
    if is_quiet():
        yield lambda done, total: None
        return
    if not sys.stderr.isatty():
        yield lines(what)
        return
    from rich.console import Console
    from rich.progress import BarColumn, MofNCompleteColumn, Progress, TimeRemainingColumn

    screen = Console(stderr=True)
    columns = (what, BarColumn(), MofNCompleteColumn(), TimeRemainingColumn())
    with Progress(*columns, console=screen, transient=True) as bar:
        task = bar.add_task(what, total=None)
        yield lambda done, total: bar.update(task, completed=done, total=total)


def lines(what: str) -> Callable[[int, int], None]:
    """Told (done, in all), it says so every `LINE_SECONDS`, with the seconds that are left, counted
    from the first time on, before which models are loaded."""
    last, first = time.monotonic(), (0, 0.0)

    def told(done: int, total: int) -> None:
        nonlocal last, first
        now = time.monotonic()
        before, began = first
        if not began:
            first = done, now
        if 0 < done < total and now - last >= LINE_SECONDS:
            left = ""
            if began and done > before:
                seconds = (now - began) / (done - before) * (total - done)
                left = f", about {seconds:.0f} s left"
            tell(f"{done} of {total} {what}{left}")
            last = now

    return told


def counted(number: int, noun: str) -> str:
    """`1 motion`, `2 motions`."""
    return f"{number} {noun}" if number == 1 else f"{number} {noun}s"


def print_json(result: Any) -> None:
    """One JSON value on stdout: results of a command with --json."""
    import json

    print(json.dumps(result, indent=1, ensure_ascii=False))


def print_columns(
    head: Sequence[str], rows: Sequence[Sequence[str]], *, right: str = "", ruled: bool = False
) -> None:
    """Plain aligned columns on stdout, so that nothing is cut off in a pipe.

    Args:
        head: their names.
        rows: their cells.
        right: the column that is aligned to the right.
        ruled: hyphens below the names.
    """
    widths = [max(len(row[column]) for row in [head, *rows]) for column in range(len(head))]
    rules = [["-" * width for width in widths]] if ruled else []
    for row in [head, *rules, *rows]:
        cells = [
            cell.rjust(width) if name == right else cell.ljust(width)
            for cell, width, name in zip(row, widths, head, strict=True)
        ]
        print("  ".join(cells).rstrip())


def note_replaced(paths: Iterable[Place], folder: Place) -> None:
    """Before writing: say how many of these files are in the folder already."""
    if found := sum(path.exists() for path in paths):
        verb = "is" if found == 1 else "are"
        tell(f"note: {counted(found, 'file')} in {folder} {verb} replaced")


class Stopwatch:
    """Seconds by part, and in all."""

    def __init__(self) -> None:
        self.started = self.last = time.perf_counter()
        self.laps: dict[str, float] = {}

    def lap(self, name: str) -> None:
        """End the part that began with the last lap; parts of one name add up."""
        now = time.perf_counter()
        self.laps[name], self.last = self.laps.get(name, 0.0) + now - self.last, now

    def seconds(self) -> dict[str, float]:
        """Every part and the total, to the millisecond."""
        parts = self.laps | {"total": self.last - self.started}
        return {name: round(value, 3) for name, value in parts.items()}
