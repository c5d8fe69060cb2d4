"""`map` in threads, some items ahead of who asks for them."""

from collections import deque
from collections.abc import Callable, Iterable, Iterator
from concurrent.futures import Future, ThreadPoolExecutor
from typing import TypeVar

Key = TypeVar("Key")
Value = TypeVar("Value")


def ahead(
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
    with ThreadPoolExecutor(threads, thread_name_prefix="ahead") as pool:
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
