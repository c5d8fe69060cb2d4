"""Prepared data, opened for reading and checked against its manifest; which split a clip is in.

Train, validation and test part takes, and whole label combinations, never windows.
"""

import hashlib
import re
from collections import defaultdict
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass, field
from functools import cached_property
from typing import Self

import torch
from pydantic import TypeAdapter, ValidationError
from safetensors import SafetensorError
from safetensors.torch import load_file
from torch import Tensor

from ..config_schema import Provenance
from ..errors import UsageError, UserError, first_fault
from ..io.files import inside, is_whole, load_json, sha256_file
from ..io.storage import Address, Place, fetched, place
from ..motion.features import mirror_features
from .captions.language import mirror_labels
from .captions.schema import Labels

SPLITS = ("train", "val", "test_seen", "test_unseen")
MIRRORED = "~mirrored"  # ends the id of a mirror image


@dataclass(frozen=True)
class ClipRecord:
    """One line of clips.jsonl.

    Attributes:
        group: whole label combination; its captions are in captions.json.
        mirrored: the stored features are to be mirrored (captions and labels already are).
        shard, offset: where its `num_frames` rows start.
    """

    id: str
    source: str
    take: str
    tag: str
    group: str
    labels: dict[str, str]
    mirrored: bool
    split: str
    num_frames: int
    shard: str
    offset: int
    captions: dict[str, list[str]] = field(default_factory=dict)
    provenance: Provenance = "captured"


VERSION = 3  # of prepared folders; 2 did not say where motion comes from, 1 held other splits
SYNTHETIC = "synthetic"
SYNTHETIC_CLIPS = 1500
ROWS = (23, 6)  # of a frame's features
_TEXTS = TypeAdapter(tuple[str, ...])
_FILES = TypeAdapter(dict[str, str])
_CAPTIONS = TypeAdapter(dict[str, dict[str, list[str]]])
_RECORD = TypeAdapter(ClipRecord)


@contextmanager
def damaged(path: Place) -> Iterator[None]:
    """What fails inside is the fault of this file of a prepared folder.

    Raises:
        UserError: instead of what failed.
    """
    try:
        yield
    except ValidationError as error:
        told = first_fault(error)
        raise UserError(f"{path} is damaged ({told:.300}); run `prepare` again") from None
    except (OSError, ValueError, TypeError, LookupError, SafetensorError) as error:
        raise UserError(f"{path} is damaged ({error!s:.300}); run `prepare` again") from None


def checked(values: Tensor, shape: tuple[int, ...]) -> Tensor:
    """The tensor, if it has this shape and finite numbers; ValueError if not."""
    if tuple(values.shape) != shape or not values.is_floating_point():
        raise ValueError(f"{values.dtype} {list(values.shape)} instead of numbers {list(shape)}")
    if not values.isfinite().all():
        raise ValueError("numbers that are not finite")
    return values


def parse_record(line: bytes) -> ClipRecord:
    """The record of a line of clips.jsonl; raises ValidationError."""
    return _RECORD.validate_json(line)


