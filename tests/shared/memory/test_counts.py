"""Counts of dancers whose beats are known by construction."""

import numpy as np
import pytest

from src.shared.memory.counts import find_counts
from tests.shared.evaluation.dancers import hopping, swinging_arms


@pytest.mark.parametrize("period", [0.4, 0.5, 0.6])
@pytest.mark.parametrize("offset", [0.0, 0.2])
def test_counts_fall_where_a_dancer_slows_down(period: float, offset: float) -> None:
    counts = find_counts(swinging_arms(period, 300, offset))
    assert np.median(np.diff(counts)) == pytest.approx(period, abs=0.02)
    off = (counts - offset + period / 2) % period - period / 2
    assert np.abs(off).mean() < 0.05 and len(counts) > 0.7 * 10 / period


def test_a_short_or_still_motion_has_none() -> None:
    assert not len(find_counts(swinging_arms(0.5, 50)))
    assert not len(find_counts(hopping(height=0.0)))
