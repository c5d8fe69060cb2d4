"""What sampling and motion use of PyTorch, by NumPy on the CPU: same names, same results.

Float32 unless something says float64, as there. Arithmetic, indexing and whatever NumPy calls as
PyTorch does are NumPy's own, with two differences for callers to mind: whole numbers divided are
float64 (say `.float()` first), and one element of a vector is a number. What is not here is not
used by any module that imports `tensors`; a name that is missed says so itself.
"""
# mypy: disable-error-code="override"

import math
from contextlib import ContextDecorator, nullcontext
from functools import partial
from types import SimpleNamespace
from typing import Any

import numpy as np

bool = np.bool_
int32, int64, long, uint8 = np.int32, np.int64, np.int64, np.uint8
float32, float64 = np.float32, np.float64
inf, nan, pi = math.inf, math.nan, math.pi

Generator = type("Generator", (), {})  # nobody makes one: noise here is counted, not drawn


class device(str):
    """Always the CPU."""

    __slots__ = ()

    @property
    def type(self) -> str:
        """Its kind."""
        return "cpu"


CPU = device("cpu")


def _wrapped(value: Any) -> Any:
    return np.asarray(value).view(Tensor)


class Tensor(np.ndarray):
    """An array that answers to the methods of `torch.Tensor`."""

    __array_priority__ = 1.0  # what is joined of these is one, too
    device = CPU  # type: ignore[assignment]

    def __hash__(self) -> int:
        return id(self)

    # what it is, and where

    def numpy(self) -> np.ndarray:
        """The array that it is."""
        return np.ndarray.view(self, np.ndarray)

    def to(self, *to: Any, dtype: Any = None, **_: Any) -> Any:
        """In another type; devices are all one."""
        for each in to:
            if isinstance(each, Tensor):
                dtype = each.dtype
            elif each is not None and not isinstance(each, str):
                dtype = each
        return self if dtype is None or self.dtype == dtype else self.astype(dtype)

    def cpu(self) -> "Tensor":
        return self

    detach = contiguous = cpu

    def clone(self) -> Any:
        return self.copy()

    def float(self) -> Any:
        return self.to(np.float32)

    def double(self) -> Any:
        return self.to(np.float64)

    def bool(self) -> Any:
        return self.to(np.bool_)

    def numel(self) -> Any:
        return np.ndarray.size.__get__(self)

    def new_tensor(self, values: Any) -> Any:
        return tensor(values, dtype=self.dtype)

    # shape

    def view(self, *shape: Any) -> Any:
        if len(shape) == 1 and isinstance(shape[0], type):
            return np.ndarray.view(self, *shape)
        return self.reshape(*shape)

    def view_as(self, other: Any) -> Any:
        return self.reshape(other.shape)

    def reshape(self, *shape: Any, **_: Any) -> Any:
        wanted = shape[0] if len(shape) == 1 and not isinstance(shape[0], int_types) else shape
        return np.ndarray.reshape(self, tuple(wanted))

    def flatten(self, start_dim: Any = 0, end_dim: Any = -1) -> Any:
        start, end = start_dim % self.ndim, end_dim % self.ndim
        return self.reshape(*self.shape[:start], -1, *self.shape[end + 1 :])

    def unsqueeze(self, dim: Any) -> Any:
        return np.expand_dims(self, dim)

    def squeeze(self, dim: Any) -> Any:
        return np.ndarray.squeeze(self, dim) if self.shape[dim] == 1 else self

    def expand(self, *shape: Any) -> Any:
        wanted = shape[0] if len(shape) == 1 and not isinstance(shape[0], int_types) else shape
        given = (1,) * (len(wanted) - self.ndim) + self.shape
        sizes = [own if size == -1 else size for size, own in zip(wanted, given, strict=True)]
        return np.broadcast_to(self, sizes, subok=True)

    def expand_as(self, other: Any) -> Any:
        return self.expand(*other.shape)

    def unbind(self, dim: Any = 0) -> Any:
        return tuple(np.moveaxis(self, dim, 0))

    def flip(self, *dims: Any) -> Any:
        return np.flip(self, dims)

    def unfold(self, dim: Any, size: Any, step: Any) -> Any:
        assert step == 1
        return np.lib.stride_tricks.sliding_window_view(self, size, dim, subok=True)

    # element by element

    def minimum(self, other: Any) -> Any:
        return np.minimum(self, other)

    def maximum(self, other: Any) -> Any:
        return np.maximum(self, other)

    def abs(self) -> Any:
        return abs(self)

    def sqrt(self) -> Any:
        return np.sqrt(self)

    def square(self) -> Any:
        return np.square(self)

    def exp(self) -> Any:
        return np.exp(self)

    def isfinite(self) -> Any:
        return np.isfinite(self)

    def masked_fill(self, mask: Any, value: Any) -> Any:
        return where(mask, value, self)

    # along a dimension

    def norm(self, dim: Any = None, keepdim: Any = False) -> Any:
        return np.sqrt(np.square(self).sum(dim, keepdim))

    def sum(self, dim: Any = None, keepdim: Any = False) -> Any:
        return np.add.reduce(self, axis=dim, keepdims=keepdim)

    def mean(self, dim: Any = None, keepdim: Any = False) -> Any:
        return np.ndarray.mean(self, dim, keepdims=keepdim)

    def any(self, dim: Any = None, keepdim: Any = False) -> Any:
        return np.ndarray.any(self, dim, keepdims=keepdim)

    def all(self, dim: Any = None, keepdim: Any = False) -> Any:
        return np.ndarray.all(self, dim, keepdims=keepdim)

    def diff(self, dim: Any = -1) -> Any:
        return np.diff(self, axis=dim)

    def gather(self, dim: Any, index: Any) -> Any:
        """As torch's, where the index is as wide as this in the other dimensions."""
        return np.take_along_axis(self, index, dim)


