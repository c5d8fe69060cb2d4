"""Pairs of sound and motion from a folder or bucket: TECH §6.1's MotionPhraseDataset.

B batch, T frames (30 a second), C = 163 rows of sound, or 167 with beat and bar phase.
"""

import hashlib
import threading
from collections import OrderedDict
from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
import torch
from torch import Tensor

from ...errors import UsageError, UserError
from ...io.concurrency import prefetch
from ...io.storage import Backoff, Unreachable
from ...motion.trajectory import encode_window
from .layout import (
    BadContent,
    PhraseRecord,
    PhraseTable,
    common_length,
    decode_body,
    decode_features,
    decode_trajectory,
    phase_rows,
)
from .store import CACHE_BYTES, ObjectCache, PhraseStore, Quarantine, Remote, default_cache

_PHASE = 16  # column of a trajectory: bars modulo 1


@dataclass(frozen=True, eq=False)
class DecodedPhrase:
    """T frames, C = 163 rows of sound, or 167 with beat and bar phase.

    Attributes:
        trajectory: [T,25] float32.
        phase: unwrapped bars [T] float64.
        audio: [C,T] float32.
        body: features [T,23,6] float16, if asked for.
    """

    trajectory: np.ndarray
    phase: np.ndarray
    audio: np.ndarray
    body: np.ndarray | None

    @property
    def num_bytes(self) -> int:
        arrays = (self.trajectory, self.phase, self.audio, self.body)
        return sum(array.nbytes for array in arrays if array is not None)


MEMORY_BYTES = 128 << 20  # an hour and a half of trajectories and sound


class MemoryCache:
    """Decoded phrases by name, up to so many bytes: what was not used for longest goes first."""

    def __init__(self, limit: int) -> None:
        self._limit, self._bytes = limit, 0
        self._phrases: OrderedDict[str, DecodedPhrase] = OrderedDict()
        self._lock = threading.Lock()

    def get(self, name: str) -> DecodedPhrase | None:
        with self._lock:
            if name in self._phrases:
                self._phrases.move_to_end(name)
            return self._phrases.get(name)

    def put(self, name: str, phrase: DecodedPhrase) -> None:
        with self._lock:
            if name in self._phrases:  # another thread was faster
                return
            self._phrases[name] = phrase
            self._bytes += phrase.num_bytes
            while self._bytes > self._limit:
                self._bytes -= self._phrases.popitem(last=False)[1].num_bytes

    def __getstate__(self) -> dict[str, object]:
        return {"_limit": self._limit}

    def __setstate__(self, state: dict[str, int]) -> None:
        self.__init__(state["_limit"])  # type: ignore[misc]


def read_phrase(
    store: PhraseStore, record: PhraseRecord, *, beat_phase: bool, body: bool
) -> DecodedPhrase:
    """Read all of a phrase.

    Args:
        beat_phase: add the four rows of beat and bar phase where they are known.
        body: read the body where there is one.

    Raises:
        BadContent, Unreachable: see `PhraseStore.load`; also where lengths differ.
    """
    trajectory = store.load(record.motion, decode_trajectory)
    sound = store.load(record.features, decode_features)
    frames = common_length(trajectory, sound)
    audio = sound.stacked[:, :frames]
    if beat_phase and sound.phase is not None:
        audio = np.concatenate([audio, phase_rows(sound.phase[:frames], sound.meter)])
    phase = np.unwrap(trajectory[:frames, _PHASE].astype(np.float64), period=1.0)
    shown = _read_body(store, record, frames) if body else None
    return DecodedPhrase(trajectory[:frames], phase, audio, shown)


def _read_body(store: PhraseStore, record: PhraseRecord, frames: int) -> np.ndarray | None:
    if record.body is None:
        return None
    features = store.load(record.body, decode_body)
    if len(features) < frames:
        raise BadContent(f"{record.body.path} has {len(features)} frames, the motion {frames}")
    return features[:frames].astype(np.float16)


class EmptySplit(UserError):
    """There are phrases, none of them of the split that was asked for."""


def _of_split(
    phrases: Iterable[PhraseRecord], split: str | None, splits: set[str]
) -> Iterator[PhraseRecord]:
    """Those of a split, or all; collects in `splits` which ones there are."""
    for phrase in phrases:
        splits.add(phrase.split)
        if split in (None, phrase.split):
            yield phrase


Encode = Callable[[np.ndarray, np.ndarray], np.ndarray]


