"""The families of metrics: the figures behind each table that tables.toml describes.

Letters: N motions or dances.
"""

import math
from collections.abc import Callable, Sequence
from dataclasses import asdict
from functools import cache, partial
from itertools import chain
from typing import Any

import numpy as np
import torch
from torch import Tensor

from ..memory.figures import FigureMemory
from ..metrics import frechet, kinetic, retrieval, rhythm
from ..metrics.measurements import measure
from ..metrics.physical import contact, physics, travel, travel_error
from ..metrics.retrieval import BATCH, POOL, RECALL_AT, SUBSET, THRESHOLD
from ..metrics.sanity import MEASURES, SEVEN, SanityChecker
from ..metrics.stage import stage
from ..motion.features import HEIGHT, ROOT_ROW, encode_features, heading_joints
from ..motion.motion import Motion
from ..motion.rotations import rotation_6d_to_matrix
from ..motion.skeleton import MIRROR, NUM_JOINTS
from ..motion.trajectory import MotionTrajectory
from ..pipelines.body import root_error
from .actions import check
from .engine import MetricFamily, Value
from .samples import Bodies, Dance, MotionSample, Trajectories
from .tables import WORDS, Column, described

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
    return retrieval.guo_retrieval(sample.text, sample.motion, equal_by, seed=seed)


def _guo(sample: MotionSample, reference: MotionSample, seed: int) -> dict[str, Value]:
    """R-precision needs a batch, and more groups than answers that are looked at."""
    found: dict[str, Value] = {}
    if len(sample) >= BATCH and len(set(sample.clips.groups)) > max(retrieval.TOP):
        at = r_precision(sample, seed).mean(1).tolist()
        found = {f"r_at_{k}": value for k, value in zip(retrieval.TOP, at, strict=True)}
    apart = sample.text.astype(np.float64) - sample.motion.astype(np.float64)
    found["matching_distance"] = np.linalg.norm(apart, axis=1)
    if len(sample) >= MIN_SAMPLE:
        found["diversity"] = frechet.diversity(sample.motion, seed=seed)
    return found


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
            alike = sample.memo.once("text similarity", lambda: retrieval.text_similarity(*said))
        if protocol == "dissimilar" and alike is not None:
            rows = retrieval.dissimilar_subset(alike, seed=seed)
            found, pool = retrieval.recalls(text[rows], motion[rows]), len(rows)
        else:
            found = retrieval.recall_in_pools(text, motion, pool, alike, seed=seed)
        keys = [column.key for column in columns]
        return dict(zip(keys, [*found.ravel().tolist(), float(pool)], strict=True))

    numbers = {"POOL": POOL, "THRESHOLD": THRESHOLD, "SUBSET": SUBSET, "BATCH": BATCH}
    says = " ".join(WORDS["tmr"]["protocols"][protocol].split()).format(**numbers)
    definition = described("tmr", protocol=says)["note"]
    return MetricFamily(f"retrieval: {protocol}", tuple(columns), definition, figures)


def _multimodality(sample: MotionSample, reference: MotionSample, seed: int) -> dict[str, float]:
    """Nothing where no caption comes twice; no random choice."""
    distance, num_prompts = frechet.within_prompts(sample.motion, sample.clips.captions)
    if not num_prompts:
        return {}
    every = kinetic.mean_pairwise(sample.motion.astype(np.float64))
    return {
        "multimodality": distance,
        "multimodality_share": distance / every if every else float("nan"),
        "multimodality_prompts": float(num_prompts),
    }


def _frechet(sample: MotionSample, reference: MotionSample, seed: int) -> dict[str, Value]:
    axes = min(JOINT_AXES, reference.motion.shape[1])
    real = reference.text, reference.motion
    joint = reference.memo.once("joint FD", lambda: frechet.JointFrechet(*real, num_axes=axes))
    found: dict[str, Value] = {
        "frechet": frechet.frechet_distance(sample.motion, reference.motion),
        "frechet_joint": joint(sample.text, sample.motion),
    }
    sides = (sample.motion, sample.clips.tags), (reference.motion, reference.clips.tags)
    groups = frechet.group_frechet(*sides[0], *sides[1])
    if groups is not None:
        found["frechet_by_tag"], found["frechet_by_wrong_tag"] = groups[:2]
        found["num_tags"] = float(groups[2])
    return found


