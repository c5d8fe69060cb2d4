"""Tables of the text branch with rows of their own: languages, and controllability by task."""

from functools import partial
from typing import Any

import numpy as np

from ..data.captions.book import CaptionBook
from ..errors import UserError
from ..metrics.retrieval import BATCH, normalised_score
from .clips import Sampler
from .control_table import FLOORS, control_table
from .families import Column
from .families_text import r_precision
from .grids import Cell, Grid, GridRow, plain
from .intervals import bootstrap_mean
from .parts import Part
from .text_context import UNTRAINED, TextContext

SHORT = {"templates": "tmpl", "paraphrases": "para"}
CONTROL_NOTE = (
    "Success by forward kinematics: prompts of the training templates (tmpl) and paraphrases that"
    " no training caption repeats (para). real: test clips with these labels; chance: motions made"
    " for the other tasks; still: the first pose held; untrained: the same network with fresh"
    " weights, asked the first language's templates. ± is Wilson's 95%."
)


def languages(context: TextContext) -> list[Grid]:
    """R-precision at 3 by language on seen combinations: real, chance, generated, untrained."""
    settings = context.settings
    if not settings.language_samples:
        return []
    rows = {}
    for language in settings.languages:
        found = context.parts.once(f"languages.{language}", partial(_language, context, language))
        if found["cells"]:
            rows[language] = GridRow(found["cells"], found["num"], 1)
    columns = tuple(Column(key, key) for key in ("real", "chance", *_made_by(context)))
    columns += (Column("normalised", "normalised"),)
    note = (
        "One replication; ± is 95% over prompts. normalised: (generated - chance) / (real -"
        f" chance). Seed {settings.seed}; real and chance over all real clips."
    )
    title = "R@3 by language (seen combinations)"
    return [Grid("languages", title, columns, rows, note, "language")] if rows else []


def _made_by(context: TextContext) -> dict[str, Sampler]:
    made_by = {"generated": context.sampler}
    return made_by if context.untrained is None else made_by | {UNTRAINED: context.untrained}


def _language(context: TextContext, language: str) -> Part:
    """The cells of one language; none where the data has too few captions in it."""
    settings = context.settings
    num = min(settings.language_samples, settings.num_samples)
    try:
        real = context.real(context.held_out.records["seen"], language)
    except UserError:
        return {"cells": None}  # the data has no captions in this language
    if min(len(real), num) < BATCH:
        return {"cells": None}
    context.progress(f"languages: {num} motions in {language}")
    asked = real.rows([row % len(real) for row in range(num)])
    order = np.random.default_rng(settings.seed).permutation(len(real)).tolist()
    samples = {"real": real, "chance": real.reordered(order)}
    for name, sampler in _made_by(context).items():
        motions = sampler(asked.clips.captions, asked.clips.num_frames, settings.seed)
        samples[name] = context.made(asked, motions)
    at_3 = {
        name: bootstrap_mean(r_precision(sample, settings.seed).hits[2].tolist())
        for name, sample in samples.items()
    }
    score = normalised_score(*(at_3[k].value for k in ("generated", "chance", "real")))
    return {"cells": plain({**at_3, "normalised": score}), "num": num}


def controllability(context: TextContext) -> list[Grid]:
    """Success rates task by task and language by language."""
    settings = context.settings
    if not settings.control_seeds:
        return []
    everything = [record for records in context.held_out.records.values() for record in records]
    found = control_table(
        context.sampler,
        CaptionBook.load(None),
        context.clips(everything, settings.language),
        languages=settings.languages,
        num_seeds=settings.control_seeds,
        seed=settings.seed,
        untrained=context.untrained,
        progress=context.progress,
        once=context.parts.once,
    )
    return [control_grid(found)]


def control_grid(found: dict[str, Any]) -> Grid:
    """What `control_table` found, as a table."""
    kinds = [(language, word) for language in found["languages"] for word in found["wordings"]]
    columns = [Column(f"{k} {word}", f"{k} {SHORT[word]}", 2, "high") for k, word in kinds]
    columns += [Column(floor, floor, 2) for floor in FLOORS]

    def cells(rates: dict[str, Any], floors: dict[str, Any]) -> dict[str, Cell]:
        made = {f"{k} {word}": rates.get(k, {}).get(word) for k, word in kinds}
        return plain({**made, **{floor: floors[floor] for floor in FLOORS}})

    rows = {name: GridRow(cells(task["generated"], task)) for name, task in found["tasks"].items()}
    rows["mean"] = GridRow(cells(found["means"], found["means"]))
    title = f"controllability ({found['num_seeds']} motions a cell)"
    return Grid("controllability", title, tuple(columns), rows, CONTROL_NOTE, "task")
