"""The audio suite: does the music matter, and does the motion hold together?

Motions are made for held-out synthetic songs whose beats are known exactly. Every family of
`AUDIO_FAMILIES` is measured on them, on the same motions under another song, on frozen and
untrained ones, and on real paired motion, replication by replication. Then phase, alignment and
seams, and sound files.

Letters: T frames, N songs.
"""

import io
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import asdict, dataclass, field, replace
from functools import cache, cached_property, partial
from itertools import pairwise
from pathlib import Path
from typing import Any
from zlib import crc32

import numpy as np

from ...audio.synthetic import render_song
from ...data.phrases.dataset import MotionPhraseDataset
from ...errors import UserError
from ...formats.arrays import write_trajectory_npz
from ...io.files import atomic_write
from ...metrics.rhythm import against_chance, phase_error, strangers
from ...metrics.sanity import frozen
from ...metrics.seams import Seamed, marked, seam_report
from ...model.audio.audio_motion_model import AudioMotionModel
from ...motion.trajectory import FPS, MotionTrajectory
from ...pipelines.song import SongGenerator, own_noise
from ...pipelines.song_sampler import SPARE, SongSampling, spans
from ..engine import Bench, Progress, Row, Suite, run_suite
from ..families import AUDIO_FAMILIES, beats_of
from ..manifest import Part, Parts, Sources, model_hashes, song_hashes
from ..samples import Dance, DanceSample, Trajectories, untrained_audio_model
from ..tables import Grid, GridRow
from .alignment import (
    alignment_grids,
    danced,
    phase_row,
    plot_phase,
    right_tempo,
)
from .songs import (
    TEMPI,
    Piece,
    dance_of,
    held_out_songs,
    held_out_specs,
    open_split,
    phrases,
    tracks,
)

Made = list[tuple[Piece, MotionTrajectory]]


@dataclass(frozen=True)
class AudioSettings:
    """How much is measured; the report repeats it."""

    num_songs: int = 50
    song_seconds: float = 16.0
    replications: int = 20
    untrained: int = 3  # replications of the untrained row, at most; 0 = no row
    own_count: int = 10  # songs made once more, the phase not held to the beat tracker
    tell_meter: bool = True
    max_real: int = 200  # test phrases
    track_seconds: float = 30.0  # of each sound file
    pictures: int = 4
    worst: int = 4  # motions to be looked at, each with its song
    seed: int = 0


