"""Folders of motions → shards, manifest, captions, splits and statistics.

The folder that `prepare` writes:

    manifest.json           version, options, shards with SHA-256, tags, counts
    clips.jsonl             one ClipRecord a line, mirrored copies included
    captions.json           group -> language -> captions
    shards/NNNNN.safetensors  "features" [N,23,6] float32, clips one after the other
    statistics.safetensors  mean, std [23,6] over the training clips and their mirror images
    report.json             what was skipped and why, counts by source and split

Work is done a shard at a time by worker processes, here or on a cluster (`run_jobs`). A finished
shard is kept beside its record (shards/NNNNN.json) under a key made of all that went into it, so
that a second run, or a run after an interruption, does only what is missing.
"""

import hashlib
import json
from collections import Counter
from collections.abc import Callable, Sequence
from dataclasses import asdict, dataclass
from itertools import groupby
from operator import itemgetter
from pathlib import Path
from typing import Any

import torch
from safetensors.torch import load_file, save_file

from ..errors import UsageError, UserError
from ..io.files import (
    atomic_write,
    clear_unfinished,
    is_whole,
    sha256_file,
    sole_writer,
    write_json,
    write_text,
)
from ..io.jobs import finished_record, run_jobs
from ..io.storage import Place, fetched, place
from ..motion.features import encode_features, mirror_features
from .captions.book import CaptionBook
from .captions.language import mirror_labels
from .prepared import (
    MIRRORED,
    SPLITS,
    SYNTHETIC,
    SYNTHETIC_CLIPS,
    VERSION,
    ClipRecord,
    PreparedData,
    assign_splits,
    group_of,
    orbit,
)
from .sources import MotionFolder, Skipped, Source, SyntheticSource

CLIPS_PER_SHARD = 128
TABLES = ("clips.jsonl", "captions.json", "statistics.safetensors")  # beside the shards
CAPTIONS_PER_GROUP = 24  # and language
COVERING_CLIPS = 3  # captured ones that make procedural ones of the same labels superfluous
_DEGREES = frozenset(("speed", "style", "count", "angle"))
STD_FLOOR = 0.05  # a channel that hardly moves is not blown up

Progress = Callable[[int, int], None]  # (clips done, clips in all)


@dataclass(frozen=True)
class _Job:
    """One shard: the items of each source, which holds no more than they need."""

    parts: tuple[tuple[Source, tuple[str, ...]], ...]
    path: Place
    key: str

    @property
    def num_items(self) -> int:
        return sum(len(items) for _, items in self.parts)


def prepare(
    sources: str | Path | Sequence[Source | str | Path],
    out: str | Place,
    *,
    captions: str | Path | Sequence[str | Path] = (),
    templates: Path | None = None,
    only_gaps: bool = False,
    mirror: bool = True,
    seed: int = 0,
    workers: int | None = None,
    scheduler: str | None = None,
    progress: Progress = lambda done, total: None,
) -> dict[str, Any]:
    """Prepare all clips of `sources` into the folder or address `out`; returns the report, and
    `held_back_now`: clips that an earlier run into `out` gave to training and this one does not.

    Args:
        sources: `MotionFolder`s and the like; folders and files of motion are opened as such.
        captions: tables of what those folders and files show (`read_captions`), one or several.
        templates: caption templates of the user's own (see src/configs/captions).
        only_gaps: keep procedural clips only of what no captured clip shows (`fill_gaps`).
        mirror: add the mirror image of each clip, with left and right swapped in its captions.
        seed: of splits and captions.
        workers, scheduler: who does it, as `run_jobs` has them.
        progress: called after each shard.

    Raises:
        UserError: a source or table is faulty, or no clip at all could be read.
        UsageError: two sources have one name, or captions are of no folder or file.
    """
    book = CaptionBook.load(templates)
    sources = _opened([sources] if isinstance(sources, str | Path) else sources, captions)
    out = place(out)
    for name, number in Counter(source.name for source in sources).items():
        if number > 1:
            raise UsageError(
                f"two sources are called {name}, which would mix their clips; open folders"
                " together, by MotionFolder.open_all"
            )
    if mirror:
        _check_languages(sources, book)
    items = [(index, item) for index, source in enumerate(sources) for item in source.items()]
    jobs = _jobs(sources, items, out)
    _run(jobs, workers, scheduler, progress)

    clips, skipped = _collect(jobs)
    if only_gaps:
        clips = fill_gaps(clips, mirror=mirror)
    if not clips:
        reasons = Counter(entry["reason"] for entry in skipped)
        example = f"; most often: {reasons.most_common(1)[0][0]}" if reasons else ""
        write_json(out / "report.json", {"skipped": skipped})
        raise UserError(
            f"none of the {len(items)} clips could be used{example} (see {out}/report.json)"
        )
    records = _records(clips, mirror=mirror, seed=seed, book=book)
    moved = _no_longer_trained_on(out, records)
    lines = "".join(json.dumps(asdict(r), ensure_ascii=False) + "\n" for r in records)
    write_text(out / "clips.jsonl", lines)
    labels_of = {record.group: record.labels for record in records if record.labels}
    worded = {
        group: book.captions(labels, num=CAPTIONS_PER_GROUP, seed=seed)
        for group, labels in labels_of.items()
    }
    write_json(out / "captions.json", worded)
    _write_statistics(out, records)
    _remove_stale_shards(out, jobs)
    report = _report(records, skipped) | {"unmatched_captions": _unmatched(sources)}
    write_json(out / "report.json", report)
    write_json(out / "manifest.json", _manifest(out, sources, jobs, records, seed, mirror))
    return report | {"held_back_now": moved}


