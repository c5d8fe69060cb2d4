"""Which beats open a bar: accents of three bands and changes of harmony around each beat.

A linear score of the five beats around a beat says how much it sounds like a downbeat; the best
numbering of all beats follows by dynamic programming, where counting on costs nothing and starting
a bar at the wrong beat (the tracker lost or added one) costs SLIP_COST. The weights were fitted
by softmax regression on the bar's offset over 300 songs of the training split, meters 2 to 4.
Letters: N beats, F features, P pitch frames.
"""

import numpy as np

from .onsets import Onsets

METERS = (3, 4)  # tried when the meter is not given
SLIP_COST = 4.0  # about three bars of clear downbeats
BASS_SEMITONES = 20  # of Onsets.pitch, up to 165 Hz
CONTEXT = (-2, -1, 0, 1, 2)  # beats
WEIGHTS = np.array(  # [features, CONTEXT]
    [
        [-0.02, 0.00, 0.09, 0.01, 0.03],  # onset, low band
        [0.08, 0.16, -0.03, -0.01, 0.06],  # onset, middle band
        [-0.21, 0.15, 0.24, -0.09, -0.16],  # onset, high band
        [-0.02, -0.11, -0.14, 0.00, 0.00],  # new bass notes since the last beat
        [-0.01, -0.19, 0.08, -0.20, 0.05],  # new harmony since the last beat
        [-0.10, 0.18, -0.09, -0.17, 0.06],  # new bass notes, two beats against two
        [-0.24, -0.18, 0.20, -0.03, -0.16],  # new harmony, two beats against two
        [-0.10, -0.09, 0.21, 0.04, 0.07],  # loudness of the bass
    ]
)


def find_downbeats(onsets: Onsets, times: np.ndarray, meter: int | None) -> tuple[int, np.ndarray]:
    """The meter, and which of the beats at `times` [N] (N >= 2) open a bar: numbers, ascending.

    Args:
        meter: beats a bar; None takes the likelier of METERS.
    """
    scores = downbeat_scores(onsets, times)
    if meter is None:
        meter = max(METERS, key=lambda bar: _evidence(scores, bar))
    return meter, np.flatnonzero(_numbers(scores, meter) == 0)


def downbeat_scores(onsets: Onsets, times: np.ndarray) -> np.ndarray:
    """How much each beat sounds like a downbeat [N], about 1 for downbeats, -0.3 for others."""
    return np.einsum("fc,fcn->n", WEIGHTS, downbeat_features(onsets, times))


def downbeat_features(onsets: Onsets, times: np.ndarray) -> np.ndarray:
    """Features of the beats around each beat, standardised over the song: [F, CONTEXT, N]."""
    features = _beat_features(onsets, times)
    spread = features.std(axis=1, keepdims=True) + 1e-3 * np.abs(features).max(axis=1)[:, None]
    features = (features - features.mean(axis=1, keepdims=True)) / (spread + 1e-6)
    around = np.arange(len(times)) + np.array(CONTEXT)[:, None]
    return np.take(features, around, axis=1, mode="clip")


def _evidence(scores: np.ndarray, meter: int) -> float:
    """Best mean score of every meter-th beat, in standard errors."""
    parts = [scores[offset::meter] for offset in range(min(meter, len(scores)))]
    return max(float(part.sum()) / np.sqrt(len(part)) for part in parts)


def _numbers(scores: np.ndarray, meter: int) -> np.ndarray:
    """Number in the bar, 0 to meter - 1, of each beat [N]: the best path (Viterbi)."""
    value = np.zeros(meter)
    before = np.zeros((len(scores), meter), dtype=int)
    for beat, score in enumerate(scores):
        counted, slipped = np.roll(value, 1), int(value.argmax())
        slips = value[slipped] - SLIP_COST > counted
        before[beat] = np.where(slips, slipped, (np.arange(meter) - 1) % meter)
        value = np.where(slips, value[slipped] - SLIP_COST, counted)
        value[0] += score
    numbers = np.empty(len(scores), dtype=int)
    number = int(value.argmax())
    for beat in range(len(scores) - 1, -1, -1):
        numbers[beat] = number
        number = int(before[beat, number])
    return numbers


def _beat_features(onsets: Onsets, times: np.ndarray) -> np.ndarray:
    """[F, N]: see WEIGHTS."""
    reach, last = 3, onsets.bands.shape[1] - 1
    frames = np.round(times * onsets.fps).astype(int)
    near = np.clip(frames[:, None] + np.arange(-reach, reach + 1), 0, last)
    accents = onsets.bands[:, near].max(axis=2)
    pitch = _pitch_by_beat(onsets, times)
    bass, harmony = pitch[:BASS_SEMITONES], pitch[BASS_SEMITONES:]
    changes = [_novelty(part, span) for span in (1, 2) for part in (bass, harmony)]
    return np.concatenate([accents, np.stack([*changes, bass.mean(axis=0)])])


def _pitch_by_beat(onsets: Onsets, times: np.ndarray) -> np.ndarray:
    """Mean pitch levels [semitones, N] from each beat to the next, without the attack."""
    count = onsets.pitch.shape[1]
    ends = np.append(times[1:], 2 * times[-1] - times[-2])
    start = np.ceil((times + 0.06) * onsets.pitch_fps).astype(int)
    start = np.minimum(start, count - 1)
    stop = np.ceil((ends - 0.03) * onsets.pitch_fps).astype(int)
    stop = np.clip(stop, start + 1, count)
    sums = np.pad(np.cumsum(onsets.pitch, axis=1, dtype=np.float64), ((0, 0), (1, 0)))
    return (sums[:, stop] - sums[:, start]) / (stop - start)


def _novelty(levels: np.ndarray, span: int) -> np.ndarray:
    """One minus the cosine [N] of the `span` beats from each beat on and those before it."""
    beats = np.arange(levels.shape[1])
    steps = np.arange(span)[:, None]
    after = np.take(levels, beats + steps, axis=1, mode="clip").sum(axis=1)
    past = np.take(levels, beats - steps - 1, axis=1, mode="clip").sum(axis=1)
    norms = np.linalg.norm(after, axis=0) * np.linalg.norm(past, axis=0)
    return 1 - (after * past).sum(axis=0) / (norms + 1e-3)
