"""Figures of a stage on motions known by construction."""

import numpy as np
import pytest

from src.shared.metrics.stage import (
    backward_share,
    distinct_poses,
    hovering,
    net_way,
    pose_dimensions,
    sliding,
    stage,
    turning,
)
from src.shared.motion.skeleton import REST_FOOT_HEIGHT
from tests.shared.evaluation.dancers import swinging_arms
from tests.shared.metrics.test_travel import walker

TIME = np.arange(300) / 30


@pytest.mark.parametrize(("way", "share"), [(0.0, 0.0), (np.pi, 1.0), (np.pi / 2, 0.0)])
@pytest.mark.parametrize("facing", [0.0, 2.5])
def test_backward_is_seen_from_where_it_faces(way: float, share: float, facing: float) -> None:
    path = np.stack([np.sin(facing + way) * TIME, np.cos(facing + way) * TIME], 1)
    assert backward_share(path, np.full(300, facing), 30.0) == pytest.approx(share)
    assert net_way(path, 30.0) == pytest.approx(1, abs=0.01)


def test_a_circle_leads_nowhere_and_standing_has_no_direction() -> None:
    angle = TIME / 10 * 2 * np.pi
    circle = np.stack([np.sin(angle), np.cos(angle)], 1)
    assert net_way(circle, 30.0) < 0.05
    assert np.isnan(backward_share(np.zeros((300, 2)), np.zeros(300), 30.0))
    assert np.isnan(net_way(np.zeros((300, 2)), 30.0))


def test_turning_either_way() -> None:
    assert turning(TIME, 30.0) == pytest.approx(np.degrees(1), rel=0.03)
    assert turning(-TIME, 30.0) == pytest.approx(np.degrees(1), rel=0.03)


def test_poses_and_their_dimensions() -> None:
    still = np.zeros((50, 22, 3))
    assert distinct_poses(still) == 1 and pose_dimensions(still) == 0
    line = still + 0.5 * np.arange(50)[:, None, None] * np.array([1.0, 0, 0])
    assert distinct_poses(line) == 50 and pose_dimensions(line) == pytest.approx(1)
    noise = np.random.default_rng(0).normal(size=(400, 22, 3))
    assert pose_dimensions(noise) > 40


def test_hovering_and_sliding_feet() -> None:
    ground = np.zeros((300, 22, 3))
    ground[..., 1] = REST_FOOT_HEIGHT
    assert hovering(ground, 30.0) == sliding(ground, 30.0).mean() == 0
    high = ground.copy()
    high[30:60, :, 1] += 0.2
    high[100:106, :, 1] += 0.2  # a hop
    assert hovering(high, 30.0) == pytest.approx(6)
    gliding = ground.copy()
    gliding[..., 2] += TIME[:, None]
    assert sliding(gliding, 30.0).mean() == 1


def test_a_whole_body() -> None:
    found = stage(swinging_arms(frames=90))
    assert found["radius"] < 0.1 and found["turning"] < 5 and found["dimensions"] >= 1
    assert stage(walker(np.pi, heading=0.3))["backward"] == 1
