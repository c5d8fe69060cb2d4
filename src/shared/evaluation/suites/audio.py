"""The audio suite: does the music matter, and does the motion hold together?

Motions are made for held-out synthetic songs whose beats are known exactly. `AUDIO_FAMILIES` are
measured on them, on the same motions under another song, on frozen and untrained ones, and on real
paired motion, replication by replication. Then phase, alignment and seams, and sound files.

Letters: T frames, N songs.
"""

import io
from collections.abc import Iterator, Mapping
from dataclasses import asdict, dataclass, field, replace
from functools import cached_property, partial
from itertools import pairwise
from pathlib import Path
from typing import Any

import numpy as np

from ...audio.synthetic import render_song
from ...data.phrases.dataset import MotionPhraseDataset
from ...errors import UserError
from ...formats.arrays import write_trajectory_npz
from ...io.files import atomic_write
from ...metrics.rhythm import against_chance, phase_error
from ...metrics.sanity import frozen
from ...metrics.seams import Seamed, marked, seam_report
from ...model.audio.audio_motion_model import AudioMotionModel
from ...motion.trajectory import FPS, MotionTrajectory
from ...pipelines.song import SongGenerator
from ...pipelines.song_sampler import SPARE, SongSampling, spans
from ..engine import Bench, Progress, Row, Suite, run_suite
from ..families import AUDIO_FAMILIES, beats_of
from ..manifest import Part, Parts, Sources, model_hashes, song_hashes
from ..samples import Dance, DanceSample, Memo, Trajectories, untrained_audio_model
from ..tables import Grid, GridRow, Report, beside_null
from .alignment import alignment_grids, phase_row, plot_phase, right_tempo
from .songs import (
    TEMPI,
    Piece,
    dance_of,
    held_out_songs,
    held_out_specs,
    open_split,
    phrases,
    sung,
    tracks,
)

