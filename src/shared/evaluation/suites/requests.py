"""Does a text model do what people ask for in their own words, as captured motion would show it?

Prompts are hand-written (`captions/requests.py`), real rows and references are captured clips
alone. The judge (`evaluation/actions.py`) has seen no procedural clip of an action that a capture
covers.

Letters: N motions, T frames, K joints, F features.
"""

import math
from collections.abc import Callable, Sequence
from dataclasses import asdict
from functools import partial
from typing import Any, Protocol

import numpy as np

from ...data.captions.requests import COMPOSITIONS, FREE, OUTSIDE, Request, drawn, load_requests
from ...data.prepared import ClipRecord, PreparedData
from ...metrics.frechet import frechet_distance
from ...metrics.measurements import at_rest, measure
from ...metrics.physical import foot_jump, support_slide, worst_acceleration
from ...motion.motion import Motion
from ..actions import MIN_FRAMES, ActionJudge, Generator, same_action, shown
from ..engine import Progress
from ..samples import frozen_pose, rows_of_each, spread_over_groups
from ..stats import Estimate, bootstrap_mean, replicated, share_of
from ..tables import Cell, Column, Grid, GridRow, Report, report_data
from .text import errors_only
from .yardstick import Asked, RequestSettings, Seen, Yardstick, answering

GESTURES = ("wave", "raise", "bow", "bye", "call", "respond", "guide", "clap")
WALK = "a person walks forward"
LONG_WALKS = (2.0, 10.0, 30.0, 60.0)  # seconds
FLOOR_SHARE = 4  # every so many-th plain request is put to the floors
PIECES, HOP = (60, 120), 15  # frames: windows in which the parts of a composition are looked for
REAL = "captured, held out"  # name of the row
LOOKED_UP = "captured, looked up in training"
HALVES = 1 << 17  # of the draws of one seed, those of halves of the takes
DRAWS = 20  # of the clips that a distance is held against
LENGTH_DRAWS = 4  # of the lengths at which its motions are made
Labels = dict[str, str]
Does = Callable[[Request, Motion], bool]


class Model(Generator, Protocol):
    """What is asked of a model; `SentenceGenerator` is one."""

    def scope_warnings(self, prompts: Sequence[str]) -> list[str | None]: ...
    def missed(self, prompt: str, motion: Motion) -> str | None: ...


