"""What a song's windows ask a memory, and what the network is told of the answers.

A window asks with the sound it covers, its bars and its length; sound, not motion, so all of a
song's windows may ask at once.

Letters: B windows, C rows of a condition, T frames of a song, W of a window, D width of the shared
space.
"""

import asyncio
import math
from collections.abc import Sequence, Set
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import torch
from torch import Tensor

from ..config_audio import AudioNetworkConfig, MemoryConfig
from ..config_loader import load_config, load_yaml, packaged_config
from ..errors import UserError
from ..io.storage import Place
from ..memory.index import MemoryIndex
from ..memory.query import Memory
from ..memory.service import MPMService
from ..model.audio import BEAT, with_phase_rows
from ..model.audio.conditioning import MemoryCondition
from ..model.audio.shared_space import SharedSpace
from ..motion.trajectory import unwrap_phase
from .song_sampler import Recall, SongSampler


@dataclass(frozen=True, eq=False)
class Question:
    """Of one window: embedding [1,D], its bars [W], a number, or None if unknown; W."""

    embedding: Tensor
    phase: np.ndarray | float | None
    num_frames: int


def open_memory(folder: str | Place, space: str | Path = "") -> tuple[MemoryIndex, SharedSpace]:
    """A memory and the space that made its keys.

    Args:
        folder: or address, that `memory build` wrote.
        space: where the space is now; "" = where it was then.

    Raises:
        UserError: one of them is not there, damaged, or they do not belong together.
    """
    index = MemoryIndex.open(folder)
    name = space or index.about["space_name"]
    found = SharedSpace.from_pretrained(name)
    if found.fingerprint != index.about["space"]:
        raise UserError(
            f"the memory in {folder} was made with another shared space than {name}: name that"
            " one, or build the memory again"
        )
    return index, found


def require_memory(config: AudioNetworkConfig, name: str) -> None:
    """Raises UserError for a model that hears no memory."""
    if config.unet.memory is None:
        raise UserError(
            f"{name} hears no memory: train that on top of it with src.train.train_memory, and"
            " name the folder"
        )


def as_condition(memory: Memory) -> MemoryCondition:
    """An answer as the network takes it."""
    return MemoryCondition(memory.context, memory.priors, memory.confidence)


def bars_of_sound(audio: Tensor) -> Tensor:
    """Unwrapped bars [B,T] that the phase rows of sound [B,C,T] tell; 0 where unknown."""
    cosine, sine = with_phase_rows(audio)[:, BEAT][:, 2:].double().cpu().unbind(dim=1)
    turns = torch.atan2(sine, cosine) / (2 * math.pi)  # [B,T]
    return torch.from_numpy(unwrap_phase(turns.numpy()))


def bars_of_window(bars: np.ndarray, start: int, length: int) -> np.ndarray:
    """Unwrapped bars [W] from a frame on; beyond the song's they go on at its last speed."""
    found = np.asarray(bars[start : start + length], np.float64)
    step = bars[-1] - bars[-2] if len(bars) > 1 else 0.0
    return np.concatenate([found, found[-1] + step * np.arange(1, length - len(found) + 1)])


@torch.no_grad()
def questions(
    space: SharedSpace,
    condition: Tensor,
    bars: np.ndarray | None,
    windows: Sequence[tuple[int, int]],
) -> list[Question]:
    """One a window.

    Args:
        space: on the CPU.
        condition: [C,T], likewise.
        bars: unwrapped [T]; None = unknown.
        windows: first frame and length, which may reach beyond T.
    """
    found = []
    for window in windows:
        start, length = window
        embedding = space.embed_audio(condition[None, :, start : start + length])
        found += same_question(embedding, bars, [window])
    return found


def same_question(
    embedding: Tensor, bars: np.ndarray | None, windows: Sequence[tuple[int, int]]
) -> list[Question]:
    """One embedding [1,D] for all windows; see `questions`."""
    return [
        Question(embedding, None if bars is None else bars_of_window(bars, start, length), length)
        for start, length in windows
    ]


async def ask(
    service: MPMService, asked: Sequence[Question], exclude_songs: Set[str] | None = None
) -> list[Memory]:
    """All answers; questions are put at the same time."""
    return await asyncio.gather(
        *(
            service.query(q.embedding, q.phase, q.num_frames, exclude_songs=exclude_songs)
            for q in asked
        )
    )


def ask_now(
    service: MPMService, asked: Sequence[Question], exclude_songs: Set[str] | None = None
) -> list[Memory]:
    """`ask` without an event loop, one after the other."""
    return [
        service.query_now(q.embedding, q.phase, q.num_frames, exclude_songs=exclude_songs)
        for q in asked
    ]


def recalling(windows: Sequence[tuple[int, int]], memories: Sequence[Memory]) -> Recall:
    """For `SongSampler`: each window's answer."""
    answers = dict(zip(windows, map(as_condition, memories), strict=True))
    return lambda start, length: answers[start, length]


@dataclass(frozen=True, eq=False)
class SongMemory:
    """A memory that answers, and the space of its keys."""

    service: MPMService
    space: SharedSpace

    @classmethod
    def open(cls, folder: str | Place) -> "SongMemory":
        """The memory in a folder or at an address, asked as memory.yaml says.

        Raises:
            UserError: it or its space is not there, damaged, or they do not belong together.
        """
        index, space = open_memory(folder)
        path = packaged_config("memory.yaml")
        settings = load_config(MemoryConfig, load_yaml(path), str(path), [f"folder={folder}"])
        return cls(MPMService(settings, index), space)

    def recall(self, sampler: SongSampler, condition: Tensor, bars: np.ndarray | None) -> Recall:
        """All that a sampler's windows of a condition [C,T] are told; bars [T] as `questions`."""
        return remembering(self.service, self.space, sampler, condition, bars)


def remembering(
    service: MPMService,
    space: SharedSpace,
    sampler: SongSampler,
    condition: Tensor,
    bars: np.ndarray | None,
    exclude_songs: Set[str] | None = None,
) -> Recall:
    """See `SongMemory.recall`; some songs may be left out."""
    windows = sampler.windows(condition.shape[1])
    asked = questions(space, condition, bars, windows)
    return recalling(windows, ask_now(service, asked, exclude_songs))
