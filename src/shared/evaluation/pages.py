"""The pages of a report folder: report.md, and report.html with plots and motions to be played;
and two reports against each other, figure by figure, paired by prompt or by replication.

The page opens offline and loads nothing. Every text of the report is escaped: a prompt cannot act
as markup.
"""

import base64
import math
import re
import tempfile
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import asdict, dataclass, replace
from html import escape
from pathlib import Path
from string import Template
from typing import Any

import numpy as np

from ..errors import UserError
from ..formats.arrays import read_npz, read_trajectory_npz
from ..formats.preview.html import write_html, write_trajectory_html
from ..formats.preview.trajectory import SongTrack
from ..io.files import inside, write_json, write_text
from . import manifest
from .engine import motion_values, part_name
from .manifest import Part, Parts, read_json
from .stats import FEW, MIN_PAIRS, Difference, paired_bootstrap
from .tables import (
    Cell,
    Column,
    Grid,
    GridRow,
    grids,
    heading,
    intervals_note,
    markdown,
    number,
    printed,
    report_data,
)

REPORT = "report.json"
PAGE, STYLE = (Path(__file__).with_name(f"pages.{ending}") for ending in ("html", "css"))
WIDTH, LABEL, LINE, TOP, BOTTOM = 284, 92, 18, 22, 20
COLOURS = {
    "real": "#2f9150", "chance": "#8a92a0", "frozen pose": "#8a92a0", "untrained": "#c8692a",
    "generated": "#2f6fd0",
}  # fmt: skip
OTHER_COLOUR = "#7a4fbf"


def save_report(report: dict[str, Any], folder: Path) -> None:
    """Write all three. Raises UserError: the folder cannot be written."""
    write_json(folder / REPORT, report)
    render(folder)


def render(folder: Path) -> dict[str, Any]:
    """Make report.md and report.html again; returns the report.
    Raises UserError: report.json, a sample or a picture is missing or damaged."""
    report = read_json(folder / REPORT)
    try:
        page = html_page(report, folder)
        text = markdown(report)
    except (KeyError, TypeError, AttributeError) as error:
        raise UserError(
            f"{folder / REPORT} is no report of this version ({error!r}); run `evaluate` again"
        ) from error
    except OSError as error:
        raise UserError(f"{error.filename}: {error.strerror}; run `evaluate` again") from error
    write_text(folder / "report.md", text)
    write_text(folder / "report.html", page)
    return report


def html_page(report: dict[str, Any], folder: Path) -> str:
    """The whole page of a report whose samples and pictures lie in `folder`.
    Raises UserError: a sample is missing or damaged."""
    tables = grids(report)
    facts = [fact.split(": ", 1) for fact in heading(report)]
    items = "".join(f"<li><b>{escape(name)}</b> {escape(value)}</li>" for name, value in facts)
    about = f'<ul class="facts">{items}</ul><p class="note">{escape(intervals_note(report))}</p>'
    sections = [f'<section id="about">{about}</section>', *_worst(report, folder)]
    sections += [_table(index, grid) for index, grid in enumerate(tables)]
    if report["pictures"]:
        sections.append(_pictures(report["pictures"], folder))
    links = "".join(
        f'<a href="#table-{index}">{escape(grid.title.split(" (")[0])}</a>'
        for index, grid in enumerate(tables)
    )
    page, style = (file.read_text(encoding="utf-8") for file in (PAGE, STYLE))
    parts = {"title": escape(report["title"]), "links": links, "sections": "\n".join(sections)}
    return Template(page).substitute(parts, style=style)


def _table(index: int, grid: Grid) -> str:
    table = printed(grid)
    head = "".join(f"<th>{escape(name)}</th>" for name in table.header)
    texts = ["".join(f"<td>{escape(text)}</td>" for text in row) for row in table.rows]
    rows = zip(table.rows, texts, strict=True)
    body = "".join(f'<tr class="{_css(row[0])}">{cells}</tr>' for row, cells in rows)
    plots = "".join(column_plot(grid, column) for column in grid.columns if grid.plot)
    drawn = f'<details open><summary>plots</summary><div class="plots">{plots}</div></details>'
    return (
        f'<section id="table-{index}"><h2>{escape(grid.title)}</h2><div class="scroll"><table>'
        f"<thead><tr>{head}</tr></thead><tbody>{body}</tbody></table></div>"
        f"{_note(grid.note)}{drawn if plots else ''}</section>"
    )


def _css(name: str) -> str:
    return re.sub(r"\W+", "-", name)


