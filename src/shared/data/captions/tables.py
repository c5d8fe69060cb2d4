"""What a user's table says of clips and pieces of clips: CSV, TSV or JSON."""

import csv
import json
import math
import re
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from difflib import get_close_matches
from pathlib import Path
from typing import Any, Literal, NamedTuple, get_args

from ...config_schema import Provenance
from ...errors import UserError
from ...io.files import parse_json, read_text
from ..retarget.read_motion import FOLDER_ENDINGS

_CLIP_KEYS = ("clip", "file", "id", "name")
_CAPTION_KEYS = ("caption", "text", "description")
LABEL_KEYS = ("action", "side", "direction", "count", "turn", "angle", "speed", "style", "kind",
              "terrain")  # fmt: skip
_VALUES = {
    "side": ("left", "right", "both"),
    "turn": ("left", "right"),
    "direction": ("forward", "backward", "left", "right", "up", "down"),
    "speed": ("slow", "normal", "fast"),
}  # of labels; others are let through but for sides, unless they are nearly one of these
_KEYS = {**dict.fromkeys(_CLIP_KEYS, "clip"), **dict.fromkeys(_CAPTION_KEYS, "caption")} | {
    key: key for key in ("language", "start", "end", "repeat", "hold", "provenance", *LABEL_KEYS)
}
# The first cell of a line, and what ends it: spreadsheets write ; where a comma is in numbers.
_FIRST_CELL = re.compile(r'\s*(?:"(?:[^"]|"")*"|[^",;\t]*)\s*([,;\t])')
_OR = " | "  # between several wordings in one cell
MAX_REPEAT, MAX_HOLD = 20, 10.0

_Row = tuple[str, dict[str, str]]  # where it stands, and its cells by key


@dataclass(frozen=True)
class Piece:
    """A stretch of a clip, or all of it, and what a table says of it.

    Attributes:
        start, end: seconds; no end is the clip's own.
        repeat: how often it is played; for loops that begin as they end.
        hold: seconds that its last pose is held; for gestures too short to train on.
        labels: as label rules give them; `action` and so on.
        captions: language -> wordings.
        provenance: where the motion comes from.
        told: language -> the first file and row with captions in it; "" stands for none.
    """

    start: float = 0.0
    end: float | None = None
    repeat: int = 1
    hold: float = 0.0
    labels: Mapping[str, str] = field(default_factory=dict)
    captions: Mapping[str, Sequence[str]] = field(default_factory=dict)
    provenance: Provenance = "captured"
    told: Mapping[str, str] = field(default_factory=dict, repr=False, compare=False)

    @property
    def whole(self) -> bool:
        """Whether it is all of the clip."""
        return not self.start and self.end is None

    def joined(self, other: "Piece") -> "Piece":
        """What two rows say of one stretch; of the second's labels those that the first lacks."""
        captions = {language: list(texts) for language, texts in self.captions.items()}
        for language, texts in other.captions.items():
            captions.setdefault(language, []).extend(texts)
        labels = {**other.labels, **self.labels}
        told = {**other.told, **self.told}
        return replace(self, labels=labels, captions=captions, told=told)


Table = dict[str, tuple[Piece, ...]]  # clip -> its pieces


def read_captions(*paths: Path) -> Table:
    """What tables say of clips (path or file name as given, without ending).

    CSV (with commas, semicolons or tabs) and TSV: columns clip, caption and, optionally, language
    (default en), start and end (seconds), labels (`LABEL_KEYS`), repeat, hold and provenance;
    without a header line the first three.
    A line has a caption or an action; several lines a piece are several captions, and so are
    wordings with " | " between them. JSON: {clip: text}, {clip: [texts]}, {clip: {language: text
    or texts}} or a list of objects with the same keys.

    Raises:
        UserError: missing file, unknown ending, a line without clip or caption, or with times,
            numbers or a provenance that are none.
    """
    pieces: dict[str, list[Piece]] = {}
    for path in paths:
        rows = _rows(path)
        for row in rows:
            clip, piece = _piece(path, row)
            pieces.setdefault(clip, []).append(piece)
        if not rows:
            raise UserError(
                f"captions {path}: no captions in it; expected clip and caption columns"
            )
    return {clip: _merged(found) for clip, found in pieces.items()}


def _merged(pieces: Iterable[Piece]) -> tuple[Piece, ...]:
    """One piece for each stretch."""
    merged: dict[tuple[float, float | None], Piece] = {}
    for piece in pieces:
        stretch = (piece.start, piece.end)
        merged[stretch] = merged[stretch].joined(piece) if stretch in merged else piece
    return tuple(merged.values())