@dataclass(frozen=True, eq=False)
class AudioContext:
    """Everything a table of the audio branch may draw on; songs and motions are made once."""

    generator: SongGenerator[AudioMotionModel]  # a trained audio branch
    settings: AudioSettings = field(default_factory=AudioSettings)
    # folder or bucket of pairs, whose test split is the real row; None = no such row
    data: str | None = None
    songs: Path | None = None  # folder of sound files to describe; None = none
    # steps, sampler, guidance_scale; left out or None = the model's own
    sampling: Mapping[str, Any] = field(default_factory=dict)
    progress: Progress = lambda text: None  # told what begins

    @cached_property
    def sampled(self) -> SongSampling:
        """How motions are sampled, with nothing left to the model."""
        return SongSampling(**self.sampling).resolved(self.generator.model.config)

    @cached_property
    def pieces(self) -> list[Piece]:
        """Held-out synthetic songs."""
        self.progress(f"{self.settings.num_songs} songs of {self.settings.song_seconds:g} s")
        return list(held_out_songs(*self._asked, tell_meter=self.settings.tell_meter))

    @property
    def _asked(self) -> tuple[int, float, int]:
        return self.settings.num_songs, self.settings.song_seconds, self.settings.seed

    def write_song(self, index: int, path: Path) -> None:
        """A held-out song as a FLAC file, for the report."""
        import soundfile

        song = render_song(held_out_specs(*self._asked)[index])
        sound = io.BytesIO()  # libsndfile does not say what the disk said
        soundfile.write(sound, song.samples, song.sample_rate, subtype="PCM_16", format="FLAC")
        with atomic_write(path) as temporary:
            temporary.write_bytes(sound.getvalue())

    def dance(
        self,
        piece: Piece,
        *,
        replication: int = 0,
        held: bool = True,
        generator: SongGenerator[AudioMotionModel] | None = None,
    ) -> MotionTrajectory:
        """A motion for a song, with noise of its own; not `held`, it counts the phase for itself.

        With one noise for all, fifty songs would hold fifty times one walk.
        """
        settings = replace(self.sampled, seed=self.settings.seed)
        settings = own_noise(settings, replication, crc32(piece.name.encode()))
        phase = piece.phase if held else None
        return (generator or self.generator).generate(
            piece.condition, phase=phase, settings=settings
        )[0]

    @cached_property
    def made(self) -> Callable[[int, bool], Made]:
        """A motion for each held-out song in a replication, by the model or by `fresh`."""
        return cache(self._made)

    def _made(self, replication: int, untrained: bool) -> Made:
        generator = self.fresh if untrained else self.generator
        return [
            (piece, self.dance(piece, replication=replication, generator=generator))
            for piece in self.pieces
        ]

    @cached_property
    def played(self) -> Made:
        """A motion for each sound file."""
        if self.songs is None:
            return []
        made = []
        for piece in tracks(self.songs, self.settings.track_seconds):
            self.progress(piece.name)
            made.append((piece, self.dance(piece)))
        return made

    # ---------------------------------------------------------------- samples

    @cached_property
    def split(self) -> MotionPhraseDataset | None:
        """The test split, in windows as long as the songs; None without data.

        Raises:
            UserError: there is none.
        """
        if self.data is None:
            return None
        frames = round(self.settings.song_seconds * FPS)
        return open_split(self.data, "test", frames, self.settings.seed)

    @property
    def fingerprint(self) -> str:
        """Hash of the data; empty without."""
        return "" if self.split is None else self.split.fingerprint

    @cached_property
    def reference(self) -> Trajectories:
        """Real motion of the test split with its music; empty without data.

        Raises:
            UserError: no phrase of the split has a beat.
        """
        if self.data is None:
            return DanceSample.of([])
        self.progress(f"the test split of {self.data}")
        assert self.split is not None
        known = [p for p in phrases(self.split, self.settings.max_real) if len(p.beats) > 1]
        if not known:
            raise UserError(
                f"{self.data}: no test phrase has a beat; make the pairs with prepare-audio"
            )
        dances = [Dance(phrase.song, phrase.motion, phrase.beats) for phrase in known]
        return DanceSample(dances, np.arange(len(dances)))

    def generated(self, replication: int) -> Trajectories:
        """The model's motions on their own songs."""
        return sample_of(self.made(replication, False))

    def chance(self, replication: int) -> Trajectories:
        """The same motions, each on another song: what not listening scores."""
        sample = self.generated(replication)
        rng = np.random.default_rng([self.settings.seed, 4, replication])
        return sample.reordered(strangers(len(sample), rng))

    def frozen_pose(self, replication: int) -> Trajectories:
        """The first pose of each motion held while the music goes on."""
        return sample_of([(piece, frozen(motion)) for piece, motion in self.made(0, False)])

    def untrained(self, replication: int) -> Trajectories:
        """Motions of the same network with fresh weights."""
        return sample_of(self.made(replication, True))

    @cached_property
    def fresh(self) -> SongGenerator[AudioMotionModel]:
        """The same network with fresh weights, the last layer included."""
        fresh = untrained_audio_model(self.generator.model, self.settings.seed)
        return SongGenerator(fresh, device=str(self.generator.device))


def sample_of(made: Sequence[tuple[Piece, MotionTrajectory]]) -> Trajectories:
    """Motions on songs as a sample; no real motion belongs to a song that was made up."""
    return DanceSample.of([dance_of(piece, motion) for piece, motion in made])