def _note(text: str) -> str:
    """Markdown's emphasis and code, nothing else."""
    marked = re.sub(r"`([^`]+)`", r"<code>\1</code>", escape(text))
    marked = re.sub(r"\*([^*\s][^*]*)\*", r"<em>\1</em>", marked)
    return f'<p class="note">{marked}</p>' if text else ""


def _worst(report: dict[str, Any], folder: Path) -> Iterator[str]:
    """A player and a table of figures for each bench, worst motion first."""
    benches = dict.fromkeys(sample["bench"] for sample in report["samples"])
    for bench in benches:
        samples = [sample for sample in report["samples"] if sample["bench"] == bench]
        # A page plays one song, so that each motion to music has a page of its own.
        groups = [samples] if report["branch"] != "audio" else [[sample] for sample in samples]
        pages = (escape(player(group, folder, report["branch"]), quote=True) for group in groups)
        frame = '<iframe title="motions" loading="lazy" srcdoc="{}"></iframe>'
        players = "".join(map(frame.format, pages))
        keys = dict.fromkeys(key for sample in samples for key in sample["figures"])
        head = "".join(f"<th>{escape(key.replace('_', ' '))}</th>" for key in keys)
        rows = "".join(
            f'<tr><td>{s["rank"]} of {s["of"]}</td><td class="long">{escape(s["title"])}</td>'
            + "".join(f"<td>{number(s['figures'].get(key), 3)}</td>" for key in keys)
            + "</tr>"
            for s in samples
        )
        yield (
            f'<section id="worst-{_css(bench)}"><h2>Worst first: {escape(bench)}</h2>'
            f'<div class="players">{players}</div>'
            '<p class="note">The first replication, by the mean over families of the mean rank in'
            " the figures below.</p><details><summary>their figures</summary>"
            f'<div class="scroll"><table><thead><tr><th>place</th><th>asked for</th>{head}</tr>'
            f"</thead><tbody>{rows}</tbody></table></div></details></section>"
        )


def player(samples: Sequence[dict[str, Any]], folder: Path, branch: str) -> str:
    """The formats' own viewer with these motions side by side, or with one and its song."""
    titles = [f"{sample['rank']} of {sample['of']}: {sample['title']}" for sample in samples]
    files = [inside(folder, sample["file"]) for sample in samples]
    with tempfile.TemporaryDirectory() as temporary:
        path = Path(temporary) / "player.html"
        if branch != "audio":
            motions = zip(map(read_npz, files), titles, strict=True)
            write_html([replace(motion, text=title) for motion, title in motions], path)
        else:
            (sample,) = samples
            song = SongTrack(inside(folder, sample["sound"]), meter=sample["meter"])
            write_trajectory_html(read_trajectory_npz(files[0]), path, song, titles)
        return path.read_text(encoding="utf-8")


def _pictures(pictures: Sequence[dict[str, Any]], folder: Path) -> str:
    shown = ""
    for picture in pictures:
        data = base64.b64encode(inside(folder, picture["file"]).read_bytes()).decode()
        title = escape(picture["title"])
        shown += f'<h2>{title}</h2><img alt="{title}" src="data:image/png;base64,{data}">'
    return f'<section id="pictures">{shown}</section>'


# ---------------------------------------------------------------- plots of a table
# One a column, a dot and its interval a row; text only, so that equal tables give equal bytes.


def column_plot(grid: Grid, column: Column) -> str:
    """One column; empty where fewer than two rows have numbers."""
    known = {name: span(row.cells.get(column.key)) for name, row in grid.rows.items()}
    spans = {name: found for name, found in known.items() if found is not None}
    if len(spans) < 2:
        return ""
    low, high = min(s[1] for s in spans.values()), max(s[2] for s in spans.values())
    if 0 < low < high - low:  # 0 is on the axis where that costs less than half of its length
        low = 0.0
    low, high = (low, high) if high > low else (low - 0.5, low + 0.5)
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
        colour = COLOURS.get(name, OTHER_COLOUR)
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
    if isinstance(cell, Mapping):
        value, low, high = (cell.get(key) for key in ("value", "low", "high"))
        if value is None or low is None or high is None:
            return None
        return float(value), float(low), float(high)
    if isinstance(cell, (int, float)) and math.isfinite(cell):
        return float(cell), float(cell), float(cell)
    return None


# ---------------------------------------------------------------- two reports against each other


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
            "difference": {k: v for k, v in asdict(found).items() if k != "p"},
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
