"""The one table of all reports: rows of cells under described columns, as data and as text.

report.json holds it; Markdown, terminal, HTML, plots and comparison read it and know nothing of
the metrics behind it.
"""

import math
import re
import tomllib
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Any, Literal

from .stats import Estimate

WORDS = tomllib.loads(Path(__file__).with_name("tables.toml").read_text(encoding="utf-8"))
FORMAT_VERSION = 1
Better = Literal["high", "low", "real"]  # real: the nearer to the real row, the better
Cell = Estimate | Mapping[str, Any] | float | str | None  # a mapping: an `Estimate` of report.json
Report = dict[str, Any]  # what report.json holds, see `report_data`


@dataclass(frozen=True)
class Column:
    """One figure of a table."""

    key: str  # in report.json; unique among the metrics of a branch
    heading: str  # above the column, with its unit
    decimals: int = 3
    # which way is good; `worst first` goes by the columns that are not `real`
    better: Better = "real"
    # yes or no a motion (1 or 0): its interval is Wilson's, which has a width at 0 of N
    share: bool = False


def described(kind: str, **values: object) -> dict[str, Any]:
    """Columns, title, head and note of a kind of table in tables.toml, `values` in their braces."""
    texts = {key: text for key, text in WORDS[kind].items() if isinstance(text, str)}
    words = {key: " ".join(text.split()).format(**values) for key, text in texts.items()}
    return {"columns": tuple(Column(*each) for each in WORDS[kind].get("columns", ())), **words}


@dataclass(frozen=True)
class GridRow:
    """One row: its cells by column key, over how many motions, how often, with which seeds."""

    cells: Mapping[str, Cell]
    num: int | None = None
    replications: int | None = None

    def __post_init__(self) -> None:
        object.__setattr__(self, "cells", plain(self.cells))


@dataclass(frozen=True)
class Grid:
    """One table."""

    name: str  # unique in its report
    title: str
    columns: tuple[Column, ...]
    rows: Mapping[str, GridRow]  # by name, in reading order
    note: str = ""  # under the table, Markdown
    head: str = "row"  # over the names of the rows
    plot: bool = False  # whether the columns are drawn in the HTML report

    @classmethod
    def of(
        cls,
        kind: str,
        rows: Mapping[str, GridRow],
        values: Mapping[str, object] | None = None,
        **fields: Any,
    ) -> "Grid":
        """Rows under what tables.toml says of their kind; `fields` take its place."""
        return cls(rows=rows, **{"name": kind, **described(kind, **(values or {})), **fields})

    def as_dict(self) -> dict[str, Any]:
        """Plain data for report.json; rows keep their order."""
        rows = [{"name": name, **asdict(row)} for name, row in self.rows.items()]
        columns = [asdict(column) for column in self.columns]
        return {**asdict(self), "columns": columns, "rows": rows}

    @classmethod
    def from_dict(cls, data: Mapping[str, Any]) -> "Grid":
        """Back from report.json."""
        rows = {row["name"]: GridRow(row["cells"], row["num"], row["replications"])
                for row in data["rows"]}  # fmt: skip
        columns = tuple(Column(**column) for column in data["columns"])
        return cls(**{**data, "columns": columns, "rows": rows})

    def value(self, row: str, column: str) -> float:
        """The figure in a cell, NaN where there is none."""
        cell = self.rows[row].cells.get(column) if row in self.rows else None
        if isinstance(cell, Mapping):
            cell = cell["value"]
        return float(cell) if isinstance(cell, (int, float)) else math.nan


def plain(value: Any) -> Any:
    """JSON has no NaN: the same value with None in its place, and tuples as lists."""
    if isinstance(value, Estimate):
        return plain(asdict(value))
    if isinstance(value, Mapping):
        return {str(key): plain(item) for key, item in value.items()}
    if isinstance(value, (list, tuple)):
        return [plain(item) for item in value]
    if isinstance(value, float) and not math.isfinite(value):
        return None
    return value


def report_data(
    branch: str,
    about: Mapping[str, Any],
    settings: Mapping[str, Any],
    tables: Sequence[Grid],
    samples: Sequence[Mapping[str, Any]] = (),
    pictures: Sequence[Mapping[str, Any]] = (),
    *,
    title: str = "",
    **found: Any,
) -> Report:
    """A whole report as plain data: what report.json holds.

    Args:
        about, settings: what was measured with what; amounts and seeds.
        samples: motions to be looked at: what a bench's `write` says of each, rank and figures.
        pictures: `file` in the report's folder and `title` of each.
        found: more of it for programs; `notes` are lines under `about`.
    """
    return {
        "format-version": FORMAT_VERSION,
        "branch": branch,
        "title": title or f"Evaluation of {about.get('model', 'motions')}",
        "about": plain(about),
        "settings": plain(settings),
        "tables": [grid.as_dict() for grid in tables],
        "samples": plain(samples),
        "pictures": plain(pictures),
        **plain(found),
    }


