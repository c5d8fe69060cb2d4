"""Seams that cannot be seen score 1, seams that are made rough or jump are found."""

import numpy as np
import pytest
from scipy.stats import ks_2samp

from src.shared.evaluation.suites.audio import seam_frames
from src.shared.metrics.seams import Seamed, compare, distance, jumps, measure, seam_report
from src.shared.motion.trajectory import PHASE, QUATERNION, MotionTrajectory

T, WINDOW, OVERLAP = 480, 240, 30


def smooth_noise(rng: np.random.Generator) -> MotionTrajectory:
    at = np.arange(T + 2) / 30.0
    waves = rng.uniform(0.3, 2.0, (12, 1)) * at + rng.random((12, 1))
    wobble = np.sin(2 * np.pi * waves) * 0.05
    position = np.stack([wobble[k::3].sum(0) for k in range(3)], -1)
    heading = wobble[:4].sum(0)
    zeros = np.zeros_like(heading)
    quaternion = np.stack([np.cos(heading), zeros, np.sin(heading), zeros], -1)
    return MotionTrajectory.from_pose(position, quaternion, at / 2, spare=2)


@pytest.fixture
def songs() -> list[Seamed]:
    near = seam_frames(T, WINDOW, OVERLAP)
    return [Seamed(smooth_noise(np.random.default_rng(seed)), near) for seed in range(20)]


def test_frames_at_seams_are_those_two_windows_share() -> None:
    near = seam_frames(T, WINDOW, OVERLAP)
    edges = np.flatnonzero(np.diff(near.astype(int)))
    assert list(edges + 1) == [199, 235, 401, 437]  # shared ones and 3 on both sides
    assert not seam_frames(200, WINDOW, OVERLAP).any()


def test_one_motion_has_no_seams(songs: list[Seamed]) -> None:
    report = seam_report(songs, n=100)
    assert (report["songs"], report["seams"]) == (20, 40)
    for found in report["quantities"].values():
        for point in (50, 95):
            ratio = found[f"ratio_p{point}"]
            assert ratio["low"] < ratio["value"] < ratio["high"]
            assert ratio["null_low"] < ratio["value"] < ratio["null_high"]
        assert found["ratio_p50"]["low"] <= 1 <= found["ratio_p50"]["high"]
        assert found["ks"]["p"] > 0.05
    assert report["jumps"]["none"]
    assert report == seam_report(songs, n=100)


def test_rough_seams_are_found(songs: list[Seamed]) -> None:
    for song in songs:
        song.trajectory.acceleration[song.seam] *= 2.0
    found = seam_report(songs, n=100)["quantities"]["acceleration"]
    assert found["ratio_p50"]["value"] == pytest.approx(2.0, rel=0.15)
    assert found["ratio_p50"]["low"] > 1.5
    assert found["ratio_p50"]["value"] > found["ratio_p50"]["null_high"]
    assert found["ks"]["p"] < 0.02


def test_equal_values_have_the_ratio_of_their_scale() -> None:
    mask = np.zeros(100, dtype=bool)
    mask[40:60] = True
    values = np.where(mask, 3.0, 1.5)
    found = compare([(values, mask)] * 4, n=50)
    assert found["ratio_p50"]["value"] == found["ratio_p95"]["value"] == 2.0
    assert found["ratio_p50"]["low"] == found["ratio_p50"]["high"] == 2.0
    assert found["ks"]["value"] == 1.0


def test_ratios_and_the_distance_are_of_what_is_marked() -> None:
    rng = np.random.default_rng(3)
    first, second = rng.normal(size=400), rng.normal(0.2, 1.3, size=300)
    mask = np.arange(700) < 400
    for values in (np.concatenate((first, second)), np.concatenate((first, second)).round(1)):
        found = measure([(values, mask)])
        shares = [np.mean(part[:, None] <= values, 0) for part in (values[mask], values[~mask])]
        assert found[-1] == pytest.approx(np.abs(shares[0] - shares[1]).max())
        ratio = np.percentile(values[mask], 95) / np.percentile(values[~mask], 95)
        assert found[1] == pytest.approx(ratio)


def test_a_flipped_sign_is_a_jump(songs: list[Seamed]) -> None:
    songs[3].trajectory.data[220:, QUATERNION] *= -1
    found = jumps(songs)
    assert not found["none"]
    assert found["quaternion_dot_min"][0] < -0.9 < 0.9 < found["quaternion_dot_min"][1]


@pytest.mark.parametrize("by", [0.2, -0.2])
def test_a_phase_that_jumps_is_found(songs: list[Seamed], by: float) -> None:
    phase = songs[5].trajectory.data[:, PHASE]
    phase[220:] = (phase[220:] + by) % 1.0
    assert not jumps(songs)["none"]


def test_a_teleport_is_a_jump(songs: list[Seamed]) -> None:
    songs[2].trajectory.data[230:, :3] += 0.5
    assert not jumps(songs)["none"]


def test_a_jump_elsewhere_is_not_the_seams_fault(songs: list[Seamed]) -> None:
    songs[0].trajectory.data[100:, QUATERNION] *= -1
    assert jumps(songs)["none"]


def test_a_song_of_one_window_has_nothing_to_report(songs: list[Seamed]) -> None:
    alone = Seamed(songs[0].trajectory, np.zeros(T, dtype=bool))
    assert seam_report([alone]) == {"songs": 0, "seams": 0}


def test_the_distance_is_scipys() -> None:
    rng = np.random.default_rng(0)
    for size in (1, 2, 7, 50):
        for shift in (0.0, 0.7, 9.0):
            first, second = rng.normal(size=size).round(1), rng.normal(shift, size=60).round(1)
            expected = ks_2samp(first, second, method="asymp").statistic
            assert distance(first, second) == expected, (size, shift)
    assert np.isnan(distance(np.array([0.0, np.nan]), second))
