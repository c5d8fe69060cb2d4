"""The passes of a training step as CUDA graphs, one for each shape of batch.

A small network has a thousand kernels of a few microseconds a step, and launching them one by one
takes several times as long as they do. Captured once they are launched as one.
https://pytorch.org/docs/stable/notes/cuda.html#cuda-graphs
"""

from collections.abc import Callable, Iterator
from dataclasses import dataclass, fields, is_dataclass
from typing import Any

import torch
from torch import Tensor, nn

WARM_UP = 3  # passes before one is captured, as PyTorch's notes have it


@dataclass
class _Captured:
    """A graph, what it reads, what it tells, and where it leaves the gradients."""

    graph: torch.cuda.CUDAGraph
    batch: Any
    metrics: dict[str, Tensor]
    gradients: list[Tensor | None]


class GraphedPasses:
    """Forward and backward pass of batches on a CUDA device.

    Args:
        module: whose gradients are wanted.
        losses: figures of a batch, `loss` among them; reads nothing back from the device.
        backward: of a loss.
    """

    def __init__(
        self,
        module: nn.Module,
        losses: Callable[[Any], dict[str, Tensor]],
        backward: Callable[[Tensor], None],
    ) -> None:
        self.weights = [weight for weight in module.parameters() if weight.requires_grad]
        self.losses, self.backward = losses, backward
        self.captured: dict[tuple[torch.Size, ...], _Captured] = {}

    def __call__(self, batch: Any) -> dict[str, Tensor]:
        """The figures of a batch on the device, until the next one; its gradients are in place."""
        shapes = tuple(tensor.shape for tensor in tensors_in(batch))
        known = self.captured.get(shapes)
        if known is None:
            known = self.captured[shapes] = self._capture(batch)
        else:
            pairs = zip(tensors_in(known.batch), tensors_in(batch), strict=True)
            for kept, new in pairs:
                kept.copy_(new, non_blocking=True)
        known.graph.replay()
        for weight, gradient in zip(self.weights, known.gradients, strict=True):
            weight.grad = gradient
        return known.metrics

    def _pass(self, batch: Any) -> dict[str, Tensor]:
        for weight in self.weights:
            weight.grad = None
        metrics = self.losses(batch)
        self.backward(metrics["loss"])
        return {name: value.detach() for name, value in metrics.items()}

    def _capture(self, batch: Any) -> _Captured:
        aside = torch.cuda.Stream()  # type: ignore[no-untyped-call]
        aside.wait_stream(torch.cuda.current_stream())
        with torch.cuda.stream(aside):
            for _ in range(WARM_UP):
                self._pass(batch)
        torch.cuda.current_stream().wait_stream(aside)
        for weight in self.weights:
            weight.grad = None
        graph = torch.cuda.CUDAGraph()
        with torch.cuda.graph(graph):
            metrics = self._pass(batch)
        return _Captured(graph, batch, metrics, [weight.grad for weight in self.weights])


def tensors_in(value: Any) -> Iterator[Tensor]:
    """Every tensor inside dicts, lists, tuples and dataclasses, in order."""
    if isinstance(value, Tensor):
        yield value
    elif isinstance(value, dict):
        for item in value.values():
            yield from tensors_in(item)
    elif isinstance(value, list | tuple):
        for item in value:
            yield from tensors_in(item)
    elif is_dataclass(value):
        for field in fields(value):
            yield from tensors_in(getattr(value, field.name))
