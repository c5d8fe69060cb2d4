"""Objects of a folder or bucket: read through fsspec with patience, cached by content, verified.

The cache is shared by processes: `objects/ab/abcd…` holds the bytes whose SHA-256 is abcd…, and
`refs/` tells, for data without a manifest, which content an object of that size and etag had. Locks
are of the operating system: a killed process leaves none behind. What cannot be used is listed
beside the cache, with reasons (ruling 17).
"""

import hashlib
import os
import threading
import time
from collections import Counter
from collections.abc import Callable, Iterator
from contextlib import AbstractContextManager, suppress
from pathlib import Path
from typing import TypeVar

from filelock import FileLock

from ...errors import UserError
from ...io.files import atomic_write, load_json, write_json
from ...io.storage import BLOCK, Storage, Unreachable, md5_of, version_of
from .layout import (
    MANIFEST,
    BadContent,
    PhraseRecord,
    PhraseTable,
    StoredObject,
    parse_manifest,
    phrases_of_listing,
)


class Remote(Storage):
    """The phrases of a folder or bucket."""

    def listing(self) -> dict[str, StoredObject]:
        """Every object under the root, by relative path, with the store's mark of its version."""
        return {
            path: StoredObject(
                path=path, size=info["size"], version=version_of(info), md5=md5_of(info)
            )
            for path, info in self.find().items()
        }

    def phrases(self) -> Iterator[PhraseRecord]:
        """Phrases of the manifest, read as they are needed, or, without one, of the listing.

        Raises:
            UserError: the manifest is broken, or nothing can be read.
        """
        try:
            try:
                size = self.stored(MANIFEST)[0]
            except FileNotFoundError:
                yield from phrases_of_listing(self.listing())
                return
            blocks = (
                self.read(MANIFEST, at, min(at + BLOCK, size)) for at in range(0, size, BLOCK)
            )
            yield from parse_manifest(blocks, f"{self.root}/{MANIFEST}")
        except (FileNotFoundError, Unreachable) as error:
            raise UserError(
                f"cannot read {self.root}: {error}; check the address and your credentials"
                " (GOOGLE_APPLICATION_CREDENTIALS for gs://)"
            ) from error


CACHE_BYTES = 20 << 30  # of downloads that are kept, if nobody says otherwise
_STALE_SECONDS = 3600.0  # an unfinished file that old was left by a killed process


def default_cache() -> Path:
    """Where downloads are kept."""
    base = os.environ.get("XDG_CACHE_HOME") or Path.home() / ".cache"
    return Path(base) / "motionsuite" / "phrases"


class ObjectCache:
    """Content-addressed files in `folder`.

    Args:
        max_bytes: evict what was not used for longest beyond this; None keeps everything.
    """

    def __init__(self, folder: Path, *, max_bytes: int | None = CACHE_BYTES) -> None:
        self.folder, self.max_bytes = Path(folder), max_bytes
        self._written = 0
        for part in self.folder.glob("objects/*/.*.part"):
            with suppress(OSError):
                if time.time() - part.stat().st_mtime > _STALE_SECONDS:
                    part.unlink()

    def lock(self, obj: StoredObject) -> AbstractContextManager[object]:
        """Held by the one thread of one process that downloads this object (or a few others)."""
        folder = self.folder / "locks"
        folder.mkdir(parents=True, exist_ok=True)
        return FileLock(folder / obj.key[:2])

    def get(self, obj: StoredObject) -> bytes | None:
        """The object's bytes; None when they are not here or no longer what was written."""
        digest = obj.sha256 or self._ref(obj)
        if not digest:
            return None
        path = self._path(digest)
        try:
            data = path.read_bytes()
        except OSError:
            return None
        if hashlib.sha256(data).hexdigest() != digest:  # the disk, or someone, changed it
            path.unlink(missing_ok=True)
            return None
        if self.max_bytes is not None:
            with suppress(OSError):
                os.utime(path)
        return data

    def put(self, obj: StoredObject, data: bytes) -> None:
        """Keep the verified bytes of an object; raises UserError where they cannot be written."""
        digest = hashlib.sha256(data).hexdigest()
        with atomic_write(self._path(digest)) as temporary:
            temporary.write_bytes(data)
        if not obj.sha256:
            write_json(self._ref_path(obj), obj.model_dump() | {"sha256": digest})
        self._written += len(data)
        if self.max_bytes is not None and self._written > self.max_bytes // 20:
            self._written = 0
            self._evict(self.max_bytes)

    def _path(self, digest: str) -> Path:
        return self.folder / "objects" / digest[:2] / digest

    def _ref_path(self, obj: StoredObject) -> Path:
        return self.folder / "refs" / obj.key[:2] / f"{obj.key}.json"

    def _ref(self, obj: StoredObject) -> str:
        try:
            return str(load_json(self._ref_path(obj))["sha256"])
        except (OSError, ValueError, LookupError, TypeError):
            return ""

    def _evict(self, limit: int) -> None:
        """Remove the least recently used files until nine tenths of the limit are kept."""
        files = []
        for path in self.folder.glob("objects/*/[0-9a-f]*"):
            with suppress(OSError):  # another process evicts too
                stat = path.stat()
                files.append((stat.st_mtime, stat.st_size, path))
        total = sum(size for _, size, _ in files)
        if total <= limit:
            return
        for _, size, path in sorted(files):
            with suppress(OSError):
                path.unlink()
            total -= size
            if total <= limit * 0.9:
                break


