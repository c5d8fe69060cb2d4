"""The text and audio branches' families of metrics: what each table is made of.

Letters: N motions.
"""

from dataclasses import asdict
from typing import Any

import numpy as np
from scipy.spatial.distance import pdist

from ..metrics.frechet import (
    JointFrechet,
    diversity,
    frechet_distance,
    group_frechet,
    within_prompts,
)
from ..metrics.kinetic import AXES, body_features, kinetic_columns, root_features, stacked
from ..metrics.measurements import measure
from ..metrics.physical import contact, physics, travel, travel_error
from ..metrics.retrieval import (
    BATCH,
    POOL,
    PROTOCOLS,
    RECALL_AT,
    SUBSET,
    THRESHOLD,
    TOP,
    dissimilar_subset,
    guo_retrieval,
    recall_in_pools,
    recalls,
    text_similarity,
)
from ..metrics.rhythm import (
    against_chance,
    motion_beats,
    song_phase,
)
from ..metrics.sanity import MEASURES, SEVEN, UNITS, SanityChecker
from ..motion.trajectory import MotionTrajectory
from .actions import check
from .engine import MetricFamily, Value
from .samples import Bodies, Dance, MotionSample, Trajectories
from .tables import Column

JOINT_AXES = 16
MIN_SAMPLE = 2  # motions that have a covariance
KINDS = {
    **dict.fromkeys(("forward", "backward", "left", "right", "forward-jump"), "direction"),
    **dict.fromkeys(("turn-left", "turn-right"), "turn"),
    **dict.fromkeys(("left-hand", "right-hand", "both-hands"), "hand"),
    **{name: name for name in ("count", "speed", "angle")},
}


def r_precision(sample: MotionSample, seed: int) -> np.ndarray:
    """`guo_retrieval` where clips of one label group, or with one caption, are all right."""
    equal_by = [sample.clips.groups, sample.clips.captions]
    return guo_retrieval(sample.text, sample.motion, equal_by, seed=seed)


def _guo(sample: MotionSample, reference: MotionSample, seed: int) -> dict[str, Value]:
    """R-precision needs a batch."""
    found: dict[str, Value] = {}
    if len(sample) >= BATCH:
        at = r_precision(sample, seed).mean(1).tolist()
        found = {f"r_at_{k}": value for k, value in zip(TOP, at, strict=True)}
    apart = sample.text.astype(np.float64) - sample.motion.astype(np.float64)
    found["matching_distance"] = np.linalg.norm(apart, axis=1)
    if len(sample) >= MIN_SAMPLE:
        found["diversity"] = diversity(sample.motion, seed=seed)
    return found


GUO = MetricFamily(
    "retrieval",
    (
        Column("r_at_1", "R@1", better="high"),
        Column("r_at_2", "R@2", better="high"),
        Column("r_at_3", "R@3", better="high"),
        Column("matching_distance", "MM-Dist", better="low"),
        Column("diversity", "Diversity"),
    ),
    "Guo et al. 2022 (§6): each text ranks the motions of a random batch of 32 by Euclidean"
    " distance; a motion of the same label group, or with the same caption, is a hit; equal"
    " distances count in every order (hypergeometric). MM-Dist: mean distance of a text to its"
    " motion. Diversity: mean distance of 300 random pairs; close to the real row is best."
    " Chance is above 3/32 where groups repeat: it is measured, not assumed.",
    _guo,
)


def _frechet(sample: MotionSample, reference: MotionSample, seed: int) -> dict[str, Value]:
    axes = min(JOINT_AXES, reference.motion.shape[1])
    joint = reference.memo.once(
        "joint FD", lambda: JointFrechet(reference.text, reference.motion, num_axes=axes)
    )
    found: dict[str, Value] = {
        "frechet": frechet_distance(sample.motion, reference.motion),
        "frechet_joint": joint(sample.text, sample.motion),
    }
    groups = group_frechet(sample.motion, sample.clips.tags, reference.motion, reference.clips.tags)
    if groups is not None:
        found["frechet_by_tag"], found["frechet_by_wrong_tag"] = groups[:2]
        found["num_tags"] = float(groups[2])
    return found


