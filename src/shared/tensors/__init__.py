"""The tensors of all that samples and moves, but does not learn: PyTorch's, or NumPy's instead.

Modules that both may serve say `from ..tensors import torch, Tensor` and are written for PyTorch,
of which these are nothing but the names. A process that is to do without it, by
`compute_without_torch`, or a machine that has none, gets the few functions of `numpy_tensors` that
those modules use.
"""

import sys
from importlib.util import find_spec
from typing import TYPE_CHECKING

from .. import environment

torch_is_here = "torch" in sys.modules or (
    not environment.torch_unwanted and find_spec("torch") is not None
)

if TYPE_CHECKING or torch_is_here:
    import torch
    from torch import Tensor, nn
    from torch.nn import functional as F
else:
    from . import numpy_tensors as torch
    from .numpy_tensors import Tensor, nn
    from .numpy_tensors import functional as F

__all__ = ["F", "Tensor", "nn", "torch", "torch_is_here"]
