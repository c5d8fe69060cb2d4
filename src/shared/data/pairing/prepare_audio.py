"""Motion and music from different places → paired phrases in TECH's layout.

The folder that `prepare-audio` writes:

    audio_features/{id}/features.npz  mel, chroma, mfcc, rms, spectral_centroid, onset_strength
                                      (float16), tempo, beat_times, downbeat_times (seconds of the
                                      phrase), phase [T] (unwrapped bars, float64), meter
    motion/{id}/trajectory.npy        [T,25] float32, its phase column is the music's
    motion/{id}/body.npz              features [T,23,6] float16 of the body behind the trajectory
    manifest.json                     phrases with size and SHA-256, split, song, tempo, tag and
                                      caption of the longest clip, the clips and warp they are
                                      made of, beat alignment
    statistics.json                   mean and std [25] of encoded windows of the training split
    bands.json                        what real motions measure, for the sanity suite
    report.json                       alignment before and after, warps, seams, what was left out

A test phrase has a song and clips that occur in no other split. Work is done a song at a time;
`phrases/{id}.json` marks a finished phrase under a key made of all that went into it, so that a
second run, or a run after an interruption, does only what is missing.
"""

import hashlib
import json
import shutil
from collections.abc import Callable, Sequence
from dataclasses import asdict, replace
from pathlib import Path
from typing import Any

from ...errors import UserError
from ...files import write_json
from ..phrases.layout import features_path, trajectory_path
from ..prepared import PreparedData
from ..worker_pool import run_jobs
from .clip_library import FPS, ClipLibrary, open_library
from .music import MusicSource
from .phrase_body import add_bodies
from .report import make_report, write_statistics
from .song_pairs import PairOptions, SongJob, finished_song, pair_song

VERSION = 2  # of the method: another number makes everything anew

Progress = Callable[[int, int], None]  # (songs done, songs in all)


def prepare_audio(
    data: PreparedData,
    sources: Sequence[MusicSource],
    out: Path,
    *,
    options: PairOptions,
    workers: int = 1,
    progress: Progress = lambda done, total: None,
) -> dict[str, Any]:
    """Pair the motions of a prepared folder with music; returns the report.

    Args:
        data: what `prepare` wrote.
        sources: of music.
        out: folder of the pairs.
        options: see `PairOptions`.
        workers: processes.
        progress: called after each song.

    Raises:
        UserError: no clip moves enough, or no phrase at all could be made.
    """
    library = open_library(data, synthetic=options.synthetic_clips, seed=options.seed)
    if not library.clips:
        raise UserError(
            f"{data.folder}: no clip can be used ({_counts(library.left_out)}); give motions that"
            " travel or step, or add the synthetic ones"
        )
    jobs = _jobs(data, library, sources, out, options)
    made = _run(jobs, workers, progress)
    phrases = sorted((e for e in made if "record" in e), key=lambda e: e["id"])
    left_out = sorted((e for e in made if "record" not in e), key=lambda e: e["id"])
    if not phrases:
        example = f", e.g. {left_out[0]['id']}: {left_out[0]['reason']}" if left_out else ""
        raise UserError(
            f"no phrase could be made of {len(jobs)} songs{example}"
            "; give longer songs or more clips"
        )
    add_bodies(out, phrases, data)
    _remove_stale(out, {entry["id"] for entry in made})
    write_json(out / "manifest.json", _manifest(phrases, data, options))
    write_statistics(out, phrases)
    report = make_report(out, phrases, left_out, library)
    write_json(out / "report.json", report)
    return report


def _counts(left_out: dict[str, int]) -> str:
    return ", ".join(f"{number}: {reason}" for reason, number in left_out.items())


def _jobs(
    data: PreparedData,
    library: ClipLibrary,
    sources: Sequence[MusicSource],
    out: Path,
    options: PairOptions,
) -> list[SongJob]:
    jobs: dict[str, SongJob] = {}  # a song that two sources hold is taken once
    for source in sources:
        for entry in source.entries():
            clips = tuple(library.of_split(entry.split))
            if not clips:  # too few were there to hold any back for this split
                entry, clips = replace(entry, split="train"), tuple(library.of_split("train"))
            made_of = (entry.id, entry.split, entry.fingerprint, asdict(options))
            text = json.dumps([VERSION, data.manifest_hash, *made_of])
            key = hashlib.sha256(text.encode()).hexdigest()
            jobs.setdefault(entry.id, SongJob(source, entry, clips, out, options, key))
    return list(jobs.values())


def _run(jobs: list[SongJob], workers: int, progress: Progress) -> list[dict[str, Any]]:
    finished = [finished_song(job) for job in jobs]
    made = [entry for found in finished if found is not None for entry in found]
    todo = [job for job, found in zip(jobs, finished, strict=True) if found is None]
    done = len(jobs) - len(todo)
    progress(done, len(jobs))
    for _, entries in run_jobs(pair_song, todo, workers):
        made += entries
        progress(done := done + 1, len(jobs))
    return made


def _remove_stale(out: Path, wanted: set[str]) -> None:
    """Phrases of an earlier, larger run."""
    for path in (out / "phrases").glob("*.json"):
        if path.stem not in wanted:
            path.unlink()
            for folder in (features_path(path.stem), trajectory_path(path.stem)):
                shutil.rmtree((out / folder).parent, ignore_errors=True)
    songs = {name.rpartition("-")[0] for name in wanted} | wanted
    for path in (out / "songs").glob("*.json"):
        if path.stem not in songs:
            path.unlink()


def _manifest(
    phrases: list[dict[str, Any]], data: PreparedData, options: PairOptions
) -> dict[str, Any]:
    return {
        "version": 1,  # of the layout
        "method": VERSION,
        "fps": FPS,
        "motion_manifest": data.manifest_hash,
        "options": asdict(options),
        "phrases": [entry["record"] | {"pair": entry["pair"]} for entry in phrases],
    }
