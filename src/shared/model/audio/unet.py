"""UNet1D: the diffusion network of the audio branch, and its blocks (TECH 3.1, REF).

Rulings 1 to 4 and 14. Letters: B batch, T frames (level i has T/2^i of them), C channels of a
level, E channels of the time embedding or of a condition, L frames of the audio context, H heads,
d = C/H.
"""

import copy
from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise

import torch
from torch import Tensor, nn
from torch.nn import functional as F
from torch.utils.checkpoint import checkpoint

from ...config_audio import NORM_GROUPS, AudioConditionConfig, MemoryConditionConfig, UNetConfig
from ..layers import KeyValue, RotaryEmbedding, attend, sinusoidal, zeroed
from . import CONDITION_ROWS, MIN_FRAMES, with_phase_rows
from .conditioning import AudioConditioner, MemoryCondition, MemoryJoin, Remembered


class ZeroConv1d(nn.Conv1d):
    """A convolution with zero weights: a branch that starts silent."""

    def reset_parameters(self) -> None:
        """Draw as its parent does, so that the layers after it start alike, then zero."""
        super().reset_parameters()
        for parameter in self.parameters():
            nn.init.zeros_(parameter)


class FiLMLayer(nn.Module):
    """Per-frame feature-wise modulation (Perez et al. 2018, eq. 1); starts as the identity.

    gamma and beta depend on the condition alone: `gamma_beta` may run once a sample and
    `modulate` once a step.
    """

    def __init__(self, channels: int, condition_dim: int) -> None:
        super().__init__()
        self.mlp = nn.Sequential(nn.SiLU(), ZeroConv1d(condition_dim, 2 * channels, 1))

    def gamma_beta(self, condition: Tensor) -> Tensor:
        """Condition [B, E, T] -> both modulations [B, 2C, T]."""
        result: Tensor = self.mlp(condition)
        return result

    @staticmethod
    def modulate(h: Tensor, gamma_beta: Tensor) -> Tensor:
        """h [B, C, T], modulations [B, 2C, T] -> [B, C, T]; gamma counts from 1."""
        gamma, beta = gamma_beta.chunk(2, dim=1)
        return torch.addcmul(h + beta, h, gamma)

    def forward(self, h: Tensor, condition: Tensor) -> Tensor:
        """h [B, C, T], condition [B, E, T] -> [B, C, T] (REF's signature)."""
        return self.modulate(h, self.gamma_beta(condition))


class ResBlock(nn.Module):
    """Two convolutions around the time embedding and the per-frame FiLM.

    Args:
        channels: of the input.
        out_channels: of the output.
        time_embed_dim: E of the time embedding.
        condition_dim: E of the FiLM condition; None = no FiLM.
        use_scale_shift_norm: TECH's way to use the time; otherwise it is added (REF).
    """

    def __init__(
        self,
        channels: int,
        out_channels: int,
        time_embed_dim: int,
        *,
        condition_dim: int | None = None,
        dropout: float = 0.1,
        use_scale_shift_norm: bool = True,
    ) -> None:
        super().__init__()
        self.use_scale_shift_norm = use_scale_shift_norm
        self.norm1 = nn.GroupNorm(NORM_GROUPS, channels)
        self.conv1 = nn.Conv1d(channels, out_channels, 3, padding=1)
        time_dim = out_channels * (2 if use_scale_shift_norm else 1)
        self.time_mlp = nn.Sequential(nn.SiLU(), nn.Linear(time_embed_dim, time_dim))
        self.norm2 = nn.GroupNorm(NORM_GROUPS, out_channels)
        self.film = None if condition_dim is None else FiLMLayer(out_channels, condition_dim)
        self.dropout = nn.Dropout(dropout)
        self.conv2 = ZeroConv1d(out_channels, out_channels, 3, padding=1)
        same = channels == out_channels
        self.skip_conv = nn.Identity() if same else nn.Conv1d(channels, out_channels, 1)

    def forward(self, x: Tensor, time_emb: Tensor, gamma_beta: Tensor | None = None) -> Tensor:
        """x [B, C, T], time [B, E], modulations of `film` [B, 2C', T] -> [B, C', T]."""
        h = self.conv1(F.silu(self.norm1(x)))  # [B, C', T]
        time_out = self.time_mlp(time_emb)[:, :, None]  # [B, 2C' or C', 1]
        if self.use_scale_shift_norm:
            scale, shift = time_out.chunk(2, dim=1)
            h = self.norm2(h) * (1 + scale) + shift
        else:
            h = self.norm2(h + time_out)
        if gamma_beta is not None:
            h = FiLMLayer.modulate(h, gamma_beta)
        h = self.conv2(self.dropout(F.silu(h)))  # [B, C', T]
        result: Tensor = h + self.skip_conv(x)
        return result


