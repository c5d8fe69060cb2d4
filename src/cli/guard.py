"""Exit codes: 0 done, 1 failed, 2 wrong usage, 130 Ctrl-C, 143 ended; and --quiet."""

import errno
import functools
import inspect
import logging
import os
import sys
from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager
from io import TextIOWrapper
from typing import Annotated, Any, ParamSpec

import typer

from ..shared.errors import UsageError, UserError, printable
from ..shared.signals import orderly_termination

Parameters = ParamSpec("Parameters")
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


def guarded(command: Callable[Parameters, None]) -> Callable[Parameters, None]:
    """Let a command end with one line and an exit code wherever the user can mend it.

    A fault of ours keeps its traceback: it is what a report needs.
    """

    @functools.wraps(command)
    def run(*args: Parameters.args, **kwargs: Parameters.kwargs) -> None:
        logging.basicConfig(format="warning: %(message)s")  # from warnings upwards, on stderr
        try:
            check_texts(kwargs)
            with orderly_termination(), short_names():
                command(*args, **kwargs)
        except UserError as error:
            complain(f"error: {error}")
            raise typer.Exit(error.exit_code) from None
        except KeyboardInterrupt:
            complain("interrupted: files already reported are whole")
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


def check_texts(arguments: Mapping[str, Any]) -> None:
    """Refuse text whose bytes are not UTF-8, which Python hands over as half characters.

    Paths are left as they are: a file may be called by any bytes.

    Raises:
        UsageError: quoting the text.
    """
    for value in arguments.values():
        for text in value if isinstance(value, list) else [value]:
            if isinstance(text, str) and any("\ud800" <= char <= "\udfff" for char in text):
                raise UsageError(f"{text!r} is not UTF-8 text; set the terminal to UTF-8")


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
