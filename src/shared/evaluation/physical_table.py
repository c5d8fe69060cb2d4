"""What a row says without a learned model: physics, travel, and whether the labels are obeyed.

Letters: N motions.
"""

from collections.abc import Sequence
from dataclasses import asdict, dataclass, fields

from src.shared.evaluation.controllability import check
from src.shared.evaluation.intervals import bootstrap_mean, success_rate
from src.shared.evaluation.measurements import Measurements, measure
from src.shared.evaluation.metrics_physical import Physics, physics
from src.shared.evaluation.metrics_travel import Travel, travel, travel_error
from src.shared.motion.motion import Motion

Labels = dict[str, str]
Row = dict[str, dict[str, float | int]]  # column to value, low, high, count
KINDS = {
    **dict.fromkeys(("forward", "backward", "left", "right", "forward-jump"), "direction"),
    **dict.fromkeys(("turn-left", "turn-right"), "turn"),
    **dict.fromkeys(("left-hand", "right-hand", "both-hands"), "hand"),
    **{name: name for name in ("count", "speed", "angle")},
}


@dataclass(frozen=True)
class Observed:
    """Everything measured of N motions, once: shuffling captions needs no second look."""

    physics: list[Physics]
    travels: list[Travel]
    measured: list[Measurements]

    @classmethod
    def of(cls, motions: Sequence[Motion]) -> "Observed":
        """Look at every motion."""
        return cls(
            [physics(motion) for motion in motions],
            [travel(motion) for motion in motions],
            [measure(motion) for motion in motions],
        )

    def rows(self, index: Sequence[int]) -> "Observed":
        """The motions at these rows, in this order."""
        return Observed(
            [self.physics[i] for i in index],
            [self.travels[i] for i in index],
            [self.measured[i] for i in index],
        )


def physical_columns(
    observed: Observed, labels: Sequence[Labels], references: Sequence[Travel]
) -> Row:
    """Columns with their intervals over motions.

    Args:
        observed: N motions.
        labels: what each was asked to do.
        references: the travel of a real clip of the same caption.
    """
    row: Row = {
        field.name: bootstrap_mean([getattr(p, field.name) for p in observed.physics]).as_dict()
        for field in fields(Physics)
    }
    errors = travel_error(observed.travels, references)
    for name, values in asdict(errors).items():
        row[f"{name}_error"] = bootstrap_mean(values).as_dict()
    return row | obedience(observed.measured, labels)


def obedience(measured: Sequence[Measurements], labels: Sequence[Labels]) -> Row:
    """Share of each kind of check that the labels ask for and the motions pass.

    Kinds: travel direction, turning, hand, action, count, speed class, angle, and `all` checks of
    a clip at once; labels that cannot be measured (style) ask for nothing.
    """
    passed: dict[str, list[bool]] = {}
    for motion, wanted in zip(measured, labels, strict=True):
        answers = check(wanted, motion)
        for name, answer in answers.items():
            passed.setdefault(KINDS.get(name, "action"), []).append(answer)
        if answers:
            passed.setdefault("all", []).append(all(answers.values()))
    return {
        f"obeys_{kind}": success_rate(sum(found), len(found)).as_dict()
        for kind, found in passed.items()
    }
