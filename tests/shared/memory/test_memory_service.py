"""MPMService: in time, or nothing and counted; whatever the index does."""

import asyncio
import gc
import threading
import time
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import torch

from src.shared.config_audio import MemoryConfig
from src.shared.errors import UsageError, UserError
from src.shared.memory.index import Hits, MemoryIndex
from src.shared.memory.query import Memory, retrieve
from src.shared.memory.service import MPMService
from tests.shared.memory.tiny_memory import make_index

FRAMES = 20


class TroubledIndex(MemoryIndex):
    """A real index on a bad day: slow always, broken for every seventh query, stuck for some."""

    def search(self, query: torch.Tensor, **settings: Any) -> Hits:
        number = int(super().search(query, top_k=1).index[0, 0])
        if number % 7 == 3:
            raise OSError(f"injected: no disk for {number}")
        time.sleep(0.5 if number % 11 == 5 else 0.004)
        return super().search(query, **settings)


def same(memory: Memory, other: Memory) -> bool:
    return all(
        torch.equal(getattr(memory, name), getattr(other, name))
        for name in ("context", "priors", "confidence")
    )


def is_null(memory: Memory) -> bool:
    return memory.hits is None and not any(
        values.any() for values in (memory.context, memory.priors, memory.confidence)
    )


def test_two_hundred_at_once_are_right_or_counted_nulls() -> None:
    """Real threads, a real loop: no deadlock, every answer right or null, nobody waits long."""
    healthy = make_index(40)
    index = TroubledIndex(**vars(healthy))
    deadline = 2.0
    service = MPMService(MemoryConfig(workers=4, deadline=deadline, top_k=3), index)
    rng = np.random.default_rng(0)
    asked = [(int(rng.integers(40)), float(rng.random())) for _ in range(200)]
    waited: list[float] = []

    async def one(number: int, phase: float) -> Memory:
        start = time.monotonic()
        memory = await service.query(healthy.audio_keys[number], phase, FRAMES)
        waited.append(time.monotonic() - start)
        return memory

    async def everyone() -> list[Memory]:
        return await asyncio.gather(*(one(number, phase) for number, phase in asked))

    answers = asyncio.run(asyncio.wait_for(everyone(), 60))
    nulls = right = 0
    for (number, phase), answer in zip(asked, answers, strict=True):
        asked_for = healthy.audio_keys[number : number + 1]
        truth = retrieve(healthy, asked_for, MemoryConfig(top_k=3), num_frames=FRAMES, phase=phase)
        if is_null(answer):
            nulls += 1
        else:
            right += 1
            assert same(answer, truth)
    failing = sum(number % 7 == 3 for number, _ in asked)
    assert sum(service.counts.values()) == 200
    assert service.counts["answered"] == right > 0
    assert service.counts["failed"] + service.counts["timed_out"] == nulls
    assert service.counts["failed"] > 0 and service.counts["timed_out"] > 0
    assert service.counts["failed"] <= failing
    assert max(waited) < deadline + 2.0, "the deadline, and what a busy machine adds"


def test_a_hanging_index_takes_nothing_but_its_deadline(tmp_path: Path) -> None:
    never = threading.Event()

    class Stuck(MemoryIndex):
        def search(self, query: torch.Tensor, **settings: Any) -> Hits:
            never.wait()
            raise AssertionError

    service = MPMService(MemoryConfig(workers=2, deadline=0.05), Stuck(**vars(make_index())))

    async def everyone() -> list[Memory]:
        query = make_index().audio_keys[0]
        return await asyncio.gather(*(service.query(query, 0.0, 9) for _ in range(20)))

    assert all(map(is_null, asyncio.run(asyncio.wait_for(everyone(), 30))))
    assert is_null(service.query_now(make_index().audio_keys[0], 0.0, 9))
    assert service.counts == {"answered": 0, "timed_out": 21, "failed": 0}
    never.set()  # the stuck searches end, and with them the errors nobody waits for


def test_threads_end_with_their_service() -> None:
    before = set(threading.enumerate())
    service = MPMService(MemoryConfig(workers=3, deadline=30.0), make_index())
    for _ in range(5):
        service.query_now(make_index().audio_keys, 0.0, 9)
    started = set(threading.enumerate()) - before
    assert 0 < len(started) <= 3
    del service
    gc.collect()
    for thread in started:
        thread.join(30)
        assert not thread.is_alive()


def test_an_index_that_times_out_by_itself_has_failed() -> None:
    class Offline(MemoryIndex):
        def search(self, query: torch.Tensor, **settings: Any) -> Hits:
            raise TimeoutError("injected")

    service = MPMService(MemoryConfig(deadline=30.0), Offline(**vars(make_index())))
    query = make_index().audio_keys[0]
    assert is_null(asyncio.run(service.query(query, 0.0, 9)))
    assert is_null(service.query_now(query, 0.0, 9))
    assert service.counts == {"answered": 0, "timed_out": 0, "failed": 2}


def test_the_ref_snippet(tmp_path: Path) -> None:
    make_index().save(tmp_path)

    async def snippet() -> tuple[MPMService, Memory]:
        mpms = await MPMService.from_config(MemoryConfig(folder=str(tmp_path)))
        await mpms.initialize()
        return mpms, await mpms.query(make_index().audio_keys[2].numpy(), 0.5, 240)

    mpms, memory = asyncio.run(snippet())
    assert memory.context.shape == (1, 256) and memory.priors.shape == (1, 4, 240)
    now = mpms.query_now(make_index().audio_keys[2], 0.5, 240)
    assert same(memory, now) and mpms.counts["answered"] == 2


def test_songs_are_excluded_for_all_or_one_by_one() -> None:
    index = make_index()
    service = MPMService(MemoryConfig(top_k=1), index)
    query = index.audio_keys[:4]
    assert service.query_now(query, None, 5).hits.index[:, 0].tolist() == [0, 1, 2, 3]  # type: ignore[union-attr]
    without = service.query_now(query, None, 5, exclude_songs={"song-0"})
    assert without.hits is not None and not set(without.hits.index[:, 0].tolist()) & {0, 1}
    each = service.query_now(query, None, 5, exclude_songs=[None, {"song-0"}, None, None])
    assert each.hits is not None and each.hits.index[:, 0].tolist()[0] == 0


def test_mistakes_of_the_caller_are_no_nulls(tmp_path: Path) -> None:
    service = MPMService(MemoryConfig(), make_index())
    with pytest.raises(ValueError, match="a query is"):
        service.query_now(np.zeros(3), 0.0, 5)
    with pytest.raises(ValueError, match="phase is"):
        service.query_now(np.zeros((2, 16)), np.zeros(3), 5)
    with pytest.raises(RuntimeError, match="initialize"):
        asyncio.run(MPMService(MemoryConfig(folder=str(tmp_path))).query(np.zeros(16), 0.0, 5))
    with pytest.raises(UsageError, match="folder is empty"):
        asyncio.run(MPMService.from_config(MemoryConfig()))
    with pytest.raises(UserError, match="is no memory"):
        asyncio.run(MPMService(MemoryConfig(folder=str(tmp_path))).initialize())
    assert sum(service.counts.values()) == 0
