"""The phase of a motion against the true phase of its song, per beat and per bar.

Letters: T frames.
"""

from collections.abc import Sequence
from typing import Any

import numpy as np

from ..metrics.rhythm import song_phase
from .audio_songs import Piece
from .stats import bootstrap_mean

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
