"""Timings taken in turns, so that rivals see the same machine.

Every round runs all candidates once, forwards and backwards by turns. Processor seconds are told
beside wall seconds: on a busy machine they are the fairer ones.
"""

import statistics
import time
from collections.abc import Callable, Mapping
from dataclasses import asdict, dataclass
from typing import Any


@dataclass(frozen=True)
class Timing:
    """Medians over the rounds, and every round's wall seconds."""

    wall: float
    processor: float
    all_wall: tuple[float, ...]


def in_turns(
    runs: Mapping[str, Callable[[], object]], rounds: int, *, warm_up: int = 1
) -> dict[str, Timing]:
    """Time each callable once a round; the first `warm_up` rounds do not count."""
    measured: dict[str, list[tuple[float, float]]] = {name: [] for name in runs}
    for number in range(warm_up + rounds):
        for name in list(runs) if number % 2 == 0 else list(reversed(runs)):
            wall, processor = time.perf_counter(), time.process_time()
            runs[name]()
            spent = time.perf_counter() - wall, time.process_time() - processor
            if number >= warm_up:
                measured[name].append(spent)
    return {
        name: Timing(
            statistics.median(wall for wall, _ in values),
            statistics.median(processor for _, processor in values),
            tuple(wall for wall, _ in values),
        )
        for name, values in measured.items()
    }


def as_rows(timings: Mapping[str, Timing]) -> dict[str, dict[str, Any]]:
    """Ready for JSON."""
    return {name: asdict(timing) for name, timing in timings.items()}


def ratio(timings: Mapping[str, Timing], slow: str, fast: str) -> dict[str, float]:
    """How many times faster the second one is: by wall and by processor seconds."""
    first, second = timings[slow], timings[fast]
    return {
        "wall": first.wall / second.wall,
        "processor": first.processor / second.processor,
    }
