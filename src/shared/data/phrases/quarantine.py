"""The list of phrases that cannot be used, with reasons, kept beside the cache (ruling 17)."""

import threading
from collections.abc import Iterable
from pathlib import Path

from ...errors import UserError
from ...files import load_json, write_json
from .layout import PhraseRecord

_NAMED = 5  # bad phrases named in the error


class Quarantine:
    """Bad phrases of one data set. Thread-safe; the file is shared by processes.

    An entry holds as long as the phrase's content does: once the manifest (or, without one, the
    etag) changes, the phrase is tried again.

    Args:
        path: JSON file with an entry per bad phrase.
        root: of the data, for messages.
        max_bad_fraction: of `phrases`; more is an error.

    Raises:
        UserError: more phrases are known to be bad than that.
    """

    def __init__(
        self, path: Path, root: str, phrases: Iterable[PhraseRecord], max_bad_fraction: float
    ) -> None:
        self.path, self.root, self.max_bad_fraction = path, root, max_bad_fraction
        self._keys = {phrase.id: phrase.key for phrase in phrases}
        self._lock = threading.Lock()
        self.reasons: dict[str, str] = {}
        self._learn(self._read())
        self._require_few()

    def __contains__(self, phrase: str) -> bool:
        return phrase in self.reasons

    def add(self, phrase: PhraseRecord, reason: str, *, keep: bool = True) -> None:
        """Count and name a bad phrase; `keep` saves it for later processes.

        Raises:
            UserError: too many phrases are bad.
        """
        with self._lock:
            self.reasons[phrase.id] = reason
            if keep:
                self._save(phrase, reason)
            self._require_few()

    def _read(self) -> dict[str, dict[str, str]]:
        try:
            saved = load_json(self.path)
            return {name: entry for name, entry in saved["phrases"].items() if "key" in entry}
        except (OSError, ValueError, KeyError, AttributeError, TypeError):
            return {}  # no list yet, or one that a person broke: it fills again

    def _save(self, phrase: PhraseRecord, reason: str) -> None:
        from filelock import FileLock

        self.path.parent.mkdir(parents=True, exist_ok=True)
        with FileLock(self.path.with_suffix(".lock")):
            entries = self._read() | {phrase.id: {"reason": reason, "key": phrase.key}}
            write_json(self.path, {"root": self.root, "phrases": entries})
        self._learn(entries)  # what other processes found meanwhile

    def _learn(self, entries: dict[str, dict[str, str]]) -> None:
        for phrase, entry in entries.items():
            if self._keys.get(phrase) == entry["key"]:
                self.reasons[phrase] = entry["reason"]

    def _require_few(self) -> None:
        bad, total = sorted(self.reasons.items()), len(self._keys)
        if len(bad) <= self.max_bad_fraction * total:
            return
        named = "; ".join(f"{phrase}: {reason}" for phrase, reason in bad[:_NAMED])
        more = f"; and {len(bad) - _NAMED} more in {self.path}" if len(bad) > _NAMED else ""
        raise UserError(
            f"{len(bad)} of {total} phrases of {self.root} are bad, max-bad-fraction is"
            f" {self.max_bad_fraction:g}: {named}{more}; mend them, or remove {self.path}"
            " to try again"
        )

    def __getstate__(self) -> dict[str, object]:
        return {name: value for name, value in self.__dict__.items() if name != "_lock"}

    def __setstate__(self, state: dict[str, object]) -> None:
        self.__dict__.update(state, _lock=threading.Lock())
