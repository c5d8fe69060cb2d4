"""One song → its phrases on disk, each marked as finished under a key of all that went into it."""

import hashlib
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Any

import numpy as np

from ...errors import UserError
from ...files import load_json, sha256_file, write_json
from ...motion.style import measure_style
from ...motion.trajectory import STYLE, MotionTrajectory
from ..phrases.layout import PhraseRecord, write_phrase
from .clip_library import FPS, Clip
from .music import Music, MusicSource, SongEntry
from .pair import MIN_SCORE, SPARE, PhrasePair, pair_phrase
from .time_warp import KNOT_SECONDS


@dataclass(frozen=True)
class PairOptions:
    """What can be chosen.

    Attributes:
        min_seconds, max_seconds: length of a phrase.
        passes: how often each song is gone through, with other cuts and other motion.
        synthetic_clips: also take the project's own parametric motions.
        seed: of every choice.
    """

    min_seconds: float = 8.0
    max_seconds: float = 20.0
    passes: int = 1
    synthetic_clips: bool = False
    seed: int = 0


@dataclass(frozen=True, eq=False)
class SongJob:
    """What one song's phrases are made of; `key` changes when any of it does."""

    source: MusicSource
    entry: SongEntry
    clips: tuple[Clip, ...]
    out: Path
    options: PairOptions
    key: str


def pair_song(job: SongJob) -> list[dict[str, Any]]:
    """Make the phrases of one song that are missing; what cannot be made is recorded."""
    try:
        music = job.source.read(job.entry)
    except UserError as error:
        return _finish(job, [{"id": job.entry.id, "reason": f"unreadable: {error}"}])
    cuts = list(_cuts(music.num_frames, job))
    if not cuts:
        seconds = music.num_frames / FPS
        reason = f"{seconds:.1f} s; {job.options.min_seconds:g} are needed"
        return _finish(job, [{"id": job.entry.id, "reason": reason}])
    entries = []
    for number, (start, stop) in enumerate(cuts):
        name = f"{job.entry.id}-{number:03d}"
        entry = _read_finished(job, name)
        entries.append(entry if entry else _pair(job, name, music, start, stop))
    return _finish(job, entries)


def _rng(job: SongJob, name: str) -> np.random.Generator:
    digest = hashlib.sha256(f"{job.options.seed}:{name}".encode()).digest()
    return np.random.default_rng(list(digest[:16]))


def _cuts(num_frames: int, job: SongJob) -> list[tuple[int, int]]:
    """Frames (start, stop) of the phrases; every pass cuts elsewhere."""
    low, high = (round(s * FPS) for s in (job.options.min_seconds, job.options.max_seconds))
    found = []
    for number in range(job.options.passes):
        rng = _rng(job, f"{job.entry.id}:{number}")
        start = 0 if number == 0 else int(rng.integers(0, low))
        while num_frames - start >= low:
            stop = min(num_frames, start + int(rng.integers(low, high + 1)))
            if num_frames - stop < low and num_frames - start <= high:
                stop = num_frames
            found.append((start, stop))
            start = stop
    return found


def _pair(job: SongJob, name: str, music: Music, start: int, stop: int) -> dict[str, Any]:
    begin, seconds = start / FPS, (stop - start) / FPS
    beats = music.beats_around(begin, begin + seconds)
    pair = pair_phrase(job.clips, beats, stop - start, _rng(job, name))
    if pair is None:
        return _mark(job, {"id": name, "reason": "no beat, or no clip fits the tempo"})
    if pair.score < MIN_SCORE:
        return _mark(job, {"id": name, "reason": f"beats meet too rarely: {pair.score:.2f}"})
    phase = music.phase[start:stop] - np.floor(music.phase[start])
    ahead = phase[-1] + (phase[-1] - phase[-2]) * np.arange(1, SPARE + 1)
    trajectory = MotionTrajectory.from_pose(
        pair.position, pair.quaternion, np.concatenate((phase, ahead)), spare=SPARE
    )
    trajectory.data[:, STYLE] = measure_style(trajectory)
    tempo = 60.0 / float(np.median(np.diff(beats.times)))
    features = {key: values[..., start:stop] for key, values in music.features.items()} | {
        "tempo": np.float32(tempo),
        "beat_times": _inside(music.beat_times, begin, seconds),
        "downbeat_times": _inside(music.downbeat_times, begin, seconds),
        "phase": phase,
        "meter": np.int64(music.meter),
    }
    record = write_phrase(
        job.out,
        name,
        trajectory.data,
        features,
        split=job.entry.split,
        song=job.entry.id,
        tempo=tempo,
    )
    return _mark(job, _entry(name, record, pair, start))


def _inside(times: np.ndarray, begin: float, seconds: float) -> np.ndarray:
    return np.asarray(times[(times >= begin) & (times < begin + seconds)] - begin)


def _entry(name: str, record: PhraseRecord, pair: PhrasePair, start: int) -> dict[str, Any]:
    return {
        "id": name,
        "record": record.model_dump(),
        "pair": {
            "song_frame": start,
            "frames": len(pair.position) - SPARE,
            "pieces": [piece.to_json() for piece in pair.motion.pieces],
            "warp": {
                "start": pair.warp.start,
                "knot_seconds": KNOT_SECONDS,
                "rates": list(pair.warp.rates),
            },
            "seams": [int(frame) for frame in pair.seams],
            "matched": pair.matched,
            "coverage": round(pair.coverage, 4),
            "motion_beats": len(pair.motion_beats),
            "alignment": {
                "before": asdict(pair.before),
                "after": asdict(pair.after),
                "chance": asdict(pair.chance),
            },
        },
    }


# ---------------------------------------------------------------- what is done already


def _phrase_path(out: Path, name: str) -> Path:
    return out / "phrases" / f"{name}.json"


def _mark(job: SongJob, entry: dict[str, Any]) -> dict[str, Any]:
    entry = entry | {"key": job.key}
    write_json(_phrase_path(job.out, entry["id"]), entry)
    return entry


def _read(path: Path, key: str) -> dict[str, Any] | None:
    try:
        content = load_json(path)
    except (OSError, ValueError):
        return None
    return content if isinstance(content, dict) and content.get("key") == key else None


def _read_finished(job: SongJob, name: str) -> dict[str, Any] | None:
    """A phrase's entry, if it was made of the same and its files are whole."""
    entry = _read(_phrase_path(job.out, name), job.key)
    if entry is None:
        return None
    for part in ("motion", "features"):
        stored = entry.get("record", {}).get(part)
        if stored and not _is_whole(job.out / stored["path"], stored["sha256"]):
            return None
    return entry


def _is_whole(path: Path, digest: str) -> bool:
    return path.exists() and sha256_file(path) == digest


def _finish(job: SongJob, entries: list[dict[str, Any]]) -> list[dict[str, Any]]:
    """Mark the song as done: the names of its phrases, so that it need not be heard again."""
    names = [entry["id"] for entry in entries]
    for entry in entries:
        if entry["id"] == job.entry.id:  # the song itself was left out
            _mark(job, entry)
    write_json(job.out / "songs" / f"{job.entry.id}.json", {"key": job.key, "phrases": names})
    return entries


def finished_song(job: SongJob) -> list[dict[str, Any]] | None:
    """The entries of a song that is done; None if anything is missing or of another key."""
    song = _read(job.out / "songs" / f"{job.entry.id}.json", job.key)
    if song is None:
        return None
    entries = [_read_finished(job, name) for name in song["phrases"]]
    return None if None in entries else [entry for entry in entries if entry]
