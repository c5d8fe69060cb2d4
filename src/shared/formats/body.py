"""The mannequin: round-ended cones fixed to the 22 joints, in metres, in each joint's rest frame.

Every picture of a motion (frame strip, GLB, HTML preview) is made from this one list.
"""

from dataclasses import dataclass

from src.shared.motion.skeleton import JOINT_INDEX, JOINT_NAMES

Point = tuple[float, float, float]


@dataclass(frozen=True)
class Part:
    """A cone with round ends, fixed to one joint.

    Attributes:
        joint: index of the joint that carries it.
        start: centre of the first ball, relative to the joint at rest.
        end: centre of the second ball.
        radii: radius at `start` and at `end`.
        side: "left", "right" or "centre".
    """

    joint: int
    start: Point
    end: Point
    radii: tuple[float, float]
    side: str = "centre"


# Trunk and head: joint, start, end, radii.
_CENTRE: tuple[tuple[str, Point, Point, tuple[float, float]], ...] = (
    ("pelvis", (-0.075, -0.035, -0.005), (0.075, -0.035, -0.005), (0.105, 0.105)),
    ("pelvis", (-0.045, 0.04, 0.0), (0.045, 0.04, 0.0), (0.100, 0.100)),
    ("spine1", (-0.045, 0.02, 0.0), (0.045, 0.02, 0.0), (0.096, 0.096)),
    ("spine2", (-0.06, 0.0, 0.0), (0.06, 0.0, 0.0), (0.100, 0.100)),
    ("spine3", (-0.075, 0.06, 0.0), (0.075, 0.06, 0.0), (0.105, 0.105)),
    ("spine3", (0.0, 0.13, -0.005), (0.0, 0.20, -0.005), (0.080, 0.055)),
    ("neck", (0.0, -0.03, -0.005), (0.0, 0.09, 0.01), (0.056, 0.050)),
    ("head", (0.0, 0.045, 0.025), (0.0, 0.105, 0.010), (0.072, 0.088)),
    ("head", (0.0, 0.035, 0.100), (0.0, 0.055, 0.096), (0.014, 0.009)),
)
# Left limbs; the right ones are their mirror images.
_LEFT: tuple[tuple[str, Point, Point, tuple[float, float]], ...] = (
    ("collar", (0.0, -0.02, 0.0), (0.085, 0.02, 0.0), (0.075, 0.064)),
    ("shoulder", (0.0, 0.0, 0.0), (0.26, 0.0, 0.0), (0.056, 0.041)),
    ("elbow", (0.0, 0.0, 0.0), (0.25, 0.0, 0.0), (0.042, 0.030)),
    ("wrist", (0.025, 0.0, 0.0), (0.085, 0.0, 0.012), (0.031, 0.034)),
    ("wrist", (0.09, 0.0, -0.005), (0.155, -0.005, -0.002), (0.028, 0.019)),
    ("wrist", (0.04, -0.004, 0.025), (0.085, -0.012, 0.06), (0.020, 0.014)),
    ("hip", (0.0, -0.01, 0.0), (0.0, -0.40, 0.0), (0.092, 0.058)),
    ("knee", (0.0, 0.0, 0.0), (0.0, -0.14, -0.012), (0.057, 0.056)),
    ("knee", (0.0, -0.14, -0.012), (0.0, -0.40, 0.0), (0.056, 0.038)),
    ("ankle", (0.0, -0.038, -0.035), (0.0, -0.040, 0.12), (0.040, 0.034)),
    ("foot", (-0.012, 0.010, 0.0), (-0.008, 0.006, 0.065), (0.030, 0.024)),
    ("foot", (0.018, 0.010, 0.0), (0.018, 0.006, 0.045), (0.029, 0.023)),
)


def _build() -> tuple[Part, ...]:
    parts = [Part(JOINT_INDEX[name], *rest) for name, *rest in _CENTRE]  # type: ignore[arg-type]
    for name, (x0, y0, z0), (x1, y1, z1), radii in _LEFT:
        left, right = JOINT_INDEX[f"l_{name}"], JOINT_INDEX[f"r_{name}"]
        parts.append(Part(left, (x0, y0, z0), (x1, y1, z1), radii, "left"))
        parts.append(Part(right, (-x0, y0, z0), (-x1, y1, z1), radii, "right"))
    return tuple(parts)


BODY: tuple[Part, ...] = _build()
JOINT_SIDES: tuple[str, ...] = tuple(
    {"l_": "left", "r_": "right"}.get(name[:2], "centre") for name in JOINT_NAMES
)
# Tips of the chains, for formats that want an end to every bone: joint → offset in metres.
END_SITES: dict[int, Point] = {
    JOINT_INDEX["head"]: (0.0, 0.18, 0.0),
    JOINT_INDEX["l_wrist"]: (0.17, 0.0, 0.0),
    JOINT_INDEX["r_wrist"]: (-0.17, 0.0, 0.0),
    JOINT_INDEX["l_foot"]: (0.0, 0.0, 0.08),
    JOINT_INDEX["r_foot"]: (0.0, 0.0, 0.08),
}