class AttentionBlock(nn.Module):
    """Self-attention, then cross-attention to the audio context, which keeps its own length.

    Args:
        channels: of the feature map.
        num_heads: must divide them.
        context_dim: channels of the context; None = no cross-attention.
        rotary: turn queries and keys by their frame (ours); TECH has no positions.
        stride: frames of the full rate behind one piece here.
    """

    def __init__(
        self,
        channels: int,
        num_heads: int = 8,
        context_dim: int | None = None,
        *,
        rotary: bool = True,
        stride: int = 1,
    ) -> None:
        super().__init__()
        self.num_heads = num_heads
        head_dim = channels // num_heads
        self.rotary = RotaryEmbedding(head_dim, stride=stride) if rotary else None
        self.norm = nn.GroupNorm(NORM_GROUPS, channels)
        self.qkv = nn.Linear(channels, 3 * channels)
        self.proj = zeroed(nn.Linear(channels, channels))
        self.has_context = context_dim is not None
        if context_dim is not None:
            self.context_rotary = RotaryEmbedding(head_dim) if rotary else None
            self.cross_norm = nn.GroupNorm(NORM_GROUPS, channels)
            self.q_cross = nn.Linear(channels, channels)
            self.kv_cross = nn.Linear(context_dim, 2 * channels)
            self.proj_cross = zeroed(nn.Linear(channels, channels))

    def keys_values(self, context: Tensor) -> KeyValue:
        """Context [B, L, E] -> keys and values [B, H, L, d], computed once a sample (ruling 3)."""
        both = self.kv_cross(context).unflatten(-1, (2, self.num_heads, -1))
        key, value = both.unbind(2)  # [B, L, H, d]
        if self.context_rotary is not None:
            key = self.context_rotary(key)
        return key.transpose(1, 2), value.transpose(1, 2)

    def forward(self, x: Tensor, keys_values: KeyValue | None = None) -> Tensor:
        """x [B, C, T] -> [B, C, T]."""
        # Rows are laid out anew: a transposed view takes a slow matrix product.
        rows = self.norm(x).transpose(1, 2).contiguous()  # [B, T, C]
        query, key, value = self.qkv(rows).unflatten(-1, (3, self.num_heads, -1)).unbind(2)
        if self.rotary is not None:
            query, key = self.rotary(query), self.rotary(key)
        out = attend(query.transpose(1, 2), key.transpose(1, 2), value.transpose(1, 2), None)
        x = x + self.proj(out.transpose(1, 2).flatten(2)).transpose(1, 2)  # [B, C, T]
        if keys_values is None:
            return x
        rows = self.cross_norm(x).transpose(1, 2).contiguous()
        query = self.q_cross(rows).unflatten(-1, (self.num_heads, -1))  # [B, T, H, d]
        if self.rotary is not None:
            query = self.rotary(query)
        out = attend(query.transpose(1, 2), *keys_values, None)  # [B, H, T, d]
        result: Tensor = x + self.proj_cross(out.transpose(1, 2).flatten(2)).transpose(1, 2)
        return result


class Downsample(nn.Module):
    """Half as many frames, by a convolution of stride 2."""

    def __init__(self, channels: int) -> None:
        super().__init__()
        self.conv = nn.Conv1d(channels, channels, 3, stride=2, padding=1)

    def forward(self, x: Tensor) -> Tensor:
        """[B, C, T] -> [B, C, T/2]."""
        result: Tensor = self.conv(x)
        return result


class Upsample(nn.Module):
    """Twice as many frames: each one repeated, then a convolution."""

    def __init__(self, channels: int) -> None:
        super().__init__()
        self.conv = nn.Conv1d(channels, channels, 3, padding=1)

    def forward(self, x: Tensor) -> Tensor:
        """[B, C, T] -> [B, C, 2T]."""
        result: Tensor = self.conv(x.repeat_interleave(2, dim=-1))
        return result


# ---------------------------------------------------------------- stages


@dataclass(frozen=True)
class StageCondition:
    """The audio condition of one stage; None where it has no such layers."""

    film: tuple[Tensor | None, ...]  # for each ResBlock [B, 2C, T]
    keys_values: KeyValue | None  # of the cross-attention, [B, H, L, d] each


