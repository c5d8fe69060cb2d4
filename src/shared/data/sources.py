"""Sources of clips: folders of BVH files and the project's own synthetic motions.

A source lists its items cheaply; each item is read later, in a worker process.
"""

from collections import Counter
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Any, Protocol

from src.shared.data.caption_files import Captions, match_captions, read_captions, without_ending
from src.shared.data.labels import LabelRules, load_label_rules
from src.shared.data.mapping import SkeletonMapping, find_mapping, load_mappings
from src.shared.data.records import RawClip
from src.shared.data.retarget import retarget
from src.shared.errors import UserError
from src.shared.formats.bvh import check_head, read_bvh

FPS = 30.0
MIN_FRAMES = 8  # shorter clips teach nothing and cannot be windowed


class Skipped(Exception):
    """A clip is left out on purpose; the text says why."""


class Source(Protocol):
    """What `prepare` reads from."""

    @property
    def name(self) -> str:
        """Prefix of the clips' ids."""
        ...

    def items(self) -> list[str]:
        """Names of all clips, in a stable order."""
        ...

    def fingerprint(self, item: str) -> str:
        """Changes when the clip behind the item changes."""
        ...

    def read(self, item: str) -> RawClip:
        """Read one clip; raises UserError or ValueError (a fault) or Skipped (a decision)."""
        ...


@dataclass(frozen=True)
class BvhFolder:
    """Every .bvh below a folder (or one file), with captions and label rules.

    Attributes:
        captions: of each item that has some.
        shared_stems: file names that several folders hold; their takes are told apart by folder.
        captions_file: where the captions come from.
        caption_rows: clips that the file names, and whether a file was found for each.
    """

    root: Path
    captions: Captions
    rules: LabelRules
    mappings: tuple[SkeletonMapping, ...]
    shared_stems: tuple[str, ...] = ()
    captions_file: Path | None = field(default=None, repr=False)
    caption_rows: Mapping[str, bool] = field(default_factory=dict, repr=False)

    @property
    def name(self) -> str:
        return self.root.stem if self.root.is_file() else self.root.resolve().name

    @classmethod
    def open(
        cls,
        root: Path,
        *,
        captions: Path | None = None,
        labels: Path | None = None,
        mapping: Path | None = None,
    ) -> "BvhFolder":
        """Check that the folder holds BVH files and read the tables.

        Raises:
            UserError: no such folder, no BVH in it, a faulty captions, labels or mapping file, a
                caption whose clip may be any of several files.
        """
        if not root.exists():
            raise UserError(f"source {root} does not exist; give a folder of BVH files")
        plain = cls(root, {}, load_label_rules(labels), load_mappings(mapping))
        items = plain.items()
        if not items:
            raise UserError(f"source {root} holds no .bvh file; give a folder of BVH files")
        rows = read_captions(captions) if captions else {}
        stems = Counter(Path(item).stem for item in items)
        name = root.resolve().parent.name if root.is_file() else plain.name
        matched, found = match_captions(rows, items, name, captions)
        return replace(
            plain,
            captions=matched,
            shared_stems=tuple(sorted(stem for stem, count in stems.items() if count > 1)),
            captions_file=captions,
            caption_rows=found,
        )

    def items(self) -> list[str]:
        if self.root.is_file():
            return [self.root.name]
        found = (p for p in self.root.rglob("*") if p.suffix.lower() == ".bvh" and p.is_file())
        return sorted(path.relative_to(self.root).as_posix() for path in found)

    def _path(self, item: str) -> Path:
        return self.root if self.root.is_file() else self.root / item

    def fingerprint(self, item: str) -> str:
        status = self._path(item).stat()
        return f"{item}:{status.st_size}:{status.st_mtime_ns}"

    def read(self, item: str) -> RawClip:
        path = self._path(item)
        labels, skip = self.rules.of_file(path.stem)
        if skip:
            raise Skipped(skip)
        captions = self.captions.get(item, {})
        for caption in captions.get("en", []):
            labels = self.rules.of_caption(caption) | labels
        if not labels and not captions:
            check_head(path)  # a broken file is told as such
            raise Skipped("no caption and no label; add it to --captions or write a --labels rule")
        clip = read_bvh(path)
        rate = 1.0 / clip.frame_time
        stride = round(rate / FPS)
        if stride > 1 and abs(rate / stride - FPS) < 0.01 * FPS:
            clip = read_bvh(path, stride=stride)
        motion = retarget(clip, find_mapping(clip.names, self.mappings), fps=FPS)
        if motion.num_frames < MIN_FRAMES:
            raise Skipped(f"{motion.num_frames} frames at {FPS:g} fps; {MIN_FRAMES} are needed")
        take = without_ending(item) if path.stem in self.shared_stems else path.stem
        return RawClip(item, take, motion, labels, captions)


@dataclass(frozen=True)
class SyntheticSource:
    """The project's own parametric motions: nothing to download, exact labels."""

    num_clips: int
    seed: int = 0
    name: str = "synthetic"

    def items(self) -> list[str]:
        return [f"synthetic-{index:05d}" for index in range(self.num_clips)]

    def fingerprint(self, item: str) -> str:
        return f"{item}:{self.num_clips}:{self.seed}"

    def read(self, item: str) -> RawClip:
        from src.shared.data.synthetic import generate_clip

        index = int(item.rpartition("-")[2])
        spec = _specs(self.num_clips, self.seed)[index]
        motion = generate_clip(spec, seed=self.seed * 1_000_003 + index)
        return RawClip(item, item, motion, dict(spec.labels), {})


_SPECS: dict[tuple[int, int], list[Any]] = {}


def _specs(num_clips: int, seed: int) -> list[Any]:
    """Specifications of a synthetic set, made once a process."""
    from src.shared.data.synthetic import sample_specs

    if (num_clips, seed) not in _SPECS:
        _SPECS[num_clips, seed] = sample_specs(num_clips, seed)
    return _SPECS[num_clips, seed]


def all_items(sources: list[Source]) -> Iterator[tuple[int, str]]:
    """(index of the source, item) of every clip."""
    for index, source in enumerate(sources):
        for item in source.items():
            yield index, item
