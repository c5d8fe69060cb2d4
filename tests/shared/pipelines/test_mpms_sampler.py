"""Songs made with a memory: each window asks, nothing known is as no memory at all."""

import asyncio

import numpy as np
import pytest
import torch

from src.shared.config_audio import MemoryConditionConfig, MemoryConfig
from src.shared.data.phrases.layout import phase_rows
from src.shared.errors import UsageError, UserError
from src.shared.memory.index import MemoryIndex
from src.shared.memory.service import MPMService
from src.shared.model.audio.audio_motion_model import AudioMotionModel
from src.shared.pipelines.motion_sampler import MPMSMotionSampler, hearable
from src.shared.pipelines.song_memory import (
    ask,
    ask_now,
    bars_of_window,
    questions,
    recalling,
    remembering,
)
from src.shared.pipelines.song_sampler import SongSampler, SongSampling
from tests.shared.memory.tiny_memory import LinearSpace, make_index
from tests.shared.model.audio.tiny_audio import awake, network_config, walk

FRAMES, WINDOW = 60, 40
SETTINGS = SongSampling(steps=2, window=WINDOW, overlap=10)


@pytest.fixture(scope="module")
def plain() -> AudioMotionModel:
    """Without a memory part."""
    torch.manual_seed(0)
    model = AudioMotionModel(network_config(window=WINDOW))
    awake(model)
    rows = walk(FRAMES)[0]
    model.set_statistics(rows.mean(0), 0.1 + rows.std(0))
    return model.eval()


@pytest.fixture(scope="module")
def model(plain: AudioMotionModel) -> AudioMotionModel:
    """The same weights and a memory part that has an effect."""
    twin = AudioMotionModel(plain.config)
    twin.load_state_dict(plain.state_dict())
    twin.add_memory(MemoryConditionConfig(width=16, num_heads=2, num_layers=1))
    assert twin.unet.memory is not None
    awake(twin.unet.memory)
    return twin.eval()


@pytest.fixture
def service() -> MPMService:
    return MPMService(MemoryConfig(deadline=60.0), make_index())


class Broken(MemoryIndex):
    """An index that cannot be searched."""

    def search(self, *_: object, **__: object) -> object:  # type: ignore[override]
        raise OSError("gone")


def broken() -> MPMService:
    return MPMService(MemoryConfig(deadline=60.0), Broken(**vars(make_index())))


def sound() -> torch.Tensor:
    features = torch.randn(163, FRAMES, generator=torch.Generator().manual_seed(1))
    bars = torch.from_numpy(phase_rows(np.arange(FRAMES) / 60, 4))
    return torch.cat((features, bars))


# ------------------------------------------------------------ what windows ask


def test_bars_go_on_beyond_the_song() -> None:
    bars = np.array([0.0, 0.25, 0.5, 1.0])
    np.testing.assert_allclose(bars_of_window(bars, 2, 4), [0.5, 1.0, 1.5, 2.0])
    np.testing.assert_allclose(bars_of_window(bars, 0, 3), bars[:3])


def test_each_window_asks_with_its_own_sound(model: AudioMotionModel, service: MPMService) -> None:
    windows = SongSampler(model, SETTINGS).windows(FRAMES)
    assert windows == [(0, 40), (22, 40), (44, 40)]  # 8 of them spare, 10 shared
    space, rows = LinearSpace(), sound()
    asked = questions(space, rows, np.arange(FRAMES) / 60, windows)
    assert [q.num_frames for q in asked] == [40, 40, 40]
    torch.testing.assert_close(asked[2].embedding, space.embed_audio(rows[None, :, 44:]))
    assert np.shape(asked[2].phase) == (40,)
    answers = ask_now(service, asked)
    at_once = asyncio.run(ask(service, asked))
    for one, other in zip(answers, at_once, strict=True):
        assert torch.equal(one.context, other.context) and torch.equal(one.priors, other.priors)
    assert service.counts["answered"] == 6
    recall = recalling(windows, answers)
    assert recall(44, 40).priors.shape == (1, 4, 40)


