"""FID_k, FID_g, Div_k and Div_g: are motions as lively and as various as the real ones?

AIST++ (Li et al. 2021, §5.2) and, for the normalisation by the real motions, Bailando (Siyao et al.
2022). Features by `kinetic_features.py`: 66 kinetic and 32 geometric ones of a body; 5 and 12 of a
25-d trajectory, which has no limbs (a reduced variant of our own). Other joints, frame rate, data
and mended formulas: none of it may stand beside a published figure, the reduced variant least.

Letters: N and M motions, F features, A principal axes.
"""

from dataclasses import dataclass

import numpy as np
from scipy.spatial.distance import pdist

from ..motion.motion import Motion
from ..motion.trajectory import MotionTrajectory
from .families import Column, DanceSample, MotionSample
from .kinetic_features import (
    geometric_features,
    kinetic_features,
    root_geometric_features,
    root_kinetic_features,
)
from .metrics_frechet import Projection, frechet_distance

AXES = 16  # of the reduced distance, which needs fewer motions
PIECE = 4.0  # seconds: a mean over a longer motion varies less, so all pieces are of one length
FLOOR = 0.05  # least scale of a feature, in those of its kind: what never varies says little


@dataclass(frozen=True, eq=False)
class FeatureSpace:
    """Features in units of how the real ones vary: `mean` [F], `scale` [F], all above 0.

    The published code divides by the plain deviation + 1e-10, so that a relation that no real
    motion shows weighs ten thousand million times as much as the others.
    """

    mean: np.ndarray
    scale: np.ndarray

    @classmethod
    def fit(cls, real: np.ndarray, kinds: np.ndarray) -> "FeatureSpace":
        """Of real features [N, F] whose units are told by `kinds` [F].

        Raises:
            ValueError: fewer than two motions, NaN or infinity.
        """
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
        return (features - self.mean) / self.scale

    def distance(self, a: np.ndarray, b: np.ndarray, axes: Projection | None = None) -> float:
        """Fréchet distance of features [N, F] and [M, F], along principal axes if given."""
        left, right = self(a), self(b)
        return (
            frechet_distance(left, right)
            if axes is None
            else frechet_distance(axes(left), axes(right))
        )


def mean_pairwise(features: np.ndarray) -> float:
    """Mean Euclidean distance over all pairs of features [N, F]; NaN below two."""
    return float(pdist(features).mean()) if len(features) > 1 else float("nan")


# ---------------------------------------------------------------- in the tables


@dataclass(frozen=True, eq=False)
class Features:
    """What is known of N motions."""

    kinetic: np.ndarray  # [N, F]
    geometric: np.ndarray  # [N, F]
    amount: np.ndarray  # [N] m/s, mean speed of the joints


def body_features(motion: Motion) -> tuple[np.ndarray, np.ndarray, float]:
    """Kinetic [66] and geometric [32] features and the amount of motion in m/s of a body."""
    points = motion.positions()
    return (
        kinetic_features(points, motion.fps).reshape(-1),
        geometric_features(points, motion.fps),
        amount(points, motion.fps),
    )


def root_features(trajectory: MotionTrajectory) -> list[tuple[np.ndarray, np.ndarray, float]]:
    """Kinetic [5] and geometric [12] features and the speed in m/s of each 4 s of a pelvis.

    What is left at the end is dropped; a shorter trajectory is one piece.
    """
    size = round(PIECE * trajectory.fps)
    starts = range(0, max(trajectory.num_frames - size, 0) + 1, size)
    pieces = [MotionTrajectory(trajectory.data[at : at + size], trajectory.fps) for at in starts]
    return [
        (
            root_kinetic_features(piece),
            root_geometric_features(piece),
            amount(piece.position, piece.fps),
        )
        for piece in pieces
    ]


def amount(points: np.ndarray, fps: float) -> float:
    """Mean speed in m/s of points [T, ..., 3]: 0 of a frozen pose."""
    steps = np.diff(points.astype(np.float64), axis=0)
    return float(np.linalg.norm(steps, axis=-1).mean() * fps)


def body_sample(sample: MotionSample) -> Features:
    """`body_features` of each motion, computed once a motion."""
    return _stack(sample.each("body features", body_features))


def root_sample(sample: DanceSample) -> Features:
    """`root_features` of each trajectory, computed once a trajectory, one after the other."""
    return _stack([piece for each in sample.each("root features", root_features) for piece in each])


def _stack(rows: list[tuple[np.ndarray, np.ndarray, float]]) -> Features:
    kinetic, geometric, speed = zip(*rows, strict=True)
    return Features(np.stack(kinetic), np.stack(geometric), np.array(speed))


