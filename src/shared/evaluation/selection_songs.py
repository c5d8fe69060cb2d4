"""Best of N for songs: candidates for held-out synthetic songs, and figures of them.

The judge looks at the sanity suite, whose bands hold mean speeds, turning and accelerations, and
at how the motion's beats fall on those that the tracker heard. So alignment with the true beats and
the kinetic distance (mean speeds and accelerations) are akin to it; outside is the geometric one
(the share of frames in which a pelvis is low, sinks, goes backward, turns left, ...).

Letters: P songs, C candidates of each.
"""

from collections.abc import Callable, Sequence
from dataclasses import asdict, dataclass, replace
from typing import Any

import numpy as np

from ..errors import UserError
from ..metrics.bands import Bands
from ..metrics.kinetic import (
    Features,
    kinetic_columns,
    root_geometric_features,
    root_kinetic_features,
)
from ..metrics.rhythm import against_chance, motion_beats, rhythm
from ..motion.trajectory import FPS, MotionTrajectory
from ..pipelines.ranking import AudioJudge
from ..pipelines.song import AudioCondition, SongGenerator
from ..pipelines.song_sampler import SongSampling
from .audio_songs import Piece, held_out_songs, open_split, phrases
from .selection_harness import Figure, Pool, report_of

KINDS = 5  # kinetic features of a pelvis, each of a unit of its own
HITS = Figure("hits", "hits F, true beats", 3, True, "akin")
DISTANCES = (
    Figure("fid_g", "FID_g, pelvis", 3, False, "outside"),
    Figure("fid_k", "FID_k, pelvis", 3, False, "akin"),
)
Progress = Callable[[str], None]


@dataclass(frozen=True)
class SongSettings:
    """How much is measured; the report repeats it."""

    num_songs: int = 24
    num_candidates: int = 8  # the largest number to choose from
    replications: int = 2
    song_seconds: float = 8.0
    max_real: int = 400  # test phrases
    seed: int = 0


def song_pool(
    generator: SongGenerator,
    judge: AudioJudge,
    pieces: Sequence[Piece],
    real: Sequence[MotionTrajectory],
    *,
    settings: SongSampling,
    progress: Progress = lambda text: None,
) -> Pool:
    """C candidates for each of P songs, measured.

    Args:
        judge: hears the beats that the tracker hears.
        real: motions that distances are taken from; none = no distances.
        settings: C, seed, sampler.
    """
    made: list[list[MotionTrajectory]] = []
    tables = []
    for number, piece in enumerate(pieces, start=1):
        progress(f"candidates for song {number} of {len(pieces)}")
        own = replace(settings, seed=_seed_of_song(settings.seed, number))
        made.append(generator.generate(piece.condition, phase=piece.phase, settings=own))
        heard = AudioCondition(piece.condition).time()
        tables.append(judge.judge(made[-1], None if heard is None else heard[1]))
    names = dict.fromkeys(name for table in tables for name in table.terms)
    nothing = np.full(settings.num_samples, np.nan)
    terms = {n: np.stack([table.terms.get(n, nothing) for table in tables]) for n in names}
    hits = np.array([[_hits(m, p) for m in row] for row, p in zip(made, pieces, strict=True)])
    figures = [HITS, *(Figure(name, name, 3, True, "judge") for name in terms)]
    floors = {"chance": {"hits": _chance(made, pieces, settings.seed)}}
    score = np.stack([table.score for table in tables])
    if not real:
        return Pool(figures, score, {"hits": hits} | terms, floors=floors)
    ours, theirs = [_features(row) for row in made], _features(real)

    return Pool(
        [*DISTANCES, *figures],
        score,
        {"hits": hits} | terms,
        of_set=lambda chosen: _distances(_join(ours, chosen.tolist()), theirs),
        floors={"real": {}, **floors},
        set_floors={"real": _between_halves(theirs, len(pieces), settings.seed)},
    )


def _seed_of_song(seed: int, number: int) -> int:
    """Noise of each song's own: one noise for all would make a replication one draw, not P."""
    return int(np.random.SeedSequence((seed, number)).generate_state(1)[0])