def _kinetics(
    name: str, pieces: Callable[[Any], Sequence[kinetic.Features]], kinds: int, suffix: str = ""
) -> MetricFamily[Any]:
    """Features of the pieces of each motion, `kinds` of them kinetic; no random choice."""

    def figures(sample: Any, reference: Any, seed: int) -> dict[str, float]:
        own, real, whole = (
            kinetic.stacked([*chain.from_iterable(each.each("kinetic features", pieces))])
            for each in (sample, reference, reference.whole or reference)
        )
        found = kinetic.kinetic_columns(own, real, kinds=kinds, units_of=whole)
        return {key + suffix: value for key, value in found.items()}

    warning = described("kinetic warning")["note"]
    return MetricFamily.of(name, figures, warning=warning, distance=True, least=MIN_SAMPLE)


def _travel(sample: MotionSample, reference: MotionSample, seed: int) -> dict[str, np.ndarray]:
    """NaN where a motion has no reference."""
    own, real = sample.each("travel", travel), reference.each("travel", travel)
    theirs = [real[row] if row >= 0 else np.full(3, np.nan) for row in sample.source]
    return {f"{name}_error": each for name, each in travel_error(own, theirs).items()}


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


TMR = tuple(_tmr(protocol) for protocol in retrieval.PROTOCOLS)
MULTIMODALITY = MetricFamily.of("multimodality", _multimodality)
BODY_KINETICS = _kinetics(
    "kinetic and geometric features", lambda motion: [kinetic.body_features(motion)], kinds=3
)
# Physical plausibility is two tables, this and CONTACT; of dances FEET.
PHYSICS: MetricFamily[MotionSample] = MetricFamily.of(
    "physics", lambda sample, *_: sample.each("physics", physics)
)
CONTACT: MetricFamily[MotionSample] = MetricFamily.of(
    "feet and floor", lambda sample, *_: sample.each("contact", contact)
)
TRAVEL = MetricFamily.of("travel", _travel)
OBEDIENCE = MetricFamily.of("obedience", _obeyed)
TEXT_FAMILIES: tuple[MetricFamily[MotionSample], ...] = (
    MetricFamily.of("retrieval", _guo),
    *TMR,
    MULTIMODALITY,
    MetricFamily.of("Fréchet distances", _frechet, distance=True, least=MIN_SAMPLE),
    BODY_KINETICS,
    PHYSICS,
    CONTACT,
    TRAVEL,
    OBEDIENCE,
)


# ---------------------------------------------------------------- the audio branch's


def beats_of(trajectory: MotionTrajectory) -> np.ndarray:
    """Times of the motion's beats, seconds."""
    return rhythm.motion_beats(trajectory.position, trajectory.fps).times


def beat_scores(times: np.ndarray, dance: Dance[Any], rng: np.random.Generator) -> dict[str, float]:
    """What moments of a dance, seconds [N], score on its music, and above chance."""
    own, chance, off = rhythm.against_chance(times, dance.beats, dance.seconds, rng)
    return asdict(own) | {
        "beat_distance": own.distance,
        "f_above_turned": own.f - chance.f,
        "f_above_half": own.f - off.f,
        "above_turned": own.motion_to_music - chance.motion_to_music,
    }


def _on_beats(sample: Trajectories, reference: Trajectories, seed: int) -> list[dict[str, float]]:
    return [
        beat_scores(beats, dance, np.random.default_rng([seed, 2, index]))
        for index, (dance, beats) in enumerate(sample.beside("beats", beats_of))
    ]


def _phase(dance: Dance[MotionTrajectory]) -> dict[str, float]:
    """Nothing where nobody knows the bars."""
    if dance.bars is None:
        return {}
    bars = dance.motion.phase_unwrapped
    return rhythm.song_phase(bars * dance.counted, bars, dance.bars, dance.meter, dance.beats)


def _sane(sample: Trajectories, reference: Trajectories, seed: int) -> dict[str, Value]:
    checked = sample.each("sanity", SanityChecker().check_all)
    path = [column.key for column in TRAJECTORY_SANITY.columns if column.key in MEASURES]
    return {
        "seven": np.array([float(all(r[k].passed for k in SEVEN)) for _, r in checked]),
        "suite": np.array([float(good) for good, _ in checked]),
        **{key: np.array(sample.each(key, MEASURES[key])) for key in path},
    }


