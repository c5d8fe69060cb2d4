"""Candidates for one prompt or song: scores in [0, 1], and a ranking, the best first.

Each candidate has terms, higher is better. Its score is their mean with the weights of
`SelectionConfig`; each failed check costs 2, more than everything else can earn. The first choice
is the highest score. Each later one is the highest score plus `distance` times how far the
candidate is from the nearest of those already chosen, so that the second best is not the best once
more (greedy maximal marginal relevance, Carbonell and Goldstein 1998). The terms:

- similarity: cosine of prompt and motion in the shared text-motion space, 0 where negative. Needs
  the motion tower that the generator's text tower was trained with; without one it is left out.
- feet: mean of two margins, of the feet's slide in contact and of their depth below the floor.
- smoothness: margin of the mean jerk of all joints.
- sanity: mean margin of the suite's checks of a path (`src.shared.metrics.sanity`).
- beats: mean of both directions of beat alignment; left out where the song has no known beat.

A margin is 1 for whatever real motion does (up to the 95th percentile of 300 mocap and synthetic
clips) and falls to 0 at three times that, ten times for the depth. It must not go on rising below:
the smoothest jump does not jump. A motion with a value that is not finite fails a check.

Letters: N candidates, T frames, J points, K joints or rows, D width of the shared space, M beats.
"""

import math
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from pydantic import Field

from ..config_schema import Config
from ..errors import UserError
from ..metrics.physical import contact_slide, mean_jerk, penetration
from ..metrics.rhythm import Alignment, alignment, chance_alignment, motion_beats
from ..metrics.sanity import Bands, CheckResult, SanityChecker
from ..model.checkpoint import list_models, read_card, resolve_model
from ..model.generation.motion_generator import TextToMotion
from ..motion.features import encode_features
from ..motion.motion import Motion
from ..motion.trajectory import MotionTrajectory
from ..tensors import Tensor, torch
from .clause import Clause
from .text import SentenceGenerator

if TYPE_CHECKING:
    from ..model.audio.shared_space import MotionTower
    from ..model.clip.core import TextTower
    from .body import Performance

FAILURE = 2.0  # what each failed check costs
MAX_FRAMES = 256  # of a candidate that its distance to others looks at, evenly spread


class SelectionConfig(Config):
    """Weight of each term; a term that the judge cannot make (no beat, no tower) is left out."""

    similarity: float = Field(1.0, ge=0)  # text: cosine of prompt and motion in the shared space
    feet: float = Field(0.5, ge=0)  # text: feet that neither slide nor sink
    smoothness: float = Field(0.5, ge=0)  # text: no more jerk than real motion has
    sanity: float = Field(1.0, ge=0)  # audio: margins of the sanity suite
    beats: float = Field(1.0, ge=0)  # audio: slow moments on the beats, both ways
    distance: float = Field(0.25, ge=0)  # from those already chosen; never decides the first


@dataclass(frozen=True, eq=False)
class ScoreTable:
    """What was found of N candidates, in the order they were sampled.

    Attributes:
        terms: name to values [N] in [0, 1].
        failed: checks that each candidate fails, [N].
        score: weighted mean of the terms less 2 for each failed check, [N].
        order: candidates by rank, the best first, [N].
        distance: of each candidate from the nearest of those ranked before it, in [0, 1]; NaN for
            the best, [N].
        weights: of the terms that there are, and of the distance.
    """

    terms: dict[str, np.ndarray]
    failed: np.ndarray
    score: np.ndarray
    order: np.ndarray
    distance: np.ndarray
    weights: dict[str, float]

    @property
    def best(self) -> int:
        """The first choice."""
        return int(self.order[0])

    def rows(self) -> list[dict[str, Any]]:
        """Plain values for JSON, best first: rank, sample, score, failed, each term, distance."""
        return [
            {
                "rank": rank,
                "sample": int(index),
                "score": round(float(self.score[index]), 6),
                "failed": int(self.failed[index]),
                **{name: round(float(values[index]), 6) for name, values in self.terms.items()},
                "distance": None if rank == 1 else round(float(self.distance[index]), 6),
            }
            for rank, index in enumerate(self.order, start=1)
        ]


