"""The arms of the memory harness: what each of them lets the model remember.

Letters: B questions, D width of the shared space, T frames.
"""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np
import torch
from torch import Tensor

from ..memory.index import MemoryConfig, MemoryIndex
from ..memory.query import Memory, retrieve
from ..model.audio.conditioning import MemoryCondition
from ..pipelines.song_memory import as_condition

WITHOUT, WITH, RANDOM = "without", "with", "random"


@dataclass(frozen=True)
class Arm:
    """One way to ask.

    Attributes:
        asks: False = the model is given no memory at all.
        stray: somebody else's question, yet as sure of the answer as of the right one: if this
            does as well as the right answers, what is remembered does not matter.
        top_k: hits; None = as configured.
        share: of the memory's songs that may be found.
    """

    name: str
    asks: bool = True
    stray: bool = False
    top_k: int | None = None
    share: float = 1.0


def arms() -> list[Arm]:
    """Without, with, random."""
    return [Arm(WITHOUT, asks=False), Arm(WITH), Arm(RANDOM, stray=True)]


def variations(shares: Sequence[float], top_ks: Sequence[int]) -> list[Arm]:
    """Smaller memories, and other numbers of hits."""
    return [
        *(Arm(f"{share:.0%} of the songs", share=share) for share in shares),
        *(Arm(f"top {top_k}", top_k=top_k) for top_k in top_ks),
    ]


@dataclass(frozen=True)
class Asker:
    """A memory asked directly, without a deadline: the same answers on any machine.

    Attributes:
        index: the memory.
        config: how it is asked.
        seed: of what is hidden from small memories, and of stray questions.
    """

    index: MemoryIndex
    config: MemoryConfig
    seed: int

    def answer(
        self,
        arm: Arm,
        query: Tensor,
        bars: np.ndarray | Tensor | None,
        num_frames: int,
        songs: Sequence[str],
        *,
        draw: int = 0,
    ) -> MemoryCondition | None:
        """What an arm is told of B windows; None for one that does not ask.

        Args:
            query: [B,D].
            bars: unwrapped [B,T]; None = unknown.
            num_frames: T.
            songs: [B], never found.
            draw: another number, other stray questions.
        """
        if not arm.asks:
            return None
        memory = self._retrieve(arm, query, bars, num_frames, songs)
        if arm.stray:
            rng = np.random.default_rng([self.seed, 5, draw])
            rows = torch.from_numpy(rng.integers(len(self.index), size=len(query)))
            other = self._retrieve(arm, self.index.audio_keys[rows], bars, num_frames, songs)
            memory = replace(other, confidence=memory.confidence)
        return as_condition(memory)

    def _retrieve(
        self,
        arm: Arm,
        query: Tensor,
        bars: np.ndarray | Tensor | None,
        num_frames: int,
        songs: Sequence[str],
    ) -> Memory:
        config, hidden = self.config, self.hidden(arm.share)
        return retrieve(
            self.index,
            query,
            num_frames=num_frames,
            phase=None if bars is None else torch.as_tensor(bars).reshape(len(query), -1),
            top_k=arm.top_k or config.top_k,
            temperature=config.temperature,
            key=config.key,
            phase_weight=config.phase_weight,
            exclude_songs=[hidden | {song} for song in songs],
        )

    def hidden(self, share: float) -> frozenset[str]:
        """The songs that a memory of this share lacks; a smaller one lacks those and more."""
        keep = max(1, round(share * len(self.index.songs)))
        return frozenset(self._order[keep:])

    @cached_property
    def _order(self) -> list[str]:
        rng = np.random.default_rng([self.seed, 6])
        return [self.index.songs[n] for n in rng.permutation(len(self.index.songs))]
