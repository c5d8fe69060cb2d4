"""Rows against metrics: measures each row in each replication, and makes tables of it.

A bench is a set of rows (real, chance, untrained, generated, ...) under one reference. Every row
meets every family of metrics, so that no figure stands without its floor and its ceiling. A suite
is benches, tables with rows of their own, and what they were measured with.

Letters: N motions, R replications.
"""

from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from functools import partial
from pathlib import Path
from typing import Any, Generic, Protocol, Self, TypeVar

import numpy as np
from scipy.stats import rankdata

from ..errors import UserError
from . import manifest
from .manifest import Part, Parts, Sources
from .stats import Estimate, bootstrap_mean, replicated, share_of
from .tables import Column, Grid, GridRow, Report, described, plain, report_data

Progress = Callable[[str], None]
Value = float | np.ndarray
DIGITS = 9  # kept of a figure: what more there is differs between machines
SAMPLES = "samples"  # folder of the motions to be looked at


class AnySample(Protocol):
    """What the engine asks of a set of N motions; the families of a kind know more of theirs."""

    def __len__(self) -> int: ...
    @property
    def asked(self) -> list[str]: ...
    def rows(self, index: Sequence[int]) -> Self: ...


Sample = TypeVar("Sample", bound=AnySample)
Judged = TypeVar("Judged", bound=AnySample)
Figures = Callable[[Judged, Judged, int], Mapping[str, Value] | Sequence[Mapping[str, float]]]


@dataclass(frozen=True)
class MetricFamily(Generic[Judged]):
    """The plug-in point: figures that belong together and share a definition.

    To add one: describe it in tables.toml and name it among the families of a suite. Tables,
    intervals, comparison, the reports and their legend follow by themselves.
    """

    name: str  # of the family's table
    columns: tuple[Column, ...]  # what `figures` may return, in the order shown
    definition: str  # Markdown: what each figure is, its source, and what it cannot tell
    # Of a sample in one replication, given the reference (the real motions; `sample.source[i]` is
    # the row that motion i was asked to resemble, and what is fitted on them belongs in
    # `reference.memo`) and the seed of every random choice. By column key a float for the sample as
    # a whole (its interval comes from replications), or an array [N], NaN where the column does not
    # apply (its interval comes from a bootstrap over motions; comparisons pair them by prompt);
    # what cannot be computed is left out. Or a mapping a motion, by column key.
    figures: Figures[Judged]
    # they are distances from the reference: the real row is measured between two disjoint halves of
    # the real motions, since a sample is at 0 from itself
    distance: bool = False
    least: int = 0  # motions of sample and reference below which there are no figures

    @classmethod
    def of(cls, name: str, figures: Figures[Judged], *, warning: str = "", **rest: Any) -> Self:
        """The family whose columns and definition tables.toml holds; `warning` ends the latter."""
        words = described(name, warning=warning)
        return cls(name, words["columns"], words["note"], figures, **rest)

    def compute(self, sample: Judged, reference: Judged, *, seed: int) -> Mapping[str, Value]:
        """What `figures` finds, by column key."""
        if self.least and min(len(sample), len(reference)) < self.least:
            return {}
        found = self.figures(sample, reference, seed)
        if not isinstance(found, Sequence):
            return found
        keys = [column.key for column in self.columns]
        return {key: np.array([row.get(key, np.nan) for row in found]) for key in keys}


@dataclass(frozen=True)
class Row(Generic[Sample]):
    """A row of a bench."""

    name: str
    make: Callable[[int], Sample]  # the sample of a replication (0, 1, ...)
    # replications at most; None = as many as are asked for, 0 = no such row
    limit: int | None = None
    # the same motions in each replication: one-a-motion figures are kept of the first
    fixed: bool = False
    # it is the reference itself, so that distances are taken between halves of it
    real: bool = False


@dataclass(frozen=True)
class Bench(Generic[Sample]):
    """Rows that are held against one reference by the same families."""

    name: str
    title: str  # for the tables, with what was measured on
    reference: Callable[[], Sample]  # makes the real sample; asked only when a part is missing
    rows: Sequence[Row[Sample]]
    families: Sequence[MetricFamily[Sample]]
    main: str = "generated"  # name of the row whose worst motions are kept as files of the report
    # writes motion i of a sample to a path, and returns what else the report says of it: its title,
    # and files beside it; None = none is kept
    write: Callable[[Sample, int, Path], dict[str, Any]] | None = None
    worst: int = 0  # motions to keep
    summary: Callable[[list[Grid]], Grid] | None = None  # a table made of the bench's own
    optional: bool = False  # a UserError leaves a table that says why in place of the bench's


