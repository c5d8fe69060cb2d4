"""How far a long command is, and how long it will still take, on stderr."""

import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager

from .guard import is_quiet, tell

LINE_SECONDS = 10.0  # between lines where there is no screen


@contextmanager
def progress_bar(what: str) -> Iterator[Callable[[int, int], None]]:
    """Its value is told (done, in all): a bar on a screen, else a line now and then.

    Args:
        what: is counted, in the plural.
    """
    if is_quiet():
        yield lambda done, total: None
        return
    from rich.console import Console
    from rich.progress import BarColumn, MofNCompleteColumn, Progress, TimeRemainingColumn

    screen = Console(stderr=True)
    if not screen.is_terminal:
        yield lines(what)
        return
    columns = (what, BarColumn(), MofNCompleteColumn(), TimeRemainingColumn())
    with Progress(*columns, console=screen, transient=True) as bar:
        task = bar.add_task(what, total=None)
        yield lambda done, total: bar.update(task, completed=done, total=total)


def lines(what: str) -> Callable[[int, int], None]:
    """Told (done, in all), it says so every `LINE_SECONDS`, with the seconds that are left."""
    began = last = time.monotonic()

    def told(done: int, total: int) -> None:
        nonlocal last
        now = time.monotonic()
        if 0 < done < total and now - last >= LINE_SECONDS:
            left = (now - began) / done * (total - done)
            tell(f"{done} of {total} {what}, about {left:.0f} s left")
            last = now

    return told
