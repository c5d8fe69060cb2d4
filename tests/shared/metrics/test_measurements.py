"""Kinematic definitions of actions: which limb, to which side, how often."""

import math

import numpy as np
import pytest

from src.shared.data.synthetic.clips import generate_clip, spec_for
from src.shared.metrics.measurements import ACTIONS, measure, repetitions, side_check, stays
from src.shared.motion.motion import Motion
from src.shared.motion.skeleton import JOINT_INDEX, NUM_JOINTS, REST_PELVIS_HEIGHT

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


@pytest.mark.parametrize(
    ("labels", "still"),
    [
        ({"action": "wave", "side": "left", "speed": "normal"}, True),
        ({"action": "squat", "count": "2", "speed": "normal"}, True),
        ({"action": "turn", "direction": "left", "angle": "90"}, False),
        ({"action": "walk", "direction": "forward", "speed": "normal"}, False),
    ],
)
def test_who_stays_ends_where_he_began_and_faces_the_same_way(
    labels: dict[str, str], still: bool
) -> None:
    assert stays(generate_clip(spec_for(labels, 0), seed=0)) is still


def swordsman(*, degrees: float, apart: bool = False) -> Motion:
    """Arms ahead, hands together or apart; the chest turns to and fro so far, a second each way."""
    frames = 90
    q = np.zeros((frames, NUM_JOINTS, 4), np.float32)
    q[..., 0] = 1
    ahead = math.radians(60 if apart else 110) / 2
    for name, sign in (("l_shoulder", -1), ("r_shoulder", 1)):
        q[:, JOINT_INDEX[name], 0] = math.cos(ahead)
        q[:, JOINT_INDEX[name], 2] = sign * math.sin(ahead)
    turn = np.radians(degrees) * np.cos(np.pi * np.arange(frames) / 15) / 2 / 2
    q[:, JOINT_INDEX["spine3"], 0], q[:, JOINT_INDEX["spine3"], 2] = np.cos(turn), np.sin(turn)
    place = np.tile(np.float32([0, REST_PELVIS_HEIGHT, 0]), (frames, 1))
    return Motion(quaternions=q, root_position=place, contacts=np.ones((frames, 2), np.float32))


def test_a_slash_is_both_hands_together_that_sweep_far() -> None:
    assert measure(swordsman(degrees=120)).slashes >= 2
    assert ACTIONS["slash"](measure(swordsman(degrees=120)))
    for other in (swordsman(degrees=20), swordsman(degrees=120, apart=True)):
        assert measure(other).slashes == 0


def caller(*, degrees: float, elbow: float) -> Motion:
    """Bends forward so far and comes up again, the arms ahead, the forearms turned in so far."""
    frames = 90
    q = np.zeros((frames, NUM_JOINTS, 4), np.float32)
    q[..., 0] = 1
    for letter, sign in (("l", -1), ("r", 1)):
        for name, turn in (("shoulder", 80.0), ("elbow", elbow)):
            half = math.radians(turn) / 2
            q[:, JOINT_INDEX[f"{letter}_{name}"], 0] = math.cos(half)
            q[:, JOINT_INDEX[f"{letter}_{name}"], 2] = sign * math.sin(half)
    lean = np.radians(degrees) * np.sin(np.pi * np.arange(frames) / (frames - 1)) / 2
    q[:, JOINT_INDEX["spine1"], 0], q[:, JOINT_INDEX["spine1"], 1] = np.cos(lean), np.sin(lean)
    place = np.tile(np.float32([0, REST_PELVIS_HEIGHT, 0]), (frames, 1))
    return Motion(quaternions=q, root_position=place, contacts=np.ones((frames, 2), np.float32))


def test_who_calls_leans_forward_with_a_hand_at_the_face() -> None:
    assert ACTIONS["call"](measure(caller(degrees=60, elbow=110)))
    assert measure(caller(degrees=60, elbow=0)).calls == 0  # bows, the arms stretched
    assert measure(caller(degrees=10, elbow=110)).calls == 0
