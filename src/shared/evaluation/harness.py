"""`evaluate --quick`: one call from a generator and prepared data to honest tables.

Rows stand beside real motion and chance; seen and unseen label combinations apart; the report
states N, seeds and the hashes of model, evaluator and data.
"""

import logging
import time
from collections.abc import Callable, Sequence
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from src.shared.data.captions import CaptionBook
from src.shared.data.records import ClipRecord
from src.shared.errors import UserError
from src.shared.evaluation.clips import Clips, Sampler, frozen, real_clips
from src.shared.evaluation.control_table import control_table
from src.shared.evaluation.evaluator import Evaluator
from src.shared.evaluation.held_out import HeldOut, open_held_out
from src.shared.evaluation.metrics_retrieval import BATCH, normalised_score
from src.shared.evaluation.physical_table import Observed, Row, physical_columns
from src.shared.evaluation.split_table import (
    Embedded,
    Reference,
    generated_row,
    learned_columns,
    r_precision,
    real_rows,
    scores,
)
from src.shared.motion.motion import Motion
from src.shared.motion.root_track import decode_features, encode_features

if TYPE_CHECKING:
    from src.shared.model.generation.motion_generator import MotionGenerator

Progress = Callable[[str], None]
LANGUAGES = ("en", "es", "fr", "de", "ja", "zh")


@dataclass(frozen=True)
class QuickSettings:
    """How much is measured; the report repeats it."""

    num_samples: int = 256  # generated motions a split and replication; 1000 for a quoted FD
    replications: int = 3
    max_real: int = 4096  # real clips a split, at most
    max_frames: int = 128
    language_samples: int = 128  # motions a language in the language table; 0 = no table
    control_seeds: int = 10  # motions a task, language and kind of wording; 0 = no table
    languages: tuple[str, ...] = LANGUAGES
    language: str = "en"  # of the captions in the split tables
    seed: int = 0


def model_sampler(
    generator: "MotionGenerator",
    *,
    steps: int | None = None,
    sampler: str | None = None,
    guidance_scale: float | None = None,
    foot_lock: bool | None = None,
) -> Sampler:
    """A sampler over a generator; what is None is the model's own setting."""

    def sample(prompts: Sequence[str], num_frames: Sequence[int], seed: int) -> list[Motion]:
        return generator.generate(
            prompts,
            seconds=[frames / generator.card.fps for frames in num_frames],
            seed=seed,
            steps=steps,
            sampler=sampler,
            guidance_scale=guidance_scale,
            foot_lock=foot_lock,
        )

    return sample


def quick(
    model: str,
    data: str = "synthetic",
    *,
    evaluator: str = "evaluator",
    cache: Path = Path("runs"),
    settings: QuickSettings | None = None,
    device: str | None = None,
    progress: Progress = lambda text: None,
    **sampling: Any,
) -> dict[str, Any]:
    """Everything `evaluate --quick` does, by names.

    Args:
        model: a shipped name or a folder.
        data: prepared folder (its test splits), or "synthetic" (fresh clips).
        evaluator: a shipped name or a folder.
        cache: where synthetic clips are kept.
        device: of the generator.
        sampling: steps, sampler, guidance_scale, foot_lock; left out = the model's own.

    Raises:
        UserError: no such model, evaluator or data, or the model is untrained.
    """
    from src.shared.model.generation.motion_generator import MotionGenerator

    judge = Evaluator.from_pretrained(evaluator)
    generator = MotionGenerator.from_pretrained(model, device=device)
    held_out = open_held_out(data, cache, judge.trained_groups)
    network = generator.network.generation
    about = {
        "model": model,
        "model_hash": generator.card.weights.sha256[:12] if generator.card.weights else "",
        "sampler": sampling.get("sampler") or network.sampler,
        "steps": sampling.get("steps") or network.sampling_steps,
        "guidance_scale": _first(sampling.get("guidance_scale"), network.guidance_scale),
        "foot_lock": _first(sampling.get("foot_lock"), network.post_processing.foot_lock),
        "evaluator": evaluator,
        "held_out": _told_apart(held_out, generator.card.data, judge),
    }
    logging.getLogger("src.shared.model.generation.motion_generator").setLevel(logging.ERROR)
    samplers = {"generated": model_sampler(generator, **sampling)}
    return evaluate_quick(
        samplers, held_out, judge, settings=settings, about=about, progress=progress
    )


def _first(value: Any, otherwise: Any) -> Any:
    return otherwise if value is None else value


def _told_apart(held_out: HeldOut, model_data: str, judge: Evaluator) -> str:
    """Whether the test clips were kept from both models, as far as the hashes tell."""
    if held_out.source.startswith("fresh"):
        return "yes: clips made for this test only"
    own = held_out.data.manifest_hash
    strangers = [
        name
        for name, trained_on in (("model", model_data), ("evaluator", judge.notes.get("data-hash")))
        if trained_on != own
    ]
    if strangers:
        return f"unknown: the {' and the '.join(strangers)} saw other data than this folder's"
    return "yes: test splits of the data both models were trained on"


