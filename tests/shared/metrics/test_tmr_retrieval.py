"""TMR's protocols against torchmetrics, plain loops over all orders, and known answers."""

import itertools

import numpy as np
import pytest
import torch
from hypothesis import given, settings
from hypothesis import strategies as st
from torchmetrics.functional.retrieval import retrieval_hit_rate
from torchmetrics.functional.retrieval import retrieval_reciprocal_rank as reciprocal

from src.shared.evaluation.families import TMR
from src.shared.evaluation.samples import Clips, MotionSample
from src.shared.metrics.retrieval import (
    PROTOCOLS,
    RECALL_AT,
    best_ranks,
    cosines,
    dissimilar_subset,
    recall_in_pools,
    recalls,
    text_similarity,
)
from src.shared.motion.motion import Motion

STANDING = Motion(np.eye(4)[np.zeros((2, 22), int)], np.zeros((2, 3)), np.zeros((2, 2)))


def noisy_pairs(num: int = 60, width: int = 6, noise: float = 0.6) -> tuple[np.ndarray, np.ndarray]:
    rng = np.random.default_rng(0)
    text = rng.normal(size=(num, width))
    return text, text + noise * rng.normal(size=text.shape)


def test_recall_is_torchmetrics_hit_rate_both_ways() -> None:
    text, motion = noisy_pairs()
    rng = np.random.default_rng(1)
    labels = rng.integers(0, 25, len(text))
    relevant = labels[:, None] == labels[None]
    found = recalls(text, motion, relevant.astype(float))
    similarity = torch.nn.functional.cosine_similarity(
        torch.as_tensor(text)[:, None], torch.as_tensor(motion)[None], dim=-1
    )
    for ours, table in zip(found, (similarity, similarity.T), strict=True):
        rows = list(zip(table, torch.as_tensor(relevant), strict=True))
        hits = [
            np.mean([float(retrieval_hit_rate(s, r, top_k=k)) for s, r in rows]) for k in RECALL_AT
        ]
        assert ours[:5] == pytest.approx(hits)
        ranks = [1 / float(reciprocal(s, r)) for s, r in rows]
        assert ours[5] == pytest.approx(np.median(ranks))


def test_perfect_embeddings_find_everything_and_one_point_scores_what_guessing_does() -> None:
    text, _ = noisy_pairs()
    perfect = recalls(text, 3 * text)
    assert perfect.shape == (2, 6) and (perfect == 1).all()
    point = recalls(np.ones((60, 4)), np.full((60, 4), 0.3))
    assert point[0, :5] == pytest.approx([k / 60 for k in RECALL_AT])
    assert point[1, 5] == pytest.approx(30.5)


def test_a_cyclic_shift_has_rank_two() -> None:
    """Each text lies on the motion of the next and, a bit farther, on its own."""
    angle = 2 * np.pi * np.arange(40) / 40
    text = np.stack((np.cos(angle), np.sin(angle)), 1)
    shifted = angle - 2 * np.pi / 40 * 0.7
    motion = np.stack((np.cos(shifted), np.sin(shifted)), 1)
    found = recalls(text, motion)
    assert found[0].tolist() == [0.0, 1.0, 1.0, 1.0, 1.0, 2.0]


def test_copies_are_ties_to_the_last_bit() -> None:
    rng = np.random.default_rng(2)
    place = rng.integers(0, 9, 200)  # nine captions, given again and again
    text = rng.normal(size=(9, 33)).astype(np.float32)[place]
    similarity = cosines(text, text)
    assert all(len(np.unique(row)) <= 9 for row in similarity)
    counts = np.bincount(place)[place]
    assert recalls(text, text)[0, 0] == pytest.approx((1 / counts).mean())
    same = (place[:, None] == place[None]).astype(float)
    assert recalls(text, text, same)[0, 0] == 1.0


@given(
    st.lists(st.tuples(st.integers(0, 3), st.booleans()), min_size=1, max_size=5),
    st.integers(1, 7),
)
@settings(max_examples=40, deadline=None)
def test_ranks_average_over_every_order_of_the_ties(
    candidates: list[tuple[int, bool]], k: int
) -> None:
    distances = np.array([[float(distance) for distance, _ in candidates]])
    relevant = np.array([[right for _, right in candidates]])
    ranks = []
    for order in itertools.permutations(range(len(candidates))):
        ranked = sorted(order, key=lambda i: distances[0, i])  # stable: ties stay in `order`
        right = [place for place, i in enumerate(ranked, 1) if relevant[0, i]]
        ranks.append(min(right, default=np.inf))
    found = best_ranks(distances, relevant)
    assert found.hits(k)[0] == pytest.approx(np.mean(np.array(ranks) <= k), abs=1e-9)
    if relevant.any():
        assert found.mean()[0] == pytest.approx(np.mean(ranks))


def test_recall_does_not_depend_on_the_order_of_the_pairs() -> None:
    text, motion = noisy_pairs()
    order = np.random.default_rng(3).permutation(len(text))
    before, after = recalls(text, motion), recalls(text[order], motion[order])
    np.testing.assert_allclose(after, before)
    np.testing.assert_array_equal(recalls(motion, text), before[::-1])


