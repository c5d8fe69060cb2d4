"""Rows against families: measures each row in each replication, and makes tables of it.

A bench is a set of rows (real, chance, untrained, generated, ...) under one reference. Every row
meets every family of metrics, so that no figure stands without its floor and its ceiling.

Letters: N motions, R replications.
"""

from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass
from functools import partial
from typing import Any, Generic, TypeVar

import numpy as np

from .families import Column, MetricFamily, Sample, Value
from .grids import Grid, GridRow, plain
from .intervals import Estimate, bootstrap_mean, replicated, success_rate
from .manifest import hash_names
from .parts import Part, Parts

Progress = Callable[[str], None]
Context = TypeVar("Context")
DIGITS = 9  # kept of a figure: what more there is differs between machines


@dataclass(frozen=True)
class Row(Generic[Sample]):
    """A row of a bench.

    Attributes:
        make: the sample of a replication (0, 1, ...).
        limit: replications at most; None = as many as are asked for.
        fixed: the same motions in each replication: one-a-motion figures are kept of the first.
        real: it is the reference itself, so that distances are taken between halves of it.
    """

    name: str
    make: Callable[[int], Sample]
    limit: int | None = None
    fixed: bool = False
    real: bool = False


@dataclass(frozen=True)
class RowKind(Generic[Context, Sample]):
    """A row before it is known what it is measured on, as `registry.py` names it.

    Attributes:
        make: the sample of a replication, from a context.
        limit: replications at most, by the context; None = as many as are asked for.
        when: whether a context has this row at all.
        fixed, real: see `Row`.
    """

    name: str
    make: Callable[[Context, int], Sample]
    limit: Callable[[Context], int | None] = lambda context: None
    when: Callable[[Context], bool] = lambda context: True
    fixed: bool = False
    real: bool = False

    def bind(self, context: Context) -> Row[Sample]:
        """The row of one context."""
        make = partial(self.make, context)
        return Row(self.name, make, self.limit(context), self.fixed, self.real)


@dataclass(frozen=True)
class Bench(Generic[Sample]):
    """Rows that are held against one reference by the same families.

    Attributes:
        title: for the tables, with what was measured on.
        reference: makes the real sample; asked only when a part is missing.
        keep: told the main row's first sample, its rows from worst to best and its one-a-motion
            figures; returns what the report says of the motions it kept.
        main: name of the row that `keep` is about.
    """

    name: str
    title: str
    reference: Callable[[], Sample]
    rows: Sequence[Row[Sample]]
    families: Sequence[MetricFamily[Sample]]
    main: str = "generated"
    keep: Callable[[Sample, list[int], dict[str, np.ndarray]], list[dict[str, Any]]] | None = None


# ---------------------------------------------------------------- measuring


def part_name(bench: str, row: str, replication: int) -> str:
    """Under which a row's replication is kept."""
    return f"{bench}.{row}.{replication:03d}"


def run_bench(
    bench: Bench[Sample], parts: Parts, replications: int, seed: int, progress: Progress
) -> list[Grid]:
    """Measure what is missing, and make one table a family.

    The rows come replication by replication, so that whoever stops early has a whole report of
    fewer replications.
    """
    measured: dict[str, list[Part]] = {row.name: [] for row in bench.rows}
    for replication in range(replications):
        for row in bench.rows:
            if row.limit is not None and replication >= row.limit:
                continue
            name = part_name(bench.name, row.name, replication)
            if not parts.done(name):
                progress(f"{bench.name}: {row.name}, {replication + 1} of {replications}")
            compute = partial(_measure, bench, row, replication, seed)
            measured[row.name].append(parts.once(name, compute))
    return [family_grid(bench, family, measured) for family in bench.families]


def _measure(bench: Bench[Sample], row: Row[Sample], replication: int, seed: int) -> Part:
    sample, reference = row.make(replication), bench.reference()
    draw = seed + replication
    figures: dict[str, float] = {}
    values: dict[str, np.ndarray] = {}
    for family in bench.families:
        own, other = (
            halves(reference, draw) if row.real and family.distance else (sample, reference)
        )
        for key, value in _computed(family, own, other, draw).items():
            if isinstance(value, np.ndarray):
                values[key] = value
            else:
                figures[key] = float(value)
    part: Part = {"num": len(sample), "asked": hash_names(sample.asked)}
    part["figures"] = _short(figures)
    if not (row.fixed and replication):
        part["values"] = {key: _short(list(map(float, each))) for key, each in values.items()}
    if row.name == bench.main and not replication and bench.keep is not None:
        order = worst_first(bench.families, values, len(sample))
        part["samples"] = bench.keep(sample, order, values)
    return part


