"""Layers that two networks or more are built of: attention over time, what carries a condition.

Multi-head attention (Vaswani et al. 2017), rotary positions (Su et al. 2021, RoFormer, equation
34), sinusoidal codes for any number of positions; FiLM, adaptive layer norm, embeddings of step and
tag; the pre-norm transformer layer and its dropout; TemporalUNet, motion to one vector (TEXT).
Masks are bool, True = real.

Letters: B batch, T frames or positions, L context tokens, D embed dim, E condition channels,
H heads, d = D/H. Attention weights are not dropped out: the fused CPU kernel has no such path, and
dropping the residual branch regularises as well at this size.
"""

import math
from collections.abc import Sequence
from typing import TypeVar

import torch
from einops import rearrange
from torch import Tensor, nn
from torch.nn.functional import gelu, pad, scaled_dot_product_attention

MAX_PERIOD = 10_000.0  # of positions, both as codes and as turns
LayerT = TypeVar("LayerT", nn.Linear, nn.Conv1d)


def zeroed(layer: LayerT) -> LayerT:
    """The layer with zero weights, adapters aside: a residual branch that starts silent."""
    for parameter in layer.parameters(recurse=False):
        nn.init.zeros_(parameter)
    return layer


def sinusoidal(positions: Tensor, dim: int) -> Tensor:
    """Codes [..., dim] float32 of positions [...]: cosines in the first half, then sines.

    Vaswani et al. 2017, section 3.5. An odd `dim` ends with one zero.
    """
    half = dim // 2
    steps = torch.arange(half, dtype=torch.float32, device=positions.device)
    frequencies = torch.exp(steps * (-math.log(MAX_PERIOD) / max(half, 1)))
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
    if torch.compiler.is_compiling():  # an exported graph takes any mask
        return mask
    if mask is not None and mask.device.type == "cpu" and bool(mask.all()):
        return None
    return mask


