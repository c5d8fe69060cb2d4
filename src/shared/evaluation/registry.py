"""What is measured. A new metric is one file and one line here.

A family adds columns to every row (real, chance, frozen, untrained, generated) of every split; an
extra adds tables with rows of its own. Both are told what to draw on and give plain figures back.
"""

from collections.abc import Callable

from src.shared.evaluation.audio_context import AudioContext
from src.shared.evaluation.audio_tables import (
    alignment_tables,
    phase_table,
    seam_tables,
    track_table,
)
from src.shared.evaluation.families import DanceSample, MetricFamily, MotionSample
from src.shared.evaluation.families_audio import BarPhase, BeatAlignment, TrajectorySanity
from src.shared.evaluation.families_text import (
    Frechet,
    GuoRetrieval,
    Obedience,
    Plausibility,
    TravelErrors,
)
from src.shared.evaluation.grids import Grid
from src.shared.evaluation.metrics_contact import ContactFamily
from src.shared.evaluation.metrics_kinetic import BodyKinetics, RootKinetics
from src.shared.evaluation.metrics_spread import Multimodality
from src.shared.evaluation.metrics_tmr import FAMILIES as TMR
from src.shared.evaluation.text_context import TextContext
from src.shared.evaluation.text_tables import controllability, languages

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
AUDIO_EXTRAS: dict[str, Callable[[AudioContext], list[Grid]]] = {
    "phase": phase_table,
    "alignment": alignment_tables,
    "seams": seam_tables,
    "tracks": track_table,
}
