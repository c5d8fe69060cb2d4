"""Which beats open a bar: accents of the bass and changes of harmony, summed over the song."""

import numpy as np

from src.shared.audio.onsets import Onsets

METERS = (3, 4)  # tried when the meter is not given


def find_downbeats(onsets: Onsets, times: np.ndarray, meter: int | None) -> tuple[int, int]:
    """The meter and the number of the first downbeat among beats at `times` [N]."""
    frames = np.clip(np.round(times * onsets.fps).astype(int), 0, onsets.strength.size - 1)
    low = onsets.bands[0][frames]
    bar = meter or 4
    sums = [low[offset::bar].mean() for offset in range(min(bar, len(times)))]
    return bar, int(np.argmax(sums))
