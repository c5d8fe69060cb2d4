"""Motions on their own music, and on what must score less; their phase against the song's.

Letters: N motion beats, M music beats.
"""

import math
from collections.abc import Mapping, Sequence
from dataclasses import asdict
from itertools import product
from pathlib import Path
from typing import Any

import numpy as np

from ...formats.preview.drawing import new_figure, save_figure
from ...metrics import rhythm
from ...motion.trajectory import FPS, MotionTrajectory
from ..samples import Dance
from ..stats import FEW, Estimate, bootstrap_columns, bootstrap_mean
from ..tables import Grid, GridRow
from .songs import Piece

HELD_AGAINST = ("chance", "another song", "half a beat later")
OTHERS = 8  # other songs that each motion is held against
Danced = tuple[Dance[Any], np.ndarray]  # a motion on its music, and the motion's beats, seconds


def alignment_grids(found: Mapping[str, Sequence[Danced]], seed: int) -> list[Grid]:
    """`alignment_rows` of motions by name: their scores, and differences."""
    grids = []
    for name, dances in found.items():
        part = alignment_rows(dances, seed)
        size = (
            f"{part['songs']} songs; beats a second: motion {part['motion_beats']:.2f}, music"
            f" {part['music_beats']:.2f}; {part['without_beats']} motions without beats"
        )
        for kind, key in (("alignment", "rows"), ("alignment above", "above")):
            rows = {row: GridRow(cells, part["songs"], 1) for row, cells in part[key].items()}
            words = {"name": name, "size": size}
            grids.append(Grid.of(kind, rows, words, name=f"alignment/{name}/{key}"))
    return grids


def alignment_rows(dances: Sequence[Danced], seed: int) -> dict[str, Any]:
    """A set of motions with their own music, and with what must score less.

    Returns:
        rows: own song and each of `HELD_AGAINST`, columns of `Rhythm` with intervals over songs;
        above: for each of `HELD_AGAINST` the paired difference own minus other, and `apart`: the
        two rows' intervals do not overlap, and there are `FEW` songs or more; songs, motion_beats,
        music_beats, without_beats.
    """
    draws = [np.random.default_rng([seed, 2, index]) for index in range(len(dances))]
    songs = [song_scores(*each, dances, rng) for each, rng in zip(dances, draws, strict=True)]
    rows = {
        name: {c: bootstrap_mean([getattr(s[name], c) for s in songs]) for c in rhythm.COLUMNS}
        for name in ("own song", *HELD_AGAINST)
    }
    own, above = rows["own song"], {name: dict[str, dict[str, Any]]() for name in HELD_AGAINST}
    for name, column in product(HELD_AGAINST, rhythm.COLUMNS[:-1]):  # of no distance
        gains = [getattr(s["own song"], column) - getattr(s[name], column) for s in songs]
        apart = len(dances) >= FEW and own[column].low > rows[name][column].high
        above[name][column] = asdict(bootstrap_mean(gains)) | {"apart": apart}
    return {
        "songs": len(dances),
        "motion_beats": _per_second([(beats, dance.seconds) for dance, beats in dances]),
        "music_beats": _per_second([(dance.beats, dance.seconds) for dance, _ in dances]),
        "without_beats": sum(len(beats) == 0 for _, beats in dances),
        "rows": rows,
        "above": above,
    }


def song_scores(
    dance: Dance[Any], beats: np.ndarray, dances: Sequence[Danced], rng: np.random.Generator
) -> dict[str, rhythm.Rhythm]:
    """One motion against its own song and everything else."""
    own, chance, off = rhythm.against_chance(beats, dance.beats, dance.seconds, rng)
    scores = {"own song": own, "chance": chance, "half a beat later": off}
    strangers = [other for other, _ in dances if other.song != dance.song]
    drawn = [strangers[k] for k in rng.permutation(len(strangers))[:OTHERS]]
    theirs = [rhythm.rhythm(beats, o.beats, min(dance.seconds, o.seconds)) for o in drawn]
    nothing = rhythm.Rhythm(*[math.nan] * len(rhythm.COLUMNS))
    return scores | {"another song": rhythm.mean_rhythm(theirs) if theirs else nothing}


def _per_second(songs: Sequence[tuple[np.ndarray, float]]) -> float:
    """Beats a second over all songs."""
    seconds = sum(length for _, length in songs)
    count = sum(int(((beats >= 0) & (beats < length)).sum()) for beats, length in songs)
    return count / seconds if seconds else math.nan


# ---------------------------------------------------------------- the phase of a song

TEMPO_TOLERANCE = 0.04  # the usual one


def right_tempo(piece: Piece) -> bool:
    """Does the tracker's phase run as fast as the true one for most of the song? An octave error,
    twice or half as fast, has no phase to speak of."""
    if piece.phase is None or piece.bars is None:
        return False
    heard, true = np.diff(piece.phase) * piece.meter, np.diff(piece.bars) * piece.true_meter
    return bool(abs(np.median(heard / true) - 1) <= TEMPO_TOLERANCE)


def phase_row(songs: Sequence[tuple[Piece, np.ndarray]]) -> dict[str, Estimate]:
    """`song_phase` over songs, each column with its interval: of each song what is true, and
    unwrapped bars [T] in the tracker's meter."""
    return bootstrap_columns(
        [
            rhythm.song_phase(bars * piece.meter, bars, piece.bars, piece.true_meter, piece.beats)
            for piece, bars in songs
            if piece.bars is not None
        ]
    )


LINES = {"truth": ("black", "-"), "beat tracker": ("tab:blue", ":"), "generated": ("tab:red", "--")}


def plot_phase(piece: Piece, trajectory: MotionTrajectory, path: str | Path) -> Path:
    """Bar phases over the beats, and the pelvis's speed with its beats, over seconds.
    Raises UserError: matplotlib is missing, or the file cannot be written."""
    curves = {"truth": piece.bars, "beat tracker": piece.phase}
    curves["generated"] = trajectory.phase_unwrapped
    found = rhythm.motion_beats(trajectory.position, trajectory.fps)
    beats = piece.beats[piece.beats < piece.seconds]
    figure = new_figure(14, 6)
    upper, lower = figure.subplots(2, 1, sharex=True)
    for axes in (upper, lower):
        axes.vlines(beats, 0, 1, transform=axes.get_xaxis_transform(), color="0.8", lw=1)
    for name, bars in ((name, bars) for name, bars in curves.items() if bars is not None):
        colour, style = LINES[name]
        phase = np.asarray(bars, np.float64) % 1.0
        phase[1:][np.diff(phase) < -0.5] = np.nan  # no line through the bar
        upper.plot(np.arange(len(bars)) / FPS, phase, style, color=colour, label=name)
    upper.set_ylabel("phase of the bar")
    upper.set_ylim(0, 1)
    upper.legend(loc="upper right", ncols=3, fontsize="small")
    speed, times = found.speed, found.times
    at = (np.arange(len(speed)) + 0.5) / FPS
    lower.plot(at, speed, color="tab:red")
    lower.plot(times, np.interp(times, at, speed), "v", color="black", label="motion beats")
    lower.set_ylabel("smoothed speed of the pelvis, m/s")
    lower.set_xlabel("seconds; grey: beats of the song")
    lower.legend(loc="upper right", fontsize="small")
    figure.suptitle(piece.name)
    return save_figure(figure, Path(path))
