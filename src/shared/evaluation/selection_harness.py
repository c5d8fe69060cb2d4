"""Best of N: does what the judge chose look better to those the judge does not listen to?

Every candidate is measured once; rows then differ only in which candidates they take. The best of
n is the judge's choice among n candidates that follow each other: of 8 there are eight choices of
one, four of two, two of four and one of eight, and a subject's figure is the mean over them.
Intervals resample subjects (prompts or songs): they cover other subjects, not only other noise.

A figure is *outside* (nothing of it enters the judge), *akin* (another measure of something that
the judge does look at) or the judge's own. Only outside figures count for the verdict.

Letters: P subjects, N candidates of each, G choices of one size.
"""

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import asdict, dataclass, field
from typing import Any, Literal

import numpy as np

from src.shared.evaluation.intervals import Estimate, bootstrap_mean
from src.shared.evaluation.report import Table, interval

Role = Literal["outside", "akin", "judge"]
ROLES: dict[Role, str] = {
    "outside": "figures outside the judge",
    "akin": "figures akin to the judge's",
    "judge": "the judge's own terms",
}
Chosen = np.ndarray  # [P], which candidate of each subject
RESAMPLES = 500  # of figures of a whole set
NOTE = (
    "± is 95% by bootstrap over subjects. Rows share their candidates; the difference is paired."
    " * the intervals of best of {size} and of best of 1 do not overlap, and it is better."
)


@dataclass(frozen=True)
class Figure:
    """One column; `higher`: more is better."""

    key: str
    heading: str
    decimals: int
    higher: bool
    role: Role


@dataclass(frozen=True, eq=False)
class Pool:
    """Everything measured of P x N candidates.

    Attributes:
        figures: the columns.
        score: the judge's, [P,N].
        values: figures of single candidates [P,N]; NaN where nothing is asked.
        together: figures [P] of each subject that depend on what was chosen for the others.
        of_set: figures of a whole choice; told subjects and their candidates, both [R].
        floors: rows to stand beside, by name: figures [P'] by key.
        set_floors: figures of such rows that belong to whole sets.
    """

    figures: Sequence[Figure]
    score: np.ndarray
    values: Mapping[str, np.ndarray]
    together: Callable[[Chosen], Mapping[str, np.ndarray]] = lambda chosen: {}
    of_set: Callable[[np.ndarray, np.ndarray], Mapping[str, float]] = lambda rows, chosen: {}
    floors: Mapping[str, Mapping[str, np.ndarray]] = field(default_factory=dict)
    set_floors: Mapping[str, Mapping[str, float]] = field(default_factory=dict)

    @property
    def num_candidates(self) -> int:
        """N."""
        return int(self.score.shape[1])

    @property
    def sizes(self) -> list[int]:
        """1, 2, 4, ... up to N."""
        return [2**k for k in range(self.num_candidates.bit_length())]


def choices(score: np.ndarray, size: int) -> list[Chosen]:
    """The highest of each run of `size` candidates of score [P,N]; what is left over is unused."""
    number = score.shape[1] // size
    runs = score[:, : number * size].reshape(len(score), number, size)
    return list((runs.argmax(2) + np.arange(number) * size).T)


def measured(pool: Pool, chosen: Sequence[Chosen]) -> dict[str, np.ndarray]:
    """Figures [P] of each subject, the mean over the choices where there is anything to average."""
    rows = np.arange(len(pool.score))
    found: dict[str, list[np.ndarray]] = {}
    for choice in chosen:
        single = {key: values[rows, choice] for key, values in pool.values.items()}
        for key, values in (single | dict(pool.together(choice))).items():
            found.setdefault(key, []).append(values)
    return {key: _mean(np.stack(values)) for key, values in found.items()}


def _mean(values: np.ndarray) -> np.ndarray:
    """Mean [P] over the first axis of values [G,P], NaN left out."""
    known = ~np.isnan(values)
    total = np.where(known, values, 0.0).sum(0)
    return np.divide(total, known.sum(0), out=np.full(len(total), np.nan), where=known.any(0))


