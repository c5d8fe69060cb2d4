"""When and where feet stand: runs, steps, reach, and curves between plants."""

import math

import numpy as np
import pytest
import torch
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.interpolate import CubicHermiteSpline

from src.shared.motion.postprocess.contacts import (
    GIVE,
    MAX_REACH,
    ROLL,
    SWING,
    UNDER,
    _in_reach,
    _on_floor,
    contact_runs,
    corrections,
    foot_shifts,
    grounding,
    hermite,
    plant_spans,
    running,
    standing,
)
from src.shared.motion.postprocess.footskate import MAX_RISE, heel_rise
from src.shared.motion.rotations import axis_turn
from src.shared.motion.skeleton import REST_FOOT_HEIGHT

FPS = 30.0


def on_floor(frames: int, speed: float = 0.0) -> np.ndarray:
    """A ball of the foot that glides along z."""
    path = np.zeros((frames, 3))
    path[:, 1] = REST_FOOT_HEIGHT
    path[:, 2] = speed * np.arange(frames) / FPS
    return path


def hips_over(path: np.ndarray, height: float = 0.87) -> np.ndarray:
    return path + np.array([0.0, height - REST_FOOT_HEIGHT, -0.1])


def test_runs_bridge_short_gaps() -> None:
    contact = np.array([0, 1, 1, 0, 1, 1, 0, 0, 0, 0, 1], dtype=bool)
    assert contact_runs(contact, max_gap=2) == [(1, 6), (10, 11)]
    assert contact_runs(contact, max_gap=0) == [(1, 3), (4, 6), (10, 11)]
    assert contact_runs(np.zeros(4, dtype=bool), max_gap=2) == []
    assert contact_runs(np.ones(4, dtype=bool), max_gap=2) == [(0, 4)]


def test_the_lower_foot_carries_who_claims_nothing() -> None:
    balls = np.stack((on_floor(20), on_floor(20) + [0, 0.03, 0]), 1)
    hips = hips_over(balls)
    assert standing(balls, hips, np.zeros((20, 2)), FPS).tolist() == [[True, False]] * 20
    claimed = standing(balls, hips, np.tile([0.0, 1.0], (20, 1)), FPS)
    assert claimed.tolist() == [[False, True]] * 20
    high = balls + [0, 0.3, 0]
    assert not standing(high, hips, np.ones((20, 2)), FPS).any()


def test_who_falls_stands_on_nothing() -> None:
    balls = np.stack((on_floor(20), on_floor(20)), 1)
    fall = -9.81 / 2 * (np.arange(20) / FPS) ** 2
    hips = hips_over(balls)
    hips[..., 1] += fall[:, None]
    assert not standing(balls, hips, np.zeros((20, 2)), FPS)[7:-7].any()


