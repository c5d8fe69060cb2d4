"""Reports as text: tables on a terminal or in Markdown, from the data of report.json."""

import math
import re
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from .families import Column
from .grids import Cell, Grid

if TYPE_CHECKING:
    from rich.console import Console


@dataclass(frozen=True)
class Table:
    """Plain cells, ready to be printed."""

    title: str
    header: list[str]
    rows: list[list[str]]
    note: str = ""


def number(value: float | None, decimals: int) -> str:
    """A figure, or a dash where there is none."""
    return "–" if value is None or math.isnan(value) else f"{value:.{decimals}f}"


def interval(cell: dict[str, Any] | None, decimals: int) -> str:
    """`value ± half width`; no width where there is one observation."""
    if cell is None or cell["value"] is None or math.isnan(cell["value"]):
        return "–"
    half = (cell["high"] - cell["low"]) / 2
    text = number(cell["value"], decimals)
    return f"{text} ±{number(half, decimals)}" if half > 0 else text


def cell_text(cell: Cell, column: Column) -> str:
    """Any cell as words."""
    if cell is None or isinstance(cell, str):
        return cell or "–"
    if isinstance(cell, dict):
        return interval(cell, column.decimals) + (" *" if cell.get("apart") else "")
    return number(cell, column.decimals)


def grids(report: dict[str, Any]) -> list[Grid]:
    """The tables of a report as data."""
    return [Grid.from_dict(table) for table in report["tables"]]


def tables(report: dict[str, Any]) -> Iterator[Table]:
    """Every table of a report, in reading order."""
    for grid in grids(report):
        yield printed(grid)


def printed(grid: Grid) -> Table:
    """A table as text; where rows differ in number, a column says how many motions and runs."""
    counted = any(row.num is not None for row in grid.rows.values())
    header = [grid.head, *(column.heading for column in grid.columns)]
    rows = [
        [name, *(cell_text(row.cells.get(column.key), column) for column in grid.columns)]
        + ([counts(row.num, row.replications)] if counted else [])
        for name, row in grid.rows.items()
    ]
    return Table(grid.title, [*header, "N × runs"] if counted else header, rows, grid.note)


def counts(num: int | None, replications: int | None) -> str:
    """Motions times replications."""
    if num is None:
        return "–"
    return str(num) if replications is None else f"{num} × {replications}"


def heading(report: dict[str, Any]) -> list[str]:
    """What was measured with what, line by line."""
    facts = {**report["about"], **report["settings"]}
    return [f"{key.replace('_', '-')}: {_fact(value)}" for key, value in facts.items()]


def _fact(value: Any) -> str:
    return ", ".join(map(str, value)) if isinstance(value, list) else str(value)


def intervals_note(report: dict[str, Any]) -> str:
    """How the ± of a report came about, and with which seeds."""
    settings = report["settings"]
    if "replications" not in settings:
        return ""
    first, runs = settings["seed"], settings["replications"]
    seeds = f"seed {first}" if runs == 1 else f"seeds {first}, {first + 1000}, … ({runs} runs)"
    return (
        f"{seeds}. ± is half a 95% interval: over replications (1.96 σ/√runs) for figures of a"
        " whole sample, over motions (percentile bootstrap; Wilson where all are yes or no) for"
        " figures of single motions. N × runs: motions a replication, and replications."
    )


def markdown(report: dict[str, Any]) -> str:
    """The report as a Markdown text."""
    lines = [*heading(report), intervals_note(report)]
    return as_markdown(report["title"], filter(None, lines), tables(report)) + _worst(report)


def _worst(report: dict[str, Any]) -> str:
    """The motions that were kept, worst first."""
    samples = report.get("samples", [])
    if not samples:
        return ""
    rows = [[f"{s['rank']} of {s['of']}, {s['bench']}", s["title"], s["file"]] for s in samples]
    table = Table("worst first", ["place", "asked for", "file"], rows)
    return "\n".join(_table_lines(table)) + "\n"


def as_markdown(title: str, lines: Iterable[str], parts: Iterable[Table]) -> str:
    """Any report as a Markdown text: a title, facts line by line, tables."""
    text = [f"# {_inert(title)}", "", *(f"- {_inert(line)}" for line in lines), ""]
    for table in parts:
        text += _table_lines(table)
    return "\n".join(text)


def _table_lines(table: Table) -> list[str]:
    lines = [f"## {_inert(table.title)}", "", _line(table.header), "|" + "---|" * len(table.header)]
    lines += [_line(row) for row in table.rows]
    return [*lines, "", table.note, ""] if table.note else [*lines, ""]


def _line(cells: Sequence[str]) -> str:
    """A row in Markdown."""
    return "| " + " | ".join(map(_inert, cells)) + " |"


def _inert(text: str) -> str:
    """Text that is no HTML, link or border in Markdown, whatever prompt or file it quotes."""
    return re.sub(r"[\\<\[|]", r"\\\g<0>", text)


def print_report(report: dict[str, Any], console: "Console") -> None:
    """The report as tables on a terminal."""
    draw([*heading(report), intervals_note(report)], tables(report), console)


def draw(lines: Iterable[str], parts: Iterable[Table], console: "Console") -> None:
    """Any report on a terminal: facts line by line, tables."""
    from rich.table import Table as RichTable

    for line in filter(None, lines):
        console.print(line, highlight=False)
    for table in parts:
        drawn = RichTable(title=table.title, caption=table.note, title_justify="left")
        for index, name in enumerate(table.header):
            drawn.add_column(name, justify="right" if index else "left")
        for row in table.rows:
            drawn.add_row(*row)
        console.print(drawn)