# ---------------------------------------------------------------- tables with rows of their own


UNITS = {"acceleration": "m/s²", "jerk": "m/s³", "angular_acceleration": "rad/s²"}


# ---------------------------------------------------------------- phase


def phase_table(context: AudioContext) -> list[Grid]:
    """Rows by name, see `phase_row`; "right tempo" are songs whose tempo the tracker found."""
    made, settings = context.made(0, False), context.settings
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
        name: GridRow(phase_row(group), len(group), 1) for name, group in groups.items() if group
    }
    return [Grid.of("phase of a song", rows, name="phase")]


def _counted(
    context: AudioContext, name: str, generator: SongGenerator[AudioMotionModel]
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
    found = {name: danced(sample, "beats", beats_of) for name, sample in samples.items()}
    return alignment_grids(found, context.settings.seed)


# ---------------------------------------------------------------- seams


def seam_tables(context: AudioContext) -> list[Grid]:
    """Accelerations at seams between windows against everywhere else."""
    made = {"": context.made(0, False)}
    if context.settings.untrained:
        made["untrained"] = context.made(0, True)
    tables: list[Grid] = []
    window, overlap = context.sampled.window, context.sampled.overlap
    assert window is not None  # resolved
    for name, motions in made.items():
        songs = [Seamed(m, seam_frames(m.num_frames, window, overlap)) for _, m in motions]
        found = seam_report(songs, context.settings.seed)
        tables += _seams(found, name) if "quantities" in found else []
    return tables


def seam_frames(num_frames: int, window: int, overlap: int) -> np.ndarray:
    """True [T] where two windows of a song share a frame, and just around."""
    found = spans(num_frames, window - SPARE, overlap)
    return marked(num_frames, ((start, end) for (_, end), (start, _) in pairwise(found)))


def _seams(seams: dict[str, Any], row: str) -> Iterator[Grid]:
    end, of = (f"/{row}", f", {row}") if row else ("", "")
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
    yield Grid.of("seams", rows, {**seams, "of": of}, name=f"seams{end}")
    jumps = seams["jumps"]
    found = "none" if jumps.pop("none") else "FOUND"
    rows = {
        key.replace("_", " "): GridRow({"at": f"{at:.4g}", "elsewhere": f"{other:.4g}"})
        for key, (at, other) in jumps.items()
    }
    yield Grid.of("jumps", rows, {"of": of, "found": found}, name=f"jumps{end}")


# ---------------------------------------------------------------- sound files


def track_table(context: AudioContext) -> list[Grid]:
    """Sound files against the beats that the tracker heard: descriptive."""
    rows = {
        piece.name[:40]: GridRow(_track(piece, motion, context.settings.seed))
        for piece, motion in context.played
    }
    return [Grid.of("tracks", rows)] if rows else []


def _track(piece: Piece, trajectory: MotionTrajectory, seed: int) -> dict[str, float]:
    cells = {key: float(piece.about[key]) for key in ("tempo", "meter", "confidence")}
    if piece.phase is None:
        return cells
    rng = np.random.default_rng([seed, 3])
    own, chance, off = against_chance(beats_of(trajectory), piece.beats, piece.seconds, rng)
    error = phase_error(
        trajectory.phase_unwrapped * piece.meter, np.asarray(piece.phase) * piece.meter
    )
    return cells | {
        "phase_from_tracker": error.absolute,
        "motion_to_music": own.motion_to_music,
        "music_to_motion": own.music_to_motion,
        "f": own.f,
        "chance": chance.f,
        "half": off.f,
    }


# ---------------------------------------------------------------- the suite


def evaluate_audio(
    context: AudioContext,
    *,
    about: Mapping[str, Any] | None = None,
    folder: Path | None = None,
) -> dict[str, Any]:
    """The whole report as plain data.

    Args:
        context: the model, songs and amounts.
        about: what to repeat in the report; `model` and `decoder` are names or folders.
        folder: of the report: finished parts are kept there and not measured again.

    Raises:
        UserError: the data or a song cannot be used, or the folder holds another report.
    """
    about = about or {}
    tables: dict[str, Callable[[AudioContext], list[Grid]]] = {
        "phase": phase_table,
        "alignment": alignment_tables,
        "seams": seam_tables,
        "tracks": track_table,
    }
    suite = Suite(
        "audio",
        asdict(context.settings),
        [song_bench(context)],
        {name: partial(make, context) for name, make in tables.items()},
        {**about, **_about_model(context)},
        facts=partial(_facts, context),
        pictures=partial(_draw, context),
        sources=partial(_sources, context, about),
    )
    return run_suite(suite, Parts(folder), context.progress)


def song_bench(context: AudioContext) -> Bench[Trajectories]:
    """The songs: real motion where there is data, chance, a frozen pose, generated, untrained."""

    def real(replication: int = 0) -> Trajectories:
        return context.reference

    return Bench(
        "songs",
        "held-out songs",
        real,
        [
            Row("real", real, None if context.data is not None else 0, fixed=True, real=True),
            Row("chance", context.chance),
            Row("frozen pose", context.frozen_pose, limit=1, fixed=True),
            Row("generated", context.generated),
            Row("untrained", context.untrained, limit=context.settings.untrained),
        ],
        AUDIO_FAMILIES,
        write=partial(_write, context),
        worst=context.settings.worst,
    )


def _write(context: AudioContext, sample: Trajectories, row: int, path: Path) -> dict[str, Any]:
    """A motion of the main row under its song's name and, beside it, the song."""
    dance, sound = sample.dances[row], path.with_suffix(".flac")
    context.write_song(row, sound)
    write_trajectory_npz(dance.motion, path)
    beside = f"{path.parent.name}/{sound.name}"
    return {"title": dance.song, "meter": dance.counted, "sound": beside}


def _draw(context: AudioContext, folder: Path) -> list[dict[str, Any]]:
    """Phases against beats of the first songs and of each sound file, as pictures."""
    shown = [*context.made(0, False)[: context.settings.pictures], *context.played]
    pictures = []
    for number, pair in enumerate(shown, start=1):
        name = f"phase-{number:02d}.png"
        plot_phase(*pair, folder / name)
        pictures.append({"file": name, "title": f"phase and beats: {pair[0].name}"})
    return pictures


# ---------------------------------------------------------------- what was measured with what


def _about_model(context: AudioContext) -> dict[str, Any]:
    card, config = context.generator.model.card, context.generator.model.config
    sampled, scale = context.sampled, config.guidance_scale
    return {
        "model_hash": card.content_hash[:12],
        "sampler": sampled.sampler or config.diffusion.sampler,
        "steps": sampled.steps or config.diffusion.sampling_steps,
        "guidance_scale": scale if sampled.guidance_scale is None else sampled.guidance_scale,
        "window": sampled.window,
        "overlap": sampled.overlap,
        "data": context.data or "none",
    }


def _facts(context: AudioContext) -> Part:
    """What only the songs themselves tell."""
    pieces = context.pieces
    heard = sum(right_tempo(piece) for piece in pieces)
    facts: Part = {
        "songs": f"{len(pieces)} synthetic, {context.settings.song_seconds:g} s, tempi {TEMPI} BPM",
        "tempo_heard_right": f"{heard} of {len(pieces)} songs",
    }
    if context.data is not None:
        facts |= {"data_hash": context.fingerprint[:12], "test_phrases": len(context.reference)}
    return facts


def _sources(context: AudioContext, about: Mapping[str, Any]) -> Sources:
    folders = {name: about[name] for name in ("model", "decoder") if name in about}
    network = context.generator.model
    return Sources(
        model=model_hashes(folders),
        data={"pairs": context.fingerprint, "songs": song_hashes(context.songs)},
        statistics=(network.mean, network.std),
        sampling=context.sampling,
        device=str(context.generator.device),
    )
