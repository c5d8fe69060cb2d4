"""Feet and floor of bodies whose slide, depth and height are known by construction."""

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from src.shared.evaluation.families import CONTACT
from src.shared.evaluation.samples import Clips, MotionSample
from src.shared.metrics.physical import (
    contact,
    jerk_per_speed,
    pfc,
    slide_per_metre,
    support_slide,
    support_speed,
    unsupported,
)
from src.shared.motion.motion import Motion
from src.shared.motion.skeleton import REST_PELVIS_HEIGHT

FPS = 30.0
ANKLES, BALLS = (7, 8), (10, 11)


def statue(
    num_frames: int = 61, *, velocity: float = 0.0, lift: float = 0.0, fps: float = FPS
) -> Motion:
    """The rest pose, gliding along +Z at `velocity` m/s, `lift` metres above the floor."""
    quaternions = np.zeros((num_frames, 22, 4), dtype=np.float32)
    quaternions[..., 0] = 1
    root = np.zeros((num_frames, 3), dtype=np.float32)
    root[:, 1] = REST_PELVIS_HEIGHT + lift
    root[:, 2] = velocity * np.arange(num_frames) / fps
    return Motion(quaternions, root, np.ones((num_frames, 2), dtype=np.float32), fps)


def walker(*, slide: float = 0.0, speed: float = 1.2) -> np.ndarray:
    """Positions [T,22,3]: feet stand in turn for half a second, and slide at `slide` m/s.

    Feet are dragged on at the body's speed while they swing 10 cm up; other joints go with the
    pelvis. Two seconds.
    """
    time = np.arange(60) / FPS
    positions = np.zeros((60, 22, 3))
    positions[..., 1], positions[..., 2] = 1.0, (speed * time)[:, None]
    left = (time % 1.0) < 0.5
    for foot, stands in ((0, left), (1, ~left)):
        step = np.where(stands, slide, speed) / FPS
        along = np.concatenate(([0.0], step.cumsum()[:-1]))
        for joint in (ANKLES[foot], BALLS[foot]):
            positions[:, joint, 2] = along
            positions[:, joint, 1] = np.where(stands, 0.02, 0.12)
    return positions


def jump(height: float, gravity: float = 9.81, stand: int = 10) -> Motion:
    """Stands, is thrown up stiffly to `height` metres, lands and stands."""
    rise = np.sqrt(2 * height / gravity)
    time = (np.arange(2 * stand + int(2 * rise * FPS)) - stand) / FPS
    up = np.sqrt(2 * gravity * height) * time - gravity / 2 * time**2
    motion = statue(len(time))
    motion.root_position[:, 1] += np.where((time > 0) & (up > 0), up, 0).astype(np.float32)
    return motion


# ---------------------------------------------------------------- sliding


def test_a_gliding_statue_slides_all_of_its_way() -> None:
    found = contact(statue(velocity=0.3))
    assert found["claimed_slide"] == pytest.approx(30, rel=1e-3)
    assert found["slide_per_metre"] == pytest.approx(100, rel=1e-3)
    assert found["skating_frames"] == found["claimed_frames"] == 100
    slow = contact(statue(velocity=0.09))
    assert slow["claimed_slide"] == pytest.approx(9, rel=1e-2) and slow["skating_frames"] == 0
    assert np.isnan(slow["slide_per_metre"])  # 18 cm in all


@pytest.mark.parametrize(("slide", "skating"), [(0.0, 0), (0.05, 0), (0.1001, 100), (0.4, 100)])
def test_a_walker_whose_standing_foot_slides(slide: float, skating: float) -> None:
    positions = walker(slide=slide)
    speeds = support_speed(positions, FPS)
    assert len(speeds) == 59 and speeds == pytest.approx(slide, abs=1e-9)
    assert 100 * (speeds > 0.1).mean() == skating
    assert 100 * slide == pytest.approx(support_slide(positions, FPS), abs=1e-9)
    assert slide_per_metre(positions, FPS) == pytest.approx(100 * slide / 1.2, abs=1e-9)


def test_slide_is_of_claimed_frames_only() -> None:
    motion = statue(velocity=0.2)
    motion.contacts[:] = 0
    assert np.isnan(contact(motion)["claimed_slide"]) and contact(motion)["claimed_frames"] == 0
    motion.contacts[:29, 0] = 1
    motion.root_position[30:, 2] *= 5  # fast, but then it claims nothing
    assert contact(motion)["claimed_slide"] == pytest.approx(20, rel=1e-3)
    assert contact(motion)["claimed_frames"] == pytest.approx(100 * 29 / 61)


# ---------------------------------------------------------------- the floor


