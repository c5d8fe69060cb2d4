"""PromptSampler keeps the best of N for each prompt."""

import numpy as np

from src.shared.inference.prompt_sampler import PromptSampler
from src.shared.inference.text_judge import TextJudge
from tests.shared.model.conftest import tiny_generator

PROMPTS = ["a person walks forward", "somebody jumps"]


def test_candidates_are_the_generators_and_the_best_is_the_judges() -> None:
    generator = tiny_generator()
    results = PromptSampler(generator).sample(
        PROMPTS, 3, seconds=[0.5, 1.0], seed=4, return_all=True
    )
    plain = generator.generate(PROMPTS, seconds=[0.5, 1.0], seed=4, num_samples=3)
    assert len(results) == 2
    for number, result in enumerate(results):
        assert result.all_candidates is not None
        for mine, other in zip(result.all_candidates, plain[3 * number :], strict=False):
            np.testing.assert_array_equal(mine.quaternions, other.quaternions)
        prompt = generator.encode_prompts([PROMPTS[number]]).pooled[0]
        table = TextJudge().judge(result.all_candidates, prompt)
        assert result.motion is result.all_candidates[table.best]
        np.testing.assert_array_equal(result.table.order, table.order)


def test_the_others_are_left_out_unless_asked_for() -> None:
    (result,) = PromptSampler(tiny_generator()).sample(PROMPTS[:1], 2, seconds=0.5)
    assert result.all_candidates is None and len(result.table.order) == 2