@dataclass(frozen=True)
class Suite:
    """One evaluation."""

    branch: str  # text, audio or performer; decides how the report plays motions
    settings: Mapping[str, Any]  # amounts and seeds, `replications` and `seed` among them
    benches: Sequence[Bench[Any]]  # rows against metrics
    # further tables by the name of their part, each made once
    tables: Mapping[str, Callable[[], list[Grid]]] = field(default_factory=dict)
    # what the report repeats of model and data
    about: Mapping[str, Any] = field(default_factory=dict)
    # more of it that takes long to find out, kept as a part of its own
    facts: Callable[[], dict[str, Any]] | None = None
    # draws into the report's folder; returns `file` and `title` of each
    pictures: Callable[[Path], list[dict[str, Any]]] | None = None
    # of the manifest; asked only where there is a folder
    sources: Callable[[], Sources] | None = None


def run_suite(suite: Suite, parts: Parts, progress: Progress = lambda text: None) -> Report:
    """The whole report as plain data; what `parts` holds is not measured again.
    Raises UserError: data that cannot be used, or the folder of `parts` holds another report."""
    if parts.folder is not None and suite.sources is not None:
        families = [family for bench in suite.benches[:1] for family in bench.families]
        metrics = {family.name: [column.key for column in family.columns] for family in families}
        sources = suite.sources()
        manifest.claim(parts.folder, manifest.build(suite.branch, sources, suite.settings, metrics))
    replications, seed = suite.settings["replications"], suite.settings["seed"]
    tables: list[Grid] = []
    samples: list[dict[str, Any]] = []
    for bench in suite.benches:
        try:
            grids = run_bench(bench, parts, replications, seed, progress)
        except UserError as error:
            if not bench.optional:
                raise
            rows, title = {bench.name: GridRow({"why": str(error)})}, f"{bench.name}: not measured"
            tables.append(Grid(bench.name, title, (Column("why", "why"),), rows))
            continue
        tables += [*grids, *([bench.summary(grids)] if bench.summary is not None else [])]
        samples += parts.once(part_name(bench.name, bench.main, 0), dict).get("samples", [])
    for name, make in suite.tables.items():
        part = parts.once(name, partial(_as_part, make))
        tables += [Grid.from_dict(grid) for grid in part["grids"]]
    drawn: list[dict[str, Any]] = []
    if suite.pictures is not None and parts.folder is not None:
        draw = partial(suite.pictures, parts.folder)
        drawn = parts.once("pictures", lambda: {"pictures": draw()})["pictures"]
    facts = {} if suite.facts is None else parts.once("facts", suite.facts)
    about = {**suite.about, **facts}
    return report_data(suite.branch, about, suite.settings, tables, samples, drawn)


def _as_part(make: Callable[[], list[Grid]]) -> Part:
    return {"grids": [grid.as_dict() for grid in make()]}


def part_name(bench: str, row: str, replication: int) -> str:
    """Under which a row's replication is kept."""
    return f"{bench}.{row}.{replication:03d}"


def run_bench(
    bench: Bench[Sample], parts: Parts, replications: int, seed: int, progress: Progress
) -> list[Grid]:
    """Measure what is missing, and make one table a family. The rows come replication by
    replication, so that whoever stops early has a whole report of fewer."""
    rows = [row for row in bench.rows if row.limit != 0]
    measured: dict[str, list[Part]] = {row.name: [] for row in rows}
    for replication in range(replications):
        for row in rows:
            if row.limit is not None and replication >= row.limit:
                continue
            name = part_name(bench.name, row.name, replication)
            if not parts.done(name):
                progress(f"{bench.name}: {row.name}, {replication + 1} of {replications}")
            compute = partial(_measure, bench, row, replication, seed, parts.folder)
            measured[row.name].append(parts.once(name, compute))
    return [family_grid(bench, family, measured) for family in bench.families]


