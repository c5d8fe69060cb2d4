"""From paired phrases of music and motion (`prepare-audio`) to a memory.

Each is cut at bars; each piece gets two keys in the shared space, of its sound and of its body.

Letters: B pieces at a time, C = 163 or 167 rows of sound, T frames, D width of the space.
"""

import hashlib
import json
from collections.abc import Iterator, Sequence
from itertools import islice
from pathlib import Path
from typing import Protocol

import torch
from torch import Tensor

from src.shared.config_memory import MemoryConfig
from src.shared.data.phrases.layout import PhraseRecord
from src.shared.errors import UserError
from src.shared.memory.folder import read_manifest
from src.shared.memory.index import MemoryIndex, Phrase
from src.shared.memory.search import add_library, library_installed
from src.shared.memory.source import Piece, Progress, Source

VERSION = 1  # of the method: another number builds anew
BATCH = 32
BUFFER = 512  # pieces sorted by length before they are embedded, so that little is padding


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
    made_of = _made_of(source.records, space, config)
    if _is_there(Path(out), made_of):
        progress(len(source.records), len(source.records))
        return MemoryIndex.open(out)
    pieces = source.pieces(config, progress)
    index = MemoryIndex.from_phrases(
        _embedded(pieces, space, source.root),
        data=source.root,
        split=split,
        space=space.fingerprint,
        space_name=space_name,
        bars=config.bars,
        made_of=made_of,
        left_out=source.bad,
    )
    index.save(out)
    if len(index) > config.library_above and library_installed():
        return add_library(index, Path(out))
    return index


def _made_of(records: Sequence[PhraseRecord], space: Space, config: MemoryConfig) -> str:
    """Changes when anything that the memory is made of does."""
    contents = [(r.id, r.key, r.body.key if r.body else "", r.caption) for r in records]
    text = json.dumps([VERSION, space.fingerprint, config.bars, config.min_frames, contents])
    return hashlib.sha256(text.encode()).hexdigest()


def _is_there(out: Path, made_of: str) -> bool:
    try:
        return bool(read_manifest(out)["about"].get("made_of") == made_of)
    except UserError:
        return False


# ---------------------------------------------------------------- keys


def _embedded(pieces: Iterator[Piece], space: Space, root: str) -> list[Phrase]:
    """Pieces with their keys, in their order."""
    found: list[Phrase] = []
    while buffer := list(islice(pieces, BUFFER)):
        order = sorted(range(len(buffer)), key=lambda n: len(buffer[n].body))
        phrases: dict[int, Phrase] = {}
        for start in range(0, len(order), BATCH):
            numbers = order[start : start + BATCH]
            made = _embed([buffer[number] for number in numbers], space)
            phrases |= dict(zip(numbers, made, strict=True))
        found += [phrases[number] for number in range(len(buffer))]
    if not found:
        raise UserError(f"{root}: no phrase is long enough to be cut at bars; lower min-frames")
    return found


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
