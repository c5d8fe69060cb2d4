"""From paired phrases of music and motion (`prepare-audio`) to a memory.

Each is cut at bars; each piece gets two keys in the shared space, of its sound and of its body.
What is done is kept in parts/ until the memory is whole, so that a stopped build goes on.

Letters: B pieces at a time, C = 163 or 167 rows of sound, T frames, D width of the space.
"""

import hashlib
import json
import shutil
from collections.abc import Sequence
from pathlib import Path
from typing import Any, Protocol

import torch
from torch import Tensor

from ..data.phrases.layout import PhraseRecord
from ..errors import UserError
from .folder import MANIFEST
from .index import MemoryConfig, MemoryIndex, Phrase
from .search import add_library, has_tables, library_installed, open_index
from .source import Piece, Progress, Source

VERSION = 2  # of the method: another number builds anew
BATCH = 32
CHUNK = 64  # phrases of the data in a part: what an interruption costs at most
PARTS = "parts"


class Space(Protocol):
    """What the memory needs of a SharedSpace."""

    @property
    def embed_dim(self) -> int:
        """D."""

    @property
    def fingerprint(self) -> str:
        """Names the weights: keys of one space mean nothing in another."""

    def embed_audio(self, condition: Tensor, mask: Tensor | None = None) -> Tensor:
        """Condition [B,C,T], mask [B,T] True on real frames → unit [B,D]."""

    def embed_motion(self, features: Tensor, mask: Tensor | None = None) -> Tensor:
        """Raw features [B,T,23,6], mask [B,T] → unit [B,D]."""


@torch.no_grad()
def build_memory(
    data: str | Path,
    space: Space,
    out: str | Path,
    *,
    config: MemoryConfig | None = None,
    split: str = "train",
    progress: Progress = lambda done, total: None,
    space_name: str = "",
) -> MemoryIndex:
    """Build and write the memory of a prepared audio folder; an up-to-date one is only opened.

    Stopped, it goes on with the parts that are there and gives the same bytes.

    Args:
        data: what `prepare-audio` wrote, a folder or a URL.
        space: embeds sound and bodies.
        out: folder of the memory.
        config: `bars` and `min_frames` of a phrase; above `library_above` the index library's
            tables are made too, if it is installed.
        split: of the data.
        progress: called after each phrase of the data.
        space_name: name or folder, for whoever opens the memory.

    Raises:
        UserError: no such data, no bodies in it, more than 5% of it unusable, or `out` cannot be
            written.
    """
    config = config or MemoryConfig()
    source = Source(str(data), split)
    made_of, out = _made_of(source.records, space, config), Path(out)
    if _opened(out, made_of):
        progress(len(source.records), len(source.records))
    else:
        parts = [
            part
            for first in range(0, len(source.records), CHUNK)
            if (part := _part(source, first, space, config, out / PARTS, made_of, progress))
        ]
        if not parts:
            raise UserError(
                f"{source.root}: no phrase is long enough to be cut at bars; lower min-frames"
            )
        _joined(
            parts,
            data=source.root,
            split=split,
            space=space.fingerprint,
            space_name=space_name,
            bars=config.bars,
            made_of=made_of,
            left_out=source.bad,
        ).save(out)
        del parts  # they are mapped
        shutil.rmtree(out / PARTS, ignore_errors=True)
    index = open_index(out, library_above=config.library_above)
    large = len(index) > config.library_above
    if large and library_installed() and not has_tables(out):
        return add_library(index, out)
    return index


def _made_of(records: Sequence[PhraseRecord], space: Space, config: MemoryConfig) -> str:
    """Changes when anything that the memory is made of does."""
    contents = [(r.id, r.key, r.body.key if r.body else "", r.caption) for r in records]
    text = json.dumps([VERSION, space.fingerprint, config.bars, config.min_frames, contents])
    return hashlib.sha256(text.encode()).hexdigest()


def _opened(folder: Path, made_of: str) -> MemoryIndex | None:
    """The memory that was made of this, if it is there and whole."""
    try:
        index = MemoryIndex.open(folder) if (folder / MANIFEST).is_file() else None
    except UserError:
        return None
    return index if index and index.about.get("made_of") == made_of else None


