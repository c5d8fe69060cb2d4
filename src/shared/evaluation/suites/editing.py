"""Editing: what is kept, how drawn paths are followed, how one action leads into the next.

Letters: T frames, K joints, N points.
"""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from ...metrics.kinetic import amount
from ...metrics.physical import jerk_per_speed, support_slide
from ...metrics.retrieval import rank_of
from ...metrics.rhythm import seen_from_pelvis
from ...metrics.seams import ACCELERATION, body_quantities, marked
from ...model.diffusion import Sampling
from ...model.evaluator import Evaluator
from ...model.generation.motion_generator import TextToMotion
from ...motion.motion import Motion
from ...motion.postprocess.stitching import joined, moved_to, place_of
from ...pipelines.edit import GROUPS, Given, edited, keep_ends, kept_error, redo
from ...pipelines.path import DrawnPath, along_path, distances_to_line, natural_gait, time_path
from ...pipelines.stream import Passage
from ...pipelines.text import SentenceGenerator
from ...pipelines.timeline import Timeline
from ..engine import Progress
from ..samples import Clips, HeldOut, held_still, real_clips, untrained
from ..stats import bootstrap_columns, bootstrap_mean
from ..tables import Cell, Grid, GridRow

WALK = "a person walks"
MIN_FRAMES, MAX_FRAMES = 90, 150  # of a clip that is edited
RADIUS = 1.5  # metres of the curved paths
NEAR = 6  # frames on either side of a border
TOP = 99  # percentile of real accelerations
HALF = 75  # frames of each action of a transition
AROUND = 15  # frames on either side of the change of text
ACTIONS = (
    "a person walks forward", "a person waves with the right hand", "a person dances",
    "a person walks backward", "a person squats", "a person runs", "a person bows",
    "a person claps",
)  # fmt: skip
Edit = tuple[Motion, Motion, Given]  # what was made of a clip, the clip, and what was to stay
Followed = tuple[Motion, np.ndarray]  # with where the pelvis was to be [T,2]
REDONE = {"left arm": "left-arm", "upper body": "upper-body", "a second": None}  # joint groups


@dataclass(frozen=True)
class EditSettings:
    """How much is measured; the report repeats it."""

    num: int = 24  # clips, and pairs of actions
    repeats: int = 3  # motions along each path
    max_real: int = 200  # clips that the real band is taken from
    untrained: int = 1  # 0 = no such rows
    seed: int = 0


