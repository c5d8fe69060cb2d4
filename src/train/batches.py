"""Batches made ahead of time in threads, and moved to the device."""

from collections import deque
from collections.abc import Callable, Iterator
from concurrent.futures import Future, ThreadPoolExecutor
from dataclasses import fields, is_dataclass, replace
from typing import Any, TypeVar

import torch
from torch import Tensor

Key = TypeVar("Key")


def to_device(value: Any, device: torch.device) -> Any:
    """Move every tensor inside dicts, lists, tuples and dataclasses; leave the rest."""
    if isinstance(value, Tensor):
        return value.to(device, non_blocking=True)
    if isinstance(value, dict):
        return {key: to_device(item, device) for key, item in value.items()}
    if isinstance(value, list | tuple) and any(isinstance(v, Tensor | dict) for v in value):
        return type(value)(to_device(item, device) for item in value)
    if is_dataclass(value) and not isinstance(value, type):
        moved = {f.name: to_device(getattr(value, f.name), device) for f in fields(value) if f.init}
        return replace(value, **moved)
    return value


def ahead(make: Callable[[Key], Any], keys: Iterator[Key], workers: int) -> Iterator[Any]:
    """`map(make, keys)`, computed up to `workers` items ahead in threads; 0 = on demand.

    `make` must be a pure function of its key, which is why threads cannot change the result.
    """
    if workers == 0:
        yield from map(make, keys)
        return
    with ThreadPoolExecutor(workers, thread_name_prefix="batch") as pool:
        queue: deque[Future[Any]] = deque()
        try:
            for key in keys:
                queue.append(pool.submit(make, key))
                if len(queue) > workers:
                    yield queue.popleft().result()
            while queue:
                yield queue.popleft().result()
        finally:
            for future in queue:
                future.cancel()
