"""Does a text model do what people ask for in their own words, as captured motion would show it?

Prompts are hand-written (`data/requests.py`), real rows and references are captured clips alone
(`yardstick.py`).

Letters: N motions.
"""

from collections.abc import Callable, Sequence
from dataclasses import asdict
from functools import partial
from typing import Any, Protocol

import numpy as np

from ..data.captions.requests import COMPOSITIONS, FREE, OUTSIDE, Request, drawn, load_requests
from ..data.prepared import PreparedData
from ..metrics.frechet import frechet_distance
from ..metrics.kinetic import FeatureSpace
from ..motion.motion import Motion
from .action_judge import ActionJudge
from .floors import frozen_pose
from .held_out import spread_over_groups
from .report.tables import Cell, Column, Grid, GridRow, report_data
from .stats import bootstrap_mean, share_of
from .suites.text import errors_only
from .yardstick import (
    MIN_FRAMES,
    PIECE,
    Progress,
    RequestSettings,
    Seen,
    Yardstick,
    at_rest,
    covers,
    gaits,
    in_order,
    kinetic,
    mean_speed,
    same_action,
    shown,
    spread,
)

GESTURES = ("wave", "raise", "bow", "bye", "call", "respond", "guide", "clap")
WALK = "a person walks forward"
LONG_WALKS = (2.0, 10.0, 30.0, 60.0)  # seconds
FLOOR_SHARE = 4  # every so many-th plain request is put to the floors


class Model(Protocol):
    """What is asked of a model; `SentenceGenerator` is one."""

    def generate(self, prompts: Sequence[str], *, seconds: float, seed: int) -> list[Motion]: ...
    def scope_warnings(self, prompts: Sequence[str]) -> list[str | None]: ...


def evaluate_requests(
    model: Model,
    data: PreparedData,
    *,
    floors: dict[str, Model] | None = None,
    settings: RequestSettings | None = None,
    about: dict[str, Any] | None = None,
    progress: Progress = lambda text: None,
) -> dict[str, Any]:
    """The whole report as plain data, see `report_data`.

    Args:
        model: whose every table is.
        data: a prepared folder with captured clips; its train split fits the judge, what is held
            back is the reference.
        floors: models of which the first tables have a row too, by its name.

    Raises:
        UserError: the data holds too few captured clips, or the model is untrained.
    """
    settings = settings or RequestSettings()
    yardstick = Yardstick(data, settings, progress)
    requests = load_requests(settings.languages)
    plain = drawn([r for r in requests if r.section == "plain"], settings.wordings, settings.seed)
    plain = [r for r in plain if r.action in yardstick.judge.classes]
    with errors_only():
        tables = _tables(yardstick, model, floors or {}, requests, plain, progress)
    facts = {**(about or {}), "data_hash": data.manifest_hash[:12], "judge": "captured clips"}
    return report_data("text", facts, asdict(settings), tables, [])


def _tables(
    yardstick: Yardstick,
    model: Model,
    floors: dict[str, Model],
    requests: Sequence[Request],
    plain: Sequence[Request],
    progress: Progress,
) -> list[Grid]:
    settings = yardstick.settings
    make = partial(_make, model, settings)
    progress(f"{len(plain)} plain requests")
    made = make([r.text for r in plain])
    few = plain[::FLOOR_SHARE]
    asked = {"generated": plain, "frozen pose": plain} | dict.fromkeys(floors, few)
    rows = {
        "generated": made,
        "frozen pose": Seen.of([frozen_pose(motion) for motion in made.motions]),
    }
    for name, floor in floors.items():
        progress(f"{len(few)} of them by {name}")
        rows[name] = _make(floor, settings, [r.text for r in few])
    progress("numbers, sides, styles and compositions")
    return [
        _obedience(yardstick, asked, rows),
        _by_action(yardstick, plain, made),
        _realism(yardstick, asked, rows),
        _exactness(yardstick, model, requests, make),
        _warnings(yardstick, model, requests, plain, made, make),
    ]


def _make(model: Model, settings: RequestSettings, texts: Sequence[str]) -> Seen:
    return Seen.of(model.generate(texts, seconds=settings.seconds, seed=settings.seed))


# ---------------------------------------------------------------- tables


