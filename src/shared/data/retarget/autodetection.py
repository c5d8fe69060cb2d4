"""What a recording does not say of itself: its unit, its up axis, its rest pose, its joints' axes.

Files of some suites (LaFAN1, MotionBuilder) rest with all bones along one axis, which tells bone
lengths and nothing more. Where their axes point in a T-pose, when no profile says it either: pelvis
and chest carry several bones, which fix their axes; knees and elbows bend one way only, which fixes
those of thigh and upper arm; a chain whose bones lie alike keeps its axes; and of any other joint,
people do not stay twisted: averaged over the recording its twist against its parent is taken to be
none. Legend: T frames, N source joints.
"""

import numpy as np
from scipy.spatial.transform import Rotation

from ...errors import UsageError
from ...formats.readers.humanml import BENDS, LEFT, UP
from ...formats.rig import SourceClip, rest_positions, swing, units
from ...motion.skeleton import JOINT_INDEX, JOINT_NAMES, PARENTS, canonical_skeleton
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
    """Metres of a unit of length by name; raises UsageError where there is none."""
    if unit not in UNITS:
        raise UsageError(f"--unit {unit!r} is not known; choose from {', '.join(UNITS)}")
    return UNITS[unit]


def unit_name(metres: float | None) -> str | None:
    """The name of a unit of this length, if it has one."""
    same = (name for name, length in UNITS.items() if abs((metres or 0.0) / length - 1) < 0.01)
    return next(same, None)


def detect_unit(legs: float) -> str:
    """The unit in which legs of this length, hip to ankle, are nearest an adult's."""
    return min(UNITS, key=lambda unit: abs(np.log(max(legs, 1e-12) * UNITS[unit] / LEGS)))


def axis_vector(axis: str) -> np.ndarray:
    """Unit vector [3] of "Y", "-Z", …; raises UsageError for what is no axis."""
    name = axis.upper()
    name = name[1:] if name[:1] == "+" and "-" not in name else name
    if name not in AXES:
        raise UsageError(f"--up {axis!r} is not an axis; choose from {', '.join(AXES)}")
    return np.asarray(np.eye(3)["XYZ".index(name[-1])] * (-1.0 if name[0] == "-" else 1.0))


def upright(axis: str) -> np.ndarray:
    """Rotation [3,3] that turns a world with this up axis into one with +Y up.

    +Z goes onto +Y by a quarter turn about X, so that what faced -Y faces +Z.
    """
    up = axis_vector(axis)
    return np.diag([1.0, -1.0, -1.0]) if up[1] < 0 else aligned(up, UP)


def aligned(start: np.ndarray, end: np.ndarray) -> np.ndarray:
    """Smallest rotation [3,3] that turns direction `start` [3] into direction `end` [3]."""
    return np.asarray(swing(units(start), units(end)[None])[0])


def detect_up(clip: SourceClip, mapping: SkeletonMapping) -> tuple[str, bool]:
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
    j, rest = joint_indices(clip, mapping), rest_positions(clip.parents, clip.offsets)
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


def joint_indices(clip: SourceClip, mapping: SkeletonMapping) -> dict[str, int]:
    """Index in the clip of each of our joints that is mapped."""
    index = {name: i for i, name in enumerate(clip.names)}
    return {ours: index[theirs] for ours, theirs in mapping.joints.items()}


# Joints that carry several bones: what lies left, right and above in their own axes.
_FRAMES = {"pelvis": ("l_hip", "r_hip", ("spine1", "spine2", "spine3", "neck")),
           "spine3": ("l_shoulder", "r_shoulder", ("neck", "head"))}  # fmt: skip
BENT = 0.1  # mean sine of the bend below which it tells nothing
NEAR = np.pi / 3  # a joint without a bone keeps its parent's axes, if they are this near
ALIKE = 0.98  # cosine: two bones of a chain lie alike; a bone lies along an axis


def calibrated_axes(
    clip: SourceClip, mapping: SkeletonMapping, aim: dict[str, str]
) -> dict[str, np.ndarray]:
    """Rotation [3,3] of each of our mapped joints: its source's axes in the T-pose.

    Args:
        aim: our joint -> the child whose bone it aims.
    """
    found: dict[str, np.ndarray] = {}
    look = _Look(clip, mapping)
    for ours in sorted(mapping.joints, key=JOINT_NAMES.index):
        above = _mapped_parent(ours, found)
        child = aim.get(ours)
        bone = look.bone(ours, child)
        rest = canonical_skeleton().offsets[JOINT_INDEX[child or ours]].astype(np.float64)
        axes = look.branching(ours, required=above is None)
        if axes is None and above is not None:
            if bone is None:
                axes = _mean_rotation(look.relative(ours, above, found[above]))
                near = np.trace(axes.T @ found[above]) > 1 + 2 * np.cos(NEAR)
                axes = found[above] if near else axes
            else:
                axes = look.bending(ours, bone, rest)
            if axes is None and bone is not None and _alike(found[above] @ bone, rest):
                axes = found[above]
            if axes is None and bone is not None:
                relative = look.relative(ours, above, found[above])
                axes = _untwisted(relative, aligned(bone, rest), rest)
        if axes is None:
            axes = np.eye(3)
        found[ours] = _snapped(axes) if bone is None or np.abs(bone).max() > ALIKE else axes
    return found


