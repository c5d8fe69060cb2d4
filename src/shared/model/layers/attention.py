"""Attention over time, its positions and masks, on the fastest kernel there is.

Multi-head attention (Vaswani et al. 2017), rotary positions (Su et al. 2021, RoFormer, equation
34), sinusoidal codes for any number of positions. Masks are bool, True = real.

Letters: B batch, T frames or positions, L context tokens, D embed dim, H heads, d = D/H.
Attention weights are not dropped out: the fused CPU kernel has no such path, and dropping
the residual branch regularises as well at this size.
"""

import math

import torch
from einops import rearrange
from torch import Tensor, nn
from torch.nn.functional import scaled_dot_product_attention


def sinusoidal(positions: Tensor, dim: int, *, max_period: float = 10_000.0) -> Tensor:
    """Codes [..., dim] float32 of positions [...]: cosines in the first half, then sines.

    Vaswani et al. 2017, section 3.5. An odd `dim` ends with one zero.
    """
    half = dim // 2
    steps = torch.arange(half, dtype=torch.float32, device=positions.device)
    frequencies = torch.exp(steps * (-math.log(max_period) / max(half, 1)))
    angles = positions.float()[..., None] * frequencies  # [..., dim/2]
    codes = torch.cat([angles.cos(), angles.sin()], dim=-1)
    return torch.nn.functional.pad(codes, (0, dim - 2 * half))


def masked_mean(values: Tensor, mask: Tensor | None) -> Tensor:
    """Mean over the real rows: values [B, T, D], mask [B, T] or None -> [B, D]."""
    if mask is None:
        return values.mean(dim=1)
    weights = mask.to(values.dtype)[..., None]  # [B, T, 1]
    return (values * weights).sum(dim=1) / weights.sum(dim=1).clamp_min(1.0)


def without_full_mask(mask: Tensor | None) -> Tensor | None:
    """None when nothing is padded, so that attention takes its faster path.

    Only looked at on the CPU: elsewhere the look itself would stall the device.
    """
    if mask is not None and mask.device.type == "cpu" and bool(mask.all()):
        return None
    return mask


class RotaryEmbedding(nn.Module):
    """Turns channel pairs (i, i + d/2) of a head by an angle that grows with the position."""

    def __init__(self, head_dim: int, *, base: float = 10_000.0) -> None:
        super().__init__()
        assert head_dim % 2 == 0, f"head dim {head_dim} must be even"
        exponents = torch.arange(0, head_dim, 2, dtype=torch.float32) / head_dim
        self.frequencies: Tensor
        self.register_buffer("frequencies", base**-exponents, persistent=False)  # [d/2]
        self._cos: Tensor | None = None
        self._sin: Tensor | None = None

    def forward(self, heads: Tensor) -> Tensor:
        """[..., T, H, d] -> the same, rotated, in its own dtype; angles are float32 always."""
        tables = self._tables(heads.shape[-3], heads.device)  # [T, 1, d/2] each
        cos, sin = (table.to(heads.dtype) for table in tables)
        first, second = heads.chunk(2, dim=-1)
        return torch.cat([first * cos - second * sin, second * cos + first * sin], dim=-1)

    def _tables(self, length: int, device: torch.device) -> tuple[Tensor, Tensor]:
        if self._cos is None or len(self._cos) < length or self._cos.device != device:
            # Made outside inference mode: training may reuse a table that sampling made first.
            with torch.inference_mode(False), torch.no_grad():
                positions = torch.arange(max(length, 256), dtype=torch.float32, device=device)
                angles = positions[:, None, None] * self.frequencies.to(device).clone()
                self._cos, self._sin = angles.cos(), angles.sin()
        assert self._cos is not None and self._sin is not None
        return self._cos[:length], self._sin[:length]


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
        heads = rearrange(self.qkv(x), "b t (n d) -> b t n d", n=3 * self.num_heads)
        if self.rotary is not None:
            positioned, value = heads.split([2 * self.num_heads, self.num_heads], dim=2)
            heads = torch.cat([self.rotary(positioned), value], dim=2)
        query, key, value = heads.transpose(1, 2).chunk(3, dim=1)  # [B, H, T, d] each
        mixed = attend(query, key, value, mask)  # [B, H, T, d]
        return self.out(rearrange(mixed, "b h t d -> b t (h d)"))


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
        key, value = rearrange(
            self.key_value(context), "b l (n h d) -> n b h l d", n=2, h=self.num_heads
        )
        return key, value

    def forward(self, x: Tensor, keys_values: KeyValue, mask: Tensor | None = None) -> Tensor:
        """x [B, T, D], keys and values of the context, its mask [B, L] -> [B, T, D]."""
        query = rearrange(self.query(x), "b t (h d) -> b h t d", h=self.num_heads)
        mixed = attend(query, *keys_values, mask)  # [B, H, T, d]
        return self.out(rearrange(mixed, "b h t d -> b t (h d)"))
