"""Tables of the performer with rows of their own: beats against everything else, and seams."""

from collections.abc import Callable

import numpy as np

from ..metrics.rhythm import body_beats, limb_beats
from ..motion.motion import Motion
from .audio_alignment import Danced, alignment_rows
from .audio_tables import alignment_grids
from .dance_context import DanceContext
from .dance_sample import BodyDance
from .dance_seams import hard_cuts, seam_grid
from .report.tables import Grid

Find = Callable[[Motion], np.ndarray]


def alignment_tables(context: DanceContext) -> list[Grid]:
    """Whole bodies and limbs on their own songs, and on what must score less."""
    made = context.danced("generated", 0).dances
    groups: dict[str, tuple[list[BodyDance], Find]] = {
        "whole-body": (made, body_beats),
        "limbs alone:": (made, limb_beats),
    }
    if context.num_tracks:
        groups["sound files, whole-body"] = (made[: context.num_tracks], body_beats)
        groups["synthetic songs, whole-body"] = (made[context.num_tracks :], body_beats)
    if len(context.reference):
        groups["real whole-body"] = (context.reference.dances, body_beats)
    return [
        grid
        for name, (dances, find) in groups.items()
        for grid in alignment_grids(
            name, alignment_rows(_danced(dances, find), context.settings.seed)
        )
    ]


def _danced(dances: list[BodyDance], find: Find) -> list[Danced]:
    return [Danced(each.song, find(each.motion), each.beats, each.seconds) for each in dances]


def seam_tables(context: DanceContext) -> list[Grid]:
    """Accelerations and jerks where windows of the body meet; nothing without real dances."""
    if not len(context.reference):
        return []
    made = context.danced("generated", 0).dances
    rows = {"generated": made, "hard cut": hard_cuts(made)}
    if context.settings.untrained:
        rows["untrained"] = context.danced("untrained", 0).dances
    real = [dance.motion for dance in context.reference.dances]
    return seam_grid(rows, real, context.settings.seed)