def _opened(
    sources: Sequence[Source | str | Path], captions: str | Path | Sequence[str | Path]
) -> tuple[Source, ...]:
    """The sources, folders and files opened together under the captions."""
    tables = [Path(each) for each in ([captions] if isinstance(captions, str | Path) else captions)]
    given: Any = sources
    if not isinstance(given, Sequence):
        raise UsageError(f"sources are a {type(given).__name__}; give a folder, or a list of them")
    roots = [place(source) for source in sources if isinstance(source, str | Path)]
    if tables and not roots:
        raise UsageError(
            f"captions {tables[0]} without a folder or file that they are of; name it among the"
            " sources, or give them to MotionFolder.open_all"
        )
    folders = iter(MotionFolder.open_all(roots, captions=tables) if roots else ())
    return tuple(next(folders) if isinstance(source, str | Path) else source for source in sources)


def _check_languages(sources: tuple[Source, ...], book: CaptionBook) -> None:
    """Mirrored captions need a table of the language's left and right."""
    for source in sources:
        if not isinstance(source, MotionFolder):
            continue
        pieces = [piece for pieces in source.table.values() for piece in pieces]
        for piece, language in ((each, code) for each in pieces for code in each.captions):
            if language not in book.languages:
                raise UserError(
                    f"{piece.told.get(language, 'captions')}: no mirror table for language"
                    f" {language!r}; correct it (known: {', '.join(book.languages)}), add a caption"
                    " file of it by `templates` (--templates), or prepare without mirror images:"
                    " `mirror=False` (--no-mirror)"
                )


def _unmatched(sources: tuple[Source, ...]) -> list[str]:
    """Clips of the captions files that no source holds."""
    rows = [source.caption_rows for source in sources if isinstance(source, MotionFolder)]
    named = {name for found in rows for name in found}
    return sorted(named - {name for found in rows for name, matched in found.items() if matched})


def open_data(
    data: str,
    cache: Place,
    *,
    synthetic_clips: int = SYNTHETIC_CLIPS,
    kind: type[PreparedData] = PreparedData,
) -> PreparedData:
    """Open a prepared folder; "synthetic" is prepared on the spot into `cache`, once."""
    if data != SYNTHETIC:
        return kind.open(data)
    folder = cache / f"synthetic-{synthetic_clips}"
    with sole_writer(folder, wait=True):
        prepare([SyntheticSource(synthetic_clips)], folder)
    return kind.open(folder)


# ---------------------------------------------------------------- shards


