"""The audio branch's families of metrics: beats on beats, phase, sanity of the trajectory.

Letters: N motions, T frames.
"""

from collections.abc import Mapping
from dataclasses import asdict, dataclass

import numpy as np

from ..metrics.bands import MEASURES, UNITS
from ..metrics.kinetic import Features, kinetic_columns, root_features, stacked
from ..metrics.rhythm import against_chance, motion_beats, song_phase
from ..metrics.sanity import SEVEN, SanityChecker
from ..motion.trajectory import MotionTrajectory
from .engine import Value
from .families_text import KINETIC_WARNING
from .report.tables import Column
from .samples import Dance, DanceSample

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


class BeatAlignment:
    """Do motion beats fall on music beats, and music beats on motion beats?"""

    name = "beat alignment"
    distance = False
    columns = (
        *SCORES,
        Column("beat_distance", "distance s", better="low"),
        *ABOVE,
    )
    definition = (
        "motion→music: mean over motion beats of exp(-d²/2σ²), d seconds to the nearest beat of"
        " the song, σ = 0.05 s; music→motion: the same over the song's beats; F: harmonic mean."
        " hits F: matches one to one within 70 ms (mir_eval). distance: median. above chance: F"
        " minus that of the same beats turned round within the song by 16 random times; above"
        " half a beat: minus that against the song's off-beats, which tells 'on the beat' from"
        " 'twice as often'. A motion without beats scores 0. Published alignment scores have no"
        " such floor: random jitter reaches 0.26 to 0.49 in them; never put these beside those."
    )

    def compute(
        self, sample: DanceSample, reference: DanceSample, *, seed: int
    ) -> Mapping[str, Value]:
        """See `MetricFamily`."""
        found: dict[str, list[float]] = {column.key: [] for column in self.columns}
        for index, (dance, beats) in enumerate(
            zip(sample.dances, sample.each("beats", beats_of), strict=True)
        ):
            for key, value in self._song(dance, beats, [seed, 2, index]).items():
                found[key].append(value)
        return {key: np.array(values) for key, values in found.items()}

    @staticmethod
    def _song(dance: Dance, beats: np.ndarray, seed: list[int]) -> dict[str, float]:
        rng = np.random.default_rng(seed)
        own, chance, off = against_chance(beats, dance.beats, dance.seconds, rng)
        figures = asdict(own)
        figures["beat_distance"] = figures.pop("distance")
        return figures | {"f_above_turned": own.f - chance.f, "f_above_half": own.f - off.f}


class BarPhase:
    """Does the trajectory's phase count the song's bars?"""

    name = "phase"
    distance = False
    columns = (
        Column("beat", "beat |error|", better="low"),
        Column("beat_seconds", "in seconds", better="low"),
        Column("bar", "bar |error|", better="low"),
        Column("beat_offset", "beat offset"),
        Column("steady", "steadiness", better="high"),
    )
    definition = (
        "Mean absolute circular error in cycles, between the first and the last true beat;"
        " guessing scores 0.25. beat offset: circular mean, ahead is positive; steadiness: length"
        " of the mean vector. Only songs whose bars are known: of real phrases"
        " nobody knows more than the tracker. The phase is the beat tracker's"
        " wherever it hears beats, so this says how good the tracker is, and nothing of the"
        " motion: a frozen pose counts as well."
    )

    def compute(
        self, sample: DanceSample, reference: DanceSample, *, seed: int
    ) -> Mapping[str, Value]:
        """See `MetricFamily`; NaN where nobody knows the bars."""
        found = {column.key: np.full(len(sample), np.nan) for column in self.columns}
        for index, dance in enumerate(sample.dances):
            if dance.bars is None:
                continue
            bars = dance.trajectory.phase_unwrapped
            errors = song_phase(bars * dance.counted, bars, dance.bars, dance.meter, dance.beats)
            for key, value in errors.items():
                found[key][index] = value
        return found


class TrajectorySanity:
    """Does the trajectory hold together, and does it move as people do?"""

    name = "sanity"
    distance = False
    columns = (
        Column("seven", "seven checks", 2, "high", share=True),
        Column("suite", "suite", 2, "high", share=True),
        *(
            Column(key, f"{key.replace('_', ' ')} {UNITS[key]}", 2)
            for key in ("mean_speed", "path_rate", "turning", "path_jerk", "roughness")
        ),
    )
    definition = (
        "Share of motions that pass the five checks of the specification, quaternion continuity"
        " and phase monotonicity (seven), and liveliness and roughness besides (suite). Motions as"
        " the sampler gives them; `evaluate-sanity` looks at post-processed ones too, and at the"
        " bands of training motions. Stillness passes the seven. The other figures are best near"
        " the real row."
    )

    def compute(
        self, sample: DanceSample, reference: DanceSample, *, seed: int
    ) -> Mapping[str, Value]:
        """See `MetricFamily`."""
        checked = sample.each("sanity", SanityChecker().check_all)
        found: dict[str, Value] = {
            "seven": np.array([float(all(r[k].passed for k in SEVEN)) for _, r in checked]),
            "suite": np.array([float(good) for good, _ in checked]),
        }
        for column in self.columns[2:]:
            found[column.key] = np.array(sample.each(column.key, MEASURES[column.key]))
        return found


def root_sample(sample: DanceSample) -> Features:
    """`root_features` of each trajectory, computed once a trajectory, one after the other."""
    return stacked(
        [piece for each in sample.each("root features", root_features) for piece in each]
    )


@dataclass(frozen=True)
class RootKinetics:
    """The reduced variant for trajectories, under keys of its own."""

    name: str = "kinetic and geometric features of the root"
    distance: bool = True
    columns: tuple[Column, ...] = (
        Column("fid_k_root", "FID_k, root, 5-d", 2, "low"),
        Column("fid_g_root", "FID_g, root, 12-d", 2, "low"),
        Column("div_k_root", "Div_k, root", 2),
        Column("div_g_root", "Div_g, root", 2),
        Column("amount_root", "motion amount, m/s", 3),
    )
    definition: str = (
        "A reduced variant of our own of FID_k and FID_g, for a pelvis without limbs. *k*: its "
        "mean squared horizontal and vertical speed, mean acceleration, mean squared turning and "
        "tilting. *g*: the share of frames in which it is low, high, rising, sinking, fast, moving "
        "to each side, turning left or right, leaning. Each 4 s of a motion count as one, since "
        "a mean over a longer motion varies less. " + KINETIC_WARNING
    )

    def compute(
        self, sample: DanceSample, reference: DanceSample, *, seed: int
    ) -> dict[str, float]:
        """Nothing for fewer than two motions on either side; no random choice."""
        if min(len(sample), len(reference)) < 2:
            return {}
        whole = root_sample(reference.whole or reference)
        real = root_sample(reference)
        found = kinetic_columns(root_sample(sample), real, kinds=5, units_of=whole)
        return {f"{name}_root": value for name, value in found.items()}
