"""Classifier-free guidance in one doubled forward (Ho & Salimans 2022; SPEC ruling 14)."""

from typing import Any

import torch
from torch import Tensor

from .conditions import (
    Model,
    ModelFn,
    join_conditions,
    with_condition,
)


def guided(model: Model, condition: Any, null_condition: Any, scale: float) -> ModelFn:
    """Steer a model from its null condition towards, and past, its condition.

    null + scale * (conditional - null), eq. 6 with scale = 1 + w. For one x_t the predictions
    epsilon, sample and v are linear in each other, so the rule is the same for all three.
    Scale 1 is the plain conditional model and scale 0 the plain null model: one forward each.

    Args:
        model: called as `model(x_t, t, ...)`; rows of a batch must not see each other.
        condition: keyword arguments (a mapping), or one third argument; batch first everywhere.
        null_condition: the learned null in the same structure and shapes.
        scale: guidance scale, 0 or more.
    """
    if scale == 1:
        return with_condition(model, condition)
    if scale == 0:
        return with_condition(model, null_condition)
    both = with_condition(model, join_conditions(condition, null_condition))

    def guided_model(x_t: Tensor, t: Tensor) -> Tensor:
        output = both(torch.cat((x_t, x_t)), torch.cat((t, t)))
        conditional, null = output.chunk(2)
        return null + scale * (conditional - null)

    return guided_model