Value = TypeVar("Value")

_COUNTING, _ADDING = threading.Lock(), threading.Lock()  # here: what holds one is not pickled


class PhraseStore:
    """What a remote holds, through a cache where there is one.

    Attributes:
        counts: `downloads`, their `bytes`, `retries` of content that was not right, cache `hits`.
    """

    def __init__(self, remote: Remote, cache: ObjectCache | None) -> None:
        self.remote, self.cache = remote, cache
        self.counts: Counter[str] = Counter()

    def load(self, obj: StoredObject, decode: Callable[[bytes], Value]) -> Value:
        """The decoded object.

        Raises:
            BadContent: missing, damaged, overwritten or of wrong content, twice.
            Unreachable: the network kept failing.
        """
        if self.cache is None:
            return self._download(obj, decode)[1]
        data = self.cache.get(obj)
        if data is None:
            with self.cache.lock(obj):
                data = self.cache.get(obj)  # another thread or process may have been faster
                if data is None:
                    data, value = self._download(obj, decode)
                    self.cache.put(obj, data)
                    return value
        self._count(hits=1)
        return decode(data)

    def _download(self, obj: StoredObject, decode: Callable[[bytes], Value]) -> tuple[bytes, Value]:
        """Bytes and their meaning; what is not right gets a second chance (ruling 17)."""
        for chance in (1, 2):
            try:
                data = self.remote.read(obj.path)
                self._count(downloads=1, bytes=len(data))
                self._verify(obj, data)
                return data, decode(data)
            except FileNotFoundError as error:
                raise BadContent(f"{obj.path} is missing") from error
            except BadContent as error:
                if chance == 2:
                    raise BadContent(f"{obj.path}: {error}") from error
                self._count(retries=1)
        raise AssertionError("the second chance returns or raises")

    def _verify(self, obj: StoredObject, data: bytes) -> None:
        """Compare with the manifest, or the listing; if unequal, ask the store what it has."""
        if obj.sha256:
            right = hashlib.sha256(data).hexdigest() == obj.sha256
        else:
            right = len(data) == obj.size and (not obj.md5 or _md5(data) == obj.md5)
        if right:
            return
        known = "the manifest" if obj.sha256 else "the listing"
        size, md5 = self.remote.stored(obj.path)
        if len(data) < size:
            raise BadContent(f"truncated: {len(data)} of {size} bytes")
        if md5 == _md5(data) or (obj.size and size != obj.size):
            raise BadContent(f"overwritten: {size} bytes that {known} does not describe")
        if md5:
            raise BadContent(f"damaged on the way: not the content that {known} describes")
        raise BadContent(f"overwritten or damaged: not the content that {known} describes")

    def _count(self, **more: int) -> None:
        with _COUNTING:
            self.counts.update(more)


def _md5(data: bytes) -> str:
    return hashlib.md5(data, usedforsecurity=False).hexdigest()


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
        self, path: Path, root: str, phrases: PhraseTable, max_bad_fraction: float
    ) -> None:
        self.path, self.root, self.max_bad_fraction = path, root, max_bad_fraction
        self._phrases = phrases
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
        with _ADDING:
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
        self.path.parent.mkdir(parents=True, exist_ok=True)
        with FileLock(self.path.with_suffix(".lock")):
            entries = self._read() | {phrase.id: {"reason": reason, "key": phrase.key}}
            write_json(self.path, {"root": self.root, "phrases": entries})
        self._learn(entries)  # what other processes found meanwhile

    def _learn(self, entries: dict[str, dict[str, str]]) -> None:
        for phrase, entry in entries.items():
            known = self._phrases.named(phrase)
            if known is not None and known.key == entry["key"]:
                self.reasons[phrase] = entry["reason"]

    def _require_few(self) -> None:
        bad, total = sorted(self.reasons.items()), len(self._phrases)
        if len(bad) <= self.max_bad_fraction * total:
            return
        named = "; ".join(f"{phrase}: {reason}" for phrase, reason in bad[:_NAMED])
        more = f"; and {len(bad) - _NAMED} more in {self.path}" if len(bad) > _NAMED else ""
        raise UserError(
            f"{len(bad)} of {total} phrases of {self.root} are bad, max-bad-fraction is"
            f" {self.max_bad_fraction:g}: {named}{more}; mend them, or remove {self.path}"
            " to try again"
        )