class Requests(Yardstick):
    """Sentences put to a model, and what it makes of them held against the yardstick."""

    def __init__(
        self, model: Model, data: PreparedData, settings: RequestSettings, progress: Progress
    ) -> None:
        """Read the clips, fit the judge, and draw the sentences."""
        super().__init__(data, settings, progress)
        self.model, self.requests = model, load_requests(settings.languages)
        plain = [r for r in self.requests if r.section == "plain"]
        plain = drawn(plain, settings.wordings, settings.seed)
        self.plain = [r for r in plain if r.action in self.judge.classes]

    def knows(self, request: Request) -> bool:
        """Whether the judge can tell all that a sentence asks for."""
        return all(part.get("action") in self.judge.classes for part in request.parts)

    def make(self, texts: Sequence[str], by: Generator | None = None) -> Seen:
        """What a model, or the one in question, makes of these sentences."""
        own = self.settings
        maker = by or self.model
        return Seen.of(maker.generate(texts, seconds=own.seconds, seed=own.seed, steps=own.steps))

    def obedience(self, rows: dict[str, Asked]) -> Grid:
        languages = self.settings.languages
        found = {REAL: GridRow({"all": share_of(self.real_obeyed)}, len(self.real))}
        if self.procedural is not None:
            tags = [{"action": record.tag} for record in self.procedural_records]
            done = self.obeyed(tags, self.procedural)
            found["procedural"] = GridRow({"all": share_of(done)}, len(tags))
        for name, asked in rows.items():
            done = self.obeyed(asked.labels, asked.seen)
            spoken = np.array([request.language for request in asked.requests])
            cells: dict[str, Cell] = {"all": share_of(done)}
            cells |= {code: share_of(done[spoken == code]) for code in languages}
            found[name] = GridRow(cells, len(asked.seen))
        asked = rows["generated"]
        others = _of_other_actions(asked.actions, self.settings.seed)
        done = self.obeyed([asked.requests[row].labels for row in others], asked.seen)
        found["generated, for another action"] = GridRow({"all": share_of(done)}, len(done))
        columns = tuple(Column(key, key, 2, "high", share=True) for key in ("all", *languages))
        return Grid.of("obeyed", found, columns=columns)

    def by_action(self, asked: Asked) -> Grid:
        done, real = self.obeyed(asked.labels, asked.seen), self.real_obeyed
        wanted, theirs = np.array(asked.actions), np.array(self.tags)
        recognizer = self.recognizer
        instead = np.array(self.judge(asked.seen.features))
        rows = {}
        for action in sorted(set(asked.actions)):
            own = wanted == action
            others = [each for each in instead[own].tolist() if not same_action(action, each)]
            cells: dict[str, Cell] = {
                "obeyed": share_of(done[own]),
                "real": share_of(real[theirs == action]),
                "source": "captured" if action in self.captured else "not captured",
                "recall": recognizer.recall[action],
                "false": recognizer.false_alarms[action],
                "kinematics": "yes" if action in recognizer.kinematic else "",
                "instead": max(set(others), key=others.count) if others else "",
            }
            rows[action] = GridRow(cells, int(own.sum()))
        return Grid.of("actions", rows)

    def as_long(self, by: Generator, asked: Sequence[Request]) -> list[Asked]:
        """Those of the requests that captured clips answer, each as long as one of these, some
        times over with other lengths; none where no clips do."""
        told = [request for request in asked if self.references(request.labels)]
        texts, labels = [r.text for r in told], [r.labels for r in told]
        found, seed = list[Asked](), self.settings.seed
        for draw in range(LENGTH_DRAWS if told else 0):
            seconds = self.lengths(labels, draw)
            made = by.generate(texts, seconds=seconds, seed=seed + draw, steps=self.settings.steps)
            found.append(Asked(told, Seen.of(made)))
        return found

    def _distances(
        self, labels: Sequence[Labels], sets: Sequence[Seen], records: Sequence[ClipRecord] = ()
    ) -> dict[str, Cell]:
        """Of a motion a request, or of a clip drawn from `records`, against a held-out clip each;
        averages over draws, which take turns with the sets of motions. Held-out clips are drawn
        from one half of the takes, and held against those of the other: against themselves their
        distance would go to 0 with the number of requests."""
        own = [answering(w, records) if records else [row] for row, w in enumerate(labels)]
        pools = [pair for w, rows in zip(labels, own, strict=True)
                 if all(pair := (self.references(w), rows))]  # fmt: skip
        if len(pools) < 2:
            return {}
        takes, shared = sorted({record.take for record in self.records}), records is self.records
        used = sorted({row for _, rows in pools for row in rows})
        place, sets = {row: at for at, row in enumerate(used)}, [seen.rows(used) for seen in sets]
        turns, held = [self.points(seen) for seen in sets], self.records
        found = list[list[float]]()
        for draw in range(DRAWS):
            rng = np.random.default_rng([self.settings.seed, draw])
            here, there = list[int](), list[int]()
            halves = np.random.default_rng([self.settings.seed, HALVES, draw])
            first = {*halves.permutation(takes)[::2].tolist()} if shared else set[str]()
            for pool, candidates in pools:
                if shared:
                    pool = [row for row in pool if held[row].take in first] or pool
                    candidates = [r for r in candidates if held[r].take not in first] or candidates
                there.append(int(rng.choice(pool)))
                here.append(place[int(rng.choice(candidates))])
            pairs = zip(turns[draw % len(turns)], self.real_points, strict=True)
            found.append([frechet_distance(a[here], b[there]) for a, b in pairs])
        names = "learned", "kinematic"
        return dict(zip(names, map(replicated, zip(*found, strict=True)), strict=True))

    def realism(self, rows: dict[str, Asked], compared: dict[str, list[Asked]]) -> Grid:
        """Distances from captured clips of the same actions, and what a body shows of itself."""
        known = self.known_records
        plain = [i for i, record in enumerate(known)
                 if record.provenance == "captured" and "style" not in record.labels]  # fmt: skip
        clips = {REAL: (self.real, self.records)}
        if plain:
            clips[LOOKED_UP] = self.known.rows(plain), [known[i] for i in plain]
        if self.procedural is not None:
            clips["procedural"] = self.procedural, self.procedural_records
        asked, found = rows["generated"].labels, dict[str, GridRow]()

        def row(seen: Seen, labels: Sequence[Labels], distances: dict[str, Cell]) -> GridRow:
            actions = [wanted.get("action", "") for wanted in labels]
            nearer = share_of(self.nearer_to_procedural(actions, seen))
            gait = gaits(seen, labels, self.top_run)
            return GridRow({**distances, **gait, "procedural": nearer}, len(seen))

        for name, (seen, records) in clips.items():
            own = [{**record.labels, "action": record.tag} for record in records]
            found[name] = row(seen, own, self._distances(asked, [seen], records))
        for name, each in rows.items():
            alike, apart = compared[name], dict[str, Cell]()
            if alike:
                apart = self._distances(alike[0].labels, [one.seen for one in alike])
            found[name] = row(each.seen, each.labels, apart)
        matches = self.settings.min_matches
        told = sum(bool(self.references(w)) for w in asked)
        words = {"matches": matches, "told": told, "lengths": LENGTH_DRAWS, "draws": DRAWS}
        return Grid.of("realism", found, words)

    def exactness(self) -> Grid:
        """Counts, angles, lengths, sides, styles, sequences: what a sentence says exactly."""
        settings, rows = self.settings, dict[str, GridRow]()

        def of(section: str, *, simultaneous: bool = False) -> list[Request]:
            found = [r for r in self.requests if r.section == section]
            found = [r for r in found if r.simultaneous == simultaneous and self.knows(r)]
            return drawn(found, settings.wordings, settings.seed)

        def row(name: str, wanted: Sequence[Request], does: Does) -> None:
            if wanted:
                motions = self.make([r.text for r in wanted]).motions
                done = [does(r, motion) for r, motion in zip(wanted, motions, strict=True)]
                rows[name] = shares(done)

        def obeys(request: Request, motion: Motion) -> bool:
            return bool(self.obeyed([request.labels], Seen.of([motion]))[0])

        def covers(request: Request, motion: Motion) -> bool:
            """From where it began to where it ends."""
            ends = motion.root_position[[0, -1]][:, [0, 2]]
            way = np.linalg.norm(ends[1] - ends[0])
            return bool(abs(way / float(request.labels["metres"]) - 1) <= 0.2)

        for section in ("counts", "angles", "sides"):
            row(section, of(section), obeys)
        row("lengths, ±20%", [r for r in of("lengths") if "metres" in r.labels], covers)
        row("two sides at once", of("sides", simultaneous=True), lambda r, m: shown(r.parts, m))
        if sequences := of(COMPOSITIONS):
            acted, order = self.make([r.text for r in sequences]).motions, self._in_order
            others = _of_other_actions([r.action for r in sequences], settings.seed)
            done = [order(r, motion) for r, motion in zip(sequences, acted, strict=True)]
            chance = [order(sequences[o], motion) for o, motion in zip(others, acted, strict=True)]
            rows["one-sentence sequences"] = shares(done)
            rows["the same, for another sequence"] = shares(chance)
            jumps = [[foot_jump(m) for m in motions] for motions in (acted, self.real.motions)]
            cells = dict(zip(("share", "real"), map(bootstrap_mean, jumps), strict=True))
            rows["sequences: largest acceleration of a foot, m/s²"] = GridRow(cells, len(acted))
        rows |= self._styles(of("styled"))
        gestures = drawn([r for r in of("plain") if r.action in GESTURES], 1, settings.seed)
        if gestures:
            rows |= self._gestures(gestures, self.make([r.text for r in gestures]))
        rows["spread of a gesture, cm"] = self._spread_row(gestures)
        for seconds in LONG_WALKS:
            walk = self.model.generate(
                [WALK], seconds=seconds, seed=settings.seed, steps=settings.steps
            )[0]
            steps = np.linalg.norm(np.diff(walk.root_position[:, [0, 2]], axis=0), axis=-1)
            speed = float(steps.sum() / walk.seconds)
            rows[f"a walk of {seconds:g} s, m/s"] = GridRow({"share": speed}, 1)
        return Grid.of("exactness", rows)

    def _gestures(self, gestures: Sequence[Request], seen: Seen) -> dict[str, GridRow]:
        """Whether arms hang at both ends, and how far the body has turned in between."""
        does = self.obeyed([r.labels for r in gestures], seen)
        rests = np.array([at_rest(motion) for motion in seen.motions])
        real = zip(self.records, self.real.motions, self.real_obeyed, strict=True)
        whole = [(motion, done) for record, motion, done in real
                 if record.tag in GESTURES and motion.num_frames < self.longest]  # fmt: skip
        theirs = [(at_rest(motion), done) for motion, done in whole]
        turned = [bootstrap_mean([abs(math.degrees(measure(m).yaw)) for m in motions])
                  for motions in (seen.motions, [motion for motion, _ in whole])]  # fmt: skip
        obeyed = share_of(rests & does), share_of([rest and done for rest, done in theirs])
        cells = {
            "gestures from rest to rest": (share_of(rests), share_of([rest for rest, _ in theirs])),
            "the same, and obeyed": obeyed,
            "gestures: turned by, degrees": turned,
        }
        rows = {name: {"share": made, "real": real} for name, (made, real) in cells.items()}
        return {name: GridRow(row, len(seen)) for name, row in rows.items()}

    def _spread_row(self, gestures: Sequence[Request]) -> GridRow:
        """How far apart motions of one sentence are over seeds, and captured clips of one label."""
        settings = self.settings
        prompts = [r.text for r in gestures if r.language == settings.languages[0]]
        make = partial(self.model.generate, prompts, seconds=settings.seconds, steps=settings.steps)
        by_seed = [make(seed=seed) for seed in range(settings.variety_seeds)]
        made = [spread(list(motions)) for motions in zip(*by_seed, strict=True)]
        pairs = zip(self.records, self.real.motions, strict=True)
        long = [(record.group, motion) for record, motion in pairs
                if record.tag in GESTURES and motion.num_frames >= PIECES[0]]  # fmt: skip
        groups = rows_of_each(group for group, _ in long).values()
        real = [spread([long[row][1] for row in rows]) for rows in groups if len(rows) > 3]
        cells = {"share": bootstrap_mean(made), "real": bootstrap_mean(real)}
        return GridRow(cells, len(made) * settings.variety_seeds)

    def _styles(self, wanted: Sequence[Request]) -> dict[str, GridRow]:
        """Style heard, by a discriminant of captured walks in styles, and if it is still a walk."""

        def style(record: ClipRecord) -> str:
            return record.labels.get("style", "normal")

        train = [r for r in self.data.records("train") if r.provenance == "captured"
                 and r.tag == "walk" and r.num_frames >= MIN_FRAMES]  # fmt: skip
        styles = {style(record) for record in train}
        wanted = [r for r in wanted if r.labels.get("style") in styles]
        if len(styles) < 2 or not wanted:
            return {}
        train = spread_over_groups(train, 2 * self.settings.max_clips, self.settings.seed)
        judge = ActionJudge.fit(self.clips(train).features, [style(r) for r in train])
        held = [i for i, tag in enumerate(self.tags) if tag == "walk"]
        told = np.array([style(self.records[i]) for i in held])
        right = np.array(judge(self.real.features[held])) == told
        made = self.make([r.text for r in wanted])
        heard = np.array(judge(made.features)) == np.array([r.labels["style"] for r in wanted])
        walks = [action == "walk" for action in self.judge(made.features)]
        both = {"share": share_of(heard), "real": share_of(right)}
        return {
            "styled walks: style heard": GridRow(both, len(made)),
            "styled walks: still a walk": shares(walks),
        }

    def warnings(self, made: Seen) -> Grid:
        """Does it know what it does not know?"""

        def warned_of(asked: Sequence[Request]) -> np.ndarray:
            warnings = self.model.scope_warnings([r.text for r in asked])
            return np.array([warning is not None for warning in warnings])

        def seen_to_miss(asked: Sequence[Request], seen: Seen) -> np.ndarray:
            pairs = zip(asked, seen.motions, strict=True)
            return np.array([self.model.missed(r.text, motion) is not None for r, motion in pairs])

        done = self.obeyed([request.labels for request in self.plain], made)
        said = warned_of(self.plain)
        warned = said | seen_to_miss(self.plain, made)
        foreign = warned_of([r for r in self.requests if r.section == OUTSIDE])
        free = [r for r in self.requests if r.section == FREE and len(r.parts) < 2]
        told = warned_of(free)
        inside = [i for i, r in enumerate(free) if r.parts and r.action in self.judge.classes]
        right = np.zeros(len(free), bool)
        if inside:
            seen = self.make([free[i].text for i in inside])
            right[inside] = self.obeyed([free[i].labels for i in inside], seen)
            told[inside] |= seen_to_miss([free[i] for i in inside], seen)
        found = {
            "plain, missed": warned[~done],
            "plain, obeyed": warned[done],
            "plain, missed: by the sentence alone": said[~done],
            "plain, obeyed: by the sentence alone": said[done],
            "outside the vocabulary": foreign,
            "free prompts, right": right,
            "free prompts, wrong but warned of": ~right & told,
            "free prompts, wrong without a word": ~right & ~told,
        }
        return Grid.of("warnings", {name: shares(each) for name, each in found.items()})

    def _in_order(self, request: Request, motion: Motion) -> bool:
        """Whether the parts are seen one after the other, each in some window of PIECES frames."""
        starts = {size: range(0, max(motion.num_frames - size, 0) + 1, HOP) for size in PIECES}
        windows = [(at, at + size) for size, places in starts.items() for at in places]
        windows.sort(key=lambda window: window[1])
        pieces = Seen.of([motion.frames(*window) for window in windows])
        rest = iter(list(zip(self.judge(pieces.features), pieces.motions, strict=True)))
        shows = self.recognizer.shows
        return all(any(shows(part["action"], *piece) for piece in rest) for part in request.parts)


