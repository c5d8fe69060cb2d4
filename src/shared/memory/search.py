"""Search by an index library (faiss), for memories too large to be compared with phrase by phrase.

Keys are sorted into cells by k-means, and a query looks at the nearest cells only: scores are
those of exact search, but a good phrase can be missed. A table holds its own copy of the keys.
`benchmarks/memory_index.py` says from which size this pays.

Letters: N phrases, D width of the shared space, B queries, k hits.
"""

from dataclasses import dataclass, field, fields
from importlib.util import find_spec
from pathlib import Path
from typing import Any, Self

import numpy as np
import torch
from torch import Tensor

from ..errors import UserError
from ..io.files import atomic_write, sha256_file, write_json
from .index import (
    MANIFEST,
    NOTHING,
    PHASE_WEIGHT,
    Excluded,
    Hits,
    Key,
    MemoryIndex,
    read_manifest,
)

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
        index, order = index.sort(
            dim=1, stable=True
        )  # of equal scores the first phrase comes first
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
        entry = {"sha256": sha256_file(path), "bytes": path.stat().st_size}
        manifest["files"][path.name] = entry
    write_json(folder / MANIFEST, manifest)
    return LibraryIndex.of(index, tables)


def open_index(folder: str | Path, *, library_above: int) -> MemoryIndex:
    """A memory, with the library where it is large, has tables, and faiss is installed.

    Raises:
        UserError: see `MemoryIndex.open`.
    """
    folder = Path(folder)
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