class RotaryEmbedding(nn.Module):
    """Turns channel pairs (i, i + d/2) of a head by an angle that grows with the position.

    Positions are frames of the full rate: with a stride, piece i lies in the middle of its own
    frames, so that queries and keys of two rates turn by their distance in time.
    """

    def __init__(self, head_dim: int, *, stride: int = 1) -> None:
        super().__init__()
        assert head_dim % 2 == 0, f"head dim {head_dim} must be even"
        self.stride = stride
        exponents = torch.arange(0, head_dim, 2, dtype=torch.float32) / head_dim
        self.frequencies: Tensor
        self.register_buffer("frequencies", MAX_PERIOD**-exponents, persistent=False)  # [d/2]
        self._cos: Tensor | None = None
        self._sin: Tensor | None = None
        self._former: list[Tensor | None] = []  # CUDA graphs may still read them

    def forward(self, heads: Tensor) -> Tensor:
        """[..., T, H, d] -> the same, rotated, in its own dtype; angles are float32 always."""
        cos, sin = self._tables(heads.shape[-3], heads.device)  # [T, 1, d/2] each
        cos, sin = cos.to(heads.dtype), sin.to(heads.dtype)
        first, second = heads.chunk(2, dim=-1)
        return torch.cat([first * cos - second * sin, second * cos + first * sin], dim=-1)

    def _tables(self, length: int, device: torch.device) -> tuple[Tensor, Tensor]:
        frames = length * self.stride
        if self._cos is None or len(self._cos) < frames or self._cos.device != device:
            self._former += [self._cos, self._sin]
            # Made outside inference mode: training may reuse a table that sampling made first.
            with torch.inference_mode(False), torch.no_grad():
                positions = torch.arange(max(frames, 256), dtype=torch.float32, device=device)
                angles = positions[:, None, None] * self.frequencies.to(device).clone()
                self._cos, self._sin = angles.cos(), angles.sin()
        assert self._cos is not None and self._sin is not None
        middles = slice(self.stride // 2, frames, self.stride)
        return self._cos[middles], self._sin[middles]


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


class AdaptedLinear(nn.Linear):
    """A linear map and low-rank adapters beside it, each for the samples that open it.

    Hu et al. 2022, LoRA, equation 3. Adapters start at zero.
    """

    def __init__(self, dim: int, out_dim: int, ranks: Sequence[int] = ()) -> None:
        super().__init__(dim, out_dim)
        self.rank = max(ranks, default=0)
        self.adapters = nn.ModuleList(
            nn.Sequential(
                nn.Linear(dim, rank, bias=False), zeroed(nn.Linear(rank, out_dim, bias=False))
            )
            for rank in ranks
        )

    def forward(self, x: Tensor, opened: Tensor | None = None) -> Tensor:
        """x [B, T, D], opened [B, A], one of the A adapters or none for each sample, or None: no
        sample opens one -> [B, T, out_dim]."""
        y = super().forward(x)
        if opened is None:
            return y
        # The weights of each sample's own adapter: as fast with twenty adapters as with one.
        own, share = opened.argmax(-1), opened.amax(-1)[:, None, None]
        # Learning one, a sixth of a step less: one product for all samples.
        eager = torch.is_grad_enabled() and not torch.compiler.is_compiling()
        if eager and x.device.type == "cpu" and len(own) and bool((own == own[0]).all()):
            first, second = self.adapters[int(own[0])].children()
            learned: Tensor = second(first(x) * share)
            return y + learned
        down, up = (self.table(layer).index_select(0, own) for layer in (0, 1))  # B R D, B D' R
        return y + x @ down.mT * share @ up.mT

    def table(self, layer: int) -> Tensor:
        """The first or second map of every adapter, filled up with zeros to the largest rank."""
        weights = [adapter.get_parameter(f"{layer}.weight") for adapter in self.adapters]
        spare = [self.rank - each.shape[layer] for each in weights]
        fills = [(0, 0, 0, each) if layer == 0 else (0, each) for each in spare]
        return torch.stack([pad(w, fill) if any(fill) else w
                            for w, fill in zip(weights, fills, strict=True)])  # fmt: skip


class MultiHeadAttention(nn.Module):
    """Self-attention; `rotary` turns q and k by their positions inside (ruling 22)."""

    def __init__(
        self, dim: int, num_heads: int, *, rotary: bool = False, ranks: Sequence[int] = ()
    ) -> None:
        super().__init__()
        _check_heads(dim, num_heads)
        self.num_heads = num_heads
        self.qkv = AdaptedLinear(dim, 3 * dim, ranks)
        self.rotary = RotaryEmbedding(dim // num_heads) if rotary else None
        self.out = AdaptedLinear(dim, dim, ranks)

    def forward(
        self, x: Tensor, mask: Tensor | None = None, opened: Tensor | None = None
    ) -> Tensor:
        """x [B, T, D], mask [B, T] bool (True = real) or None, opened as in AdaptedLinear
        -> [B, T, D]."""
        heads = rearrange(self.qkv(x, opened), "b t (n d) -> b t n d", n=3 * self.num_heads)
        if self.rotary is not None:
            positioned, value = heads.split([2 * self.num_heads, self.num_heads], dim=2)
            heads = torch.cat([self.rotary(positioned), value], dim=2)
        query, key, value = heads.transpose(1, 2).chunk(3, dim=1)  # [B, H, T, d] each
        mixed = attend(query, key, value, mask)  # [B, H, T, d]
        result: Tensor = self.out(rearrange(mixed, "b h t d -> b t (h d)"), opened)
        return result


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
        result: Tensor = self.out(rearrange(mixed, "b h t d -> b t (h d)"))
        return result


class FiLM(nn.Module):
    """x * (1 + scale) + shift, both read off the condition; starts as the identity.

    Perez et al. 2018, FiLM, equation 1.
    """

    def __init__(self, dim: int, condition_dim: int) -> None:
        super().__init__()
        self.modulation = zeroed(nn.Linear(condition_dim, 2 * dim))

    def forward(self, x: Tensor, condition: Tensor) -> Tensor:
        """x [B, T, D], condition [B, E] -> [B, T, D]."""
        scale, shift = self.modulation(condition)[:, None].chunk(2, dim=-1)  # [B, 1, D] each
        result: Tensor = x * (1 + scale) + shift
        return result


class AdaLN(nn.Module):
    """Layer norm whose scale and shift come from the condition; starts as a plain layer norm.

    Peebles and Xie 2023, DiT, section 3.2.
    """

    def __init__(self, dim: int, condition_dim: int) -> None:
        super().__init__()
        self.norm = nn.LayerNorm(dim, elementwise_affine=False)
        self.film = FiLM(dim, condition_dim)

    def forward(self, x: Tensor, condition: Tensor) -> Tensor:
        """x [B, T, D], condition [B, E] -> [B, T, D]."""
        result: Tensor = self.film(self.norm(x), condition)
        return result


class TimestepEmbedding(nn.Module):
    """Sinusoidal code of the step, then an MLP D -> 4D -> D."""

    def __init__(self, dim: int) -> None:
        super().__init__()
        self.dim = dim
        self.mlp = nn.Sequential(nn.Linear(dim, 4 * dim), nn.SiLU(), nn.Linear(4 * dim, dim))

    def forward(self, timesteps: Tensor) -> Tensor:
        """Steps [B] -> [B, D]."""
        code = sinusoidal(timesteps, self.dim)  # [B, D]
        result: Tensor = self.mlp(code)
        return result


class TagEmbedding(nn.Module):
    """One vector a tag; the last index, `num_tags`, stands for "no tag" (ruling 25)."""

    def __init__(self, num_tags: int, dim: int) -> None:
        super().__init__()
        self.num_tags = num_tags
        self.embedding = nn.Embedding(num_tags + 1, dim)
        nn.init.normal_(self.embedding.weight, std=dim**-0.5)

    def forward(self, tags: Tensor) -> Tensor:
        """Tag indices [B], `num_tags` where there is none -> [B, D]."""
        result: Tensor = self.embedding(tags)
        return result


class ChannelDropout(nn.Module):
    """Drops the same channels in all frames of a sample: one random number a channel.

    Gal and Ghahramani 2016, variational dropout. Drawing one for every value costs a tenth of a
    training step on the CPU.
    """

    def __init__(self, p: float) -> None:
        super().__init__()
        self.p = p

    def forward(self, x: Tensor) -> Tensor:
        """x [B, T, D] -> the same shape; the identity in eval mode and for p = 0."""
        if not self.training or self.p == 0:
            return x
        keep = torch.rand(x.shape[0], 1, x.shape[2], device=x.device) >= self.p  # [B, 1, D]
        return x * (keep / (1 - self.p)).to(x.dtype)


class TransformLayer(nn.Module):
    """Two linear maps around a GELU; adds its input when the two widths match."""

    def __init__(
        self,
        dim: int,
        out_dim: int | None = None,
        *,
        expansion: int = 4,
        dropout: float = 0.0,
        ranks: Sequence[int] = (),
    ) -> None:
        super().__init__()
        out_dim = dim if out_dim is None else out_dim
        self.residual = out_dim == dim
        self.expand = AdaptedLinear(dim, expansion * dim, ranks)
        self.activation = nn.GELU()
        self.contract = AdaptedLinear(expansion * dim, out_dim, ranks)
        self.dropout = ChannelDropout(dropout)

    def forward(self, x: Tensor, opened: Tensor | None = None) -> Tensor:
        """x [B, T, D], opened as in AdaptedLinear -> [B, T, out_dim]."""
        hidden = self.activation(self.expand(x, opened))  # [B, T, 4D]
        y: Tensor = self.dropout(self.contract(hidden, opened))  # [B, T, out_dim]
        return x + y if self.residual else y


class TemporalLayer(nn.Module):
    """Self-attention and a feed-forward network, each behind a layer norm with a residual."""

    def __init__(
        self,
        dim: int,
        num_heads: int,
        *,
        expansion: int = 4,
        dropout: float = 0.0,
        rotary: bool = False,
        ranks: Sequence[int] = (),
    ) -> None:
        super().__init__()
        self.attention_norm = nn.LayerNorm(dim)
        self.attention = MultiHeadAttention(dim, num_heads, rotary=rotary, ranks=ranks)
        self.dropout = ChannelDropout(dropout)
        self.feed_forward_norm = nn.LayerNorm(dim)
        self.feed_forward = TransformLayer(dim, expansion=expansion, dropout=dropout, ranks=ranks)
        self.feed_forward.residual = False  # the residual goes around the norm

    def forward(
        self, x: Tensor, mask: Tensor | None = None, opened: Tensor | None = None
    ) -> Tensor:
        """x [B, T, D], mask [B, T] bool (True = real) or None, opened as in AdaptedLinear
        -> [B, T, D]."""
        x = x + self.dropout(self.attention(self.attention_norm(x), mask, opened))  # [B, T, D]
        result: Tensor = x + self.feed_forward(self.feed_forward_norm(x), opened)
        return result


class DenoiserBlock(nn.Module):
    """TemporalLayer, FiLM, LayerNorm, MHA with RoPE, AdaLN, TransformLayer (TEXT's order).

    With `tokens` a cross-attention to the text follows the MHA (ruling 22).
    """

    def __init__(
        self, dim: int, num_heads: int, *, dropout: float, tokens: bool, ranks: Sequence[int] = ()
    ) -> None:
        super().__init__()
        self.temporal = TemporalLayer(dim, num_heads, dropout=dropout, rotary=True, ranks=ranks)
        self.film = FiLM(dim, 2 * dim)
        self.norm = nn.LayerNorm(dim)
        self.attention = MultiHeadAttention(dim, num_heads, rotary=True, ranks=ranks)
        self.cross_norm = nn.LayerNorm(dim) if tokens else None
        self.cross_attention = CrossAttention(dim, num_heads) if tokens else None
        self.adaln = AdaLN(dim, 2 * dim)
        self.transform = TransformLayer(dim, dropout=dropout, ranks=ranks)
        self.dropout = ChannelDropout(dropout)

    def forward(
        self,
        h: Tensor,
        condition: Tensor,
        mask: Tensor | None = None,
        text: KeyValue | None = None,
        text_mask: Tensor | None = None,
        opened: Tensor | None = None,
    ) -> Tensor:
        """h [B, T, D], condition [B, 2D], masks [B, T] and [B, L], opened as in AdaptedLinear
        -> [B, T, D]."""
        h = self.temporal(h, mask, opened)  # [B, T, D]
        h = self.film(h, condition)  # [B, T, D]
        h = h + self.dropout(self.attention(self.norm(h), mask, opened))  # [B, T, D]
        if self.cross_attention is not None and self.cross_norm is not None:
            assert text is not None, "a block with cross-attention needs the text tokens"
            attended = self.cross_attention(self.cross_norm(h), text, text_mask)  # [B, T, D]
            h = h + self.dropout(attended)
        h = self.adaln(h, condition)  # [B, T, D]
        result: Tensor = self.transform(h, opened)  # [B, T, D]
        return result


# ---------------------------------------------------------------- a motion as one vector


class TemporalUNet(nn.Module):
    """The motion tower of CLIP: strided convolutions shorten time by 8, a transformer reads it, the
    mean sums it up.

    Padded frames are zeroed before each convolution, so a clip gets the same vector alone and
    in a padded batch.
    """

    def __init__(
        self, motion_dim: int, dim: int, *, num_heads: int, num_layers: int, dropout: float = 0.1
    ) -> None:
        super().__init__()
        self.input_proj = nn.Linear(motion_dim, dim)
        self.conv4 = nn.Conv1d(dim, dim, kernel_size=7, stride=4, padding=3)
        self.conv2 = nn.Conv1d(dim, dim, kernel_size=3, stride=2, padding=1)
        self.layers = nn.ModuleList(
            TemporalLayer(dim, num_heads, expansion=2, dropout=dropout) for _ in range(num_layers)
        )
        self.norm = nn.LayerNorm(dim)
        self.output_proj = nn.Linear(dim, dim)

    def forward(self, motion: Tensor, mask: Tensor | None = None) -> Tensor:
        """motion [B, T, K, C], mask [B, T] bool (True = real) or None -> [B, D]."""
        mask = without_full_mask(mask)
        h = self.input_proj(motion.flatten(2))  # [B, T, D]
        h, mask = self._shorten(h, mask, self.conv4)  # [B, ceil(T/4), D]
        h, mask = self._shorten(h, mask, self.conv2)  # [B, T', D]
        positions = torch.arange(h.shape[1], device=h.device)
        h = h + sinusoidal(positions, h.shape[2])  # [B, T', D]
        for layer in self.layers:
            h = layer(h, mask)  # [B, T', D]
        pooled = masked_mean(self.norm(h), mask)  # [B, D]
        result: Tensor = self.output_proj(pooled)
        return result

    @staticmethod
    def _shorten(h: Tensor, mask: Tensor | None, conv: nn.Conv1d) -> tuple[Tensor, Tensor | None]:
        stride = conv.stride[0]
        if mask is not None:
            h = h * mask[..., None].to(h.dtype)
        h = gelu(conv(h.transpose(1, 2))).transpose(1, 2)
        return h, None if mask is None else mask[:, ::stride]
