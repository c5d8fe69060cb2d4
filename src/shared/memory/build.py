"""From paired phrases of music and motion (`prepare-audio`) to a memory.

Each is cut at bars; each piece gets two keys in the shared space, of its sound and of its body.
What is done is kept in parts/ until the memory is whole, so that a stopped build goes on.

Letters: B pieces at a time, C = 163 or 167 rows of sound, T frames, D width of the space.
"""

import hashlib
import json
import shutil
from collections import Counter
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, replace
from itertools import islice
from pathlib import Path
from typing import Any, Protocol

import numpy as np
import torch
from torch import Tensor

from ..data.phrases.dataset import read_phrase
from ..data.phrases.layout import MANIFEST as PAIRS_MANIFEST
from ..data.phrases.layout import BadContent, PhraseRecord
from ..data.phrases.store import Backoff, PhraseStore, Remote, Unreachable
from ..errors import UserError
from ..io.files import parse_json
from ..motion.features import LEFT_CONTACT, ROOT_ROW
from ..motion.trajectory import FPS, encode_window, place_window
from .index import MANIFEST, MemoryConfig, MemoryIndex, Phrase
from .priors import prior_curves
from .search import add_library, has_tables, library_installed, open_index

VERSION = 2  # of the method: another number builds anew
BATCH = 32
CHUNK = 64  # phrases of the data in a part: what an interruption costs at most
PARTS = "parts"
ONSETS = 162  # row of a condition
MAX_BAD_FRACTION = 0.05  # ruling 17
AGAIN = "run prepare-audio again into the same folder: it adds what is missing"

Progress = Callable[[int, int], None]  # (phrases done, phrases in all)
MIN_FRAMES = 24  # 0.8 s
NO_KEY = np.zeros(0, np.float32)


def cut_at_bars(
    phase_unwrapped: np.ndarray,
    *,
    bars: int = 2,
    step: int | None = None,
    min_frames: int = MIN_FRAMES,
) -> list[tuple[int, int]]:
    """Frames (start, stop) of phrases, in order.

    Each starts at the frame nearest to a downbeat and lasts `bars` bars. What is left before the
    first downbeat and after the last whole phrase is a phrase too if it is long enough.

    Args:
        phase_unwrapped: bars [T], rising; whole numbers are downbeats (ruling 9).
        bars: length of a phrase.
        step: bars from one start to the next; None = `bars`, so that phrases do not overlap.
        min_frames: of any phrase.
    """
    num_frames = len(phase_unwrapped)
    step = step or bars
    if num_frames < min_frames:
        return []
    phase = np.maximum.accumulate(np.asarray(phase_unwrapped, np.float64))
    if phase[-1] == phase[0]:  # a song without beats
        return [(0, num_frames)]
    numbers = np.arange(np.ceil(phase[0]), np.floor(phase[-1]) + 1)
    downbeats = np.rint(np.interp(numbers, phase, np.arange(num_frames))).astype(int).tolist()
    if not downbeats:
        return [(0, num_frames)]
    ends = [*downbeats[bars:], *[num_frames] * bars]
    cuts = [(0, downbeats[0]), *zip(downbeats[::step], ends[::step], strict=False)]
    return [(start, stop) for start, stop in cuts if stop - start >= min_frames]


@dataclass(frozen=True, eq=False)
class Piece:
    """A phrase whose keys are still empty, and what they are made of.

    Attributes:
        audio: condition [C,T].
        body: raw features [T,23,6].
    """

    phrase: Phrase
    audio: np.ndarray
    body: np.ndarray