def _jobs(sources: tuple[Source, ...], items: list[tuple[int, str]], out: Place) -> list[_Job]:
    jobs = []
    for number, start in enumerate(range(0, len(items), CLIPS_PER_SHARD)):
        own = items[start : start + CLIPS_PER_SHARD]
        digest, parts = hashlib.sha256(f"{VERSION}".encode()), []
        for index, group in groupby(own, key=itemgetter(0)):
            source, names = sources[index], tuple(item for _, item in group)
            for item in names:
                digest.update(f"{source.name}:{source.fingerprint(item)}".encode())
            part = source.part(names) if isinstance(source, MotionFolder) else source
            # Everything else a source is made of (rules, captions, mapping) shapes the clip too.
            digest.update(repr(part).encode())
            parts.append((part, names))
        path = out.absolute() / "shards" / f"{number:05d}.safetensors"
        jobs.append(_Job(tuple(parts), path, digest.hexdigest()))
    return jobs


def _finished(job: _Job) -> bool:
    content = finished_record(job.path.with_suffix(".json"), job.key)
    return content is not None and is_whole(job.path, str(content.get("sha256")))


def _run(jobs: list[_Job], workers: int | None, scheduler: str | None, progress: Progress) -> None:
    todo = [job for job in jobs if not _finished(job)]
    total = sum(job.num_items for job in jobs)
    done = total - sum(job.num_items for job in todo)
    progress(done, total)
    for job, _ in run_jobs(_make_shard, todo, workers, scheduler):
        progress(done := done + job.num_items, total)


def _make_shard(job: _Job) -> None:
    """Read the clips of one shard; a clip that cannot be read is recorded, not fatal."""
    if _finished(job):  # by a worker that was lost before it could tell
        return
    features, clips, skipped, offset = [], [], [], 0
    for source, item in ((source, item) for source, items in job.parts for item in items):
        try:
            clip = source.read(item)
            values = encode_features(clip.motion)
            if not torch.isfinite(values).all():
                raise ValueError("the motion holds values that are not finite")
        except Skipped as decision:
            skipped.append({"clip": f"{source.name}/{item}", "reason": str(decision)})
            continue
        except (UserError, ValueError, OSError) as error:
            skipped.append({"clip": f"{source.name}/{item}", "reason": f"unreadable: {error}"})
            continue
        features.append(values)
        clips.append(
            {
                "id": f"{source.name}/{clip.id}",
                "source": source.name,
                "take": f"{source.name}/{clip.take}",
                "labels": clip.labels,
                "captions": clip.captions,
                "provenance": clip.provenance,
                "num_frames": len(values),
                "shard": job.path.name,
                "offset": offset,
            }
        )
        offset += len(values)
    stacked = torch.cat(features) if features else torch.zeros(0, 23, 6)
    with atomic_write(job.path) as temporary:
        save_file({"features": stacked}, temporary)
        digest = sha256_file(temporary)
    sidecar = {"key": job.key, "sha256": digest, "clips": clips, "skipped": skipped}
    write_json(job.path.with_suffix(".json"), sidecar)


def _collect(jobs: list[_Job]) -> tuple[list[dict[str, Any]], list[dict[str, str]]]:
    clips: list[dict[str, Any]] = []
    skipped: list[dict[str, str]] = []
    for job in jobs:
        content = finished_record(job.path.with_suffix(".json"), job.key)
        if content is None:
            raise UserError(f"{job.path} was changed by another run; run this one again")
        clips += content["clips"]
        skipped += content["skipped"]
    return clips, skipped


def fill_gaps(clips: list[dict[str, Any]], *, mirror: bool) -> list[dict[str, Any]]:
    """The clips without the procedural ones of labels that captured clips, or with `mirror` their
    mirror images, show.

    Speed, style, count and angle are not compared: who asks for a fast walk is better served by
    a captured walk than by a procedural fast one. A captured clip with fewer labels covers
    nothing ("kick" does not cover "kick, left").
    """

    def shown(labels: dict[str, str]) -> frozenset[tuple[str, str]]:
        return frozenset(item for item in labels.items() if item[0] not in _DEGREES)

    captured: Counter[frozenset[tuple[str, str]]] = Counter()
    for clip in clips:
        if clip["provenance"] == "captured":
            labels = clip["labels"]
            captured.update({shown(labels), shown(mirror_labels(labels) if mirror else labels)})
    return [
        clip
        for clip in clips
        if clip["provenance"] != "procedural" or captured[shown(clip["labels"])] < COVERING_CLIPS
    ]


def _remove_stale_shards(out: Place, jobs: list[_Job]) -> None:
    """Shards of an earlier, larger run, and what a worker that died left of one."""
    clear_unfinished(out / "shards")
    wanted = {job.path.stem for job in jobs}
    for path in (out / "shards").iterdir():
        if path.stem not in wanted and not path.name.startswith("."):
            path.unlink()


