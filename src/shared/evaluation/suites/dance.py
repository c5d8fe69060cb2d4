"""The performer's suite: does the whole body hear the music, obey the words, keep its feet?

Rows against families, then beats, seams, and the same path and song danced to different prompts.
Editing by the same mechanism is measured on clips that no training saw.

Letters: T frames, K joints, N songs, S songs of a table, P prompts, W windows of a dance, D
channels of the judge.
"""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import asdict, dataclass, field, replace
from functools import cache, cached_property, partial
from itertools import accumulate, cycle, product
from pathlib import Path
from typing import Any
from zlib import crc32

import numpy as np
from scipy.spatial.distance import cdist, pdist

from ...errors import UserError
from ...formats.arrays import write_npz
from ...memory.figures import FigureMemory
from ...metrics.retrieval import rank_of
from ...metrics.rhythm import body_beats, limb_beats, rhythm
from ...metrics.seams import ORDERS, body_quantities, compare, marked, split, starts
from ...model.audio.audio_motion_model import AudioMotionModel
from ...model.evaluator import Evaluator
from ...model.generation.motion_generator import TextToMotion
from ...motion.motion import Motion
from ...motion.postprocess.contacts import contact_runs
from ...motion.postprocess.footskate import lock_carried_feet, lock_feet
from ...motion.trajectory import FPS, MotionTrajectory, to_motion
from ...pipelines.body import Performer, PerformerSettings
from ...pipelines.choreography import Choreographer, Wish
from ...pipelines.dance import candidate_seed
from ...pipelines.figure_dance import FigureDancer
from ...pipelines.song import SongCondition, SongGenerator, finished
from ...pipelines.song_sampler import SongSampling
from ...pipelines.stream import OVERLAP, WINDOW, Passage, window_lengths
from ..engine import Bench, Progress, Row, Suite, run_suite
from ..families import DANCE_FAMILIES, MOMENTS
from ..manifest import Parts, Sources, model_hashes, song_hashes
from ..samples import Bodies, Dance, DanceSample, Memo, held_still, untrained
from ..stats import Estimate, bootstrap_columns
from ..tables import Grid, GridRow, Report, beside_null
from .alignment import alignment_grids
from .editing import EditContext
from .songs import Piece, captured_dances, held_out_songs, real_dances, sung, tracks

PROMPTS = (
    "a person dances", "a proud person dances", "a young person dances to the music",
    "an old man dances", "a person dances energetically",
)  # fmt: skip
ASKED = (
    "a person dances", "a proud person dances", "an old man dances", "a tired person dances",
    "a person walks happily", "a person runs", "a person waves with the right hand",
    "a person claps",
)  # fmt: skip
NOISES = 2  # dances of each prompt
Dancer = Callable[[int, str, int], Motion]  # song, prompt and noise to a dance


@dataclass(frozen=True)
class DanceSettings:
    """How much is measured; the report repeats it."""

    num_songs: int = 20
    song_seconds: float = 16.0
    replications: int = 5
    untrained: int = 1  # replications of the rows that only have to fail, at most
    max_real: int = 200  # test phrases with bodies
    track_seconds: float = 16.0  # of each sound file
    prompts: tuple[str, ...] = PROMPTS  # song after song
    style_songs: int = 8  # on which the same path is danced to different prompts
    edits: int = 24  # clips that are edited, and pairs of actions that follow each other
    worst: int = 4  # dances to be looked at
    seed: int = 0