def kinetic_columns(
    made: Features, real: Features, *, kinds: int, units_of: Features | None = None
) -> dict[str, float]:
    """Distances and diversity of both sets of features, and the amount of motion.

    Args:
        made: N ≥ 2 motions.
        real: M ≥ 2 motions.
        kinds: kinetic features a joint; they have units of their own.
        units_of: motions whose spread is the unit; None = `real`.

    Returns:
        fid_k, fid_g; fid_k_axes, fid_g_axes along 16 principal axes of the real motions, where
        there are more features; div_k, div_g; amount.
    """
    found: dict[str, float] = {}
    base = units_of or real
    sets = (
        ("k", made.kinetic, real.kinetic, base.kinetic),
        ("g", made.geometric, real.geometric, base.geometric),
    )
    for name, ours, theirs, whole in sets:
        units = np.arange(ours.shape[1]) % kinds if name == "k" else np.zeros(ours.shape[1])
        space = FeatureSpace.fit(whole, units)
        found[f"fid_{name}"] = space.distance(ours, theirs)
        if ours.shape[1] > AXES:
            axes = Projection.fit(space(whole), AXES)
            found[f"fid_{name}_axes"] = space.distance(ours, theirs, axes)
        found[f"div_{name}"] = mean_pairwise(space(ours))
    return found | {"amount": float(made.amount.mean())}


_WARNS = (
    "Never beside published figures: other joints, frame rate and data, mended formulas, and "
    "features in units of the real motions' deviation. A Fréchet distance grows as N shrinks, so "
    "rows of the same N alone compare, and the real row says what no difference looks like. "
    "*Div* rises with jitter and with any nonsense that differs; it is good where it is near the "
    "real row, and only together with its FID. *motion amount* is the mean speed of the joints: a "
    "frozen pose has 0."
)


@dataclass(frozen=True)
class BodyKinetics:
    """FID_k, FID_g, Div_k, Div_g of whole bodies."""

    name: str = "kinetic and geometric features"
    distance: bool = True
    columns: tuple[Column, ...] = (
        Column("fid_k", "FID_k, 66-d", 2, "low"),
        Column("fid_g", "FID_g, 32-d", 2, "low"),
        Column("fid_k_axes", f"FID_k, {AXES} axes", 2, "low"),
        Column("fid_g_axes", f"FID_g, {AXES} axes", 2, "low"),
        Column("div_k", "Div_k", 2),
        Column("div_g", "Div_g", 2),
        Column("amount", "motion amount, m/s", 3),
    )
    definition: str = (
        "*k*: mean squared horizontal and vertical speed and mean acceleration of each of 22 "
        "joints (Onuma et al. 2008); *g*: the share of frames in which each of 32 relations holds "
        "(Müller et al. 2005); as in AIST++ (Li et al. 2021). FID: Fréchet distance to the real "
        "motions, also along the 16 directions in which these vary most: the one to read below "
        "a thousand motions. Div: mean distance over all pairs. " + _WARNS
    )

    def compute(
        self, sample: MotionSample, reference: MotionSample, *, seed: int
    ) -> dict[str, float]:
        """Nothing for fewer than two motions on either side; no random choice."""
        if min(len(sample), len(reference)) < 2:
            return {}
        whole = body_sample(reference.whole or reference)
        real = body_sample(reference)
        return kinetic_columns(body_sample(sample), real, kinds=3, units_of=whole)


@dataclass(frozen=True)
class RootKinetics:
    """The reduced variant for trajectories, under keys of its own."""

    name: str = "kinetic and geometric features of the root"
    distance: bool = True
    columns: tuple[Column, ...] = (
        Column("fid_k_root", "FID_k, root, 5-d", 2, "low"),
        Column("fid_g_root", "FID_g, root, 12-d", 2, "low"),
        Column("div_k_root", "Div_k, root", 2),
        Column("div_g_root", "Div_g, root", 2),
        Column("amount_root", "motion amount, m/s", 3),
    )
    definition: str = (
        "A reduced variant of our own of FID_k and FID_g, for a pelvis without limbs. *k*: its "
        "mean squared horizontal and vertical speed, mean acceleration, mean squared turning and "
        "tilting. *g*: the share of frames in which it is low, high, rising, sinking, fast, moving "
        "to each side, turning left or right, leaning. Each 4 s of a motion count as one, since "
        "a mean over a longer motion varies less. " + _WARNS
    )

    def compute(
        self, sample: DanceSample, reference: DanceSample, *, seed: int
    ) -> dict[str, float]:
        """Nothing for fewer than two motions on either side; no random choice."""
        if min(len(sample), len(reference)) < 2:
            return {}
        whole = root_sample(reference.whole or reference)
        real = root_sample(reference)
        found = kinetic_columns(root_sample(sample), real, kinds=5, units_of=whole)
        return {f"{name}_root": value for name, value in found.items()}
