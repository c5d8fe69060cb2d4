"""Prepared data, opened for reading and checked against its manifest."""

from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import asdict, dataclass, field
from functools import cached_property
from pathlib import Path
from typing import Any

import torch
from pydantic import TypeAdapter, ValidationError
from safetensors import SafetensorError
from safetensors.torch import load_file
from torch import Tensor

from ..config_schema import Provenance
from ..errors import UserError, first_fault
from ..io.files import inside, load_json, sha256_file
from ..motion.features import mirror_features

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

    def to_json(self) -> dict[str, Any]:
        return asdict(self)


VERSION = 3  # of prepared folders; 2 did not say where motion comes from, 1 held other splits
SYNTHETIC = "synthetic"
SYNTHETIC_CLIPS = 1500
ROWS = (23, 6)  # of a frame's features
_TEXTS = TypeAdapter(tuple[str, ...])
_FILES = TypeAdapter(dict[str, str])
_CAPTIONS = TypeAdapter(dict[str, dict[str, list[str]]])
_RECORD = TypeAdapter(ClipRecord)


@contextmanager
def damaged(path: Path) -> Iterator[None]:
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


def _checked(values: Tensor, shape: tuple[int, ...]) -> Tensor:
    """The tensor, if it has this shape and finite numbers; ValueError if not."""
    if tuple(values.shape) != shape or not values.is_floating_point():
        raise ValueError(f"{values.dtype} {list(values.shape)} instead of numbers {list(shape)}")
    if not values.isfinite().all():
        raise ValueError("numbers that are not finite")
    return values


class PreparedData:
    """A folder written by `prepare`, held in memory (an hour of motion is 60 MB)."""

    def __init__(self, folder: Path, *, verify: bool = True) -> None:
        """Open a prepared folder.

        Args:
            folder: what `prepare --out` wrote.
            verify: compare every file with its SHA-256 in the manifest.

        Raises:
            UserError: not a prepared folder, or a file is missing or damaged.
        """
        self.folder = Path(folder)
        path = self.folder / "manifest.json"
        if not path.exists():
            raise UserError(f"{folder} is not prepared data: no manifest.json; run `prepare` first")
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
        with damaged(path):
            statistics = load_file(path)
            self.mean: Tensor = _checked(statistics["mean"], ROWS)  # 23 6
            self.std: Tensor = _checked(statistics["std"], ROWS)  # 23 6
        path = self.folder / "captions.json"
        with damaged(path):
            self._captions = _CAPTIONS.validate_python(load_json(path))

    @classmethod
    def open(cls, folder: str | Path) -> "PreparedData":
        """Open a prepared folder; see `PreparedData`."""
        return cls(Path(folder))

    def _verify(self, files: dict[str, str]) -> None:
        for name, digest in files.items():
            path = inside(self.folder, name)
            if not path.exists() or sha256_file(path) != digest:
                state = "is damaged" if path.exists() else "is missing"
                raise UserError(f"{path} {state}; run `prepare` again with the same options")

    @cached_property
    def _all_records(self) -> list[ClipRecord]:
        path = self.folder / "clips.jsonl"
        with damaged(path), path.open(encoding="utf-8") as stream:
            return [_RECORD.validate_json(line) for line in stream]

    @cached_property
    def _shards(self) -> dict[str, Tensor]:
        shards = {}
        for path in sorted((self.folder / "shards").glob("*.safetensors")):
            with damaged(path):
                features = load_file(path)["features"]
                shards[path.name] = _checked(features, (len(features), *ROWS))
        return shards

    def records(self, split: str | None = None) -> list[ClipRecord]:
        """Records of one split (train, val, test_seen, test_unseen), or all."""
        assert split is None or split in SPLITS
        return [r for r in self._all_records if split is None or r.split == split]

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
