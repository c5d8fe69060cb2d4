"""Sources of clips: folders of motion files and the project's own synthetic motions.

A source lists its items cheaply; each item is read later, in a worker process. Labels come from
file names and from the words of captions, by YAML rules.
"""

import re
from collections import Counter
from collections.abc import Iterable, Iterator, Mapping, Sequence
from contextlib import contextmanager, suppress
from dataclasses import dataclass, field, replace
from functools import cache, cached_property
from pathlib import Path, PurePath, PurePosixPath
from typing import Any

import numpy as np
from pydantic import BaseModel

from ..config_schema import Provenance
from ..errors import UsageError, UserError
from ..formats.readers.acclaim import find_skeleton
from ..formats.readers.bvh import check_head
from ..io.storage import Address, Place, fetched, version_of
from ..motion.motion import Motion
from .captions.schema import Labels, Pattern
from .captions.tables import Piece, Table, match_captions, read_captions, without_ending
from .retarget.mapping import SkeletonMapping, load_mappings, load_table, words
from .retarget.read_motion import FOLDER_ENDINGS, fit, open_recording
from .retarget.to_canonical import on_floor
from .synthetic.clips import SyntheticSpec, generate_clip, sample_specs


class _Rule(BaseModel, frozen=True, extra="forbid"):
    pattern: Pattern
    labels: Labels = {}


class FileRule(_Rule):
    """One entry of `files` in labels.yaml."""

    groups: dict[str, dict[str, Labels]] = {}
    skip: str | None = None


class LabelRules(BaseModel, frozen=True, extra="forbid"):
    """labels.yaml."""

    files: tuple[FileRule, ...] = ()
    captions: tuple[_Rule, ...] = ()

    def of_file(self, stem: str) -> tuple[Labels, str | None]:
        """Labels of a file name without its ending, and why to skip it, if so."""
        for rule in self.files:
            if match := re.search(rule.pattern, stem):
                labels = dict(rule.labels)
                for group, value in match.groupdict().items():
                    labels |= rule.groups.get(group, {}).get(value, {group: value})
                return labels, rule.skip
        return {}, None

    def of_caption(self, caption: str) -> Labels:
        """Labels that an English caption implies; empty when no rule fits."""
        for rule in self.captions:
            if re.search(rule.pattern, caption, re.IGNORECASE):
                return dict(rule.labels)
        return {}


def load_label_rules(extra: Path | None = None) -> LabelRules:
    """The user's rules first, then ours."""
    ours = load_table("labels.yaml", LabelRules)
    if extra is None:
        return ours
    theirs = load_table(extra, LabelRules)
    return LabelRules(files=theirs.files + ours.files, captions=theirs.captions + ours.captions)


FPS = 30.0
END_SLACK = 0.2  # seconds that a piece may reach beyond the end of its file
MIN_FRAMES = 8  # shorter clips teach nothing and cannot be windowed


@dataclass(frozen=True, eq=False)
class RawClip:
    """One clip of a source, already on the canonical skeleton at 30 fps.

    Attributes:
        id: unique name within its source.
        take: recording it belongs to; clips of one take never part between splits.
        captions: captions of this very clip by language, beside those its labels give.
        provenance: where the motion comes from; a condition of the denoiser.
    """

    id: str
    take: str
    motion: Motion
    labels: dict[str, str]
    captions: dict[str, list[str]]
    provenance: Provenance = "captured"


class Skipped(Exception):
    """A clip is left out on purpose; the text says why."""


@dataclass(frozen=True)
class Reading:
    """What a user states of files that do not say it; the fields are those of `read_motion`."""

    unit: str | None = None
    up: str | None = None
    skeleton: Path | None = None
    source_fps: float | None = None

    def read(self, path: Path, mappings: tuple[SkeletonMapping, ...]) -> Motion:
        """The motion of a file at the data's rate; raises UserError."""
        recording = open_recording(path, skeleton=self.skeleton, fps=self.source_fps)
        return fit(path, recording, mappings, unit=self.unit, up=self.up, fps=FPS)


