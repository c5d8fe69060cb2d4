"""One table a split: real, chance, frozen and generated motions under the same measurements.

Letters: N clips, D embedding channels.
"""

from collections.abc import Iterator, Sequence
from dataclasses import asdict, dataclass, fields

import numpy as np

from src.shared.evaluation.clips import Clips, Sampler
from src.shared.evaluation.controllability import check
from src.shared.evaluation.evaluator import Evaluator
from src.shared.evaluation.intervals import bootstrap_mean, replicated, success_rate
from src.shared.evaluation.measurements import measure
from src.shared.evaluation.metrics_frechet import JointFrechet, frechet_distance, group_frechet
from src.shared.evaluation.metrics_physical import Physics, physics
from src.shared.evaluation.metrics_retrieval import BATCH, guo_retrieval, normalised_score
from src.shared.evaluation.metrics_spread import diversity
from src.shared.evaluation.metrics_travel import Travel, travel, travel_error

KINDS = {
    **dict.fromkeys(("forward", "backward", "left", "right", "forward-jump"), "direction"),
    **dict.fromkeys(("turn-left", "turn-right"), "turn"),
    **dict.fromkeys(("left-hand", "right-hand", "both-hands"), "hand"),
    **{name: name for name in ("count", "speed", "angle")},
}
Row = dict[str, dict[str, float | int]]  # column to value, low, high, count


@dataclass(frozen=True)
class Embedded:
    """Clips with their text and motion embeddings [N, D]."""

    clips: Clips
    text: np.ndarray
    motion: np.ndarray

    @classmethod
    def of(cls, evaluator: Evaluator, clips: Clips) -> "Embedded":
        """Embed every caption and motion."""
        text = evaluator.embed_text(clips.captions).numpy()
        return cls(clips, text, evaluator.embed_motion(clips.motions).numpy())

    def with_motions(self, evaluator: Evaluator, clips: Clips) -> "Embedded":
        """The same captions over other motions."""
        return Embedded(clips, self.text, evaluator.embed_motion(clips.motions).numpy())

    def shuffled(self, seed: int) -> "Embedded":
        """Texts and labels stay, motions change places: the score of ignoring the prompt."""
        order = np.random.default_rng(seed).permutation(len(self.clips))
        motions = [self.clips.motions[row] for row in order]
        return Embedded(self.clips.with_motions(motions), self.text, self.motion[order])


@dataclass(frozen=True)
class Reference:
    """The real clips of a split, with everything that is computed from them once."""

    real: Embedded
    joint: JointFrechet
    travels: list[Travel]

    @classmethod
    def of(cls, real: Embedded) -> "Reference":
        """Fit the projections of the joint distance and follow every pelvis."""
        axes = min(16, real.motion.shape[1])
        joint = JointFrechet(real.text, real.motion, num_axes=axes)
        return cls(real, joint, [travel(motion) for motion in real.clips.motions])


def learned_columns(sample: Embedded, reference: Reference, seed: int) -> dict[str, float]:
    """Everything the evaluator model decides: retrieval, Fréchet distances, diversity."""
    columns: dict[str, float] = {}
    if len(sample.clips) >= BATCH:
        equal_by = [sample.clips.groups, sample.clips.captions]
        found = guo_retrieval(sample.text, sample.motion, equal_by, seed=seed)
        for k, value in enumerate(found.r_precision, start=1):
            columns[f"r_at_{k}"] = value
        columns["matching_distance"] = found.matching_distance
    columns["frechet"] = frechet_distance(sample.motion, reference.real.motion)
    columns["frechet_joint"] = reference.joint(sample.text, sample.motion)
    groups = group_frechet(
        sample.motion, sample.clips.tags, reference.real.motion, reference.real.clips.tags
    )
    if groups is not None:
        columns["frechet_by_tag"] = groups.matched
        columns["frechet_by_wrong_tag"] = groups.mismatched
        columns["num_tags"] = groups.num_groups
    columns["diversity"] = diversity(sample.motion, seed=seed)
    return columns


def physical_columns(sample: Clips, references: Sequence[Travel]) -> Row:
    """Everything that needs no learned model, with bootstrap intervals over clips."""
    figures = [physics(motion) for motion in sample.motions]
    row: Row = {
        field.name: bootstrap_mean([getattr(f, field.name) for f in figures]).as_dict()
        for field in fields(Physics)
    }
    errors = travel_error([travel(motion) for motion in sample.motions], references)
    for name, values in asdict(errors).items():
        row[f"{name}_error"] = bootstrap_mean(values).as_dict()
    return row | obedience(sample)


