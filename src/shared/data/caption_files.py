"""Captions that a user gives for their clips: CSV, TSV or JSON."""

import csv
import json
import re
from collections.abc import Sequence
from pathlib import Path
from typing import Any, Literal, NamedTuple

from src.shared.data.recordings import FOLDER_ENDINGS
from src.shared.errors import UserError
from src.shared.files import parse_json, read_text

Captions = dict[str, dict[str, list[str]]]  # clip -> language -> captions
_CLIP_KEYS = ("clip", "file", "id", "name")
_CAPTION_KEYS = ("caption", "text", "description")
# The first cell of a line, and what ends it: spreadsheets write ; where a comma is in numbers.
_FIRST_CELL = re.compile(r'\s*(?:"(?:[^"]|"")*"|[^",;\t]*)\s*([,;\t])')


def read_captions(path: Path) -> Captions:
    """Captions by clip (path or file name as given, without ending) and language.

    CSV (with commas, semicolons or tabs) and TSV: columns clip, caption and, optionally, language
    (default en), with or without a header line; several lines a clip are several captions. JSON:
    {clip: text}, {clip: [texts]}, {clip: {language: text or texts}} or a list of {clip, caption,
    language}.

    Raises:
        UserError: missing file, unknown ending, a line without clip or caption.
    """
    text = read_text(path, "a CSV, TSV or JSON file of captions, in UTF-8")
    ending = path.suffix.lower()
    if ending == ".json":
        rows = _json_rows(path, text)
    elif ending in (".csv", ".tsv"):
        rows = _table_rows(path, text, "\t" if ending == ".tsv" else _delimiter(text))
    else:
        raise UserError(f"captions {path}: unknown ending {ending!r}; use .csv, .tsv or .json")
    captions: Captions = {}
    for where, clip, language, caption in rows:
        caption = " ".join(caption.split())
        if not clip.strip() or not caption:
            raise UserError(f"captions {path}, {where}: no clip or no caption; give both")
        clip = without_ending(Path(clip.strip().replace("\\", "/")).as_posix())
        captions.setdefault(clip, {}).setdefault(language or "en", []).append(caption)
    if not captions:
        raise UserError(f"captions {path}: no captions in it; expected clip and caption columns")
    return captions


def without_ending(name: str) -> str:
    """The name without the ending of a motion file, whatever the case."""
    ending = next((e for e in FOLDER_ENDINGS if name.lower().endswith(e)), "")
    return name[: len(name) - len(ending)]


def match_captions(
    captions: Captions, sources: Sequence[tuple[str, Sequence[str]]], path: Path | None
) -> tuple[list[Captions], dict[str, bool]]:
    """Give each row to its file: by the path below its folder first, by the file name otherwise.

    Args:
        captions: as `read_captions` gives them.
        sources: name of each folder, and the paths of its files relative to it, with their
            endings; a row may begin with the name, or with folders above it.
        path: names the captions file in errors.

    Returns:
        captions by item of each source, and for each row whether it found a file.

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
    matched: list[Captions] = [{} for _ in sources]
    found: dict[str, bool] = {}
    for row, texts in captions.items():
        files = exact[row] or fitting[row]
        if len(files) > 1 and (exact[row] or "/" not in row):
            named = ", ".join(f"{file.folder}/{file.item}" for file in files[:4])
            raise UserError(
                f"captions {path}: clip {row!r} fits {len(files)} files ({named}); write the"
                " folder too"
            )
        file = files[0] if len(files) == 1 else None
        if not exact[row] and "/" in row and file in taken:
            file = None  # a row of another folder leaves a file alone that has rows of its own
        found[row] = file is not None
        if file is not None:
            languages = matched[file.source].setdefault(file.item, {})
            for language, more in texts.items():
                languages[language] = languages.get(language, []) + more
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


def _delimiter(text: str) -> str:
    """What parts the cells of a table: whatever ends the first one."""
    found = _FIRST_CELL.match(text)
    return found[1] if found else ","


def _table_rows(path: Path, text: str, delimiter: str) -> list[tuple[str, str, str, str]]:
    quoting: Literal[0, 3] = csv.QUOTE_NONE if delimiter == "\t" else csv.QUOTE_MINIMAL
    reader = csv.reader(text.splitlines(), delimiter=delimiter, quoting=quoting)
    try:
        lines = [(n, row) for n, row in enumerate(reader, 1) if any(cell.strip() for cell in row)]
    except csv.Error as error:
        raise UserError(f"captions {path}, line {reader.line_num}: {error}; mend it") from None
    columns = {"clip": 0, "caption": 1, "language": 2}
    header = [cell.strip().lower() for cell in lines[0][1]] if lines else []
    if set(header) & set(_CLIP_KEYS) and set(header) & set(_CAPTION_KEYS):
        columns = {
            "clip": next(header.index(key) for key in _CLIP_KEYS if key in header),
            "caption": next(header.index(key) for key in _CAPTION_KEYS if key in header),
            "language": header.index("language") if "language" in header else len(header),
        }
        lines = lines[1:]

    def cell(row: list[str], name: str) -> str:
        return row[columns[name]].strip() if columns[name] < len(row) else ""

    return [
        (f"line {number}", cell(row, "clip"), cell(row, "language"), cell(row, "caption"))
        for number, row in lines
    ]


def _json_rows(path: Path, text: str) -> list[tuple[str, str, str, str]]:
    try:
        content: Any = parse_json(text)
    except ValueError as error:
        line = f", line {error.lineno}" if isinstance(error, json.JSONDecodeError) else ""
        what = error.msg if isinstance(error, json.JSONDecodeError) else str(error)
        raise UserError(f"captions {path}{line}: not JSON: {what}; mend the file") from None
    rows: list[tuple[str, str, str, str]] = []
    if isinstance(content, list):
        for number, entry in enumerate(content):
            if not isinstance(entry, dict):
                raise UserError(f"captions {path}, entry {number}: expected an object")
            clip = next((str(entry[key]) for key in _CLIP_KEYS if key in entry), "")
            caption = next((str(entry[key]) for key in _CAPTION_KEYS if key in entry), "")
            rows.append((f"entry {number}", clip, str(entry.get("language", "en")), caption))
        return rows
    if not isinstance(content, dict):
        raise UserError(f"captions {path}: expected an object or a list")
    for clip, value in content.items():
        by_language = value if isinstance(value, dict) else {"en": value}
        for language, texts in by_language.items():
            for caption in texts if isinstance(texts, list) else [texts]:
                if not isinstance(caption, str):
                    raise UserError(
                        f"captions {path}, {clip!r}: {caption!r:.60} is not text"
                        "; write it in quotes"
                    )
                rows.append((f"{clip!r}", clip, language, caption))
    return rows