FRECHET = MetricFamily(
    "Fréchet distances",
    (
        Column("frechet", "FD", better="low"),
        Column("frechet_joint", "joint FD", better="low"),
        Column("frechet_by_tag", "FD by tag", better="low"),
        Column("frechet_by_wrong_tag", "by wrong tag", better="real"),
        Column("num_tags", "tags", 0),
    ),
    "Fréchet distance of the judge's motion embeddings to the real ones (32 dimensions,"
    " float64). It cannot see labels: shuffled ones leave it at 0, so its chance row says"
    " nothing. joint FD: of (text, motion) pairs, each side in 16 principal axes of the real"
    " ones; its chance row is the distance under shuffled labels. by tag: mean over actions"
    " of 24 clips or more, 8 axes. The real row lies between two halves of the real clips"
    " (half the N, which raises it). All depend on N: quote them from 1,000 motions on, and"
    " never beside a figure of another judge or another N.",
    _frechet,
    distance=True,
    least=MIN_SAMPLE,
)

# Physical plausibility is two tables, this and CONTACT; of dances `GROUND` in families_dance.py.
PHYSICS: MetricFamily[MotionSample] = MetricFamily(
    "physics",
    (
        Column("contact_slide", "slide, contact cm/s", 2, better="low"),
        Column("support_slide", "slide, support cm/s", 2, better="low"),
        Column("penetration", "sunk cm", 2, better="low"),
        Column("jerk", "jerk m/s³", 0),
        Column("hand_jerk", "wrist jerk m/s³", 0),
        Column("speed", "speed m/s", 2),
    ),
    "contact: speed of the ball of a foot over frames that the contact detector accepts, which"
    " asks for a slow foot itself, so that a fast glide escapes it; support: of the lower foot"
    " in every frame within 6 cm of its standing height. sunk: lowest foot below its standing"
    " height. jerk: third differences of joint positions. A frozen pose is best in slide, sunk and"
    " jerk: read them beside speed and the real row.",
    lambda sample, *_: sample.each("physics", physics),
)


def _travel(sample: MotionSample, reference: MotionSample, seed: int) -> dict[str, np.ndarray]:
    """NaN where a motion has no reference."""
    own, real = sample.each("travel", travel), reference.each("travel", travel)
    known = np.flatnonzero(sample.source >= 0)
    errors = travel_error([own[i] for i in known], [real[sample.source[i]] for i in known])
    found = {}
    for name, values in errors.items():
        column = found[f"{name}_error"] = np.full(len(sample), np.nan)
        column[known] = values
    return found


TRAVEL = MetricFamily(
    "travel",
    (
        Column("speed_error", "speed error m/s", 2, better="low"),
        Column("direction_error", "direction error °", 0, better="low"),
        Column("turn_error", "turn error °", 0, better="low"),
    ),
    "Absolute differences to a real clip of the same caption; the real row compares real clips"
    " of one label group, which is as good as it gets. A motion that stands where its"
    " reference travels has a direction error of 90°.",
    _travel,
)


def _obeyed(sample: MotionSample, reference: MotionSample, seed: int) -> list[dict[str, float]]:
    """By kind of check; what the labels do not ask is left out."""
    measured = sample.each("measure", measure)
    rows = []
    for labels, motion in zip(sample.clips.labels, measured, strict=True):
        answers = check(labels, motion)
        kinds = {"all": list(answers.values())} if answers else {}
        for name, passed in answers.items():
            kinds.setdefault(KINDS.get(name, "action"), []).append(passed)
        rows.append({f"obeys_{kind}": float(all(passes)) for kind, passes in kinds.items()})
    return rows


OBEDIENCE = MetricFamily(
    "obedience",
    tuple(
        Column(f"obeys_{kind}", kind, 2, "high", share=True)
        for kind in ("direction", "turn", "hand", "action", "speed", "count", "angle", "all")
    ),
    "Share of motions that pass the check their labels call for; speed and count are exact"
    " classes, so real motion does not reach 1 either. Styles ask for nothing: no check"
    " covers them.",
    _obeyed,
)

KINETIC_WARNING = (
    "Never beside published figures: other joints, frame rate and data, mended formulas, and "
    "features in units of the real motions' deviation. A Fréchet distance grows as N shrinks, so "
    "rows of the same N alone compare, and the real row says what no difference looks like. "
    "*Div* rises with jitter and with any nonsense that differs; it is good where it is near the "
    "real row, and only together with its FID. *motion amount* is the mean speed of the joints: a "
    "frozen pose has 0."
)


def _body_kinetics(
    sample: MotionSample | Bodies, reference: MotionSample | Bodies, seed: int
) -> dict[str, float]:
    """No random choice."""
    own, real, whole = (
        stacked(each.each("body features", body_features))
        for each in (sample, reference, reference.whole or reference)
    )
    return kinetic_columns(own, real, kinds=3, units_of=whole)