Made = list[tuple[Piece, MotionTrajectory]]
Counted = list[tuple[Piece, np.ndarray]]  # unwrapped bars [T] of each song
UNITS = {"acceleration": "m/s²", "jerk": "m/s³", "angular_acceleration": "rad/s²"}


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
    """A model, songs and motions that are made once, and everything that is measured of them."""

    generator: SongGenerator[AudioMotionModel]  # a trained audio branch
    settings: AudioSettings = field(default_factory=AudioSettings)
    # folder or bucket of pairs, whose test split is the real row; None = no such row
    data: str | None = None
    songs: Path | None = None  # folder of sound files to describe; None = none
    # steps, sampler, guidance_scale; left out or None = the model's own
    sampling: Mapping[str, Any] = field(default_factory=dict)
    progress: Progress = lambda text: None  # told what begins
    memo: Memo = field(default_factory=Memo)

    @cached_property
    def sampled(self) -> SongSampling:
        """How motions are sampled, with nothing left to the model."""
        return SongSampling(**self.sampling).resolved(self.generator.model.config)

    @property
    def amount(self) -> tuple[int, float, int]:
        """Of held-out songs: number, seconds and seed."""
        return self.settings.num_songs, self.settings.song_seconds, self.settings.seed

    @cached_property
    def pieces(self) -> list[Piece]:
        """Held-out synthetic songs."""
        self.progress(f"{self.settings.num_songs} songs of {self.settings.song_seconds:g} s")
        return list(held_out_songs(*self.amount, tell_meter=self.settings.tell_meter))

    def dance(
        self, piece: Piece, *, replication: int = 0, held: bool = True, untrained: bool = False
    ) -> MotionTrajectory:
        """A motion for a song, by the model or by `fresh`; not `held`, it counts for itself."""
        settings = replace(self.sampled, seed=self.settings.seed)
        generator = self.fresh if untrained else self.generator
        heard = piece if held else replace(piece, phase=None)
        return sung(generator, heard, settings, replication)

    def made(self, replication: int, *, untrained: bool = False) -> Made:
        """A motion for each held-out song in a replication, by the model or by `fresh`."""

        def make() -> Made:
            dance = partial(self.dance, replication=replication, untrained=untrained)
            return [(piece, dance(piece)) for piece in self.pieces]

        return self.memo.once(f"made {replication} {untrained}", make)

    @cached_property
    def played(self) -> Made:
        """A motion for each sound file."""
        made: Made = []
        for piece in tracks(self.songs, self.settings.track_seconds) if self.songs else ():
            self.progress(piece.name)
            made.append((piece, self.dance(piece)))
        return made

    @cached_property
    def fresh(self) -> SongGenerator[AudioMotionModel]:
        """The same network with fresh weights, the last layer included."""
        fresh = untrained_audio_model(self.generator.model, self.settings.seed)
        return SongGenerator(fresh, device=str(self.generator.device))

    # ---------------------------------------------------------------- samples

    @cached_property
    def split(self) -> MotionPhraseDataset | None:
        """The test split, in windows as long as the songs; None without data.
        Raises UserError: there is none."""
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
        Raises UserError: no phrase of the split has a beat."""
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

    def sample(self, replication: int, *, untrained: bool = False) -> Trajectories:
        """Motions on their own songs; no real one belongs to a song that was made up."""
        made = self.made(replication, untrained=untrained)
        return DanceSample.of([dance_of(piece, motion) for piece, motion in made])

    def frozen_pose(self, replication: int) -> Trajectories:
        """The first pose of each motion held while the music goes on."""
        return DanceSample.of([dance_of(piece, frozen(motion)) for piece, motion in self.made(0)])

    def bench(self) -> Bench[Trajectories]:
        """The songs: real motion where there is data, its floors, and what the model makes."""
        few, seed = self.settings.untrained, self.settings.seed
        known = None if self.data is not None else 0
        return Bench(
            "songs",
            "held-out songs",
            lambda: self.reference,
            [
                Row("real", lambda replication: self.reference, known, fixed=True, real=True),
                Row("chance", lambda run: self.sample(run).on_other_songs(seed, run)),
                Row("frozen pose", self.frozen_pose, limit=1, fixed=True),
                Row("generated", self.sample),
                Row("untrained", partial(self.sample, untrained=True), limit=few),
            ],
            AUDIO_FAMILIES,
            write=self.write,
            worst=self.settings.worst,
        )

    def write(self, sample: Trajectories, row: int, path: Path) -> dict[str, Any]:
        """A motion of the main row under its song's name and, beside it, the song as FLAC."""
        import soundfile

        dance, beside = sample.dances[row], path.with_suffix(".flac")
        song = render_song(held_out_specs(*self.amount)[row])
        sound = io.BytesIO()  # libsndfile does not say what the disk said
        soundfile.write(sound, song.samples, song.sample_rate, subtype="PCM_16", format="FLAC")
        with atomic_write(beside) as temporary:
            temporary.write_bytes(sound.getvalue())
        write_trajectory_npz(dance.motion, path)
        file = f"{path.parent.name}/{beside.name}"
        return {"title": dance.song, "meter": dance.counted, "sound": file}

    def draw(self, folder: Path) -> list[dict[str, Any]]:
        """Phases against beats of the first songs and of each sound file, as pictures."""
        pictures = []
        shown = [*self.made(0)[: self.settings.pictures], *self.played]
        for number, pair in enumerate(shown, start=1):
            name = f"phase-{number:02d}.png"
            plot_phase(*pair, folder / name)
            pictures.append({"file": name, "title": f"phase and beats: {pair[0].name}"})
        return pictures

    # ---------------------------------------------------------------- tables with rows of their own

    def phase(self) -> list[Grid]:
        """Rows by name, see `phase_row`; "right tempo" are songs whose tempo the tracker found."""
        made, rng = self.made(0), np.random.default_rng([self.settings.seed, 1])
        own = [(piece, motion.phase_unwrapped) for piece, motion in made]
        tracked = [(p, np.asarray(p.phase)) for p, _ in made if p.phase is not None]
        groups: dict[str, Counted] = {
            "generated": own,
            "beat tracker": tracked,
            "generated, right tempo": [pair for pair in own if right_tempo(pair[0])],
            "beat tracker, right tempo": [pair for pair in tracked if right_tempo(pair[0])],
            "own count": self._counted("own count"),
        }
        if self.settings.untrained:
            name = "untrained, own count"
            groups[name] = self._counted(name, untrained=True)
        groups["chance"] = [(piece, bars + rng.random()) for piece, bars in tracked]
        rows = {n: GridRow(phase_row(group), len(group), 1) for n, group in groups.items() if group}
        return [Grid.of("phase of a song", rows, name="phase")]

    def _counted(self, name: str, *, untrained: bool = False) -> Counted:
        """Bars [T] that a network counts for itself, of the first songs."""
        asked = self.pieces[: self.settings.own_count]
        counted: Counted = []
        for number, piece in enumerate(asked, start=1):
            self.progress(f"{name}, song {number} of {len(asked)}")
            motion = self.dance(piece, held=False, untrained=untrained)
            counted.append((piece, motion.phase_unwrapped))
        return counted

    def alignment(self) -> list[Grid]:
        """Generated, real and untrained motion on their own songs, and on what must score less."""
        samples = {"generated": self.sample(0)}
        if self.settings.untrained:
            samples["untrained"] = self.sample(0, untrained=True)
        samples["real"] = self.reference
        found = {n: each.beside("beats", beats_of) for n, each in samples.items() if len(each)}
        return alignment_grids(found, self.settings.seed)

    def seams(self) -> list[Grid]:
        """Accelerations at seams between windows against everywhere else."""
        made = {"": self.made(0)}
        if self.settings.untrained:
            made["untrained"] = self.made(0, untrained=True)
        tables: list[Grid] = []
        window, overlap = self.sampled.window, self.sampled.overlap
        assert window is not None  # resolved
        for name, motions in made.items():
            songs = [Seamed(m, seam_frames(m.num_frames, window, overlap)) for _, m in motions]
            found = seam_report(songs, self.settings.seed)
            tables += _seams(found, name) if "quantities" in found else []
        return tables

    def tracks(self) -> list[Grid]:
        """Sound files against the beats that the tracker heard: descriptive."""
        seed = self.settings.seed
        rows = {piece.name[:40]: GridRow(_track(piece, m, seed)) for piece, m in self.played}
        return [Grid.of("tracks", rows)] if rows else []

    # ---------------------------------------------------------------- what was measured with what

    def about(self) -> dict[str, Any]:
        """Of the model, as it was sampled."""
        card, config = self.generator.model.card, self.generator.model.config
        sampled, scale = self.sampled, config.guidance_scale
        return {
            "model_hash": card.content_hash[:12],
            "sampler": sampled.sampler or config.diffusion.sampler,
            "steps": sampled.steps or config.diffusion.sampling_steps,
            "guidance_scale": scale if sampled.guidance_scale is None else sampled.guidance_scale,
            "window": sampled.window,
            "overlap": sampled.overlap,
            "data": self.data or "none",
        }

    def facts(self) -> Part:
        """What only the songs themselves tell."""
        number, seconds, _ = self.amount
        heard = sum(right_tempo(piece) for piece in self.pieces)
        facts: Part = {
            "songs": f"{number} synthetic, {seconds:g} s, tempi {TEMPI} BPM",
            "tempo_heard_right": f"{heard} of {number} songs",
        }
        if self.data is not None:
            facts |= {"data_hash": self.fingerprint[:12], "test_phrases": len(self.reference)}
        return facts

    def sources(self, about: Mapping[str, Any]) -> Sources:
        """What decides the figures."""
        folders = {name: about[name] for name in ("model", "decoder") if name in about}
        network = self.generator.model
        return Sources(
            model=model_hashes(folders),
            data={"pairs": self.fingerprint, "songs": song_hashes(self.songs)},
            statistics=(network.mean, network.std),
            sampling=self.sampling,
            device=str(self.generator.device),
        )


