"""The report of `evaluate --quick` as tables: one list of rows, printed or written as Markdown."""

import math
from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from rich.console import Console

# Column heading, key, decimals, whether the interval is shown.
LEARNED = (
    ("R@1", "r_at_1", 3), ("R@2", "r_at_2", 3), ("R@3", "r_at_3", 3),
    ("MM-Dist", "matching_distance", 3), ("FD", "frechet", 3), ("joint FD", "frechet_joint", 3),
    ("FD by tag", "frechet_by_tag", 3), ("by wrong tag", "frechet_by_wrong_tag", 3),
    ("Diversity", "diversity", 3),
)  # fmt: skip
PHYSICAL = (
    ("slide, contact cm/s", "contact_slide", 2), ("slide, support cm/s", "support_slide", 2),
    ("sunk cm", "penetration", 2), ("jerk m/s³", "jerk", 0), ("hand jerk", "hand_jerk", 0),
    ("speed m/s", "speed", 2), ("speed error", "speed_error", 2),
    ("direction error °", "direction_error", 0), ("turn error °", "turn_error", 0),
)  # fmt: skip
OBEYS = tuple(
    (kind, f"obeys_{kind}", 2)
    for kind in ("direction", "turn", "hand", "action", "speed", "count", "angle", "all")
)
NOTES = {
    "learned": "R@k: batches of 32, a motion of the same label group or caption is a hit. joint FD:"
    " Fréchet distance of (text, motion) pairs; its chance row is the distance under shuffled"
    " labels. FD of motions alone cannot see labels: 0 for chance by making. The real row's FDs are"
    " between two halves of the real clips (half the N). ± is 95% over replications.",
    "physical": "Errors are against a real clip of the same caption; the real row compares real"
    " clips of one label group. contact: frames the contact detector accepts; support: the lower"
    " foot of every grounded frame. ± is 95% over clips.",
    "obeyed": "Share of motions that do what the labels of their caption say, by forward"
    " kinematics; speed and count are exact classes, so real motion does not reach 1 either.",
    "control": "Success by forward kinematics. real: test clips with these labels; chance: motions"
    " made for the other tasks; still: the first pose held.",
}


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
    if cell is None or math.isnan(cell["value"]):
        return "–"
    half = (cell["high"] - cell["low"]) / 2
    text = number(cell["value"], decimals)
    return f"{text} ±{number(half, decimals)}" if half > 0 else text


def percent(cell: dict[str, Any] | None) -> str:
    """A success rate as whole percent."""
    return "–" if cell is None or math.isnan(cell["value"]) else f"{100 * cell['value']:.0f}%"


def tables(report: dict[str, Any]) -> Iterator[Table]:
    """Every table of a report, in reading order."""
    for name, split in report["splits"].items():
        if "missing" in split:
            yield Table(f"{name}: not measured", ["why"], [[split["missing"]]])
            continue
        size = (
            f"{split['num_real']} real clips of {split['num_groups']} label groups,"
            f" {split['num_generated']} generated"
        )
        for part, columns in (("learned", LEARNED), ("physical", PHYSICAL), ("obeyed", OBEYS)):
            rows = [
                [row, *(interval(cells.get(key), digits) for _, key, digits in columns)]
                for row, cells in split["rows"].items()
            ]
            header = ["row", *(heading for heading, _, _ in columns)]
            yield Table(f"{name} label combinations, {part} ({size})", header, rows, NOTES[part])
        yield _score_table(name, split["scores"])
    if report["languages"]:
        yield _language_table(report["languages"])
    if report["controllability"]:
        yield _control_table(report["controllability"])


def _score_table(name: str, scores: dict[str, dict[str, float]]) -> Table:
    keys = list(next(iter(scores.values())))
    rows = [[key, *(number(values[key], 3) for values in scores.values())] for key in keys]
    return Table(f"{name}: against real and chance", ["score", *scores], rows)


def _language_table(languages: dict[str, dict[str, float]]) -> Table:
    keys = list(next(iter(languages.values())))
    rows = [[name, *(number(row[key], 3) for key in keys)] for name, row in languages.items()]
    return Table("R@3 by language (seen combinations)", ["language", *keys], rows)


def _control_table(control: dict[str, Any]) -> Table:
    languages = control["languages"]
    kinds = [(language, wording) for language in languages for wording in control["wordings"]]
    rows = [
        [
            name,
            *(percent(task["generated"].get(language, {}).get(word)) for language, word in kinds),
            *(percent(task[floor]) for floor in ("real", "chance", "still")),
        ]
        for name, task in control["tasks"].items()
    ]
    rows.append(
        [
            "mean",
            *(percent(control["means"].get(language, {}).get(word)) for language, word in kinds),
            *(percent(control["means"][floor]) for floor in ("real", "chance", "still")),
        ]
    )
    short = {"templates": "tmpl", "paraphrases": "para"}
    header = ["task", *(f"{language} {short[word]}" for language, word in kinds)]
    title = f"controllability ({control['num_seeds']} seeds a cell)"
    return Table(title, [*header, "real", "chance", "still"], rows, NOTES["control"])


def heading(report: dict[str, Any]) -> list[str]:
    """What was measured with what, line by line."""
    facts = {**report["about"], **report["settings"], "seconds": report["seconds"]}
    return [f"{key.replace('_', '-')}: {value}" for key, value in facts.items()]


def markdown(report: dict[str, Any]) -> str:
    """The report as a Markdown text."""
    return as_markdown("Evaluation (quick)", heading(report), tables(report))


def as_markdown(title: str, lines: Iterable[str], parts: Iterable[Table]) -> str:
    """Any report as a Markdown text: a title, facts line by line, tables."""
    text = [f"# {title}", "", *(f"- {line}" for line in lines), ""]
    for table in parts:
        text += [f"## {table.title}", "", "| " + " | ".join(table.header) + " |"]
        text.append("|" + "---|" * len(table.header))
        text += ["| " + " | ".join(row) + " |" for row in table.rows]
        text += ["", table.note, ""] if table.note else [""]
    return "\n".join(text)


def print_report(report: dict[str, Any], console: "Console") -> None:
    """The report as tables on a terminal."""
    draw(heading(report), tables(report), console)


def draw(lines: Iterable[str], parts: Iterable[Table], console: "Console") -> None:
    """Any report on a terminal: facts line by line, tables."""
    from rich.table import Table as RichTable

    for line in lines:
        console.print(line, highlight=False)
    for table in parts:
        drawn = RichTable(title=table.title, caption=table.note, title_justify="left")
        for index, name in enumerate(table.header):
            drawn.add_column(name, justify="right" if index else "left")
        for row in table.rows:
            drawn.add_row(*row)
        console.print(drawn)
