"""The report of `evaluate-sanity` as tables."""

from collections.abc import Iterator
from typing import Any

from ..metrics.sanity import SEVEN
from .report.tables import Table, number

NOTES = {
    "sanity": "What the decoder gave, not clamped, not made coherent. seven: TECH's five checks and"
    " ruling 18's two; suite: with liveliness, roughness and bands. No chance row: no check asks"
    " which song a motion belongs to.",
    "inside": "Share of motions between the 5th and 95th percentile of training motions; real"
    " motion itself reaches about 0.9.",
}


def sanity_tables(report: dict[str, Any]) -> Iterator[Table]:
    """Every table of `evaluate-sanity`, in reading order."""
    rows = report["rows"]
    cells = [
        [name, str(row["motions"]), f"{row['passed_seven']}", f"{row['passed']}"]
        + [_count(row["checks"], key) for key in (*SEVEN, "liveliness", "roughness")]
        for name, row in rows.items()
    ]
    header = ["row", "N", "seven", "suite"]
    header += [key.replace("_", " ") for key in (*SEVEN, "liveliness", "roughness")]
    yield Table("motions that pass", header, cells, NOTES["sanity"])
    if report["bands"]:
        yield _inside(report)
    yield Table("verdict", ["what must hold", "value", "holds"], list(_verdict(report["verdict"])))


def _count(checks: dict[str, Any], key: str) -> str:
    return str(checks[key]["passed"]) if key in checks else "–"


def _inside(report: dict[str, Any]) -> Table:
    names = list(report["rows"]["generated"]["inside"])
    rows = [
        ["p5 to p95", *(_band(report["bands"][name]) for name in names)],
        *(
            [name, *(number(row["inside"].get(key), 2) for key in names)]
            for name, row in report["rows"].items()
        ),
    ]
    header = ["row", *(name.replace("_", " ") for name in names)]
    return Table("motions inside the training motions' band", header, rows, NOTES["inside"])


def _band(band: dict[str, float]) -> str:
    return f"{band['low']:.3g} – {band['high']:.3g}"


def _verdict(found: dict[str, Any]) -> Iterator[list[str]]:
    seven = found["seven_checks"]
    value = f"{seven['value']:.2f} [{seven['low']:.2f}, {seven['high']:.2f}]"
    yield ["all seven checks, share of generated (≥ 0.95)", value, _holds(seven["holds"])]
    for name in ("frozen", "untrained"):
        yield [f"{name} fails", "", _holds(found[f"{name}_fails"])]
    for name, inside in found["inside"].items():
        value = f"{number(inside['mean'], 3)}; {inside['share']:.2f} of motions inside"
        yield [
            f"{name.replace('_', ' ')}: mean of generated inside p5–p95",
            value,
            _holds(inside["holds"]),
        ]


def _holds(value: bool) -> str:
    return "yes" if value else "NO"