# ---------------------------------------------------------------- as text


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


def interval(cell: Mapping[str, Any] | None, decimals: int) -> str:
    """`value ± half width`; no width where there is one observation."""
    if cell is None or cell["value"] is None or math.isnan(cell["value"]):
        return "–"
    half = (cell["high"] - cell["low"]) / 2
    text = number(cell["value"], decimals)
    return f"{text} ±{number(half, decimals)}" if half > 0 else text


def beside_null(ratio: Mapping[str, float], decimals: int) -> str:
    """`value [interval] (interval of the null)` of a ratio of `metrics.seams.compare`."""
    text = "{value:.{d}f} [{low:.{d}f}, {high:.{d}f}] ({null_low:.{d}f}–{null_high:.{d}f})"
    return text.format(**ratio, d=decimals)


def cell_text(cell: Cell, column: Column) -> str:
    """Any cell as words; an estimate that is `apart` has a star."""
    if cell is None or isinstance(cell, str):
        return cell or "–"
    if isinstance(cell, Mapping):
        return interval(cell, column.decimals) + (" *" if cell.get("apart") else "")
    assert isinstance(cell, (int, float))
    return number(cell, column.decimals)


def grids(report: Report) -> list[Grid]:
    """The tables of a report as data."""
    return [Grid.from_dict(table) for table in report["tables"]]


def tables(report: Report) -> Iterator[Table]:
    """Every table of a report as text, in reading order."""
    return map(printed, grids(report))


def printed(grid: Grid) -> Table:
    """A table as text; where rows differ in number, a column says how many motions and runs."""
    counted = any(row.num is not None for row in grid.rows.values())
    header = [grid.head, *(column.heading for column in grid.columns)]
    header += ["N × runs"] if counted else []
    rows = []
    for name, row in grid.rows.items():
        rows.append([name, *(cell_text(row.cells.get(c.key), c) for c in grid.columns)])
        if counted:
            both = (str(number) for number in (row.num, row.replications) if number is not None)
            rows[-1].append(" × ".join(both) if row.num is not None else "–")
    return Table(grid.title, header, rows, grid.note)


def heading(report: Report) -> list[str]:
    """What was measured with what, line by line."""
    facts = {**report["about"], **report["settings"]}
    listed = {k: ", ".join(map(str, v)) if isinstance(v, list) else v for k, v in facts.items()}
    lines = [f"{key.replace('_', '-')}: {value}" for key, value in listed.items()]
    return [*lines, *report.get("notes", ())]


def intervals_note(report: Report) -> str:
    """How the ± of a report came about, and with which seeds."""
    settings = report["settings"]
    if not any(table["plot"] for table in report["tables"]):
        return ""  # no table of a bench
    first, runs = settings["seed"], settings["replications"]
    seeds = f"seed {first}" if runs == 1 else f"seeds {first}, {first + 1000}, … ({runs} runs)"
    return str(described("intervals", seeds=seeds)["note"])


def markdown(report: Report) -> str:
    """The report as a Markdown text, with the motions that were kept, worst first."""
    lines = filter(None, [*heading(report), intervals_note(report)])
    text = [f"# {_inert(report['title'])}", "", *(f"- {_inert(line)}" for line in lines), ""]
    for table in tables(report):
        text += table_lines(table)
    samples = report.get("samples", [])
    if samples:
        rows = [[f"{s['rank']} of {s['of']}, {s['bench']}", s["title"], s["file"]] for s in samples]
        text += table_lines(Table("worst first", ["place", "asked for", "file"], rows))
    return "\n".join(text)


def table_lines(table: Table) -> list[str]:
    """A table in Markdown."""
    head, *body = (
        "| " + " | ".join(map(_inert, row)) + " |" for row in (table.header, *table.rows)
    )
    lines = [f"## {_inert(table.title)}", "", head, "|" + "---|" * len(table.header), *body, ""]
    return [*lines, table.note, ""] if table.note else lines


def _inert(text: str) -> str:
    """Text that is no HTML, link or border in Markdown, whatever prompt or file it quotes."""
    return re.sub(r"[\\<\[|]", r"\\\g<0>", text)