def test_a_body_five_centimetres_up_floats_five_centimetres() -> None:
    found = contact(statue(lift=0.05))
    assert found["float_height"] == pytest.approx(5, rel=1e-3) and found["floating_frames"] == 100
    assert found["flying_frames"] == found["sunk_frames"] == found["sunk_depth"] == 0
    assert contact(statue(lift=0.015))["floating_frames"] == 0  # skin


def test_a_body_five_centimetres_down_is_sunk_by_five() -> None:
    found = contact(statue(lift=-0.05))
    assert found["sunk_depth"] == pytest.approx(5, rel=1e-3) and found["sunk_frames"] == 100
    assert found["floating_frames"] == found["flying_frames"] == 0
    half = statue(40)
    half.root_position[:10, 1] -= 0.03
    assert contact(half)["sunk_frames"] == pytest.approx(25)
    assert contact(half)["sunk_depth"] == pytest.approx(3 / 4, rel=1e-3)


@pytest.mark.parametrize("height", [0.05, 0.2, 0.5])
def test_a_jump_flies_and_a_jump_on_the_moon_floats(height: float) -> None:
    real, moon = contact(jump(height)), contact(jump(height, gravity=1.62))
    assert real["flying_frames"] > 0 and real["floating_frames"] == 0 and real["float_height"] == 0
    assert moon["flying_frames"] == 0 and moon["floating_frames"] > 20 and moon["float_height"] > 1
    flown = 2 * np.sqrt(2 * height / 9.81) * FPS  # frames
    motion = jump(height)
    assert real["flying_frames"] / 100 * motion.num_frames == pytest.approx(flown, abs=4)


def test_a_hop_from_a_cloud_is_no_flight() -> None:
    motion = jump(0.2)
    motion.root_position[:, 1] += 0.05
    assert contact(motion)["flying_frames"] == 0 and contact(motion)["floating_frames"] == 100


def test_a_body_on_its_hands_is_carried() -> None:
    motion = statue(lift=0.3)
    positions = motion.positions()
    assert unsupported(positions, FPS)[0].all()
    positions[:, 20, 1] = 0.02  # a wrist on the floor
    assert not unsupported(positions, FPS)[0].any()


# ---------------------------------------------------------------- roughness and PFC


def test_jerk_per_speed_of_a_sine_is_its_frequency_squared() -> None:
    time = np.arange(3000) / 300  # fine enough for differences to be derivatives
    positions = np.zeros((3000, 2, 3))
    positions[..., 0] = 0.3 * np.sin(2 * np.pi * 1.5 * time)[:, None]
    assert jerk_per_speed(positions, 300) == pytest.approx((2 * np.pi * 1.5) ** 2, rel=1e-2)
    assert jerk_per_speed(positions, 600) == pytest.approx((2 * np.pi * 3) ** 2, rel=1e-2)
    assert np.isnan(jerk_per_speed(np.ones((50, 2, 3)), FPS))
    assert np.isnan(jerk_per_speed(positions[:3], FPS))


def pfc_by_loops(positions: np.ndarray, fps: float) -> float:
    """EDGE's steps, a frame at a time, with z up turned to y up."""
    pushes, products = [], []
    for t in range(len(positions) - 2):
        before = (positions[t + 1, 0] - positions[t, 0]) * fps
        after = (positions[t + 2, 0] - positions[t + 1, 0]) * fps
        bend = (after - before) * fps
        bend[1] = max(bend[1], 0)
        pushes.append(np.sqrt((bend**2).sum()))
        moved = positions[t + 2] - positions[t + 1]
        feet = [
            min(np.hypot(moved[joint][0], moved[joint][2]) for joint in foot)
            for foot in zip(ANKLES, BALLS, strict=True)
        ]
        products.append(feet[0] * feet[1])
    scaled = np.array(pushes) / max(pushes)
    return float((scaled * products).mean() * 10_000)


@pytest.mark.parametrize("seed", range(3))
def test_pfc_is_that_of_the_loops(seed: int) -> None:
    positions = np.random.default_rng(seed).normal(size=(30, 22, 3)).cumsum(0) * 0.01
    assert pfc(positions, FPS) == pytest.approx(pfc_by_loops(positions, FPS))


def test_pfc_by_construction_and_its_faults() -> None:
    time = np.arange(61) / FPS
    positions = np.zeros((61, 22, 3))
    positions[..., 2] = (0.6 * time)[:, None]  # feet glide at 2 cm a frame
    positions[:, 0, 2] = 2 * time**2  # the pelvis gains 4 m/s²
    assert pfc(positions, FPS) == pytest.approx(0.02**2 * 1e4)
    assert pfc(positions, 2 * FPS) == pytest.approx(4 * pfc(positions, FPS))  # twice as fast
    still = positions.copy()
    still[:, [ANKLES[0], BALLS[0]]] = 0  # one standing foot excuses the other
    assert pfc(still, FPS) == 0
    spiked = positions.copy()
    spiked[30, 0, 2] += 0.5  # one rough frame improves the score of the others
    assert pfc(spiked, FPS) < 0.1 * pfc(positions, FPS)
    assert np.isnan(pfc(statue(velocity=1.0).positions(), FPS))  # the worst slide there is
    assert np.isnan(pfc(statue().positions(), FPS)) and np.isnan(pfc(positions[:2], FPS))