@dataclass(frozen=True, eq=False)
class DanceContext:
    """Models, songs, paths and dances that are made once, and all that is measured of them."""

    generator: TextToMotion  # the text branch
    singer: SongGenerator[AudioMotionModel]  # the audio branch, which makes the paths
    judge: Evaluator  # the separate evaluator
    settings: DanceSettings
    # pairs with bodies, whose test split is the real row; None = no such row
    data: str | None = None
    dances: Path | None = None  # folder of captured dances, more of the real row; None = none
    songs: Path | None = None  # folder of sound files; None = synthetic songs alone
    other: TextToMotion | None = None  # another text model, for a row of its own; None = none
    sampling: PerformerSettings = field(default_factory=PerformerSettings)  # of the text branch
    progress: Progress = lambda text: None  # told what begins
    memo: Memo = field(default_factory=Memo)

    @cached_property
    def pieces(self) -> list[Piece]:
        """The sound files, then held-out synthetic songs."""
        settings = self.settings
        amount = settings.num_songs, settings.song_seconds
        self.progress(f"{amount[0]} songs of {amount[1]:g} s")
        found = [] if self.songs is None else list(tracks(self.songs, settings.track_seconds))
        return found + list(held_out_songs(*amount, settings.seed))

    @property
    def num_tracks(self) -> int:
        """How many of the pieces are sound files."""
        return len(self.pieces) - self.settings.num_songs

    def path(self, number: int, replication: int) -> MotionTrajectory:
        """The path of a song in a replication, post-processed as it is pinned."""

        def make() -> MotionTrajectory:
            settings = SongSampling(seed=self.settings.seed)
            return finished(sung(self.singer, self.pieces[number], settings, replication))

        return self.memo.once(f"path {number} {replication}", make)

    # ---------------------------------------------------------------- bodies

    def perform(
        self,
        performer: Performer,
        number: int,
        replication: int,
        prompt: str,
        seed: int | None = None,
        pinned: bool = False,
    ) -> Dance[Motion]:
        """A body that dances to a song; with the `seed` of its replication unless told."""
        piece = self.pieces[number]
        own = self._own_seed(piece, replication if seed is None else seed)
        path = self.path(number, replication) if pinned else None
        if path is not None:
            raw = performer.perform(path, prompt, beats=piece.heard, seed=own).motion
        else:
            passages = [Passage(prompt, piece.num_frames)]
            raw = performer.improvise(passages, beats=piece.heard, seed=own).motion
        seams = near_seams(raw.num_frames)
        motion = lock_carried_feet(raw)
        return Dance(piece.name, motion, piece.beats, raw=raw, path=path, seams=seams)

    def _own_seed(self, piece: Piece, replication: int) -> int:
        return candidate_seed(self.settings.seed, crc32(piece.name.encode()), replication)

    def performer(self, who: str) -> Performer:
        """Puts bodies on paths, their feet not yet held: whoever dances in that row."""
        generator = self.fresh if who == "untrained" else self.generator
        if who == "other" and self.other is not None:
            generator = self.other
        on_beats = who != "beats not told"
        return Performer(generator, replace(self.sampling, foot_lock=False, on_beats=on_beats))

    @cached_property
    def fresh(self) -> TextToMotion:
        """The same denoiser without its training."""
        return untrained(self.generator, self.settings.seed)

    def danced(self, who: str, replication: int) -> Bodies:
        """A dance for each song by one of the performers in a replication."""

        def make() -> Bodies:
            dance = partial(self.perform, self.performer(who), pinned=who == "pinned")
            prompts = zip(range(len(self.pieces)), cycle(self.settings.prompts), strict=False)
            return DanceSample.of([dance(n, replication, prompt) for n, prompt in prompts])

        return self.memo.once(f"danced {who} {replication}", make)

    # ---------------------------------------------------------------- samples

    @cached_property
    def reference(self) -> Bodies:
        """Real bodies of the test split with their music, and captured dances without; or none.
        Raises UserError: the split holds no body with a beat, or a dance cannot be read."""
        settings = self.settings
        frames = round(settings.song_seconds * FPS)
        captured = [] if self.dances is None else list(captured_dances(self.dances, frames))
        dances: list[Dance[Motion]] = []
        if self.data is not None:
            self.progress(f"the test split of {self.data}")
            dances = real_dances(self.data, frames, settings.max_real, settings.seed)
            if not dances:
                raise UserError(
                    f"{self.data}: no test phrase has a body and beats; make the pairs with"
                    " prepare-audio"
                )
        dances += captured
        return DanceSample(dances, np.arange(len(dances)))

    @cached_property
    def choreographer(self) -> Choreographer:
        """Of the shipped figures."""
        return Choreographer(FigureMemory.open())

    def figured(self, replication: int, *, at_random: bool = False) -> Bodies:
        """Dances of recorded figures, chosen or drawn; a song without beats has none."""

        def make() -> Bodies:
            dancer = FigureDancer(self.choreographer, self.generator, at_random=at_random)
            found = []
            for piece in self.pieces:
                heard = np.zeros(0) if piece.heard is None else piece.heard
                song = SongCondition(piece.condition, piece.phase, heard)
                own = self._own_seed(piece, replication)
                sampling = replace(self.sampling, foot_lock=False, seed=own)
                made = dancer.dance(song, Wish(), sampling=sampling, foot_lock=False)
                if made is not None:
                    raw, joins = made[0], [round(figure.start * FPS) for figure in made[1][1:]]
                    near = marked(raw.num_frames, ((at, at) for at in joins))
                    found.append(
                        Dance(piece.name, lock_feet(raw), piece.beats, raw=raw, seams=near)
                    )
            return DanceSample.of(found)

        return self.memo.once(f"figured {at_random} {replication}", make)

    def frozen_pose(self, replication: int) -> Bodies:
        """The first pose of each dance held where it is."""
        dances = self.danced("generated", 0).dances
        return DanceSample.of([Dance(d.song, held_still(d.motion), d.beats) for d in dances])

    def path_alone(self, replication: int) -> Bodies:
        """A statue carried along each path."""
        rows = [(piece, self.path(n, replication)) for n, piece in enumerate(self.pieces)]
        statues = [Dance(p.name, to_motion(path), p.beats, path=path) for p, path in rows]
        return DanceSample.of(statues)

    def bench(self) -> Bench[Bodies]:
        """The songs, danced by the model and its floors, and by real dancers where known."""
        few, danced = self.settings.untrained, self.danced
        hinted = self.generator.network.generation.constraints
        known = None if self.data is not None or self.dances is not None else 0
        seed = self.settings.seed
        return Bench(
            "dances",
            "dances",
            lambda: self.reference,
            [
                Row("real", lambda replication: self.reference, known, fixed=True, real=True),
                Row("generated", partial(danced, "generated")),
                Row("figures", self.figured),
                Row("figures at random", partial(self.figured, at_random=True), limit=few),
                Row("another song", lambda run: danced("generated", run).on_other_songs(seed, run)),
                Row("frozen pose", self.frozen_pose, limit=1, fixed=True),
                Row("pinned", partial(danced, "pinned")),
                Row("path alone", self.path_alone, limit=1, fixed=True),
                Row("beats not told", partial(danced, "beats not told"), few if hinted else 0),
                Row("other model", partial(danced, "other"), few if self.other else 0),
                Row("untrained", partial(danced, "untrained"), limit=few),
            ],
            DANCE_FAMILIES,
            write=write_body,
            worst=self.settings.worst,
        )

    # ---------------------------------------------------------------- tables with rows of their own

    def alignment(self) -> list[Grid]:
        """Whole bodies and limbs on their own songs, and on what must score less."""
        made, number = self.danced("generated", 0), self.num_tracks
        groups = {"whole-body": made, "limbs alone:": made}
        if number:
            groups["sound files, whole-body"] = made.rows(range(number))
            groups["synthetic songs, whole-body"] = made.rows(range(number, len(made)))
        heard = [row for row, dance in enumerate(self.reference.dances) if len(dance.beats)]
        if heard:
            groups["real whole-body"] = self.reference.rows(heard)
        found = {}
        for name, sample in groups.items():
            key = "limbs_" if name.startswith("limbs") else ""
            found[name] = sample.beside(key + "beats", MOMENTS[key])
        return alignment_grids(found, self.settings.seed)

    def seams(self) -> list[Grid]:
        """Accelerations and jerks where windows of the body meet; nothing without real dances."""
        if not len(self.reference):
            return []
        made = self.danced("generated", 0).dances
        rows = {"generated": made, "figures": self.figured(0).dances, "hard cut": hard_cuts(made)}
        if self.settings.untrained:
            rows["untrained"] = self.danced("untrained", 0).dances
        real = [dance.motion for dance in self.reference.dances]
        return seam_grid(rows, real, self.settings.seed)

    def prompts(self) -> list[Grid]:
        """Does the prompt change the dance? Nothing without songs to measure on."""
        songs = list(range(self.num_tracks, len(self.pieces)))[: self.settings.style_songs]
        if not songs:
            return []
        text = self.judge.embed_text(ASKED).numpy()
        rows = {}
        for name, dancer in self.dancers().items():
            self.progress(f"prompts: {name}")
            embeddings, f, limbs_f = self.dance_all(dancer, songs)
            rows[name] = GridRow(effect(embeddings, f, limbs_f, text), f.size, 1)
        words = {"prompts": "; ".join(ASKED), "num": len(ASKED), "noises": NOISES}
        return [Grid.of("prompts", rows, words | {"songs": len(songs)})]

    def dancers(self) -> dict[str, Dancer]:
        """Who dances, by the name of the row."""

        def by(performer: Performer) -> Dancer:
            return lambda song, prompt, noise: (
                self.perform(performer, song, 0, prompt, seed=noise).motion
            )

        def alone(song: int, prompt: str, noise: int) -> Motion:
            seconds = self.path(song, 0).seconds
            (motion,) = self.generator.generate([prompt], seconds=seconds, seed=noise)
            return motion

        own = cache(by(self.performer("generated")))
        found: dict[str, Dancer] = {
            "generated": own,
            "words alone": alone,
            "path alone": lambda song, prompt, noise: to_motion(self.path(song, 0)),
            "frozen pose": lambda song, prompt, noise: held_still(own(song, ASKED[0], noise)),
        }
        if self.settings.untrained:
            found["untrained"] = by(self.performer("untrained"))
        return found

    def dance_all(
        self, dancer: Dancer, songs: Sequence[int]
    ) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """Every song to every prompt with every noise: embeddings [S,P,NOISES,W,D], and what beats
        of bodies and limbs score [S,P·NOISES]."""
        embeddings, scores, limbs = [], [], []
        for song, prompt, noise in product(songs, ASKED, range(NOISES)):
            motion, beats = dancer(song, prompt, noise), self.pieces[song].beats
            embeddings.append(self.judge.embed_windows(motion))
            scores.append(rhythm(body_beats(motion), beats, motion.seconds).f)
            limbs.append(rhythm(limb_beats(motion), beats, motion.seconds).f)
        shape, flat = (len(songs), len(ASKED), NOISES, *embeddings[0].shape), (len(songs), -1)
        return np.reshape(embeddings, shape), np.reshape(scores, flat), np.reshape(limbs, flat)


