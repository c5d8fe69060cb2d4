"""What an evaluation has finished, part by part: a second start takes it up where it stopped.

A folder of JSON files, each written whole, one a part; without a folder, memory. How long each
part took is kept apart in timing.json, so that nothing else depends on the clock.
"""

import re
import time
from collections.abc import Callable
from pathlib import Path
from typing import Any

from ..errors import UserError
from ..files import inside, load_json, write_json

Part = dict[str, Any]
TIMING = "timing.json"


class Parts:
    """Finished parts by name.

    Args:
        folder: of the report; None = nothing is kept.
    """

    def __init__(self, folder: Path | None = None) -> None:
        self.folder = folder
        self.known: dict[str, Part] = {}
        self.seconds: dict[str, float] = {}
        if folder is not None and (folder / TIMING).is_file():
            self.seconds = dict(read_json(folder / TIMING).get("seconds", {}))

    def once(self, name: str, compute: Callable[[], Part]) -> Part:
        """The part of this name, computed and written unless it is there."""
        if name not in self.known:
            self.known[name] = self._read(name) or self._compute(name, compute)
        return self.known[name]

    def done(self, name: str) -> bool:
        """Whether `once` would compute nothing."""
        path = self._path(name)
        return name in self.known or (path is not None and path.is_file())

    def _path(self, name: str) -> Path | None:
        if self.folder is None:
            return None
        return self.folder / "parts" / (re.sub(r"[^\w.-]+", "-", name) + ".json")

    def _read(self, name: str) -> Part | None:
        """A finished part whose files are still there."""
        path = self._path(name)
        if self.folder is None or path is None or not path.is_file():
            return None
        part = read_json(path)
        kept = [*part.get("samples", ()), *part.get("pictures", ())]
        files = [item[key] for item in kept for key in ("file", "sound") if key in item]
        return part if all(inside(self.folder, file).is_file() for file in files) else None

    def _compute(self, name: str, compute: Callable[[], Part]) -> Part:
        started = time.perf_counter()
        part = compute()
        self.seconds[name] = round(time.perf_counter() - started, 3)
        path = self._path(name)
        if path is not None and self.folder is not None:
            write_json(path, part)
            total = round(sum(self.seconds.values()), 1)
            write_json(self.folder / TIMING, {"seconds": self.seconds, "total": total})
        return part


def read_json(path: Path) -> dict[str, Any]:
    """An object of a report folder.

    Raises:
        UserError: missing, or not whole.
    """
    try:
        return dict(load_json(path))
    except (OSError, ValueError, TypeError) as error:
        raise UserError(
            f"{path} cannot be read ({error}); delete it and run `evaluate` again with the same"
            " --out: only what is missing is measured"
        ) from error
