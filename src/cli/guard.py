"""From exceptions to exit codes: 0 done, 1 failed, 2 wrong usage, 130 interrupted."""

import functools
import logging
import sys
from collections.abc import Callable
from typing import ParamSpec

import typer

from src.shared.errors import UserError

Parameters = ParamSpec("Parameters")
INTERRUPTED = 130


def complain(text: str) -> None:
    """One line on stderr; stdout belongs to results."""
    print(" ".join(str(text).split()), file=sys.stderr, flush=True)


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
