"""FID and Div of features against scipy, torchmetrics and closed forms; what a frozen pose gets."""

from dataclasses import replace

import numpy as np
import pytest
import scipy.linalg
import torch
from torchmetrics.image.fid import FrechetInceptionDistance

from src.shared.evaluation.families import BODY_KINETICS, ROOT_KINETICS
from src.shared.evaluation.samples import Clips, Dance, DanceSample, MotionSample
from src.shared.metrics.frechet import Projection, frechet_distance
from src.shared.metrics.kinetic import (
    AXES,
    FeatureSpace,
    amount,
    kinetic_columns,
    mean_pairwise,
    root_features,
)
from src.shared.motion.motion import Motion
from src.shared.motion.trajectory import MotionTrajectory, from_motion

ONE_KIND = np.zeros(5)


def normal(seed: int, num: int, mean: float = 0.0, deviation: float = 1.0) -> np.ndarray:
    return np.random.default_rng(seed).normal(mean, deviation, (num, 5))


def distance(space: FeatureSpace, a: np.ndarray, b: np.ndarray) -> float:
    """Fréchet distance of features in the units of a space."""
    return frechet_distance(space(a), space(b))


class AsTheyAre(torch.nn.Module):
    """What torchmetrics asks for instead of the Inception network."""

    num_features = 5

    def forward(self, rows: torch.Tensor) -> torch.Tensor:
        return rows


def test_the_distance_is_torchmetrics_and_scipys() -> None:
    real, made = normal(0, 80, 3.0, 2.0), normal(1, 60, 2.0, 1.0)
    space = FeatureSpace.fit(real, np.arange(5))
    a, b = (made - real.mean(0)) / real.std(0, ddof=1), (real - real.mean(0)) / real.std(0, ddof=1)
    oracle = FrechetInceptionDistance(feature=AsTheyAre()).set_dtype(torch.float64)
    oracle.update(torch.as_tensor(b), real=True)
    oracle.update(torch.as_tensor(a), real=False)
    assert distance(space, made, real) == pytest.approx(float(oracle.compute()))
    root = scipy.linalg.sqrtm(np.cov(a.T) @ np.cov(b.T)).real
    plain = ((a.mean(0) - b.mean(0)) ** 2).sum() + np.trace(np.cov(a.T) + np.cov(b.T) - 2 * root)
    assert distance(space, made, real) == pytest.approx(plain)


def test_gaussians_have_their_analytic_distance() -> None:
    """N(m, s²) against N(0, 1) in each of 5 features: m² + (s - 1)²."""
    real, made = normal(0, 40_000), normal(1, 40_000, 2.0, 3.0)
    space = FeatureSpace.fit(real, ONE_KIND)
    assert distance(space, made, real) == pytest.approx(5 * (4 + 4), rel=0.03)
    assert distance(space, real + 3 * real.std(0, ddof=1), real) == pytest.approx(5 * 9)
    assert distance(space, real, real) == pytest.approx(0, abs=1e-9)
    axes = Projection(np.zeros(5), np.eye(5)[:, :2])
    assert frechet_distance(axes(space(made)), axes(space(real))) == pytest.approx(
        2 * (4 + 4), rel=0.05
    )


def test_units_do_not_matter_where_kinds_are_apart() -> None:
    real, made = normal(0, 90), normal(1, 70, 0.5)
    metres, units = np.arange(5), np.array([1.0, 100.0, 0.01, 7.0, 3.0])
    plain = distance(FeatureSpace.fit(real, metres), made, real)
    scaled = FeatureSpace.fit(real * units, metres)
    assert distance(scaled, made * units, real * units) == pytest.approx(plain)


