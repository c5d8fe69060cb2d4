"""How reliably each action comes out when a model is asked for it.

The judge (`action_judge.py`) learned from the training clips, and the sentences are training
captions: what is left to chance is the motion alone.
"""

from collections import defaultdict
from typing import Protocol

import numpy as np

from ..data.prepared import ClipRecord, PreparedData
from ..errors import UserError
from ..motion.features import decode_features
from ..motion.motion import Motion
from .action_judge import ActionJudge, descriptor
from .held_out import choose_caption, spread_over_groups
from .yardstick import MIN_FRAMES, Progress, judged_by, same_action, shown

JUDGING_CLIPS = 2_400
SECONDS = 4.0
BATCH = 32  # sentences


class Model(Protocol):
    """What is asked of a model; `SentenceGenerator` is one."""

    def generate(self, prompts: list[str], *, seconds: float, seed: int) -> list[Motion]: ...


def action_reliability(
    model: Model,
    data: PreparedData,
    *,
    tries: int = 12,
    seed: int = 0,
    progress: Progress = lambda text: None,
) -> dict[str, float]:
    """Share of `tries` in which each action of the training clips was shown.

    (successes + 1) / (tries + 2), the mean of the posterior under a uniform prior (Laplace): one
    try tells little.

    Raises:
        UserError: fewer than two actions to tell apart.
    """
    train = [r for r in data.records("train") if r.tag and r.num_frames >= MIN_FRAMES]
    clips = spread_over_groups(judged_by(train), JUDGING_CLIPS, seed)
    progress(f"a judge of {len(clips)} clips")
    seen = [decode_features(data.features(r)[: round(SECONDS * 30)]) for r in clips]
    try:
        judge = ActionJudge.fit(np.stack([*map(descriptor, seen)]), [r.tag for r in clips])
    except ValueError as error:
        raise UserError(
            f"{data.folder}: no judge can be fitted ({error}); prepare clips of labelled actions"
        ) from error
    asked = [
        (record, _caption(data, record, seed + row))
        for tag, own in sorted(_by_tag(train).items())
        for row, record in enumerate(_several(spread_over_groups(own, tries, seed), tries))
    ]
    shares: dict[str, list[bool]] = defaultdict(list)
    for at in range(0, len(asked), BATCH):
        progress(f"{at} of {len(asked)} sentences")
        part = asked[at : at + BATCH]
        motions = model.generate([text for _, text in part], seconds=SECONDS, seed=seed + at)
        found = judge(np.stack([*map(descriptor, motions)]))
        for (record, _), motion, action in zip(part, motions, found, strict=True):
            right = same_action(record.tag, action) and shown(record.labels, motion)
            shares[record.tag].append(right)
    return {tag: (sum(done) + 1) / (len(done) + 2) for tag, done in shares.items()}


def _by_tag(records: list[ClipRecord]) -> dict[str, list[ClipRecord]]:
    found: dict[str, list[ClipRecord]] = defaultdict(list)
    for record in records:
        found[record.tag].append(record)
    return found


def _several(records: list[ClipRecord], num: int) -> list[ClipRecord]:
    return [records[row % len(records)] for row in range(num)]


def _caption(data: PreparedData, record: ClipRecord, seed: int) -> str:
    """One of the captions of a clip, in a language that goes round with the seed."""
    captions = {code: texts for code, texts in data.captions(record).items() if texts}
    code = sorted(captions)[seed % len(captions)]
    return choose_caption(captions[code], f"{record.id}{seed}", seed)