# ---------------------------------------------------------------- records


def _first_caption(captions: dict[str, list[str]]) -> str:
    return next((texts[0] for texts in captions.values() if texts), "")


def _records(
    clips: list[dict[str, Any]], *, mirror: bool, seed: int, book: CaptionBook
) -> list[ClipRecord]:
    orbits = [
        (clip["take"], orbit(clip["labels"], _first_caption(clip["captions"])), clip["labels"])
        for clip in clips
    ]
    split = assign_splits(orbits, seed)
    records = []
    for clip in clips:
        for mirrored in (False, True) if mirror else (False,):
            labels, captions = clip["labels"], clip["captions"]
            if mirrored:
                labels = mirror_labels(labels)
                captions = {
                    language: [book.mirror_text(text, language) for text in texts]
                    for language, texts in captions.items()
                }
            found = {
                "id": clip["id"] + (MIRRORED if mirrored else ""),
                "tag": labels.get("action", ""),
                "group": group_of(labels, _first_caption(captions)),
                "labels": labels,
                "mirrored": mirrored,
                "split": split[clip["take"]],
                "captions": captions,
            }
            records.append(ClipRecord(**(clip | found)))
    return records


def _no_longer_trained_on(out: Place, records: list[ClipRecord]) -> list[str]:
    """Clips that an earlier run into this folder gave to training, and this one holds back."""
    file = out / "clips.jsonl"
    if not file.exists():
        return []
    try:
        with fetched(file) as path:
            before = map(json.loads, path.read_text(encoding="utf-8").splitlines())
            trained = {row["id"] for row in before if row["split"] == "train"}
    except (OSError, ValueError, LookupError, TypeError):
        return []  # damaged: it is written anew
    return sorted(r.id for r in records if r.id in trained and r.split != "train")


def _write_statistics(out: Place, records: list[ClipRecord]) -> None:
    """Mean and standard deviation per channel, over training clips and their mirror images."""
    shards: dict[str, torch.Tensor] = {}
    count, total, squares = 0, torch.zeros(23, 6), torch.zeros(23, 6)
    wanted = [r for r in records if r.split == "train"] or records
    for record in sorted(wanted, key=lambda r: (r.shard, r.offset)):
        if record.shard not in shards:
            with fetched(out / "shards" / record.shard) as path:
                shards = {record.shard: load_file(path)["features"]}
        values = shards[record.shard][record.offset : record.offset + record.num_frames]
        if record.mirrored:
            values = mirror_features(values)
        count += len(values)
        total += values.sum(0)
        squares += values.square().sum(0)
    mean = total / count
    std = (squares / count - mean.square()).clamp_min(0).sqrt().clamp_min(STD_FLOOR)
    with atomic_write(out / "statistics.safetensors") as temporary:
        save_file({"mean": mean, "std": std}, temporary)


def _report(records: list[ClipRecord], skipped: list[dict[str, str]]) -> dict[str, Any]:
    originals = [record for record in records if not record.mirrored]
    return {
        "clips": len(originals),
        "records": len(records),
        "seconds": round(sum(record.num_frames for record in originals) / 30.0, 1),
        "groups": len({record.group for record in records}),
        "by_provenance": dict(Counter(record.provenance for record in originals)),
        "actions": sorted({record.tag for record in originals}),
        "by_source": dict(Counter(record.source for record in originals)),
        "by_split": {split: sum(r.split == split for r in records) for split in SPLITS},
        "held_back_groups": sorted({r.group for r in records if r.split == "test_unseen"}),
        "skipped": skipped,
    }


def _manifest(
    out: Place,
    sources: tuple[Source, ...],
    jobs: list[_Job],
    records: list[ClipRecord],
    seed: int,
    mirror: bool,
) -> dict[str, Any]:
    shards = [f"shards/{job.path.name}" for job in jobs]
    return {
        "version": VERSION,
        "fps": 30.0,
        "seed": seed,
        "mirror": mirror,
        "sources": [source.name for source in sources],
        "tags": sorted({record.tag for record in records if record.tag}),
        "files": {name: sha256_file(out / name) for name in (*shards, *TABLES)},
    }