def test_a_frozen_pose_has_no_say_where_it_would_win() -> None:
    found = contact(statue())
    assert np.isnan([found["slide_per_metre"], found["jerk_per_speed"], found["pfc"]]).all()
    assert found["skating_frames"] == found["sunk_frames"] == found["floating_frames"] == 0


# ---------------------------------------------------------------- symmetries


def dancer(seed: int, num_frames: int = 50) -> Motion:
    """Limbs that swing, a pelvis that wanders, bounces and turns."""
    rng = np.random.default_rng(seed)
    time = np.arange(num_frames) / FPS
    swing = 0.7 * np.sin(2 * np.pi * rng.uniform(0.3, 1.5, 22) * time[:, None])
    quaternions = np.zeros((num_frames, 22, 4), dtype=np.float32)
    quaternions[..., 0], quaternions[..., 1] = np.cos(swing / 2), np.sin(swing / 2)
    root = np.cumsum(rng.normal(0, 0.02, (num_frames, 3)), 0).astype(np.float32)
    root[:, 1] = REST_PELVIS_HEIGHT + 0.1 * np.sin(7 * time + seed)
    contacts = (np.sin(5 * time[:, None] + np.array([0, 3])) > 0).astype(np.float32)
    return Motion(quaternions, root, contacts)


def turned(motion: Motion, angle: float, x: float, z: float) -> Motion:
    """The same about the vertical, and elsewhere on the floor."""
    w, v = np.cos(angle / 2), np.sin(angle / 2)
    q = motion.quaternions[:, 0].astype(np.float64)
    turn = np.stack(
        (w * q[:, 0] - v * q[:, 2], w * q[:, 1] + v * q[:, 3],
         w * q[:, 2] + v * q[:, 0], w * q[:, 3] - v * q[:, 1]), -1,
    )  # fmt: skip
    quaternions = motion.quaternions.copy()
    quaternions[:, 0] = turn
    sine, cosine = np.sin(angle), np.cos(angle)
    px, py, pz = motion.root_position.T.astype(np.float64)
    root = np.stack((cosine * px + sine * pz + x, py, cosine * pz - sine * px + z), -1)
    return replace(motion, quaternions=quaternions, root_position=root.astype(np.float32))


@given(st.floats(-3, 3), st.floats(-3, 3), st.floats(-3, 3), st.integers(0, 20))
@settings(max_examples=15, deadline=None)
def test_figures_know_no_place_or_heading(angle: float, x: float, z: float, seed: int) -> None:
    motion = dancer(seed)
    before, after = contact(motion), contact(turned(motion, angle, x, z))
    assert after == pytest.approx(before, rel=1e-2, abs=1e-2, nan_ok=True)


@given(st.integers(0, 30))
@settings(max_examples=10, deadline=None)
def test_floor_and_roughness_know_no_direction_of_time(seed: int) -> None:
    motion = dancer(seed)
    back = replace(
        motion,
        quaternions=motion.quaternions[::-1].copy(),
        root_position=motion.root_position[::-1].copy(),
        contacts=motion.contacts[::-1].copy(),
    )
    before, after = contact(motion), contact(back)
    for name in ("sunk_depth", "sunk_frames", "float_height", "floating_frames", "flying_frames",
                 "jerk_per_speed", "claimed_frames"):  # fmt: skip
        assert after[name] == pytest.approx(before[name], rel=1e-4)


def test_nan_is_named() -> None:
    motion = statue()
    motion.root_position[7, 0] = np.nan
    with pytest.raises(ValueError, match="NaN"):
        contact(motion)


def test_the_family_has_one_value_a_motion() -> None:
    motions = [statue(), statue(velocity=0.5), dancer(1)]
    names = ["caption"] * 3
    sample = MotionSample.of(
        Clips(motions, names, names, names, [{}] * 3),
        np.ones((3, 4)),
        np.ones((3, 4)),
        np.arange(3),
    )
    family = CONTACT
    found = family.compute(sample, sample, seed=0)
    assert list(found) == [column.key for column in family.columns]
    assert all(values.shape == (3,) for values in found.values())
    assert found["slide_per_metre"][1] == pytest.approx(100, rel=1e-3)
    assert "published" in family.definition