def _computed(
    family: MetricFamily[Sample], sample: Sample, reference: Sample, seed: int
) -> dict[str, Value]:
    known = {column.key for column in family.columns}
    found = dict(family.compute(sample, reference, seed=seed))
    assert found.keys() <= known, f"{family.name} returns {found.keys() - known}, no column of it"
    return found


def halves(sample: Sample, seed: int) -> tuple[Sample, Sample]:
    """Two disjoint random halves: how far real motions are from real motions."""
    order = np.random.default_rng(seed).permutation(len(sample)).tolist()
    middle = len(order) // 2
    return sample.rows(order[:middle]), sample.rows(order[middle:])


def _short(value: Any) -> Any:
    """Figures rounded to `DIGITS`, for JSON."""
    if isinstance(value, float):
        return plain(float(f"{value:.{DIGITS}g}"))
    if isinstance(value, list):
        return [_short(item) for item in value]
    return {key: _short(item) for key, item in value.items()}


def worst_first(
    families: Iterable[MetricFamily[Sample]], values: dict[str, np.ndarray], num: int
) -> list[int]:
    """Rows [N] from worst to best.

    By the mean over families of the mean rank among the columns that give one figure a motion and
    have a good side; a motion to which a column does not apply is in the middle of it.
    """
    totals = np.zeros(num)
    for family in families:
        ranks = [
            _badness(values[column.key], column.better == "high")
            for column in family.columns
            if column.key in values and column.better != "real"
        ]
        if ranks:
            totals += np.mean(ranks, axis=0)
    return np.argsort(-totals, kind="stable").tolist()


def _badness(values: np.ndarray, high_is_good: bool) -> np.ndarray:
    """Rank [N] in [0, 1], 1 = worst; equal values share their mean rank, NaN is 0.5."""
    result = np.full(len(values), 0.5)
    known = np.flatnonzero(~np.isnan(values))
    if len(known) > 1:
        signed = -values[known] if high_is_good else values[known]
        below = (signed[None] < signed[:, None]).sum(1)
        equal = (signed[None] == signed[:, None]).sum(1)
        result[known] = (below + (equal - 1) / 2) / (len(known) - 1)
    return result


# ---------------------------------------------------------------- tables


def family_grid(
    bench: Bench[Sample], family: MetricFamily[Sample], measured: dict[str, list[Part]]
) -> Grid:
    """A family's table: figures of whole samples with intervals over replications, figures of
    single motions with intervals over motions. Columns that no row has are left out."""
    rows = {}
    for name, found in measured.items():
        cells = {column.key: estimate(found, column) for column in family.columns}
        rows[name] = GridRow(
            {key: plain(cell) for key, cell in cells.items() if cell is not None},
            found[0]["num"],
            len(found),
        )
    columns = tuple(c for c in family.columns if any(c.key in row.cells for row in rows.values()))
    title = f"{bench.title}: {family.name}"
    return Grid(f"{bench.name}/{family.name}", title, columns, rows, family.definition, plot=True)


def estimate(parts: Sequence[Part], column: Column) -> Estimate | None:
    """One cell from a row's replications."""
    key = column.key
    figures = [part["figures"][key] for part in parts if part["figures"].get(key) is not None]
    if figures:
        return replicated(figures)
    values = motion_values(parts, key)
    if values is None:
        return None
    known = values[~np.isnan(values)]
    if column.share and np.isin(known, (0.0, 1.0)).all():  # a bootstrap has no width at 0 of N
        return success_rate(int(known.sum()), len(known))
    return bootstrap_mean(known)


def motion_values(parts: Sequence[Part], key: str) -> np.ndarray | None:
    """A column's figure for each motion [N], the mean over the replications that have it."""
    kept = [part["values"][key] for part in parts if key in part.get("values", {})]
    if not kept:
        return None
    table = np.array(kept, dtype=np.float64)  # None becomes NaN
    known = (~np.isnan(table)).sum(0)
    total = np.nansum(table, axis=0)
    return np.where(known > 0, total / np.maximum(known, 1), np.nan)
