"""Signals answered for the length of a block."""

import signal
import sys
import threading
from collections.abc import Iterator
from contextlib import AbstractContextManager, contextmanager
from types import FrameType
from typing import Any


@contextmanager
def answered(number: int, answer: Any) -> Iterator[None]:
    """Answer a signal with `answer` inside; processes that start there inherit an ignored one."""
    if threading.current_thread() is not threading.main_thread():
        yield  # signals stay with whoever runs it
        return
    before = signal.signal(number, answer)
    try:
        yield
    finally:
        signal.signal(number, before)


def orderly_termination() -> AbstractContextManager[None]:
    """Let SIGTERM end the program as an error would: workers end, half-written files go."""
    return answered(signal.SIGTERM, _leave)


def _leave(number: int, _frame: FrameType | None) -> None:
    sys.exit(128 + number)
