"""Ranking: weights, ties, failed checks, and distance from those already chosen."""

import json

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays
from pydantic import ValidationError

from src.shared.inference.selection import SelectionConfig, distances, rank

UNIT = st.floats(0, 1)
NONE = SelectionConfig(distance=0)


def line(places: list[float]) -> np.ndarray:
    """Motions of one point that stands still at each place."""
    points = np.zeros((len(places), 4, 1, 3))
    points[..., 0] = np.array(places)[:, None, None]
    return points


def test_the_score_is_the_weighted_mean_of_the_terms_there_are() -> None:
    terms = {"similarity": np.array([0.2, 0.8]), "feet": np.array([1.0, 0.0])}
    config = SelectionConfig(similarity=3, feet=1, smoothness=100)
    table = rank(terms, np.zeros(2), distances(line([0, 0]), 1.0), config)
    np.testing.assert_allclose(table.score, [(3 * 0.2 + 1) / 4, 3 * 0.8 / 4])
    assert table.best == 1 and table.weights == {"similarity": 3, "feet": 1, "distance": 0.25}


def test_a_failed_check_outweighs_every_term() -> None:
    terms = {"sanity": np.array([1.0, 0.0, 1.0]), "beats": np.array([1.0, 0.0, 1.0])}
    table = rank(terms, np.array([1, 0, 2]), distances(line([0, 0, 0]), 1.0))
    assert table.order.tolist() == [1, 0, 2]


def test_equal_candidates_keep_their_order_and_nan_is_nothing() -> None:
    terms = {"beats": np.array([np.nan, 0.5, 0.5, 0.0])}
    table = rank(terms, np.zeros(4), distances(line([0, 0, 0, 0]), 1.0))
    assert table.order.tolist() == [1, 2, 0, 3]


def test_later_choices_look_for_what_is_far_from_the_chosen() -> None:
    terms = {"similarity": np.array([0.9, 0.89, 0.8, 0.5])}
    far = distances(line([0.0, 0.01, 3.0, 3.01]), 1.0)
    assert rank(terms, np.zeros(4), far, NONE).order.tolist() == [0, 1, 2, 3]
    table = rank(terms, np.zeros(4), far, SelectionConfig(distance=0.25))
    assert table.order.tolist() == [0, 2, 1, 3]
    assert table.distance[2] == pytest.approx(1 - np.exp(-3.0))
    assert table.distance[1] == pytest.approx(1 - np.exp(-0.01))


def test_rows_are_json_best_first() -> None:
    terms = {"similarity": np.array([0.25, 0.75])}
    rows = rank(terms, np.zeros(2), distances(line([0, 1]), 1.0)).rows()
    assert json.loads(json.dumps(rows))[0] == {
        "rank": 1, "sample": 1, "score": 0.75, "failed": 0, "similarity": 0.75, "distance": None
    }  # fmt: skip
    assert rows[1]["distance"] == pytest.approx(1 - np.exp(-1), abs=1e-6)


@given(arrays(float, st.integers(1, 8), elements=UNIT), st.data())
def test_ranking_is_a_greedy_permutation(values: np.ndarray, data: st.DataObject) -> None:
    places = data.draw(st.lists(st.floats(-5, 5), min_size=len(values), max_size=len(values)))
    weight = data.draw(st.floats(0, 2))
    far = distances(line(places), 1.0)
    table = rank({"beats": values}, np.zeros(len(values)), far, SelectionConfig(distance=weight))
    order = table.order.tolist()
    assert sorted(order) == list(range(len(values)))
    assert values[order[0]] == values.max(), "distance never decides the first"
    for step in range(1, len(order)):  # by definition, each choice is the best of the rest
        gains = [values[i] + weight * min(far(j)[i] for j in order[:step]) for i in order[step:]]
        assert gains[0] == pytest.approx(max(gains))
        assert table.distance[order[step]] == pytest.approx(
            min(far(j)[order[step]] for j in order[:step])
        )


def test_distance_is_symmetric_saturating_and_looks_at_long_motions_sparsely() -> None:
    points = (
        np.random.default_rng(0).normal(size=(3, 1000, 2, 3)) + np.arange(3)[:, None, None, None]
    )
    far = distances(points, 0.5)
    matrix = np.stack([far(i) for i in range(3)])
    np.testing.assert_allclose(matrix, matrix.T)
    np.testing.assert_allclose(np.diag(matrix), 0)
    exact = np.linalg.norm(points[0] - points[1], axis=-1).mean()
    assert matrix[0, 1] == pytest.approx(1 - np.exp(-exact / 0.5), abs=0.01)
    assert distances(line([0, 1e9]), 1.0)(0)[1] == 1.0


def test_weights_are_not_negative() -> None:
    with pytest.raises(ValidationError):
        SelectionConfig(beats=-1)
