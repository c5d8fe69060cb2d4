"""MemoryIndex: phrases of motion with their keys in the shared space, and exact search in them.

Search is a matrix product in blocks, so its memory does not grow with the index. What is found
depends on the content alone: equal scores come in the order of the phrases.

Letters: N phrases, D width of the shared space, S songs, F frames of all phrases together,
B queries, k hits, T frames of one phrase.
"""

from collections.abc import Iterable, Sequence, Set
from dataclasses import dataclass, field, fields
from functools import cached_property
from importlib.util import find_spec
from pathlib import Path
from typing import Any, Literal, Self

import numpy as np
import torch
from torch import Tensor
from torch.nn.functional import normalize, pad

from ..errors import UserError
from ..io.files import atomic_write, write_json
from ..io.storage import Place, place
from .folders import MANIFEST, entry_of, read_index, read_manifest, readable, save_index

Key = Literal["audio", "motion"]
Excluded = Sequence[Set[str] | None]  # a query's songs that may not be found

BLOCK = 65_536  # phrases compared at a time
PHASE_WEIGHT = 0.1
NOTHING = -1  # in Hits.index where there are fewer phrases than hits were asked for


@dataclass(frozen=True, eq=False)
class Phrase:
    """One phrase on its way into the memory.

    Attributes:
        id: names it.
        song: the music it was danced to.
        caption: what it shows; empty if unknown.
        clip: the recording it shows most of; empty if unknown.
        tempo: beats a minute; 0 if unknown.
        audio_key, motion_key: [D], unit.
        trajectory: [T,25], local: starts at x = z = 0, facing +Z; its phase is modulo 1 per bar.
        priors: [4,T] in [0,1].
    """

    id: str
    song: str
    caption: str
    clip: str
    tempo: float
    audio_key: np.ndarray
    motion_key: np.ndarray
    trajectory: np.ndarray
    priors: np.ndarray


@dataclass(frozen=True, eq=False)
class Hits:
    """The k best phrases of each query, best first.

    Attributes:
        index: [B,k] int64; -1 where there is none.
        score: [B,k] float32, cosine less the loss for a foreign bar phase; -inf where none.
    """

    index: Tensor
    score: Tensor


