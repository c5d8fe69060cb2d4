"""Which action does a motion show? Two witnesses, each held against captured clips.

A linear discriminant over descriptors is fitted in seconds on the captured training clips of the
data at hand, so a procedural clip never tells it what an action looks like. It shares nothing with
the models it judges: no network, no text, no rotations. What it learned from two takes it does not
find in a third; so an action may be told by kinematics too (a kick is a foot that goes up in
front), where captured clips bear that out. Both shares, of captured clips that are recognised and
of captured clips of other actions that are mistaken, stand beside every figure.

Letters: N motions, T frames, K joints, F features, C classes.
"""

import math
from collections import defaultdict
from collections.abc import Sequence
from contextlib import suppress
from dataclasses import dataclass
from itertools import cycle, islice, pairwise
from pathlib import Path
from typing import Protocol

import numpy as np

from ..data.prepared import ClipRecord, PreparedData
from ..data.synthetic.clips import SPEED_METRES, SPEEDS
from ..data.text_motion import comes_back, shorten
from ..errors import UserError
from ..io.files import load_json, write_json
from ..metrics.measurements import (
    ACTIONS,
    CHECKS,
    Check,
    Measurements,
    credible,
    hand_swings,
    measure,
    repetitions,
)
from ..model.clip.out_of_domain import TWINS
from ..motion.features import ahead_and_left, decode_features, heading_frame, motion_heading
from ..motion.motion import Motion
from ..motion.skeleton import JOINT_INDEX
from ..tensors import Tensor
from .engine import Progress
from .samples import choose_caption, rows_of_each, spread_over_groups

PARTS = 3  # beginning, middle, end: a wave is not a raise that stays up
BANDS = ((0.3, 1.0), (1.0, 2.0), (2.0, 4.0), (4.0, 8.0))  # Hz
TIPS = [JOINT_INDEX[name] for name in ("l_wrist", "r_wrist", "l_ankle", "r_ankle", "head")]
MOST_SWINGS = 8  # of a raised hand: a wave of twenty is no more of a wave
SHRINKAGE = 0.1  # of the covariance towards its diagonal (Friedman 1989)
FLOOR = 0.02  # least deviation of a feature, in its own unit
JUDGING_CLIPS = 2_400
SECONDS = 4.0
SENTENCES = 32  # at once
MIN_FRAMES = 24
MEASURES = ("count", "angle")  # how well they are kept tells nothing of the action
FOLDS = 5  # of takes, to see what the discriminant makes of a take that it has not seen
MIN_RECALL, MAX_FALSE = 0.8, 0.15  # of captured clips, for kinematics to be heard
WITNESS_CLIPS = 20  # of an action
# Checks of which way, which side and how much; which action it is the judge says.
SHOWN = {
    "forward", "backward", "left", "right", "turn-left", "turn-right", "left-hand", "right-hand",
    "both-hands", "kick-left", "kick-right", "punch-left", "punch-right", "count", "angle",
}  # fmt: skip


def descriptor(motion: Motion) -> np.ndarray:
    """What a body does, as numbers [F] in metres, seconds, radians: poses, speeds, rhythm of the
    limbs, swings, travel; joints are seen from the pelvis in the momentary heading frame."""
    joints = motion.positions().astype(np.float64)  # T K 3
    heading = np.unwrap(motion_heading(motion).astype(np.float64))
    body = heading_frame(joints, heading)
    velocity = np.diff(body, axis=0) * motion.fps  # T-1 K 3
    speed = np.linalg.norm(velocity, axis=-1)
    step = np.diff(joints[:, 0], axis=0) * motion.fps
    forward, lateral = ahead_and_left(step, heading[:-1])
    yaw_rate = np.diff(heading) * motion.fps
    height = joints[:, 0, 1]
    travel = [
        each
        for curve in (forward, lateral, yaw_rate, height)
        for each in (curve.mean(), curve.std(), *np.percentile(curve, (5, 95)))
    ]
    return np.concatenate(
        [
            *(part.mean(0).ravel() for part in np.array_split(body, PARTS)),
            body.std(0).ravel(),
            np.ptp(body, axis=0).ravel(),
            speed.mean(0),
            np.percentile(speed, 95, axis=0),
            _rhythm(velocity[:, TIPS], motion.fps).ravel(),
            [*travel, heading[-1] - heading[0]],
            np.minimum(hand_swings(motion), MOST_SWINGS),
        ]
    )


def _rhythm(velocity: np.ndarray, fps: float) -> np.ndarray:
    """Root of the power of velocities [T, J, 3] in each band, m/s: [J, bands]."""
    spectrum = np.abs(np.fft.rfft(velocity, axis=0)) ** 2  # frequencies J 3
    frequencies = np.fft.rfftfreq(len(velocity), 1 / fps)
    power = spectrum.sum(-1) / len(velocity) ** 2
    bands = [power[(low <= frequencies) & (frequencies < high)].sum(0) for low, high in BANDS]
    return np.asarray(np.sqrt(np.stack(bands, -1)))


