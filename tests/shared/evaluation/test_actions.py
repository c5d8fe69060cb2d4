"""The discriminant that says which action a motion shows."""

import numpy as np
import pytest

from src.shared.data.prepared import ClipRecord
from src.shared.data.synthetic.clips import generate_clip, spec_for
from src.shared.evaluation.actions import (
    ActionJudge,
    ActionRecognizer,
    descriptor,
    shown,
)
from src.shared.evaluation.samples import frozen_pose
from src.shared.metrics.measurements import ACTIONS

LABELS = {
    "walk": {"action": "walk", "direction": "forward", "speed": "normal"},
    "wave": {"action": "wave", "side": "right", "speed": "normal"},
    "squat": {"action": "squat", "count": "2", "speed": "normal"},
    "punch": {"action": "punch", "side": "left", "count": "1"},
}


@pytest.fixture(scope="module")
def clips() -> dict[str, np.ndarray]:
    return {
        name: np.stack([descriptor(generate_clip(spec_for(labels, s), seed=s)) for s in range(16)])
        for name, labels in LABELS.items()
    }


def fit(clips: dict[str, np.ndarray], seeds: slice) -> ActionJudge:
    names = [name for name, rows in clips.items() for _ in rows[seeds]]
    return ActionJudge.fit(np.concatenate([rows[seeds] for rows in clips.values()]), names)


def test_it_tells_actions_of_clips_it_has_not_seen(clips: dict[str, np.ndarray]) -> None:
    judge = fit(clips, slice(0, 10))
    for name, rows in clips.items():
        assert judge(rows[10:]) == [name] * 6


def test_a_frozen_pose_is_no_walk(clips: dict[str, np.ndarray]) -> None:
    judge = fit(clips, slice(0, 16))
    walk = generate_clip(spec_for(LABELS["walk"], 99), seed=99)
    still = descriptor(frozen_pose(walk))
    assert np.isfinite(still).all()
    assert judge(still[None]) != ["walk"]


def test_labels_that_mean_nothing_give_chance(clips: dict[str, np.ndarray]) -> None:
    everything = np.concatenate([rows for rows in clips.values()])
    names = [name for name, rows in clips.items() for _ in rows]
    rng = np.random.default_rng(0)
    order = rng.permutation(len(names))
    shuffled = [names[row] for row in order]
    judge = ActionJudge.fit(everything[:40], shuffled[:40])
    right = np.mean([a == b for a, b in zip(judge(everything[40:]), shuffled[40:], strict=True)])
    assert right < 0.6


def test_classes_lie_apart_in_its_axes_in_deviations_within_a_class(
    clips: dict[str, np.ndarray],
) -> None:
    judge = fit(clips, slice(0, 16))
    places = {name: judge.embed(rows) for name, rows in clips.items()}
    within = np.mean([rows.std(0).mean() for rows in places.values()])
    centres = np.stack([rows.mean(0) for rows in places.values()])
    apart = [np.linalg.norm(a - b) for i, a in enumerate(centres) for b in centres[:i]]
    assert places["walk"].shape == (16, 3) and min(apart) > 5 * within


def test_one_class_is_refused(clips: dict[str, np.ndarray]) -> None:
    with pytest.raises(ValueError, match="too few"):
        ActionJudge.fit(clips["walk"], ["walk"] * 16)


def recognizer(takes: int) -> ActionRecognizer:
    """Of twelve clips of each action, so many takes an action."""
    records, motions = [], []
    for name, labels in LABELS.items():
        for seed in range(12):
            take = f"{name}{seed % takes}"
            records.append(
                ClipRecord(f"{take}-{seed}", "here", take, name, name, labels, False, "train", 90,
                           "0", 0, {}, "captured")
            )  # fmt: skip
            motions.append(generate_clip(spec_for(labels, seed), seed=seed))
    return ActionRecognizer.fit(records, motions, np.stack([*map(descriptor, motions)]))


def test_what_kinematics_bear_out_is_seen_without_the_discriminant() -> None:
    found = recognizer(takes=12)
    assert {"walk", "squat", "punch"} <= found.kinematic
    squat = generate_clip(spec_for(LABELS["squat"], 50), seed=50)
    assert found.shows("squat", "walk", squat) and found.shows("walk", "walk", squat)
    assert not found.shows("walk", "squat", squat) and not found.shows("punch", "squat", squat)


def test_an_action_of_one_take_is_known_by_kinematics_alone() -> None:
    found = recognizer(takes=1)
    assert all(found.recall[name] == 1.0 for name in found.kinematic)
    assert all(found.recall[name] < 0.5 for name in LABELS.keys() - found.kinematic)


def test_a_frozen_pose_shows_no_action_of_kinematics() -> None:
    from src.shared.metrics.measurements import measure

    for name in ("walk", "squat", "punch", "wave"):
        still = frozen_pose(generate_clip(spec_for(LABELS[name], 3), seed=3))
        assert not any(check(measure(still)) for check in ACTIONS.values())


def test_both_hands_may_be_up_when_each_has_something_to_do() -> None:
    both = generate_clip(
        spec_for({"action": "raise", "side": "both", "speed": "normal"}, 0), seed=0
    )
    left = generate_clip(
        spec_for({"action": "raise", "side": "left", "speed": "normal"}, 0), seed=0
    )
    parts = [{"action": "raise", "side": "left"}, {"action": "wave", "side": "right"}]
    assert shown(parts, both) and not shown(parts[:1], both)
    assert not shown(parts, left)
    assert not shown(parts, frozen_pose(both))