class Source:
    """The phrases of one split of a prepared audio folder.

    Attributes:
        records: with bodies.
        bad: phrases that could not be used, with the reason.

    Raises:
        UserError: nothing there, no phrases of the split, or phrases without bodies.
    """

    def __init__(self, root: str, split: str) -> None:
        self.root = root
        remote = Remote(root, backoff=Backoff())
        self.store = PhraseStore(remote, None)
        everything = remote.phrases()
        self.records = [record for record in everything if record.split == split]
        self.bad: dict[str, str] = {}
        if not self.records:
            splits = ", ".join(sorted({record.split for record in everything})) or "none"
            raise UserError(f"{root} has no phrases of split {split!r}; there are: {splits}")
        bare = [record.id for record in self.records if record.body is None]
        if bare:
            raise UserError(
                f"{root}: {len(bare)} of {len(self.records)} phrases have no body.npz (e.g."
                f" {bare[0]}), which a memory of motion needs; {AGAIN}"
            )
        self._pairs = _pairs(remote)
        self._captions = {
            _longest(self._pairs[record.id]): record.caption
            for record in everything
            if record.id in self._pairs and record.caption
        }

    def pieces(
        self, config: MemoryConfig, progress: Progress, *, first: int = 0, last: int | None = None
    ) -> Iterator[Piece]:
        """The phrases from `first` to before `last`, cut at bars.

        Raises:
            UserError: too many are bad.
        """
        for done, record in enumerate(self.records[first:last], first + 1):
            try:
                yield from self._cut(record, config)
            except (BadContent, Unreachable) as error:
                self._leave_out(record, str(error))
            progress(done, len(self.records))

    def _leave_out(self, record: PhraseRecord, reason: str) -> None:
        self.bad[record.id] = reason
        if len(self.bad) > MAX_BAD_FRACTION * len(self.records):
            named = "; ".join(f"{name}: {why}" for name, why in islice(self.bad.items(), 3))
            raise UserError(
                f"{self.root}: more than {MAX_BAD_FRACTION:.0%} of {len(self.records)} phrases"
                f" cannot be used ({named}); {AGAIN}; prepare the data again"
            )

    def _cut(self, record: PhraseRecord, config: MemoryConfig) -> Iterator[Piece]:
        phrase = read_phrase(self.store, record, beat_phase=True, body=True)
        trajectory, phase, audio = phrase.trajectory, phrase.phase, phrase.audio
        assert phrase.body is not None  # `bare` phrases were refused
        body = phrase.body.astype(np.float32)
        contacts = body[:, ROOT_ROW, LEFT_CONTACT:]
        priors = prior_curves(trajectory, onsets=audio[ONSETS], contacts=contacts)
        for start, stop in cut_at_bars(phase, bars=config.bars, min_frames=config.min_frames):
            part = slice(start, stop)
            window = encode_window(trajectory[part], phase[part])
            clip = self._clip(record.id, start, stop)
            cut = Phrase(
                id=f"{record.id}/{start:04d}",
                song=record.song or record.id,
                caption=self._captions.get(clip, "") if clip else record.caption,
                clip=clip,
                tempo=record.tempo,
                audio_key=NO_KEY,
                motion_key=NO_KEY,
                trajectory=place_window(window, phase=phase[start]),
                priors=priors[:, part],
            )
            yield Piece(cut, audio[:, part], body[part])

    def _clip(self, phrase: str, start: int, stop: int) -> str:
        """The clip that most frames of a phrase show; "" if the data does not tell."""
        from ..data.pairing.phrase_motion import read_pair

        if phrase not in self._pairs:
            return ""
        pieces, warp = read_pair(self._pairs[phrase])
        shown = np.rint(warp.times(np.arange(start, stop) / FPS) * FPS)
        places = np.searchsorted([piece.at for piece in pieces], shown, side="right") - 1
        return str(Counter(pieces[n].clip for n in places.clip(0)).most_common(1)[0][0])


def _pairs(remote: Remote) -> dict[str, dict[str, Any]]:
    """What the manifest says of the clips behind each phrase, if it does."""
    try:
        phrases = parse_json(remote.read(PAIRS_MANIFEST))["phrases"]
    except FileNotFoundError:
        return {}
    return {phrase["id"]: phrase["pair"] for phrase in phrases if "pair" in phrase}


def _longest(pair: dict[str, Any]) -> str:
    """The clip that a phrase's caption tells of."""
    return str(max(pair["pieces"], key=lambda piece: piece["last"] - piece["first"])["clip"])


# ---------------------------------------------------------------- build


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
        replace(piece.phrase, audio_key=audio_key, motion_key=motion_key)
        for piece, audio_key, motion_key in zip(pieces, audio_keys, motion_keys, strict=True)
    ]
