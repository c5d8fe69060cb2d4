"""A disk that is full, without one: the system lets this process write no long file."""

from collections.abc import Iterator
from contextlib import contextmanager

import pytest


@contextmanager
def full_disk(room: int = 1000) -> Iterator[None]:
    """No file grows beyond `room` bytes; writing more fails as on a full disk, in other words."""
    resource = pytest.importorskip("resource")  # POSIX; Python ignores the signal that goes with it
    soft, hard = resource.getrlimit(resource.RLIMIT_FSIZE)
    resource.setrlimit(resource.RLIMIT_FSIZE, (room, hard))
    try:
        yield
    finally:
        resource.setrlimit(resource.RLIMIT_FSIZE, (soft, hard))