@dataclass(frozen=True, eq=False)
class MemoryIndex:
    """N phrases; `open` leaves trajectories and priors on disk until they are asked for.

    Attributes:
        audio_keys, motion_keys: [N,D] float32, unit.
        start_phase: [N] float32, bar phase of the first frame, in [0,1).
        tempo: [N] float32, beats a minute, 0 if unknown.
        song: [N] int64, number in `songs`.
        offsets: [N+1] int64; phrase n has rows offsets[n] to offsets[n+1] of the next two.
        trajectories: [F,25] float16.
        priors: [F,4] float16.
        songs: S names.
        ids, captions, clips: N texts each, see `Phrase`.
        about: what it was made of and how: `space` is the hash of the space's weights.
    """

    audio_keys: Tensor
    motion_keys: Tensor
    start_phase: Tensor
    tempo: Tensor
    song: Tensor
    offsets: Tensor
    trajectories: Tensor
    priors: Tensor
    songs: tuple[str, ...]
    ids: tuple[str, ...]
    captions: tuple[str, ...]
    clips: tuple[str, ...]
    about: dict[str, Any] = field(default_factory=dict)

    @classmethod
    def from_phrases(cls, phrases: Iterable[Phrase], **about: Any) -> Self:
        """An index of at least one phrase, in their order; `about` says what it is made of."""
        items = list(phrases)
        assert items, "a memory has at least one phrase"
        songs = tuple(sorted({phrase.song for phrase in items}))
        number = {song: n for n, song in enumerate(songs)}
        lengths = [len(phrase.trajectory) for phrase in items]
        phases = [phrase.trajectory[0, 16] for phrase in items]
        trajectories = np.concatenate([phrase.trajectory for phrase in items])
        priors = np.concatenate([phrase.priors.T for phrase in items])
        return cls(
            audio_keys=_stack([phrase.audio_key for phrase in items]),
            motion_keys=_stack([phrase.motion_key for phrase in items]),
            start_phase=torch.tensor(np.array(phases), dtype=torch.float32),
            tempo=torch.tensor([phrase.tempo for phrase in items], dtype=torch.float32),
            song=torch.tensor([number[phrase.song] for phrase in items]),
            offsets=torch.from_numpy(np.concatenate([[0], np.cumsum(lengths)])),
            trajectories=torch.from_numpy(trajectories.astype(np.float16)),
            priors=torch.from_numpy(priors.astype(np.float16)),
            songs=songs,
            ids=tuple(phrase.id for phrase in items),
            captions=tuple(phrase.caption for phrase in items),
            clips=tuple(phrase.clip for phrase in items),
            about=about,
        )

    def __len__(self) -> int:
        return len(self.audio_keys)

    @property
    def dim(self) -> int:
        """D."""
        return self.audio_keys.shape[1]

    def keys(self, key: Key) -> Tensor:
        """[N,D] of one side."""
        return self.audio_keys if key == "audio" else self.motion_keys

    @cached_property
    def mean_key(self) -> dict[Key, Tensor]:
        """[D] for each side: its product with a query is the query's mean similarity."""
        return {"audio": self.audio_keys.mean(0), "motion": self.motion_keys.mean(0)}

    def trajectory(self, phrase: int) -> np.ndarray:
        """[T,25] float32 of one phrase."""
        return self.trajectories[self._rows(phrase)].float().numpy()

    def prior(self, phrase: int) -> np.ndarray:
        """[4,T] float32 of one phrase."""
        return self.priors[self._rows(phrase)].float().numpy().T

    def song_of(self, phrase: int) -> str:
        """Name of the song that a phrase belongs to."""
        return self.songs[int(self.song[phrase])]

    def _rows(self, phrase: int) -> slice:
        return slice(int(self.offsets[phrase]), int(self.offsets[phrase + 1]))

    # ------------------------------------------------------------ search

    def search(
        self,
        query: Tensor,
        *,
        top_k: int,
        exclude_songs: Excluded | None = None,
        key: Key = "audio",
        phase: Tensor | None = None,
        phase_weight: float = PHASE_WEIGHT,
    ) -> Hits:
        """The best phrases by cosine, exactly.

        Args:
            query: [B,D], unit.
            top_k: k ≥ 1.
            exclude_songs: for each query, songs whose phrases are not taken, or None.
            key: which side of the phrases is compared.
            phase: [B] bar phase that a phrase should start in.
            phase_weight: what half a bar off costs; `phase_cost` says how it grows.

        Raises:
            ValueError: the query has another width.
        """
        self.check_width(query)
        keys, banned = self.keys(key), self.banned(exclude_songs, len(query))
        best = []
        for start in range(0, len(self), BLOCK):
            block = slice(start, min(start + BLOCK, len(self)))
            scores = query.float() @ keys[block].T
            if phase is not None and phase_weight:
                scores -= phase_cost(phase, self.start_phase[block], phase_weight)
            if banned is not None:
                scores.masked_fill_(banned[:, self.song[block]], -torch.inf)
            best.append(_top(scores, top_k, start))
        return _merged(best, top_k)

    def check_width(self, query: Tensor) -> None:
        """Raises ValueError for queries that are not [B,D]."""
        if query.ndim != 2 or query.shape[1] != self.dim:
            raise ValueError(f"a query is [B,{self.dim}], not {list(query.shape)}")

    def banned(self, exclude_songs: Excluded | None, queries: int) -> Tensor | None:
        """[B,S] True where a query may not find a song; None where nothing is excluded.

        Raises:
            ValueError: not one entry a query.
        """
        if exclude_songs is None:
            return None
        if len(exclude_songs) != queries:
            raise ValueError(f"exclude_songs has {len(exclude_songs)} entries, not {queries}")
        table = torch.zeros(queries, len(self.songs), dtype=torch.bool)
        for row, excluded in enumerate(exclude_songs):
            known = [self._number[song] for song in excluded or () if song in self._number]
            table[row, known] = True
        return table if table.any() else None

    @cached_property
    def _number(self) -> dict[str, int]:
        return {song: number for number, song in enumerate(self.songs)}

    def save(self, folder: str | Place) -> None:
        """Write the folder or address (see `save_index`); raises UserError when that fails."""
        save_index(self, place(folder))

    @classmethod
    def open(cls, folder: str | Place) -> Self:
        """Open what `save` wrote.

        Raises:
            UserError: no memory there, of another version, or a file is missing or damaged.
        """
        return cls(**read_index(readable(folder)))