@dataclass(frozen=True, eq=False)
class ActionJudge:
    """Linear discriminant analysis with one covariance for all classes."""

    classes: tuple[str, ...]  # C names
    mean: np.ndarray  # [F] of the clips it was fitted on
    scale: np.ndarray  # [F], likewise
    weights: np.ndarray  # [F, C] of the scores
    bias: np.ndarray  # [C] of the scores
    # [F, C - 1] in which the classes lie apart: the covariance within a class is 1
    axes: np.ndarray

    @classmethod
    def fit(cls, features: np.ndarray, labels: Sequence[str]) -> "ActionJudge":
        """Of descriptors [N, F] with a label each; every class counts alike.
        Raises ValueError: fewer than two classes, NaN or infinity."""
        classes = tuple(sorted(set(labels)))
        if len(classes) < 2 or not np.isfinite(features).all():
            raise ValueError(f"{len(classes)} classes of finite features are too few to tell apart")
        row = np.array([classes.index(label) for label in labels])
        mean, scale = features.mean(0), features.std(0).clip(min=FLOOR)
        scaled = (features - mean) / scale
        centres = np.stack([scaled[row == index].mean(0) for index in range(len(classes))])
        within = scaled - centres[row]
        share = 1.0 / np.bincount(row)[row] / len(classes)  # every class alike
        covariance = (within * share[:, None]).T @ within
        diagonal = np.diag(np.diag(covariance) + 1e-3)
        covariance = (1 - SHRINKAGE) * covariance + SHRINKAGE * diagonal
        weights = np.linalg.solve(covariance, centres.T)  # F C
        values, vectors = np.linalg.eigh(covariance)
        whiten = vectors / np.sqrt(values)
        _, _, directions = np.linalg.svd((centres - centres.mean(0)) @ whiten, full_matrices=False)
        axes, bias = whiten @ directions[: len(classes) - 1].T, -0.5 * (centres.T * weights).sum(0)
        return cls(classes, mean, scale, weights, bias, axes)

    def __call__(self, features: np.ndarray) -> list[str]:
        """The likeliest class of each of N descriptors."""
        scores = (features - self.mean) / self.scale @ self.weights + self.bias  # N C, log odds
        return [self.classes[index] for index in scores.argmax(1)]

    def embed(self, features: np.ndarray) -> np.ndarray:
        """Coordinates [N, C - 1] in which classes lie apart, in deviations within a class."""
        return np.asarray((features - self.mean) / self.scale @ self.axes)


@dataclass(frozen=True, eq=False)
class ActionRecognizer:
    """The discriminant, and kinematics where captured clips bear them out."""

    judge: ActionJudge  # fitted on every clip
    # actions that are shown too where `metrics.measurements.ACTIONS` says so: a share MIN_RECALL of
    # their captured clips pass, and MAX_FALSE at most of those of others
    kinematic: frozenset[str]
    # actions of which MIN_RECALL of the captured clips pass, whatever else does
    necessary: frozenset[str]
    # share of an action's clips recognised, the discriminant fitted on other takes each time
    recall: dict[str, float]
    false_alarms: dict[str, float]  # share of the clips of other actions that pass for it, likewise

    @classmethod
    def fit(
        cls, records: Sequence[ClipRecord], motions: Sequence[Motion], features: np.ndarray
    ) -> "ActionRecognizer":
        """Of N clips with a tag each, their motions and descriptors [N, F].
        Raises ValueError: fewer than two actions, NaN or infinity."""
        tags, takes = [r.tag for r in records], [r.take for r in records]
        judge = ActionJudge.fit(features, tags)
        seen = np.array(_of_unseen_takes(features, tags, takes), object)
        few = sorted(row for own in rows_of_each(tags).values() for row in own[:WITNESS_CLIPS])
        figures = {row: measure(motions[row]) for row in few}
        kinematic, necessary = set[str](), set[str]()
        recall, false_alarms = dict[str, float](), dict[str, float]()
        for action in judge.classes:
            own = np.array([same_action(action, tags[row]) for row in few])
            said = np.array([same_action(action, seen[row]) for row in few])
            performs: Check = ACTIONS.get(action, lambda _: False)
            shown = np.array([performs(figures[row]) for row in few])
            if shown[own].mean() >= MIN_RECALL:
                necessary.add(action)
                if shown[~own].mean() <= MAX_FALSE:
                    kinematic.add(action)
                    said |= shown
            recall[action] = float(said[own].mean())
            false_alarms[action] = float(said[~own].mean())
        return cls(judge, frozenset(kinematic), frozenset(necessary), recall, false_alarms)

    def shows(self, action: str, found: str, motion: Motion) -> bool:
        """Whether a motion, in which the discriminant found an action, shows this one."""
        if same_action(action, found):
            return True
        return action in self.kinematic and ACTIONS[action](measure(motion))


