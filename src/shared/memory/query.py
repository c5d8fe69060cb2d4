"""From a song or words to the phrases found, and what of them conditions a network.

Letters: B queries, C rows of sound, D width of the shared space, k hits, T frames asked for.
"""

from dataclasses import asdict, dataclass
from functools import lru_cache
from typing import Any

import numpy as np
import torch
from torch import Tensor

from ..config_audio import MemoryConfig
from ..model.audio.shared_space import SharedSpace
from ..motion.trajectory import FPS, PHASE, VELOCITY, unwrap_phase
from .build import BATCH, cut_at_bars, padded
from .index import NOTHING, Excluded, Hits, Key, MemoryIndex
from .priors import NUM_PRIORS

CONTEXT_DIM = 256  # ruling 26
NEAR = 0.05  # bars by which a query may begin before a phrase and still begin with it
_SEED = 26


@dataclass(frozen=True, eq=False)
class Memory:
    """What B queries remember.

    Attributes:
        context: [B,256] float32; its length says how much the hits agree, at most 1.
        priors: [B,4,T] float32 in [0,1]; see `prior_curves`.
        confidence: [B] float32 in [0,1]; 0 = nothing is known, context and priors are zeros.
        hits: the phrases it comes from; None in a null memory.
    """

    context: Tensor
    priors: Tensor
    confidence: Tensor
    hits: Hits | None = None


def null_memory(batch: int, num_frames: int) -> Memory:
    """Nothing known: zeros, and confidence 0."""
    return Memory(
        torch.zeros(batch, CONTEXT_DIM),
        torch.zeros(batch, NUM_PRIORS, num_frames),
        torch.zeros(batch),
    )


def retrieve(
    index: MemoryIndex,
    query: Tensor,
    config: MemoryConfig | None = None,
    *,
    num_frames: int,
    phase: Tensor | float | None = None,
    exclude_songs: Excluded | None = None,
) -> Memory:
    """Search, then tell a network about the hits.

    The context is the mean of the hits' motion keys, weighted by a softmax of score over
    `config.temperature`, then carried from D to 256 numbers by a fixed orthonormal map (ruling
    26). The priors are the same mean of the hits' curves, each laid along the query's bars.

    The confidence is m / (1 - a), limited to [0,1]: a is the query's mean similarity to all
    phrases, m by how much the weighted similarity of the hits exceeds it. The query itself gives
    1; hits that are no better than any phrase give 0.

    Args:
        index: the memory.
        query: [B,D], unit.
        config: `top_k`, `key`, `phase_weight` of the search, `temperature`.
        num_frames: T.
        phase: bars at the query's frames [B,T], unwrapped: curves follow its tempo. Or those of
            its first frame, [B] or a number: each hit keeps its own tempo. None: 0, and phrases
            are not judged by their phase.
        exclude_songs: see `MemoryIndex.search`.

    Raises:
        ValueError: query or phase of another shape.
    """
    index.check_width(query)
    config = config or MemoryConfig()
    bars = query_bars(phase, len(query), num_frames)
    start = None if phase is None else torch.from_numpy(bars[:, 0] % 1)
    hits = index.search(
        query,
        top_k=config.top_k,
        exclude_songs=exclude_songs,
        key=config.key,
        phase=start,
        phase_weight=config.phase_weight,
    )
    found = (hits.index != NOTHING).any(1)
    weights = torch.softmax(hits.score / config.temperature, dim=1).masked_fill(~found[:, None], 0)
    keys = index.motion_keys[hits.index.clamp(min=0)]  # B k D
    context = torch.einsum("bk,bkd->bd", weights, keys) @ projection(index.dim).T
    return Memory(
        context,
        torch.from_numpy(_blend(index, hits, weights.numpy(), bars, num_frames)),
        _confidence(index, query, hits, weights, config.key),
        hits,
    )


@lru_cache
def projection(dim: int) -> Tensor:
    """The fixed map [256,D]: orthonormal columns, or rows where D > 256; keeps angles.

    From a seeded stream that NumPy keeps the same on all machines and versions.
    """
    drawn = np.random.RandomState(_SEED).standard_normal((CONTEXT_DIM, dim))
    tall = drawn if dim <= CONTEXT_DIM else drawn.T
    q, r = np.linalg.qr(tall)
    q = q * np.sign(np.diag(r))  # LAPACKs differ in signs only
    return torch.from_numpy(q if dim <= CONTEXT_DIM else q.T).float().contiguous()


def query_bars(phase: Tensor | float | None, batch: int, num_frames: int) -> np.ndarray:
    """Phases as `retrieve` takes them → [B,T] or [B,1], float64.

    Raises:
        ValueError: another shape.
    """
    given = torch.zeros(()) if phase is None else torch.as_tensor(phase)
    bars = given.double().numpy()
    bars = np.full((batch, 1), bars) if bars.ndim == 0 else bars
    shaped = bars.reshape(batch, -1) if bars.size % batch == 0 else bars
    if shaped.shape not in ((batch, 1), (batch, num_frames)):
        raise ValueError(
            f"phase is [{batch}] or [{batch},{num_frames}] or a number, not {list(bars.shape)}"
        )
    return shaped


