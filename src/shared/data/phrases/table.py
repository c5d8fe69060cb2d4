"""The phrases of a set on disk: in memory is only where each is, 16 bytes a phrase."""

import hashlib
import os
import tempfile
import weakref
from array import array
from bisect import bisect_left
from collections.abc import Iterable, Sequence
from functools import cached_property
from pathlib import Path
from typing import IO, Any, overload

from ...errors import UserError
from .layout import PhraseRecord


class PhraseTable(Sequence[PhraseRecord]):
    """Phrases by name, in a temporary file that goes when this does.

    Args:
        phrases: in any order; that of the names costs no memory.
        most: keep only the first so many.
        where: they come from, for messages.

    Raises:
        UserError: two have one name.
    """

    def __init__(self, phrases: Iterable[PhraseRecord], most: int | None, where: str) -> None:
        self._begins, self._ends = array("q"), array("q")
        last, ordered = "", True
        with self._new_file() as stream:
            for phrase in phrases:
                self._begins.append(stream.tell())
                stream.write(phrase.model_dump_json(exclude_unset=True).encode())
                self._ends.append(stream.tell())
                ordered, last = ordered and last < phrase.id, phrase.id
        if not ordered:
            self._sort(where)
        if most is not None:
            del self._begins[most:], self._ends[most:]

    def _new_file(self) -> IO[bytes]:
        handle, name = tempfile.mkstemp(prefix="motionsuite-", suffix=".jsonl")
        self._path = Path(name)
        weakref.finalize(self, self._path.unlink, missing_ok=True)
        return os.fdopen(handle, "wb")

    def _sort(self, where: str) -> None:
        names = [phrase.id for phrase in self]
        if len(set(names)) < len(names):
            raise UserError(f"{where} names a phrase twice; write it again with prepare-audio")
        order = sorted(range(len(names)), key=names.__getitem__)
        for places in (self._begins, self._ends):
            places[:] = array("q", [places[number] for number in order])

    @cached_property
    def fingerprint(self) -> str:
        """Changes when any phrase's content or the selection of phrases does."""
        digest = hashlib.sha256()
        for phrase in self:
            digest.update(f"{phrase.id} {phrase.key}\n".encode())
        return digest.hexdigest()

    def __len__(self) -> int:
        return len(self._begins)

    @overload
    def __getitem__(self, index: int) -> PhraseRecord: ...
    @overload
    def __getitem__(self, index: slice) -> list[PhraseRecord]: ...
    def __getitem__(self, index: int | slice) -> PhraseRecord | list[PhraseRecord]:
        if isinstance(index, slice):
            return [self[number] for number in range(*index.indices(len(self)))]
        begin, end = self._begins[index], self._ends[index]
        with self._path.open("rb") as stream:  # anew: threads and processes read at once
            stream.seek(begin)
            return PhraseRecord.model_validate_json(stream.read(end - begin))

    def named(self, name: str) -> PhraseRecord | None:
        """The phrase of this name."""
        index = bisect_left(self, name, key=lambda phrase: phrase.id)
        found = self[index] if index < len(self) else None
        return found if found is not None and found.id == name else None

    def __getstate__(self) -> dict[str, Any]:
        return self.__dict__ | {"_path": self._path.read_bytes()}

    def __setstate__(self, state: dict[str, Any]) -> None:
        self.__dict__.update(state)
        with self._new_file() as stream:
            stream.write(state["_path"])
