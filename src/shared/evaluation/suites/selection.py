"""Best of N: does what the judge chose look better to those the judge does not listen to?

Every candidate is measured once; rows differ in which candidates they take. The best of n is the
judge's choice among n that follow each other: of 32 there are 32 choices of one and four of eight.
Each choice for all subjects (prompts or songs) is a replication: intervals of rows say what other
noise would give. What the largest size gains over single candidates is resampled over subjects: it
says what other subjects would give.

A figure is *outside* (nothing of it enters the judge), *akin* (another measure of something that
the judge does look at) or the judge's own. Only outside figures count for the verdict.

Letters: P subjects, C candidates of each, N the largest number to choose from, G choices, D
embedding channels.
"""

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import asdict, dataclass, field, replace
from pathlib import Path
from typing import Any, Literal

import numpy as np

from ...errors import UserError
from ...metrics import kinetic
from ...metrics.retrieval import BATCH, TOP, in_batches
from ...metrics.rhythm import against_chance, motion_beats, rhythm
from ...metrics.sanity import Bands
from ...model.evaluator import Evaluator
from ...model.generation.motion_generator import TextToMotion
from ...motion.motion import Motion
from ...motion.trajectory import FPS, MotionTrajectory
from ...pipelines.ranking import AudioJudge, PromptSampler, TextJudge, load_tower, own_tower
from ...pipelines.song import AudioCondition, SongGenerator, own_noise
from ...pipelines.song_sampler import SongSampling
from ..engine import Progress, Value
from ..families import OBEDIENCE, PHYSICS, TRAVEL
from ..samples import Clips, MotionSample, open_held_out, real_clips
from ..stats import Estimate, bootstrap_mean, replicated
from ..tables import WORDS, Column, Grid, GridRow, Report, report_data
from .songs import Piece, held_out_songs, open_split, phrases

Role = Literal["outside", "akin", "judge"]
Chosen = np.ndarray  # [P], which candidate of each subject


@dataclass(frozen=True)
class Figure:
    """One column; `higher`: more is better."""

    key: str
    heading: str
    decimals: int
    higher: bool
    role: Role


@dataclass(frozen=True, eq=False)
class Pool:
    """Everything measured of P x C candidates."""

    figures: Sequence[Figure]
    score: np.ndarray  # the judge's, [P,C]
    # figures of single candidates [P,C]; NaN where nothing is asked
    values: Mapping[str, np.ndarray]
    # figures that depend on what was chosen for the others: [P] of each subject, or one of all
    together: Callable[[Chosen], Mapping[str, Value]] = lambda chosen: {}
    # rows to stand beside, by name: figures [P'] by key, or one of a whole set
    floors: Mapping[str, Mapping[str, Value]] = field(default_factory=dict)

    def under(self, chosen: Chosen) -> dict[str, Value]:
        """Every figure under one choice: [P] of each subject, or one of all."""
        rows = np.arange(len(self.score))
        found = {key: values[rows, chosen] for key, values in self.values.items()}
        return {**found, **self.together(chosen)}


def sizes(largest: int) -> list[int]:
    """1, 2, 4, ... and the largest."""
    return [*(2**k for k in range((largest - 1).bit_length())), largest]


def choices(score: np.ndarray, size: int) -> list[Chosen]:
    """The highest of each run of `size` candidates of score [P,N]; what is left over is unused."""
    number = score.shape[1] // size
    runs = score[:, : number * size].reshape(len(score), number, size)
    return list((runs.argmax(2) + np.arange(number) * size).T)


def measured(
    pool: Pool, chosen: Sequence[Chosen]
) -> tuple[dict[str, np.ndarray], dict[str, Estimate]]:
    """Figures [P] of each subject, the mean over the choices, and of each choice as a whole."""
    found = [pool.under(choice) for choice in chosen]
    figures = {key: np.stack([one[key] for one in found]) for key in found[0]}  # G P, or G
    single = {key: values for key, values in figures.items() if values.ndim == 2}
    subjects = {key: np.array([_mean(c) for c in values.T]) for key, values in single.items()}
    whole = {key: [_mean(choice) for choice in values] for key, values in figures.items()}
    return subjects, {key: replicated(values) for key, values in whole.items()}