def test_a_relation_that_no_real_motion_shows_does_not_explode() -> None:
    real, made = normal(0, 50), normal(1, 50)
    real[:, 2] = made[:, 2] = 0.0
    made[0, 2] = 1.0  # one motion does it
    space = FeatureSpace.fit(real, ONE_KIND)
    assert space.scale[2] == pytest.approx(0.05 * np.sqrt((real.std(0, ddof=1) ** 2).mean()))
    assert distance(space, made, real) < 20
    still = np.zeros((4, 5))
    assert distance(FeatureSpace.fit(still, ONE_KIND), still, still) == 0
    with pytest.raises(ValueError, match="2 motions"):
        FeatureSpace.fit(real[:1], ONE_KIND)
    with pytest.raises(ValueError, match="finite"):
        FeatureSpace.fit(real * np.nan, ONE_KIND)


def test_diversity_is_the_mean_over_all_pairs() -> None:
    rows = normal(2, 9)
    plain = [np.sqrt(((a - b) ** 2).sum()) for i, a in enumerate(rows) for b in rows[:i]]
    assert mean_pairwise(rows) == pytest.approx(np.mean(plain))
    assert mean_pairwise(np.ones((5, 3))) == 0 and np.isnan(mean_pairwise(rows[:1]))


def test_the_amount_of_a_glide_and_of_nothing() -> None:
    glide = np.zeros((31, 22, 3))
    glide[..., 2] = 0.5 * np.arange(31)[:, None] / 30
    assert amount(glide, 30) == pytest.approx(0.5) and amount(glide[:1].repeat(9, 0), 30) == 0


# ---------------------------------------------------------------- the tables


def dancer(seed: int, num_frames: int = 45) -> Motion:
    """Standing, with arms and pelvis swinging at random rates."""
    rng = np.random.default_rng(seed)
    time = np.arange(num_frames) / 30
    swing = 0.6 * np.sin(2 * np.pi * rng.uniform(0.3, 1.5, 22) * time[:, None])
    quaternions = np.zeros((num_frames, 22, 4), dtype=np.float32)
    quaternions[..., 0], quaternions[..., 3] = np.cos(swing / 2), np.sin(swing / 2)
    root = np.zeros((num_frames, 3), dtype=np.float32)
    root[:, 1] = 0.95 + 0.03 * np.sin(7 * time + seed)
    root[:, 2] = rng.uniform(-1, 1) * time
    return Motion(quaternions, root, np.ones((num_frames, 2), dtype=np.float32))


def held(motion: Motion) -> Motion:
    frames = motion.num_frames
    return replace(
        motion,
        quaternions=motion.quaternions[:1].repeat(frames, 0),
        root_position=motion.root_position[:1].repeat(frames, 0),
    )


def sample(motions: list[Motion]) -> MotionSample:
    names = ["caption"] * len(motions)
    clips = Clips(motions, names, names, names, [{}] * len(motions))
    vectors = np.ones((len(motions), 4))
    return MotionSample.of(clips, vectors, vectors, np.arange(len(motions)))


def dances(trajectories: list[MotionTrajectory]) -> DanceSample:
    found = [Dance(f"song {i}", each, np.arange(0, 9, 0.5)) for i, each in enumerate(trajectories)]
    return DanceSample(found, np.arange(len(found)))


REAL = [dancer(seed) for seed in range(24)]
OTHER = [dancer(seed) for seed in range(100, 124)]


def test_real_motion_is_near_itself_and_a_frozen_pose_is_not() -> None:
    family, real = BODY_KINETICS, sample(REAL)
    same = family.compute(real, real, seed=0)
    other = family.compute(sample(OTHER), real, seed=0)
    frozen = family.compute(sample([held(motion) for motion in OTHER]), real, seed=0)
    assert list(same) and set(same) == {column.key for column in family.columns}
    for key in ("fid_k", "fid_g", "fid_k_axes", "fid_g_axes"):
        assert same[key] == pytest.approx(0, abs=1e-6)
        assert frozen[key] > 2 * other[key] > 0, key
    assert frozen["div_k"] == pytest.approx(0, abs=1e-9)
    assert other["div_k"] > 1
    assert frozen["amount"] == 0 and other["amount"] > 0.05
    assert family.distance and "published" in family.definition


