"""Two reports against each other, figure by figure, paired by prompt or by replication.

Letters: N motions, R replications.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from ..errors import UserError
from . import manifest
from .engine import motion_values, part_name
from .manifest import Part, Parts, read_json
from .stats import FEW, MIN_PAIRS, Difference, paired_bootstrap
from .tables import Cell, Column, Grid, GridRow, grids, report_data

FREE = ("model", "sampling", "statistics", "environment")  # what a comparison may be about


@dataclass(frozen=True)
class Side:
    """A report's folder, and the row to look at."""

    folder: Path
    row: str = "generated"

    def parts(self, bench: str) -> list[Part]:
        """The row's replications, as many as there are without a gap."""
        kept = Parts(self.folder)
        found: list[Part] = []
        while kept.done(name := part_name(bench, self.row, len(found))):
            found.append(kept.once(name, dict))
        return found


def compare(a: Side, b: Side, *, seed: int = 0) -> dict[str, Any]:
    """Every figure that both have, as a report: one table a family.
    Raises UserError: a folder holds no report, the reports measured different things (data, judge,
    settings, metrics), a row is missing, or the rows were asked different things."""
    first, second = read_json(a.folder / manifest.MANIFEST), read_json(b.folder / manifest.MANIFEST)
    found = manifest.differences(first, second)
    differs = [name for name in found if name.split(".")[0] not in FREE]
    if differs:
        raise UserError(
            f"{a.folder} and {b.folder} differ in {', '.join(differs)}: such figures never stand"
            " beside each other; evaluate both with the same data, judge and settings"
        )
    ours, theirs = (read_json(side.folder / "report.json") for side in (a, b))
    found_tables = (_difference(grid, a, b, seed) for grid in grids(ours) if grid.plot)
    tables = [table for table in found_tables if table is not None]
    if not tables:
        raise UserError(
            f"{a.folder} has no row {a.row!r}, or {b.folder} has no row {b.row!r}"
            "; evaluate both with it"
        )
    about = {
        "a": f"{a.folder}, row {a.row}, model {ours['about'].get('model')}",
        "b": f"{b.folder}, row {b.row}, model {theirs['about'].get('model')}",
        "model_hash_a": ours["about"].get("model_hash"),
        "model_hash_b": theirs["about"].get("model_hash"),
        "different": ", ".join(found) or "nothing",
    }
    return report_data(first["branch"], about, {}, tables, [], title="Comparison of two reports")


def _difference(grid: Grid, a: Side, b: Side, seed: int) -> Grid | None:
    """A family's table of one bench: a row a column of it."""
    bench = grid.name.split("/")[0]
    left, right = a.parts(bench), b.parts(bench)
    if not left or not right:
        return None
    if left[0]["asked"] != right[0]["asked"]:
        raise UserError(
            f"{bench}: rows {a.row!r} and {b.row!r} were asked for different things, so that"
            " nothing pairs them; compare rows of the same prompts"
        )
    rows = {}
    for column in grid.columns:
        pair = _pairs(left, right, column.key)
        if pair is None:
            continue
        found = paired_bootstrap(*pair, seed=seed)
        cells: dict[str, Cell] = {
            "a": float(np.nanmean(pair[0])),
            "b": float(np.nanmean(pair[1])),
            "difference": {k: v for k, v in found.as_dict().items() if k != "p"},
            "p": found.p,
            "better": verdict(column, found),
            "pairs": found.count,
        }
        rows[column.heading] = GridRow(cells)
    words = {"name": grid.name, "title": grid.title}
    return Grid.of("comparison", rows, {"FEW": FEW}, **words) if rows else None


def _pairs(a: Sequence[Part], b: Sequence[Part], key: str) -> tuple[np.ndarray, np.ndarray] | None:
    """A column of both sides, entry by entry: motions, else replications; None = too few."""
    num = min(len(a), len(b))
    left, right = (motion_values(side[:num], key) for side in (a, b))
    if left is None or right is None:
        left, right = (np.array([p["figures"].get(key) for p in s[:num]], float) for s in (a, b))
    known = ~np.isnan(left - right)
    return (left, right) if known.sum() >= MIN_PAIRS else None


def verdict(column: Column, found: Difference) -> str:
    """Which side is better, as far as the interval tells."""
    if found.count < FEW:
        return "too few"
    if found.low <= 0 <= found.high:
        return "–"
    if column.better == "real":
        return "differ"
    return "b" if (found.low > 0) == (column.better == "high") else "a"
