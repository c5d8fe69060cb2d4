"""What a network is told of the phrases that were found: context, prior curves, confidence.

Letters: B queries, D width of the shared space, k hits, T frames asked for.
"""

from collections.abc import Iterator
from dataclasses import dataclass
from functools import lru_cache

import numpy as np
import torch
from torch import Tensor

from ..motion.trajectory import PHASE, unwrap_phase
from .index import NOTHING, PHASE_WEIGHT, Excluded, Hits, Key, MemoryIndex
from .priors import NUM_PRIORS

CONTEXT_DIM = 256  # ruling 26
TOP_K = 8
TEMPERATURE = 0.07
NEAR = 0.05  # bars by which a query may begin before a phrase and still begin with it
_SEED = 26


@dataclass(frozen=True, eq=False)
class Memory:
    """What B queries remember.

    Attributes:
        context: [B,256] float32; its length says how much the hits agree, at most 1.
        priors: [B,4,T] float32 in [0,1]; see priors.py.
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
    *,
    num_frames: int,
    phase: Tensor | float | None = None,
    top_k: int = TOP_K,
    temperature: float = TEMPERATURE,
    exclude_songs: Excluded | None = None,
    key: Key = "audio",
    phase_weight: float = PHASE_WEIGHT,
) -> Memory:
    """Search, then tell a network about the hits.

    The context is the mean of the hits' motion keys, weighted by a softmax of score over
    `temperature`, then carried from D to 256 numbers by a fixed orthonormal map (ruling 26). The
    priors are the same mean of the hits' curves, each laid along the query's bars.

    The confidence is m / (1 - a), limited to [0,1]: a is the query's mean similarity to all
    phrases, m by how much the weighted similarity of the hits exceeds it. The query itself gives
    1; hits that are no better than any phrase give 0.

    Args:
        index: the memory.
        query: [B,D], unit.
        num_frames: T.
        phase: bars at the query's frames [B,T], unwrapped: curves follow its tempo. Or those of
            its first frame, [B] or a number: each hit keeps its own tempo. None: 0, and phrases
            are not judged by their phase.
        top_k, exclude_songs, key, phase_weight: see `MemoryIndex.search`.
        temperature: of the softmax.

    Raises:
        ValueError: query or phase of another shape.
    """
    index.check_width(query)
    bars = query_bars(phase, len(query), num_frames)
    start = None if phase is None else torch.from_numpy(bars[:, 0] % 1)
    hits = index.search(
        query,
        top_k=top_k,
        exclude_songs=exclude_songs,
        key=key,
        phase=start,
        phase_weight=phase_weight,
    )
    found = (hits.index != NOTHING).any(1)
    weights = torch.softmax(hits.score / temperature, dim=1).masked_fill(~found[:, None], 0)
    keys = index.motion_keys[hits.index.clamp(min=0)]  # B k D
    context = torch.einsum("bk,bkd->bd", weights, keys) @ projection(index.dim).T
    return Memory(
        context,
        torch.from_numpy(_blend(index, hits, weights.numpy(), bars, num_frames)),
        _confidence(index, query, hits, weights, key),
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
    for row, phrase, weight in _weighted(hits, weights):
        curves = index.prior(phrase)
        own = unwrap_phase(index.trajectory(phrase)[:, PHASE])
        mean[row] += weight * lay(curves, own, bars[row], num_frames)
    return np.clip(mean, 0, 1)


def _weighted(hits: Hits, weights: np.ndarray) -> Iterator[tuple[int, int, float]]:
    for row, phrases in enumerate(hits.index.tolist()):
        for place, phrase in enumerate(phrases):
            if weights[row, place] > 0:
                yield row, phrase, float(weights[row, place])


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