def _obedience(
    yardstick: Yardstick, asked: dict[str, Sequence[Request]], rows: dict[str, Seen]
) -> Grid:
    languages = yardstick.settings.languages
    labels = [record.labels for record in yardstick.records]
    real = yardstick.obeyed(labels, yardstick.real)
    found = {"captured, held out": GridRow({"all": share_of(real)}, len(real))}
    if yardstick.procedural is not None:
        tags = [{"action": tag} for tag in yardstick.procedural_tags]
        share = share_of(yardstick.obeyed(tags, yardstick.procedural))
        found["procedural"] = GridRow({"all": share}, len(tags))
    for name, seen in rows.items():
        done = yardstick.obeyed([request.labels for request in asked[name]], seen)
        cells: dict[str, Cell] = {"all": share_of(done)}
        for code in languages:
            own = [row for row, request in enumerate(asked[name]) if request.language == code]
            cells[code] = share_of(done[own])
        found[name] = GridRow(cells, len(seen))
    columns = [Column(key, key, 2, "high", share=True) for key in ("all", *languages)]
    note = (
        "Share of motions that do what a hand-written, plain sentence asks: the action by a"
        " discriminant fitted on captured clips, side, direction and turn by kinematics."
        " *captured*: held-out clips under their own labels; *procedural*: the action alone."
    )
    return Grid("obeyed", "Plain requests obeyed", tuple(columns), found, note)


def _by_action(yardstick: Yardstick, plain: Sequence[Request], made: Seen) -> Grid:
    done = yardstick.obeyed([request.labels for request in plain], made)
    real = yardstick.obeyed([record.labels for record in yardstick.records], yardstick.real)
    instead = yardstick.shows(made)
    rows = {}
    for action in sorted({request.action for request in plain}):
        own = [row for row, request in enumerate(plain) if request.action == action]
        theirs = [row for row, record in enumerate(yardstick.records) if record.tag == action]
        others = [instead[row] for row in own if not same_action(action, instead[row])]
        cells: dict[str, Cell] = {
            "obeyed": share_of(done[own]),
            "real": share_of(real[theirs]),
            "source": "captured" if action in yardstick.captured else "not captured",
            "instead": max(set(others), key=others.count) if others else "",
        }
        rows[action] = GridRow(cells, len(own))
    columns = (
        Column("obeyed", "obeyed", 2, "high", share=True),
        Column("real", "captured clips", 2, "high", share=True),
        Column("source", "the judge knows it from"),
        Column("instead", "most often shown instead"),
    )
    return Grid("actions", "Plain requests by action", columns, rows, head="action")


def _realism(
    yardstick: Yardstick, asked: dict[str, Sequence[Request]], rows: dict[str, Seen]
) -> Grid:
    """Distances from captured clips of the same actions, and what a body shows of itself."""
    tags = [record.tag for record in yardstick.records]
    rng = np.random.default_rng(yardstick.settings.seed)
    halves = np.array_split(rng.permutation(len(tags)), 2)
    real, features = yardstick.real, kinetic(yardstick.real)
    space = FeatureSpace.fit(features, np.arange(features.shape[1]) % 3)

    def figures(seen: Seen, wanted: Sequence[str], reference: np.ndarray) -> dict[str, Cell]:
        gait = gaits(seen, wanted, yardstick.top_run)
        return distances(seen, wanted, reference) | gait

    def distances(seen: Seen, wanted: Sequence[str], reference: np.ndarray) -> dict[str, Cell]:
        """Against as many captured clips of the same actions."""
        pool = [[i for i in reference if tags[i] == tag] for tag in wanted]
        own = [row for row, same in enumerate(pool) if same]
        if len(own) < 2:
            return {}
        there = [int(rng.choice(pool[row])) for row in own]
        judge = yardstick.judge
        a, b = seen.rows(own), real.rows(there)
        nearer = yardstick.nearer_to_procedural([wanted[row] for row in own], a)
        return {
            "learned": frechet_distance(judge.embed(a.features), judge.embed(b.features)),
            "kinematic": space.distance(kinetic(a), kinetic(b)),
            "procedural": share_of(nearer),
        }

    half = real.rows(halves[0].tolist())
    own, everything = [tags[i] for i in halves[0]], np.arange(len(tags))
    gait = gaits(real, tags, yardstick.top_run)
    apart = distances(half, own, halves[1]) | gait
    found = {"captured, held out": GridRow(apart, len(half))}
    if yardstick.procedural is not None:
        seen, wanted = yardstick.procedural, yardstick.procedural_tags
        found["procedural"] = GridRow(figures(seen, wanted, everything), len(seen))
    for name, seen in rows.items():
        wanted = [request.action for request in asked[name]]
        found[name] = GridRow(figures(seen, wanted, everything), len(seen))
    columns = (
        Column("learned", "FD, judge's axes", 1, "low"),
        Column("kinematic", "FID_k", 1, "low"),
        Column("procedural", "nearer to procedural", 2, "low", share=True),
        Column("peak", "walks: peak acceleration m/s²", 0),
        Column("teleports", "runs: frames beyond captured %", 2, "low"),
        Column("slide", "walks: carrying foot cm/s", 1),
    )
    note = (
        "FD: Fréchet distance in the axes along which the judge tells captured actions apart, in"
        " deviations within an action; FID_k: of 66 kinetic features. Each motion stands against"
        " one captured clip of its action; the first row is one half of the held-out clips against"
        " the other. *nearer to procedural*: the nearest clip of the same action is one that nobody"
        " recorded. *frames beyond captured*: worst joint's acceleration above the 99.9th"
        " percentile of captured runs. A frozen pose is smooth and does not slide: read the"
        " distances first."
    )
    return Grid("realism", "Like captured motion", columns, found, note)


