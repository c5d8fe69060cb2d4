"""The mannequin of every picture: round-ended cones on the 22 joints, and a smooth skin on them.

The skin lies in mannequin.npz, made of the cones by tests/shared/formats/mannequin_skin.py: whoever
changes the cones runs that. Legend: V vertices, F triangles."""

from dataclasses import dataclass
from functools import lru_cache
from importlib.resources import files

import numpy as np

from ..io.arrays import load_arrays
from ..motion.skeleton import JOINT_INDEX, JOINT_NAMES
from .rig import canonical_rig

Point = tuple[float, float, float]


@dataclass(frozen=True)
class Part:
    """A cone with round ends, fixed to one joint.

    Attributes:
        joint: index of the joint that carries it.
        start: centre of the first ball, relative to the joint at rest.
        end: centre of the second ball.
        radii: radius at `start` and at `end`.
        width: factor by which the cone is wider along X than it is deep.
        group: parts of a group form one limb and meet with equal radii; groups melt together.
        side: "left", "right" or "centre".
    """

    joint: int
    start: Point
    end: Point
    radii: tuple[float, float]
    width: float
    group: str
    side: str


_Row = tuple[str, str, Point, Point, tuple[float, float], float]
# Trunk and head: group, joint, start, end, radii, width.
_CENTRE: tuple[_Row, ...] = (
    ("trunk", "pelvis", (0.0, -0.050, -0.008), (0.0, 0.020, -0.004), (0.098, 0.100), 1.62),
    ("trunk", "pelvis", (0.0, 0.020, -0.004), (0.0, 0.110, 0.0), (0.100, 0.092), 1.50),
    ("trunk", "spine1", (0.0, 0.0, 0.0), (0.0, 0.130, 0.0), (0.092, 0.102), 1.44),
    ("trunk", "spine2", (0.0, 0.0, 0.0), (0.0, 0.060, 0.004), (0.102, 0.108), 1.50),
    ("trunk", "spine3", (0.0, 0.0, 0.004), (0.0, 0.085, 0.004), (0.108, 0.106), 1.56),
    ("trunk", "spine3", (0.0, 0.085, 0.004), (0.0, 0.165, -0.012), (0.106, 0.064), 1.60),
    ("neck", "neck", (0.0, -0.060, -0.012), (0.0, 0.090, 0.006), (0.058, 0.052), 1.0),
    ("head", "head", (0.0, 0.030, 0.032), (0.0, 0.095, 0.008), (0.064, 0.090), 0.94),
    ("nose", "head", (0.0, 0.038, 0.098), (0.0, 0.062, 0.092), (0.013, 0.008), 1.0),
)
# Left limbs; the right ones are their mirror images.
_LEFT: tuple[_Row, ...] = (
    ("shoulder", "collar", (-0.010, -0.010, -0.004), (0.090, 0.018, 0.0), (0.070, 0.060), 1.0),
    ("trapezius", "collar", (-0.055, 0.075, -0.014), (0.070, 0.036, -0.008), (0.036, 0.028), 1.0),
    ("arm", "shoulder", (0.0, 0.0, 0.0), (0.09, 0.0, 0.0), (0.056, 0.052), 1.0),
    ("arm", "shoulder", (0.09, 0.0, 0.0), (0.26, 0.0, 0.0), (0.052, 0.041), 1.0),
    ("arm", "elbow", (0.0, 0.0, 0.0), (0.07, 0.0, 0.0), (0.041, 0.043), 1.0),
    ("arm", "elbow", (0.07, 0.0, 0.0), (0.25, 0.0, 0.0), (0.043, 0.028), 1.0),
    ("hand", "wrist", (0.030, 0.0, -0.008), (0.085, 0.0, -0.014), (0.024, 0.024), 1.0),
    ("hand", "wrist", (0.030, 0.0, 0.008), (0.085, 0.0, 0.016), (0.024, 0.024), 1.0),
    ("fingers", "wrist", (0.085, 0.0, -0.014), (0.160, -0.008, -0.010), (0.019, 0.014), 1.0),
    ("fingers", "wrist", (0.085, 0.0, 0.014), (0.165, -0.008, 0.010), (0.019, 0.014), 1.0),
    ("thumb", "wrist", (0.035, -0.004, 0.022), (0.085, -0.012, 0.058), (0.018, 0.013), 1.0),
    ("leg", "hip", (0.002, 0.0, 0.0), (0.002, -0.120, 0.0), (0.090, 0.080), 1.0),
    ("leg", "hip", (0.002, -0.120, 0.0), (0.0, -0.400, 0.0), (0.080, 0.055), 1.0),
    ("seat", "hip", (-0.006, 0.000, -0.040), (0.0, -0.050, -0.026), (0.076, 0.066), 1.0),
    ("leg", "knee", (0.0, 0.0, 0.0), (0.0, -0.130, -0.012), (0.055, 0.056), 1.0),
    ("leg", "knee", (0.0, -0.130, -0.012), (0.0, -0.400, 0.0), (0.056, 0.037), 1.0),
    ("foot", "ankle", (0.0, -0.034, -0.035), (0.0, -0.039, 0.120), (0.037, 0.032), 1.0),
    ("toes", "foot", (-0.014, 0.013, 0.0), (-0.010, 0.009, 0.068), (0.025, 0.021), 1.0),
    ("toes", "foot", (0.016, 0.013, 0.0), (0.016, 0.009, 0.048), (0.025, 0.021), 1.0),
)


