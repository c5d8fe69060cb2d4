"""Does a motion show an action? Kinematic definitions, no learned model.

Thresholds lie between what the synthetic source and real mocap do and what they do not do
when another action is asked for; a frozen pose and noise fail every check.
"""

import math
from collections.abc import Callable

from .measurements import Measurements

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
    "left-hand-too": lambda m: _hand_up(m, 0),
    "right-hand-too": lambda m: _hand_up(m, 1),
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
    **dict.fromkeys(("raise", "bye"), lambda m: _hand_up(m, 0) or _hand_up(m, 1)),
    **{name: _RAW[name] for name in ("squat", "jump", "clap", "bow", "stand")},
}

ACTIONS: dict[str, Check] = {name: _of_a_body(check) for name, check in _ACTIONS.items()}
"""Actions that kinematics define, or ask something of, whoever performs them in whatever style."""


def side_check(action: str, side: str, *, by_hand: bool) -> Check | None:
    """Whether an action is done with the left or right limb, or to that side; None where nobody can
    say. `by_hand`: it is done with the arms alone."""
    name = f"turn-{side}" if action == "spin" else f"{action}-{side}"
    return CHECKS.get(name) or (CHECKS.get(f"{side}-hand") if by_hand else None)


def repetitions(action: str, m: Measurements, side: str | None = None) -> int | None:
    """How often an action is seen, with either limb or the named one; None where nobody counts."""
    sides = {"left": m.kicks[:1], "right": m.kicks[1:]}.get(side or "", m.kicks)
    fists = {"left": m.punches[:1], "right": m.punches[1:]}.get(side or "", m.punches)
    one = {"squat": m.squats, "jump": m.jumps, "clap": m.claps, "bow": m.bows}
    return (one | {"kick": sum(sides), "punch": sum(fists)}).get(action)
