"""Did the motion do what its labels say? Checks on measurements, no learned model.

Thresholds lie between what the synthetic source and real mocap do and what they do not do
when another action is asked for; a frozen pose and noise fail every check.
"""

import math
from collections.abc import Callable
from dataclasses import dataclass
from itertools import pairwise

from ...data.synthetic.clips import SPEED_METRES, SPEEDS
from ...metrics.measurements import Measurements, measure
from ...motion.motion import Motion

Check = Callable[[Measurements], bool]

_MAX_ANGULAR_SPEED = 6.0  # rad/s, mean over joints; sprinting mocap has 4, white noise over 30
_MIN_ANGULAR_SPEED = 0.02
_MIN_TURN = 0.7  # radians; straight walking mocap gains at most 0.5
_MIN_STRIDE = 0.06  # metres; a gliding body does not step


def credible(m: Measurements) -> bool:
    """A body that lives: upright, neither frozen nor trembling."""
    return m.upright > 0.9 and _MIN_ANGULAR_SPEED < m.angular_speed < _MAX_ANGULAR_SPEED


def _steps(m: Measurements, distance: float, speed: float) -> bool:
    return distance > 0.3 and speed > 0.17 and m.stride > _MIN_STRIDE


def _forward(m: Measurements) -> bool:
    return _steps(m, m.forward, m.forward_speed) and abs(m.lateral) < 0.6 * m.forward


def _backward(m: Measurements) -> bool:
    return _steps(m, -m.forward, -m.forward_speed) and abs(m.lateral) < -0.6 * m.forward


def _sideways(m: Measurements, sign: int) -> bool:
    # Mocap called "walk left" goes diagonally, 20° and more from straight ahead.
    return _steps(m, sign * m.lateral, sign * m.lateral_speed / 0.7) and (
        sign * m.lateral > 0.25 * abs(m.forward)
    )


def _turns(m: Measurements, sign: int) -> bool:
    return sign * m.yaw > _MIN_TURN


def _hand_up(m: Measurements, side: int) -> bool:
    return m.hand_peak[side] > -0.2 and m.hand_travel[side] > 0.15


def _one_hand(m: Measurements, side: int) -> bool:
    return _hand_up(m, side) and m.hand_peak[side] - m.hand_peak[1 - side] > 0.35


def _both_hands(m: Measurements) -> bool:
    return all(_hand_up(m, side) and m.hand_peak[side] > -0.15 for side in (0, 1))


def _waves(m: Measurements) -> bool:
    highest = max((0, 1), key=lambda side: m.hand_peak[side])
    return _hand_up(m, highest) and m.hand_swings[highest] >= 4


def _runs(m: Measurements) -> bool:
    flies = m.flight > 0.05 * m.seconds
    return _forward(m) and (m.cruise > 2.0 or (flies and m.cruise > 1.3))


def _kicks(m: Measurements, side: int) -> bool:
    return m.kicks[side] > m.kicks[1 - side]


def _punches(m: Measurements, side: int) -> bool:
    return m.punches[side] > m.punches[1 - side]


def _stays(m: Measurements) -> bool:
    return abs(m.forward) < 0.4 and abs(m.lateral) < 0.4


def _stands(m: Measurements) -> bool:
    quiet = max(m.hand_peak) < -0.3 and abs(m.yaw) < 0.5 and m.angular_speed < 1.0
    return _stays(m) and quiet and m.pelvis_low > 0.9 and m.stride < 0.1 and m.bows == 0


_RAW: dict[str, Check] = {
    "forward": _forward,
    "backward": _backward,
    "left": lambda m: _sideways(m, 1),
    "right": lambda m: _sideways(m, -1),
    "turn-left": lambda m: _turns(m, 1),
    "turn-right": lambda m: _turns(m, -1),
    "left-hand": lambda m: _one_hand(m, 0),
    "right-hand": lambda m: _one_hand(m, 1),
    "both-hands": _both_hands,
    "wave": _waves,
    "run": _runs,
    "squat": lambda m: m.squats >= 1,
    "jump": lambda m: m.jumps >= 1,
    "kick-left": lambda m: _kicks(m, 0),
    "kick-right": lambda m: _kicks(m, 1),
    "punch-left": lambda m: _punches(m, 0),
    "punch-right": lambda m: _punches(m, 1),
    "clap": lambda m: m.claps >= 1,
    "bow": lambda m: m.bows >= 1,
    "forward-jump": lambda m: m.forward > 0.25,
    "crouched": lambda m: m.pelvis_low < 0.82,
    "in-place": _stays,
    "stand": _stands,
}


def _of_a_body(check: Check) -> Check:
    return lambda m: credible(m) and check(m)


CHECKS: dict[str, Check] = {name: _of_a_body(check) for name, check in _RAW.items()}
"""Named yes-or-no questions to a measured motion; each also demands a credible body."""


def _travels(m: Measurements, speed: float) -> bool:
    return math.hypot(m.forward_net, m.lateral_net) > speed * m.seconds


def _within(m: Measurements, metres: float) -> bool:
    return abs(m.forward_net) < metres and abs(m.lateral_net) < metres


def _walks(m: Measurements) -> bool:
    slow = m.cruise < 2.0 and m.flight < 0.05 * m.seconds
    return slow and _travels(m, 0.25) and m.stride > _MIN_STRIDE and m.pelvis_low > 0.82


def _side_steps(m: Measurements) -> bool:
    return any(_sideways(m, sign) for sign in (1, -1)) and abs(m.lateral_net) > abs(m.forward_net)


def _turns_in_place(m: Measurements) -> bool:
    return abs(m.yaw) > _MIN_TURN and _within(m, 0.6) and max(m.hand_peak) < -0.3


_ACTIONS: dict[str, Check] = {
    "walk": _walks,
    "run": _runs,
    "wave": _waves,
    "crouch-walk": lambda m: m.pelvis_low < 0.85 and _travels(m, 0.2),
    "side-step": _side_steps,
    "turn": _turns_in_place,
    "spin": lambda m: abs(m.yaw) > 4.7 and _within(m, 0.8),
    "kick": lambda m: max(m.kicks) >= 1,
    "punch": lambda m: max(m.punches) >= 1 and not _travels(m, 0.25),
    **{name: _RAW[name] for name in ("squat", "jump", "clap", "bow", "stand")},
}

ACTIONS: dict[str, Check] = {name: _of_a_body(check) for name, check in _ACTIONS.items()}
"""Actions that kinematics define, whoever performs them and in whatever style."""


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


def _count(labels: dict[str, str], m: Measurements) -> int | None:
    """Repetitions seen of the action that the labels name, None where none are counted."""
    side = 0 if labels.get("side") == "left" else 1
    one = {"squat": m.squats, "jump": m.jumps, "clap": m.claps, "bow": m.bows}
    return (one | {"kick": m.kicks[side], "punch": m.punches[side]}).get(labels["action"])


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
    exactly), "speed" (the named speed class) and "angle" (within 30°).
    Labels that cannot be measured (style, unknown actions) ask for nothing.
    """
    m = motion if isinstance(motion, Measurements) else measure(motion)
    answers = {name: CHECKS[name](m) for name in _names(labels)}
    if "count" in labels and (count := _count(labels, m)) is not None:
        answers["count"] = credible(m) and count == int(labels["count"])
    if "speed" in labels and (speed := speed_class(labels, m)) is not None:
        answers["speed"] = credible(m) and speed == labels["speed"]
    if "angle" in labels:
        wanted = float(labels["angle"]) * 3.14159265 / 180
        answers["angle"] = credible(m) and abs(abs(m.yaw) - wanted) < 0.52
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
