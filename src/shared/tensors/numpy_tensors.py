"""What sampling and motion use of PyTorch, by NumPy on the CPU: same names, same results.

Float32 unless something says float64, as there; numbers that are no tensors widen nothing. What is
not here is not used by any module that imports `tensors`; a name that is missed says so itself.
"""
# mypy: disable-error-code="override"

import math
from collections.abc import Callable, Iterator, Sequence
from contextlib import ContextDecorator
from types import SimpleNamespace
from typing import Any

import numpy as np

bool = np.bool_
int32, int64, long, uint8 = np.int32, np.int64, np.int64, np.uint8
float32, float64 = np.float32, np.float64
nan, inf, pi = math.nan, math.inf, math.pi

Generator = type("Generator", (), {})  # nobody makes one: noise here is counted, not drawn


class device(str):
    """Always the CPU."""

    __slots__ = ()

    @property
    def type(self) -> str:
        """Its kind."""
        return "cpu"


CPU = device("cpu")


def _plain(value: Any) -> Any:
    """The same with arrays for tensors."""
    if isinstance(value, Tensor):
        return value.numpy()
    if isinstance(value, tuple | list):
        return type(value)(map(_plain, value))
    return value


def _wrapped(value: Any) -> Any:
    return np.asarray(value).view(Tensor) if isinstance(value, np.ndarray | np.generic) else value


def _narrowed(result: Any, inputs: Sequence[Any]) -> Any:
    """Float64 only where a tensor was: numbers, and those among arrays, widen nothing."""
    if getattr(result, "dtype", None) != np.float64:
        return result
    arrays = [each for each in inputs if isinstance(each, np.ndarray)]
    deciding = [each for each in arrays if each.ndim] or arrays
    wide = any(each.dtype == np.float64 for each in deciding)
    return result if wide else result.astype(np.float32)


