"""A local cache of objects named by their content, shared by processes, verified on every read.

`objects/ab/abcd…` holds the bytes whose SHA-256 is abcd…; `refs/` tells, for data without a
manifest, which content an object of that size and etag had. Locks are of the operating system: a
killed process leaves none behind.
"""

import hashlib
import os
import time
from contextlib import AbstractContextManager, suppress
from pathlib import Path

from ...files import atomic_write, load_json, write_json
from .layout import StoredObject

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
        from filelock import FileLock

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
