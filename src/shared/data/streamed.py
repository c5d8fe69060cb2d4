"""A prepared folder or address of any size, read shard by shard: every clip once an epoch.

Shards come in an order of their own each epoch, and the clips of `MIXED` of them are mixed. Which
clip is at which place follows from (seed, epoch, place) and from how many clips each shard has, so
that a run goes on in the middle of an epoch without any state, in as many processes as it likes.
What a stage needs to know of the whole (words, styles, validation) it takes from a sample of clips.

Memory holds some shards, the sample, and a few numbers of every shard.
"""

import hashlib
import threading
from collections import OrderedDict
from collections.abc import Iterator
from dataclasses import dataclass
from functools import lru_cache
from typing import Unpack

import numpy as np
import torch
from safetensors.torch import load
from torch import Tensor

from ..errors import UserError
from ..io.files import parse_json
from ..io.storage import Backoff, Place, Unreachable, read_blocks, read_range
from ..motion.features import mirror_features
from .phrases.layout import BadContent, StoredObject
from .phrases.store import ObjectCache, PhraseStore, Remote, default_cache
from .prepared import ROWS, ClipRecord, PreparedData, checked, damaged, parse_record
from .text_motion import CaptionedWindows, TextMotionBatch, WindowOptions, comes_back

MIXED = 8  # shards whose clips are mixed
AHEAD = 2  # more are kept, for batches that are made ahead; and those that one batch walks through
SAMPLE = {"train": 8192, "val": 512}  # clips at most, of the kinds that training looks at whole
_FRAME = ROWS[0] * ROWS[1] * 4  # bytes


@dataclass(frozen=True)
class Shard:
    """One shard: its file's name, and where its lines of clips.jsonl begin and end."""

    name: str
    start: int
    stop: int


class StreamedData(PreparedData):
    """A prepared folder whose shards stay where they are; its records are those of the sample.

    Args:
        folder: as of `PreparedData`.

    Attributes:
        shards: all of them.
        files: SHA-256 of each file.

    Raises:
        UserError: as `PreparedData`; of the shards, when one is read.
    """

    def __init__(self, folder: Place) -> None:
        super().__init__(folder, verify=False)
        self.files: dict[str, str] = self.manifest["files"]
        small = ("statistics.safetensors", "captions.json")
        self._verify({name: self.files[name] for name in small})
        self.shards: list[Shard] = []
        self._starts: dict[str, int] = {}
        self._sample = self._survey()

    def lines(self) -> Iterator[bytes]:
        """The lines of clips.jsonl, read in blocks.

        Raises:
            UserError: the file is damaged, as its end shows.
        """
        path = self.folder / "clips.jsonl"
        digest, rest = hashlib.sha256(), b""
        for block in read_blocks(path):
            digest.update(block)
            *whole, rest = (rest + block).split(b"\n")
            yield from whole
        if rest or digest.hexdigest() != self.files["clips.jsonl"]:
            raise UserError(f"{path} is damaged; run `prepare` again with the same options")

    def _survey(self) -> list[ClipRecord]:
        """Find the lines of each shard; returns the clips that the hashes of their ids draw."""
        chosen: dict[str, list[tuple[int, bytes]]] = {split: [] for split in SAMPLE}
        least = dict.fromkeys(SAMPLE, 1 << 64)  # of hashes that are taken
        at, begun, last, seen = 0, 0, "", set()
        with damaged(self.folder / "clips.jsonl"):
            for line in self.lines():
                about = parse_json(line)
                if about["shard"] != last:
                    if about["shard"] in seen:
                        raise ValueError(f"the clips of {about['shard']} are not together")
                    seen.add(about["shard"])
                    self._add(last, begun, at)
                    last, begun = about["shard"], at
                at += len(line) + 1
                split = about["split"]
                if split not in SAMPLE:
                    continue
                digest = hashlib.blake2b(about["id"].encode(), digest_size=8).digest()
                mark = int.from_bytes(digest, "big")
                if mark < least[split]:
                    chosen[split].append((mark, line))
                while len(chosen[split]) > SAMPLE[split]:
                    least[split] //= 2
                    chosen[split] = [one for one in chosen[split] if one[0] < least[split]]
            self._add(last, begun, at)
            return [parse_record(line) for some in chosen.values() for _, line in some]

    def _add(self, name: str, start: int, stop: int) -> None:
        if name:
            self.files[f"shards/{name}"]  # a shard that the manifest lacks is damage
            self.shards.append(Shard(name, start, stop))

    def records_of(self, shard: Shard) -> list[ClipRecord]:
        """Every clip of a shard."""
        path = self.folder / "clips.jsonl"
        with damaged(path):
            return [*map(parse_record, read_range(path, shard.start, shard.stop).splitlines())]

    def records(self, split: str | None = None) -> list[ClipRecord]:
        """Records of the sample."""
        return [record for record in self._sample if split in (None, record.split)]

    def features(self, record: ClipRecord) -> Tensor:
        """Raw features [T,23,6] of one clip, of which nothing is kept.

        Raises:
            UserError: its shard is damaged.
        """
        path = self.folder / "shards" / record.shard
        with damaged(path):
            begin = self._data_start(path) + record.offset * _FRAME
            data = read_range(path, begin, begin + record.num_frames * _FRAME)
            values = torch.frombuffer(bytearray(data), dtype=torch.float32)
            values = checked(values.view(-1, *ROWS), (record.num_frames, *ROWS))
        return mirror_features(values) if record.mirrored else values

    def _data_start(self, path: Place) -> int:
        """Where the frames begin in a shard: after the header of safetensors."""
        if path.name not in self._starts:
            length = int.from_bytes(read_range(path, 0, 8), "little")
            about = parse_json(read_range(path, 8, 8 + length))["features"]
            if about["dtype"] != "F32":
                raise ValueError(f"{about['dtype']} instead of F32")
            self._starts[path.name] = 8 + length + about["data_offsets"][0]
        return self._starts[path.name]


