"""Captured clips as the measure of motions that people asked for, and the judge they taught.

Letters: N motions, F features.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from itertools import chain

import numpy as np

from ...data.captions.requests import Request
from ...data.prepared import ClipRecord, PreparedData
from ...errors import UserError
from ...metrics.kinetic import FeatureSpace, kinetic_features
from ...metrics.physical import worst_acceleration
from ...motion.motion import Motion
from ..actions import MIN_FRAMES, ActionRecognizer, as_asked, descriptor, examples, judged_by, shown
from ..engine import Progress
from ..samples import spread_over_groups
from .text import LANGUAGES

LENGTHS = 1 << 16  # of the draws of one seed, the one of lengths: no distance is of it


@dataclass(frozen=True)
class RequestSettings:
    """How much is measured; the report repeats it."""

    wordings: int = 3  # of each set of labels and language
    languages: tuple[str, ...] = LANGUAGES
    seconds: float = 4.0
    variety_seeds: int = 8  # of the spread of gestures
    max_clips: int = 600  # captured clips of the reference
    min_matches: int = 10  # held-out clips with a request's labels, to take part in distances
    seed: int = 0
    steps: int | None = None  # of sampling; None = the model's own


@dataclass(frozen=True, eq=False)
class Seen:
    """N motions with what is measured of each: descriptors [N,F]."""

    motions: list[Motion]
    features: np.ndarray

    @classmethod
    def of(cls, motions: Sequence[Motion]) -> "Seen":
        """Of motions not measured yet."""
        return cls(list(motions), np.stack([descriptor(motion) for motion in motions]))

    def __len__(self) -> int:
        return len(self.motions)

    def rows(self, index: Sequence[int]) -> "Seen":
        """The motions at these rows, in this order."""
        return Seen([self.motions[i] for i in index], self.features[list(index)])


@dataclass(frozen=True, eq=False)
class Asked:
    """A row of the first tables: motions and what each was asked for."""

    requests: Sequence[Request]
    seen: Seen

    @property
    def labels(self) -> list[dict[str, str]]:
        """What each was asked for."""
        return [request.labels for request in self.requests]

    @property
    def actions(self) -> list[str]:
        """The action that each was asked for."""
        return [request.action for request in self.requests]


def too_few(kept: Sequence[ClipRecord], known: set[str]) -> str:
    """Why captured clips held back from training are not enough to measure by, and what to do."""
    foreign = [r for r in kept if r.tag and r.tag not in known]
    faults = {
        "have no action label": sum(not r.tag for r in kept),
        "an action that no captured clip of training shows": len(foreign),
        f"fewer than {MIN_FRAMES} frames": sum(r.num_frames < MIN_FRAMES for r in kept),
    }
    if not any(faults.values()):
        held = f"{len(kept)} captured clip" if kept else "no captured clip"
        return f"holds {held} back from training, and 2 are needed; prepare more of them"
    named = ", ".join(f"{number} {what}" for what, number in faults.items() if number)
    return (
        f"holds {len(kept)} captured clips back from training, of which {named}; label them"
        " (column action of the captions, or label rules), and prepare longer ones where they are"
        " short"
    )


class Yardstick:
    """Captured clips, the judge that learned from them, and the clips nobody recorded."""

    def __init__(self, data: PreparedData, settings: RequestSettings, progress: Progress) -> None:
        """Read the clips and fit the judge.
        Raises UserError: too few captured clips are held back."""
        self.data, self.settings = data, settings
        self.longest = round(settings.seconds * 30)
        train = [r for r in data.records("train") if r.tag and r.num_frames >= MIN_FRAMES]
        self.captured = {r.tag for r in train if r.provenance == "captured"}
        progress("descriptors of the training clips")
        chosen = spread_over_groups(judged_by(train), 4 * settings.max_clips, settings.seed)
        fitted, motions = examples(data, chosen, self.longest)
        self.known, self.known_records = Seen.of(motions), fitted
        try:
            self.recognizer = ActionRecognizer.fit(fitted, self.known.motions, self.known.features)
        except ValueError as error:
            raise UserError(
                f"{data.folder}: no judge can be fitted ({error}); prepare captured clips"
            ) from error
        self.judge = self.recognizer.judge
        self.space = FeatureSpace.fit(self.known.features, np.zeros(self.known.features.shape[1]))
        kept_back = chain.from_iterable(map(data.records, ("test_seen", "test_unseen", "val")))
        kept = [r for r in kept_back if r.provenance == "captured"]
        held = [r for r in kept if r.tag in self.captured and r.num_frames >= MIN_FRAMES]
        if len(held) < 2:
            raise UserError(f"{data.folder} {too_few(kept, self.captured)}")
        progress("descriptors of the held-out clips")
        self.records = spread_over_groups(held, settings.max_clips, settings.seed)
        self.real = self.clips(self.records)
        self.tags = [record.tag for record in self.records]
        made = [r for r in train if r.provenance == "procedural" and r.tag in self.captured]
        made = spread_over_groups(made, settings.max_clips, settings.seed)
        self.procedural = self.clips(made) if made else None
        self.procedural_records = made
        pairs = zip(self.real.motions, self.tags, strict=True)
        runs = [worst_acceleration(motion) for motion, tag in pairs if tag == "run"]
        self.top_run = float(np.percentile(np.concatenate(runs), 99.9)) if runs else 0.0

    def clips(self, records: Sequence[ClipRecord]) -> Seen:
        """These clips as asked for: gestures from rest to rest, the first seconds of others."""
        values = (self.data.features(record) for record in records)
        return Seen.of([as_asked(each, self.longest) for each in values])

    def obeyed(self, labels: Sequence[dict[str, str]], seen: Seen) -> np.ndarray:
        """Whether each motion does what its labels say: the action, and which way or side [N]."""
        rows = zip(labels, self.judge(seen.features), seen.motions, strict=True)
        shows = self.recognizer.shows
        return np.array([shows(w.get("action", ""), f, m) and shown([w], m) for w, f, m in rows])

    @cached_property
    def real_obeyed(self) -> np.ndarray:
        """The same of the held-out clips under their own labels."""
        return self.obeyed([record.labels for record in self.records], self.real)

    def nearer_to_procedural(self, tags: Sequence[str], seen: Seen) -> np.ndarray:
        """Whether the nearest clip of the action is one that nobody recorded; NaN without any."""
        if self.procedural is None:
            return np.full(len(seen), np.nan)
        sources = (self.known, self.known_records), (self.procedural, self.procedural_records)
        points = [(self.space(clips.features), np.array([r.tag for r in records]))
                  for clips, records in sources]  # fmt: skip
        answers = []
        for tag, point in zip(tags, self.space(seen.features), strict=True):
            away = [np.linalg.norm(there[names == tag] - point, axis=1) for there, names in points]
            known = all(map(len, away))
            answers.append(float(away[1].min() < away[0].min()) if known else np.nan)
        return np.array(answers)

    def points(self, seen: Seen) -> tuple[np.ndarray, np.ndarray]:
        """Where motions lie [N, axes] in the judge's axes and [N, 66] in kinetic features."""
        return self.judge.embed(seen.features), self._moving(kinetic(seen))

    @cached_property
    def _moving(self) -> FeatureSpace:
        """Kinetic features in deviations of the held-out clips."""
        values = kinetic(self.real)
        return FeatureSpace.fit(values, np.arange(values.shape[1]) % 3)

    @cached_property
    def real_points(self) -> tuple[np.ndarray, np.ndarray]:
        """Where the held-out clips lie."""
        return self.points(self.real)

    def references(self, labels: dict[str, str]) -> list[int]:
        """The held-out clips of what was asked for, none where there are hardly any."""
        found = answering(labels, self.records)
        return found if len(found) >= self.settings.min_matches else []

    def lengths(self, labels: Sequence[dict[str, str]], draw: int) -> list[float]:
        """Seconds of one of the references of each, drawn: what moves for two seconds of four has
        half the kinetic energy of what is over after two. Raises ValueError where there is none."""
        rng = np.random.default_rng([self.settings.seed, LENGTHS, draw])
        return [self.real.motions[rng.choice(self.references(w))].seconds for w in labels]


def kinetic(seen: Seen) -> np.ndarray:
    """Kinetic features [N, 66]."""
    return np.stack([kinetic_features(m.positions(), m.fps).reshape(-1) for m in seen.motions])


def answering(labels: dict[str, str], records: Sequence[ClipRecord]) -> list[int]:
    """The clips that have all these labels, whatever others they have."""
    return [row for row, record in enumerate(records) if labels.items() <= record.labels.items()]