def _piece(path: Path, row: _Row) -> tuple[str, Piece]:
    """The clip that a row names, and the piece it tells of."""
    where, cells = row
    place = f"captions {path}, {where}"
    clip = cells.get("clip", "").strip()
    texts = [" ".join(text.split()) for text in cells.get("caption", "").split(_OR)]
    texts = [text for text in texts if text]
    labels = {key: cells[key].strip() for key in LABEL_KEYS if cells.get(key, "").strip()}
    labels = {key: _label(place, key, value) for key, value in labels.items()}
    if not clip or not (texts or "action" in labels):
        raise UserError(f"{place}: no clip or no caption; give both, or an action for a caption")
    start = _number(place, "start", cells, 0.0)
    end = _number(place, "end", cells, math.inf)
    if not 0 <= start < end:
        raise UserError(f"{place}: start {start:g} is not before end {end:g}; correct the seconds")
    repeat = _number(place, "repeat", cells, 1.0)
    if repeat not in range(1, MAX_REPEAT + 1):
        raise UserError(f"{place}: repeat {repeat:g}: must be a whole number, 1 to {MAX_REPEAT}")
    hold = _number(place, "hold", cells, 0.0)
    if not 0 <= hold <= MAX_HOLD:
        raise UserError(f"{place}: hold {hold:g}: must be within 0 and {MAX_HOLD:g} seconds")
    provenance: Any = cells.get("provenance", "").strip() or "captured"
    if provenance not in get_args(Provenance):
        raise UserError(f"{place}: provenance {provenance!r} is not known;"
                        f" choose from {', '.join(get_args(Provenance))}")  # fmt: skip
    captions = {cells.get("language", "").strip() or "en": texts} if texts else {}
    told = dict.fromkeys(captions or [""], place)
    last = None if end == math.inf else end
    clip = without_ending(Path(clip.replace("\\", "/")).as_posix())
    return clip, Piece(start, last, int(repeat), hold, labels, captions, provenance, told)


def _label(place: str, key: str, value: str) -> str:
    """A label's value as others write it. Raises UserError: it is none, or nearly another one."""
    if key in ("count", "angle"):
        most, what = (MAX_REPEAT, "a number of times") if key == "count" else (3600, "degrees")
        if not (value.isascii() and value.isdigit() and 0 < int(value) <= most):
            raise UserError(f"{place}: {key} {value!r}: write {what} in digits, 1 to {most}")
        return str(int(value))
    value, known = value.lower() if key in ("action", *_VALUES) else value, _VALUES.get(key, ())
    near = get_close_matches(value, known, n=1, cutoff=0.75)
    if near and value not in known:
        raise UserError(f"{place}: {key} {value!r} is none; write {near[0]!r}")
    if key in ("side", "turn") and value not in known:
        raise UserError(f"{place}: {key} {value!r} is none; choose from {', '.join(known)}")
    return value


def _number(place: str, key: str, cells: dict[str, str], default: float) -> float:
    text = cells.get(key, "").strip()
    if not text:
        return default
    try:
        number = float(text)
    except ValueError:
        number = math.nan
    if not math.isfinite(number):
        raise UserError(f"{place}: {key} {text!r} is not a number; write 2.5, for example")
    return number


def without_ending(name: str) -> str:
    """The name without the ending of a motion file, whatever the case."""
    ending = next((e for e in FOLDER_ENDINGS if name.lower().endswith(e)), "")
    return name[: len(name) - len(ending)]


def match_captions(
    captions: Table, sources: Sequence[tuple[str, Sequence[str]]]
) -> tuple[list[Table], dict[str, bool]]:
    """Give each row to its file: by the path below its folder first, by the file name otherwise.

    Args:
        captions: as `read_captions` gives them.
        sources: name of each folder, and the paths of its files relative to it, with their
            endings; a row may begin with the name, or with folders above it.

    Returns:
        pieces by item of each source, and for each row whether it found a file.

    Raises:
        UserError: a row fits several files alike.
    """
    by_name: dict[str, list[_File]] = {}
    for number, (folder, items) in enumerate(sources):
        for item in items:
            by_name.setdefault(Path(item).stem, []).append(_File(number, folder, item))
    fitting = {row: by_name.get(Path(row + ".bvh").stem, []) for row in captions}
    exact = {row: _by_path(row, files) for row, files in fitting.items()}
    taken = {file for files in exact.values() for file in files}
    matched: list[Table] = [{} for _ in sources]
    found: dict[str, bool] = {}
    for row, pieces in captions.items():
        files = exact[row] or fitting[row]
        if len(files) > 1 and (exact[row] or "/" not in row):
            named = ", ".join(f"{file.folder}/{file.item}" for file in files[:4])
            where = next((place for piece in pieces for place in piece.told.values()), "captions")
            raise UserError(
                f"{where}: clip {row!r} fits {len(files)} files ({named}); write the folder too"
            )
        file = files[0] if len(files) == 1 else None
        if not exact[row] and "/" in row and file in taken:
            file = None  # a row of another folder leaves a file alone that has rows of its own
        found[row] = file is not None
        if file is not None:
            own = matched[file.source]
            own[file.item] = _merged((*own.get(file.item, ()), *pieces))
    return matched, found


