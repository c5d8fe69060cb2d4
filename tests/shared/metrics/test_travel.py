"""Where a motion goes, seen from its first frame, on paths known by construction."""

import numpy as np
import pytest

from src.shared.metrics.physical import travel, travel_error
from src.shared.motion.motion import Motion


def walker(direction: float, *, heading: float, metres: float = 2.0, turn: float = 0.0) -> Motion:
    """31 frames (1 s) straight ahead of `heading` + `direction`, turning by `turn` meanwhile."""
    time = np.linspace(0, 1, 31)
    yaw = heading + turn * time
    quaternions = np.zeros((31, 22, 4), dtype=np.float32)
    quaternions[..., 0] = 1
    quaternions[:, 0] = np.stack([np.cos(yaw / 2), 0 * yaw, np.sin(yaw / 2), 0 * yaw], axis=-1)
    path = metres * time[:, None] * [np.sin(heading + direction), 0, np.cos(heading + direction)]
    root = (path + [0, 0.95, 0]).astype(np.float32)
    return Motion(quaternions, root, np.ones((31, 2), np.float32))


@pytest.mark.parametrize("direction", [-2.5, 0.0, 0.5, np.pi / 2])
@pytest.mark.parametrize("heading", [0.0, 2.0, -3.0])
def test_direction_is_seen_from_the_first_heading(direction: float, heading: float) -> None:
    found = travel(walker(direction, heading=heading, turn=0.4))
    assert found == pytest.approx([2, direction, 0.4], abs=1e-3, rel=1e-3)


def test_a_small_step_has_no_direction() -> None:
    assert np.isnan(travel(walker(0.0, heading=0.0, metres=0.3))[1])


def test_errors_wrap_and_standing_where_one_should_walk_is_half_wrong() -> None:
    nan = float("nan")
    ours = [np.array(row) for row in ((1.0, 3.0, 0.0), (0.0, nan, 1.0), (1.0, 0.0, 0.0))]
    real = [np.array(row) for row in ((1.5, -3.0, 0.0), (1.0, 0.0, 0.0), (0.0, nan, 0.0))]
    errors = travel_error(ours, real)
    assert errors["speed"] == pytest.approx([0.5, 1.0, 1.0])
    assert errors["direction"][:2] == pytest.approx([np.degrees(2 * np.pi - 6), 90.0])
    assert np.isnan(errors["direction"][2])
    assert errors["turn"] == pytest.approx([0, np.degrees(1.0), 0])
