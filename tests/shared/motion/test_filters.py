"""Our filters are scipy's, but for what a processor rounds otherwise."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy import ndimage

from src.shared.motion.filters import frames_away, greatest, smoothed


@pytest.mark.parametrize(("mode", "theirs"), [("edge", "nearest"), ("symmetric", "reflect")])
@given(
    frames=st.integers(1, 80),
    rest=st.sampled_from([(), (3,), (4, 2)]),
    sigma=st.floats(0.2, 30),
    kind=st.sampled_from([np.float32, np.float64]),
    seed=st.integers(0, 9),
)
def test_smoothing_is_scipys(mode, theirs, frames, rest, sigma, kind, seed) -> None:
    values = np.random.default_rng(seed).standard_normal((frames, *rest)).astype(kind)
    expected = ndimage.gaussian_filter1d(values, sigma, axis=0, mode=theirs)
    found = smoothed(values, sigma, mode=mode)
    assert found.dtype == expected.dtype
    np.testing.assert_allclose(found, expected, rtol=1e-6, atol=1e-7)


@given(frames=st.integers(1, 60), reach=st.integers(0, 12), seed=st.integers(0, 9))
def test_the_greatest_nearby_is_scipys(frames: int, reach: int, seed: int) -> None:
    values = np.random.default_rng(seed).standard_normal((frames, 2))
    size = 2 * reach + 1
    expected = ndimage.maximum_filter1d(values, size, axis=0)
    np.testing.assert_array_equal(greatest(values, size), expected)
    least = ndimage.minimum_filter1d(values, size, axis=0)
    np.testing.assert_array_equal(-greatest(-values, size), least)


@given(marked=st.lists(st.booleans(), min_size=1, max_size=60).filter(any))
def test_distances_are_scipys(marked: list[bool]) -> None:
    at = np.array(marked)
    np.testing.assert_array_equal(frames_away(at), ndimage.distance_transform_edt(~at))
