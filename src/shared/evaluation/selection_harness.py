"""Best of N: does what the judge chose look better to those the judge does not listen to?

Every candidate is measured once; rows then differ only in which candidates they take. The best of
n is the judge's choice among n candidates that follow each other, so of 32 there are 32 choices of
one and four of eight. Each choice for all subjects (prompts or songs) is a replication: intervals
of rows say what other noise would give for the same subjects. What the largest size gains over
single candidates is resampled over subjects: it says what other subjects would give.

A figure is *outside* (nothing of it enters the judge), *akin* (another measure of something that
the judge does look at) or the judge's own. Only outside figures count for the verdict.

Letters: P subjects, C candidates of each, N the largest number to choose from, G choices.
"""

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import asdict, dataclass, field
from typing import Any, Literal

import numpy as np

from .report.tables import Table, interval
from .stats import Estimate, bootstrap_mean, replicated

Role = Literal["outside", "akin", "judge"]
ROLES: dict[Role, str] = {
    "outside": "figures outside the judge",
    "akin": "figures akin to the judge's",
    "judge": "the judge's own terms",
}
Chosen = np.ndarray  # [P], which candidate of each subject
NOTE = (
    "Rows: ± is 95% over replications, other noise for the same subjects (floors: over subjects)."
    " Difference: paired, ± is 95% by bootstrap over subjects. * better, and the intervals of both"
    " rows are apart. An untrained judge chooses at random: its row is best of 1."
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
    """Everything measured of P x C candidates.

    Attributes:
        figures: the columns.
        score: the judge's, [P,C].
        values: figures of single candidates [P,C]; NaN where nothing is asked.
        together: figures [P] of each subject that depend on what was chosen for the others.
        of_set: figures of a whole choice.
        floors: rows to stand beside, by name: figures [P'] by key.
        set_floors: figures of such rows that belong to whole sets.
    """

    figures: Sequence[Figure]
    score: np.ndarray
    values: Mapping[str, np.ndarray]
    together: Callable[[Chosen], Mapping[str, np.ndarray]] = lambda chosen: {}
    of_set: Callable[[Chosen], Mapping[str, float]] = lambda chosen: {}
    floors: Mapping[str, Mapping[str, np.ndarray]] = field(default_factory=dict)
    set_floors: Mapping[str, Mapping[str, float]] = field(default_factory=dict)

    def single(self, chosen: Chosen) -> dict[str, np.ndarray]:
        """Figures [P] of each subject under one choice."""
        rows = np.arange(len(self.score))
        found = {key: values[rows, chosen] for key, values in self.values.items()}
        return found | dict(self.together(chosen))


def sizes(largest: int) -> list[int]:
    """1, 2, 4, ... and the largest."""
    return [*(2**k for k in range((largest - 1).bit_length())), largest]


def choices(score: np.ndarray, size: int) -> list[Chosen]:
    """The highest of each run of `size` candidates of score [P,N]; what is left over is unused."""
    number = score.shape[1] // size
    runs = score[:, : number * size].reshape(len(score), number, size)
    return list((runs.argmax(2) + np.arange(number) * size).T)


def measured(
    pool: Pool, chosen: Sequence[Chosen]
) -> tuple[dict[str, np.ndarray], dict[str, Estimate]]:
    """Figures [P] of each subject, the mean over the choices, and of each choice as a whole."""
    found = [pool.single(choice) for choice in chosen]
    stacked = {key: np.stack([one[key] for one in found]) for key in found[0]}  # G P
    whole = {key: [_mean(row) for row in values] for key, values in stacked.items()}
    sets = [pool.of_set(choice) for choice in chosen]
    whole |= {key: [one[key] for one in sets] for key in sets[0]}
    subjects = {key: np.array([_mean(c) for c in values.T]) for key, values in stacked.items()}
    return subjects, {key: replicated(values) for key, values in whole.items()}


def _mean(values: np.ndarray) -> float:
    """Mean of what is known; NaN if nothing is."""
    known = values[~np.isnan(values)]
    return float(known.mean()) if len(known) else float("nan")


def selection_report(pool: Pool, largest: int) -> dict[str, Any]:
    """Rows of figures, and what the best of `largest` N gains over a single candidate.

    Returns:
        rows: name to figures, each an `Estimate` as a dict: floors, `best of n`, `worst of N`;
        gains: figure to its `role`, whether best of N is `better` than best of 1 and their
        intervals `apart` (never with one replication), and, but for whole sets, the paired
        `difference`;
        outside_apart: keys of outside figures that are better with intervals apart.
    """
    rows: dict[str, dict[str, Any]] = {}
    for name, floor in pool.floors.items():
        rows[name] = {key: bootstrap_mean(v.tolist()).as_dict() for key, v in floor.items()}
        for key, value in pool.set_floors.get(name, {}).items():
            rows[name][key] = Estimate(value, value, value, 1).as_dict()
    taken = {f"best of {size}": choices(pool.score, size) for size in sizes(largest)}
    taken[f"worst of {largest}"] = choices(-pool.score, largest)
    found = {name: measured(pool, chosen) for name, chosen in taken.items()}
    rows |= {
        name: {key: estimate.as_dict() for key, estimate in whole.items()}
        for name, (_, whole) in found.items()
    }
    (one, _), (many, _) = found["best of 1"], found[f"best of {largest}"]
    gains: dict[str, dict[str, Any]] = {}
    for figure in pool.figures:
        cells = rows["best of 1"][figure.key], rows[f"best of {largest}"][figure.key]
        gains[figure.key] = {"role": figure.role, **_compared(*cells, higher=figure.higher)}
        if figure.key in many:
            paired = (many[figure.key] - one[figure.key]).tolist()
            gain = bootstrap_mean(paired).as_dict()
            gains[figure.key]["difference"] = gain
            # Replications share their prompts: alone they say nothing of other prompts.
            gains[figure.key]["apart"] &= gain["low"] > 0 if figure.higher else gain["high"] < 0
    outside = [key for key, gain in gains.items() if gain["role"] == "outside" and gain["apart"]]
    return {"rows": rows, "gains": gains, "outside_apart": outside}


def _compared(one: dict[str, Any], many: dict[str, Any], *, higher: bool) -> dict[str, bool]:
    low, high = (one, many) if higher else (many, one)
    known = min(one["count"], many["count"]) > 2
    return {
        "better": bool(low["value"] < high["value"]),
        "apart": bool(known and low["high"] < high["low"]),
    }


def report_of(
    pool: Pool, largest: int, subjects: str, about: dict[str, Any], settings: dict[str, Any]
) -> dict[str, Any]:
    """`selection_report` with what it was measured on, as plain data for JSON.

    Args:
        subjects: words for the titles.
    """
    figures = [asdict(figure) for figure in pool.figures]
    facts = {"about": about, "settings": settings, "subjects": subjects, "figures": figures}
    return facts | selection_report(pool, largest)


def selection_tables(report: dict[str, Any]) -> Iterator[Table]:
    """One table a role: rows as in the report, and the gain below."""
    last = [name for name in report["rows"] if name.startswith("best of ")][-1]
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
        yield Table(f"{title} ({report['subjects']})", header, rows, NOTE)


def _gain(gain: dict[str, Any], figure: Figure) -> str:
    text = interval(gain.get("difference"), figure.decimals)
    return f"{text} *" if gain["apart"] else text