@dataclass(frozen=True)
class MotionFolder:
    """Every motion file below a folder (or one file), with captions and label rules.

    Of one name in several formats, the first of `FOLDER_ENDINGS` is taken. A file is one
    clip, or as many as the table cuts it into; these stay one take.

    Attributes:
        name: begins the ids of its clips; no other source has it.
        table: the pieces of each file that has some.
        from_names: files without words of their own have those of their names as English captions.
        shared_stems: file names that several folders hold; their takes are told apart by folder.
        listed: the files, where they are known.
        reading: what the files do not say of themselves.
        caption_rows: clips that the file names, and whether a file was found for each.
    """

    root: Place = field(repr=False)
    name: str
    table: Table
    rules: LabelRules
    mappings: tuple[SkeletonMapping, ...]
    reading: Reading = Reading()
    shared_stems: tuple[str, ...] = ()
    from_names: bool = False
    listed: tuple[str, ...] | None = None
    caption_rows: Mapping[str, bool] = field(default_factory=dict, repr=False)

    @classmethod
    def open(cls, root: Place, **tables: Any) -> "MotionFolder":
        """One folder or file; see `open_all`."""
        return cls.open_all([root], **tables)[0]

    @classmethod
    def open_all(
        cls,
        roots: Sequence[Place],
        *,
        captions: Sequence[Path] = (),
        labels: Path | None = None,
        mapping: Path | None = None,
        reading: Reading | None = None,
    ) -> list["MotionFolder"]:
        """Check that the folders hold motion files and read the tables, which they share.

        Raises:
            UserError: no such folder, no motion in it, one within another, a faulty captions,
                labels or mapping file, a caption whose clip may be any of several files.
        """
        for root in roots:
            if not root.exists():
                raise UsageError(f"source {root} does not exist; give a folder of motion files")
        rules, mappings = load_label_rules(labels), load_mappings(mapping)
        plain = [
            cls(root, name, {}, rules, mappings, reading or Reading())
            for root, name in zip(roots, distinct_names(roots), strict=True)
        ]
        for folder in plain:
            if not folder.files():
                raise UserError(f"source {folder.root} holds no motion file; give a folder of"
                                f" {', '.join(FOLDER_ENDINGS)} files")  # fmt: skip
        rows = read_captions(*captions)
        listed = [(folder._captioned_as, folder.files()) for folder in plain]
        matched, found = match_captions(rows, listed)
        return [
            replace(
                folder,
                table=own,
                from_names=not own,
                shared_stems=_repeated(Path(item).stem for item in items),
                caption_rows=found,
            )
            for folder, own, (_, items) in zip(plain, matched, listed, strict=True)
        ]

    @property
    def _captioned_as(self) -> str:
        """The folder that a row of the captions may name: a file's is the one it lies in."""
        if self.root.is_dir():
            return self.name
        above = max(1, self.name.count("/"))
        return "/".join(self.root.resolve().parts[-1 - above : -1])

    def items(self) -> list[str]:
        """Names of all clips, in a stable order."""
        return list(self._pieces)

    @cached_property
    def _pieces(self) -> dict[str, tuple[str, Piece]]:
        """File and piece behind each item."""
        found = {}
        for file in self.files():
            for piece in self.table.get(file, (Piece(),)):
                end = "" if piece.end is None else f"{piece.end:g}"
                item = file if piece.whole else f"{file}@{piece.start:g}-{end}"
                found[item] = (file, piece)
        return found

    def part(self, items: Sequence[str]) -> "MotionFolder":
        """These clips alone, as light as can be and wherever one stands: for a job elsewhere."""
        files = tuple(dict.fromkeys(self._pieces[item][0] for item in items))
        stems = {Path(file).stem for file in files}
        skeleton = self.reading.skeleton
        return replace(
            self,
            root=self.root.absolute(),
            table={file: self.table[file] for file in files if file in self.table},
            reading=replace(self.reading, skeleton=skeleton and skeleton.absolute()),
            shared_stems=tuple(stem for stem in self.shared_stems if stem in stems),
            listed=files,
            caption_rows={},
        )

    def files(self) -> list[str]:
        """The motion files, below the root."""
        if self.listed is not None:
            return list(self.listed)
        if self._is_file:
            return [self.root.name]
        best: dict[PurePath, PurePath] = {}
        for path in sorted(map(PurePosixPath, self._below()), key=_rank):
            if path.suffix.lower() in FOLDER_ENDINGS:
                best.setdefault(path.with_suffix(""), path)
        return sorted(path.as_posix() for path in best.values())

    def _below(self) -> Iterable[str]:
        """Every file below the root, by relative path."""
        if isinstance(self.root, Address):
            return self._stored
        found = (path for path in self.root.rglob("*") if path.suffix.lower() in FOLDER_ENDINGS)
        return [path.relative_to(self.root).as_posix() for path in found if path.is_file()]

    @cached_property
    def _stored(self) -> dict[str, dict[str, Any]]:
        """What the store tells of each file, of an address."""
        assert isinstance(self.root, Address)
        return self.root.find()

    @cached_property
    def _skeletons(self) -> list[str]:
        return sorted(name for name in self._stored if name.lower().endswith(".asf"))

    @cached_property
    def _is_file(self) -> bool:
        return self.root.is_file()

    def _path(self, item: str) -> Place:
        return self.root if self._is_file else self.root / item

    def fingerprint(self, item: str) -> str:
        """Changes when the clip behind the item changes."""
        file = self._pieces[item][0]
        if isinstance(self.root, Address):
            names = [file if file in self._stored else ""]  # "": the root is the file
            if file.lower().endswith(".amc"):
                above = PurePosixPath(file).parent
                names += [name for name in self._skeletons if PurePosixPath(name).parent == above]
            told = [self._stored[name] for name in names]
            marks = (f"{info['size']}:{version_of(info)}" for info in told)
            return ":".join([item, *marks])
        path = self.root if self._is_file else self.root / file
        parts = [path]
        if path.suffix.lower() == ".amc":
            with suppress(UserError):  # none: reading tells
                parts.append(self.reading.skeleton or find_skeleton(path))
        found = [part.stat() for part in parts if part.exists()]
        return ":".join([item, *(f"{status.st_size}:{status.st_mtime_ns}" for status in found)])

    def wordless(self) -> list[str]:
        """Files that neither a table nor a label rule says anything of."""
        return [
            file
            for file in self.files()
            if file not in self.table and not any(self.rules.of_file(Path(file).stem))
        ]

    def read(self, item: str) -> RawClip:
        """Read one clip; raises UserError or ValueError (a fault) or Skipped (a decision)."""
        file, piece = self._pieces[item]
        path = self._path(file)
        labels, skip = self.rules.of_file(path.stem)
        if skip:
            raise Skipped(skip)
        captions = {language: list(texts) for language, texts in piece.captions.items()}
        if self.from_names and not labels and (named := words(path.stem)):
            captions = {"en": [" ".join(named)]}
        labels |= piece.labels
        for caption in captions.get("en", []):
            labels = self.rules.of_caption(caption) | labels
        if not labels and not captions:
            if path.suffix.lower() == ".bvh":
                with _on_this_machine(path) as local:
                    check_head(local)  # a broken file is told as such
            raise Skipped("no caption and no label; add it to the captions or write a label rule")
        motion = cut(_last_read(self.reading, path, self.mappings), piece)
        if motion.num_frames < MIN_FRAMES:
            raise Skipped(f"{motion.num_frames} frames at {FPS:g} fps; {MIN_FRAMES} are needed")
        take = without_ending(file) if path.stem in self.shared_stems else path.stem
        return RawClip(item, take, motion, labels, captions, piece.provenance)


