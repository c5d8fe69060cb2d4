"""Where the counts of a dance fall, found from its motion alone.

A dancer slows down on counts and lands on them: these moments are the evidence, and the best chain
of nearly even counts through them is found by dynamic programming, as beats are in a song (Ellis
2007), for each tempo; the tempo that explains most wins.

Letters: T frames, N counts, G frames of a grid.
"""

import numpy as np
from scipy.ndimage import gaussian_filter1d

from ..metrics.rhythm import body_beats, landings
from ..motion.motion import Motion

PERIODS = np.arange(0.34, 0.76, 0.02)  # seconds a count
GRID = 60.0  # frames a second in which counts are sought
WIDTH = 0.05  # seconds, standard deviation of a moment's evidence
LANDING = 0.6  # of a landing's evidence against that of slowing down
EVEN = 40.0  # cost of log-ratio² of two counts
SNAP = 0.06  # seconds by which a count moves to the moment that it means


def find_counts(motion: Motion) -> np.ndarray:
    """Seconds [N] of the counts, ascending; none in a motion of under two seconds."""
    slow, down = body_beats(motion), landings(motion)
    frames = round(motion.seconds * GRID)
    if motion.seconds < 2 or not len(slow):
        return np.zeros(0)
    evidence = np.zeros(frames + 1)
    np.add.at(evidence, np.rint(slow * GRID).astype(int).clip(0, frames), 1.0)
    np.add.at(evidence, np.rint(down * GRID).astype(int).clip(0, frames), LANDING)
    evidence = gaussian_filter1d(evidence, WIDTH * GRID) * WIDTH * GRID * np.sqrt(2 * np.pi)
    chains = [_chain(evidence, period * GRID) for period in PERIODS]
    # A count earns what it meets; where nothing is, it costs: else the fastest chain meets all.
    worth = [(evidence[chain] - evidence.mean()).sum() / np.sqrt(len(chain)) for chain in chains]
    counts = chains[int(np.argmax(worth))] / GRID
    moments = np.sort(np.concatenate((slow, down)))
    nearest = moments[np.abs(moments[:, None] - counts).argmin(0)]
    return np.asarray(np.where(np.abs(nearest - counts) < SNAP, nearest, counts))


def _chain(evidence: np.ndarray, period: float) -> np.ndarray:
    """Frames [N] of the best chain of counts about `period` frames apart through evidence [G]."""
    steps = np.arange(round(0.8 * period), round(1.25 * period) + 1)
    cost = EVEN * np.log(steps / period) ** 2
    value, before = evidence.copy(), np.full(len(evidence), -1)
    for frame in range(int(steps[0]), len(evidence)):
        known = steps[steps <= frame]
        options = value[frame - known] - cost[: len(known)]
        best = int(options.argmax())
        if options[best] > 0:
            value[frame] += options[best]
            before[frame] = frame - known[best]
    tail = max(len(value) - int(period), 0)
    frame = tail + int(value[tail:].argmax())
    chain = [frame]
    while before[frame] >= 0:
        frame = int(before[frame])
        chain.append(frame)
    return np.array(chain[::-1])