def test_shuffled_motions_score_chance() -> None:
    rng = np.random.default_rng(4)
    text, motion = noisy_pairs(1000, 16)
    found = recalls(text, rng.permutation(motion))[0]
    assert found[4] == pytest.approx(10 / 1000, abs=0.007)
    assert found[5] == pytest.approx(500, rel=0.08)


def test_batches_are_easier_and_leave_out_the_rest() -> None:
    text, motion = noisy_pairs(200, 8, 1.0)
    found = recall_in_pools(text, motion, seed=1)
    assert found[0, 0] > recalls(text, motion)[0, 0]
    one = recall_in_pools(text[:32], motion[:32])
    np.testing.assert_allclose(one, recalls(text[:32], motion[:32]))
    alike = text_similarity([f"caption {i % 50}" for i in range(200)])
    np.testing.assert_allclose(
        recall_in_pools(text, motion, 200, alike), recalls(text, motion, alike)
    )
    with pytest.raises(ValueError, match="fewer than one pool"):
        recall_in_pools(text[:31], motion[:31])


def test_the_dissimilar_subset_takes_one_of_each_cluster() -> None:
    rng = np.random.default_rng(5)
    cluster = rng.permutation(np.repeat(np.arange(12), 5))
    similarity = np.where(cluster[:, None] == cluster[None], 0.99, 0.1)
    rows = dissimilar_subset(similarity, 12)
    assert sorted(cluster[rows]) == list(range(12))
    assert sorted(cluster[dissimilar_subset(similarity, 200)]) == list(range(12))  # no two alike
    drawn = {tuple(dissimilar_subset(similarity, 12, seed=seed)) for seed in range(5)}
    assert len(drawn) == 5
    assert list(dissimilar_subset(0.9 * similarity, 200)) == list(range(60))


def test_the_dissimilar_subset_is_near_the_best_of_all_subsets() -> None:
    rng = np.random.default_rng(6)
    for _ in range(5):
        text, _ = rng.normal(size=(2, 11, 3))
        similarity = cosines(text, text)
        sums = {
            subset: similarity[np.ix_(subset, subset)].sum()
            for subset in itertools.combinations(range(11), 4)
        }
        ours = sums[tuple(dissimilar_subset(0.9 * similarity, 4).tolist())]
        best, mean = min(sums.values()), np.mean(list(sums.values()))
        assert (ours - best) / (mean - best) < 0.15


def test_text_similarity_knows_equal_captions_and_groups() -> None:
    captions = ["a person walks", "A person walks.", "someone waves the left hand", "歩く人", ""]
    similarity = text_similarity(captions)
    assert similarity[0, 1] == pytest.approx(1) and np.allclose(similarity, similarity.T)
    assert 0.5 <= similarity[0, 2] < 0.75 and similarity[0, 3] == pytest.approx(0.5)
    grouped = text_similarity(captions, ["walk", "walk", "wave", "walk", "none"])
    assert grouped[0, 3] == 1 and grouped[0, 2] == similarity[0, 2]
    with_group = recalls(np.eye(5), np.eye(5)[[3, 1, 2, 0, 4]], grouped)
    assert with_group[0, 0] == 1.0
    assert recalls(np.eye(5), np.eye(5)[[3, 1, 2, 0, 4]])[0, 0] < 1


def test_bad_embeddings_are_named() -> None:
    good = np.ones((40, 3))
    with pytest.raises(ValueError, match="NaN"):
        recalls(good, np.full((40, 3), np.nan))
    with pytest.raises(ValueError, match="length 0"):
        recall_in_pools(good, np.zeros((40, 3)))
    with pytest.raises(ValueError, match="aligned"):
        recalls(good, good[:, :2])


def sample(num: int) -> MotionSample:
    text, motion = noisy_pairs(num)
    captions = [f"caption number {i} of {i % 7} kinds" for i in range(num)]
    clips = Clips([STANDING] * num, captions, captions, captions, [{}] * num)
    return MotionSample.of(clips, text, motion, np.arange(num))


def test_the_families_fill_their_columns() -> None:
    pairs, few = sample(120), sample(20)
    keys = [column.key for family in TMR for column in family.columns]
    assert len(set(keys)) == len(keys) == 52
    for protocol, family in zip(PROTOCOLS, TMR, strict=True):
        found = family.compute(pairs, pairs, seed=0)
        assert list(found) == [column.key for column in family.columns]
        assert all(np.isfinite(value) for value in found.values())
        assert protocol in family.name and "published" in family.definition
    assert TMR[3].compute(few, few, seed=0) == {}
    assert TMR[0].compute(sample(700), pairs, seed=0)["tmr_all_pairs"] == 256
    strict = TMR[0].compute(pairs, pairs, seed=0)["tmr_all_t2m_r1"]
    loose = TMR[1].compute(pairs, pairs, seed=0)["tmr_threshold_t2m_r1"]
    assert strict <= loose