@dataclass(frozen=True, eq=False)
class EditContext:
    """Real clips, models, pairs of actions, and the tables of editing."""

    generator: TextToMotion  # the text branch
    held_out: HeldOut  # clips that no training saw
    settings: EditSettings
    progress: Progress = lambda text: None  # told what begins

    @cached_property
    def clips(self) -> Clips:
        """Real clips to edit, of at least three seconds, spread over label groups.
        Raises UserError: there is none."""
        return self._real(self.settings.num, MIN_FRAMES)

    @cached_property
    def limit(self) -> float:
        """The 99th percentile of real frames' largest accelerations, m/s²."""
        real = self._real(self.settings.max_real, 16).motions
        return float(np.percentile(np.concatenate([accelerations(m) for m in real]), TOP))

    def _real(self, number: int, least: int) -> Clips:
        data, clips, seed = self.held_out.data, self.held_out.everything, self.settings.seed
        return real_clips(
            data, clips, num=number, min_frames=least, max_frames=MAX_FRAMES, seed=seed
        )

    @cached_property
    def generators(self) -> dict[str, TextToMotion]:
        """By the name of their row."""
        found = {"generated": self.generator}
        if self.settings.untrained:
            found["untrained"] = untrained(self.generator, self.settings.seed)
        return found

    @property
    def pairs(self) -> list[tuple[str, str]]:
        """Actions that follow each other: a walk round a table of all ordered pairs."""
        number, pairs = len(ACTIONS), []
        for index in range(self.settings.num):
            first, step = index % number, 1 + (index // number) % (number - 1)
            pairs.append((ACTIONS[first], ACTIONS[(first + step) % number]))
        return pairs

    def against(self, sizes: np.ndarray, name: str) -> dict[str, Cell]:
        """p99 of accelerations, the real one, and the share beyond it in percent."""
        if not len(sizes):
            return {"real": self.limit}
        return {
            name: float(np.percentile(sizes, TOP)),
            "real": self.limit,
            "beyond": 100 * float((sizes > self.limit).mean()),
        }

    # ---------------------------------------------------------------- tables

    def kept(self) -> list[Grid]:
        """A row a kind of edit, and floors."""
        rows = {}
        for who, generator in self.generators.items():
            for kind in ("between ends", *REDONE):
                self.progress(f"edits: {kind}, {who}")
                made = [
                    (edited(generator, text, given, Sampling(seed=seed)).motion, clip, given)
                    for clip, given, text, seed in self._tasks(kind)
                ]
                rows[f"{kind}: {who}"] = self._kept_row(made)
        tasks = [(clip, given) for clip, given, _, _ in self._tasks("a second")]
        back = [(clip, clip, given) for clip, given in tasks]
        others = [(_with_poses(c, tasks[k - 1][0], g), c, g) for k, (c, g) in enumerate(tasks)]
        rows["a second: clip handed back"] = self._kept_row(back)
        rows["a second: another clip's poses"] = self._kept_row(others)
        return [Grid.of("edits", rows, {"clips": len(tasks)})]

    def _tasks(self, kind: str) -> Iterator[tuple[Motion, Given, str, int]]:
        """Clip, what is kept of it, the text for the rest and a seed."""
        for index, clip in enumerate(self.clips.motions):
            frames, group = clip.num_frames, REDONE.get(kind)
            if kind == "between ends":
                given = keep_ends(clip, clip, 30, frames, rejoin=True)
            else:
                joints = None if group is None else set(GROUPS[group])
                given = redo(clip, frames // 2 - 15, frames // 2 + 15, joints)
            yield clip, given, self.clips.captions[index], self.settings.seed + index

    def _kept_row(self, made: Sequence[Edit]) -> GridRow:
        figures = [kept_figures(*each) for each in made]
        borders = []
        for motion, _, given in made:  # where something stops or begins to be known
            known = given.constraint.known[:, :-1].flatten(1).numpy()
            places = (1 + np.flatnonzero((known[1:] != known[:-1]).any(1))).tolist()
            near = marked(motion.num_frames, ((place, place) for place in places), NEAR)
            borders.append(accelerations(motion)[near])
        cells: dict[str, Cell] = {}
        for key in ("rotation", "root", "position"):
            sizes = [each[key] for each in figures if not np.isnan(each[key])]
            cells |= {key: max(sizes)} if sizes else {}
        cells["changed"] = bootstrap_mean([each["changed"] for each in figures])
        return GridRow(cells | self.against(np.concatenate(borders), "border"), len(made), 1)

    def paths(self) -> list[Grid]:
        """A row a shape and a maker."""
        rows, number = dict[str, GridRow](), self.settings.repeats
        seeds = np.random.SeedSequence(self.settings.seed).generate_state(number).tolist()
        for shape, drawn in drawn_paths().items():
            made = dict[str, list[Followed]]()
            for who, generator in self.generators.items():
                self.progress(f"paths: {shape}, {who}")
                made[who] = [_follow(generator, drawn, seed) for seed in seeds]
            own = made["generated"]
            made["frozen pose"] = [(held_still(motion), points) for motion, points in own]
            made["words alone"] = [
                (self.generator.generate([WALK], seconds=motion.seconds, seed=seed)[0], points)
                for seed, (motion, points) in enumerate(own)
            ]
            rows |= {f"{shape}: {who}": _path_row(each, drawn) for who, each in made.items()}
        return [Grid.of("paths", rows, {"num": number})]

    def transitions(self, judge: Evaluator) -> list[Grid]:
        """One action after the other."""
        seed, pairs, made = self.settings.seed, self.pairs, dict[str, list[Motion]]()
        timelines = [Timeline(tuple(Passage(text, HALF) for text in pair)) for pair in pairs]
        for who, generator in self.generators.items():
            self.progress(f"transitions: {who}")
            make = SentenceGenerator(generator).timeline
            made[who] = [make(each, Sampling(seed=seed + k)) for k, each in enumerate(timelines)]
        self.progress("transitions: hard cut")
        made["hard cut"] = []  # what a transition looks like that nobody made
        for k, pair in enumerate(pairs):
            first, second = self.generator.generate(pair, seconds=HALF / 30, seed=seed + k)
            second = moved_to(second, place_of(first, first.num_frames - 1))
            made["hard cut"].append(joined(first, second))
        made["frozen pose"] = [held_still(motion) for motion in made["generated"]]
        rows = {who: self._transition_row(motions, judge) for who, motions in made.items()}
        words = {"pairs": len(pairs), "HALF": HALF, "AROUND": AROUND, "actions": len(ACTIONS)}
        return [Grid.of("transitions", rows, words)]

    def _transition_row(self, motions: Sequence[Motion], judge: Evaluator) -> GridRow:
        text = judge.embed_text(ACTIONS).numpy()
        sizes = [accelerations(motion) for motion in motions]
        change = np.concatenate([values[HALF - AROUND : HALF + AROUND] for values in sizes])
        rest = [np.delete(each, slice(HALF - AROUND, HALF + AROUND)) for each in sizes]
        cells = self.against(change, "near")
        cells["elsewhere"] = float(np.percentile(np.concatenate(rest), TOP))
        for which, key in enumerate(("before", "after")):
            hits = []
            for motion, pair in zip(motions, self.pairs, strict=True):
                seen = judge.embed_windows(motion.frames(which * HALF, (which + 1) * HALF))
                distances = np.linalg.norm(seen[:, None] - text[None], axis=-1)  # W P
                hits.append((rank_of(distances, ACTIONS.index(pair[which])) < 1).mean())
            cells[key] = bootstrap_mean(hits)
        return GridRow(cells, len(motions), 1)


def accelerations(motion: Motion) -> np.ndarray:
    """Of each frame [T] the largest acceleration of a joint in m/s²; 0 at the ends."""
    return body_quantities(motion)[ACCELERATION]


def kept_figures(motion: Motion, clip: Motion, given: Given) -> dict[str, float]:
    """How an edit compares with the clip that it was made of; both of T frames."""
    errors = kept_error(motion, given.constraint)
    whole = given.constraint.known.flatten(1).all(1).numpy()  # T
    apart = np.linalg.norm(from_pelvis(motion) - from_pelvis(clip), axis=-1)  # T K
    return {
        "rotation": errors["rotation"],  # largest difference of a kept entry of the 6D rotations
        "root": errors["root"],  # the same of the root row: m/s, rad/s, and m of height
        # largest distance in mm of a joint in frames that are kept whole, place apart in what
        # comes after the edit; mean distance in cm of a joint from the clip in edited frames
        "position": 1000 * float(apart[whole].max()) if whole.any() else float("nan"),
        "changed": 100 * float(apart[~whole].mean()) if (~whole).any() else float("nan"),
    }


def from_pelvis(motion: Motion) -> np.ndarray:
    """Joint positions [T,21,3] in the pelvis's frame, and its height as one joint more."""
    height = np.zeros((motion.num_frames, 1, 3))
    height[:, 0, 1] = motion.root_position[:, 1]
    return np.concatenate((seen_from_pelvis(motion), height), axis=1)


def _with_poses(clip: Motion, other: Motion, given: Given) -> Motion:
    """A clip with another one's poses in the frames that are to be made anew."""
    where = np.flatnonzero(~given.constraint.known.flatten(1).all(1).numpy())
    pose = clip.quaternions.copy()
    pose[where, 1:] = other.quaternions[where % other.num_frames, 1:]
    return replace(clip, quaternions=pose)


def drawn_paths() -> dict[str, DrawnPath]:
    """A straight line, a curve, and a figure of eight, in metres."""
    arc = np.pi * np.linspace(0, 1, 61)
    eight = np.stack((np.sin(4 * arc) / 2, np.sin(2 * arc)), axis=1)
    return {
        "line": DrawnPath(np.array([[0.0, 0.0], [0.0, 4.0]])),
        "curve": DrawnPath(RADIUS * np.stack((1 - np.cos(arc), np.sin(arc)), axis=1)),
        "figure of eight": DrawnPath(RADIUS * eight),
    }


def _follow(generator: TextToMotion, drawn: DrawnPath, seed: int) -> Followed:
    settings = Sampling(seed=seed % 2**31)
    passage = Passage(WALK, 1)
    motion = along_path(generator, Timeline((passage,)), drawn, settings).motion
    speed, facing, *_ = natural_gait(generator, passage, settings)
    path = time_path(drawn, fps=generator.card.fps, speed=speed, facing=facing)
    return motion, path.points


def _path_row(made: Sequence[Followed], drawn: DrawnPath) -> GridRow:
    rows = []
    for motion, points in made:
        ground = motion.root_position[:, [0, 2]].astype(np.float64)
        frames = min(len(ground), len(points))
        apart = np.linalg.norm(ground[:frames] - points[:frames], axis=1)
        joints, fps = motion.positions().astype(np.float64), motion.fps
        rows.append(
            {
                "mean": 100 * float(apart.mean()),
                "max": 100 * float(apart.max()),
                "line": 100 * float(distances_to_line(ground, drawn.points).mean()),
                "limb_speed": amount(seen_from_pelvis(motion), fps),
                "support": support_slide(joints, fps),
                "rough": jerk_per_speed(joints, fps),
            }
        )
    furthest = max(row["max"] for row in rows)
    return GridRow({**bootstrap_columns(rows), "max": furthest}, len(made), 1)
