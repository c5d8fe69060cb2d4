"""`report`: the pages of an evaluation, made again from its report.json."""

from pathlib import Path
from typing import Annotated

import typer

from ..shared.errors import UsageError
from . import options


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

    from ..shared.evaluation.report.pages import render
    from .console import tell
    from .evaluate import show_report

    show_report(render(folder), json=json)
    tell(f"report: {folder / 'report.html'}")