@dataclass(frozen=True, eq=False)
class PhraseItem:
    """One window: motion [25,T], audio [C,T] float32, mask [T] True on real frames, its phrase.

    `body`: features [T,23,6] where the data set was asked for them.
    """

    motion: Tensor
    audio: Tensor
    mask: Tensor
    record: PhraseRecord
    body: Tensor | None = None


@dataclass(frozen=True, eq=False)
class PhraseBatch:
    """Windows stacked: motion [B,25,T], audio [B,C,T], mask [B,T], B records, body [B,T,23,6]."""

    motion: Tensor
    audio: Tensor
    mask: Tensor
    records: list[PhraseRecord]
    body: Tensor | None = None

    def __len__(self) -> int:
        return len(self.records)


class MotionPhraseDataset(torch.utils.data.Dataset[tuple[Tensor, Tensor]]):
    """Windows of phrases; what cannot be used is retried once, quarantined, counted and named.

    A phrase that is bad is left out: of an epoch, of a batch, of what a DataLoader makes of
    `dataset[i]` for many i. `dataset[i]` alone raises `BadContent`.

    Args:
        root: folder or URL; without it `gs://{gcs_bucket}/{gcs_prefix}` (TECH's spelling).
        num_phrases: take only the first so many.
        target_frames: T; shorter phrases are padded with zeros, longer ones give a window.
        cache_in_memory: keep decoded phrases, the last used in `memory_bytes`.
        split: of the manifest; None is all.
        beat_phase: add the four rows of beat and bar phase where features.npz holds `phase`
            (unwrapped bars) and `meter`; `collate` fills zeros, "unknown", where others do not.
        bodies: read the whole body of each phrase too.
        encode: trajectory [T,25] and unwrapped bars [T] -> window [25,T]; `encode_window`.
        cache_dir: for downloads and the quarantine list; default `~/.cache/motionsuite/phrases`.
        cache_bytes: limit of the downloads kept on disk; None keeps all.
        memory_bytes: limit of the decoded phrases kept.
        threads: downloads at a time; 0 fetches on demand.
        storage_options: for fsspec (credentials, endpoint).

    Raises:
        UsageError: neither root nor bucket; an unknown kind of URL.
        UserError: nothing there, cannot be read, no bodies where they are asked for, or more bad
            phrases than `max_bad_fraction`.
    """

    def __init__(
        self,
        root: str | Path | None = None,
        *,
        gcs_bucket: str | None = None,
        gcs_prefix: str = "motionphrase",
        num_phrases: int | None = None,
        target_frames: int = 120,
        cache_in_memory: bool = True,
        split: str | None = None,
        beat_phase: bool = True,
        bodies: bool = False,
        encode: Encode | None = None,
        cache_dir: Path | None = None,
        cache_bytes: int | None = CACHE_BYTES,
        memory_bytes: int = MEMORY_BYTES,
        threads: int = 8,
        max_bad_fraction: float = 0.05,
        storage_options: dict[str, Any] | None = None,
        backoff: Backoff | None = None,
        seed: int = 0,
    ) -> None:
        if root is None and gcs_bucket is None:
            raise UsageError("no data: give root (a folder or URL) or gcs_bucket")
        self.root = str(root) if root is not None else f"gs://{gcs_bucket}/{gcs_prefix.strip('/')}"
        self.target_frames, self.seed, self.threads = target_frames, seed, threads
        self._encode = encode or encode_window
        remote = Remote(self.root, storage_options=storage_options, backoff=backoff or Backoff())
        cache_dir = cache_dir or default_cache()
        cache = None if remote.local else ObjectCache(cache_dir, max_bytes=cache_bytes)
        self.store = PhraseStore(remote, cache)
        splits: set[str] = set()
        chosen = _of_split(remote.phrases(), split, splits)
        self.phrases = PhraseTable(chosen, num_phrases, self.root)
        if not splits:
            raise UserError(
                f"{self.root} has no phrases; it needs audio_features/ID/features.npz and"
                " motion/ID/trajectory.npy: make them with prepare-audio"
            )
        if not self.phrases:
            known = ", ".join(sorted(splits))
            raise EmptySplit(
                f"{self.root} has no phrases of split {split} (splits: {known}); name one of"
                " these, or prepare more songs and clips"
            )
        if bodies and any(phrase.body is None for phrase in self.phrases):
            raise UserError(
                f"{self.root} holds trajectories without bodies, as prepare-audio once wrote them;"
                " run prepare-audio into it again with the same options: it adds what is missing"
            )
        name = hashlib.sha256(self.root.encode()).hexdigest()[:16]
        self.quarantine = Quarantine(
            cache_dir / "quarantine" / f"{name}.json", self.root, self.phrases, max_bad_fraction
        )
        self._memory = MemoryCache(memory_bytes if cache_in_memory else 0)
        self._order = (-1, np.empty(0, np.int64))
        self.epoch_number = 0
        self.beat_phase, self.bodies = beat_phase, bodies

    @property
    def phrase_ids(self) -> list[str]:
        return [phrase.id for phrase in self.phrases]

    @property
    def fingerprint(self) -> str:
        """Changes when any phrase's content or the selection of phrases does."""
        return self.phrases.fingerprint

    # ------------------------------------------------------------ one item

    def __len__(self) -> int:
        return len(self.phrases)

    def set_epoch(self, epoch: int) -> None:
        """Draw other windows from now on in `dataset[i]`."""
        self.epoch_number = epoch

    def __getitem__(self, index: int) -> tuple[Tensor, Tensor]:
        """Motion [25,T] and audio_cond [C,T] (TECH §6.1)."""
        index = range(len(self))[index]  # -1 is the last; IndexError ends a plain for loop
        item = self.item(index, self.epoch_number)
        if item is None:
            name = self.phrases[index].id
            raise BadContent(f"{name} is in quarantine: {self.quarantine.reasons[name]}")
        return item.motion, item.audio

    def __getitems__(self, indices: Sequence[int]) -> list[tuple[Tensor, Tensor]]:
        """What a DataLoader asks for: the good ones of these."""
        items = (self.item(index, self.epoch_number) for index in indices)
        return [(item.motion, item.audio) for item in items if item is not None]

    def item(self, index: int, draw: int) -> PhraseItem | None:
        """The window of a phrase that (seed, draw, index) gives; None in quarantine.

        Args:
            draw: epoch or step.

        Raises:
            UserError: too many phrases are bad.
        """
        record = self.phrases[index]
        phrase = self._load(record)
        if phrase is None:
            return None
        rng = np.random.default_rng((self.seed, draw, index))
        start = int(rng.integers(max(1, len(phrase.phase) - self.target_frames + 1)))
        part = slice(start, start + self.target_frames)
        window = self._encode(phrase.trajectory[part], phrase.phase[part])
        length = window.shape[1]
        motion = torch.zeros(25, self.target_frames)
        audio = torch.zeros(len(phrase.audio), self.target_frames)
        motion[:, :length] = torch.from_numpy(window)
        audio[:, :length] = torch.from_numpy(phrase.audio[:, part])
        body = None
        if phrase.body is not None:
            body = torch.zeros(self.target_frames, *phrase.body.shape[1:])
            body[:length] = torch.from_numpy(phrase.body[part].astype(np.float32))
        return PhraseItem(motion, audio, torch.arange(self.target_frames) < length, record, body)

    def whole(self, index: int) -> DecodedPhrase | None:
        """A phrase in its full length, None in quarantine; raises UserError as `item`."""
        return self._load(self.phrases[index])

    def _load(self, record: PhraseRecord) -> DecodedPhrase | None:
        if record.id in self.quarantine:
            return None
        if (kept := self._memory.get(record.id)) is not None:
            return kept
        try:
            phrase = read_phrase(self.store, record, beat_phase=self.beat_phase, body=self.bodies)
        except BadContent as error:
            self.quarantine.add(record, str(error))
            return None
        except Unreachable as error:  # no fault of the object: another process may try again
            self.quarantine.add(record, f"unreachable: {error}", keep=False)
            return None
        self._memory.put(record.id, phrase)
        return phrase

    # ------------------------------------------------------------ epochs and batches

    def order(self, epoch: int) -> np.ndarray:
        """The indices of all phrases in the order of an epoch."""
        known, order = self._order
        if known != epoch:
            order = np.random.default_rng((self.seed, epoch)).permutation(len(self.phrases))
            self._order = (epoch, order)
        return order

    def epoch(self, epoch: int = 0, position: int = 0) -> "EpochIterator":
        """Every good phrase once; see `EpochIterator`."""
        return EpochIterator(self, epoch, position)

    def batch(self, step: int, size: int, *, index: int = 0, count: int = 1) -> PhraseBatch:
        """Part `index` of `count` parts of `size` of step 1, 2, …: a function of these alone.

        Steps walk through the epochs in order, so every good phrase comes once an epoch. A bad one
        leaves the part smaller; a part of bad ones only takes the next good phrase.
        """
        first = ((step - 1) * count + index) * size
        items = list(prefetch(self._at, range(first, first + size), min(self.threads, size)))
        good = [item for item in items if item is not None]
        while not good:  # ends: the quarantine fails first if all are bad
            first += size
            good = [item for item in [self._at(first)] if item is not None]
        return collate(good)

    def _at(self, place: int) -> PhraseItem | None:
        epoch, position = divmod(place, len(self.phrases))
        return self.item(int(self.order(epoch)[position]), epoch)

    def report(self) -> dict[str, Any]:
        """Downloads, cache hits, and every bad phrase with its reason."""
        return {**self.store.counts, "phrases": len(self), "bad": dict(self.quarantine.reasons)}


