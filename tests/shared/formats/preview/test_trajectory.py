"""Beats in the pictures: those of the song, or where the phase reaches whole beats.
The stand-in body: its pelvis is the trajectory, its feet stay on the floor."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.spatial.transform import Rotation

from src.shared.formats.preview.trajectory import (
    SongTrack,
    beat_marks,
    phase_palette,
    proxy_body,
)
from src.shared.motion.skeleton import FOOT_JOINTS, JOINT_INDEX, REST_PELVIS_HEIGHT
from src.shared.motion.trajectory import MotionTrajectory
from tests.shared.motion.trajectories import smooth_trajectory


def keeping(phase: np.ndarray) -> MotionTrajectory:
    """Standing still while the bar goes on."""
    frames = len(phase)
    turn = np.tile([1.0, 0, 0, 0], (frames, 1))
    return MotionTrajectory.from_pose(np.zeros((frames, 3)), turn, phase)


@settings(max_examples=40, deadline=None)
@given(st.floats(40, 220), st.integers(2, 6), st.floats(0, 0.99))
def test_beats_of_an_even_phase(tempo: float, meter: int, start: float) -> None:
    bars = start + np.arange(301) / 30 * tempo / 60 / meter
    marks = beat_marks(keeping(bars), SongTrack(meter=meter))
    beats = np.arange(np.ceil(bars[0] * meter), np.floor(bars[-1] * meter) + 1)
    expected = (beats / meter - start) * 60 * meter / tempo
    inner = (expected > 0.01) & (expected < 9.99)  # at the very ends float32 decides
    found = np.interp(expected[inner], marks.times, marks.times)
    np.testing.assert_allclose(found, expected[inner], atol=2e-3)
    assert abs(len(marks.times) - len(beats)) <= 2
    gap = np.abs(marks.times[:, None] - expected)
    known = gap.min(1) < 2e-3
    np.testing.assert_array_equal(marks.downbeat[known], (beats[gap.argmin(1)] % meter == 0)[known])


def test_the_songs_beats_win_and_are_cut_to_the_motion() -> None:
    song = SongTrack(None, np.arange(-1, 20) * 0.5, np.array([0.0, 1.5, 3.0]), 3)
    marks = beat_marks(keeping(np.linspace(0, 7, 61)), song)  # 2 seconds
    np.testing.assert_allclose(marks.times, [0, 0.5, 1, 1.5, 2])
    assert marks.downbeat.tolist() == [True, False, False, True, False]
    none = SongTrack(None, np.array([]), np.array([]))
    assert none.beatless and not song.beatless and not SongTrack().beatless
    assert not len(beat_marks(keeping(np.linspace(0, 7, 61)), none).times)
    assert not beat_marks(keeping(np.zeros(61)), SongTrack(None, np.array([1.0]))).downbeat.any()


@pytest.mark.parametrize("frames", [1, 2, 30])
def test_no_music_has_no_beats(frames: int) -> None:
    assert not len(beat_marks(keeping(np.zeros(frames)), SongTrack()).times)


def test_a_phase_that_halts_or_slips_back_still_has_rising_beats() -> None:
    phase = np.concatenate((np.linspace(0, 1, 30), np.full(20, 1.0), np.linspace(0.98, 2, 30)))
    times = beat_marks(keeping(phase), SongTrack()).times
    assert (np.diff(times) > 0).all()
    assert len(times) in (8, 9)


def test_colours_go_round_and_are_equally_light() -> None:
    palette = phase_palette(64).astype(float)
    steps = np.abs(np.diff(np.concatenate((palette, palette[:1])), axis=0)).max(1)
    assert steps.max() < 16
    assert palette.min() > 0  # nothing is cut off
    assert palette[0].argmax() == 0  # red at the downbeat
    linear = (palette / 255) ** 2.2 @ [0.2126, 0.7152, 0.0722]
    assert linear.std() / linear.mean() < 0.1


def leaning(lean: float, height: float, yaw: float = 1.0) -> MotionTrajectory:
    turn = Rotation.from_euler("YX", [yaw, lean]).as_quat()[[3, 0, 1, 2]]
    position = np.tile([0.5, height, -2.0], (3, 1))
    return MotionTrajectory.from_pose(position, np.tile(turn, (3, 1)), np.zeros(3))


def test_the_pelvis_is_where_the_trajectory_says() -> None:
    trajectory = smooth_trajectory(3)
    motion = proxy_body(trajectory, "song")
    np.testing.assert_array_equal(motion.positions()[:, 0], trajectory.position)
    np.testing.assert_array_equal(motion.quaternions[:, 0], trajectory.quaternion)
    np.testing.assert_allclose(np.linalg.norm(motion.quaternions, axis=-1), 1, atol=1e-5)
    assert (motion.text, motion.fps, motion.num_frames) == ("song", 30.0, 120)
    assert not motion.contacts.any()


@settings(max_examples=30, deadline=None)
@given(st.floats(-0.9, 0.9), st.floats(0.6, 0.94), st.floats(-3, 3))
def test_legs_bend_until_the_feet_are_flat_on_the_floor(
    lean: float, height: float, yaw: float
) -> None:
    motion = proxy_body(leaning(lean, height, yaw))
    positions = motion.positions()[0]
    for ankle, foot in FOOT_JOINTS:
        hip = positions[ankle - 6]
        if 0.35 < hip[1] - 0.08 < 0.8:  # within the leg's reach
            np.testing.assert_allclose(positions[ankle], [hip[0], 0.08, hip[2]], atol=2e-3)
            assert positions[foot][1] == pytest.approx(0.02, abs=2e-3)


def test_a_jump_leaves_the_floor_and_arms_hang() -> None:
    positions = proxy_body(leaning(0.0, REST_PELVIS_HEIGHT + 0.4)).positions()[0]
    assert positions[JOINT_INDEX["l_foot"]][1] == pytest.approx(0.42, abs=2e-3)
    assert positions[JOINT_INDEX["l_wrist"]][1] < positions[JOINT_INDEX["l_shoulder"]][1] - 0.35
    assert positions[JOINT_INDEX["l_foot"]][0] != positions[JOINT_INDEX["r_foot"]][0]


@pytest.mark.parametrize("lean", [np.pi / 2, np.pi, -3.0])
def test_a_body_upside_down_is_finite(lean: float) -> None:
    positions = proxy_body(leaning(lean, 0.3)).positions()
    assert np.isfinite(positions).all()


def test_knees_bend_forwards() -> None:
    """Facing +Z, the knee is before the hip and the ankle."""
    positions = proxy_body(leaning(0.0, 0.75, yaw=0.0)).positions()[0]
    knee, hip = positions[JOINT_INDEX["l_knee"]], positions[JOINT_INDEX["l_hip"]]
    assert knee[2] > hip[2] + 0.1
