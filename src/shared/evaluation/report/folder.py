"""The folder of a report: report.json, and what is made from it, report.md and report.html."""

from pathlib import Path
from typing import Any

from ...errors import UserError
from ...io.files import write_json, write_text
from ..manifest import read_json
from .html import html_page
from .tables import markdown

REPORT = "report.json"


def save_report(report: dict[str, Any], folder: Path) -> None:
    """Write all three.

    Raises:
        UserError: the folder cannot be written.
    """
    write_json(folder / REPORT, report)
    render(folder)


def render(folder: Path) -> dict[str, Any]:
    """Make report.md and report.html again; returns the report.

    Raises:
        UserError: report.json, a sample or a picture is missing or damaged.
    """
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
