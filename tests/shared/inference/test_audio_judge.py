"""AudioJudge: beats and sanity decide, and a broken candidate comes last."""

import numpy as np
import pytest

from src.shared.inference.audio_judge import AudioJudge, on_the_beat
from src.shared.inference.selection import SelectionConfig
from src.shared.motion.trajectory import MotionTrajectory

BEATS = np.arange(0.5, 8, 0.5)


def stopping(times: np.ndarray, frames: int = 240, heading: float = 0.0) -> MotionTrajectory:
    """A walk that slows down at these times."""
    clock = np.arange(frames) / 30
    near = np.exp(-((clock[:, None] - times) ** 2) / (2 * 0.06**2)).sum(axis=1)
    path = np.zeros((frames, 3))
    path[:, 2] = np.cumsum(1.0 - 0.8 * np.minimum(near, 1)) / 30
    path[:, 1] = 0.9
    turn = np.tile([np.cos(heading / 2), 0, np.sin(heading / 2), 0], (frames, 1))
    return MotionTrajectory.from_pose(path, turn, clock / 2)


def broken(trajectory: MotionTrajectory) -> MotionTrajectory:
    """The same with one sign flip of its orientation."""
    data = trajectory.data.copy()
    data[100, 9:13] *= -1
    return MotionTrajectory(data)


def test_on_the_beat_wins_and_a_broken_one_loses() -> None:
    on, off = stopping(BEATS), stopping(BEATS + 0.25)
    assert on_the_beat(on, BEATS) > 0.8 > 0.2 > on_the_beat(off, BEATS)
    assert on_the_beat(stopping(np.zeros(0)), BEATS) == 0
    table = AudioJudge().judge([off, broken(on), on], BEATS)
    assert table.order.tolist() == [2, 0, 1]
    assert table.failed.tolist() == [0, 1, 0]
    assert set(table.terms) == {"sanity", "beats"}


@pytest.mark.parametrize("unknown", [None, np.zeros(0)])
def test_without_beats_the_suite_decides(unknown: np.ndarray | None) -> None:
    noisy = stopping(BEATS)
    rough = noisy.position + np.random.default_rng(0).normal(0, 0.002, noisy.position.shape)
    trembling = MotionTrajectory.from_pose(rough, noisy.quaternion, noisy.phase_unwrapped)
    table = AudioJudge().judge([trembling, noisy], unknown)
    assert set(table.terms) == {"sanity"} and table.best == 1


def test_facing_elsewhere_on_one_path_is_a_distance() -> None:
    same, turned = stopping(BEATS), stopping(BEATS, heading=np.pi)
    judge = AudioJudge(config=SelectionConfig(distance=1.0))
    table = judge.judge([same, same, turned], BEATS)
    assert table.order.tolist() == [0, 2, 1]
    assert table.distance[2] == pytest.approx(1 - np.exp(-0.5)) and table.distance[1] == 0
