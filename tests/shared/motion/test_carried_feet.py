"""Feet on a path that is not their body's own: held, and smoother than after one lock."""

import numpy as np

from src.shared.evaluation.dance_seams import ACCELERATION, JERK, body_quantities
from src.shared.metrics.physical import support_speed
from src.shared.motion.carried_feet import hold_carried_feet
from src.shared.motion.foot_lock import lock_feet
from src.shared.motion.motion import Motion
from src.shared.motion.skeleton import JOINT_INDEX
from tests.shared.motion.test_foot_lock import sliding_walk

LEGS = [JOINT_INDEX[f"{side}_{name}"] for side in "lr" for name in ("hip", "knee", "ankle", "foot")]
OTHERS = [joint for joint in JOINT_INDEX.values() if joint not in LEGS]


def slide(motion: Motion) -> float:
    """Mean speed of the lower foot, m/s."""
    return float(support_speed(motion.positions().astype(np.float64), motion.fps).mean())


def test_feet_slide_as_little_and_legs_move_more_smoothly_than_after_one_lock() -> None:
    motion = sliding_walk(150, slide=0.9)
    once, carried = lock_feet(motion), hold_carried_feet(motion)
    assert slide(motion) > 0.5
    assert slide(carried) < 0.25 * slide(motion) and slide(carried) < 1.2 * slide(once)
    for quantity in (ACCELERATION, JERK):
        rough, smooth = (np.percentile(body_quantities(m)[quantity], 99) for m in (once, carried))
        assert smooth < 0.9 * rough


def test_nothing_but_the_legs_is_touched() -> None:
    motion = sliding_walk(90, slide=0.9)
    carried = hold_carried_feet(motion)
    np.testing.assert_array_equal(carried.root_position, motion.root_position)
    np.testing.assert_array_equal(carried.quaternions[:, OTHERS], motion.quaternions[:, OTHERS])
    norms = np.linalg.norm(carried.quaternions, axis=-1)
    np.testing.assert_allclose(norms, 1, atol=1e-5)
    assert ((carried.quaternions[1:] * carried.quaternions[:-1]).sum(-1) > 0).all()


def test_kept_legs_stay() -> None:
    motion = sliding_walk(90, slide=0.9)
    kept = np.zeros((90, 2), dtype=bool)
    kept[:40, 0] = True
    carried = hold_carried_feet(motion, kept=kept)
    np.testing.assert_array_equal(
        carried.quaternions[:40, LEGS[:4]], motion.quaternions[:40, LEGS[:4]]
    )
    np.testing.assert_array_equal(carried.contacts[:40, 0], motion.contacts[:40, 0])
    assert not np.array_equal(carried.quaternions[40:], motion.quaternions[40:])
