"""`evaluate-audio`: does the music matter, and are the seams seen?

Motions are made for held-out synthetic songs; their phase is held against the truth beside the
beat tracker's own error, their motion beats against the song's beats beside chance, another song
and the same song half a beat later. Real paired motion stands beside them. One seed, one report.

Letters: T frames, N songs.
"""

import time
from collections.abc import Callable, Sequence
from dataclasses import asdict, dataclass, field
from pathlib import Path
from typing import Any

import numpy as np

from src.shared.data.pairing.motion_beats import MotionBeats, motion_beats
from src.shared.errors import UserError
from src.shared.evaluation.audio_alignment import Danced, alignment_rows, song_scores
from src.shared.evaluation.audio_phase import phase_row, right_tempo
from src.shared.evaluation.audio_songs import (
    TEMPI,
    Piece,
    held_out_songs,
    open_split,
    phrases,
    tracks,
)
from src.shared.evaluation.metrics_rhythm import phase_error
from src.shared.evaluation.metrics_seams import Seamed, seam_frames, seam_report
from src.shared.inference.song_generator import SongGenerator
from src.shared.inference.song_sampler import SampleSettings
from src.shared.motion.trajectory import FPS, MotionTrajectory

Progress = Callable[[str], None]
Cells = dict[str, dict[str, Any]]


@dataclass(frozen=True)
class AudioSettings:
    """How much is measured; the report repeats it."""

    num_songs: int = 50
    song_seconds: float = 16.0
    own_count: int = 10  # songs made once more, the phase not held to the beat tracker
    tell_meter: bool = True
    max_real: int = 200  # test phrases
    track_seconds: float = 30.0  # of each sound file
    pictures: int = 4
    seed: int = 0


@dataclass(frozen=True, eq=False)
class Picture:
    """What a plot of one song needs: bars [T] by name, beats, and where the motion slows down."""

    name: str
    bars: dict[str, np.ndarray]
    beats: np.ndarray
    motion: MotionBeats


@dataclass(eq=False)
class AudioEvaluation:
    """The report as plain data, and the pictures that go with it."""

    report: dict[str, Any] = field(default_factory=dict)
    pictures: list[Picture] = field(default_factory=list)


def evaluate_audio(
    generator: SongGenerator,
    *,
    data: str | None = None,
    songs: Path | None = None,
    settings: AudioSettings | None = None,
    sampling: dict[str, Any] | None = None,
    about: dict[str, Any] | None = None,
    progress: Progress = lambda text: None,
) -> AudioEvaluation:
    """Everything of `evaluate-audio`.

    Args:
        generator: a trained audio branch.
        data: folder or bucket of pairs, whose test split is the real row; None = no such row.
        songs: folder of sound files to describe; None = none.
        sampling: steps, sampler, guidance_scale; left out = the model's own.
        about: what to repeat in the report.
        progress: told what begins.

    Raises:
        UserError: the data or a song cannot be used.
    """
    settings, started = settings or AudioSettings(), time.perf_counter()
    sampled = SampleSettings(seed=settings.seed, **(sampling or {}))
    sampled = sampled.resolved(generator.model.config)
    result = AudioEvaluation()
    made = _dance(generator, settings, sampled, progress)
    dances = [_danced(trajectory, piece) for piece, trajectory in made]
    rows = {"generated": alignment_rows(dances, settings.seed)}
    real: dict[str, Any] | None = None
    if data is not None:
        progress(f"the test split of {data}")
        real = _real_dances(data, settings)
        rows["real"] = alignment_rows(real.pop("dances"), settings.seed)
    played = [] if songs is None else _play(generator, songs, settings, sampled, progress)
    progress("seams")
    result.report = {
        "about": {
            **(about or {}),
            **_about_model(generator, sampled),
            "songs": f"{len(made)} synthetic, {settings.song_seconds:g} s, tempi {TEMPI} BPM",
            "tempo_heard_right": f"{sum(right_tempo(p) for p, _ in made)} of {len(made)} songs",
            "data": data or "none",
            **(real or {}),
        },
        "settings": asdict(settings),
        "phase": _phase_table(generator, made, settings, sampled, progress),
        "alignment": rows,
        "tempi": [piece.about for piece, _ in made],
        "seams": seam_report([_seamed(*pair, sampled) for pair in made], settings.seed),
        "tracks": [_track_row(piece, made, settings) for piece, made in played],
        "seconds": round(time.perf_counter() - started, 1),
    }
    shown = [*made[: settings.pictures], *played]
    result.pictures = [_picture(piece, trajectory) for piece, trajectory in shown]
    return result


def _about_model(generator: SongGenerator, sampled: SampleSettings) -> dict[str, Any]:
    card, diffusion = generator.model.card, generator.model.config.diffusion
    scale = generator.model.config.guidance_scale
    return {
        "model_hash": card.weights.sha256[:12] if card.weights else "",
        "sampler": sampled.sampler or diffusion.sampler,
        "steps": sampled.steps or diffusion.sampling_steps,
        "guidance_scale": scale if sampled.guidance_scale is None else sampled.guidance_scale,
        "window": sampled.window,
        "overlap": sampled.overlap,
    }