def _set_estimates(pool: Pool, chosen: Sequence[Chosen], seed: int) -> dict[str, Estimate]:
    """Figures of whole sets with percentile intervals over resampled subjects."""
    subjects = np.arange(len(pool.score))
    draws = np.random.default_rng(seed).integers(0, len(subjects), (RESAMPLES, len(subjects)))

    def over_choices(rows: np.ndarray) -> dict[str, float]:
        found = [pool.of_set(rows, choice[rows]) for choice in chosen]
        return {key: float(np.mean([one[key] for one in found])) for key in found[0]}

    whole = over_choices(subjects)
    if not whole:
        return {}
    again = [over_choices(rows) for rows in draws]
    bounds = {key: np.percentile([one[key] for one in again], (2.5, 97.5)) for key in whole}
    return {
        key: Estimate(value, float(bounds[key][0]), float(bounds[key][1]), len(subjects))
        for key, value in whole.items()
    }


def selection_report(pool: Pool, seed: int = 0) -> dict[str, Any]:
    """Rows of figures, and what the largest choice gains over a single candidate.

    Returns:
        rows: name to figures, each an `Estimate` as a dict: floors, `best of n`, `worst of N`;
        gains: figure to the paired difference of best of N and best of 1 (single candidates and
        subjects only), whether it is `better`, and whether the intervals are `apart`;
        outside_apart: keys of outside figures that are better with intervals apart.
    """
    rows: dict[str, dict[str, Any]] = {}
    for name, floor in pool.floors.items():
        rows[name] = {key: _over_subjects(values) for key, values in floor.items()}
        for key, value in pool.set_floors.get(name, {}).items():
            rows[name][key] = Estimate(value, value, value, 1).as_dict()
    taken = {f"best of {size}": choices(pool.score, size) for size in pool.sizes}
    taken[f"worst of {pool.num_candidates}"] = [pool.score.argmin(1)]
    subjects = {name: measured(pool, chosen) for name, chosen in taken.items()}
    for name, chosen in taken.items():
        rows[name] = {key: _over_subjects(v) for key, v in subjects[name].items()}
        rows[name] |= {k: e.as_dict() for k, e in _set_estimates(pool, chosen, seed).items()}
    last = f"best of {pool.sizes[-1]}"
    gains: dict[str, dict[str, Any]] = {}
    for figure in pool.figures:
        one, many = rows["best of 1"][figure.key], rows[last][figure.key]
        gain: dict[str, Any] = {"role": figure.role, **_apart(one, many, higher=figure.higher)}
        if figure.key in subjects[last]:
            paired = subjects[last][figure.key] - subjects["best of 1"][figure.key]
            gain["difference"] = _over_subjects(paired)
        gains[figure.key] = gain
    outside = [key for key, gain in gains.items() if gain["role"] == "outside" and gain["apart"]]
    return {"rows": rows, "gains": gains, "outside_apart": outside}


def _over_subjects(values: np.ndarray) -> dict[str, float | int]:
    return bootstrap_mean(values.tolist()).as_dict()


def _apart(one: dict[str, Any], many: dict[str, Any], *, higher: bool) -> dict[str, bool]:
    if higher:
        return {"better": many["value"] > one["value"], "apart": many["low"] > one["high"]}
    return {"better": many["value"] < one["value"], "apart": many["high"] < one["low"]}


def report_of(
    pool: Pool, subjects: str, about: dict[str, Any], settings: dict[str, Any], seed: int
) -> dict[str, Any]:
    """`selection_report` with what it was measured on, as plain data for JSON.

    Args:
        subjects: words for the titles.
    """
    figures = [asdict(figure) for figure in pool.figures]
    facts = {"about": about, "settings": settings, "subjects": subjects, "figures": figures}
    return facts | selection_report(pool, seed)


def selection_tables(report: dict[str, Any]) -> Iterator[Table]:
    """One table a role: rows as in the report, and the gain below."""
    last = [name for name in report["rows"] if name.startswith("best of ")][-1]
    note = NOTE.format(size=last.rpartition(" ")[2])
    figures = [Figure(**figure) for figure in report["figures"]]
    for role, title in ROLES.items():
        shown = [figure for figure in figures if figure.role == role]
        if not shown:
            continue
        rows = [
            [name, *(interval(cells.get(figure.key), figure.decimals) for figure in shown)]
            for name, cells in report["rows"].items()
        ]
        gains = [(report["gains"][figure.key], figure) for figure in shown]
        rows.append([f"{last} less best of 1", *(_gain(gain, figure) for gain, figure in gains)])
        header = ["row", *(f"{f.heading} {'↑' if f.higher else '↓'}" for f in shown)]
        yield Table(f"{title} ({report['subjects']})", header, rows, note)


def _gain(gain: dict[str, Any], figure: Figure) -> str:
    text = interval(gain.get("difference"), figure.decimals)
    return f"{text} *" if gain["apart"] else text
