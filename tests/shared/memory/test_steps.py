"""Steps made by code: what lands on a count, what stands, and that a cycle closes."""

import numpy as np
import pytest

from src.shared.memory.steps import STEPS, Steps, made_take
from src.shared.metrics.stage import stage
from src.shared.motion.skeleton import JOINT_INDEX

BALLS = [JOINT_INDEX["l_foot"], JOINT_INDEX["r_foot"]]


@pytest.mark.parametrize("steps", STEPS, ids=lambda steps: steps.kind)
def test_feet_land_on_counts_stand_still_and_end_where_they_began(steps: Steps) -> None:
    take = made_take(steps, 0.5)
    motion, length = take.motion, len(steps.landings)
    balls = motion.positions()[:, BALLS]
    begin = round(float(take.counts[0]) * 30)
    cycle = round(length * 0.5 * 30)
    gap = np.linalg.norm(balls[begin + cycle] - balls[begin], axis=-1)
    assert gap.max() < 0.02
    speed = np.linalg.norm(np.diff(balls, axis=0), axis=-1) * 30
    still = (motion.contacts[:-1] > 0.5) & (motion.contacts[1:] > 0.5)
    assert np.percentile(speed[still], 95) < 0.2
    for count, landing in enumerate(steps.landings):
        if landing is not None:
            foot, frame = "LR".index(landing.foot.upper()), begin + 15 * count + 1
            assert (motion.contacts[frame, foot] > 0.5) == (landing.height == 0)
    assert (motion.contacts.max(1) > 0.5).all(), "one foot is always on the floor"
    figures = stage(motion)
    assert figures["hovering"] == 0 and figures["both_slide"] < 0.03 and figures["radius"] < 0.8


def test_a_step_says_what_it_is() -> None:
    take = made_take(STEPS[0], 0.5, 7)
    assert take.name == "step-touch-7-120bpm" and take.meter == 4 and take.is_dance
    assert np.allclose(np.diff(take.counts), 0.5)
    assert {steps.meter for steps in STEPS if steps.kind == "waltz"} == {3}