def test_excluded_songs_are_not_remembered(service: MPMService) -> None:
    index = service.index
    assert index is not None
    asked = questions(LinearSpace(), sound(), None, [(0, 40)])
    hits = ask_now(service, asked, {"song-0", "song-1"})[0].hits
    assert hits is not None
    assert not {index.song_of(n) for n in hits.index[0].tolist()} & {"song-0", "song-1"}


# ------------------------------------------------------------ songs


def test_nothing_known_makes_the_song_of_the_model_without_memory(
    plain: AudioMotionModel, model: AudioMotionModel
) -> None:
    before = SongSampler(plain, SETTINGS).sample(sound())[0].data
    sampler = SongSampler(model, SETTINGS)
    np.testing.assert_array_equal(sampler.sample(sound())[0].data, before)
    service = broken()
    recall = remembering(service, LinearSpace(), sampler, sound(), None)
    np.testing.assert_array_equal(sampler.sample(sound(), recall=recall)[0].data, before)
    assert service.counts == {"answered": 0, "timed_out": 0, "failed": 3}


def test_a_memory_changes_every_window(model: AudioMotionModel, service: MPMService) -> None:
    sampler = SongSampler(model, SETTINGS)
    recall = remembering(service, LinearSpace(), sampler, sound(), np.arange(FRAMES) / 60)
    made, before = (sampler.sample(sound(), recall=r)[0].data for r in (recall, None))
    assert made.shape == (FRAMES, 25)
    assert np.abs(made - before)[:30].max() > 1e-4 and np.abs(made - before)[50:].max() > 1e-4


# ------------------------------------------------------------ REF's sampler


def test_the_call_that_ref_prints(model: AudioMotionModel) -> None:
    async def main() -> None:
        index = make_index()
        mpms = await MPMService.from_config(MemoryConfig(folder="not opened", deadline=60.0))
        mpms.index = index
        await mpms.initialize()
        sampler = MPMSMotionSampler(model, mpms_service=mpms, device="cpu")
        result = await sampler.sample_with_mpms(
            audio_condition=sound()[:163, :40],
            num_frames=30,
            num_samples=2,
            audio_embedding=index.audio_keys[3],
            beat_phase=0.5,
            num_steps=1,
            return_all=True,
        )
        assert result.all_candidates is not None
        assert result.trajectory.shape == (30, 25) and result.all_candidates.shape == (2, 30, 25)
        assert mpms.counts["answered"] == 1

    asyncio.run(main())


def test_windows_that_ask_together_or_in_turn_are_the_same(
    model: AudioMotionModel, service: MPMService
) -> None:
    sampler = MPMSMotionSampler(model, service, LinearSpace(), device="cpu")
    wish = {"num_samples": 2, "num_steps": 1, "exclude_songs": {"song-2"}, "return_all": True}
    together = asyncio.run(sampler.sample_with_mpms(sound(), **wish))
    heard, alone = hearable(sound(), None), SongSampler(model, SongSampling(2, steps=1))
    bars, _ = heard.time() or (None, None)
    recall = remembering(service, LinearSpace(), alone, heard.rows, bars, {"song-2"})
    in_turn = sampler.keep_best(heard, alone, return_all=True, recall=recall)
    assert together.all_candidates is not None and in_turn.all_candidates is not None
    np.testing.assert_array_equal(together.all_candidates, in_turn.all_candidates)
    np.testing.assert_array_equal(together.trajectory, together.all_candidates[together.best])


def test_what_cannot_be_remembered_is_refused(
    plain: AudioMotionModel, model: AudioMotionModel, service: MPMService
) -> None:
    with pytest.raises(UserError, match="hears no memory"):
        MPMSMotionSampler(plain, service)
    sampler = MPMSMotionSampler(model, service, device="cpu")
    with pytest.raises(UsageError, match="audio_embedding"):
        asyncio.run(sampler.sample_with_mpms(sound(), num_samples=1))
    with pytest.raises(UsageError, match="num_frames 61"):
        asyncio.run(sampler.sample_with_mpms(sound(), 61))
