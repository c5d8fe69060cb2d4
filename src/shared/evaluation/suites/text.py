"""The text suite: from a generator and prepared data to honest tables.

Every family is measured on real, shuffled, frozen, untrained and generated motions, seen and unseen
label combinations apart. Then retrieval by language, and whether what is asked for is done.

Letters: N clips.
"""

import logging
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import asdict, dataclass, field, replace
from functools import cached_property, partial
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from ...data.captions.book import CaptionBook
from ...data.prepared import ClipRecord
from ...errors import UserError
from ...formats.arrays import write_npz
from ...metrics.retrieval import BATCH, normalised_score
from ...model.evaluator import Evaluator, evaluator_folder
from ...motion.motion import Motion
from .. import manifest
from ..engine import Bench, Progress, Row, Suite, run_suite
from ..families import TEXT_FAMILIES, r_precision
from ..manifest import Part, Parts, Sources
from ..samples import (
    Clips,
    HeldOut,
    MotionSample,
    Sampler,
    frozen_pose,
    open_held_out,
    real_clips,
    rows_of_each,
    untrained,
)
from ..stats import bootstrap_mean
from ..tables import Column, Grid, GridRow, Report, plain
from .control import control_grid

if TYPE_CHECKING:
    from ...model.generation.motion_generator import TextToMotion