class _File(NamedTuple):
    source: int  # its number
    folder: str
    item: str


def _by_path(row: str, files: Sequence[_File]) -> list[_File]:
    """Files whose path below their source the row is, or ends with, the folder's name before."""
    return [file for file in files if row == without_ending(file.item)] or [
        file for file in files if f"/{row}".endswith(f"/{file.folder}/{without_ending(file.item)}")
    ]


def _rows(path: Path) -> list[_Row]:
    text = read_text(path, "a CSV, TSV or JSON file of captions, in UTF-8")
    ending = path.suffix.lower()
    if ending == ".json":
        return _json_rows(path, text)
    if ending in (".csv", ".tsv"):
        first = _FIRST_CELL.match(text)
        delimiter = "\t" if ending == ".tsv" else first[1] if first else ","
        return _table_rows(path, text, delimiter)
    raise UserError(f"captions {path}: unknown ending {ending!r}; use .csv, .tsv or .json")


def _table_rows(path: Path, text: str, delimiter: str) -> list[_Row]:
    quoting: Literal[0, 3] = csv.QUOTE_NONE if delimiter == "\t" else csv.QUOTE_MINIMAL
    reader = csv.reader(text.splitlines(), delimiter=delimiter, quoting=quoting)
    try:
        lines = [(n, row) for n, row in enumerate(reader, 1) if any(cell.strip() for cell in row)]
    except csv.Error as error:
        raise UserError(f"captions {path}, line {reader.line_num}: {error}; mend it") from None
    columns = ["clip", "caption", "language"]
    header = [_KEYS.get(cell.strip().lower(), "") for cell in lines[0][1]] if lines else []
    if "clip" in header and {"caption", "action"} & set(header):
        _check_columns(path, [cell.strip().lower() for cell in lines[0][1]], header)
        columns, lines = header, lines[1:]
    for number, row in lines:
        if any(cell.strip() for cell in row[len(columns) :]):
            mark = {",": "commas", ";": "semicolons"}.get(delimiter, "tabs")
            remedy = f"write a caption with {mark} in quotes"
            if quoting:
                remedy = "take out the tabs"
            if columns is not header:
                remedy += "; without a header line the columns are clip, caption, language"
            what = f"{len(row)} cells for {len(columns)} columns"
            raise UserError(f"captions {path}, line {number}: {what}; {remedy}")
    cells = [(number, [*zip(columns, row, strict=False)]) for number, row in lines]
    # Of several columns for one key the first counts.
    return [(f"line {number}", dict(reversed(pairs))) for number, pairs in cells]


def _check_columns(path: Path, names: Sequence[str], header: Sequence[str]) -> None:
    """Raises UserError: a column has nearly the name of one that is not there."""
    absent = [name for name, key in _KEYS.items() if key not in header]
    for name, key in zip(names, header, strict=True):
        alike = [each for each in absent if each[:1] == name[:1]]  # "reaction" is no "action"
        near = [] if key else get_close_matches(name, alike, n=1, cutoff=0.85)
        if near:
            raise UserError(
                f"captions {path}: column {name!r} is unknown; rename it to {near[0]!r}"
            )


def _json_rows(path: Path, text: str) -> list[_Row]:
    try:
        content: Any = parse_json(text)
    except ValueError as error:
        line = f", line {error.lineno}" if isinstance(error, json.JSONDecodeError) else ""
        what = error.msg if isinstance(error, json.JSONDecodeError) else str(error)
        raise UserError(f"captions {path}{line}: not JSON: {what}; mend the file") from None
    rows: list[_Row] = []
    if isinstance(content, list):
        for number, entry in enumerate(content):
            if not isinstance(entry, dict):
                raise UserError(f"captions {path}, entry {number}: expected an object")
            given = [(key, value) for key, value in entry.items() if value is not None]
            cells = {_KEYS.get(str(key), ""): str(value) for key, value in reversed(given)}
            rows.append((f"entry {number}", cells))
        return rows
    if not isinstance(content, dict):
        raise UserError(f"captions {path}: expected an object or a list")
    for clip, value in content.items():
        by_language = value if isinstance(value, dict) else {"en": value}
        for language, texts in by_language.items():
            for caption in texts if isinstance(texts, list) else [texts]:
                if not isinstance(caption, str):
                    raise UserError(f"captions {path}, {clip!r}: {caption!r:.60} is not text; "
                                    "write it in quotes")  # fmt: skip
                cells = {"clip": clip, "language": language, "caption": caption}
                rows.append((f"{clip!r}", cells))
    return rows