BEAT_ALIGNMENT = MetricFamily.of("beat alignment", _on_beats)
TRAJECTORY_SANITY: MetricFamily[Trajectories] = MetricFamily.of("sanity", _sane)
ROOT_KINETICS = _kinetics(
    "kinetic and geometric features of the root", kinetic.root_features, kinds=5, suffix="_root"
)
AUDIO_FAMILIES: tuple[MetricFamily[Trajectories], ...] = (
    BEAT_ALIGNMENT,
    MetricFamily.of("phase", lambda sample, *_: [_phase(dance) for dance in sample.dances]),
    TRAJECTORY_SANITY,
    ROOT_KINETICS,
)


# ---------------------------------------------------------------- the performer's

MOMENTS = {"": rhythm.body_beats, "limbs_": rhythm.limb_beats, "landing_": rhythm.landings}


def _moments(sample: Bodies, reference: Bodies, seed: int) -> list[dict[str, float]]:
    moments = {key: sample.each(key + "beats", find) for key, find in MOMENTS.items()}
    rows: list[dict[str, float]] = []
    for index, dance in enumerate(sample.dances):
        if not len(dance.beats):  # of a captured dance nobody knows the music
            rows.append({})
            continue
        rng = np.random.default_rng([seed, 5, index])
        figures = {"landings": len(moments["landing_"][index]) / dance.seconds}
        for key, times in moments.items():
            scores = beat_scores(times[index], dance, rng)
            figures |= {key + name: value for name, value in scores.items()}
        figures["landing_to_music"] = figures["landing_motion_to_music"]
        rows.append(figures)
    return rows


def _path_figures(dance: Dance[Motion]) -> dict[str, float]:
    figures = {
        "joint_speed": kinetic.amount(dance.motion.positions(), dance.motion.fps),
        "limb_speed": kinetic.amount(rhythm.seen_from_pelvis(dance.motion), dance.motion.fps),
    }
    if dance.path is None:
        return figures
    error = root_error(dance.motion, dance.path)
    return figures | {
        "root_mean": 100 * error.mean_metres,
        "root_max": 100 * error.max_metres,
        "turn_mean": error.mean_degrees,
        "turn_max": error.max_degrees,
    }


GROUND = {
    "contact": "contact_slide", "support": "support_slide", "skating": "skating_frames",
    "sunk": "sunk_depth", "floating": "float_height", "jerk": "jerk",
    "jerk_per_speed": "jerk_per_speed",
}  # fmt: skip


def _ground(motion: Motion) -> dict[str, float]:
    figures = physics(motion) | contact(motion)
    return {name: figures[key] for name, key in GROUND.items()}


def _feet(sample: Bodies, reference: Bodies, seed: int) -> list[dict[str, float]]:
    rows = []
    for dance, after in sample.beside("feet", _ground):
        before = after
        if dance.raw is not None:
            before = dance.memo.once("feet before", partial(_ground, dance.raw))
        rows.append(after | {f"{key}_before": figure for key, figure in before.items()})
    return rows


LOOKED_UP = 10  # frames between those that are looked for in the memory


def _on_stage(motion: Motion) -> dict[str, float]:
    return stage(motion) | {"nearest": 100 * nearest_pose(motion)}


def nearest_pose(motion: Motion) -> float:
    """How far its joints are on average from those of the nearest pose of the shipped figures or
    their mirror images, metres; root mean square over the joints. A copy has 0."""
    features = encode_features(motion)[::LOOKED_UP]
    rotations = rotation_6d_to_matrix(features[:, :NUM_JOINTS])
    poses = heading_joints(rotations, features[:, ROOT_ROW, HEIGHT]).flatten(1)
    apart = torch.cdist(poses, _remembered()).amin(1)
    return float(apart.mean()) / math.sqrt(NUM_JOINTS)


@cache
def _remembered() -> Tensor:
    """Poses of the shipped figures and their mirror images [2F,3K]."""
    poses = torch.from_numpy(FigureMemory.open().poses).float()
    mirrored = poses[:, list(MIRROR)] * torch.tensor([-1.0, 1.0, 1.0])
    return torch.cat((poses, mirrored)).flatten(1)


BODY_RHYTHM = MetricFamily.of("whole-body beats", _moments)
ON_THE_PATH: MetricFamily[Bodies] = MetricFamily.of(
    "root against the trajectory", lambda sample, *_: [_path_figures(d) for d in sample.dances]
)
FEET = MetricFamily.of("feet", _feet)
DANCE_FAMILIES: tuple[MetricFamily[Bodies], ...] = (
    BODY_RHYTHM,
    MetricFamily.of("on stage", lambda sample, *_: sample.each("stage", _on_stage)),
    BODY_KINETICS,
    ON_THE_PATH,
    FEET,
)