class PreparedData:
    """A folder written by `prepare`, held in memory (an hour of motion is 60 MB)."""

    def __init__(self, folder: Place, *, verify: bool = True) -> None:
        """Open a prepared folder.

        Args:
            folder: what `prepare --out` wrote.
            verify: compare every file with its SHA-256 in the manifest.

        Raises:
            UsageError: not a prepared folder.
            UserError: a file in it is missing or damaged.
        """
        self.folder = folder
        path = self.folder / "manifest.json"
        if not path.exists():
            raise UsageError(
                f"{folder} is not prepared data: no manifest.json; run `prepare` first"
            )
        with damaged(path):
            self.manifest = dict(load_json(path))
            self.tags: tuple[str, ...] = _TEXTS.validate_python(self.manifest["tags"])
            files = _FILES.validate_python(self.manifest["files"])
            version = int(self.manifest["version"])
        if version != VERSION:
            whose = "an older" if version < VERSION else "a newer"
            raise UserError(
                f"{folder} was prepared by {whose} version of this program (format {version}, this"
                f" one reads {VERSION}); run `prepare` again with the same sources and --out"
            )
        self.manifest_hash = sha256_file(path)
        if verify:
            self._verify(files)
        path = self.folder / "statistics.safetensors"
        with damaged(path), fetched(path) as local:
            statistics = load_file(local)
            self.mean: Tensor = checked(statistics["mean"], ROWS)  # 23 6
            self.std: Tensor = checked(statistics["std"], ROWS)  # 23 6
        path = self.folder / "captions.json"
        with damaged(path):
            self._captions = _CAPTIONS.validate_python(load_json(path))

    @classmethod
    def open(cls, folder: str | Place) -> Self:
        """Open a prepared folder, or an address; see `PreparedData`."""
        return cls(place(folder))

    def _verify(self, files: dict[str, str]) -> None:
        for name, digest in files.items():
            folder = self.folder
            path = folder / name if isinstance(folder, Address) else inside(folder, name)
            if not is_whole(path, digest):
                state = "is damaged" if path.exists() else "is missing"
                raise UserError(f"{path} {state}; run `prepare` again with the same options")

    @cached_property
    def _all_records(self) -> list[ClipRecord]:
        path = self.folder / "clips.jsonl"
        with damaged(path), path.open("rb") as stream:
            return [parse_record(line) for line in stream]

    @cached_property
    def _shards(self) -> dict[str, Tensor]:
        shards = {}
        names = (path.name for path in (self.folder / "shards").iterdir())
        for path in (self.folder / "shards" / name for name in sorted(names)):
            if path.suffix != ".safetensors" or path.name.startswith("."):
                continue
            with damaged(path), fetched(path) as local:
                features = load_file(local)["features"]
                shards[path.name] = checked(features, (len(features), *ROWS))
        return shards

    def records(self, split: str | None = None) -> list[ClipRecord]:
        """Records of one split (train, val, test_seen, test_unseen), or all."""
        assert split is None or split in SPLITS
        return [r for r in self._all_records if split is None or r.split == split]

    @cached_property
    def records_by_id(self) -> dict[str, ClipRecord]:
        """Every record by its id."""
        return {record.id: record for record in self._all_records}

    def features(self, record: ClipRecord) -> Tensor:
        """Raw features [T,23,6] float32 of a record, mirrored where it says so.

        Raises:
            UserError: the record names frames that are not there.
        """
        shard = self._shards.get(record.shard, torch.zeros(0))
        if not 0 <= record.offset < record.offset + record.num_frames <= len(shard):
            raise UserError(f"{self.folder}/clips.jsonl: {record.id!r:.60} names frames that no"
                            " shard holds; run `prepare` again")  # fmt: skip
        values = shard[record.offset : record.offset + record.num_frames]
        return mirror_features(values) if record.mirrored else values

    def captions(self, record: ClipRecord) -> dict[str, list[str]]:
        """All captions of a record by language: its own, and those of its label group."""
        merged = {language: list(texts) for language, texts in record.captions.items()}
        for language, texts in self._captions.get(record.group, {}).items():
            merged.setdefault(language, []).extend(texts)
        return merged

    def all_captions(self, split: str | None = None) -> dict[str, list[str]]:
        """Distinct captions by language, sorted."""
        found: dict[str, set[str]] = {}
        for record in {r.group + str(r.captions): r for r in self.records(split)}.values():
            for language, texts in self.captions(record).items():
                found.setdefault(language, set()).update(texts)
        return {language: sorted(texts) for language, texts in sorted(found.items())}


VAL_FRACTION = 0.04
TEST_FRACTION = 0.10
UNSEEN_FRACTION = 0.08
MIN_SUPPORT = 0.5  # share of a label's combinations that stays in training
MIN_TAKES = 5  # a combination with fewer takes keeps them all for training