int_types = (int, np.integer)


def _size(shape: tuple[Any, ...]) -> tuple[int, ...]:
    whole = shape[0] if len(shape) == 1 and not isinstance(shape[0], int_types) else shape
    return tuple(whole)


def tensor(values: Any, dtype: Any = None, **_: Any) -> Any:
    """A copy; numbers are float32, as whole numbers are int64."""
    array = np.array(values)
    if dtype is None and not isinstance(values, np.ndarray | np.generic):
        dtype = np.float32 if array.dtype == np.float64 else None
    return _wrapped(array if dtype is None else array.astype(dtype))


def as_tensor(values: Any, dtype: Any = None, **_: Any) -> Any:
    """The same memory where that is possible."""
    if isinstance(values, np.ndarray):
        return _wrapped(values if dtype is None else values.astype(dtype, copy=False))
    return tensor(values, dtype)


from_numpy = partial(np.ndarray.view, type=Tensor)


def zeros(*shape: Any, dtype: Any = None, **_: Any) -> Any:
    return _wrapped(np.zeros(_size(shape), dtype or np.float32))


def ones(*shape: Any, dtype: Any = None, **_: Any) -> Any:
    return _wrapped(np.ones(_size(shape), dtype or np.float32))


def full(shape: Any, value: Any, dtype: Any = None, **_: Any) -> Any:
    made = np.full(shape, value, dtype)
    return _wrapped(made.astype(np.float32) if dtype is None and made.dtype == np.float64 else made)


def zeros_like(like: Any, dtype: Any = None, **_: Any) -> Any:
    return zeros(like.shape, dtype=dtype or like.dtype)


def ones_like(like: Any, dtype: Any = None, **_: Any) -> Any:
    return ones(like.shape, dtype=dtype or like.dtype)


def full_like(like: Any, value: Any, **_: Any) -> Any:
    return full(like.shape, value, dtype=like.dtype)


def eye(size: int, dtype: Any = None, **_: Any) -> Any:
    return _wrapped(np.eye(size, dtype=dtype or np.float32))


def arange(*bounds: Any, dtype: Any = None, **_: Any) -> Any:
    made = np.arange(*bounds)
    return made.view(Tensor).to(dtype or (np.float32 if made.dtype == np.float64 else None))


def linspace(start: float, end: float, steps: int, dtype: Any = None, **_: Any) -> Any:
    return _wrapped(np.linspace(start, end, steps, dtype=dtype or np.float32))


def where(condition: Any, one: Any, other: Any) -> Any:
    """Float32 if both are numbers."""
    chosen = _wrapped(np.where(condition, one, other))
    numbers = not (isinstance(one, np.ndarray) or isinstance(other, np.ndarray))
    return chosen.float() if numbers else chosen


def nonzero(values: Any) -> Any:
    """Indices [N, D] of what is not zero."""
    return _wrapped(np.argwhere(values))


def lerp(start: Any, end: Any, weight: Any) -> Any:
    return start + weight * (end - start)


cat, stack, moveaxis = np.concatenate, np.stack, np.moveaxis
cumsum, remainder = np.cumsum, np.remainder
sin, cos, exp, log, sqrt, round = np.sin, np.cos, np.exp, np.log, np.sqrt, np.round
atan2, acos = np.arctan2, np.arccos


def get_num_threads() -> int:
    """NumPy's own matter to nobody: the products here are small."""
    return 1


class inference_mode(nullcontext[Any], ContextDecorator):
    """Nothing here has gradients."""


no_grad = inference_mode


def _cross(one: Any, other: Any) -> Any:
    a, b = (each.unbind(-1) for each in (one, other))
    return stack([a[i - 2] * b[i - 1] - a[i - 1] * b[i - 2] for i in range(3)], -1)


linalg = SimpleNamespace(cross=_cross)


# ---------------------------------------------------------------- modules, functions of them


class Module:
    """Something that is called; it has nothing to learn, and is where it is."""

    def __init_subclass__(cls) -> None:
        cls.__call__ = getattr(cls, "forward", None)  # type: ignore[method-assign, assignment]

    def register_buffer(self, name: str, value: Any, persistent: Any = True) -> None:
        setattr(self, name, value)

    def to(self, *_: Any, **__: Any) -> "Module":
        return self

    def eval(self) -> "Module":
        return self


nn = SimpleNamespace(Module=Module)


def _normalize(values: Any, dim: int = -1, eps: float = 1e-12) -> Any:
    return values / values.norm(dim=dim, keepdim=True).clip(eps)


def _pad(values: Any, pad: tuple[int, int], mode: str = "constant") -> Any:
    """Of the last dimension."""
    widths = [(0, 0)] * (values.ndim - 1) + [pad]
    return _wrapped(np.pad(values.numpy(), widths, "edge" if mode == "replicate" else "constant"))


def _conv1d(series: Any, weights: Any, groups: int = 1) -> Any:
    """[B, C, T] with [C, 1, W]: each channel by its own weights."""
    assert groups == series.shape[1] and weights.shape[1] == 1, "depthwise alone"
    size = series.shape[2] - weights.shape[2] + 1
    return sum(
        weights[:, 0, at, None] * series[..., at : at + size] for at in range(weights.shape[2])
    )


functional = SimpleNamespace(normalize=_normalize, pad=_pad, conv1d=_conv1d)