def evaluate_quick(
    samplers: dict[str, Sampler],
    held_out: HeldOut,
    evaluator: Evaluator,
    *,
    settings: QuickSettings | None = None,
    about: dict[str, Any] | None = None,
    progress: Progress = lambda text: None,
) -> dict[str, Any]:
    """Everything of `evaluate --quick` as plain data.

    Args:
        samplers: name to sampler; the first one is the model that the language and controllability
            tables are about, the others (an untrained or older model) only add rows.
        held_out: held-back clips.
        evaluator: the judge.
        about: what to repeat in the report: model, its hash, steps, guidance scale.
        progress: told what begins.
    """
    settings = settings or QuickSettings()
    started = time.perf_counter()
    main = next(iter(samplers.values()))
    splits: dict[str, Any] = {}
    for name in held_out.records:
        try:
            splits[name] = split_report(held_out, name, evaluator, samplers, settings, progress)
        except UserError as error:
            splits[name] = {"missing": str(error)}
    languages = language_table(held_out, evaluator, main, settings, progress)
    control = None
    if settings.control_seeds:
        everything = [record for records in held_out.records.values() for record in records]
        control = control_table(
            main,
            CaptionBook.load(None),
            _clips(held_out, everything, settings, settings.language),
            languages=settings.languages,
            num_seeds=settings.control_seeds,
            seed=settings.seed,
            progress=progress,
        )
    return {
        "about": {
            **(about or {}),
            "evaluator_hash": evaluator.content_hash,
            "data": held_out.source,
            "data_hash": held_out.data.manifest_hash[:12],
        },
        "settings": asdict(settings),
        "splits": splits,
        "languages": languages,
        "controllability": control,
        "seconds": round(time.perf_counter() - started, 1),
    }


def _clips(
    held_out: HeldOut, records: Sequence[ClipRecord], settings: QuickSettings, language: str
) -> Clips:
    return real_clips(
        held_out.data,
        records,
        num=settings.max_real,
        max_frames=settings.max_frames,
        language=language,
        seed=settings.seed,
    )


def split_report(
    held_out: HeldOut,
    name: str,
    evaluator: Evaluator,
    samplers: dict[str, Sampler],
    settings: QuickSettings,
    progress: Progress,
) -> dict[str, Any]:
    """The table of one split: rows `real`, `chance`, `frozen pose` and one a sampler.

    Raises:
        UserError: the split holds no captioned clip.
    """
    clips = _clips(held_out, held_out.records[name], settings, settings.language)
    progress(f"{name}: {len(clips)} real clips")
    reference = Reference.of(Embedded.of(evaluator, clips))
    rows = real_rows(reference, settings.replications, settings.seed)
    rows["frozen pose"] = _frozen_row(evaluator, reference, settings.seed)
    for label, sampler in samplers.items():
        progress(f"{name}: {settings.replications} x {settings.num_samples} motions, {label}")
        rows[label] = generated_row(
            sampler,
            evaluator,
            reference,
            num_samples=settings.num_samples,
            replications=settings.replications,
            seed=settings.seed,
        )
    return {
        "num_real": len(clips),
        "num_groups": len(set(clips.groups)),
        "num_generated": settings.num_samples,
        "rows": rows,
        "scores": {label: scores(rows, label) for label in [*samplers, "frozen pose"]},
    }


def _frozen_row(evaluator: Evaluator, reference: Reference, seed: int) -> Row:
    clips = reference.real.clips
    still = [decode_features(frozen(encode_features(motion))) for motion in clips.motions]
    sample = reference.real.with_motions(evaluator, clips.with_motions(still))
    learned = learned_columns(sample, reference, seed)
    row: Row = {
        name: {"value": value, "low": value, "high": value, "count": 1}
        for name, value in learned.items()
    }
    travels = reference.observed.travels
    return row | physical_columns(Observed.of(still), clips.labels, travels)


def language_table(
    held_out: HeldOut,
    evaluator: Evaluator,
    sampler: Sampler,
    settings: QuickSettings,
    progress: Progress,
) -> dict[str, dict[str, float]]:
    """R-precision at 3 language by language on seen combinations: real, chance, generated."""
    table: dict[str, dict[str, float]] = {}
    num = settings.language_samples
    for language in settings.languages if num else ():
        try:
            clips = _clips(held_out, held_out.records["seen"], settings, language)
        except UserError:
            continue  # the data has no captions in this language
        if min(len(clips), num) < BATCH:
            continue
        progress(f"languages: {num} motions in {language}")
        real = Embedded.of(evaluator, clips)
        shuffled = real.reordered(np.random.default_rng(settings.seed).permutation(len(clips)))
        asked = real.rows([row % len(clips) for row in range(num)])
        motions = sampler(asked.clips.captions, asked.clips.num_frames, settings.seed)
        made = asked.with_motions(evaluator, asked.clips.with_motions(motions))
        values = {
            name: r_precision(sample, settings.seed).r_precision[2]
            for name, sample in (("real", real), ("chance", shuffled), ("generated", made))
        }
        score = normalised_score(values["generated"], values["chance"], values["real"])
        table[language] = values | {"normalised": score, "num_samples": num}
    return table
