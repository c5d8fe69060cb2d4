"""What the text branch is measured with: settings, held-back clips, the judge, the samplers.

Letters: N clips.
"""

import logging
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass, field
from functools import cached_property
from typing import TYPE_CHECKING, Any

import numpy as np

from ..data.prepared import ClipRecord
from ..motion.features import decode_features, encode_features
from ..motion.motion import Motion
from .clips import Clips, Sampler, frozen, real_clips
from .evaluator import Evaluator
from .families import MotionSample
from .held_out import HeldOut
from .parts import Parts

if TYPE_CHECKING:
    from ..model.generation.motion_generator import TextToMotion

Progress = Callable[[str], None]
LANGUAGES = ("en", "es", "fr", "de", "ja", "zh")
UNTRAINED = "untrained"  # name of the row whose replications `TextSettings.untrained` limits


@dataclass(frozen=True)
class TextSettings:
    """How much is measured; the report repeats it."""

    num_samples: int = 256  # generated motions a split and replication; 1000 for a quoted FD
    replications: int = 20
    untrained: int = 3  # replications of the untrained row, at most
    max_real: int = 4096  # real clips a split, at most
    max_frames: int = 128
    language_samples: int = 128  # motions a language, at most num_samples; 0 = no such table
    control_seeds: int = 10  # motions a task, language and kind of wording; 0 = no table
    languages: tuple[str, ...] = LANGUAGES
    language: str = "en"  # of the captions in the split tables
    seed: int = 0
    worst: int = 8  # motions a split to be looked at


@dataclass(frozen=True, eq=False)
class TextContext:
    """Everything a table of the text branch may draw on.

    Attributes:
        samplers: by the name of their row; the first is the model that the other tables are about.
        parts: where a table that takes long keeps what it has finished.
    """

    held_out: HeldOut
    judge: Evaluator
    samplers: dict[str, Sampler]
    settings: TextSettings
    progress: Progress
    parts: Parts = field(default_factory=Parts)

    @property
    def sampler(self) -> Sampler:
        """The model's."""
        return next(iter(self.samplers.values()))

    @property
    def untrained(self) -> Sampler | None:
        """That of the same network with fresh weights; None if no such row is wanted."""
        return self.samplers.get(UNTRAINED)

    def clips(self, records: Sequence[ClipRecord], language: str) -> Clips:
        """Real clips with a caption in this language, spread over label groups.

        Raises:
            UserError: there is none.
        """
        return real_clips(
            self.held_out.data,
            records,
            num=self.settings.max_real,
            max_frames=self.settings.max_frames,
            language=language,
            seed=self.settings.seed,
        )

    def real(self, records: Sequence[ClipRecord], language: str) -> MotionSample:
        """The same as a sample; `source` is each clip itself."""
        clips = self.clips(records, language)
        text = self.judge.embed_text(clips.captions).numpy()
        motion = self.judge.embed_motion(clips.motions).numpy()
        return MotionSample.of(clips, text, motion, np.arange(len(clips)))

    def made(self, asked: MotionSample, motions: list[Motion]) -> MotionSample:
        """Other motions under the captions of a sample."""
        motion = self.judge.embed_motion(motions).numpy()
        return MotionSample.of(asked.clips.with_motions(motions), asked.text, motion, asked.source)


class Split:
    """The samples of one split: real clips once, the rest replication by replication."""

    def __init__(self, context: TextContext, records: Sequence[ClipRecord]) -> None:
        self.context, self.records = context, records
        self.seed = context.settings.seed

    @cached_property
    def reference(self) -> MotionSample:
        """The real clips.

        Raises:
            UserError: the split holds no captioned clip.
        """
        return self.context.real(self.records, self.context.settings.language)

    @cached_property
    def _siblings(self) -> MotionSample:
        """The real clips, each to be compared with another of its label group."""
        real, rng = self.reference, np.random.default_rng(self.seed)
        source = np.full(len(real), -1)
        groups: dict[str, list[int]] = {}
        for row, group in enumerate(real.clips.groups):
            groups.setdefault(group, []).append(row)
        for rows in groups.values():
            if len(rows) > 1:
                order = rng.permutation(rows)
                source[order] = np.roll(order, 1)
        return MotionSample(real.clips, real.text, real.motion, source, real.memos, real.memo)

    def real(self, replication: int) -> MotionSample:
        """The same clips each time."""
        return self._siblings

    def chance(self, replication: int) -> MotionSample:
        """The real motions under shuffled captions."""
        order = np.random.default_rng(self.seed + replication).permutation(len(self.reference))
        return self.reference.reordered(order.tolist())

    def frozen_pose(self, replication: int) -> MotionSample:
        """The first pose of each clip held still."""
        real = self.reference
        still = [decode_features(frozen(encode_features(motion))) for motion in real.clips.motions]
        return self.context.made(real, still)

    def generated(self, sampler: Sampler, replication: int) -> MotionSample:
        """Motions for the split's captions at the clips' lengths.

        The prompts are a random sample of the clips: the first ones hold more of the rare groups
        than the reference does, which alone is a distance (0.010 of 0.108 once). With fewer clips
        than samples the captions come round again, with other noise.
        """
        order = np.random.default_rng(self.seed).permutation(len(self.reference)).tolist()
        wanted = range(self.context.settings.num_samples)
        asked = self.reference.rows([order[row % len(order)] for row in wanted])
        run = self.seed + 1000 * replication
        motions = sampler(asked.clips.captions, asked.clips.num_frames, run)
        return self.context.made(asked, motions)


# ---------------------------------------------------------------- samplers


@contextmanager
def errors_only() -> Iterator[None]:
    """Thousands of prompts would each say how near they are to what was trained."""
    from ..model.generation.motion_generator import log as logger

    level = logger.level
    logger.setLevel(logging.ERROR)
    try:
        yield
    finally:
        logger.setLevel(level)


def model_sampler(generator: "TextToMotion", **sampling: Any) -> Sampler:
    """A sampler over a generator: steps, sampler, guidance_scale, foot_lock; None = its own."""

    def sample(prompts: Sequence[str], num_frames: Sequence[int], seed: int) -> list[Motion]:
        seconds = [frames / generator.card.fps for frames in num_frames]
        return generator.generate(prompts, seconds=seconds, seed=seed, **sampling)

    return sample


def untrained(generator: "TextToMotion", seed: int) -> "TextToMotion":
    """The same denoiser with fresh weights, text tower and statistics of the trained one."""
    import torch

    from ..model.generation.denoiser import MotionDenoiser
    from ..model.generation.motion_generator import TextToMotion

    with torch.random.fork_rng(devices=[]):
        torch.manual_seed(seed)
        fresh = MotionDenoiser(generator.network, generator.denoiser.num_tags)
        # As training begins the last layer is zero, and every motion the mean one.
        torch.nn.init.xavier_uniform_(fresh.output_proj.weight)
    return TextToMotion(
        fresh,
        generator.text,
        generator.tokenizer,
        mean=generator.mean,
        std=generator.std,
        card=generator.card,
        device=str(generator.device),
    )
