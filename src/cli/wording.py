"""Small sentences that several commands say."""

from collections.abc import Iterable
from pathlib import Path

from .guard import tell


def counted(number: int, noun: str) -> str:
    """`1 motion`, `2 motions`."""
    return f"{number} {noun}" if number == 1 else f"{number} {noun}s"


def note_replaced(paths: Iterable[Path], folder: Path) -> None:
    """Before writing: say how many of these files an earlier run has left in the folder."""
    if found := sum(path.exists() for path in paths):
        verb = "is" if found == 1 else "are"
        tell(f"note: {counted(found, 'file')} of an earlier run in {folder} {verb} replaced")