class _Look:
    """Frames of a clip, and what they say of its joints."""

    def __init__(self, clip: SourceClip, mapping: SkeletonMapping) -> None:
        stride = max(1, clip.num_frames // SAMPLES)
        self.positions, self.world = clip.every(stride).world()
        self.index = joint_indices(clip, mapping)
        self.reach = max(1e-9, float(np.abs(clip.offsets).max()))

    def steps(self, start: str, end: str, frame_of: str) -> np.ndarray:
        """From one joint to another in the axes of a third [T,3]."""
        step = self.positions[:, self.index[end]] - self.positions[:, self.index[start]]
        return np.asarray((step[:, None] @ self.world[:, self.index[frame_of]])[:, 0])

    def bone(self, ours: str, child: str | None) -> np.ndarray | None:
        """Direction [3] of a joint's bone in its own axes; None if it has none."""
        if child not in self.index or child is None:
            return None
        bone = self.steps(ours, child, ours).mean(0)
        length = np.linalg.norm(bone)
        return bone / length if length > 1e-6 * self.reach else None

    def relative(self, ours: str, above: str, axes: np.ndarray) -> np.ndarray:
        """Rotation of a joint against a parent with known axes [T,3,3]."""
        parent = self.world[:, self.index[above]] @ axes.T
        return np.asarray(np.swapaxes(parent, -1, -2) @ self.world[:, self.index[ours]])

    def branching(self, ours: str, *, required: bool) -> np.ndarray | None:
        """Axes [3,3] of a joint that carries several bones."""
        if ours not in _FRAMES and not required:
            return None
        left, right, higher = _FRAMES.get(ours, _FRAMES["pelvis"])
        up = next(name for name in higher if name in self.index)
        across = self.steps(right, left, ours).mean(0)
        return _frame(across, self.steps(ours, up, ours).mean(0), LEFT, UP)

    def bending(self, ours: str, bone: np.ndarray, rest: np.ndarray) -> np.ndarray | None:
        """Axes [3,3] of a limb's upper joint, by the way the limb bends."""
        if ours not in BENDS:
            return None
        middle, end, hinge = BENDS[ours]
        lower = units(self.steps(middle, end, ours))
        normals = np.cross(bone, lower)  # length: sine of the bend
        mean = normals.mean(0)
        if np.linalg.norm(mean) < max(BENT, 0.7 * np.linalg.norm(normals, axis=-1).mean()):
            return None
        return _frame(bone, mean, rest, hinge)


def _mapped_parent(ours: str, found: dict[str, np.ndarray]) -> str | None:
    """The nearest of our joints above that is mapped."""
    joint = PARENTS[JOINT_INDEX[ours]]
    while joint >= 0 and JOINT_NAMES[joint] not in found:
        joint = PARENTS[joint]
    return JOINT_NAMES[joint] if joint >= 0 else None


def _frame(
    first: np.ndarray, second: np.ndarray, onto: np.ndarray, near: np.ndarray
) -> np.ndarray | None:
    """Rotation [3,3] that turns `first` onto `onto` and `second` near `near`; None if undefined."""
    sides = []
    for one, other in ((onto, near), (first, second)):
        size = np.linalg.norm(one) * np.linalg.norm(other)
        third = np.cross(one, other)
        if size < 1e-12 or np.linalg.norm(third) < 0.5 * size:
            return None
        one, third = one / np.linalg.norm(one), third / np.linalg.norm(third)
        sides.append(np.stack([one, np.cross(third, one), third]))
    return np.asarray(sides[0].T @ sides[1])


def _alike(one: np.ndarray, other: np.ndarray) -> bool:
    return bool(one @ other > ALIKE * np.linalg.norm(one) * np.linalg.norm(other))


def _snapped(axes: np.ndarray) -> np.ndarray:
    """The nearest rotation that takes axes to axes."""
    result, left = np.zeros((3, 3)), np.abs(axes)
    for _ in range(3):
        row, column = np.unravel_index(np.argmax(left), (3, 3))
        result[row, column] = np.sign(axes[row, column])
        left[row], left[:, column] = -1.0, -1.0
    return result if np.linalg.det(result) > 0 else axes


def _untwisted(relative: np.ndarray, first: np.ndarray, rest: np.ndarray) -> np.ndarray:
    """`first`, turned about the bone so that the mean twist against the parent is none.

    Args:
        relative: the joint's rotation against its parent in our axes [T,3,3].
        rest: the bone in the T-pose [3].
    """
    axis = units(rest)
    local = relative @ first.T
    # Twice the quaternion's w and its part along the axis, up to one factor per frame: their
    # angle is the twist (swing–twist), their length its weight (none at half a turn of swing).
    w = 1 + np.trace(local, axis1=-2, axis2=-1)
    skew = np.stack([local[:, 2, 1] - local[:, 1, 2], local[:, 0, 2] - local[:, 2, 0],
                     local[:, 1, 0] - local[:, 0, 1]], -1)  # fmt: skip
    twist = 2 * np.arctan2(skew @ axis, w)
    weight = w**2 + (skew @ axis) ** 2
    angle = np.arctan2((weight * np.sin(twist)).sum(), (weight * np.cos(twist)).sum())
    return np.asarray(Rotation.from_rotvec(angle * axis).as_matrix() @ first)


def _mean_rotation(rotations: np.ndarray) -> np.ndarray:
    """The rotation nearest to the mean of rotations [T,3,3]."""
    u, _, v = np.linalg.svd(rotations.mean(0))
    return np.asarray(u @ np.diag([1.0, 1.0, np.sign(np.linalg.det(u @ v)) or 1.0]) @ v)