def evaluate_requests(
    model: Model,
    data: PreparedData,
    *,
    floors: dict[str, Generator] | None = None,
    settings: RequestSettings | None = None,
    about: dict[str, Any] | None = None,
    progress: Progress = lambda text: None,
) -> Report:
    """The whole report as plain data, see `report_data`.

    Args:
        model: whose every table is.
        data: a prepared folder with captured clips; its train split fits the judge, what is held
            back is the reference.
        floors: models of which the first tables have a row too, by its name.

    Raises UserError: the data holds too few captured clips, or the model is untrained.
    """
    settings, floors = settings or RequestSettings(), floors or {}
    suite = Requests(model, data, settings, progress)
    plain = suite.plain

    def still(seen: Seen) -> Seen:
        return Seen.of([frozen_pose(motion) for motion in seen.motions])

    with errors_only():
        progress(f"{len(plain)} plain requests")
        made, few = suite.make([r.text for r in plain]), plain[::FLOOR_SHARE]
        rows = {"generated": Asked(plain, made), "frozen pose": Asked(plain, still(made))}
        for name, floor in floors.items():
            progress(f"{len(few)} of them by {name}")
            rows[name] = Asked(few, suite.make([r.text for r in few], floor))
        progress("those that are compared with captured clips, as long as these are")
        makers = {"generated": (model, plain), **{n: (each, few) for n, each in floors.items()}}
        compared = {name: suite.as_long(*each) for name, each in makers.items()}
        alike = compared["generated"]
        compared["frozen pose"] = [Asked(each.requests, still(each.seen)) for each in alike]
        progress("numbers, sides, styles and compositions")
        tables = [
            suite.obedience(rows),
            suite.by_action(rows["generated"]),
            suite.realism(rows, compared),
            suite.exactness(),
            suite.warnings(made),
        ]
    facts = {**(about or {}), "data_hash": data.manifest_hash[:12], "judge": "captured clips"}
    return report_data("text", facts, asdict(settings), tables)