def rank(
    terms: Mapping[str, np.ndarray],
    failed: np.ndarray,
    distance_from: Callable[[int], np.ndarray],
    config: SelectionConfig | None = None,
) -> ScoreTable:
    """Rank N ≥ 1 candidates.

    Args:
        terms: values [N] in [0, 1] by the names of `SelectionConfig`; what is not finite is 0.
        failed: checks that each fails, [N].
        distance_from: distances [N] in [0, 1] of all candidates from one.
        config: weights.

    Equal candidates keep the order they were sampled in.
    """
    config = config or SelectionConfig()
    clean = {name: np.nan_to_num(np.asarray(values), nan=0.0) for name, values in terms.items()}
    weights = {name: float(getattr(config, name)) for name in clean}
    total = sum(weights.values()) or 1.0
    number = len(failed)
    mean = sum((weights[name] / total * values for name, values in clean.items()), np.zeros(number))
    score = mean - FAILURE * np.asarray(failed)
    order, distance = _greedy(score, distance_from, config.distance)
    weights["distance"] = config.distance
    return ScoreTable(clean, np.asarray(failed), score, order, distance, weights)


def unranked() -> ScoreTable:
    """Of one candidate: there is nothing to judge."""
    return rank({}, np.zeros(1, dtype=int), lambda chosen: np.zeros(1))


def _greedy(
    score: np.ndarray, distance_from: Callable[[int], np.ndarray], weight: float
) -> tuple[np.ndarray, np.ndarray]:
    """Order [N], and the distance [N] at which each was chosen."""
    number = len(score)
    left = np.ones(number, dtype=bool)
    nearest, at = np.full(number, np.inf), np.full(number, np.nan)
    order = [int(score.argmax())]
    while len(order) < number:
        left[order[-1]] = False
        nearest = np.minimum(nearest, distance_from(order[-1]))
        gain = np.where(left, score + weight * nearest, -np.inf)
        order.append(int(gain.argmax()))
        at[order[-1]] = nearest[order[-1]]
    return np.array(order), at


