"""The tables of a report as data: rows of cells under described columns, ready for JSON.

Markdown, HTML, plots and comparison read these and know nothing of the metrics behind them.
"""

import math
from collections.abc import Mapping, Sequence
from dataclasses import asdict, dataclass
from typing import Any

from .families import Column
from .intervals import Estimate

FORMAT_VERSION = 1
Cell = dict[str, Any] | float | str | None  # an `Estimate` as a dict, a number, or words


@dataclass(frozen=True)
class GridRow:
    """One row: its cells by column key, over how many motions, how often, with which seeds."""

    cells: Mapping[str, Cell]
    num: int | None = None
    replications: int | None = None


@dataclass(frozen=True)
class Grid:
    """One table.

    Attributes:
        name: unique in its report.
        rows: by name, in reading order.
        note: under the table, Markdown.
        head: over the names of the rows.
        plot: whether the columns are drawn in the HTML report.
    """

    name: str
    title: str
    columns: tuple[Column, ...]
    rows: Mapping[str, GridRow]
    note: str = ""
    head: str = "row"
    plot: bool = False

    def as_dict(self) -> dict[str, Any]:
        """Plain data for report.json; rows keep their order."""
        rows = [{"name": name, **plain(asdict(row))} for name, row in self.rows.items()]
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
        if isinstance(cell, dict):
            cell = cell["value"]
        return float(cell) if isinstance(cell, (int, float)) else math.nan


def plain(value: Any) -> Any:
    """JSON has no NaN: the same value with None in its place, and tuples as lists."""
    if isinstance(value, Estimate):
        return plain(value.as_dict())
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
    samples: Sequence[Mapping[str, Any]],
    pictures: Sequence[Mapping[str, Any]] = (),
    *,
    title: str = "",
) -> dict[str, Any]:
    """A whole report as plain data: what report.json holds.

    Args:
        branch: text or audio.
        about: what was measured with what.
        settings: amounts and seeds.
        samples: motions to be looked at, see `Keeper`.
        pictures: `file` in the report's folder and `title` of each.
        title: over the pages; the model's name.
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
    }
