"""A set of motions on their own music, and on what must score less.

Letters: N motion beats, M music beats.
"""

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from ...metrics.rhythm import COLUMNS, Rhythm, against_chance, mean_rhythm, rhythm
from ..report.tables import Column, Grid, GridRow, plain
from ..stats import FEW, bootstrap_mean

HELD_AGAINST = ("chance", "another song", "half a beat later")
OTHERS = 8  # other songs that each motion is held against
ALIGNMENT = (
    Column("motion_to_music", "motion→music"), Column("music_to_motion", "music→motion"),
    Column("f", "F"), Column("hits", "hits F"), Column("distance", "distance s"),
)  # fmt: skip
NOTES = {
    "rows": "The first replication. chance: the motion turned round by random times; another"
    " song: 8 others. ± is 95% over songs.",
    "above": "own song minus the row, song by song, ± 95%; * the two rows' intervals do not"
    " overlap.",
}
Cells = dict[str, dict[str, Any]]
SCORES = ("motion_to_music", "music_to_motion", "f", "hits")


def alignment_grids(name: str, part: dict[str, Any]) -> Iterator[Grid]:
    """What `alignment_rows` found of the motions called `name`: scores, and differences."""
    size = (
        f"{part['songs']} songs; beats a second: motion {part['motion_beats']:.2f}, music"
        f" {part['music_beats']:.2f}; {part['without_beats']} motions without beats"
    )
    for key, title, columns in (
        ("rows", f"{name} motion on music ({size})", ALIGNMENT),
        ("above", f"{name} motion: its own song above", ALIGNMENT[:-1]),
    ):
        note = NOTES[key]
        rows = {row: GridRow(plain(cells), part["songs"], 1) for row, cells in part[key].items()}
        yield Grid(f"alignment/{name}/{key}", title, columns, rows, note, "motion against")


@dataclass(frozen=True, eq=False)
class Danced:
    """Motion beats and the beats of the music they belong to, seconds; the song's name."""

    song: str
    motion: np.ndarray
    music: np.ndarray
    seconds: float


def alignment_rows(dances: Sequence[Danced], seed: int) -> dict[str, Any]:
    """A set of motions with their own music, and with what must score less.

    Returns:
        rows: own song and each of `HELD_AGAINST`, columns of `Rhythm` with intervals over songs;
        above: for each of `HELD_AGAINST` the paired difference own minus other, and `apart`: the
        two rows' intervals do not overlap, and there are `FEW` songs or more; songs, motion_beats,
        music_beats, without_beats.
    """
    scores: dict[str, list[Rhythm]] = {name: [] for name in ("own song", *HELD_AGAINST)}
    for index, dance in enumerate(dances):
        rng = np.random.default_rng([seed, 2, index])
        for name, score in song_scores(dance, dances, rng).items():
            scores[name].append(score)
    rows = {name: _columns(values) for name, values in scores.items()}
    own = rows["own song"]
    above = {
        name: {
            column: _difference(scores["own song"], scores[name], column)
            | {"apart": len(dances) >= FEW and own[column]["low"] > rows[name][column]["high"]}
            for column in SCORES
        }
        for name in HELD_AGAINST
    }
    return {
        "songs": len(dances),
        "motion_beats": _per_second([dance.motion for dance in dances], dances),
        "music_beats": _per_second([dance.music for dance in dances], dances),
        "without_beats": sum(len(dance.motion) == 0 for dance in dances),
        "rows": rows,
        "above": above,
    }


def song_scores(
    dance: Danced,
    dances: Sequence[Danced],
    rng: np.random.Generator,
) -> dict[str, Rhythm]:
    """One motion against its own song and everything else."""
    own, chance, off = against_chance(dance.motion, dance.music, dance.seconds, rng)
    scores = {"own song": own, "chance": chance, "half a beat later": off}
    strangers = [other for other in dances if other.song != dance.song]
    if strangers:
        drawn = rng.permutation(len(strangers))[:OTHERS]
        scores["another song"] = mean_rhythm(
            [
                rhythm(dance.motion, strangers[k].music, min(dance.seconds, strangers[k].seconds))
                for k in drawn
            ]
        )
    else:
        scores["another song"] = Rhythm(*[math.nan] * len(COLUMNS))
    return scores


def _columns(scores: Sequence[Rhythm]) -> Cells:
    return {
        name: bootstrap_mean([getattr(score, name) for score in scores]).as_dict()
        for name in COLUMNS
    }


def _difference(own: Sequence[Rhythm], other: Sequence[Rhythm], column: str) -> dict[str, Any]:
    pairs = zip(own, other, strict=True)
    return bootstrap_mean([getattr(a, column) - getattr(b, column) for a, b in pairs]).as_dict()


def _per_second(beats: Sequence[np.ndarray], dances: Sequence[Danced]) -> float:
    """Beats a second over all songs."""
    seconds = sum(dance.seconds for dance in dances)
    inside = zip(beats, dances, strict=True)
    count = sum(int(((b >= 0) & (b < dance.seconds)).sum()) for b, dance in inside)
    return count / seconds if seconds else math.nan