class Stage(nn.Module):
    """ResBlocks of one resolution, and one attention after the block `attention_after`.

    Args:
        config: of the whole network.
        widths: channels in, then out of each block.
        factor: downsampling factor here.
        condition_dim: E of the FiLM condition; None = no FiLM.
        attention_after: index of a block; None = no attention.
    """

    def __init__(
        self,
        config: UNetConfig,
        widths: Sequence[int],
        factor: int,
        condition_dim: int | None,
        attention_after: int | None,
    ) -> None:
        super().__init__()
        self.factor = factor
        self.attention_after = attention_after
        self.blocks = nn.ModuleList(
            ResBlock(
                before,
                after,
                config.time_embed_dim,
                condition_dim=condition_dim,
                dropout=config.dropout,
                use_scale_shift_norm=config.use_scale_shift_norm,
            )
            for before, after in pairwise(widths)
        )
        self.attention: AttentionBlock | None = None
        if attention_after is not None:
            channels = widths[attention_after + 1]
            self.attention = AttentionBlock(
                channels,
                config.heads(channels),
                None if config.conditioning == "film" else config.context_dim,
                rotary=config.rotary,
                stride=factor,
            )

    def prepare(self, audio: Tensor | None, context: Tensor | None) -> StageCondition:
        """Audio for FiLM [B, E, T] at this rate, context [B, L, E]; None = not in use."""
        film: list[Tensor | None] = [None] * len(self.blocks)
        if audio is not None:
            layers = [block.film for block in self.blocks]
            film = [layer.gamma_beta(audio) for layer in layers if isinstance(layer, FiLMLayer)]
        keys_values = None
        if context is not None and self.attention is not None:
            keys_values = self.attention.keys_values(context)
        return StageCondition(tuple(film), keys_values)

    def forward(self, h: Tensor, time_emb: Tensor, condition: StageCondition) -> Tensor:
        """h [B, C, T], time [B, E] -> [B, C', T]."""
        for index, block in enumerate(self.blocks):
            h = block(h, time_emb, condition.film[index])
            if index == self.attention_after and self.attention is not None:
                h = self.attention(h, condition.keys_values)
        return h


# ---------------------------------------------------------------- the network


@dataclass(frozen=True)
class Prepared:
    """A condition after all layers that depend on it alone: made once a sample (ruling 3).

    Two of them join along the batch by `join_conditions`, as guidance does.
    """

    stages: tuple[StageCondition, ...]  # down, middle, up
    time: Tensor | None = None  # [B, E] added to the time embedding, if the network has a memory


def halved(audio: Tensor) -> Tensor:
    """Mean of neighbouring frames, [B, E, T] -> [B, E, T/2]; T is even."""
    return (audio[..., ::2] + audio[..., 1::2]) / 2