def _mean(values: np.ndarray) -> float:
    """Mean of what is known; NaN if nothing is."""
    known = values[~np.isnan(values)]
    return float(known.mean()) if len(known) else float("nan")


def selection_report(pool: Pool, largest: int) -> Report:
    """Rows of figures, and what the best of `largest` N gains over a single candidate.

    Returns:
        rows: name to figures, each an `Estimate` as a dict: floors, `best of n`, `worst of N`;
        gains: figure to its `role`, whether best of N is `better` than best of 1 and their
        intervals `apart` (never with one replication), and, but for whole sets, the paired
        `difference`;
        outside_apart: keys of outside figures that are better with intervals apart.
    """
    taken = {f"best of {size}": choices(pool.score, size) for size in sizes(largest)}
    taken[f"worst of {largest}"] = choices(-pool.score, largest)
    found = {name: measured(pool, chosen) for name, chosen in taken.items()}
    estimates = {
        name: {k: bootstrap_mean(v) if isinstance(v, np.ndarray) else replicated([v])
               for k, v in floor.items()}
        for name, floor in pool.floors.items()
    } | {name: whole for name, (_, whole) in found.items()}  # fmt: skip
    rows = {name: {k: asdict(e) for k, e in each.items()} for name, each in estimates.items()}
    (one, _), (many, _) = found["best of 1"], found[f"best of {largest}"]
    gains: dict[str, dict[str, Any]] = {}
    for figure in pool.figures:
        key, higher = figure.key, figure.higher
        cells = rows["best of 1"][key], rows[f"best of {largest}"][key]
        low, high = cells if higher else cells[::-1]
        several = min(cell["count"] for cell in cells) > 2
        gains[key] = {
            "role": figure.role,
            "better": bool(low["value"] < high["value"]),
            "apart": bool(several and low["high"] < high["low"]),
        }
        if key in many:
            gain = asdict(bootstrap_mean(many[key] - one[key]))
            gains[key]["difference"] = gain
            # Replications share their prompts: alone they say nothing of other prompts.
            gains[key]["apart"] &= gain["low"] > 0 if higher else gain["high"] < 0
    outside = [key for key, gain in gains.items() if gain["role"] == "outside" and gain["apart"]]
    return {"rows": rows, "gains": gains, "outside_apart": outside}


def report_of(
    pool: Pool, largest: int, subjects: str, about: dict[str, Any], settings: dict[str, Any]
) -> Report:
    """`selection_report` with what it was measured on, as plain data; `subjects` in the titles."""
    found = selection_report(pool, largest)
    apart = ", ".join(found["outside_apart"]) or "none"
    return report_data(
        "selection",
        about,
        settings,
        list(selection_grids(found, pool.figures, subjects)),
        title="Best of N",
        notes=[f"outside figures that are better, intervals apart: {apart}"],
        subjects=subjects,
        figures=[asdict(figure) for figure in pool.figures],
        **found,
    )


def selection_grids(found: Report, figures: Sequence[Figure], subjects: str) -> Iterator[Grid]:
    """One table a role: rows as `selection_report` has them, and the gain below."""
    last = [name for name in found["rows"] if name.startswith("best of ")][-1]
    gains = {
        key: {"value": None, **gain.get("difference", {}), "apart": gain["apart"]}
        for key, gain in found["gains"].items()
    }
    rows = {name: GridRow(cells) for name, cells in found["rows"].items()}
    rows[f"{last} less best of 1"] = GridRow(gains)
    for role, title in WORDS["selection"]["roles"].items():
        columns = [
            Column(f.key, f"{f.heading} {'↑' if f.higher else '↓'}", f.decimals)
            for f in figures
            if f.role == role
        ]
        if columns:
            title = f"{title} ({subjects})"
            yield Grid.of("selection", rows, name=role, title=title, columns=tuple(columns))


