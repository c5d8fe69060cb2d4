"""Kinetic and geometric features of a body or a pelvis, and FID and diversity in them.

Kinetic: Onuma et al. 2008, as AIST++ (Li et al. 2021, §5.2) has them: three figures a joint.
Geometric: 32 of the relations of Müller et al. 2005, each the share of frames in which it holds.
Lengths are in those of the skeleton: hl the upper arm, sw and hw the width of shoulders and hips.
Normalised by the real motions as in Bailando (Siyao et al. 2022). 66 kinetic and 32 geometric
features of a body; 5 and 12 of a 25-d trajectory, a reduced variant of our own.

Never beside figures of the published code. Mended here: it divides only one of two positions by the
frame time in the acceleration, so that a pose far from the origin "accelerates"; takes 1/60 or
1/120 s a frame whatever the frame rate; two velocity features look at the chest instead of the
wrist; the plane features of left and right look opposite ways.

Letters: T frames, K joints, F features, W windows, N and M motions, A principal axes.
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import torch
from scipy.spatial.distance import pdist

from ..motion.features import ahead_and_left
from ..motion.motion import Motion
from ..motion.rotations import angular_velocity
from ..motion.skeleton import JOINT_INDEX, JOINT_NAMES, REST_PELVIS_HEIGHT, canonical_skeleton
from ..motion.trajectory import MotionTrajectory
from .frechet import Projection, frechet_distance

WINDOW = 2  # frames on either side of a velocity or an acceleration

_OFFSETS = canonical_skeleton().offsets
UPPER_ARM = float(np.linalg.norm(_OFFSETS[JOINT_INDEX["l_elbow"]]))  # hl, metres
SHOULDERS = float(
    2 * abs(_OFFSETS[JOINT_INDEX["l_collar"], 0] + _OFFSETS[JOINT_INDEX["l_shoulder"], 0])
)  # sw
HIPS = float(2 * abs(_OFFSETS[JOINT_INDEX["l_hip"], 0]))  # hw

Array = np.ndarray


def windowed_mean(values: Array) -> Array:
    """Mean [W, ...] of values [W, ...] over two neighbours on either side, fewer at the ends."""
    total = np.concatenate((np.zeros_like(values[:1]), values.cumsum(0)))
    at = np.arange(len(values))
    low, high = np.maximum(at - WINDOW, 0), np.minimum(at + WINDOW + 1, len(values))
    count = (high - low).reshape(-1, *[1] * (values.ndim - 1))
    return np.asarray((total[high] - total[low]) / count)


def _checked(points: Array) -> Array:
    if len(points) < 3:
        raise ValueError(f"{len(points)} frames have no acceleration: at least 3 are needed")
    if not np.isfinite(points).all():
        raise ValueError("positions hold NaN or infinity")
    return points.astype(np.float64)


def kinetic_features(points: Array, fps: float) -> Array:
    """Mean squared horizontal and vertical speed and mean acceleration of each joint of
    points [T, K, 3] in metres in the world, y up: [K, 3] in m²/s², m²/s², m/s².
    Means over five frames. Turning about y, moving anywhere, playing backwards change nothing.
    Raises ValueError: fewer than 3 frames, NaN or infinity."""
    path = _checked(points)
    velocity = windowed_mean(np.diff(path, axis=0)) * fps  # T-1 K 3
    acceleration = windowed_mean(np.diff(path, n=2, axis=0)) * fps**2  # T-2 K 3
    return np.stack(
        (
            (velocity[..., [0, 2]] ** 2).sum(-1).mean(0),
            (velocity[..., 1] ** 2).mean(0),
            np.linalg.norm(acceleration, axis=-1).mean(0),
        ),
        -1,
    )


# ---------------------------------------------------------------- geometric features of a body


class _Body:
    """Joint positions [T-1, 3] of every frame but the last, and what is said of them."""

    def __init__(self, points: Array, fps: float, side: str = "r") -> None:
        self.now, self.velocity = points[:-1], np.diff(points, axis=0) * fps  # T-1 K 3
        self.side = side

    def _index(self, name: str) -> int:
        """`hand` is this side's, `other hand` the other side's; the middle has no side."""
        name = {"hand": "wrist", "other hand": "other wrist"}.get(name, name)
        if name in JOINT_INDEX:
            return JOINT_INDEX[name]
        side = {"r": "l", "l": "r"}[self.side] if name.startswith("other ") else self.side
        return JOINT_INDEX[f"{side}_{name.removeprefix('other ')}"]

    def at(self, name: str) -> Array:
        return self.now[:, self._index(name)]

    def to(self, start: str, end: str) -> Array:
        """Vector [T-1, 3] from one joint to another."""
        return np.asarray(self.at(end) - self.at(start))

    def relative(self, name: str, to: str) -> Array:
        """Velocity [T-1, 3] of one joint seen from another."""
        return self.velocity[:, self._index(name)] - self.velocity[:, self._index(to)]

    def speed(self, name: str) -> Array:
        return np.asarray(np.linalg.norm(self.velocity[:, self._index(name)], axis=-1))

    def height(self, name: str) -> Array:
        """Metres above the lowest joint."""
        return np.asarray(self.at(name)[:, 1] - self.now[..., 1].min(1))

    def front(self) -> Array:
        """Normal [T-1, 3] of the plane of neck and hips, forwards."""
        return np.cross(self.to("neck", "r_hip"), self.to("neck", "l_hip"))


def _along(vector: Array, direction: Array) -> Array:
    """Component [T-1] of a vector along a direction; 0 where there is no direction."""
    length = np.linalg.norm(direction, axis=-1)
    return np.asarray((vector * direction).sum(-1) / np.where(length > 1e-9, length, np.inf))


def _angle(a: Array, b: Array) -> Array:
    """Degrees [T-1] between two vectors."""
    across = np.linalg.norm(np.cross(a, b), axis=-1)
    return np.asarray(np.degrees(np.arctan2(across, (a * b).sum(-1))))


def _of_one_side(body: _Body) -> dict[str, Array]:
    """What holds of the right or the left side: bool [T-1] each, 13 relations."""
    hl, to, front = UPPER_ARM, body.to, body.front()
    leg = np.cross(to("pelvis", "other hip"), to("pelvis", "other foot"))
    forwards = np.where((_along(leg, front) < 0)[:, None], -leg, leg)
    spine, thigh = to("pelvis", "neck"), to("hip", "knee")
    away = {name: body.relative("hand", name) for name in ("neck", "spine3", "pelvis")}
    return {
        "hand forwards": _along(away["neck"], front) > 1.8 * hl,
        "hand above neck": _along(to("neck", "hand"), to("spine3", "neck")) > 0.2 * hl,
        "hand upwards": _along(away["spine3"], to("spine1", "spine3")) > 1.8 * hl,
        "elbow bent": _angle(to("elbow", "shoulder"), to("elbow", "hand")) < 110,
        "hand leaves pelvis": _along(away["pelvis"], to("pelvis", "hand")) > 1.4 * hl,
        "hand fast": body.speed("hand") > 2.5 * hl,
        "foot before other leg": _along(to("pelvis", "ankle"), forwards) > 0.38 * hl,
        "foot raised": body.height("ankle") > 1.2 * hl,
        "knee bent": _angle(to("knee", "hip"), to("knee", "ankle")) < 110,
        "foot fast": body.speed("ankle") > 2.5 * hl,
        "arm away from trunk": _angle(-spine, to("shoulder", "elbow")) > 25,
        "leg away from trunk": _angle(-spine, thigh) > 50,
        "hand low": body.height("hand") < 1.2 * hl,
    }


def _of_both_sides(body: _Body) -> dict[str, Array]:
    """What holds of the body as a whole: bool [T-1] each, 6 relations."""
    hl, to = UPPER_ARM, body.to
    lean = _angle(to("neck", "pelvis"), np.array([0.0, 1.0, 0.0]))
    stance = np.cross(to("r_ankle", "l_ankle"), to("r_ankle", "neck"))
    hands, parting = to("l_wrist", "r_wrist"), body.relative("l_wrist", "r_wrist")
    return {
        "hands apart": _along(hands, to("l_shoulder", "r_shoulder")) > 2.5 * SHOULDERS,
        "hands approach": _along(parting, hands) > 1.4 * hl,
        "feet apart": _along(to("l_ankle", "r_ankle"), to("l_hip", "r_hip")) > 2.1 * HIPS,
        "pelvis before feet": _along(to("r_ankle", "pelvis"), stance) > 0.5 * hl,
        "trunk level": (lean > 70) & (lean < 110),
        "pelvis fast": body.speed("pelvis") > 2.3 * hl,
    }


def geometric_relations(points: Array, fps: float) -> dict[str, Array]:
    """The 32 relations of positions [T, 22, 3]: name to bool [T-1]; velocities are forward."""
    path = _checked(points)
    found = dict(_of_both_sides(_Body(path, fps)))
    for side in ("r", "l"):
        relations = _of_one_side(_Body(path, fps, side))
        found |= {f"{side} {name}": holds for name, holds in relations.items()}
    return found


def geometric_features(points: Array, fps: float) -> Array:
    """Share [32] of frames in which each relation holds, of positions [T, 22, 3] in metres.
    Raises ValueError: fewer than 3 frames, NaN or infinity."""
    if points.shape[1] != len(JOINT_NAMES):
        raise ValueError(f"{points.shape[1]} joints: the relations need all {len(JOINT_NAMES)}")
    return np.array([holds.mean() for holds in geometric_relations(points, fps).values()])


# ---------------------------------------------------------------- a pelvis alone


def _turning(trajectory: MotionTrajectory) -> Array:
    """Angular velocity [T-1, 3] in the world from the quaternions, rad/s."""
    quaternions = torch.as_tensor(_checked(trajectory.quaternion))
    return np.asarray(angular_velocity(quaternions, trajectory.fps).numpy())[:-1]


def root_kinetic_features(trajectory: MotionTrajectory) -> Array:
    """Of a trajectory's position and quaternion [5]: the features of one joint, and mean squared
    turning and tilting, in m²/s², m²/s², m/s², rad²/s², rad²/s².
    Raises ValueError as `kinetic_features` does."""
    turning = windowed_mean(_turning(trajectory)) ** 2
    joint = kinetic_features(trajectory.position[:, None], trajectory.fps)[0]
    return np.append(joint, (turning[:, 1].mean(), turning[:, [0, 2]].sum(1).mean()))


def root_geometric_features(trajectory: MotionTrajectory) -> Array:
    """Share [12] of frames in which each of the relations below holds, in shares of the standing
    height, m/s as seen from the heading, rad/s. Raises ValueError as `kinetic_features` does."""
    path = _checked(trajectory.position)
    velocity = windowed_mean(np.diff(path, axis=0)) * trajectory.fps  # T-1 3
    height = path[:-1, 1] / REST_PELVIS_HEIGHT
    ahead, left = ahead_and_left(velocity, trajectory.heading[:-1])
    turn = windowed_mean(_turning(trajectory))[:, 1]
    _, x, _, z = trajectory.quaternion[:-1].T.astype(np.float64)
    upright = 1 - 2 * (x**2 + z**2)  # y of the turned up axis
    rise, speed = velocity[:, 1], np.linalg.norm(velocity, axis=1)
    relations = {
        "low": height < 0.85, "high": height > 1.03, "rising": rise > 0.2, "sinking": rise < -0.2,
        "fast": speed > 2.3 * UPPER_ARM, "forward": ahead > 0.3, "backward": ahead < -0.3,
        "to the left": left > 0.3, "to the right": left < -0.3, "turning left": turn > 1,
        "turning right": turn < -1, "leaning": upright < np.cos(np.radians(20)),
    }  # fmt: skip
    return np.array([holds.mean() for holds in relations.values()])


# ---------------------------------------------------------------- FID_k, FID_g, Div_k and Div_g

AXES = 16  # of the reduced distance, which needs fewer motions
PIECE = 4.0  # seconds: a mean over a longer motion varies less, so all pieces are of one length
FLOOR = 0.05  # least scale of a feature, in those of its kind: what never varies says little


@dataclass(frozen=True, eq=False)
class FeatureSpace:
    """Features in units of how the real ones vary: `mean` [F], `scale` [F], all above 0. (By the
    published deviation + 1e-10 what no real motion shows weighs ten thousand million times more.)
    """

    mean: np.ndarray
    scale: np.ndarray

    @classmethod
    def fit(cls, real: np.ndarray, kinds: np.ndarray) -> "FeatureSpace":
        """Of real features [N, F] whose units are told by `kinds` [F].
        Raises ValueError: fewer than two motions, NaN or infinity."""
        if len(real) < 2 or not np.isfinite(real).all():
            raise ValueError(f"features {real.shape} must be finite and of 2 motions or more")
        deviation = real.std(0, ddof=1)
        scale = deviation.copy()
        for kind in np.unique(kinds):
            same = kinds == kind
            usual = float(np.sqrt((deviation[same] ** 2).mean()))
            scale[same] = deviation[same].clip(min=FLOOR * usual if usual else 1.0)
        return cls(real.mean(0), scale)

    def __call__(self, features: np.ndarray) -> np.ndarray:
        """[N, F] in units of the real deviation, 0 at the real mean."""
        return np.asarray((features - self.mean) / self.scale)


def mean_pairwise(features: np.ndarray) -> float:
    """Mean Euclidean distance over all pairs of features [N, F]; NaN below two."""
    return float(pdist(features).mean()) if len(features) > 1 else float("nan")


# Of one motion kinetic and geometric features [F] and its amount in m/s, the joints' mean speed.
Features = tuple[Array, Array, float]
Stacked = tuple[Array, Array, Array]  # the same of N motions: [N, F], [N, F'] and [N]


def body_features(motion: Motion) -> Features:
    """Kinetic [66] and geometric [32] features and the amount of motion in m/s of a body."""
    points = motion.positions()
    kinetic = kinetic_features(points, motion.fps).reshape(-1)
    return kinetic, geometric_features(points, motion.fps), amount(points, motion.fps)


def root_features(trajectory: MotionTrajectory) -> list[Features]:
    """Kinetic [5] and geometric [12] features and the speed in m/s of each 4 s of a pelvis, without
    what is left at the end; a shorter trajectory is one piece."""
    size = round(PIECE * trajectory.fps)
    starts = range(0, max(trajectory.num_frames - size, 0) + 1, size)
    pieces = [MotionTrajectory(trajectory.data[at : at + size], trajectory.fps) for at in starts]
    return [
        (root_kinetic_features(p), root_geometric_features(p), amount(p.position, p.fps))
        for p in pieces
    ]


def amount(points: np.ndarray, fps: float) -> float:
    """Mean speed in m/s of points [T, ..., 3]: 0 of a frozen pose."""
    steps = np.diff(points.astype(np.float64), axis=0)
    return float(np.linalg.norm(steps, axis=-1).mean() * fps)


def stacked(rows: Sequence[Features]) -> Stacked:
    """What `body_features` or `root_features` say of N motions."""
    kinetic, geometric, speed = zip(*rows, strict=True)
    return np.stack(kinetic), np.stack(geometric), np.array(speed)


def kinetic_columns(
    made: Stacked, real: Stacked, *, kinds: int, units_of: Stacked | None = None
) -> dict[str, float]:
    """Distances and diversity of both sets of features, and the amount of motion.

    Args:
        made, real: N ≥ 2 and M ≥ 2 motions.
        kinds: kinetic features a joint; they have units of their own.
        units_of: motions whose spread is the unit; None = `real`.

    Returns:
        fid_k, fid_g; fid_k_axes, fid_g_axes along 16 principal axes of the real motions, where
        there are more features; div_k, div_g; amount.
    """
    found: dict[str, float] = {}
    for name, *sets in zip("kg", made, real, units_of or real, strict=False):
        width = sets[0].shape[1]
        units = np.arange(width) % kinds if name == "k" else np.zeros(width)
        space = FeatureSpace.fit(sets[2], units)
        ours, theirs, whole = map(space, sets)
        found[f"fid_{name}"] = frechet_distance(ours, theirs)
        if width > AXES:
            axes = Projection.fit(whole, AXES)
            found[f"fid_{name}_axes"] = frechet_distance(axes(ours), axes(theirs))
        found[f"div_{name}"] = mean_pairwise(ours)
    return found | {"amount": float(made[2].mean())}
