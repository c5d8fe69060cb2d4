"""The mannequin of every picture: round-ended cones on the 22 joints, and a smooth skin on them.

Our own shape, computed when first needed (about 0.3 s): a smooth union of distance fields on a
grid, turned into triangles by naive surface nets (Gibson 1998, "Constrained elastic surface
nets"), then pulled onto the exact surface. Legend: V vertices, F triangles, P points, M cones."""

from collections.abc import Callable
from dataclasses import dataclass
from functools import lru_cache

import numpy as np

from ..motion.skeleton import JOINT_INDEX, JOINT_NAMES, PARENTS
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


SPACING = 0.019  # metres between grid points
BLEND = 0.040  # metres over which groups of cones melt into each other
SEAM = 0.012  # metres over which the cones of one group do
SOFTNESS = 0.016  # metres over which skin weights pass from one joint to the next
_Piece = Callable[[int], tuple[tuple[slice, ...], np.ndarray]]
FAR = 1.0  # metres: "not near anything"


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
    """The one mannequin, built on first use."""
    rest = canonical_rig().rest()
    cones = _Cones(rest)
    corners, triangles = _surface_nets(*cones.grid())
    vertices = corners
    for _ in range(2):  # Newton steps onto the surface
        distance, normals = cones.field_and_normals(vertices)
        vertices = vertices - distance[:, None] * normals
    normals = cones.field_and_normals(vertices)[1]
    joints, weights = _skin_weights(cones.joint_distances(vertices))
    sides = np.array([{"left": 1.0, "right": -1.0, "centre": 0.0}[side] for side in JOINT_SIDES])
    return Mannequin(
        vertices.astype(np.float32),
        normals.astype(np.float32),
        triangles.astype(np.int32),
        joints.astype(np.uint8),
        weights.astype(np.float32),
        (sides[joints] * weights).sum(-1).astype(np.float32),
        rest.astype(np.float32),
    )


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