def _make(
    generator: SongGenerator, piece: Piece, sampled: SampleSettings, *, held: bool = True
) -> MotionTrajectory:
    return generator.generate(
        piece.condition, phase=piece.phase if held else None, settings=sampled
    )[0]


def _dance(
    generator: SongGenerator, settings: AudioSettings, sampled: SampleSettings, progress: Progress
) -> list[tuple[Piece, MotionTrajectory]]:
    """A motion for each held-out song."""
    made = []
    pieces = held_out_songs(
        settings.num_songs, settings.song_seconds, settings.seed, tell_meter=settings.tell_meter
    )
    for number, piece in enumerate(pieces, start=1):
        progress(f"song {number} of {settings.num_songs}")
        made.append((piece, _make(generator, piece, sampled)))
    return made


def _play(
    generator: SongGenerator,
    songs: Path,
    settings: AudioSettings,
    sampled: SampleSettings,
    progress: Progress,
) -> list[tuple[Piece, MotionTrajectory]]:
    """A motion for each sound file."""
    made = []
    for piece in tracks(songs, settings.track_seconds):
        progress(piece.name)
        made.append((piece, _make(generator, piece, sampled)))
    return made


def _danced(trajectory: MotionTrajectory, piece: Piece) -> Danced:
    found = motion_beats(trajectory.position, trajectory.fps)
    return Danced(piece.name, found.times, piece.beats, piece.seconds)


def _seamed(piece: Piece, trajectory: MotionTrajectory, sampled: SampleSettings) -> Seamed:
    assert sampled.window is not None  # resolved
    near = seam_frames(trajectory.num_frames, sampled.window, sampled.overlap)
    return Seamed(trajectory, near)


# ---------------------------------------------------------------- phase


def _phase_table(
    generator: SongGenerator,
    made: Sequence[tuple[Piece, MotionTrajectory]],
    settings: AudioSettings,
    sampled: SampleSettings,
    progress: Progress,
) -> dict[str, Cells]:
    """Rows by name, see `phase_row`; "right tempo" are songs whose tempo the tracker found."""
    rng = np.random.default_rng([settings.seed, 1])
    counted = []
    for number, (piece, _) in enumerate(made[: settings.own_count], start=1):
        progress(f"own count, song {number} of {min(settings.own_count, len(made))}")
        counted.append((piece, _make(generator, piece, sampled, held=False)))
    tracked = [(p, np.asarray(p.phase)) for p, _ in made if p.phase is not None]
    rows = {
        "generated": phase_row([(piece, t.phase_unwrapped) for piece, t in made]),
        "beat tracker": phase_row(tracked),
        "generated, right tempo": phase_row(
            [(piece, t.phase_unwrapped) for piece, t in made if right_tempo(piece)]
        ),
        "beat tracker, right tempo": phase_row([pair for pair in tracked if right_tempo(pair[0])]),
        "own count": phase_row([(piece, t.phase_unwrapped) for piece, t in counted]),
        "chance": phase_row([(piece, bars + rng.random()) for piece, bars in tracked]),
    }
    return {name: row for name, row in rows.items() if row}


# ---------------------------------------------------------------- real motion


def _real_dances(data: str, settings: AudioSettings) -> dict[str, Any]:
    """Paired motion of the test split, its hash, and how many phrases have no known beat."""
    dataset = open_split(data, "test", round(settings.song_seconds * FPS), settings.seed)
    real = phrases(dataset, settings.max_real)
    known = [phrase for phrase in real if len(phrase.beats) > 1]
    if not known:
        raise UserError(f"{data}: no test phrase has a beat; make the pairs with prepare-audio")
    dances = [
        Danced(
            phrase.song, motion_beats(phrase.motion.position).times, phrase.beats, phrase.seconds
        )
        for phrase in known
    ]
    return {"dances": dances, "data_hash": dataset.fingerprint[:12], "test_phrases": len(known)}


# ---------------------------------------------------------------- tracks and pictures


def _track_row(
    piece: Piece, trajectory: MotionTrajectory, settings: AudioSettings
) -> dict[str, Any]:
    """A sound file's figures against the beats that the tracker heard: descriptive."""
    row: dict[str, Any] = {"name": piece.name, "seconds": piece.seconds, **piece.about}
    if piece.phase is None:
        return row
    dance = _danced(trajectory, piece)
    rng = np.random.default_rng([settings.seed, 3])
    scores = song_scores(dance, [dance], rng)
    scores.pop("another song")
    error = phase_error(
        trajectory.phase_unwrapped * piece.meter, np.asarray(piece.phase) * piece.meter
    )
    return row | {
        "phase_from_tracker": error.absolute,
        "rows": {name: score.as_dict() for name, score in scores.items()},
    }


def _picture(piece: Piece, trajectory: MotionTrajectory) -> Picture:
    bars = {} if piece.bars is None else {"truth": piece.bars}
    bars |= {} if piece.phase is None else {"beat tracker": piece.phase}
    bars["generated"] = trajectory.phase_unwrapped
    motion = motion_beats(trajectory.position, trajectory.fps)
    inside = piece.beats[piece.beats < piece.seconds]
    return Picture(piece.name, bars, inside, motion)
