"""The performer's evaluation: does the whole body hear the music, obey the words, keep its feet?

Rows and families are those of `registry.py`; tables with rows of their own follow. Editing by the
same mechanism is measured on clips that no training saw.
"""

from collections.abc import Callable
from dataclasses import asdict
from functools import partial
from pathlib import Path
from typing import Any

from ..files import sha256_file
from ..formats.arrays import write_npz
from ..model.zoo import resolve_model
from . import manifest
from .dance_context import DanceContext
from .dance_sample import BodySample
from .editing_context import EditContext
from .editing_tables import kept_table, path_table, transition_table
from .engine import Bench, Progress, part_name, run_bench
from .grids import Grid, report_data
from .parts import Part, Parts
from .registry import DANCE_EXTRAS, DANCE_FAMILIES, DANCE_ROWS
from .worst import Keeper


def evaluate_performer(
    context: DanceContext,
    edits: EditContext | None = None,
    *,
    about: dict[str, Any] | None = None,
    folder: Path | None = None,
    progress: Progress = lambda text: None,
) -> dict[str, Any]:
    """The whole report as plain data.

    Args:
        context: models, songs and amounts.
        edits: of editing; None = not measured.
        about: what to repeat in the report; `model` and `audio_model` are names or folders.
        folder: of the report: finished parts are kept there and not measured again.
        progress: told what begins.

    Raises:
        UserError: the data or a song cannot be used, or the folder holds another report.
    """
    settings, about = context.settings, about or {}
    if folder is not None:
        manifest.claim(folder, _manifest(context, edits, about))
    parts = Parts(folder)
    bench = dance_bench(context, folder)
    tables = run_bench(bench, parts, settings.replications, settings.seed, progress)
    extras: dict[str, Callable[[], list[Grid]]] = {
        name: partial(extra, context) for name, extra in DANCE_EXTRAS.items()
    }
    if edits is not None:
        extras |= {
            "edits": lambda: [kept_table(edits)],
            "paths": lambda: [path_table(edits)],
            "transitions": lambda: [transition_table(edits, context.judge)],
        }
    for name, extra in extras.items():
        part = parts.once(name, partial(_as_part, extra))
        tables += [Grid.from_dict(grid) for grid in part["grids"]]
    samples = parts.once(part_name(bench.name, bench.main, 0), dict).get("samples", [])
    facts = {
        **about,
        "evaluator_hash": context.judge.content_hash,
        "data": context.data or "none",
        "clips": "none" if edits is None else edits.held_out.source,
    }
    return report_data("performer", facts, asdict(settings), tables, samples)


def _as_part(extra: Callable[[], list[Grid]]) -> Part:
    return {"grids": [grid.as_dict() for grid in extra()]}


def dance_bench(context: DanceContext, folder: Path | None) -> Bench[BodySample]:
    """The rows of the registry over the songs."""
    return Bench(
        "dances",
        "dances",
        lambda: context.reference,
        [kind.bind(context) for kind in DANCE_ROWS if kind.when(context)],
        DANCE_FAMILIES,
        keep=Keeper(folder, "dances", context.settings.worst, DANCE_FAMILIES, write_body),
    )


def write_body(sample: BodySample, row: int, path: Path) -> dict[str, Any]:
    """A dance; its title is the song and what was asked for."""
    dance = sample.dances[row]
    write_npz(dance.motion, path)
    return {"title": f"{dance.song}: {dance.motion.text}"}


def _manifest(
    context: DanceContext, edits: EditContext | None, about: dict[str, Any]
) -> dict[str, Any]:
    named = {name: about[name] for name in ("model", "audio_model", "other") if about.get(name)}
    model = {
        f"{name}/{file}": digest
        for name, folder in named.items()
        for file, digest in manifest.folder_hashes(resolve_model(folder)).items()
    }
    files = [] if context.songs is None else sorted(context.songs.rglob("*"))
    generator, singer = context.generator, context.singer.model
    return manifest.build(
        "performer",
        model=model,
        evaluator={"hash": context.judge.content_hash},
        data={
            "pairs": context.data or "",
            "songs": {path.name: sha256_file(path) for path in files if path.is_file()},
            "clips": "" if edits is None else edits.held_out.data.manifest_hash,
        },
        statistics=(generator.mean, generator.std, singer.mean, singer.std),
        settings=asdict(context.settings),
        sampling=asdict(context.sampling),
        families=DANCE_FAMILIES,
        device=str(generator.device),
    )
