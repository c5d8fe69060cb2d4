"""Where nothing is heard, and what is no music: there a dancer waits.

Letters: T frames.
"""

import numpy as np

QUIET = 0.03  # of the loudness that 5% of the frames exceed
WAIT = 1.2  # seconds; a shorter silence is a rest of the music
NOISE = 1.8  # a music's strongest pitch class is so many times the mean one, and a noise's is not


def silent_spans(loudness: np.ndarray, fps: float = 30.0) -> list[tuple[int, int]]:
    """First and past-the-last frame of each silence of 1.2 s or more.

    Args:
        loudness: RMS [T], 0 to 1; all of it silent where nothing sounds.
        fps: frames a second.
    """
    quiet = loudness <= QUIET * float(np.percentile(loudness, 95))
    edges = np.flatnonzero(np.diff(quiet.astype(int), prepend=0, append=0)).reshape(-1, 2)
    return [(start, stop) for start, stop in edges.tolist() if stop - start >= WAIT * fps]


def is_noise(chroma: np.ndarray) -> bool:
    """Whether no pitch stands out of a sound's chroma [12,T]; silence is no music either."""
    mean = chroma.mean(0)
    sounding = mean > 0
    if not sounding.any():
        return True
    return bool(np.median(chroma[:, sounding].max(0) / mean[sounding]) < NOISE)
