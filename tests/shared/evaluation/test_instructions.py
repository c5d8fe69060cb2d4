"""The oracle: right on every synthetic clip, blind to frozen and random motion, mirror-true."""

from collections import Counter

import numpy as np
import pytest
import torch

from src.shared.data.synthetic.clips import (
    generate_clip,
    label_combinations,
    sample_specs,
    spec_for,
)
from src.shared.evaluation.actions import (
    CHECKS,
    check,
    credible,
    speed_class,
)
from src.shared.evaluation.suites.control import CONTROL_TASKS, faster, rate
from src.shared.metrics.measurements import count_peaks, measure, smooth
from src.shared.motion.motion import Motion
from tests.shared.motion.mirrored import mirror_motion

COMBINATIONS = label_combinations()
SWAP = {"left": "right", "right": "left"}


def _clip(seed: int = 0, **labels: str) -> Motion:
    return generate_clip(spec_for(labels, seed), seed)


def _random_motion(rng: np.random.Generator, smoothing: int) -> Motion:
    q = smooth(rng.normal(size=(120, 22, 4)), smoothing)
    q /= np.linalg.norm(q, axis=-1, keepdims=True)
    root = smooth(rng.normal(size=(120, 3)), smoothing) + np.array([0, 0.9, 0])
    contacts = (rng.random((120, 2)) > 0.5).astype(np.float32)
    return Motion(q.astype(np.float32), root.astype(np.float32), contacts)


def test_right_on_synthetic_clips() -> None:
    failures: Counter[str] = Counter()
    specs = sample_specs(3 * len(COMBINATIONS), seed=11)
    for seed, spec in enumerate(specs):
        answers = check(spec.labels, generate_clip(spec, seed))
        assert answers, f"nothing is checked for {spec.labels}"
        for name, passed in answers.items():
            if not passed:
                failures[f"{spec.labels}: {name}"] += 1
    assert sum(failures.values()) <= 0.01 * len(specs), failures


def test_other_actions_do_not_pass_by_accident() -> None:
    for labels in COMBINATIONS:
        m = measure(_clip(**labels))
        action, direction = labels["action"], labels.get("direction")
        travels = action in ("walk", "run", "side-step", "crouch-walk")
        assert CHECKS["forward"](m) <= (direction == "forward"), labels
        assert CHECKS["backward"](m) <= (direction == "backward"), labels
        assert CHECKS["left"](m) <= (travels and direction == "left"), labels
        assert CHECKS["run"](m) == (action == "run"), labels
        for name in ("squat", "jump", "bow", "clap", "stand"):
            assert CHECKS[name](m) == (action == name), (labels, name)
        for side in ("left", "right"):
            turns = labels.get("turn") == side or (action in ("turn", "spin") and direction == side)
            assert CHECKS[f"turn-{side}"](m) == turns, labels
            hand = action in ("wave", "raise") and labels["side"] == side
            if action != "punch":
                assert CHECKS[f"{side}-hand"](m) == hand, labels
            for limb in ("kick", "punch"):
                asked = action == limb and labels["side"] == side
                assert CHECKS[f"{limb}-{side}"](m) == asked, (labels, limb)


def test_mirrored_motion_flips_left_and_right() -> None:
    for labels in COMBINATIONS:
        motion = _clip(1, **labels)
        mirrored = {name: SWAP.get(value, value) for name, value in labels.items()}
        assert all(check(mirrored, mirror_motion(motion)).values()), labels
        if mirrored != labels:
            assert not all(check(labels, mirror_motion(motion)).values()), labels


@pytest.mark.parametrize("labels", COMBINATIONS[::7], ids=str)
def test_frozen_poses_fail_every_check(labels: dict[str, str]) -> None:
    motion = _clip(2, **labels)
    middle = slice(motion.num_frames // 2, motion.num_frames // 2 + 1)
    frozen = Motion(
        np.repeat(motion.quaternions[middle], 90, 0),
        np.repeat(motion.root_position[middle], 90, 0),
        np.ones((90, 2), np.float32),
    )
    m = measure(frozen)
    assert not any(ask(m) for ask in CHECKS.values())
    assert not any(check(labels, frozen).values())


def test_a_gliding_pose_does_not_walk() -> None:
    standing = _clip(action="stand")
    path = standing.root_position.copy()
    path[:, 2] += np.linspace(0, 4, len(path))
    gliding = Motion(standing.quaternions, path, standing.contacts)
    assert not CHECKS["forward"](measure(gliding))


@pytest.mark.parametrize("smoothing", [1, 5])
@pytest.mark.parametrize("seed", range(5))
def test_random_motion_fails_every_check(seed: int, smoothing: int) -> None:
    motion = _random_motion(np.random.default_rng(seed), smoothing)
    m = measure(motion)
    assert not credible(m)
    assert not any(ask(m) for ask in CHECKS.values())
    for labels in COMBINATIONS:
        assert not any(check(labels, m).values())
    assert not any(rate(task, [m], [m]).value for task in CONTROL_TASKS)


def test_faster_compares_pairs() -> None:
    walk = measure(_clip(action="walk", direction="forward", speed="fast"))
    run = measure(_clip(action="run", direction="forward", speed="slow"))
    assert faster(run, walk) and not faster(walk, run) and not faster(run, run)


def test_speed_class_is_none_without_a_speed_table() -> None:
    motion = measure(_clip(action="stand"))
    assert speed_class({"action": "stand"}, motion) is None


def test_tasks_ask_for_known_labels() -> None:
    names = [task.name for task in CONTROL_TASKS]
    assert len(set(names)) == len(names) == 7
    for task in CONTROL_TASKS:
        for labels in (*task.labels, *([task.versus] if task.versus else [])):
            assert any(labels.items() <= full.items() for full in COMBINATIONS), labels
            full = next(c for c in COMBINATIONS if labels.items() <= c.items())
            other = measure(_clip(3, **task.versus, speed="normal")) if task.versus else None
            if labels is not task.versus:
                found = rate(task, [measure(_clip(3, **full))], [other] if other else [])
                assert found.value == 1, (task.name, labels)


def test_count_peaks_needs_a_valley_between() -> None:
    curve = np.array([0, 1, 0.6, 1, 0, 1, 0], float)
    assert count_peaks(curve, 0.9, 0.5) == 2
    assert count_peaks(curve, 0.9, 0.7) == 3
    assert count_peaks(np.ones(5), 0.9, 0.5) == 0


def test_measure_leaves_torch_state_alone() -> None:
    torch.manual_seed(0)
    expected = torch.rand(1)
    torch.manual_seed(0)
    measure(_clip(action="stand"))
    assert torch.equal(torch.rand(1), expected)


def test_a_spin_to_no_side_in_particular_can_be_judged() -> None:
    spinning = _clip(action="spin", direction="left")
    assert check({"action": "spin"}, spinning) == {"in-place": True}
