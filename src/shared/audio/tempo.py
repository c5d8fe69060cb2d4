"""How likely each tempo is at each moment: autocorrelation of onset strengths, read at multiples.

A window's autocorrelation peaks at the beat, but also at its halves and multiples. Which one
people tap is decided by a linear model (multinomial logistic regression) that looks at the
multiples of a candidate period in three bands together, with a mild preference for 120 BPM;
it was fitted on 300 songs of the training split, none of whose tempi the tests use.
Letters: B bands (low, middle, high, all), T frames, N windows, G candidate tempi.
"""

import numpy as np

SLOWEST, PER_OCTAVE, CANDIDATES = 44.0, 24, 57  # BPM, candidates per octave, G: up to 223 BPM
PERIODS = 60 / (SLOWEST * 2 ** (np.arange(CANDIDATES) / PER_OCTAVE))  # [G] seconds
WINDOW, STEP = 8.0, 2.0  # seconds
MULTIPLES = (1 / 4, 1 / 3, 1 / 2, 2 / 3, 1, 3 / 2, 2, 3, 4)
WEIGHTS = np.array(  # [B, multiples]
    [
        [-0.64, -0.39, -0.87, -0.72, -1.27, 0.77, 0.89, -0.60, -0.56],
        [-1.07, -0.47, -1.16, -0.99, 1.50, -1.57, -0.21, 0.18, 0.81],
        [-0.52, -0.99, 1.27, -1.58, 4.03, -1.20, 0.18, 0.45, -0.54],
        [-0.75, -0.57, -1.09, -1.14, 2.80, -0.46, 2.08, 0.52, 0.04],
    ]
)
PRIOR = np.array([0.23, -0.45, -1.15])  # of x, x², |x|³ with x octaves slower than 120 BPM
SONG_WEIGHT = 0.5  # how much the whole song's mean counts beside a window
SLACK = (-0.01, 0.0, 0.01)  # a period may be off by this share when read


def autocorrelation(novelty: np.ndarray, fps: float) -> tuple[np.ndarray, np.ndarray]:
    """Normalised autocorrelations [N, B, lags] of windows, and the windows' centres [N] (s).

    Args:
        novelty: onset strengths [B, T] at `fps`.
    """
    bands, frames = novelty.shape
    window, step = round(WINDOW * fps), round(STEP * fps)
    lags = round(PERIODS[0] * MULTIPLES[-1] * fps) + 2
    taper = np.hanning(min(window, frames) + 2)[1:-1]
    size = 2 ** int(np.ceil(np.log2(window + lags)))

    def correlate(signal: np.ndarray) -> np.ndarray:
        power = np.abs(np.fft.rfft(signal, size, axis=-1)) ** 2
        return np.fft.irfft(power, axis=-1)[..., :lags]

    overlap = correlate(taper)  # fewer frames overlap at long lags: undo that
    overlap = np.maximum(overlap / overlap[0], 0.05)
    starts = np.arange(0, max(frames - window, 0) + 1, step)
    result = np.empty((len(starts), bands, lags))
    for index, start in enumerate(starts):
        part = novelty[:, start : start + window]
        result[index] = correlate((part - part.mean(axis=1, keepdims=True)) * taper)
    result /= (result[:, :, :1] + 1e-6) * overlap
    return result, (starts + taper.size / 2) / fps


def tempo_scores(correlations: np.ndarray, fps: float) -> np.ndarray:
    """Log-probability [N, G] of each candidate period, from correlations [N, B, lags]."""
    lags = correlations.shape[-1]
    x = np.log2(PERIODS / 0.5)
    scores = np.tile(PRIOR @ np.stack([x, x**2, np.abs(x) ** 3]), (len(correlations), 1))
    for multiple, weights in zip(MULTIPLES, WEIGHTS.T, strict=True):
        scores += np.einsum("b,nbg->ng", weights, read_at(correlations, PERIODS * multiple * fps))
    assert lags > PERIODS[0] * MULTIPLES[-1] * fps
    scores += SONG_WEIGHT * scores.mean(axis=0)
    top = scores.max(axis=1, keepdims=True)
    return scores - top - np.log(np.exp(scores - top).sum(axis=1, keepdims=True))


def read_at(correlations: np.ndarray, lags: np.ndarray) -> np.ndarray:
    """Correlations [N, B, G] at fractional `lags` [G], the best within SLACK."""
    values = []
    for slack in SLACK:
        position = np.minimum(lags * (1 + slack), correlations.shape[-1] - 1.001)
        index = position.astype(int)
        share = position - index
        values.append(correlations[..., index] * (1 - share) + correlations[..., index + 1] * share)
    return np.maximum.reduce(values)
