"""Footsteps: left and right in turn, landing on beats, only where a path walks."""

from itertools import pairwise

import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from src.shared.inference.footsteps import QUICK, landings, step_plan
from src.shared.motion.trajectory import MotionTrajectory


def walk(speed: float, frames: int = 240, *, sway: np.ndarray | None = None) -> MotionTrajectory:
    """Straight ahead, the pelvis `sway` metres to the left of the line."""
    position = np.zeros((frames, 3))
    position[:, 1], position[:, 2] = 0.93, np.arange(frames) / 30 * speed
    if sway is not None:
        position[:, 0] = sway
    turn = np.tile([1.0, 0.0, 0.0, 0.0], (frames, 1))
    return MotionTrajectory.from_pose(position, turn, np.arange(frames) / 60)


def test_feet_land_on_the_beats_in_turn() -> None:
    beats = 0.2 + 0.5 * np.arange(17)
    contact, planned = step_plan(walk(1.0), beats)
    assert planned.all() and contact.any(1).all()
    lands = [np.flatnonzero(np.diff(contact[:, side].astype(int)) == 1) + 1 for side in (0, 1)]
    times = np.sort(np.concatenate(lands)) / 30
    assert np.abs(times[:, None] - beats).min(1).max() <= 1 / 30 + 1e-9
    in_turn = sorted([(at, 0) for at in lands[0]] + [(at, 1) for at in lands[1]])
    assert all(a[1] != b[1] for a, b in pairwise(in_turn))
    both = contact.all(1).mean()
    assert 0.15 < both < 0.3


def test_nothing_is_planned_where_nobody_walks() -> None:
    beats = 0.5 * np.arange(16)
    for speed in (0.0, 3.0):
        assert not step_plan(walk(speed), beats)[1].any()
    assert not step_plan(walk(1.0), beats[:1])[1].any()
    position = np.concatenate((np.zeros(120), np.arange(120) / 30))
    both = walk(0.0)
    both.data[:, 2] = position
    planned = step_plan(both, beats)[1]
    assert not planned[:100].any() and planned[140:].all()


def test_quick_beats_get_a_step_every_second_time() -> None:
    quick, slow = QUICK * 0.8 * np.arange(20), QUICK * 1.2 * np.arange(20)
    np.testing.assert_allclose(np.diff(landings(quick, 5.0)), QUICK * 1.6)
    np.testing.assert_allclose(np.diff(landings(slow, 5.0)), QUICK * 1.2)


@given(side=st.sampled_from([-1, 1]), offset=st.integers(0, 1))
def test_the_foot_stands_under_the_swaying_pelvis(side: int, offset: int) -> None:
    beats = 0.5 * np.arange(offset, 18)
    sway = side * 0.04 * np.sin(np.pi * np.arange(240) / 30 / 0.5)  # left in the first half second
    contact, _ = step_plan(walk(1.0, sway=sway), beats)
    left_alone = contact[:, 0] & ~contact[:, 1]
    right_alone = contact[:, 1] & ~contact[:, 0]
    assert sway[left_alone].mean() > 0.01 > -0.01 > sway[right_alone].mean()


@given(seed=st.integers(0, 500), tempo=st.floats(50, 200))
def test_some_foot_stands_wherever_steps_are_planned(seed: int, tempo: float) -> None:
    rng = np.random.default_rng(seed)
    beats = rng.uniform(0, 1) + np.cumsum(60 / tempo * rng.uniform(0.95, 1.05, 30))
    contact, planned = step_plan(walk(rng.uniform(0, 2.5), 150), beats)
    assert contact[planned].any(1).all()
    assert contact.shape == (150, 2) and planned.shape == (150,)