def _build() -> tuple[Part, ...]:
    parts = []
    for group, name, start, end, radii, width in _CENTRE:
        parts.append(Part(JOINT_INDEX[name], start, end, radii, width, group, "centre"))
    for group, name, (x0, y0, z0), (x1, y1, z1), radii, width in _LEFT:
        left, right = JOINT_INDEX[f"l_{name}"], JOINT_INDEX[f"r_{name}"]
        parts.append(Part(left, (x0, y0, z0), (x1, y1, z1), radii, width, group, "left"))
        parts.append(Part(right, (-x0, y0, z0), (-x1, y1, z1), radii, width, group, "right"))
    return tuple(parts)


BODY: tuple[Part, ...] = _build()
# RGB of the limbs of each side, 0 to 1, in every picture and viewer.
COLOURS = {"left": (0.93, 0.52, 0.24), "right": (0.27, 0.52, 0.86), "centre": (0.72, 0.74, 0.78)}
CONTACT = (0.25, 0.72, 0.38)  # a foot on the ground
JOINT_SIDES: tuple[str, ...] = tuple(
    {"l_": "left", "r_": "right"}.get(name[:2], "centre") for name in JOINT_NAMES
)


@dataclass(frozen=True, eq=False)
class Mannequin:
    """A skinned mesh in the rest pose (T-pose, pelvis at its rest height, facing +Z).

    Attributes:
        vertices: [V,3] float32, metres.
        normals: [V,3] float32, unit length.
        triangles: [F,3] int32, counter-clockwise seen from outside.
        joints: the four joints that move each vertex [V,4] uint8, heaviest first.
        weights: their shares [V,4] float32, summing to 1.
        side: [V] float32, 1 on the left limbs, -1 on the right ones, 0 on the trunk.
        rest: rest position of each joint [22,3] float32.
    """

    vertices: np.ndarray
    normals: np.ndarray
    triangles: np.ndarray
    joints: np.ndarray
    weights: np.ndarray
    side: np.ndarray
    rest: np.ndarray

    def pose(self, positions: np.ndarray, rotations: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Linear blend skinning: vertices [V,3] and normals [V,3] of one pose.

        Args:
            positions: world joint positions [22,3].
            rotations: world joint rotations [22,3,3].
        """
        moved = np.zeros((len(self.vertices), 3))
        normals = np.zeros((len(self.vertices), 3))
        for joint, weight in zip(self.joints.T, self.weights.T, strict=True):
            turn, share = rotations[joint], weight[:, None]
            local = self.vertices - self.rest[joint]
            moved += share * (np.einsum("vij,vj->vi", turn, local) + positions[joint])
            normals += share * np.einsum("vij,vj->vi", turn, self.normals)
        return moved, normals / np.linalg.norm(normals, axis=-1, keepdims=True)


@lru_cache(maxsize=1)
def mannequin() -> Mannequin:
    """The one mannequin."""
    arrays = load_arrays(files(__package__).joinpath("mannequin.npz").read_bytes())
    return Mannequin(**arrays, rest=canonical_rig().rest().astype(np.float32))


def side_colours(side: np.ndarray) -> np.ndarray:
    """RGB [V,3] of places between the right (-1), the trunk (0) and the left (1)."""
    right, trunk, left = (np.array(COLOURS[name]) for name in ("right", "centre", "left"))
    share = side[:, None]
    mixed = trunk + np.maximum(share, 0) * (left - trunk) + np.maximum(-share, 0) * (right - trunk)
    return np.asarray(mixed)


def whole_shares(weights: np.ndarray, total: int) -> np.ndarray:
    """Weights [V,4] (heaviest first, summing to 1) as integers that sum to `total` exactly."""
    shares = np.floor(weights.astype(np.float64) * total).astype(np.int64)
    shares[:, 0] += total - shares.sum(-1)
    return shares