def _measure(
    bench: Bench[Sample], row: Row[Sample], replication: int, seed: int, folder: Path | None
) -> Part:
    sample, reference = row.make(replication), bench.reference()
    draw = seed + replication
    figures: dict[str, float] = {}
    values: dict[str, np.ndarray] = {}
    for family in bench.families:
        own, other = sample, reference
        if row.real and family.distance:  # how far real motions are from real motions
            order = np.random.default_rng(draw).permutation(len(reference)).tolist()
            middle = len(order) // 2
            own, other = reference.rows(order[:middle]), reference.rows(order[middle:])
        found = family.compute(own, other, seed=draw)
        unknown = found.keys() - {column.key for column in family.columns}
        assert not unknown, f"{family.name} returns {unknown}, no column of it"
        for key, value in found.items():
            if isinstance(value, np.ndarray):
                values[key] = value
            else:
                figures[key] = float(value)
    part: Part = {"num": len(sample), "asked": manifest.hash_names(sample.asked)}
    part["figures"] = {key: _short(figure, DIGITS) for key, figure in figures.items()}
    if not (row.fixed and replication):
        part["values"] = {key: [_short(x, DIGITS) for x in each] for key, each in values.items()}
    if row.name == bench.main and not replication and bench.write is not None:
        part["samples"] = [] if folder is None else _keep_worst(bench, sample, values, folder)
    return part


def _short(value: float, digits: int) -> Any:
    """A figure rounded, for JSON."""
    return plain(float(f"{float(value):.{digits}g}"))


def _keep_worst(
    bench: Bench[Sample], sample: Sample, values: Mapping[str, np.ndarray], folder: Path
) -> list[dict[str, Any]]:
    """What the report says of each motion kept: file, figures, title, rank, of."""
    assert bench.write is not None
    order = worst_first(bench.families, values, len(sample))
    columns = [c.key for family in bench.families for c in family.columns if c.better != "real"]
    kept = []
    for rank, row in enumerate(order[: bench.worst], start=1):
        name = f"{SAMPLES}/{bench.name}-{rank:02d}.npz"
        told = bench.write(sample, row, folder / name)
        figures = {key: _short(values[key][row], 6) for key in columns if key in values}
        place = {"rank": rank, "of": len(order), "bench": bench.name}
        kept.append({"file": name, "figures": figures, **told, **place})
    return kept


def worst_first(
    families: Iterable[MetricFamily[Sample]], values: Mapping[str, np.ndarray], num: int
) -> list[int]:
    """Rows [N] from worst to best, by the mean over families of the mean rank among the columns
    that give one figure a motion and have a good side; a motion to which a column does not apply is
    in the middle of it."""
    totals = np.zeros(num)
    for family in families:
        good = [c for c in family.columns if c.key in values and c.better != "real"]
        if good:
            totals += np.mean([_badness(values[c.key], c.better == "high") for c in good], axis=0)
    return [int(row) for row in np.argsort(-totals, kind="stable")]


def _badness(values: np.ndarray, high_is_good: bool) -> np.ndarray:
    """Rank [N] in [0, 1], 1 = worst; equal values share their mean rank, NaN is 0.5."""
    result = np.full(len(values), 0.5)
    known = np.flatnonzero(~np.isnan(values))
    if len(known) > 1:
        signed = -values[known] if high_is_good else values[known]
        result[known] = (rankdata(signed) - 1) / (len(known) - 1)
    return result


def family_grid(
    bench: Bench[Sample], family: MetricFamily[Sample], measured: Mapping[str, list[Part]]
) -> Grid:
    """A family's table: figures of whole samples with intervals over replications, figures of
    single motions with intervals over motions. Columns that no row has are left out."""
    rows = {}
    for name, found in measured.items():
        cells = {column.key: estimate(found, column) for column in family.columns}
        known = {key: cell for key, cell in cells.items() if cell is not None}
        rows[name] = GridRow(known, found[0]["num"], len(found))
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
    if column.share and np.isin(values[~np.isnan(values)], (0.0, 1.0)).all():
        return share_of(values)  # a bootstrap has no width at 0 of N
    return bootstrap_mean(values)


def motion_values(parts: Sequence[Part], key: str) -> np.ndarray | None:
    """A column's figure for each motion [N], the mean over the replications that have it."""
    kept = [part["values"][key] for part in parts if key in part.get("values", {})]
    if not kept:
        return None
    table = np.ma.masked_invalid(np.array(kept, dtype=np.float64))  # None becomes NaN
    return np.asarray(table.mean(0).filled(np.nan))
