"""What the synthetic source can show: label keys, their values and every combination."""

from itertools import product

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