# ---------------------------------------------------------------- prompts

BATCHINGS = 20  # random batches of 32 that each prompt's R-precision is the mean of
PROMPTS_AT_ONCE = 8
FIGURES = tuple(Figure(*each) for each in WORDS["selection"]["prompts"])


@dataclass(frozen=True)
class PromptSettings:
    """How much is measured; the report repeats it."""

    num_prompts: int = 64
    num_candidates: int = 8  # the largest number to choose from
    replications: int = 4
    split: str = "seen"  # label combinations: seen or unseen in training
    max_frames: int = 64
    language: str = "en"
    seed: int = 0


def prompt_pool(
    best_of: PromptSampler,
    evaluator: Evaluator,
    clips: Clips,
    *,
    num_candidates: int,
    seed: int,
    progress: Progress = lambda text: None,
    **sampling: Any,
) -> Pool:
    """C candidates for each of P ≥ 32 captions at their clips' lengths, measured; the evaluator is
    trained apart from generator and judge. `sampling` as in `evaluate_prompts`."""
    made: list[list[Motion]] = []
    tables = []
    seconds = [frames / best_of.generator.card.fps for frames in clips.num_frames]
    for start in range(0, len(clips), PROMPTS_AT_ONCE):
        progress(f"candidates for prompt {start + 1} of {len(clips)}")
        part = slice(start, start + PROMPTS_AT_ONCE)
        asked = {"seconds": seconds[part], "return_all": True, "seed": seed, **sampling}
        for result in best_of.sample(clips.captions[part], num_candidates, **asked):
            assert result.all_candidates is not None
            made.append(result.all_candidates)
            tables.append(result.table)
    progress("measuring")
    terms = {name: np.stack([table.terms[name] for table in tables]) for name in tables[0].terms}
    text, rows = evaluator.embed_text(clips.captions).numpy(), np.arange(len(clips))
    prompt, bodies = rows.repeat(num_candidates), [motion for row in made for motion in row]
    embedded = evaluator.embed_motion(bodies).numpy()
    candidates = replace(clips.rows(prompt.tolist()), motions=bodies)
    sample = MotionSample.of(candidates, text[prompt], embedded, prompt)
    real = MotionSample.of(clips, text, evaluator.embed_motion(clips.motions).numpy(), rows)
    order = np.random.default_rng(seed).permutation(len(clips)).tolist()
    chance = sample.rows(range(0, len(sample), num_candidates)).reordered(order)
    floors = {
        name: _singles(each, real) | _retrieval(text, each.motion, clips, seed)
        for name, each in (("real", real), ("chance", chance))
    }
    for key in ("speed_error", "turn_error"):
        del floors["real"][key]  # a clip has no travel error against itself
    shape = len(clips), num_candidates
    single = {key: values.reshape(shape) for key, values in _singles(sample, real).items()}
    places = embedded.reshape(*shape, -1)
    return Pool(
        figures=[*FIGURES, *(Figure(name, name, 3, True, "judge") for name in terms)],
        score=np.stack([table.score for table in tables]),
        values=single | terms,
        together=lambda chosen: _retrieval(text, places[rows, chosen], clips, seed),
        floors=floors,
    )


def _singles(sample: MotionSample, real: MotionSample) -> dict[str, np.ndarray]:
    """Figures [N] of each motion by itself, as the text suite's families have them."""
    apart = np.linalg.norm(sample.text.astype(np.float64) - sample.motion, axis=1)
    found: dict[str, Value] = {"matching_distance": apart}
    for family in (OBEDIENCE, TRAVEL, PHYSICS):
        found |= family.compute(sample, real, seed=0)
    keys = "speed_error", "turn_error", "support_slide", "hand_jerk", "matching_distance"
    names = {"obeys": "obeys_all"} | {key: key for key in keys}
    return {name: np.asarray(found[key]) for name, key in names.items()}


