"""Multimodality against plain loops and closed forms."""

import math

import numpy as np
import pytest

from src.shared.evaluation.families import MULTIMODALITY
from src.shared.evaluation.samples import Clips, MotionSample
from src.shared.metrics.frechet import within_prompts
from src.shared.motion.motion import Motion

STANDING = Motion(np.eye(4)[np.zeros((2, 22), int)], np.zeros((2, 3)), np.zeros((2, 2)))


def sample(vectors: np.ndarray, captions: list[str]) -> MotionSample:
    clips = Clips([STANDING] * len(captions), captions, captions, captions, [{}] * len(captions))
    return MotionSample.of(clips, vectors, vectors, np.arange(len(captions)))


def test_it_is_the_mean_over_pairs_of_one_prompt() -> None:
    rng = np.random.default_rng(0)
    vectors, prompts = rng.normal(size=(30, 4)), list("aaaabbbccd" * 3)
    means = []
    for name in sorted(set(prompts)):
        rows = [i for i, prompt in enumerate(prompts) if prompt == name]
        apart = [
            math.dist(vectors[i], vectors[j]) for k, i in enumerate(rows) for j in rows[k + 1 :]
        ]
        means.append(sum(apart) / len(apart))
    distance, num_prompts = within_prompts(vectors, prompts)
    assert distance == pytest.approx(sum(means) / 4) and num_prompts == 4


def test_it_is_what_ten_random_pairs_estimate() -> None:
    vectors = np.random.default_rng(1).normal(size=(200, 30, 8))
    prompts = [str(p) for p in range(200) for _ in range(30)]
    exact, num_prompts = within_prompts(vectors.reshape(-1, 8), prompts)
    rng = np.random.default_rng(2)  # Guo's draw: ten random pairs a prompt
    pairs = [vectors[p, rng.permutation(30)[:20]].reshape(2, 10, 8) for p in range(200)]
    guo = np.mean([np.linalg.norm(first - second, axis=-1).mean() for first, second in pairs])
    assert guo == pytest.approx(exact, rel=0.02)
    # difference of two unit normals in 8 dimensions: √2 times the chi distribution's mean
    mean = math.sqrt(2) * math.sqrt(2) * math.gamma(4.5) / math.gamma(4)
    assert exact == pytest.approx(mean, rel=0.01) and num_prompts == 200


def test_one_answer_a_prompt_is_zero_and_no_repetition_is_nothing() -> None:
    places = np.repeat(np.eye(3), 4, 0)
    assert within_prompts(places, list("aaaabbbbcccc"))[0] == 0
    alone, num_prompts = within_prompts(np.eye(3), ["a", "b", "c"])
    assert math.isnan(alone) and num_prompts == 0
    assert within_prompts(np.eye(3), ["a", "b", "a"])[0] == pytest.approx(math.sqrt(2))


def test_bad_input_is_named() -> None:
    with pytest.raises(ValueError, match="not aligned"):
        within_prompts(np.eye(3), ["a"])
    with pytest.raises(ValueError, match="NaN"):
        within_prompts(np.full((2, 2), np.nan), ["a", "a"])


def test_the_family_says_what_share_of_all_variety_a_caption_leaves() -> None:
    rng = np.random.default_rng(2)
    captions = [f"caption {i % 20}" for i in range(200)]
    centre = rng.normal(size=(20, 6))[np.arange(200) % 20]
    family, near = MULTIMODALITY, centre + 0.1 * rng.normal(size=(200, 6))
    told = family.compute(sample(near, captions), sample(near, captions), seed=0)
    assert list(told) == [column.key for column in family.columns]
    assert told["multimodality_share"] < 0.2 and told["multimodality_prompts"] == 20
    shuffled = rng.permutation(near)
    chance = family.compute(sample(shuffled, captions), sample(near, captions), seed=0)
    assert chance["multimodality_share"] == pytest.approx(1, abs=0.1)
    lonely = sample(np.eye(3), ["a", "b", "c"])
    assert family.compute(lonely, lonely, seed=0) == {}
    point = sample(np.ones((4, 2)), ["a"] * 4)
    assert math.isnan(family.compute(point, point, seed=0)["multimodality_share"])