def obedience(clips: Clips) -> Row:
    """Share of each kind of check that the labels ask for and the motions pass.

    Kinds: travel direction, turning, hand, action, count, speed class, angle, and `all` checks of
    a clip at once; labels that cannot be measured (style) ask for nothing.
    """
    passed: dict[str, list[bool]] = {}
    for motion, labels in zip(clips.motions, clips.labels, strict=True):
        answers = check(labels, measure(motion))
        for name, answer in answers.items():
            passed.setdefault(KINDS.get(name, "action"), []).append(answer)
        if answers:
            passed.setdefault("all", []).append(all(answers.values()))
    return {
        f"obeys_{kind}": success_rate(sum(found), len(found)).as_dict()
        for kind, found in passed.items()
    }


def same_group_partner(clips: Clips, seed: int) -> Iterator[tuple[int, int]]:
    """Pairs (row, another row of the same label group), for groups of two or more."""
    rng = np.random.default_rng(seed)
    groups: dict[str, list[int]] = {}
    for row, group in enumerate(clips.groups):
        groups.setdefault(group, []).append(row)
    for rows in groups.values():
        if len(rows) > 1:
            order = rng.permutation(rows)
            yield from zip(order.tolist(), np.roll(order, 1).tolist(), strict=True)


def _replicate(columns: Sequence[dict[str, float]]) -> Row:
    return {name: replicated([column[name] for column in columns]).as_dict() for name in columns[0]}


def real_rows(reference: Reference, replications: int, seed: int) -> dict[str, Row]:
    """Rows `real` and `chance`: the ceiling and the floor of every column."""
    real = reference.real
    seeds = range(seed, seed + replications)
    # Fréchet distances of the real row come from two disjoint halves: a sample is 0 from itself.
    truth = [learned_columns(real, reference, s) | _halves(real, s) for s in seeds]
    chance = [learned_columns(real.shuffled(s), reference, s) for s in seeds]
    pairs = list(same_group_partner(real.clips, seed))
    partners = [reference.travels[other] for _, other in pairs]
    rows = {
        "real": _replicate(truth) | physical_columns(real.clips, reference.travels),
        "chance": _replicate(chance)
        | physical_columns(real.shuffled(seed).clips, reference.travels),
    }
    if pairs:  # a real clip has no error against itself: compare it with a sibling
        siblings = physical_columns(real.clips.rows([row for row, _ in pairs]), partners)
        rows["real"] |= {key: value for key, value in siblings.items() if key.endswith("_error")}
    return rows


def _halves(real: Embedded, seed: int) -> dict[str, float]:
    order = np.random.default_rng(seed).permutation(len(real.clips))
    left, right = order[: len(order) // 2], order[len(order) // 2 :]
    if len(left) < 2:
        return {}
    joint = JointFrechet(real.text, real.motion, num_axes=min(16, real.motion.shape[1]))
    joint.reference = joint.moments(real.text[right], real.motion[right])
    return {
        "frechet": frechet_distance(real.motion[left], real.motion[right]),
        "frechet_joint": joint(real.text[left], real.motion[left]),
    }


def generated_row(
    sampler: Sampler,
    evaluator: Evaluator,
    reference: Reference,
    *,
    num_samples: int,
    replications: int,
    seed: int,
) -> Row:
    """Motions made for the split's captions at the clips' lengths, `num_samples` a replication.

    With fewer clips than samples the captions come round again, with other noise.
    """
    real = reference.real
    index = [row % len(real.clips) for row in range(num_samples)]
    prompts = real.clips.rows(index)
    prompted = Embedded(prompts, real.text[index], real.motion[index])
    columns: list[dict[str, float]] = []
    first: Clips | None = None
    for replication in range(replications):
        run = seed + 1000 * replication
        clips = prompts.with_motions(sampler(prompts.captions, prompts.num_frames, run))
        first = first or clips
        columns.append(
            learned_columns(prompted.with_motions(evaluator, clips), reference, seed + replication)
        )
    assert first is not None
    return _replicate(columns) | physical_columns(first, [reference.travels[i] for i in index])


def scores(rows: dict[str, Row], name: str) -> dict[str, float]:
    """What the bar asks of row `name`: each figure against real and chance.

    `normalised_r_at_k` is (row - chance) / (real - chance); `frechet_joint_ratio` is the row's
    joint distance over that of real motions under shuffled labels; the others are row / real.
    """

    def value(row: str, column: str) -> float:
        return float(rows[row].get(column, {}).get("value", float("nan")))

    def over(numerator: float, denominator: float) -> float:
        return numerator / denominator if denominator > 1e-9 else float("nan")

    result = {
        f"normalised_r_at_{k}": normalised_score(
            value(name, f"r_at_{k}"), value("chance", f"r_at_{k}"), value("real", f"r_at_{k}")
        )
        for k in (1, 2, 3)
    }
    result["frechet_joint_ratio"] = over(
        value(name, "frechet_joint"), value("chance", "frechet_joint")
    )
    result["frechet_tag_ratio"] = over(
        value(name, "frechet_by_tag"), value(name, "frechet_by_wrong_tag")
    )
    for column in ("contact_slide", "support_slide", "jerk", "hand_jerk", "speed", "diversity"):
        result[f"{column}_ratio"] = over(value(name, column), value("real", column))
    return result
