"""The scores of candidates: whole for JSON, the first few as a table on stderr."""

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

from .guard import is_quiet

if TYPE_CHECKING:
    from ..shared.pipelines.ranking import ScoreTable

SHOWN = 8  # candidates in the printed table


def scored(about: str, table: "ScoreTable") -> dict[str, Any]:
    """What was chosen for one prompt or song, as plain values: weights, candidates best first."""
    return {"for": about, "weights": table.weights, "candidates": table.rows()}


def show_scores(selection: Sequence[dict[str, Any]]) -> None:
    """One short table a prompt or song on stderr."""
    if not selection or is_quiet():
        return
    from rich.console import Console
    from rich.table import Table

    console = Console(stderr=True, highlight=False, markup=False)
    for chosen in selection:
        rows = chosen["candidates"]
        more = f", first {SHOWN} of {len(rows)}" if len(rows) > SHOWN else ""
        title = f"scores of {len(rows)} candidates{more}: {chosen['for']}"
        table = Table(title=title, title_justify="left", box=None, padding=(0, 1))
        for name in rows[0]:
            table.add_column(name, justify="right")
        for row in rows[:SHOWN]:
            table.add_row(*map(_cell, row.values()))
        console.print(table)


def _cell(value: float | int | None) -> str:
    if value is None:
        return "–"
    return str(value) if isinstance(value, int) else f"{value:.3f}"
