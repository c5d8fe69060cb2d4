"""Synthetic clips, the project's own motions with labels true by making: what they can show."""

from collections.abc import Callable
from dataclasses import dataclass
from itertools import product

import numpy as np

from ...motion.motion import Motion
from . import actions, locomotion
from .rig import FPS, Body, Scene, solve

SPEEDS = ("slow", "normal", "fast")
COUNTS = ("1", "2", "3")
SIDES = ("left", "right", "both")
TURNS = ("left", "right")

LABEL_VALUES: dict[str, tuple[str, ...]] = {
    "action": (
        "stand", "walk", "run", "turn", "side-step", "wave", "raise", "squat", "jump",
        "kick", "punch", "bow", "clap", "crouch-walk", "spin",
    ),
    "direction": ("forward", "backward", "left", "right", "up"),
    "speed": SPEEDS,
    "turn": TURNS,
    "angle": ("90", "180"),
    "side": SIDES,
    "count": COUNTS,
}  # fmt: skip
"""Every key and value that `SyntheticSpec.labels` may hold."""

_FAMILIES: tuple[dict[str, tuple[str, ...]], ...] = (
    {"action": ("stand",)},
    {"action": ("walk",), "direction": ("forward", "backward", "left", "right"), "speed": SPEEDS},
    {"action": ("walk",), "direction": ("forward",), "speed": SPEEDS, "turn": TURNS},
    {"action": ("run",), "direction": ("forward",), "speed": SPEEDS},
    {"action": ("run",), "direction": ("forward",), "speed": SPEEDS, "turn": TURNS},
    {"action": ("turn",), "direction": TURNS, "angle": LABEL_VALUES["angle"]},
    {"action": ("side-step",), "direction": TURNS, "speed": SPEEDS},
    {"action": ("wave",), "side": SIDES, "speed": SPEEDS},
    {"action": ("raise",), "side": SIDES, "speed": SPEEDS},
    {"action": ("squat",), "count": COUNTS, "speed": SPEEDS},
    {"action": ("jump",), "direction": ("up", "forward"), "count": COUNTS},
    {"action": ("kick",), "side": TURNS, "count": COUNTS},
    {"action": ("punch",), "side": TURNS, "count": COUNTS},
    {"action": ("bow",), "count": COUNTS},
    {"action": ("clap",), "count": COUNTS},
    {"action": ("crouch-walk",), "direction": ("forward",), "speed": SPEEDS},
    {"action": ("spin",), "direction": TURNS},
)

# m/s; neighbours differ by a third at least, so that "slow" and "fast" can be told apart.
SPEED_METRES: dict[tuple[str, str], tuple[float, float, float]] = {
    ("walk", "forward"): (0.7, 1.2, 1.7),
    ("walk", "backward"): (0.45, 0.75, 1.1),
    ("walk", "left"): (0.4, 0.65, 0.95),
    ("walk", "right"): (0.4, 0.65, 0.95),
    ("run", "forward"): (2.4, 3.2, 4.2),
    ("side-step", "left"): (0.25, 0.39, 0.60),
    ("side-step", "right"): (0.25, 0.39, 0.60),
    ("crouch-walk", "forward"): (0.45, 0.75, 1.1),
}


def label_combinations() -> list[dict[str, str]]:
    """Every combination of labels the source knows, in a fixed order."""
    return [
        dict(zip(family, values, strict=True))
        for family in _FAMILIES
        for values in product(*family.values())
    ]


def speed_metres(labels: dict[str, str]) -> float:
    """Travelling speed in m/s that the labels name."""
    speeds = SPEED_METRES[labels["action"], labels["direction"]]
    return speeds[SPEEDS.index(labels["speed"])]


# Drawn uniformly for every clip; 1 is neutral for factors, 0 for the others.
_PARAMETER_RANGES: dict[str, tuple[float, float]] = {
    "tempo": (0.92, 1.08),  # factor on durations' inverse
    "amplitude": (0.85, 1.15),  # factor on how far limbs and trunk move
    "width": (0.85, 1.2),  # factor on the distance between the feet
    "hunch": (-4.0, 9.0),  # degrees the upper back is bent forward
    "gaze": (-4.0, 6.0),  # degrees the head looks down
    "arm_carry": (-3.0, 7.0),  # degrees the arms hang further out
    "elbow_carry": (-6.0, 12.0),  # degrees the elbows are bent further
    "toe_out": (3.0, 12.0),  # degrees the feet point outward
    "swing": (0.7, 1.3),  # factor on arm swing
    "bounce": (0.8, 1.25),  # factor on the pelvis' up and down
    "variant": (0.0, 1.0),  # lets an action choose among its forms
    "entry": (0.0, 1.0),  # how a clip begins and ends: in the middle, from standing, ...
    "length": (0.0, 1.0),  # where the duration lies in its allowed range
}
_SPEED_SPREAD = 0.08  # relative; half the gap between neighbouring speeds stays free


