"""Filters along time as scipy.ndimage has them, whose import takes as long as the sampling of a
motion (docs/decisions.md).

Letters: T frames.
"""

from typing import Literal

import numpy as np
from numpy.lib.stride_tricks import sliding_window_view

REACH = 4.0  # deviations of a Gaussian that are summed


def smoothed(
    values: np.ndarray, sigma: float, *, mode: Literal["edge", "symmetric"] = "edge"
) -> np.ndarray:
    """Values [T, ...] by a Gaussian of `sigma` frames; at the ends as `np.pad` fills up by `mode`.

    Args:
        mode: "edge" (scipy's nearest) or "symmetric" (its reflect).

    Returns:
        As many values of the same kind.
    """
    radius = int(REACH * sigma + 0.5)
    steps = np.arange(-radius, radius + 1)
    weights = np.exp(-0.5 / (sigma * sigma) * steps**2)
    weights /= weights.sum()
    length, rest = len(values), [(0, 0)] * (values.ndim - 1)
    wide = np.pad(values.astype(np.float64), [(radius, radius), *rest], mode=mode)
    total = wide[radius : radius + length] * weights[radius]
    for step in range(radius, 0, -1):  # the furthest first, as scipy adds up
        before, after = radius - step, radius + step
        pair = wide[before : before + length] + wide[after : after + length]
        total += pair * weights[before]
    kind = values.dtype if values.dtype.kind == "f" else np.float64
    return np.asarray(total, dtype=kind)


def greatest(values: np.ndarray, size: int) -> np.ndarray:
    """Of values [T, ...] the greatest within an odd number of frames around each."""
    reach = size // 2
    rest = [(0, 0)] * (values.ndim - 1)
    wide = np.pad(values, [(reach, reach), *rest], mode="symmetric")
    return np.asarray(sliding_window_view(wide, size, axis=0).max(-1))


def frames_away(marked: np.ndarray) -> np.ndarray:
    """How many frames each of T is away from the nearest one that is marked; at least one is."""
    at = np.flatnonzero(marked)
    frames = np.arange(len(marked))
    after = np.searchsorted(at, frames)
    near = np.abs(at[np.stack((np.minimum(after, len(at) - 1), np.maximum(after - 1, 0)))] - frames)
    return np.asarray(near.min(0), dtype=np.float64)