def _hits(trajectory: MotionTrajectory, piece: Piece) -> float:
    found = motion_beats(trajectory.position, trajectory.fps).times
    return rhythm(found, piece.beats, piece.seconds).hits


def _chance(
    made: Sequence[Sequence[MotionTrajectory]], pieces: Sequence[Piece], seed: int
) -> np.ndarray:
    """Hits [P] of the first candidate of each song, moved by random times."""
    found = []
    for index, (row, piece) in enumerate(zip(made, pieces, strict=True)):
        times = motion_beats(row[0].position, row[0].fps).times
        rng = np.random.default_rng([seed, index])
        found.append(against_chance(times, piece.beats, piece.seconds, rng)[1].hits)
    return np.array(found)


# ---------------------------------------------------------------- distances to real motion


def _features(motions: Sequence[MotionTrajectory]) -> Features:
    kinetic = np.stack([root_kinetic_features(motion) for motion in motions])
    geometric = np.stack([root_geometric_features(motion) for motion in motions])
    return Features(kinetic, geometric, np.zeros(len(motions)))


def _rows(features: Features, index: Sequence[int]) -> Features:
    at = list(index)
    return Features(features.kinetic[at], features.geometric[at], features.amount[at])


def _join(songs: Sequence[Features], chosen: Sequence[int]) -> Features:
    """One candidate of each song, side by side."""
    parts = [_rows(song, [place]) for song, place in zip(songs, chosen, strict=True)]
    columns = ("kinetic", "geometric", "amount")
    return Features(*(np.concatenate([getattr(p, name) for p in parts]) for name in columns))


def _distances(ours: Features, theirs: Features) -> dict[str, float]:
    found = kinetic_columns(ours, theirs, kinds=KINDS)
    return {key: float(found[key]) for key in ("fid_g", "fid_k")}


def _between_halves(real: Features, size: int, seed: int) -> dict[str, float]:
    """Of as many real motions as there are songs, from the others."""
    order = np.random.default_rng(seed).permutation(len(real.kinetic)).tolist()
    size = min(size, len(order) // 2)
    return _distances(_rows(real, order[:size]), _rows(real, order[size:]))


# ---------------------------------------------------------------- by names


def evaluate_songs(
    model: str,
    data: str | None = None,
    *,
    bands: Bands | None = None,
    settings: SongSettings | None = None,
    device: str | None = None,
    progress: Progress = lambda text: None,
    **sampling: Any,
) -> dict[str, Any]:
    """Best of N for held-out synthetic songs, by names; see `selection_report`.

    Args:
        model: a shipped name or a folder.
        data: folder or bucket of pairs, whose test split is the real motion; None = none.
        bands: of real motions, for the judge.
        sampling: steps, sampler, guidance_scale; left out = the model's own.

    Raises:
        UserError: no such model, or the data cannot be used.
    """
    settings = settings or SongSettings()
    real: list[MotionTrajectory] = []
    facts: dict[str, Any] = {"model": model, "data": data or "none"}
    if data is not None:
        dataset = open_split(data, "test", round(settings.song_seconds * FPS), settings.seed)
        real = [phrase.motion for phrase in phrases(dataset, settings.max_real)]
        if len(real) < 4:
            raise UserError(
                f"{data}: {len(real)} test phrases are too few to compare with; prepare more songs"
            )
        facts |= {"data_hash": dataset.fingerprint[:12], "real_motions": len(real)}
    generator, judge = SongGenerator.from_pretrained(model, device=device), AudioJudge(bands)
    progress("songs")
    pieces = list(held_out_songs(settings.num_songs, settings.song_seconds, settings.seed))
    number = settings.num_candidates * settings.replications
    sampled = SongSampling(number, seed=settings.seed, **sampling)
    pool = song_pool(generator, judge, pieces, real, settings=sampled, progress=progress)
    card = generator.model.card
    facts |= {
        "model_hash": card.weights.sha256[:12] if card.weights else "",
        "weights": judge.config.model_dump(),
        "bands": f"of {bands.motions} motions" if bands else "none",
        "sampling": {k: v for k, v in sampling.items() if v is not None},
    }
    subjects = f"{len(pieces)} held-out synthetic songs of {settings.song_seconds:g} s"
    return report_of(pool, settings.num_candidates, subjects, facts, asdict(settings))