def phase_cost(phase: Tensor, start_phase: Tensor, weight: float) -> Tensor:
    """What queries [B] lose with phrases [N] that start elsewhere in the bar: [B,N].

    weight · (1 - cos 2πΔ) / 2: nothing for the same phase, `weight` for half a bar, round both
    ways, and a scalar product of points on the circle, as an index library needs it.
    """
    turns = phase[:, None].float() - start_phase[None].float()
    return weight * (1 - torch.cos(2 * torch.pi * turns)) / 2


def _stack(keys: list[np.ndarray]) -> Tensor:
    stacked = torch.from_numpy(np.stack(keys).astype(np.float32))
    return normalize(stacked, dim=-1)


def _top(scores: Tensor, top_k: int, start: int) -> Hits:
    """The best of one block [B,C]; of equal scores at the border, the first phrases."""
    values, index = scores.topk(min(top_k + 1, scores.shape[1]))
    if values.shape[1] > top_k:
        for row in torch.nonzero(values[:, top_k - 1] == values[:, top_k])[:, 0]:
            order = scores[row].sort(descending=True, stable=True)
            values[row], index[row] = order.values[: top_k + 1], order.indices[: top_k + 1]
    return Hits(index[:, :top_k] + start, values[:, :top_k])


def _merged(parts: Sequence[Hits], top_k: int) -> Hits:
    """The best of all blocks, always k wide; what scores -inf is no hit."""
    index = torch.cat([part.index for part in parts], 1)
    score = torch.cat([part.score for part in parts], 1)
    spare = (0, max(top_k - index.shape[1], 0))
    index, score = pad(index, spare, value=NOTHING), pad(score, spare, value=-torch.inf)
    by_index = index.masked_fill(index == NOTHING, torch.iinfo(index.dtype).max).argsort(1)
    index, score = index.gather(1, by_index), score.gather(1, by_index)
    order = score.sort(dim=1, descending=True, stable=True).indices[:, :top_k]
    index, score = index.gather(1, order), score.gather(1, order)
    return Hits(index.masked_fill(score == -torch.inf, NOTHING), score)


# ---------------------------------------------------------------- by an index library

SIDES: tuple[Key, ...] = ("audio", "motion")
SAMPLE = 40  # keys a cell that k-means learns from
ITERATIONS = 6
PROBES, LEAST = 0.15, 32  # share of the cells a query looks at, and how many at least


def library_installed() -> bool:
    """Whether faiss is there (the extra `index`)."""
    return find_spec("faiss") is not None


