"""A figure of a dance: what is danced when, on which counts."""

from dataclasses import dataclass
from typing import Any


@dataclass(frozen=True)
class Danced:
    """A figure in a dance.

    Attributes:
        name: the take that it is from, and the second at which it begins there.
        kind: of dance.
        times: seconds of its n counts, and of its end [n+1].
        mirrored: left and right swapped.
        part: a letter for each phrase of a take, in the order that they are first danced; a' is the
            mirror image of a.
    """

    name: str
    kind: str
    times: tuple[float, ...]
    mirrored: bool
    part: str

    @property
    def start(self) -> float:
        """Second of the first count."""
        return self.times[0]

    @property
    def stop(self) -> float:
        """Second at which it ends."""
        return self.times[-1]

    def told(self) -> dict[str, Any]:
        """As plain values."""
        return {
            "name": self.name,
            "kind": self.kind,
            "start": round(self.start, 3),
            "stop": round(self.stop, 3),
            "counts": len(self.times) - 1,
            "mirrored": self.mirrored,
            "part": self.part,
        }