def _exactness(
    yardstick: Yardstick,
    model: Model,
    requests: Sequence[Request],
    make: Callable[[Sequence[str]], Seen],
) -> Grid:
    """Counts, angles, lengths, sides, styles, sequences: what a sentence says exactly."""
    rows: dict[str, GridRow] = {}

    def of(section: str, *, simultaneous: bool = False) -> list[Request]:
        found = [r for r in requests if r.section == section and r.simultaneous == simultaneous]
        known = yardstick.judge.classes
        found = [r for r in found if all(part.get("action") in known for part in r.parts)]
        return drawn(found, yardstick.settings.wordings, yardstick.settings.seed)

    def row(name: str, wanted: Sequence[Request], does: Callable[[Request, Motion], bool]) -> None:
        if wanted:
            motions = make([r.text for r in wanted]).motions
            done = [does(r, motion) for r, motion in zip(wanted, motions, strict=True)]
            rows[name] = GridRow({"share": share_of(done)}, len(done))

    def obeys(request: Request, motion: Motion) -> bool:
        return bool(yardstick.obeyed([request.labels], Seen.of([motion]))[0])

    for section in ("counts", "angles", "sides"):
        row(section, of(section), obeys)
    row("lengths, ±20%", [r for r in of("lengths") if "metres" in r.labels], covers)
    row(
        "two sides at once",
        of("sides", simultaneous=True),
        lambda r, motion: all(shown(part, motion) for part in r.parts),
    )
    row("one-sentence sequences", of(COMPOSITIONS), partial(in_order, yardstick))
    rows |= _styles(yardstick, of("styled"), make)
    gestures = [r for r in of("plain") if r.action in GESTURES]
    gestures = drawn(gestures, 1, yardstick.settings.seed)
    row("gestures from rest to rest", gestures, lambda r, motion: at_rest(motion))
    if gestures:
        name, longest = "gestures from rest to rest", yardstick.longest
        pairs = zip(yardstick.records, yardstick.real.motions, strict=True)
        whole = [at_rest(m) for r, m in pairs if r.tag in GESTURES and r.num_frames <= longest]
        rows[name] = GridRow({**rows[name].cells, "real": share_of(whole)}, rows[name].num)
    rows["spread of a gesture, cm"] = _spread_row(yardstick, model, gestures)
    for seconds in LONG_WALKS:
        walk = model.generate([WALK], seconds=seconds, seed=yardstick.settings.seed)[0]
        rows[f"a walk of {seconds:g} s, m/s"] = GridRow({"share": mean_speed(walk)}, 1)
    columns = (
        Column("share", "generated", 2, "high"),
        Column("real", "captured clips", 2),
    )
    note = (
        "Shares of hand-written sentences of all languages whose number, angle within 30°, length,"
        " side or order is shown, beside the action itself."
    )
    return Grid("exactness", "What is said exactly", columns, rows, note, head="asked for")


