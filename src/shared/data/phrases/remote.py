"""A folder or bucket read through fsspec, with patience for a network that fails now and then."""

import base64
import os
import random
import time
from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Any, TypeVar

from ...errors import UsageError, UserError
from .layout import (
    MANIFEST,
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
        import fsspec

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
        from fsspec.asyn import sync

        fs, base = self._open()
        full = f"{base}/{path}"

        def attempt() -> bytes:
            if fs.async_impl:
                return sync(fs.loop, fs._cat_file, full, timeout=self.backoff.timeout)
            return fs.cat_file(full)

        return self.backoff.run(attempt, path)

    def listing(self) -> dict[str, StoredObject]:
        """Every object under the root, by relative path, with the store's mark of its version."""
        fs, base = self._open()
        found = self.backoff.run(lambda: fs.find(base, detail=True), self.root)
        names = {name[len(base) :].lstrip("/"): info for name, info in found.items()}
        return {
            path: StoredObject(path=path, size=info["size"], version=_version(info), md5=_md5(info))
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
        return info["size"], _md5(info)


def _md5(info: dict[str, Any]) -> str:
    if "md5Hash" in info:
        return base64.b64decode(info["md5Hash"]).hex()
    etag = str(info.get("ETag", "")).strip('"')  # S3: the MD5, unless uploaded in parts
    return etag if len(etag) == 32 else ""


def _version(info: dict[str, Any]) -> str:
    return " ".join(f"{mark}={info[mark]}" for mark in _VERSION_MARKS if info.get(mark))
