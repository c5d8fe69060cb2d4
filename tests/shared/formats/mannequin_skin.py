"""The skin over the mannequin's cones, as mannequin.npz holds it.

A smooth union of distance fields on a grid, turned into triangles by naive surface nets (Gibson
1998, "Constrained elastic surface nets"), then pulled onto the exact surface. Remade by

    python -m tests.shared.formats.mannequin_skin

Legend: V vertices, F triangles, P points.
"""

from collections.abc import Callable
from pathlib import Path

import numpy as np

from src.shared.formats import mannequin
from src.shared.formats.mannequin import BODY, JOINT_SIDES, Part
from src.shared.formats.rig import canonical_rig
from src.shared.io.arrays import write_arrays
from src.shared.motion.skeleton import PARENTS

SPACING = 0.019  # metres between grid points
BLEND = 0.040  # metres over which groups of cones melt into each other
SEAM = 0.012  # metres over which the cones of one group do
SOFTNESS = 0.016  # metres over which skin weights pass from one joint to the next
_Piece = Callable[[int], tuple[tuple[slice, ...], np.ndarray]]
FAR = 1.0  # metres: "not near anything"


def skin() -> dict[str, np.ndarray]:
    """The arrays of mannequin.npz, by the fields of `Mannequin`."""
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
    return {
        "vertices": vertices.astype(np.float32),
        "normals": normals.astype(np.float32),
        "triangles": triangles.astype(np.int32),
        "joints": joints.astype(np.uint8),
        "weights": weights.astype(np.float32),
        "side": (sides[joints] * weights).sum(-1).astype(np.float32),
    }


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


if __name__ == "__main__":
    write_arrays(skin(), Path(mannequin.__file__).with_suffix(".npz"), compressed=True)
