"""Tables of the audio branch with rows of their own: phase, alignment, seams, sound files."""

from collections.abc import Iterator
from itertools import pairwise
from typing import Any

import numpy as np

from ..metrics.rhythm import phase_error
from ..metrics.seams import REACH, Seamed, seam_report
from ..motion.trajectory import MotionTrajectory
from ..pipelines.song import SongGenerator
from ..pipelines.song_sampler import SPARE, spans
from .audio_alignment import Danced, alignment_rows, song_scores
from .audio_context import AudioContext
from .audio_phase import phase_row, right_tempo
from .audio_songs import Piece
from .families_audio import beats_of
from .report.tables import Column, Grid, GridRow, plain
from .samples import DanceSample

PHASE = (
    Column("beat", "beat |error|"), Column("beat_seconds", "in seconds"),
    Column("bar", "bar |error|"), Column("beat_offset", "beat offset"),
    Column("steady", "steadiness"),
)  # fmt: skip
ALIGNMENT = (
    Column("motion_to_music", "motion→music"), Column("music_to_motion", "music→motion"),
    Column("f", "F"), Column("hits", "hits F"), Column("distance", "distance s"),
)  # fmt: skip
TRACK = (
    Column("tempo", "BPM", 1), Column("meter", "meter", 0), Column("confidence", "confidence", 2),
    Column("phase_from_tracker", "phase off tracker"), Column("motion_to_music", "motion→music"),
    Column("music_to_motion", "music→motion"), Column("f", "F"), Column("chance", "chance F"),
    Column("half", "half-beat F"),
)  # fmt: skip
UNITS = {"acceleration": "m/s²", "jerk": "m/s³", "angular_acceleration": "rad/s²"}
NOTES = {
    "phase": "Cycles; guessing scores 0.25. The first replication. generated: where the tracker"
    " finds beats its phase is taken over, so the rows agree; right tempo: songs whose tempo the"
    " tracker found within 4%; own count: the same network, not held; chance: the tracker's phase"
    " moved by a random offset a song. No real row: of real phrases nobody knows more than the"
    " tracker. ± is 95% over songs.",
    "alignment": "The first replication. chance: the motion turned round by random times; another"
    " song: 8 others. ± is 95% over songs.",
    "above": "own song minus the row, song by song, ± 95%; * the two rows' intervals do not"
    " overlap.",
    "seams": "The first replication. Ratio of quantiles at seams and elsewhere, [95% bootstrap"
    " over songs]; (null: the same marks at random places). KS: largest distance of the"
    " distributions, p from the null. The null is chance; real motion is not made of windows, so"
    " it has no seams, and what it would score is 1.",
    "jumps": "The extremes elsewhere in the same songs stand for real and chance.",
    "tracks": "Descriptive: nobody knows these songs' beats, the tracker's stand in, and nobody"
    " danced to them, so there is no real row. chance: the motion turned round by random times."
    " Untrained: see the held-out songs.",
}


# ---------------------------------------------------------------- phase


def phase_table(context: AudioContext) -> list[Grid]:
    """Rows by name, see `phase_row`; "right tempo" are songs whose tempo the tracker found."""
    made, settings = context.made(0), context.settings
    rng = np.random.default_rng([settings.seed, 1])
    counted = _counted(context, "own count", context.generator)
    blind = _counted(context, "untrained, own count", context.fresh) if settings.untrained else []
    own = [(piece, motion.phase_unwrapped) for piece, motion in made]
    tracked = [(p, np.asarray(p.phase)) for p, _ in made if p.phase is not None]
    groups = {
        "generated": own,
        "beat tracker": tracked,
        "generated, right tempo": [pair for pair in own if right_tempo(pair[0])],
        "beat tracker, right tempo": [pair for pair in tracked if right_tempo(pair[0])],
        "own count": counted,
        "untrained, own count": blind,
        "chance": [(piece, bars + rng.random()) for piece, bars in tracked],
    }
    rows = {
        name: GridRow(plain(phase_row(group)), len(group), 1)
        for name, group in groups.items()
        if group
    }
    return [Grid("phase", "bar and beat phase, held-out songs", PHASE, rows, NOTES["phase"])]


def _counted(
    context: AudioContext, name: str, generator: SongGenerator
) -> list[tuple[Piece, np.ndarray]]:
    """Bars [T] that a network counts for itself, of the first songs."""
    asked = context.pieces[: context.settings.own_count]
    counted = []
    for number, piece in enumerate(asked, start=1):
        context.progress(f"{name}, song {number} of {len(asked)}")
        counted.append((piece, context.dance(piece, held=False, generator=generator)))
    return [(piece, motion.phase_unwrapped) for piece, motion in counted]


# ---------------------------------------------------------------- beats


def alignment_tables(context: AudioContext) -> list[Grid]:
    """Generated, real and untrained motion on their own songs, and on what must score less."""
    samples = {"generated": context.generated(0)}
    if context.settings.untrained:
        samples["untrained"] = context.untrained(0)
    if len(context.reference):
        samples["real"] = context.reference
    seed = context.settings.seed
    return [
        grid
        for name, sample in samples.items()
        for grid in alignment_grids(name, alignment_rows(_danced(sample), seed))
    ]


