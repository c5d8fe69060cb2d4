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

A test phrase has a song and clips that occur in no other split. Work is done a song at a time, by
processes here or on a cluster (`run_jobs`);
`phrases/{id}.json` marks a finished phrase under a key made of all that went into it, so that a
second run, or a run after an interruption, does only what is missing.
"""

import hashlib
import json
import threading
from collections import Counter
from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import asdict, dataclass, replace
from typing import Any

import numpy as np

from ...errors import UserError
from ...io.arrays import load_array, load_arrays
from ...io.files import clear_unfinished, is_whole, load_json, remove_folder, write_json
from ...io.jobs import finished_record, run_jobs
from ...io.storage import Place, files_below
from ...metrics.rhythm import motion_beats
from ...motion.style import measure_style
from ...motion.trajectory import STYLE, MotionTrajectory, encode_window
from ..captions.tables import Piece
from ..phrases.layout import PhraseRecord, features_path, trajectory_path, write_phrase
from ..prepare import prepare
from ..prepared import PreparedData
from ..sources import MotionFolder
from .clip_library import FPS, MARGIN, ClipLibrary, open_library
from .music import Music, MusicSource, SongEntry
from .pair import MIN_SCORE, PhrasePair, pair_phrase
from .phrase_motion import KNOT_SECONDS, SPARE, add_body, describe

WINDOW_FRAMES = 120  # TECH §6.1's target length
STD_FLOOR = 1e-4  # a row that does not vary is not blown up
WHEN = ("before", "after", "chance")  # alignment: as recorded, warped, and by chance
RATE_EDGES = np.round(np.arange(0.85, 1.151, 0.05), 2)

Entry = dict[str, Any]


def load_trajectory(out: Place, entry: Entry) -> np.ndarray:
    """Trajectory [T,25] of a phrase."""
    return load_array(out / entry["record"]["motion"]["path"])


def encoded_windows(out: Place, entries: Sequence[Entry]) -> Iterator[np.ndarray]:
    """Windows [25,T] of phrases, half overlapping; a shorter phrase is one window."""
    for entry in entries:
        trajectory = load_trajectory(out, entry)
        phase = load_arrays(out / entry["record"]["features"]["path"], ["phase"])["phase"]
        for start in range(0, max(1, len(phase) - WINDOW_FRAMES + 1), WINDOW_FRAMES // 2):
            part = slice(start, start + WINDOW_FRAMES)
            yield encode_window(trajectory[part], phase[part])


def training_trajectories(out: Place) -> Iterator[MotionTrajectory]:
    """Every trajectory of the training split, or of all where there is none."""
    phrases = load_json(out / "manifest.json")["phrases"]
    train = [phrase for phrase in phrases if phrase["split"] == "train"] or phrases
    for phrase in train:
        yield MotionTrajectory(load_array(out / phrase["motion"]["path"]))


def write_statistics(out: Place, entries: Sequence[Entry]) -> None:
    """Mean and std [25] of encoded windows over the training phrases, in statistics.json."""
    train = [entry for entry in entries if entry["record"]["split"] == "train"] or entries
    rows = np.concatenate(list(encoded_windows(out, train)), 1).astype(np.float64)  # 25 N
    std = np.maximum(rows.std(1), STD_FLOOR)
    write_json(
        out / "statistics.json",
        {
            "mean": [float(np.float32(v)) for v in rows.mean(1)],
            "std": [float(np.float32(v)) for v in std],
            "window_frames": WINDOW_FRAMES,
            "phrases": len(train),
        },
    )


def make_report(
    out: Place, entries: Sequence[Entry], left_out: Sequence[Entry], library: ClipLibrary
) -> dict[str, Any]:
    """The content of report.json."""
    splits = Counter(entry["record"]["split"] for entry in entries)
    of_split: dict[str, Sequence[Entry]] = {
        split: [entry for entry in entries if entry["record"]["split"] == split] for split in splits
    }
    rates = np.concatenate([entry["pair"]["warp"]["rates"] for entry in entries])
    return {
        "phrases": len(entries),
        "hours": _hours(entries),
        "songs": len({entry["record"]["song"] for entry in entries}),
        "by_split": dict(splits),
        "hours_by_split": {split: _hours(some) for split, some in of_split.items()},
        "alignment": {
            split: _alignment(some) for split, some in ({"all": entries} | of_split).items()
        },
        "warp": {
            "rate_percentiles": _percentiles(rates),
            "edges": RATE_EDGES.tolist(),
            "share": (np.histogram(rates, RATE_EDGES)[0] / len(rates)).round(4).tolist(),
        },
        "seams": _seams(out, entries),
        "clips": {
            "usable": len(library.clips),
            "left_out": library.left_out,
            "speed_threshold": round(library.threshold, 4),
            "usable_by_kind": library.used,
            "seconds_by_source": _seconds_by_source(entries, library),
        },
        "left_out": list(left_out),
    }


def _hours(entries: Sequence[Entry]) -> float:
    return round(sum(int(entry["pair"]["frames"]) for entry in entries) / FPS / 3600, 3)


def _alignment(entries: Sequence[Entry]) -> dict[str, dict[str, float]]:
    """Mean over phrases of each direction: as recorded, warped, and by chance."""
    return {
        when: {
            way: round(
                float(np.mean([entry["pair"]["alignment"][when][way] for entry in entries])), 4
            )
            for way in ("motion_to_music", "music_to_motion")
        }
        for when in WHEN
    }


def _seams(out: Place, entries: Sequence[Entry]) -> dict[str, Any]:
    """Size of the acceleration in m/s² within seams, around other motion beats, elsewhere.

    Seams lie on motion beats, where the pelvis turns from braking to pushing in any case, so the
    second of the three is what the first is to be compared with.
    """
    found: dict[str, list[np.ndarray]] = {"at_seams": [], "at_other_beats": [], "elsewhere": []}
    for entry in entries:
        trajectory = MotionTrajectory(load_trajectory(out, entry))
        size = np.linalg.norm(trajectory.acceleration, axis=1)
        seam = _near(entry["pair"]["seams"], len(size))
        beats = motion_beats(trajectory.position, FPS).times * FPS
        beat = _near(np.rint(beats).astype(int), len(size)) & ~seam
        found["at_seams"].append(size[seam])
        found["at_other_beats"].append(size[beat])
        found["elsewhere"].append(size[~seam & ~beat])
    return {"number": sum(len(entry["pair"]["seams"]) for entry in entries)} | {
        f"acceleration_{name}": _percentiles(np.concatenate(sizes)) for name, sizes in found.items()
    }


def _near(frames: Iterable[int], num_frames: int) -> np.ndarray:
    """Frames [T] bool within half a seam of any of `frames`."""
    near = np.zeros(num_frames, dtype=bool)
    for frame in frames:
        near[max(0, frame - MARGIN) : frame + MARGIN + 1] = True
    return near


def _percentiles(values: np.ndarray) -> dict[str, float]:
    """Five points of a distribution; empty without values."""
    points = (5, 25, 50, 75, 95) if len(values) else ()
    return {f"p{p}": round(float(np.percentile(values, p)), 4) for p in points}


def _seconds_by_source(entries: Sequence[Entry], library: ClipLibrary) -> dict[str, float]:
    """Seconds of motion that each source of clips gave, seams counted twice."""
    source = {clip.id: clip.source for clip in library.clips}
    total: Counter[str] = Counter()
    for entry in entries:
        for piece in entry["pair"]["pieces"]:
            total[source[piece["clip"]]] += piece["last"] - piece["first"] + 1
    return {source: round(frames / FPS, 1) for source, frames in total.most_common()}


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


@dataclass(frozen=True)
class Motions:
    """The clips that a job takes its motion from, by name: each process reads them once."""

    folder: Place
    manifest_hash: str
    synthetic: bool
    seed: int

    def open(self, data: PreparedData | None = None) -> tuple[PreparedData, ClipLibrary]:
        """The folder and its usable clips.

        Args:
            data: the folder, where it is open already.

        Raises:
            UserError: the folder is damaged, or was written anew.
        """
        with _OPENING:
            if self not in _OPENED:
                data = data or PreparedData(self.folder, verify=False)
                if data.manifest_hash != self.manifest_hash:
                    raise UserError(f"{self.folder} has changed meanwhile; run prepare-audio again")
                _OPENED.clear()
                _OPENED[self] = data, open_library(data, synthetic=self.synthetic, seed=self.seed)
            return _OPENED[self]


_OPENED: dict[Motions, tuple[PreparedData, ClipLibrary]] = {}  # the last
_OPENING = threading.Lock()


@dataclass(frozen=True, eq=False)
class SongJob:
    """What one song's phrases are made of; `key` changes when any of it does."""

    source: MusicSource
    entry: SongEntry
    motions: Motions
    out: Place
    options: PairOptions
    key: str


