"""What of a clause leads the root: its angle, its circles, its metres, the way that it bends.

A way is timed by the gait that the network has when nobody leads it, and keeps its sway.
"""

import logging
import math
from collections.abc import Callable
from dataclasses import replace
from functools import partial

import numpy as np

from ..errors import UserError
from ..model.diffusion import Sampling
from ..model.generation.constraint import Constraint
from ..model.generation.motion_generator import TextToMotion
from ..motion.features import ROOT_ROW, YAW_RATE
from ..tensors import Tensor, torch
from .clause import GOING, STEPPING, Clause
from .path import (
    TURN_REST,
    DrawnPath,
    Gait,
    circled,
    natural_gait,
    natural_sway,
    on_the_spot,
    time_of_steps,
    time_path,
    turned,
)
from .stream import WINDOW, Passage, stream_features
from .words import all_words, side_of

SPIN_SPEED = 120.0  # degrees a second, about, where a number of seconds is to be filled
CORNER, CORNER_SECONDS = 90.0, 2.3  # led so, it turns in 1.95 s; captured walks in 1.9
TAKES = 3.0  # seconds of what is done once
WINDING_SPEED = 75.0  # the same, of ways with a name: wide enough to be seen
EIGHT, WINDS = (360.0, -360.0), (45.0, -90.0, 90.0, -90.0, 45.0)  # degrees, of ways with a name
TURN_SECONDS, TURNING = 2.2, math.radians(20.0)  # of a led quarter on the spot; a second, at least

log = logging.getLogger(__name__)


def goes_round(text: str) -> bool:
    """Whether a text tells of a way in a circle."""
    return bool(all_words().round.search(text)) and not all_words().corner.search(text)


def winding(text: str) -> tuple[float, ...]:
    """The degrees of a way in a figure of eight, or from side to side; none where a text names
    neither."""
    words = all_words()
    return EIGHT if words.eights.search(text) else WINDS if words.winds.search(text) else ()


def unwound(text: str) -> str:
    """A text without the words that name such a way."""
    words = all_words()
    return words.eights.sub(" ", words.winds.sub(" ", text)).strip()


