"""Objects of a folder or bucket: read through fsspec with patience, cached by content, verified.

The cache is shared by processes: `objects/ab/abcd…` holds the bytes whose SHA-256 is abcd…, and
`refs/` tells, for data without a manifest, which content an object of that size and etag had. Locks
are of the operating system: a killed process leaves none behind. What cannot be used is listed
beside the cache, with reasons (ruling 17).
"""

import base64
import hashlib
import os
import random
import threading
import time
from collections import Counter
from collections.abc import Callable, Iterable
from contextlib import AbstractContextManager, suppress
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, TypeVar

import fsspec
from filelock import FileLock
from fsspec.asyn import sync

from ...errors import UsageError, UserError
from ...io.files import atomic_write, load_json, write_json
from .layout import (
    MANIFEST,
    BadContent,
    PhraseRecord,
    StoredObject,
    parse_manifest,
    phrases_of_listing,
)

Result = TypeVar("Result")

_LIBRARIES = {"aiohttp", "aiobotocore", "botocore", "gcsfs", "google", "requests"}
_TRANSIENT_STATUS = {408, 429}  # of those below 500
_VERSION_MARKS = ("generation", "etag", "ETag", "md5Hash", "mtime", "created", "LastModified")
_PACKAGES = {"gs": "gcsfs", "gcs": "gcsfs", "s3": "s3fs", "s3a": "s3fs"}


class Unreachable(Exception):
    """Not allowed, or the network failed too often; the object itself may be fine."""


@dataclass(frozen=True)
class Backoff:
    """Waits between attempts: exponential, with jitter so that threads do not come back at once.

    Attributes:
        attempts: how often to try at most.
        first, longest: seconds of the first wait and of any wait.
        patience: no further attempt after so many seconds in all.
        timeout: seconds for one attempt.
    """

    attempts: int = 6
    first: float = 0.25
    longest: float = 8.0
    patience: float = 90.0
    timeout: float = 60.0
    sleep: Callable[[float], None] = field(default=time.sleep, repr=False)

    def run(self, action: Callable[[], Result], what: str) -> Result:
        """`action`'s result, after transient errors tried again.

        Raises:
            FileNotFoundError: at once.
            Unreachable: it kept failing, or is not allowed.
        """
        end = time.monotonic() + self.patience
        for attempt in range(1, self.attempts + 1):
            try:
                return action()
            except FileNotFoundError:
                raise
            except Exception as error:
                if not is_of_storage(error):
                    raise
                last = attempt == self.attempts or time.monotonic() > end
                if last or not is_transient(error):
                    reason = f"{type(error).__name__}: {error}"
                    raise Unreachable(f"{what}: {reason} ({attempt} attempts)") from error
            self.sleep(min(self.longest, self.first * 2 ** (attempt - 1)) * random.uniform(0.5, 1))
        raise AssertionError("attempts is at least 1")


def is_of_storage(error: Exception) -> bool:
    """Whether an error comes from storage or the network, not from a mistake of ours."""
    return isinstance(error, OSError) or type(error).__module__.split(".")[0] in _LIBRARIES


def is_transient(error: Exception) -> bool:
    """Whether an error of storage is worth another try: timeouts, broken connections, 5xx."""
    status = str(getattr(error, "code", None) or getattr(error, "status", None) or "")
    if status.isdigit():
        return int(status) >= 500 or int(status) in _TRANSIENT_STATUS
    return not isinstance(error, PermissionError) and "Forbidden" not in str(error)


