"""Small plots of a table as inline SVG: one a column, a dot and its interval a row.

Text only, so that equal tables give equal bytes.
"""

import math
from html import escape

from .families import Column
from .grids import Cell, Grid
from .report import number

WIDTH, LABEL, LINE, TOP, BOTTOM = 284, 92, 18, 22, 20
COLOURS = {
    "real": "#2f9150", "chance": "#8a92a0", "frozen pose": "#8a92a0", "untrained": "#c8692a",
    "generated": "#2f6fd0",
}  # fmt: skip
OTHER = "#7a4fbf"


def grid_plots(grid: Grid) -> str:
    """A plot for each column with numbers in two rows or more."""
    return "".join(column_plot(grid, column) for column in grid.columns)


def column_plot(grid: Grid, column: Column) -> str:
    """One column; empty where there is nothing to compare."""
    spans = {
        name: found
        for name, row in grid.rows.items()
        if (found := span(row.cells.get(column.key))) is not None
    }
    if len(spans) < 2:
        return ""
    low, high = _ends(spans)
    height = TOP + LINE * len(spans) + BOTTOM

    def at(value: float) -> str:
        return f"{LABEL + (WIDTH - LABEL - 10) * (value - low) / (high - low):.1f}"

    title = escape(column.heading)
    parts = [
        f'<svg class="plot" width="{WIDTH}" height="{height}" viewBox="0 0 {WIDTH} {height}"'
        f' role="img" aria-label="{title}"><text x="0" y="13" class="name">{title}</text>'
    ]
    for index, (name, (value, left, right)) in enumerate(spans.items()):
        y = TOP + LINE * index + LINE / 2
        colour = COLOURS.get(name, OTHER)
        parts.append(
            f'<text x="{LABEL - 8}" y="{y + 4:g}" text-anchor="end">{escape(name)}</text>'
            f'<line x1="{at(left)}" x2="{at(right)}" y1="{y:g}" y2="{y:g}" stroke="{colour}"'
            f' stroke-width="3" opacity=".45"/><circle cx="{at(value)}" cy="{y:g}" r="4"'
            f' fill="{colour}"/>'
        )
    foot = height - BOTTOM + 4
    for value, anchor in ((low, "start"), (high, "end")):
        text = number(value, column.decimals)
        parts.append(
            f'<text x="{at(value)}" y="{foot + 12}" text-anchor="{anchor}" class="tick">'
            f"{text}</text>"
        )
    line = f'<line x1="{at(low)}" x2="{at(high)}" y1="{foot}" y2="{foot}" stroke="#d9dde4"/>'
    return "".join([*parts, line, "</svg>"])


def span(cell: Cell) -> tuple[float, float, float] | None:
    """Value and interval of a cell; None where it holds no number."""
    if isinstance(cell, dict):
        value, low, high = cell.get("value"), cell.get("low"), cell.get("high")
        if value is None or low is None or high is None:
            return None
        return float(value), float(low), float(high)
    if isinstance(cell, (int, float)) and math.isfinite(cell):
        return float(cell), float(cell), float(cell)
    return None


def _ends(spans: dict[str, tuple[float, float, float]]) -> tuple[float, float]:
    """Ends of the axis: 0 is on it where that costs less than half of its length."""
    low, high = min(s[1] for s in spans.values()), max(s[2] for s in spans.values())
    if 0 < low < (high - low):
        low = 0.0
    return (low, high) if high > low else (low - 0.5, low + 0.5)