def collate(items: Sequence[PhraseItem]) -> PhraseBatch:
    """Items as one batch; C is that of the item with most. Bodies: all have one, or none has."""
    rows = max(len(item.audio) for item in items)
    audio = [torch.nn.functional.pad(i.audio, (0, 0, 0, rows - len(i.audio))) for i in items]
    bodies = [item.body for item in items if item.body is not None]
    return PhraseBatch(
        motion=torch.stack([item.motion for item in items]),
        audio=torch.stack(audio),
        mask=torch.stack([item.mask for item in items]),
        records=[item.record for item in items],
        body=torch.stack(bodies) if bodies else None,
    )


class EpochIterator:
    """Every good phrase of one epoch exactly once, in an order given by (seed, epoch).

    Save `state_dict()` together with what became of the items; an iterator with that state loaded
    goes on behind the last item handed out, in this process or another.
    """

    def __init__(self, dataset: MotionPhraseDataset, epoch: int, position: int = 0) -> None:
        self.dataset, self.epoch, self.position = dataset, epoch, position
        self._items: Iterator[tuple[int, PhraseItem | None]] | None = None

    def __iter__(self) -> "EpochIterator":
        return self

    def __next__(self) -> PhraseItem:
        if self._items is None:
            self._items = self._start()
        for position, item in self._items:
            self.position = position + 1
            if item is not None:
                return item
        raise StopIteration

    def _start(self) -> Iterator[tuple[int, PhraseItem | None]]:
        order = self.dataset.order(self.epoch)
        positions = range(self.position, len(order))

        def make(position: int) -> tuple[int, PhraseItem | None]:
            return position, self.dataset.item(int(order[position]), self.epoch)

        threads = self.dataset.threads
        return prefetch(make, positions, threads, depth=2 * threads)

    def state_dict(self) -> dict[str, Any]:
        """Plain data for JSON: the position counts bad phrases too."""
        return {
            "epoch": self.epoch,
            "position": self.position,
            "seed": self.dataset.seed,
            "data": self.dataset.fingerprint,
        }

    def load_state_dict(self, state: dict[str, Any]) -> None:
        """Go on where another iterator stopped.

        Raises:
            UserError: that one ran over other data or with another seed.
        """
        for name, now in (("data", self.dataset.fingerprint), ("seed", self.dataset.seed)):
            if state[name] != now:
                raise UserError(
                    f"cannot go on in epoch {state['epoch']}: its {name} was {state[name]}, that of"
                    f" {self.dataset.root} is {now}; start the epoch again"
                )
        self.epoch, self.position, self._items = state["epoch"], state["position"], None