def write_body(sample: Bodies, row: int, path: Path) -> dict[str, Any]:
    """A dance; its title is the song and what was asked for."""
    dance = sample.dances[row]
    write_npz(dance.motion, path)
    return {"title": f"{dance.song}: {dance.motion.text}"}


# ---------------------------------------------------------------- seams of the body's windows
# There, elsewhere and in mocap, and where they are seen: every window another dancer's (hard cut).

SEAM_TOP = 99  # percentile of real motion that nothing at a seam is to pass


def near_seams(frames: int) -> np.ndarray:
    """True [T] where a window of the body's stream ends, and just around."""
    cuts = list(accumulate(window_lengths(frames, 0, WINDOW, OVERLAP)))[:-1]
    return marked(frames, ((cut, cut) for cut in cuts))


def hard_cuts(dances: Sequence[Dance[Motion]]) -> list[Dance[Motion]]:
    """The dances, each with the poses of the next one from every second seam on."""
    cut = []
    for number, dance in enumerate(dances):
        other = dances[(number + 1) % len(dances)].motion.quaternions
        frames = min(len(other), dance.motion.num_frames)
        own, window = dance.motion.quaternions[:frames], np.zeros(frames, dtype=int)
        for start, stop in [] if dance.seams is None else contact_runs(dance.seams, 0):
            window[(start + stop) // 2 :] += 1  # they change in the middle of seams
        pose = np.where((window % 2 == 1)[:, None, None], other[:frames], own)
        pose[:, 0] = own[:, 0]  # the path stays
        motion = replace(dance.motion.frames(0, frames), quaternions=pose)
        seams = None if dance.seams is None else dance.seams[:frames]
        cut.append(Dance(dance.song, motion, dance.beats, path=dance.path, seams=seams))
    return cut


def seam_grid(
    rows: Mapping[str, Sequence[Dance[Motion]]], real: Sequence[Motion], seed: int
) -> list[Grid]:
    """A row a kind of dance (by name) and quantity; nothing where no dance has a seam. The 99th
    percentile of the `real` motions is the limit."""
    sizes = [body_quantities(motion) for motion in real]
    limits = {
        name: float(np.percentile(np.concatenate([each[name] for each in sizes]), SEAM_TOP))
        for name in ORDERS
    }
    found, counted = dict[str, GridRow](), dict[str, int]()
    for who, dances in rows.items():
        seamed = [(body_quantities(d.motion), d.seams) for d in dances
                  if d.seams is not None and d.seams.any()]  # fmt: skip
        if not counted:  # of the first, which the title tells of
            number = sum(len(starts(seams)) for _, seams in seamed)
            counted = {"seams": number, "dances": len(seamed)} if seamed else {}
        for name, limit in limits.items() if seamed else ():
            pairs = [(values[name], seams) for values, seams in seamed]
            found[f"{name}: {who}"] = GridRow(_cells(pairs, limit, seed), len(seamed), 1)
    return [Grid.of("body-seams", found, counted)] if found else []


def _cells(
    pairs: Sequence[tuple[np.ndarray, np.ndarray]], limit: float, seed: int
) -> dict[str, Any]:
    """One row: quantiles, shares beyond the limit, and the ratio with its intervals."""
    seam, other = split(pairs)
    ratio = compare(pairs, seed)["ratio_p50"]
    return {
        "seam": float(np.percentile(seam, SEAM_TOP)),
        "elsewhere": float(np.percentile(other, SEAM_TOP)),
        "real": limit,
        "beyond_seam": 100 * float((seam > limit).mean()),
        "beyond_elsewhere": 100 * float((other > limit).mean()),
        "ratio": beside_null(ratio, 2),
    }


def effect(
    embeddings: np.ndarray, f: np.ndarray, limbs_f: np.ndarray, text: np.ndarray
) -> dict[str, Estimate]:
    """The cells of a row: means over songs of what `dance_all` returns, with their intervals;
    `text`: the judge's embeddings of the prompts [P,D]."""
    rows = []
    for song, scores, limbs in zip(embeddings.astype(np.float64), f, limbs_f, strict=True):
        prompts, noises, windows, width = song.shape
        apart = np.mean([pdist(song[:, n, w]) for n in range(noises) for w in range(windows)])
        same = np.mean([pdist(song[p, :, w]) for p in range(prompts) for w in range(windows)])
        dances = song.reshape(prompts, noises * windows, width)
        places = np.concatenate([rank_of(cdist(dances[p], text), p) for p in range(prompts)])
        rows.append(
            {
                "apart": float(apart),
                "same": float(same),
                "gain": float(apart - same),
                "r_at_1": float((places < 1).mean()),
                "r_at_3": float((places < 3).mean()),
                "f": float(scores.mean()),
                "limbs_f": float(limbs.mean()),
            }
        )
    return bootstrap_columns(rows)


def evaluate_performer(
    context: DanceContext,
    edits: EditContext | None = None,
    *,
    about: dict[str, Any] | None = None,
    folder: Path | None = None,
) -> Report:
    """The whole report as plain data.

    Args:
        edits: of editing; None = not measured.
        about: what to repeat; `model`, `audio_model` and `other` are names or folders.
        folder: of the report: finished parts are kept there and not measured again.

    Raises UserError: the data or a song cannot be used, or the folder holds another report.
    """
    about = about or {}
    tables: dict[str, Callable[[], list[Grid]]] = {
        "alignment": context.alignment,
        "seams": context.seams,
        "prompts": context.prompts,
    }
    if edits is not None:
        tables |= {
            "edits": edits.kept,
            "paths": edits.paths,
            "transitions": partial(edits.transitions, context.judge),
        }
    facts = {
        **about,
        "evaluator_hash": context.judge.content_hash,
        "data": context.data or "none",
        "clips": "none" if edits is None else edits.held_out.source,
    }
    sources = partial(_sources, context, edits, about)
    amount, bench = asdict(context.settings), context.bench()
    suite = Suite("performer", amount, [bench], tables, facts, sources=sources)
    return run_suite(suite, Parts(folder), context.progress)


def _sources(context: DanceContext, edits: EditContext | None, about: dict[str, Any]) -> Sources:
    named = {name: about[name] for name in ("model", "audio_model", "other") if about.get(name)}
    generator, singer = context.generator, context.singer.model
    return Sources(
        model=model_hashes(named),
        evaluator={"hash": context.judge.content_hash},
        data={
            "pairs": context.data or "",
            "dances": "" if context.dances is None else str(context.dances),
            "songs": song_hashes(context.songs),
            "clips": "" if edits is None else edits.held_out.data.manifest_hash,
        },
        statistics=(generator.mean, generator.std, singer.mean, singer.std),
        sampling=asdict(context.sampling),
        device=str(generator.device),
    )
