"""From parts to pages: one page with everything in it, nothing that acts as markup, comparison."""

import json
import re
from dataclasses import replace
from pathlib import Path

import pytest

from src.shared.errors import UsageError, UserError
from src.shared.evaluation import manifest
from src.shared.evaluation.engine import run_bench
from src.shared.evaluation.manifest import Parts, read_json
from src.shared.evaluation.pages import Side, compare, render, save_report, verdict
from src.shared.evaluation.stats import Difference
from src.shared.evaluation.tables import (
    Column,
    Grid,
    Table,
    markdown,
    report_data,
    table_lines,
)
from tests.shared.evaluation.toy_bench import toy_bench
from tests.shared.formats.chromium_pipe import Browser, chromium

MANIFEST = {"branch": "text", "model": {"w": "1"}, "settings": {"seed": 0, "replications": 3}}


def write(folder: Path, *, lift: float = 0.5, replications: int = 3) -> Path:
    """A report of the toy bench."""
    manifest.claim(folder, {**MANIFEST, "model": {"w": str(lift)}})
    parts = Parts(folder)
    grids = run_bench(
        toy_bench(lift=lift),
        parts,
        replications,
        0,
        lambda text: None,
    )
    samples = parts.once("toy.generated.000", dict)["samples"]
    settings = {"seed": 0, "replications": replications}
    about = {"model": "<script>alert(1)</script>"}
    save_report(report_data("text", about, settings, grids, samples), folder)
    return folder


def test_one_page_holds_tables_plots_and_players(tmp_path: Path) -> None:
    folder = write(tmp_path)
    page = (folder / "report.html").read_text()
    assert page.count("<iframe") == 1 and page.count('<svg class="plot"') == 3
    assert "Worst first" in page and "<em>metres</em>" in page
    outside = re.sub(r'srcdoc="[^"]*"', "", page)
    assert "<script" not in outside and "&lt;script&gt;alert" in outside and "<b>1" not in outside
    assert not re.search(r'(?:src|href)="(?!data:|#)', outside)


def test_markdown_takes_no_html_from_what_it_quotes(tmp_path: Path) -> None:
    text = (write(tmp_path) / "report.md").read_text()
    assert "- model: \\<script>alert(1)\\</script>" in text and "| \\<b>1" in text
    assert not re.search(r"(?<!\\)<(?=[a-z/!])", text)
    table = Table("t", ["asked for"], [["![x](http://x) [y](javascript:z) a|b \\"]])
    assert "| !\\[x](http://x) \\[y](javascript:z) a\\|b \\\\ |" in table_lines(table)


@pytest.mark.skipif(chromium() is None, reason="no Chromium here")
def test_a_browser_has_nothing_to_complain_about(tmp_path: Path) -> None:
    page = write(tmp_path / "report") / "report.html"
    with Browser(page.as_uri(), tmp_path / "profile", ready="true") as browser:
        assert "Worst first" in browser.evaluate("document.body.textContent")
        assert not browser.problems


def test_the_pages_can_be_made_again(tmp_path: Path) -> None:
    folder = write(tmp_path)
    before = {name: (folder / name).read_bytes() for name in ("report.md", "report.html")}
    for name in before:
        (folder / name).unlink()
    report = render(folder)
    assert before == {name: (folder / name).read_bytes() for name in before}
    assert "| generated |" in markdown(report) and "1 of 12, toy" in markdown(report)
    (folder / "samples" / "toy-01.npz").unlink()
    with pytest.raises(UserError, match=r"toy-01.npz does not exist"):
        render(folder)
    (folder / "report.json").write_text("{}")
    with pytest.raises(UserError, match="no report of this version"):
        render(folder)


def test_a_known_difference_is_found_and_paired(tmp_path: Path) -> None:
    a, b = write(tmp_path / "a"), write(tmp_path / "b", lift=0.2)
    found = {t["name"]: Grid.from_dict(t) for t in compare(Side(a), Side(b))["tables"]}
    cells = found["toy/heights"].rows["height m"].cells
    difference = cells["difference"]
    assert isinstance(difference, dict)
    assert difference["value"] == pytest.approx(-0.3) and difference["count"] == 12
    assert difference["low"] == pytest.approx(-0.3, abs=1e-6)  # float32 heights
    assert cells["better"] == "b" and found["toy/apart"].value("apart m", "pairs") == 3
    rows = compare(Side(a, "generated"), Side(a, "untrained"))["tables"]
    assert {row["name"] for table in rows for row in table["rows"]} == {
        "height m"
    }  # one replication of the others makes no pair


def test_a_verdict_needs_pairs_and_an_interval_off_zero() -> None:
    high, low, real = (Column("x", "x", better=kind) for kind in ("high", "low", "real"))
    above = Difference(1.0, 0.5, 1.5, 20, 0.01)
    assert [verdict(column, above) for column in (high, low, real)] == ["b", "a", "differ"]
    assert verdict(high, Difference(1.0, -0.5, 1.5, 20, 0.2)) == "–"
    assert verdict(high, replace(above, count=7)) == "too few"


def test_a_bar_in_a_heading_is_no_border() -> None:
    table = Table("t", ["row", "|error|"], [["real", "0.1"]])
    assert "| row | \\|error\\| |" in table_lines(table)


def test_only_like_is_compared_with_like(tmp_path: Path) -> None:
    a, b = write(tmp_path / "a"), write(tmp_path / "b")
    other = read_json(b / "manifest.json")
    other["settings"]["seed"] = 1
    (b / "manifest.json").write_text(json.dumps(other))
    with pytest.raises(UserError, match=r"differ in settings.seed: such figures never stand"):
        compare(Side(a), Side(b))
    with pytest.raises(UserError, match="asked for different things"):
        compare(Side(a), Side(a, "real"))
    with pytest.raises(UserError, match="no row 'nobody'"):
        compare(Side(a), Side(a, "nobody"))


def test_a_folder_of_another_evaluation_is_refused(tmp_path: Path) -> None:
    manifest.claim(tmp_path, MANIFEST)
    manifest.claim(tmp_path, {**MANIFEST, "settings": {"seed": 0, "replications": 20}})
    with pytest.raises(UsageError, match=r"another model.w; name another folder"):
        manifest.claim(tmp_path, {**MANIFEST, "model": {"w": "2"}})