@dataclass(frozen=True)
class _Loaded:
    """The usable clips of a shard, its frames [N,23,6], and the ids of its gestures."""

    records: list[ClipRecord]
    features: Tensor
    gestures: frozenset[str]


class StreamedSet(CaptionedWindows):
    """The training clips of `StreamedData`, each once an epoch; balance has no meaning here."""

    data: StreamedData

    def __init__(self, data: StreamedData, **windows: Unpack[WindowOptions]) -> None:
        """Count the usable clips of each shard; raises ValueError where there is none."""
        super().__init__(data, **windows)
        numbers = {shard.name: number for number, shard in enumerate(data.shards)}
        self._counts = np.zeros(len(data.shards), np.int64)
        for record in map(parse_record, data.lines()):
            self._counts[numbers[record.shard]] += self._is_usable(record)
        self._total = int(self._counts.sum())
        if not self._total:
            raise ValueError(
                f"{data.folder} has no training clip of at least {self.min_frames} frames"
            )
        self._numbers = numbers
        remote = Remote(str(data.folder), backoff=Backoff())
        cache = None if remote.local else ObjectCache(default_cache())
        self._store = PhraseStore(remote, cache)
        self._loaded: OrderedDict[int, _Loaded] = OrderedDict()
        self._kept = MIXED + AHEAD
        self._lock = threading.Lock()
        self._plan = lru_cache(2)(self._plan_of)
        self._mix = lru_cache(MIXED + AHEAD)(self._mix_of)

    def __len__(self) -> int:
        return self._total

    def _is_usable(self, record: ClipRecord) -> bool:
        return record.split == "train" and super()._is_usable(record)

    # ------------------------------------------------------------ the order

    def _plan_of(self, epoch: int) -> tuple[np.ndarray, np.ndarray]:
        """Shards in their order, and the place at which each turn's clips begin.

        The clips of the shard at place n are spread over the turns n, …, n + MIXED - 1.
        """
        order = np.random.default_rng((self.seed, epoch)).permutation(len(self._counts))
        sizes = np.zeros(len(order) + MIXED, np.int64)  # the first stays 0
        for place, shard in enumerate(order):
            sizes[place + 1 : place + MIXED + 1] += np.bincount(
                self._turns(epoch, int(shard)), minlength=MIXED
            )
        return order, sizes.cumsum()

    def _turns(self, epoch: int, shard: int) -> np.ndarray:
        """In which turn after its own each clip of a shard comes [clips]."""
        rng = np.random.default_rng((self.seed, epoch, shard, 3))
        turns: np.ndarray = rng.integers(MIXED, size=self._counts[shard])
        return turns

    def _mix_of(self, epoch: int, turn: int) -> np.ndarray:
        """Shard and row of the clips of a turn, in their order [clips,2]."""
        order, _ = self._plan(epoch)
        found = []
        for place in range(max(0, turn - MIXED + 1), min(turn + 1, len(order))):
            rows = np.flatnonzero(self._turns(epoch, int(order[place])) == turn - place)
            found.append(np.stack((np.full_like(rows, order[place]), rows), axis=1))
        return np.random.default_rng((self.seed, epoch, turn, 4)).permutation(np.concatenate(found))

    def at(self, place: int) -> ClipRecord:
        """The clip at a place of the endless row of epochs."""
        epoch, place = divmod(place, self._total)
        _, begins = self._plan(epoch)
        turn = int(begins.searchsorted(place, "right")) - 1
        shard, row = self._mix(epoch, turn)[place - begins[turn]]
        return self._load(int(shard)).records[int(row)]

    def batch(self, step: int, size: int, *, rank: int = 0, count: int = 1) -> TextMotionBatch:
        """Part `rank` of `count` parts of `size` of step 1, 2, …; they walk through the epochs.

        One length a step, spread evenly, and longer where a clip of the part is not to be cut.
        """
        first = ((step - 1) * count + rank) * size
        self._kept = MIXED + AHEAD + size * len(self._counts) // self._total
        records = [self.at(place) for place in range(first, first + size)]
        shared = np.random.default_rng((self.seed, step))
        longest = self._longest(shared)
        longest = max(longest, *(self._fewest_frames(record) for record in records))
        rng = np.random.default_rng((self.seed, step, rank, 1))
        return self.collate(records, min(longest, self.max_frames), rng)

    # ------------------------------------------------------------ the shards

    def _load(self, number: int) -> _Loaded:
        """A shard in memory; raises UserError where it is missing, damaged or out of reach."""
        with self._lock:
            if number not in self._loaded:
                while len(self._loaded) >= self._kept:
                    self._loaded.popitem(last=False)
                self._loaded[number] = self._read(self.data.shards[number])
            self._loaded.move_to_end(number)
            return self._loaded[number]

    def _read(self, shard: Shard) -> _Loaded:
        name = f"shards/{shard.name}"
        path = self.data.folder / name
        try:
            obj = StoredObject(path=name, sha256=self.data.files[name])
            features = self._store.load(obj, lambda data: load(data)["features"])
        except (BadContent, Unreachable) as error:
            raise UserError(
                f"{path}: {error}; go on with --resume where it can be read, or run `prepare`"
                " again with the same options"
            ) from None
        with damaged(path):
            features = checked(features, (len(features), *ROWS))
            records = [r for r in self.data.records_of(shard) if self._is_usable(r)]
            if any(r.offset + r.num_frames > len(features) for r in records):
                raise ValueError("clips.jsonl names frames that it lacks")
        gestures = {r.id for r in records if comes_back(_frames(features, r))}
        return _Loaded(records, features, frozenset(gestures))

    def _features(self, record: ClipRecord) -> Tensor:
        values = _frames(self._load(self._numbers[record.shard]).features, record)
        return mirror_features(values) if record.mirrored else values

    def _comes_back(self, record: ClipRecord) -> bool:
        return record.id in self._load(self._numbers[record.shard]).gestures

    def _group(self, record: ClipRecord) -> int:
        digest = hashlib.blake2b(record.group.encode(), digest_size=8).digest()
        return int.from_bytes(digest, "big") >> 1


def _frames(features: Tensor, record: ClipRecord) -> Tensor:
    """A clip's part [T,23,6] of its shard's frames."""
    return features[record.offset : record.offset + record.num_frames]
