"""Margins of sanity checks: 0 at the bound, 1 where real motion is."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from src.shared.metrics.sanity import Band, Bands, CheckResult, SanityChecker
from src.shared.motion.trajectory import MotionTrajectory
from src.shared.pipelines.ranking import margin, mean_margin, share


def band_check(value: float) -> CheckResult:
    """Real motions have 2 to 4; the limits are 1 and 8."""
    passed = 1 <= value <= 8
    return CheckResult("band_mean_speed", passed, value, (1.0, 8.0), "", (2.0, 4.0))


def below(value: float) -> CheckResult:
    return CheckResult("jerk", value < 2000, value, 2000.0, "")


@pytest.mark.parametrize(
    ("value", "expected"),
    [(0.5, 0), (1, 0), (2**0.5, 0.5), (2, 1), (3, 1), (4, 1), (4 * 2**0.5, 0.5), (8, 0), (9, 0)],
)
def test_a_band_falls_to_its_limits(value: float, expected: float) -> None:
    assert margin(band_check(value)) == pytest.approx(expected)


def test_a_bound_falls_linearly_and_the_rest_passes_or_fails() -> None:
    assert [margin(below(v)) for v in (0.0, 500.0, 2000.0)] == [1.0, 0.75, 0.0]
    norm = CheckResult("quaternion", True, 1.04, (0.95, 1.05), "")
    assert margin(norm) == 1.0
    assert mean_margin([below(500.0), norm, below(3000.0)]) == pytest.approx(1.75 / 3)


def test_no_motion_gains_by_being_tamer_than_real_ones() -> None:
    margins = [
        margin(CheckResult("jerk", True, value, 1600.0, "", (10.0, 400.0)))
        for value in (0.0, 300.0, 400.0, 800.0)
    ]
    assert margins == pytest.approx([1, 1, 1, 0.5])
    gap = CheckResult("velocity_coherence", True, 1.0, 5.0, "", (1e-9, 1e-7))
    assert margin(gap) == pytest.approx(0.8), "real motion has none: the band says nothing"


def test_real_bands_may_begin_at_zero() -> None:
    walk = np.zeros((60, 3))
    walk[:, 2] = np.arange(60) / 30
    turn = np.tile([1.0, 0, 0, 0], (60, 1))
    straight = MotionTrajectory.from_pose(walk, turn, np.arange(60) / 60)
    bands = Bands({"turning": Band(0.0, 0.4, 1.0), "mean_speed": Band(0.5, 1.0, 2.0)}, 10)
    results = SanityChecker(bands=bands).check_all(straight)[1]
    assert margin(results["band_turning"]) == 1.0
    assert mean_margin(results.values()) > 0.95


@given(st.floats(0, 1e6), st.floats(0.01, 100), st.floats(1.1, 10))
def test_a_share_falls_from_one_to_zero(value: float, edge: float, factor: float) -> None:
    above, below = share(value, edge * factor, edge), share(value, edge / factor, edge)
    assert 0 <= above <= 1 and 0 <= below <= 1
    assert (above == 1) == (value <= edge) and (below == 1) == (value >= edge)
