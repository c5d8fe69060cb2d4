"""Tables of editing: what is kept, how paths are followed, how one action leads into the next."""

from collections.abc import Iterator, Sequence
from dataclasses import asdict, replace
from typing import Any

import numpy as np

from ..metrics.physical import jerk_per_speed, support_slide
from ..metrics.rhythm import seen_from_pelvis
from ..model.diffusion.samplers import Sampling
from ..model.generation.motion_generator import TextToMotion
from ..motion.motion import Motion
from ..pipelines.edit import GROUPS, Given, edited, keep_ends, redo
from ..pipelines.path import DrawnPath, along_path, distances_to_line, natural_gait, time_path
from ..pipelines.stream import Passage
from ..pipelines.timeline import Timeline, by_timeline
from .dance_context import held_still
from .dance_style import embed, rank_of
from .editing_context import ACTIONS, EditContext, drawn_paths, seeds
from .editing_figures import (
    accelerations,
    borders_of,
    hard_cut,
    kept_figures,
    near,
)
from .evaluator import Evaluator
from .report.tables import Column, Grid, GridRow
from .stats import bootstrap_mean

TOP = 99  # percentile of real accelerations
HALF = 75  # frames of each action of a transition
AROUND = 15  # frames on either side of the change of text
KEPT = (
    Column("rotation", "kept rotations, max", 6, "low"),
    Column("root", "kept root, max", 6, "low"),
    Column("position", "kept joints, max mm", 3, "low"),
    Column("changed", "changed cm"),
    Column("border", "p99 at borders m/s²", 0), Column("real", "real p99", 0),
    Column("beyond", "beyond it %", 2, "low"),
)  # fmt: skip
PATH = (
    Column("mean", "from the path, mean cm", 2, "low"), Column("max", "max cm", 2, "low"),
    Column("line", "from the line, mean cm", 2, "low"), Column("limb_speed", "limb speed m/s", 2),
    Column("support", "slide, support cm/s", 1, "low"), Column("rough", "jerk / speed 1/s²", 0),
)  # fmt: skip
TRANSITION = (
    Column("near", "p99 at the change m/s²", 0), Column("elsewhere", "p99 elsewhere", 0),
    Column("real", "real p99", 0), Column("beyond", "beyond it at the change %", 2, "low"),
    Column("before", "R@1 before", better="high"), Column("after", "R@1 after", better="high"),
)  # fmt: skip
NOTES = {
    "kept": "Real clips with a part made anew. *kept*: the largest difference over all clips of"
    " what was to stay (6D entries; m/s, rad/s and m; mm seen from the pelvis in frames kept"
    " whole). *changed*: mean distance of a joint from the clip in edited frames; who hands the"
    " clip back has 0. *borders*: the largest acceleration of a joint within 6 frames of what is"
    " kept; *real p99* of whole real clips. *another clip's poses*: cut in.",
    "path": "Where the pelvis is to be in each frame, and the nearest point of the line as drawn."
    " The path is pinned, so whatever is carried keeps to it, an untrained body too: *limb speed*,"
    " *slide* and *jerk / speed* tell them apart. *words alone*: the prompt without the path, from"
    " its beginning.",
    "transitions": f"Two actions of {HALF} frames, one text after the other. *at the change*: the"
    f" largest acceleration of a joint within {AROUND} frames of it. *R@1*: the separate evaluator"
    f" finds the action asked for among {len(ACTIONS)}, in the frames of each. *hard cut*: the same"
    " two actions made apart and put one after the other.",
}
REDONE = {
    "left arm": ("left-arm",),
    "upper body": ("upper-body",),
    "a second": None,
}


# ---------------------------------------------------------------- what is kept


def kept_table(context: EditContext) -> Grid:
    """A row a kind of edit, and floors."""
    limit = real_limit(context.real)
    rows = {}
    for who, generator in context.generators.items():
        for kind in ("between ends", *REDONE):
            context.progress(f"edits: {kind}, {who}")
            made = [(_edit(generator, kind, *each), *each) for each in _tasks(context, kind)]
            rows[f"{kind}: {who}"] = _kept_row(
                [(motion, clip, given) for motion, clip, given, _, _ in made], limit
            )
    tasks = list(_tasks(context, "a second"))
    clips = [task[0] for task in tasks]
    rows["a second: clip handed back"] = _kept_row([(c, c, g) for c, g, _, _ in tasks], limit)
    others = [_with_poses(c, clips[k - 1], g) for k, (c, g, _, _) in enumerate(tasks)]
    rows["a second: another clip's poses"] = _kept_row(
        [(o, c, g) for o, (c, g, _, _) in zip(others, tasks, strict=True)], limit
    )
    title = f"edits of {len(clips)} real clips"
    return Grid("edits", title, KEPT, rows, NOTES["kept"], "edit")