def _retrieval(
    text: np.ndarray, motion: np.ndarray, clips: Clips, seed: int
) -> dict[str, np.ndarray]:
    """Each prompt's R-precision [P] at 1 and 3, the mean over random batches of 32; motions of the
    same label group or caption are hits, as in `guo_retrieval`."""
    hits, seen = np.zeros((len(TOP), len(text))), np.zeros(len(text))
    equal_by = clips.groups, clips.captions
    for batching in range(BATCHINGS):
        for rows, right in in_batches(text, motion, equal_by, [seed, batching]):
            hits[:, rows] += right
            seen[rows] += 1
    rates = np.divide(hits, seen, out=np.full_like(hits, np.nan), where=seen > 0)
    return {"r_at_1": rates[0], "r_at_3": rates[2]}


def evaluate_prompts(
    model: str,
    data: str = "synthetic",
    *,
    judge: str | None = None,
    evaluator: str = "evaluator",
    cache: Path = Path("runs"),
    settings: PromptSettings | None = None,
    device: str | None = None,
    progress: Progress = lambda text: None,
    **sampling: Any,
) -> Report:
    """Best of N for the captions of held-back clips, by names; see `selection_report`.

    Args:
        model, evaluator: shipped names or folders.
        data: prepared folder (its test splits), or "synthetic" (fresh clips, kept in `cache`).
        judge: folder of `train_clip`; None = the model's own where one is shipped.
        sampling: steps, sampler, guidance_scale; left out = the model's own.

    Raises UserError: no such model, tower, evaluator or data, or too few clips.
    """
    settings = settings or PromptSettings()
    outside = Evaluator.from_pretrained(evaluator)
    generator = TextToMotion.from_pretrained(model, device=device)
    tower = own_tower(generator.text) if judge is None else load_tower(judge, generator.text)
    held_out = open_held_out(data, cache, outside.trained_groups)
    amount = {"num": settings.num_prompts, "max_frames": settings.max_frames}
    records, language = held_out.records[settings.split], settings.language
    clips = real_clips(held_out.data, records, **amount, language=language, seed=settings.seed)
    if len(clips) < BATCH:
        raise UserError(
            f"{data}: {len(clips)} clips of {settings.split} are fewer than {BATCH}"
            "; prepare more clips"
        )
    best_of = PromptSampler(generator, TextJudge(tower))
    number = settings.num_candidates * settings.replications
    amount = {"num_candidates": number, "seed": settings.seed}
    pool = prompt_pool(best_of, outside, clips, **amount, progress=progress, **sampling)
    about = {
        "model": model,
        "model_hash": generator.card.content_hash[:12],
        "judge": judge or ("shipped" if tower else "none: feet and smoothness only"),
        "weights": best_of.judge.config.model_dump(),
        "evaluator": evaluator,
        "evaluator_hash": outside.content_hash,
        "data": held_out.source,
        "data_hash": held_out.data.manifest_hash[:12],
        "sampling": {name: value for name, value in sampling.items() if value is not None},
    }
    subjects = f"{len(clips)} prompts, {settings.split} label combinations"
    return report_of(pool, settings.num_candidates, subjects, about, asdict(settings))


# ---------------------------------------------------------------- songs

