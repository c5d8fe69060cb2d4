"""Threads that work ahead, and signals answered for the length of a block."""

import functools
import os
import signal
import sys
import threading
from collections import deque
from collections.abc import Callable, Iterable, Iterator
from concurrent.futures import Future, ThreadPoolExecutor
from contextlib import contextmanager
from types import FrameType
from typing import Any, TypeVar

Key = TypeVar("Key")
Value = TypeVar("Value")
LATER = 0.05  # seconds


def prefetch(
    function: Callable[[Key], Value], keys: Iterable[Key], threads: int, depth: int = 0
) -> Iterator[Value]:
    """`map(function, keys)` in order, computed in threads up to `depth` keys ahead.

    Args:
        function: a pure function of its key, so that threads cannot change the result.
        keys: read as they are needed.
        threads: 0 = on demand, in the caller's thread.
        depth: at least as many as there are threads.
    """
    if threads == 0:
        yield from map(function, keys)
        return
    with ThreadPoolExecutor(threads, thread_name_prefix="prefetch") as pool:
        queue: deque[Future[Value]] = deque()
        try:
            for key in keys:
                queue.append(pool.submit(function, key))
                if len(queue) > max(threads, depth):
                    yield queue.popleft().result()
            while queue:
                yield queue.popleft().result()
        finally:
            for future in queue:
                future.cancel()


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


@contextmanager
def orderly_termination() -> Iterator[None]:
    """Let SIGTERM end the program as an error would: workers end, half-written files go.
    Ctrl-C does so anyhow, but in a finalizer or a callback of the interpreter's."""
    with answered(signal.SIGTERM, _leave):
        if signal.getsignal(signal.SIGINT) is signal.default_int_handler:  # not ignored
            with answered(signal.SIGINT, _leave):
                yield
        else:
            yield


def _leave(number: int, frame: FrameType | None) -> None:
    if _is_finalizing(frame):
        _send_again(number)
        return
    sys.unraisablehook = functools.partial(_unraisable, number)
    if number == signal.SIGINT:
        raise KeyboardInterrupt
    sys.exit(128 + number)


def _is_finalizing(frame: FrameType | None) -> bool:
    """Whether a signal has interrupted a `__del__`, `_unraisable`, or what they call."""
    while frame is not None and frame.f_code.co_name not in ("__del__", _unraisable.__name__):
        frame = frame.f_back
    return frame is not None


def _unraisable(number: int, error: "sys.UnraisableHookArgs") -> None:
    """Finalizers of what is half built complain, which is no news once the program ends; a signal
    that met a callback has ended nothing, and comes again."""
    if error.exc_type in (KeyboardInterrupt, SystemExit):
        _send_again(number)


def _send_again(number: int) -> None:
    """The signal once more, a little later: where it came an exception ends nothing."""
    again = threading.Timer(LATER, os.kill, (os.getpid(), number))
    again.daemon = True
    again.start()