def test_the_root_has_keys_of_its_own() -> None:
    family, real = ROOT_KINETICS, dances([from_motion(motion) for motion in REAL])
    frozen = dances([from_motion(held(motion)) for motion in OTHER])
    other = dances([from_motion(motion) for motion in OTHER])
    found, still = family.compute(other, real, seed=0), family.compute(frozen, real, seed=0)
    assert set(found) == {column.key for column in family.columns}
    assert not set(found) & {column.key for column in BODY_KINETICS.columns}
    assert still["fid_k_root"] > 2 * found["fid_k_root"]
    assert still["fid_g_root"] > 2 * found["fid_g_root"]
    assert family.compute(real, real, seed=0)["fid_k_root"] == pytest.approx(0, abs=1e-9)
    assert still["amount_root"] == 0


def test_long_motions_are_cut_into_pieces_of_one_length() -> None:
    long = from_motion(dancer(7, 500))  # 4 pieces of 120 frames, 20 left over
    pieces = root_features(long)
    assert len(pieces) == 4
    third = from_motion(dancer(7, 500)).data[240:360]
    alone = root_features(MotionTrajectory(third))
    assert len(alone) == 1
    assert np.allclose(pieces[2][0], alone[0][0]) and np.allclose(pieces[2][1], alone[0][1])
    assert len(root_features(from_motion(dancer(7, 119)))) == 1
    assert len(root_features(from_motion(dancer(7, 240)))) == 2
    steps = np.linalg.norm(np.diff(long.position[:120].astype(float), axis=0), axis=1)
    assert pieces[0][2] == pytest.approx(steps.mean() * 30)


def test_the_length_of_the_songs_does_not_move_the_figures() -> None:
    """The same dancing, in songs of 4 s and in songs of 16 s, is at no distance."""
    whole = [from_motion(dancer(seed, 480)) for seed in range(12)]
    short = [
        MotionTrajectory(each.data[at : at + 120]) for each in whole for at in range(0, 480, 120)
    ]
    found = ROOT_KINETICS.compute(dances(whole), dances(short), seed=0)
    assert found["fid_k_root"] == pytest.approx(0, abs=1e-6)
    assert found["fid_g_root"] == pytest.approx(0, abs=1e-6)


def test_one_motion_has_no_distribution() -> None:
    assert BODY_KINETICS.compute(sample(REAL[:1]), sample(REAL), seed=0) == {}
    assert ROOT_KINETICS.compute(dances([from_motion(REAL[0])]), dances([]), seed=0) == {}


def test_few_features_need_no_axes() -> None:
    rng = np.random.default_rng(0)
    few = rng.normal(size=(9, 5)), rng.normal(size=(9, AXES + 4)), np.ones(9)
    found = kinetic_columns(few, few, kinds=5)
    assert "fid_k_axes" not in found and "fid_g_axes" in found
    assert frechet_distance(few[0], few[0]) == pytest.approx(0, abs=1e-9)


def test_halves_are_measured_in_the_units_of_the_whole() -> None:
    """Few motions have a spread of their own: in units of a half, real is far from real."""
    rng = np.random.default_rng(0)
    features = rng.normal(size=(8, 5)), rng.normal(size=(8, 12)), np.ones(8)
    first = features[0][:4], features[1][:4], np.ones(4)
    second = features[0][4:], features[1][4:], np.ones(4)
    both = kinetic_columns(first, second, kinds=5, units_of=features)
    swapped = kinetic_columns(second, first, kinds=5, units_of=features)
    assert both["fid_k"] == pytest.approx(swapped["fid_k"])
    assert both["fid_g"] == pytest.approx(swapped["fid_g"])
    part = sample(REAL).rows([0, 1]).rows([1])
    assert part.whole is not None and len(part.whole) == len(REAL)