class Remote:
    """The objects under one URL (`gs://`, `s3://`, `memory://`) or folder.

    Raises:
        UsageError: no such kind of URL.
        UserError: the package for it is not installed.
    """

    def __init__(
        self, root: str, *, storage_options: dict[str, Any] | None = None, backoff: Backoff
    ) -> None:
        self.root = root.rstrip("/")
        self.options = storage_options or {}
        self.backoff = backoff
        self._opened: tuple[int, Any, str] | None = None
        self.local = "file" in self._open()[0].protocol

    def _open(self) -> tuple[Any, str]:
        """File system and base path, anew in a forked process: its connections are not ours."""
        if self._opened is None or self._opened[0] != os.getpid():
            scheme = self.root.split("://")[0]
            try:
                fs, base = fsspec.url_to_fs(self.root, **self.options)
            except ImportError as error:
                package = _PACKAGES.get(scheme, f"fsspec's package for {scheme}://")
                raise UserError(f"cannot read {self.root}: install {package}") from error
            except ValueError as error:
                raise UsageError(
                    f"cannot read {self.root}: {error}; give a folder, gs:// or s3://"
                ) from error
            self._opened = (os.getpid(), fs, base.rstrip("/"))
        return self._opened[1:]

    def __getstate__(self) -> dict[str, Any]:
        return self.__dict__ | {"_opened": None}

    def read(self, path: str) -> bytes:
        """One object.

        Raises:
            FileNotFoundError: it does not exist.
            Unreachable: see `Backoff.run`.
        """
        fs, base = self._open()
        full = f"{base}/{path}"

        def attempt() -> bytes:
            if fs.async_impl:
                found = sync(fs.loop, fs._cat_file, full, timeout=self.backoff.timeout)
            else:
                found = fs.cat_file(full)
            return bytes(found)

        return self.backoff.run(attempt, path)

    def listing(self) -> dict[str, StoredObject]:
        """Every object under the root, by relative path, with the store's mark of its version."""
        fs, base = self._open()
        found = self.backoff.run(lambda: fs.find(base, detail=True), self.root)
        names = {name[len(base) :].lstrip("/"): info for name, info in found.items()}
        return {
            path: StoredObject(
                path=path, size=info["size"], version=_version(info), md5=_stored_md5(info)
            )
            for path, info in names.items()
        }

    def phrases(self) -> list[PhraseRecord]:
        """Phrases of the manifest, or of the listing where there is none, sorted by name.

        Raises:
            UserError: the manifest is broken, or nothing can be read.
        """
        try:
            try:
                found = parse_manifest(self.read(MANIFEST), f"{self.root}/{MANIFEST}")
            except FileNotFoundError:
                found = phrases_of_listing(self.listing())
        except (FileNotFoundError, Unreachable) as error:
            raise UserError(
                f"cannot read {self.root}: {error}; check the address and your credentials"
                " (GOOGLE_APPLICATION_CREDENTIALS for gs://)"
            ) from error
        return sorted(found, key=lambda phrase: phrase.id)

    def stored(self, path: str) -> tuple[int, str]:
        """What the store itself says now: size and hex MD5 ("" where it tells none)."""
        fs, base = self._open()
        fs.invalidate_cache()
        info = self.backoff.run(lambda: fs.info(f"{base}/{path}"), path)
        return info["size"], _stored_md5(info)


def _stored_md5(info: dict[str, Any]) -> str:
    if "md5Hash" in info:
        return base64.b64decode(info["md5Hash"]).hex()
    etag = str(info.get("ETag", "")).strip('"')  # S3: the MD5, unless uploaded in parts
    return etag if len(etag) == 32 else ""


def _version(info: dict[str, Any]) -> str:
    return " ".join(f"{mark}={info[mark]}" for mark in _VERSION_MARKS if info.get(mark))


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

    def __init__(self, folder: Path, *, max_bytes: int | None = None) -> None:
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
        """Keep the verified bytes of an object.

        Raises:
            UserError: the cache cannot be written.
        """
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

_COUNTING = threading.Lock()


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
        right = len(data) == obj.size and (not obj.md5 or _md5(data) == obj.md5)
        if obj.sha256:
            right = right and hashlib.sha256(data).hexdigest() == obj.sha256
        if right:
            return
        known = "the manifest" if obj.sha256 else "the listing"
        size, md5 = self.remote.stored(obj.path)
        if len(data) < size:
            raise BadContent(f"truncated: {len(data)} of {size} bytes")
        if md5 == _md5(data) or size != obj.size:
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
