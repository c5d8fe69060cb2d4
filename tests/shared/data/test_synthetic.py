"""The synthetic source: balance, determinism, planted feet, anatomy, smoothness."""

from collections import Counter
from itertools import pairwise

import numpy as np
import pytest

from src.shared.data.synthetic.clips import (
    LABEL_VALUES,
    SPEED_METRES,
    SyntheticSpec,
    generate_clip,
    label_combinations,
    sample_specs,
    spec_for,
    speed_metres,
)
from src.shared.motion.features import decode_features, encode_features
from src.shared.motion.motion import Motion
from src.shared.motion.postprocess.contacts import detect_contacts
from src.shared.motion.skeleton import JOINT_INDEX, REST_FOOT_HEIGHT

COMBINATIONS = label_combinations()
BALLS = [JOINT_INDEX["l_foot"], JOINT_INDEX["r_foot"]]


def _key(labels: dict[str, str]) -> str:
    return "|".join(f"{name}={value}" for name, value in sorted(labels.items()))


@pytest.fixture(scope="module")
def clips() -> list[tuple[SyntheticSpec, Motion]]:
    specs = sample_specs(2 * len(COMBINATIONS), seed=3)
    return [(spec, generate_clip(spec, seed)) for seed, spec in enumerate(specs)]


def test_labels_use_only_the_declared_values() -> None:
    for labels in COMBINATIONS:
        for name, value in labels.items():
            assert value in LABEL_VALUES[name]
    used = {value for labels in COMBINATIONS for value in labels.values()}
    assert used == {value for values in LABEL_VALUES.values() for value in values}
    assert len({_key(labels) for labels in COMBINATIONS}) == len(COMBINATIONS)


@pytest.mark.parametrize("n", [1, 50, 2 * len(COMBINATIONS) + 5])
def test_sample_specs_covers_combinations_in_balance(n: int) -> None:
    specs = sample_specs(n, seed=1)
    counts = Counter(_key(spec.labels) for spec in specs)
    assert len(specs) == n
    assert max(counts.values()) <= -(-n // len(COMBINATIONS))
    if n > len(COMBINATIONS):
        assert len(counts) == len(COMBINATIONS)
        assert min(counts.values()) >= n // len(COMBINATIONS)


def test_sampling_and_generation_are_deterministic_and_varied() -> None:
    assert sample_specs(20, 5) == sample_specs(20, 5)
    assert sample_specs(20, 5) != sample_specs(20, 6)
    spec = spec_for({"action": "walk", "direction": "forward", "speed": "slow"}, 1)
    first, again, other = generate_clip(spec, 1), generate_clip(spec, 1), generate_clip(spec, 2)
    assert np.array_equal(first.quaternions, again.quaternions)
    assert not np.array_equal(first.quaternions, other.quaternions)


def test_clips_are_well_formed(clips: list[tuple[SyntheticSpec, Motion]]) -> None:
    for spec, motion in clips:
        assert motion.fps == 30 and 2.5 <= motion.seconds <= 6.02, spec.labels
        for array in (motion.quaternions, motion.root_position, motion.contacts):
            assert array.dtype == np.float32 and np.isfinite(array).all()
        assert np.allclose(np.linalg.norm(motion.quaternions, axis=-1), 1, atol=1e-5)
        assert np.allclose(motion.root_position[0, [0, 2]], 0, atol=1e-6)
        assert set(np.unique(motion.contacts)) <= {0.0, 1.0}


def test_planted_feet_do_not_slide_or_sink(clips: list[tuple[SyntheticSpec, Motion]]) -> None:
    for spec, motion in clips:
        balls = motion.positions()[:, BALLS]
        assert balls[..., 1].min() > REST_FOOT_HEIGHT - 0.01, spec.labels
        speed = np.linalg.norm(np.diff(balls[..., [0, 2]], axis=0), axis=-1) * motion.fps
        planted = (motion.contacts[1:] > 0) & (motion.contacts[:-1] > 0)
        assert (speed * planted).max() < 0.03, spec.labels
        assert (detect_contacts(motion.positions(), motion.fps) == motion.contacts).mean() > 0.75


def test_feet_leave_the_ground_only_where_they_should(
    clips: list[tuple[SyntheticSpec, Motion]],
) -> None:
    for spec, motion in clips:
        airborne = (motion.contacts.sum(1) == 0).any()
        assert airborne == (spec.labels["action"] in ("run", "jump")), spec.labels


def test_knees_and_elbows_bend_only_the_anatomical_way(
    clips: list[tuple[SyntheticSpec, Motion]],
) -> None:
    for spec, motion in clips:
        rotations = motion.global_rotations()
        for letter, forward in (("l", 1.0), ("r", -1.0)):
            thigh = rotations[:, JOINT_INDEX[f"{letter}_hip"]]
            shin = rotations[:, JOINT_INDEX[f"{letter}_knee"]]
            # The shin, seen from the thigh, never points forward of it.
            ahead = -(thigh[:, :, 2] * shin[:, :, 1]).sum(-1)
            assert ahead.max() < 0.02, spec.labels
            upper = rotations[:, JOINT_INDEX[f"{letter}_shoulder"]]
            lower = rotations[:, JOINT_INDEX[f"{letter}_elbow"]]
            inward = forward * (upper[:, :, 2] * lower[:, :, 0]).sum(-1)
            assert inward.min() > -0.05, spec.labels


def test_motion_is_smooth(clips: list[tuple[SyntheticSpec, Motion]]) -> None:
    for spec, motion in clips:
        q = motion.quaternions
        turned = 2 * np.arccos(np.clip(np.abs((q[1:] * q[:-1]).sum(-1)), 0, 1)) * motion.fps
        assert turned.max() < 30, spec.labels  # rad/s
        pelvis = np.diff(motion.root_position, axis=0) * motion.fps
        # Landing from a jump brakes hardest, with about 2.5 g.
        assert np.abs(np.diff(pelvis, axis=0)).max() * motion.fps < 40, spec.labels


def test_speeds_are_apart_and_kept() -> None:
    for speeds in SPEED_METRES.values():
        assert all(fast > 1.25 * slow for slow, fast in pairwise(speeds))
    for speed in ("slow", "normal", "fast"):
        labels = {"action": "run", "direction": "forward", "speed": speed}
        motion = generate_clip(spec_for(labels, 4), 4)
        middle = motion.root_position[len(motion.root_position) // 2 :]
        measured = np.linalg.norm(middle[-1] - middle[0]) / (len(middle) - 1) * motion.fps
        assert measured == pytest.approx(speed_metres(labels), rel=0.12)


def test_features_round_trip() -> None:
    motion = generate_clip(spec_for(COMBINATIONS[5], 2), 2)
    back = decode_features(encode_features(motion))
    assert np.allclose(back.positions()[0], motion.positions()[0], atol=0.02)
