"""Does the memory help? With, without and with randomly retrieved memory (the RAG++ harness).

Every arm is measured on the same phrases and songs, which no training saw, with the same noise;
what it gains over "without" is resampled over songs, pair by pair. Sizes of the memory and numbers
of hits are told apart by the denoising error alone, the finest and cheapest of the figures.

Letters: N phrases or songs, S songs.
"""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import asdict, dataclass
from typing import Any

import numpy as np

from ..errors import UserError
from ..memory.build import Space
from ..memory.index import MemoryConfig, MemoryIndex
from ..model.audio.audio_motion_model import AudioMotionModel
from ..pipelines.song_sampler import SongSampling
from .audio_songs import held_out_songs
from .memory_arms import RANDOM, WITH, WITHOUT, Arm, Asker, arms, variations
from .memory_figures import (
    Curves,
    Denoising,
    Figures,
    Setting,
    Songs,
    Values,
    held_back,
)
from .report.tables import Column, Grid, GridRow, plain
from .stats import MIN_PAIRS, bootstrap_mean, paired_bootstrap

Progress = Callable[[str], None]
CHANCE = "real, of another song"
NOTE = (
    "± is half a 95% interval: rows by bootstrap over songs; differences by paired bootstrap over"
    " songs (10,000 resamples). * the interval excludes 0. random: the answer to a random"
    " question, with the confidence of the right one. Every cell is one test: of twenty that"
    " differ in nothing, one seems to. An untrained memory part changes nothing: its row"
    " is without."
)


@dataclass(frozen=True)
class MemorySettings:
    """How much is measured; the report repeats it."""

    num_phrases: int = 120
    splits: tuple[str, ...] = ("test", "val")
    draws: int = 2  # of noise, a phrase and level
    num_songs: int = 24
    song_seconds: float = 12.0
    shares: tuple[float, ...] = (0.1, 0.3)
    top_ks: tuple[int, ...] = (1, 32)
    tell_meter: bool = True
    seed: int = 0


def evaluate_memory(
    model: AudioMotionModel,
    index: MemoryIndex,
    space: Space,
    *,
    data: str,
    config: MemoryConfig,
    settings: MemorySettings,
    sampling: Mapping[str, Any] | None = None,
    about: Mapping[str, Any] | None = None,
    progress: Progress = lambda text: None,
) -> dict[str, Any]:
    """The whole report as plain data: about, settings, tables, verdict.

    Args:
        model: of train_memory.
        index, space: the memory and the space of its keys.
        data: folder or bucket of pairs with the splits to measure on.
        config: how the memory is asked.
        settings: how much is measured.
        sampling: what `SongSampling` takes, the seed aside.
        about: what to repeat in the report.
        progress: told what begins.

    Raises:
        UserError: the data cannot be used.
    """
    sampled = SongSampling(seed=settings.seed, **(sampling or {})).resolved(model.config)
    setting = Setting(model, space, Asker(index, config, settings.seed), sampled)
    items = held_back(
        data, settings.splits, model.config.window, settings.num_phrases, settings.seed
    )
    if len(items) < MIN_PAIRS:
        raise UserError(
            f"{data}: {len(items)} held-back phrases of {model.config.window} frames are too few"
            "; prepare more data"
        )
    pieces = held_out_songs(
        settings.num_songs, settings.song_seconds, settings.seed, tell_meter=settings.tell_meter
    )
    main, others = arms(), variations(settings.shares, settings.top_ks)
    tables: list[Grid] = []
    verdict: dict[str, Any] = {}
    for figures, asked in (
        (Denoising(setting, items, settings.draws), [*main, *others]),
        (Curves(setting, items), main),
        (Songs(setting, list(pieces)), main),
    ):
        measured = {}
        for arm in asked:
            progress(f"{figures.name}: {arm.name}")
            measured[arm.name] = over_songs(figures.measure(arm), figures.clusters)
        if isinstance(figures, Curves):
            measured[CHANCE] = over_songs(figures.chance(), figures.clusters)
        tables += [rows_table(figures, measured), gains_table(figures, measured, asked)]
        verdict |= judged(figures, measured)
    facts = {
        **(about or {}),
        "memory": f"{len(index)} phrases of {len(index.songs)} songs",
        "phrases": f"{len(items)} of {len({item.record.song for item in items})} songs",
        "asked": plain(config.model_dump()),
    }
    return {
        "about": facts,
        "settings": plain(asdict(settings)),
        "tables": [table.as_dict() for table in tables],
        "verdict": verdict,
    }


def over_songs(values: Values, clusters: Sequence[str]) -> Values:
    """Figures [N] -> the mean of each song [S]: phrases of a song are not independent."""
    names = sorted(set(clusters))
    rows = [[n for n, name in enumerate(clusters) if name == song] for song in names]
    return {key: np.array([each[row].mean() for row in rows]) for key, each in values.items()}


def rows_table(figures: Figures, measured: Mapping[str, Values]) -> Grid:
    """Every arm's figures."""
    rows = {
        name: GridRow({key: bootstrap_mean(each.tolist()).as_dict() for key, each in found.items()})
        for name, found in measured.items()
    }
    return Grid(figures.name, figures.name, figures.columns, rows, NOTE, head="memory")


def gains_table(figures: Figures, measured: Mapping[str, Values], asked: Sequence[Arm]) -> Grid:
    """Every arm less "without", and with less random."""
    pairs = {f"{arm.name} − {WITHOUT}": (arm.name, WITHOUT) for arm in asked if arm.asks}
    pairs |= {f"{WITH} − {RANDOM}": (WITH, RANDOM)}
    rows = {
        name: GridRow({c.key: difference(measured, *pair, c.key) for c in figures.columns})
        for name, pair in pairs.items()
    }
    title = f"{figures.name}: differences"
    return Grid(title, title, figures.columns, rows, head="memory")


def difference(measured: Mapping[str, Values], arm: str, base: str, key: str) -> dict[str, Any]:
    """Arm less base over songs; `apart`: its interval excludes 0."""
    found = paired_bootstrap(measured[base][key], measured[arm][key]).as_dict()
    return found | {"apart": bool(found["low"] > 0 or found["high"] < 0)}


def judged(figures: Figures, measured: Mapping[str, Values]) -> dict[str, Any]:
    """For each column with a good side: is the memory better than none, and than a random one?"""
    found: dict[str, Any] = {}
    for column in figures.columns:
        if column.better == "real":
            continue
        said = {
            base: word(difference(measured, WITH, base, column.key), column)
            for base in (WITHOUT, RANDOM)
        }
        found[f"{figures.name}: {column.heading}"] = said
    return found


def word(found: Mapping[str, Any], column: Column) -> str:
    """better, worse, or no difference."""
    if not found["apart"]:
        return "no difference"
    return "better" if (found["value"] > 0) == (column.better == "high") else "worse"
