"""The text branch's families of metrics of bodies: feet, kinetics, variety, TMR's retrieval."""

from collections.abc import Callable
from dataclasses import dataclass, fields

import numpy as np
from scipy.spatial.distance import pdist

from ..metrics.frechet import within_prompts
from ..metrics.kinetic import AXES, Features, body_features, kinetic_columns, stacked
from ..metrics.physical import Contact, contact
from ..metrics.retrieval import (
    BATCH,
    POOL,
    PROTOCOLS,
    RECALL_AT,
    SUBSET,
    THRESHOLD,
    BothWays,
    recall_in_pools,
    recall_of_dissimilar,
    text_similarity,
)
from .report.tables import Column
from .samples import MotionSample

KINETIC_WARNING = (
    "Never beside published figures: other joints, frame rate and data, mended formulas, and "
    "features in units of the real motions' deviation. A Fréchet distance grows as N shrinks, so "
    "rows of the same N alone compare, and the real row says what no difference looks like. "
    "*Div* rises with jitter and with any nonsense that differs; it is good where it is near the "
    "real row, and only together with its FID. *motion amount* is the mean speed of the joints: a "
    "frozen pose has 0."
)


@dataclass(frozen=True)
class BodyKinetics:
    """FID_k, FID_g, Div_k, Div_g of whole bodies."""

    name: str = "kinetic and geometric features"
    distance: bool = True
    columns: tuple[Column, ...] = (
        Column("fid_k", "FID_k, 66-d", 2, "low"),
        Column("fid_g", "FID_g, 32-d", 2, "low"),
        Column("fid_k_axes", f"FID_k, {AXES} axes", 2, "low"),
        Column("fid_g_axes", f"FID_g, {AXES} axes", 2, "low"),
        Column("div_k", "Div_k", 2),
        Column("div_g", "Div_g", 2),
        Column("amount", "motion amount, m/s", 3),
    )
    definition: str = (
        "*k*: mean squared horizontal and vertical speed and mean acceleration of each of 22 "
        "joints (Onuma et al. 2008); *g*: the share of frames in which each of 32 relations holds "
        "(Müller et al. 2005); as in AIST++ (Li et al. 2021). FID: Fréchet distance to the real "
        "motions, also along the 16 directions in which these vary most: the one to read below "
        "a thousand motions. Div: mean distance over all pairs. " + KINETIC_WARNING
    )

    def compute(
        self, sample: MotionSample, reference: MotionSample, *, seed: int
    ) -> dict[str, float]:
        """Nothing for fewer than two motions on either side; no random choice."""
        if min(len(sample), len(reference)) < 2:
            return {}
        whole = body_sample(reference.whole or reference)
        real = body_sample(reference)
        return kinetic_columns(body_sample(sample), real, kinds=3, units_of=whole)


def body_sample(sample: MotionSample) -> Features:
    """`body_features` of each motion, computed once a motion."""
    return stacked(sample.each("body features", body_features))


@dataclass(frozen=True)
class ContactFamily:
    """Feet, floor and roughness as a table, one value a motion."""

    name: str = "feet and floor"
    distance: bool = False
    columns: tuple[Column, ...] = (
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
    )
    definition: str = (
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
        "the motion amount. None may stand beside a published figure."
    )

    def compute(
        self, sample: MotionSample, reference: MotionSample, *, seed: int
    ) -> dict[str, np.ndarray]:
        """Each figure of each motion [N]; no random choice."""
        found = sample.each("contact", contact)
        return {
            field.name: np.array([getattr(one, field.name) for one in found])
            for field in fields(Contact)
        }


@dataclass(frozen=True)
class Multimodality:
    """Different answers to one prompt, as a table."""

    name: str = "multimodality"
    distance: bool = False
    columns: tuple[Column, ...] = (
        Column("multimodality", "MultiModality"),
        Column("multimodality_share", "of all pairs"),
        Column("multimodality_prompts", "prompts", 0),
    )
    definition: str = (
        "Guo et al. 2020: mean distance of the judge's embeddings of motions that have one "
        "caption, over the captions that come twice or more (all their pairs, not ten random "
        "ones). *of all pairs*: over the mean distance of any two motions; 1 says that the caption "
        "decides nothing, which is what the chance row has, and 0 that each caption has one "
        "answer. Best near the real row, where one caption has several clips. Nonsense is varied "
        "too, and so are frozen poses of different clips: read it beside R@k. Where captions "
        "seldom repeat it rests on the few *prompts* counted. The judge is ours: no published "
        "figure stands beside it."
    )

    def compute(
        self, sample: MotionSample, reference: MotionSample, *, seed: int
    ) -> dict[str, float]:
        """Nothing where no caption comes twice; no random choice."""
        found = within_prompts(sample.motion, sample.clips.captions)
        if not found.num_prompts:
            return {}
        every = float(pdist(sample.motion.astype(np.float64)).mean())
        return {
            "multimodality": found.distance,
            "multimodality_share": found.distance / every if every else float("nan"),
            "multimodality_prompts": float(found.num_prompts),
        }


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


@dataclass(frozen=True)
class TmrFamily:
    """One of the four protocols as a table."""

    protocol: str
    distance: bool = False

    @property
    def name(self) -> str:
        return f"retrieval: {self.protocol}"

    @property
    def columns(self) -> tuple[Column, ...]:
        found = []
        for way, arrow in (("t2m", "text→motion"), ("m2t", "motion→text")):
            key = f"tmr_{self.protocol}_{way}"
            found += [Column(f"{key}_r{k}", f"{arrow} R@{k}", 3, "high") for k in RECALL_AT]
            found.append(Column(f"{key}_medr", f"{arrow} MedR", 1, "low"))
        found.append(Column(f"tmr_{self.protocol}_pairs", "candidates", 0))
        return tuple(found)

    @property
    def definition(self) -> str:
        return (
            f"TMR (Petrovich et al. 2023), {_SAYS[self.protocol]}. Cosine similarity; R@k is the "
            "share of queries with a right answer among the first k, MedR the median rank from 1; "
            "ties are averaged over all orders. The judge is ours, so no published figure may "
            "stand beside it. It says whether a motion fits its text better than other texts, not "
            "whether it looks right."
        )

    def compute(
        self, sample: MotionSample, reference: MotionSample, *, seed: int
    ) -> dict[str, float]:
        """R@k and MedR of the sample; nothing where it is smaller than a batch of protocol (d)."""
        if self.protocol == "batches" and len(sample) < BATCH:
            return {}

        def alike() -> np.ndarray:
            clips = sample.clips
            return sample.memo.once(
                "text similarity", lambda: text_similarity(clips.captions, clips.groups)
            )

        text, motion, pool = sample.text, sample.motion, min(POOL, len(sample))
        protocols: dict[str, Callable[[], BothWays]] = {
            "all": lambda: recall_in_pools(text, motion, pool, seed=seed),
            "threshold": lambda: recall_in_pools(text, motion, pool, alike(), seed=seed),
            "dissimilar": lambda: recall_of_dissimilar(text, motion, alike(), seed=seed),
            "batches": lambda: recall_in_pools(text, motion, seed=seed),
        }
        found = protocols[self.protocol]()
        ways = (found.text_to_motion, found.motion_to_text)
        values = [value for way in ways for value in (*way.recall, way.median_rank)]
        keys = [column.key for column in self.columns]
        return dict(zip(keys, [*values, float(found.num_pairs)], strict=True))


FAMILIES = tuple(TmrFamily(protocol) for protocol in PROTOCOLS)
