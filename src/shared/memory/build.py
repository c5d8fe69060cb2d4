"""From paired phrases of music and motion (`prepare-audio`) to a memory.

Each is cut at bars; each piece gets two keys in the shared space, of its sound and of its body.
What is done is kept in parts/ until the memory is whole, so that a stopped build goes on.

Letters: B pieces at a time, C = 163 or 167 rows of sound, T frames, D width of the space.
"""

import copy
import csv
import hashlib
import io
import json
import os
from collections import Counter
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, replace
from functools import lru_cache
from itertools import islice
from pathlib import Path
from typing import Any

import numpy as np
import torch
from torch import Tensor
from torch.nn.utils.rnn import pad_sequence

from ..config_audio import MemoryConfig
from ..data.phrases.dataset import read_phrase
from ..data.phrases.layout import MANIFEST as PAIRS_MANIFEST
from ..data.phrases.layout import BadContent, PhraseRecord, PhraseTable
from ..data.phrases.store import PhraseStore, Remote
from ..data.retarget.read_motion import FOLDER_ENDINGS, read_motion
from ..errors import UsageError, UserError
from ..io.files import parse_json, read_text, remove_folder
from ..io.jobs import run_jobs
from ..io.storage import Backoff, Place, Unreachable, fetched, files_below, place
from ..model.audio.shared_space import SharedSpace
from ..motion.features import LEFT_CONTACT, ROOT_ROW
from ..motion.motion import Motion
from ..motion.staging import without_flips
from ..motion.trajectory import FPS, encode_window, place_window
from .figures import FigureMemory, Take
from .folders import INTEGERS, KEY_TENSORS, MANIFEST, MOTION_TENSORS, TEXTS, writable
from .index import MemoryIndex, Phrase, add_library, has_tables, library_installed, open_index
from .priors import prior_curves
from .steps import made_takes

VERSION = 2  # of the method: another number builds anew
BATCH = 32
CHUNK = 64  # phrases of the data in a part: what an interruption costs at most
PARTS = "parts"
ONSETS = 162  # row of a condition
MAX_BAD_FRACTION = 0.05  # ruling 17
AGAIN = "run prepare-audio again into the same folder: it adds what is missing"

