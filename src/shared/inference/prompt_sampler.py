"""PromptSampler: several candidates for each prompt, and the best of them.

Letters: N candidates.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

from ..model.generation.motion_generator import MotionGenerator
from ..motion.motion import Motion
from .selection import ScoreTable
from .spoken import SentenceGenerator
from .text_judge import TextJudge


@dataclass(frozen=True, eq=False)
class PromptResult:
    """The best motion for one prompt; all N, as sampled, if asked for; their scores."""

    motion: Motion
    all_candidates: list[Motion] | None
    table: ScoreTable

    def ranked(self) -> list[Motion]:
        """All candidates, best first; only the best where the others were not kept."""
        if self.all_candidates is None:
            return [self.motion]
        return [self.all_candidates[place] for place in self.table.order]


class PromptSampler:
    """Best of N for prompts, the text side's `MotionSampler`.

    Args:
        generator: trained.
        judge: of the candidates; one with the generator's motion tower sees the prompt, None
            makes one without.
    """

    def __init__(self, generator: MotionGenerator, judge: TextJudge | None = None) -> None:
        self.generator, self.judge = SentenceGenerator(generator), judge or TextJudge()

    def sample(
        self,
        prompts: Sequence[str],
        num_samples: int = 8,
        *,
        return_all: bool = False,
        **settings: Any,
    ) -> list[PromptResult]:
        """Sample N candidates a prompt and keep the one that the judge puts first.

        Args:
            prompts: see `SentenceGenerator.generate`.
            num_samples: N; candidate i depends on (seed, prompt, i) alone.
            return_all: keep the others too.
            settings: what else `SentenceGenerator.generate` takes.

        Raises:
            UserError: as `SentenceGenerator.generate`.
        """
        motions = self.generator.generate(prompts, num_samples=num_samples, **settings)
        embeddings = self.generator.encode_prompts(prompts).pooled
        results = []
        for number, embedding in enumerate(embeddings):
            made = motions[number * num_samples : (number + 1) * num_samples]
            table = self.judge.judge(made, embedding)
            results.append(PromptResult(made[table.best], made if return_all else None, table))
        return results