class Tensor(np.ndarray):
    """An array that answers to the methods of `torch.Tensor`."""

    def __array_ufunc__(
        self, ufunc: Any, method: str, *inputs: Any, out: Any = None, **options: Any
    ) -> Any:
        plain = [_plain(each) for each in inputs]
        if out is not None:
            getattr(ufunc, method)(*plain, out=_plain(out), **options)
            return out[0]
        return _wrapped(_narrowed(getattr(ufunc, method)(*plain, **options), plain))

    def __array_function__(
        self, function: Callable[..., Any], types: Any, args: Any, options: Any
    ) -> Any:
        """NumPy's functions give arrays."""
        return function(*_plain(args), **{key: _plain(each) for key, each in options.items()})

    def __getitem__(self, key: Any) -> Any:
        return _wrapped(self.numpy()[_plain(key)])

    def __setitem__(self, key: Any, value: Any) -> None:
        self.numpy()[_plain(key)] = _plain(value)

    def __iter__(self) -> Iterator[Any]:
        return (self[row] for row in range(len(self)))

    def __hash__(self) -> int:
        return id(self)

    def __matmul__(self, other: Any) -> Any:
        return _wrapped(np.matmul(self.numpy(), _plain(other)))

    # what it is, and where

    @property
    def device(self) -> device:
        """The CPU."""
        return CPU

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
        return (
            self if dtype is None or self.dtype == dtype else _wrapped(self.numpy().astype(dtype))
        )

    def cpu(self) -> "Tensor":
        return self

    detach = contiguous = cpu

    def clone(self) -> Any:
        return _wrapped(self.numpy().copy())

    def float(self) -> Any:
        return self.to(np.float32)

    def double(self) -> Any:
        return self.to(np.float64)

    def bool(self) -> Any:
        return self.to(np.bool_)

    def long(self) -> Any:
        return self.to(np.int64)

    def int(self) -> Any:
        return self.to(np.int32)

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
        return _wrapped(self.numpy().reshape(tuple(wanted)))

    def transpose(self, *dims: Any) -> Any:
        return _wrapped(self.numpy().swapaxes(*dims))

    def movedim(self, source: Any, target: Any) -> Any:
        return _wrapped(np.moveaxis(self.numpy(), source, target))

    def flatten(self, start_dim: Any = 0, end_dim: Any = -1) -> Any:
        start, end = start_dim % self.ndim, end_dim % self.ndim
        return self.reshape(*self.shape[:start], -1, *self.shape[end + 1 :])

    def unsqueeze(self, dim: Any) -> Any:
        return _wrapped(np.expand_dims(self.numpy(), dim))

    def squeeze(self, dim: Any) -> Any:
        return _wrapped(self.numpy().squeeze(dim)) if self.shape[dim] == 1 else self

    def expand(self, *shape: Any) -> Any:
        wanted = shape[0] if len(shape) == 1 and not isinstance(shape[0], int_types) else shape
        given = (1,) * (len(wanted) - self.ndim) + self.shape
        sizes = [own if size == -1 else size for size, own in zip(wanted, given, strict=True)]
        return _wrapped(np.broadcast_to(self.numpy(), sizes))

    def expand_as(self, other: Any) -> Any:
        return self.expand(*other.shape)

    def unbind(self, dim: Any = 0) -> Any:
        return tuple(_wrapped(each) for each in np.moveaxis(self.numpy(), dim, 0))

    def chunk(self, chunks: Any, dim: Any = 0) -> Any:
        return tuple(_wrapped(each) for each in np.array_split(self.numpy(), chunks, dim))

    def flip(self, *dims: Any) -> Any:
        return _wrapped(np.flip(self.numpy(), dims))

    def unfold(self, dim: Any, size: Any, step: Any) -> Any:
        windows = np.lib.stride_tricks.sliding_window_view(self.numpy(), size, dim)
        assert step == 1
        return _wrapped(windows)

    # element by element

    def clamp(self, min: Any = None, max: Any = None) -> Any:
        return _wrapped(np.clip(self.numpy(), _plain(min), _plain(max)).astype(self.dtype))

    def clamp_min(self, min: Any) -> Any:
        return self.clamp(min)

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

    def log(self) -> Any:
        return np.log(self)

    def sin(self) -> Any:
        return np.sin(self)

    def cos(self) -> Any:
        return np.cos(self)

    def acos(self) -> Any:
        return np.arccos(self)

    def sign(self) -> Any:
        return np.sign(self)

    def isfinite(self) -> Any:
        return np.isfinite(self)

    def isnan(self) -> Any:
        return np.isnan(self)

    def masked_fill(self, mask: Any, value: Any) -> Any:
        return where(mask, value, self)

    def lerp(self, end: Any, weight: Any) -> Any:
        return lerp(self, end, weight)

    # along a dimension

    def norm(self, dim: Any = None, keepdim: Any = False) -> Any:
        squares = np.square(self.numpy())
        return _wrapped(np.sqrt(squares.sum(axis=dim, keepdims=keepdim)))

    def sum(self, dim: Any = None, keepdim: Any = False, **_: Any) -> Any:
        return _wrapped(self.numpy().sum(axis=dim, keepdims=keepdim))

    def mean(self, dim: Any = None, keepdim: Any = False, **_: Any) -> Any:
        return _wrapped(self.numpy().mean(axis=dim, keepdims=keepdim))

    def any(self, dim: Any = None, keepdim: Any = False, **_: Any) -> Any:
        return _wrapped(self.numpy().any(axis=dim, keepdims=keepdim))

    def all(self, dim: Any = None, keepdim: Any = False, **_: Any) -> Any:
        return _wrapped(self.numpy().all(axis=dim, keepdims=keepdim))

    def max(self) -> Any:  # the largest of all; along a dimension nobody asks
        return _wrapped(self.numpy().max())

    def min(self) -> Any:
        return _wrapped(self.numpy().min())

    def argmax(self, dim: Any = None) -> Any:
        return _wrapped(self.numpy().argmax(dim))

    def argmin(self, dim: Any = None) -> Any:
        return _wrapped(self.numpy().argmin(dim))

    def cumsum(self, dim: Any) -> Any:
        return _wrapped(self.numpy().cumsum(dim))

    def diff(self, dim: Any = -1) -> Any:
        return _wrapped(np.diff(self.numpy(), axis=dim))

    def gather(self, dim: Any, index: Any) -> Any:
        """As torch's, where the index is as wide as this in the other dimensions."""
        return _wrapped(np.take_along_axis(self.numpy(), _plain(index), dim))


