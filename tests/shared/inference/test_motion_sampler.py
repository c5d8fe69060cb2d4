"""MotionSampler keeps the best of N candidates."""

import numpy as np
import pytest
import torch

from src.shared.errors import UsageError
from src.shared.inference.audio_condition import AudioCondition
from src.shared.inference.motion_sampler import MotionSampler, on_the_beat
from src.shared.inference.song_sampler import SampleSettings, SongSampler
from src.shared.model.audio.audio_motion_model import AudioMotionModel
from src.shared.motion.trajectory import MotionTrajectory
from tests.shared.model.audio.tiny_audio import awake, network_config, walk

FRAMES = 60


@pytest.fixture(scope="module")
def model() -> AudioMotionModel:
    torch.manual_seed(0)
    model = AudioMotionModel(network_config())
    awake(model)
    rows = walk(FRAMES)[0]
    model.set_statistics(rows.mean(0), 0.1 + rows.std(0))
    return model.eval()


def sound(rows: int = 163) -> torch.Tensor:
    return torch.randn(rows, FRAMES, generator=torch.Generator().manual_seed(1))


def test_candidates_are_the_song_samplers_and_the_best_is_among_them(
    model: AudioMotionModel,
) -> None:
    result = MotionSampler(model, device="cpu").sample(
        audio_condition=sound(), num_frames=40, num_samples=3, num_steps=2, return_all=True
    )
    assert result.all_candidates is not None
    assert result.all_candidates.shape == (3, 40, 25)
    np.testing.assert_array_equal(result.trajectory, result.all_candidates[result.best])
    plain = SongSampler(model, SampleSettings(num_samples=3, steps=2)).sample(sound()[:, :40])
    np.testing.assert_array_equal(result.all_candidates, np.stack([t.data for t in plain]))


def test_rows_come_in_any_wrapping_and_nothing_else_is_kept(
    model: AudioMotionModel,
) -> None:
    sampler = MotionSampler(model)
    first = sampler.sample(sound()[None], num_samples=1, num_steps=1)
    second = sampler.sample(AudioCondition(sound()), num_samples=1, num_steps=1)
    third = sampler.sample(sound().numpy(), num_samples=1, num_steps=1)
    for other in (second, third):
        np.testing.assert_array_equal(first.trajectory, other.trajectory)
    assert first.trajectory.shape == (FRAMES, 25) and first.all_candidates is None


@pytest.mark.parametrize(
    "wrong", [{"num_frames": FRAMES + 1}, {"num_frames": 0}, {"num_samples": 0}]
)
def test_impossible_wishes_are_refused(model: AudioMotionModel, wrong: dict[str, int]) -> None:
    with pytest.raises(UsageError, match=r"num.(frames|samples)"):
        MotionSampler(model).sample(sound(), num_steps=1, **wrong)


def stopping(times: np.ndarray, frames: int = 240) -> MotionTrajectory:
    """A walk that slows down at these times."""
    clock = np.arange(frames) / 30
    near = np.exp(-((clock[:, None] - times) ** 2) / (2 * 0.06**2)).sum(axis=1)
    path = np.zeros((frames, 3))
    path[:, 2] = np.cumsum(1.0 - 0.8 * np.minimum(near, 1)) / 30
    path[:, 1] = 0.9
    turn = np.tile([1.0, 0, 0, 0], (frames, 1))
    return MotionTrajectory.from_pose(path, turn, clock / 2)


def test_fewer_failed_checks_win_before_the_beat(model: AudioMotionModel) -> None:
    sampler = MotionSampler(model)
    beats = np.arange(0.5, 8, 0.5)
    on, off = stopping(beats), stopping(beats + 0.25)
    assert on_the_beat(on, beats) > 0.8 > 0.2 > on_the_beat(off, beats)
    assert sampler._rank(on, beats) < sampler._rank(off, beats)
    broken = MotionTrajectory(on.data.copy())
    broken.data[100, 9:13] *= -1
    assert sampler._rank(off, beats) < sampler._rank(broken, beats)
    assert on_the_beat(stopping(np.zeros(0)), beats) == 0