def _of_unseen_takes(features: np.ndarray, tags: Sequence[str], takes: Sequence[str]) -> list[str]:
    """What discriminants that were fitted on other takes find in each clip [N, F]."""
    order = {take: row for row, take in enumerate(dict.fromkeys(takes))}
    fold, names = np.array([order[take] % FOLDS for take in takes]), np.array(tags)
    found = [""] * len(names)
    for part in set(fold.tolist()):
        rest = fold != part
        if len(set(names[rest])) < 2:
            continue
        said = ActionJudge.fit(features[rest], names[rest].tolist())(features[~rest])
        for row, name in zip(np.flatnonzero(~rest), said, strict=True):
            found[row] = name
    return found


# ---------------------------------------------------------------- what counts as done


def rested(values: Tensor, frames: int) -> Tensor | None:
    """A gesture [T,23,6] longer than so many frames from rest to rest within them, as in training;
    None where there is nothing to leave out."""
    return shorten(values, frames) if len(values) > frames and comes_back(values) else None


def as_asked(values: Tensor, frames: int) -> Motion:
    """A clip [T,23,6] as a request of so many frames asks for it: a gesture from rest to rest, the
    first frames of all else."""
    whole = rested(values, frames)
    return decode_features(values[:frames] if whole is None else whole)


def examples(
    data: PreparedData, records: Sequence[ClipRecord], frames: int
) -> tuple[list[ClipRecord], list[Motion]]:
    """What a judge learns from: the first frames of clips, and gestures from rest to rest, too: of
    waves that are always cut off it would learn that an arm which comes down was only raised."""
    owners, motions = list[ClipRecord](), list[Motion]()
    for record in records:
        values = data.features(record)
        for part in (values[:frames], rested(values, frames)):
            if part is not None:
                owners.append(record)
                motions.append(decode_features(part))
    return owners, motions


def judged_by(records: Sequence[ClipRecord]) -> list[ClipRecord]:
    """The clips that tell a judge what actions look like: captured, where an action has any."""
    captured = {r.tag for r in records if r.provenance == "captured"}
    return [r for r in records if r.provenance == "captured" or r.tag not in captured]


def same_action(wanted: str, found: str) -> bool:
    """Whether two names stand for one action."""
    return wanted == found or {wanted, found} in TWINS


def shown(parts: Sequence[dict[str, str]], motion: Motion) -> bool:
    """Whether direction, turn, side, count and angle are those of the labels, as far as asked; of
    several `parts` done at once, a hand that is up need not be higher than the other."""
    measured, other = measure(motion), {"left": "right", "right": "left"}
    for labels in parts:
        rest = [part.get("side") for part in parts if part is not labels]
        side, answers = labels.get("side", ""), check(labels, measured)
        if f"{side}-hand" in answers and {other.get(side), "both"} & {*rest}:
            answers[f"{side}-hand"] = CHECKS[f"{side}-hand-too"](measured)
        if not all(value for name, value in answers.items() if name in SHOWN):
            return False
    return True


# ---------------------------------------------------------------- how reliably actions come out


class Generator(Protocol):
    """What is asked of a model; `SentenceGenerator` is one."""

    def generate(
        self,
        prompts: Sequence[str],
        *,
        seconds: float | Sequence[float],
        seed: int,
        steps: int | None = None,
    ) -> list[Motion]: ...


def recognizer_of(
    data: PreparedData, seed: int = 0, progress: Progress = lambda text: None
) -> ActionRecognizer:
    """A judge fitted on the training clips.
    Raises UserError: fewer than two actions to tell apart."""
    clips = spread_over_groups(judged_by(_captioned(data)), JUDGING_CLIPS, seed)
    progress(f"a judge of {len(clips)} clips")
    if len({record.tag for record in clips}) < 2:
        raise UserError(
            f"{data.folder}: a judge tells labelled actions apart and needs two or more; prepare"
            " the clips once more with others, or with procedural ones (`--synthetic 300`)"
        )
    clips, seen = examples(data, clips, round(SECONDS * 30))
    try:
        return ActionRecognizer.fit(clips, seen, np.stack([*map(descriptor, seen)]))
    except ValueError as error:
        raise UserError(
            f"{data.folder}: no judge can be fitted ({error}); prepare clips of labelled actions"
        ) from error


