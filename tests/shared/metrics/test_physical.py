"""Foot slide, jerk and speed of motions whose answer is known by construction."""

import numpy as np
import pytest

from src.shared.metrics.physical import (
    BALLS,
    contact_slide,
    foot_jump,
    mean_jerk,
    physics,
    support_slide,
)
from src.shared.motion.motion import Motion
from src.shared.motion.skeleton import REST_FOOT_HEIGHT, REST_PELVIS_HEIGHT


def rest_motion(num_frames: int = 40, *, velocity: float = 0.0, lift: float = 0.0) -> Motion:
    """The rest pose, gliding along +Z at `velocity` m/s, `lift` metres above the floor."""
    quaternions = np.zeros((num_frames, 22, 4), dtype=np.float32)
    quaternions[..., 0] = 1
    root = np.zeros((num_frames, 3), dtype=np.float32)
    root[:, 1] = REST_PELVIS_HEIGHT + lift
    root[:, 2] = velocity * np.arange(num_frames) / 30
    return Motion(quaternions, root, np.ones((num_frames, 2), dtype=np.float32))


def test_a_gliding_pose_slides_at_its_own_speed() -> None:
    figures = physics(rest_motion(velocity=0.2))
    assert figures["contact_slide"] == pytest.approx(20, rel=1e-3)
    assert figures["support_slide"] == pytest.approx(20, rel=1e-3)
    assert figures["speed"] == pytest.approx(0.2, rel=1e-3)
    assert figures["jerk"] == pytest.approx(0, abs=0.1)
    assert figures["penetration"] == pytest.approx(0, abs=1e-3)


def test_a_fast_glide_escapes_the_contact_detector_but_not_the_support_slide() -> None:
    figures = physics(rest_motion(velocity=1.5))
    assert np.isnan(figures["contact_slide"])
    assert figures["support_slide"] == pytest.approx(150, rel=1e-3)


def test_a_body_in_the_air_has_no_slide_and_a_sunk_one_penetrates() -> None:
    assert np.isnan(physics(rest_motion(lift=0.5, velocity=1.0))["support_slide"])
    assert physics(rest_motion(lift=-0.05))["penetration"] == pytest.approx(5, rel=1e-3)


def test_the_standing_foot_of_a_step_does_not_slide() -> None:
    positions = np.zeros((20, 22, 3))
    positions[..., 1] = 1.0
    positions[:, BALLS[0], 1] = REST_FOOT_HEIGHT
    positions[:, BALLS[1], 1] = REST_FOOT_HEIGHT + 0.05  # swings, higher
    positions[:, BALLS[1], 2] = 2 * np.arange(20) / 30
    assert support_slide(positions, 30) == 0
    assert contact_slide(positions, 30) == 0


def test_jerk_of_a_cubic_is_its_third_derivative() -> None:
    time = np.arange(30) / 30
    positions = np.zeros((30, 22, 3))
    positions[..., 0] = (time**3)[:, None]
    assert mean_jerk(positions, 30) == pytest.approx(6)
    assert np.isnan(mean_jerk(positions[:3], 30))


def test_a_foot_that_changes_its_place_at_once_is_seen() -> None:
    motion = rest_motion()
    assert foot_jump(motion) < 1e-3
    motion.root_position[30:, 0] += 0.2
    assert foot_jump(motion) == pytest.approx(180, rel=1e-3)
