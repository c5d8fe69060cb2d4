"""The phase of a motion against the true phase of its song, per beat and per bar.

Letters: T frames.
"""

from collections.abc import Sequence
from typing import Any

import numpy as np

from ..motion.trajectory import FPS
from .audio_songs import Piece
from .intervals import bootstrap_mean
from .metrics_rhythm import phase_error

TEMPO_TOLERANCE = 0.04  # the usual one


def right_tempo(piece: Piece) -> bool:
    """Does the tracker's phase run as fast as the true one for most of the song?

    An octave error, twice or half as fast, has no phase to speak of.
    """
    if piece.phase is None or piece.bars is None:
        return False
    heard, true = np.diff(piece.phase) * piece.meter, np.diff(piece.bars) * piece.true_meter
    return bool(abs(np.median(heard / true) - 1) <= TEMPO_TOLERANCE)


def phase_row(songs: Sequence[tuple[Piece, np.ndarray]]) -> dict[str, dict[str, Any]]:
    """`song_phase` over songs, each column with its interval.

    Args:
        songs: what is true, and unwrapped bars [T] in the tracker's meter.
    """
    columns: dict[str, list[float]] = {}
    for piece, bars in songs:
        assert piece.bars is not None
        found = song_phase(bars * piece.meter, bars, piece.bars, piece.true_meter, piece.beats)
        for name, value in found.items():
            columns.setdefault(name, []).append(value)
    return {name: bootstrap_mean(values).as_dict() for name, values in columns.items()}


def song_phase(
    beats: np.ndarray, bars: np.ndarray, true_bars: np.ndarray, meter: int, times: np.ndarray
) -> dict[str, float]:
    """Errors of one song, counted from its first true beat to its last.

    Args:
        beats, bars: what the motion counts, unwrapped [T].
        true_bars: [T]; at least two beats lie inside.
        meter: beats a true bar.
        times: of the true beats, seconds.

    Returns:
        beat and bar: mean |error| in cycles; beat_seconds: in seconds; beat_offset: signed, in
        cycles of a beat; steady: concentration of the beat's error.
    """
    at = np.arange(min(len(bars), len(true_bars))) / FPS
    inside = np.flatnonzero((at >= times[0]) & (at <= times[-1]))
    true_beats = true_bars[inside] * meter
    beat = phase_error(beats[inside], true_beats)
    period = (at[inside][-1] - at[inside][0]) / (true_beats[-1] - true_beats[0])
    return {
        "beat": beat.absolute,
        "bar": phase_error(bars[inside], true_bars[inside]).absolute,
        "beat_seconds": float(beat.absolute * period),
        "beat_offset": beat.offset,
        "steady": beat.concentration,
    }
