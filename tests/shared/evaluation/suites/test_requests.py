"""The yardstick on models whose score is known: one that obeys, a deaf one, a still one."""

from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from src.shared.data.captions.requests import Request, load_requests
from src.shared.data.prepare import prepare
from src.shared.data.prepared import PreparedData
from src.shared.data.sources import SyntheticSource
from src.shared.data.synthetic.clips import generate_clip, label_combinations, spec_for
from src.shared.errors import UserError
from src.shared.evaluation.suites.requests import LONG_WALKS, Requests, evaluate_requests
from src.shared.evaluation.suites.yardstick import RequestSettings, Yardstick
from src.shared.evaluation.tables import Grid
from src.shared.motion.motion import Motion

SETTINGS = RequestSettings(
    wordings=1, languages=("en",), seconds=3.0, max_clips=60, min_matches=1, steps=3
)
CAPTURED = {"walk", "run", "wave", "squat", "bow", "kick", "raise", "clap"}


@pytest.fixture(scope="module")
def data(tmp_path_factory: pytest.TempPathFactory) -> PreparedData:
    """Synthetic clips, half of which pass for captured ones."""
    folder = tmp_path_factory.mktemp("prepared")
    prepare([SyntheticSource(160)], folder, workers=1)
    prepared = PreparedData.open(folder)
    records = [
        replace(record, provenance="captured") if record.tag in CAPTURED and row % 4 < 2 else record
        for row, record in enumerate(prepared.records())
    ]
    prepared.__dict__["_all_records"] = records
    return prepared