KINDS = 5  # kinetic features of a pelvis, each of a unit of its own
HITS, *DISTANCES = (Figure(*each) for each in WORDS["selection"]["songs"])


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
    generator: SongGenerator[Any],
    judge: AudioJudge,
    pieces: Sequence[Piece],
    real: Sequence[MotionTrajectory],
    *,
    settings: SongSampling,
    progress: Progress = lambda text: None,
) -> Pool:
    """C candidates for each of P songs, measured; `settings`: C, seed, sampler. The judge hears the
    beats that the tracker hears. Distances are taken from the `real` motions, where there are."""
    made: list[list[MotionTrajectory]] = []
    tables = []
    for number, piece in enumerate(pieces, start=1):
        progress(f"candidates for song {number} of {len(pieces)}")
        # Noise of each song's own: one noise for all would make a replication one draw, not P.
        own = own_noise(settings, number)
        made.append(generator.generate(piece.condition, phase=piece.phase, settings=own))
        heard = AudioCondition(piece.condition).time()
        tables.append(judge.judge(made[-1], None if heard is None else heard[1]))
    names = dict.fromkeys(name for table in tables for name in table.terms)
    nothing = np.full(settings.num_samples, np.nan)
    terms = {n: np.stack([table.terms.get(n, nothing) for table in tables]) for n in names}
    hits, chance = [], []  # chance: the first candidate of each song, moved by random times
    for index, (row, piece) in enumerate(zip(made, pieces, strict=True)):
        beats = [motion_beats(m.position, m.fps).times for m in row]
        music, rng = (piece.beats, piece.seconds), np.random.default_rng([settings.seed, index])
        hits.append([rhythm(times, *music).hits for times in beats])
        chance.append(against_chance(beats[0], *music, rng)[1].hits)
    figures = [HITS, *(Figure(name, name, 3, True, "judge") for name in terms)]
    score, floors = np.stack([table.score for table in tables]), {"hits": np.array(chance)}
    pool = Pool(figures, score, {"hits": np.array(hits)} | terms, floors={"chance": floors})
    if not real:
        return pool
    ours, known = [_features(row) for row in made], _features(real)
    order = np.random.default_rng(settings.seed).permutation(len(real))
    size = min(len(pieces), len(real) // 2)  # as many real motions as songs, from the others
    halves = ([known[at] for at in part] for part in (order[:size], order[size:]))

    def together(chosen: Chosen) -> dict[str, float]:
        """Of one candidate of each song, side by side."""
        return _distances([song[at] for song, at in zip(ours, chosen, strict=True)], known)

    return replace(
        pool,
        figures=[*DISTANCES, *figures],
        together=together,
        floors={"real": _distances(*halves), **pool.floors},
    )


def _features(motions: Sequence[MotionTrajectory]) -> list[kinetic.Features]:
    """Of each motion as a whole; how much it moves counts for nothing here."""
    moves, poses = kinetic.root_kinetic_features, kinetic.root_geometric_features
    return [(moves(motion), poses(motion), 0.0) for motion in motions]


def _distances(
    ours: Sequence[kinetic.Features], theirs: Sequence[kinetic.Features]
) -> dict[str, float]:
    found = kinetic.kinetic_columns(kinetic.stacked(ours), kinetic.stacked(theirs), kinds=KINDS)
    return {key: float(found[key]) for key in ("fid_g", "fid_k")}


def evaluate_songs(
    model: str,
    data: str | None = None,
    *,
    bands: Bands | None = None,
    settings: SongSettings | None = None,
    device: str | None = None,
    progress: Progress = lambda text: None,
    **sampling: Any,
) -> Report:
    """Best of N for held-out synthetic songs, by names; see `selection_report`.

    Args:
        model: a shipped name or a folder.
        data: folder or bucket of pairs, whose test split is the real motion; None = none.
        bands: of real motions, for the judge.
        sampling: steps, sampler, guidance_scale; left out = the model's own.

    Raises UserError: no such model, or the data cannot be used.
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
    facts |= {
        "model_hash": generator.model.card.content_hash[:12],
        "weights": judge.config.model_dump(),
        "bands": f"of {bands.motions} motions" if bands else "none",
        "sampling": {k: v for k, v in sampling.items() if v is not None},
    }
    subjects = f"{len(pieces)} held-out synthetic songs of {settings.song_seconds:g} s"
    return report_of(pool, settings.num_candidates, subjects, facts, asdict(settings))
