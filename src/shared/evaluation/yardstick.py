"""What hand-written requests are measured by: captured clips, and a judge that learned from them.

The judge (`action_judge.py`) has seen no procedural clip of an action that a capture covers.

Letters: N motions, T frames, K joints, F features.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np

from ..data.captions.requests import Request
from ..data.prepared import ClipRecord, PreparedData
from ..errors import UserError
from ..metrics.kinetic import FeatureSpace, kinetic_features
from ..metrics.physical import support_slide
from ..motion.features import decode_features
from ..motion.motion import Motion
from ..motion.skeleton import JOINT_INDEX
from .action_judge import ActionJudge, descriptor
from .controllability import check
from .held_out import spread_over_groups
from .stats import Estimate, bootstrap_mean
from .suites.text import LANGUAGES

Progress = Callable[[str], None]
TWINS = ({"wave", "bye"},)  # one gesture under two names
HAND_DOWN = 0.15  # metres above the pelvis, at most, of a hand at rest
AT_REST = 3  # frames at either end
PIECE, HOP = 60, 15  # frames: windows in which the parts of a composition are looked for
MIN_FRAMES = 24
SHOWN = frozenset(
    (
        *("forward", "backward", "left", "right", "turn-left", "turn-right"),
        *("left-hand", "right-hand", "both-hands"),
        *("kick-left", "kick-right", "punch-left", "punch-right", "count", "angle"),
    )
)  # checks of which way, which side and how much; which action it is the judge says


@dataclass(frozen=True)
class RequestSettings:
    """How much is measured; the report repeats it."""

    wordings: int = 3  # of each set of labels and language
    languages: tuple[str, ...] = LANGUAGES
    seconds: float = 4.0
    variety_seeds: int = 8  # of the spread of gestures
    max_clips: int = 600  # captured clips of the reference
    seed: int = 0


@dataclass(frozen=True, eq=False)
class Seen:
    """N motions with what is measured of each: descriptors [N,F]."""

    motions: list[Motion]
    features: np.ndarray

    @classmethod
    def of(cls, motions: Sequence[Motion]) -> "Seen":
        return cls(list(motions), np.stack([descriptor(motion) for motion in motions]))

    def __len__(self) -> int:
        return len(self.motions)

    def rows(self, index: Sequence[int]) -> "Seen":
        return Seen([self.motions[i] for i in index], self.features[list(index)])


class Yardstick:
    """Captured clips, the judge that learned from them, and the clips nobody recorded."""

    def __init__(self, data: PreparedData, settings: RequestSettings, progress: Progress) -> None:
        """Read the clips and fit the judge.

        Raises:
            UserError: too few captured clips are held back.
        """
        self.data, self.settings = data, settings
        self.longest = round(settings.seconds * 30)
        train = [r for r in data.records("train") if r.tag and r.num_frames >= MIN_FRAMES]
        self.captured = {r.tag for r in train if r.provenance == "captured"}
        progress("descriptors of the training clips")
        fitted = spread_over_groups(judged_by(train), 4 * settings.max_clips, settings.seed)
        self.known = self.clips(fitted)
        self.known_tags = [record.tag for record in fitted]
        try:
            self.judge = ActionJudge.fit(self.known.features, self.known_tags)
        except ValueError as error:
            raise UserError(
                f"{data.folder}: no judge can be fitted ({error}); prepare captured clips"
            ) from error
        self.space = FeatureSpace.fit(self.known.features, np.zeros(self.known.features.shape[1]))
        held = [
            r
            for split in ("test_seen", "test_unseen", "val")
            for r in data.records(split)
            if r.provenance == "captured" and r.tag in self.captured and r.num_frames >= MIN_FRAMES
        ]
        if len(held) < 2:
            raise UserError(
                f"{data.folder} holds no captured clip back from training; prepare more of them"
            )
        progress("descriptors of the held-out clips")
        self.records = spread_over_groups(held, settings.max_clips, settings.seed)
        self.real = self.clips(self.records)
        made = [r for r in train if r.provenance == "procedural" and r.tag in self.captured]
        made = spread_over_groups(made, settings.max_clips, settings.seed)
        self.procedural = self.clips(made) if made else None
        self.procedural_tags = [record.tag for record in made]
        pairs = zip(self.real.motions, self.records, strict=True)
        runs = [worst_acceleration(motion) for motion, record in pairs if record.tag == "run"]
        self.top_run = float(np.percentile(np.concatenate(runs), 99.9)) if runs else 0.0

    def clips(self, records: Sequence[ClipRecord]) -> Seen:
        """The first seconds of these clips."""
        return Seen.of([decode_features(self.data.features(r)[: self.longest]) for r in records])

    def shows(self, seen: Seen) -> list[str]:
        """The action that the judge sees in each."""
        return self.judge(seen.features)

    def obeyed(self, labels: Sequence[dict[str, str]], seen: Seen) -> np.ndarray:
        """Whether each motion does what its labels say: the action, and which way or side [N]."""
        found = self.shows(seen)
        return np.array(
            [
                same_action(wanted.get("action", ""), action) and shown(wanted, motion)
                for wanted, action, motion in zip(labels, found, seen.motions, strict=True)
            ]
        )

    def nearer_to_procedural(self, tags: Sequence[str], seen: Seen) -> np.ndarray:
        """Whether the nearest clip of the action is one that nobody recorded; NaN without any."""
        if self.procedural is None:
            return np.full(len(seen), np.nan)
        own = self.space(seen.features)
        captured, made = self.space(self.known.features), self.space(self.procedural.features)
        answers = []
        for tag, point in zip(tags, own, strict=True):
            distances = [
                np.linalg.norm(there[[t == tag for t in theirs]] - point, axis=1)
                for there, theirs in (
                    (captured, self.known_tags),
                    (made, self.procedural_tags),
                )
            ]
            both = all(len(each) for each in distances)
            answers.append(float(distances[1].min() < distances[0].min()) if both else np.nan)
        return np.array(answers)


def judged_by(records: Sequence[ClipRecord]) -> list[ClipRecord]:
    """The clips that tell a judge what actions look like: captured, where an action has any."""
    captured = {r.tag for r in records if r.provenance == "captured"}
    return [r for r in records if r.provenance == "captured" or r.tag not in captured]


def same_action(wanted: str, found: str) -> bool:
    """Whether two names stand for one action."""
    return wanted == found or {wanted, found} in TWINS


def shown(labels: dict[str, str], motion: Motion) -> bool:
    """Whether direction, turn, side, count and angle are those of the labels, as far as asked."""
    answers = check({key: value for key, value in labels.items() if key != "speed"}, motion)
    return all(value for name, value in answers.items() if name in SHOWN)


def spread(motions: Sequence[Motion]) -> float:
    """Deviation of the joints, seen from the pelvis, over motions of two seconds or more; cm."""
    joints = np.stack([motion.positions()[:PIECE] for motion in motions])
    deviation: np.ndarray = (joints - joints[:, :, :1]).std(0)  # T K 3
    return float(100 * np.linalg.norm(deviation, axis=-1).mean())


def gaits(seen: Seen, tags: Sequence[str], top_run: float) -> dict[str, Estimate]:
    """How walks and runs move: peak acceleration m/s², frames beyond `top_run` %, slide cm/s."""
    pairs = list(zip(seen.motions, tags, strict=True))
    walks = [motion for motion, tag in pairs if tag == "walk"]
    runs = [motion for motion, tag in pairs if tag == "run"]
    return {
        "peak": bootstrap_mean([float(np.percentile(worst_acceleration(m), 99)) for m in walks]),
        "teleports": bootstrap_mean([100 * (worst_acceleration(m) > top_run).mean() for m in runs]),
        "slide": bootstrap_mean(
            [support_slide(m.positions().astype(np.float64), m.fps) for m in walks]
        ),
    }


def kinetic(seen: Seen) -> np.ndarray:
    """Kinetic features [N, 66]."""
    return np.stack([kinetic_features(m.positions(), m.fps).reshape(-1) for m in seen.motions])


def worst_acceleration(motion: Motion) -> np.ndarray:
    """m/s² of the worst joint [T - 2]."""
    second = np.diff(motion.positions().astype(np.float64), n=2, axis=0) * motion.fps**2
    return np.asarray(np.linalg.norm(second, axis=-1).max(1))


def covers(request: Request, motion: Motion) -> bool:
    """Whether a motion ends so many metres from where it began as were asked for, ±20%."""
    way = np.linalg.norm(motion.root_position[-1, [0, 2]] - motion.root_position[0, [0, 2]])
    return bool(abs(way / float(request.labels["metres"]) - 1) <= 0.2)


def mean_speed(motion: Motion) -> float:
    """Of the pelvis over the ground, m/s."""
    way = np.linalg.norm(np.diff(motion.root_position[:, [0, 2]], axis=0), axis=-1).sum()
    return float(way / motion.seconds)


def at_rest(motion: Motion) -> bool:
    """Whether both hands hang at the beginning and at the end."""
    joints = motion.positions()
    hands = joints[:, [JOINT_INDEX["l_wrist"], JOINT_INDEX["r_wrist"]], 1] - joints[:, :1, 1]
    ends = np.concatenate((hands[:AT_REST], hands[-AT_REST:]))
    return bool((ends < HAND_DOWN).all())


def in_order(yardstick: Yardstick, request: Request, motion: Motion) -> bool:
    """Whether the parts are seen one after the other, each in some window of two seconds."""
    starts = range(0, max(motion.num_frames - PIECE, 0) + 1, HOP)
    pieces = Seen.of([motion.frames(at, at + PIECE) for at in starts])
    found, at = yardstick.shows(pieces), 0
    for part in request.parts:
        while at < len(found) and not same_action(part["action"], found[at]):
            at += 1
        if at == len(found):
            return False
    return True