def _tasks(context: EditContext, kind: str) -> Iterator[tuple[Motion, Given, str, int]]:
    """Clip, what is kept of it, the text for the rest and a seed."""
    clips = context.clips
    for index, clip in enumerate(clips.motions):
        frames = clip.num_frames
        middle = (frames // 2 - 15, frames // 2 + 15)
        joints = REDONE.get(kind)
        if kind == "between ends":
            given = keep_ends(clip, clip, 30, frames, rejoin=True)
        else:
            chosen = None if joints is None else {name for key in joints for name in GROUPS[key]}
            given = redo(clip, *middle, chosen)
        yield clip, given, clips.captions[index], context.settings.seed + index


def _edit(
    generator: TextToMotion, kind: str, clip: Motion, given: Given, text: str, seed: int
) -> Motion:
    return edited(generator, text, given, Sampling(seed=seed)).motion


def _kept_row(made: Sequence[tuple[Motion, Motion, Given]], limit: float) -> GridRow:
    figures = [asdict(kept_figures(*each)) for each in made]
    borders = np.concatenate(
        [accelerations(m)[near(m.num_frames, borders_of(given))] for m, _, given in made]
    )
    cells: dict[str, Any] = {
        key: float(np.nanmax([each[key] for each in figures]))
        for key in ("rotation", "root", "position")
        if not all(np.isnan(each[key]) for each in figures)
    }
    cells["changed"] = bootstrap_mean([each["changed"] for each in figures])
    cells |= _against(borders, limit, "border")
    return GridRow(cells, len(made), 1)


def _with_poses(clip: Motion, other: Motion, given: Given) -> Motion:
    """A clip with another one's poses in the frames that are to be made anew."""
    free = ~given.constraint.known.flatten(1).all(1).numpy()
    pose = clip.quaternions.copy()
    where = np.flatnonzero(free)
    pose[where, 1:] = other.quaternions[where % other.num_frames, 1:]
    return replace(clip, quaternions=pose)


# ---------------------------------------------------------------- paths


def path_table(context: EditContext) -> Grid:
    """A row a shape and a maker."""
    rows = {}
    number = context.settings.repeats
    for shape, drawn in drawn_paths().items():
        for who, generator in context.generators.items():
            context.progress(f"paths: {shape}, {who}")
            made = [
                _follow(generator, drawn, seed) for seed in seeds(context.settings.seed, number)
            ]
            rows[f"{shape}: {who}"] = _path_row(made)
        still = [(held_still(motion), points, drawn) for motion, points, drawn in made]
        rows[f"{shape}: frozen pose"] = _path_row(still)
        rows[f"{shape}: words alone"] = _path_row(
            [
                (_free(context.generator, m, k), points, drawn)
                for k, (m, points, _) in enumerate(made)
            ]
        )
    return Grid("paths", f"drawn paths ({number} motions each)", PATH, rows, NOTES["path"], "path")


Followed = tuple[Motion, np.ndarray, DrawnPath]  # with where the pelvis was to be [T,2]


def _follow(generator: TextToMotion, drawn: DrawnPath, seed: int) -> Followed:
    settings = Sampling(seed=seed % 2**31)
    passage = Passage("a person walks", 1)
    motion = along_path(generator, Timeline((passage,)), drawn, settings).motion
    speed, facing = natural_gait(generator, passage, settings)
    path = time_path(drawn, fps=generator.card.fps, speed=speed, facing=facing)
    return motion, path.points, drawn


def _free(generator: TextToMotion, like: Motion, seed: int) -> Motion:
    (motion,) = generator.generate(["a person walks"], seconds=like.seconds, seed=seed)
    return motion


def _path_row(made: Sequence[Followed]) -> GridRow:
    columns: dict[str, list[float]] = {column.key: [] for column in PATH}
    for motion, points, drawn in made:
        ground = motion.root_position[:, [0, 2]].astype(np.float64)
        frames = min(len(ground), len(points))
        apart = np.linalg.norm(ground[:frames] - points[:frames], axis=1)
        seen, fps = seen_from_pelvis(motion), motion.fps
        columns["mean"].append(100 * float(apart.mean()))
        columns["max"].append(100 * float(apart.max()))
        columns["line"].append(100 * float(distances_to_line(ground, drawn.points).mean()))
        speed = np.linalg.norm(np.diff(seen, axis=0), axis=-1).mean() * fps
        columns["limb_speed"].append(float(speed))
        columns["support"].append(support_slide(motion.positions().astype(np.float64), fps))
        columns["rough"].append(jerk_per_speed(motion.positions().astype(np.float64), fps))
    cells = {key: bootstrap_mean(values) for key, values in columns.items()}
    cells["max"] = float(np.max(columns["max"]))  # type: ignore[assignment]
    return GridRow(cells, len(made), 1)


# ---------------------------------------------------------------- transitions


def transition_table(context: EditContext, judge: Evaluator) -> Grid:
    """One action after the other."""
    limit = real_limit(context.real)
    text = judge.embed_text(ACTIONS).numpy()
    pairs = context.pairs
    made = {}
    for who, generator in context.generators.items():
        context.progress(f"transitions: {who}")
        made[who] = [
            _transition(generator, pair, context.settings.seed + k) for k, pair in enumerate(pairs)
        ]
    context.progress("transitions: hard cut")
    apart = [
        context.generator.generate(pair, seconds=HALF / 30, seed=context.settings.seed + k)
        for k, pair in enumerate(pairs)
    ]
    made["hard cut"] = [hard_cut(*each) for each in apart]
    made["frozen pose"] = [held_still(motion) for motion in made["generated"]]
    rows = {who: _transition_row(each, pairs, judge, text, limit) for who, each in made.items()}
    title = f"transitions ({len(pairs)} pairs of actions)"
    return Grid("transitions", title, TRANSITION, rows, NOTES["transitions"])


def _transition(generator: TextToMotion, pair: tuple[str, str], seed: int) -> Motion:
    timeline = Timeline(tuple(Passage(text, HALF) for text in pair))
    return by_timeline(generator, timeline, Sampling(seed=seed)).motion


def _transition_row(
    motions: Sequence[Motion],
    pairs: Sequence[tuple[str, str]],
    judge: Evaluator,
    text: np.ndarray,
    limit: float,
) -> GridRow:
    sizes = [accelerations(motion) for motion in motions]
    change = np.concatenate([values[HALF - AROUND : HALF + AROUND] for values in sizes])
    rest = [np.delete(each, slice(HALF - AROUND, HALF + AROUND)) for each in sizes]
    cells = _against(change, limit, "near")
    cells["elsewhere"] = float(np.percentile(np.concatenate(rest), TOP))
    for key, part, which in (("before", (0, HALF), 0), ("after", (HALF, 2 * HALF), 1)):
        hits = [
            _first(judge, motion.frames(*part), text, ACTIONS.index(pair[which]))
            for motion, pair in zip(motions, pairs, strict=True)
        ]
        cells[key] = bootstrap_mean(hits)
    return GridRow(cells, len(motions), 1)


def _first(judge: Evaluator, motion: Motion, text: np.ndarray, asked: int) -> float:
    """1 if the action asked for is the nearest of all."""
    seen = embed(judge, motion)
    distances = np.linalg.norm(seen[:, None] - text[None], axis=-1)  # W P
    return float((rank_of(distances, asked) < 1).mean())


# ---------------------------------------------------------------- the real band


def real_limit(motions: Sequence[Motion]) -> float:
    """The 99th percentile of the frames' largest accelerations, m/s²."""
    return float(np.percentile(np.concatenate([accelerations(m) for m in motions]), TOP))


def _against(sizes: np.ndarray, limit: float, name: str) -> dict[str, Any]:
    """p99 of sizes, the real one, and the share beyond it in percent."""
    if not len(sizes):
        return {"real": limit}
    return {
        name: float(np.percentile(sizes, TOP)),
        "real": limit,
        "beyond": 100 * float((sizes > limit).mean()),
    }
