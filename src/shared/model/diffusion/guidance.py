"""Conditions of a denoiser, and classifier-free guidance in one doubled forward.

Ho & Salimans 2022; SPEC ruling 14.
"""

from collections.abc import Callable, Mapping
from dataclasses import fields, is_dataclass, replace
from typing import Any

import torch
from torch import Tensor

Model = Callable[..., Tensor]  # model(x_t, t [B], ...) -> model output, shaped like x_t
ModelFn = Callable[[Tensor, Tensor], Tensor]  # the same with its condition already inside


def with_condition(model: Model, condition: Any) -> ModelFn:
    """Close a model over its condition.

    A mapping becomes keyword arguments, None nothing, anything else the third argument:
    `model(x_t, t, condition)`.
    """
    if condition is None:
        return model
    if isinstance(condition, Mapping):
        keywords = dict(condition)
        return lambda x_t, t: model(x_t, t, **keywords)
    return lambda x_t, t: model(x_t, t, condition)


def join_conditions(first: Any, second: Any) -> Any:
    """Concatenate two conditions of one structure along the batch.

    Goes through tensors, None, mappings, tuples, lists and dataclasses.

    Raises:
        TypeError: the two differ in structure.
    """
    if first is None and second is None:
        return None
    if isinstance(first, Tensor) and isinstance(second, Tensor):
        return torch.cat((first, second))
    if type(first) is not type(second):
        raise TypeError(
            f"condition is a {type(first).__name__}, its null a {type(second).__name__}"
        )
    if isinstance(first, Mapping):
        if first.keys() != second.keys():
            raise TypeError(f"condition has the keys {sorted(first)}, its null {sorted(second)}")
        return {key: join_conditions(first[key], second[key]) for key in first}
    if isinstance(first, tuple | list):
        if len(first) != len(second):
            raise TypeError(f"condition has {len(first)} parts, its null {len(second)}")
        parts = [join_conditions(a, b) for a, b in zip(first, second, strict=True)]
        return type(first)(*parts) if hasattr(first, "_fields") else type(first)(parts)
    if is_dataclass(first) and not isinstance(first, type):
        changes = {
            field.name: join_conditions(getattr(first, field.name), getattr(second, field.name))
            for field in fields(first)
        }
        return replace(first, **changes)
    raise TypeError(f"cannot join conditions of type {type(first).__name__}")


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
