"""The audio branch's families of metrics: beats on beats, phase, sanity of the trajectory.

Letters: N motions, T frames.
"""

from dataclasses import asdict

import numpy as np

from ..metrics.bands import MEASURES, UNITS
from ..metrics.kinetic import kinetic_columns, root_features, stacked
from ..metrics.rhythm import against_chance, motion_beats, song_phase
from ..metrics.sanity import SEVEN, SanityChecker
from ..motion.trajectory import MotionTrajectory
from .engine import MetricFamily, Value
from .families_text import KINETIC_WARNING, MIN_SAMPLE
from .report.tables import Column
from .samples import Trajectories

SCORES = (
    Column("motion_to_music", "motion→music", better="high"),
    Column("music_to_motion", "music→motion", better="high"),
    Column("f", "F", better="high"),
    Column("hits", "hits F", better="high"),
)
ABOVE = (
    Column("f_above_turned", "F above chance", better="high"),
    Column("f_above_half", "F above half a beat", better="high"),
)


def beats_of(trajectory: MotionTrajectory) -> np.ndarray:
    """Times of the motion's beats, seconds."""
    return motion_beats(trajectory.position, trajectory.fps).times


def _on_beats(sample: Trajectories, reference: Trajectories, seed: int) -> list[dict[str, float]]:
    rows = []
    pairs = zip(sample.dances, sample.each("beats", beats_of), strict=True)
    for index, (dance, beats) in enumerate(pairs):
        rng = np.random.default_rng([seed, 2, index])
        own, chance, off = against_chance(beats, dance.beats, dance.seconds, rng)
        above = {"f_above_turned": own.f - chance.f, "f_above_half": own.f - off.f}
        rows.append(asdict(own) | above | {"beat_distance": own.distance})
    return rows


BEAT_ALIGNMENT = MetricFamily(
    "beat alignment",
    (*SCORES, Column("beat_distance", "distance s", better="low"), *ABOVE),
    "motion→music: mean over motion beats of exp(-d²/2σ²), d seconds to the nearest beat of"
    " the song, σ = 0.05 s; music→motion: the same over the song's beats; F: harmonic mean."
    " hits F: matches one to one within 70 ms (mir_eval). distance: median. above chance: F"
    " minus that of the same beats turned round within the song by 16 random times; above"
    " half a beat: minus that against the song's off-beats, which tells 'on the beat' from"
    " 'twice as often'. A motion without beats scores 0. Published alignment scores have no"
    " such floor: random jitter reaches 0.26 to 0.49 in them; never put these beside those.",
    _on_beats,
)


def _phases(sample: Trajectories, reference: Trajectories, seed: int) -> list[dict[str, float]]:
    """Nothing where nobody knows the bars."""
    rows = []
    for dance in sample.dances:
        bars = dance.motion.phase_unwrapped
        rows.append(
            {}
            if dance.bars is None
            else song_phase(bars * dance.counted, bars, dance.bars, dance.meter, dance.beats)
        )
    return rows


BAR_PHASE = MetricFamily(
    "phase",
    (
        Column("beat", "beat |error|", better="low"),
        Column("beat_seconds", "in seconds", better="low"),
        Column("bar", "bar |error|", better="low"),
        Column("beat_offset", "beat offset"),
        Column("steady", "steadiness", better="high"),
    ),
    "Mean absolute circular error in cycles, between the first and the last true beat;"
    " guessing scores 0.25. beat offset: circular mean, ahead is positive; steadiness: length"
    " of the mean vector. Only songs whose bars are known: of real phrases"
    " nobody knows more than the tracker. The phase is the beat tracker's"
    " wherever it hears beats, so this says how good the tracker is, and nothing of the"
    " motion: a frozen pose counts as well.",
    _phases,
)

PATH = ("mean_speed", "path_rate", "turning", "path_jerk", "roughness")


def _sane(sample: Trajectories, reference: Trajectories, seed: int) -> dict[str, Value]:
    checked = sample.each("sanity", SanityChecker().check_all)
    return {
        "seven": np.array([float(all(r[k].passed for k in SEVEN)) for _, r in checked]),
        "suite": np.array([float(good) for good, _ in checked]),
        **{key: np.array(sample.each(key, MEASURES[key])) for key in PATH},
    }


TRAJECTORY_SANITY = MetricFamily(
    "sanity",
    (
        Column("seven", "seven checks", 2, "high", share=True),
        Column("suite", "suite", 2, "high", share=True),
        *(Column(key, f"{key.replace('_', ' ')} {UNITS[key]}", 2) for key in PATH),
    ),
    "Share of motions that pass the five checks of the specification, quaternion continuity"
    " and phase monotonicity (seven), and liveliness and roughness besides (suite). Motions as"
    " the sampler gives them; `evaluate-sanity` looks at post-processed ones too, and at the"
    " bands of training motions. Stillness passes the seven. The other figures are best near"
    " the real row.",
    _sane,
)


def _root_kinetics(sample: Trajectories, reference: Trajectories, seed: int) -> dict[str, float]:
    """Nothing for fewer than two motions on either side; no random choice."""
    if min(len(sample), len(reference)) < MIN_SAMPLE:
        return {}
    own, real, whole = (
        stacked([piece for pieces in each.each("root features", root_features) for piece in pieces])
        for each in (sample, reference, reference.whole or reference)
    )
    found = kinetic_columns(own, real, kinds=5, units_of=whole)
    return {f"{name}_root": value for name, value in found.items()}


ROOT_KINETICS = MetricFamily(
    "kinetic and geometric features of the root",
    (
        Column("fid_k_root", "FID_k, root, 5-d", 2, "low"),
        Column("fid_g_root", "FID_g, root, 12-d", 2, "low"),
        Column("div_k_root", "Div_k, root", 2),
        Column("div_g_root", "Div_g, root", 2),
        Column("amount_root", "motion amount, m/s", 3),
    ),
    "A reduced variant of our own of FID_k and FID_g, for a pelvis without limbs. *k*: its "
    "mean squared horizontal and vertical speed, mean acceleration, mean squared turning and "
    "tilting. *g*: the share of frames in which it is low, high, rising, sinking, fast, moving "
    "to each side, turning left or right, leaning. Each 4 s of a motion count as one, since "
    "a mean over a longer motion varies less. " + KINETIC_WARNING,
    _root_kinetics,
    distance=True,
)
FAMILIES: tuple[MetricFamily[Trajectories], ...] = (
    BEAT_ALIGNMENT, BAR_PHASE, TRAJECTORY_SANITY, ROOT_KINETICS,
)  # fmt: skip