LANGUAGES = ("en", "es", "fr", "de", "ja", "zh")
UNTRAINED = "untrained"  # name of the row whose replications `TextSettings.untrained` limits
RATIOS = ("contact_slide", "support_slide", "jerk", "hand_jerk", "speed", "diversity")


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
    """Clips, judge and samplers of the text branch, and the tables with rows of their own."""

    held_out: HeldOut  # clips that no training saw
    judge: Evaluator
    # by the name of their row; the first is the model that the other tables are about, the others
    # (an untrained or older model) only add rows
    samplers: dict[str, Sampler]
    settings: TextSettings = field(default_factory=TextSettings)
    progress: Progress = lambda text: None  # told what begins
    actions: frozenset[str] = frozenset()  # that the model knows; none = nobody knows
    # of the report's folder: what is finished is kept there and not measured again
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
        Raises UserError: there is none."""
        most = {"num": self.settings.max_real, "max_frames": self.settings.max_frames}
        data, seed = self.held_out.data, self.settings.seed
        return real_clips(data, records, **most, language=language, seed=seed)

    def real(self, records: Sequence[ClipRecord], language: str) -> MotionSample:
        """The same as a sample; `source` is each clip itself."""
        clips = self.clips(records, language)
        text = self.judge.embed_text(clips.captions).numpy()
        motion = self.judge.embed_motion(clips.motions).numpy()
        return MotionSample.of(clips, text, motion, np.arange(len(clips)))

    def with_motions(self, asked: MotionSample, motions: list[Motion]) -> MotionSample:
        """Other motions under the captions of a sample."""
        motion = self.judge.embed_motion(motions).numpy()
        clips = replace(asked.clips, motions=motions)
        return MotionSample.of(clips, asked.text, motion, asked.source)

    def made(self, asked: MotionSample, sampler: Sampler, seed: int) -> MotionSample:
        """What a sampler makes of the captions of a sample, at its lengths."""
        return self.with_motions(asked, sampler(asked.clips.captions, asked.clips.num_frames, seed))

    # ---------------------------------------------------------------- tables with rows of their own

    def languages(self) -> list[Grid]:
        """R-precision at 3 by language on seen combinations: real, chance, generated, untrained."""
        settings = self.settings
        if not settings.language_samples:
            return []
        rows = {}
        for language in settings.languages:
            found = self.parts.once(f"languages.{language}", partial(self._language, language))
            if found["cells"]:
                rows[language] = GridRow(found["cells"], found["num"], 1)
        made_by = ["generated", *([UNTRAINED] if self.untrained else [])]
        columns = tuple(Column(key, key) for key in ("real", "chance", *made_by, "normalised"))
        seed = {"seed": settings.seed}
        return [Grid.of("languages", rows, seed, columns=columns)] if rows else []

    def _language(self, language: str) -> Part:
        """The cells of one language; none where the data has too few captions in it."""
        settings, seed = self.settings, self.settings.seed
        num = min(settings.language_samples, settings.num_samples)
        try:
            real = self.real(self.held_out.records["seen"], language)
        except UserError:
            return {"cells": None}  # the data has no captions in this language
        if min(len(real), num) < BATCH:
            return {"cells": None}
        self.progress(f"languages: {num} motions in {language}")
        asked = real.rows([row % len(real) for row in range(num)])
        order = np.random.default_rng(seed).permutation(len(real)).tolist()
        samples = {"real": real, "chance": real.reordered(order)}
        samples["generated"] = self.made(asked, self.sampler, seed)
        if self.untrained is not None:
            samples[UNTRAINED] = self.made(asked, self.untrained, seed)
        at_3 = {n: bootstrap_mean(r_precision(each, seed)[2]) for n, each in samples.items()}
        score = normalised_score(*(at_3[k].value for k in ("generated", "chance", "real")))
        return {"cells": plain({**at_3, "normalised": score}), "num": num}

    def control(self) -> list[Grid]:
        """Success rates task by task and language by language."""
        settings = self.settings
        if not settings.control_seeds:
            return []
        grid = control_grid(
            self.sampler,
            CaptionBook.load(None),
            self.clips(self.held_out.everything, settings.language),
            languages=settings.languages,
            num_seeds=settings.control_seeds,
            seed=settings.seed,
            untrained=self.untrained,
            actions=self.actions,
            progress=self.progress,
            once=self.parts.once,
        )
        return [grid] if grid.rows else []


@dataclass(frozen=True, eq=False)
class Split:
    """The samples of one split: real clips once, the rest replication by replication."""

    context: TextContext
    records: Sequence[ClipRecord]

    @property
    def seed(self) -> int:
        return self.context.settings.seed

    @cached_property
    def reference(self) -> MotionSample:
        """The real clips. Raises UserError: the split holds no captioned clip."""
        return self.context.real(self.records, self.context.settings.language)

    @cached_property
    def siblings(self) -> MotionSample:
        """The real clips, each to be compared with another of its label group."""
        real, rng = self.reference, np.random.default_rng(self.seed)
        source = np.full(len(real), -1)
        for rows in rows_of_each(real.clips.groups).values():
            if len(rows) > 1:
                order = rng.permutation(rows)
                source[order] = np.roll(order, 1)
        return replace(real, source=source)

    def chance(self, replication: int) -> MotionSample:
        """The real motions under shuffled captions."""
        order = np.random.default_rng(self.seed + replication).permutation(len(self.reference))
        return self.reference.reordered(order.tolist())

    def frozen(self, replication: int) -> MotionSample:
        """The first pose of each clip held still."""
        still = [frozen_pose(motion) for motion in self.reference.clips.motions]
        return self.context.with_motions(self.reference, still)

    def generated(self, sampler: Sampler, replication: int) -> MotionSample:
        """Motions for the captions of a random sample of the clips, at their lengths; where clips
        are fewer than samples they come round again, with other noise. (The first clips hold more
        of the rare groups, which alone is a distance: 0.010 of 0.108 once.)"""
        order = np.random.default_rng(self.seed).permutation(len(self.reference)).tolist()
        wanted = range(self.context.settings.num_samples)
        asked = self.reference.rows([order[row % len(order)] for row in wanted])
        return self.context.made(asked, sampler, self.seed + 1000 * replication)

    def bench(self, name: str) -> Bench[MotionSample]:
        """Real, chance, a frozen pose, and a row a sampler."""
        samplers, settings = self.context.samplers, self.context.settings
        rows = [
            Row("real", lambda replication: self.siblings, fixed=True, real=True),
            Row("chance", self.chance, fixed=True),
            Row("frozen pose", self.frozen, limit=1, fixed=True),
        ]
        for label, sampler in samplers.items():
            limit = settings.untrained if label == UNTRAINED else None
            rows.append(Row(label, partial(self.generated, sampler), limit=limit))

        def summary(grids: Sequence[Grid]) -> Grid:
            """What a reader asks first: each row against real and chance."""
            rows = {each: GridRow(scores(grids, each)) for each in (*samplers, "frozen pose")}
            columns = tuple(Column(k, k.replace("_", " ")) for k in rows["frozen pose"].cells)
            return Grid.of("scores", rows, {"split": name}, name=f"{name}/scores", columns=columns)

        return Bench(
            name, f"{name} label combinations", lambda: self.reference, rows, TEXT_FAMILIES,
            main=next(iter(samplers)), write=write_motion, worst=settings.worst, optional=True,
            summary=summary,
        )  # fmt: skip


def write_motion(sample: MotionSample, row: int, path: Path) -> dict[str, Any]:
    """A motion as a file; its title is the caption."""
    write_npz(sample.clips.motions[row], path)
    return {"title": sample.clips.captions[row]}


def evaluate_samplers(
    context: TextContext,
    *,
    about: Mapping[str, Any] | None = None,
    sources: Callable[[], Sources] | None = None,
) -> Report:
    """The whole report; `about` is what to repeat of the model, `sources` are for the manifest."""
    held_out = context.held_out
    facts = {
        **(about or {}),
        "evaluator_hash": context.judge.content_hash,
        "data": held_out.source,
        "data_hash": held_out.data.manifest_hash[:12],
    }
    suite = Suite(
        "text",
        asdict(context.settings),
        [Split(context, records).bench(name) for name, records in held_out.records.items()],
        {"languages": context.languages, "controllability": context.control},
        facts,
        sources=sources,
    )
    return run_suite(suite, context.parts, context.progress)


def evaluate_text(
    model: str,
    data: str = "synthetic",
    *,
    evaluator: str = "evaluator",
    cache: Path = Path("runs"),
    settings: TextSettings | None = None,
    device: str | None = None,
    folder: Path | None = None,
    progress: Progress = lambda text: None,
    **sampling: Any,
) -> Report:
    """Everything `evaluate` does for a text model, by names.

    Args:
        model, evaluator: shipped names or folders.
        data: prepared folder (its test splits), or "synthetic" (fresh clips, kept in `cache`).
        device: of the generator.
        folder: of the report: finished parts are kept there and not measured again.
        sampling: steps, sampler, guidance_scale, foot_lock; left out = the model's own.

    Raises UserError: no such model, evaluator or data, the model is untrained, or the folder holds
    another report.
    """
    from ...model.generation.motion_generator import TextToMotion

    settings = settings or TextSettings()
    judge = Evaluator.from_pretrained(evaluator)
    generator = TextToMotion.from_pretrained(model, device=device)
    held_out = open_held_out(data, cache, judge.trained_groups)
    network, card = generator.network.generation, generator.card
    own = {
        "sampler": network.sampler,
        "steps": network.sampling_steps,
        "guidance_scale": network.guidance_scale,
        "foot_lock": network.post_processing.foot_lock,
    }
    given = {key: value for key, value in sampling.items() if value is not None}
    about = {
        "model": model,
        "model_hash": card.content_hash[:12],
        **(own | {key: given[key] for key in own if key in given}),
        "evaluator": evaluator,
        "held_out": _told_apart(held_out, card.data, judge),
    }

    def sources() -> Sources:
        from ...model.checkpoint import resolve_model

        splits = held_out.records.items()
        ids = {name: manifest.hash_names(each.id for each in records) for name, records in splits}
        return Sources(
            model=manifest.folder_hashes(resolve_model(model)),
            evaluator=manifest.folder_hashes(evaluator_folder(evaluator)),
            data={"manifest": held_out.data.manifest_hash, **ids},
            statistics=(generator.mean, generator.std, judge.motion.mean, judge.motion.std),
            sampling=sampling,
            device=str(generator.device),
        )

    samplers = {"generated": model_sampler(generator, **sampling)}
    if settings.untrained:
        samplers[UNTRAINED] = model_sampler(untrained(generator, settings.seed), **sampling)
    actions = frozenset(generator.card.tags)
    context = TextContext(held_out, judge, samplers, settings, progress, actions, Parts(folder))
    with errors_only():
        return evaluate_samplers(context, about=about, sources=sources)


def _told_apart(held_out: HeldOut, model_data: str, judge: Evaluator) -> str:
    """Whether the test clips were kept from both models, as far as the hashes tell."""
    if held_out.source.startswith("fresh"):
        return "yes: clips made for this test only"
    trained_on = {"model": model_data, "evaluator": judge.notes.get("data-hash")}
    strangers = [name for name, data in trained_on.items() if data != held_out.data.manifest_hash]
    if strangers:
        return f"unknown: the {' and the '.join(strangers)} saw other data than this folder's"
    return "yes: test splits of the data both models were trained on"


@contextmanager
def errors_only() -> Iterator[None]:
    """Thousands of prompts would each say how near they are to what was trained."""
    from ...model.generation.motion_generator import log as logger

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


def scores(grids: Sequence[Grid], name: str) -> dict[str, float]:
    """Row `name` against real and chance; NaN where a column is missing."""

    def value(row: str, column: str) -> float:
        known = [grid.value(row, column) for grid in grids]
        return next((each for each in known if each == each), float("nan"))

    def over(numerator: float, denominator: float) -> float:
        return numerator / denominator if denominator > 1e-9 else float("nan")

    result = {}
    for key in ("r_at_1", "r_at_2", "r_at_3"):
        cells = (value(row, key) for row in (name, "chance", "real"))
        result[f"normalised_{key}"] = normalised_score(*cells)
    joint, wrong_tag = value("chance", "frechet_joint"), value(name, "frechet_by_wrong_tag")
    result["frechet_joint_ratio"] = over(value(name, "frechet_joint"), joint)
    result["frechet_tag_ratio"] = over(value(name, "frechet_by_tag"), wrong_tag)
    for column in RATIOS:
        result[f"{column}_ratio"] = over(value(name, column), value("real", column))
    return result
