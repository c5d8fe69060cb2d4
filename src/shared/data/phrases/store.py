"""Objects verified on arrival, and fetched once by all threads and processes together."""

import hashlib
import threading
from collections import Counter
from collections.abc import Callable
from typing import TypeVar

from .cache import ObjectCache
from .layout import BadContent, StoredObject
from .remote import Remote

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
