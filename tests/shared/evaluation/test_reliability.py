"""Which actions come out: of a puppet that does as it is told, but never jumps."""

import json
from collections.abc import Sequence
from pathlib import Path

import numpy as np
import pytest

from src.shared.data.prepare import prepare
from src.shared.data.prepared import PreparedData
from src.shared.data.sources import SyntheticSource
from src.shared.data.synthetic.clips import generate_clip, spec_for
from src.shared.evaluation.actions import (
    ActionJudge,
    action_reliability,
    descriptor,
    examples,
    recognizer_of,
    rested,
)
from src.shared.model.clip.out_of_domain import RELIABLE
from src.shared.motion.features import decode_features
from src.shared.motion.motion import Motion


@pytest.fixture(scope="module")
def data(tmp_path_factory: pytest.TempPathFactory) -> PreparedData:
    folder = tmp_path_factory.mktemp("prepared")
    prepare([SyntheticSource(140)], folder, workers=1)
    return PreparedData.open(folder)


class Puppet:
    """Does what the caption of a training clip says, and stands where it says to jump."""

    def __init__(self, data: PreparedData) -> None:
        self.labels = {
            text: record.labels
            for record in data.records("train")
            for texts in data.captions(record).values()
            for text in texts
        }

    def generate(self, prompts: Sequence[str], *, seconds: float, seed: int) -> list[Motion]:
        wanted = [self.labels[prompt] for prompt in prompts]
        wanted = [{"action": "stand"} if w["action"] == "jump" else w for w in wanted]
        clips = [generate_clip(spec_for(w, row), seed=row) for row, w in enumerate(wanted)]
        return [clip.frames(0, min(clip.num_frames, round(seconds * clip.fps))) for clip in clips]


def test_what_never_comes_out_is_found(data: PreparedData) -> None:
    judge = recognizer_of(data)
    found = action_reliability(Puppet(data), data, judge, tries=3)
    assert found.keys() == {record.tag for record in data.records("train")}
    assert found["jump"] == 1 / 5  # none of three
    assert found["jump"] < RELIABLE < found["walk"] < 1
    assert json.loads(json.dumps(found)) == found


def test_what_was_found_is_not_asked_again(data: PreparedData, tmp_path: Path) -> None:
    judge, kept = recognizer_of(data), tmp_path / "kept.json"
    whole = action_reliability(Puppet(data), data, judge, tries=4)

    class Mortal(Puppet):
        def __init__(self, data: PreparedData, parts: int) -> None:
            super().__init__(data)
            self.parts = parts

        def generate(self, prompts: Sequence[str], *, seconds: float, seed: int) -> list[Motion]:
            self.parts -= 1
            if self.parts < 0:
                raise KeyboardInterrupt
            return super().generate(prompts, seconds=seconds, seed=seed)

    with pytest.raises(KeyboardInterrupt):
        action_reliability(Mortal(data, 1), data, judge, tries=4, kept=kept)
    told: list[str] = []
    again = action_reliability(Puppet(data), data, judge, tries=4, kept=kept, progress=told.append)
    assert again == whole and told[0].startswith("32 of ")
    assert action_reliability(Mortal(data, 1), data, judge, tries=4, kept=kept) == whole
    for useless in ("{}", '["yes"]', "not JSON", json.dumps([True] * 9999)):
        kept.write_text(useless)
        told.clear()
        with pytest.raises(KeyboardInterrupt):
            action_reliability(
                Mortal(data, 0), data, judge, tries=4, kept=kept, progress=told.append
            )
        assert told[0].startswith("0 of ")


def test_without_actions_to_tell_apart_it_says_so(data: PreparedData, tmp_path: Path) -> None:
    from src.shared.errors import UserError

    prepare([SyntheticSource(4)], tmp_path, workers=1)
    few = PreparedData.open(tmp_path)
    few.__dict__["_all_records"] = few.records()[:1]
    with pytest.raises(UserError, match=r"needs two or more; .*--synthetic"):
        recognizer_of(few)


def test_a_wave_that_comes_to_rest_in_time_is_no_raised_arm(data: PreparedData) -> None:
    frames = 75
    train = [r for r in data.records("train") if r.tag in ("wave", "raise")]
    records, motions = examples(data, train, frames)
    judge = ActionJudge.fit(np.stack([*map(descriptor, motions)]), [r.tag for r in records])
    long = [r for r in data.records("train") if r.tag == "wave" and r.num_frames > frames]
    whole = [rested(data.features(record), frames) for record in long]
    waves = [decode_features(values) for values in whole if values is not None]
    assert len(waves) >= 5
    assert judge(np.stack([*map(descriptor, waves)])).count("wave") >= 0.8 * len(waves)
    assert len(motions) > len(train)  # cut off, and from rest to rest
