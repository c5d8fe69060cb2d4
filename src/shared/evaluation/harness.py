"""The text branch's evaluation: one call from a generator and prepared data to honest tables.

Every family of `registry.py` is measured on real, shuffled, frozen, untrained and generated
motions, seen and unseen label combinations apart, replication by replication.
"""

from collections.abc import Callable, Sequence
from dataclasses import asdict
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Any

from ..data.prepared import ClipRecord
from ..errors import UserError
from . import manifest
from .clips import Sampler
from .engine import Bench, Progress, Row, part_name, run_bench
from .evaluator import Evaluator
from .families import Column, MotionSample
from .grids import Grid, GridRow, report_data
from .held_out import HeldOut, open_held_out
from .parts import Part, Parts
from .registry import TEXT_EXTRAS, TEXT_FAMILIES, TEXT_ROWS
from .text_context import (
    UNTRAINED,
    Split,
    TextContext,
    TextSettings,
    errors_only,
    model_sampler,
    untrained,
)
from .text_scores import score_grid
from .worst import Keeper, write_motion

if TYPE_CHECKING:
    from ..model.generation.motion_generator import TextToMotion


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
) -> dict[str, Any]:
    """Everything `evaluate` does for a text model, by names.

    Args:
        model: a shipped name or a folder.
        data: prepared folder (its test splits), or "synthetic" (fresh clips).
        evaluator: a shipped name or a folder.
        cache: where synthetic clips are kept.
        device: of the generator.
        folder: of the report: finished parts are kept there and not measured again.
        sampling: steps, sampler, guidance_scale, foot_lock; left out = the model's own.

    Raises:
        UserError: no such model, evaluator or data, the model is untrained, or the folder holds
            another report.
    """
    from ..model.generation.motion_generator import TextToMotion

    settings = settings or TextSettings()
    judge = Evaluator.from_pretrained(evaluator)
    generator = TextToMotion.from_pretrained(model, device=device)
    held_out = open_held_out(data, cache, judge.trained_groups)
    about = _about(model, generator, evaluator, judge, held_out, sampling)
    if folder is not None:
        manifest.claim(
            folder, _manifest(model, generator, evaluator, judge, held_out, settings, sampling)
        )
    samplers = {"generated": model_sampler(generator, **sampling)}
    if settings.untrained:
        samplers[UNTRAINED] = model_sampler(untrained(generator, settings.seed), **sampling)
    with errors_only():
        return evaluate_samplers(
            samplers,
            held_out,
            judge,
            settings=settings,
            about=about,
            folder=folder,
            progress=progress,
        )


def _about(
    model: str,
    generator: "TextToMotion",
    evaluator: str,
    judge: Evaluator,
    held_out: HeldOut,
    sampling: dict[str, Any],
) -> dict[str, Any]:
    """What the report repeats of model, judge and data."""
    network = generator.network.generation
    return {
        "model": model,
        "model_hash": generator.card.weights.sha256[:12] if generator.card.weights else "",
        "sampler": sampling.get("sampler") or network.sampler,
        "steps": sampling.get("steps") or network.sampling_steps,
        "guidance_scale": _first(sampling.get("guidance_scale"), network.guidance_scale),
        "foot_lock": _first(sampling.get("foot_lock"), network.post_processing.foot_lock),
        "evaluator": evaluator,
        "held_out": _told_apart(held_out, generator.card.data, judge),
    }


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


def _manifest(
    model: str,
    generator: "TextToMotion",
    evaluator: str,
    judge: Evaluator,
    held_out: HeldOut,
    settings: TextSettings,
    sampling: dict[str, Any],
) -> dict[str, Any]:
    from ..model.zoo import PRETRAINED, resolve_model

    judge_folder = Path(evaluator) if Path(evaluator).is_dir() else PRETRAINED / evaluator
    splits = {
        name: manifest.hash_names(record.id for record in records)
        for name, records in held_out.records.items()
    }
    return manifest.build(
        "text",
        model=manifest.folder_hashes(resolve_model(model)),
        evaluator=manifest.folder_hashes(judge_folder),
        data={"manifest": held_out.data.manifest_hash, **splits},
        statistics=(generator.mean, generator.std, judge.motion.mean, judge.motion.std),
        settings=asdict(settings),
        sampling=sampling,
        families=TEXT_FAMILIES,
        device=str(generator.device),
    )


def evaluate_samplers(
    samplers: dict[str, Sampler],
    held_out: HeldOut,
    evaluator: Evaluator,
    *,
    settings: TextSettings | None = None,
    about: dict[str, Any] | None = None,
    folder: Path | None = None,
    progress: Progress = lambda text: None,
) -> dict[str, Any]:
    """The whole report as plain data.

    Args:
        samplers: name to sampler; the first one is the model that the extra tables are about, the
            others (an untrained or older model) only add rows.
        held_out: held-back clips.
        evaluator: the judge.
        about: what to repeat in the report: model, its hash, steps, guidance scale.
        progress: told what begins.

    Returns:
        See `report_data`.
    """
    settings = settings or TextSettings()
    parts = Parts(folder)
    context = TextContext(held_out, evaluator, samplers, settings, progress, parts)
    tables: list[Grid] = []
    samples: list[dict[str, Any]] = []
    for name, records in held_out.records.items():
        bench = split_bench(context, name, records, folder)
        try:
            grids = run_bench(bench, parts, settings.replications, settings.seed, progress)
        except UserError as error:
            tables.append(missing(name, str(error)))
            continue
        tables += [*grids, score_grid(name, grids, [*samplers, "frozen pose"])]
        samples += parts.once(part_name(name, bench.main, 0), dict).get("samples", [])
    for name, extra in TEXT_EXTRAS.items():
        part = parts.once(name, partial(_as_part, extra, context))
        tables += [Grid.from_dict(grid) for grid in part["grids"]]
    facts = {
        **(about or {}),
        "evaluator_hash": evaluator.content_hash,
        "data": held_out.source,
        "data_hash": held_out.data.manifest_hash[:12],
    }
    return report_data("text", facts, asdict(settings), tables, samples)


def _as_part(extra: Callable[[TextContext], list[Grid]], context: TextContext) -> Part:
    return {"grids": [grid.as_dict() for grid in extra(context)]}


def split_bench(
    context: TextContext, name: str, records: Sequence[ClipRecord], folder: Path | None
) -> Bench[MotionSample]:
    """The rows of the registry and one a sampler over the clips of a split."""
    split = Split(context, records)
    rows = [kind.bind(split) for kind in TEXT_ROWS if kind.when(split)]
    for label, sampler in context.samplers.items():
        limit = context.settings.untrained if label == UNTRAINED else None
        rows.append(Row(label, partial(split.generated, sampler), limit=limit))
    return Bench(
        name,
        f"{name} label combinations",
        lambda: split.reference,
        rows,
        TEXT_FAMILIES,
        main=next(iter(context.samplers)),
        keep=Keeper(folder, name, context.settings.worst, TEXT_FAMILIES, write_motion),
    )


def missing(name: str, why: str) -> Grid:
    """What stands where a split could not be measured."""
    row = GridRow({"why": why})
    return Grid(name, f"{name}: not measured", (Column("why", "why"),), {name: row})