# ---------------------------------------------------------------- parts


def _part(
    source: Source,
    first: int,
    space: Space,
    config: MemoryConfig,
    folder: Path,
    made_of: str,
    progress: Progress,
) -> MemoryIndex | None:
    """The pieces of `CHUNK` phrases from `first` on; None where all are too short.

    Kept as a memory of its own. One that leaves a phrase out is not kept: the phrase may be better
    next time.
    """
    last = min(first + CHUNK, len(source.records))
    folder = folder / f"{first:08d}"
    if part := _opened(folder, made_of):
        progress(last, len(source.records))
        return part
    bad = len(source.bad)
    phrases = _embedded(list(source.pieces(config, progress, first=first, last=last)), space)
    if not phrases:
        return None
    part = MemoryIndex.from_phrases(phrases, made_of=made_of)
    if len(source.bad) == bad:
        part.save(folder)
    return part


def _joined(parts: Sequence[MemoryIndex], **about: Any) -> MemoryIndex:
    """The phrases of one or more memories of one space, in their order."""
    songs = tuple(sorted({song for part in parts for song in part.songs}))
    number = {song: n for n, song in enumerate(songs)}
    renamed = [torch.tensor([number[song] for song in part.songs])[part.song] for part in parts]
    lengths = torch.cat([part.offsets.diff() for part in parts])

    def rows(name: str) -> Tensor:
        return torch.cat([getattr(part, name) for part in parts])

    def texts(name: str) -> tuple[str, ...]:
        return tuple(text for part in parts for text in getattr(part, name))

    return MemoryIndex(
        audio_keys=rows("audio_keys"),
        motion_keys=rows("motion_keys"),
        start_phase=rows("start_phase"),
        tempo=rows("tempo"),
        song=torch.cat(renamed),
        offsets=torch.nn.functional.pad(lengths.cumsum(0), (1, 0)),
        trajectories=rows("trajectories"),
        priors=rows("priors"),
        songs=songs,
        ids=texts("ids"),
        captions=texts("captions"),
        clips=texts("clips"),
        about=about,
    )


def _embedded(pieces: Sequence[Piece], space: Space) -> list[Phrase]:
    """Pieces with their keys, in their order; embedded by length, so that little is padding."""
    order = sorted(range(len(pieces)), key=lambda n: len(pieces[n].body))
    phrases: dict[int, Phrase] = {}
    for start in range(0, len(order), BATCH):
        numbers = order[start : start + BATCH]
        made = _embed([pieces[number] for number in numbers], space)
        phrases |= dict(zip(numbers, made, strict=True))
    return [phrases[number] for number in range(len(pieces))]


def _embed(pieces: Sequence[Piece], space: Space) -> list[Phrase]:
    """One batch, padded with zeros that the mask hides."""
    longest = max(len(piece.body) for piece in pieces)
    rows = max(len(piece.audio) for piece in pieces)
    audio = torch.zeros(len(pieces), rows, longest)
    body = torch.zeros(len(pieces), longest, *pieces[0].body.shape[1:])
    mask = torch.zeros(len(pieces), longest, dtype=torch.bool)
    for number, piece in enumerate(pieces):
        frames = len(piece.body)
        audio[number, : len(piece.audio), :frames] = torch.from_numpy(piece.audio)
        body[number, :frames] = torch.from_numpy(piece.body)
        mask[number, :frames] = True
    audio_keys = space.embed_audio(audio, mask).float().cpu().numpy()
    motion_keys = space.embed_motion(body, mask).float().cpu().numpy()
    return [
        Phrase(
            id=piece.id,
            song=piece.song,
            caption=piece.caption,
            clip=piece.clip,
            tempo=piece.tempo,
            audio_key=audio_keys[number],
            motion_key=motion_keys[number],
            trajectory=piece.trajectory,
            priors=piece.priors,
        )
        for number, piece in enumerate(pieces)
    ]