BODY_KINETICS: MetricFamily[Any] = MetricFamily(
    "kinetic and geometric features",
    (
        Column("fid_k", "FID_k, 66-d", 2, "low"),
        Column("fid_g", "FID_g, 32-d", 2, "low"),
        Column("fid_k_axes", f"FID_k, {AXES} axes", 2, "low"),
        Column("fid_g_axes", f"FID_g, {AXES} axes", 2, "low"),
        Column("div_k", "Div_k", 2),
        Column("div_g", "Div_g", 2),
        Column("amount", "motion amount, m/s", 3),
    ),
    "*k*: mean squared horizontal and vertical speed and mean acceleration of each of 22 "
    "joints (Onuma et al. 2008); *g*: the share of frames in which each of 32 relations holds "
    "(Müller et al. 2005); as in AIST++ (Li et al. 2021). FID: Fréchet distance to the real "
    "motions, also along the 16 directions in which these vary most: the one to read below "
    "a thousand motions. Div: mean distance over all pairs. " + KINETIC_WARNING,
    _body_kinetics,
    distance=True,
    least=MIN_SAMPLE,
)

CONTACT: MetricFamily[MotionSample] = MetricFamily(
    "feet and floor",
    (
        Column("claimed_slide", "slide, claimed contact cm/s", 2, "low"),
        Column("claimed_frames", "contact claimed %", 1),
        Column("skating_frames", "skating %", 1, "low"),
        Column("slide_per_metre", "slide cm/m", 2, "low"),
        Column("sunk_depth", "sunk, any joint cm", 2, "low"),
        Column("sunk_frames", "sunk %", 1, "low"),
        Column("float_height", "floating cm", 2, "low"),
        Column("floating_frames", "floating %", 1, "low"),
        Column("flying_frames", "flying %", 1),
        Column("jerk_per_speed", "jerk / speed 1/s²", 0),
        Column("pfc", "PFC", 3),
    ),
    "*slide, claimed contact*: speed of a foot while the motion's own contact channel says "
    "that it stands; who never claims one escapes, hence *contact claimed*. *skating*: of the "
    "frames with the lower foot within 6 cm of its standing height, the share in which it "
    "moves faster than 10 cm/s. *slide cm/m*: what it slides for each metre that the pelvis "
    "travels; a gliding statue has 100, a motion that travels less than half a metre none. "
    "*sunk*: the lowest joint below the standing height of a foot, and the frames deeper than "
    "1 cm. *floating*: no joint within 2 cm of that height, and the body does not fall at half "
    "of g or more, else it is *flying*; a body on its back floats a little. *jerk / speed*: "
    "roughness for the motion there is; the frozen pose has none. *PFC* (EDGE, Tseng et al. "
    "2023) is not a number for a still body nor for a steady glide, depends on the length of "
    "the clip, and improves with one rough frame: it is here because it is asked for. A frozen "
    "pose is perfect in *skating*, *sunk* and *floating*: read them beside *slide cm/m* and "
    "the motion amount. None may stand beside a published figure.",
    lambda sample, *_: sample.each("contact", contact),
)


def _multimodality(sample: MotionSample, reference: MotionSample, seed: int) -> dict[str, float]:
    """Nothing where no caption comes twice; no random choice."""
    distance, num_prompts = within_prompts(sample.motion, sample.clips.captions)
    if not num_prompts:
        return {}
    every = float(pdist(sample.motion.astype(np.float64)).mean())
    return {
        "multimodality": distance,
        "multimodality_share": distance / every if every else float("nan"),
        "multimodality_prompts": float(num_prompts),
    }


MULTIMODALITY = MetricFamily(
    "multimodality",
    (
        Column("multimodality", "MultiModality"),
        Column("multimodality_share", "of all pairs"),
        Column("multimodality_prompts", "prompts", 0),
    ),
    "Guo et al. 2020: mean distance of the judge's embeddings of motions that have one "
    "caption, over the captions that come twice or more (all their pairs, not ten random "
    "ones). *of all pairs*: over the mean distance of any two motions; 1 says that the caption "
    "decides nothing, which is what the chance row has, and 0 that each caption has one "
    "answer. Best near the real row, where one caption has several clips. Nonsense is varied "
    "too, and so are frozen poses of different clips: read it beside R@k. Where captions "
    "seldom repeat it rests on the few *prompts* counted. The judge is ours: no published "
    "figure stands beside it.",
    _multimodality,
)

