"""Means and standard deviations of a phrase set's rows, over the real frames of its windows."""

from collections.abc import Callable

import numpy as np
import torch
from torch import Tensor

from ...errors import UserError
from .dataset import MotionPhraseDataset, PhraseItem

MOST = 2000  # windows looked at
LEAST_STD = 1e-3
FEATURE_ROWS = 163  # of sound; phases are no features


def motion_statistics(
    dataset: MotionPhraseDataset, most: int = MOST, least_std: float = LEAST_STD
) -> tuple[Tensor, Tensor]:
    """Mean and standard deviation [25] of the window rows over real frames of up to `most` items.

    Raises:
        UserError: no phrase can be used.
    """
    return _statistics(dataset, lambda item: item.motion, most, least_std)


def sound_statistics(
    dataset: MotionPhraseDataset, most: int = MOST, least_std: float = LEAST_STD
) -> tuple[Tensor, Tensor]:
    """Mean and standard deviation [163] of the features of sound, as `motion_statistics`.

    Raises:
        UserError: no phrase can be used.
    """
    return _statistics(dataset, lambda item: item.audio[:FEATURE_ROWS], most, least_std)


def _statistics(
    dataset: MotionPhraseDataset,
    rows: Callable[[PhraseItem], Tensor],
    most: int,
    least_std: float,
) -> tuple[Tensor, Tensor]:
    count, total, squares = 0, np.zeros(1), np.zeros(1)
    for number, item in enumerate(dataset.epoch(0)):
        if number == most:
            break
        values = rows(item)[:, item.mask].numpy().astype(np.float64)
        count += values.shape[1]
        total, squares = total + values.sum(1), squares + (values**2).sum(1)
    if count == 0:
        raise UserError(f"{dataset.root} has no phrase that can be used; prepare it again")
    mean = total / count
    std = np.sqrt(np.maximum(squares / count - mean**2, 0)).clip(least_std)
    return torch.from_numpy(mean).float(), torch.from_numpy(std).float()
