"""Questions to a memory: what moves like this song sounds, bar by bar; what moves like these words.

Letters: B questions, C rows of sound, T frames, D width of the space, k hits.
"""

from dataclasses import asdict, dataclass
from typing import Any

import numpy as np
import torch
from torch import Tensor

from ..motion.trajectory import FPS, VELOCITY
from .build import BATCH, Space
from .context import retrieve
from .index import NOTHING, Hits, MemoryConfig, MemoryIndex
from .phrases import cut_at_bars

BEATLESS = 2.0  # seconds of a "bar" of a song without beats


@dataclass(frozen=True)
class Found:
    """One hit, told to a person.

    Attributes:
        score: cosine, less the loss for a foreign bar phase.
        tempo: beats a minute of the song it was danced to; 0 if unknown.
        speed: mean speed of the pelvis, m/s.
        energy, density, tension, stability: means of the prior curves, 0 to 1.
    """

    rank: int
    score: float
    phrase: str
    song: str
    clip: str
    caption: str
    seconds: float
    tempo: float
    speed: float
    energy: float
    density: float
    tension: float
    stability: float


@dataclass(frozen=True)
class Answer:
    """What one question found; `start` and `stop` are seconds of the song, `bar` its number."""

    confidence: float
    hits: list[Found]
    bar: int | None = None
    start: float | None = None
    stop: float | None = None

    def to_json(self) -> dict[str, Any]:
        """Without what is not known."""
        return {name: value for name, value in asdict(self).items() if value is not None}


@torch.no_grad()
def ask_song(
    index: MemoryIndex,
    space: Space,
    condition: Tensor,
    phase: np.ndarray | None,
    *,
    config: MemoryConfig,
) -> list[Answer]:
    """For each bar of a song, the phrases that sound like the bars from there on.

    Args:
        index: a memory made with `space`.
        condition: rows [C,T] of the whole song.
        phase: unwrapped bars [T]; None = no beat was heard, "bars" of 2 s.
        config: `bars`, `min_frames`, `top_k`, `phase_weight`, ...
    """
    bars = np.arange(condition.shape[1]) / (BEATLESS * FPS) if phase is None else phase
    cuts = cut_at_bars(bars, bars=config.bars, step=1, min_frames=config.min_frames)
    answers: list[Answer] = []
    for first in range(0, len(cuts), BATCH):
        part = cuts[first : first + BATCH]
        longest = max(stop - start for start, stop in part)
        windows = torch.zeros(len(part), len(condition), longest)
        mask = torch.zeros(len(part), longest, dtype=torch.bool)
        for row, (start, stop) in enumerate(part):
            windows[row, :, : stop - start] = condition[:, start:stop]
            mask[row, : stop - start] = True
        starts = torch.tensor([float(bars[start]) for start, _ in part])
        memory = retrieve(
            index,
            space.embed_audio(windows, mask).cpu(),
            num_frames=1,
            phase=None if phase is None else starts,
            top_k=config.top_k,
            temperature=config.temperature,
            key="audio",
            phase_weight=config.phase_weight,
        )
        assert memory.hits is not None
        for row, (start, stop) in enumerate(part):
            answers.append(
                Answer(
                    confidence=float(memory.confidence[row]),
                    hits=describe(index, memory.hits, row),
                    bar=int(np.rint(bars[start])),
                    start=start / FPS,
                    stop=stop / FPS,
                )
            )
    return answers


def ask_text(index: MemoryIndex, embedding: Tensor, *, config: MemoryConfig) -> Answer:
    """The phrases whose motion is nearest to a text's embedding [1,D]."""
    memory = retrieve(
        index,
        embedding,
        num_frames=1,
        top_k=config.top_k,
        temperature=config.temperature,
        key="motion",
    )
    assert memory.hits is not None
    return Answer(float(memory.confidence[0]), describe(index, memory.hits, 0))


def describe(index: MemoryIndex, hits: Hits, row: int) -> list[Found]:
    """The hits of one query in words and figures."""
    pairs = zip(hits.index[row].tolist(), hits.score[row].tolist(), strict=True)
    return [
        _found(index, phrase, score, rank)
        for rank, (phrase, score) in enumerate(pairs, 1)
        if phrase != NOTHING
    ]


def _found(index: MemoryIndex, phrase: int, score: float, rank: int) -> Found:
    trajectory = index.trajectory(phrase)
    energy, density, tension, stability = index.prior(phrase).mean(1).tolist()
    return Found(
        rank=rank,
        score=score,
        phrase=index.ids[phrase],
        song=index.song_of(phrase),
        clip=index.clips[phrase],
        caption=index.captions[phrase],
        seconds=len(trajectory) / FPS,
        tempo=float(index.tempo[phrase]),
        speed=float(np.linalg.norm(trajectory[:, VELOCITY], axis=1).mean()),
        energy=energy,
        density=density,
        tension=tension,
        stability=stability,
    )
