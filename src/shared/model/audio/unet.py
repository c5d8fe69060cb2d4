"""UNet1D: the diffusion network of the audio branch (TECH 3.1, REF; rulings 1 to 4, 14).

Letters: B batch, T frames, C channels of a level, E channels of the time embedding or condition,
L frames of the audio context. Level i has T/2^i frames.
"""

from collections.abc import Sequence
from dataclasses import dataclass

import torch
from torch import Tensor, nn
from torch.nn import functional as F
from torch.utils.checkpoint import checkpoint

from ...config_audio import (
    NORM_GROUPS,
    AudioConditionConfig,
    MemoryConditionConfig,
    UNetConfig,
)
from ..layers.attention import sinusoidal
from .blocks import Downsample, Stage, StageCondition, Upsample
from .conditioning import (
    CONDITION_ROWS,
    AudioConditioner,
    MemoryCondition,
    MemoryJoin,
    Remembered,
    with_phase_rows,
    zeroed,
)

MIN_FRAMES = 8  # ruling 4


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
        self.config = config
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
        self.output_conv = zeroed(
            nn.Conv1d(config.model_channels, config.out_channels, 3, padding=1)
        )
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
        config, channels, factors = self.config, self.config.channels, self.config.factors
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
        self,
        condition: Tensor,
        drop: Tensor | None = None,
        memory: MemoryCondition | None = None,
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
            for factor in sorted(set(self.config.factors))[1:]:
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
        missing = -x.shape[-1] % self.config.factors[-1]
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
        down, middle, up = self._split(condition)
        time_emb = self.time_embed(sinusoidal(t, self.config.time_embed_dim))  # [B, E]
        if condition.time is not None:
            time_emb = time_emb + condition.time
        h = self.input_conv(self._pad(x))  # [B, C, T']
        self._check_frames(h.shape[-1], condition)
        skips = []
        for stage, halve, own in zip(self.down, self.downsample, down, strict=True):
            h = self._run(stage, h, time_emb, own)  # [B, C_i, T/2^i]
            skips.append(h)
            h = halve(h)
        h = self._run(self.middle, h, time_emb, middle)
        for level, own in zip(reversed(range(len(self.up))), up, strict=True):
            h = self.upsample[level](h)
            h = torch.cat((h, skips[level]), dim=1)  # [B, 2 C_i, T/2^i]
            h = self._run(self.up[level], h, time_emb, own)
        h = F.silu(self.output_norm(h))  # [B, C, T']
        return self.output_conv(h)[..., :frames]  # [B, 25, T]

    def _split(
        self, prepared: Prepared
    ) -> tuple[Sequence[StageCondition], StageCondition, Sequence[StageCondition]]:
        depth, stages = len(self.down), prepared.stages
        return stages[:depth], stages[depth], stages[depth + 1 :]

    def _check_frames(self, frames: int, prepared: Prepared) -> None:
        film = prepared.stages[0].film[0]
        if film is not None and film.shape[-1] != frames:
            raise ValueError(
                f"the condition has {film.shape[-1]} frames (padded), the motion {frames}"
            )

    def _run(self, stage: nn.Module, h: Tensor, time: Tensor, condition: StageCondition) -> Tensor:
        if self.config.use_checkpoint and torch.is_grad_enabled():
            return checkpoint(stage, h, time, condition, use_reentrant=False)
        return stage(h, time, condition)