class Puppet:
    """Shows what the labels of a request say, or those of another one."""

    def __init__(self, *, deaf: bool = False) -> None:
        self.lengths: set[tuple[str, float]] = set()  # seconds asked for, of each prompt
        self.steps: set[int | None] = set()
        requests = load_requests(("en",))
        self.asked = {request.text: request for request in requests}
        others = [request for request in requests if request.action in CAPTURED]
        self.other = others[:: max(1, len(others) // 7)] if deaf else []

    def generate(
        self,
        prompts: Sequence[str],
        *,
        seconds: float | Sequence[float],
        seed: int,
        steps: int | None = None,
    ) -> list[Motion]:
        self.steps.add(steps)
        long = seconds if isinstance(seconds, Sequence) else [seconds] * len(prompts)
        self.lengths |= {*zip(prompts, long, strict=True)}
        return [self._motion(prompt, row, long[row]) for row, prompt in enumerate(prompts)]

    def _motion(self, prompt: str, row: int, seconds: float) -> Motion:
        request = self.asked.get(prompt, Request(prompt, "en", "plain", ({"action": "walk"},)))
        if self.other:
            request = self.other[row % len(self.other)]
        known = {key: v for key, v in request.labels.items() if key in ("action", "side")}
        fitting = [labels for labels in label_combinations() if known.items() <= labels.items()]
        labels = fitting[0] if request.action in CAPTURED and fitting else {"action": "stand"}
        clip = generate_clip(spec_for(labels, row), seed=row)
        return clip.frames(0, round(seconds * clip.fps))

    def scope_warnings(self, prompts: Sequence[str]) -> list[str | None]:
        known = {*CAPTURED, "stand"}
        return [None if self.asked[prompt].action in known else "far" for prompt in prompts]

    def missed(self, prompt: str, motion: Motion) -> str | None:
        return None


@pytest.fixture(scope="module")
def puppet() -> Puppet:
    """The one that `tables` are of."""
    return Puppet()


@pytest.fixture(scope="module")
def tables(data: PreparedData, puppet: Puppet) -> dict[str, Grid]:
    report = evaluate_requests(puppet, data, floors={"deaf": Puppet(deaf=True)}, settings=SETTINGS)
    return {grid["name"]: Grid.from_dict(grid) for grid in report["tables"]}


def test_who_obeys_stands_above_the_deaf_and_the_still(tables: dict[str, Grid]) -> None:
    obeyed = tables["obeyed"]
    by_action = [tables["actions"].value(action, "obeyed") for action in sorted(CAPTURED)]
    assert np.mean(by_action) > 0.7
    assert obeyed.value("captured, held out", "all") > 0.7
    assert obeyed.value("deaf", "all") < 0.35 < obeyed.value("generated", "all")
    assert obeyed.value("frozen pose", "all") < 0.35
    assert obeyed.value("generated", "en") == obeyed.value("generated", "all")
    assert obeyed.value("generated, for another action", "all") < 0.2


def test_distances_grow_where_nothing_moves(tables: dict[str, Grid]) -> None:
    realism = tables["realism"]
    for column in ("learned", "kinematic"):
        near, far = (realism.value(row, column) for row in ("captured, held out", "frozen pose"))
        assert far > 2 * near
        assert far > realism.value("captured, looked up in training", column)
    assert 0 <= realism.value("generated", "procedural") <= 1


def test_more_requests_do_not_hold_captured_clips_against_themselves(data: PreparedData) -> None:
    suite = Requests(Puppet(), data, SETTINGS, lambda text: None)
    labels = [request.labels for request in suite.plain]
    few, many = (
        suite._distances(labels * times, [suite.real], suite.records)["learned"]
        for times in (1, 30)
    )
    assert many.value > 0.25 * few.value > 0  # type: ignore[union-attr]


def test_distances_compare_motions_of_the_lengths_of_captured_clips(
    data: PreparedData, puppet: Puppet, tables: dict[str, Grid]
) -> None:
    yardstick = Yardstick(data, SETTINGS, lambda text: None)
    assert puppet.steps == {SETTINGS.steps}  # each time
    usual = {SETTINGS.seconds, *LONG_WALKS, 4.0}
    others = [(puppet.asked[prompt], s) for prompt, s in puppet.lengths if s not in usual]
    assert len(others) > 2
    for request, seconds in others:
        rows = yardstick.references(request.labels)
        assert seconds in {yardstick.real.motions[row].seconds for row in rows}


@pytest.mark.parametrize(
    ("changes", "told"),
    [
        ({"provenance": "procedural"}, "holds no captured clip back from training, and 2"),
        ({"tag": ""}, "of which [0-9]+ have no action label; label them"),
        ({"tag": "swim"}, "of which [0-9]+ an action that no captured clip of training shows"),
        ({"num_frames": 9}, "of which [0-9]+ fewer than [0-9]+ frames; .*longer ones"),
    ],
)
def test_why_there_are_too_few_clips_is_told(
    data: PreparedData, tmp_path: Path, changes: dict[str, Any], told: str
) -> None:
    few = PreparedData.open(data.folder)
    few.__dict__["_all_records"] = [
        record if record.split == "train" else replace(record, **changes)
        for record in data.records()
    ]
    with pytest.raises(UserError, match=told) as raised:
        Yardstick(few, SETTINGS, lambda text: None)
    assert "\n" not in str(raised.value)


def test_warnings_are_held_against_what_went_wrong(tables: dict[str, Grid]) -> None:
    warned = tables["warnings"]
    assert warned.value("outside the vocabulary", "share") == 1.0
    assert warned.value("plain, obeyed", "share") == 0.0
    parts = ("right", "wrong but warned of", "wrong without a word")
    assert sum(warned.value(f"free prompts, {part}", "share") for part in parts) == pytest.approx(1)


def test_every_action_the_judge_knows_has_a_row(tables: dict[str, Grid]) -> None:
    assert tables["actions"].rows.keys() >= CAPTURED
    assert tables["actions"].rows["walk"].cells["source"] == "captured"
    assert tables["actions"].rows["punch"].cells["source"] == "not captured"
    assert (
        tables["actions"].value("walk", "recall") > 0.7 > tables["actions"].value("walk", "false")
    )
    exact = tables["exactness"]
    assert {"counts", "a walk of 10 s, m/s"} <= exact.rows.keys()
    order, chance = "one-sentence sequences", "the same, for another sequence"
    assert exact.value(order, "share") >= exact.value(chance, "share")
    rests, gestures = "gestures from rest to rest", "the same, and obeyed"
    assert exact.value(gestures, "share") <= exact.value(rests, "share")
    assert exact.value("gestures: turned by, degrees", "share") < 45


def test_data_without_captured_clips_is_refused(tmp_path: Path) -> None:
    prepare([SyntheticSource(8)], tmp_path, workers=1)
    with pytest.raises(UserError, match="captured"):
        evaluate_requests(Puppet(), PreparedData.open(tmp_path), settings=SETTINGS)
