"""MotionSampler keeps the best of N candidates."""

import numpy as np
import pytest
import torch

from src.shared.errors import UsageError
from src.shared.model.audio.audio_motion_model import AudioMotionModel
from src.shared.pipelines.motion_sampler import MotionSampler
from src.shared.pipelines.song import AudioCondition
from src.shared.pipelines.song_sampler import SongSampler, SongSampling
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
    plain = SongSampler(model, SongSampling(num_samples=3, steps=2)).sample(sound()[:, :40])
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


def test_scores_are_the_judges_and_the_best_is_the_highest(model: AudioMotionModel) -> None:
    result = MotionSampler(model).sample(sound(167), num_samples=3, num_steps=2)
    assert result.table.score[result.best] == result.table.score.max()
    assert set(result.table.terms) == {"sanity"}, "noise tells no beat"
    assert sorted(result.table.order) == [0, 1, 2]
