"""The 8-d style: four named pairs measured from a motion, or set by words (ruling 11).

Each pair is a point on a quarter circle, so that the eight numbers have length 1:

| columns | pair      | first number  | second  | measured from                      |
|---------|-----------|---------------|---------|------------------------------------|
| 0, 1    | intensity | energetic     | calm    | root mean square speed             |
| 2, 3    | extent    | wide          | narrow  | path covered                       |
| 4, 5    | rhythm    | staccato      | legato  | how much the speed comes and goes  |
| 6, 7    | attitude  | tense         | relaxed | acceleration by speed              |

A pair's value lies in 0 to 1; 0.5 is the median of real walking, running and dancing. Measures
are averaged over two seconds around each frame, so the style changes slowly.

Letters: T frames.
"""

import difflib
import re
from functools import partial

import numpy as np

from ..errors import UsageError
from ..tensors import torch
from .rotations import forward_difference
from .trajectory import MotionTrajectory

PAIRS = ("intensity", "extent", "rhythm", "attitude")
WINDOW = 2.0  # seconds
# 5th, 50th and 95th percentile of the pelvis over 300 walks and runs of Bandai-Namco and all CMU
# clips: m/s, m, 1, 1/s.
PELVIS = ((0.147, 1.047, 2.734), (0.029, 0.326, 0.920), (0.079, 0.203, 0.733), (2.67, 3.78, 17.3))
_FLOOR = 1e-6  # of a measure whose logarithm is taken
_STEEPNESS = float(np.log(19))  # a percentile of 5 becomes 0.05

# Words → the pairs they speak of, each 0 to 1; a pair that no word names stays at 0.5.
WORDS: dict[str, dict[str, float]] = {
    "active": {"intensity": 0.8, "attitude": 0.65},
    "aggressive": {"intensity": 0.9, "rhythm": 0.85, "attitude": 0.95},
    "angry": {"intensity": 0.75, "rhythm": 0.75, "attitude": 0.95},
    "bouncy": {"intensity": 0.7, "rhythm": 0.8, "attitude": 0.4},
    "calm": {"intensity": 0.2, "rhythm": 0.2, "attitude": 0.15},
    "cautious": {"intensity": 0.25, "extent": 0.25, "attitude": 0.75},
    "cheerful": {"intensity": 0.7, "extent": 0.65, "rhythm": 0.7, "attitude": 0.3},
    "childish": {"intensity": 0.65, "extent": 0.6, "rhythm": 0.7},
    "confident": {"intensity": 0.6, "extent": 0.75, "attitude": 0.35},
    "elderly": {"intensity": 0.15, "extent": 0.2, "attitude": 0.6},
    "energetic": {"intensity": 0.9, "extent": 0.7, "rhythm": 0.65},
    "excited": {"intensity": 0.85, "extent": 0.7, "rhythm": 0.75, "attitude": 0.7},
    "fast": {"intensity": 0.85},
    "flowing": {"rhythm": 0.1, "attitude": 0.2},
    "gentle": {"intensity": 0.25, "rhythm": 0.2, "attitude": 0.2},
    "graceful": {"extent": 0.65, "rhythm": 0.15, "attitude": 0.25},
    "happy": {"intensity": 0.7, "extent": 0.65, "rhythm": 0.65, "attitude": 0.35},
    "heavy": {"intensity": 0.35, "rhythm": 0.6, "attitude": 0.7},
    "jerky": {"rhythm": 0.95, "attitude": 0.8},
    "lazy": {"intensity": 0.1, "extent": 0.3, "rhythm": 0.25, "attitude": 0.1},
    "legato": {"rhythm": 0.05},
    "narrow": {"extent": 0.1},
    "nervous": {"extent": 0.25, "rhythm": 0.7, "attitude": 0.9},
    "neutral": dict.fromkeys(PAIRS, 0.5),
    "powerful": {"intensity": 0.9, "extent": 0.75, "attitude": 0.75},
    "proud": {"intensity": 0.5, "extent": 0.8, "attitude": 0.45},
    "relaxed": {"intensity": 0.3, "attitude": 0.05},
    "sad": {"intensity": 0.15, "extent": 0.2, "rhythm": 0.2},
    "shy": {"intensity": 0.3, "extent": 0.15, "attitude": 0.7},
    "slow": {"intensity": 0.15},
    "small": {"extent": 0.1},
    "smooth": {"rhythm": 0.1, "attitude": 0.2},
    "staccato": {"rhythm": 0.95},
    "strong": {"intensity": 0.8, "attitude": 0.75},
    "tense": {"attitude": 0.95},
    "tired": {"intensity": 0.15, "rhythm": 0.3, "attitude": 0.15},
    "wide": {"extent": 0.9},
    "youthful": {"intensity": 0.75, "extent": 0.6, "attitude": 0.4},
}


