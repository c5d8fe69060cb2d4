"""The performer's evaluation: does the whole body hear the music, obey the words, keep its feet?

Rows against families; tables with rows of their own follow. Editing by the
same mechanism is measured on clips that no training saw.
"""

from collections.abc import Callable
from dataclasses import asdict
from functools import partial
from pathlib import Path
from typing import Any

from ..formats.arrays import write_npz
from .dance_context import DanceContext
from .dance_sample import BodySample
from .dance_style import prompt_effect
from .dance_tables import alignment_tables, seam_tables
from .engine import Bench, Progress, Row, Suite, run_suite
from .families_performer import FAMILIES
from .manifest import Parts, Sources, model_hashes, song_hashes
from .report.tables import Grid
from .suites.editing import EditContext, editing_tables


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
    tables: dict[str, Callable[[], list[Grid]]] = {
        "alignment": partial(alignment_tables, context),
        "seams": partial(seam_tables, context),
        "prompts": partial(prompt_effect, context),
    }
    if edits is not None:
        tables |= editing_tables(edits, context.judge)
    facts = {
        **about,
        "evaluator_hash": context.judge.content_hash,
        "data": context.data or "none",
        "clips": "none" if edits is None else edits.held_out.source,
    }
    sources = partial(_sources, context, edits, about)
    benches = [dance_bench(context)]
    suite = Suite("performer", asdict(settings), benches, tables, facts, sources=sources)
    return run_suite(suite, Parts(folder), progress)


def dance_bench(context: DanceContext) -> Bench[BodySample]:
    """The songs, danced by the model, by its floors, and by real dancers where there is data."""
    few = context.settings.untrained
    hinted = context.generator.network.generation.constraints
    return Bench(
        "dances",
        "dances",
        lambda: context.reference,
        [
            Row("real", context.real, None if context.data is not None else 0, True, True),
            Row("generated", partial(context.danced, "generated")),
            Row("another song", context.another_song),
            Row("frozen pose", context.frozen_pose, limit=1, fixed=True),
            Row("path alone", context.path_alone, limit=1, fixed=True),
            Row(
                "beats not told",
                partial(context.danced, "beats not told"),
                limit=few if hinted else 0,
            ),
            Row(
                "other model",
                partial(context.danced, "other"),
                limit=0 if context.other is None else few,
            ),
            Row("untrained", partial(context.danced, "untrained"), limit=few),
        ],
        FAMILIES,
        write=write_body,
        worst=context.settings.worst,
    )


def write_body(sample: BodySample, row: int, path: Path) -> dict[str, Any]:
    """A dance; its title is the song and what was asked for."""
    dance = sample.dances[row]
    write_npz(dance.motion, path)
    return {"title": f"{dance.song}: {dance.motion.text}"}


def _sources(context: DanceContext, edits: EditContext | None, about: dict[str, Any]) -> Sources:
    named = {name: about[name] for name in ("model", "audio_model", "other") if about.get(name)}
    generator, singer = context.generator, context.singer.model
    return Sources(
        model=model_hashes(named),
        evaluator={"hash": context.judge.content_hash},
        data={
            "pairs": context.data or "",
            "songs": song_hashes(context.songs),
            "clips": "" if edits is None else edits.held_out.data.manifest_hash,
        },
        statistics=(generator.mean, generator.std, singer.mean, singer.std),
        sampling=asdict(context.sampling),
        device=str(generator.device),
    )
