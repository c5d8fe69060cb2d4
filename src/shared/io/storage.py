"""Files on any address that fsspec knows, read and written with patience; local paths stay paths.

`place` makes of what somebody typed a `Path`, or an `Address`, which has what is used of a path.
A store has no folders, no locks and no renaming: an object is there whole or not at all.
"""

import base64
import io
import os
import random
import re
import tempfile
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager, suppress
from dataclasses import dataclass, field
from pathlib import Path, PurePosixPath
from typing import Any, TypeVar

from ..errors import UsageError, UserError

Result = TypeVar("Result")

_LIBRARIES = {"aiohttp", "aiobotocore", "botocore", "gcsfs", "google", "requests"}
_TRANSIENT_STATUS = {408, 429}  # of those below 500
_VERSION_MARKS = ("generation", "etag", "ETag", "md5Hash", "mtime", "created", "LastModified")
_PACKAGES = {"gs": "gcsfs", "gcs": "gcsfs", "s3": "s3fs", "s3a": "s3fs"}


BLOCK = 4 << 20  # bytes of long files that are read at a time


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


class Storage:
    """The objects under one address (`gs://`, `s3://`, `memory://`) or folder.

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
            import fsspec  # takes a while, and few commands need it

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

    def run(
        self, action: Callable[[Any, str], Result], path: str = "", *, anew: bool = False
    ) -> Result:
        """`action` of the file system and an object's full path, with patience; `anew`: not out of
        what fsspec remembers. Raises as `Backoff.run`."""
        fs, base = self._open()
        if anew:
            fs.invalidate_cache()
        full = f"{base}/{path}".rstrip("/")
        return self.backoff.run(lambda: action(fs, full), path or self.root)

    def read(self, path: str, start: int | None = None, stop: int | None = None) -> bytes:
        """One object, or its bytes from `start` to `stop`.

        Raises:
            FileNotFoundError: it does not exist.
            Unreachable: see `Backoff.run`.
        """
        from fsspec.asyn import sync

        def attempt(fs: Any, full: str) -> bytes:
            if not fs.async_impl:
                return bytes(fs.cat_file(full, start=start, end=stop))
            read, timeout = fs._cat_file, self.backoff.timeout
            return bytes(sync(fs.loop, read, full, start=start, end=stop, timeout=timeout))

        return self.run(attempt, path)

    def find(self) -> dict[str, dict[str, Any]]:
        """What the store tells of every object under the root, by relative path."""
        found = self.run(lambda fs, base: fs.find(base, detail=True))
        base = self._open()[1]
        return {name[len(base) :].lstrip("/"): info for name, info in found.items()}

    def stored(self, path: str) -> tuple[int, str]:
        """What the store itself says now: size and hex MD5 ("" where it tells none)."""
        info = self.run(lambda fs, full: fs.info(full), path, anew=True)
        return info["size"], md5_of(info)


def md5_of(info: dict[str, Any]) -> str:
    """Hex MD5 of an object, from what a store tells of it; "" where it tells none."""
    if "md5Hash" in info:
        return base64.b64decode(info["md5Hash"]).hex()
    etag = str(info.get("ETag", "")).strip('"')  # S3: the MD5, unless uploaded in parts
    return etag if len(etag) == 32 else ""


def version_of(info: dict[str, Any]) -> str:
    """What changes when an object is written anew, as its store marks that."""
    return " ".join(f"{mark}={info[mark]}" for mark in _VERSION_MARKS if info.get(mark))


# ---------------------------------------------------------------- addresses

_URL = re.compile(r"([a-z][a-z0-9+.-]+):/+")  # a path type has made one slash of two


@dataclass(frozen=True)
class Address:
    """An object of a store, or what lies under it; reads, writes and names it as a `Path` does.

    Raises, in every method that asks the store:
        FileNotFoundError: there is no such object.
        UserError: the store cannot be reached, or does not allow it.
    """

    url: str

    def __str__(self) -> str:
        return self.url

    def __truediv__(self, name: str | PurePosixPath) -> "Address":
        return Address(f"{self.url}/{name}")

    @property
    def name(self) -> str:
        return self._pure.name

    @property
    def stem(self) -> str:
        return self._pure.stem

    @property
    def suffix(self) -> str:
        return self._pure.suffix

    @property
    def parent(self) -> "Address":
        return Address(self.url.rpartition("/")[0])

    @property
    def parts(self) -> tuple[str, ...]:
        return self._pure.parts

    @property
    def _pure(self) -> PurePosixPath:
        return PurePosixPath(self.url.replace("://", "/", 1))

    def with_suffix(self, suffix: str) -> "Address":
        return self.parent / self._pure.with_suffix(suffix).name

    def absolute(self) -> "Address":
        return self

    resolve = absolute

    def find(self) -> dict[str, dict[str, Any]]:
        """What the store tells of every object under it, by relative path."""
        return self._ask(lambda store: store.find())

    def exists(self) -> bool:
        """Whether there is an object, or any under it; asked anew."""
        return bool(self._run(lambda fs, full: fs.exists(full), anew=True))

    def is_file(self) -> bool:
        """Whether there is an object of just this name; asked anew."""
        return bool(self._run(lambda fs, full: fs.isfile(full), anew=True))

    def is_dir(self) -> bool:
        """Whether there are objects under it."""
        return self.exists() and not self.is_file()

    def iterdir(self) -> "Iterator[Address]":
        """All objects under it."""
        return (self / name for name in self.find())

    def open(self, mode: str = "rb") -> io.BytesIO:
        """The object, read whole."""
        assert mode == "rb"
        return io.BytesIO(self.read_bytes())

    def read_bytes(self) -> bytes:
        return self._ask(lambda store: store.read(""))

    def read_range(self, start: int, stop: int) -> bytes:
        """Its bytes from `start` to `stop`."""
        return self._ask(lambda store: store.read("", start, stop))

    def size(self) -> int:
        """Bytes of the object."""
        return self._ask(lambda store: store.stored("")[0])

    def write_bytes(self, data: bytes) -> None:
        self._run(lambda fs, full: fs.pipe_file(full, data))

    def unlink(self, missing_ok: bool = False) -> None:
        """Remove the object."""
        with suppress(*[FileNotFoundError] if missing_ok else []):
            self._run(lambda fs, full: fs.rm_file(full))

    def _run(self, action: Callable[[Any, str], Result], *, anew: bool = False) -> Result:
        return self._ask(lambda store: store.run(action, anew=anew))

    def _ask(self, question: Callable[[Storage], Result]) -> Result:
        try:
            return question(Storage(self.url, backoff=Backoff()))
        except Unreachable as error:
            raise UserError(
                f"{self.url}: {error}; check the address and your credentials"
                " (GOOGLE_APPLICATION_CREDENTIALS for gs://)"
            ) from error


Place = Path | Address


def place(name: str | Path | Address) -> Place:
    """A path of this machine, or an address of a store; file:// is the former."""
    if isinstance(name, Address):
        return name
    match = _URL.match(str(name))
    if match is None:
        return Path(name)
    rest = str(name)[match.end() :].rstrip("/")
    return Path("/" + rest) if match[1] in ("file", "local") else Address(f"{match[1]}://{rest}")