class Ways:
    """The ways that a model's clauses lead.

    Args:
        generator: the model.
        nearest: the action that a text asks for.
    """

    def __init__(self, generator: TextToMotion, nearest: Callable[[str], str | None]) -> None:
        self.generator, self.nearest, self.fps = generator, nearest, generator.card.fps
        self._bent, self._gaits = dict[str, float](), dict[tuple[str, Sampling, str | None], Gait]()

    def gait(self, text: str, sampling: Sampling, tag: str | None = None) -> Gait:
        """How a text goes where nothing leads it; sampled once."""
        if (key := (text, sampling, tag)) not in self._gaits:
            self._gaits[key] = natural_gait(self.generator, Passage(text, 1, tag), sampling)
        return self._gaits[key]

    def ahead(self, text: str, rest: str) -> str:
        """The text, or the rest of it, where only that goes ahead."""
        for each in (text, rest):
            gait = self.gait(each, Sampling())
            if not gait.stands and abs(gait.facing) < math.pi / 2:
                return each
        return text

    def bends(self, text: str) -> tuple[float, ...]:
        """Degrees, positive to the left, by which a walk or a run turns that is to turn, one after
        the other: if what the network makes of it turns, and does not stop turning (experiments,
        section 44)."""
        if self.nearest(text) not in GOING:
            return ()
        if (named := winding(text)) or (side_of(text) == "both" and not goes_round(text)):
            return named
        if text not in self._bent:
            turning = self.gait(text, Sampling()).turning
            left = turning > 0 if (side := side_of(text)) == "both" else side == "left"
            angle = 360.0 if goes_round(text) else 0.0 if abs(turning) < TURNING else CORNER
            self._bent[text] = angle if left else -angle
        return (self._bent[text],) if self._bent[text] else ()

    def turn(self, clause: Clause, seconds: float, sampling: Sampling) -> Constraint:
        """By the angle that is named; round a corner or in a circle; else in full circles, as many
        as are named or as fill the seconds, to the side that is named or that the seed says."""
        fps, turns = self.fps, self.nearest(clause.text) == "turn"
        if clause.degrees is not None:
            given = turned(clause.degrees, fps, clause.seconds)
            return on_the_spot(given) if turns else given
        side = side_of(clause.text)
        if turns and side != "both":
            angle = CORNER * clause.count * (1 if side == "left" else -1)
            rest = max((seconds - TURN_SECONDS) / 2, TURN_REST)
            time = (clause.seconds,) if clause.count > 1 else (seconds, rest)
            return on_the_spot(turned(angle, fps, *time))
        if bends := self.bends(clause.text):
            if clause.seconds is None:
                speed = SPIN_SPEED if len(bends) == 1 else WINDING_SPEED
                seconds = max(seconds, sum(map(abs, bends)) / speed + 2 * TURN_REST)
            if bends in ((CORNER,), (-CORNER,)):
                rest = max((seconds - CORNER_SECONDS) / 2, TURN_REST)
                given = turned(bends[0], fps, seconds, rest)
            else:
                given = circled(bends, fps, seconds)
            sway = self.sway(Passage(clause.text, len(given)), sampling)
            given.values[:, ROOT_ROW, YAW_RATE] += torch.as_tensor(sway)
            return given
        circles, around = clause.count, 360.0 / SPIN_SPEED
        if circles == 1:
            circles = max(round((seconds - 2 * TURN_REST) / around), 1)
        elif clause.seconds is None:
            seconds = circles * around + 2 * TURN_REST
        left = sampling.seed % 2 == 0 if side == "both" else side == "left"
        return turned(360.0 * (circles if left else -circles), fps, seconds)

    def led(
        self, passage: Passage, clause: Clause, sampling: Sampling, *, timed: bool
    ) -> Constraint:
        """So many metres, at the pace and in the direction that are the clause's own; in its
        seconds, unless nobody goes so fast and it is not `timed`.

        Raises:
            UserError: nobody goes so fast, and it is `timed`.
        """
        if not clause.metres:
            return on_the_spot(Constraint.free(passage.frames))
        speed, facing, *_ = self.gait(passage.text, sampling, passage.tag)
        ahead = np.array([[0.0, 0.0], [0.0, clause.metres]])
        fps, seconds = self.fps, clause.seconds
        last = None if seconds is None else max(seconds * fps - 1, 1) / fps
        pace = partial(time_path, DrawnPath(ahead), fps=fps, speed=speed, facing=facing)
        try:
            path = pace(seconds=last)
        except UserError as error:
            if timed:
                raise UserError(f"{passage.text!r}: {error}") from None
            log.warning("%r: %s; until then it takes its own time", passage.text, error)
            path = pace(seconds=None)
        return path.swaying(self.sway(replace(passage, frames=len(path)), sampling)).constraint()

    def lasting(self, clause: Clause) -> float:
        """Seconds of a clause that nothing leads, with more behind it."""
        steps = clause.steps if self.nearest(clause.text) in STEPPING else None
        if clause.seconds or not (clause.metres or steps):
            return clause.seconds or clause.count * clause.lasting(TAKES)
        speed = self.gait(clause.text, Sampling()).speed
        return time_of_steps(steps, speed) if steps else (clause.metres or 0.0) / speed

    def goes_straight(self, text: str) -> bool:
        """Whether a text asks for a way that nothing in it bends."""
        action, bent = self.nearest(text), side_of(text) != "both" or winding(text) != ()
        return action in STEPPING and not goes_round(text) and not (bent and action in GOING)

    def straight(self, text: str, features: Tensor) -> Tensor:
        """Features that nothing led, [T,23,6]: who goes on for longer than a window, and does not
        turn in the mean, goes straight on. Drift bends a minute's walk by up to 200 degrees."""
        rate = features[:, ROOT_ROW, YAW_RATE]
        if self.nearest(text) not in STEPPING or len(rate) <= WINDOW or abs(rate.mean()) >= TURNING:
            return features
        straight = features.clone()
        straight[:, ROOT_ROW, YAW_RATE] = torch.as_tensor(natural_sway(features, self.fps))
        return straight

    def sway(self, passage: Passage, sampling: Sampling) -> np.ndarray:
        """Of its heading, radians a second [T], about the way that it goes."""
        free = [*stream_features(self.generator, [passage], sampling)]
        return natural_sway(torch.cat(free), self.fps)
