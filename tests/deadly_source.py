"""A source of clips whose reader dies on the way, once."""

import os
import signal
from dataclasses import dataclass, field
from pathlib import Path

from src.shared.data.sources import RawClip, SyntheticSource


@dataclass(frozen=True)
class DeadlySource(SyntheticSource):
    """The process that reads clip `deadly` is killed, unless the file `died` is there."""

    deadly: str = ""
    died: Path = field(default=Path(), repr=False)

    def read(self, item: str) -> RawClip:
        if item == self.deadly and not self.died.exists():
            self.died.touch()
            os.kill(os.getpid(), signal.SIGKILL)
        return super().read(item)