def test_a_dragged_foot_takes_steps_in_turn_with_the_other() -> None:
    path = on_floor(120, speed=0.5)  # two metres
    balls, kept = np.stack((path, path), 1), np.zeros((120, 2), dtype=bool)
    left, right = plant_spans(balls, hips_over(balls), ~kept, FPS, kept)
    assert len(left) >= 3 and len(right) >= 3
    planted = np.zeros((120, 2), dtype=bool)
    for side, plants in enumerate((left, right)):
        for plant in plants:
            planted[plant.start : plant.stop, side] = True
            reach = np.linalg.norm(hips_over(path)[plant.start : plant.stop] - plant.point, axis=1)
            assert reach.max() <= MAX_REACH
    assert planted.any(1).all()  # one foot is always down
    assert not planted.all()
    treads = np.zeros(120, dtype=bool)
    shift = corrections(path, left, kept[:, 0], treads, FPS)
    moved = path + shift
    for plant in left:
        ground = moved[plant.start : plant.stop, [0, 2]]
        speed = np.linalg.norm(np.diff(ground, axis=0), axis=1) * FPS
        np.testing.assert_allclose(speed, GIVE, atol=1e-6)
    between = slice(left[0].stop, left[1].start)
    assert moved[between, 1].max() > REST_FOOT_HEIGHT + 0.03  # a step is lifted
    treads[(left[0].stop + left[1].start) // 2] = True
    shift = corrections(path, left, kept[:, 0], treads, FPS)
    assert np.abs(shift[between, 1]).max() < ROLL  # unless it runs


def test_a_quick_step_is_no_pause_of_one_stand() -> None:
    """A foot that is off the floor for two frames, in which it gets half a metre away."""
    path = on_floor(60)
    path[32:, 2] += 0.5
    balls, kept = np.stack((path, path), 1), np.zeros((60, 2), dtype=bool)
    stands = np.ones((60, 2), dtype=bool)
    stands[30:32, 0] = False
    left = plant_spans(balls, hips_over(balls), stands, FPS, kept)[0]
    assert [round(float(plant.point[2]), 2) for plant in left] == [0.0, 0.5]
    path[32:, 2] -= 0.4
    balls[:, 0] = path
    assert len(plant_spans(balls, hips_over(balls), stands, FPS, kept)[0]) == 1


@pytest.mark.parametrize("stop", [30, 3])
def test_a_foot_has_time_to_get_to_its_next_plant(stop: int) -> None:
    """Three frames after it stood it stands half a metre away: it leaves sooner, or lands later."""
    path = on_floor(60)
    path[stop + 3 :, 2] += 0.5
    balls = np.stack((path, path + [0.2, 0, 0]), 1)
    stands = np.zeros((60, 2), dtype=bool)
    stands[:, 0] = True
    stands[stop : stop + 3, 0] = False
    kept = np.zeros((60, 2), dtype=bool)
    one, other = plant_spans(balls, hips_over(balls), stands, FPS, kept)[0]
    away = np.linalg.norm(other.point - one.point)
    assert other.start - one.stop == math.ceil(math.sqrt(6 * away / SWING) * FPS) == 5
    assert (one.stop, other.start) == ((28, 33) if stop == 30 else (3, 8))


def test_a_body_too_fast_for_its_steps_takes_more_of_them() -> None:
    path = on_floor(120, speed=1.8)
    balls = np.stack((path, path), 1)
    turn = np.arange(120) // 24 % 2  # each foot in turn, for much longer than a leg is
    stands = np.stack((turn == 0, turn == 1), 1)
    kept = np.zeros((120, 2), dtype=bool)
    hips = hips_over(balls)
    found = plant_spans(balls, hips, stands, FPS, kept)
    planted = np.zeros((120, 2), dtype=bool)
    for side, plants in enumerate(found):
        assert len(plants) >= 4
        for plant in plants:
            planted[plant.start : plant.stop, side] = True
            ways = hips[plant.start : plant.stop, side] - plant.point
            assert np.linalg.norm(ways, axis=1).max() <= MAX_REACH
    assert planted.any(1).mean() > 0.9


def test_a_body_that_hovers_is_put_on_the_floor_and_a_jump_stays() -> None:
    balls = np.stack((on_floor(60), on_floor(60) + [0, 0.1, 0]), 1) + [0, 0.06, 0]
    kept = np.zeros((60, 2), dtype=bool)
    low = (balls + grounding(balls, hips_over(balls), kept, FPS))[..., 1] - REST_FOOT_HEIGHT
    assert np.abs(low[:, 0]).max() < 0.011
    np.testing.assert_allclose(low[:, 1] - low[:, 0], 0.1, atol=1e-9)
    jump = np.stack((on_floor(60), on_floor(60)), 1)
    jump[25:35, :, 1] += 0.3
    assert np.abs(grounding(jump, hips_over(jump), kept, FPS)).max() == 0
    hanging = jump + [0, 0.5, 0]
    assert np.abs(grounding(hanging, hips_over(hanging), kept, FPS)).max() == 0


def test_who_lies_or_sits_on_the_floor_stands_on_no_foot() -> None:
    balls = np.stack((on_floor(60), on_floor(60)), 1) + [0, 0.05, 0]
    hips = balls + [0, 0.1, -0.8]
    for claims in (np.zeros((60, 2)), np.ones((60, 2))):
        shifts, planted = foot_shifts(balls, hips, claims, FPS)
        assert not planted.any() and not shifts.any()


def test_a_kept_beginning_says_where_the_foot_stands_on() -> None:
    path = on_floor(30, speed=0.3)
    kept = np.arange(30) < 10
    balls = np.stack((path, path), 1)
    both = np.stack((kept, kept), 1)
    shifts, planted = foot_shifts(balls, hips_over(balls), np.ones((30, 2)), FPS, both)
    assert np.abs(shifts[:10]).max() == 0.0
    moved = balls + shifts
    np.testing.assert_allclose(moved[10:, :, 2], path[9, 2], atol=1e-9)
    assert planted.all()


@settings(deadline=None, max_examples=50)
@given(st.lists(st.floats(-2, 2), min_size=4, max_size=4), st.integers(1, 20))
def test_hermite_is_scipys(values: list[float], num: int) -> None:
    left, right, left_slope, right_slope = (np.array([value, 0.0, 1.0]) for value in values)
    ours = hermite(left, right, left_slope, right_slope, num)
    theirs = CubicHermiteSpline([0, num], [left, right], [left_slope, right_slope])
    np.testing.assert_allclose(ours, theirs(np.arange(num + 1)), atol=1e-9)


@settings(deadline=None, max_examples=60)
@given(
    height=st.floats(0.6, 0.95),
    away=st.tuples(st.floats(-0.5, 0.5), st.floats(-0.5, 0.5)),
    longest=st.floats(0.7, 0.8),
)
def test_a_heel_rises_no_further_than_needed(
    height: float, away: tuple[float, float], longest: float
) -> None:
    hip = torch.tensor([away[0], height, away[1]], dtype=torch.float64)
    ball = torch.tensor([0.0, REST_FOOT_HEIGHT, 0.0], dtype=torch.float64)
    lever = torch.tensor([0.0, 0.06, -0.13], dtype=torch.float64)
    turn = axis_turn(*heel_rise(hip, ball, lever, torch.tensor(longest, dtype=torch.float64)))
    before = float((ball + lever - hip).norm())
    after = float((ball + turn @ lever - hip).norm())
    angle = float(torch.arccos(((turn.trace() - 1) / 2).clamp(-1, 1)))
    if before <= longest:
        assert angle < 1e-6
    elif angle < MAX_RISE - 1e-6 and float((hip - ball).norm() - lever.norm()) < longest:
        assert after == pytest.approx(longest, abs=1e-6)
    else:
        assert longest - 1e-9 < after < before


@pytest.mark.parametrize(("speed", "left_alone"), [(1.0, False), (3.0, True)])
def test_running_feet_are_left_alone_and_told_of(speed: float, left_alone: bool):
    """A foot that claims to stand slides under a body that walks, or runs, past it."""
    way = np.arange(40) / FPS
    balls = np.zeros((40, 2, 3))
    balls[..., 1] = REST_FOOT_HEIGHT
    balls[..., 2] = 0.2 * way[:, None]  # a slow slide: 20 cm/s
    hips = np.zeros((40, 2, 3))
    hips[..., 1], hips[..., 2] = 0.85, speed * (way - way[20])[:, None]
    claims = np.zeros((40, 2))
    claims[17:24, 0] = 1.0
    shifts, planted = foot_shifts(balls, hips, claims, FPS)
    assert running(hips, FPS).all() == left_alone
    stood = claims[:, 0] > 0  # a foot on the floor is told of, planted or not
    assert (
        np.array_equal(planted[:, 0] & stood, stood)
        if left_alone
        else (planted[:, 0] & stood).any()
    )
    assert (np.abs(shifts[..., 2]).max() == 0) == left_alone


@settings(max_examples=60)
@given(st.integers(0, 2**32 - 1), st.integers(2, 40), st.integers(1, 7), st.floats(0.6, 0.92))
def test_where_a_leg_reaches_is_what_trying_all_spans_finds(
    seed: int, frames: int, shortest: int, height: float
) -> None:
    draws = np.random.default_rng(seed)
    ball = np.cumsum(draws.normal(0, 0.02, (frames, 3)), 0)
    hip = np.cumsum(draws.normal(0, 0.02, (frames, 3)), 0) + [0, height, 0]
    found = _in_reach(ball, hip, 1, frames, shortest)

    for first in range(1, frames - shortest + 1):
        for last in range(frames, first + shortest - 1, -1):
            for share in UNDER:
                middle = (1 - share) * ball[first:last].mean(0) + share * hip[first:last].mean(0)
                point = _on_floor(middle)
                if np.linalg.norm(hip[first:last] - point, axis=1).max() <= MAX_REACH:
                    assert found[1:] == (first, last) and np.array_equal(found[0], point)
                    return
    assert found[1:] == (1, 1)