def _confidence(index: MemoryIndex, query: Tensor, hits: Hits, weights: Tensor, key: Key) -> Tensor:
    keys = index.keys(key)
    query = query.float()
    similarity = torch.einsum("bd,bkd->bk", query, keys[hits.index.clamp(min=0)])
    average = query @ index.mean_key[key]
    best = (weights * similarity).sum(1)
    margin = (best - average) / (1 - average).clamp(min=1e-6)
    return torch.where(weights.sum(1) > 0, margin.clamp(0, 1), 0)


# ---------------------------------------------------------------- curves along the query's bars


def _blend(
    index: MemoryIndex, hits: Hits, weights: np.ndarray, bars: np.ndarray, num_frames: int
) -> np.ndarray:
    """Weighted mean [B,4,T] of the hits' curves."""
    mean = np.zeros((len(weights), NUM_PRIORS, num_frames), np.float32)
    for row, place in np.argwhere(weights > 0):
        phrase = int(hits.index[row, place])
        own = unwrap_phase(index.trajectory(phrase)[:, PHASE])
        curves = lay(index.prior(phrase), own, bars[row], num_frames)
        mean[row] += float(weights[row, place]) * curves
    return np.clip(mean, 0, 1)


def lay(curves: np.ndarray, own: np.ndarray, bars: np.ndarray, num_frames: int) -> np.ndarray:
    """A phrase's curves along other bars: [C,T0] → [C,T].

    Downbeats meet downbeats. Where the phrase is over, it starts again a whole number of bars
    before; a phrase of less than a bar holds its ends.

    Args:
        curves: [C,T0].
        own: unwrapped bars [T0] of the phrase.
        bars: unwrapped bars of the query: [T], or [1], its first frame; then the phrase keeps its
            own mean tempo.
        num_frames: T.
    """
    own = np.maximum.accumulate(np.asarray(own, np.float64))
    step = (own[-1] - own[0]) / max(len(own) - 1, 1)  # bars a frame
    if len(bars) == 1 and num_frames > 1:
        bars = bars[0] + np.arange(num_frames) * step
    since = bars - own[0] - np.floor(bars[0] - own[0] + NEAR)
    period = np.floor((len(own) + 1) * step)  # cut at frames, two bars may be a frame short
    since = np.maximum(since, 0) % period if period else since
    return np.stack([np.interp(own[0] + since, own, curve) for curve in curves]).astype(np.float32)


# ---------------------------------------------------------------- songs and words

BEATLESS = 2.0  # seconds of a "bar" of a song without beats


@dataclass(frozen=True)
class Hit:
    """One phrase found, described for a person.

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
class QueryResult:
    """What one query found; `start` and `stop` are seconds of the song, `bar` its number."""

    confidence: float
    hits: list[Hit]
    bar: int | None = None
    start: float | None = None
    stop: float | None = None

    def to_json(self) -> dict[str, Any]:
        """Without what is not known."""
        return {name: value for name, value in asdict(self).items() if value is not None}


@torch.no_grad()
def query_song(
    index: MemoryIndex,
    space: SharedSpace,
    condition: Tensor,
    phase: np.ndarray | None,
    *,
    config: MemoryConfig,
) -> list[QueryResult]:
    """For each bar of a song, the phrases that sound like the bars from there on.

    Args:
        index: a memory made with `space`.
        condition: rows [C,T] of the whole song.
        phase: unwrapped bars [T]; None = no beat was heard, "bars" of 2 s.
        config: `bars`, `min_frames`, `top_k`, `phase_weight`, ...
    """
    bars = np.arange(condition.shape[1]) / (BEATLESS * FPS) if phase is None else phase
    config = config.model_copy(update={"key": "audio"})
    cuts = cut_at_bars(bars, bars=config.bars, step=1, min_frames=config.min_frames)
    results: list[QueryResult] = []
    for first in range(0, len(cuts), BATCH):
        part = cuts[first : first + BATCH]
        windows, mask = padded([condition[:, start:stop] for start, stop in part])
        starts = torch.tensor([float(bars[start]) for start, _ in part])
        memory = retrieve(
            index,
            space.embed_audio(windows, mask).cpu(),
            config,
            num_frames=1,
            phase=None if phase is None else starts,
        )
        assert memory.hits is not None
        for row, (start, stop) in enumerate(part):
            results.append(
                QueryResult(
                    confidence=float(memory.confidence[row]),
                    hits=describe(index, memory.hits, row),
                    bar=int(np.rint(bars[start])),
                    start=start / FPS,
                    stop=stop / FPS,
                )
            )
    return results


def query_text(index: MemoryIndex, embedding: Tensor, *, config: MemoryConfig) -> QueryResult:
    """The phrases whose motion is nearest to a text's embedding [1,D]."""
    config = config.model_copy(update={"key": "motion"})
    memory = retrieve(index, embedding, config, num_frames=1)
    assert memory.hits is not None
    return QueryResult(float(memory.confidence[0]), describe(index, memory.hits, 0))


def describe(index: MemoryIndex, hits: Hits, row: int) -> list[Hit]:
    """The hits of one query in words and figures."""
    pairs = zip(hits.index[row].tolist(), hits.score[row].tolist(), strict=True)
    return [
        _hit(index, phrase, score, rank)
        for rank, (phrase, score) in enumerate(pairs, 1)
        if phrase != NOTHING
    ]


def _hit(index: MemoryIndex, phrase: int, score: float, rank: int) -> Hit:
    trajectory = index.trajectory(phrase)
    energy, density, tension, stability = index.prior(phrase).mean(1).tolist()
    return Hit(
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