def style_vector(values: np.ndarray) -> np.ndarray:
    """Pair values [...,4] in 0 to 1 → unit styles [...,8] float32."""
    angle = np.clip(np.asarray(values, dtype=np.float64), 0, 1) * np.pi / 2
    pairs = np.stack((np.sin(angle), np.cos(angle)), -1) / 2  # [...,4,2]
    return pairs.reshape(*angle.shape[:-1], 8).astype(np.float32)


def style_values(style: np.ndarray) -> np.ndarray:
    """Styles [...,8], of any length → pair values [...,4] in 0 to 1."""
    pairs = np.maximum(np.asarray(style, dtype=np.float64), 0).reshape(*style.shape[:-1], 4, 2)
    return np.arctan2(pairs[..., 0], pairs[..., 1]) * 2 / np.pi


def _split(words: str) -> list[str]:
    return [word for word in re.split(r"[\s,;]+", words.lower()) if word not in ("", "and")]


def only_style_words(words: str) -> bool:
    """Whether `named_style` knows every word of a text that is not empty."""
    return all(word in WORDS for word in _split(words))


def named_style(words: str) -> np.ndarray:
    """English words, "tired, elderly" → unit style [8]; where words disagree, their mean.

    Raises:
        UsageError: no word, or one that is not in `WORDS`.
    """
    given = _split(words)
    if not given:
        raise UsageError(f"--style {words!r} names no style; known are {', '.join(WORDS)}")
    for word in given:
        if word not in WORDS:
            near = difflib.get_close_matches(word, WORDS, n=1)
            hint = f"did you mean {near[0]!r}? " if near else ""
            raise UsageError(
                f"--style: {word!r} is not a known style; {hint}known are {', '.join(WORDS)}"
            )
    named = [[WORDS[word][pair] for word in given if pair in WORDS[word]] for pair in PAIRS]
    return style_vector(np.array([np.mean(values) if values else 0.5 for values in named]))


def measure_style(trajectory: MotionTrajectory) -> np.ndarray:
    """Style [T,8] of a path, from the pelvis alone."""
    velocity = forward_difference(torch.as_tensor(trajectory.position), trajectory.fps)  # T 3
    acceleration = forward_difference(velocity, trajectory.fps)
    if trajectory.num_frames > 2:  # the last two are zero because the last velocity repeats
        acceleration[-2:] = acceleration[-3]
    speed = velocity.norm(dim=-1).numpy().astype(np.float64)
    position = trajectory.position.astype(np.float64)
    average = partial(_average, fps=trajectory.fps)
    spread = average(position**2) - average(position) ** 2
    slow = average(speed)
    variance = average(speed**2) - slow**2
    energy = np.sqrt(average(speed**2))
    extent = np.sqrt(np.maximum(spread.sum(1), 0))
    rhythm = np.sqrt(np.maximum(variance, 0)) / np.maximum(slow, _FLOOR)
    tension = average(acceleration.norm(dim=-1).numpy().astype(np.float64))
    tension /= np.maximum(slow, _FLOOR)
    measures = np.stack((energy, extent, rhythm, tension), 1)  # T 4
    return style_vector(_percentile(measures, np.array(PELVIS)))


def _average(values: np.ndarray, fps: float) -> np.ndarray:
    """Hann-weighted mean of [T] or [T,C] over `WINDOW` around each frame; shorter at the ends."""
    size = max(1, round(WINDOW * fps)) | 1
    weights, own = np.hanning(size + 2)[1:-1], slice(size // 2, size // 2 + len(values))
    total = np.convolve(np.ones(len(values)), weights, "full")[own]
    columns = values.reshape(len(values), -1).T
    means = np.stack([np.convolve(each, weights, "full")[own] / total for each in columns], 1)
    return means.reshape(values.shape)


def _percentile(measures: np.ndarray, reference: np.ndarray) -> np.ndarray:
    """Measures [T,4] → roughly their rank among real motions, 0 to 1: a logistic of their log."""
    low, middle, high = np.log(reference).T  # 4 each
    log = np.log(np.maximum(measures, _FLOOR))
    width = np.where(log < middle, middle - low, high - middle)
    return np.asarray(1 / (1 + np.exp(-_STEEPNESS * (log - middle) / width)))
