"""Ranks and recalls against brute force, known answers, and intervals that grow with kinship."""

import itertools

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from src.shared.evaluation.suites.space import by_song, ranks, retrieval_figures
from src.shared.metrics.retrieval import Ranks


def unit(rng: np.random.Generator, *shape: int) -> np.ndarray:
    values = rng.integers(-2, 3, shape) + 0.5  # few values, so that similarities tie
    return values / np.linalg.norm(values, axis=-1, keepdims=True)


@given(seed=st.integers(0, 200))
def test_recall_and_rank_are_means_over_all_orders_of_ties(seed: int) -> None:
    rng = np.random.default_rng(seed)
    query, items = unit(rng, 6, 2), unit(rng, 6, 2)
    kin = rng.random((6, 6)) < 0.3
    found = ranks(query, items, kin)
    similarity = query @ items.T
    for i in range(6):
        others = [j for j in range(6) if j != i and not kin[i, j]]
        better = sum(similarity[i, j] > similarity[i, i] for j in others)
        tied = sum(similarity[i, j] == similarity[i, i] for j in others)
        orders = list(itertools.permutations(range(tied + 1)))
        places = [better + 1 + order.index(0) for order in orders]
        assert found.mean()[i] == pytest.approx(np.mean(places))
        for k in (1, 2, 5):
            assert found.hits(k)[i] == pytest.approx(np.mean([p <= k for p in places]))


def test_known_answers() -> None:
    items = np.eye(8)
    kin = np.zeros((8, 8), dtype=bool)
    assert ranks(items, items, kin).mean().tolist() == [1] * 8
    blind = ranks(np.ones((8, 8)) / np.sqrt(8), items, kin)
    assert blind.mean().tolist() == [4.5] * 8, "all tied: the middle"
    assert blind.hits(1) == pytest.approx(np.full(8, 1 / 8))
    last = ranks(np.roll(items, 1, axis=0), items, kin)  # each finds its neighbour's
    assert (last.better == 1).all()
    kin |= np.roll(np.eye(8, dtype=bool), -1, axis=1)  # the neighbour is of the same song
    kin |= np.roll(np.eye(8, dtype=bool), 1, axis=1)
    assert (ranks(np.roll(items, 1, axis=0), items, kin).better == 0).all()


def test_intervals_are_of_songs_not_of_queries() -> None:
    rng = np.random.default_rng(0)
    values = np.repeat(rng.normal(size=20), 50)  # fifty queries a song that agree
    alone = by_song(values, [str(n) for n in range(1000)], np.mean)
    together = by_song(values, [str(n // 50) for n in range(1000)], np.mean)
    assert together.count == 20 and alone.count == 1000
    assert together.value == alone.value == pytest.approx(values.mean())
    widths = together.high - together.low, alone.high - alone.low
    assert widths[0] > 4 * widths[1]
    half = 1.96 * values.std() / np.sqrt(20)
    assert widths[0] / 2 == pytest.approx(half, rel=0.2)


def test_figures_of_several_batches() -> None:
    parts = [Ranks(np.array(better), np.ones(2), np.zeros(2)) for better in ([0, 4], [9, 30])]
    found = retrieval_figures(parts, ["a", "b", "a", "b"])
    assert found["r_at_1"].value == 0.25 and found["r_at_5"].value == 0.5
    assert found["r_at_10"].value == 0.75 and found["median_rank"].value == 7.5
    assert found["r_at_1"].low <= 0.25 <= found["r_at_1"].high