def action_reliability(
    model: Generator,
    data: PreparedData,
    judge: ActionRecognizer,
    *,
    tries: int = 12,
    seed: int = 0,
    kept: Path | None = None,
    progress: Progress = lambda text: None,
) -> dict[str, float]:
    """Share of `tries` in which each action of the training clips was shown: (successes + 1) /
    (tries + 2), the mean of the posterior under a uniform prior (Laplace), as one try tells little.
    The next call goes on from the file `kept`; another model or judge needs another one."""
    train = _captioned(data)
    asked = []
    for _, rows in sorted(rows_of_each(record.tag for record in train).items()):
        own = spread_over_groups([train[row] for row in rows], tries, seed)
        for draw, record in enumerate(islice(cycle(own), tries), start=seed):
            captions = {code: texts for code, texts in data.captions(record).items() if texts}
            code = sorted(captions)[draw % len(captions)]  # the languages in turn
            asked.append((record, choose_caption(captions[code], f"{record.id}{draw}", draw)))
    right: list[bool] = []
    with suppress(OSError, UserError, ValueError):  # what is kept may be of no use
        known = load_json(kept) if kept is not None else []
        if isinstance(known, list) and len(known) <= len(asked):
            right = known if all(isinstance(one, bool) for one in known) else []
    for at in range(len(right), len(asked), SENTENCES):
        progress(f"{at} of {len(asked)} sentences")
        part = asked[at : at + SENTENCES]
        motions = model.generate([text for _, text in part], seconds=SECONDS, seed=seed + at)
        found = judge.judge(np.stack([*map(descriptor, motions)]))
        for (record, _), motion, action in zip(part, motions, found, strict=True):
            labels = {key: v for key, v in record.labels.items() if key not in MEASURES}
            done = judge.shows(record.tag, action, motion) and shown([labels], motion)
            right.append(bool(done))
        if kept is not None:
            write_json(kept, right)
    shares: dict[str, list[bool]] = defaultdict(list)
    for (record, _), done in zip(asked, right, strict=True):
        shares[record.tag].append(done)
    return {tag: (sum(done) + 1) / (len(done) + 2) for tag, done in shares.items()}


def _captioned(data: PreparedData) -> list[ClipRecord]:
    """Training clips of a labelled action, long enough, with words."""
    train = [r for r in data.records("train") if r.tag and r.num_frames >= MIN_FRAMES]
    return [r for r in train if any(data.captions(r).values())]


# ---------------------------------------------------------------- what an instruction asks

ANGLE_WITHIN = 20.0  # degrees


def _names(labels: dict[str, str]) -> list[str]:
    """Checks that a label set calls for."""
    action, direction = labels.get("action", ""), labels.get("direction", "")
    side, turn = labels.get("side", ""), labels.get("turn", "")
    if action in ("walk", "run", "side-step", "crouch-walk"):
        names = [direction] if direction in CHECKS else []
        names += {"run": ["run"], "crouch-walk": ["crouched"]}.get(action, [])
        return names + ([f"turn-{turn}"] if turn else [])
    if action in ("turn", "spin"):
        return [*([f"turn-{direction}"] if direction else []), "in-place"]
    if action in ("wave", "raise"):
        names = ["both-hands" if side == "both" else f"{side}-hand"] if side else []
        return names + (["wave"] if action == "wave" else [])
    if action in ("kick", "punch"):
        return [f"{action}-{side}"] if side in ("left", "right") else []
    if action == "jump":
        return ["jump", *(["forward-jump"] if direction == "forward" else [])]
    return [action] if action in CHECKS else []


def speed_class(labels: dict[str, str], m: Measurements) -> str | None:
    """ "slow", "normal" or "fast" by the synthetic source's speeds, None where it has none."""
    speeds = SPEED_METRES.get((labels.get("action", ""), labels.get("direction", "")))
    if speeds is None:
        return None
    borders = [(low * high) ** 0.5 for low, high in pairwise(speeds)]
    return SPEEDS[sum(m.cruise > border for border in borders)]


def check(labels: dict[str, str], motion: Motion | Measurements) -> dict[str, bool]:
    """What the labels ask for → whether the motion does it: names in `CHECKS`, "count" (of
    repetitions, exactly), "speed" (the class) and "angle" (within 20°). Labels that cannot be
    measured (style, unknown actions) ask for nothing."""
    m = motion if isinstance(motion, Measurements) else measure(motion)
    answers = {name: CHECKS[name](m) for name in _names(labels)}
    count = repetitions(labels.get("action", ""), m, labels.get("side"))
    if "count" in labels and count is not None:
        answers["count"] = credible(m) and count == int(labels["count"])
    if "speed" in labels and (speed := speed_class(labels, m)) is not None:
        answers["speed"] = credible(m) and speed == labels["speed"]
    if "angle" in labels:
        off = abs(math.degrees(m.yaw)) - float(labels["angle"])
        answers["angle"] = credible(m) and abs(off) < ANGLE_WITHIN
    return answers
