"""Multi-head attention over time (Vaswani et al. 2017), on the fastest kernel there is.

Letters: B batch, T frames, L context tokens, D embed dim, H heads, d = D/H.
Attention weights are not dropped out: the fused CPU kernel has no such path, and dropping
the residual branch regularises as well at this size.
"""

import torch
from torch import Tensor, nn
from torch.nn.functional import scaled_dot_product_attention

from .rope import RotaryEmbedding

KeyValue = tuple[Tensor, Tensor]  # each [B, H, L, d]


def _check_heads(dim: int, num_heads: int) -> None:
    assert dim % num_heads == 0, f"embed dim {dim} must be divisible by the {num_heads} heads"


def attend(query: Tensor, key: Tensor, value: Tensor, mask: Tensor | None) -> Tensor:
    """Softmax attention: query [B, H, T, d], key and value [B, H, L, d] -> [B, H, T, d].

    PyTorch's fused kernel, except while training in bf16 on the CPU: there its backward pass
    takes 6 times as long as three plain matrix products (43 against 7 ms at B=64, T=96, H=4).

    Args:
        mask: [B, L] bool, True = real, or None.
    """
    keep = None if mask is None else mask[:, None, None, :]  # [B, 1, 1, L]
    if not (query.requires_grad and query.dtype == torch.bfloat16 and query.device.type == "cpu"):
        return scaled_dot_product_attention(query, key, value, keep)
    scores = torch.matmul(query * query.shape[-1] ** -0.5, key.transpose(-1, -2))  # [B, H, T, L]
    if keep is not None:
        scores = scores + torch.zeros_like(keep, dtype=scores.dtype).masked_fill(~keep, -1e4)
    return torch.matmul(scores.softmax(dim=-1), value)


class MultiHeadAttention(nn.Module):
    """Self-attention; `rotary` turns q and k by their positions inside (ruling 22)."""

    def __init__(self, dim: int, num_heads: int, *, rotary: bool = False) -> None:
        super().__init__()
        _check_heads(dim, num_heads)
        self.num_heads = num_heads
        self.qkv = nn.Linear(dim, 3 * dim)
        self.rotary = RotaryEmbedding(dim // num_heads) if rotary else None
        self.out = nn.Linear(dim, dim)

    def forward(self, x: Tensor, mask: Tensor | None = None) -> Tensor:
        """x [B, T, D], mask [B, T] bool (True = real) or None -> [B, T, D]."""
        qkv = self.qkv(x).unflatten(-1, (3 * self.num_heads, -1))  # [B, T, 3H, d]
        if self.rotary is None:
            query, key, value = qkv.chunk(3, dim=2)  # [B, T, H, d] each
        else:
            positioned, value = qkv.split([2 * self.num_heads, self.num_heads], dim=2)
            query, key = self.rotary(positioned).chunk(2, dim=2)  # [B, T, H, d] each
        mixed = attend(
            query.transpose(1, 2), key.transpose(1, 2), value.transpose(1, 2), mask
        )  # [B, H, T, d]
        return self.out(mixed.transpose(1, 2).flatten(2))


class CrossAttention(nn.Module):
    """Attention from frames to a context of its own length; keys and values can be kept."""

    def __init__(self, dim: int, num_heads: int) -> None:
        super().__init__()
        _check_heads(dim, num_heads)
        self.num_heads = num_heads
        self.query = nn.Linear(dim, dim)
        self.key_value = nn.Linear(dim, 2 * dim)
        self.out = nn.Linear(dim, dim)

    def keys_values(self, context: Tensor) -> KeyValue:
        """Context [B, L, D] -> keys and values, which need computing once a sample only."""
        heads = self.key_value(context).unflatten(-1, (2 * self.num_heads, -1))  # [B, L, 2H, d]
        key, value = heads.transpose(1, 2).chunk(2, dim=1)  # [B, H, L, d] each
        return key, value

    def forward(self, x: Tensor, keys_values: KeyValue, mask: Tensor | None = None) -> Tensor:
        """x [B, T, D], keys and values of the context, its mask [B, L] -> [B, T, D]."""
        query = self.query(x).unflatten(-1, (self.num_heads, -1)).transpose(1, 2)  # [B, H, T, d]
        mixed = attend(query, *keys_values, mask)  # [B, H, T, d]
        return self.out(mixed.transpose(1, 2).flatten(2))
