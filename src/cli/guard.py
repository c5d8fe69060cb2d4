"""From exceptions to exit codes: 0 done, 1 failed, 2 wrong usage, 130 interrupted; and --quiet."""

import functools
import inspect
import logging
import sys
from collections.abc import Callable
from typing import Annotated, ParamSpec

import typer

from src.shared.errors import UserError

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
    print(" ".join(str(text).split()), file=sys.stderr, flush=True)


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
            command(*args, **kwargs)
        except UserError as error:
            complain(f"error: {error}")
            raise typer.Exit(error.exit_code) from None
        except KeyboardInterrupt:
            complain("interrupted: files already reported are whole")
            raise typer.Exit(INTERRUPTED) from None

    return run


def with_quiet(command: Callable[Parameters, None]) -> Callable[..., None]:
    """The command with one more option, --quiet."""

    @functools.wraps(command)
    def run(*args: Parameters.args, quiet: bool = False, **kwargs: Parameters.kwargs) -> None:
        global _quiet
        _quiet = quiet
        command(*args, **kwargs)

    signature = inspect.signature(command)
    parameters = [*signature.parameters.values(), QUIET]
    run.__signature__ = signature.replace(parameters=parameters)  # type: ignore[attr-defined]
    return run