@dataclass(frozen=True, eq=False)
class LibraryIndex(MemoryIndex):
    """A memory that is searched by faiss; in all else a MemoryIndex.

    Attributes:
        tables: faiss index of each side.
    """

    tables: dict[Key, Any] = field(default_factory=dict)

    @classmethod
    def of(cls, index: MemoryIndex, tables: dict[Key, Any]) -> Self:
        """The same memory with tables that `make_table` made of it."""
        return cls(**{f.name: getattr(index, f.name) for f in fields(MemoryIndex)}, tables=tables)

    def search(
        self,
        query: Tensor,
        *,
        top_k: int,
        exclude_songs: Excluded | None = None,
        key: Key = "audio",
        phase: Tensor | None = None,
        phase_weight: float = PHASE_WEIGHT,
    ) -> Hits:
        """As `MemoryIndex.search`, but a phrase may be missed."""
        self.check_width(query)
        banned = self.banned(exclude_songs, len(query))
        weight = 0.0 if phase is None else phase_weight
        bars = torch.zeros(len(query)) if phase is None else phase.float()
        points = torch.cat((query.float(), weight / 2 * _circle(bars)), 1).numpy()
        if banned is None:
            score, index = self._search_table(key, points, top_k)
        else:
            rows = zip(points, (~banned).numpy(), strict=True)
            parts = [self._search_table(key, row[None], top_k, songs) for row, songs in rows]
            score, index = (torch.cat(part) for part in zip(*parts, strict=True))
        index, order = index.sort(dim=1, stable=True)  # of equal scores the first phrase is first
        score = (score.gather(1, order) - weight / 2).masked_fill(index == NOTHING, -torch.inf)
        score, order = score.sort(dim=1, descending=True, stable=True)
        return Hits(index.gather(1, order), score)

    def _search_table(
        self, key: Key, queries: np.ndarray, top_k: int, songs: np.ndarray | None = None
    ) -> tuple[Tensor, Tensor]:
        """Scalar products and phrases [B,k] of queries [B,D+2] that may find the same songs [S].

        All cells are looked at where the nearest hold too few.
        """
        import faiss  # type: ignore[import-untyped,import-not-found,unused-ignore]

        table, parameters = self.tables[key], faiss.SearchParametersIVF()
        enough = min(top_k, len(self))
        if songs is not None:
            allowed = songs[self.song.numpy()]
            bits = np.packbits(allowed, bitorder="little")
            parameters.sel = faiss.IDSelectorBitmap(len(allowed), faiss.swig_ptr(bits))
            enough = min(top_k, int(allowed.sum()))
        for probes in (max(round(PROBES * table.nlist), LEAST), table.nlist):
            parameters.nprobe = min(probes, table.nlist)
            score, found = table.search(queries, top_k, params=parameters)
            if (found != NOTHING).sum(1).min() >= enough:
                break
        return torch.from_numpy(score), torch.from_numpy(found)


def make_table(index: MemoryIndex, key: Key) -> Any:
    """The faiss index of one side: 2 √N cells, less for few phrases."""
    import faiss

    points = torch.cat((index.keys(key), _circle(index.start_phase)), 1).numpy()
    cells = max(1, min(round(2 * len(index) ** 0.5), len(index) // SAMPLE))
    width, product = points.shape[1], faiss.METRIC_INNER_PRODUCT
    table = faiss.IndexIVFFlat(faiss.IndexFlat(width, product), width, cells, product)
    table.cp.max_points_per_centroid = SAMPLE
    table.cp.min_points_per_centroid = 1
    table.cp.niter, table.cp.seed = ITERATIONS, 0
    table.train(points)
    table.add(points)
    return table


def add_library(index: MemoryIndex, folder: Path) -> LibraryIndex:
    """Make both tables and add them to the memory in `folder`; its manifest vouches for them.

    Raises:
        UserError: the folder cannot be written.
    """
    import faiss

    tables = {key: make_table(index, key) for key in SIDES}
    manifest = read_manifest(folder)
    for key, table in tables.items():
        path = folder / _file(key)
        with atomic_write(path) as temporary:
            faiss.write_index(table, str(temporary))
        manifest["files"][path.name] = entry_of(path)
    write_json(folder / MANIFEST, manifest)
    return LibraryIndex.of(index, tables)


def open_index(folder: str | Place, *, library_above: int) -> MemoryIndex:
    """A memory, with the library where it is large, has tables, and faiss is installed.

    Raises:
        UserError: see `MemoryIndex.open`.
    """
    folder = readable(folder)
    index = MemoryIndex.open(folder)
    if len(index) <= library_above or not has_tables(folder) or not library_installed():
        return index
    import faiss

    try:
        tables = {key: faiss.read_index(str(folder / _file(key))) for key in SIDES}
    except RuntimeError as error:
        raise UserError(f"{folder} is damaged ({error}); build the memory again") from error
    return LibraryIndex.of(index, tables)


def has_tables(folder: Path) -> bool:
    """Whether a memory has the tables of both sides."""
    files = read_manifest(folder)["files"]
    return all(_file(key) in files for key in SIDES)


def _file(key: str) -> str:
    return f"{key}.faiss"


def _circle(phase: Tensor) -> Tensor:
    """Bar phases [N] as points [N,2]: the phase's cost is a part of the scalar product."""
    return torch.stack((torch.cos(2 * torch.pi * phase), torch.sin(2 * torch.pi * phase)), 1)