def pair_song(job: SongJob) -> list[Entry]:
    """Make the phrases of one song that are missing; what cannot be made is recorded."""
    if done := finished_song(job):  # by a worker that was lost before it could tell
        return done
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
    data, library = job.motions.open()
    pair = pair_phrase(library.of_split(job.entry.split), beats, stop - start, _rng(job, name))
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
    entry = _entry(name, record, pair, start)
    add_body(job.out, entry, data)
    return _mark(job, entry)


def _inside(times: np.ndarray, begin: float, seconds: float) -> np.ndarray:
    return np.asarray(times[(times >= begin) & (times < begin + seconds)] - begin)


def _entry(name: str, record: PhraseRecord, pair: PhrasePair, start: int) -> dict[str, Any]:
    return {
        "id": name,
        "record": record.model_dump(),
        "pair": {
            "song_frame": start,
            "frames": len(pair.position) - SPARE,
            "pieces": [asdict(piece) for piece in pair.motion.pieces],
            "warp": {
                "start": pair.warp.start,
                "knot_seconds": KNOT_SECONDS,
                "rates": list(pair.warp.rates),
            },
            "seams": [int(frame) for frame in pair.seams],
            "matched": pair.matched,
            "coverage": round(pair.coverage, 4),
            "motion_beats": len(pair.motion_beats),
            "alignment": {when: asdict(getattr(pair, when)) for when in WHEN},
        },
    }


