"""The text branch's families of metrics: retrieval, Fréchet distances, physics, travel, obedience.

Letters: N motions.
"""

from collections.abc import Mapping
from dataclasses import asdict, fields

import numpy as np

from ..metrics.frechet import JointFrechet, diversity, frechet_distance, group_frechet
from ..metrics.measurements import measure
from ..metrics.physical import Physics, physics
from ..metrics.retrieval import BATCH, Retrieval, guo_retrieval
from ..metrics.travel import travel, travel_error
from .engine import Value
from .judge.instructions import check
from .report.tables import Column
from .samples import MotionSample

JOINT_AXES = 16
MIN_SAMPLE = 2  # motions that have a covariance
KINDS = {
    **dict.fromkeys(("forward", "backward", "left", "right", "forward-jump"), "direction"),
    **dict.fromkeys(("turn-left", "turn-right"), "turn"),
    **dict.fromkeys(("left-hand", "right-hand", "both-hands"), "hand"),
    **{name: name for name in ("count", "speed", "angle")},
}


def r_precision(sample: MotionSample, seed: int) -> Retrieval:
    """Retrieval where clips of one label group, or with one caption, are all right."""
    equal_by = [sample.clips.groups, sample.clips.captions]
    return guo_retrieval(sample.text, sample.motion, equal_by, seed=seed)


class GuoRetrieval:
    """R-precision in batches of 32 and distance to the own caption."""

    name = "retrieval"
    distance = False
    columns = (
        Column("r_at_1", "R@1", better="high"),
        Column("r_at_2", "R@2", better="high"),
        Column("r_at_3", "R@3", better="high"),
        Column("matching_distance", "MM-Dist", better="low"),
        Column("diversity", "Diversity"),
    )
    definition = (
        "Guo et al. 2022 (§6): each text ranks the motions of a random batch of 32 by Euclidean"
        " distance; a motion of the same label group, or with the same caption, is a hit; equal"
        " distances count in every order (hypergeometric). MM-Dist: mean distance of a text to its"
        " motion. Diversity: mean distance of 300 random pairs; close to the real row is best."
        " Chance is above 3/32 where groups repeat: it is measured, not assumed."
    )

    def compute(
        self, sample: MotionSample, reference: MotionSample, *, seed: int
    ) -> Mapping[str, Value]:
        """See `MetricFamily`; R-precision needs a batch."""
        found: dict[str, Value] = {}
        if len(sample) >= BATCH:
            retrieval = r_precision(sample, seed)
            for k, value in enumerate(retrieval.r_precision, start=1):
                found[f"r_at_{k}"] = value
        apart = sample.text.astype(np.float64) - sample.motion.astype(np.float64)
        found["matching_distance"] = np.linalg.norm(apart, axis=1)
        if len(sample) >= MIN_SAMPLE:
            found["diversity"] = diversity(sample.motion, seed=seed)
        return found


class Frechet:
    """Distances of embedded distributions, alone, with their texts, and label by label."""

    name = "Fréchet distances"
    distance = True
    columns = (
        Column("frechet", "FD", better="low"),
        Column("frechet_joint", "joint FD", better="low"),
        Column("frechet_by_tag", "FD by tag", better="low"),
        Column("frechet_by_wrong_tag", "by wrong tag", better="real"),
        Column("num_tags", "tags", 0),
    )
    definition = (
        "Fréchet distance of the judge's motion embeddings to the real ones (32 dimensions,"
        " float64). It cannot see labels: shuffled ones leave it at 0, so its chance row says"
        " nothing. joint FD: of (text, motion) pairs, each side in 16 principal axes of the real"
        " ones; its chance row is the distance under shuffled labels. by tag: mean over actions"
        " of 24 clips or more, 8 axes. The real row lies between two halves of the real clips"
        " (half the N, which raises it). All depend on N: quote them from 1,000 motions on, and"
        " never beside a figure of another judge or another N."
    )

    def compute(
        self, sample: MotionSample, reference: MotionSample, *, seed: int
    ) -> Mapping[str, Value]:
        """See `MetricFamily`."""
        if min(len(sample), len(reference)) < MIN_SAMPLE:
            return {}
        joint = reference.memo.once("joint FD", lambda: _joint(reference))
        found: dict[str, Value] = {
            "frechet": frechet_distance(sample.motion, reference.motion),
            "frechet_joint": joint(sample.text, sample.motion),
        }
        groups = group_frechet(
            sample.motion, sample.clips.tags, reference.motion, reference.clips.tags
        )
        if groups is not None:
            found["frechet_by_tag"] = groups.matched
            found["frechet_by_wrong_tag"] = groups.mismatched
            found["num_tags"] = float(groups.num_groups)
        return found