def read_range(path: Place, start: int, stop: int) -> bytes:
    """Bytes of a file from `start` to `stop`."""
    if isinstance(path, Address):
        return path.read_range(start, stop)
    with path.open("rb") as stream:
        stream.seek(start)
        return stream.read(stop - start)


def size_of(path: Place) -> int:
    """Bytes of a file."""
    return path.size() if isinstance(path, Address) else path.stat().st_size


def files_below(folder: Place) -> list[Place]:
    """All files of a folder and of those in it, sorted; none where there is no folder."""
    if isinstance(folder, Address):
        return sorted(folder.iterdir(), key=str) if folder.is_dir() else []
    return [*sorted(path for path in folder.rglob("*") if path.is_file())]


def relative_name(path: Place, folder: Place) -> str:
    """The name of a file as seen from a folder that it lies in, with slashes."""
    return PurePosixPath(*path.parts[len(folder.parts) :]).as_posix()


def read_blocks(path: Place) -> Iterator[bytes]:
    """A file of any length in blocks, so that memory stays bounded."""
    total = size_of(path)
    return (read_range(path, at, min(at + BLOCK, total)) for at in range(0, total, BLOCK))


@contextmanager
def fetched(path: Place) -> Iterator[Path]:
    """The file as one of this machine: itself, or a copy as long as the block lasts.

    Of a motion whose skeleton lies beside it (.amc), the skeletons come along.
    """
    if isinstance(path, Path):
        yield path
        return
    with tempfile.TemporaryDirectory(prefix="motionsuite-") as folder:
        local = Path(folder, path.name)
        local.write_bytes(path.read_bytes())
        if path.suffix.lower() == ".amc":
            for other in path.parent.iterdir():
                if other.suffix.lower() == ".asf" and other.parent == path.parent:
                    Path(folder, other.name).write_bytes(other.read_bytes())
        yield local
