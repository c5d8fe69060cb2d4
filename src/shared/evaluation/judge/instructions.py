"""Did the motion do what its labels say? The checks of `metrics/measurements.py`, by labels."""

import math
from collections.abc import Callable
from dataclasses import dataclass
from itertools import pairwise

from ...data.synthetic.clips import SPEED_METRES, SPEEDS
from ...metrics.measurements import CHECKS, Check, Measurements, credible, measure, repetitions
from ...motion.motion import Motion

ANGLE_WITHIN = 20.0  # degrees


def faster(fast: Measurements, slow: Measurements) -> bool:
    """Whether one motion travels at least a quarter faster than another."""
    return credible(fast) and credible(slow) and fast.speed > 1.25 * slow.speed > 0.0


def _names(labels: dict[str, str]) -> list[str]:
    """Checks that a label set calls for."""
    action, direction = labels.get("action", ""), labels.get("direction", "")
    side, turn = labels.get("side", ""), labels.get("turn", "")
    if action in ("walk", "run", "side-step", "crouch-walk"):
        names = [direction] if direction in CHECKS else []
        names += {"run": ["run"], "crouch-walk": ["crouched"]}.get(action, [])
        return names + ([f"turn-{turn}"] if turn else [])
    if action in ("turn", "spin"):
        return [*([f"turn-{direction}"] if direction else []), "in-place"]
    if action in ("wave", "raise"):
        names = ["both-hands" if side == "both" else f"{side}-hand"] if side else []
        return names + (["wave"] if action == "wave" else [])
    if action in ("kick", "punch"):
        return [f"{action}-{side}"] if side in ("left", "right") else []
    if action == "jump":
        return ["jump", *(["forward-jump"] if direction == "forward" else [])]
    return [action] if action in CHECKS else []


def speed_class(labels: dict[str, str], m: Measurements) -> str | None:
    """ "slow", "normal" or "fast" by the synthetic source's speeds, None where it has none."""
    speeds = SPEED_METRES.get((labels.get("action", ""), labels.get("direction", "")))
    if speeds is None:
        return None
    borders = [(low * high) ** 0.5 for low, high in pairwise(speeds)]
    return SPEEDS[sum(m.cruise > border for border in borders)]


def check(labels: dict[str, str], motion: Motion | Measurements) -> dict[str, bool]:
    """What the labels ask for → whether the motion does it.

    Besides the names in `CHECKS` the answer may hold "count" (the named number of repetitions,
    exactly), "speed" (the named speed class) and "angle" (within 20°).
    Labels that cannot be measured (style, unknown actions) ask for nothing.
    """
    m = motion if isinstance(motion, Measurements) else measure(motion)
    answers = {name: CHECKS[name](m) for name in _names(labels)}
    count = repetitions(labels.get("action", ""), m, labels.get("side"))
    if "count" in labels and count is not None:
        answers["count"] = credible(m) and count == int(labels["count"])
    if "speed" in labels and (speed := speed_class(labels, m)) is not None:
        answers["speed"] = credible(m) and speed == labels["speed"]
    if "angle" in labels:
        off = abs(math.degrees(m.yaw)) - float(labels["angle"])
        answers["angle"] = credible(m) and abs(off) < ANGLE_WITHIN
    return answers


@dataclass(frozen=True)
class ControlTask:
    """One thing a user may ask for, with the labels its prompts are rendered from.

    Attributes:
        labels: label sets that all ask for it; use them in turn.
        check: answers for one motion.
        versus: label set of the motion to compare with, None if none is needed.
        compare: answers for the pair (motion, comparison) where `versus` is given.
    """

    name: str
    labels: tuple[dict[str, str], ...]
    check: Check
    versus: dict[str, str] | None = None
    compare: Callable[[Measurements, Measurements], bool] | None = None

    def passes(self, motion: Measurements, other: Measurements | None = None) -> bool:
        """Whether the motion (against `other` where the task compares two) does it.

        Raises:
            ValueError: the task compares two motions and `other` is missing.
        """
        if self.compare is None:
            return self.check(motion)
        if other is None:
            raise ValueError(f"task {self.name!r} compares two motions: give the one of `versus`")
        return self.compare(motion, other)


def _hand(side: str) -> tuple[dict[str, str], ...]:
    return {"action": "wave", "side": side}, {"action": "raise", "side": side}


def _turn(side: str) -> tuple[dict[str, str], ...]:
    return (
        {"action": "walk", "direction": "forward", "turn": side},
        {"action": "turn", "direction": side, "angle": "90"},
    )


_WALK = {"action": "walk", "direction": "forward"}
_RUN = {"action": "run", "direction": "forward"}

CONTROL_TASKS: tuple[ControlTask, ...] = (
    ControlTask("forward", (_WALK,), CHECKS["forward"]),
    ControlTask("backward", ({"action": "walk", "direction": "backward"},), CHECKS["backward"]),
    ControlTask("left hand", _hand("left"), CHECKS["left-hand"]),
    ControlTask("right hand", _hand("right"), CHECKS["right-hand"]),
    ControlTask("run faster than walk", (_RUN,), CHECKS["run"], versus=_WALK, compare=faster),
    ControlTask("turn left", _turn("left"), CHECKS["turn-left"]),
    ControlTask("turn right", _turn("right"), CHECKS["turn-right"]),
)
"""The controllability that shipped weights are held to."""
