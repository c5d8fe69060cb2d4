"""A path as a user draws it: points on the ground, from a file.

In metres: x (to the left of a character that faces +Z) and z; optionally t (seconds) and heading
(degrees about +Y, 0 = +Z, 90 = +X).

Letters: N points.
"""

import csv
import math
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from ..config_loader import parse_yaml
from ..errors import UserError
from ..files import read_text

COLUMNS = ("x", "z", "t", "heading")
SHORTEST, LONGEST = 0.01, 1000.0  # metres of a path
FASTEST = 4.0  # m/s
MAX_POINTS = 100_000


@dataclass(frozen=True, eq=False)
class DrawnPath:
    """Points as they were given.

    Attributes:
        points: x and z [N,2] float64, metres.
        times: seconds [N], increasing, or None.
        headings: radians [N], or None.
    """

    points: np.ndarray
    times: np.ndarray | None = None
    headings: np.ndarray | None = None

    @property
    def length(self) -> float:
        """Metres along the straight lines between the points."""
        return float(np.linalg.norm(np.diff(self.points, axis=0), axis=1).sum())


def read_path(path: str | Path) -> DrawnPath:
    """A path from CSV (with or without a line of names), JSON or YAML.

    JSON and YAML hold a list of points, or a mapping with `points`: each a list in the order x, z,
    t, heading, or a mapping of these names.

    Raises:
        UserError: unreadable, not numbers, fewer than two places, times that do not increase, or
            too fast; names the point.
    """
    path = Path(path)
    text = read_text(path, "a CSV, JSON or YAML file")
    if path.suffix.lower() == ".csv":
        names, rows = _csv_rows(text, path)
    else:
        names, rows = _listed_rows(parse_yaml(text, str(path)), path)
    values = _numbers(rows, names, path)
    column = {name: values[:, index] for index, name in enumerate(names)}
    headings = column.get("heading")
    drawn = DrawnPath(
        np.stack((column["x"], column["z"]), axis=1),
        column.get("t"),
        None if headings is None else np.unwrap(np.deg2rad(headings)),
    )
    _check(drawn, path)
    return drawn


def _csv_rows(text: str, path: Path) -> tuple[tuple[str, ...], list[Any]]:
    try:
        rows = [[cell.strip() for cell in row] for row in csv.reader(text.splitlines()) if any(row)]
    except csv.Error as error:
        raise UserError(f"{path}: is no table ({error}); give at least two lines x,z") from None
    if not rows:
        raise UserError(f"{path}: is empty; give at least two lines x,z")
    names = tuple(cell.lower() for cell in rows[0])
    if any(_is_number(cell) for cell in names):
        return COLUMNS[: len(rows[0])], rows
    return _checked_names(names, path), rows[1:]


def _listed_rows(value: Any, path: Path) -> tuple[tuple[str, ...], list[Any]]:
    points = value.get("points") if isinstance(value, dict) else value
    if not isinstance(points, list) or not points:
        raise UserError(f"{path}: holds no list of points; write [[x, z], …] or {{points: …}}")
    if isinstance(points[0], dict):
        names = _checked_names(tuple(str(name).lower() for name in points[0]), path)
        rows = []
        for number, point in enumerate(points, start=1):
            if not isinstance(point, dict) or {str(key).lower() for key in point} != set(names):
                raise UserError(
                    f"{path}: point {number} is not like the first one ({', '.join(names)});"
                    " mend it"
                )
            rows.append([point[key] for name in names for key in point if str(key).lower() == name])
        return names, rows
    width = len(points[0]) if isinstance(points[0], list) else 0
    return COLUMNS[:width], points


def _checked_names(names: tuple[str, ...], path: Path) -> tuple[str, ...]:
    unknown = [name for name in names if name not in COLUMNS]
    if unknown or not {"x", "z"} <= set(names) or len(set(names)) < len(names):
        raise UserError(
            f"{path}: the columns are {', '.join(names)}; give x and z, and if you like t"
            " (seconds) and heading (degrees)"
        )
    return names


def _numbers(rows: Sequence[Any], names: tuple[str, ...], path: Path) -> np.ndarray:
    """Values [N, columns]."""
    if not 2 <= len(names) <= len(COLUMNS):
        raise UserError(f"{path}: a point needs 2 to 4 numbers: x, z, t, heading")
    if len(rows) > MAX_POINTS:
        raise UserError(
            f"{path}: {len(rows)} points are over the limit of {MAX_POINTS}; leave some out"
        )
    for number, row in enumerate(rows, start=1):
        if not isinstance(row, list) or len(row) != len(names):
            raise UserError(f"{path}: point {number} is {row!r}, not {len(names)} numbers; mend it")
        for name, value in zip(names, row, strict=True):
            if not _is_number(value) or not math.isfinite(float(value)):
                raise UserError(
                    f"{path}: point {number}: {name} is {value!r}, not a number; mend it"
                )
    return np.array([[float(value) for value in row] for row in rows]).reshape(-1, len(names))


def _is_number(value: Any) -> bool:
    if isinstance(value, bool):
        return False
    try:
        float(value)
    except (TypeError, ValueError, OverflowError):
        return False
    return True


def _check(drawn: DrawnPath, path: Path) -> None:
    if not SHORTEST <= drawn.length <= LONGEST:
        raise UserError(
            f"{path}: the path is {drawn.length:g} m long; give two or more different points, in"
            f" metres, of at most {LONGEST:g} m"
        )
    if drawn.times is None:
        return
    steps = np.diff(drawn.times)
    if not (steps > 0).all():
        worst = int(np.flatnonzero(steps <= 0)[0])
        raise UserError(
            f"{path}: point {worst + 2} is at t = {drawn.times[worst + 1]:g}, not after"
            f" {drawn.times[worst]:g}; times must increase"
        )
    speeds = np.linalg.norm(np.diff(drawn.points, axis=0), axis=1) / steps
    if speeds.max() > FASTEST:
        worst = int(speeds.argmax())
        raise UserError(
            f"{path}: from point {worst + 1} to {worst + 2} the speed is {speeds.max():.1f} m/s;"
            f" at most {FASTEST:g} m/s can be gone"
        )
