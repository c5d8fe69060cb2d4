"""The performer's families of metrics: beats of the body, the path it stands on, its feet.

Letters: N dances.
"""

from functools import partial

import numpy as np

from ..metrics.kinetic import amount
from ..metrics.physical import contact, physics
from ..metrics.rhythm import body_beats, landings, limb_beats, seen_from_pelvis
from ..metrics.stage import stage
from ..motion.motion import Motion
from ..pipelines.body import root_error
from .engine import MetricFamily
from .families import ABOVE, BODY_KINETICS, SCORES, beat_scores
from .samples import Bodies, Dance
from .tables import Column

MOMENTS = {"": body_beats, "limbs_": limb_beats, "landing_": landings}


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


BODY_RHYTHM = MetricFamily(
    "whole-body beats",
    (
        *SCORES,
        *ABOVE,
        Column("limbs_f", "limbs F", better="high"),
        Column("limbs_f_above_turned", "limbs above chance", better="high"),
        Column("landing_to_music", "landing→music", better="high"),
        Column("landing_above_turned", "landings above chance", better="high"),
        Column("landings", "landings/s", 2),
    ),
    "Motion beats are minima of the mean speed of all 22 joints (Li et al. 2021), scores as in"
    " the audio branch (σ = 0.05 s, both ways). A path that slows down on the beat carries"
    " whatever stands on it, a statue too: the row *path alone* has high F. *limbs F* sees the"
    " joints from the pelvis, where a carried statue has no beats: read both. *landing→music*:"
    " feet that come down from 4 cm, one way only, as nobody lands on every beat. *above"
    " chance*: minus the same beats turned round within the song by 16 random times. Who has"
    " no beats scores 0.",
    _moments,
)


def _path_figures(dance: Dance[Motion]) -> dict[str, float]:
    figures = {
        "joint_speed": amount(dance.motion.positions(), dance.motion.fps),
        "limb_speed": amount(seen_from_pelvis(dance.motion), dance.motion.fps),
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


ON_THE_PATH: MetricFamily[Bodies] = MetricFamily(
    "root against the trajectory",
    (
        Column("root_mean", "mean cm", 2, "low"),
        Column("root_max", "max cm", 2, "low"),
        Column("turn_mean", "mean °", 2, "low"),
        Column("turn_max", "max °", 2, "low"),
        Column("joint_speed", "joint speed m/s", 2),
        Column("limb_speed", "limb speed m/s", 2),
    ),
    "Distance of the pelvis and of its heading from the song's trajectory, frame by frame; rows"
    " without a trajectory have none. A statue that is carried is perfect here: *limb speed*,"
    " seen from the pelvis, says whether anything else moves.",
    lambda sample, *_: [_path_figures(dance) for dance in sample.dances],
)

GROUND = {
    "contact": "slide, contact cm/s",
    "support": "slide, support cm/s",
    "skating": "skating %",
    "sunk": "sunk cm",
    "floating": "floating cm",
    "jerk": "jerk m/s³",
}


def _ground(motion: Motion) -> dict[str, float]:
    """The figures of `GROUND`, and the roughness."""
    speeds, floor = physics(motion), contact(motion)
    return {
        "contact": speeds["contact_slide"],
        "support": speeds["support_slide"],
        "skating": floor["skating_frames"],
        "sunk": floor["sunk_depth"],
        "floating": floor["float_height"],
        "jerk": speeds["jerk"],
        "jerk_per_speed": floor["jerk_per_speed"],
    }


def _feet(sample: Bodies, reference: Bodies, seed: int) -> list[dict[str, float]]:
    rows = []
    for dance, after in zip(sample.dances, sample.each("feet", _ground), strict=True):
        before = after
        if dance.raw is not None:
            before = dance.memo.once("feet before", partial(_ground, dance.raw))
        rows.append(after | {f"{key}_before": before[key] for key in GROUND})
    return rows


FEET = MetricFamily(
    "feet",
    (
        *(
            Column(
                f"{key}{suffix}",
                f"{heading}, {when}",
                0 if key in ("jerk", "skating") else 2,
                "low",
            )
            for key, heading in GROUND.items()
            for suffix, when in (("_before", "before"), ("", "after"))
        ),
        Column("jerk_per_speed", "jerk / speed 1/s², after", 0),
    ),
    "Before and after the clean-up of the feet; rows that have none show the same twice."
    " *contact*: cm/s of the ball of a foot while a detector that asks for a slow foot says that"
    " it stands. *support*: the lower foot in every frame within 6 cm of its standing height,"
    " no condition on its speed, so neither a fast glide nor the clean-up's own idea of a"
    " contact escapes it. A frozen pose is perfect in all but *jerk / speed*, which it has not.",
    _feet,
)


ON_STAGE: MetricFamily[Bodies] = MetricFamily(
    "on stage",
    (
        Column("backward", "backward", 2, "low"),
        Column("radius", "radius m", 2),
        Column("net_way", "net way", 2, "low"),
        Column("turning", "turning °/s", 1),
        Column("poses", "poses", 1, "high"),
        Column("dimensions", "dimensions", 1, "high"),
        Column("hovering", "hovering /min", 2, "low"),
        Column("both_slide", "both slide", 3, "low"),
    ),
    "Is it a dance or a procession? *backward*: share of the way gone backward, a quarter where no"
    " direction is preferred. *radius*: the furthest that the pelvis gets from the middle of where"
    " it was. *net way*: distance from start to end over the way between. *poses*: how many differ"
    " by 12 cm a joint; it grows with the length. *dimensions*: participation ratio of the poses."
    " *hovering*: no joint near the floor for over 0.45 s. *both slide*: share of time in which"
    " both feet are near the floor and faster than 20 cm/s. A frozen pose is perfect in the last"
    " two, has one pose and no way.",
    lambda sample, *_: sample.each("stage", stage),
)
DANCE_FAMILIES: tuple[MetricFamily[Bodies], ...] = (
    BODY_RHYTHM, ON_STAGE, BODY_KINETICS, ON_THE_PATH, FEET,
)  # fmt: skip
