"""What editing is measured on: real clips, paths drawn by formula, and pairs of actions.

Letters: N points.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from ..model.generation.motion_generator import TextToMotion
from ..motion.motion import Motion
from ..pipelines.path import DrawnPath
from .floors import untrained
from .held_out import HeldOut, real_clips
from .samples import Clips

Progress = Callable[[str], None]
MIN_FRAMES, MAX_FRAMES = 90, 150  # of a clip that is edited
RADIUS = 1.5  # metres of the curved paths
ACTIONS = (
    "a person walks forward", "a person waves with the right hand", "a person dances",
    "a person walks backward", "a person squats", "a person runs", "a person bows",
    "a person claps",
)  # fmt: skip


@dataclass(frozen=True)
class EditSettings:
    """How much is measured; the report repeats it."""

    num: int = 24  # clips, and pairs of actions
    repeats: int = 3  # motions along each path
    max_real: int = 200  # clips that the real band is taken from
    untrained: int = 1  # 0 = no such rows
    seed: int = 0


class EditContext:
    """Everything the tables of editing draw on.

    Args:
        generator: the text branch.
        held_out: clips that no training saw.
        settings: how much.
        progress: told what begins.
    """

    def __init__(
        self,
        generator: TextToMotion,
        held_out: HeldOut,
        settings: EditSettings,
        progress: Progress = lambda text: None,
    ) -> None:
        self.generator, self.held_out = generator, held_out
        self.settings, self.progress = settings, progress

    @cached_property
    def clips(self) -> Clips:
        """Real clips to edit, of at least three seconds, spread over label groups.

        Raises:
            UserError: there is none.
        """
        return self._real(self.settings.num, MIN_FRAMES)

    @cached_property
    def real(self) -> list[Motion]:
        """Real clips that say how much a motion may accelerate."""
        return self._real(self.settings.max_real, 16).motions

    def _real(self, number: int, min_frames: int) -> Clips:
        return real_clips(
            self.held_out.data,
            [record for split in self.held_out.records.values() for record in split],
            num=number,
            min_frames=min_frames,
            max_frames=MAX_FRAMES,
            seed=self.settings.seed,
        )

    @cached_property
    def generators(self) -> dict[str, TextToMotion]:
        """By the name of their row."""
        found = {"generated": self.generator}
        if self.settings.untrained:
            found["untrained"] = untrained(self.generator, self.settings.seed)
        return found

    @property
    def pairs(self) -> list[tuple[str, str]]:
        """Actions that follow each other: a walk round a table of all ordered pairs."""
        number, pairs = len(ACTIONS), []
        for index in range(self.settings.num):
            first, step = index % number, 1 + (index // number) % (number - 1)
            pairs.append((ACTIONS[first], ACTIONS[(first + step) % number]))
        return pairs


def drawn_paths() -> dict[str, DrawnPath]:
    """A straight line, a curve, and a figure of eight, in metres."""
    turn = np.linspace(0, 1, 61)
    arc = np.pi * turn
    round_and_back = 2 * np.pi * turn
    return {
        "line": DrawnPath(np.array([[0.0, 0.0], [0.0, 4.0]])),
        "curve": DrawnPath(RADIUS * np.stack((1 - np.cos(arc), np.sin(arc)), axis=1)),
        "figure of eight": DrawnPath(
            RADIUS * np.stack((np.sin(2 * round_and_back) / 2, np.sin(round_and_back)), axis=1)
        ),
    }


def seeds(seed: int, number: int) -> Sequence[int]:
    """A seed for each of `number` motions."""
    return np.random.SeedSequence(seed).generate_state(number).tolist()
