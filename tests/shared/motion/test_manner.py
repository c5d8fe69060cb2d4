"""Manners: the same movement, carried otherwise."""

import numpy as np
import pytest
import torch

from src.shared.motion.features import decode_features, encode_features
from src.shared.motion.manner import FAR, PLAIN, Manner, carried
from src.shared.motion.skeleton import JOINT_INDEX
from tests.shared.memory.tiny_figures import tiny_figures

HEAD, PELVIS, WRIST = (JOINT_INDEX[name] for name in ("head", "pelvis", "l_wrist"))


def places(manner: Manner) -> np.ndarray:
    features = encode_features(tiny_figures().takes[0].motion)
    return decode_features(carried(features, manner, 30.0)).positions()


def test_who_is_plain_moves_as_ever() -> None:
    features = encode_features(tiny_figures().takes[0].motion)
    assert carried(features, PLAIN, 30.0) is features
    assert Manner(stoop=10, arms=0.5) & Manner(knees=5, arms=0.5) == Manner(10, 0, 5, 0.25)


def test_trunk_and_knees_bend_and_feet_stay_on_the_floor() -> None:
    plain, old = places(PLAIN), places(Manner(stoop=24, knees=14))
    assert (old[:, HEAD, 2] - old[:, PELVIS, 2]).mean() > 0.15  # in front of the pelvis
    sinks = plain[:, PELVIS, 1] - old[:, PELVIS, 1]
    assert 0.01 < sinks.mean() < 0.06
    assert np.abs(plain[..., 1].min(1) - old[..., 1].min(1)).max() < 0.01


@pytest.mark.parametrize("share", [0.5, 1.3])
def test_arms_keep_a_share_of_their_movement(share: float) -> None:
    plain, own = places(PLAIN)[:, WRIST], places(Manner(arms=share))[:, WRIST]
    moved = [np.ptp(each - each.mean(0), axis=0).max() for each in (own, plain)]
    assert moved[0] / moved[1] == pytest.approx(share, abs=0.3)


def test_an_arm_that_goes_all_round_does_not_jump() -> None:
    features = encode_features(tiny_figures().takes[0].motion)[:120]
    angle = torch.linspace(0, 2 * np.pi, 120)
    shoulder = JOINT_INDEX["l_shoulder"]
    zero = torch.zeros_like(angle)
    features[:, shoulder] = torch.stack((zero + 1, zero, zero, zero, angle.cos(), angle.sin()), -1)
    steps = np.linalg.norm(
        np.diff(decode_features(carried(features, Manner(arms=0.7), 30.0)).positions(), axis=0),
        axis=-1,
    )[:, WRIST]
    assert steps.max() < 0.2 and np.pi > FAR