def group_of(labels: Labels, caption: str = "") -> str:
    """Name of the whole label combination: the unit of splits and of positive pairs.

    A clip without labels is named by its caption.
    """
    if not labels:
        return f"caption={' '.join(caption.lower().split())}"
    return "|".join(f"{key}={labels[key]}" for key in sorted(labels))


def _order(seed: int, text: str) -> str:
    """A stable pseudo-random key: does not change when other clips come or go."""
    return hashlib.sha256(f"{seed}:{text}".encode()).hexdigest()


def orbit(labels: Labels, caption: str) -> str:
    """The combination and its mirror image under one name: both are held back or neither."""
    if not labels:
        return re.sub(r"\b(left|right)\b", "left/right", group_of({}, caption))
    return min(group_of(labels), group_of(mirror_labels(labels)))


def unseen_orbits(clips: Sequence[tuple[str, Labels]], seed: int) -> set[str]:
    """Combinations to hold back whole, chosen so that each of their labels is seen elsewhere.

    Only combinations of three labels or more qualify, and none that another one extends: the
    plain "walk forward, turning left" must be learned, "…, tired" can be composed.

    Args:
        clips: (orbit, labels) of every clip.
    """
    labels_of = dict(clips)
    keys_of = {
        name: [(labels.get("action", ""), *item) for item in labels.items() if item[0] != "action"]
        for name, labels in labels_of.items()
    }
    support: dict[tuple[str, str, str], set[str]] = defaultdict(set)
    for name, keys in keys_of.items():
        for key in keys:
            support[key].add(name)
    eligible = [
        name
        for name, labels in labels_of.items()
        if len(labels) >= 3
        and not any(labels.items() < other.items() for other in labels_of.values())
        and all(len(support[key]) >= 2 for key in keys_of[name])
    ]
    chosen: set[str] = set()
    for name in sorted(eligible, key=lambda name: _order(seed, name)):
        if len(chosen) >= round(UNSEEN_FRACTION * len(labels_of)):
            break
        left = [(len(support[key] - chosen - {name}), len(support[key])) for key in keys_of[name]]
        if all(stays >= max(1, MIN_SUPPORT * of) for stays, of in left):
            chosen.add(name)
    return chosen


def assign_splits(clips: Sequence[tuple[str, str, Labels]], seed: int) -> dict[str, str]:
    """Split of each take.

    Args:
        clips: (take, orbit, labels) of every clip.
        seed: another seed holds back other takes.
    """
    held_back = unseen_orbits([(name, labels) for _, name, labels in clips], seed)
    takes: dict[str, list[str]] = defaultdict(list)
    split: dict[str, str] = {}
    for take, name, _ in clips:
        if name in held_back:
            split[take] = "test_unseen"
        elif take not in split:
            split[take] = "train"
            takes[name].append(take)
    for members in takes.values():
        if len(members) < MIN_TAKES:
            continue
        ordered = sorted(members, key=lambda take: _order(seed, take))
        num_test = max(1, round(TEST_FRACTION * len(ordered)))
        num_val = max(1 if len(ordered) >= 2 * MIN_TAKES else 0, round(VAL_FRACTION * len(ordered)))
        for take in ordered[:num_test]:
            split[take] = "test_seen"
        for take in ordered[num_test : num_test + num_val]:
            split[take] = "val"
    return split


def assign_alike(names: Sequence[str], seed: int) -> dict[str, str]:
    """Train, val or test of songs or takes of one kind.

    Fewer than are needed for all three are all for training: what is held back of so few would be
    missed there and tell little.
    """
    if len(names) < 2 * MIN_TAKES:
        return dict.fromkeys(names, "train")
    drawn = assign_splits([(name, "of one kind", {}) for name in names], seed)
    return {name: split.partition("_")[0] for name, split in drawn.items()}