def seam_frames(num_frames: int, window: int, overlap: int) -> np.ndarray:
    """True [T] where two windows of a song share a frame, and just around."""
    found = spans(num_frames, window - SPARE, overlap)
    return marked(num_frames, ((start, end) for (_, end), (start, _) in pairwise(found)))


def _seams(seams: dict[str, Any], row: str) -> Iterator[Grid]:
    end, of = (f"/{row}", f", {row}") if row else ("", "")
    rows = {}
    for name, found in seams["quantities"].items():
        cells = {key: beside_null(found[f"ratio_{key}"], 3) for key in ("p50", "p95")}
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


def _track(piece: Piece, trajectory: MotionTrajectory, seed: int) -> dict[str, float]:
    cells = {key: float(piece.about[key]) for key in ("tempo", "meter", "confidence")}
    if piece.phase is None:
        return cells
    rng = np.random.default_rng([seed, 3])
    own, chance, off = against_chance(beats_of(trajectory), piece.beats, piece.seconds, rng)
    counted, heard = trajectory.phase_unwrapped, np.asarray(piece.phase)
    return cells | {
        "phase_from_tracker": phase_error(counted * piece.meter, heard * piece.meter).absolute,
        "motion_to_music": own.motion_to_music,
        "music_to_motion": own.music_to_motion,
        "f": own.f,
        "chance": chance.f,
        "half": off.f,
    }


def evaluate_audio(
    context: AudioContext, *, about: Mapping[str, Any] | None = None, folder: Path | None = None
) -> Report:
    """The whole report as plain data; `about` is what to repeat in it (`model` and `decoder` are
    names or folders), in its `folder` finished parts are kept and not measured again.
    Raises UserError: the data or a song cannot be used, or the folder holds another report."""
    about = about or {}
    suite = Suite(
        "audio",
        asdict(context.settings),
        [context.bench()],
        {
            "phase": context.phase,
            "alignment": context.alignment,
            "seams": context.seams,
            "tracks": context.tracks,
        },
        {**about, **context.about()},
        facts=context.facts,
        pictures=context.draw,
        sources=partial(context.sources, about),
    )
    return run_suite(suite, Parts(folder), context.progress)