@dataclass(frozen=True)
class SyntheticSpec:
    """A clip to be made.

    Attributes:
        labels: keys and values out of `LABEL_VALUES`, only the keys that apply.
        params: continuous parameters; names and ranges above, "speed" in m/s where it applies.
    """

    labels: dict[str, str]
    params: dict[str, float]


def spec_for(labels: dict[str, str], seed: int) -> SyntheticSpec:
    """A spec with the given labels and parameters drawn from the seed."""
    rng = np.random.default_rng((seed, 71))
    params = {name: float(rng.uniform(*bounds)) for name, bounds in _PARAMETER_RANGES.items()}
    spread = 1.0 + _SPEED_SPREAD * float(rng.uniform(-1, 1))
    if labels["action"] in ("walk", "run", "side-step", "crouch-walk"):
        params["speed"] = speed_metres(labels) * spread
    return SyntheticSpec(dict(labels), params)


def sample_specs(n: int, seed: int) -> list[SyntheticSpec]:
    """`n` specs; every label combination occurs ⌊n/C⌋ or ⌈n/C⌉ times, in shuffled order."""
    rng = np.random.default_rng(seed)
    combinations = label_combinations()
    rounds = -(-n // len(combinations))
    order = np.concatenate([rng.permutation(len(combinations)) for _ in range(rounds)])[:n]
    seeds = rng.integers(0, 2**31, size=n)
    return [spec_for(combinations[i], int(s)) for i, s in zip(order, seeds, strict=True)]


_ACTIONS: dict[str, Callable[[Scene], Body]] = {
    "stand": actions.stand,
    "walk": locomotion.travel,
    "run": locomotion.travel,
    "side-step": locomotion.travel,
    "crouch-walk": locomotion.travel,
    "turn": locomotion.turn_in_place,
    "spin": locomotion.turn_in_place,
    "wave": actions.wave,
    "raise": actions.raise_hands,
    "squat": actions.squat,
    "jump": actions.jump,
    "kick": actions.kick,
    "punch": actions.punch,
    "bow": actions.bow,
    "clap": actions.clap,
}
# Seconds before and after the repetitions, and per repetition at normal tempo.
_COUNTED: dict[str, tuple[float, float]] = {
    "jump": (1.0, 1.55),
    "kick": (1.6, 1.35),
    "punch": (2.0, 0.85),
    "bow": (0.9, 1.6),
    "clap": (2.4, 0.6),
}
_SQUAT_SECONDS = {"slow": 2.3, "normal": 1.56, "fast": 1.1}
_MIN_SECONDS, _MAX_SECONDS = 2.5, 6.0


def _seconds(spec: SyntheticSpec) -> float:
    labels, params = spec.labels, spec.params
    action, length = labels["action"], params["length"]
    if action == "squat":
        seconds = 0.8 + int(labels["count"]) * _SQUAT_SECONDS[labels["speed"]] / params["tempo"]
    elif action in _COUNTED:
        around, each = _COUNTED[action]
        seconds = around + int(labels["count"]) * each / params["tempo"]
    elif action in ("turn", "spin"):
        seconds = {"90": 2.9, "180": 3.8}.get(labels.get("angle", ""), 3.3) + 0.6 * length
    elif action in ("wave", "raise"):
        seconds = (4.4 if labels["speed"] == "slow" else 3.4) + 1.4 * length
    elif "turn" in labels:
        seconds = 3.2 + 2.0 * length
    else:
        seconds = 2.8 + 2.8 * length
    return float(np.clip(seconds, _MIN_SECONDS, _MAX_SECONDS))


def generate_clip(spec: SyntheticSpec, seed: int) -> Motion:
    """The clip a spec describes: [T,22,4] rotations at 30 fps, 2.5 to 6 s, exact contacts.

    The same spec and seed give the same clip; the seed only feeds the slow noise.
    """
    num_frames = round(_seconds(spec) * FPS)
    t = np.arange(num_frames) / FPS
    scene = Scene(t, spec.labels, spec.params, np.random.default_rng(seed))
    return solve(_ACTIONS[spec.labels["action"]](scene))
