"""From motion files to a memory of figures: takes of dance, each with its kind, source and licence.

A table (CSV) names the files: `file,kind,source,licence,repeat`, all but the first optional; a
short loop is repeated so often. A line `steps` stands for the steps that are made by code. Without
a table every motion file of the folder is a take.
"""

import csv
import io
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np

from ..data.retarget.read_motion import FOLDER_ENDINGS, read_motion
from ..errors import UserError
from ..io.files import read_text
from ..motion.motion import Motion
from .figures import FigureMemory, Take
from .steps import made_takes

COLUMNS = ("file", "kind", "source", "licence", "repeat")
DANCE = "dance"  # a kind that nobody named
MAX_REPEAT = 20
MADE = "steps"  # stands for a file: the takes that `steps.py` makes

Progress = Callable[[int, int], None]  # (takes done, takes in all)


@dataclass(frozen=True)
class TakeRow:
    """One line of a table; `repeat`: how often a loop is played."""

    file: Path
    kind: str = DANCE
    source: str = ""
    licence: str = ""
    repeat: int = 1


def read_takes(table: Path, folder: Path) -> list[TakeRow]:
    """The rows of a table, their files in `folder`.

    Raises:
        UserError: unreadable, another column, no row, no such file, or a bad number.
    """
    reader = csv.DictReader(io.StringIO(read_text(table, "a CSV file")))
    names = [name.strip().lower() for name in reader.fieldnames or ()]
    if "file" not in names or not set(names) <= set(COLUMNS):
        raise UserError(
            f"{table}: the columns are {', '.join(names) or 'none'}; give file and, if you like,"
            f" {', '.join(COLUMNS[1:])}"
        )
    rows = []
    for line, cells in enumerate(reader, start=2):
        values = dict(
            zip(names, (str(value or "").strip() for value in cells.values()), strict=False)
        )
        repeat = values.get("repeat") or "1"
        if not repeat.isdigit() or not 1 <= int(repeat) <= MAX_REPEAT:
            raise UserError(f"{table}: line {line}: repeat is {repeat!r}; give 1 to {MAX_REPEAT}")
        file = folder / values["file"]
        if values["file"] != MADE and not file.is_file():
            raise UserError(f"{table}: line {line}: {file} is no file; mend the name or the folder")
        kind = values.get("kind") or DANCE
        own = values.get("source", ""), values.get("licence", "")
        rows.append(TakeRow(file, kind, *own, int(repeat)))
    if not rows:
        raise UserError(f"{table} names no file; give one a line")
    return rows


def every_file(folder: Path) -> list[TakeRow]:
    """All motion files below a folder, in order.

    Raises:
        UserError: there is none.
    """
    found = [path for path in sorted(folder.rglob("*")) if path.suffix.lower() in FOLDER_ENDINGS]
    if not found:
        raise UserError(f"{folder} holds no motion files; name a folder of dances")
    return [TakeRow(path, source=folder.name) for path in found]


def build_figures(
    rows: Sequence[TakeRow], *, progress: Progress = lambda done, total: None
) -> tuple[FigureMemory, dict[str, str]]:
    """The memory of some takes, and those that could not be used, with the reason.

    Raises:
        UserError: none can.
    """
    takes: list[Take] = []
    left_out: dict[str, str] = {}
    for done, row in enumerate(rows, start=1):
        if row.file.name == MADE:
            takes += made_takes()
            progress(done, len(rows))
            continue
        try:
            motion = repeated(read_motion(row.file), row.repeat)
            take = Take.of(motion, row.file.stem, row.kind, row.source, row.licence)
            if take.is_dance:
                takes.append(take)
            else:
                left_out[str(row.file)] = "fewer than five counts were found"
        except UserError as error:
            left_out[str(row.file)] = str(error)
        progress(done, len(rows))
    return FigureMemory(takes), left_out


def repeated(motion: Motion, times: int) -> Motion:
    """A loop that is played some times, where it is."""
    return replace(
        motion,
        quaternions=np.tile(motion.quaternions, (times, 1, 1)),
        root_position=np.tile(motion.root_position, (times, 1)),
        contacts=np.tile(motion.contacts, (times, 1)),
    )
