"""What is measured. A new metric is one file and one line here.

A family adds columns to every row; a row is held against the same families as all others; an extra
adds tables with rows of its own. Each is told what to draw on and gives plain figures back.
"""

from collections.abc import Callable

from .audio_context import AudioContext
from .audio_tables import (
    alignment_tables,
    phase_table,
    seam_tables,
    track_table,
)
from .dance_context import DanceContext
from .dance_sample import BodySample
from .dance_style import prompt_effect
from .dance_tables import alignment_tables as dance_alignment
from .dance_tables import seam_tables as dance_seams
from .engine import RowKind
from .families import DanceSample, MetricFamily, MotionSample
from .families_audio import BarPhase, BeatAlignment, RootKinetics, TrajectorySanity
from .families_motion import FAMILIES as TMR
from .families_motion import BodyKinetics, ContactFamily, Multimodality
from .families_performer import FAMILIES as PERFORMER
from .families_text import (
    Frechet,
    GuoRetrieval,
    Obedience,
    Plausibility,
    TravelErrors,
)
from .grids import Grid
from .text_context import Split, TextContext
from .text_tables import controllability, languages

TEXT_FAMILIES: tuple[MetricFamily[MotionSample], ...] = (
    GuoRetrieval(),
    *TMR,
    Multimodality(),
    Frechet(),
    BodyKinetics(),
    Plausibility(),
    ContactFamily(),
    TravelErrors(),
    Obedience(),
)
TEXT_ROWS: tuple[RowKind[Split, MotionSample], ...] = (  # and one a sampler
    RowKind("real", Split.real, fixed=True, real=True),
    RowKind("chance", Split.chance, fixed=True),
    RowKind("frozen pose", Split.frozen_pose, limit=lambda split: 1, fixed=True),
)
TEXT_EXTRAS: dict[str, Callable[[TextContext], list[Grid]]] = {
    "languages": languages,
    "controllability": controllability,
}
AUDIO_FAMILIES: tuple[MetricFamily[DanceSample], ...] = (
    BeatAlignment(),
    BarPhase(),
    TrajectorySanity(),
    RootKinetics(),
)
AUDIO_ROWS: tuple[RowKind[AudioContext, DanceSample], ...] = (
    RowKind(
        "real",
        AudioContext.real,
        when=lambda context: context.data is not None,
        fixed=True,
        real=True,
    ),
    RowKind("chance", AudioContext.chance),
    RowKind("frozen pose", AudioContext.frozen_pose, limit=lambda context: 1, fixed=True),
    RowKind("generated", AudioContext.generated),
    RowKind(
        "untrained",
        AudioContext.untrained,
        limit=lambda context: context.settings.untrained,
        when=lambda context: context.settings.untrained > 0,
    ),
)
AUDIO_EXTRAS: dict[str, Callable[[AudioContext], list[Grid]]] = {
    "phase": phase_table,
    "alignment": alignment_tables,
    "seams": seam_tables,
    "tracks": track_table,
}
DANCE_FAMILIES: tuple[MetricFamily[BodySample], ...] = PERFORMER
DANCE_ROWS: tuple[RowKind[DanceContext, BodySample], ...] = (
    RowKind(
        "real", DanceContext.real, when=lambda context: context.data is not None,
        fixed=True, real=True,
    ),
    RowKind("generated", lambda context, run: context.danced("generated", run)),
    RowKind("another song", DanceContext.another_song),
    RowKind("frozen pose", DanceContext.frozen_pose, limit=lambda context: 1, fixed=True),
    RowKind("path alone", DanceContext.path_alone, limit=lambda context: 1, fixed=True),
    RowKind(
        "beats not told",
        lambda context, run: context.danced("beats not told", run),
        limit=lambda context: context.settings.untrained,
        when=lambda context: context.settings.untrained > 0
        and context.generator.network.generation.constraints,
    ),
    RowKind(
        "other model",
        lambda context, run: context.danced("other", run),
        limit=lambda context: context.settings.untrained,
        when=lambda context: context.settings.untrained > 0 and context.other is not None,
    ),
    RowKind(
        "untrained",
        lambda context, run: context.danced("untrained", run),
        limit=lambda context: context.settings.untrained,
        when=lambda context: context.settings.untrained > 0,
    ),
)  # fmt: skip
DANCE_EXTRAS: dict[str, Callable[[DanceContext], list[Grid]]] = {
    "alignment": dance_alignment,
    "seams": dance_seams,
    "prompts": prompt_effect,
}