# ---------------------------------------------------------------- what is done already


def _phrase_path(out: Place, name: str) -> Place:
    return out / "phrases" / f"{name}.json"


def _mark(job: SongJob, entry: dict[str, Any]) -> dict[str, Any]:
    entry = entry | {"key": job.key}
    write_json(_phrase_path(job.out, entry["id"]), entry)
    return entry


def _read_finished(job: SongJob, name: str) -> Entry | None:
    """A phrase's entry, if it was made of the same and its files are whole."""
    entry = finished_record(_phrase_path(job.out, name), job.key)
    if entry is None:
        return None
    for part in ("motion", "features"):
        stored = entry.get("record", {}).get(part)
        if stored and not is_whole(job.out / stored["path"], stored["sha256"]):
            return None
    return entry


def _finish(job: SongJob, entries: list[Entry]) -> list[Entry]:
    """Mark the song as done: the names of its phrases, so that it need not be heard again."""
    names = [entry["id"] for entry in entries]
    for entry in entries:
        if entry["id"] == job.entry.id:  # the song itself was left out
            _mark(job, entry)
    write_json(job.out / "songs" / f"{job.entry.id}.json", {"key": job.key, "phrases": names})
    return entries


def finished_song(job: SongJob) -> list[Entry] | None:
    """The entries of a song that is done; None if anything is missing or of another key."""
    song = finished_record(job.out / "songs" / f"{job.entry.id}.json", job.key)
    if song is None:
        return None
    entries = [_read_finished(job, name) for name in song["phrases"]]
    return None if None in entries else [entry for entry in entries if entry]


CAPTION = {"en": ["a person moves"]}  # what keeps `prepare` from skipping an unlabelled clip


def prepare_unlabelled(
    source: Place, out: Place, *, workers: int | None = 1, scheduler: str | None = None
) -> PreparedData:
    """Prepare every motion file of a folder, labelled or not, once; then open it.

    Args:
        workers, scheduler: who does it, as `run_jobs` has them.

    Raises:
        UserError: no motion file, or none can be used.
    """
    folder = MotionFolder.open(source)
    folder = replace(folder, table=dict.fromkeys(folder.files(), (Piece(captions=CAPTION),)))
    prepare([folder], out, workers=workers, scheduler=scheduler)
    return PreparedData.open(out)


VERSION = 2  # of the method: another number makes everything anew