def _danced(sample: DanceSample) -> list[Danced]:
    pairs = zip(sample.dances, sample.each("beats", beats_of), strict=True)
    return [Danced(dance.song, beats, dance.beats, dance.seconds) for dance, beats in pairs]


def alignment_grids(name: str, part: dict[str, Any]) -> Iterator[Grid]:
    """What `alignment_rows` found of the motions called `name`: scores, and differences."""
    size = (
        f"{part['songs']} songs; beats a second: motion {part['motion_beats']:.2f}, music"
        f" {part['music_beats']:.2f}; {part['without_beats']} motions without beats"
    )
    for key, title, columns in (
        ("rows", f"{name} motion on music ({size})", ALIGNMENT),
        ("above", f"{name} motion: its own song above", ALIGNMENT[:-1]),
    ):
        note = NOTES["alignment" if key == "rows" else "above"]
        rows = {row: GridRow(plain(cells), part["songs"], 1) for row, cells in part[key].items()}
        yield Grid(f"alignment/{name}/{key}", title, columns, rows, note, "motion against")


# ---------------------------------------------------------------- seams


def seam_tables(context: AudioContext) -> list[Grid]:
    """Accelerations at seams between windows against everywhere else."""
    made = {"": context.made(0)}
    if context.settings.untrained:
        made["untrained"] = context.made_untrained(0)
    tables: list[Grid] = []
    for name, motions in made.items():
        songs = [_seamed(motion, context) for _, motion in motions]
        found = seam_report(songs, context.settings.seed)
        tables += _seams(found, name) if "quantities" in found else []
    return tables


def seam_frames(num_frames: int, window: int, overlap: int) -> np.ndarray:
    """True [T] where two windows of a song share a frame, and just around."""
    near = np.zeros(num_frames, dtype=bool)
    found = spans(num_frames, window - SPARE, overlap)
    for (_, end), (start, _) in pairwise(found):
        near[max(0, start - REACH) : end + REACH] = True
    return near


def _seamed(trajectory: MotionTrajectory, context: AudioContext) -> Seamed:
    sampled = context.sampled
    assert sampled.window is not None  # resolved
    near = seam_frames(trajectory.num_frames, sampled.window, sampled.overlap)
    return Seamed(trajectory, near)


def _seams(seams: dict[str, Any], row: str) -> Iterator[Grid]:
    names = [f"{name}/{row}".rstrip("/") for name in ("seams", "jumps")]
    of = f", {row}" if row else ""
    rows = {}
    for name, found in seams["quantities"].items():
        cells = {
            key: f"{r['value']:.3f} [{r['low']:.3f}, {r['high']:.3f}]"
            f" ({r['null_low']:.3f}–{r['null_high']:.3f})"
            for key, r in (("p50", found["ratio_p50"]), ("p95", found["ratio_p95"]))
        }
        cells["medians"] = f"{found['seam_p50']:.3g} / {found['elsewhere_p50']:.3g}"
        cells["ks"] = f"{found['ks']['value']:.3f} (p {found['ks']['p']:.2f})"
        rows[f"{name.replace('_', ' ')}, {UNITS[name]}"] = GridRow(cells)
    columns = (
        Column("medians", "median at / elsewhere"), Column("p50", "ratio of medians"),
        Column("p95", "ratio of p95"), Column("ks", "KS"),
    )  # fmt: skip
    size = f"{seams['seams']} seams of {seams['songs']} songs, {seams['frames']} frames"
    yield Grid(names[0], f"seams{of} ({size})", columns, rows, NOTES["seams"], "quantity")
    jumps = seams["jumps"]
    rows = {
        key.replace("_", " "): GridRow({"at": f"{at:.4g}", "elsewhere": f"{other:.4g}"})
        for key, (at, other) in ((k, v) for k, v in jumps.items() if k != "none")
    }
    title = f"jumps at seams{of}: {'none' if jumps['none'] else 'FOUND'}"
    places = (Column("at", "at seams"), Column("elsewhere", "elsewhere"))
    yield Grid(names[1], title, places, rows, NOTES["jumps"], "extreme")


# ---------------------------------------------------------------- sound files


def track_table(context: AudioContext) -> list[Grid]:
    """Sound files against the beats that the tracker heard: descriptive."""
    rows = {
        piece.name[:40]: GridRow(plain(_track(piece, motion, context.settings.seed)))
        for piece, motion in context.played
    }
    return [Grid("tracks", "real tracks", TRACK, rows, NOTES["tracks"], "track")] if rows else []


def _track(piece: Piece, trajectory: MotionTrajectory, seed: int) -> dict[str, float]:
    cells = {key: float(piece.about[key]) for key in ("tempo", "meter", "confidence")}
    if piece.phase is None:
        return cells
    dance = Danced(piece.name, beats_of(trajectory), piece.beats, piece.seconds)
    scores = song_scores(dance, [dance], np.random.default_rng([seed, 3]))
    own = scores["own song"].as_dict()
    error = phase_error(
        trajectory.phase_unwrapped * piece.meter, np.asarray(piece.phase) * piece.meter
    )
    return cells | {
        "phase_from_tracker": error.absolute,
        **{key: own[key] for key in ("motion_to_music", "music_to_motion", "f")},
        "chance": scores["chance"].f,
        "half": scores["half a beat later"].f,
    }
