"""The suite lets smooth motion pass and nothing else: each check fails for its own reason."""

import json
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest

from src.shared.errors import UserError
from src.shared.metrics.sanity import (
    SEVEN,
    Band,
    Bands,
    SanityChecker,
    SanityThresholds,
    frozen,
    sanity_row,
)
from src.shared.motion.trajectory import PHASE, MotionTrajectory
from tests.shared.motion.trajectories import smooth_trajectory


@pytest.fixture(scope="module")
def real() -> list[MotionTrajectory]:
    return [smooth_trajectory(seed, 150) for seed in range(30)]


@pytest.fixture(scope="module")
def bands(real: list[MotionTrajectory]) -> Bands:
    return Bands.of(real)


def noise(seed: int, scale: float = 1.0) -> MotionTrajectory:
    """What an untrained model with derived columns gives: each frame on its own."""
    rng = np.random.default_rng(seed)
    position = rng.normal(0, scale, (120, 3))
    quaternion = rng.normal(0, 1, (120, 4))
    quaternion /= np.linalg.norm(quaternion, axis=1, keepdims=True)
    return MotionTrajectory.from_pose(position, quaternion, np.arange(120) * 0.02)


@pytest.mark.parametrize("with_bands", [False, True])
def test_real_passes_frozen_and_untrained_fail(
    real: list[MotionTrajectory], bands: Bands, with_bands: bool
) -> None:
    checker = SanityChecker(bands=bands if with_bands else None)
    rows = {
        "real": sanity_row("real", real, checker),
        "frozen": sanity_row("frozen", map(frozen, real), checker),
        "untrained": sanity_row("untrained", map(noise, range(30)), checker),
        "1 mm": sanity_row("1 mm", (noise(i, 0.001) for i in range(30)), checker),
    }
    assert {name: row["rate"] for name, row in rows.items()} == {
        "real": 1, "frozen": 0, "untrained": 0, "1 mm": 0}  # fmt: skip
    assert rows["frozen"]["passed_seven"] == 30, "the documents' checks alone let it pass"
    assert bool(rows["real"]["inside"]) == with_bands
    if with_bands:
        assert min(rows["real"]["inside"].values()) >= 0.85
    broken = MotionTrajectory(np.full((9, 25), np.nan, dtype=np.float32))
    rows["broken"] = sanity_row("broken", [broken], checker)
    json.dumps(rows, allow_nan=False)


def test_the_seven_come_first_under_the_documents_names(bands: Bands) -> None:
    passed, results = SanityChecker(bands=bands).check_all(smooth_trajectory(0))
    assert passed and tuple(results)[:7] == SEVEN == (
        "quaternion", "phase", "jerk", "velocity_coherence", "accel_coherence",
        "quaternion_continuity", "phase_monotonic",
    )  # fmt: skip
    assert all(results[name].band is not None for name in SEVEN)
    assert set(results) - set(SEVEN) - {"liveliness", "roughness"} == {
        f"band_{name}" for name in bands.inside(smooth_trajectory(0))
    }


def scaled_quaternions(data: np.ndarray) -> None:
    data[:, 9:13] *= 1.2


def phase_beyond(data: np.ndarray) -> None:
    data[5, PHASE] = 1.2


def shaking(data: np.ndarray) -> None:
    data[::2, 6:9] += 60


def wrong_velocity(data: np.ndarray) -> None:
    data[:, 3:6] += 6


def wrong_acceleration(data: np.ndarray) -> None:
    data[:, 6:9] += 60


def lost_sign(data: np.ndarray) -> None:
    data[10:, 9:13] *= -1


def backwards(data: np.ndarray) -> None:
    data[:, PHASE] = data[::-1, PHASE]


@pytest.mark.parametrize(
    ("spoil", "failing"),
    [
        (scaled_quaternions, {"quaternion"}),
        (phase_beyond, {"phase", "phase_monotonic"}),
        (shaking, {"jerk"}),
        (wrong_velocity, {"velocity_coherence"}),
        (wrong_acceleration, {"accel_coherence"}),
        (lost_sign, {"quaternion_continuity"}),
        (backwards, {"phase_monotonic"}),
    ],
)
def test_each_check_sees_its_fault(spoil: Callable[[np.ndarray], None], failing: set[str]) -> None:
    data = smooth_trajectory(1).data.copy()
    spoil(data)
    passed, results = SanityChecker().check_all(MotionTrajectory(data))
    assert not passed
    assert {name for name, result in results.items() if not result.passed} == failing


@pytest.mark.parametrize("column", range(0, 17, 4))
@pytest.mark.parametrize("value", [np.nan, np.inf])
def test_what_is_not_finite_fails(column: int, value: float) -> None:
    data = smooth_trajectory(1).data.copy()
    data[7, column] = value
    assert not SanityChecker().check_all(MotionTrajectory(data))[0]


def test_a_legal_wrap_is_no_step_back() -> None:
    """TECH's loss punishes it, ruling 23."""
    whole = smooth_trajectory(4)
    assert (np.diff(whole.phase) < 0).any()
    assert SanityChecker().check_all(whole)[1]["phase_monotonic"].passed


def test_thresholds_are_held() -> None:
    strict = SanityThresholds(max_jerk=1e-3, min_mean_speed=50)
    results = SanityChecker(strict).check_all(smooth_trajectory(0))[1]
    assert {name for name, r in results.items() if not r.passed} == {"jerk", "liveliness"}
    assert "threshold 0.001" in results["jerk"].message


def test_one_frame_and_none() -> None:
    one = MotionTrajectory(smooth_trajectory(0).data[:1])
    passed, results = SanityChecker().check_all(one)
    assert not passed and results["quaternion_continuity"].passed
    with pytest.raises(ValueError, match="without frames"):
        SanityChecker().check_all(MotionTrajectory(one.data[:0]))


def test_bands_go_to_a_file_and_back(bands: Bands, tmp_path: Path) -> None:
    assert Bands.load(bands.save(tmp_path / "bands.json")) == bands
    assert bands.motions == 30


@pytest.mark.parametrize(
    "text",
    [
        "",
        "[]",
        '{"bands": {"jerk": {"low": 1}}, "motions": 2}',
        '{"bands": {"a": {"low": NaN, "median": 1, "high": 1}}}',
        f'{{"bands": {{"a": {{"low": {10**400}, "median": 1, "high": 1}}}}}}',
    ],
)
def test_damaged_bands_are_named(text: str, tmp_path: Path) -> None:
    path = tmp_path / "bands.json"
    path.write_text(text, encoding="utf-8")
    with pytest.raises(UserError, match="is not a file of bands"):
        Bands.load(path)
    with pytest.raises(UserError, match="cannot be read"):
        Bands.load(tmp_path / "none.json")
    with pytest.raises(UserError, match="no real motions"):
        Bands.of([])


def test_a_band_and_its_slack() -> None:
    band = Band(3, 4, 6)
    assert band.holds(3) and not band.holds(2.9)
    assert band.limits == (1, 18)
