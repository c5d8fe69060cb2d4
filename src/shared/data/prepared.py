"""Prepared data, opened for reading and checked against its manifest."""

import hashlib
import json
from functools import cached_property
from pathlib import Path

from safetensors import SafetensorError
from safetensors.torch import load_file
from torch import Tensor

from src.shared.data.records import SPLITS, ClipRecord
from src.shared.errors import UserError
from src.shared.files import sha256_file
from src.shared.motion.mirror import mirror_features

SYNTHETIC = "synthetic"
SYNTHETIC_CLIPS = 1500


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
        text = path.read_text(encoding="utf-8")
        self.manifest = json.loads(text)
        self.manifest_hash = hashlib.sha256(text.encode()).hexdigest()
        if verify:
            self._verify()
        self.tags: tuple[str, ...] = tuple(self.manifest["tags"])
        statistics = load_file(self.folder / "statistics.safetensors")
        self.mean: Tensor = statistics["mean"]  # 23 6
        self.std: Tensor = statistics["std"]  # 23 6
        self._captions = json.loads((self.folder / "captions.json").read_text(encoding="utf-8"))

    @classmethod
    def open(cls, folder: str | Path) -> "PreparedData":
        """Open a prepared folder; see `PreparedData`."""
        return cls(Path(folder))

    def _verify(self) -> None:
        for name, digest in self.manifest["files"].items():
            path = self.folder / name
            if not path.exists() or sha256_file(path) != digest:
                state = "is damaged" if path.exists() else "is missing"
                raise UserError(f"{path} {state}; run `prepare` again with the same options")

    @cached_property
    def _all_records(self) -> list[ClipRecord]:
        with (self.folder / "clips.jsonl").open(encoding="utf-8") as stream:
            return [ClipRecord(**json.loads(line)) for line in stream]

    @cached_property
    def _shards(self) -> dict[str, Tensor]:
        try:
            return {
                path.name: load_file(path)["features"]
                for path in sorted((self.folder / "shards").glob("*.safetensors"))
            }
        except SafetensorError as error:
            raise UserError(f"{self.folder}/shards: {error}; run `prepare` again") from None

    def records(self, split: str | None = None) -> list[ClipRecord]:
        """Records of one split (train, val, test_seen, test_unseen), or all."""
        assert split is None or split in SPLITS
        return [r for r in self._all_records if split is None or r.split == split]

    def features(self, record: ClipRecord) -> Tensor:
        """Raw features [T,23,6] float32 of a record, mirrored where it says so."""
        values = self._shards[record.shard][record.offset : record.offset + record.num_frames]
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


def open_data(data: str, cache: Path, *, synthetic_clips: int = SYNTHETIC_CLIPS) -> PreparedData:
    """Open a prepared folder; "synthetic" is prepared on the spot into `cache`, once."""
    if data != SYNTHETIC:
        return PreparedData.open(data)
    from src.shared.data.prepare import prepare
    from src.shared.data.sources import SyntheticSource

    folder = cache / f"synthetic-{synthetic_clips}"
    prepare([SyntheticSource(synthetic_clips)], folder)
    return PreparedData.open(folder)
