"""One table a split: real, chance, frozen and generated motions under the same measurements.

Letters: N clips, D embedding channels.
"""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np

from src.shared.evaluation.clips import Clips, Sampler
from src.shared.evaluation.evaluator import Evaluator
from src.shared.evaluation.intervals import replicated
from src.shared.evaluation.metrics_frechet import JointFrechet, frechet_distance, group_frechet
from src.shared.evaluation.metrics_retrieval import (
    BATCH,
    Retrieval,
    guo_retrieval,
    normalised_score,
)
from src.shared.evaluation.metrics_spread import diversity
from src.shared.evaluation.physical_table import Observed, Row, physical_columns


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

    def rows(self, index: Sequence[int]) -> "Embedded":
        """The pairs at these rows, in this order."""
        return Embedded(self.clips.rows(index), self.text[index], self.motion[index])

    def reordered(self, order: np.ndarray) -> "Embedded":
        """Texts and labels stay, motions change places: what ignoring the prompt gives."""
        motions = [self.clips.motions[row] for row in order]
        return Embedded(self.clips.with_motions(motions), self.text, self.motion[order])


@dataclass(frozen=True)
class Reference:
    """The real clips of a split, with everything that is computed from them once."""

    real: Embedded
    joint: JointFrechet
    observed: Observed

    @classmethod
    def of(cls, real: Embedded) -> "Reference":
        """Fit the projections of the joint distance and measure every motion."""
        axes = min(16, real.motion.shape[1])
        joint = JointFrechet(real.text, real.motion, num_axes=axes)
        return cls(real, joint, Observed.of(real.clips.motions))


def r_precision(sample: Embedded, seed: int) -> Retrieval:
    """Retrieval where clips of one label group, or with one caption, are all right."""
    equal_by = [sample.clips.groups, sample.clips.captions]
    return guo_retrieval(sample.text, sample.motion, equal_by, seed=seed)


def learned_columns(sample: Embedded, reference: Reference, seed: int) -> dict[str, float]:
    """Everything the evaluator model decides: retrieval, Fréchet distances, diversity."""
    columns: dict[str, float] = {}
    if len(sample.clips) >= BATCH:
        found = r_precision(sample, seed)
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
    real, observed = reference.real, reference.observed
    labels, travels = real.clips.labels, observed.travels
    seeds = range(seed, seed + replications)
    orders = [np.random.default_rng(s).permutation(len(real.clips)) for s in seeds]
    # Fréchet distances of the real row come from two disjoint halves: a sample is 0 from itself.
    truth = [_without_itself(learned_columns(real, reference, s), real, s) for s in seeds]
    chance = [
        learned_columns(real.reordered(order), reference, s)
        for order, s in zip(orders, seeds, strict=True)
    ]
    shuffled = observed.rows(orders[0].tolist())
    rows = {
        "real": _replicate(truth) | physical_columns(observed, labels, travels),
        "chance": _replicate(chance) | physical_columns(shuffled, labels, travels),
    }
    pairs = list(same_group_partner(real.clips, seed))
    own, other = [row for row, _ in pairs], [row for _, row in pairs]
    # A real clip has no error against itself: compare it with a sibling, where there is one.
    rows["real"] = {k: v for k, v in rows["real"].items() if not k.endswith("_error")}
    if pairs:
        siblings = physical_columns(
            observed.rows(own), [labels[i] for i in own], [travels[i] for i in other]
        )
        rows["real"] |= {k: v for k, v in siblings.items() if k.endswith("_error")}
    return rows


def _without_itself(columns: dict[str, float], real: Embedded, seed: int) -> dict[str, float]:
    """The columns with Fréchet distances between two random halves instead of to itself."""
    columns = {k: v for k, v in columns.items() if k not in ("frechet_by_tag", "num_tags")}
    order = np.random.default_rng(seed).permutation(len(real.clips)).tolist()
    left, right = real.rows(order[: len(order) // 2]), real.rows(order[len(order) // 2 :])
    if len(left.clips) < 2:
        return columns
    joint = JointFrechet(real.text, real.motion, num_axes=min(16, real.motion.shape[1]))
    joint.reference = joint.moments(right.text, right.motion)
    columns["frechet"] = frechet_distance(left.motion, right.motion)
    columns["frechet_joint"] = joint(left.text, left.motion)
    groups = group_frechet(left.motion, left.clips.tags, right.motion, right.clips.tags)
    if groups is not None:
        columns["frechet_by_tag"] = groups.matched
        columns["frechet_by_wrong_tag"] = groups.mismatched
        columns["num_tags"] = groups.num_groups
    return columns


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

    The prompts are a random sample of the clips: the first ones hold more of the rare groups than
    the reference does, which alone is a distance (0.010 of 0.108 once). With fewer clips than
    samples the captions come round again, with other noise.
    """
    real = reference.real
    order = np.random.default_rng(seed).permutation(len(real.clips)).tolist()
    index = [order[row % len(order)] for row in range(num_samples)]
    prompted = real.rows(index)
    prompts = prompted.clips
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
    travels = [reference.observed.travels[i] for i in index]
    return _replicate(columns) | physical_columns(Observed.of(first.motions), first.labels, travels)


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