Progress = Callable[[int, int], None]  # (phrases or takes done, and in all)
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
        total: how many these are, or are a part of.
        bad: phrases that could not be used, with the reason.
        captions: of the clips behind them.

    Raises:
        UserError: nothing there, no phrases of the split, or phrases without bodies.
    """

    def __init__(self, root: str, split: str) -> None:
        self.root = root
        remote = Remote(root if "://" in root else os.path.abspath(root), backoff=Backoff())
        self.store = PhraseStore(remote, None)
        everything = PhraseTable(remote.phrases(), None, root)
        self.records = [record for record in everything if record.split == split]
        self.bad: dict[str, str] = {}
        if not self.records:
            splits = ", ".join(sorted({record.split for record in everything}))
            if not splits:
                raise UsageError(
                    f"{root} is missing or holds no phrases; name a folder of `prepare-audio`"
                )
            raise UserError(f"{root} has no phrases of split {split!r}; there are: {splits}")
        bare = [record.id for record in self.records if record.body is None]
        if bare:
            raise UserError(
                f"{root}: {len(bare)} of {len(self.records)} phrases have no body.npz (e.g."
                f" {bare[0]}), which a memory of motion needs; {AGAIN}"
            )
        self.total = len(self.records)
        self._pairs = _pairs(remote)
        self.captions: dict[str, str] = {}  # of clips
        for record in everything:
            pair = self._pairs.get(record.id, {})
            if "captions" in pair:
                self.captions |= pair["captions"]
            elif pair and record.caption:  # older folders tell of the clip that is shown longest
                pieces = pair["pieces"]
                longest = max(pieces, key=lambda piece: piece["last"] - piece["first"])
                self.captions[str(longest["clip"])] = record.caption

    def part(self, first: int, last: int) -> "Source":
        """The phrases from `first` to before `last`, as light as can be: for a job elsewhere."""
        part = copy.copy(self)
        part.records, part.bad = self.records[first:last], {}
        part._pairs = {r.id: self._pairs[r.id] for r in part.records if r.id in self._pairs}
        clips = {piece["clip"] for pair in part._pairs.values() for piece in pair["pieces"]}
        part.captions = {clip: self.captions[clip] for clip in clips & self.captions.keys()}
        return part

    def pieces(self, config: MemoryConfig) -> Iterator[Piece]:
        """The phrases, cut at bars.

        Raises:
            UserError: too many are bad.
        """
        for record in self.records:
            try:
                yield from self._cut(record, config)
            except (BadContent, Unreachable) as error:
                self.leave_out({record.id: str(error)})

    def leave_out(self, reasons: dict[str, str]) -> None:
        """Phrases, with the reason of each.

        Raises:
            UserError: too many are bad.
        """
        self.bad |= reasons
        if len(self.bad) > MAX_BAD_FRACTION * self.total:
            named = "; ".join(f"{name}: {why}" for name, why in islice(self.bad.items(), 3))
            raise UserError(
                f"{self.root}: more than {MAX_BAD_FRACTION:.0%} of {self.total} phrases"
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
                caption=self.captions.get(clip, "") if clip else record.caption,
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


# ---------------------------------------------------------------- build


def build_memory(
    data: str | Path,
    space: SharedSpace,
    out: str | Place,
    *,
    config: MemoryConfig | None = None,
    split: str = "train",
    workers: int | None = 1,
    scheduler: str | None = None,
    progress: Progress = lambda done, total: None,
    space_name: str = "",
) -> MemoryIndex:
    """Build and write the memory of a prepared audio folder; an up-to-date one is only opened.

    Stopped, it goes on with the parts that are there and gives the same bytes.

    Args:
        data: what `prepare-audio` wrote, a folder or a URL.
        space: embeds sound and bodies.
        out: folder of the memory, or an address. Parts lie there too if a cluster makes them, else
            where the memory is built, in the cache.
        config: `bars` and `min_frames` of a phrase; above `library_above` the index library's
            tables are made too, if it is installed.
        split: of the data.
        workers, scheduler: who does it, as `run_jobs` has them.
        progress: called after each part of the data.
        space_name: name or folder, for whoever opens the memory, and for workers.

    Raises:
        UserError: no such data, no bodies in it, more than 5% of it unusable, or `out` cannot be
            written.
    """
    config = config or MemoryConfig()
    source = Source(str(data), split)
    made_of, out = _made_of(source, space, config), place(out)
    with writable(out) as folder:
        if _opened(folder, made_of):
            progress(source.total, source.total)
        else:
            here = scheduler is None and workers == 1
            parts_at = (folder if scheduler is None else out).absolute() / PARTS
            named = space if here or not space_name else space_name
            jobs = [
                _Job(source.part(first, first + CHUNK), named, space.fingerprint, config,
                     parts_at / f"{first:08d}", made_of)
                for first in range(0, source.total, CHUNK)
            ]  # fmt: skip
            _run(jobs, source, workers, scheduler, progress)
            parts = [part for job in jobs if (part := _opened(job.folder, made_of))]
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
            ).save(folder)
            del parts  # they are mapped
        for left in {folder / PARTS, out / PARTS}:  # also of a build that was stopped just here
            remove_folder(left)
        index = open_index(folder, library_above=config.library_above)
        large = len(index) > config.library_above
        if large and library_installed() and not has_tables(folder):
            return add_library(index, folder)
        return index


def _made_of(source: Source, space: SharedSpace, config: MemoryConfig) -> str:
    """Changes when anything that the memory is made of does."""
    parts = [(r.id, r.key, r.body.key if r.body else "", r.caption) for r in source.records]
    contents = [parts, sorted(source.captions.items())]
    text = json.dumps([VERSION, space.fingerprint, config.bars, config.min_frames, *contents])
    return hashlib.sha256(text.encode()).hexdigest()


def _opened(folder: Place, made_of: str) -> MemoryIndex | None:
    """The memory that was made of this, if it is there and whole."""
    try:
        index = MemoryIndex.open(folder) if (folder / MANIFEST).is_file() else None
    except UserError:
        return None
    return index if index and index.about.get("made_of") == made_of else None


# ---------------------------------------------------------------- parts


@dataclass(frozen=True, eq=False)
class _Job:
    """A part of the phrases, kept as a memory of its own; `space` itself, or its name."""

    source: Source
    space: SharedSpace | str
    fingerprint: str
    config: MemoryConfig
    folder: Place
    made_of: str


def _run(
    jobs: list[_Job], source: Source, workers: int | None, scheduler: str | None, progress: Progress
) -> None:
    """Make the parts that are missing. One that left a phrase out is: it may be better now."""
    todo = [job for job in jobs if not _whole(job)]
    done = source.total - sum(len(job.source.records) for job in todo)
    progress(done, source.total)
    for job, bad in run_jobs(_make_part, todo, workers, scheduler):
        source.leave_out(bad)
        progress(done := done + len(job.source.records), source.total)


def _whole(job: _Job) -> bool:
    part = _opened(job.folder, job.made_of)
    return part is not None and not part.about["left_out"]


@torch.no_grad()
def _make_part(job: _Job) -> dict[str, str]:
    """Write a part, if any of its phrases is long enough; which were left out, and why."""
    if _whole(job):  # by a worker that was lost before it could tell
        return {}
    space = _named(job.space) if isinstance(job.space, str) else job.space
    if space.fingerprint != job.fingerprint:
        raise UserError(f"{job.space} is another space on a worker; install the same version there")
    phrases = _embedded(list(job.source.pieces(job.config)), space)
    if phrases:
        about = {"made_of": job.made_of, "left_out": job.source.bad}
        MemoryIndex.from_phrases(phrases, **about).save(job.folder)
    return job.source.bad


@lru_cache(maxsize=1)
def _named(name: str) -> SharedSpace:
    """A space by name or folder, read once a process."""
    return SharedSpace.from_pretrained(name)


def _joined(parts: Sequence[MemoryIndex], **about: Any) -> MemoryIndex:
    """The phrases of one or more memories of one space, in their order."""
    songs = tuple(sorted({song for part in parts for song in part.songs}))
    number = {song: n for n, song in enumerate(songs)}
    renamed = [torch.tensor([number[song] for song in part.songs])[part.song] for part in parts]
    lengths = torch.cat([part.offsets.diff() for part in parts])
    fields: dict[str, Any] = {
        name: torch.cat([getattr(part, name) for part in parts])
        for name in (*KEY_TENSORS, *MOTION_TENSORS)
        if name not in INTEGERS
    }
    fields |= {name: tuple(t for part in parts for t in getattr(part, name)) for name in TEXTS}
    offsets = torch.nn.functional.pad(lengths.cumsum(0), (1, 0))
    return MemoryIndex(**fields, songs=songs, song=torch.cat(renamed), offsets=offsets, about=about)


def _embedded(pieces: Sequence[Piece], space: SharedSpace) -> list[Phrase]:
    """Pieces with their keys, in their order; embedded by length, so that little is padding."""
    order = sorted(range(len(pieces)), key=lambda n: len(pieces[n].body))
    phrases: dict[int, Phrase] = {}
    for start in range(0, len(order), BATCH):
        numbers = order[start : start + BATCH]
        batch = [pieces[number] for number in numbers]
        audio, mask = padded([torch.from_numpy(piece.audio) for piece in batch])
        bodies = [torch.from_numpy(piece.body).float() for piece in batch]
        audio_keys = space.embed_audio(audio, mask).float().cpu().numpy()
        body = pad_sequence(bodies, batch_first=True)
        motion_keys = space.embed_motion(body, mask).float().cpu().numpy()
        for row, (number, piece) in enumerate(zip(numbers, batch, strict=True)):
            keys = {"audio_key": audio_keys[row], "motion_key": motion_keys[row]}
            phrases[number] = replace(piece.phrase, **keys)
    return [phrases[number] for number in range(len(pieces))]


def padded(sounds: Sequence[Tensor]) -> tuple[Tensor, Tensor]:
    """Conditions [C,T] as one batch [B,C,T], padded with zeros that its mask [B,T] hides."""
    longest = max(sound.shape[1] for sound in sounds)
    batch = torch.zeros(len(sounds), max(len(sound) for sound in sounds), longest)
    for row, sound in zip(batch, sounds, strict=True):
        row[: len(sound), : sound.shape[1]] = sound
    lengths = torch.tensor([sound.shape[1] for sound in sounds])
    return batch, torch.arange(longest) < lengths[:, None]


# ---------------------------------------------------------------- of figures

COLUMNS = ("file", "kind", "source", "licence", "repeat")
DANCE = "dance"  # a kind that nobody named
MAX_REPEAT = 20
MADE = "steps"  # stands for a file: the takes that `steps.py` makes


@dataclass(frozen=True)
class TakeRow:
    """One line of a table; `repeat`: how often a loop is played."""

    file: Place
    kind: str = DANCE
    source: str = ""
    licence: str = ""
    repeat: int = 1


def read_takes(table: Path, folder: Place) -> list[TakeRow]:
    """The rows of a table, their files in `folder`.

    Raises:
        UserError: unreadable, another column, no row, no such file, or a bad number.
    """
    reader = csv.DictReader(io.StringIO(read_text(table, "a CSV file")))
    names = [name.strip().lower() for name in reader.fieldnames or ()]
    if "file" not in names or not set(names) <= set(COLUMNS):
        raise UserError(
            f"{table}: the columns are {', '.join(names) or 'none'}; give file and, if you like,"
            f" {', '.join(COLUMNS[1:])}"
        )
    rows = []
    for line, cells in enumerate(reader, start=2):
        values = dict(
            zip(names, (str(value or "").strip() for value in cells.values()), strict=False)
        )
        repeat = values.get("repeat") or "1"
        if not repeat.isdigit() or not 1 <= int(repeat) <= MAX_REPEAT:
            raise UserError(f"{table}: line {line}: repeat is {repeat!r}; give 1 to {MAX_REPEAT}")
        file = folder / values["file"]
        if values["file"] != MADE and not file.is_file():
            raise UserError(f"{table}: line {line}: {file} is no file; mend the name or the folder")
        kind = values.get("kind") or DANCE
        own = values.get("source", ""), values.get("licence", "")
        rows.append(TakeRow(file, kind, *own, int(repeat)))
    if not rows:
        raise UserError(f"{table} names no file; give one a line")
    return rows


def every_file(folder: Place) -> list[TakeRow]:
    """All motion files below a folder or an address, in order.

    Raises:
        UserError: there is none.
    """
    found = [path for path in files_below(folder) if path.suffix.lower() in FOLDER_ENDINGS]
    if not found:
        raise UserError(f"{folder} holds no motion files; name a folder of dances")
    return [TakeRow(path, source=folder.name) for path in found]


def build_figures(
    rows: Sequence[TakeRow], *, progress: Progress = lambda done, total: None
) -> tuple[FigureMemory, dict[str, str]]:
    """The memory of some takes, and those that could not be used, with the reason.

    Raises:
        UserError: none can.
    """
    takes: list[Take] = []
    left_out: dict[str, str] = {}
    for done, row in enumerate(rows, start=1):
        try:
            found = [*made_takes()] if row.file.name == MADE else [_take(row)]
            if not any(take.is_dance for take in found):
                left_out[str(row.file)] = "fewer than five counts were found"
            takes += found
        except UserError as error:
            left_out[str(row.file)] = str(error)
        progress(done, len(rows))
    if left_out and not any(take.is_dance for take in takes):
        first = "; ".join(f"{name}: {reason}" for name, reason in [*left_out.items()][:3])
        raise UserError(f"none of {len(rows)} files can be danced; give others: {first}")
    return FigureMemory(takes), left_out


def _take(row: TakeRow) -> Take:
    with fetched(row.file) as file:
        motion = without_flips(repeated(read_motion(file), row.repeat))
    return Take.of(motion, row.file.stem, row.kind, row.source, row.licence)


def repeated(motion: Motion, times: int) -> Motion:
    """A loop that is played some times, where it is."""
    return replace(
        motion,
        quaternions=np.tile(motion.quaternions, (times, 1, 1)),
        root_position=np.tile(motion.root_position, (times, 1)),
        contacts=np.tile(motion.contacts, (times, 1)),
    )