def distances(points: np.ndarray, scale: float) -> Callable[[int], np.ndarray]:
    """How far candidates are from each other, for `rank`.

    1 - exp(-d / scale), d the mean distance of the same point at the same frame: 0 for the same
    motion, 0.63 for points `scale` apart, never more than 1.

    Args:
        points: [N,T,J,3], metres.
        scale: metres.
    """
    every = -(-points.shape[1] // MAX_FRAMES)
    kept = points[:, ::every]

    def distance_from(chosen: int) -> np.ndarray:
        apart = np.linalg.norm(kept - kept[chosen], axis=-1).mean((1, 2))
        return np.asarray(-np.expm1(-np.nan_to_num(apart) / scale))

    return distance_from


SLIDE = (9.0, 27.0)  # cm/s: where the margin begins to fall, and where it is 0
DEPTH = (0.5, 5.0)  # cm below the floor; real feet are never deeper than 0.1
JERK = (400.0, 1200.0)  # m/s³
SCALE = 0.5  # metres between joints that count as far apart


# ---------------------------------------------------------------- how far within its bounds
# The margin of a failed check is 0. Of a passed one:
# - a figure with a band of real motions: 1 inside the band (5th to 95th percentile), falling with
#   the logarithm to 0 at the limits (the band with its slack);
# - jerk and roughness: 1 up to the 95th percentile of real motions, falling likewise to 0 at the
#   bound. They must not go on rising below, or the tamest motion is the best;
# - a figure below a bound of which no band is known, or that is 0 by right: 1 - value / bound;
# - anything else: 1.
LIVELY = ("jerk", "roughness")
BELOW = (*LIVELY, "velocity_coherence", "accel_coherence")


def margin(result: CheckResult) -> float:
    """How far within its bounds a check stays, in [0, 1]: rules above."""
    if not result.passed:
        return 0.0
    value, bound = result.value, result.threshold
    if result.name in BELOW:
        assert not isinstance(value, tuple) and not isinstance(bound, tuple)
        if result.band and result.name in LIVELY:
            return share(value, bound, result.band[1])
        return 1.0 - value / bound
    if result.name.startswith("band_"):
        assert not isinstance(value, tuple) and isinstance(bound, tuple) and result.band
        side = 0 if value < result.band[0] else 1
        return share(value, bound[side], result.band[side])
    return 1.0


def mean_margin(results: Iterable[CheckResult]) -> float:
    """Mean margin of one motion's checks, at least one."""
    margins = [margin(result) for result in results]
    return sum(margins) / len(margins)


def share(value: float, limit: float, edge: float) -> float:
    """1 at the edge of what real motion has and on its far side, 0 at the limit and beyond, falling
    with the logarithm between them. Limit and edge are above 0; any value will do."""
    if (value - edge) * (limit - edge) <= 0:
        return 1.0
    if (value - limit) * (limit - edge) >= 0:
        return 0.0
    return math.log(value / limit) / math.log(edge / limit)


# ---------------------------------------------------------------- judges

Tower = Callable[[Tensor], Tensor]  # raw features [N,T,K,6] -> unit vectors [N,D]


class TextJudge:
    """Scores candidates for a prompt.

    Args:
        tower: motions into the space of the generator's text tower; None = no similarity.
        config: weights.
    """

    def __init__(self, tower: Tower | None = None, config: SelectionConfig | None = None) -> None:
        self.tower, self.config = tower, config or SelectionConfig()

    def judge(self, candidates: Sequence[Motion], prompt: Tensor) -> ScoreTable:
        """Rank motions of equal length made for one prompt.

        Args:
            candidates: N ≥ 1, T frames each.
            prompt: its embedding [D], unit-norm.
        """
        points = np.stack([motion.positions() for motion in candidates])  # N T K 3
        bodies = [
            _body(positions.astype(np.float64), motion.fps)
            for positions, motion in zip(points, candidates, strict=True)
        ]
        terms = {name: np.array([body[name] for body in bodies]) for name in bodies[0]}
        if self.tower is not None:
            features = torch.stack([encode_features(motion) for motion in candidates])
            with torch.inference_mode():
                cosine = self.tower(features).cpu() @ prompt.detach().float().cpu()
            terms = {"similarity": cosine.clip(0, 1).numpy().astype(np.float64)} | terms
        failed = ~np.isfinite(points).all((1, 2, 3))
        return rank(terms, failed.astype(int), distances(points, SCALE), self.config)


def _body(positions: np.ndarray, fps: float) -> dict[str, float]:
    """Terms of one motion [T,K,3] that need no prompt; feet that never touch the floor slide 0."""
    slide = float(np.nan_to_num(contact_slide(positions, fps)))
    jerk = float(np.nan_to_num(mean_jerk(positions, fps)))
    feet = _margin(slide, SLIDE) + _margin(penetration(positions), DEPTH)
    return {"feet": feet / 2, "smoothness": _margin(jerk, JERK)}


def _margin(value: float, bounds: tuple[float, float]) -> float:
    return share(value, bounds[1], bounds[0])


def load_tower(name_or_folder: str | Path, text: "TextTower") -> "MotionTower":
    """The motion tower of a folder that `train_clip`, `train_text` or `train_audio_tower` wrote.

    Args:
        name_or_folder: of the model, or a shipped shared space.
        text: the generator's, which it must have been trained with.

    Raises:
        UserError: no such model, another kind, damaged, or trained with another text tower.
    """
    from ..model.audio import shared_space
    from ..model.audio.shared_space import MotionTower, SharedSpace
    from ..model.clip import pretrained
    from ..model.clip.pretrained import ClipBundle, tower_hash

    folder = resolve_model(name_or_folder)
    kind = read_card(folder).kind
    if kind == shared_space.KIND:
        space = SharedSpace.from_pretrained(folder)
        tower, trained_with = space.motion, space.card.text_tower
    elif kind == pretrained.KIND:
        bundle = ClipBundle.from_pretrained(folder)
        tower, trained_with = MotionTower.of(bundle), tower_hash(bundle.clip.text)
    else:
        raise UserError(
            f"{folder} holds a {kind}, which has no motion tower; name the folder of train_clip,"
            " or of train_text, that the generator's text tower comes from"
        )
    if trained_with != tower_hash(text):
        raise UserError(
            f"{folder} was trained with another text tower than the generator's, so prompts and"
            " motions cannot be compared; name the CLIP folder that the generator was trained from"
        )
    return tower


def own_tower(text: "TextTower") -> "MotionTower | None":
    """The motion tower of the first listed shared space that a text tower belongs to, or None."""
    from ..model.audio.shared_space import KIND, SharedSpace
    from ..model.clip.pretrained import tower_hash

    own = tower_hash(text)
    for row in list_models():
        if row["kind"] == KIND:
            space = SharedSpace.from_pretrained(row["name"])
            if space.card.text_tower == own:
                return space.motion
    return None


PATH_SCALE = 2.0  # metres between paths that count as far apart
AHEAD = 1.0  # metres: two motions on one path that face apart are apart as well


class AudioJudge:
    """Scores candidates for a song.

    Args:
        bands: of real motions, usually `bands.json` beside the weights; None = built-in bounds.
        config: weights.
    """

    def __init__(self, bands: Bands | None = None, config: SelectionConfig | None = None) -> None:
        self.checker, self.config = SanityChecker(bands=bands), config or SelectionConfig()

    def judge(
        self, candidates: Sequence[MotionTrajectory], beats: np.ndarray | None = None
    ) -> ScoreTable:
        """Rank trajectories of equal length made for one song.

        Args:
            candidates: N ≥ 1 as the decoder gave them, T frames each.
            beats: seconds [M], ascending; None or none at all = unknown.
        """
        outcomes = [list(self.checker.check_all(c)[1].values()) for c in candidates]
        failed = np.array([sum(not result.passed for result in results) for results in outcomes])
        terms = {"sanity": np.array([mean_margin(results) for results in outcomes])}
        if beats is not None and len(beats):
            terms["beats"] = np.array([on_the_beat(c, beats) for c in candidates])
        points = np.stack([_points(candidate) for candidate in candidates])
        return rank(terms, failed, distances(points, PATH_SCALE), self.config)


def on_the_beat(trajectory: MotionTrajectory, beats: np.ndarray) -> float:
    """Mean of both directions of beat alignment, in [0, 1]; 0 for a motion without beats."""
    times = motion_beats(trajectory.position, trajectory.fps).times
    both = alignment(times, beats, trajectory.seconds)
    return float(np.nan_to_num([both.motion_to_music, both.music_to_motion]).mean())


def _points(trajectory: MotionTrajectory) -> np.ndarray:
    """The pelvis and a point ahead of it, [T,2,3]."""
    heading = trajectory.heading
    ahead = np.stack([np.sin(heading), np.zeros_like(heading), np.cos(heading)], axis=1)
    return np.stack([trajectory.position, trajectory.position + AHEAD * ahead], axis=1)


WINDOW = 150  # frames that the motion tower sees at once: it learned from six seconds at most


class PerformanceJudge:
    """Scores dances to a song.

    Args:
        bands: of real paths, usually `bands.json` beside the audio weights; None = built-in bounds.
        tower: motions into the space of the generator's text tower; None = no similarity.
        config: weights.
    """

    def __init__(
        self,
        bands: Bands | None = None,
        tower: Tower | None = None,
        config: SelectionConfig | None = None,
    ) -> None:
        self.config = config or SelectionConfig()
        self.paths, self.bodies = AudioJudge(bands), TextJudge()
        self.tower = tower

    def judge(
        self,
        candidates: "Sequence[Performance]",
        prompts: Sequence[Tensor],
        beats: np.ndarray | None = None,
        *,
        raw: Sequence[MotionTrajectory] | None = None,
    ) -> ScoreTable:
        """Rank dances of equal length.

        Args:
            candidates: N ≥ 1.
            prompts: [P,D] for each candidate, one embedding a passage, unit-norm.
            beats: seconds [M], ascending; None or none at all = unknown.
            raw: their paths before post-processing, which would hide what the suite looks for;
                None = the audio branch made none.
        """
        motions = [candidate.motion for candidate in candidates]
        body = self.bodies.judge(motions, torch.zeros(1))
        terms, failed = body.terms, body.failed
        if raw is not None:
            path = self.paths.judge(raw)
            terms, failed = terms | path.terms, failed + path.failed
        if beats is not None and len(beats):
            both = [body_alignment(motion, beats) for motion in motions]
            means = [(each.motion_to_music + each.music_to_motion) / 2 for each in both]
            terms["beats"] = np.nan_to_num(means)
        if self.tower is not None:
            found = [
                _similarity(self.tower, candidate, each)
                for candidate, each in zip(candidates, prompts, strict=True)
            ]
            terms = {"similarity": np.array(found)} | terms
        points = np.stack([motion.positions() for motion in motions])
        return rank(terms, failed, distances(points, SCALE), self.config)


def body_alignment(motion: Motion, beats: np.ndarray) -> Alignment:
    """How the beats of all joints' mean speed and a song's [M] fall on each other."""
    times = motion_beats(motion.positions(), motion.fps).times
    return alignment(times, beats, motion.seconds)


def beat_report(motion: Motion, beats: np.ndarray) -> dict[str, float]:
    """Both directions of alignment with beats [M], and their mean when the motion is turned round
    by a random time: chance."""
    times = motion_beats(motion.positions(), motion.fps).times
    rng = np.random.default_rng(0)
    own = alignment(times, beats, motion.seconds)
    chance = chance_alignment(times, beats, motion.seconds, rng)
    both = {"motion-to-music": own.motion_to_music, "music-to-motion": own.music_to_motion}
    both["chance"] = (chance.motion_to_music + chance.music_to_motion) / 2
    return {name: round(float(np.nan_to_num(value)), 4) for name, value in both.items()}


@torch.inference_mode()
def _similarity(tower: Tower, performance: "Performance", prompts: Tensor) -> float:
    """Mean over windows of the cosine of what is seen and what was asked, not below 0."""
    features = encode_features(performance.motion)
    ends = np.cumsum([passage.frames for passage in performance.passages])
    cosines = []
    for start in range(0, max(1, len(features) - WINDOW // 2), WINDOW):
        window = features[start : start + WINDOW]
        asked = min(int(np.searchsorted(ends, start + len(window) // 2)), len(ends) - 1)
        cosines.append(float(tower(window[None])[0].cpu() @ prompts[asked].detach().float().cpu()))
    return float(np.clip(np.mean(cosines), 0, 1))


# ---------------------------------------------------------------- sampling


@dataclass(frozen=True, eq=False)
class PromptResult:
    """The best motion for one prompt; all N, as sampled, if asked for; their scores; a line if the
    prompt is far from what the model knows, or the best does not show what it asks for; and what
    the prompt was read as."""

    motion: Motion
    all_candidates: list[Motion] | None
    table: ScoreTable
    warning: str | None = None
    clauses: Sequence[Clause] = ()

    def ranked(self) -> list[Motion]:
        """All candidates, best first; only the best where the others were not kept."""
        if self.all_candidates is None:
            return [self.motion]
        return [self.all_candidates[place] for place in self.table.order]


class PromptSampler:
    """Best of N for prompts, the text side's `MotionSampler`.

    Args:
        generator: trained; a `SentenceGenerator` is used as it is.
        judge: of the candidates; one with the generator's motion tower sees the prompt, None
            makes one without.
    """

    def __init__(
        self, generator: TextToMotion | SentenceGenerator, judge: TextJudge | None = None
    ) -> None:
        if isinstance(generator, TextToMotion):
            generator = SentenceGenerator(generator)
        self.generator = generator
        self.judge = judge or TextJudge()

    def sample(
        self,
        prompts: Sequence[str],
        num_samples: int = 8,
        *,
        return_all: bool = False,
        **options: Any,
    ) -> list[PromptResult]:
        """Sample N candidates a prompt and keep the one that the judge puts first.

        Args:
            prompts: see `SentenceGenerator.generate`.
            num_samples: N; candidate i depends on (seed, prompt, i) alone.
            return_all: keep the others too.
            options: what else `SentenceGenerator.generate` takes.

        Raises:
            UserError: as `SentenceGenerator.generate`.
        """
        motions = self.generator.generate(prompts, num_samples=num_samples, **options)
        embeddings = None if num_samples == 1 else self.generator.encode_prompts(prompts).pooled
        results, warnings = [], self.generator.scope_warnings(prompts)
        for number, prompt in enumerate(prompts):
            made = motions[number * num_samples : (number + 1) * num_samples]
            table = unranked()
            if embeddings is not None:
                table = self.judge.judge(made, embeddings[number])
            best, kept = made[table.best], made if return_all else None
            warning = warnings[number] or self.generator.missed(prompt, best)
            clauses = self.generator.clauses(prompt)
            results.append(PromptResult(best, kept, table, warning, clauses))
        return results
