"""Analysed songs on disk, found again by the content of the sound file and the parameters.

The folder is $MOTIONGEN_AUDIO_CACHE, else motionsuite/audio in the user's cache folder. An entry
is written whole or not at all; one that cannot be read is made again.
"""

import hashlib
import json
import logging
import os
from functools import lru_cache
from pathlib import Path
from typing import Any

import numpy as np

from ..errors import UserError
from .arrays import read_arrays, write_arrays

FOLDER_VARIABLE = "MOTIONGEN_AUDIO_CACHE"

log = logging.getLogger(__name__)


def cache_folder() -> Path:
    """Where entries lie unless a caller says otherwise."""
    if chosen := os.environ.get(FOLDER_VARIABLE):
        return Path(chosen).expanduser()
    base = os.environ.get("XDG_CACHE_HOME") or "~/.cache"
    return Path(base).expanduser() / "motionsuite" / "audio"


@lru_cache(maxsize=1)
def code_version() -> str:
    """Changes with any source file of this package: other code may find other beats."""
    sources = sorted(Path(__file__).parent.glob("*.py"))
    return hashlib.sha256(b"".join(source.read_bytes() for source in sources)).hexdigest()


class FeatureCache:
    """A folder of npz entries; with `folder` None it keeps nothing and finds nothing."""

    def __init__(self, folder: Path | None) -> None:
        self.folder = folder

    def path(self, sha256: str, **parameters: Any) -> Path:
        """File of an entry: one for each content, parameters and version of the code."""
        assert self.folder is not None
        text = json.dumps({"version": code_version(), **parameters}, sort_keys=True)
        tail = hashlib.sha256(text.encode()).hexdigest()[:12]
        return self.folder / f"{sha256}-{tail}.npz"

    def get(self, sha256: str, **parameters: Any) -> dict[str, np.ndarray] | None:
        """Arrays of an entry, or None where there is none that can be read."""
        if self.folder is None or not (path := self.path(sha256, **parameters)).exists():
            return None
        try:
            return read_arrays(path)
        except UserError as error:
            log.warning("made again: %s", error)
            return None

    def put(self, arrays: dict[str, np.ndarray], sha256: str, **parameters: Any) -> None:
        """Keep `arrays`; a folder that cannot be written to is a warning, not an end."""
        if self.folder is None:
            return
        try:
            write_arrays(arrays, self.path(sha256, **parameters))
        except UserError as error:
            log.warning("not cached: %s; $%s names another folder", error, FOLDER_VARIABLE)
