"""What a recording does not say of itself: its unit of length, its up axis, its rest pose.

Legend: T frames, N source joints.
"""

import numpy as np

from ..errors import UsageError
from ..formats.rig import SourceClip
from .mapping import SkeletonMapping

UNITS: dict[str, float] = {
    "m": 1.0, "cm": 0.01, "mm": 0.001, "in": 0.0254, "ft": 0.3048, "cmu": 0.0254 / 0.45,
}  # fmt: skip
LEGS = 0.82  # metres, hip to ankle of an adult; from a child of six to a giant is 0.5 … 1.1
AXES = ("X", "Y", "Z", "-X", "-Y", "-Z")
STANDING = 0.7  # cosine: how nearly bones of a rest pose must point where a body's do
PELVIS = (0.45, 0.8)  # its height, of the length from ankles to head, when the body stands
SAMPLES = 200  # frames that are looked at


def unit_metres(unit: str) -> float:
    """Metres of a unit of length by name.

    Raises:
        UsageError: no such unit.
    """
    if unit not in UNITS:
        raise UsageError(f"--unit {unit!r} is not known; choose from {', '.join(UNITS)}")
    return UNITS[unit]


def unit_name(metres: float | None) -> str | None:
    """The name of a unit of this length, if it has one."""
    same = (name for name, length in UNITS.items() if abs((metres or 0.0) / length - 1) < 0.01)
    return next(same, None)


def guess_unit(legs: float) -> str:
    """The unit in which legs of this length, hip to ankle, are nearest an adult's."""
    return min(UNITS, key=lambda unit: abs(np.log(max(legs, 1e-12) * UNITS[unit] / LEGS)))


def axis_vector(axis: str) -> np.ndarray:
    """Unit vector [3] of "Y", "-Z", …

    Raises:
        UsageError: no such axis.
    """
    name = axis.upper()
    name = name[1:] if name[:1] == "+" and "-" not in name else name
    if name not in AXES:
        raise UsageError(f"--up {axis!r} is not an axis; choose from {', '.join(AXES)}")
    return np.eye(3)["XYZ".index(name[-1])] * (-1.0 if name[0] == "-" else 1.0)


def upright(axis: str) -> np.ndarray:
    """Rotation [3,3] that turns a world with this up axis into one with +Y up.

    +Z goes onto +Y by a quarter turn about X, so that what faced -Y faces +Z.
    """
    up = axis_vector(axis)
    if abs(up[1]) > 0.5:
        return np.eye(3) if up[1] > 0 else np.diag([1.0, -1.0, -1.0])
    cross = np.cross(up, [0.0, 1.0, 0.0])
    k = np.array([[0, -cross[2], cross[1]], [cross[2], 0, -cross[0]], [-cross[1], cross[0], 0]])
    return np.asarray(np.eye(3) + k + k @ k)


def guess_up(clip: SourceClip, mapping: SkeletonMapping) -> tuple[str, bool]:
    """The up axis, and whether the recording leaves little doubt.

    It is the axis along which the head is above the ankles, on average over the frames. Where
    the body lies or tumbles, or is stretched out along another axis than its rest pose and not
    as high above the origin as one who stands (push-ups, say), the rest pose decides.
    """
    j = joint_indices(clip, mapping)
    stride = max(1, clip.num_frames // SAMPLES)
    positions = clip.every(stride).world()[0]
    ankles = (positions[:, j["l_ankle"]] + positions[:, j["r_ankle"]]) / 2
    body = positions[:, j["head"]] - ankles
    length = np.linalg.norm(body, axis=-1, keepdims=True)
    mean = (body / np.maximum(length, 1e-9)).mean(0)
    rest = rest_frame(clip, mapping)
    stands = _nearest_axis(mean) if np.abs(mean).max() > STANDING else None
    rests = _nearest_axis(rest[1]) if rest is not None else None
    if stands and rests not in (None, stands):
        height = np.median(positions[:, j["pelvis"]] @ axis_vector(stands)) / np.median(length)
        stands = stands if PELVIS[0] < height < PELVIS[1] else None
    return stands or rests or "Y", stands is not None


def _nearest_axis(direction: np.ndarray) -> str:
    best = int(np.argmax(np.abs(direction)))
    return AXES[best if direction[best] > 0 else best + 3]


def rest_frame(clip: SourceClip, mapping: SkeletonMapping) -> np.ndarray | None:
    """Rows left, up, forward [3,3] of a body that stands in the rest pose, snapped to the axes.

    None when the rest pose is no standing body: bones that all lie along one axis, say.
    """
    j, rest = joint_indices(clip, mapping), rest_positions(clip)
    left = rest[j["l_hip"]] - rest[j["r_hip"]] + rest[j["l_shoulder"]] - rest[j["r_shoulder"]]
    body = rest[j["head"]] - rest[j["pelvis"]]
    legs = [(rest[j[f"{s}_{a}"]] - rest[j[f"{s}_{b}"]]) for s in "lr"
            for a, b in (("hip", "knee"), ("knee", "ankle"))]  # fmt: skip
    for_up = [body, *legs]
    if min(np.linalg.norm(v) for v in (left, *for_up)) < 1e-9:
        return None
    up = sum(v / np.linalg.norm(v) for v in for_up) / len(for_up)
    axes = []
    for vector in (left / np.linalg.norm(left), up):
        best = int(np.argmax(np.abs(vector)))
        if abs(vector[best]) < STANDING:
            return None
        axes.append(np.eye(3)[best] * np.sign(vector[best]))
    if any(v @ axes[1] < 0.5 * np.linalg.norm(v) for v in for_up) or axes[0] @ axes[1]:
        return None
    return np.stack([axes[0], axes[1], np.cross(axes[0], axes[1])])


def rest_positions(clip: SourceClip) -> np.ndarray:
    """Places of the joints at rest [N,3], the first at its own offset."""
    places = clip.offsets.astype(np.float64).copy()
    for joint, parent in enumerate(clip.parents):
        if parent >= 0:
            places[joint] += places[parent]
    return places


def joint_indices(clip: SourceClip, mapping: SkeletonMapping) -> dict[str, int]:
    """Index in the clip of each of our joints that is mapped."""
    index = {name: i for i, name in enumerate(clip.names)}
    return {ours: index[theirs] for ours, theirs in mapping.joints.items()}