class UNet1D(nn.Module):
    """Noisy trajectory, step and audio -> what the diffusion's prediction type says.

    Each level has ResBlocks, and attention where its factor is in attention-resolutions; its
    output is kept for the way up. The middle always attends. The deepest level has no attention
    on the way up when it follows the middle at the same resolution (TECH's diagram).
    The output convolution starts at zero.
    """

    def __init__(self, config: UNetConfig, condition: AudioConditionConfig | None = None) -> None:
        super().__init__()
        condition = condition or AudioConditionConfig()
        self.config, self.factors = config, config.factors
        uses_film = config.conditioning != "cross-attention"
        uses_context = config.conditioning != "film"
        self.conditioner = AudioConditioner(condition) if uses_film else None
        self.context_proj = nn.Linear(CONDITION_ROWS, config.context_dim) if uses_context else None
        self.null = nn.Parameter(torch.randn(CONDITION_ROWS))  # ruling 14

        time_dim = config.time_embed_dim
        self.time_embed = nn.Sequential(
            nn.Linear(time_dim, time_dim), nn.SiLU(), nn.Linear(time_dim, time_dim)
        )
        self._build_stages(condition.dim if uses_film else None)
        self.output_norm = nn.GroupNorm(NORM_GROUPS, config.model_channels)
        self.output_conv = ZeroConv1d(config.model_channels, config.out_channels, 3, padding=1)
        self.memory: MemoryJoin | None = None  # last, so that it takes no random number before
        if config.memory is not None:
            self.add_memory(config.memory)

    def add_memory(self, memory: MemoryConditionConfig) -> None:
        """Learn to take a memory too, starting with no effect."""
        conditioner, proj = self.conditioner, self.context_proj
        self.config = self.config.model_copy(update={"memory": memory})
        self.memory = MemoryJoin(
            memory,
            self.config.time_embed_dim,
            None if conditioner is None else conditioner.combine.out_channels,
            None if proj is None else proj.out_features,
        ).to(self.null.device)

    def _build_stages(self, film_dim: int | None) -> None:
        config, channels, factors = self.config, self.config.channels, self.factors
        depth, repeat = len(channels), self.config.num_res_blocks
        last, middle = depth - 1, factors[-1]

        def attends(factor: int) -> int | None:
            return repeat - 1 if factor in config.attention_resolutions else None

        self.input_conv = nn.Conv1d(config.in_channels, channels[0], 3, padding=1)
        self.down, self.downsample = nn.ModuleList(), nn.ModuleList()
        self.up, self.upsample = nn.ModuleList(), nn.ModuleList()
        for level, width in enumerate(channels):
            before = channels[max(level - 1, 0)]
            factor = factors[level]
            halves = level < last or config.downsample_last
            widths = [before] + [width] * repeat
            self.down.append(Stage(config, widths, factor, film_dim, attends(factor)))
            self.downsample.append(Downsample(width) if halves else nn.Identity())
            # on the way up a level leaves with the channels of the one above it
            widths = [2 * width] + [before] * repeat
            after = None if factor == middle else attends(factor)
            self.up.append(Stage(config, widths, factor, film_dim, after))
            self.upsample.append(Upsample(width) if halves else nn.Identity())
        bottom = channels[-1]
        self.middle = Stage(config, [bottom] * 3, middle, film_dim, attention_after=0)

    # Conditions

    def prepare(
        self, condition: Tensor, drop: Tensor | None = None, memory: MemoryCondition | None = None
    ) -> Prepared:
        """All that depends on the condition alone.

        Args:
            condition: [B, 163 or 167, T]; see conditioning.py for its rows.
            drop: [B] bool, True = the learned null instead, and no memory.
            memory: what is remembered for it; only for a network with a memory.
        """
        condition = with_phase_rows(condition)
        if drop is not None:
            null = self.null[:, None].to(condition.dtype)
            condition = torch.where(drop.to(condition.device)[:, None, None], null, condition)
            memory = None if memory is None else memory.without(drop)
        remembered = self._remember(condition, memory)
        audio: dict[int, Tensor] = {}
        if self.conditioner is not None:
            audio[1] = self.conditioner(self._pad(condition))  # [B, E, T']
            if remembered.film is not None:
                audio[1] = audio[1] + self._pad(remembered.film)
            for factor in sorted(set(self.factors))[1:]:
                audio[factor] = halved(audio[factor // 2])  # [B, E, T'/2^i]
        context = None
        if self.context_proj is not None:
            context = self.context_proj(condition.transpose(1, 2))  # [B, T, E]
            if remembered.context is not None:
                context = context + remembered.context
        stages = tuple(stage.prepare(audio.get(stage.factor), context) for stage in self.stages())
        return Prepared(stages, remembered.time)

    def _remember(self, condition: Tensor, memory: MemoryCondition | None) -> Remembered:
        """What the memory adds; a network that has one always gives a sum, so that all join."""
        if self.memory is None:
            assert memory is None, "this network takes no memory; train one with train_memory"
            return Remembered(None, None, None)
        if memory is None:
            nothing = condition.new_zeros(len(condition), self.config.time_embed_dim)
            return Remembered(nothing, None, None)
        remembered: Remembered = self.memory(condition, memory)
        return remembered

    def null_condition(self, batch: int, frames: int) -> Tensor:
        """The learned "no audio", [B, 167, T]."""
        return self.null[:, None].expand(batch, CONDITION_ROWS, frames)

    def stages(self) -> list[Stage]:
        """In the order of `Prepared.stages`: down, middle, up."""
        stages = [*self.down, self.middle, *reversed(self.up)]
        return [stage for stage in stages if isinstance(stage, Stage)]

    def _pad(self, x: Tensor) -> Tensor:
        """Repeat the last frame up to a multiple of the deepest downsampling (ruling 4)."""
        missing = -x.shape[-1] % self.factors[-1]
        return F.pad(x, (0, missing), mode="replicate") if missing else x

    # The network

    def forward(
        self,
        x: Tensor,
        t: Tensor,
        condition: Prepared | Tensor,
        drop: Tensor | None = None,
        memory: MemoryCondition | None = None,
    ) -> Tensor:
        """One prediction.

        Args:
            x: [B, 25, T] z-scored, T >= 8.
            t: [B] diffusion steps.
            condition: what `prepare` gave, or [B, 163 or 167, T].
            drop: [B] bool, True = the learned null; only with a condition not yet prepared.
            memory: what is remembered for the condition; likewise.

        Raises:
            ValueError: fewer than 8 frames, or a condition of another length.
        """
        frames = x.shape[-1]
        if frames < MIN_FRAMES:
            raise ValueError(f"UNet1D takes {MIN_FRAMES} frames or more, not {frames}")
        if isinstance(condition, Tensor):
            condition = self.prepare(condition, drop, memory)
        else:
            assert drop is None and memory is None, "a prepared condition cannot change any more"
        stages = condition.stages
        time_emb = self.time_embed(sinusoidal(t, self.config.time_embed_dim))  # [B, E]
        if condition.time is not None:
            time_emb = time_emb + condition.time
        padded = self._pad(x)  # [B, 25, T']
        film = stages[0].film[0]
        if film is not None and film.shape[-1] != padded.shape[-1]:
            raise ValueError(
                f"the condition has {film.shape[-1]} frames (padded), the motion {padded.shape[-1]}"
            )
        return self.through(padded, time_emb, stages)[..., :frames]  # [B, 25, T]

    def through(self, x: Tensor, time_emb: Tensor, stages: Sequence[StageCondition]) -> Tensor:
        """x [B, 25, T'], time [B, E] and what `prepare` made of each stage -> [B, 25, T']."""
        skips, depth = [], len(self.down)
        h = self.input_conv(x)  # [B, C, T']
        for stage, halve, own in zip(self.down, self.downsample, stages[:depth], strict=True):
            h = self._run(stage, h, time_emb, own)  # [B, C_i, T/2^i]
            skips.append(h)
            h = halve(h)
        h = self._run(self.middle, h, time_emb, stages[depth])
        for level, own in zip(reversed(range(depth)), stages[depth + 1 :], strict=True):
            h = self.upsample[level](h)
            h = torch.cat((h, skips[level]), dim=1)  # [B, 2 C_i, T/2^i]
            h = self._run(self.up[level], h, time_emb, own)
        h = F.silu(self.output_norm(h))  # [B, C, T']
        result: Tensor = self.output_conv(h)
        return result

    def _run(self, stage: nn.Module, h: Tensor, time: Tensor, condition: StageCondition) -> Tensor:
        out: Tensor
        if self.config.use_checkpoint and torch.is_grad_enabled():
            out = checkpoint(stage, h, time, condition, use_reentrant=False)
        else:
            out = stage(h, time, condition)
        return out


# ---------------------------------------------------------------- a faster copy to sample

DEEP = 4  # downsampling factor from which a level counts as deep


class MatrixConv1d(nn.Module):
    """Conv1d as one matrix product over frames; weights [C', k*C] instead of [C', C, k]."""

    def __init__(self, conv: nn.Conv1d) -> None:
        super().__init__()
        assert conv.groups == 1 and conv.padding_mode == "zeros" and conv.dilation == (1,)
        (self.kernel,), (self.stride,) = conv.kernel_size, conv.stride
        padding = conv.padding[0]
        assert isinstance(padding, int)
        self.padding = padding
        weight = conv.weight.detach().permute(0, 2, 1).flatten(1).contiguous()
        self.weight = nn.Parameter(weight, requires_grad=False)
        self.bias = conv.bias

    def forward(self, x: Tensor) -> Tensor:
        """[B, C, T] -> [B, C', T']."""
        rows = x.transpose(1, 2)  # [B, T, C]
        if self.kernel > 1:
            batch, _, channels = rows.shape
            rows = F.pad(rows, (0, 0, self.padding, self.padding)).contiguous()
            length = rows.shape[1]
            frames = (length - self.kernel) // self.stride + 1
            # neighbours lie behind each other: k frames are one run of k*C numbers
            rows = rows.as_strided(
                (batch, frames, self.kernel * channels),
                (length * channels, self.stride * channels, 1),
            )
        return F.linear(rows.contiguous(), self.weight, self.bias).transpose(1, 2)


def sampling_copy(unet: UNet1D) -> UNet1D:
    """The network again, for sampling on the CPU only: it neither trains nor is saved.

    Deep levels, from T/4 down, hold most weights and few frames, which PyTorch's Conv1d on a CPU
    serves badly: there a convolution is one matrix product.

    Args:
        unet: on the CPU; left as it is.
    """
    fast = copy.deepcopy(unet).eval().requires_grad_(False)
    resamplers = zip(fast.factors[:-1], fast.downsample, fast.upsample, strict=True)
    parts: list[tuple[int, nn.Module]] = [(stage.factor, stage) for stage in fast.stages()]
    parts += [(factor, layer) for factor, *layers in resamplers for layer in layers]
    for factor, part in parts:
        if factor >= DEEP:
            _replace_convolutions(part)
    return fast


def _replace_convolutions(module: nn.Module) -> None:
    for name, child in module.named_children():
        if isinstance(child, nn.Conv1d):
            setattr(module, name, MatrixConv1d(child))
        else:
            _replace_convolutions(child)