_LAST: list[tuple[tuple[Reading, Place], Motion]] = []  # the file that was read last


def _last_read(reading: Reading, path: Place, mappings: tuple[SkeletonMapping, ...]) -> Motion:
    """`Reading.read`, once for all pieces of a file."""
    last = _LAST[0] if _LAST else None  # one look: other threads put theirs there, too
    if last is None or last[0] != (reading, path):
        with _on_this_machine(path) as local:
            _LAST[:] = [last := ((reading, path), reading.read(local, mappings))]
    return last[1]


@contextmanager
def _on_this_machine(path: Place) -> Iterator[Path]:
    """`fetched`; what is said of the copy is said of the file."""
    with fetched(path) as local:
        try:
            yield local
        except (UserError, ValueError) as error:
            if local is path:
                raise
            raise UserError(str(error).replace(str(local), str(path))) from error


def cut(motion: Motion, piece: Piece) -> Motion:
    """A piece of a motion, put on the floor by itself; its repetitions go on where it ended.

    Raises:
        UserError: the motion ends before the piece does.
    """
    if piece == replace(piece, start=0.0, end=None, repeat=1, hold=0.0):
        return motion
    end = motion.seconds if piece.end is None else piece.end
    if end > motion.seconds + END_SLACK or piece.start >= motion.seconds:
        raise UserError(f"the piece {piece.start:g} to {end:g} s is not within the file's"
                        f" {motion.seconds:.2f} s")  # fmt: skip
    frames = slice(round(piece.start * motion.fps), round(end * motion.fps))
    order = np.arange(motion.num_frames)[frames]
    root = motion.root_position[order]
    stride = (2 * root[-1] - root[-2] - root[0]) * (1, 0, 1) if len(root) > 1 else 0 * root[0]
    root = np.concatenate([root + time * stride for time in range(piece.repeat)])
    last = round(piece.hold * motion.fps)
    order = np.concatenate([np.tile(order, piece.repeat), np.full(last, order[-1])])
    root = np.concatenate([root, np.repeat(root[-1:], last, 0)]).astype(np.float32)
    quaternions, contacts = motion.quaternions[order], motion.contacts[order]
    return on_floor(Motion(quaternions, root, contacts, motion.fps))