def _spread_row(yardstick: Yardstick, model: Model, gestures: Sequence[Request]) -> GridRow:
    """How far apart motions for one sentence are, over seeds; and captured clips of one label."""
    settings = yardstick.settings
    prompts = [r.text for r in gestures if r.language == settings.languages[0]]
    by_seed = [
        model.generate(prompts, seconds=settings.seconds, seed=seed)
        for seed in range(settings.variety_seeds)
    ]
    made = [spread(list(motions)) for motions in zip(*by_seed, strict=True)]
    groups: dict[str, list[Motion]] = {}
    for record, motion in zip(yardstick.records, yardstick.real.motions, strict=True):
        if record.tag in GESTURES and motion.num_frames >= PIECE:
            groups.setdefault(record.group, []).append(motion)
    real = [spread(motions) for motions in groups.values() if len(motions) > 3]
    cells = {"share": bootstrap_mean(made), "real": bootstrap_mean(real)}
    return GridRow(cells, len(made) * settings.variety_seeds)


def _styles(
    yardstick: Yardstick, wanted: Sequence[Request], make: Callable[[Sequence[str]], Seen]
) -> dict[str, GridRow]:
    """Style heard, by a discriminant of captured walks in styles, and whether it still walks."""
    train = [r for r in yardstick.data.records("train") if r.provenance == "captured"
             and r.tag == "walk" and r.num_frames >= MIN_FRAMES]  # fmt: skip
    styles = {r.labels.get("style", "normal") for r in train}
    wanted = [r for r in wanted if r.labels.get("style") in styles]
    if len(styles) < 2 or not wanted:
        return {}
    limit = yardstick.settings.max_clips
    train = spread_over_groups(train, 2 * limit, yardstick.settings.seed)
    judge = ActionJudge.fit(
        yardstick.clips(train).features, [r.labels.get("style", "normal") for r in train]
    )
    held = [i for i, r in enumerate(yardstick.records) if r.tag == "walk"]
    told = [yardstick.records[i].labels.get("style", "normal") for i in held]
    right = np.array(judge(yardstick.real.features[held])) == np.array(told)
    made = make([r.text for r in wanted])
    heard = np.array(judge(made.features)) == np.array([r.labels["style"] for r in wanted])
    walks = [action == "walk" for action in yardstick.shows(made)]
    return {
        "styled walks: style heard": GridRow(
            {"share": share_of(heard), "real": share_of(right)}, len(made)
        ),
        "styled walks: still a walk": GridRow({"share": share_of(walks)}, len(made)),
    }


def _warnings(
    yardstick: Yardstick,
    model: Model,
    requests: Sequence[Request],
    plain: Sequence[Request],
    made: Seen,
    make: Callable[[Sequence[str]], Seen],
) -> Grid:
    """Does it know what it does not know?"""
    done = yardstick.obeyed([request.labels for request in plain], made)
    warned = np.array([w is not None for w in model.scope_warnings([r.text for r in plain])])
    outside = [r for r in requests if r.section == OUTSIDE]
    foreign = [w is not None for w in model.scope_warnings([r.text for r in outside])]
    free = [r for r in requests if r.section == FREE and len(r.parts) < 2]
    told = np.array([w is not None for w in model.scope_warnings([r.text for r in free])])
    inside = [i for i, r in enumerate(free) if r.parts and r.action in yardstick.judge.classes]
    right = np.zeros(len(free), bool)
    if inside:
        seen = make([free[i].text for i in inside])
        right[inside] = yardstick.obeyed([free[i].labels for i in inside], seen)
    shares: dict[str, Sequence[bool] | np.ndarray] = {
        "plain, missed": warned[~done],
        "plain, obeyed": warned[done],
        "outside the vocabulary": foreign,
        "free prompts, right": right,
        "free prompts, wrong but warned of": ~right & told,
        "free prompts, wrong without a word": ~right & ~told,
    }
    rows = {name: GridRow({"share": share_of(each)}, len(each)) for name, each in shares.items()}
    note = (
        "The first three rows: share that is warned of. Then the free prompts, half of which are"
        " outside: every one is right, or wrong with or without a warning."
    )
    title = "Knowing what it does not know"
    return Grid("warnings", title, (Column("share", "share", 2),), rows, note, head="requests")