def shares(done: Sequence[bool] | np.ndarray) -> GridRow:
    """The share of motions that do it."""
    return GridRow({"share": share_of(done)}, len(done))


def _of_other_actions(actions: Sequence[str], seed: int) -> list[int]:
    """A row with another action for each row, drawn; the row itself where there is but one."""
    rng, names = np.random.default_rng(seed), np.array(actions)
    pools = [np.flatnonzero(names != action) for action in actions]
    return [int(rng.choice(pool)) if len(pool) else row for row, pool in enumerate(pools)]


def spread(motions: Sequence[Motion]) -> float:
    """Deviation of the joints, seen from the pelvis, over motions of two seconds or more; cm."""
    joints = np.stack([motion.positions()[: PIECES[0]] for motion in motions])
    deviation: np.ndarray = (joints - joints[:, :, :1]).std(0)  # T K 3
    return float(100 * np.linalg.norm(deviation, axis=-1).mean())


def gaits(seen: Seen, labels: Sequence[Labels], top_run: float) -> dict[str, Estimate]:
    """How walks and runs move: peak acceleration m/s², frames beyond `top_run` %, slide cm/s, and
    degrees by which walks turn that are to turn, to whichever side."""
    pairs = list(zip(seen.motions, labels, strict=True))
    walks = [motion for motion, wanted in pairs if wanted.get("action") == "walk"]
    runs = [motion for motion, wanted in pairs if wanted.get("action") == "run"]
    bent = [m for m, wanted in pairs if wanted.get("action") == "walk" and "turn" in wanted]
    slides = [support_slide(m.positions().astype(np.float64), m.fps) for m in walks]
    return {
        "peak": bootstrap_mean([float(np.percentile(worst_acceleration(m), 99)) for m in walks]),
        "teleports": bootstrap_mean([100 * (worst_acceleration(m) > top_run).mean() for m in runs]),
        "slide": bootstrap_mean(slides),
        "turn": bootstrap_mean([abs(math.degrees(measure(m).yaw)) for m in bent]),
    }