def distinct_names(roots: Sequence[Place]) -> list[str]:
    """The name of each folder or file, with the folders above it that tell it from the others.

    Raises:
        UsageError: one is within another, so that its clips would be taken twice.
    """
    paths = [PurePath(*root.resolve().parts) for root in roots]
    paths = [
        path.with_suffix("") if root.is_file() else path
        for path, root in zip(paths, roots, strict=True)
    ]
    for number, path in enumerate(paths):
        for other in (*paths[:number], *paths[number + 1 :]):
            if path.is_relative_to(other):
                raise UsageError(f"source {roots[number]} is named twice, or lies within another"
                                 " one; name every clip once")  # fmt: skip
    depth = [1] * len(paths)
    while True:
        names = ["/".join(path.parts[-of:]) for path, of in zip(paths, depth, strict=True)]
        alike = {*_repeated(names), SyntheticSource.name}
        if alike.isdisjoint(names):
            return names
        depth = [of + (name in alike) for of, name in zip(depth, names, strict=True)]


def _repeated(names: Iterable[str]) -> tuple[str, ...]:
    return tuple(sorted(name for name, count in Counter(names).items() if count > 1))


def _rank(path: PurePath) -> tuple[int, PurePath]:
    ending = path.suffix.lower()
    return (FOLDER_ENDINGS.index(ending) if ending in FOLDER_ENDINGS else len(FOLDER_ENDINGS), path)


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
        index = int(item.rpartition("-")[2])
        spec = _specs(self.num_clips, self.seed)[index]
        motion = generate_clip(spec, seed=self.seed * 1_000_003 + index)
        return RawClip(item, item, motion, dict(spec.labels), {}, "procedural")


@cache
def _specs(num_clips: int, seed: int) -> list[SyntheticSpec]:
    """Specifications of a synthetic set, made once a process."""
    return sample_specs(num_clips, seed)


Source = MotionFolder | SyntheticSource  # what `prepare` reads from