def _joint(reference: MotionSample) -> JointFrechet:
    axes = min(JOINT_AXES, reference.motion.shape[1])
    return JointFrechet(reference.text, reference.motion, num_axes=axes)


class Plausibility:
    """Foot slide, floor, jerk and speed."""

    name = "physics"
    distance = False
    columns = (
        Column("contact_slide", "slide, contact cm/s", 2, better="low"),
        Column("support_slide", "slide, support cm/s", 2, better="low"),
        Column("penetration", "sunk cm", 2, better="low"),
        Column("jerk", "jerk m/s³", 0),
        Column("hand_jerk", "hand jerk m/s³", 0),
        Column("speed", "speed m/s", 2),
    )
    definition = (
        "contact: speed of the ball of a foot over frames that the contact detector accepts, which"
        " asks for a slow foot itself, so that a fast glide escapes it; support: of the lower foot"
        " in every frame within 6 cm of its standing height. sunk: lowest foot below its standing"
        " height. jerk: third differences of joint positions. A frozen pose is best in the first"
        " four: read them beside speed and the real row."
    )

    def compute(
        self, sample: MotionSample, reference: MotionSample, *, seed: int
    ) -> Mapping[str, Value]:
        """See `MetricFamily`."""
        found = sample.each("physics", physics)
        return {
            field.name: np.array([getattr(each, field.name) for each in found])
            for field in fields(Physics)
        }


class TravelErrors:
    """Where a motion goes, against a real clip of its caption."""

    name = "travel"
    distance = False
    columns = (
        Column("speed_error", "speed error m/s", 2, better="low"),
        Column("direction_error", "direction error °", 0, better="low"),
        Column("turn_error", "turn error °", 0, better="low"),
    )
    definition = (
        "Absolute differences to a real clip of the same caption; the real row compares real clips"
        " of one label group, which is as good as it gets. A motion that stands where its"
        " reference travels has a direction error of 90°."
    )

    def compute(
        self, sample: MotionSample, reference: MotionSample, *, seed: int
    ) -> Mapping[str, Value]:
        """See `MetricFamily`; NaN where a motion has no reference."""
        own, real = sample.each("travel", travel), reference.each("travel", travel)
        known = np.flatnonzero(sample.source >= 0)
        errors = travel_error([own[i] for i in known], [real[sample.source[i]] for i in known])
        found = {}
        for name, values in asdict(errors).items():
            column = np.full(len(sample), np.nan)
            column[known] = values
            found[f"{name}_error"] = column
        return found


class Obedience:
    """Does a motion do what the labels of its caption say? Decided by forward kinematics."""

    name = "obedience"
    distance = False
    kinds = ("direction", "turn", "hand", "action", "speed", "count", "angle")
    columns = tuple(
        Column(f"obeys_{kind}", kind, 2, "high", share=True) for kind in (*kinds, "all")
    )
    definition = (
        "Share of motions that pass the check their labels call for; speed and count are exact"
        " classes, so real motion does not reach 1 either. Styles ask for nothing: no check"
        " covers them."
    )

    def compute(
        self, sample: MotionSample, reference: MotionSample, *, seed: int
    ) -> Mapping[str, Value]:
        """See `MetricFamily`; NaN where the labels do not ask."""
        found = {column.key: np.full(len(sample), np.nan) for column in self.columns}
        measured = sample.each("measure", measure)
        for row, (labels, motion) in enumerate(zip(sample.clips.labels, measured, strict=True)):
            answers = check(labels, motion)
            kinds: dict[str, list[bool]] = {"all": list(answers.values())}
            for name, passed in answers.items():
                kinds.setdefault(KINDS.get(name, "action"), []).append(passed)
            for kind, passes in kinds.items():
                if passes:
                    found[f"obeys_{kind}"][row] = all(passes)
        return found