class _Cones:
    """Distance fields of the body's cones in the rest pose."""

    def __init__(self, rest: np.ndarray) -> None:
        self.parts: tuple[Part, ...] = BODY
        self.starts = np.array([rest[p.joint] + p.start for p in BODY])
        self.ends = np.array([rest[p.joint] + p.end for p in BODY])

    def distance(self, points: np.ndarray, index: int) -> np.ndarray:
        """Signed distance [...] of points [...,3] to one cone, negative inside."""
        stretch = np.array([1.0 / self.parts[index].width, 1.0, 1.0])
        axis = (self.ends[index] - self.starts[index]) * stretch
        local = (points - self.starts[index]) * stretch
        s = np.clip(local @ axis / (axis @ axis), 0.0, 1.0)
        r0, r1 = self.parts[index].radii
        gap = local - s[..., None] * axis
        return np.asarray(np.sqrt(np.einsum("...i,...i", gap, gap)) - (r0 + s * (r1 - r0)))

    def field(self, points: np.ndarray) -> np.ndarray:
        """Signed distance [P] to the whole body."""
        everywhere = (slice(None),)
        return self._melt((len(points),), lambda index: (everywhere, self.distance(points, index)))

    def grid(self) -> tuple[np.ndarray, np.ndarray]:
        """Origin [3] and field values [X,Y,Z] on a grid; each cone fills only its own box."""
        reach = np.array([max(p.radii) * np.array([p.width, 1, 1]) for p in self.parts])
        reach += BLEND + 2 * SPACING
        low = np.minimum(self.starts, self.ends) - reach
        high = np.maximum(self.starts, self.ends) + reach
        origin = np.floor(low.min(0) / SPACING) * SPACING
        shape = np.ceil((high.max(0) - origin) / SPACING).astype(int) + 1

        def one(index: int) -> tuple[tuple[slice, ...], np.ndarray]:
            first = np.floor((low[index] - origin) / SPACING).astype(int)
            last = np.ceil((high[index] - origin) / SPACING).astype(int) + 1
            box = tuple(slice(a, b) for a, b in zip(first, last, strict=True))
            axes = [origin[i] + SPACING * np.arange(shape[i])[box[i]] for i in range(3)]
            return box, self.distance(np.stack(np.meshgrid(*axes, indexing="ij"), -1), index)

        return origin, self._melt(tuple(shape), one)

    def _melt(self, shape: tuple[int, ...], one: _Piece) -> np.ndarray:
        """Join the distances `one(index)` gives for a region of the whole, group by group.

        Each side melts into the trunk, but left and right never into each other: the thighs
        must come apart when the legs do.
        """
        sides = {}
        for side in ("centre", "left", "right"):
            whole = np.full(shape, FAR)
            for group in dict.fromkeys(part.group for part in self.parts if part.side == side):
                limb = np.full(shape, FAR)
                for index, part in enumerate(self.parts):
                    if (part.side, part.group) == (side, group):
                        where, distance = one(index)
                        limb[where] = _smooth_min(limb[where], distance, SEAM)
                whole = _smooth_min(whole, limb, BLEND)
            sides[side] = whole
        left, right = (_smooth_min(sides[s], sides["centre"], BLEND) for s in ("left", "right"))
        return np.asarray(np.minimum(left, right))

    def field_and_normals(self, points: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Signed distance [P] and unit outward normals [P,3], by differences over 0.5 mm."""
        here = self.field(points)
        slope = np.stack([self.field(points + step) - here for step in 5e-4 * np.eye(3)], -1)
        return here, slope / np.linalg.norm(slope, axis=-1, keepdims=True)

    def joint_distances(self, points: np.ndarray) -> np.ndarray:
        """Distance [P,22] to the nearest cone of each joint."""
        result = np.full((len(points), len(PARENTS)), FAR)
        for index, part in enumerate(self.parts):
            result[:, part.joint] = np.minimum(result[:, part.joint], self.distance(points, index))
        return result


def _smooth_min(first: np.ndarray, second: np.ndarray, reach: float) -> np.ndarray:
    """Quadratic smooth minimum: equals the minimum where the two differ by `reach` or more."""
    overlap = np.maximum(reach - np.abs(first - second), 0.0)
    return np.asarray(np.minimum(first, second) - overlap**2 / (4 * reach))


def _skin_weights(distances: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """The four nearest joints [V,4] and their weights [V,4] from distances [V,22].

    Only the nearest joint and its neighbours in the tree take part, so that a hand never moves
    a hip it hangs beside.
    """
    neighbour = np.eye(len(PARENTS), dtype=bool)
    for joint, parent in enumerate(PARENTS):
        if parent >= 0:
            neighbour[joint, parent] = neighbour[parent, joint] = True
    nearest = distances.argmin(-1)
    share = np.exp(-(distances - distances.min(-1, keepdims=True)) / SOFTNESS)
    share *= neighbour[nearest]
    joints = np.argsort(-share, axis=-1, kind="stable")[:, :4]
    weights = np.take_along_axis(share, joints, -1)
    weights[weights < 0.02] = 0.0
    joints[weights == 0.0] = 0
    return joints, weights / weights.sum(-1, keepdims=True)


def _surface_nets(origin: np.ndarray, field: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Vertices [V,3] and outward triangles [F,3] of the zero surface of a grid field.

    One vertex for each cell that the surface crosses, at the mean of its edge crossings; one
    quad around each grid edge whose ends have different signs.
    """
    cells = np.array(
        [
            field[i : i - 1 or None, j : j - 1 or None, k : k - 1 or None]
            for i in (0, 1)
            for j in (0, 1)
            for k in (0, 1)
        ]
    )  # [8,...] fmt: skip
    inside = cells < 0
    crossed = inside.any(0) & ~inside.all(0)
    values = cells[:, crossed]  # [8,V]
    corner = np.array([(i, j, k) for i in (0, 1) for j in (0, 1) for k in (0, 1)], dtype=float)
    total, count = np.zeros((values.shape[1], 3)), np.zeros(values.shape[1])
    for a in range(8):
        for b in range(a + 1, 8):
            if np.abs(corner[a] - corner[b]).sum() == 1:
                cut = (values[a] < 0) != (values[b] < 0)
                t = values[a, cut] / (values[a, cut] - values[b, cut])
                total[cut] += corner[a] + t[:, None] * (corner[b] - corner[a])
                count[cut] += 1
    index = np.full(crossed.shape, -1)
    index[crossed] = np.arange(crossed.sum())
    vertices = origin + SPACING * (np.argwhere(crossed) + total / count[:, None])
    return vertices, np.concatenate([_quads(field < 0, index, axis) for axis in range(3)])


def _quads(inside: np.ndarray, index: np.ndarray, axis: int) -> np.ndarray:
    """Triangles around the grid edges along one axis that leave or enter the body."""
    front = np.moveaxis(inside, axis, 0)  # cyclic order keeps the winding the same for all axes
    cells = np.moveaxis(index, axis, 0)
    if axis == 1:
        front, cells = front.swapaxes(1, 2), cells.swapaxes(1, 2)
    a, b = front[:-1, 1:-1, 1:-1], front[1:, 1:-1, 1:-1]
    around = [cells[:, :-1, :-1], cells[:, 1:, :-1], cells[:, 1:, 1:], cells[:, :-1, 1:]]
    result = []
    for leaves in (True, False):
        where = (a & ~b) if leaves else (~a & b)
        p, q, r, s = (corners[where] for corners in (around if leaves else around[::-1]))
        result += [np.stack((p, q, r), -1), np.stack((p, r, s), -1)]
    return np.concatenate(result)