MOST = 2000  # windows looked at
LEAST_STD = 1e-3
FEATURE_ROWS = 163  # of sound; phases are no features


def motion_statistics(dataset: MotionPhraseDataset) -> tuple[Tensor, Tensor]:
    """Mean and deviation [25] of the window rows over real frames of up to `MOST` items; raises
    UserError where no phrase can be used."""
    return _statistics(dataset, lambda item: item.motion)


def sound_statistics(dataset: MotionPhraseDataset) -> tuple[Tensor, Tensor]:
    """Mean and deviation [163] of the features of sound, as `motion_statistics`."""
    return _statistics(dataset, lambda item: item.audio[:FEATURE_ROWS])


def _statistics(
    dataset: MotionPhraseDataset, rows: Callable[[PhraseItem], Tensor]
) -> tuple[Tensor, Tensor]:
    count, total, squares = 0, np.zeros(1), np.zeros(1)
    for number, item in enumerate(dataset.epoch(0)):
        if number == MOST:
            break
        values = rows(item)[:, item.mask].numpy().astype(np.float64)
        count += values.shape[1]
        total, squares = total + values.sum(1), squares + (values**2).sum(1)
    if count == 0:
        raise UserError(f"{dataset.root} has no phrase that can be used; prepare it again")
    mean = total / count
    std = np.sqrt(np.maximum(squares / count - mean**2, 0)).clip(LEAST_STD)
    return torch.from_numpy(mean).float(), torch.from_numpy(std).float()