int_types = (int, np.integer)


def _made(values: Any, dtype: Any) -> Any:
    return _wrapped(values if dtype is None else np.asarray(values, dtype))


def _size(shape: tuple[Any, ...]) -> tuple[int, ...]:
    whole = shape[0] if len(shape) == 1 and not isinstance(shape[0], int_types) else shape
    return tuple(whole)


def tensor(values: Any, dtype: Any = None, **_: Any) -> Any:
    """A copy; numbers are float32, as whole numbers are int64."""
    array = np.array(_plain(values))
    if dtype is None and not isinstance(values, np.ndarray | np.generic):
        dtype = np.float32 if array.dtype == np.float64 else None
    return _wrapped(array if dtype is None else array.astype(dtype))


def as_tensor(values: Any, dtype: Any = None, **_: Any) -> Any:
    """The same memory where that is possible."""
    if isinstance(values, np.ndarray):
        array = _plain(values)
        return _wrapped(array if dtype is None else array.astype(dtype, copy=False))
    return tensor(values, dtype)


def from_numpy(array: Any) -> Any:
    """The same memory."""
    return _wrapped(array)


def zeros(*shape: Any, dtype: Any = None, **_: Any) -> Any:
    return _wrapped(np.zeros(_size(shape), dtype or np.float32))


def ones(*shape: Any, dtype: Any = None, **_: Any) -> Any:
    return _wrapped(np.ones(_size(shape), dtype or np.float32))


def full(shape: Any, value: Any, dtype: Any = None, **_: Any) -> Any:
    made = np.full(shape, _plain(value), dtype)
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


def cat(tensors: Sequence[Any], dim: int = 0) -> Any:
    return _wrapped(np.concatenate([_plain(each) for each in tensors], dim))


def stack(tensors: Sequence[Any], dim: int = 0) -> Any:
    return _wrapped(np.stack([_plain(each) for each in tensors], dim))


def where(condition: Any, one: Any, other: Any) -> Any:
    values = [_plain(one), _plain(other)]
    return _wrapped(_narrowed(np.where(_plain(condition), *values), values))


def nonzero(values: Any) -> Any:
    """Indices [N, D] of what is not zero."""
    return _wrapped(np.argwhere(_plain(values)))


def searchsorted(ordered: Any, values: Any) -> Any:
    return _wrapped(np.searchsorted(_plain(ordered), _plain(values)))


def lerp(start: Any, end: Any, weight: Any) -> Any:
    return start + weight * (end - start)


def remainder(values: Any, divisor: Any) -> Any:
    return np.remainder(values, divisor)


def cumsum(values: Any, dim: int) -> Any:
    return values.cumsum(dim)


sin, cos, exp, log, sqrt, round = np.sin, np.cos, np.exp, np.log, np.sqrt, np.round
atan2, acos = np.arctan2, np.arccos


def get_num_threads() -> int:
    """NumPy's own matter to nobody: the products here are small."""
    return 1


class inference_mode(ContextDecorator):
    """Nothing here has gradients."""

    def __init__(self, mode: Any = True) -> None:
        pass

    def __enter__(self) -> None:
        pass

    def __exit__(self, *_: Any) -> None:
        pass


no_grad = inference_mode


def _cross(one: Any, other: Any) -> Any:
    a, b = (each.unbind(-1) for each in (one, other))
    return stack([a[i - 2] * b[i - 1] - a[i - 1] * b[i - 2] for i in range(3)], -1)


linalg = SimpleNamespace(cross=_cross)


# ---------------------------------------------------------------- modules, functions of them


class Module:
    """Something that is called; it has nothing to learn, and is where it is."""

    def __call__(self, *args: Any, **options: Any) -> Any:
        return self.forward(*args, **options)  # type: ignore[attr-defined]

    def register_buffer(self, name: str, value: Any, persistent: Any = True) -> None:
        setattr(self, name, value)

    def to(self, *_: Any, **__: Any) -> "Module":
        return self

    def eval(self) -> "Module":
        return self


nn = SimpleNamespace(Module=Module)


def _normalize(values: Any, dim: int = -1, eps: float = 1e-12) -> Any:
    return values / values.norm(dim=dim, keepdim=True).clamp_min(eps)


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