_SAYS = {
    "all": f"protocol (a): only the own pair is right. In random pools of {POOL} instead of the "
    "whole sample, because recall falls with the number of candidates and rows differ in it. "
    "Captions that repeat cap it below 1, for real motion too",
    "threshold": f"protocol (b): texts with (1 + cosine) / 2 > {THRESHOLD} of their word n-grams, "
    "or of one label group, count as right. Pools as in (a); chance is higher here",
    "dissimilar": f"protocol (c): among {SUBSET} texts far from each other, only the own pair; "
    "fewer where the captions say fewer things (*candidates*). Which of equals it takes is drawn "
    "anew in each replication",
    "batches": f"protocol (d): random batches of {BATCH}, only the own pair is right",
}


def _tmr(protocol: str) -> MetricFamily[MotionSample]:
    """One of the four protocols as a table."""
    columns = []
    for way, arrow in (("t2m", "text→motion"), ("m2t", "motion→text")):
        key = f"tmr_{protocol}_{way}"
        columns += [Column(f"{key}_r{k}", f"{arrow} R@{k}", 3, "high") for k in RECALL_AT]
        columns.append(Column(f"{key}_medr", f"{arrow} MedR", 1, "low"))
    columns.append(Column(f"tmr_{protocol}_pairs", "candidates", 0))

    def figures(sample: MotionSample, reference: MotionSample, seed: int) -> dict[str, float]:
        """R@k and MedR of the sample; nothing where it is smaller than a batch of protocol (d)."""
        text, motion, alike = sample.text, sample.motion, None
        pool = BATCH if protocol == "batches" else min(POOL, len(sample))
        if len(sample) < pool:
            return {}
        if protocol in ("threshold", "dissimilar"):
            said = sample.clips.captions, sample.clips.groups
            alike = sample.memo.once("text similarity", lambda: text_similarity(*said))
        if protocol == "dissimilar" and alike is not None:
            rows = dissimilar_subset(alike, seed=seed)
            found, pool = recalls(text[rows], motion[rows]), len(rows)
        else:
            found = recall_in_pools(text, motion, pool, alike, seed=seed)
        keys = [column.key for column in columns]
        return dict(zip(keys, [*found.ravel().tolist(), float(pool)], strict=True))

    definition = (
        f"TMR (Petrovich et al. 2023), {_SAYS[protocol]}. Cosine similarity; R@k is the "
        "share of queries with a right answer among the first k, MedR the median rank from 1; "
        "ties are averaged over all orders. The judge is ours, so no published figure may "
        "stand beside it. It says whether a motion fits its text better than other texts, not "
        "whether it looks right."
    )
    return MetricFamily(f"retrieval: {protocol}", tuple(columns), definition, figures)


TMR = tuple(_tmr(protocol) for protocol in PROTOCOLS)
TEXT_FAMILIES: tuple[MetricFamily[MotionSample], ...] = (
    GUO, *TMR, MULTIMODALITY, FRECHET, BODY_KINETICS, PHYSICS, CONTACT, TRAVEL, OBEDIENCE,
)  # fmt: skip


# ---------------------------------------------------------------- the audio branch's

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


def beat_scores(times: np.ndarray, dance: Dance[Any], rng: np.random.Generator) -> dict[str, float]:
    """What moments of a dance, seconds [N], score on its music, and above chance."""
    own, chance, off = against_chance(times, dance.beats, dance.seconds, rng)
    return asdict(own) | {
        "beat_distance": own.distance,
        "f_above_turned": own.f - chance.f,
        "f_above_half": own.f - off.f,
        "above_turned": own.motion_to_music - chance.motion_to_music,
    }


def _on_beats(sample: Trajectories, reference: Trajectories, seed: int) -> list[dict[str, float]]:
    pairs = zip(sample.dances, sample.each("beats", beats_of), strict=True)
    return [
        beat_scores(beats, dance, np.random.default_rng([seed, 2, index]))
        for index, (dance, beats) in enumerate(pairs)
    ]


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
    """No random choice."""
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
    least=MIN_SAMPLE,
)
AUDIO_FAMILIES: tuple[MetricFamily[Trajectories], ...] = (
    BEAT_ALIGNMENT, BAR_PHASE, TRAJECTORY_SANITY, ROOT_KINETICS,
)  # fmt: skip
