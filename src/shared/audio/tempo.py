"""How likely each tempo is at each moment: correlations of onset strengths, read at multiples.

A window's autocorrelation peaks at the beat, but also at its halves and multiples. Which one
people tap is decided by a linear model (multinomial logistic regression) that looks at the
multiples of a candidate period within and between three bands (a kick answered by a snare), with
a mild preference for 120 BPM; it was fitted on 800 songs of the training split, none of whose
tempi the tests use.
Letters: B pairs of bands, T frames, N windows, G candidate tempi.
"""

import numpy as np

SLOWEST, PER_OCTAVE, CANDIDATES = 44.0, 24, 57  # BPM, candidates per octave, G: up to 223 BPM
PERIODS = 60 / (SLOWEST * 2 ** (np.arange(CANDIDATES) / PER_OCTAVE))  # [G] seconds
DISTANCE = np.log2(PERIODS / 0.5)  # [G] octaves below 120 BPM
WINDOW, STEP = 8.0, 2.0  # seconds
PAIRS = ((0, 0), (1, 1), (2, 2), (0, 1), (0, 2), (1, 2))  # of the low, middle and high band
MULTIPLES = (1 / 4, 1 / 3, 1 / 2, 2 / 3, 1, 3 / 2, 2, 3, 4)
WEIGHTS = np.array(  # [B, multiples]
    [
        [-1.7, -1.0, -1.0, -1.3, -2.4, 0.1, 1.2, 1.2, 0.7],
        [-1.8, -0.4, -0.2, -0.6, 0.3, -0.5, -0.1, 1.5, 1.1],
        [0.3, -1.3, 0.8, -1.4, 1.7, 0.4, 1.7, 0.3, 0.0],
        [-1.7, 0.1, -1.2, -0.8, 0.9, -0.4, 1.8, -0.8, -0.5],
        [-1.2, -0.2, 0.2, -0.3, 2.7, -0.8, 0.2, -0.5, -1.3],
        [-0.8, -0.6, -0.3, -0.9, 1.6, -1.2, -1.3, 0.3, 0.6],
    ]
)
PRIOR = -0.95  # of the squared DISTANCE: log-normal with a spread of 0.7 octaves
LEAP_COST, OCTAVE_COST = 6.0, 12.0  # of a change of tempo between windows
NEARBY = 5  # candidates to each side of the path that a beat may still have
BLUR = np.bartlett(15)[1:-1] / 7  # players are not exact: onsets are spread over 13 frames


def correlate_windows(novelty: np.ndarray, fps: float) -> tuple[np.ndarray, np.ndarray]:
    """Normalised correlations [N, B, lags] of windows, and the windows' centres [N] (s).

    Args:
        novelty: onset strengths [3, T] of the low, middle and high bands at `fps`.
    """
    novelty = np.stack([np.convolve(row, BLUR, "same") for row in novelty])
    frames = novelty.shape[1]
    window, step = round(WINDOW * fps), round(STEP * fps)
    lags = round(PERIODS[0] * MULTIPLES[-1] * fps) + 2
    taper = np.hanning(min(window, frames) + 2)[1:-1]
    size = int(2 ** np.ceil(np.log2(window + lags)))
    first, second = np.array(PAIRS).T
    overlap = np.fft.irfft(np.abs(np.fft.rfft(taper, size)) ** 2)[:lags]
    overlap = np.maximum(overlap / overlap[0], 0.05)  # fewer frames meet at long lags: undo that
    starts = np.arange(0, max(frames - window, 0) + 1, step)
    result = np.empty((len(starts), len(PAIRS), lags))
    for index, start in enumerate(starts):
        part = novelty[:, start : start + window]
        mean = (part * taper).sum(axis=1, keepdims=True) / taper.sum()
        spectrum = np.fft.rfft((part - mean) * taper, size)
        crossed = np.fft.irfft((spectrum[first] * spectrum[second].conj()).real)[:, :lags]
        energy = crossed[:3, 0] + 1e-6
        result[index] = crossed / np.sqrt(energy[first] * energy[second])[:, None] / overlap
    return result, (starts + taper.size / 2) / fps


def tempo_features(correlations: np.ndarray, fps: float) -> np.ndarray:
    """Correlations [N, B, lags] read at the multiples of each candidate: [N, B, multiples, G]."""
    lags = np.outer(MULTIPLES, PERIODS) * fps
    return read_at(correlations, lags)


def tempo_scores(correlations: np.ndarray, fps: float) -> np.ndarray:
    """Log-probability [N, G] of each candidate period, from correlations [N, B, lags]."""
    scores = np.einsum("bm,nbmg->ng", WEIGHTS, tempo_features(correlations, fps))
    scores += PRIOR * DISTANCE**2
    top = scores.max(axis=1, keepdims=True)
    return np.asarray(scores - top - np.log(np.exp(scores - top).sum(axis=1, keepdims=True)))


def tempo_path(scores: np.ndarray) -> np.ndarray:
    """The likeliest candidate of each window, [N] numbers: drifts are free, jumps cost, and a
    leap to the double or half is taken for an illusion (Viterbi)."""
    steps = np.abs(np.subtract.outer(np.arange(CANDIDATES), np.arange(CANDIDATES)))
    cost = np.minimum(0.5 * np.maximum(steps - 1, 0), LEAP_COST)
    cost += np.where(np.abs(steps - PER_OCTAVE) <= 1, OCTAVE_COST, 0.0)
    value, before = scores[0], np.zeros(scores.shape, dtype=int)
    for window in range(1, len(scores)):
        options = value[:, None] - cost
        before[window] = options.argmax(axis=0)
        value = options.max(axis=0) + scores[window]
    path = [int(value.argmax())]
    for window in range(len(scores) - 1, 0, -1):
        path.append(int(before[window, path[-1]]))
    return np.array(path[::-1])


def certainty(scores: np.ndarray, path: np.ndarray) -> float:
    """Mean probability [0, 1] that the scores [N, G] give to the tempi (±6%) of the path [N]."""
    near = np.abs(np.arange(CANDIDATES) - path[:, None]) <= 2
    return float((np.exp(scores) * near).sum(axis=1).mean())


def read_at(correlations: np.ndarray, lags: np.ndarray) -> np.ndarray:
    """Correlations [..., lags] at fractional lags of any shape, linearly interpolated."""
    index = lags.astype(int)
    share = lags - index
    return np.asarray(correlations[..., index] * (1 - share) + correlations[..., index + 1] * share)


def periodicity(correlations: np.ndarray, lengths: np.ndarray) -> float:
    """How alike the onsets are one or two beats later, 0 to 1: mean over windows, best band.

    Args:
        correlations: [N, B, lags].
        lengths: [N] beat length of each window in frames.
    """
    best = [
        read_at(window[:3], np.array([1.0, 2.0]) * length).max()
        for window, length in zip(correlations, lengths, strict=True)
    ]
    return float(np.clip(np.mean(best), 0.0, 1.0))