Progress = Callable[[int, int], None]  # (songs done, songs in all)


def prepare_audio(
    data: PreparedData,
    sources: Sequence[MusicSource],
    out: Place,
    *,
    options: PairOptions,
    workers: int | None = 1,
    scheduler: str | None = None,
    progress: Progress = lambda done, total: None,
) -> dict[str, Any]:
    """Pair the motions of a prepared folder with music; returns the report.

    Args:
        data: what `prepare` wrote.
        out: folder of the pairs.
        workers, scheduler: who does it, as `run_jobs` has them.
        progress: called after each song.

    Raises:
        UserError: no clip moves enough, or no phrase at all could be made.
    """
    motions = Motions(
        data.folder.absolute(), data.manifest_hash, options.synthetic_clips, options.seed
    )
    _, library = motions.open(data)
    if not library.clips:
        reasons = ", ".join(f"{number}: {why}" for why, number in library.left_out.items())
        raise UserError(
            f"{data.folder}: no clip can be used ({reasons}); give motions that"
            " travel or step, or add the synthetic ones"
        )
    jobs = _jobs(motions, library, sources, out.absolute(), options)
    made = _run(jobs, workers, scheduler, progress)
    if scheduler is not None:
        clear_unfinished(out)  # what workers that died left
    phrases = sorted((e for e in made if "record" in e), key=lambda e: e["id"])
    left_out = sorted((e for e in made if "record" not in e), key=lambda e: e["id"])
    if not phrases:
        example = f", e.g. {left_out[0]['id']}: {left_out[0]['reason']}" if left_out else ""
        raise UserError(
            f"no phrase could be made of {len(jobs)} songs{example}"
            "; give longer songs or more clips"
        )
    describe(out, phrases, data)
    _remove_stale(out, {entry["id"] for entry in made})
    write_json(out / "manifest.json", _manifest(phrases, data, options))
    write_statistics(out, phrases)
    report = make_report(out, phrases, left_out, library)
    write_json(out / "report.json", report)
    return report


def _jobs(
    motions: Motions,
    library: ClipLibrary,
    sources: Sequence[MusicSource],
    out: Place,
    options: PairOptions,
) -> list[SongJob]:
    jobs: dict[str, SongJob] = {}  # a song that two sources hold is taken once
    for source in sources:
        for entry in source.entries():
            if not library.of_split(entry.split):  # too few to hold any back for this split
                entry = replace(entry, split="train")
            made_of = (entry.id, entry.split, entry.fingerprint, asdict(options))
            text = json.dumps([VERSION, motions.manifest_hash, *made_of])
            key = hashlib.sha256(text.encode()).hexdigest()
            jobs.setdefault(entry.id, SongJob(source, entry, motions, out, options, key))
    return list(jobs.values())


def _run(
    jobs: list[SongJob], workers: int | None, scheduler: str | None, progress: Progress
) -> list[Entry]:
    finished = [finished_song(job) for job in jobs]
    made = [entry for found in finished if found is not None for entry in found]
    todo = [job for job, found in zip(jobs, finished, strict=True) if found is None]
    done = len(jobs) - len(todo)
    progress(done, len(jobs))
    for _, entries in run_jobs(pair_song, todo, workers, scheduler):
        made += entries
        progress(done := done + 1, len(jobs))
    return made


def _remove_stale(out: Place, wanted: set[str]) -> None:
    """Phrases of an earlier, larger run."""
    for path in files_below(out / "phrases"):
        if path.suffix == ".json" and path.stem not in wanted:
            path.unlink()
            for file in (features_path(path.stem), trajectory_path(path.stem)):
                remove_folder((out / file).parent)
    songs = {name.rpartition("-")[0] for name in wanted} | wanted
    for path in files_below(out / "songs"):
        if path.suffix == ".json" and path.stem not in songs:
            path.unlink()


def _manifest(phrases: list[Entry], data: PreparedData, options: PairOptions) -> dict[str, Any]:
    return {
        "version": 1,  # of the layout
        "method": VERSION,
        "fps": FPS,
        "motion_manifest": data.manifest_hash,
        "options": asdict(options),
        "phrases": [entry["record"] | {"pair": entry["pair"]} for entry in phrases],
    }
