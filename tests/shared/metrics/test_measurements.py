"""Kinematic definitions of actions: which limb, to which side, how often."""

import pytest

from src.shared.data.synthetic.clips import generate_clip, spec_for
from src.shared.metrics.measurements import ACTIONS, measure, repetitions, side_check

SIDED = {
    "kick": {"action": "kick", "side": "left", "count": "2"},
    "punch": {"action": "punch", "side": "left", "count": "2"},
    "wave": {"action": "wave", "side": "left", "speed": "normal"},
    "turn": {"action": "turn", "direction": "left", "angle": "90"},
}


@pytest.mark.parametrize("action", sorted(SIDED))
def test_a_side_is_that_of_the_limb_or_of_the_turn(action: str) -> None:
    seen = measure(generate_clip(spec_for(SIDED[action], 0), seed=0))
    answers = [side_check(action, side, by_hand=action == "wave") for side in ("left", "right")]
    assert [check is not None and check(seen) for check in answers] == [True, False]
    assert ACTIONS[action](seen)


def test_what_has_no_side_is_not_asked_for_one() -> None:
    assert side_check("walk", "left", by_hand=False) is None
    assert side_check("kick", "both", by_hand=False) is None


@pytest.mark.parametrize("action", ["kick", "punch"])
def test_repetitions_are_those_of_the_limb_or_of_both(action: str) -> None:
    seen = measure(generate_clip(spec_for(SIDED[action], 0), seed=0))
    assert repetitions(action, seen) == repetitions(action, seen, "left") == 2
    assert repetitions(action, seen, "right") == 0
    assert repetitions("walk", seen) is None
