"""Where a song is cut: at bars, so that a phrase of memory starts on a downbeat.

T frames at 30 fps.
"""

import numpy as np

MIN_FRAMES = 24  # 0.8 s


def cut_at_bars(
    phase_unwrapped: np.ndarray,
    *,
    bars: int = 2,
    step: int | None = None,
    min_frames: int = MIN_FRAMES,
) -> list[tuple[int, int]]:
    """Frames (start, stop) of phrases, in order.

    Each starts at the frame nearest to a downbeat and lasts `bars` bars. What is left before the
    first downbeat and after the last whole phrase is a phrase too if it is long enough.

    Args:
        phase_unwrapped: bars [T], rising; whole numbers are downbeats (ruling 9).
        bars: length of a phrase.
        step: bars from one start to the next; None = `bars`, so that phrases do not overlap.
        min_frames: of any phrase.
    """
    num_frames = len(phase_unwrapped)
    step = step or bars
    if num_frames < min_frames:
        return []
    phase = np.maximum.accumulate(np.asarray(phase_unwrapped, np.float64))
    if phase[-1] == phase[0]:  # a song without beats
        return [(0, num_frames)]
    numbers = np.arange(np.ceil(phase[0]), np.floor(phase[-1]) + 1)
    downbeats = np.rint(np.interp(numbers, phase, np.arange(num_frames))).astype(int).tolist()
    if not downbeats:
        return [(0, num_frames)]
    ends = [*downbeats[bars:], *[num_frames] * bars]
    cuts = [(0, downbeats[0]), *zip(downbeats[::step], ends[::step], strict=False)]
    return [(start, stop) for start, stop in cuts if stop - start >= min_frames]
